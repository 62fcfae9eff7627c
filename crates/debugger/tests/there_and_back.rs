//! Whoever goes back finds everything as it was.

use ascript::compile;
use debugger::{Code, Debugger, Direction, Goal, Stop, Target, code::Place};
use devices::Language;
use sim::{DeviceConfig, Scenario, fault, tape::Act};
use source::Source;
use tmcl::asm::{NoFiles, assemble};

const TMCL: &str = "\
VECT 0, tick
SGP 0, 3, 7
EI 0
EI 255
MVP ABS, 0, 3000
loop: CSUB count
WAIT TICKS, 0, 1
GIO 0, 0
COMP 100
JC LT, loop
MVP ABS, 0, 0
WAIT POS, 0, 0
STOP
count: GGP 1, 2
CALC ADD, 1
AGP 1, 2
RSUB
tick: GGP 2, 2
CALC ADD, 1
AGP 2, 2
RETI
";

const ASCRIPT: &str = "\
PRG 0
EO=3
HSPD=5000
WHILE 1=1
X300
WAITX
V1=V1+1
GOSUB 2
X0
WAITX
ENDWHILE
END
PRG 1
WHILE 1=1
V2=PX
IF DI1=1
V3=V3+1
ELSE
DELAY=3
ENDIF
ENDWHILE
END
SUB 2
V4=V4-V2
ENDSUB
";

fn debugger(model: &str, source: &str, inputs: &[&str]) -> Debugger {
    with_faults(model, source, inputs, "")
}

/// The same with a scenario.
fn with_faults(model: &str, source: &str, inputs: &[&str], scenario: &str) -> Debugger {
    let model = devices::model(model).unwrap();
    let code = match model.language {
        Language::Tmcl => Code::tmcl(assemble("a.tmc", source.as_bytes(), &NoFiles)).unwrap(),
        Language::Ascript(dialect) => {
            let compilation = compile("a.prg", source.as_bytes(), dialect);
            Code::ascript(Source::new("a.prg", source.as_bytes()), compilation.code.unwrap())
        }
    };
    let inputs = inputs.iter().map(|input| input.parse().unwrap()).collect();
    let config = DeviceConfig::new(model);
    let find = |place: &fault::Place<'_>| code.address(place).map(u32::from).ok_or_else(String::new);
    let scenario = Scenario::parse(scenario, "faults.toml", std::slice::from_ref(&config), &find).unwrap();
    let faults = scenario.of(0).cloned().collect();
    Debugger::new(Target { code, config, inputs, faults }, 100.0).unwrap()
}

/// Everything that can be seen.
fn look(debugger: &mut Debugger) -> String {
    let program = debugger.program();
    let (frames, point) = (debugger.frames(program), debugger.point());
    let device = debugger.device();
    let axes: Vec<_> = (0..device.axes().len()).map(|axis| device.axis(axis)).collect();
    let programs: Vec<_> = device.programs().collect();
    let values: Vec<_> = device.quantities().iter().filter_map(|it| device.value(&it.name)).collect();
    let pins: Vec<_> = device.pins().iter().map(|pin| device.read_pin(pin.name).unwrap()).collect();
    format!("{point:?} {program} {frames:?} {axes:?} {programs:?} {values:?} {pins:?}")
}

fn go(debugger: &mut Debugger, direction: Direction, goal: Goal) -> Stop {
    debugger.go(direction, goal).unwrap()
}

