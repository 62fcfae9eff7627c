//! One axis' motor and what it drives.

use super::{
    stall::{Field, spacing},
    torque::FULL_CURRENT,
    zone::NEVER,
};
use devices::Drive;
use motion::Train;

/// Load and torque are parts in a thousand of the pull-out torque at full current.
pub(crate) const FULL_TORQUE: u32 = 1000;

/// A window of pulses that may be lost reaches so many times less far than the nearest edge: an axis that loses
/// some one way, and comes back, has gone up to twice as far as its window is long.
const SURE_PART: i64 = 4;

/// A driver stage that no controller has told anything yet.
const UNTOLD: Drive = Drive { step: 1, parts: 1, current: FULL_CURRENT };

/// Which of two positions is meant: they differ by the play between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// The motor's own shaft.
    Motor,
    /// What it drives.
    Load,
}

/// Positions of one side, below and above its present one, at which something changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Edge {
    pub side: Side,
    pub below: i64,
    pub above: i64,
}

/// A motor that follows its trains unless it has no current, is loaded too much, or stands against
/// something.
///
/// Positions count what one pulse turns at full resolution: 1/256 of a full step for a driver with
/// microsteps. The driven side lies between the motor and the backlash above
/// it: it follows upward motion at once and downward motion after the play.
#[derive(Clone, Debug)]
pub(crate) struct Shaft {
    motor: i64,
    load: i64,
    backlash: i64,
    stops: [i64; 2],
    drive: Drive,
    load_permille: u32,
    /// How many of the next pulses the motor will not follow.
    losing: u64,
    odometer: i64,
    pushing: i64,
    /// The field of a motor whose torque is known at each speed.
    field: Option<Box<Field>>,
}

impl Shaft {
    pub fn new(backlash: i64, stops: Option<[i64; 2]>) -> Self {
        let stops = stops.unwrap_or([-NEVER, NEVER]);
        Self {
            motor: 0,
            load: 0,
            backlash,
            stops,
            drive: UNTOLD,
            load_permille: 0,
            losing: 0,
            odometer: 0,
            pushing: 0,
            field: None,
        }
    }

    /// The same with a motor whose torque depends on its speed.
    pub fn with_field(mut self, field: Option<Field>) -> Self {
        self.field = field.map(Box::new);
        self.set_field();
        self
    }

    /// The controller was switched off and on: it counts from 0 again, the shaft stays where it is.
    pub fn power_up(&mut self) {
        self.odometer = 0;
        self.pushing = 0;
        if let Some(field) = &mut self.field {
            field.power_up();
        }
        self.set_drive(UNTOLD);
    }

    pub fn position(&self, side: Side) -> i64 {
        match side {
            Side::Motor => self.motor,
            Side::Load => self.load,
        }
    }

    pub fn odometer(&self) -> i64 {
        self.odometer
    }

    /// The driver stage.
    pub fn drive(&self) -> Drive {
        self.drive
    }

    /// The driver stage changes.
    pub fn set_drive(&mut self, drive: Drive) {
        self.drive = drive;
        self.set_field();
    }

    pub fn set_load(&mut self, permille: u32) {
        self.load_permille = permille;
        self.set_field();
    }

    /// The supply is this part of that at which the torque was found.
    pub fn set_supply(&mut self, part: f64) {
        if let Some(field) = &mut self.field {
            field.set_supply(part);
        }
        self.set_field();
    }

    fn set_field(&mut self) {
        let (load, drive) = (self.load_part(), self.drive);
        if let Some(field) = &mut self.field {
            field.set(load, drive);
        }
    }

    fn load_part(&self) -> f64 {
        f64::from(self.load_permille) / f64::from(FULL_TORQUE)
    }

    /// The load as the driver stage can measure it: full against a stop, and in parts of the torque that there
    /// is at the present speed.
    pub fn load_permille(&self) -> u32 {
        let load = match &self.field {
            None => self.load_permille,
            Some(field) => {
                (field.share(self.load_part(), self.drive) * f64::from(FULL_TORQUE)).round() as u32
            }
        };
        if self.pushing != 0 { load.max(FULL_TORQUE) } else { load }
    }

    /// Whether pulses move the shaft.
    fn follows(&self) -> bool {
        let current = u32::from(self.drive.current.min(FULL_CURRENT));
        let torque = FULL_TORQUE * current / u32::from(FULL_CURRENT);
        current > 0 && self.load_permille <= torque
    }

    /// The motor will not follow so many of the pulses that it would follow, from the next one on.
    pub fn lose(&mut self, pulses: u64) {
        self.losing = self.losing.saturating_add(pulses);
    }

