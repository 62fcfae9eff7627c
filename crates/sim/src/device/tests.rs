//! A device as a whole, with the controller of [`testing`](crate::testing).

mod switches;

use super::*;
use crate::{
    config::{AxisConfig, Cam, EncoderPlace, Switch},
    record::Recorder,
    testing::{
        CLOCK_HZ, ENCODER, HOME, IN_POSITION, INDEX, INTERVAL, LEVEL, MODELS, Order, PORT, PULSER, SLOWDOWN,
        STOP_L, STOP_R, SUPPLY, report,
    },
};
use devices::Drive;
use motion::Train;
use proptest::prelude::*;
use std::sync::{Arc, Mutex};

/// Everything that a recorder is told.
#[derive(Clone, Default)]
struct Log(Arc<Mutex<Vec<Event>>>);

#[derive(Clone, Debug, PartialEq)]
enum Event {
    Train(Train),
    Drive(Ticks, Drive),
    Pin(Ticks, usize, i32),
    Mark(Ticks, Mark),
    Finish(Ticks),
}

impl Log {
    fn put(&self, event: Event) {
        self.0.lock().unwrap().push(event);
    }

    fn trains(&self) -> Vec<Train> {
        let events = self.0.lock().unwrap();
        events
            .iter()
            .filter_map(|event| if let Event::Train(train) = event { Some(*train) } else { None })
            .collect()
    }

    fn marks(&self) -> Vec<(Ticks, Mark)> {
        let events = self.0.lock().unwrap();
        let mark = |event: &Event| if let Event::Mark(at, mark) = event { Some((*at, *mark)) } else { None };
        events.iter().filter_map(mark).collect()
    }
}

impl Recorder for Log {
    fn train(&mut self, _axis: usize, train: &Train) {
        self.put(Event::Train(*train));
    }

    fn drive(&mut self, at: Ticks, _axis: usize, drive: Drive) {
        self.put(Event::Drive(at, drive));
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        self.put(Event::Pin(at, pin, level));
    }

    fn mark(&mut self, at: Ticks, _axis: usize, mark: Mark) {
        self.put(Event::Mark(at, mark));
    }

    fn sample(&mut self, _at: Ticks, _axis: usize, _state: &AxisState) {}

    fn finish(&mut self, at: Ticks) -> Result<(), RecordError> {
        self.put(Event::Finish(at));
        Ok(())
    }
}

fn small() -> AxisConfig {
    AxisConfig {
        negative_limit: -1000,
        positive_limit: 1000,
        home: [-200, -100],
        index_every: 400,
        ..AxisConfig::of_model("test")
    }
}

fn device(axis: AxisConfig) -> VirtualDevice {
    let mut config = DeviceConfig::new(&MODELS[0]);
    config.axes.insert("0".into(), axis);
    let mut device = VirtualDevice::new(&config, 1);
    device.drain_sent().for_each(drop);
    device
}

fn order(device: &mut VirtualDevice, order: Order) {
    device.receive(Port::Usb, &order.bytes());
}

/// Moves to a place and gives the reports on the way.
fn go(device: &mut VirtualDevice, target: i64) -> Vec<(usize, bool, i64)> {
    order(device, Order::Move(target));
    while device.controller.wake() != Ticks::MAX {
        device.advance(device.wake());
    }
    device.drain_sent().map(|sent| report(&sent.bytes)).collect()
}

#[test]
fn inputs_change_at_exactly_the_pulse() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_L | 1 << STOP_R | 1 << HOME));
    // STOP_R rests at 1 and its switch pulls it to 0. The index is not watched: where it is seen does
    // not count here.
    let mut check = |target, expected: &[(usize, bool, i64)]| {
        let mut reports = go(&mut device, target);
        reports.retain(|(pin, ..)| *pin != INDEX);
        assert_eq!(reports, expected);
    };
    check(1200, &[(STOP_R, false, 1000)]);
    check(-50, &[(STOP_R, true, 999)]);
    check(-1500, &[(HOME, true, -100), (HOME, false, -201), (STOP_L, true, -1000)]);
    check(0, &[(STOP_L, false, -999), (HOME, true, -200), (HOME, false, -99)]);
}

#[test]
fn watched_marks_are_seen_one_by_one() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << INDEX));
    let expected =
        [(INDEX, false, 1), (INDEX, true, 400), (INDEX, false, 401), (INDEX, true, 800), (INDEX, false, 801)];
    assert_eq!(go(&mut device, 900), expected);
    assert_eq!(go(&mut device, 700), [(INDEX, true, 800), (INDEX, false, 799)]);
}

