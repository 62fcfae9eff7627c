//! The ten programs of section 5.4 and what they do.

use crate::ascii::examples::{self, turns};
use crate::rig::Rig;
use devices::ProgramRun;

macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../../examples/ascript/commander/", $name, ".prg"))
    };
}

#[test]
fn example_1_there_and_back() {
    examples::there_and_back(example!("there_and_back"));
}

/// Seven lines without a pause, each with the speed in force when it was added.
#[test]
fn example_2_buffered_contour() {
    let mut rig = Rig::new();
    rig.start(1, example!("buffered_contour"));
    rig.pass_ms(100);
    rig.check("SASTAT1", "1");
    // Corners of X, speeds of the lines that lead to them.
    let lines = [(1000, 100), (2000, 200), (3000, 300), (4000, 400), (5000, 500), (3000, 400), (0, 300)];
    let (mut from, mut ms) = (0, 100);
    for (line, (to, speed)) in lines.into_iter().enumerate() {
        let time = i32::abs(to - from) * 1000 / speed;
        rig.pass_ms((time / 2) as u64 - ms);
        let state = rig.device.axis(0);
        assert_eq!(state.speed_mpps.unsigned_abs().div_ceil(1000), speed as u64, "line {line}");
        // It is half way, to the pulse before or behind.
        assert!((state.position - (from + to) / 2).abs() <= 4, "line {line}: {state:?}");
        assert_eq!(rig.say("BSTAT").split(':').next(), Some("1"));
        rig.pass_ms((time - time / 2) as u64);
        (from, ms) = (to, 0);
    }
    rig.pass_ms(20);
    rig.check("PP", "0:100:100:0");
    rig.check("SASTAT1", "0");
    let status = rig.say("BSTAT");
    assert!(status.starts_with("0:") && status.ends_with(":100"), "{status}");
}

#[test]
fn example_3_endless_moves() {
    examples::endless_moves(1, example!("endless_moves"));
}

#[test]
fn example_4_counted_moves() {
    examples::counted_moves(1, example!("counted_moves"));
}

#[test]
fn example_5_moves_on_input() {
    examples::moves_on_input(2, example!("moves_on_input"));
}

#[test]
fn example_6_step_on_edge() {
    examples::step_on_edge(example!("step_on_edge"));
}

#[test]
fn example_7_positions_by_input() {
    let mut rig = Rig::with(|axis| axis.home = [-700, -600]);
    rig.start(2, example!("positions_by_input"));
    for (input, position) in [("DI1", 2000), ("DI2", 4000), ("DI3", 6000), ("DI1", 2000)] {
        rig.pin(input, true);
        rig.pass_ms(50);
        rig.check("DO1", "1");
        rig.pass_ms(1950);
        rig.pin(input, false);
        rig.pass_ms(10);
        rig.check("PX", &position.to_string());
        rig.check("DO", "0");
    }
    // DI4 homes in the negative direction: zero is at the switch.
    rig.pin("DI4", true);
    rig.pass_ms(10);
    rig.pin("DI4", false);
    rig.pass_ms(3000);
    assert_eq!(rig.shaft("X") - i64::from(rig.get("PX")), -600);
    rig.pin("DI2", true);
    rig.pass_ms(2000);
    rig.pin("DI2", false);
    rig.check("PX", "4000");
    // An error on the way: SUB 31 clears it, goes back to 0 and switches output 2 on.
    rig.pin("DI3", true);
    rig.pass_ms(200);
    rig.pin("DI3", false);
    rig.pin("+LX", true);
    rig.pass_ms(1);
    rig.pin("+LX", false);
    rig.pass_ms(2000);
    assert_eq!((rig.get("PX"), rig.get("DO2"), rig.get("MSTX") & 0x307), (0, 1, 0));
    rig.check("SASTAT2", "1");
}

#[test]
fn example_8_stop_by_input() {
    examples::stop_by_input(example!("stop_by_input"));
}

/// SUB 31 is quicker than program 1: it clears the alarm's bit before anybody reads it.
#[test]
fn example_9_alarm() {
    let mut rig = Rig::with(|axis| axis.negative_limit = -500);
    rig.start(0, example!("alarm"));
    rig.ok("SACTRL1=1");
    let homed = turns(&mut rig, 3000);
    // Zero is where the limit switch goes off.
    assert_eq!(rig.shaft("X") - i64::from(rig.get("PX")), -499);
    assert!(homed.len() > 1, "{homed:?}");
    while rig.get("PX") < 500 {
        rig.pass_ms(1);
    }
    rig.pin("ALMX", true);
    rig.pass_us(10);
    assert!(!rig.moves("X"));
    rig.pin("ALMX", false);
    rig.pass_ms(2);
    rig.check("DO2", "1");
    // It has gone back to 0, and on with its round.
    assert!(turns(&mut rig, 5000).len() > 2);
    assert_eq!((rig.get("SASTAT0"), rig.get("SASTAT1"), rig.get("MSTX") & 1024), (1, 1, 0));
}

