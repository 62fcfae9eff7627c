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
    // An axis that goes round has no ends.
    let end = |axis: usize, zone: Zone| axes[axis].circumference.is_none().then_some(zone);
    match (pin.wiring, pin.kind) {
        (Wiring::NegativeLimit(axis), _) => {
            usual(axis, Switch::NegativeLimit, end(axis, Zone::up_to(axes[axis].negative_limit)))
        }
        (Wiring::PositiveLimit(axis), _) => {
            usual(axis, Switch::PositiveLimit, end(axis, Zone::from(axes[axis].positive_limit)))
        }
        (Wiring::Home(axis), _) => usual(axis, Switch::Home, Some(Zone::between(axes[axis].home))),
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

fn switch(axis: usize, config: &AxisConfig, zone: Zone, normally_closed: bool) -> Contact {
    let zone = config.circumference.map_or(zone, |turn| zone.every(turn));
    Contact::switch(axis, zone, config.switch_hysteresis, normally_closed)
}

/// The axis whose switch is at a pin, if it is one that bounces: no mark or signal.
pub(super) fn axis_of_switch(pin: &Pin, contact: Option<&Contact>) -> Option<usize> {
    match (contact?.mover, pin.kind) {
        (Mover::Shaft { axis, .. }, PinKind::Input | PinKind::Port) => Some(axis),
        _ => None,
    }
}