#[test]
fn full_steps_do_not_jump_over_marks() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << INDEX));
    order(&mut device, Order::Drive(256, 32));
    // 400 lies between the pulses at 256 and 512, 1600 between 1536 and 1792.
    let reports = go(&mut device, 7);
    let seen: Vec<_> =
        reports.iter().filter(|(pin, ..)| *pin == INDEX).map(|(_, on, odometer)| (*on, *odometer)).collect();
    let marks = [2, 4, 5, 7].into_iter().flat_map(|pulse| [(true, pulse), (false, pulse)]);
    assert_eq!(seen, [(false, 1)].into_iter().chain(marks).collect::<Vec<_>>());
}

#[test]
fn a_cruise_between_inputs_is_one_train() {
    let mut device = device(AxisConfig { positive_limit: 5_000_000, ..small() });
    order(&mut device, Order::Watch(1 << STOP_R));
    let log = Log::default();
    device.add_recorder(Box::new(log.clone()));
    go(&mut device, 6_000_000);
    let counts: Vec<_> = log.trains().iter().map(|train| train.count).collect();
    assert_eq!(counts, [5_000_000, 1_000_000]);
    let marks = [(100, Mark::Started), (6_000_000 * INTERVAL, Mark::TargetReached)];
    // The first event after the start is the limit switch.
    assert_eq!(log.marks(), [(5_000_000 * INTERVAL, marks[0].1), marks[1]]);
}

#[test]
fn backlash_moves_the_switches_on_the_way_down() {
    let mut device = device(AxisConfig { backlash: 30, ..small() });
    order(&mut device, Order::Watch(1 << STOP_R));
    assert!(go(&mut device, 1100).contains(&(STOP_R, false, 1000)));
    let reports = go(&mut device, 900);
    assert!(reports.contains(&(STOP_R, true, 999 - 30)), "{reports:?}");
    assert_eq!(device.shaft("0"), Ok(930));
}

#[test]
fn a_stalled_shaft_loses_pulses() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_R));
    go(&mut device, 100);
    device.set_load("0", 1.01).unwrap();
    go(&mut device, 300);
    assert_eq!(device.shaft("0"), Ok(100));
    device.set_load("0", 0.5).unwrap();
    assert!(go(&mut device, 1250).contains(&(STOP_R, false, 1200)));
    assert_eq!((device.axis(0).position, device.axis(0).encoder), (1250, 1050));
}

#[test]
fn lost_pulses_are_counted_but_not_followed() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_R));
    device.lose("0", 70).unwrap();
    go(&mut device, 40);
    go(&mut device, 0);
    // 40 were lost on the way up, 30 on the way back.
    assert_eq!((device.axis(0).position, device.shaft("0")), (0, Ok(-10)));
    assert!(go(&mut device, 1100).contains(&(STOP_R, false, 1010)));
    assert_eq!(device.lose("1", 1).unwrap_err().to_string(), "there is no axis `1`, the device has: 0");
    assert_eq!(device.lose("0", u64::MAX), Err(AxisError::Range));
}

#[test]
fn pushing_turns_the_shaft_under_the_controller() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_R));
    order(&mut device, Order::Drive(1, 0));
    device.push("0", 990).unwrap();
    order(&mut device, Order::Drive(1, 32));
    assert_eq!((device.axis(0).position, device.axis(0).encoder), (0, 990));
    assert!(go(&mut device, 20).contains(&(STOP_R, false, 10)));
    assert_eq!(device.push("1", 1).unwrap_err().to_string(), "there is no axis `1`, the device has: 0");
    assert_eq!(device.push("0", i64::MIN), Err(AxisError::Range));
    assert_eq!(device.set_load("0", f64::NAN), Err(AxisError::Range));
}

#[test]
fn a_hand_overrides_the_machine() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_L | 1 << HOME));
    device.drive_pin("HOME", PinValue::Level(true)).unwrap();
    assert_eq!(device.drain_sent().map(|sent| report(&sent.bytes)).collect::<Vec<_>>(), [(HOME, true, 0)]);
    // The shaft passes the real switch, and nobody sees it.
    let reports = go(&mut device, -150);
    assert!(!reports.iter().any(|(pin, ..)| *pin == HOME), "{reports:?}");
    device.drive_pin("HOME", PinValue::Level(false)).unwrap();
    device.release_pin("HOME").unwrap();
    let reports: Vec<_> = device.drain_sent().map(|sent| report(&sent.bytes)).collect();
    assert_eq!(reports, [(HOME, false, -150), (HOME, true, -150)]);
}

