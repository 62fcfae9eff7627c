use super::*;
use crate::{
    config::Bench,
    device::{Switches, VirtualDevice},
};
use rand_pcg::{Pcg32, rand_core::Rng as _};
use std::io::Cursor;

/// Bytes that several owners write to.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Shared {
    fn take(&self) -> Vec<u8> {
        std::mem::take(&mut self.0.lock().unwrap())
    }

    fn text(&self) -> String {
        String::from_utf8(self.take()).unwrap()
    }
}

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn logged(device: &mut VirtualDevice) -> Shared {
    let log = Shared::default();
    device.add_recorder(Box::new(Log::new(log.clone(), "log", &device.record_info())));
    log
}

/// Plays a tape and gives what it logs.
fn replayed(tape: &[u8]) -> String {
    let mut replay = Reader::new(Cursor::new(tape), Path::new("a.ptr")).replay().unwrap();
    let logs: Vec<_> = replay.devices().iter_mut().map(logged).collect();
    replay.play(|_, _, _| ()).unwrap();
    replay.devices().iter_mut().for_each(|device| device.finish_recordings().unwrap());
    logs.iter().map(Shared::text).collect()
}

const BENCH: &str = r#"
[[device]]
model = "pd42-1140"
supply = 20
[device.axis.0]
positive_limit = 30000
load = 0.25
[[device]]
model = "pmx-2ed"
name = "stage"
listen = ["tcp:127.0.0.1:0"]
seed = 7
[device.axis.X]
backlash = 20
hard_stops = [-3000, 9000]
[[device]]
model = "cmd-4cr"
[device.axis.Y]
slowdown = [[0, 5], [10, 15]]
in_position_ms = 3
mpg_from = "X"
"#;

/// What a host may say to each of them.
fn commands(model: &str) -> Vec<Vec<u8>> {
    let tmcl = |opcode: u8, kind: u8, value: i32| {
        let mut bytes = [1, opcode, kind, 0].to_vec();
        bytes.extend(value.to_be_bytes());
        bytes.push(bytes.iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte)));
        bytes
    };
    let ascii = |lines: &[&str]| lines.iter().map(|line| format!("{line}\r").into_bytes()).collect();
    match model {
        "pd42-1140" => vec![
            tmcl(1, 0, 800),
            tmcl(2, 0, 1200),
            tmcl(4, 0, 40_000),
            tmcl(4, 1, -900),
            tmcl(3, 0, 0),
            tmcl(5, 4, 1500),
            tmcl(7, 4, 0),
            tmcl(6, 1, 0),
            tmcl(37, 0, 0),
            vec![1, 6, 1],
        ],
        "pmx-2ed" => {
            ascii(&["HSPD=20000", "EO=3", "X5000", "I3000:-200", "J+Y", "STOP", "PX", "STORE", "LX-", "PX"])
        }
        _ => {
            ascii(&["HS=30000", "EO=15", "X5000", "X800Y-300", "JY+", "STOP", "PX", "STORE", "HX-0", "V1=5"])
        }
    }
}

