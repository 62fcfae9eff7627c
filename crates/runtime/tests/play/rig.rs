//! A board that is not there: a timer in virtual time, pins that write down what happens to them, pipes for bytes.

use devices::{Drive, Port};
use motion::Direction;
use runtime::hardware::TICK_HZ;
use runtime::{Figures, Hardware, Pins, Player, Serial, Timer};
use std::cell::Cell;
use std::collections::{HashMap, VecDeque};
use std::rc::Rc;

/// How long a look at the timer takes, as a part of a second.
const LOOK: u32 = 25_000_000;

/// The time since the start, which passes by being looked at too.
#[derive(Clone, Default)]
pub struct Time {
    now: Rc<Cell<u64>>,
    looks: Rc<Cell<u32>>,
}

pub struct Alarm<const HZ: u32> {
    time: Time,
    at: Option<u64>,
}

impl<const HZ: u32> Timer for Alarm<HZ> {
    const HZ: u32 = HZ;

    fn now(&self) -> u32 {
        self.time.look(HZ)
    }

    fn set_alarm(&mut self, at: Option<u32>) {
        let now = self.time.now.get();
        self.at = at.map(|at| now.saturating_add_signed(i64::from(at.wrapping_sub(now as u32) as i32)));
    }
}

impl Time {
    fn look(&self, hz: u32) -> u32 {
        // A slow timer stands still for some looks.
        let looks = self.looks.get() + 1;
        if looks >= LOOK.div_ceil(hz) {
            self.looks.set(0);
            self.now.set(self.now.get() + 1);
        } else {
            self.looks.set(looks);
        }
        self.now.get() as u32
    }
}

/// What happened at the pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A pulse, as the direction pin says; when it was due.
    Pulse(usize, Direction, u32),
    Drive(usize, Drive),
    Output(usize, bool),
    Release(usize),
    Analog(usize, i32),
}

/// The pins, and everything that happened to them with its tick.
#[derive(Default)]
pub struct Recorder {
    time: Time,
    directions: HashMap<usize, Direction>,
    stepping: u8,
    pub log: Vec<(u64, What)>,
    /// Calls of `step`, for those who count.
    pub steps: usize,
}

impl Recorder {
    fn write(&mut self, what: What) {
        self.log.push((self.time.now.get(), what));
    }
}

impl Pins for Recorder {
    fn direction(&mut self, axis: usize, direction: Direction) {
        assert_eq!(self.stepping, 0, "a direction changes between pulses");
        assert_ne!(self.directions.insert(axis, direction), Some(direction), "it changes");
    }

    fn step(&mut self, axes: u8) {
        assert_eq!(std::mem::replace(&mut self.stepping, axes), 0, "pulses end");
        assert_ne!(axes, 0);
        self.steps += 1;
    }

    fn step_end(&mut self, axes: u8) {
        assert_eq!(std::mem::take(&mut self.stepping), axes, "the pulses that began end");
    }

    fn drive(&mut self, axis: usize, drive: Drive) {
        self.write(What::Drive(axis, drive));
    }

    fn output(&mut self, pin: usize, on: bool) {
        self.write(What::Output(pin, on));
    }

    fn release(&mut self, pin: usize) {
        self.write(What::Release(pin));
    }

    fn output_analog(&mut self, pin: usize, value: i32) {
        self.write(What::Analog(pin, value));
    }

    fn played(&mut self, axis: usize, direction: Direction, due: u32, _: u32) {
        assert_ne!(self.stepping >> axis & 1, 0, "it steps");
        assert_eq!(self.directions.get(&axis), Some(&direction), "the pin was set before");
        self.write(What::Pulse(axis, direction, due));
    }
}

/// One end of a serial line. So many bytes at a time can be written.
#[derive(Default)]
pub struct Pipe {
    pub to_device: VecDeque<u8>,
    /// What it sent, with the time of each byte.
    pub from_device: Vec<(u64, u8)>,
    pub room: usize,
    pub talking: bool,
    time: Time,
}

impl embedded_io::ErrorType for Pipe {
    type Error = core::convert::Infallible;
}

impl embedded_io::Read for Pipe {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        let count = bytes.len().min(self.to_device.len());
        assert!(count > 0, "a read would block");
        for (byte, sent) in bytes.iter_mut().zip(self.to_device.drain(..count)) {
            *byte = sent;
        }
        Ok(count)
    }
}

impl embedded_io::ReadReady for Pipe {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(!self.to_device.is_empty())
    }
}

impl embedded_io::Write for Pipe {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        assert!(self.talking, "the bus is ours");
        let count = bytes.len().min(self.room);
        assert!(count > 0, "a write would block");
        self.room -= count;
        let now = self.time.now.get();
        self.from_device.extend(bytes[..count].iter().map(|byte| (now, *byte)));
        Ok(count)
    }

    fn flush(&mut self) -> Result<(), Self::Error> {
        Ok(())
    }
}

