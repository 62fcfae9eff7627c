//! The machine behind the pins: shafts, switches, encoders, supply.
//!
//! Trains turn shafts; everything else follows from where the shafts are. The machine says how far each
//! axis can go before an input changes, and the controller stops at exactly that pulse.

mod bounce;
mod contact;
mod encoder;
pub(crate) mod fitting;
mod servo;
mod shaft;
mod stall;
#[cfg(test)]
mod stall_tests;
mod table;
mod torque;
mod wiring;
mod zone;

use crate::config::DeviceConfig;
use bounce::Bounce;
pub(crate) use bounce::MAX_BOUNCE_MS;
use contact::{Contact, Contacts, Mover};
use devices::{Drive, Pin, Wiring};
use encoder::Counter;
use fitting::fitting;
use motion::{Ticks, Train};
use rand_pcg::Pcg32;
use servo::Servo;
pub(crate) use shaft::Edge;
use shaft::{FULL_TORQUE, Shaft, Side};
use stall::Field;
pub use table::{EncoderRow, MachineTable, PinRow, ZoneRow};
use torque::Torque;
use zone::{NEVER, Zone};

/// The machine of one device.
#[derive(Debug)]
pub(crate) struct Machine {
    axes: Vec<Shaft>,
    /// Encoders by channel, each with its axis: first those of the first axis.
    encoders: Vec<(usize, Counter)>,
    /// The servo driver of each axis, if it has one.
    servos: Vec<Option<Servo>>,
    /// What pins hang on.
    contacts: Contacts,
    /// Those of them that have to be told of every change.
    remembering: Vec<usize>,
    /// Analog quantities by pin.
    quantities: Vec<i32>,
    pins: &'static [Pin],
    clock_hz: u32,
    seed: u64,
    /// What the motors' torques were found at.
    supply_v: f64,
    /// How long the switches of each axis bounce by themselves.
    bounces_ms: Vec<u32>,
}

impl Machine {
    /// `seed` is where its random numbers start from.
    pub fn new(config: &DeviceConfig, axes: &[&str], pins: &'static [Pin], clock_hz: u32, seed: u64) -> Self {
        let configs: Vec<_> = axes.iter().map(|axis| config.axis(axis)).collect();
        let fitting = fitting(config.model.name);
        let shafts = configs.iter().map(|axis| {
            let torque = Torque::new(&axis.pull_out, axis.friction, axis.microsteps, clock_hz);
            let field = torque.map(|torque| Field::new(torque, axis.microsteps));
            let mut shaft = Shaft::new(axis.backlash, axis.hard_stops).with_field(field);
            shaft.set_load(permille(axis.load));
            shaft
        });
        let encoders: Vec<_> = configs
            .iter()
            .enumerate()
            .flat_map(|(index, axis)| {
                fitting.encoders.iter().map(move |kind| (index, Counter::new(*kind, axis)))
            })
            .collect();
        let servo = |ms: u32| Servo::new(Ticks::from(clock_hz) * Ticks::from(ms) / 1000);
        let servos: Vec<_> = configs.iter().map(|axis| axis.in_position_ms.map(servo)).collect();
        let contacts = wiring::contacts(pins, &configs, &encoders);
        let quantity = |pin: &Pin| match pin.wiring {
            Wiring::Supply => in_board_units(config.supply_v, pin),
            Wiring::Temperature => in_board_units(config.temperature_c, pin),
            // From one end of the range to the other, with the middle where it rests.
            Wiring::Joystick(axis) => {
                pin.rest + (f64::from(pin.rest) * configs[axis].joystick).round() as i32
            }
            _ => pin.rest,
        };
        let mut machine = Self {
            axes: shafts.collect(),
            encoders,
            servos,
            contacts,
            remembering: Vec::new(),
            quantities: pins.iter().map(quantity).collect(),
            pins,
            clock_hz,
            seed,
            supply_v: config.supply_v,
            bounces_ms: configs.iter().map(|axis| axis.bounce_ms).collect(),
        };
        (0..pins.len()).for_each(|pin| machine.set_bounce(pin, 0, 0));
        machine
    }

    /// Odometers start from 0, and driver stages as if nobody had told them anything.
    pub fn power_up(&mut self) {
        for shaft in &mut self.axes {
            shaft.power_up();
        }
    }

    /// Pulses of an axis, the last one in device time `last`.
    pub fn follow(&mut self, axis: usize, train: &Train, last: Ticks) {
        self.axes[axis].follow(train);
        if let Some(servo) = &mut self.servos[axis] {
            servo.follow(last);
        }
    }

    /// When something next happens by itself; [`Ticks::MAX`] if nothing will.
    pub fn due(&self) -> Ticks {
        let in_position = self.servos.iter().flatten().filter_map(Servo::due);
        let bounces = self.remembering.iter().filter_map(|&pin| Some(self.contacts.get(pin)?.due()));
        in_position.chain(bounces).min().unwrap_or(Ticks::MAX)
    }

