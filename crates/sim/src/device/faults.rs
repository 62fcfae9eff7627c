//! The faults of a device: those that it has, and those that still wait for something.

use super::{
    PinValue, VirtualDevice,
    held::Held,
    level_for,
    power::Flash,
    world::{Stirred, World},
};
use crate::{
    fault::{
        Entry, Fault, FaultError, FaultView, Kind, MAX_FAULTS, Parts, Planned, Trigger, Way,
        scenario::no_source,
        trigger::{Counter, Motion, clocks, next_look},
    },
    record::Note,
    tape::Act,
};
use devices::{PinKind, Port};
use motion::Ticks;
use std::collections::{BTreeMap, BTreeSet};

/// All faults of a device.
#[derive(Debug)]
pub(super) struct Faults {
    made: u64,
    waiting: Vec<Waiting>,
    active: Vec<Active>,
    /// What the active ones do, as far as the machine knows.
    effects: Effects,
    /// When something is looked for next that nobody tells of; `None` if there is no such thing.
    look_at: Option<Ticks>,
}

/// A fault to come.
#[derive(Debug)]
struct Waiting {
    id: u64,
    planned: Planned,
    until: Until,
}

/// What a fault waits for.
#[derive(Debug)]
enum Until {
    /// A clock.
    Clock(Ticks),
    /// What the [traps](super::traps::Traps) tell of.
    Trap,
    /// An axis that starts or stops.
    Motion { axis: usize, motion: Motion, was_moving: bool, odometer: i64 },
    /// A program at an address.
    Address { program: Option<u8>, address: u32 },
    /// A message.
    Message(Counter),
}

/// A fault that is there.
#[derive(Debug)]
struct Active {
    id: u64,
    fault: Fault,
    ends: Ticks,
    /// The level of a switch that is stuck.
    level: i32,
}

/// What all faults together do to the machine.
#[derive(Clone, Debug, PartialEq)]
struct Effects {
    /// The levels of inputs that are stuck, by pin.
    stuck: Held,
    /// How long switches bounce: those that do.
    bounces_ms: BTreeMap<usize, u32>,
    /// Whether an encoder is broken, by channel.
    broken: Vec<bool>,
    /// More load, by axis.
    loads: Vec<f64>,
    /// Another supply.
    volts: Option<f64>,
    /// What happens to the flash if there is no supply at all.
    dark: Option<Flash>,
}

impl Effects {
    fn none(parts: &Parts) -> Self {
        let axes = parts.axes.len();
        Self {
            stuck: Held::default(),
            bounces_ms: BTreeMap::new(),
            broken: vec![false; axes * parts.encoders()],
            loads: vec![0.0; axes],
            volts: None,
            dark: None,
        }
    }
}

impl Faults {
    /// None at all.
    pub fn none(parts: &Parts) -> Self {
        let effects = Effects::none(parts);
        Self { made: 0, waiting: Vec::new(), active: Vec::new(), effects, look_at: None }
    }

    /// How much more an axis is loaded.
    pub fn load(&self, axis: usize) -> f64 {
        self.effects.loads[axis]
    }

    /// When something is to be done by itself.
    pub fn next(&self) -> Ticks {
        let begin = self.waiting.iter().filter_map(|waiting| match waiting.until {
            Until::Clock(at) => Some(at),
            _ => None,
        });
        let end = self.active.iter().map(|active| active.ends);
        begin.chain(end).chain(self.look_at).min().unwrap_or(Ticks::MAX)
    }

    /// Whether a fault waits for a line of a program.
    pub fn wait_for_lines(&self) -> bool {
        self.waiting.iter().any(|waiting| matches!(waiting.until, Until::Address { .. }))
    }

    /// Whether a fault waits for a message.
    pub fn listens(&self) -> bool {
        self.waiting.iter().any(|waiting| matches!(waiting.until, Until::Message(_)))
    }

    /// A byte comes. Whether a fault begins with it, or after it.
    pub fn hear(&mut self, port: Port, first_of_chunk: bool, byte: u8, now: Ticks, clock_hz: u32) -> bool {
        let mut begins = false;
        for waiting in &mut self.waiting {
            if let Until::Message(counter) = &mut waiting.until
                && counter.hear(port, first_of_chunk, byte)
            {
                waiting.until = Until::Clock(now + clocks(waiting.planned.after_s, clock_hz));
                begins = true;
            }
        }
        begins
    }

    /// Whoever was sending at a port has gone.
    pub fn hang_up(&mut self, port: Port) {
        for waiting in &mut self.waiting {
            if let Until::Message(counter) = &mut waiting.until {
                counter.hang_up(port);
            }
        }
    }
}

