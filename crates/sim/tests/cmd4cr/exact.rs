//! What happens in the very clock of a pulse, as a recording sees it, and whatever the pace at which somebody
//! looks: synchronisation outputs, and axes that follow an encoder.

use crate::controller::HZ;
use crate::rig::Rig;
use devices::{AxisState, Drive};
use motion::{Ticks, Train};
use proptest::prelude::*;
use sim::record::{Mark, RecordError, Recorder};
use sim::{AxisConfig, PinValue};
use std::sync::{Arc, Mutex};

/// The pulses of all axes and the levels of all pins.
#[derive(Clone, Default)]
struct Log(Arc<Mutex<Events>>);

#[derive(Default)]
struct Events {
    /// Axis, clock and direction.
    pulses: Vec<(usize, Ticks, i64)>,
    /// Clock, pin and level.
    pins: Vec<(Ticks, usize, i32)>,
}

impl Recorder for Log {
    fn train(&mut self, axis: usize, train: &Train) {
        let edges = train.edges().map(|clock| (axis, clock, train.direction.sign()));
        self.0.lock().unwrap().pulses.extend(edges);
    }

    fn drive(&mut self, _: Ticks, _: usize, _: Drive) {}

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        self.0.lock().unwrap().pins.push((at, pin, level));
    }

    fn mark(&mut self, _: Ticks, _: usize, _: Mark) {}

    fn sample(&mut self, _: Ticks, _: usize, _: &AxisState) {}

    fn finish(&mut self, _: Ticks) -> Result<(), RecordError> {
        Ok(())
    }
}

impl Log {
    /// The clocks of an axis' pulses with their directions.
    fn pulses(&self, axis: usize) -> Vec<(Ticks, i64)> {
        let events = self.0.lock().unwrap();
        events.pulses.iter().filter(|(of, ..)| *of == axis).map(|(_, clock, way)| (*clock, *way)).collect()
    }

    /// The clocks in which a pin changed, with the new level; the first one is where it began.
    fn levels(&self, pin: usize) -> Vec<(Ticks, bool)> {
        let events = self.0.lock().unwrap();
        events.pins.iter().filter(|(_, of, _)| *of == pin).map(|(at, _, level)| (*at, *level != 0)).collect()
    }
}

/// A rig that is recorded from now on, after these commands.
fn recorded(change: impl Fn(&mut AxisConfig), commands: &str) -> (Rig, Log) {
    let mut rig = Rig::with(change);
    rig.ok(commands);
    let log = Log::default();
    rig.device.add_recorder(Box::new(log.clone()));
    (rig, log)
}

fn pin(rig: &Rig, name: &str) -> usize {
    rig.device.pins().iter().position(|pin| pin.name == name).expect("a pin")
}

/// What the counter that is compared shows after so many pulses.
#[derive(Clone, Copy)]
enum Counter {
    Pulses,
    /// Counts of the encoder a pulse.
    Encoder(f64),
}

/// The levels that an output has to have: those of a rule, pulse by pulse.
fn expected(pulses: &[(Ticks, i64)], counter: Counter, mode: i32, position: i64) -> Vec<(Ticks, bool)> {
    const PULSE: Ticks = 197;
    let count = |pulses: i64| match counter {
        Counter::Pulses => pulses,
        Counter::Encoder(ratio) => (pulses as f64 * ratio + 0.5).floor() as i64,
    };
    let holds = |count: i64| match mode {
        1 => count == position,
        2 => count < position,
        3 => count > position,
        _ => false,
    };
    let mut odometer = 0;
    let mut changes: Vec<(Ticks, bool)> = Vec::new();
    let mut ends: Option<Ticks> = None;
    for (clock, way) in pulses {
        let before = count(odometer);
        odometer += way;
        let after = count(odometer);
        if mode == 4 {
            if let Some(end) = ends.take_if(|end| *end <= *clock) {
                changes.push((end, false));
            }
            let multiple = |count: &i64| count % position == 0;
            let passed = if after > before {
                (before + 1..=after).any(|count| multiple(&count))
            } else {
                (after..before).any(|count| multiple(&count))
            };
            if passed {
                if ends.is_none() {
                    changes.push((*clock, true));
                }
                ends = Some(clock + PULSE);
            }
        } else if holds(after) != holds(before) {
            changes.push((*clock, holds(after)));
        }
    }
    changes.extend(ends.map(|end| (end, false)));
    // A pulse that begins where one ends is none.
    let mut index = 1;
    while index < changes.len() {
        if changes[index].0 == changes[index - 1].0 {
            changes.drain(index - 1..=index);
        } else {
            index += 1;
        }
    }
    changes
}