    /// The pulses of a train.
    pub fn follow(&mut self, train: &Train) {
        let sign = train.direction.sign();
        self.odometer += sign * i64::from(train.count);
        if let Some(mut field) = self.field.take() {
            self.follow_field(&mut field, train, sign * i64::from(self.drive.step));
            field.pass(train);
            self.field = Some(field);
        } else if self.follows() {
            let lost = self.losing.min(train.count.into());
            self.losing -= lost;
            let pulses = i64::from(train.count) - lost as i64;
            self.turn(sign * pulses * i64::from(self.drive.step));
        }
    }

    /// The field turns so far with each pulse of a train, and the rotor follows where it can.
    fn follow_field(&mut self, field: &mut Field, train: &Train, step: i64) {
        self.pulse(field, field.is_followed(field.first_interval(train)), step);
        let others = i64::from(train.count - 1);
        let [low, high] = self.stops;
        let way = self.motor.saturating_add(others * step);
        let is_free = self.losing == 0 && field.ahead == 0 && low - self.backlash <= way && way <= high;
        if is_free && field.is_followed_throughout(train) {
            self.turn(others * step);
        } else if field.is_lost_throughout(train) {
            field.turn(others * step);
        } else {
            for k in 2..=train.count {
                self.pulse(field, field.is_followed(spacing(train, k)), step);
            }
        }
    }

    /// One pulse that turns the field so far.
    fn pulse(&mut self, field: &mut Field, is_followed: bool, step: i64) {
        if is_followed && self.losing > 0 {
            self.losing -= 1;
            return;
        }
        field.turn(step);
        if is_followed {
            let wanted = self.motor.saturating_add(field.ahead);
            self.turn(field.ahead);
            field.ahead = wanted - self.motor;
        }
    }

    /// Turns the motor, as far as it can.
    pub fn turn(&mut self, distance: i64) {
        let wanted = self.motor.saturating_add(distance);
        let [low, high] = self.stops;
        self.motor = wanted.clamp(low.saturating_sub(self.backlash), high);
        self.pushing = (wanted - self.motor).signum();
        self.load = self.load.clamp(self.motor, self.motor.saturating_add(self.backlash));
    }

    /// The odometer window in which it arrives at none of these edges.
    ///
    /// What a pulse does changes at a stop, so a window ends there too.
    pub fn window(&self, edges: &[Edge]) -> (i64, i64) {
        let step = i64::from(self.drive.step);
        if let Some(field) = &self.field
            && self.losing == 0
        {
            return self.careful_window(edges, field.jump());
        }
        if self.field.is_none() && !self.follows() || step == 0 {
            return (-NEVER, NEVER);
        }
        // Each pulse that is lost moves the edges, whatever its direction.
        if self.losing > 0 {
            return (self.odometer - 1, self.odometer + 1);
        }
        let [stop_below, stop_above] = self.stops;
        // The next stop, or the very next pulse off the one it leans on or into it.
        let mut low = (stop_below - self.backlash).min(self.motor - 1);
        let mut high = stop_above.max(self.motor + 1);
        for edge in edges {
            // The driven side arrives below when the motor has gone through the play.
            let play = if edge.side == Side::Load { self.backlash } else { 0 };
            low = low.max(edge.below - play);
            high = high.min(edge.above);
        }
        let down = pulses(self.motor - low, step.abs());
        let up = pulses(high - self.motor, step.abs());
        let (down, up) = if step > 0 { (down, up) } else { (up, down) };
        (self.odometer - down, self.odometer + up)
    }
    /// The same where any pulse may be lost, also on the way back, and the rotor may jump: only a part of the
    /// way to the nearest edge is sure.
    fn careful_window(&self, edges: &[Edge], jump: i64) -> (i64, i64) {
        let distances = edges.iter().map(|edge| {
            let play = if edge.side == Side::Load { self.backlash } else { 0 };
            (self.motor - edge.below + play).min(edge.above - self.motor)
        });
        let nearest = distances.min().unwrap_or(NEVER);
        if nearest >= NEVER / 2 {
            return (-NEVER, NEVER);
        }
        let step = i64::from(self.drive.step).abs().max(1);
        let pulses = ((nearest - jump) / (SURE_PART * step)).max(1);
        (self.odometer - pulses, self.odometer + pulses)
    }
}

