//! What faults wait for at the pins and the shafts.

use crate::machine::{Edge, Machine};

/// Everything that is waited for.
#[derive(Clone, Debug, Default)]
pub(super) struct Traps {
    trips: Vec<Trip>,
    gates: Vec<Gate>,
}

/// A change of a pin.
#[derive(Clone, Debug)]
struct Trip {
    id: u64,
    pin: usize,
    /// The level that it has to get.
    wanted: Option<i32>,
    /// The level that it had last.
    level: i32,
    sprung: Option<Seen>,
}

/// When a change is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// In the clock in which it happens.
    AtOnce,
    /// In the next look: the controller may have gone on meanwhile.
    Later,
}

/// A place along a shaft.
#[derive(Clone, Debug)]
struct Gate {
    id: u64,
    axis: usize,
    position: i64,
    from_below: bool,
}

impl Gate {
    fn is_passed(&self, machine: &Machine) -> bool {
        let position = machine.position(self.axis);
        if self.from_below { position >= self.position } else { position <= self.position }
    }
}

impl Traps {
    /// Waits for a change of a pin, which is at this level now.
    pub fn add_trip(&mut self, id: u64, pin: usize, level: i32, wanted: Option<i32>) {
        self.trips.push(Trip { id, pin, wanted, level, sprung: None });
    }

    /// Waits for an axis to arrive at a position.
    pub fn add_gate(&mut self, id: u64, axis: usize, position: i64, machine: &Machine) {
        self.gates.push(Gate { id, axis, position, from_below: machine.position(axis) < position });
    }

    /// Waits no more.
    pub fn remove(&mut self, id: u64) {
        self.trips.retain(|trip| trip.id != id);
        self.gates.retain(|gate| gate.id != id);
    }

    /// Whether the clock matters at which a pin changes.
    pub fn watches(&self, pin: usize) -> bool {
        self.trips.iter().any(|trip| trip.pin == pin)
    }

    /// Something is on a pin.
    pub fn see(&mut self, pin: usize, level: i32, seen: Seen) {
        for trip in self.trips.iter_mut().filter(|trip| trip.pin == pin) {
            let changed = std::mem::replace(&mut trip.level, level) != level;
            if changed && trip.sprung.is_none() && trip.wanted.is_none_or(|wanted| wanted == level) {
                trip.sprung = Some(seen);
            }
        }
    }

    /// Where an axis arrives at a place that is waited for.
    pub fn edges(&self, axis: usize, machine: &Machine) -> impl Iterator<Item = Edge> {
        let gates = self.gates.iter().filter(move |gate| gate.axis == axis && !gate.is_passed(machine));
        gates.map(|gate| machine.arrival(gate.position, gate.from_below))
    }

    /// The next that has happened, which is waited for no more. In a look the others are known too.
    pub fn take(&mut self, is_look: bool, machine: &Machine) -> Option<u64> {
        let trip = self.trips.iter().find(|trip| match trip.sprung {
            None => false,
            Some(Seen::AtOnce) => true,
            Some(Seen::Later) => is_look,
        });
        let gate = || self.gates.iter().find(|gate| gate.is_passed(machine)).map(|gate| gate.id);
        let id = trip.map(|trip| trip.id).or_else(gate)?;
        self.remove(id);
        Some(id)
    }
}
