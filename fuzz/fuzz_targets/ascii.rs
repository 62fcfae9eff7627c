//! What users do to the controllers that have tables of commands: Performax and Commander.

use devices::ascii::{Command, Form};
use devices::{PinKind, Port};
use sim::{PinValue, VirtualDevice};

/// Chunks of one input that are looked at.
const MAX_CHUNKS: usize = 300;

/// Device time that passes for a chunk, at most: 255 steps of 0.5 ms.
const STEP_TICKS: u64 = 10_000;

/// Any bytes, any commands of the table with any values, time passing, inputs changing, wheels turning, motors
/// pushed about, and the supply switched off and on.
pub fn session<I>(device: &mut VirtualDevice, table: &'static [Command<I>], axes: &str, data: &[u8]) {
    let mut rest = data;
    for _ in 0..MAX_CHUNKS {
        let [what, size, tail @ ..] = rest else { break };
        rest = tail;
        match what % 8 {
            0 => {
                let (chunk, after) = tail.split_at(usize::from(*size).min(tail.len()));
                rest = after;
                let port = if what & 8 == 0 { Port::Usb } else { Port::Rs485 };
                device.receive(port, chunk);
            }
            1..=4 => {
                let Some((&[a, b, c, d], after)) = tail.split_first_chunk() else { break };
                rest = after;
                // Small numbers are more often in range.
                let number = i32::from_le_bytes([a, b, c, d]) >> (8 * (what >> 4 & 3));
                let command = &table[usize::from(*size) % table.len()];
                device.receive(Port::Usb, (line(command, axes, *what, number) + "\r").as_bytes());
            }
            5 => {
                let until = device.now() + u64::from(*size) * STEP_TICKS;
                device.advance(until);
            }
            6 => {
                let pins = device.pins();
                let pin = &pins[usize::from(*size) % pins.len()];
                let value = match pin.kind {
                    PinKind::Analog => PinValue::Number(f64::from(*what) * 20.0),
                    _ => PinValue::Level(what & 8 != 0),
                };
                // Outputs are not driven.
                let _ = if what & 16 == 0 {
                    device.drive_pin(pin.name, value)
                } else {
                    device.release_pin(pin.name)
                };
            }
            _ => {
                let axis = device.axes()[usize::from(what >> 3 & 3) % device.axes().len()];
                let distance = i64::from(*size) - 128;
                // Not every controller has an input for a wheel.
                let _ = match what >> 5 {
                    0 => device.set_load(axis, f64::from(*size) / 128.0),
                    1..=2 => device.push(axis, distance),
                    3..=5 => device.pulser(axis, distance),
                    _ => {
                        device.power_cycle();
                        Ok(())
                    }
                };
            }
        }
        device.drain_sent().for_each(drop);
    }
}

/// Says something and lets it have its effect: twice, because a correction of StepNLoop that is on has to end
/// before the loop can be switched off, and a line may have been left unfinished.
pub fn rest(device: &mut VirtualDevice, lines: &str) {
    for _ in 0..2 {
        device.receive(Port::Usb, format!("\r{lines}\r").as_bytes());
        let until = device.now() + STEP_TICKS;
        device.advance(until);
    }
    device.drain_sent().for_each(drop);
}

/// What the device answers.
pub fn answer(device: &mut VirtualDevice, command: &str) -> Vec<u8> {
    device.receive(Port::Usb, format!("{command}\r").as_bytes());
    device.drain_sent().flat_map(|sent| sent.bytes).collect()
}

/// Lets time pass in which no axis may move.
pub fn stands_still(device: &mut VirtualDevice) {
    let steps = |device: &mut VirtualDevice| -> Vec<u64> {
        (0..device.axes().len()).map(|axis| device.axis(axis).steps).collect()
    };
    let before = steps(device);
    let until = device.now() + 100 * STEP_TICKS;
    device.advance(until);
    assert_eq!(steps(device), before, "it stands still");
}

/// A line of this command's form. The number decides whatever else it needs, with `how` for choices that should
/// not depend on it: its bits 64 and 128 leave out a value and an axis.
pub fn line<I>(command: &Command<I>, axes: &str, how: u8, number: i32) -> String {
    let at = |turn: u32| axes.as_bytes()[(usize::from(how >> 3) + turn as usize) % axes.len()] as char;
    let axis = at(0);
    let sign = if number & 1 == 0 { '+' } else { '-' };
    let turn = if number & 2 == 0 { 'P' } else { 'N' };
    let numbers = |count: u8| {
        let all = (0..count).map(|turns| number.rotate_left(9 * u32::from(turns)).to_string());
        all.collect::<Vec<_>>().join(":")
    };
    let within = |low: u16, high: u16| low + (number.unsigned_abs() >> 3) as u16 % (high - low + 1);
    let name = command.name;
    let line = match command.form {
        Form::Bare => name.to_owned(),
        Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach if how & 128 == 0 => name.to_owned(),
        Form::Axis | Form::AxisOf(_) | Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach => {
            format!("{name}{axis}")
        }
        Form::Index(low, high) | Form::MaybeIndex(low, high) => format!("{name}{}", within(low, high)),
        Form::Way | Form::MaybeWay => format!("{name}{axis}{sign}"),
        Form::WayMode(low, high) => format!("{name}{axis}{sign}{}", within(low.into(), high.into())),
        Form::AxisNumber => format!("{name}{axis}{number}"),
        Form::Targets if how & 128 == 0 => format!("{axis}{number}"),
        Form::Targets => format!("{axis}{number}{}{}", at(1), number.rotate_left(7)),
        Form::Numbers(count) => format!("{name}{}", numbers(count)),
        Form::Plane(count) => format!("{name}{axis}{}{turn}{}", at(1), numbers(count)),
        Form::Helix(count) => format!("{name}{turn}{}", numbers(count)),
    };
    if command.value.can_set() && how & 64 == 0 { format!("{line}={number}") } else { line }
}