/// Program 1 of the same example, where there is no SUB 31.
#[test]
fn example_9_alarm_watched_by_a_program() {
    let mut rig = Rig::with(|axis| axis.negative_limit = -500);
    let (programs, _) = example!("alarm").split_once("; Errors.").expect("the example has a SUB 31");
    rig.start(0, programs);
    rig.ok("SACTRL1=1 DO=15");
    turns(&mut rig, 3000);
    while rig.get("PX") < 500 {
        rig.pass_ms(1);
    }
    rig.pin("ALMX", true);
    rig.pass_ms(2);
    rig.pin("ALMX", false);
    // Program 1 has stopped program 0 and waits three seconds.
    assert_eq!((rig.get("SASTAT0"), rig.get("SASTAT1"), rig.get("DO")), (0, 1, 0));
    assert_eq!(rig.get("MSTX") & 1031, 1024);
    rig.pass_ms(2990);
    assert_eq!((rig.get("SASTAT0"), rig.get("MSTX") & 1024), (0, 1024));
    rig.pass_ms(20);
    assert_eq!((rig.get("SASTAT0"), rig.get("MSTX") & 1024, rig.get("DO")), (1, 0, 1));
    assert!(turns(&mut rig, 8000).len() > 3);
}

/// A circle, a line and an arc with the laser on, its ways between them in the dark; the lights meanwhile.
#[test]
fn example_10_laser() {
    let mut rig = Rig::with(|axis| axis.negative_limit = -20_000);
    rig.ok("EO=0 IOCFG=255");
    rig.start(1, example!("laser"));
    rig.ok("SACTRL3=1");
    for lights in [64, 80, 84, 85] {
        rig.pass_ms(350);
        rig.check("IO", &lights.to_string());
        rig.pass_ms(350);
    }
    assert!((0..40).any(|_| {
        rig.pass_ms(25);
        rig.get("IO") == 0
    }));
    // What the laser draws, sampled.
    let mut figures: Vec<Vec<[i32; 2]>> = Vec::new();
    let mut was = false;
    for _ in 0..48_000 {
        rig.pass_ms(5);
        let on = rig.level("DO2");
        let at = [0, 1].map(|axis| rig.device.axis(axis).position);
        if on && !was {
            figures.push(Vec::new());
        }
        // The laser goes out where the figure ends, a while before the next way begins.
        if on || was {
            figures.last_mut().expect("a figure has begun").push(at);
        }
        if was && !on && figures.len() == 3 {
            break;
        }
        was = on;
    }
    assert_eq!(figures.len(), 3);
    let distance = |at: &[i32; 2], to: [i32; 2]| {
        f64::hypot(f64::from(at[0]) - f64::from(to[0]), f64::from(at[1]) - f64::from(to[1]))
    };
    let circle = [487_659, 562_431];
    let radius = distance(&[85_610, 562_530], circle);
    assert!(figures[0].iter().all(|at| (distance(at, circle) - radius).abs() <= 0.71));
    assert!(figures[0].iter().any(|at| at[0] > 889_000), "all around");
    assert_eq!(figures[0].last(), Some(&[85_610, 562_530]));
    assert_eq!(figures[1].first(), Some(&[100_000, 100_000]));
    assert_eq!(figures[1].last(), Some(&[909_000, 642_390]));
    let slope = 542_390.0 / 809_000.0;
    let beside = |at: &[i32; 2]| f64::from(at[1] - 100_000) - slope * f64::from(at[0] - 100_000);
    assert!(figures[1].iter().all(|at| beside(at).abs() <= 0.51));
    let arc = [288_899, 267_403];
    let radius = distance(&[430_589, 20_623], arc);
    assert!(figures[2].iter().all(|at| (distance(at, arc) - radius).abs() <= 0.71));
    // At 95 degrees.
    let angle = 95f64.to_radians();
    let end = [angle.cos(), angle.sin()].map(|part| part * radius);
    let last = figures[2].last().expect("it was drawn");
    assert!((f64::from(last[0] - arc[0]) - end[0]).abs() <= 1.0, "{last:?}");
    assert!((f64::from(last[1] - arc[1]) - end[1]).abs() <= 1.0, "{last:?}");
    // An error ends it all, in the dark.
    rig.pass_ms(5000);
    rig.pin("CEMG", true);
    rig.pass_ms(5);
    let stopped = [1, 3].map(|number| rig.device.program(number).expect("a program").run);
    assert_eq!(stopped, [ProgramRun::Idle; 2]);
    assert_eq!((rig.get("IO"), rig.get("DO2"), rig.get("MSTX") & 1 << 16), (0, 0, 0));
    assert!(!rig.moves("X") && !rig.moves("Y"));
}