impl VirtualDevice {
    /// Gives the device a fault, from now on. Its number is for [`clear_fault`](Self::clear_fault).
    ///
    /// # Errors
    /// [`FaultError`].
    pub fn inject(&mut self, fault: &Fault) -> Result<u64, FaultError> {
        self.plan(&fault.clone().into())
    }

    /// Plans a fault; times count from now.
    ///
    /// # Errors
    /// [`FaultError`].
    pub fn plan(&mut self, planned: &Planned) -> Result<u64, FaultError> {
        self.plan_entry(&planned.into())
    }

    /// The same as an entry says it.
    ///
    /// # Errors
    /// [`FaultError`].
    pub fn plan_entry(&mut self, entry: &Entry) -> Result<u64, FaultError> {
        let planned = entry.parse(&self.parts(), &no_source)?;
        if self.faults.waiting.len() + self.faults.active.len() >= MAX_FAULTS {
            return Err(FaultError::TooMany);
        }
        self.tell_tape(|| Act::Fault(Box::new((&planned).into())));
        self.faults.made += 1;
        let id = self.faults.made;
        let until = self.until(id, &planned);
        self.faults.waiting.push(Waiting { id, planned, until });
        self.tend_faults();
        Ok(id)
    }

    /// Ends a fault, or forgets one that still waits.
    ///
    /// # Errors
    /// [`FaultError::Unknown`].
    pub fn clear_fault(&mut self, id: u64) -> Result<(), FaultError> {
        let is_known = self.faults.waiting.iter().any(|waiting| waiting.id == id)
            || self.faults.active.iter().any(|active| active.id == id);
        if !is_known {
            return Err(FaultError::Unknown(id));
        }
        self.tell_tape(|| Act::Clear(Some(id)));
        self.forget(|other| other == id);
        Ok(())
    }

    /// Ends all faults, and forgets those that still wait.
    pub fn clear_faults(&mut self) {
        self.tell_tape(|| Act::Clear(None));
        self.forget(|_| true);
    }

    /// The faults that it has and those that wait, the oldest first.
    pub fn faults(&self) -> Vec<FaultView> {
        let active = self.faults.active.iter().map(|active| FaultView {
            id: active.id,
            is_active: true,
            entry: (&active.fault).into(),
        });
        let waiting = self.faults.waiting.iter().map(|waiting| FaultView {
            id: waiting.id,
            is_active: false,
            entry: (&waiting.planned).into(),
        });
        let mut all: Vec<_> = active.chain(waiting).collect();
        all.sort_by_key(|view| view.id);
        all
    }

    /// Does what is due because of faults, until nothing is.
    pub(super) fn tend_faults(&mut self) {
        let now = self.now();
        self.world.take_in();
        let is_look = self.faults.look_at.is_some_and(|at| at <= now);
        if is_look {
            self.look();
        }
        while self.tend_one(is_look) {}
        let needs_looks =
            self.faults.waiting.iter().any(|waiting| match (&waiting.until, &waiting.planned.trigger) {
                (Until::Motion { .. }, _) => true,
                (Until::Trap, Trigger::Pin { pin, .. }) => self.is_driven(pin),
                _ => false,
            });
        if !needs_looks {
            self.faults.look_at = None;
        } else if is_look || self.faults.look_at.is_none() {
            self.faults.look_at = Some(next_look(now, self.clock_hz));
        }
    }

    /// Does one thing that is due; whether there was one.
    fn tend_one(&mut self, is_look: bool) -> bool {
        let now = self.now();
        let World { traps, machine, wire, .. } = &mut self.world;
        if let Some(id) = traps.take(is_look, machine) {
            self.release(|waiting| waiting.id == id);
            return true;
        }
        let due = |waiting: &Waiting| matches!(waiting.until, Until::Clock(at) if at <= now);
        if let Some(place) = self.faults.waiting.iter().position(due) {
            let Waiting { id, planned, .. } = self.faults.waiting.remove(place);
            self.begin(id, planned.fault);
        } else if let Some(place) = self.faults.active.iter().position(|active| active.ends <= now) {
            self.end(place);
            self.apply_faults();
        } else if let Some(parcel) = wire.take(Way::In, now) {
            self.hear(parcel.port, &parcel.bytes);
        } else if let Some((port, bytes)) = wire.take_babble(now) {
            self.world.overhear(port, &bytes);
            self.hear(port, &bytes);
        } else {
            return false;
        }
        true
    }

    /// Bytes arrive at a port of the controller.
    pub(super) fn hear(&mut self, port: Port, bytes: &[u8]) {
        if self.is_powered {
            self.world.record_received(port, bytes);
            self.controller.receive(port, bytes, &mut self.world);
            self.settle();
        }
    }

    fn parts(&self) -> Parts {
        Parts::of_controller(self.config.model, &*self.controller)
    }

    fn clocks(&self, seconds: f64) -> Ticks {
        clocks(seconds, self.clock_hz)
    }

