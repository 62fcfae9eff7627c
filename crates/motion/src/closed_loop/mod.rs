//! StepNLoop: an encoder watches the motor, and lost pulses are made up for (PMX-2ED-SA manual, section
//! 7.17; CMD-4CR, 2.5.3).
//!
//! While it is on, positions are in encoder counts. The target in real time, P, is where the encoder should
//! stand after the pulses given out so far; the encoder, E, is where it stands; delta is P − E. The device
//! keeps the encoder's counter and passes it in.
//!
//! - Moving, of any kind: a delta beyond the error range stops the motor at once: stall error.
//! - At rest, also long after a move: a delta within the tolerance is in position. Beyond it, once the
//!   shaft has had [`SETTLING_POLLS`] to settle, pulses that make up for it are added at the speed in
//!   force: a correction. If the delta is still too large after the attempts allowed: attempt error. A
//!   delta beyond the error range is a range error at once.
//! - In an error nothing is watched or corrected until it is cleared.
//!
//! Where the manual is silent:
//!
//! - P stays at the target while a correction adds its pulses.
//! - A delta equal to the tolerance is in position, one equal to the error range is corrected.
//! - A delta that is less than half a pulse cannot be corrected and is in position.
//! - Whatever must not move the motor by itself takes E for the new target, so that delta is 0: switching
//!   the loop on, clearing an error, and coming to rest after a stop, an abort or a jog. After homing the
//!   target is what the pulses say, so that zero is kept.
//! - Setting E shifts P and the target along: delta stays. P cannot be set.
//! - Switched off, P is the pulse counter, which has counted all along, corrections included.

mod ratio;
#[cfg(test)]
mod tests;

use crate::axis::{Axis, Goal};
pub use ratio::{MAX_THOUSANDTHS, Ratio};

/// How many polls in a row find the axis at rest and out of position before a correction begins: a motor rings when it stops, and the encoder with it.
pub const SETTLING_POLLS: u8 = 10;

/// The parameters of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pulses a count (`SLR`). Stays the same while the loop is on: P is reckoned with it.
    pub ratio: Ratio,
    /// The largest delta that is in position, in counts (`SLT`).
    pub tolerance: u32,
    /// The largest delta that is no error, in counts (`SLE`).
    pub range: u32,
    /// How many corrections in a row may fail to get into position (`SLA`).
    pub attempts: u32,
}

/// What the loop is doing; its number is the value of `SLS` (table 7.9).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// At rest, watching.
    Idle = 0,
    /// On its way to a target.
    Moving = 1,
    /// Making up for a delta.
    Correcting = 2,
    /// Stopping with the ramp.
    Stopping = 3,
    /// Stopping at once.
    Aborting = 4,
    /// Turning at a speed.
    Jogging = 5,
    /// Homing with the home input.
    Homing = 6,
    /// Homing with the index.
    IndexHoming = 7,
    /// Error: out of the error range at rest.
    RangeError = 8,
    /// Error: corrections did not help.
    AttemptError = 9,
    /// Error: out of the error range on the way.
    StallError = 10,
    /// Error: a limit stopped the motor.
    LimitError = 11,
    /// The loop is off.
    Off = 12,
    /// Homing with a limit.
    LimitHoming = 13,
}

impl Status {
    /// Whether this is one of the four errors, which end only by [`StepNLoop::clear`].
    pub const fn is_error(self) -> bool {
        matches!(self, Self::RangeError | Self::AttemptError | Self::StallError | Self::LimitError)
    }
}

/// A motion that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// To this target, in counts.
    To(i32),
    /// Turning at a speed.
    Jog,
    /// Homing with the home input.
    Home,
    /// Homing with the index.
    IndexHome,
    /// Homing with a limit.
    LimitHome,
    /// Stopping with the ramp.
    Stop,
    /// Stopping at once.
    Abort,
}

/// The loop of an axis.
#[derive(Clone, Debug)]
pub struct StepNLoop {
    status: Status,
    /// A pair that belongs together: pulses of the odometer and encoder counts.
    origin: (i64, i32),
    /// Where to be, in counts. While a motion is on, P is what the pulses say.
    target: i32,
    /// The odometer when the correction under way began.
    corrected_from: i64,
    /// Corrections in a row.
    attempts: u32,
    /// Polls in a row at rest and out of position.
    waited: u8,
}

