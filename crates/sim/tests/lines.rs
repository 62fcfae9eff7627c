//! Programs whose lines a debugger lets through one by one: everything happens as if nobody looked.

use ascript::compiler::compile;
use devices::{AxisState, Drive, Language};
use motion::Train;
use sim::{
    DeviceConfig, Program, Scenario, SharedFlash, TimedInput, VirtualDevice,
    fault::scenario::no_source,
    record::{Mark, Note, RecordError, Recorder},
    run,
    tape::Log,
};
use std::{
    fs,
    io::Write,
    path::Path,
    sync::{Arc, Mutex},
};
use tmcl::asm::{NoFiles, assemble};

/// A file that everybody can look into.
#[derive(Clone, Default)]
struct Page(Arc<Mutex<Vec<u8>>>);

impl Write for Page {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

fn program(model: &str, source: &str) -> Program {
    match devices::model(model).unwrap().language {
        Language::Tmcl => {
            let assembly = assemble("a.tmc", source.as_bytes(), &NoFiles);
            assert!(!assembly.has_errors(), "{}", assembly.render(false));
            Program::Tmcl(assembly.program.unwrap_or_default().commands)
        }
        Language::Ascript(dialect) => {
            let compilation = compile("a.prg", source.as_bytes(), dialect);
            assert!(!compilation.has_errors(), "{}", compilation.render(false));
            Program::Ascript(compilation.code.unwrap_or_default().lines)
        }
    }
}

/// The log of so many seconds, from the start of the program.
fn log(model: &str, program: &Program, inputs: &[&str], seconds: f64, gated: bool) -> String {
    let config = DeviceConfig::new(devices::model(model).unwrap());
    let flash = SharedFlash::erased(config.model.flash_bytes);
    let mut device = VirtualDevice::with_flash(&config, flash, 1);
    let page = Page::default();
    let info = device.record_info();
    run::load(&mut device, program).unwrap();
    device.add_recorder(Box::new(Log::new(page.clone(), "log", &info)));
    for input in inputs {
        let TimedInput { seconds, input } = input.parse().unwrap();
        device.schedule(device.now() + device.ticks(seconds), &input).unwrap();
    }
    run::start(&mut device, program).unwrap();
    let end = device.now() + device.ticks(seconds);
    let mut lines = 0;
    if gated {
        while device.advance_to_line(end, lines % 3 == 0).is_some() || device.now() < end {
            device.execute_line();
            lines += 1;
        }
        assert!(lines > 0, "lines are held");
    } else {
        device.advance(end);
    }
    device.release_lines();
    device.finish_recordings().unwrap();
    let state = device.state();
    let text = String::from_utf8(page.0.lock().unwrap().clone()).unwrap();
    format!("{text}{state:?}")
}

#[track_caller]
fn check(model: &str, source: &str, inputs: &[&str], seconds: f64) {
    let program = program(model, source);
    let plain = log(model, &program, inputs, seconds, false);
    assert_eq!(log(model, &program, inputs, seconds, true), plain, "{model}:\n{source}");
}

/// Inputs that change in the very clocks in which lines are executed and waits end.
const INPUTS: [&str; 4] = ["0.1:HOME=true", "0.25:HOME=false", "0.5:HOME=true", "0.50005:HOME=false"];

#[test]
fn tmcl() {
    check("pd42-1140", "l: GIO 1, 0\nCOMP 0\nJC EQ, l\nAGP 5, 2\nMVP REL, 0, 100\nJA l\n", &INPUTS, 1.0);
    check(
        "pd42-1140",
        "WAIT TICKS, 0, 25\nGAP 9, 0\nAGP 1, 2\nWAIT TICKS, 0, 25\nGAP 9, 0\nAGP 2, 2\n\
         MVP ABS, 0, 5000\nWAIT POS, 0, 0\nROR 0, 300\nWAIT LIMSW, 0, 10\nMST 0\nSTOP\n",
        &INPUTS,
        3.0,
    );
    // A timer's interrupts come in clocks of commands.
    check(
        "pd42-1140",
        "VECT 0, tick\nSGP 0, 3, 10\nEI 0\nEI 255\nROR 0, 100\nl: CSUB sub\nJA l\n\
         sub: GGP 1, 2\nCALC ADD, 1\nAGP 1, 2\nRSUB\n\
         tick: GGP 2, 2\nCALC ADD, 1\nAGP 2, 2\nCSUB sub\nRETI\n",
        &[],
        1.0,
    );
}

#[test]
fn ascript() {
    let inputs = ["0.1:DI1=true", "0.2:DI1=false", "0.5:+LX=true", "0.5001:+LX=false"];
    let source = "PRG 0\nEO=3\nHSPD=5000\nWHILE 1=1\nX2000\nWAITX\nV1=V1+1\nDELAY=100\nX0\nWAITX\nV4=DI1\nDO1=V4\nENDWHILE\nEND\n\
                  PRG 1\nWHILE 1=1\nV2=PX\nIF DI1=1\nGOSUB 1\nENDIF\nDELAY=10\nENDWHILE\nEND\n\
                  SUB 1\nV3=V3+V2\nENDSUB\nSUB 31\nV9=V9+1\nECLEARX\nENDSUB\n";
    for model in ["pmx-2ed", "cmd-4cr"] {
        check(model, source, &inputs, 2.0);
    }
}

#[test]
fn the_examples() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/ascript");
    for (folder, model) in [("performax", "pmx-2ed"), ("commander", "cmd-4cr")] {
        for entry in fs::read_dir(examples.join(folder)).unwrap() {
            let source = fs::read_to_string(entry.unwrap().path()).unwrap();
            check(model, &source, &["0.3:DI1=true"], 1.0);
        }
    }
}