const MODES: [(i32, i64); 6] = [(1, 51), (2, 700), (3, 1300), (4, 100), (4, 7), (4, 1)];

/// Every mode on both counters, through ramps there and back.
#[test]
fn outputs_change_with_the_pulse() {
    for (mode, position) in MODES {
        for (source, counter) in [
            (0, Counter::Pulses),
            (8, Counter::Encoder(1.0)),
            (8, Counter::Encoder(2.5)),
            (8, Counter::Encoder(-1.0)),
            (8, Counter::Encoder(0.25)),
        ] {
            let ratio = if let Counter::Encoder(ratio) = counter { ratio } else { 1.0 };
            let setting = format!("HSPD=200000 ACC=10 SYNCX={} SYNPX={position}", mode + source);
            let (mut rig, log) = recorded(|axis| axis.encoder_ratio = ratio, &setting);
            rig.ok("SYNOX X2000");
            rig.pass_ms(200);
            rig.ok("X-300");
            rig.pass_ms(200);
            let mut levels = log.levels(pin(&rig, "DO1"));
            // It stands as it does from the beginning.
            levels.retain(|(at, _)| *at > 0);
            let pulses = log.pulses(0);
            assert_eq!(pulses.len(), 2000 + 2300);
            assert_eq!(levels, expected(&pulses, counter, mode, position), "mode {mode}, {setting}, {ratio}");
        }
    }
}

/// The axis of an output may be any of an interpolated move.
#[test]
fn outputs_change_with_pulses_of_paths() {
    for (command, steps) in [("X3000Y1234Z-77", 1234), ("CIRXYP500:0", 2000), ("ARCXYN500:0:90000", 1500)] {
        let (mut rig, log) = recorded(|_| (), "HSPD=30000 SYNCY=4 SYNPY=50 SYNOY");
        rig.ok(command);
        rig.pass_ms(400);
        let pulses = log.pulses(1);
        assert_eq!(pulses.len(), steps, "{command}");
        let mut levels = log.levels(pin(&rig, "DO2"));
        levels.remove(0);
        assert_eq!(levels, expected(&pulses, Counter::Pulses, 4, 50), "{command}");
    }
}

/// A program that switches an output on is no later than a host.
#[test]
fn programs_switch_outputs_that_follow_the_encoder() {
    let (mut rig, log) = recorded(|_| (), "HSPD=47000 LSPD=47000 SYNCX=12 SYNPX=10");
    rig.start(0, "PRG 0\nX10000\nDELAY=10\nDO3=1\nSYNONX\nWAITX\nEND\n");
    rig.pass_ms(500);
    let pulses: Vec<_> = log.pulses(0).into_iter().map(|(clock, _)| clock).collect();
    let switched = log.levels(pin(&rig, "DO3"))[1].0 + HZ / 10_000;
    let levels = log.levels(pin(&rig, "DO1"));
    let rises: Vec<_> = levels[1..].iter().filter(|(_, on)| *on).map(|(at, _)| *at).collect();
    let start = pulses.partition_point(|clock| *clock <= switched);
    let expected: Vec<_> = pulses[start..].iter().skip(9).step_by(10).copied().collect();
    assert_eq!(rises, expected);
}