#[track_caller]
fn check(model: &str, source: &str, inputs: &[&str], scenario: &str, steps: usize) {
    let mut debugger = with_faults(model, source, inputs, scenario);
    let mut seen = vec![look(&mut debugger)];
    for number in 0..steps {
        // Somebody meddles now and then.
        if number % 17 == 9 {
            let axis = debugger.device().axes()[0].to_owned();
            debugger.perform(Act::Push(axis, 5)).unwrap();
            seen.pop();
            seen.push(look(&mut debugger));
        }
        assert_eq!(go(&mut debugger, Direction::Forward, Goal::Into), Stop::Step, "{number}");
        seen.push(look(&mut debugger));
    }
    for (number, before) in seen.iter().enumerate().rev().skip(1) {
        let stop = go(&mut debugger, Direction::Backward, Goal::Into);
        assert_eq!(stop, if number == 0 { Stop::Start } else { Stop::Step }, "{number}");
        assert_eq!(look(&mut debugger), *before, "back to {number}");
    }
    // And forward again: what was done is done again.
    for (number, after) in seen.iter().enumerate().skip(1) {
        assert_eq!(go(&mut debugger, Direction::Forward, Goal::Into), Stop::Step);
        assert_eq!(look(&mut debugger), *after, "forward again, {number}");
    }
}

#[test]
fn steps() {
    check("pd42-1140", TMCL, &["0.02:HOME=true"], "", 60);
    check("pmx-2ed", ASCRIPT, &["0.05:DI1=true", "0.06:DI1=false"], "", 60);
    check("cmd-4cr", ASCRIPT, &["0.05:DI1=true", "0.06:DI1=false"], "", 40);
}

#[test]
fn faults() {
    let scenario = r#"
        [[fault]]
        on = { axis = "0", position = 40 }
        kind = "slip"
        axis = "0"
        pulses = 20
        [[fault]]
        on = { label = "count" }
        kind = "stuck_switch"
        pin = "HOME"
        value = true
        duration = 0.004
        [[fault]]
        on = { line = 8 }
        after = 0.001
        kind = "supply_dip"
        volts = 20.0
    "#;
    check("pd42-1140", TMCL, &["0.02:HOME=true"], scenario, 60);
    let scenario = r#"
        [[fault]]
        on = { axis = "X", motion = "stops" }
        kind = "stuck_switch"
        pin = "DI1"
        value = true
    "#;
    check("pmx-2ed", ASCRIPT, &[], scenario, 60);
    check("cmd-4cr", ASCRIPT, &[], scenario, 40);
}

#[test]
fn a_supply_that_goes() {
    let scenario = "[[fault]]\nat = 0.01\nkind = \"brown_out\"\nduration = 0.02\n";
    let mut debugger = with_faults("pmx-2ed", ASCRIPT, &[], scenario);
    let clock = debugger.clock(0.0099);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Clock(clock)), Stop::Time);
    let before = look(&mut debugger);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::End), Stop::Ended);
    assert!(debugger.seconds() >= 0.03, "it comes back, and nobody starts its programs");
    assert_eq!(debugger.value("EO"), Some(sim::PinValue::Number(0.0)));
    while debugger.seconds() > 0.009 {
        assert_eq!(go(&mut debugger, Direction::Backward, Goal::Into), Stop::Step);
    }
    assert_eq!(debugger.value("EO"), Some(sim::PinValue::Number(3.0)));
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Clock(clock)), Stop::Time);
    assert_eq!(look(&mut debugger), before);
}

#[test]
fn a_hand_that_takes_the_supply_away() {
    let scenario = "[[fault]]\non = { pin = \"DI2\" }\nkind = \"power_cut\"\n";
    let mut debugger = with_faults("pmx-2ed", ASCRIPT, &[], scenario);
    for _ in 0..5 {
        assert_eq!(go(&mut debugger, Direction::Forward, Goal::Into), Stop::Step);
    }
    debugger.drive("DI2", Some(sim::PinValue::Level(true))).unwrap();
    let dark = look(&mut debugger);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Into), Stop::Time);
    assert_eq!(go(&mut debugger, Direction::Backward, Goal::Into), Stop::Step);
    assert_ne!(look(&mut debugger), dark);
}

#[test]
fn who_is_interrupted_on_the_way_back_stays() {
    let mut debugger = debugger("pd42-1140", "l: JA l\n", &[]);
    let clock = debugger.clock(3.0);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Clock(clock)), Stop::Time);
    let here = look(&mut debugger);
    let flag = std::sync::Arc::new(true.into());
    debugger.set_interrupt(flag);
    assert_eq!(go(&mut debugger, Direction::Backward, Goal::End), Stop::Interrupted);
    assert_eq!(look(&mut debugger), here);
    assert_eq!(go(&mut debugger, Direction::Backward, Goal::Into), Stop::Step);
}

