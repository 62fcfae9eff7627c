//! A motor that falls out of step where its torque is not enough, and into step again.
//!
//! The field goes on turning with every pulse; a rotor that has lost it stands. The first pulse that is slow
//! enough pulls it to the nearest place at which it fits the field, so what is lost in the end are whole
//! electrical cycles of four full steps. Whether a pulse is slow enough is a matter of the time since the pulse
//! before, and of nothing else: trains may be cut anywhere.

use super::torque::Torque;
use devices::Drive;
use motion::{Moment, SubTicks, Train, train::EVERY_SLOT};

/// Full steps after which the coils carry the same currents again.
const CYCLE: u32 = 4;

/// The field of a motor whose torque is known, seen from its rotor.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    torque: Torque,
    /// Positions of an electrical cycle.
    cycle: i64,
    /// The shortest time between pulses at which the rotor follows; `None` if it never does.
    shortest: Option<SubTicks>,
    /// How far it is ahead of the rotor, half a cycle at most either way.
    pub ahead: i64,
    last: Option<Moment>,
    /// The time before the last pulse.
    interval: SubTicks,
}

impl Field {
    pub fn new(torque: Torque, full_step: u32) -> Self {
        let cycle = i64::from(CYCLE * full_step);
        Self { torque, cycle, shortest: None, ahead: 0, last: None, interval: SubTicks::MAX }
    }

    /// The controller counts its clock from 0 again.
    pub fn power_up(&mut self) {
        self.last = None;
        self.interval = SubTicks::MAX;
    }

    /// Load or driver stage are others.
    pub fn set(&mut self, load: f64, drive: Drive) {
        self.shortest = self.torque.shortest_interval(load, drive);
    }

    /// The supply is this part of what it should be.
    pub fn set_supply(&mut self, part: f64) {
        self.torque.set_supply(part);
    }

    /// The load in parts of the torque at full current and at the present speed.
    pub fn share(&self, load: f64, drive: Drive) -> f64 {
        self.torque.share(load, self.interval, drive)
    }

    /// How far a rotor that comes into step may jump.
    pub fn jump(&self) -> i64 {
        self.cycle / 2
    }

    /// The time before the first pulse of a train, which is the next to come.
    pub fn first_interval(&self, train: &Train) -> SubTicks {
        self.last.and_then(|last| train.moment(1).since(last)).unwrap_or(SubTicks::MAX)
    }

    /// The train is over.
    pub fn pass(&mut self, train: &Train) {
        self.interval = match train.count {
            1 => self.first_interval(train),
            count => spacing(train, count),
        };
        self.last = Some(train.moment(train.count));
    }

    /// Whether the rotor follows a pulse so long after the one before.
    pub fn is_followed(&self, interval: SubTicks) -> bool {
        self.shortest.is_some_and(|shortest| interval >= shortest)
    }

    /// Whether it follows all pulses of a train but the first; if not, it may follow some.
    pub fn is_followed_throughout(&self, train: &Train) -> bool {
        self.shortest == Some(0) || self.is_followed(least_spacing(train))
    }

    /// Whether it follows none of them but the first; if not, it may follow none all the same.
    pub fn is_lost_throughout(&self, train: &Train) -> bool {
        let even = (train.add, train.jerk, train.mask) == (0, 0, EVERY_SLOT);
        self.shortest.is_none() || even && !self.is_followed(train.interval)
    }

    /// The field turns; a whole cycle makes no difference.
    pub fn turn(&mut self, distance: i64) {
        let ahead = (self.ahead + distance).rem_euclid(self.cycle);
        self.ahead = if ahead > self.cycle / 2 { ahead - self.cycle } else { ahead };
    }
}

/// The time from the pulse before to pulse `k` of a train, which is not its first.
pub(crate) fn spacing(train: &Train, k: u32) -> SubTicks {
    train.offset(k).wrapping_sub(train.offset(k - 1))
}

/// The least spacing of a train's slots; 0 where it is not at an end.
fn least_spacing(train: &Train) -> SubTicks {
    let slots = i64::from(train.slot(train.count));
    // How much the second spacing differs from the first, and the last from the one before.
    let [first, last] = [train.add, train.add.wrapping_add((slots - 2).max(0).wrapping_mul(train.jerk))];
    if first >= 0 && last >= 0 {
        train.interval
    } else if first <= 0 && last <= 0 {
        let pairs = (slots - 1) * (slots - 2) / 2;
        let change = (slots - 1).wrapping_mul(train.add).wrapping_add(pairs.wrapping_mul(train.jerk));
        train.interval.wrapping_add(change as u64)
    } else {
        0
    }
}
