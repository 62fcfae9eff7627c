//! The wires between a controller's ports and whoever is at their other ends.

use super::kind::{Kind, Line, Way};
use devices::Port;
use motion::Ticks;
use protocol::can::{MAX_DATA, MAX_ID};
use rand_pcg::{Pcg32, rand_core::Rng as _};
use std::collections::VecDeque;

/// Most messages that may be on their way; later ones are lost.
pub const MAX_ON_THE_WAY: usize = 65_536;

/// Bits of a CAN frame beside its data, the three between two frames included.
const CAN_FRAME_BITS: u32 = 47;

/// Most random bytes that a babbling node says.
const MAX_RANDOM_BYTES: u32 = 8;

/// Bytes on their way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parcel {
    /// When they arrive.
    pub due: Ticks,
    pub port: Port,
    /// The pause that was to be kept before.
    pub delay_ms: u32,
    pub bytes: Vec<u8>,
}

/// What is wrong with a wire.
#[derive(Debug)]
struct Effect {
    id: u64,
    kind: Kind,
    random: Pcg32,
    /// When a babbling node talks next.
    talks_at: Ticks,
}

/// All wires of a device.
#[derive(Debug)]
pub struct Wire {
    clock_hz: u32,
    seed: u64,
    effects: Vec<Effect>,
    /// By direction, in the order of their arrival.
    on_the_way: [VecDeque<Parcel>; 2],
}

impl Wire {
    pub fn new(clock_hz: u32, seed: u64) -> Self {
        Self { clock_hz, seed, effects: Vec::new(), on_the_way: [VecDeque::new(), VecDeque::new()] }
    }

    /// Whether bytes pass as they are and at once.
    pub fn is_sound(&self) -> bool {
        self.effects.is_empty() && self.on_the_way.iter().all(VecDeque::is_empty)
    }

    /// From now on the wire has a fault, whose random numbers are its own.
    pub fn spoil(&mut self, id: u64, kind: &Kind, now: Ticks) {
        let random = Pcg32::new(self.seed, id);
        let mut effect = Effect { id, kind: kind.clone(), random, talks_at: Ticks::MAX };
        effect.rest(now, self.clock_hz);
        self.effects.push(effect);
    }

    /// The fault is over. What is late stays late.
    pub fn mend(&mut self, id: u64) {
        self.effects.retain(|effect| effect.id != id);
    }

    /// Bytes enter a wire. What comes out at once is given to `arrive`, the rest waits.
    pub fn pass(
        &mut self,
        way: Way,
        now: Ticks,
        (port, delay_ms, bytes): (Port, u32, &[u8]),
        mut arrive: impl FnMut(&[u8]),
    ) {
        let mut due = now;
        let mut chunks = vec![bytes.to_vec()];
        for effect in &mut self.effects {
            match effect.kind {
                Kind::Noise { line, rate } if line.is(port, way) => effect.noise(port, rate, &mut chunks),
                Kind::Loss { line, rate } if line.is(port, way) => effect.repeat(port, rate, 0, &mut chunks),
                Kind::Duplication { line, rate } if line.is(port, way) => {
                    effect.repeat(port, rate, 2, &mut chunks);
                }
                Kind::Delay { line, ms } if line.is(port, way) => due += milliseconds(ms, self.clock_hz),
                _ => {}
            }
        }
        let queue = &mut self.on_the_way[way as usize];
        // Nothing overtakes on a wire.
        let last = queue.iter().rev().find(|parcel| parcel.port == port).map_or(now, |parcel| parcel.due);
        let due = due.max(last);
        for bytes in chunks {
            if due == now {
                arrive(&bytes);
            } else if queue.len() < MAX_ON_THE_WAY {
                let place = queue.partition_point(|parcel| parcel.due <= due);
                queue.insert(place, Parcel { due, port, delay_ms, bytes });
            }
        }
    }

    /// When the next bytes arrive that are on their way.
    pub fn next(&self, way: Way) -> Ticks {
        self.on_the_way[way as usize].front().map_or(Ticks::MAX, |parcel| parcel.due)
    }

