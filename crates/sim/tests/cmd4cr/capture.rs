//! Position latches and synchronisation outputs.

use crate::controller::{AXES, HZ};
use crate::rig::Rig;

#[test]
fn latches() {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 0.5);
    for (number, axis) in AXES.into_iter().enumerate() {
        let [enable, status, position, encoder] =
            ["LT", "LTS", "LTP", "LTE"].map(|name| format!("{name}{axis}"));
        let input = format!("DI{}", number + 1);
        rig.check(&status, "0");
        rig.ok(&format!("{enable}=1 J{axis}+"));
        rig.check(&status, "1");
        rig.pass_ms(1234);
        // What is on already is no edge; the other inputs are not its own.
        rig.pin(&format!("DI{}", (number + 1) % 4 + 1), true);
        rig.check(&status, "1");
        let at = [rig.get(&format!("P{axis}")), rig.get(&format!("E{axis}"))];
        rig.pin(&input, true);
        rig.pass_ms(100);
        rig.check(&status, "2");
        assert_eq!([rig.get(&position), rig.get(&encoder)], at);
        assert!(rig.get(&format!("P{axis}")) > at[0]);
        // Once; another edge changes nothing.
        rig.pin(&input, false);
        rig.pin(&input, true);
        rig.check(&position, &at[0].to_string());
        // Off and on: it waits for the next edge.
        rig.ok(&format!("{enable}=0"));
        rig.check(&status, "0");
        rig.ok(&format!("{enable}=1"));
        rig.check(&status, "1");
        rig.pin(&input, false);
        rig.pin(&input, true);
        rig.check(&status, "2");
        assert!(rig.get(&position) > at[0]);
        rig.ok("ABORT");
        for bit in 1..=4 {
            rig.pin(&format!("DI{bit}"), false);
        }
    }
    rig.check("LTX=2", "?Invalid Index");
}

/// The position is that of the edge, also where nobody looks for a long time.
#[test]
fn a_latch_is_exact() {
    let mut rig = Rig::new();
    rig.ok("HSPD=100000 LSPD=100000 LTX=1 JX+");
    let start = rig.device.now();
    let at = start + HZ * 7777 / 10_000;
    let input = sim::Input { pin: "DI1".into(), value: Some(sim::PinValue::Level(true)) };
    rig.device.schedule(at, &input).expect("an input");
    rig.pass_ms(2000);
    // A pulse every 196.608 clocks.
    let expected = (at - start) as i64 * 100_000 / HZ as i64;
    assert!((i64::from(rig.get("LTPX")) - expected).abs() <= 1, "{}", rig.get("LTPX"));
    assert_eq!(rig.get("LTEX"), rig.get("LTPX"));
    assert!(rig.get("PX") > 199_000);
    rig.ok("ABORT");
}

/// Conditions 1 to 3, by the pulse counter and by the encoder.
#[test]
fn synchronisation_outputs() {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 2.0);
    rig.ok("HSPD=2000 LSPD=2000");
    for (number, axis) in AXES.into_iter().enumerate() {
        let output = format!("DO{}", number + 1);
        let status = format!("SYNS{axis}");
        for (mode, holds) in
            [(1, i32::eq as fn(&i32, &i32) -> bool), (2, i32::lt as fn(&i32, &i32) -> bool), (3, i32::gt)]
        {
            for (source, counter) in [(0, "P"), (8, "E")] {
                rig.ok(&format!("SYNC{axis}={} SYNP{axis}=51", mode + source));
                rig.check(&status, "0");
                assert!(!rig.level(&output));
                rig.ok(&format!("SYNO{axis} {axis}60"));
                let mut met = false;
                while rig.moves(axis) {
                    let count = rig.get(&format!("{counter}{axis}"));
                    met |= holds(&count, &51);
                    assert_eq!(rig.level(&output), holds(&count, &51), "mode {mode} of {counter} at {count}");
                    // It stays established once it was.
                    if met {
                        rig.check(&status, "2");
                    }
                    rig.pass_us(500);
                }
                // In encoder counts 51 is never met: it counts by two. The condition 1 waits then.
                if (mode, source) != (1, 8) {
                    rig.check(&status, "2");
                }
                rig.ok(&format!("SYNF{axis}"));
                rig.check(&status, "0");
                assert!(!rig.level(&output));
                rig.run(&format!("{axis}0"));
            }
        }
    }
    // Condition 0 never holds.
    rig.ok("SYNCX=0 SYNOX");
    rig.run("X100");
    rig.check("SYNSX", "1");
}

