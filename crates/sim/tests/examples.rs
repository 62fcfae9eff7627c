//! The example programs on the real controllers: what comes of them does not depend on how their time is cut into
//! pieces. In long pieces the rounds of loops that wait for something are left out; in pieces shorter than a round
//! none can be.

use devices::{Language, Model};
use sim::{DeviceConfig, Input, PinValue, Program, RunOptions, TimedInput, VirtualDevice, run};
use std::{
    fs,
    path::{Path, PathBuf},
};
use tmcl::asm::{Environment, Include};

const SECONDS: f64 = 3.0;

/// Shorter than a loop that looks at anything: three commands or lines.
const PIECE_SECONDS: f64 = 97e-6;

/// Folder of a model's examples, the inputs that go on and off meanwhile, and one that nobody looks at.
const MODELS: [(&str, &str, &[&str], &str); 3] = [
    ("pd42-1140", "tmcl", &["STOP_L", "HOME", "STOP_R", "AIN0"], "ENC_N"),
    ("pmx-2ed", "ascript/performax", &["DI1", "DI2", "DI3", "DI4"], "AI2"),
    ("cmd-4cr", "ascript/commander", &["DI1", "DI2", "ALMX", "DI3", "DI4"], "AI2"),
];

/// The program in a file; none if it includes files that are for the command line to find.
fn program(model: &Model, path: &Path) -> Option<Program> {
    let (name, source) = (path.display().to_string(), fs::read(path).unwrap());
    match model.language {
        Language::Tmcl => {
            let assembly = tmcl::asm::assemble(&name, &source, &Nothing);
            assembly.program.map(|program| Program::Tmcl(program.commands))
        }
        Language::Ascript(dialect) => {
            let code = ascript::compile(&name, &source, dialect).code.expect(&name);
            Some(Program::Ascript(code.lines))
        }
    }
}

/// No files beside the source.
struct Nothing;

impl Environment for Nothing {
    fn include(&self, _: &str, _: &str) -> Option<Include> {
        None
    }
}

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
    let examples = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut programs = 0;
    for (name, folder, pins, unused) in MODELS {
        let model = devices::model(name).unwrap();
        let files = fs::read_dir(examples.join(folder)).unwrap();
        for path in files.map(|entry| entry.unwrap().path()) {
            let Some(program) = program(model, &path) else { continue };
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
            assert!(ahead <= 1, "{}: {ahead} instructions", path.display());
            cut.instructions = whole.instructions;
            assert_eq!(whole, cut, "{}", path.display());
        }
    }
    assert!(programs > 25, "only {programs}");
}
