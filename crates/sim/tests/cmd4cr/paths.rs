//! Interpolated moves: lines, circles, arcs, helices; and those of the buffer.

use crate::controller::AXES;
use crate::rig::Rig;

/// Positions of all axes.
fn at(rig: &mut Rig) -> [i32; 4] {
    let reply = rig.say("PP");
    let numbers: Vec<_> = reply.split(':').map(|number| number.parse().expect("a number")).collect();
    numbers.try_into().expect("four axes")
}

/// Runs a command and gives the positions on the way, a millisecond apart.
#[track_caller]
fn way(rig: &mut Rig, command: &str) -> Vec<[i32; 4]> {
    rig.ok(command);
    let mut positions = Vec::new();
    while AXES.iter().any(|axis| rig.moves(axis)) {
        positions.push(at(rig));
        rig.pass_ms(1);
    }
    positions
}

fn radius(of: [i32; 2], around: [i32; 2]) -> f64 {
    let [x, y] = [0, 1].map(|side| f64::from(of[side]) - f64::from(around[side]));
    f64::hypot(x, y)
}

/// The angle in degrees, from 0 to 360, counter-clockwise from the first axis' positive direction.
fn angle(of: [i32; 2], around: [i32; 2]) -> f64 {
    let [x, y] = [0, 1].map(|side| f64::from(of[side] - around[side]));
    y.atan2(x).to_degrees().rem_euclid(360.0)
}

#[test]
fn lines_need_interpolation() {
    let mut rig = Rig::new();
    rig.check("EINT", "1");
    rig.ok("HSPD=5000 LSPD=500 ACC=100 DEC=100");
    for (command, ends) in [
        ("X3000Y-1000", [3000, -1000, 0, 0]),
        ("Z500X0", [0, -1000, 500, 0]),
        ("U-700Y0Z0", [0, 0, 0, -700]),
        ("X400Y300Z-200U100", [400, 300, -200, 100]),
        ("X0Y0Z0U0", [0; 4]),
    ] {
        let from = at(&mut rig);
        let ways: [i64; 4] = core::array::from_fn(|axis| i64::from(ends[axis] - from[axis]));
        let longest = (0..4).max_by_key(|&axis| ways[axis].abs()).expect("four axes");
        for position in way(&mut rig, command) {
            let made: [i64; 4] = core::array::from_fn(|axis| i64::from(position[axis] - from[axis]));
            for axis in 0..4 {
                // Half a pulse beside the line at the most.
                let beside = made[axis] * ways[longest] - made[longest] * ways[axis];
                assert!(2 * beside.abs() <= ways[longest].abs(), "{command}: {position:?}");
            }
        }
        assert_eq!(at(&mut rig), ends);
    }
    assert!(AXES.iter().all(|axis| rig.shaft(axis) == 0));
    // Without interpolation each axis goes by itself.
    rig.ok("EINT=0 X3000Y300");
    rig.pass_ms(150);
    assert!(rig.get("PY") == 300 || rig.get("PY") * 10 > 2 * rig.get("PX"));
    rig.until_rest();
    assert_eq!(at(&mut rig), [3000, 300, 0, 0]);
}

/// Axes that are not interpolated are free, alone or in another line.
#[test]
fn two_lines_at_once() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 X4000Y2000");
    rig.pass_ms(50);
    rig.ok("Z-3000U1000");
    rig.check("X1Z1", "?Error Moving");
    while rig.moves("X") && rig.moves("Z") {
        let [x, y, z, u] = at(&mut rig);
        assert!((x - 2 * y).abs() <= 1 && (z + 3 * u).abs() <= 2, "{x} {y} {z} {u}");
        rig.pass_ms(5);
    }
    rig.until_rest();
    assert_eq!(at(&mut rig), [4000, 2000, -3000, 1000]);
}

/// The longest axis has the high speed of all axes.
#[test]
fn speeds_of_interpolated_moves() {
    let mut rig = Rig::new();
    rig.ok("HSPD=4000 ACC=50 DEC=50 X8000Y-6000Z2000");
    rig.pass_ms(500);
    assert_eq!([rig.get("PSX"), rig.get("PSY"), rig.get("PSZ"), rig.get("PSU")], [4000, 3000, 1000, 0]);
    rig.until_rest();
    // Of a circle the path has it, whichever way it goes.
    rig.ok("CIRXYP8000:-26000");
    rig.pass_ms(500);
    for _ in 0..20 {
        let from = at(&mut rig);
        rig.pass_ms(500);
        let to = at(&mut rig);
        let way = radius([to[0], to[1]], [from[0], from[1]]);
        assert!((1990.0..=2002.0).contains(&way), "{way}");
    }
    rig.ok("ABORT");
}