/// How many pulses of `step` it takes to cover `distance`.
fn pulses(distance: i64, step: i64) -> i64 {
    if distance >= NEVER / 2 { NEVER } else { (distance + step - 1) / step }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion::{Direction, Moment, train::EVERY_SLOT};

    fn train(pulses: i64) -> Train {
        let (count, direction) = (pulses.unsigned_abs() as u32, Direction::of(pulses));
        Train { start: Moment::at(0), interval: 1 << 40, add: 0, jerk: 0, count, direction, mask: EVERY_SLOT }
    }

    /// Moves in pulses, and where motor and load are after each.
    #[track_caller]
    fn check(mut shaft: Shaft, moves: &[(i64, i64, i64)]) {
        for (pulses, motor, load) in moves {
            shaft.follow(&train(*pulses));
            assert_eq!(
                (shaft.position(Side::Motor), shaft.position(Side::Load)),
                (*motor, *load),
                "{pulses}"
            );
        }
        assert_eq!(shaft.odometer(), moves.iter().map(|(pulses, ..)| pulses).sum::<i64>());
    }

    fn edge(side: Side, below: i64, above: i64) -> Edge {
        Edge { side, below, above }
    }

    fn with_drive(step: i16, current: u8) -> Shaft {
        let mut shaft = Shaft::new(0, None);
        shaft.set_drive(Drive { step, parts: 1, current });
        shaft
    }

    #[test]
    fn the_shaft_turns_a_step_a_pulse() {
        check(with_drive(1, 32), &[(100, 100, 100), (-150, -50, -50)]);
        check(with_drive(-16, 32), &[(100, -1600, -1600), (-100, 0, 0)]);
        check(with_drive(256, 0), &[(100, 0, 0)]);
    }

    #[test]
    fn the_load_follows_after_the_play() {
        check(Shaft::new(10, None), &[(5, 5, 5), (-4, 1, 5), (-20, -19, -9), (9, -10, -9), (2, -8, -8)]);
    }

    #[test]
    fn nothing_goes_past_a_stop() {
        let mut shaft = Shaft::new(10, Some([-50, 100]));
        check(shaft.clone(), &[(500, 100, 100), (-20, 80, 90), (-500, -60, -50), (1, -59, -50)]);
        assert_eq!(shaft.load_permille(), 0);
        shaft.follow(&train(101));
        assert_eq!(shaft.load_permille(), FULL_TORQUE);
        shaft.follow(&train(-1));
        assert_eq!(shaft.load_permille(), 0);
    }

    #[test]
    fn too_much_load_stalls() {
        // Half the current holds half the torque.
        for (current, load, follows) in
            [(32, 1000, true), (32, 1001, false), (16, 500, true), (16, 501, false), (0, 0, false)]
        {
            let mut shaft = with_drive(1, current);
            shaft.set_load(load);
            assert_eq!(shaft.follows(), follows, "current {current}, load {load}");
        }
    }

    #[test]
    fn pulses_are_lost_in_both_directions() {
        let mut shaft = Shaft::new(0, None);
        shaft.lose(5);
        check(shaft.clone(), &[(3, 0, 0), (-3, -1, -1), (10, 9, 9)]);
        assert_eq!(shaft.window(&[edge(Side::Motor, -33, 32)]), (-1, 1));
        shaft.follow(&train(5));
        assert_eq!(shaft.window(&[edge(Side::Motor, -33, 32)]), (5 - 33, 5 + 32));
        // What a motor without current does not follow anyway is not lost.
        shaft.lose(2);
        shaft.set_drive(Drive { step: 1, parts: 1, current: 0 });
        shaft.follow(&train(10));
        shaft.set_drive(Drive { step: 1, parts: 1, current: 32 });
        shaft.follow(&train(10));
        assert_eq!(shaft.position(Side::Load), 8);
    }

    #[test]
    fn windows_end_where_something_changes() {
        let mut shaft = Shaft::new(10, Some([-1000, 2000]));
        assert_eq!(shaft.window(&[]), (-1010, 2000));
        assert_eq!(shaft.window(&[edge(Side::Load, -50, 31), edge(Side::Motor, -55, 40)]), (-55, 31));
        shaft.set_drive(Drive { step: 16, parts: 1, current: 32 });
        assert_eq!(shaft.window(&[edge(Side::Motor, -33, 32)]), (-3, 2));
        shaft.set_drive(Drive { step: -16, parts: 1, current: 32 });
        assert_eq!(shaft.window(&[edge(Side::Motor, -33, 32)]), (-2, 3));
        shaft.set_drive(Drive { step: 16, parts: 1, current: 0 });
        assert_eq!(shaft.window(&[edge(Side::Motor, -33, 32)]), (-NEVER, NEVER));
    }

    #[test]
    fn each_pulse_against_a_stop_is_an_event() {
        let mut shaft = Shaft::new(0, Some([-5, 5]));
        shaft.follow(&train(9));
        // Up: the next pulse may be lost, and then the way back begins later.
        assert_eq!(shaft.window(&[]), (9 - 10, 10));
    }
}