#[test]
fn pins_take_what_fits_them() {
    let mut device = device(small());
    let mut check = |pin: &str, value, expected: Result<(), &str>| {
        let got = device.drive_pin(pin, value).map_err(|error| error.to_string());
        assert_eq!(got, expected.map_err(str::to_string));
    };
    check("STOP_L", PinValue::Level(true), Ok(()));
    check("STOP_L", PinValue::Number(1.0), Err("`STOP_L` is digital: true or false"));
    check("SUPPLY", PinValue::Level(true), Err("`SUPPLY` is analog: a number in V"));
    check("SUPPLY", PinValue::Number(8.46), Ok(()));
    check("SUPPLY", PinValue::Number(1e12), Err("`SUPPLY` cannot have this value"));
    check("SUPPLY", PinValue::Number(f64::NAN), Err("`SUPPLY` cannot have this value"));
    check("OUT", PinValue::Level(true), Err("`OUT` is an output, only the controller drives it"));
    let known = "the device has: STOP_L, STOP_R, HOME, INDEX, SUPPLY, OUT, TEMPERATURE, \
                 PORT, LEVEL, SLOWDOWN, IN_POSITION";
    check("DI1", PinValue::Level(true), Err(&format!("there is no pin `DI1`, {known}")));
    let reports: Vec<_> = device.drain_sent().map(|sent| report(&sent.bytes)).collect();
    assert_eq!(reports, [(STOP_L, true, 0), (SUPPLY, true, 85)]);
    assert_eq!(device.read_pin("SUPPLY"), Ok(PinValue::Number(8.5)));
    assert_eq!(device.read_pin("STOP_R"), Ok(PinValue::Level(true)));
    assert_eq!(device.read_pin("OUT"), Ok(PinValue::Level(false)));
}

/// What was reported since the last time, of these only.
fn reports(device: &mut VirtualDevice, of: &[usize]) -> Vec<(usize, bool, i64)> {
    let all = device.drain_sent().map(|sent| report(&sent.bytes));
    all.filter(|(what, ..)| of.contains(what)).collect()
}

#[test]
fn a_port_is_an_input_until_it_is_driven() {
    let mut device = device(small());
    let log = Log::default();
    device.add_recorder(Box::new(log.clone()));
    let (on, off) = (PinValue::Level(true), PinValue::Level(false));
    let level = |device: &VirtualDevice| device.read_pin("PORT").unwrap();
    device.drive_pin("PORT", on).unwrap();
    assert_eq!(reports(&mut device, &[PORT]), [(PORT, true, 0)]);
    // The controller wins, and nobody tells it of what it does itself.
    order(&mut device, Order::Port(Some(false)));
    assert_eq!((level(&device), reports(&mut device, &[PORT])), (off, vec![]));
    let driven = "`PORT` is an output now, the controller drives it";
    assert_eq!(device.drive_pin("PORT", on).unwrap_err().to_string(), driven);
    order(&mut device, Order::Port(None));
    assert_eq!((level(&device), reports(&mut device, &[PORT])), (on, vec![]));
    // A hand that lets go while the port is an output is seen when it is an input again.
    order(&mut device, Order::Port(Some(true)));
    device.release_pin("PORT").unwrap();
    assert_eq!((level(&device), reports(&mut device, &[PORT])), (on, vec![]));
    order(&mut device, Order::Port(None));
    assert_eq!((level(&device), reports(&mut device, &[PORT])), (off, vec![(PORT, false, 0)]));
    order(&mut device, Order::Port(Some(true)));
    device.power_cycle();
    assert_eq!(level(&device), off);
    let events = log.0.lock().unwrap();
    let recorded = events.iter().filter_map(|event| match event {
        Event::Pin(_, PORT, level) => Some(*level),
        _ => None,
    });
    assert_eq!(recorded.collect::<Vec<_>>(), [0, 1, 0, 1, 0, 1, 0]);
}

#[test]
fn an_analog_output_is_read() {
    let mut device = device(small());
    let log = Log::default();
    device.add_recorder(Box::new(log.clone()));
    assert_eq!(device.read_pin("LEVEL"), Ok(PinValue::Number(5.0)));
    order(&mut device, Order::Level(42));
    assert_eq!(device.read_pin("LEVEL"), Ok(PinValue::Number(42.0)));
    let output = Err(PinError::Output("LEVEL".into()));
    assert_eq!(device.drive_pin("LEVEL", PinValue::Number(1.0)), output);
    assert_eq!(device.release_pin("LEVEL"), output);
    let events = log.0.lock().unwrap();
    assert!(events.contains(&Event::Pin(0, LEVEL, 5)) && events.contains(&Event::Pin(0, LEVEL, 42)));
}