/// What may be wrong with any of them, and when; not every device takes each.
const FAULTS: &[&str] = &[
    r#"{"kind":"stuck_switch","pin":"HOME","duration":0.01}"#,
    r#"{"kind":"stuck_switch","pin":"HX","value":true,"on":{"axis":"AXIS","position":700},"duration":0.3}"#,
    r#"{"kind":"bouncing_switch","pin":"HOME","ms":7,"on":{"axis":"AXIS","position":-55}}"#,
    r#"{"kind":"bouncing_switch","pin":"HX","ms":7}"#,
    r#"{"kind":"broken_encoder","axis":"AXIS","on":{"axis":"AXIS","motion":"starts"},"duration":0.2}"#,
    r#"{"kind":"slip","axis":"AXIS","pulses":35,"on":{"axis":"AXIS","position":222}}"#,
    r#"{"kind":"hand_wheel","axis":"AXIS","counts":-40,"on":{"axis":"AXIS","motion":"stops"}}"#,
    r#"{"kind":"extra_load","axis":"AXIS","load":0.6,"on":{"axis":"AXIS","motion":"stops"},"duration":0.05}"#,
    r#"{"kind":"supply_dip","volts":8,"at":0.01,"duration":0.02}"#,
    r#"{"kind":"brown_out","on":{"message":3},"after":0.0005,"duration":0.02}"#,
    r#"{"kind":"power_cut","on":{"pin":"DO1"},"duration":0.03}"#,
    r#"{"kind":"power_cut","at":0.02,"duration":0.01}"#,
    r#"{"kind":"noise","rate":0.003}"#,
    r#"{"kind":"loss","rate":0.02,"on":{"message":2},"duration":0.1}"#,
    r#"{"kind":"duplication","rate":0.02,"way":"in","duration":0.1}"#,
    r#"{"kind":"delay","ms":9,"duration":0.1}"#,
    r#"{"kind":"babbling_node","port":"usb","ms":11,"duration":0.3}"#,
    r#"{"kind":"stuck_switch","pin":"DI1","value":true,"on":{"address":2},"duration":0.3}"#,
];

/// Drives a device for a while at moments that nobody planned.
fn torment(device: &mut VirtualDevice, random: &mut Pcg32) {
    let commands = commands(device.config().model.name);
    let axis = device.axes()[0];
    for _ in 0..120 {
        for _ in 0..random.next_u32() % 4 {
            let to = device.now() + Ticks::from(random.next_u32() % 400_000);
            device.advance(to);
        }
        match random.next_u32() % 22 {
            16 | 17 => {
                let entry = FAULTS[random.next_u32() as usize % FAULTS.len()];
                drop(device.plan_entry(&serde_json::from_str(&entry.replace("AXIS", axis)).unwrap()));
            }
            18 => {
                let oldest = device.faults().first().map(|fault| fault.id);
                oldest.into_iter().for_each(|id| device.clear_fault(id).unwrap());
            }
            19 if random.next_u32().is_multiple_of(4) => device.clear_faults(),
            20 => {
                let home = i64::from(random.next_u32() % 900);
                let switches = Switches { home: Some([home, home + 40]), ..Switches::default() };
                device.move_switches(axis, &switches).unwrap();
            }
            21 => {
                let limit = Some(500 + i64::from(random.next_u32() % 4000));
                let switches = Switches { positive_limit: limit, ..Switches::default() };
                drop(device.move_switches(axis, &switches));
            }
            0 => device.set_load(axis, f64::from(random.next_u32() % 3) * 0.45).unwrap(),
            1 => device.push(axis, i64::from(random.next_u32() % 100)).unwrap(),
            2 => device.lose(axis, 5).unwrap(),
            3 => device.power_cycle(),
            4 => device.power_cut(),
            5 => device.hang_up(Port::Usb),
            6 => drop(device.pulser(axis, -40)),
            7 => {
                let pin = device.pins().iter().find(|pin| pin.kind.is_told()).unwrap();
                let value = (random.next_u32().is_multiple_of(2)).then_some(PinValue::Level(true));
                let input = crate::Input { pin: pin.name.into(), value };
                device.schedule(device.now() + 12_345, &input).unwrap();
            }
            8 => {
                let pin = device.pins().iter().find(|pin| pin.kind.is_told()).unwrap();
                drop(device.drive_pin(pin.name, PinValue::Level(random.next_u32().is_multiple_of(2))));
            }
            9 => {
                let pin = device.pins().iter().find(|pin| pin.kind.is_told()).unwrap();
                device.release_pin(pin.name).unwrap();
            }
            _ => {
                let command = &commands[random.next_u32() as usize % commands.len()];
                device.receive(Port::Usb, command);
            }
        }
    }
}

