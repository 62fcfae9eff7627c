//! Everything around the controller: the board that it acts on.

use crate::{
    SharedFlash,
    config::DeviceConfig,
    machine::{Edge, Machine},
    record::{Mark, Recorder},
};
use devices::{AxisState, Board, Controller, Drive, Pin, PinKind, Port};
use motion::{Moment, Ticks, Train};
use std::collections::VecDeque;

/// Most messages that wait to be taken; older ones are lost.
pub const MAX_SENT: usize = 65_536;

/// Bytes that a controller sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sent {
    /// Device time at which they left, in clocks.
    pub at: Ticks,
    /// Through which port.
    pub port: Port,
    /// The pause that the controller was told to keep before, in milliseconds.
    pub delay_ms: u32,
    /// The bytes.
    pub bytes: Vec<u8>,
}

/// A recorder with its next sample.
struct Recording {
    recorder: Box<dyn Recorder + Send>,
    next_sample: Ticks,
}

pub(super) struct World {
    pub machine: Machine,
    flash: SharedFlash,
    clock_hz: u32,
    pub pins: &'static [Pin],
    /// Device time at clock 0 of the controller.
    pub origin: Ticks,
    /// The controller's clock.
    pub clock: Ticks,
    pub sent: VecDeque<Sent>,
    /// The level of each output, and of each input that was driven by hand.
    driven: Vec<Option<i32>>,
    /// Pulses came or pins were driven since the inputs were last looked at.
    pub stirred: bool,
    /// The odometer window of each axis that the controller was given.
    pub windows: Vec<Option<(i64, i64)>>,
    recordings: Vec<Recording>,
    /// Room for [`window`](Self::window).
    edges: Vec<Edge>,
}

impl World {
    pub fn new(
        config: &DeviceConfig,
        axes: &[&str],
        pins: &'static [Pin],
        flash: SharedFlash,
        clock_hz: u32,
    ) -> Self {
        assert!(pins.len() <= 64, "watched pins are bits of a word");
        Self {
            machine: Machine::new(config, axes, pins),
            flash,
            clock_hz,
            pins,
            origin: 0,
            clock: 0,
            sent: VecDeque::new(),
            driven: vec![None; pins.len()],
            stirred: true,
            windows: vec![None; axes.len()],
            recordings: Vec::new(),
            edges: Vec::with_capacity(pins.len()),
        }
    }

    /// The controller's clock is this; the flash is told how long its operations have had.
    pub fn set_clock(&mut self, clock: Ticks) {
        self.clock = clock;
        self.flash.set_time(self.now(), self.clock_hz);
    }

    /// Device time.
    pub fn now(&self) -> Ticks {
        self.origin + self.clock
    }

    /// The controller starts again at clock 0; its outputs fall to rest.
    pub fn power_up(&mut self) {
        self.origin = self.now();
        self.clock = 0;
        self.machine.power_up();
        self.stirred = true;
        self.windows.fill(None);
        for pin in 0..self.pins.len() {
            if self.pins[pin].kind == PinKind::Output && self.driven[pin].take().is_some() {
                self.record_pin(pin, self.pins[pin].rest);
            }
        }
    }

    /// What is on a pin: what drives it by hand, else the machine, else nothing.
    pub fn level(&self, pin: usize) -> i32 {
        let rest = self.pins[pin].rest;
        if let Some(level) = self.driven[pin] {
            return level;
        }
        match (self.pins[pin].kind, self.machine.is_on(pin)) {
            (PinKind::Analog, _) => self.machine.quantity(pin),
            // A pin that rests at 1 is pulled down by its switch.
            (_, Some(true)) => i32::from(rest == 0),
            (_, _) => rest,
        }
    }

    /// Whether the machine, and nobody's hand, decides what is on a pin.
    pub fn is_free(&self, pin: usize) -> bool {
        self.driven[pin].is_none()
    }

    /// Whether the clock matters at which an input changes: to the controller, or to a recording. Only
    /// index marks are too many to record them all.
    pub fn watches(&self, pin: usize, controller: &dyn Controller) -> bool {
        let recorded = self.is_recording() && self.pins[pin].kind == PinKind::Input;
        !self.is_free(pin) || recorded || controller.watches(pin)
    }

    /// Whether the window of an axis has to be reckoned again: what it was reckoned from is another now,
    /// or the axis has arrived at its edge.
    pub fn is_window_stale(&self, axis: usize) -> bool {
        self.windows[axis].is_none_or(|(low, high)| {
            let odometer = self.machine.odometer(axis);
            odometer <= low || high <= odometer
        })
    }

    /// The inputs that are watched, as bits.
    pub fn watched(&self, controller: &dyn Controller) -> u64 {
        let pins = (0..self.pins.len()).filter(|pin| self.watches(*pin, controller));
        pins.fold(0, |pins, pin| pins | 1 << pin)
    }