#[test]
fn slowdown_zones_are_switches() {
    let zones = [Some([100, 200]), Some([300, 310])];
    let mut device = device(AxisConfig { slowdown: zones, ..small() });
    order(&mut device, Order::Watch(1 << SLOWDOWN));
    let seen = |pulses: &[i64]| -> Vec<_> {
        pulses.iter().zip([true, false].iter().cycle()).map(|(at, on)| (SLOWDOWN, *on, *at)).collect()
    };
    order(&mut device, Order::Move(500));
    device.advance(500 * INTERVAL);
    assert_eq!(reports(&mut device, &[SLOWDOWN]), seen(&[100, 201, 300, 311]));
    order(&mut device, Order::Move(0));
    device.advance(1000 * INTERVAL);
    assert_eq!(reports(&mut device, &[SLOWDOWN]), seen(&[310, 299, 200, 99]));
}

#[test]
fn a_servo_is_in_position_some_time_after_its_pulses() {
    let mut device = device(AxisConfig { in_position_ms: Some(2), ..small() });
    assert_eq!(device.read_pin("IN_POSITION"), Ok(PinValue::Level(true)));
    order(&mut device, Order::Watch(1 << IN_POSITION));
    let mut go = |target: i64| {
        order(&mut device, Order::Move(target));
        device.advance(device.now() + 10_000);
        let seen = device.drain_sent().map(|sent| (sent.at, report(&sent.bytes)));
        seen.filter(|(_, seen)| seen.0 == IN_POSITION).collect::<Vec<_>>()
    };
    assert_eq!(go(5), [(100, (IN_POSITION, false, 1)), (2500, (IN_POSITION, true, 5))]);
    assert_eq!(go(4), [(10_100, (IN_POSITION, false, 4)), (12_100, (IN_POSITION, true, 4))]);
    // Without a servo driver the input is off.
    assert_eq!(super::tests::device(small()).read_pin("IN_POSITION"), Ok(PinValue::Level(false)));
}

#[test]
fn encoder_counts_are_told_at_their_pulse() {
    let check = |axis: AxisConfig, window: (i32, i32), target: i64, expected: &[(bool, i64)]| {
        let mut device = device(axis);
        order(&mut device, Order::Watch(0));
        order(&mut device, Order::Encoder(window.0, window.1));
        order(&mut device, Order::Move(target));
        device.advance(5000 * INTERVAL);
        let seen = reports(&mut device, &[ENCODER]);
        assert_eq!(seen.iter().map(|seen| (seen.1, seen.2)).collect::<Vec<_>>(), expected, "{window:?}");
    };
    // The next window goes from 20 below to 20 above.
    check(small(), (-10, 10), 55, &[(true, 10), (true, 30), (true, 50)]);
    check(small(), (-10, 10), -35, &[(false, -10), (false, -30)]);
    // 4 counts at a time, the other way, and after the play.
    let ratio = |encoder_ratio| AxisConfig { encoder_ratio, ..small() };
    check(ratio(4.0), (-10, 10), 9, &[(true, 3), (true, 8)]);
    check(ratio(-1.0), (-10, 10), 11, &[(false, 10)]);
    check(ratio(0.1), (-10, 2), 30, &[(true, 15)]);
    let play = AxisConfig { backlash: 7, ..small() };
    check(play, (-10, 10), -20, &[(false, -17)]);
}

#[test]
fn an_axis_follows_an_encoder_count_by_count() {
    let mut device = device(AxisConfig { mpg_from: Some(0), encoder_ratio: 2.5, ..small() });
    order(&mut device, Order::Watch(0));
    let go = |device: &mut VirtualDevice, target: i64| {
        order(device, Order::Move(target));
        device.advance(device.now() + 1000 * INTERVAL);
        let seen = reports(device, &[PULSER]);
        seen.iter().map(|(_, up, at)| (*up, *at)).collect::<Vec<_>>()
    };
    // Counts before the controller listens are none.
    assert_eq!(go(&mut device, 3), []);
    order(&mut device, Order::Follow(true));
    // From 8 counts to 10, then to 8 and 5.
    assert_eq!(go(&mut device, 4), [(true, 4); 2]);
    assert_eq!(go(&mut device, 2), [(false, 3), (false, 3), (false, 2), (false, 2), (false, 2)]);
    order(&mut device, Order::Follow(false));
    assert_eq!(go(&mut device, 9), []);
}

