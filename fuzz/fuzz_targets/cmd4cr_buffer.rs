//! Buffered moves of a CMD-4CR, legal and not: lines, circles, arcs and helices into the buffer and past it,
//! started, stopped and aborted, with limits, alarms and the emergency stop in between. No axis is ever faster than
//! what was asked for, the registers add up, and everything comes to rest when it is told to.

#![no_main]

use devices::{Port, model};
use libfuzzer_sys::fuzz_target;
use sim::{DeviceConfig, PinValue, VirtualDevice};

/// Chunks of one input that are looked at.
const MAX_CHUNKS: usize = 400;

/// Clocks of a millisecond, about.
const MS: u64 = 19_661;

/// Registers of the buffer (manual, 2.3.4).
const REGISTERS: i64 = 100;

/// The longest that a ramp takes: acceleration and deceleration are set to less.
const RAMP_MS: u64 = 20;

/// The highest speed of an axis (manual, appendix B).
const MAX_PPS: i64 = 6_553_500;

/// The speed from the factory, and the low one.
const FIRST_PPS: i64 = 1000;

const INPUTS: [&str; 14] =
    ["+LX", "-LX", "+LY", "-LY", "+LZ", "-LZ", "SDX", "SDY", "ALMX", "ALMZ", "INPY", "CEMG", "CSTA", "+LU"];

/// Commands without numbers.
const COMMANDS: [&str; 32] = [
    "BO", "BSTART", "BO", "BSTART", "BF", "STOP", "ABORT", "ESTOP", "STOPX", "ABORTY", "ABORTZ", "INC",
    "ABS", "CLRX", "CLRY", "CLRZ", "CLRU", "IERR=1", "IERR=0", "SDEX=1", "SDEY=3", "SDCX=1", "SDEX=0",
    "EXST=1", "EXST=0", "EINT=0", "EINT=1", "INPY=1", "INPY=0", "JX+", "HY-1", "SCVX=1",
];

struct Bench {
    device: VirtualDevice,
    /// The highest speed that was asked for since the axes rested.
    top_pps: i64,
    /// Z went along on a helix meanwhile, where the speed is that of the others.
    helix: bool,
    high_pps: i64,
}

impl Bench {
    fn new() -> Self {
        let device = VirtualDevice::new(&DeviceConfig::new(model("cmd-4cr").unwrap()), 1);
        let mut bench = Self { device, top_pps: FIRST_PPS, helix: false, high_pps: FIRST_PPS };
        for command in ["EO=15", "ACC=10", "DEC=10"] {
            assert_eq!(bench.say(command), "OK");
        }
        bench
    }

    fn say(&mut self, command: &str) -> String {
        self.device.receive(Port::Usb, format!("{command}\r").as_bytes());
        let reply: Vec<u8> = self.device.drain_sent().flat_map(|sent| sent.bytes).collect();
        let reply = String::from_utf8(reply).unwrap();
        assert_eq!(reply.matches('\r').count(), 1, "one reply to {command}");
        reply.trim_end().to_owned()
    }

    fn steps(&mut self) -> [u64; 4] {
        [0, 1, 2, 3].map(|axis| self.device.axis(axis).steps)
    }

    /// Lets time pass. No axis makes more pulses than its highest speed allows.
    fn pass(&mut self, ms: u64) {
        let (before, from) = (self.steps(), self.device.now());
        self.device.advance(from + ms * MS);
        let clocks = u128::from(self.device.now() - from);
        for (axis, (after, before)) in self.steps().into_iter().zip(before).enumerate() {
            let top_pps = if axis == 2 && self.helix { MAX_PPS } else { self.top_pps };
            // A pulse at each end, and one that an axis may be beside its path.
            let (made, most) = (after - before, top_pps as u128 * clocks / 19_660_800 + 3);
            assert!(u128::from(made) <= most, "axis {axis} makes {made} pulses of {most}");
            let speed = self.device.axis(axis).speed_mpps.abs();
            assert!(speed <= top_pps * 1001 + 1000, "axis {axis} at {speed} mpps, top {top_pps} pps");
        }
    }

    /// `BSTAT` adds up; gives how many moves wait.
    fn waiting(&mut self) -> i64 {
        let status = self.say("BSTAT");
        let fields: Vec<i64> = status.split(':').map(|field| field.parse().unwrap()).collect();
        let [on, start, end, free] = fields[..] else { panic!("{status}") };
        assert!((0..=1).contains(&on) && (0..=REGISTERS).contains(&free), "{status}");
        let waiting = REGISTERS - free;
        assert_eq!((start + waiting) % REGISTERS, end, "{status}");
        assert!(on == 1 || waiting == 0, "{status}");
        waiting
    }

