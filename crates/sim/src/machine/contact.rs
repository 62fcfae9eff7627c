//! What an axis does to a pin: a switch or mark along its way, or the signal of its servo driver.

use super::{bounce::Bounce, shaft::Side, zone::Zone};
use motion::Ticks;

/// Those of a device, by pin.
#[derive(Debug)]
pub(crate) struct Contacts {
    all: Vec<Contact>,
    /// Where that of each pin is among them: [`NONE`](Self::NONE) for most pins.
    places: Vec<u8>,
}

impl Contacts {
    const NONE: u8 = u8::MAX;

    /// # Panics
    /// If there are more than a place can tell.
    pub fn new(pins: impl Iterator<Item = Option<Contact>>) -> Self {
        let mut all = Vec::new();
        let places = pins.map(|contact| {
            let Some(contact) = contact else { return Self::NONE };
            assert!(all.len() < usize::from(Self::NONE), "places of contacts are bytes");
            all.push(contact);
            all.len() as u8 - 1
        });
        let places = places.collect();
        all.shrink_to_fit();
        Self { all, places }
    }

    #[inline]
    pub fn get(&self, pin: usize) -> Option<&Contact> {
        self.all.get(usize::from(self.places[pin]))
    }

    #[inline]
    pub fn get_mut(&mut self, pin: usize) -> Option<&mut Contact> {
        self.all.get_mut(usize::from(self.places[pin]))
    }
}

/// A switch, mark or signal.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    pub mover: Mover,
    /// Where its shaft was when it was looked at last.
    pub seen_at: i64,
    /// Whether it is seen off while it is on.
    pub normally_closed: bool,
    /// What it is beside where its axis is now; most contacts are nothing beside.
    memory: Option<Box<Memory>>,
}

/// What turns a contact on.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Mover {
    /// A shaft in a zone.
    Shaft { axis: usize, side: Side, zone: Zone },
    /// The servo driver, when it has followed all pulses.
    InPosition { axis: usize },
}

/// A contact that depends on what it was.
#[derive(Clone, Debug, Default)]
struct Memory {
    on: bool,
    /// How far past its zone it stays on.
    hysteresis: i64,
    bounce: Option<Bounce>,
}

impl Contact {
    pub const fn new(mover: Mover) -> Self {
        Self { mover, seen_at: 0, normally_closed: false, memory: None }
    }

    /// A switch that a shaft turns on in a zone, and off so far past it.
    pub fn switch(axis: usize, zone: Zone, hysteresis: i64, normally_closed: bool) -> Self {
        let on = zone.is_on(0);
        let memory = (hysteresis > 0).then(|| Box::new(Memory { on, hysteresis, bounce: None }));
        let mover = Mover::Shaft { axis, side: Side::Load, zone };
        Self { mover, seen_at: 0, normally_closed, memory }
    }

    /// Where along its axis it is on, as long as it stays as it is; `None` for a signal.
    pub fn zone(&self) -> Option<(usize, Side, Zone)> {
        let Mover::Shaft { axis, side, zone } = self.mover else { return None };
        let hysteresis =
            self.memory.as_ref().filter(|memory| memory.on).map_or(0, |memory| memory.hysteresis);
        Some((axis, side, zone.widened(hysteresis)))
    }

    /// A switch is moved.
    pub fn set_zone(&mut self, to: Zone) {
        if let Mover::Shaft { zone, .. } = &mut self.mover {
            *zone = to;
        }
    }

    /// Whether it has to be told of every change: what is on it depends on when that was.
    pub fn remembers(&self) -> bool {
        self.memory.is_some()
    }

    /// Lets it bounce from its next change on, or no longer. It is on or off now.
    pub fn set_bounce(&mut self, bounce: Option<Bounce>, on: bool) {
        let hysteresis = self.memory.as_ref().map_or(0, |memory| memory.hysteresis);
        let remembers = hysteresis > 0 || bounce.is_some();
        self.memory = remembers.then(|| Box::new(Memory { on, hysteresis, bounce }));
    }

    /// Its mover is on or off now.
    pub fn update(&mut self, on: bool, now: Ticks) {
        if let Some(memory) = &mut self.memory
            && memory.on != on
        {
            memory.on = on;
            if let Some(bounce) = &mut memory.bounce {
                bounce.begin(now);
            }
        }
    }

    /// What is seen of it while its mover is on or off.
    pub fn shown(&self, on: bool) -> bool {
        let bounce = self.memory.as_ref().and_then(|memory| memory.bounce.as_ref());
        on ^ self.normally_closed ^ bounce.is_some_and(Bounce::is_apart)
    }

    /// When it opens or closes without its mover; [`Ticks::MAX`] if it does not.
    pub fn due(&self) -> Ticks {
        let bounce = self.memory.as_ref().and_then(|memory| memory.bounce.as_ref());
        bounce.map_or(Ticks::MAX, Bounce::next)
    }

    /// Whether it has opened or closed by `now`, since it was asked last.
    pub fn settle(&mut self, now: Ticks) -> bool {
        let bounce = self.memory.as_mut().and_then(|memory| memory.bounce.as_mut());
        bounce.is_some_and(|bounce| bounce.take(now))
    }
}