#[test]
fn a_tape_played_again_gives_the_same_log_byte_for_byte() {
    let configs = Bench::parse(BENCH, "bench.toml").unwrap().devices;
    for seed in 0..4 {
        let mut random = Pcg32::new(seed, 1);
        let flashes = configs.iter().map(|config| {
            let flash = SharedFlash::erased(config.model.flash_bytes);
            // Somebody stored something in an earlier life.
            let mut device = VirtualDevice::with_flash(config, flash.clone(), seed);
            torment(&mut device, &mut random);
            drop(device);
            flash.finish();
            SharedFlash::from_bytes(flash.to_bytes())
        });
        let flashes: Vec<_> = flashes.collect();
        let heads: Vec<_> =
            configs.iter().zip(&flashes).map(|(config, flash)| (config, seed, flash)).collect();
        let bytes = Shared::default();
        let tape = Tape::new(Box::new(bytes.clone()), Path::new("a.ptr"), &heads);
        let mut expected = String::new();
        for (number, (config, flash)) in configs.iter().zip(&flashes).enumerate() {
            let mut device = VirtualDevice::with_flash(config, flash.clone(), seed);
            device.add_tape(tape.track(number));
            let log = logged(&mut device);
            torment(&mut device, &mut random);
            device.end_tape();
            device.finish_recordings().unwrap();
            expected += &log.text();
        }
        tape.finish().unwrap();
        let bytes = bytes.take();
        assert_eq!(expected.matches("pulses, ").count(), 7, "a line for each axis");
        assert!(!expected.contains("axis X: 0 pulses"), "something moved");
        for again in 0..2 {
            let log = replayed(&bytes);
            let differs = expected.lines().zip(log.lines()).find(|(before, after)| before != after);
            assert!(log == expected, "seed {seed}, replay {again}: {differs:?}");
        }
    }
}

#[test]
fn a_bench_survives_a_tape() {
    let devices = Bench::parse(BENCH, "bench.toml").unwrap().devices;
    let text = crate::config::bench_text(&devices);
    assert_eq!(Bench::parse(&text, "again").unwrap().devices, devices, "{text}");
}

#[track_caller]
fn check_error(tape: &str, expected: &str) {
    let replay = Reader::new(tape.as_bytes(), Path::new("a.ptr")).replay();
    let error = replay.and_then(|mut replay| replay.play(|_, _, _| ())).unwrap_err();
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_broken_tape_is_told_with_its_line() {
    let head = |version: u32, bench: &str, devices: &str| {
        format!(r#"{{"pulsetrain_tape":{version},"bench":"{bench}","devices":[{devices}]}}"#) + "\n"
    };
    let one = "[[device]]\\nmodel = 'pd42-1140'";
    let good = head(1, one, r#"{"seed":0,"flash":[]}"#);
    check_error("", "a.ptr:1: a tape begins with its devices");
    check_error(&head(2, one, ""), "a.ptr:1: a tape of version 2, known is 1");
    check_error(&head(1, one, ""), "a.ptr:1: the bench has other devices than the tape");
    check_error(
        &head(1, "device = 3", ""),
        "a.ptr:1: bench:1: device: invalid type: integer `3`, expected a sequence",
    );
    check_error(
        &head(1, one, r#"{"seed":0,"flash":[[4294967295,"00"]]}"#),
        "a.ptr:1: rows of flash out of place",
    );
    check_error(&(good.clone() + r#"{"device":1,"at":0,"act":"end"}"#), "a.ptr:2: there is no device 1");
    let late = good.clone() + "{\"at\":5,\"act\":\"end\"}\n{\"at\":4,\"act\":\"end\"}\n";
    check_error(&late, "a.ptr:3: clock 4 has passed");
    check_error(
        &(good.clone() + r#"{"at":0,"act":{"receive":["usb","0"]}}"#),
        "a.ptr:2: bytes are pairs of hexadecimal digits",
    );
    check_error(
        &(good + r#"{"at":0,"act":{"load":["7",1.0]}}"#),
        "a.ptr:2: there is no axis `7`, the device has: 0",
    );
}
