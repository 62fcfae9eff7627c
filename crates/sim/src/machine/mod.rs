//! The machine behind the pins: shafts, switches, encoders, supply.
//!
//! Trains turn shafts; everything else follows from where the shafts are. The machine says how far each
//! axis can go before an input changes, and the controller stops at exactly that pulse.

mod encoder;
pub(crate) mod fitting;
mod shaft;
mod zone;

use crate::config::DeviceConfig;
use devices::{Drive, Pin, PinKind, Wiring};
use encoder::Counter;
use fitting::fitting;
use motion::Train;
pub(crate) use shaft::Edge;
use shaft::{FULL_TORQUE, Shaft, Side};
use zone::Zone;

/// The machine of one device.
#[derive(Debug)]
pub(crate) struct Machine {
    axes: Vec<Shaft>,
    /// Encoders by channel, each with its axis: first those of the first axis.
    encoders: Vec<(usize, Counter)>,
    /// What the pins hang on, in their order.
    contacts: Vec<Option<Contact>>,
    /// Analog quantities by pin.
    quantities: Vec<i32>,
}

/// A switch or mark: on in a zone of a shaft.
#[derive(Clone, Copy, Debug)]
struct Contact {
    axis: usize,
    side: Side,
    zone: Zone,
}

impl Machine {
    pub fn new(config: &DeviceConfig, axes: &[&str], pins: &[Pin]) -> Self {
        let configs: Vec<_> = axes.iter().map(|axis| config.axis(axis)).collect();
        let fitting = fitting(config.model.name);
        let shafts = configs.iter().map(|axis| {
            let mut shaft = Shaft::new(axis.backlash, axis.hard_stops);
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
        let contacts = pins
            .iter()
            .map(|pin| {
                let on_load = |axis: usize, zone| Some(Contact { axis, side: Side::Load, zone });
                match (pin.wiring, pin.kind) {
                    (Wiring::NegativeLimit(axis), _) => {
                        on_load(axis, Zone::up_to(configs[axis].negative_limit))
                    }
                    (Wiring::PositiveLimit(axis), _) => {
                        on_load(axis, Zone::from(configs[axis].positive_limit))
                    }
                    (Wiring::Home(axis), _) => {
                        on_load(axis, Zone::between(configs[axis].home[0], configs[axis].home[1]))
                    }
                    (Wiring::Index(_), PinKind::Index(channel)) => {
                        let (axis, counter) = &encoders[channel];
                        let (side, zone) = counter.mark();
                        Some(Contact { axis: *axis, side, zone })
                    }
                    (Wiring::Index(axis), _) => {
                        on_load(axis, Zone::repeated(0, 0, configs[axis].index_every))
                    }
                    _ => None,
                }
            })
            .collect();
        let quantities = pins
            .iter()
            .map(|pin| match pin.wiring {
                Wiring::Supply => in_board_units(config.supply_v, pin),
                Wiring::Temperature => in_board_units(config.temperature_c, pin),
                _ => pin.rest,
            })
            .collect();
        Self { axes: shafts.collect(), encoders, contacts, quantities }
    }

    /// Odometers start from 0, and driver stages as if nobody had told them anything.
    pub fn power_up(&mut self) {
        for shaft in &mut self.axes {
            shaft.power_up();
        }
    }

    pub fn follow(&mut self, axis: usize, train: &Train) {
        self.axes[axis].follow(train);
    }

    /// The driver stage of an axis.
    pub fn drive(&self, axis: usize) -> Drive {
        self.axes[axis].drive()
    }

    /// The driver stage of an axis changes.
    pub fn set_drive(&mut self, axis: usize, drive: Drive) {
        self.axes[axis].set_drive(drive);
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

    pub fn quantity(&self, pin: usize) -> i32 {
        self.quantities[pin]
    }

    /// Whether the switch or mark at a pin is on; `None` if there is none.
    pub fn is_on(&self, pin: usize) -> Option<bool> {
        self.contacts[pin].map(|contact| contact.zone.is_on(self.place(&contact)))
    }

    /// Where the shaft at a pin is, for [`is_jumped`](Self::is_jumped); 0 where there is none.
    pub fn place_of(&self, pin: usize) -> i64 {
        self.contacts[pin].map_or(0, |contact| self.place(&contact))
    }

    /// Whether on its way from `from` the shaft at a pin passed the zone without standing in it.
    pub fn is_jumped(&self, pin: usize, from: i64) -> bool {
        self.contacts[pin].is_some_and(|contact| contact.zone.is_jumped(from, self.place(&contact)))
    }

    /// Whether what a pin hangs on is moved by an axis.
    pub fn is_on_axis(&self, pin: usize, axis: usize) -> bool {
        self.contacts[pin].is_some_and(|contact| contact.axis == axis)
    }

    /// Where the switch or mark at a pin changes next, below and above.
    ///
    /// # Panics
    /// If the pin hangs on nothing.
    pub fn edge(&self, pin: usize) -> Edge {
        let contact = self.contacts[pin].expect("a pin on an axis hangs on something");
        let place = self.place(&contact);
        Edge { side: contact.side, below: contact.zone.below(place), above: contact.zone.above(place) }
    }

    /// The odometer window of an axis in which it arrives at none of these edges.
    pub fn window(&self, axis: usize, edges: &[Edge]) -> (i64, i64) {
        self.axes[axis].window(edges)
    }

    fn place(&self, contact: &Contact) -> i64 {
        self.axes[contact.axis].position(contact.side)
    }
}

fn permille(load: f64) -> u32 {
    (load * f64::from(FULL_TORQUE)).round() as u32
}

/// Volts or degrees Celsius in the integers of a pin.
fn in_board_units(quantity: f64, pin: &Pin) -> i32 {
    (quantity * f64::from(pin.scale)).round() as i32
}