    /// Whether the controller may drive a pin.
    fn is_driven(&self, pin: &str) -> bool {
        self.pins().iter().any(|known| known.name == pin && !matches!(known.kind, PinKind::Input))
    }

    /// What a fault waits for, from now on.
    fn until(&mut self, id: u64, planned: &Planned) -> Until {
        let parts = self.parts();
        let axis = |name: &str| parts.axis(name).expect("the entry was checked");
        match &planned.trigger {
            Trigger::At(seconds) => Until::Clock(self.now() + self.clocks(seconds + planned.after_s)),
            Trigger::Pin { pin, value } => {
                let pin = parts.pin(pin).expect("the entry was checked");
                let level = self.world.level(pin);
                self.world.traps.add_trip(id, pin, level, value.map(i32::from));
                self.world.windows.fill(None);
                self.settle();
                Until::Trap
            }
            Trigger::Position { axis: name, position } => {
                self.world.traps.add_gate(id, axis(name), *position, &self.world.machine);
                self.world.windows.fill(None);
                self.settle();
                Until::Trap
            }
            Trigger::Motion { axis: name, motion } => {
                let axis = axis(name);
                let (was_moving, odometer) = self.movement_of(axis);
                Until::Motion { axis, motion: *motion, was_moving, odometer }
            }
            Trigger::Address { program, address } => Until::Address { program: *program, address: *address },
            Trigger::Message { number, port } => {
                Until::Message(Counter::new(parts.framing(), port.map(Into::into), *number))
            }
        }
    }

    fn movement_of(&mut self, axis: usize) -> (bool, i64) {
        (self.axis(axis).speed_mpps != 0, self.world.machine.odometer(axis))
    }

    /// Looks for what nobody tells of.
    fn look(&mut self) {
        let movements: Vec<_> = (0..self.axes().len()).map(|axis| self.movement_of(axis)).collect();
        self.release(|waiting| match &mut waiting.until {
            Until::Motion { axis, motion, was_moving, odometer } => {
                let (turns, reached) = movements[*axis];
                let moves = turns || std::mem::replace(odometer, reached) != reached;
                let was = std::mem::replace(was_moving, moves);
                match motion {
                    Motion::Starts => moves && !was,
                    Motion::Stops => was && !moves,
                }
            }
            _ => false,
        });
    }

    /// A line of a program is about to be executed: faults that waited for it begin. Whether there was one.
    pub(super) fn release_at_line(&mut self, program: usize, line: u32) -> bool {
        let mut any = false;
        self.release(|waiting| {
            let is_it = matches!(waiting.until, Until::Address { program: of, address }
                if address == line && of.is_none_or(|of| usize::from(of) == program));
            any |= is_it;
            is_it
        });
        if any {
            self.tend_faults();
        }
        any
    }

    /// What these faults waited for has happened.
    fn release(&mut self, mut happened: impl FnMut(&mut Waiting) -> bool) {
        let (now, clock_hz) = (self.now(), self.clock_hz);
        for waiting in &mut self.faults.waiting {
            if happened(waiting) {
                waiting.until = Until::Clock(now + clocks(waiting.planned.after_s, clock_hz));
            }
        }
    }

    fn begin(&mut self, id: u64, fault: Fault) {
        let now = self.now();
        self.world.record_note(Note::Fault, &fault.to_string());
        let is_moment = match &fault.kind {
            Kind::Slip { axis, pulses } => {
                let axis = self.axis_index(axis).expect("the entry was checked");
                self.world.machine.lose(axis, *pulses);
                self.world.windows[axis] = None;
                self.settle();
                true
            }
            Kind::HandWheel { axis, counts } => {
                let axis = self.axis_index(axis).expect("the entry was checked");
                // One that has more to give than it can keep is not turned on.
                let _ = self.wheels[axis].turn(*counts, now);
                true
            }
            _ => false,
        };
        if is_moment {
            self.world.record_note(Note::Cleared, &fault.to_string());
            return;
        }
        if fault.kind.is_on_wire() {
            self.world.wire.spoil(id, &fault.kind, now);
        }
        let level = match &fault.kind {
            Kind::StuckSwitch { pin, value } => self.stuck_level(pin, *value),
            _ => 0,
        };
        let ends = fault.duration_s.map_or(Ticks::MAX, |seconds| now.saturating_add(self.clocks(seconds)));
        self.faults.active.push(Active { id, fault, ends, level });
        self.apply_faults();
    }

    fn end(&mut self, place: usize) {
        let Active { id, fault, .. } = self.faults.active.remove(place);
        self.world.wire.mend(id);
        self.world.record_note(Note::Cleared, &fault.to_string());
    }

