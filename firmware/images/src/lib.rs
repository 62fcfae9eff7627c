//! What the firmware images share: a controller, a board and what is between them, as statics.
//!
//! An image is a controller, an [`Image`] and two functions: the entry, which calls [`Image::run`], and the interrupt of
//! the player's timer, which calls [`Image::play`]. Which board it is for is a feature.
#![no_std]

mod fault;

#[cfg(feature = "mps2-an386")]
pub use mps2_an386 as board;
#[cfg(all(feature = "nucleo-g474re", not(feature = "mps2-an386")))]
pub use nucleo_g474re as board;

use board::Board;
use core::cell::RefCell;
use core::fmt::Write as _;
use critical_section::Mutex;
use devices::Controller;
use runtime::{Loop, Pages, Plan, Player, Plays, Queues};
use static_cell::StaticCell;

/// The memory for a controller's settings.
pub type Settings = Pages<board::Nor>;

/// The main loop of a controller.
type Main<C, const AXES: usize> = Loop<'static, 'static, C, board::Hardware, AXES>;

/// What it is made of.
type Parts<C, const AXES: usize> = (&'static mut C, board::Hardware, Plan<'static, AXES>);

/// What an image has to know of a model.
pub struct Model {
    /// Its name.
    pub name: &'static str,
    /// Bytes of flash for its settings.
    pub settings_bytes: u32,
}

impl Model {
    /// The flash for its settings.
    pub const fn settings(&self) -> Settings {
        Settings::new(board::Nor::settings(self.settings_bytes), 0, self.settings_bytes)
    }
}

/// What the interrupt of the player's timer works with.
struct Interrupt<const AXES: usize> {
    player: Player<'static, AXES>,
    timer: board::PlayerTimer,
    pins: board::Pins,
}

/// What stands between a controller and its pins, in places that last. Nothing in it has a value before it runs, so that
/// it takes no flash.
pub struct Image<C: Controller + 'static, const AXES: usize> {
    main: StaticCell<Main<C, AXES>>,
    queues: StaticCell<Queues<AXES>>,
    player: StaticCell<Interrupt<AXES>>,
    /// The same, once it is there.
    interrupt: Mutex<RefCell<Option<&'static mut Interrupt<AXES>>>>,
}

impl<C: Controller, const AXES: usize> Image<C, AXES> {
    /// Room for it.
    pub const fn new() -> Self {
        Self {
            main: StaticCell::new(),
            queues: StaticCell::new(),
            player: StaticCell::new(),
            interrupt: Mutex::new(RefCell::new(None)),
        }
    }

    /// Switches on the board and a controller, and runs it. For the entry.
    ///
    /// # Panics
    /// The second time, and where board and controller do not fit.
    pub fn run(&'static self, model: Model, controller: &'static mut C, power_on: impl FnOnce(&mut C)) -> ! {
        fault::guard_stack();
        let parts = self.switch_on(model, controller, power_on);
        let main = self.begin(parts);
        loop {
            main.turn();
            main.rest();
        }
    }

    /// Makes the main loop. Like what comes before, apart, so that nothing of it stays on the stack.
    #[inline(never)]
    fn begin(&'static self, (controller, hardware, plan): Parts<C, AXES>) -> &'static mut Main<C, AXES> {
        self.main.init_with(|| Loop::new(controller, hardware, plan))
    }

    /// Everything before that.
    #[inline(never)]
    fn switch_on(
        &'static self,
        Model { name, settings_bytes }: Model,
        controller: &'static mut C,
        power_on: impl FnOnce(&mut C),
    ) -> Parts<C, AXES> {
        let mut board = Board::take(controller.pins(), AXES, settings_bytes);
        let cause = last_stop(&mut board);
        let version = env!("CARGO_PKG_VERSION");
        // A console takes everything.
        let _ = writeln!(board.console, "pulsetrain {name} {version} on {}\r", board::NAME);
        if !cause.is_empty() {
            let _ = writeln!(board.console, "last stop: {cause}\r");
        }
        power_on(controller);
        let (plan, player) = self.queues.init_with(Queues::new).split();
        let Board { hardware, timer, pins, interrupts, .. } = board;
        let interrupt = self.player.init_with(|| Interrupt { player, timer, pins });
        critical_section::with(|section| self.interrupt.borrow_ref_mut(section).replace(interrupt));
        interrupts.enable(&cause);
        (controller, hardware, plan)
    }

    /// Plays what is due. For the interrupt of the player's timer, before which no other goes.
    #[inline]
    pub fn play(&'static self)
    where
        Player<'static, AXES>: Plays<board::PlayerTimer, board::Pins>,
    {
        critical_section::with(|section| {
            if let Some(interrupt) = &mut *self.interrupt.borrow_ref_mut(section) {
                interrupt.player.interrupt(&mut interrupt.timer, &mut interrupt.pins);
            }
        });
    }
}

impl<C: Controller, const AXES: usize> Default for Image<C, AXES> {
    fn default() -> Self {
        Self::new()
    }
}

/// Why the firmware had stopped before this start; empty if it had not.
fn last_stop(board: &mut Board) -> runtime::fault::Cause {
    if board.by_watchdog {
        return "the watchdog was not fed".try_into().unwrap_or_default();
    }
    // Whatever cannot be read was not stored.
    runtime::fault::take(&mut board.causes, 0).ok().flatten().unwrap_or_default()
}
