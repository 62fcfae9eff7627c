//! A small controller for tests: one axis at constant speed, which reports every input that it hears of.

use devices::{
    AxisState, Board, Controller, Drive, Model, Pin, PinKind, Port, ProgramState, Wiring,
    flash::{Flash, WORD_BYTES},
};
use motion::{Direction, Moment, Ticks, Train, train::EVERY_SLOT};

/// The models of tests.
pub static MODELS: &[Model] = &[Model {
    name: "test",
    title: "Test",
    language: devices::Language::Tmcl,
    hid_product: None,
    flash_bytes: 8192,
    guide: &devices::guide::Guide::NONE,
    build,
}];

pub const CLOCK_HZ: u32 = 1_000_000;

/// Clocks from one pulse to the next.
pub const INTERVAL: u64 = 100;

pub const STOP_L: usize = 0;
pub const STOP_R: usize = 1;
pub const HOME: usize = 2;
pub const INDEX: usize = 3;
pub const SUPPLY: usize = 4;
pub const PORT: usize = 7;
pub const LEVEL: usize = 8;
pub const SLOWDOWN: usize = 9;
pub const IN_POSITION: usize = 10;

/// How far it lets an encoder count before it wants to be told again.
pub const ENCODER_ROOM: i32 = 20;

/// What a report says instead of a pin: a count at the pulser input, up or down.
pub const PULSER: usize = 100;
/// The encoder has come to an end of its window.
pub const ENCODER: usize = 101;

const fn pin(name: &'static str, kind: PinKind, wiring: Wiring, unit: &'static str, rest: i32) -> Pin {
    Pin { name, kind, wiring, unit, scale: 1, rest }
}

static PINS: &[Pin] = &[
    pin("STOP_L", PinKind::Input, Wiring::NegativeLimit(0), "", 0),
    pin("STOP_R", PinKind::Input, Wiring::PositiveLimit(0), "", 1),
    pin("HOME", PinKind::Input, Wiring::Home(0), "", 0),
    pin("INDEX", PinKind::Index(0), Wiring::Index(0), "", 0),
    Pin { scale: 10, ..pin("SUPPLY", PinKind::Analog, Wiring::Supply, "V", 240) },
    pin("OUT", PinKind::Output, Wiring::Free, "", 0),
    pin("TEMPERATURE", PinKind::Analog, Wiring::Temperature, "°C", 25),
    pin("PORT", PinKind::Port, Wiring::Free, "", 0),
    pin("LEVEL", PinKind::AnalogOutput, Wiring::Free, "%", 5),
    pin("SLOWDOWN", PinKind::Input, Wiring::Slowdown(0), "", 0),
    pin("IN_POSITION", PinKind::Input, Wiring::InPosition(0), "", 0),
];

/// What a test tells the controller, as bytes.
#[derive(Clone, Copy, Debug)]
pub enum Order {
    /// Move until the odometer has this value.
    Move(i64),
    /// Another driver setting.
    Drive(i16, u8),
    /// Watch these pins, as bits.
    Watch(u16),
    /// Program a word of the flash: its lower half, the upper one is 0.
    Write(u32, u32),
    /// Switch the output.
    Out(bool),
    /// Drive the port, or make it an input.
    Port(Option<bool>),
    /// Set the analog output.
    Level(u8),
    /// Listen to the pulser input.
    Follow(bool),
    /// Look out for these counts of the encoder, and from each for those that are [`ENCODER_ROOM`] away.
    Encoder(i32, i32),
}

impl Order {
    pub fn bytes(self) -> [u8; 9] {
        let (kind, value) = match self {
            Self::Move(target) => (0, target as u64),
            Self::Drive(step, current) => (1, u64::from(step as u16) << 8 | u64::from(current)),
            Self::Watch(pins) => (2, u64::from(pins)),
            Self::Write(offset, word) => (3, u64::from(offset) << 32 | u64::from(word)),
            Self::Out(on) => (4, u64::from(on)),
            Self::Port(level) => (5, level.map_or(2, u64::from)),
            Self::Level(value) => (6, value.into()),
            Self::Follow(on) => (7, on.into()),
            Self::Encoder(low, high) => (8, u64::from(low as u32) << 32 | u64::from(high as u32)),
        };
        let mut bytes = [kind; 9];
        bytes[1..].copy_from_slice(&value.to_le_bytes());
        bytes
    }
}

/// What the controller reports of an input: pin, level, odometer.
pub fn report(bytes: &[u8]) -> (usize, bool, i64) {
    (usize::from(bytes[0]), bytes[1] != 0, i64::from_le_bytes(bytes[2..10].try_into().unwrap()))
}

struct TestController {
    flash: Box<dyn Flash + Send>,
    now: Ticks,
    last_pulse: Ticks,
    odometer: i64,
    target: i64,
    steps: u64,
    window: (i64, i64),
    watched: u16,
    follows: bool,
    encoder: Option<(i32, i32)>,
}

fn build(flash: Box<dyn Flash + Send>, _seed: u64) -> Box<dyn Controller + Send> {
    Box::new(TestController {
        flash,
        now: 0,
        last_pulse: 0,
        odometer: 0,
        target: 0,
        steps: 0,
        window: (i64::MIN, i64::MAX),
        watched: u16::MAX,
        follows: false,
        encoder: None,
    })
}

