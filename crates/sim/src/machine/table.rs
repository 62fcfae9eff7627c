//! A machine as a table: for whoever has to be the machine of a controller that runs elsewhere.

use super::Machine;
use crate::{SharedFlash, config::DeviceConfig};
use devices::Controller;
use serde::Serialize;

/// What hangs on the pins of a device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MachineTable {
    /// The model's name.
    pub model: &'static str,
    /// The device's name.
    pub name: String,
    /// Its endpoints, as a bench file has them.
    pub listen: Vec<String>,
    /// Clocks a second of its controller.
    pub clock_hz: u32,
    /// Names of the axes.
    pub axes: &'static [&'static str],
    /// The pins, by their numbers.
    pub pins: Vec<PinRow>,
    /// The encoders, by their channels.
    pub encoders: Vec<EncoderRow>,
}

/// A pin and what is on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PinRow {
    /// Its name in the manual.
    pub name: &'static str,
    /// Whether it has a number on it, and not a level.
    pub analog: bool,
    /// How many of the board's integers make one unit of an analog pin; 1 for others.
    pub scale: i32,
    /// What is on it by itself, or when its switch is off: 0 or 1, or the analog value in the board's integers.
    pub rest: i32,
    /// Where its switch or mark is on: the pin then has the other level.
    pub zone: Option<ZoneRow>,
}

/// Odometers of an axis at which an input is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ZoneRow {
    /// The number of the axis.
    pub axis: usize,
    /// The lowest.
    pub first: i64,
    /// The highest.
    pub last: i64,
    /// After how many pulses the zone comes again, if it does.
    pub every: Option<i64>,
}

/// An encoder: its count is the odometer of an axis times a ratio, rounded to the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct EncoderRow {
    /// The number of the axis.
    pub axis: usize,
    /// Counts for so many pulses:
    pub numerator: i64,
    /// these.
    pub denominator: i64,
}

impl MachineTable {
    /// The machine of a device, at full resolution, without play, servo drivers and a second slowdown zone:
    /// a table is no simulation.
    pub fn of(config: &DeviceConfig) -> Self {
        // Only a controller itself knows its pins.
        let flash = SharedFlash::erased(config.model.flash_bytes);
        let controller: Box<dyn Controller> = (config.model.build)(Box::new(flash), 0);
        let (axes, pins, clock_hz) = (controller.axes(), controller.pins(), controller.clock_hz());
        let machine = Machine::new(config, axes, pins, clock_hz, 0);
        let zone = |pin: usize| {
            let (axis, _, zone) = machine.zone(pin)?;
            let (first, last, every) = zone.interval();
            Some(ZoneRow { axis, first, last, every })
        };
        let row = |(number, pin): (usize, &devices::Pin)| PinRow {
            name: pin.name,
            analog: pin.kind.is_analog(),
            scale: pin.scale,
            rest: match machine.contacts.get(number) {
                _ if pin.kind.is_analog() => machine.quantity(number),
                Some(contact) if contact.normally_closed => 1 - pin.rest,
                _ => pin.rest,
            },
            zone: zone(number),
        };
        let encoder = |(axis, counter): &(usize, super::Counter)| {
            let (numerator, denominator) = counter.ratio();
            EncoderRow { axis: *axis, numerator, denominator }
        };
        Self {
            model: config.model.name,
            name: config.name.clone(),
            listen: config.listen.iter().map(ToString::to_string).collect(),
            clock_hz,
            axes,
            pins: pins.iter().enumerate().map(row).collect(),
            encoders: machine.encoders.iter().map(encoder).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bench;

    fn table(bench: &str) -> MachineTable {
        MachineTable::of(&Bench::parse(bench, "bench.toml").unwrap().devices[0])
    }

    #[test]
    fn zones_and_encoders_are_those_of_the_bench() {
        let table = table(
            "[[device]]\nmodel = \"pd42-1140\"\nsupply = 12.5\nlisten = [\"tcp:127.0.0.1:4001\"]\n[device.axis.0]\n\
             negative_limit = -8000\nhome = [1000, 3000]\nindex_every = 500\nencoder_ratio = -0.5\n",
        );
        let pin = |name| table.pins.iter().find(|pin| pin.name == name).unwrap();
        let zone = |first, last, every| Some(ZoneRow { axis: 0, first, last, every });
        assert_eq!(pin("HOME").zone, zone(1000, 3000, None));
        assert_eq!(pin("STOP_L").zone.unwrap().last, -8000);
        assert_eq!(pin("ENC_N").zone, zone(0, 0, Some(500)));
        assert_eq!((pin("SUPPLY").rest, pin("OUT0").zone), (12_500, None));
        let ratios: Vec<_> = table.encoders.iter().map(|row| (row.numerator, row.denominator)).collect();
        assert_eq!(ratios, [(-1, 100), (-1, 2)]);
        assert_eq!(table.listen, ["tcp:127.0.0.1:4001"]);
    }
}
