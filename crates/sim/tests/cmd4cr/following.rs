//! Axes that follow a joystick or a manual pulse generator, and motions that wait for the external start.

use crate::ascii::joystick::{speed, with_joystick};
use crate::controller::AXES;
use crate::rig::Rig;
use sim::{Scenario, fault::scenario::no_source};

#[test]
fn joysticks_of_some_axes() {
    let mut rig = with_joystick();
    rig.ok("SLX=1 SLY=1 JENA=2");
    rig.check("SLX", "1");
    rig.check("SLY", "0");
    rig.run("X100");
    rig.run("Z10");
    rig.pass_ms(50);
    rig.check("Y100", "?Error Moving");
    rig.ok("JX+");
    rig.check("JENA=3", "?Error Moving");
    rig.check("JENA", "2");
    rig.ok("ABORTX JENA=0");
}

/// `JMAX` below `JMIN` turns the direction round; both may be anywhere (manual, 2.5.1.1).
#[test]
fn the_joysticks_voltages() {
    let mut rig = with_joystick();
    rig.ok("JTOLX=50 JMAXX=3250 JMINX=10 JENA=1");
    assert_eq!(speed(&mut rig, "AI1", 3250.0), 5000);
    // The manual's example: the zone is from 1580 to 1680 mV.
    assert_eq!(speed(&mut rig, "AI1", 1580.0), 0);
    assert_eq!(speed(&mut rig, "AI1", 1680.0), 0);
    assert!(speed(&mut rig, "AI1", 1690.0) > 0);
    assert!(speed(&mut rig, "AI1", 1570.0) < 0);
    rig.ok("JMAXX=10 JMINX=3250");
    assert_eq!(speed(&mut rig, "AI1", 3250.0), -5000);
    assert_eq!(speed(&mut rig, "AI1", 0.0), 5000);
    assert_eq!(speed(&mut rig, "AI1", 1630.0), 0);
}

/// Turns the wheel and waits until all is done.
fn turn(rig: &mut Rig, axis: &str, counts: i64) {
    rig.device.pulser(axis, counts).expect("an MPG input");
    rig.pass_ms(3000);
}

/// What a scenario turns the axis follows, as what a hand turns.
#[test]
fn hand_wheels() {
    let mut rig = Rig::new();
    rig.ok("HSPD=20000 MPEX=1");
    let fault = |text: &str| {
        let devices = [rig.device.config().clone()];
        let scenario = Scenario::parse(&format!("[[fault]]\n{text}"), "test", &devices, &no_source);
        scenario.unwrap_or_else(|error| panic!("{error}")).faults[0].1.clone()
    };
    let first = fault("kind = 'hand_wheel'\naxis = 'X'\ncounts = 100\nat = 0.5");
    let back = fault("kind = 'hand_wheel'\naxis = 'X'\ncounts = -30\non = { axis = 'X', position = 80 }");
    rig.device.plan(&first).unwrap();
    rig.device.plan(&back).unwrap();
    rig.pass_ms(499);
    rig.check("PX", "0");
    rig.pass_ms(3000);
    rig.check("PX", "70");
    assert_eq!(rig.shaft("X"), 70);
    assert!(rig.device.faults().is_empty(), "it is a moment, not a state");
}