#[test]
fn circles() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 LSPD=500 ACC=50 DEC=50 X100Y50Z-20U7");
    rig.until_rest();
    let start = at(&mut rig);
    for first in 0..4 {
        for second in (0..4).filter(|&second| second != first) {
            for turn in ["P", "N"] {
                let names = format!("{}{}", AXES[first], AXES[second]);
                let centre = [start[first] - 300, start[second] + 400];
                let command = format!("CIR{names}{turn}{}:{}", centre[0], centre[1]);
                let mut last = angle([start[first], start[second]], centre);
                let mut turned = 0.0;
                for position in way(&mut rig, &command) {
                    let of = [position[first], position[second]];
                    assert!((radius(of, centre) - 500.0).abs() <= 0.71, "{command}: {of:?}");
                    let now = angle(of, centre);
                    turned += (now - last + 180.0).rem_euclid(360.0) - 180.0;
                    last = now;
                    // The others stay.
                    for axis in (0..4).filter(|&axis| axis != first && axis != second) {
                        assert_eq!(position[axis], start[axis]);
                    }
                }
                let all = if turn == "P" { -360.0 } else { 360.0 };
                assert!(f64::abs(turned - all) < 3.0, "{command}: {turned}");
                assert_eq!(at(&mut rig), start, "{command}");
            }
        }
    }
}

#[test]
fn arcs() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 LSPD=500 ACC=50 DEC=50");
    // The manual's example (2.3.2.1): from 0 to 90 degrees clockwise is three quarters, counter-clockwise one.
    let mut check = |command: &str, turned: f64, end: [i32; 2]| {
        rig.run("X1000Y0");
        let mut last = 0.0;
        let mut sum = 0.0;
        for position in way(&mut rig, command) {
            let of = [position[0], position[1]];
            assert!((radius(of, [0, 0]) - 1000.0).abs() <= 0.71, "{command}: {of:?}");
            let now = angle(of, [0, 0]);
            sum += (now - last + 180.0).rem_euclid(360.0) - 180.0;
            last = now;
        }
        assert!(f64::abs(sum - turned) < 2.0, "{command}: {sum}");
        assert_eq!(at(&mut rig)[..2], end, "{command}");
    };
    check("ARCXYP0:0:90000", -270.0, [0, 1000]);
    check("ARCXYN0:0:90000", 90.0, [0, 1000]);
    check("ARCXYN0:0:45000", 45.0, [707, 707]);
    check("ARCXYP0:0:180000", -180.0, [-1000, 0]);
    check("ARCXYP0:0:-90000", -90.0, [0, -1000]);
    check("ARCXYN0:0:270000", 270.0, [0, -1000]);
    // An arc to where the axes are is none; only CIR goes all around.
    rig.run("X1000Y0");
    rig.ok("ARCXYP0:0:0");
    assert!(!rig.moves("X"));
    // Other axes, in the other order: the first one is to the right.
    rig.run("ARCUZN0:500:0");
    assert_eq!(at(&mut rig)[2..], [500, 500]);
}

/// X and Y turn, Z goes along evenly, U is used up but stays.
#[test]
fn helices() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 LSPD=500 ACC=50 DEC=50 X500");
    rig.until_rest();
    let mut check = |command: &str, around: f64, ends: [i32; 4]| {
        let from = at(&mut rig);
        let (mut last, mut sum) = (angle([from[0], from[1]], [0, 0]), 0.0);
        for position in way(&mut rig, command) {
            let of = [position[0], position[1]];
            assert!((radius(of, [0, 0]) - 500.0).abs() <= 0.71, "{command}: {of:?}");
            let now = angle(of, [0, 0]);
            sum += (now - last + 180.0).rem_euclid(360.0) - 180.0;
            last = now;
            let rise = f64::from(position[2] - from[2]) / f64::from(ends[2] - from[2]);
            assert!((rise - sum / around).abs() < 0.02, "{command}: {rise} {}", sum / around);
            assert_eq!(position[3], 0);
        }
        assert_eq!(at(&mut rig), ends, "{command}");
    };
    check("CIRTP0:0:300", -360.0, [500, 0, 300, 0]);
    check("CIRTN0:0:-300", 360.0, [500, 0, -300, 0]);
    check("ARCTN0:0:90000:100", 90.0, [0, 500, 100, 0]);
    check("ARCTP0:0:180000:0", -270.0, [-500, 0, 0, 0]);
    // While it turns, U cannot move; nor does it turn while U moves.
    rig.ok("CIRTP0:0:300");
    rig.check("U100", "?Error Moving");
    rig.until_rest();
    rig.ok("U1000");
    rig.check("CIRTP0:0:0", "?Error Moving");
    rig.until_rest();
}

/// On a helix that rises more than it turns Z is the faster one, but not faster than an axis can be; then the turn
/// takes longer.
#[test]
fn steep_helices() {
    for buffered in [false, true] {
        let mut rig = Rig::with(|axis| axis.positive_limit = 10_000_000);
        rig.ok("HSPD=1000 LSPD=1000");
        let mut ms = |command: &str| {
            if buffered {
                rig.ok("BO ABS");
                rig.ok(command);
                rig.run("BSTART")
            } else {
                rig.run(command)
            }
        };
        // 628 pulses around.
        assert!((628..=630).contains(&ms("CIRTP100:0:100000")));
        let ms = ms("CIRTP100:0:6653500");
        assert!((1000..=1005).contains(&ms), "{ms}");
        rig.check("PP", "0:0:6653500:0");
    }
}

