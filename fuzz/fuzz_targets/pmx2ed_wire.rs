//! Any bytes, and any commands of the table with any values, on the ports of a PMX-2ED-SA, with time passing,
//! inputs changing and the motors pushed about, on the simulated machine: nothing may panic, and the
//! controller must still answer and stop afterwards.

#![no_main]

mod line;

use devices::pmx2ed::table::{AXES, COMMANDS};
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
                let command = &COMMANDS[usize::from(*size) % COMMANDS.len()];
                device.receive(Port::Usb, (line::line(command, AXES, *what, number) + "\r").as_bytes());
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