#[test]
fn a_hand_wheel_gives_count_after_count() {
    let mut device = device(AxisConfig { mpg_hz: 3000, ..small() });
    device.pulser("0", 3).unwrap();
    device.pulser("0", -1).unwrap();
    device.advance(2000);
    let seen: Vec<_> = device.drain_sent().map(|sent| (sent.at, report(&sent.bytes).1)).collect();
    assert_eq!(seen, [(334, true), (667, true), (1000, true), (1334, false)]);
    assert_eq!(device.pulser("X", 1).unwrap_err().to_string(), "there is no axis `X`, the device has: 0");
    assert_eq!(device.pulser("0", i64::MIN), Err(AxisError::Range));
    let mut other = VirtualDevice::new(&DeviceConfig::new(devices::model("pmx-2ed").unwrap()), 1);
    assert_eq!(other.pulser("Y", 1).unwrap_err().to_string(), "axis `Y` has no MPG input");
}

#[test]
fn planned_inputs_come_at_their_clock() {
    let mut device = device(small());
    let input = |pin: &str, value| Input { pin: pin.into(), value };
    device.schedule(700, &input("HOME", Some(PinValue::Number(1.0)))).unwrap();
    device.schedule(900, &input("HOME", None)).unwrap();
    assert_eq!(device.schedule(0, &input("OUT", None)), Err(PinError::Output("OUT".into())));
    assert!(device.schedule(0, &input("HOME", Some(PinValue::Number(2.0)))).is_err());
    device.advance(10_000);
    let times: Vec<_> = device.drain_sent().map(|sent| (sent.at, report(&sent.bytes).1)).collect();
    assert_eq!(times, [(700, true), (900, false)]);
    assert_eq!(device.now(), 10_000);
}

#[test]
fn the_supply_of_the_bench_is_told_at_the_start() {
    let mut config = DeviceConfig::new(&MODELS[0]);
    config.supply_v = 12.0;
    let mut device = VirtualDevice::new(&config, 1);
    let reports: Vec<_> = device.drain_sent().map(|sent| report(&sent.bytes)).collect();
    assert!(reports.contains(&(SUPPLY, true, 120)), "{reports:?}");
}

#[test]
fn a_power_cycle_keeps_time_shaft_and_flash() {
    let mut device = device(small());
    order(&mut device, Order::Out(true));
    order(&mut device, Order::Write(0, 0x1234_5678));
    go(&mut device, 150);
    device.power_cycle();
    assert_eq!(device.now(), 150 * INTERVAL);
    assert_eq!(device.read_pin("OUT"), Ok(PinValue::Level(false)));
    assert_eq!((device.axis(0).position, device.axis(0).encoder, device.shaft("0")), (0, 150, Ok(150)));
    assert_eq!(device.flash().to_bytes()[..4], 0x1234_5678_u32.to_le_bytes());
    // Switches stand where they stood.
    device.drain_sent().for_each(drop);
    order(&mut device, Order::Watch(1 << STOP_R));
    let log = Log::default();
    device.add_recorder(Box::new(log.clone()));
    assert!(go(&mut device, 900).contains(&(STOP_R, false, 850)));
    assert_eq!(log.trains()[0].start.ticks, 150 * INTERVAL);
}

#[test]
fn a_power_cut_loses_what_flash_had_not_finished() {
    let written = |wait| {
        let mut device = device(small());
        order(&mut device, Order::Write(0, 0));
        order(&mut device, Order::Write(8, 0));
        device.advance(wait);
        device.power_cut();
        let bytes = device.flash().to_bytes();
        [bytes[0], bytes[8]]
    };
    // A word takes 50 us, and a clock of this device 1 us.
    assert_eq!(written(0), [0xFF, 0xFF]);
    assert_eq!(written(49), [0xFF, 0xFF]);
    assert_eq!(written(50), [0, 0xFF]);
    assert_eq!(written(100), [0, 0]);
}

#[test]
fn the_state_is_what_people_ask_for() {
    let mut device = device(small());
    go(&mut device, 150);
    let state = serde_json::to_value(device.state()).unwrap();
    let axis = serde_json::json!({
        "position": 150, "encoder": 150, "speed": 0.0, "target": 150, "status": 0, "steps": 150
    });
    let expected = serde_json::json!({ "axes": { "0": axis }, "programs": [], "device_seconds": 0.015 });
    assert_eq!(state, expected);
}