    /// The next axis whose servo driver has come into position by `now`.
    pub fn take_in_position(&mut self, now: Ticks) -> Option<usize> {
        self.servos.iter_mut().position(|servo| servo.as_mut().is_some_and(|servo| servo.settle(now)))
    }

    /// Whether a contact has opened or closed by `now` without its axis, since this was asked last.
    pub fn take_bounce(&mut self, now: Ticks) -> bool {
        let Self { remembering, contacts, .. } = self;
        let mut settles = |pin: usize| contacts.get_mut(pin).is_some_and(|contact| contact.settle(now));
        remembering.iter().any(|&pin| settles(pin))
    }

    /// Lets contacts take notice of where the shafts are now.
    pub fn update_contacts(&mut self, now: Ticks) {
        for place in 0..self.remembering.len() {
            let pin = self.remembering[place];
            let on = self.is_moved(pin, now);
            if let (Some(contact), Some(on)) = (self.contacts.get_mut(pin), on) {
                contact.update(on, now);
            }
        }
    }

    /// Whether what is on a pin depends on when it changed, so that every change counts.
    pub fn remembers(&self, pin: usize) -> bool {
        self.contacts.get(pin).is_some_and(Contact::remembers)
    }

    /// Lets the switch at a pin bounce for so long after each change, from the next one on; for as long as it
    /// does by itself if that is longer. Where there is no switch nothing bounces.
    pub fn set_bounce(&mut self, pin: usize, ms: u32, now: Ticks) {
        let axis = wiring::axis_of_switch(&self.pins[pin], self.contacts.get(pin));
        let ms = ms.max(axis.map_or(0, |axis| self.bounces_ms[axis]));
        let span = Ticks::from(self.clock_hz) * Ticks::from(ms.min(MAX_BOUNCE_MS)) / 1000;
        let bounce = (ms > 0).then(|| Bounce::new(span, Pcg32::new(self.seed, pin as u64)));
        if let (Some(on), Some(contact)) = (self.is_moved(pin, now), self.contacts.get_mut(pin)) {
            contact.set_bounce(bounce, on);
        }
        self.remembering.retain(|other| *other != pin);
        if self.remembers(pin) {
            self.remembering.push(pin);
        }
    }

    /// The counter of an encoder no longer sees its shaft turn, or does again from where it stands.
    pub fn set_encoder_broken(&mut self, channel: usize, broken: bool) {
        let (axis, counter) = &mut self.encoders[channel];
        counter.set_broken(broken, &self.axes[*axis]);
    }

    /// The motor supply has so many volts. The pins that measure it have changed: those whose `quantity` is
    /// another now.
    pub fn set_supply(&mut self, volts: f64) {
        for (pin, quantity) in self.pins.iter().zip(&mut self.quantities) {
            if pin.wiring == Wiring::Supply {
                *quantity = in_board_units(volts, pin);
            }
        }
        if self.supply_v > 0.0 {
            self.axes.iter_mut().for_each(|shaft| shaft.set_supply(volts / self.supply_v));
        }
    }

    /// The driver stage of an axis.
    pub fn drive(&self, axis: usize) -> Drive {
        self.axes[axis].drive()
    }

    /// The driver stage of an axis changes.
    pub fn set_drive(&mut self, axis: usize, drive: Drive) {
        self.axes[axis].set_drive(drive);
    }

    /// The limits and the home switch of an axis are where the configuration has them now.
    pub fn move_switches(&mut self, axis: usize, config: &DeviceConfig, axes: &[&str]) {
        let configs: Vec<_> = axes.iter().map(|axis| config.axis(axis)).collect();
        for (number, pin) in self.pins.iter().enumerate() {
            let has_cam = configs.iter().flat_map(|axis| &axis.cams).any(|cam| cam.pin == pin.name);
            if let Some(zone) = wiring::zone(pin, axis, &configs[axis]).filter(|_| !has_cam)
                && let Some(contact) = self.contacts.get_mut(number)
            {
                contact.set_zone(zone);
            }
        }
    }

    /// Sets the load in parts of the pull-out torque.
    pub fn set_load(&mut self, axis: usize, load: f64) {
        self.axes[axis].set_load(permille(load));
    }

    /// Turns a shaft from outside.
    pub fn push(&mut self, axis: usize, distance: i64) {
        self.axes[axis].turn(distance);
    }

    /// The motor of an axis will not follow so many pulses.
    pub fn lose(&mut self, axis: usize, pulses: u64) {
        self.axes[axis].lose(pulses);
    }

    pub fn load_permille(&self, axis: usize) -> u16 {
        self.axes[axis].load_permille().min(u32::from(u16::MAX)) as u16
    }

