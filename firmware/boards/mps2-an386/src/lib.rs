//! Arm's MPS2 board with the image AN386, a Cortex-M4 at 25 MHz, as QEMU emulates it: for tests of firmware without
//! hardware.
//!
//! QEMU has no pins there. The board's PSRAM is a file on the host, and in it are the bench page (`bench/page.rs`),
//! through which a program on the host is the machine on the pins, and the flash memory, which outlives that QEMU
//! is killed, as real flash does a power cut. Whatever a program on the host would be too slow for follows from the
//! page by itself: which switch or mark is on is looked up in the interrupt that plays the pulse.
#![no_std]

mod bench;
mod clock;
mod flash;
mod hardware;
mod pins;
mod registers;
mod serial;
mod timer;
mod vectors;
mod watchdog;

pub use flash::{Nor, NorError};
pub use hardware::Mps2 as Hardware;
pub use pins::BenchPins as Pins;
pub use serial::{Console, Serial};
pub use timer::PlayerTimer;
pub use vectors::Interrupt;

use core::sync::atomic::{AtomicU32, Ordering};
use devices::Pin;

runtime::compile_players!(PlayerTimer, Pins: 1 2 4);

/// Its name.
pub const NAME: &str = "mps2-an386";

/// Where random numbers start from: as in simulated runs.
pub const fn seed() -> u64 {
    0
}

/// Bytes of flash for the settings, once the board is taken.
static SETTINGS_BYTES: AtomicU32 = AtomicU32::new(0);

/// Defines the interrupt of the player's timer.
#[macro_export]
macro_rules! player_interrupt {
    ($play:expr) => {
        use $crate::Interrupt as interrupt;

        #[cortex_m_rt::interrupt]
        fn TIMER0() {
            $play
        }
    };
}

/// Everything that is on it.
pub struct Board {
    /// For the main loop.
    pub hardware: Hardware,
    /// For the player.
    pub timer: PlayerTimer,
    /// For the player.
    pub pins: Pins,
    /// A page of flash for the cause of a stop.
    pub causes: Nor,
    /// For people.
    pub console: Console,
    /// Whether the watchdog was what reset it.
    pub by_watchdog: bool,
    /// Off until the player is in its place.
    pub interrupts: Interrupts,
}

/// The board's interrupts.
pub struct Interrupts(cortex_m::Peripherals);

impl Interrupts {
    /// Lets them come. `cause` is why the image had stopped before this start; empty if it had not.
    pub fn enable(mut self, cause: &str) {
        clock::start(&mut self.0.SYST);
        vectors::enable(&mut self.0.NVIC, &mut self.0.SCB);
        bench::open(cause);
    }
}

impl Board {
    /// Takes the board, which then counts time and has a watchdog to be fed.
    ///
    /// # Panics
    /// The second time, and for a controller with more pins, axes or settings than there is room for.
    pub fn take(pins: &'static [Pin], axes: usize, settings_bytes: u32) -> Self {
        let core = cortex_m::Peripherals::take().expect("the board is taken once");
        assert!(
            pins.len() <= bench::page::PINS && axes <= runtime::hardware::MAX_AXES,
            "the page is too small"
        );
        timer::start();
        let by_watchdog = watchdog::start();
        let mut causes = Nor::causes(settings_bytes);
        if !bench::is_known() {
            Nor::settings(settings_bytes).make_new();
            causes.make_new();
        }
        SETTINGS_BYTES.store(settings_bytes, Ordering::Relaxed);
        bench::begin(axes, settings_bytes, by_watchdog);
        Self {
            hardware: Hardware::new(pins, axes),
            timer: PlayerTimer,
            pins: Pins::new(),
            causes,
            console: Console::open(),
            by_watchdog,
            interrupts: Interrupts(core),
        }
    }
}

/// Stops for good: no interrupt, no pulse, no current, nothing driven.
pub fn stop() {
    cortex_m::interrupt::disable();
    bench::stop();
}

/// The page for the cause of a stop, for whoever has stopped the board and never gives it back. `None` before the
/// board was taken.
pub fn causes_after_stop() -> Option<Nor> {
    match SETTINGS_BYTES.load(Ordering::Relaxed) {
        0 => None,
        bytes => Some(Nor::causes(bytes)),
    }
}

/// Keeps the board as it is until somebody resets it.
pub fn stay_stopped() -> ! {
    loop {
        watchdog::feed();
        cortex_m::asm::delay(timer::HZ / 1000);
    }
}