/// A real controller with two axes, on machines that differ.
#[test]
fn each_axis_has_its_machine() {
    let mut config = DeviceConfig::new(devices::model("pmx-2ed").unwrap());
    let y = AxisConfig { positive_limit: 300, encoder_ratio: -2.0, index_every: 100, ..config.axis("Y") };
    config.axes.insert("Y".into(), y);
    let mut device = VirtualDevice::new(&config, 1);
    let second = Ticks::from(device.clock_hz());
    let send = |device: &mut VirtualDevice, line: &[u8]| {
        device.receive(Port::Usb, &[line, b"\r"].concat());
        let replies: Vec<_> = device.drain_sent().flat_map(|sent| sent.bytes).collect();
        assert_eq!(String::from_utf8(replies).unwrap(), "OK\r");
    };
    for line in [&b"EO=3"[..], b"HSPD=5000", b"X500", b"Y500"] {
        send(&mut device, line);
    }
    device.advance(2 * second);
    let place = |device: &mut VirtualDevice, axis| (device.axis(axis).position, device.axis(axis).encoder);
    assert_eq!((place(&mut device, 0), place(&mut device, 1)), ((500, 500), (300, -600)));
    let pin = |device: &VirtualDevice, name: &str| device.read_pin(name).unwrap();
    let (on, off) = (PinValue::Level(true), PinValue::Level(false));
    assert_eq!((pin(&device, "+LX"), pin(&device, "+LY")), (off, on));
    assert_eq!((pin(&device, "ZX"), pin(&device, "ZY")), (off, on));
    assert_eq!((pin(&device, "AI1"), pin(&device, "EO2")), (PinValue::Number(2500.0), on));
    device.push("X", -600).unwrap();
    device.lose("Y", 40).unwrap();
    send(&mut device, b"CLRY");
    send(&mut device, b"Y200");
    device.advance(device.now() + 2 * second);
    assert_eq!((place(&mut device, 0), place(&mut device, 1)), ((500, -100), (200, -480)));
    assert_eq!((pin(&device, "HX"), pin(&device, "HY")), (on, off));
    let state = device.state();
    assert_eq!(state.axes.keys().collect::<Vec<_>>(), [&"X", &"Y"]);
    assert!(state.programs.iter().all(|program| program.state == "idle"));
}

