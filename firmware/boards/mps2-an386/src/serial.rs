//! The serial ports. Bytes that come wait in a queue until the main loop takes them; when that is full, the last one
//! waits in the port, and whoever sends them waits too.

use crate::clock;
use crate::registers::{Block, UART0, UART1, UART2, Uart};
use crate::timer::HZ;
use crate::vectors::Interrupt;
use core::cell::RefCell;
use core::convert::Infallible;
use core::fmt;
use cortex_m::peripheral::NVIC;
use critical_section::Mutex;
use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use heapless::spsc::{Consumer, Producer, Queue};
use static_cell::ConstStaticCell;
use tock_registers::interfaces::{Readable, Writeable};

/// Bits a second.
const BAUD: u32 = 115_200;

/// Bytes that a port keeps for the main loop: what comes in some milliseconds.
const KEPT_BYTES: usize = 128;

/// Bits of the state word.
const FULL: u32 = 1;
const CAME: u32 = 1 << 1;

/// Bits of the control word.
const SENDS: u32 = 1;
const RECEIVES: u32 = 1 << 1;
const RECEIVE_INTERRUPT: u32 = 1 << 3;

/// The receive interrupt in the word of interrupts.
const RECEIVED: u32 = 1 << 1;

/// The ports for bytes: the queue of each, and the end of it that its interrupt has.
type Kept = Queue<u8, KEPT_BYTES>;
static KEPT: [ConstStaticCell<Kept>; 2] = [const { ConstStaticCell::new(Kept::new()) }; 2];
static RECEIVERS: [Mutex<RefCell<Option<Producer<'static, u8>>>>; 2] =
    [const { Mutex::new(RefCell::new(None)) }; 2];

/// A port.
pub struct Serial {
    uart: Block<Uart>,
    interrupt: Interrupt,
    kept: Consumer<'static, u8>,
}

impl Serial {
    /// Sets up port 0 or 1.
    ///
    /// # Panics
    /// The second time.
    pub fn open(port: usize) -> Self {
        let (uart, interrupt) = [(UART0, Interrupt::UART0RX), (UART1, Interrupt::UART1RX)][port];
        let (producer, kept) = KEPT[port].take().split();
        critical_section::with(|section| RECEIVERS[port].borrow_ref_mut(section).replace(producer));
        uart.divider.set(HZ / BAUD);
        uart.control.set(SENDS | RECEIVES | RECEIVE_INTERRUPT);
        Self { uart, interrupt, kept }
    }
}

/// Takes the bytes that came at a port.
fn receive(port: usize, uart: Block<Uart>) {
    uart.interrupts.set(RECEIVED);
    critical_section::with(|section| {
        let mut receiver = RECEIVERS[port].borrow_ref_mut(section);
        let Some(receiver) = receiver.as_mut() else { return };
        while receiver.ready() && uart.state.get() & CAME != 0 {
            // There is room: this was asked just now.
            let _ = receiver.enqueue(uart.data.get() as u8);
        }
    });
    clock::wake();
}

/// The interrupts.
mod interrupts {
    use super::*;
    use crate::vectors::Interrupt as interrupt;
    use cortex_m_rt::interrupt;

    #[interrupt]
    fn UART0RX() {
        receive(0, UART0);
    }

    #[interrupt]
    fn UART1RX() {
        receive(1, UART1);
    }
}

impl runtime::Serial for Serial {
    fn is_sent(&mut self) -> bool {
        self.uart.state.get() & FULL == 0
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
        while !buffer.is_empty() && !self.kept.ready() {
            cortex_m::asm::nop();
        }
        let mut read = 0;
        for (place, byte) in buffer.iter_mut().zip(core::iter::from_fn(|| self.kept.dequeue())) {
            *place = byte;
            read += 1;
        }
        // A byte that found no room makes no further interrupt.
        if self.uart.state.get() & CAME != 0 {
            NVIC::pend(self.interrupt);
        }
        Ok(read)
    }
}

impl WriteReady for Serial {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.uart.state.get() & FULL == 0)
    }
}

impl Write for Serial {
    fn write(&mut self, buffer: &[u8]) -> Result<usize, Infallible> {
        let Some(&byte) = buffer.first() else { return Ok(0) };
        while self.uart.state.get() & FULL != 0 {
            cortex_m::asm::nop();
        }
        self.uart.data.set(byte.into());
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while self.uart.state.get() & FULL != 0 {
            cortex_m::asm::nop();
        }
        Ok(())
    }
}

/// Port 2, for people: what is said at the start. Nobody has to listen.
pub struct Console(());

/// How often it is asked whether there is room for a byte before that is dropped: longer than a byte takes.
const PATIENCE: u32 = 100_000;

impl Console {
    /// Sets the port up.
    pub fn open() -> Self {
        UART2.divider.set(HZ / BAUD);
        UART2.control.set(SENDS);
        Self(())
    }
}

impl fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            let mut tries = 0..PATIENCE;
            if tries.any(|_| UART2.state.get() & FULL == 0) {
                UART2.data.set(byte.into());
            }
        }
        Ok(())
    }
}
