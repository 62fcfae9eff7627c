//! What an axis does to a pin: a switch or mark along its way, or the signal of its servo driver.

use super::{bounce::Bounce, shaft::Side, zone::Zone};
use motion::Ticks;

/// A switch, mark or signal.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    pub mover: Mover,
    /// What it is beside where its axis is now; most contacts are nothing beside.
    memory: Option<Box<Memory>>,
}

/// What closes a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Mover {
    /// A shaft in a zone.
    Shaft { axis: usize, side: Side, zone: Zone },
    /// The servo driver, when it has followed all pulses.
    InPosition { axis: usize },
}

/// A contact that bounces.
#[derive(Clone, Debug)]
struct Memory {
    on: bool,
    bounce: Bounce,
}

impl Contact {
    pub const fn new(mover: Mover) -> Self {
        Self { mover, memory: None }
    }

    /// Where along its axis it is on; `None` for a signal.
    pub fn zone(&self) -> Option<(usize, Side, Zone)> {
        match self.mover {
            Mover::Shaft { axis, side, zone } => Some((axis, side, zone)),
            Mover::InPosition { .. } => None,
        }
    }

    /// Whether it has to be told of every change: what is on it depends on when that was.
    pub fn remembers(&self) -> bool {
        self.memory.is_some()
    }

    /// Lets it bounce from its next change on, or no longer. It is on or off now.
    pub fn set_bounce(&mut self, bounce: Option<Bounce>, on: bool) {
        self.memory = bounce.map(|bounce| Box::new(Memory { on, bounce }));
    }

    /// Its mover is on or off now.
    pub fn update(&mut self, on: bool, now: Ticks) {
        if let Some(memory) = &mut self.memory
            && memory.on != on
        {
            memory.on = on;
            memory.bounce.begin(now);
        }
    }

    /// What is seen of it while its mover is on or off.
    pub fn shown(&self, on: bool) -> bool {
        self.memory.as_ref().is_some_and(|memory| memory.bounce.is_apart()) != on
    }

    /// When it opens or closes without its mover; [`Ticks::MAX`] if it does not.
    pub fn due(&self) -> Ticks {
        self.memory.as_ref().map_or(Ticks::MAX, |memory| memory.bounce.next())
    }

    /// Whether it has opened or closed by `now`, since it was asked last.
    pub fn settle(&mut self, now: Ticks) -> bool {
        self.memory.as_mut().is_some_and(|memory| memory.bounce.take(now))
    }
}