/// One call of a user.
#[derive(Clone, Debug)]
enum Call {
    Go(i64),
    Advance(Ticks),
    Drive(i16, u8),
    Load(f64),
    Push(i64),
    Lose(u64),
    Watch(u16),
    Pin(&'static str, bool),
    Release(&'static str),
    PowerCycle,
}

fn call() -> impl Strategy<Value = Call> {
    let digital = || prop::sample::select(vec!["STOP_L", "STOP_R", "HOME", "INDEX"]);
    prop_oneof![
        4 => (-3000_i64..3000).prop_map(Call::Go),
        4 => (0_u64..200_000).prop_map(Call::Advance),
        1 => (-256_i16..=256, 0_u8..=32).prop_map(|(step, current)| Call::Drive(step, current)),
        1 => (0.0..1.2).prop_map(Call::Load),
        1 => (-500_i64..500).prop_map(Call::Push),
        1 => (0_u64..300).prop_map(Call::Lose),
        1 => any::<u16>().prop_map(Call::Watch),
        1 => (digital(), any::<bool>()).prop_map(|(pin, on)| Call::Pin(pin, on)),
        1 => digital().prop_map(Call::Release),
        1 => Just(Call::PowerCycle),
    ]
}

fn make(device: &mut VirtualDevice, call: &Call) {
    match *call {
        Call::Go(target) => order(device, Order::Move(target)),
        Call::Advance(span) => device.advance(device.now() + span),
        Call::Drive(step, current) => order(device, Order::Drive(step, current)),
        Call::Load(load) => device.set_load("0", load).unwrap(),
        Call::Push(distance) => device.push("0", distance).unwrap(),
        Call::Lose(pulses) => device.lose("0", pulses).unwrap(),
        Call::Watch(pins) => order(device, Order::Watch(pins)),
        Call::Pin(pin, on) => device.drive_pin(pin, PinValue::Level(on)).unwrap(),
        Call::Release(pin) => device.release_pin(pin).unwrap(),
        Call::PowerCycle => device.power_cycle(),
    }
}

/// The log and the messages of a session.
fn session(calls: &[Call]) -> (Vec<Event>, Vec<Sent>, Vec<i32>) {
    let mut device = device(AxisConfig { backlash: 7, hard_stops: Some([-2000, 1500]), ..small() });
    let log = Log::default();
    device.add_recorder(Box::new(log.clone()));
    let mut sent = Vec::new();
    for call in calls {
        make(&mut device, call);
        sent.extend(device.drain_sent());
    }
    let levels = (0..device.pins().len()).map(|pin| device.world.level(pin)).collect();
    device.finish_recordings().unwrap();
    let events = log.0.lock().unwrap().clone();
    (events, sent, levels)
}

proptest! {
    #[test]
    fn the_same_calls_give_the_same_events(calls in prop::collection::vec(call(), 1..40)) {
        prop_assert_eq!(session(&calls), session(&calls));
    }

    /// Whoever advances in small steps sees the same edges as whoever waits.
    #[test]
    fn edges_do_not_depend_on_the_pace(target in -3000_i64..3000, pace in 1_u64..5000) {
        let edges = |pace: u64| {
            let mut device = device(small());
            let log = Log::default();
            device.add_recorder(Box::new(log.clone()));
            order(&mut device, Order::Move(target));
            let end = 3001 * INTERVAL;
            while device.now() < end {
                device.advance((device.now() + pace).min(end));
            }
            let edges: Vec<_> = log.trains().iter().flat_map(Train::edges).collect();
            let reports: Vec<_> = device.drain_sent().filter(|sent| sent.bytes[0] != INDEX as u8).collect();
            (edges, reports)
        };
        prop_assert_eq!(edges(pace), edges(u64::MAX / 2));
    }

    /// The shaft is the sum of its trains, each with the step of its time.
    #[test]
    fn the_shaft_is_the_sum_of_the_trains(calls in prop::collection::vec(call(), 1..40)) {
        let mut device = device(small());
        let log = Log::default();
        device.add_recorder(Box::new(log.clone()));
        let (mut pushed, mut seen, mut expected, mut step) = (0, 0, 0, 1);
        for call in &calls {
            let (before, follows) = match call {
                // Stalls and lost pulses have tests of their own.
                Call::Load(_) | Call::Lose(_) => continue,
                Call::Push(distance) => { pushed += distance; (step, step != 0) }
                _ => (step, step != 0),
            };
            make(&mut device, call);
            let trains = log.trains();
            for train in &trains[seen..] {
                if follows {
                    expected += before * train.direction.sign() * i64::from(train.count);
                }
            }
            seen = trains.len();
            match call {
                Call::Drive(_, 0) => step = 0,
                Call::Drive(next, _) => step = i64::from(*next),
                Call::PowerCycle => step = 1,
                _ => {}
            }
            prop_assert_eq!(device.shaft("0"), Ok(expected + pushed));
        }
    }

    /// What the controller was told last is what is on its pins.
    #[test]
    fn the_controller_knows_its_inputs(calls in prop::collection::vec(call(), 1..40)) {
        let (_, sent, levels) = session(&calls);
        for pin in [STOP_L, STOP_R, HOME, INDEX] {
            // A power cycle tells it all over again what is not at rest.
            let last = sent.iter().rev().map(|sent| report(&sent.bytes)).find(|report| report.0 == pin);
            if let Some((_, on, _)) = last && !calls.iter().any(|call| matches!(call, Call::PowerCycle)) {
                prop_assert_eq!(i32::from(on), levels[pin], "pin {}", pin);
            }
        }
    }
}

#[test]
fn a_second_is_a_second() {
    let mut device = device(small());
    device.advance(device.ticks(1.5));
    assert_eq!((device.now(), device.seconds()), (u64::from(CLOCK_HZ) * 3 / 2, 1.5));
}

#[test]
fn a_switch_bounces_the_same_however_time_is_cut() {
    let reports = |slices: &[Ticks]| {
        let mut device = device(small());
        device.world.machine.set_bounce(HOME, 2, 0);
        device.settle();
        order(&mut device, Order::Move(-150));
        let mut reports = Vec::new();
        for &until in slices.iter().chain(&[30_000]) {
            device.advance(until);
            reports.extend(device.drain_sent().map(|sent| (sent.at, report(&sent.bytes))));
        }
        reports.retain(|(_, (pin, ..))| *pin == HOME);
        reports
    };
    let whole = reports(&[]);
    // From -100 on, at the clock of its pulse, and for 2 ms; then it stays on.
    assert_eq!(whole[0], (10_000, (HOME, true, -100)));
    assert!(whole.len() >= 3 && whole.len() % 2 == 1, "{whole:?}");
    assert!(whole.iter().all(|(at, _)| (10_000..=12_000).contains(at)), "{whole:?}");
    assert!(whole.iter().enumerate().all(|(number, (_, (_, on, _)))| *on == (number % 2 == 0)), "{whole:?}");
    let fine: Vec<_> = (0..3000).map(|slice| slice * 7).collect();
    assert_eq!(reports(&fine), whole);
}

#[test]
fn a_switch_stays_on_for_its_hysteresis() {
    let mut device = device(AxisConfig { switch_hysteresis: 5, home: [100, 200], ..small() });
    // Nobody watches, and still each change is seen where it is.
    order(&mut device, Order::Watch(0));
    let mut home = |target| {
        let mut reports = go(&mut device, target);
        reports.retain(|(pin, ..)| *pin == HOME);
        reports
    };
    assert_eq!(home(300), [(HOME, true, 100), (HOME, false, 206)]);
    assert_eq!(home(97), [(HOME, true, 200)]);
    assert_eq!(home(0), [(HOME, false, 94)]);
}

#[test]
fn a_closed_switch_opens() {
    let closed = AxisConfig { normally_closed: vec![Switch::Home, Switch::PositiveLimit], ..small() };
    let mut device = device(closed);
    assert_eq!(device.read_pin("HOME"), Ok(PinValue::Level(true)));
    // This pin rests at 1 without a switch.
    assert_eq!(device.read_pin("STOP_R"), Ok(PinValue::Level(false)));
    order(&mut device, Order::Watch(1 << HOME));
    let mut reports = go(&mut device, -250);
    reports.retain(|(pin, ..)| *pin == HOME);
    assert_eq!(reports, [(HOME, false, -100), (HOME, true, -201)]);
}

#[test]
fn an_axis_goes_round() {
    let round = AxisConfig { circumference: Some(1000), home: [-10, 10], index_every: 500, ..small() };
    let mut device = device(round);
    order(&mut device, Order::Watch(1 << HOME | 1 << STOP_R | 1 << STOP_L));
    let mut reports = go(&mut device, 2500);
    reports.retain(|(pin, ..)| *pin != INDEX);
    let turn = |turn: i64| [(HOME, true, 1000 * turn - 10), (HOME, false, 1000 * turn + 11)];
    assert_eq!(reports[0], (HOME, false, 11));
    assert_eq!(reports[1..], [turn(1), turn(2)].concat());
}

#[test]
fn an_axis_is_a_cam() {
    let cam = |on, normally_closed| Cam { pin: "PORT".into(), on, normally_closed };
    for normally_closed in [false, true] {
        let mut device = device(AxisConfig {
            cams: vec![cam([300, 400], normally_closed)],
            ..AxisConfig::of_model("test")
        });
        assert_eq!(device.read_pin("PORT"), Ok(PinValue::Level(normally_closed)));
        order(&mut device, Order::Watch(1 << PORT));
        let mut reports = go(&mut device, 500);
        reports.retain(|(pin, ..)| *pin == PORT);
        assert_eq!(reports, [(PORT, !normally_closed, 300), (PORT, normally_closed, 401)]);
    }
}

#[test]
fn an_encoder_at_the_motor_does_not_see_the_play() {
    for (encoder_at, counts) in [(EncoderPlace::Motor, -30), (EncoderPlace::Load, -20)] {
        let mut device = device(AxisConfig { backlash: 10, encoder_at, ..small() });
        go(&mut device, -30);
        assert_eq!(device.axis(0).encoder, counts, "{encoder_at:?}");
    }
}

/// At 10,000 full steps a second it stalls where the load is more than half.
#[test]
fn a_stalled_motor_is_late_at_its_switches() {
    let curve = vec![[0.0, 1.0], [20_000.0, 0.0]];
    let switches = |load| {
        let axis = AxisConfig { pull_out: curve.clone(), load, ..small() };
        let mut device = device(axis);
        order(&mut device, Order::Watch(1 << STOP_R));
        let mut reports = go(&mut device, 1100);
        reports.retain(|(pin, ..)| *pin == STOP_R);
        (reports, device.shaft("0").unwrap())
    };
    assert_eq!(switches(0.49), (vec![(STOP_R, false, 1000)], 1100));
    assert_eq!(switches(0.51), (vec![], 1), "the first pulse has none before it");
}