/// An axis follows another one by its encoder: the pulses of each count come before the next one.
#[test]
fn gearing_is_exact() {
    let mut config = sim::DeviceConfig::new(devices::model("cmd-4cr").unwrap());
    let follower = AxisConfig { mpg_from: Some(0), ..config.axis("Z") };
    config.axes.insert("Z".into(), follower);
    let mut rig = Rig { device: sim::VirtualDevice::new(&config, 1) };
    rig.ok("EO=15 HSPDZ=1000000 LSPDZ=1000000 MPMZ=3 MPDZ=1024 HSPDX=20000 MPEZ=1");
    let log = Log::default();
    rig.device.add_recorder(Box::new(log.clone()));
    rig.ok("X2000");
    rig.pass_ms(400);
    rig.ok("X-500");
    rig.pass_ms(400);
    rig.check("PZ", "-750");
    rig.check("MPZ", "-750");
    let (master, follower) = (log.pulses(0), log.pulses(2));
    assert_eq!((master.len(), follower.len()), (4500, 6750));
    let mut made = follower.iter().peekable();
    let (mut x, mut z) = (0_i64, 0_i64);
    for (number, (clock, way)) in master.iter().enumerate() {
        x += way;
        let next = master.get(number + 1).map_or(Ticks::MAX, |(clock, _)| *clock);
        while let Some((at, way)) = made.next_if(|(at, _)| *at <= next) {
            assert!(at > clock);
            z += way;
        }
        assert_eq!(z, (3 * x).div_euclid(2), "when X is at {x}");
    }
}

/// Counts before the program switches the input on are none.
#[test]
fn programs_begin_to_follow() {
    let mut config = sim::DeviceConfig::new(devices::model("cmd-4cr").unwrap());
    config.axes.insert("Z".into(), AxisConfig { mpg_from: Some(0), ..config.axis("Z") });
    let mut rig = Rig { device: sim::VirtualDevice::new(&config, 1) };
    rig.ok("EO=15 HSPD=1000 LSPD=1000 HSPDZ=50000 LSPDZ=50000");
    rig.start(0, "PRG 0\nX1000\nDELAY=333\nV1=PX\nMPGEZ=1\nWAITX\nEND\n");
    rig.pass_ms(2000);
    let (start, end) = (rig.get("V1"), rig.get("PZ"));
    assert!((300..=340).contains(&start), "{start}");
    assert!((1000 - start - end).abs() <= 1, "{end} after {start}");
}

/// Whoever looks often sees the same as who waits.
#[test]
fn nothing_depends_on_the_pace() {
    let levels = |pace: Ticks| {
        let setting = "HSPD=60000 ACC=30 SYNCX=12 SYNPX=33 SYNCY=4 SYNPY=10 SYNOX SYNOY LTX=1";
        let (mut rig, log) = recorded(|axis| axis.backlash = 9, setting);
        rig.ok("CIRXYN700:300");
        let end = rig.device.now() + HZ / 2;
        while rig.device.now() < end {
            rig.device.advance((rig.device.now() + pace).min(end));
        }
        let outputs = ["DO1", "DO2"].map(|name| log.levels(pin(&rig, name)));
        (outputs, log.pulses(0), log.pulses(1))
    };
    let whole = levels(HZ);
    assert!(whole.0.iter().all(|levels| levels.len() > 50));
    assert_eq!(whole, levels(7919));
    assert_eq!(whole, levels(104_729));
}

/// An axis may turn into a limit that it set out from.
#[test]
fn a_circle_turns_into_a_limit() {
    let end = |pace: Ticks| {
        let mut rig = Rig::new();
        rig.pin("+LX", true);
        rig.ok("HSPD=10000 LSPD=10000 X-200");
        rig.until_rest();
        rig.ok("CLRX CIRXZP-200:100");
        let end = rig.device.now() + HZ / 10;
        while rig.device.now() < end {
            rig.device.advance((rig.device.now() + pace).min(end));
        }
        rig.say("PP")
    };
    // Clockwise from below its centre: to the left first, and then a quarter later to the right.
    assert_eq!(end(HZ), "-300:0:100:0");
    assert_eq!(end(997), end(HZ));
}