    fn forget(&mut self, whether: impl Fn(u64) -> bool) {
        let (gone, left) =
            std::mem::take(&mut self.faults.waiting).into_iter().partition(|waiting| whether(waiting.id));
        self.faults.waiting = left;
        let gone: Vec<Waiting> = gone;
        gone.iter().for_each(|waiting| self.world.traps.remove(waiting.id));
        while let Some(place) = self.faults.active.iter().position(|active| whether(active.id)) {
            self.end(place);
        }
        self.apply_faults();
        self.tend_faults();
    }

    fn stuck_level(&self, pin: &str, value: Option<PinValue>) -> i32 {
        let pin = self.parts().pin(pin).expect("the entry was checked");
        let given = value.map(|value| level_for(&self.pins()[pin], value).expect("the entry was checked"));
        given.unwrap_or_else(|| self.world.level(pin))
    }

    /// Makes of the machine, the supply and the pins what the faults make of them now.
    fn apply_faults(&mut self) {
        let new = self.effects();
        let old = std::mem::replace(&mut self.faults.effects, new.clone());
        if new == old {
            return;
        }
        let (now, machine) = (self.now(), &mut self.world.machine);
        // By pin, so that runs repeat.
        let bouncing: BTreeSet<_> = old.bounces_ms.keys().chain(new.bounces_ms.keys()).collect();
        for pin in bouncing {
            let [before, ms] = [&old, &new].map(|effects| effects.bounces_ms.get(pin).copied().unwrap_or(0));
            if ms != before {
                machine.set_bounce(*pin, ms, now);
            }
        }
        for (channel, broken) in changes(&old.broken, &new.broken) {
            machine.set_encoder_broken(channel, broken);
        }
        for (axis, extra) in changes(&old.loads, &new.loads) {
            machine.set_load(axis, self.loads[axis] + extra);
        }
        self.world.windows.fill(None);
        let dips = new.volts != old.volts;
        self.disturb(|device| {
            device.world.stuck = new.stuck;
            if dips {
                device.supply();
            }
        });
        match (old.dark, new.dark) {
            (None, Some(flash)) => self.switch_off(flash),
            (Some(_), None) => self.switch_on("after a fault of the supply"),
            _ => {}
        }
    }

    fn effects(&self) -> Effects {
        let parts = self.parts();
        let pin = |name: &str| parts.pin(name).expect("the entry was checked");
        let axis = |name: &str| parts.axis(name).expect("the entry was checked");
        let mut effects = Effects::none(&parts);
        for Active { fault, level, .. } in &self.faults.active {
            match &fault.kind {
                Kind::StuckSwitch { pin: name, .. } => effects.stuck.set(pin(name), Some(*level)),
                Kind::BouncingSwitch { pin: name, ms } => {
                    let bounce = effects.bounces_ms.entry(pin(name)).or_default();
                    *bounce = (*bounce).max(*ms);
                }
                Kind::BrokenEncoder { axis: name, encoder } => {
                    let first = axis(name) * parts.encoders();
                    let all = first..first + parts.encoders();
                    let broken = encoder.map_or(all, |encoder| first + encoder..first + encoder + 1);
                    effects.broken[broken].fill(true);
                }
                Kind::ExtraLoad { axis: name, load } => effects.loads[axis(name)] += load,
                Kind::SupplyDip { volts } => effects.volts = Some(*volts),
                Kind::BrownOut => effects.dark = effects.dark.or(Some(Flash::Finishes)),
                Kind::PowerCut => effects.dark = effects.dark.or(Some(Flash::Tears)),
                Kind::Slip { .. }
                | Kind::HandWheel { .. }
                | Kind::Noise { .. }
                | Kind::Loss { .. }
                | Kind::Duplication { .. }
                | Kind::Delay { .. }
                | Kind::BabblingNode { .. } => {}
            }
        }
        effects
    }

    /// Gives the motors the supply that there is now: that of a hand, of a fault, or the usual one.
    pub(super) fn supply(&mut self) {
        let others = self.faults.effects.volts.unwrap_or(self.config.supply_v);
        self.world.machine.set_supply(self.world.supply_by_hand().unwrap_or(others));
    }

    /// Changes something outside, and tells the controller of analog pins that have other levels then.
    fn disturb(&mut self, change: impl FnOnce(&mut Self)) {
        let pins = self.pins();
        let before: Vec<_> = (0..pins.len()).map(|pin| self.world.level(pin)).collect();
        change(self);
        for (pin, before) in before.into_iter().enumerate() {
            self.analog_was(pin, before);
        }
        self.world.stirred = Stirred::Pins;
        self.settle();
    }
}

/// What is different, with its place.
fn changes<'a, T: PartialEq + Copy>(
    old: &'a [T],
    new: &'a [T],
) -> impl Iterator<Item = (usize, T)> + use<'a, T> {
    let both = old.iter().zip(new).enumerate();
    both.filter(|(_, (old, new))| old != new).map(|(place, (_, new))| (place, *new))
}