    /// The next bytes if they arrive by `now`.
    pub fn take(&mut self, way: Way, now: Ticks) -> Option<Parcel> {
        self.on_the_way[way as usize].pop_front_if(|parcel| parcel.due <= now)
    }

    /// When somebody talks out of turn.
    pub fn next_babble(&self) -> Ticks {
        self.effects.iter().map(|effect| effect.talks_at).min().unwrap_or(Ticks::MAX)
    }

    /// What somebody says at `now` out of turn.
    pub fn take_babble(&mut self, now: Ticks) -> Option<(Port, Vec<u8>)> {
        let effect = self.effects.iter_mut().find(|effect| effect.talks_at <= now)?;
        let Kind::BabblingNode { port, bytes, .. } = effect.kind.clone() else { return None };
        let port = Port::from(port);
        let said = bytes.unwrap_or_else(|| effect.gibberish(port));
        effect.rest(now, self.clock_hz);
        Some((port, said))
    }
}

impl Line {
    fn is(self, port: Port, way: Way) -> bool {
        self.port.is_none_or(|other| Port::from(other) == port) && self.way.is_none_or(|other| other == way)
    }
}

impl Effect {
    /// Whether something happens that does with this probability.
    fn happens(&mut self, rate: f64) -> bool {
        let threshold = (rate * f64::from(u32::MAX) + rate) as u64;
        u64::from(self.random.next_u32()) < threshold
    }

    /// Turns bits over.
    fn noise(&mut self, port: Port, rate: f64, chunks: &mut Vec<Vec<u8>>) {
        if port == Port::Can {
            chunks.retain(|frame| {
                let bits = CAN_FRAME_BITS + 8 * (frame.len() as u32).saturating_sub(2);
                (0..bits).filter(|_| self.happens(rate)).count() == 0
            });
            return;
        }
        for byte in chunks.iter_mut().flatten() {
            let flipped = (0..8).filter(|_| self.happens(rate)).fold(0, |bits: u8, bit| bits | 1 << bit);
            *byte ^= flipped;
        }
    }

    /// Lets bytes, or CAN frames, come so often instead of once.
    fn repeat(&mut self, port: Port, rate: f64, times: usize, chunks: &mut Vec<Vec<u8>>) {
        if port == Port::Can {
            let frames = std::mem::take(chunks);
            for frame in frames {
                let times = if self.happens(rate) { times } else { 1 };
                chunks.extend(std::iter::repeat_n(frame, times));
            }
            return;
        }
        for chunk in chunks.iter_mut() {
            let bytes = std::mem::take(chunk);
            for byte in bytes {
                let times = if self.happens(rate) { times } else { 1 };
                chunk.extend(std::iter::repeat_n(byte, times));
            }
        }
        chunks.retain(|chunk| !chunk.is_empty());
    }

    /// A babbling node is quiet for a while.
    fn rest(&mut self, now: Ticks, clock_hz: u32) {
        if let Kind::BabblingNode { ms, .. } = self.kind {
            let mean = milliseconds(ms, clock_hz);
            let part = (u128::from(self.random.next_u32()) * u128::from(mean)) >> u32::BITS;
            self.talks_at = now + mean / 2 + part as Ticks;
        }
    }

    fn gibberish(&mut self, port: Port) -> Vec<u8> {
        if port == Port::Can {
            let id = (self.random.next_u32() as u16) & MAX_ID;
            let length = self.random.next_u32() as usize % (MAX_DATA + 1);
            return id.to_be_bytes().into_iter().chain(self.bytes(length)).collect();
        }
        let length = 1 + self.random.next_u32() % MAX_RANDOM_BYTES;
        self.bytes(length as usize)
    }

    fn bytes(&mut self, length: usize) -> Vec<u8> {
        (0..length).map(|_| self.random.next_u32() as u8).collect()
    }
}

fn milliseconds(ms: u32, clock_hz: u32) -> Ticks {
    Ticks::from(ms) * Ticks::from(clock_hz) / 1000
}