/// One call of a user.
#[derive(Clone, Debug)]
enum Call {
    Say(String),
    Pass(u64),
    Push(&'static str, i64),
    Lose(&'static str, u64),
    Turn(&'static str, i64),
    Pin(&'static str, bool),
    Release(&'static str),
    PowerCycle,
}

fn call() -> impl Strategy<Value = Call> {
    let axis = || prop::sample::select(vec!["X", "Z"]);
    let pin =
        || prop::sample::select(vec!["DI1", "IO1", "IO5", "SDX", "ALMX", "INPX", "ZX", "CSTA", "+LX", "-LZ"]);
    let say = (axis(), 0_usize..12, -3000_i32..3000).prop_map(|(axis, what, value)| {
        Call::Say(match what {
            0 | 1 => format!("{axis}{value}"),
            2 => format!("SYNC{axis}={}", value.rem_euclid(16)),
            3 => format!("SYNP{axis}={}", value / 10),
            4 => format!("SYNO{axis}"),
            5 => format!("{}{axis}", ["SYNF", "SYNWO", "SYNWF", "CLR"][value.rem_euclid(4) as usize]),
            6 => format!("{}{axis}={value}", ["E", "P", "SYNMIN"][value.rem_euclid(3) as usize]),
            7 => format!("POL{axis}={}", value.rem_euclid(128) << 10),
            8 => format!("MPE{axis}={}", value & 1),
            9 => format!("IOCFG={}", value & 17),
            10 => format!("CIRXZP{value}:100"),
            _ => format!("EO={}", value & 15),
        })
    });
    prop_oneof![
        6 => say,
        4 => (0_u64..100_000).prop_map(Call::Pass),
        1 => (axis(), -500_i64..500).prop_map(|(axis, way)| Call::Push(axis, way)),
        1 => (axis(), 0_u64..300).prop_map(|(axis, pulses)| Call::Lose(axis, pulses)),
        1 => (axis(), -99_i64..99).prop_map(|(axis, counts)| Call::Turn(axis, counts)),
        1 => (pin(), any::<bool>()).prop_map(|(pin, on)| Call::Pin(pin, on)),
        1 => pin().prop_map(Call::Release),
        1 => Just(Call::PowerCycle),
    ]
}

/// Trains of pulses of axes, and levels of pins.
type Told = (Vec<(usize, Ticks, i64)>, Vec<(Ticks, usize, i32)>);

/// What a session puts out, looked at as often as `pace` says.
fn session(calls: &[Call], pace: u64) -> Told {
    let mut config = sim::DeviceConfig::new(devices::model("cmd-4cr").unwrap());
    let x = AxisConfig {
        backlash: 5,
        encoder_ratio: 1.5,
        in_position_ms: Some(3),
        slowdown: [Some([-900, -800]), Some([700, 800])],
        negative_limit: -2500,
        positive_limit: 2000,
        ..config.axis("X")
    };
    let z = AxisConfig { mpg_from: Some(0), encoder_ratio: -2.0, mpg_hz: 3000, ..config.axis("Z") };
    config.axes.extend([("X".into(), x), ("Z".into(), z)]);
    let mut rig = Rig { device: sim::VirtualDevice::new(&config, 1) };
    let log = Log::default();
    rig.device.add_recorder(Box::new(log.clone()));
    rig.ok("EO=15 HSPD=30000 ACC=20 SDEX=3 INPX=1 LTX=1");
    for call in calls {
        match call {
            Call::Say(command) => drop(rig.say(command)),
            Call::Pass(us) => {
                let end = rig.device.now() + us * 20;
                while rig.device.now() < end {
                    rig.device.advance((rig.device.now() + pace).min(end));
                }
            }
            Call::Push(axis, way) => rig.device.push(axis, *way).unwrap(),
            Call::Lose(axis, pulses) => rig.device.lose(axis, *pulses).unwrap(),
            Call::Turn(axis, counts) => rig.device.pulser(axis, *counts).unwrap(),
            Call::Pin(pin, on) => drop(rig.device.drive_pin(pin, PinValue::Level(*on))),
            Call::Release(pin) => rig.device.release_pin(pin).unwrap(),
            Call::PowerCycle => rig.power_cycle(),
        }
    }
    let mut events = std::mem::take(&mut *log.0.lock().unwrap());
    // A train is told of when it is over; who looks often sees it in pieces.
    events.pulses.sort_unstable();
    (events.pulses, events.pins)
}

proptest! {
    /// Whatever a user does, looking at it changes nothing.
    #[test]
    fn sessions_do_not_depend_on_the_pace(calls in prop::collection::vec(call(), 1..60), pace in 1000_u64..200_000) {
        prop_assert_eq!(session(&calls, u64::MAX / 2), session(&calls, pace));
    }
}