/// While it is on, the output is not set by hand; afterwards it is as it was.
#[test]
fn a_synchronised_output_has_one_master() {
    let mut rig = Rig::new();
    rig.ok("DO=9 SYNCX=3 SYNPX=1000000 SYNOX");
    assert!(!rig.level("DO1"));
    rig.check("DO", "8");
    rig.check("DO1=1", "?Invalid Index");
    rig.ok("DO=7 DO4=0");
    rig.check("DO", "6");
    rig.ok("SYNPX=-1");
    rig.check("DO", "7");
    rig.ok("DOP=1");
    assert!(!rig.level("DO1") && !rig.level("DO2") && rig.level("DO4"));
    rig.ok("DOP=0 SYNFX");
    rig.check("DO", "7");
    rig.ok("DO1=0");
    rig.check("DO", "6");
}

/// Clocks and positions of the rising edges of an output while X moves.
fn edges(rig: &mut Rig, output: &str) -> Vec<(u64, i32)> {
    let mut edges = Vec::new();
    let (mut was, mut moving) = (false, true);
    // The last pulse counts too.
    while moving {
        moving = rig.moves("X");
        let on = rig.level(output);
        if on && !was {
            edges.push((rig.device.now(), rig.get("PX")));
        }
        was = on;
        rig.device.advance(rig.device.now() + 50);
    }
    edges
}

#[test]
fn continuous_synchronisation() {
    let mut rig = Rig::new();
    rig.ok("HSPD=10000 LSPD=10000 PX=7 SYNCX=4 SYNPX=100 SYNOX X1000");
    let positions: Vec<_> = edges(&mut rig, "DO1").into_iter().map(|(_, position)| position).collect();
    // At every multiple from where it was switched on.
    assert_eq!(positions, [107, 207, 307, 407, 507, 607, 707, 807, 907]);
    rig.check("SYNSX", "2");
    // Backwards too.
    rig.ok("X700");
    let positions: Vec<_> = edges(&mut rig, "DO1").into_iter().map(|(_, position)| position).collect();
    assert_eq!(positions, [907, 807, 707]);
    // A pulse is 10 us long.
    rig.ok("X1000");
    while !rig.level("DO1") {
        rig.device.advance(rig.device.now() + 1);
    }
    let start = rig.device.now();
    while rig.level("DO1") {
        rig.device.advance(rig.device.now() + 1);
    }
    assert_eq!(rig.device.now() - start, 197);
    rig.ok("ABORT");
}

/// Pulses come inside the window only; outside the multiples go on.
#[test]
fn the_synchronisation_window() {
    let mut rig = Rig::new();
    rig.ok("HSPD=10000 LSPD=10000 SYNCX=4 SYNPX=100 SYNMINX=250 SYNMAXX=500 SYNWOX X1000");
    let at = |edges: Vec<(u64, i32)>| edges.into_iter().map(|(_, position)| position).collect::<Vec<_>>();
    let inside = edges(&mut rig, "DO1");
    assert_eq!(at(inside), [300, 400, 500]);
    // Without it they come everywhere, where they would have come.
    rig.ok("SYNWFX X600");
    let all = edges(&mut rig, "DO1");
    assert_eq!(at(all), [900, 800, 700, 600]);
    rig.pass_ms(1);
    rig.ok("SYNWOX X400");
    let again = edges(&mut rig, "DO1");
    assert_eq!(at(again), [500, 400]);
    // SYNF ends it all.
    rig.ok("SYNFX");
    rig.check("SYNSX", "0");
    rig.ok("X0");
    let none = edges(&mut rig, "DO1");
    assert_eq!(at(none), [0; 0]);
}
