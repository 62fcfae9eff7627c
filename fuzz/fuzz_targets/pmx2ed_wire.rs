//! Any bytes, and any commands of the table with any values, on the ports of a PMX-2ED-SA, with time passing,
//! inputs changing and the motors pushed about, on the simulated machine: nothing may panic, and the
//! controller must still answer and stop afterwards.

#![no_main]

use devices::ascii::Form;
use devices::pmx2ed::table::COMMANDS;
use devices::{PinKind, Port, model};
use libfuzzer_sys::fuzz_target;
use sim::{DeviceConfig, PinValue, VirtualDevice};

/// Chunks of one input that are looked at.
const MAX_CHUNKS: usize = 300;

/// Device time that passes for a chunk, at most: 255 steps of 2 ms.
const STEP_TICKS: u64 = 40_000;

fuzz_target!(|data: &[u8]| {
    let mut device = VirtualDevice::new(&DeviceConfig::new(model("pmx-2ed").unwrap()), 1);
    device.receive(Port::Usb, b"EO=3\r");
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
                device.receive(Port::Usb, command(*size, *what, number).as_bytes());
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
                let _ = if what & 16 == 0 {
                    device.drive_pin(pin.name, value)
                } else {
                    device.release_pin(pin.name)
                };
            }
            _ => {
                let axis = if what & 8 == 0 { "X" } else { "Y" };
                let _ = match what >> 4 & 3 {
                    0 => device.set_load(axis, f64::from(*size) / 128.0),
                    1 | 2 => device.push(axis, i64::from(*size) - 128),
                    _ => {
                        device.power_cycle();
                        Ok(())
                    }
                };
            }
        }
        device.drain_sent().for_each(drop);
    }
    // A line may have been left unfinished.
    device.receive(Port::Usb, b"\rSR0=0\rSR1=0\rJF\rABORT\r");
    device.drain_sent().for_each(drop);
    device.receive(Port::Usb, b"ID\r");
    let reply: Vec<u8> = device.drain_sent().flat_map(|sent| sent.bytes).collect();
    assert_eq!(reply, b"PERFORMAX-2ED-SA\r");
});

/// A command of the table.
fn command(entry: u8, how: u8, number: i32) -> String {
    let command = &COMMANDS[usize::from(entry) % COMMANDS.len()];
    let axis = if how & 8 == 0 { 'X' } else { 'Y' };
    let sign = if number & 1 == 0 { '+' } else { '-' };
    let name = command.name;
    let line = match command.form {
        Form::Bare => name.to_owned(),
        Form::Axis => format!("{name}{axis}"),
        Form::MaybeAxis if how & 128 == 0 => name.to_owned(),
        Form::MaybeAxis => format!("{name}{axis}"),
        Form::Index(low, high) | Form::MaybeIndex(low, high) => {
            format!("{name}{}", low + (number.unsigned_abs() as u16 >> 3) % (high - low + 1))
        }
        Form::Way | Form::MaybeWay => format!("{name}{axis}{sign}"),
        Form::AxisNumber => format!("{name}{axis}{number}"),
        Form::Targets if how & 128 == 0 => format!("{axis}{number}"),
        Form::Targets => format!("X{number}Y{}", number.rotate_left(7)),
        Form::Each => format!("{name}{number}:{}", number.rotate_left(9)),
    };
    if command.value.can_set() && how & 64 == 0 { format!("{line}={number}\r") } else { format!("{line}\r") }
}
