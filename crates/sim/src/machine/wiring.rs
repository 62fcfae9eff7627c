//! What hangs on the pins of a device, from its bench entry.

use super::{
    contact::{Contact, Contacts, Mover},
    encoder::Counter,
    shaft::Side,
    zone::Zone,
};
use crate::config::{AxisConfig, Switch};
use devices::{Pin, PinKind, Wiring};

/// The contacts by pin.
pub(super) fn contacts(pins: &[Pin], axes: &[AxisConfig], encoders: &[(usize, Counter)]) -> Contacts {
    let mut contacts: Vec<_> = pins.iter().map(|pin| contact(pin, axes, encoders)).collect();
    for (axis, config) in axes.iter().enumerate() {
        for cam in &config.cams {
            let pin = pins.iter().position(|pin| pin.name == cam.pin);
            // The configuration names pins that there are.
            let pin = pin.expect("a cam has a pin");
            contacts[pin] = Some(switch(axis, config, Zone::between(cam.on), cam.normally_closed));
        }
    }
    Contacts::new(contacts.into_iter())
}

/// What a pin is made for.
fn contact(pin: &Pin, axes: &[AxisConfig], encoders: &[(usize, Counter)]) -> Option<Contact> {
    let usual = |axis: usize, kind: Switch, zone: Option<Zone>| {
        Some(switch(axis, &axes[axis], zone?, axes[axis].normally_closed.contains(&kind)))
    };
    match (pin.wiring, pin.kind) {
        (Wiring::NegativeLimit(axis), _) => usual(axis, Switch::NegativeLimit, zone(pin, axis, &axes[axis])),
        (Wiring::PositiveLimit(axis), _) => usual(axis, Switch::PositiveLimit, zone(pin, axis, &axes[axis])),
        (Wiring::Home(axis), _) => usual(axis, Switch::Home, zone(pin, axis, &axes[axis])),
        (Wiring::Slowdown(axis), _) => {
            let [first, second] = axes[axis].slowdown;
            // A closed contact may stand for a switch that nothing ever meets.
            let never = axes[axis].normally_closed.contains(&Switch::Slowdown).then(Zone::nowhere);
            usual(axis, Switch::Slowdown, first.map(|first| Zone::between_two(first, second)).or(never))
        }
        (Wiring::InPosition(axis), _) => {
            axes[axis].in_position_ms.map(|_| Contact::new(Mover::InPosition { axis }))
        }
        (Wiring::Index(_), PinKind::Index(channel)) => {
            let (axis, counter) = &encoders[channel];
            let (side, zone) = counter.mark();
            Some(Contact::new(Mover::Shaft { axis: *axis, side, zone }))
        }
        (Wiring::Index(axis), _) => {
            let zone = Zone::marks(axes[axis].index_every);
            Some(Contact::new(Mover::Shaft { axis, side: Side::Load, zone }))
        }
        _ => None,
    }
}

/// Where a limit or home switch at a pin is on, if it is one of this axis.
pub(super) fn zone(pin: &Pin, axis: usize, config: &AxisConfig) -> Option<Zone> {
    // An axis that goes round has no ends.
    let end = |zone: Zone| config.circumference.is_none().then_some(zone);
    match pin.wiring {
        Wiring::NegativeLimit(of) if of == axis => end(Zone::up_to(config.negative_limit)),
        Wiring::PositiveLimit(of) if of == axis => end(Zone::from(config.positive_limit)),
        Wiring::Home(of) if of == axis => Some(around(config, Zone::between(config.home))),
        _ => None,
    }
}

/// A zone that comes again on an axis that goes round.
fn around(config: &AxisConfig, zone: Zone) -> Zone {
    config.circumference.map_or(zone, |turn| zone.every(turn))
}

fn switch(axis: usize, config: &AxisConfig, zone: Zone, normally_closed: bool) -> Contact {
    let zone = around(config, zone);
    Contact::switch(axis, zone, config.switch_hysteresis, normally_closed)
}

/// The axis whose switch is at a pin, if it is one that bounces: no mark or signal.
pub(super) fn axis_of_switch(pin: &Pin, contact: Option<&Contact>) -> Option<usize> {
    match (contact?.mover, pin.kind) {
        (Mover::Shaft { axis, .. }, PinKind::Input | PinKind::Port) => Some(axis),
        _ => None,
    }
}
