//! The machines of `examples/bench` at work: what the programs beside them do there.

use devices::{Language, Port, ProgramRun};
use protocol::tmcl::Request;
use sim::{Bench, PinValue, Program, VirtualDevice, run::load};
use std::path::{Path, PathBuf};
use tmcl::asm::{NoFiles, assemble};

/// Longest time that a program may take.
const PATIENCE_S: u64 = 120;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/bench")
}

/// A machine with its program, which has just been started.
struct Work {
    device: VirtualDevice,
    millisecond: u64,
}

impl Work {
    fn start(bench: &str, program: &str) -> Self {
        let bench = Bench::read(&folder().join(bench)).unwrap();
        let mut device = VirtualDevice::new(&bench.devices[0], 1);
        let source = std::fs::read(folder().join(program)).unwrap();
        let start = match device.config().model.language {
            Language::Tmcl => {
                let assembly = assemble(program, &source, &NoFiles);
                let code = assembly.program.as_ref().unwrap_or_else(|| panic!("{}", assembly.render(false)));
                load(&mut device, &Program::Tmcl(code.commands.clone())).unwrap();
                Request { address: 1, opcode: 129, kind: 1, motor: 0, value: 0 }.emit().0.to_vec()
            }
            Language::Ascript(dialect) => {
                let compilation = ascript::compile(program, &source, dialect);
                let code =
                    compilation.code.as_ref().unwrap_or_else(|| panic!("{}", compilation.render(false)));
                load(&mut device, &Program::Ascript(code.lines.clone())).unwrap();
                format!("{}0=1\r", dialect.control).into_bytes()
            }
        };
        device.receive(Port::Usb, &start);
        device.drain_sent().for_each(drop);
        let millisecond = u64::from(device.clock_hz()) / 1000;
        Self { device, millisecond }
    }

    /// A millisecond goes by.
    fn pass(&mut self) {
        self.device.advance(self.device.now() + self.millisecond);
    }

    fn is_on(&self, pin: &str) -> bool {
        self.device.read_pin(pin) == Ok(PinValue::Level(true))
    }

    fn shaft(&self, axis: &str) -> i64 {
        self.device.shaft(axis).unwrap()
    }

    /// Lets the program run to its end, and gives what is seen whenever a pin comes on.
    #[track_caller]
    fn run<T>(&mut self, pin: &str, see: impl Fn(&Self) -> T) -> Vec<T> {
        let mut seen = Vec::new();
        let mut was_on = self.is_on(pin);
        for _ in 0..PATIENCE_S * 1000 {
            self.pass();
            let on = self.is_on(pin);
            if on && !was_on {
                seen.push(see(self));
            }
            was_on = on;
            if self.device.programs().all(|program| program.run == ProgramRun::Idle) {
                return seen;
            }
        }
        panic!("it does not come to its end: {:?}", self.device.state());
    }
}

#[test]
fn the_wheel_shows_each_filter_in_the_middle_of_its_mark() {
    let mut wheel = Work::start("filter-wheel.toml", "filter-wheel.tmc");
    let exposures = wheel.run("OUT0", |wheel| wheel.shaft("0"));
    // It searches downward from 0: the mark of the turn below, from 12,000 to 12,600.
    let places: Vec<_> = (0..8).map(|filter| exposures[0] + filter * 6400).collect();
    assert_eq!(exposures, places);
    let home = exposures[0].rem_euclid(51_200);
    assert!((12_000..=12_640).contains(&home), "{home}");
    assert_eq!(i64::from(wheel.device.axis(0).position), 7 * 6400);
}

