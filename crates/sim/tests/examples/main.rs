//! The example programs on the real controllers: what comes of them does not depend on how their time is cut into
//! pieces. In long pieces the rounds of loops that wait for something are left out; in pieces shorter than a round
//! none can be.

mod programs;

use sim::{DeviceConfig, Input, PinValue, RunOptions, TimedInput, VirtualDevice, run};

const SECONDS: f64 = 3.0;

/// Shorter than a loop that looks at anything: three commands or lines.
const PIECE_SECONDS: f64 = 97e-6;

/// The inputs of a model that go on and off meanwhile, and one that nobody looks at.
const MODELS: [(&str, &[&str], &str); 3] = [
    ("pd42-1140", &["STOP_L", "HOME", "STOP_R", "AIN0"], "ENC_N"),
    ("pmx-2ed", &["DI1", "DI2", "DI3", "DI4"], "AI2"),
    ("cmd-4cr", &["DI1", "DI2", "ALMX", "DI3", "DI4"], "AI2"),
];

fn timed(seconds: f64, pin: &str, value: Option<PinValue>) -> TimedInput {
    TimedInput { seconds, input: Input { pin: pin.into(), value } }
}

/// Inputs that go on for a while, one after the other.
fn inputs(pins: &[&str]) -> Vec<TimedInput> {
    let on = |pin: &str| if pin == "AIN0" { PinValue::Number(3000.0) } else { PinValue::Level(true) };
    let mut seconds = 0.1234;
    let mut inputs = Vec::new();
    while seconds < SECONDS {
        for pin in pins {
            inputs.push(timed(seconds, pin, Some(on(pin))));
            inputs.push(timed(seconds + 0.0567, pin, None));
            seconds += 0.1289;
        }
    }
    inputs
}

#[test]
fn programs_do_the_same_however_time_is_cut() {
    let mut programs = 0;
    for (name, pins, unused) in MODELS {
        let model = devices::model(name).unwrap();
        for (file, program) in programs::of_model(model) {
            programs += 1;
            let result = |inputs| {
                let mut device = VirtualDevice::new(&DeviceConfig::new(model), 1);
                let options = RunOptions { for_seconds: Some(SECONDS), inputs, ..RunOptions::default() };
                let mut result = run(&mut device, &program, &options, |_| ()).unwrap();
                result.wall_seconds = 0.0;
                result
            };
            let pieces = (0..(SECONDS / PIECE_SECONDS) as u32).map(|n| f64::from(n) * PIECE_SECONDS);
            let cut = pieces.map(|seconds| timed(seconds, unused, None));
            let whole = result(inputs(pins));
            let mut cut = result(inputs(pins).into_iter().chain(cut).collect());
            // Of two programs with a line in the very clock in which the run ends, both have executed it or one.
            let ahead = whole.instructions.abs_diff(cut.instructions);
            assert!(ahead <= 1, "{file}: {ahead} instructions");
            cut.instructions = whole.instructions;
            assert_eq!(whole, cut, "{file}");
        }
    }
    assert!(programs > 25, "only {programs}");
}