#[test]
fn breakpoints_and_watches() {
    let mut debugger = debugger("pd42-1140", TMCL, &[]);
    let place = Place { file: 0, line: 18 };
    let number = debugger.break_at(place, None).unwrap().number;
    let mut seen = Vec::new();
    for _ in 0..5 {
        assert_eq!(go(&mut debugger, Direction::Forward, Goal::End), Stop::Breakpoint(number));
        assert_eq!(debugger.place(0), Some(place), "before the first command of the handler");
        seen.push(look(&mut debugger));
    }
    for before in seen.iter().rev().skip(1) {
        assert_eq!(go(&mut debugger, Direction::Backward, Goal::End), Stop::Breakpoint(number));
        assert_eq!(look(&mut debugger), *before);
    }
    assert_eq!(go(&mut debugger, Direction::Backward, Goal::End), Stop::Start);
    assert!(debugger.delete(number) && !debugger.delete(number));

    // A parameter that changes while the program waits.
    let number = debugger.watch("APPositionReached").unwrap().number;
    let stop = go(&mut debugger, Direction::Forward, Goal::End);
    assert!(matches!(&stop, Stop::Watch { number: found, .. } if *found == number), "{stop:?}");
    let first = look(&mut debugger);
    go(&mut debugger, Direction::Forward, Goal::End);
    let stop = go(&mut debugger, Direction::Backward, Goal::End);
    assert!(matches!(stop, Stop::Watch { .. }), "{stop:?}");
    assert_eq!(look(&mut debugger), first);
}

#[test]
fn another_course() {
    let mut debugger = debugger("pmx-2ed", ASCRIPT, &[]);
    let clock = debugger.clock(0.2);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Clock(clock)), Stop::Time);
    let plain = look(&mut debugger);
    debugger.set("V4", "1000").unwrap();
    debugger.drive("DI1", Some(sim::PinValue::Level(true))).unwrap();
    let meddled = look(&mut debugger);
    assert_ne!(plain, meddled);
    let clock = debugger.clock(0.3);
    go(&mut debugger, Direction::Forward, Goal::Clock(clock));
    let later = look(&mut debugger);
    for _ in 0..20 {
        go(&mut debugger, Direction::Backward, Goal::Over);
    }
    go(&mut debugger, Direction::Forward, Goal::Clock(clock));
    assert_eq!(look(&mut debugger), later);
    // Before it was meddled with, and on another way from there.
    let number = debugger.break_at(Place { file: 0, line: 3 }, None).unwrap().number;
    assert_eq!(go(&mut debugger, Direction::Backward, Goal::End), Stop::Breakpoint(number));
    debugger.perform(Act::Load("X".into(), 0.5)).unwrap();
    let clock = debugger.clock(0.2);
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Clock(clock)), Stop::Time);
    assert_eq!(look(&mut debugger), plain);
}

#[test]
fn routines() {
    let mut debugger = debugger("pmx-2ed", ASCRIPT, &[]);
    let clock = debugger.clock(0.001);
    let addresses = vec![debugger.target().code.label("SUB2").unwrap()];
    assert_eq!(go(&mut debugger, Direction::Forward, Goal::Addresses(addresses)), Stop::Step);
    assert!(debugger.point().clock > clock);
    let line = |debugger: &mut Debugger| debugger.place(0).unwrap().line;
    assert_eq!((line(&mut debugger), debugger.frames(0).len()), (23, 2));
    go(&mut debugger, Direction::Forward, Goal::Out);
    assert_eq!(line(&mut debugger), 9);
    go(&mut debugger, Direction::Backward, Goal::Over);
    assert_eq!(line(&mut debugger), 8);
    go(&mut debugger, Direction::Forward, Goal::Into);
    assert_eq!(line(&mut debugger), 23);
    go(&mut debugger, Direction::Forward, Goal::Into);
    go(&mut debugger, Direction::Backward, Goal::Out);
    assert_eq!(line(&mut debugger), 8);
}