#[test]
fn the_manual_pulse_generator() {
    let mut rig = Rig::new();
    rig.ok("HSPD=20000");
    for axis in AXES {
        let [position, output] = ["P", "MP"].map(|name| format!("{name}{axis}"));
        // Off, it counts nothing and moves nothing.
        turn(&mut rig, axis, 100);
        rig.check(&output, "0");
        rig.ok(&format!("MPE{axis}=1"));
        turn(&mut rig, axis, 100);
        rig.check(&output, "100");
        rig.check(&position, "100");
        // The manual's example (2.5.2.2): 100 counts become 125 pulses.
        rig.ok(&format!("MPM{axis}=5 MPD{axis}=512"));
        turn(&mut rig, axis, 100);
        rig.check(&position, "225");
        rig.check(&output, "225");
        turn(&mut rig, axis, -200);
        rig.check(&position, "-25");
        // Fractions are not lost.
        rig.ok(&format!("MPM{axis}=1 MPD{axis}=1024"));
        for _ in 0..10 {
            turn(&mut rig, axis, 1);
        }
        rig.check(&position, "-20");
        rig.ok(&format!("MP{axis}=7"));
        rig.check(&output, "7");
        rig.check(&position, "-20");
        assert_eq!(rig.shaft(axis), -20);
        for refused in ["J+", "T5", "100"] {
            let command = match refused {
                "J+" => format!("J{axis}+"),
                "T5" => continue,
                target => format!("{axis}{target}"),
            };
            rig.check(&command, "?Error Moving");
        }
        rig.ok(&format!("MPE{axis}=0"));
        turn(&mut rig, axis, 100);
        rig.check(&position, "-20");
        rig.run(&format!("{axis}0"));
    }
}

/// Single, double, fourfold counting, two pulses; and the direction.
#[test]
fn inputs_of_the_manual_pulse_generator() {
    let mut rig = Rig::new();
    rig.ok("HSPD=20000 MPEX=1");
    for (mode, pulses) in [(0, 100), (1, 200), (2, 400), (3, 400)] {
        for (direction, way) in [(0, 1), (1 << 14, -1)] {
            rig.ok(&format!("POLX={} PX=0", mode << 15 | direction | 2 << 11));
            turn(&mut rig, "X", 400);
            assert_eq!(rig.get("PX"), way * pulses, "mode {mode}");
        }
    }
}

#[test]
fn a_manual_pulse_generator_runs_into_a_limit() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 500);
    rig.ok("HSPD=20000 MPEX=1");
    turn(&mut rig, "X", 800);
    rig.check("PX", "500");
    assert_eq!(rig.get("MSTX") & 0x110, 0x110);
    turn(&mut rig, "X", -100);
    rig.check("PX", "500");
    rig.ok("CLRX");
    turn(&mut rig, "X", -100);
    rig.check("PX", "400");
}

/// Up to three motions wait, and start one at a time.
#[test]
fn external_start() {
    const WAITS: i32 = 1 << 19;
    let mut rig = Rig::new();
    let start = |rig: &mut Rig| {
        rig.pin("CSTA", true);
        rig.pass_ms(1);
        rig.pin("CSTA", false);
    };
    rig.ok("HSPD=5000 EXST=1 X1000 Y500Z-500 X0");
    rig.check("U1", "?Buffer Full");
    rig.pass_ms(1000);
    rig.check("PP", "0:0:0:0");
    let waiting = |rig: &mut Rig| AXES.map(|axis| rig.get(&format!("MST{axis}")) & WAITS != 0);
    assert_eq!(waiting(&mut rig), [true, true, true, false]);
    start(&mut rig);
    assert!(rig.until_rest() > 300);
    rig.check("PP", "1000:0:0:0");
    assert_eq!(waiting(&mut rig), [true, true, true, false]);
    start(&mut rig);
    rig.until_rest();
    rig.check("PP", "1000:500:-500:0");
    assert_eq!(waiting(&mut rig), [true, false, false, false]);
    start(&mut rig);
    rig.until_rest();
    rig.check("PP", "0:500:-500:0");
    assert_eq!(waiting(&mut rig), [false; 4]);
    // Every kind of motion waits; a stop forgets those of its axis.
    rig.ok("JX+ HY-0 CIRZUP0:0");
    rig.ok("STOPY");
    assert_eq!(waiting(&mut rig), [true, false, true, true]);
    start(&mut rig);
    assert!(rig.moves("X"));
    start(&mut rig);
    rig.pass_ms(50);
    assert!(rig.moves("Z") && rig.moves("U") && !rig.moves("Y"));
    rig.ok("ABORT EXST=0 Y0");
    rig.until_rest();
    rig.check("PY", "0");
}
