//! Programs whose lines a debugger lets through one by one: everything happens as if nobody looked.

use ascript::compiler::compile;
use devices::Language;
use sim::{DeviceConfig, Program, SharedFlash, TimedInput, VirtualDevice, run, tape::Log};
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
