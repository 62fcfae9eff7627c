//! A servo driver that says when its motor has followed all pulses.

use motion::Ticks;

/// The in-position signal: off with the first pulse, on again some time after the last one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Servo {
    delay: Ticks,
    /// When it will be in position; `None` while it is.
    due: Option<Ticks>,
}

impl Servo {
    /// In position now, and so many clocks after each pulse that no other follows.
    pub const fn new(delay: Ticks) -> Self {
        Self { delay, due: None }
    }

    /// Pulses came, the last of them at this time.
    pub fn follow(&mut self, last: Ticks) {
        self.due = Some(last.saturating_add(self.delay));
    }

    /// When it comes into position; `None` if it is.
    pub const fn due(&self) -> Option<Ticks> {
        self.due
    }

    /// Whether it has come into position by `now`, since it was asked last.
    pub fn settle(&mut self, now: Ticks) -> bool {
        self.due.take_if(|due| *due <= now).is_some()
    }

    /// Whether it is in position.
    pub fn is_in_position(&self, now: Ticks) -> bool {
        self.due.is_none_or(|due| due <= now)
    }
}
