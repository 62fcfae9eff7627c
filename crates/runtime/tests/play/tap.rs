//! A controller whose board is listened to: what it gave out is what the pins must show.

use crate::rig::What;
use devices::{AxisState, Board, Controller, Drive, Pin, Port, ProgramState};
use motion::{Ticks, Train};

/// What the controller did.
#[derive(Clone, Copy, Debug)]
pub enum Given {
    /// Pulses of an axis.
    Train(usize, Train),
    /// Something else, at a clock.
    Event(Ticks, What),
}

/// The controller with what was heard.
pub struct Tap<C> {
    pub inner: C,
    pub given: Vec<Given>,
    pub sent: Vec<(Port, Vec<u8>, u32)>,
    /// What it was told of: pins with their levels, analog pins with their values, encoders, counts.
    pub told: Vec<(&'static str, usize, i32)>,
    clock: Ticks,
}

impl<C> Tap<C> {
    pub fn new(inner: C) -> Self {
        Self { inner, given: Vec::new(), sent: Vec::new(), told: Vec::new(), clock: 0 }
    }
}

struct Ear<'a> {
    board: &'a mut dyn Board,
    given: &'a mut Vec<Given>,
    sent: &'a mut Vec<(Port, Vec<u8>, u32)>,
    clock: &'a mut Ticks,
}

impl Ear<'_> {
    fn event(&mut self, what: What) {
        self.given.push(Given::Event(*self.clock, what));
    }
}

impl Board for Ear<'_> {
    fn clock(&mut self, now: Ticks) {
        assert!(now >= *self.clock);
        *self.clock = now;
        self.board.clock(now);
    }

    fn pulses(&mut self, axis: usize, train: &Train) {
        self.given.push(Given::Train(axis, *train));
        self.board.pulses(axis, train);
    }

    fn drive(&mut self, axis: usize, drive: Drive) {
        self.event(What::Drive(axis, drive));
        self.board.drive(axis, drive);
    }

    fn send(&mut self, port: Port, bytes: &[u8], delay_ms: u32) {
        self.sent.push((port, bytes.into(), delay_ms));
        self.board.send(port, bytes, delay_ms);
    }

    fn output(&mut self, pin: usize, on: bool) {
        self.event(What::Output(pin, on));
        self.board.output(pin, on);
    }

    fn release(&mut self, pin: usize) {
        self.event(What::Release(pin));
        self.board.release(pin);
    }

    fn output_analog(&mut self, pin: usize, value: i32) {
        self.event(What::Analog(pin, value));
        self.board.output_analog(pin, value);
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        self.board.encoder(channel)
    }

    fn digital(&mut self, pin: usize) -> bool {
        self.board.digital(pin)
    }

    fn load(&mut self, axis: usize) -> u16 {
        self.board.load(axis)
    }

    fn analog(&mut self, pin: usize) -> i32 {
        self.board.analog(pin)
    }
}

macro_rules! ear {
    ($tap:ident, $board:ident) => {
        (
            &mut $tap.inner,
            &mut Ear { board: $board, given: &mut $tap.given, sent: &mut $tap.sent, clock: &mut $tap.clock },
        )
    };
}

impl<C: Controller> Controller for Tap<C> {
    fn clock_hz(&self) -> u32 {
        self.inner.clock_hz()
    }

    fn axes(&self) -> &'static [&'static str] {
        self.inner.axes()
    }

    fn pins(&self) -> &'static [Pin] {
        self.inner.pins()
    }

    fn watches(&self, pin: usize) -> bool {
        self.inner.watches(pin)
    }

    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        let (inner, ear) = ear!(self, board);
        inner.advance(now, ear)
    }

    fn wake(&self) -> Ticks {
        self.inner.wake()
    }

    fn is_moving(&self) -> bool {
        self.inner.is_moving()
    }

    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        let (inner, ear) = ear!(self, board);
        inner.receive(port, bytes, ear);
    }

    fn input(&mut self, pin: usize, on: bool, board: &mut dyn Board) {
        self.told.push(("input", pin, on.into()));
        let (inner, ear) = ear!(self, board);
        inner.input(pin, on, ear);
    }

    fn analog_changed(&mut self, pin: usize, board: &mut dyn Board) {
        self.told.push(("analog", pin, board.analog(pin)));
        let (inner, ear) = ear!(self, board);
        inner.analog_changed(pin, ear);
    }

    fn has_pulser(&self, axis: usize) -> bool {
        self.inner.has_pulser(axis)
    }

    fn watches_pulser(&self, axis: usize) -> bool {
        self.inner.watches_pulser(axis)
    }

    fn pulser(&mut self, axis: usize, counts: i32, board: &mut dyn Board) {
        self.told.push(("pulser", axis, counts));
        let (inner, ear) = ear!(self, board);
        inner.pulser(axis, counts, ear);
    }

    fn encoder_window(&self, channel: usize) -> Option<(i32, i32)> {
        self.inner.encoder_window(channel)
    }

    fn encoder_moved(&mut self, channel: usize, board: &mut dyn Board) {
        self.told.push(("encoder", channel, board.encoder(channel)));
        let (inner, ear) = ear!(self, board);
        inner.encoder_moved(channel, ear);
    }

    fn set_window(&mut self, axis: usize, low: i64, high: i64) {
        self.inner.set_window(axis, low, high);
    }

    fn odometer(&self, axis: usize) -> i64 {
        self.inner.odometer(axis)
    }

    fn axis(&self, axis: usize, board: &mut dyn Board) -> AxisState {
        self.inner.axis(axis, board)
    }

    fn program(&self, index: usize) -> Option<ProgramState> {
        self.inner.program(index)
    }
}