    pub fn odometer(&self, axis: usize) -> i64 {
        self.axes[axis].odometer()
    }

    /// Where the driven side of an axis is, in pulses from where it was first switched on.
    pub fn position(&self, axis: usize) -> i64 {
        self.axes[axis].position(Side::Load)
    }

    /// The counter of an encoder: 0 where the shaft first stood.
    pub fn encoder(&self, channel: usize) -> i32 {
        let (axis, counter) = &self.encoders[channel];
        // A register of 32 bits wraps.
        counter.count(&self.axes[*axis]) as i32
    }

    /// How many encoders there are.
    pub fn encoders(&self) -> usize {
        self.encoders.len()
    }

    /// The first encoder of an axis, if it has one.
    pub fn encoder_of(&self, axis: usize) -> Option<usize> {
        self.encoders.iter().position(|(other, _)| *other == axis)
    }

    /// The axis that turns an encoder.
    pub fn axis_of(&self, channel: usize) -> usize {
        self.encoders[channel].0
    }

    /// Where an encoder has counted so far down or up from its present count.
    pub fn encoder_edge(&self, channel: usize, down: u32, up: u32) -> Edge {
        let (axis, counter) = &self.encoders[channel];
        counter.edge(&self.axes[*axis], down, up)
    }

    pub fn quantity(&self, pin: usize) -> i32 {
        self.quantities[pin]
    }

    /// Whether a pin is one that an axis moves.
    pub fn hangs_on_axis(&self, pin: usize) -> bool {
        self.contacts.get(pin).is_some()
    }

    /// Whether the switch, mark or signal at a pin is seen on; `None` if there is none.
    pub fn is_on(&self, pin: usize, now: Ticks) -> Option<bool> {
        Some(self.contacts.get(pin)?.shown(self.is_moved(pin, now)?))
    }

    /// Whether the shaft at a pin has passed the zone since this was asked last, without standing in it.
    pub fn take_jump(&mut self, pin: usize) -> bool {
        let Some((axis, side, zone)) = self.zone(pin) else { return false };
        let place = self.axes[axis].position(side);
        let contact = self.contacts.get_mut(pin).expect("a zone is a contact's");
        zone.is_jumped(std::mem::replace(&mut contact.seen_at, place), place)
    }

    /// Where the switch or mark at a pin changes next, below and above, if this axis moves it.
    pub fn edge(&self, pin: usize, axis: usize) -> Option<Edge> {
        let (_, side, zone) = self.zone(pin).filter(|(mover, ..)| *mover == axis)?;
        let place = self.axes[axis].position(side);
        Some(Edge { side, below: zone.below(place), above: zone.above(place) })
    }

    /// Whether the next pulse of an axis, whatever its direction, changes a pin.
    pub fn ends_with_pulse(&self, pin: usize, axis: usize, now: Ticks) -> bool {
        self.contacts.get(pin).is_some_and(|contact| {
            matches!(contact.mover, Mover::InPosition { axis: mover }
                if mover == axis && self.is_in_position(axis, now))
        })
    }

    /// Where the driven side of an axis arrives at a position that it comes to from below or from above.
    pub const fn arrival(&self, position: i64, from_below: bool) -> Edge {
        let (below, above) = if from_below { (-NEVER, position) } else { (position, NEVER) };
        Edge { side: Side::Load, below, above }
    }

    /// The odometer window of an axis in which it arrives at none of these edges.
    pub fn window(&self, axis: usize, edges: &[Edge]) -> (i64, i64) {
        self.axes[axis].window(edges)
    }

    /// Where along its axis the switch or mark at a pin is on.
    fn zone(&self, pin: usize) -> Option<(usize, Side, Zone)> {
        self.contacts.get(pin)?.zone()
    }

    /// Whether what moves the contact at a pin holds it on; `None` if there is none.
    fn is_moved(&self, pin: usize, now: Ticks) -> Option<bool> {
        let contact = self.contacts.get(pin)?;
        Some(match (contact.zone(), contact.mover) {
            (Some((axis, side, zone)), _) => zone.is_on(self.axes[axis].position(side)),
            (None, Mover::Shaft { axis, .. } | Mover::InPosition { axis }) => self.is_in_position(axis, now),
        })
    }

    fn is_in_position(&self, axis: usize, now: Ticks) -> bool {
        self.servos[axis].as_ref().is_some_and(|servo| servo.is_in_position(now))
    }
}

fn permille(load: f64) -> u32 {
    (load * f64::from(FULL_TORQUE)).round() as u32
}

/// Volts or degrees Celsius in the integers of a pin.
fn in_board_units(quantity: f64, pin: &Pin) -> i32 {
    (quantity * f64::from(pin.scale)).round() as i32
}
