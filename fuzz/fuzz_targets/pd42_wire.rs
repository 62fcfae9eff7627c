//! Any bytes on any port of a PD42-1140, with time passing and inputs changing in between, on the simulated
//! machine: nothing may panic, and the module must still answer afterwards.

#![no_main]

use devices::{Port, model};
use libfuzzer_sys::fuzz_target;
use protocol::tmcl::Request;
use sim::{DeviceConfig, PinValue, VirtualDevice};

/// Chunks of one input that are looked at.
const MAX_CHUNKS: usize = 200;

/// Device time that passes for a chunk, at most: 255 steps of 2 ms.
const STEP_TICKS: u64 = 32_000;

fuzz_target!(|data: &[u8]| {
    let mut device = VirtualDevice::new(&DeviceConfig::new(model("pd42-1140").unwrap()), 1);
    let mut rest = data;
    for _ in 0..MAX_CHUNKS {
        let [what, size, tail @ ..] = rest else { break };
        let (chunk, after) = tail.split_at(usize::from(*size).min(tail.len()));
        rest = after;
        match what % 8 {
            0 | 1 => device.receive(Port::Usb, chunk),
            2 => device.receive(Port::Rs485, chunk),
            3 => device.receive(Port::Can, chunk),
            4 => {
                // Well-formed commands reach deeper than random bytes do.
                for command in chunk.as_chunks::<7>().0 {
                    let &[opcode, kind, motor, value @ ..] = command;
                    let value = i32::from_be_bytes(value);
                    device.receive(Port::Usb, &Request { address: 1, opcode, kind, motor, value }.emit().0);
                }
            }
            5 => {
                let until = device.now() + u64::from(*size) * STEP_TICKS;
                device.advance(until);
                rest = tail;
            }
            6 => {
                let pins = device.pins();
                let pin = &pins[usize::from(*size) % pins.len()];
                let level = what & 8 != 0;
                let value = match pin.kind {
                    devices::PinKind::Analog => PinValue::Number(f64::from(*what)),
                    _ => PinValue::Level(level),
                };
                let _ = device.drive_pin(pin.name, value);
                rest = tail;
            }
            _ => {
                if *size == 0 {
                    device.power_cycle();
                } else {
                    let _ = device.set_load("0", f64::from(*size) / 128.0);
                }
                rest = tail;
            }
        }
        device.drain_sent().for_each(drop);
    }
    // Undo what may have silenced it: a silence, then binary mode by a restart from factory settings is not
    // needed, since GAP is answered unless the port is in ASCII mode.
    let until = device.now() + 1_000_000;
    device.advance(until);
    device.drain_sent().for_each(drop);
    device.receive(Port::Usb, &Request { address: 1, opcode: 6, kind: 1, motor: 0, value: 0 }.emit().0);
    device.drain_sent().for_each(drop);
});
