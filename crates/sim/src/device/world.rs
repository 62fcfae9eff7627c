//! Everything around the controller: the board that it acts on.

use super::{
    held::Held,
    traps::{Seen, Traps},
};
use crate::{
    SharedFlash,
    config::DeviceConfig,
    fault::{
        Way,
        wire::{Parcel, Wire},
    },
    machine::{Edge, Machine},
    record::{Mark, Note, RecordError, Recorder},
};
use devices::{AxisState, Board, Controller, Drive, Pin, PinKind, Port, Wiring};
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

/// Most pins that hang on the axes of a device.
pub const MAX_CONTACTS: usize = u64::BITS as usize;

/// Which inputs may have changed since they were last looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) enum Stirred {
    #[default]
    None,
    /// Those that hang on the axes.
    Contacts,
    /// Any.
    Pins,
}

/// What the windows of the axes are reckoned from, beside where the shafts are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Watched {
    /// The contacts, as bits in their order.
    contacts: u64,
    /// The window that the controller has for each encoder.
    encoders: Vec<Option<(i32, i32)>>,
    /// Whether an axis follows each encoder.
    followed: Vec<bool>,
}

/// An axis' pulser input that is wired to an encoder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Follower {
    pub axis: usize,
    pub channel: usize,
    /// The encoder's count that the controller knows.
    pub count: i32,
    /// Whether the controller had use for it when it was looked at last.
    pub watched: bool,
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
    /// The pins that hang on the axes.
    pub contacts: Vec<usize>,
    /// What the controller has put on each pin.
    outputs: Vec<Option<i32>>,
    /// What each pin is driven to by hand. A port that is an output does not show it.
    hands: Held,
    /// The levels of inputs that are stuck.
    pub stuck: Held,
    pub traps: Traps,
    pub wire: Wire,
    /// What the recordings were told of each pin last; empty before the first recording.
    shown: Vec<i32>,
    pub stirred: Stirred,
    watched: Watched,
    pub followers: Vec<Follower>,
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
        seed: u64,
    ) -> Self {
        let machine = Machine::new(config, axes, pins, clock_hz, seed);
        let contacts: Vec<_> = (0..pins.len()).filter(|pin| machine.hangs_on_axis(*pin)).collect();
        assert!(contacts.len() <= MAX_CONTACTS, "watched contacts are bits of a word");
        let follower = |(axis, name): (usize, &&str)| {
            let channel = machine.encoder_of(config.axis(name).mpg_from?)?;
            Some(Follower { axis, channel, count: 0, watched: false })
        };
        Self {
            followers: axes.iter().enumerate().filter_map(follower).collect(),
            watched: Watched {
                contacts: 0,
                encoders: vec![None; machine.encoders()],
                followed: vec![false; machine.encoders()],
            },
            machine,
            flash,
            clock_hz,
            pins,
            origin: 0,
            clock: 0,
            sent: VecDeque::new(),
            outputs: vec![None; pins.len()],
            hands: Held::default(),
            stuck: Held::default(),
            traps: Traps::default(),
            wire: Wire::new(clock_hz, seed),
            shown: Vec::new(),
            stirred: Stirred::Pins,
            windows: vec![None; axes.len()],
            recordings: Vec::new(),
            edges: Vec::new(),
            contacts,
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
        self.stirred = Stirred::Pins;
        self.windows.fill(None);
        for pin in 0..self.pins.len() {
            if self.outputs[pin].take().is_some() {
                self.show(pin);
            }
        }
    }

    /// What is on a pin: what the controller drives, else where it is stuck, else what a hand does, else the
    /// machine, else nothing.
    pub fn level(&self, pin: usize) -> i32 {
        let rest = self.pins[pin].rest;
        if let Some(level) = self.outputs[pin].or(self.stuck.level(pin)).or(self.hands.level(pin)) {
            return level;
        }
        if self.pins[pin].kind.is_analog() {
            return self.machine.quantity(pin);
        }
        match self.machine.is_on(pin, self.now()) {
            // A pin that rests at 1 is pulled down by its switch.
            Some(true) => i32::from(rest == 0),
            _ => rest,
        }
    }

    /// Whether the controller drives a pin now.
    pub fn is_output(&self, pin: usize) -> bool {
        self.pins[pin].kind.is_output() || self.outputs[pin].is_some()
    }

    /// Whether the machine, and nobody's hand, decides what is on a pin.
    pub fn is_free(&self, pin: usize) -> bool {
        self.hands.level(pin).is_none() && self.stuck.level(pin).is_none()
    }

    /// Whether the clock matters at which an input changes: to the controller, or to a recording. Only
    /// index marks are too many to record them all.
    pub fn watches(&self, pin: usize, controller: &dyn Controller) -> bool {
        let recorded = self.is_recording() && matches!(self.pins[pin].kind, PinKind::Input | PinKind::Port);
        let matters = self.machine.remembers(pin) || self.traps.watches(pin);
        !self.is_free(pin) || recorded || matters || controller.watches(pin)
    }

    /// Whether the window of an axis has to be reckoned again: what it was reckoned from is another now,
    /// or the axis has arrived at its edge.
    pub fn is_window_stale(&self, axis: usize) -> bool {
        self.windows[axis].is_none_or(|(low, high)| {
            let odometer = self.machine.odometer(axis);
            odometer <= low || high <= odometer
        })
    }

    /// Looks at what the controller watches. Windows that were reckoned from something else are forgotten.
    pub fn look_at_watches(&mut self, controller: &dyn Controller) {
        let watched = self.contacts.iter().enumerate().filter(|(_, pin)| self.watches(**pin, controller));
        let contacts = watched.fold(0, |bits, (bit, _)| bits | 1 << bit);
        if std::mem::replace(&mut self.watched.contacts, contacts) != contacts {
            self.windows.fill(None);
        }
        for follower in &mut self.followers {
            follower.watched = controller.watches_pulser(follower.axis);
        }
        for channel in 0..self.machine.encoders() {
            let window = controller.encoder_window(channel);
            let followed = self.followers.iter().any(|other| other.watched && other.channel == channel);
            let changed = std::mem::replace(&mut self.watched.encoders[channel], window) != window;
            if std::mem::replace(&mut self.watched.followed[channel], followed) != followed || changed {
                self.windows[self.machine.axis_of(channel)] = None;
            }
        }
    }

    /// How far an axis can go before an input changes that is watched, or an encoder counts that is. A pin
    /// that is driven by hand does not care where the shaft is.
    pub fn window(&mut self, axis: usize) -> (i64, i64) {
        let mut edges = std::mem::take(&mut self.edges);
        edges.clear();
        let mut at_once = false;
        for (bit, &pin) in self.contacts.iter().enumerate() {
            if self.watched.contacts >> bit & 1 != 0 && self.is_free(pin) {
                edges.extend(self.machine.edge(pin, axis));
                at_once |= self.machine.ends_with_pulse(pin, axis, self.now());
            }
        }
        edges.extend(self.traps.edges(axis, &self.machine));
        for channel in (0..self.machine.encoders()).filter(|&other| self.machine.axis_of(other) == axis) {
            if let Some((down, up)) = self.encoder_room(channel, self.watched.encoders[channel]) {
                edges.push(self.machine.encoder_edge(channel, down, up));
            }
            if self.watched.followed[channel] {
                edges.push(self.machine.encoder_edge(channel, 1, 1));
            }
        }
        let (low, high) = self.machine.window(axis, &edges);
        self.edges = edges;
        if at_once {
            let odometer = self.machine.odometer(axis);
            return (odometer - 1, odometer + 1);
        }
        (low, high)
    }

    /// How far an encoder can count down and up within a window; `None` without one.
    ///
    /// # Panics
    /// If it stands at an end of the window or beyond.
    fn encoder_room(&self, channel: usize, window: Option<(i32, i32)>) -> Option<(u32, u32)> {
        let (low, high) = window?;
        let count = self.machine.encoder(channel);
        assert!(is_between(count, window?), "encoder {channel} stands at {count}, not in its window");
        Some((count.wrapping_sub(low) as u32, high.wrapping_sub(count) as u32))
    }

    /// Whether an encoder has arrived at an end of this window.
    pub fn is_at_encoder_window(&self, channel: usize, window: (i32, i32)) -> bool {
        !is_between(self.machine.encoder(channel), window)
    }

    /// Servo drivers whose time has come are in position, and contacts that bounce change.
    pub fn settle_contacts(&mut self) {
        while let Some(axis) = self.machine.take_in_position(self.now()) {
            self.windows[axis] = None;
            self.stir(Stirred::Contacts);
        }
        while self.machine.take_bounce(self.now()) {
            self.stir(Stirred::Contacts);
        }
    }

    pub fn stir(&mut self, stirred: Stirred) {
        self.stirred = self.stirred.max(stirred);
    }

    /// Drives an input by hand, or gives it back.
    pub fn drive_input(&mut self, pin: usize, level: Option<i32>) {
        self.hands.set(pin, level);
        self.stirred = Stirred::Pins;
        self.windows.fill(None);
    }

    /// The volts that somebody gives the motors by hand. A supply has no sign.
    pub fn supply_by_hand(&self) -> Option<f64> {
        let measures = |pin: &usize| self.pins[*pin].wiring == Wiring::Supply;
        let pin = (0..self.pins.len()).find(measures)?;
        Some((f64::from(self.hands.level(pin)?) / f64::from(self.pins[pin].scale)).max(0.0))
    }

    pub fn add_recorder(&mut self, mut recorder: Box<dyn Recorder + Send>) {
        let now = self.now();
        self.shown = (0..self.pins.len()).map(|pin| self.level(pin)).collect();
        for (pin, level) in self.shown.iter().enumerate() {
            recorder.pin(now, pin, *level);
        }
        let next_sample = recorder.sample_every().map_or(Ticks::MAX, |_| now);
        self.recordings.push(Recording { recorder, next_sample });
    }

    /// Ends the recordings. The axes are shown once more, since they may have moved after the last sample.
    pub fn finish_recordings(&mut self, states: &[AxisState]) -> Result<(), RecordError> {
        let now = self.now();
        let mut result = Ok(());
        for Recording { mut recorder, next_sample } in self.recordings.drain(..) {
            if recorder.sample_every().is_some_and(|every| next_sample < now.saturating_add(every)) {
                show(&mut *recorder, now, states);
            }
            result = result.and(recorder.finish(now));
        }
        result
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
            show(&mut **recorder, now, states);
            let every = recorder.sample_every().map_or(Ticks::MAX, |every| every.max(1));
            *next_sample = next_sample.saturating_add(every);
        }
    }

    /// Tells the recordings what is on a pin, unless they know.
    pub fn record_pin(&mut self, pin: usize, level: i32) {
        if !self.is_recording() || std::mem::replace(&mut self.shown[pin], level) == level {
            return;
        }
        let now = self.now();
        self.each(|recorder| recorder.pin(now, pin, level));
    }

    pub fn record_mark(&mut self, axis: usize, mark: Mark) {
        let now = self.now();
        self.each(|recorder| recorder.mark(now, axis, mark));
    }

    pub fn record_note(&mut self, note: Note, text: &str) {
        let now = self.now();
        self.each(|recorder| recorder.note(now, note, text));
    }

    pub fn record_received(&mut self, port: Port, bytes: &[u8]) {
        let now = self.now();
        self.each(|recorder| recorder.received(now, port, bytes));
    }

    fn put_out(&mut self, pin: usize, level: i32) {
        self.outputs[pin] = Some(level);
        self.show(pin);
    }

    /// The controller has changed what is on a pin.
    fn show(&mut self, pin: usize) {
        let level = self.level(pin);
        self.traps.see(pin, level, Seen::Later);
        self.record_pin(pin, level);
    }

    /// Whoever listens at the other end of a wire hears something that the controller did not send.
    pub fn overhear(&mut self, port: Port, bytes: &[u8]) {
        self.arrive(Sent { at: self.now(), port, delay_ms: 0, bytes: bytes.into() });
    }

    /// What was late and has arrived by now goes to those who listen.
    pub fn take_in(&mut self) {
        while let Some(Parcel { due, port, delay_ms, bytes }) = self.wire.take(Way::Out, self.now()) {
            self.arrive(Sent { at: due, port, delay_ms, bytes });
        }
    }

    fn arrive(&mut self, sent: Sent) {
        if self.sent.len() == MAX_SENT {
            self.sent.pop_front();
        }
        self.sent.push_back(sent);
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
        self.machine.follow(axis, train, self.origin + train.end());
        self.stir(Stirred::Contacts);
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
        self.stir(Stirred::Contacts);
        let now = self.now();
        self.each(|recorder| recorder.drive(now, axis, drive));
    }

    fn send(&mut self, port: Port, bytes: &[u8], delay_ms: u32) {
        let now = self.now();
        self.each(|recorder| recorder.sent(now, port, bytes));
        if self.wire.is_sound() {
            return self.arrive(Sent { at: now, port, delay_ms, bytes: bytes.into() });
        }
        self.take_in();
        let mut arrived = Vec::new();
        self.wire.pass(Way::Out, now, (port, delay_ms, bytes), |bytes| arrived.push(bytes.to_vec()));
        arrived.into_iter().for_each(|bytes| self.arrive(Sent { at: now, port, delay_ms, bytes }));
    }

    fn output(&mut self, pin: usize, on: bool) {
        assert!(!self.pins[pin].kind.is_analog(), "a level is for a digital pin");
        self.put_out(pin, i32::from(on));
    }

    fn release(&mut self, pin: usize) {
        assert_eq!(self.pins[pin].kind, PinKind::Port, "only a port can become an input");
        if self.outputs[pin].take().is_some() {
            self.show(pin);
            self.stirred = Stirred::Pins;
        }
    }

    fn output_analog(&mut self, pin: usize, value: i32) {
        assert_eq!(self.pins[pin].kind, PinKind::AnalogOutput, "a number is for an analog output");
        self.put_out(pin, value);
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

/// Whether a count lies strictly between two others, on the circle that it counts on.
fn is_between(count: i32, (low, high): (i32, i32)) -> bool {
    let (beyond, whole) = (count.wrapping_sub(low) as u32, high.wrapping_sub(low) as u32);
    beyond != 0 && (beyond < whole || whole == 0)
}

fn show(recorder: &mut (dyn Recorder + Send), now: Ticks, states: &[AxisState]) {
    for (axis, state) in states.iter().enumerate() {
        recorder.sample(now, axis, state);
    }
}

#[cfg(test)]
mod tests {
    use super::is_between;

    #[test]
    fn counts_lie_on_a_circle() {
        let (low, high) = (i32::MIN, i32::MAX);
        for (count, window, expected) in [
            (5, (0, 10), true),
            (0, (0, 10), false),
            (10, (0, 10), false),
            (-1, (0, 10), false),
            (low, (high, low + 1), true),
            (high, (high, low + 1), false),
            (0, (high - 5, low + 5), false),
            (6, (5, 5), true),
            (4, (5, 5), true),
            (5, (5, 5), false),
        ] {
            assert_eq!(is_between(count, window), expected, "{count} in {window:?}");
        }
    }
}