impl Default for StepNLoop {
    fn default() -> Self {
        Self::new()
    }
}

impl StepNLoop {
    /// A loop that is off.
    pub const fn new() -> Self {
        Self { status: Status::Off, origin: (0, 0), target: 0, corrected_from: 0, attempts: 0, waited: 0 }
    }

    /// What it is doing.
    pub fn status(&self) -> Status {
        self.status
    }

    /// Whether it is on, in an error or not.
    pub fn is_on(&self) -> bool {
        self.status != Status::Off
    }

    /// The target in real time, P, in counts; the pulse counter while the loop is off.
    pub fn position(&self, axis: &Axis, ratio: Ratio) -> i32 {
        match self.status {
            Status::Off => axis.position(),
            Status::Idle | Status::Correcting => self.target,
            status if status.is_error() => self.target,
            _ => self.reached(axis, ratio),
        }
    }

    /// P − E in counts; 0 while the loop is off.
    pub fn delta(&self, axis: &Axis, encoder: i32, ratio: Ratio) -> i32 {
        if self.is_on() { self.position(axis, ratio).wrapping_sub(encoder) } else { 0 }
    }

    /// Switches it on: the encoder's position is the target.
    pub fn enable(&mut self, axis: &Axis, encoder: i32) {
        if !self.is_on() {
            self.hold(axis, encoder);
        }
    }

    /// Switches it off. A correction under way is the caller's to stop.
    pub fn disable(&mut self) {
        self.status = Status::Off;
    }

    /// Ends an error: the encoder's position is the target.
    pub fn clear(&mut self, axis: &Axis, encoder: i32) {
        if self.status.is_error() {
            self.hold(axis, encoder);
        }
    }

    /// The encoder's counter was set and is now `by` larger: P and the target go along.
    pub fn shift(&mut self, by: i32) {
        self.origin.1 = self.origin.1.wrapping_add(by);
        self.target = self.target.wrapping_add(by);
    }

    /// Homing has found zero at this pulse, and the encoder's counter was set to 0 as well.
    pub fn zero(&mut self, axis: &Axis) {
        self.origin = (axis.odometer(), 0);
        self.target = 0;
    }

    /// Where the pulse counter must go for a target in counts: the [`Goal::Position`] of a move. Always
    /// reckoned from the same origin, so that rounding does not add up. `None` if it is more pulses away
    /// than the counter has.
    pub fn goal(&self, axis: &Axis, target: i32, ratio: Ratio) -> Option<i32> {
        let made = axis.odometer() - self.origin_now(axis);
        let counts = ratio.counts(made);
        let here = self.origin.1.wrapping_add(counts as i32);
        let pulses = ratio.pulses(counts + i64::from(target.wrapping_sub(here))) - made;
        let pulses = i32::try_from(pulses).ok().filter(|&pulses| pulses != i32::MIN)?;
        Some(axis.position().wrapping_add(pulses))
    }

    /// A motion begins: before the next poll the axis gets its goal, or the homing routine its first turn.
    /// Nothing while the loop is off or in an error.
    pub fn begin(&mut self, axis: &Axis, motion: Motion) {
        if !self.is_on() || self.status.is_error() {
            return;
        }
        self.end_correction(axis);
        self.attempts = 0;
        self.waited = 0;
        self.status = match motion {
            Motion::To(target) => {
                self.target = target;
                Status::Moving
            }
            Motion::Jog => Status::Jogging,
            Motion::Home => Status::Homing,
            Motion::IndexHome => Status::IndexHoming,
            Motion::LimitHome => Status::LimitHoming,
            Motion::Stop => Status::Stopping,
            Motion::Abort => Status::Aborting,
        };
    }

    /// A limit has stopped the motor, and that is an error. Where it is none (`IERR=1`), this is a
    /// [`Motion::Abort`].
    pub fn limit(&mut self, axis: &Axis, ratio: Ratio) {
        if self.is_on() && !self.status.is_error() {
            self.fail(axis, ratio, Status::LimitError);
        }
    }