/// A watch stops at the clock at which what it looks at changes, and on the way back at the same.
#[track_caller]
fn watched(
    model: &str,
    source: &str,
    inputs: &[&str],
    name: &str,
    skip: usize,
    expected: impl Fn(f64) -> bool,
) {
    let mut debugger = debugger(model, source, inputs);
    let number = debugger.watch(name).unwrap().number;
    let mut seen = Vec::new();
    for _ in 0..skip + 2 {
        let stop = go(&mut debugger, Direction::Forward, Goal::End);
        assert!(matches!(&stop, Stop::Watch { number: found, .. } if *found == number), "{stop:?}");
        seen.push((stop, look(&mut debugger), debugger.seconds()));
    }
    let seconds = seen[skip].2;
    assert!(expected(seconds), "{name}: {seconds}");
    for (stop, state, seconds) in seen.iter().rev().skip(1) {
        assert_eq!(go(&mut debugger, Direction::Backward, Goal::End), *stop, "back to {seconds}");
        assert_eq!(look(&mut debugger), *state);
    }
}

#[test]
fn watches_are_exact() {
    let hz = |seconds: f64| move |at: f64| (at - seconds).abs() < 1e-7;
    // A program that waits in a loop, and pins that change within a line of it.
    let inputs = ["0.1234567:STOP_R=true", "0.1234570:STOP_R=false", "0.2:STOP_R=true"];
    let tmcl = "l: GIO 0, 0\nCOMP 1\nJC NE, l\nSTOP\n";
    watched("pd42-1140", tmcl, &inputs, "STOP_R", 1, hz(0.123_457));
    let inputs = ["0.1234567:DI1=true", "0.1234570:DI1=false", "0.2:DI1=true"];
    let ascript = "PRG 0\nWHILE DI2=0\nENDWHILE\nEND\n";
    for model in ["pmx-2ed", "cmd-4cr"] {
        watched(model, ascript, &inputs, "DI1", 0, hz(0.123_456_7));
    }
    // One that waits for its axis, which goes 1000 pulses a second: there is nothing else to wake up for.
    let cruise = "PRG 0\nEO=3\nHSPD=1000\nLSPD=1000\nACC=100\nX400\nWAITX\nEND\n";
    let mut last = debugger("pmx-2ed", cruise, &[]);
    last.watch("PX").unwrap();
    let mut times = Vec::new();
    for _ in 0..20 {
        go(&mut last, Direction::Forward, Goal::End);
        times.push(last.seconds());
        assert_eq!(last.value("PX"), Some(sim::PinValue::Number(times.len() as f64)));
    }
    for (a, b) in times.iter().zip(&times[1..]) {
        assert!((b - a - 0.001).abs() < 1e-6, "pulse for pulse: {times:?}");
    }
    watched("pmx-2ed", cruise, &[], "PX", 2, |seconds| seconds > 0.0);
}

#[test]
fn registers_of_tmcl_are_set() {
    let mut debugger = debugger("pd42-1140", "CALC LOAD, 5\nCALCX LOAD\nCALC ADD, 1\nAGP 1, 2\nSTOP\n", &[]);
    for _ in 0..2 {
        go(&mut debugger, Direction::Forward, Goal::Into);
    }
    debugger.set("A", "41").unwrap();
    debugger.set("x", "-7").unwrap();
    assert!(debugger.set("EQ", "1").is_err());
    go(&mut debugger, Direction::Forward, Goal::End);
    let values = ["V1", "X", "A"].map(|name| debugger.value(name).unwrap());
    assert_eq!(values, [42.0, -7.0, 42.0].map(sim::PinValue::Number));
    for _ in 0..3 {
        go(&mut debugger, Direction::Backward, Goal::Into);
    }
    go(&mut debugger, Direction::Forward, Goal::End);
    assert_eq!(debugger.value("V1"), Some(sim::PinValue::Number(42.0)), "done once more on the way");
}