/// Moves of the buffer follow each other without a pause, each with its own speed.
#[test]
fn buffered_moves() {
    let mut rig = Rig::new();
    rig.check("BSTAT", "0:0:0:100");
    rig.ok("BO");
    rig.check("BSTAT", "1:0:0:100");
    rig.ok("I1000:0:0:1000 I1000:500:0:2000 I0:0:250:4000 HSPD=1000 CIRXYN100:0 X0Y0Z0");
    rig.check("BSTAT", "1:0:5:95");
    rig.pass_ms(100);
    rig.check("PP", "0:0:0:0");
    // Lines of 1000, 500 and 1000 pulses: 1 s, 250 ms, 250 ms; then a circle of 628 pulses at 1000 pps and the
    // way back of 250.
    rig.ok("BSTART");
    rig.pass_ms(500);
    assert_eq!((rig.get("PSX"), at(&mut rig)[0].abs_diff(500) <= 1), (1000, true));
    rig.pass_ms(625);
    assert_eq!((rig.get("PSY"), at(&mut rig)[1].abs_diff(250) <= 2), (2000, true));
    rig.check("BSTAT", "1:2:5:97");
    rig.pass_ms(250);
    let [x, y, z, _] = at(&mut rig);
    assert!(x.abs_diff(500) <= 3 && y.abs_diff(250) <= 2 && z.abs_diff(125) <= 2, "{x} {y} {z}");
    rig.pass_ms(125 + 314);
    let [x, y, z, _] = at(&mut rig);
    assert!(x.abs_diff(200) <= 2 && y.abs_diff(0) <= 6 && z == 250, "{x} {y} {z}");
    // More can be added while it runs.
    rig.ok("I0:0:100:1000");
    rig.pass_ms(314 + 250 + 100 + 4);
    assert!(AXES.iter().all(|axis| !rig.moves(axis)));
    rig.check("PP", "0:0:100:0");
    rig.check("BSTAT", "1:6:6:100");
    // What comes later waits for another start.
    rig.ok("I0:0:0:1000");
    rig.pass_ms(200);
    rig.check("PP", "0:0:100:0");
    rig.ok("BSTART");
    rig.until_rest();
    rig.check("PP", "0:0:0:0");
    rig.ok("BF");
    assert!(rig.say("BSTAT").starts_with("0:"));
}

/// The hundred registers in one go, and a hundred more while they run.
#[test]
fn a_long_contour() {
    let mut rig = Rig::new();
    rig.ok("BO");
    for x in 1..=100 {
        rig.ok(&format!("I{}:{}:0:1000", 10 * x, x % 2));
    }
    rig.ok("BSTART");
    let mut added = 100;
    while added < 200 {
        if rig.say(&format!("I{}:{}:0:1000", 10 * (added + 1), (added + 1) % 2)) == "OK" {
            added += 1;
        } else {
            rig.pass_ms(5);
        }
    }
    // Two thousand pulses at a thousand a second, never a pause.
    rig.until_rest();
    rig.check("PP", "2000:0:0:0");
    let ms = (rig.device.seconds() * 1000.0).round();
    assert!((2000.0..=2002.0).contains(&ms), "{ms}");
}

/// What the buffer does not take, and what ends it.
#[test]
fn the_buffer_and_other_motions() {
    let mut rig = Rig::new();
    rig.ok("BO");
    for refused in ["X1U1", "CIRXUP0:5", "ARCZUP0:5:0"] {
        rig.check(refused, "?Buffer Enabled");
    }
    rig.check("I1:2:3:0", "?Invalid Index");
    rig.check("I1:2:3:6553501", "?Invalid Index");
    rig.check("I1:2:3:-5", "?Invalid Index");
    rig.check("BSTAT", "1:0:0:100");
    rig.check("SLX=1", "?Buffer Enabled");
    // A stop forgets what waits.
    rig.ok("I5000:0:0:1000 I0:0:0:1000 BSTART");
    rig.pass_ms(500);
    rig.ok("STOPX");
    rig.until_rest();
    let stood = rig.get("PX");
    rig.pass_ms(1000);
    assert_eq!(rig.get("PX"), stood);
    assert!(rig.say("BSTAT").ends_with(":100"));
    // So do an error and BF.
    rig.ok("I9000:0:0:1000 I0:0:0:1000 BSTART");
    rig.pass_ms(100);
    rig.pin("+LX", true);
    rig.pin("+LX", false);
    rig.pass_ms(100);
    assert!(!rig.moves("X") && rig.say("BSTAT").ends_with(":100"));
    rig.ok("CLRX I9000:0:0:1000 I0:0:0:1000 BSTART");
    rig.pass_ms(100);
    // The move that is on goes to its end.
    rig.ok("BF");
    rig.until_rest();
    rig.check("PX", "9000");
    // StepNLoop and the buffer exclude each other.
    rig.ok("SLZ=1");
    rig.check("BO", "?Error SNL");
}