impl TestController {
    /// Pulses until the target or the edge of the window.
    fn pulses_left(&self) -> u64 {
        self.target.abs_diff(self.odometer).min(self.pulses_to_edge())
    }

    fn report(&self, what: usize, on: bool, board: &mut dyn Board) {
        let mut bytes = vec![what as u8, u8::from(on)];
        bytes.extend(self.odometer.to_le_bytes());
        board.send(Port::Usb, &bytes, 0);
    }

    fn pulses_to_edge(&self) -> u64 {
        let edge = if self.target < self.odometer { self.window.0 } else { self.window.1 };
        edge.abs_diff(self.odometer)
    }
}

impl Controller for TestController {
    fn clock_hz(&self) -> u32 {
        CLOCK_HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["0"]
    }

    fn pins(&self) -> &'static [Pin] {
        PINS
    }

    fn watches(&self, pin: usize) -> bool {
        self.watched & (1 << pin) != 0
    }

    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        assert!(now >= self.now, "time goes back");
        let edge = self.last_pulse.saturating_add(self.pulses_to_edge().saturating_mul(INTERVAL));
        let now = if self.pulses_left() == self.pulses_to_edge() { now.min(edge) } else { now };
        self.now = now;
        let due = (now - self.last_pulse) / INTERVAL;
        let count = due.min(self.pulses_left()) as u32;
        if count > 0 {
            let direction = Direction::of(self.target - self.odometer);
            let start = Moment::at(self.last_pulse);
            let interval = INTERVAL << 32;
            let train = Train { start, interval, add: 0, jerk: 0, count, direction, mask: EVERY_SLOT };
            board.pulses(0, &train);
            self.last_pulse += u64::from(count) * INTERVAL;
            self.odometer += direction.sign() * i64::from(count);
            self.steps += u64::from(count);
        }
        now
    }

    fn wake(&self) -> Ticks {
        match self.target.abs_diff(self.odometer) {
            0 => Ticks::MAX,
            pulses => self.last_pulse + pulses * INTERVAL,
        }
    }

    fn is_moving(&self) -> bool {
        self.pulses_left() > 0
    }

    fn receive(&mut self, _port: Port, bytes: &[u8], board: &mut dyn Board) {
        let value = u64::from_le_bytes(bytes[1..].try_into().unwrap());
        match bytes[0] {
            0 => {
                self.target = value as i64;
                self.last_pulse = self.now;
            }
            1 => board.drive(0, Drive { step: (value >> 8) as i16, parts: 1, current: value as u8 }),
            2 => self.watched = value as u16,
            3 => {
                let mut word = [0; WORD_BYTES as usize];
                word[..4].copy_from_slice(&(value as u32).to_le_bytes());
                let _ = self.flash.write((value >> 32) as u32, &word);
            }
            4 => board.output(5, value != 0),
            5 if value > 1 => board.release(PORT),
            5 => board.output(PORT, value != 0),
            6 => board.output_analog(LEVEL, value as i32),
            7 => self.follows = value != 0,
            _ => self.encoder = Some(((value >> 32) as i32, value as i32)),
        }
    }

    fn input(&mut self, pin: usize, on: bool, board: &mut dyn Board) {
        self.report(pin, on, board);
    }

    fn has_pulser(&self, _axis: usize) -> bool {
        true
    }

    fn watches_pulser(&self, _axis: usize) -> bool {
        self.follows
    }

    fn pulser(&mut self, _axis: usize, counts: i32, board: &mut dyn Board) {
        for _ in 0..counts.unsigned_abs() {
            self.report(PULSER, counts > 0, board);
        }
    }

    fn encoder_window(&self, _channel: usize) -> Option<(i32, i32)> {
        self.encoder
    }

    fn encoder_moved(&mut self, channel: usize, board: &mut dyn Board) {
        let Some((_, high)) = self.encoder else { return };
        let count = board.encoder(channel);
        self.report(ENCODER, count >= high, board);
        self.encoder = Some((count - ENCODER_ROOM, count + ENCODER_ROOM));
    }

    fn analog_changed(&mut self, pin: usize, board: &mut dyn Board) {
        let value = board.analog(pin);
        let mut bytes = vec![pin as u8, 1];
        bytes.extend(i64::from(value).to_le_bytes());
        board.send(Port::Usb, &bytes, 0);
    }

    fn set_window(&mut self, _axis: usize, low: i64, high: i64) {
        assert!(low < self.odometer && self.odometer < high, "the window is around the odometer");
        self.window = (low, high);
    }

    fn odometer(&self, _axis: usize) -> i64 {
        self.odometer
    }

    fn axis(&self, _axis: usize, board: &mut dyn Board) -> AxisState {
        let speed =
            if self.target == self.odometer { 0 } else { i64::from(CLOCK_HZ) * 1000 / INTERVAL as i64 };
        AxisState {
            position: self.odometer as i32,
            encoder: board.encoder(0),
            speed_mpps: speed * (self.target - self.odometer).signum(),
            target: self.target as i32,
            status: 0,
            steps: self.steps,
        }
    }

    fn program(&self, _index: usize) -> Option<ProgramState> {
        None
    }
}
