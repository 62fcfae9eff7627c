//! A controller that does what a test says, when it says so.

use devices::{AxisState, Board, Controller, Pin, PinKind, Port, ProgramState, Wiring};
use motion::{Ticks, Train};

/// Clocks a second.
pub const HZ: u32 = 16_000_000;

const fn pin(kind: PinKind) -> Pin {
    Pin { name: "", kind, wiring: Wiring::Free, unit: "", scale: 1, rest: 0 }
}

/// Its pins.
pub static PINS: [Pin; 6] = [
    pin(PinKind::Input),
    Pin { rest: 1, ..pin(PinKind::Input) },
    pin(PinKind::Port),
    pin(PinKind::Output),
    Pin { rest: 700, ..pin(PinKind::Analog) },
    pin(PinKind::Analog),
];

/// What it does.
#[derive(Clone, Copy, Debug)]
pub enum Act {
    /// Gives out the pulses of a train, each in its clock.
    Train(usize, Train),
    /// Drives a pin.
    Output(usize, bool),
    /// Lets go of it.
    Release(usize),
    /// Stops short of the clock that it was given, so often.
    Stop(u32),
}

/// The controller.
#[derive(Default)]
pub struct Script {
    pub now: Ticks,
    /// What it does, with the clock.
    pub acts: Vec<(Ticks, Act)>,
    /// How far its encoder may count from the middle before it is told, which is the middle from then on.
    pub window: Option<i32>,
    pub middle: i32,
    /// Whether it has use for counts at its pulser input.
    pub follows: bool,
}

impl Script {
    pub fn new(acts: &[(Ticks, Act)]) -> Self {
        Self { acts: acts.to_vec(), ..Self::default() }
    }
}

impl Controller for Script {
    fn clock_hz(&self) -> u32 {
        HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["0", "1"]
    }

    fn pins(&self) -> &'static [Pin] {
        &PINS
    }

    fn watches(&self, pin: usize) -> bool {
        pin != 5
    }

    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        while let Some(index) = self.acts.iter().position(|(at, _)| *at <= now) {
            let (at, act) = self.acts[index];
            self.now = self.now.max(at);
            board.clock(self.now);
            match act {
                Act::Train(axis, train) => {
                    let done = train.count_until(now);
                    self.acts.remove(index);
                    if done == train.count {
                        board.pulses(axis, &train);
                    } else {
                        let rest = if done > 0 {
                            let (head, tail) = train.split(done);
                            board.pulses(axis, &head);
                            tail
                        } else {
                            train
                        };
                        let next = (rest.edge(1), Act::Train(axis, rest));
                        let index = self.acts.partition_point(|(at, _)| *at <= next.0);
                        self.acts.insert(index, next);
                    }
                }
                Act::Output(pin, on) => {
                    board.output(pin, on);
                    self.acts.remove(index);
                }
                Act::Release(pin) => {
                    board.release(pin);
                    self.acts.remove(index);
                }
                Act::Stop(0) => drop(self.acts.remove(index)),
                Act::Stop(times) => {
                    self.acts[index].1 = Act::Stop(times - 1);
                    return self.now;
                }
            }
        }
        board.clock(now);
        self.now = now;
        now
    }

    fn wake(&self) -> Ticks {
        self.acts.iter().map(|(at, _)| *at).min().unwrap_or(Ticks::MAX)
    }

    fn is_moving(&self) -> bool {
        self.acts.iter().any(|(_, act)| matches!(act, Act::Train(..)))
    }

    /// Sends what it gets back; the first byte is the pause, in milliseconds.
    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        for byte in bytes {
            board.send(port, &[*byte; 40], u32::from(*byte) % 50);
        }
    }

    fn input(&mut self, _: usize, _: bool, _: &mut dyn Board) {}

    fn analog_changed(&mut self, _: usize, _: &mut dyn Board) {}

    fn has_pulser(&self, axis: usize) -> bool {
        axis == 1
    }

    fn watches_pulser(&self, _: usize) -> bool {
        self.follows
    }

    fn encoder_window(&self, channel: usize) -> Option<(i32, i32)> {
        let window = self.window.filter(|_| channel == 0)?;
        Some((self.middle.wrapping_sub(window), self.middle.wrapping_add(window)))
    }

    fn encoder_moved(&mut self, channel: usize, board: &mut dyn Board) {
        self.middle = board.encoder(channel);
    }

    fn set_window(&mut self, _: usize, _: i64, _: i64) {}

    fn odometer(&self, _: usize) -> i64 {
        0
    }

    fn axis(&self, _: usize, _: &mut dyn Board) -> AxisState {
        AxisState::default()
    }

    fn program(&self, _: usize) -> Option<ProgramState> {
        None
    }
}