    fn rests(&mut self) -> bool {
        ["X", "Y", "Z", "U"]
            .iter()
            .all(|axis| self.say(&format!("MST{axis}")).parse::<i32>().unwrap() & 7 == 0)
    }

    /// What is asked for from here on counts alone, if nothing is on.
    fn forget(&mut self) {
        if self.waiting() == 0 && self.rests() {
            (self.top_pps, self.helix) = (self.high_pps.max(FIRST_PPS), false);
        }
    }

    fn speed(&mut self, pps: i64) {
        self.top_pps = self.top_pps.max(pps);
    }
}

/// A number: mostly small, sometimes anything.
fn number(bytes: [u8; 2]) -> i32 {
    let [low, high] = bytes;
    match high >> 5 {
        0..=4 => i32::from(low.cast_signed()) * 4,
        5 => i32::from(i16::from_le_bytes(bytes)),
        6 => i32::from(i16::from_le_bytes(bytes)) << 12,
        _ => [i32::MIN, i32::MAX, 0, -1, 134_217_727, 134_217_728, -134_217_728, 1][usize::from(low) % 8],
    }
}

fuzz_target!(|data: &[u8]| {
    let mut bench = Bench::new();
    let (way, mut rest) = data.split_first().map_or((0, data), |(way, rest)| (*way, rest));
    for _ in 0..MAX_CHUNKS {
        let [what, size, tail @ ..] = rest else { break };
        rest = tail;
        let mut next = || {
            let (bytes, after) = rest.split_first_chunk().map_or(([0; 2], rest), |(it, after)| (*it, after));
            rest = after;
            number(bytes)
        };
        let axis = |turn: u8| b"XYZU"[usize::from(size.wrapping_add(turn)) % 4] as char;
        let turn = if size & 4 == 0 { 'P' } else { 'N' };
        match what % 16 {
            0..=3 => {
                let speed = if what & 16 == 0 { 200 * i32::from(*size) } else { next() };
                let command = format!("I{}:{}:{}:{speed}", next(), next(), next());
                if bench.say(&command) == "OK" {
                    bench.speed(speed.into());
                }
            }
            4 => {
                bench.say(&format!("CIR{}{}{turn}{}:{}", axis(0), axis(1 + (size >> 4) % 3), next(), next()));
            }
            5 => {
                let command = format!("ARC{}{}{turn}{}:{}", axis(0), axis(1), next(), next());
                bench.say(&format!("{command}:{}", next().wrapping_mul(100)));
            }
            6 => {
                let command = format!("CIRT{turn}{}:{}:{}", next(), next(), next());
                bench.helix |= bench.say(&command) == "OK";
            }
            7 => {
                let command = format!("ARCT{turn}{}:{}", next(), next());
                let command = format!("{command}:{}:{}", next().wrapping_mul(100), next());
                bench.helix |= bench.say(&command) == "OK";
            }
            8 => {
                bench.say(&format!("X{}Y{}Z{}", next(), next(), next()));
            }
            9 => {
                bench.say(&format!("{}{}", axis(0), next()));
            }
            10 => {
                let pps = 1 + 200 * i64::from(*size);
                assert_eq!(bench.say(&format!("HSPD={pps}")), "OK");
                bench.high_pps = pps;
                bench.speed(pps);
            }
            11 => {
                let input = INPUTS[usize::from(*size) % INPUTS.len()];
                let _ = match what >> 4 & 3 {
                    0 => bench.device.drive_pin(input, PinValue::Level(true)),
                    1 => bench.device.drive_pin(input, PinValue::Level(false)),
                    _ => bench.device.release_pin(input),
                };
            }
            12 | 13 => {
                bench.say(COMMANDS[usize::from(*size) % COMMANDS.len()]);
            }
            _ => bench.pass(u64::from(*size >> 2)),
        }
        bench.waiting();
        bench.forget();
    }
    // An alarm or a driver out of position does not keep an axis from stopping.
    if way & 1 == 0 {
        bench.say("ABORT");
    } else {
        bench.say("STOP");
        bench.pass(RAMP_MS);
    }
    assert!(bench.rests(), "it stops");
    bench.say("BF");
    assert_eq!(bench.waiting(), 0);
    bench.say("ABORT");
    let before = bench.steps();
    bench.pass(500);
    assert_eq!(bench.steps(), before, "nothing goes on");
});
