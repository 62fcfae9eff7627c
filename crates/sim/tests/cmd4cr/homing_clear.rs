//! The error clear output at the end of homing and at error stops (2.1.6.1 and appendix A).

use crate::controller::HZ;
use crate::homing::{rig, rig_with};
use crate::rig::Rig;
use devices::{AxisState, Drive};
use motion::{Ticks, Train};
use sim::record::{Mark, RecordError, Recorder};
use std::sync::{Arc, Mutex};

/// The error clear output is on.
const CLEARING: i32 = 1 << 12;

/// What happened to axis X.
#[derive(Default)]
struct Course {
    /// When ERCX came on and went off.
    edges: Vec<(Ticks, bool)>,
    /// When the axis came to rest last.
    rest_at: Ticks,
}

/// Takes down the course of X.
struct Clerk {
    pin: usize,
    course: Arc<Mutex<Course>>,
}

impl Recorder for Clerk {
    fn train(&mut self, _: usize, _: &Train) {}

    fn drive(&mut self, _: Ticks, _: usize, _: Drive) {}

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        if pin == self.pin {
            self.course.lock().unwrap().edges.push((at, level != 0));
        }
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        if axis == 0 && mark != Mark::Started {
            self.course.lock().unwrap().rest_at = at;
        }
    }

    fn sample(&mut self, _: Ticks, _: usize, _: &AxisState) {}

    fn finish(&mut self, _: Ticks) -> Result<(), RecordError> {
        Ok(())
    }
}

fn watch(rig: &mut Rig) -> Arc<Mutex<Course>> {
    let course = Arc::new(Mutex::new(Course::default()));
    let pin = rig.device.pins().iter().position(|pin| pin.name == "ERCX").unwrap();
    rig.device.add_recorder(Box::new(Clerk { pin, course: Arc::clone(&course) }));
    course.lock().unwrap().edges.clear();
    course
}

/// The pulses that the output gives until the axis has been at rest for a while: when each began, in clocks after
/// the axis came to rest (earlier ones are before it), and how long it was.
fn pulses(rig: &mut Rig, command: &str) -> Vec<(i64, Ticks)> {
    let course = watch(rig);
    rig.run(command);
    rig.pass_ms(250);
    let course = course.lock().unwrap();
    let (pairs, rest) = course.edges.as_chunks();
    assert_eq!(rest, [], "every pulse ends");
    let pulse = |&[(from, on), (to, off)]: &[(Ticks, bool); 2]| {
        assert!(on && !off);
        (from.cast_signed() - course.rest_at.cast_signed(), to - from)
    };
    pairs.iter().map(pulse).collect()
}

/// Clocks of some microseconds, up to a whole one.
fn clocks(us: u64) -> u64 {
    (us * HZ).div_ceil(1_000_000)
}

/// Tables 2-14 and 2-15.
#[test]
fn error_clear_outputs() {
    let delays_us = [0, 12, 1600, 104_000];
    let widths_us = [12, 102, 409, 1600, 13_000, 52_000, 104_000];
    for (delay, delay_us) in delays_us.into_iter().enumerate() {
        for (width, width_us) in widths_us.into_iter().enumerate() {
            let mut rig = rig();
            rig.ok(&format!("ERCX=2 ERCDX={delay} ERCPX={width}"));
            let expected = (clocks(delay_us).cast_signed(), clocks(width_us));
            assert_eq!(pulses(&mut rig, "HX+1"), [expected], "{delay_us} us, {width_us} us");
        }
    }
    let mut rig = rig();
    rig.ok("ERCX=3");
    for wrong in ["ERCX=4", "ERCDX=4", "ERCPX=7"] {
        rig.check(wrong, "?Invalid Index");
    }
    rig.check("ERCX", "3");
}

/// Which of the two conditions gives a pulse when.
#[test]
fn occasions() {
    for mode in 0..13 {
        let by_limit = matches!(mode, 6 | 7 | 8 | 12);
        for (conditions, at_limit, at_end) in
            [(0, false, false), (1, true, false), (2, false, true), (3, true, true)]
        {
            let mut rig = rig();
            rig.ok(&format!("ERCX={conditions}"));
            let pulses = pulses(&mut rig, &format!("HX+{mode}"));
            let ends = pulses.iter().filter(|(after, _)| *after >= 0).count();
            let expected = (usize::from(at_limit && by_limit), usize::from(at_end));
            assert_eq!((pulses.len() - ends, ends), expected, "mode {mode}, ERC={conditions}");
        }
    }
}

#[test]
fn error_stops() {
    // Homing that fails ends with the pulse of an error stop and without the other one.
    for (conditions, count) in [(0, 0), (1, 1), (2, 0), (3, 1)] {
        let mut rig = rig_with(|axis| axis.home = [-10, -5]);
        rig.ok(&format!("ERCX={conditions}"));
        assert_eq!(pulses(&mut rig, "HX+1").len(), count, "ERC={conditions}");
        let mut rig = crate::homing::rig();
        rig.ok(&format!("ERCX={conditions}"));
        assert_eq!(pulses(&mut rig, "X5000").len(), count, "ERC={conditions}: no homing");
    }
    let stopped = |stop: &str| {
        let mut rig = rig();
        rig.ok("ERCX=3 HX+1");
        rig.pass_ms(100);
        pulses(&mut rig, stop).len()
    };
    assert_eq!(["STOPX", "ABORTX", "ESTOP"].map(stopped), [0, 0, 1]);
    let mut rig = rig();
    rig.ok("ERCX=2");
    assert_eq!(pulses(&mut rig, "ZMOVEX+").len(), 0, "not homing");
}

/// The status word and the pin, which has a polarity, say the same.
#[test]
fn status_and_polarity() {
    let mut rig = rig();
    rig.ok("ERCX=2 ERCDX=3 ERCPX=5");
    rig.run("HX+1");
    for (ms, on) in [(90, false), (20, true), (40, true), (20, false)] {
        rig.pass_ms(ms);
        assert_eq!((rig.get("MSTX") & CLEARING != 0, rig.level("ERCX")), (on, on));
    }
    rig.ok("POLX=37120");
    assert!(rig.level("ERCX"), "negative now");
    rig.run("X1500");
    rig.run("HX-1");
    rig.pass_ms(110);
    assert_eq!((rig.get("MSTX") & CLEARING, rig.level("ERCX")), (CLEARING, false));
    rig.pass_ms(100);
    assert_eq!((rig.get("MSTX") & CLEARING, rig.level("ERCX")), (0, true));
}