    /// How far an axis can go before an input changes that is watched. A pin that is driven by hand does
    /// not care where the shaft is.
    pub fn window(&mut self, axis: usize, controller: &dyn Controller) -> (i64, i64) {
        let mut edges = std::mem::take(&mut self.edges);
        edges.clear();
        edges.extend(
            (0..self.pins.len())
                .filter(|pin| self.machine.is_on_axis(*pin, axis) && self.is_free(*pin))
                .filter(|pin| self.watches(*pin, controller))
                .map(|pin| self.machine.edge(pin)),
        );
        let window = self.machine.window(axis, &edges);
        self.edges = edges;
        window
    }

    /// Drives an input by hand, or gives it back.
    pub fn drive_input(&mut self, pin: usize, level: Option<i32>) {
        self.driven[pin] = level;
        self.stirred = true;
        self.windows.fill(None);
    }

    pub fn add_recorder(&mut self, mut recorder: Box<dyn Recorder + Send>) {
        let now = self.now();
        for pin in 0..self.pins.len() {
            recorder.pin(now, pin, self.level(pin));
        }
        let next_sample = recorder.sample_every().map_or(Ticks::MAX, |_| now);
        self.recordings.push(Recording { recorder, next_sample });
    }

    pub fn take_recorders(&mut self) -> Vec<Box<dyn Recorder + Send>> {
        self.recordings.drain(..).map(|recording| recording.recorder).collect()
    }

    pub fn is_recording(&self) -> bool {
        !self.recordings.is_empty()
    }

    /// The device time of the next sample.
    pub fn next_sample(&self) -> Ticks {
        self.recordings.iter().map(|recording| recording.next_sample).min().unwrap_or(Ticks::MAX)
    }

    /// Gives the recorders their samples that are due.
    pub fn sample(&mut self, states: &[AxisState]) {
        let now = self.now();
        for Recording { recorder, next_sample } in &mut self.recordings {
            if *next_sample > now {
                continue;
            }
            for (axis, state) in states.iter().enumerate() {
                recorder.sample(now, axis, state);
            }
            let every = recorder.sample_every().map_or(Ticks::MAX, |every| every.max(1));
            *next_sample = next_sample.saturating_add(every);
        }
    }

    pub fn record_pin(&mut self, pin: usize, level: i32) {
        let now = self.now();
        self.each(|recorder| recorder.pin(now, pin, level));
    }

    pub fn record_mark(&mut self, axis: usize, mark: Mark) {
        let now = self.now();
        self.each(|recorder| recorder.mark(now, axis, mark));
    }

    fn each(&mut self, mut tell: impl FnMut(&mut dyn Recorder)) {
        for recording in &mut self.recordings {
            tell(recording.recorder.as_mut());
        }
    }
}

impl Board for World {
    fn clock(&mut self, now: Ticks) {
        self.set_clock(now);
    }

    fn pulses(&mut self, axis: usize, train: &Train) {
        self.machine.follow(axis, train);
        self.stirred = true;
        if let Some((low, high)) = self.windows[axis] {
            let odometer = self.machine.odometer(axis);
            assert!(low <= odometer && odometer <= high, "axis {axis} went past its window to {odometer}");
        }
        if !self.recordings.is_empty() {
            let start = Moment { ticks: train.start.ticks + self.origin, ..train.start };
            let train = Train { start, ..*train };
            self.each(|recorder| recorder.train(axis, &train));
        }
    }

    fn drive(&mut self, axis: usize, drive: Drive) {
        self.machine.set_drive(axis, drive);
        // The window was reckoned with another step.
        self.windows[axis] = None;
        self.stirred = true;
        let now = self.now();
        self.each(|recorder| recorder.drive(now, axis, drive));
    }

    fn send(&mut self, port: Port, bytes: &[u8], delay_ms: u32) {
        if self.sent.len() == MAX_SENT {
            self.sent.pop_front();
        }
        self.sent.push_back(Sent { at: self.now(), port, delay_ms, bytes: bytes.into() });
    }

    fn output(&mut self, pin: usize, on: bool) {
        let level = i32::from(on);
        if self.driven[pin].unwrap_or(self.pins[pin].rest) != level {
            self.record_pin(pin, level);
        }
        self.driven[pin] = Some(level);
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        self.machine.encoder(channel)
    }

    fn digital(&mut self, pin: usize) -> bool {
        self.level(pin) != 0
    }

    fn load(&mut self, axis: usize) -> u16 {
        self.machine.load_permille(axis)
    }

    fn analog(&mut self, pin: usize) -> i32 {
        self.level(pin)
    }
}
