//! ST's NUCLEO-G474RE: an STM32G474RE, a Cortex-M4 at 170 MHz, with drivers that have step, direction and enable pins.
//!
//! It builds; it was never run on hardware. `wiring.rs` says what is connected where. Without it are analog inputs
//! and outputs, pulser inputs, and a measurement of the load; index marks shorter than a tick of the main loop are not
//! seen.
#![no_std]

mod chip;
mod encoders;
mod flash;
mod gpio;
mod hardware;
mod pins;
mod serial;
mod timer;
mod watchdog;
mod wiring;

pub use flash::{Nor, NorError};
pub use hardware::Hardware;
pub use pins::Pins;
pub use serial::{Console, Serial};
pub use stm32g4::stm32g474::interrupt;
pub use timer::PlayerTimer;

use devices::Pin;

runtime::compile_players!(PlayerTimer, Pins: 1 2 4);

/// Its name.
pub const NAME: &str = "nucleo-g474re";

/// Where random numbers start from: the time that there is until somebody asks for it.
pub fn seed() -> u64 {
    use runtime::Timer as _;
    PlayerTimer.now().into()
}

/// Defines the interrupt of the player's timer.
#[macro_export]
macro_rules! player_interrupt {
    ($play:expr) => {
        use $crate::interrupt;

        #[interrupt]
        fn TIM2() {
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
    /// Flash pages for the cause of a stop.
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
    /// Lets them come. Why the image had stopped before this start has been said on the console.
    pub fn enable(mut self, _cause: &str) {
        timer::start_clock(&mut self.0.SYST);
        chip::enable_interrupts(&mut self.0.NVIC, &mut self.0.SCB);
    }
}

impl Board {
    /// Takes the board, which then counts time and has a watchdog to be fed.
    ///
    /// # Panics
    /// The second time, and for a controller with more axes than there are pins for.
    pub fn take(pins: &'static [Pin], axes: usize, _settings_bytes: u32) -> Self {
        let core = cortex_m::Peripherals::take().expect("the board is taken once");
        assert!(axes <= runtime::hardware::MAX_AXES, "the board has fewer axes");
        chip::start_clock();
        gpio::start();
        let pins_driven = Pins::new(pins);
        timer::start();
        Self {
            hardware: Hardware::new(pins),
            timer: PlayerTimer,
            pins: pins_driven,
            causes: Nor::causes(),
            console: Console::open(),
            by_watchdog: watchdog::start(),
            interrupts: Interrupts(core),
        }
    }
}

/// Stops for good: no interrupt, no pulse, no current, nothing driven.
pub fn stop() {
    cortex_m::interrupt::disable();
    pins::quiet();
    pins::release_all();
}

/// The pages for the cause of a stop, for whoever has stopped the board and never gives it back.
pub fn causes_after_stop() -> Option<Nor> {
    Some(Nor::causes())
}

/// Keeps the board as it is until somebody resets it.
pub fn stay_stopped() -> ! {
    loop {
        watchdog::feed();
        cortex_m::asm::delay(chip::HZ / 1000);
    }
}
