//! The serial ports: USART 2 for a host, USART 1 for an RS-485 bus, USART 3 for people. Bytes that come wait in a queue
//! until the main loop takes them; eight that go wait in the port.

use crate::chip::{self, chip, put};
use crate::wiring;
use core::cell::RefCell;
use core::convert::Infallible;
use core::fmt;
use critical_section::Mutex;
use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use heapless::spsc::{Consumer, Producer, Queue};
use static_cell::ConstStaticCell;
use stm32g4::stm32g474::interrupt;
use stm32g4::stm32g474::usart1::RegisterBlock;

/// Bits a second.
const BAUD: u32 = 115_200;

/// Bytes that a port keeps for the main loop: what comes in ten milliseconds.
const KEPT_BYTES: usize = 128;

/// Bits of the first control word: on, receives, sends, interrupts for what comes, has queues of eight.
const ON: u32 = 1;
const RECEIVES: u32 = 1 << 2;
const SENDS: u32 = 1 << 3;
const RECEIVE_INTERRUPT: u32 = 1 << 5;
const QUEUES: u32 = 1 << 29;

/// The driver's enable pin is on for a sixteenth of a bit, sixteen times, before a byte and after it.
const DRIVER_TIMES: u32 = 16 << 21 | 16 << 16;
/// In the third control word: there is such a pin.
const DRIVER: u32 = 1 << 14;

/// Bits of the status word.
const CAME: u32 = 1 << 5;
const ALL_SENT: u32 = 1 << 6;
const HAS_ROOM: u32 = 1 << 7;

/// All that can be cleared: errors above all, which would stop reception.
const ERRORS: u32 = 0xF;

type Kept = Queue<u8, KEPT_BYTES>;
static KEPT: [ConstStaticCell<Kept>; 2] = [const { ConstStaticCell::new(Kept::new()) }; 2];
static RECEIVERS: [Mutex<RefCell<Option<Producer<'static, u8>>>>; 2] =
    [const { Mutex::new(RefCell::new(None)) }; 2];

/// Which of the ports for bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// USART 2.
    Host,
    /// USART 1.
    Bus,
}

/// Does something with the registers of a port.
fn on<T>(which: Which, body: impl FnOnce(&RegisterBlock) -> T) -> T {
    match which {
        Which::Host => body(&chip().USART2),
        Which::Bus => body(&chip().USART1),
    }
}

/// A port.
pub struct Serial {
    which: Which,
    kept: Consumer<'static, u8>,
}

impl Serial {
    /// Sets it up.
    ///
    /// # Panics
    /// The second time.
    pub fn open(which: Which) -> Self {
        let (producer, kept) = KEPT[which as usize].take().split();
        critical_section::with(|section| RECEIVERS[which as usize].borrow_ref_mut(section).replace(producer));
        let pins = match which {
            Which::Host => {
                chip().RCC.apb1enr1().modify(|_, w| w.usart2en().set_bit());
                wiring::USART2.as_slice()
            }
            Which::Bus => {
                chip().RCC.apb2enr().modify(|_, w| w.usart1en().set_bit());
                wiring::USART1.as_slice()
            }
        };
        pins.iter().for_each(|pin| pin.make_alternate(wiring::USART_FUNCTION));
        on(which, |port| {
            let driver = which == Which::Bus;
            put(port.brr(), chip::HZ / BAUD);
            put(port.cr3(), if driver { DRIVER } else { 0 });
            let times = if driver { DRIVER_TIMES } else { 0 };
            put(port.cr1(), QUEUES | times | RECEIVE_INTERRUPT | RECEIVES | SENDS | ON);
        });
        Self { which, kept }
    }

    fn has(&self, bit: u32) -> bool {
        on(self.which, |port| port.isr().read().bits() & bit != 0)
    }
}

/// Takes the bytes that came. One that finds no room is lost, as is one that comes too fast.
fn receive(which: Which) {
    critical_section::with(|section| {
        let mut receiver = RECEIVERS[which as usize].borrow_ref_mut(section);
        on(which, |port| {
            put(port.icr(), ERRORS);
            while port.isr().read().bits() & CAME != 0 {
                let byte = port.rdr().read().bits() as u8;
                let _ = receiver.as_mut().map(|receiver| receiver.enqueue(byte));
            }
        });
    });
}

#[interrupt]
fn USART2() {
    receive(Which::Host);
}

#[interrupt]
fn USART1() {
    receive(Which::Bus);
}

impl runtime::Serial for Serial {
    fn is_sent(&mut self) -> bool {
        self.has(ALL_SENT)
    }
}

impl ErrorType for Serial {
    type Error = Infallible;
}

impl ReadReady for Serial {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.kept.ready())
    }
}

impl Read for Serial {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        while !buffer.is_empty() && !self.kept.ready() {}
        let mut read = 0;
        for (place, byte) in buffer.iter_mut().zip(core::iter::from_fn(|| self.kept.dequeue())) {
            *place = byte;
            read += 1;
        }
        Ok(read)
    }
}

impl WriteReady for Serial {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.has(HAS_ROOM))
    }
}

impl Write for Serial {
    fn write(&mut self, buffer: &[u8]) -> Result<usize, Infallible> {
        let Some(&byte) = buffer.first() else { return Ok(0) };
        while !self.has(HAS_ROOM) {}
        on(self.which, |port| put(port.tdr(), byte.into()));
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while !self.has(ALL_SENT) {}
        Ok(())
    }
}

/// For people: what is said at the start.
pub struct Console(());

impl Console {
    /// Sets the port up.
    pub fn open() -> Self {
        chip().RCC.apb1enr1().modify(|_, w| w.usart3en().set_bit());
        wiring::USART3.iter().for_each(|pin| pin.make_alternate(wiring::USART_FUNCTION));
        let port = chip().USART3;
        put(port.brr(), chip::HZ / BAUD);
        put(port.cr1(), SENDS | ON);
        Self(())
    }
}

impl fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let port = chip().USART3;
        for byte in text.bytes() {
            while port.isr().read().bits() & HAS_ROOM == 0 {}
            put(port.tdr(), byte.into());
        }
        Ok(())
    }
}