    /// Watches; call it every millisecond. Stops the axis or sends it on a correction, at the limits in
    /// force. The new status, if it is another.
    pub fn poll(&mut self, axis: &mut Axis, encoder: i32, settings: &Settings) -> Option<Status> {
        let before = self.status;
        match before {
            Status::Off => {}
            status if status.is_error() => {}
            _ if axis.is_moving() => {
                self.waited = 0;
                self.watch(axis, encoder, settings);
            }
            Status::Stopping | Status::Aborting | Status::Jogging => self.hold(axis, encoder),
            // A routine that turns around is at rest for no time, so a single poll says nothing.
            Status::Homing | Status::IndexHoming | Status::LimitHoming if self.waited == 0 => self.waited = 1,
            Status::Homing | Status::IndexHoming | Status::LimitHoming => {
                self.waited = 0;
                self.target = self.reached(axis, settings.ratio);
                self.status = Status::Idle;
                self.verify(axis, encoder, settings);
            }
            _ => {
                self.end_correction(axis);
                self.verify(axis, encoder, settings);
            }
        }
        if self.status.is_error() && self.status != before {
            axis.halt();
        }
        (self.status != before).then_some(self.status)
    }

    /// Watches a motion, and is to be called instead of [`Self::poll`] while a line carries the axis:
    /// whether this is a stall error and the motion has to stop at once.
    pub fn watch(&mut self, axis: &Axis, encoder: i32, settings: &Settings) -> bool {
        let watching = self.is_on() && !self.status.is_error();
        let stalled = watching && self.delta(axis, encoder, settings.ratio).unsigned_abs() > settings.range;
        if stalled {
            self.fail(axis, settings.ratio, Status::StallError);
        }
        stalled
    }

    /// The axis is at rest: is it where it should be?
    fn verify(&mut self, axis: &mut Axis, encoder: i32, settings: &Settings) {
        let delta = self.target.wrapping_sub(encoder);
        let pulses = settings.ratio.pulses(delta.into());
        if delta.unsigned_abs() > settings.range {
            self.status = Status::RangeError;
            return;
        }
        if delta.unsigned_abs() <= settings.tolerance || pulses == 0 {
            self.status = Status::Idle;
            self.attempts = 0;
            self.waited = 0;
            return;
        }
        self.waited += 1;
        if self.waited < SETTLING_POLLS {
            return;
        }
        if self.attempts >= settings.attempts {
            self.status = Status::AttemptError;
            return;
        }
        self.attempts += 1;
        self.waited = 0;
        self.status = Status::Correcting;
        self.corrected_from = axis.odometer();
        let pulses = pulses.clamp(-i64::from(i32::MAX), i32::MAX.into());
        axis.set_goal(Goal::Position(axis.position().wrapping_add(pulses as i32)));
    }

    /// What the pulses say, in counts.
    fn reached(&self, axis: &Axis, ratio: Ratio) -> i32 {
        let counts = ratio.counts(axis.odometer() - self.origin_now(axis));
        self.origin.1.wrapping_add(counts as i32)
    }

    /// The odometer's part of the origin. The pulses of a correction make up for lost ones: they move the
    /// origin instead of P.
    fn origin_now(&self, axis: &Axis) -> i64 {
        let correction =
            if self.status == Status::Correcting { axis.odometer() - self.corrected_from } else { 0 };
        self.origin.0 + correction
    }

    fn end_correction(&mut self, axis: &Axis) {
        self.origin.0 = self.origin_now(axis);
        self.corrected_from = axis.odometer();
    }

    /// Stays where the encoder stands; a motion that is on goes on as a jog.
    fn hold(&mut self, axis: &Axis, encoder: i32) {
        let status = if axis.is_moving() { Status::Jogging } else { Status::Idle };
        *self = Self { status, origin: (axis.odometer(), encoder), target: encoder, ..Self::new() };
    }

    /// Stays in an error, with P as it is.
    fn fail(&mut self, axis: &Axis, ratio: Ratio, error: Status) {
        self.target = self.position(axis, ratio);
        self.status = error;
    }
}