impl embedded_io::WriteReady for Pipe {
    fn write_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(self.room > 0)
    }
}

impl Serial for Pipe {
    fn begin(&mut self) {
        assert!(!std::mem::replace(&mut self.talking, true));
    }

    fn is_sent(&mut self) -> bool {
        self.room > 0
    }

    fn end(&mut self) {
        assert!(std::mem::take(&mut self.talking));
    }
}

/// The board.
pub struct Rig<'q, const AXES: usize, const HZ: u32> {
    time: Time,
    alarm: Alarm<HZ>,
    player: Player<'q, AXES>,
    pub pins: Recorder,
    ports: [(Port, Pipe); 2],
    next_tick: u64,
    ticked: bool,
    /// How long after each interrupt the main loop wakes.
    pub latency: u64,
    /// Levels and values of inputs that are not at rest; encoders; counters of pulsers.
    pub inputs: HashMap<usize, i32>,
    pub encoders: HashMap<usize, i32>,
    pub pulsers: HashMap<usize, i32>,
    rests: Vec<i32>,
    pub feeds: usize,
    pub figures: Figures,
}

impl<'q, const AXES: usize, const HZ: u32> Rig<'q, AXES, HZ> {
    /// A board whose timer starts from somewhere.
    pub fn new(player: Player<'q, AXES>, pins: &[devices::Pin], start: u64) -> Self {
        let time = Time::default();
        time.now.set(start);
        let pipe = || Pipe { room: usize::MAX, time: time.clone(), ..Pipe::default() };
        Self {
            alarm: Alarm { time: time.clone(), at: None },
            player,
            pins: Recorder { time: time.clone(), ..Recorder::default() },
            ports: [(Port::Usb, pipe()), (Port::Rs485, pipe())],
            next_tick: start + 7,
            ticked: false,
            latency: 0,
            inputs: HashMap::new(),
            encoders: HashMap::new(),
            pulsers: HashMap::new(),
            rests: pins.iter().map(|pin| pin.rest).collect(),
            feeds: 0,
            figures: Figures::default(),
            time,
        }
    }

    pub fn time(&self) -> u64 {
        self.time.now.get()
    }

    pub fn port(&mut self, port: Port) -> &mut Pipe {
        let found = self.ports.iter_mut().find(|(other, _)| *other == port);
        &mut found.unwrap().1
    }

    /// Time passes; the player's interrupts come.
    pub fn pass(&mut self, ticks: u64) {
        let until = self.time() + ticks;
        while let Some(at) = self.alarm.at.filter(|at| *at <= until) {
            self.stall(at.saturating_sub(self.time()));
            self.play();
        }
        self.stall(until.saturating_sub(self.time()));
    }

    /// Time passes with all interrupts off.
    pub fn stall(&mut self, ticks: u64) {
        self.time.now.set(self.time() + ticks);
        while self.next_tick <= self.time() {
            self.next_tick += u64::from(HZ / TICK_HZ);
            self.ticked = true;
        }
    }

    fn play(&mut self) {
        self.alarm.at = None;
        self.player.play(&mut self.alarm, &mut self.pins);
    }

    fn pin(&self, pin: usize) -> i32 {
        self.inputs.get(&pin).copied().unwrap_or(self.rests[pin])
    }
}

impl<const AXES: usize, const HZ: u32> Hardware for Rig<'_, AXES, HZ> {
    type Serial = Pipe;
    type Timer = Alarm<HZ>;

    fn now(&self) -> u32 {
        self.time() as u32
    }

    fn kick(&mut self) {
        self.play();
    }

    fn rest(&mut self) {
        let next = self.alarm.at.unwrap_or(u64::MAX).min(self.next_tick);
        self.pass(next.saturating_sub(self.time()));
        self.pass(self.latency);
    }

    fn ticked(&mut self) -> bool {
        self.stall(0);
        std::mem::take(&mut self.ticked)
    }

    fn feed(&mut self) {
        self.feeds += 1;
    }

    fn ports(&mut self) -> &mut [(Port, Pipe)] {
        &mut self.ports
    }

    fn level(&mut self, pin: usize) -> bool {
        self.pin(pin) != 0
    }

    fn analog(&mut self, pin: usize) -> i32 {
        self.pin(pin)
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        self.encoders.get(&channel).copied().unwrap_or(0)
    }

    fn pulser(&mut self, axis: usize) -> i32 {
        self.pulsers.get(&axis).copied().unwrap_or(0)
    }

    fn report(&mut self, figures: &Figures) {
        self.figures = *figures;
    }
}