/// Takes down when a fault begins.
#[derive(Clone, Default)]
struct Begin(Arc<Mutex<Option<u64>>>);

impl Recorder for Begin {
    fn train(&mut self, _axis: usize, _train: &Train) {}

    fn drive(&mut self, _at: u64, _axis: usize, _drive: Drive) {}

    fn pin(&mut self, _at: u64, _pin: usize, _level: i32) {}

    fn mark(&mut self, _at: u64, _axis: usize, _mark: Mark) {}

    fn note(&mut self, at: u64, note: Note, _text: &str) {
        if note == Note::Fault {
            *self.0.lock().unwrap() = Some(at);
        }
    }

    fn sample(&mut self, _at: u64, _axis: usize, _state: &AxisState) {}

    fn finish(&mut self, _at: u64) -> Result<(), RecordError> {
        Ok(())
    }
}

/// When a program first stands before an address, of a device that is looked at line by line.
fn arrival(model: &str, program: &Program, number: Option<u8>, address: u16) -> u64 {
    let mut device = VirtualDevice::new(&DeviceConfig::new(devices::model(model).unwrap()), 1);
    run::load(&mut device, program).unwrap();
    run::start(&mut device, program).unwrap();
    let end = device.now() + device.ticks(10.0);
    while let Some(at) = device.advance_to_line(end, false) {
        if number.is_none_or(|number| usize::from(number) == at) && device.address(at) == Some(address) {
            return device.now();
        }
        device.execute_line();
    }
    panic!("it does not come there");
}

/// A fault that waits for an address begins before it, in its clock, however time is cut into pieces; the value of a
/// variable that is set there from a pin tells that.
#[track_caller]
fn begins(model: &str, source: &str, (program, address): (Option<u8>, u16), pin: &str, variable: &str) {
    let code = self::program(model, source);
    let expected = arrival(model, &code, program, address);
    let on = match program {
        Some(number) => format!("{{ address = {address}, program = {number} }}"),
        None => format!("{{ address = {address} }}"),
    };
    let scenario = format!("[[fault]]\non = {on}\nkind = \"stuck_switch\"\npin = \"{pin}\"\nvalue = true\n");
    let config = DeviceConfig::new(devices::model(model).unwrap());
    let scenario = Scenario::parse(&scenario, "s", std::slice::from_ref(&config), &no_source).unwrap();
    for (piece_s, gated) in [(10.0, false), (0.000_37, false), (10.0, true)] {
        let mut device = VirtualDevice::new(&config, 1);
        run::load(&mut device, &code).unwrap();
        device.plan(&scenario.faults[0].1).unwrap();
        let begin = Begin::default();
        device.add_recorder(Box::new(begin.clone()));
        run::start(&mut device, &code).unwrap();
        let end = device.now() + device.ticks(2.0);
        while device.now() < end {
            let until = (device.now() + device.ticks(piece_s)).min(end);
            if !gated {
                device.advance(until);
            } else if device.advance_to_line(until, false).is_some() {
                device.execute_line();
            }
        }
        device.release_lines();
        let begun = *begin.0.lock().unwrap();
        assert_eq!(begun, Some(expected), "{model}, {piece_s}, {gated}");
        let value = device.value(variable).unwrap();
        assert_eq!(value, sim::PinValue::Number(1.0), "{model}, {piece_s}, {gated}");
    }
}

#[test]
fn faults_begin_before_a_line() {
    // After rounds that are left out, and a wait.
    let tmcl =
        "l: GIO 10, 0\nGGP 132, 0\nCOMP 300\nJC LT, l\nWAIT TICKS, 0, 20\nGAP 10, 0\nAGP 1, 2\ne: JA e\n";
    begins("pd42-1140", tmcl, (None, 5), "STOP_R", "V1");
    begins("pd42-1140", tmcl, (Some(0), 5), "STOP_R", "V1");
    // What follows a wait without a command between.
    begins("pd42-1140", "WAIT TICKS, 0, 20\nGAP 10, 0\nAGP 1, 2\ne: JA e\n", (None, 1), "STOP_R", "V1");
    // Two programs, one of which waits for the other in a loop.
    let source = "PRG 0\nWHILE V2=0\nENDWHILE\nV1=DI1\nWHILE 1=1\nENDWHILE\nEND\n\
                  PRG 1\nDELAY=777\nV3=0\nV2=1\nEND\n";
    for model in ["pmx-2ed", "cmd-4cr"] {
        let Language::Ascript(dialect) = devices::model(model).unwrap().language else { unreachable!() };
        let map = compile("a.prg", source.as_bytes(), dialect).code.unwrap().map;
        let at = |line: usize| map.iter().position(|other| *other == line).unwrap() as u16;
        begins(model, source, (Some(0), at(4)), "DI1", "V1");
        begins(model, source, (Some(1), at(10)), "DI1", "V1");
        begins(model, source, (None, at(10)), "DI1", "V1");
    }
}
