//! Any bytes, and any commands of the table with any values, on the ports of a CMD-4CR, with time passing,
//! inputs changing, wheels turning and the motors pushed about, on the simulated machine: nothing may panic, and
//! the controller must still answer and stop afterwards.

#![no_main]

mod line;

use devices::cmd4cr::table::{AXES, COMMANDS};
use devices::{PinKind, Port, model};
use libfuzzer_sys::fuzz_target;
use sim::{DeviceConfig, PinValue, VirtualDevice};

/// Chunks of one input that are looked at.
const MAX_CHUNKS: usize = 300;

/// Device time that passes for a chunk, at most: 255 steps of about 0.5 ms.
const STEP_TICKS: u64 = 10_000;

/// Lets everything come to rest; before it a line may have been left unfinished.
const REST: &[u8] = b"\rSACTRL0=0\rSACTRL1=0\rSACTRL2=0\rSACTRL3=0\rBF\rABORT\rJENA=0\r\
    MPEX=0\rMPEY=0\rMPEZ=0\rMPEU=0\rABORT\rSLX=0\rSLY=0\rSLZ=0\rSLU=0\rABORT\r";

fuzz_target!(|data: &[u8]| {
    let mut device = VirtualDevice::new(&DeviceConfig::new(model("cmd-4cr").unwrap()), 1);
    device.receive(Port::Usb, b"EO=15\r");
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
                    PinKind::Analog => PinValue::Number(f64::from(*what) * 13.0),
                    _ => PinValue::Level(what & 8 != 0),
                };
                let _ = if what & 16 == 0 {
                    device.drive_pin(pin.name, value)
                } else {
                    device.release_pin(pin.name)
                };
            }
            _ => {
                let axis = device.axes()[usize::from(what >> 3 & 3)];
                let distance = i64::from(*size) - 128;
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
    device.receive(Port::Usb, REST);
    // A correction of StepNLoop that was on has to end before the loop can be switched off.
    let until = device.now() + STEP_TICKS;
    device.advance(until);
    device.receive(Port::Usb, REST);
    device.drain_sent().for_each(drop);
    device.receive(Port::Usb, b"VER\r");
    let reply: Vec<u8> = device.drain_sent().flat_map(|sent| sent.bytes).collect();
    assert_eq!(reply, b"V126BL\r");
    let steps = |device: &mut VirtualDevice| [0, 1, 2, 3].map(|axis| device.axis(axis).steps);
    let before = steps(&mut device);
    let until = device.now() + 100 * STEP_TICKS;
    device.advance(until);
    assert_eq!(steps(&mut device), before, "it stands still");
});
