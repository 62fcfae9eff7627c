//! Points in time, and a device that comes to one.

use crate::code::Code;
use motion::Ticks;
use sim::{
    DeviceConfig, SharedFlash, TimedInput, VirtualDevice,
    fault::Planned,
    run::{self, RunError},
    tape::{self, Act},
};
use std::sync::atomic::{AtomicBool, Ordering};

/// Seed of a device whose bench file has none: that of `pulsetrain run`.
const SEED: u64 = 0;

/// A point in time, between two lines of the programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Point {
    /// The clock of the device.
    pub clock: Ticks,
    /// How often something was done to the device at the end of the clock that let lines become due in it.
    pub round: u32,
    /// How many lines have been executed in this clock; [`Point::OVER`] if all that happens in it has happened.
    pub line: u32,
}

impl Point {
    /// The line of a clock that is over.
    pub const OVER: u32 = u32::MAX;
}

/// What is debugged: everything on which its course depends, but for what is done to it on the way.
#[derive(Clone, Debug)]
pub struct Target {
    /// The program.
    pub code: Code,
    /// The device in its machine.
    pub config: DeviceConfig,
    /// Inputs that change on the way; times count from the start of the program.
    pub inputs: Vec<TimedInput>,
    /// Faults on the way, as in [`RunOptions`](sim::RunOptions).
    pub faults: Vec<Planned>,
}

/// Something that was done to the device, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Deed {
    /// When.
    pub at: Point,
    /// What.
    pub act: Act,
}

/// A device with its program, held before one of its lines or at the end of a clock.
pub struct Session {
    /// The device.
    pub device: VirtualDevice,
    /// Where it stands.
    pub point: Point,
    /// The program whose line is executed next, if the device stands before a line.
    pub held: Option<usize>,
}

impl Session {
    /// A device that has just been told to start its programs.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn start(target: &Target) -> Result<Self, RunError> {
        let flash = SharedFlash::erased(target.config.model.flash_bytes);
        let mut device = VirtualDevice::with_flash(&target.config, flash, SEED);
        run::load(&mut device, &target.code.program)?;
        let start = device.now();
        for timed in &target.inputs {
            device.schedule(start.saturating_add(device.ticks(timed.seconds)), &timed.input)?;
        }
        for planned in &target.faults {
            device.plan(planned)?;
        }
        run::start(&mut device, &target.code.program)?;
        let mut session = Self { device, point: Point { clock: start, round: 0, line: 0 }, held: None };
        session.arrive(start, false);
        Ok(session)
    }

    /// The same at a later point, after all deeds up to there; `None` if somebody interrupts it on the way.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn at(
        target: &Target,
        deeds: &[Deed],
        point: Point,
        interrupt: &AtomicBool,
    ) -> Result<Option<Self>, RunError> {
        let mut session = Self::start(target)?;
        for deed in deeds.iter().take_while(|deed| deed.at <= point) {
            if !session.play(deed.at, interrupt) {
                return Ok(None);
            }
            let done = session.perform(&deed.act);
            assert!(done.is_ok(), "what could be done once can be done again");
        }
        Ok(session.play(point, interrupt).then_some(session))
    }

    /// Goes to the next line that is due, but no further than the end of clock `until`, or the next thing that
    /// happens by itself if it `wakes`.
    pub fn arrive(&mut self, until: Ticks, wakes: bool) {
        let before = self.point;
        self.held = self.device.advance_to_line(until, wakes);
        let clock = self.device.now();
        let (round, line) = match (clock == before.clock, before.line) {
            (true, Point::OVER) if self.held.is_some() => (before.round + 1, 0),
            (true, line) => (before.round, line),
            (false, _) => (0, 0),
        };
        self.point = Point { clock, round, line: if self.held.is_some() { line } else { Point::OVER } };
    }

    /// Executes the line before which the device stands, if it does.
    pub fn execute(&mut self) {
        if self.held.take().is_some() {
            self.device.execute_line();
            self.point.line += 1;
        }
    }

    /// Does something to the device, here and now.
    ///
    /// # Errors
    /// What the device says against it.
    pub fn perform(&mut self, act: &Act) -> Result<(), String> {
        tape::perform(&mut self.device, act)?;
        // A fault that waited for this may have taken the supply away.
        self.held = self.held.filter(|_| self.device.is_held());
        Ok(())
    }

    /// Goes on to a point that was arrived at before, without looking at the lines on the way; false if somebody
    /// interrupts it.
    fn play(&mut self, point: Point, interrupt: &AtomicBool) -> bool {
        assert!(point >= self.point, "a device goes forward only");
        let over = point.line == Point::OVER;
        // Nobody needs to see what comes before the clock.
        let clock = if over { point.clock } else { point.clock.saturating_sub(1) };
        if clock > self.point.clock || over && point != self.point {
            self.device.release_lines();
            while self.device.now() < clock {
                if interrupt.load(Ordering::Relaxed) {
                    return false;
                }
                self.device.advance(next_second(&self.device).min(clock));
            }
            self.device.advance(clock);
            self.point = if over { point } else { Point { clock, round: 0, line: Point::OVER } };
            self.held = None;
        }
        while self.point < point {
            self.execute();
            self.arrive(point.clock, false);
        }
        assert!(self.point == point, "a run is a function of its input");
        true
    }
}

/// The next whole second of device time: nobody who interrupts a device waits for longer than it takes to get there.
pub fn next_second(device: &VirtualDevice) -> Ticks {
    let second = Ticks::from(device.clock_hz());
    (device.now() / second + 1).saturating_mul(second)
}