#[test]
fn the_belt_brings_part_after_part() {
    let mut belt = Work::start("conveyor.toml", "conveyor.tmc");
    let parts = belt.run("OUT0", |belt| belt.shaft("0"));
    let barrier: Vec<_> = parts.iter().map(|part| (part / 20_480, part % 20_480)).collect();
    assert_eq!(barrier.iter().map(|part| part.0).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
    // It needs some way to stop, the same for each.
    assert!(barrier.iter().all(|part| (9_000..=12_000).contains(&part.1)), "{barrier:?}");
    assert_eq!(i64::from(belt.device.axis(0).position), belt.shaft("0"), "no pulse was lost");
}

#[test]
fn a_belt_that_is_too_full_stalls_at_speed() {
    let mut belt = Work::start("conveyor.toml", "conveyor.tmc");
    belt.device.set_load("0", 0.95).unwrap();
    (0..2000).for_each(|_| belt.pass());
    let position = i64::from(belt.device.axis(0).position);
    let stalled = belt.shaft("0");
    assert!(position > 100_000 && stalled < 20_000, "{position}, {stalled}");
    // Without its parts it comes into step: whole cycles of four full steps are lost.
    belt.device.set_load("0", 0.35).unwrap();
    (0..100).for_each(|_| belt.pass());
    let position = i64::from(belt.device.axis(0).position);
    assert_eq!((position - belt.shaft("0")) % 1024, 0);
    assert!(belt.shaft("0") > stalled + 1_000, "from {stalled} to {}", belt.shaft("0"));
}

#[test]
fn the_pump_draws_and_gives() {
    let mut pump = Work::start("syringe-pump.toml", "syringe-pump.prg");
    let strokes = pump.run("DI2", |pump| (pump.shaft("X"), pump.shaft("Y").rem_euclid(2000)));
    // The valve passes its outlet while it is homed, too. Then it arrives there with a full syringe.
    let strokes: Vec<_> = strokes.into_iter().filter(|(plunger, _)| *plunger > 0).collect();
    assert_eq!(strokes.len(), 3, "{strokes:?}");
    assert!(strokes.iter().all(|stroke| *stroke == (strokes[0].0, 190)), "{strokes:?}");
    assert_eq!(pump.device.axis(0).position, 0);
    assert!(!pump.is_on("DO1") && pump.is_on("DI2"));
    let (plunger, scale) = (pump.shaft("X"), pump.device.axis(0).encoder);
    assert!(
        (strokes[0].0 - plunger - (40_000 - 24)).abs() <= 1,
        "a stroke less its play: {strokes:?} {plunger}"
    );
    assert!(scale.abs() <= 13, "{scale}");
}

#[test]
fn the_gantry_carries_three_parts() {
    let mut gantry = Work::start("gantry.toml", "gantry.prg");
    let places = |gantry: &Work| ["X", "Y", "Z"].map(|axis| gantry.shaft(axis));
    let taken = gantry.run("DO1", places);
    assert_eq!(taken.len(), 3, "{taken:?} {:?}", gantry.device.state());
    let [first, ..] = taken[0];
    assert_eq!(taken.iter().map(|place| place[0] - first).collect::<Vec<_>>(), [0, 8000, 16_000]);
    // Y has play: it comes from below for the first part, and from above for the others.
    assert_eq!(taken.iter().map(|place| place[1] - taken[0][1]).collect::<Vec<_>>(), [0, 6, 6]);
    assert!(taken.iter().all(|place| place[2] == taken[0][2]), "{taken:?}");
    let [x, y, z] = places(&gantry);
    assert_eq!(x - first, 60_000);
    assert_eq!(y - taken[0][1], 45_000);
    assert_eq!(z - taken[0][2], 12_000);
}

#[test]
fn a_stalled_belt_is_where_it_is_however_time_is_cut() {
    let places = |slice: u64| {
        let mut belt = Work::start("conveyor.toml", "conveyor.tmc");
        belt.device.set_load("0", 0.9).unwrap();
        let mut places = Vec::new();
        for moment in 1..=20 {
            let until = moment * 50 * belt.millisecond;
            while belt.device.now() < until {
                belt.device.advance(until.min(belt.device.now() + slice));
            }
            places.push((belt.device.axis(0), belt.shaft("0")));
        }
        places
    };
    let whole = places(u64::MAX / 2);
    assert!(whole.iter().any(|(state, shaft)| i64::from(state.position) != *shaft), "it stalls");
    assert_eq!(places(16_000), whole);
    assert_eq!(places(777), whole);
}
