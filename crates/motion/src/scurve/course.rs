//! A motion of two curves with a cruise between them.

use super::curve::{Curve, FINE_BITS, Fine, Way, divide};
use crate::block::{MAX_BLOCK, block_length, longest};
use crate::plan::{Kind, Limits, Now, Piece, Wish, longest_cruise};
use crate::speed::{Pace, Speed, root, square};
use crate::train::{FRACTION_BITS, SubTicks};

/// The largest share of v² that changes over a block, as a power of two: a cubic with it is off by 0.03 % of
/// the acceleration. It gets smaller where the acceleration itself changes much, near the ends of a curve.
const SHARE_BITS: u32 = 5;

/// No end in sight.
const ENDLESS: Way = Way::MAX;

/// A motion along S-curves, from the speed at which it was planned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    limits: Limits,
    wish: Wish,
    /// From the first speed to that of the cruise.
    lead: Curve,
    /// Whether the lead slows down.
    falls: bool,
    cruise: Speed,
    /// From the speed of the cruise down to the stop speed.
    tail: Curve,
    /// Where the lead ends, the tail begins, and the tail ends.
    climbed: Way,
    slowing: Way,
    end: Way,
    /// Where the next pulse is.
    next: Way,
    /// The end of the piece on its way, which the next one begins with.
    here: Place,
    /// A guess at the length of the next block.
    block: u32,
}

/// A place on a course: how much of each part lies behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    way: Way,
    lead: Fine,
    cruised: Way,
    tail: Fine,
    pace: Pace,
}

impl Course {
    /// The course that fulfils a wish; `None` if the axis may stand still now. A target that is too near
    /// for the present speed is passed: the course brakes.
    pub(crate) fn new(limits: &Limits, bend: Speed, now: Now, wish: Wish) -> Option<Self> {
        match wish {
            Wish::To(pulses) => {
                Self::toward(limits, bend, now, pulses).or_else(|| Self::brake(limits, bend, now))
            }
            Wish::Speed(speed) => {
                let from = root(now.squared);
                Some(Self::of(limits, bend, wish, now, [from, speed, speed], ENDLESS))
            }
            Wish::Brake => Self::brake(limits, bend, now),
        }
    }

    fn toward(limits: &Limits, bend: Speed, now: Now, pulses: u64) -> Option<Self> {
        let from = root(now.squared);
        let end = (Way::from(pulses - 1) << FRACTION_BITS) + Way::from(now.rest);
        let rise = |high| Curve::new(limits.scale, limits.growth, bend, from, high).way();
        let fall = |low, high| Curve::new(limits.scale, limits.fall, bend, low, high).way();
        if fall(limits.stop, from) > end {
            return None;
        }
        let fits = |cruise| {
            let lead = if cruise < from { fall(cruise, from) } else { rise(cruise) };
            lead + fall(limits.stop, cruise) <= end
        };
        let cruise = if fits(limits.top) {
            limits.top
        } else if from > limits.top {
            // No room to slow down twice.
            from
        } else {
            highest(from, limits.top, fits)
        };
        Some(Self::of(limits, bend, Wish::To(pulses), now, [from, cruise, limits.stop.min(cruise)], end))
    }

    /// To standstill on the first pulse that is possible.
    fn brake(limits: &Limits, bend: Speed, now: Now) -> Option<Self> {
        let from = root(now.squared);
        if from <= limits.stop {
            return None;
        }
        let way = Curve::new(limits.scale, limits.fall, bend, limits.stop, from).way();
        let rest = Way::from(now.rest);
        let pulses = way.saturating_sub(rest).div_ceil(1 << FRACTION_BITS);
        let end = rest + (pulses << FRACTION_BITS);
        Some(Self::of(limits, bend, Wish::Brake, now, [from, from, limits.stop], end))
    }

    fn of(limits: &Limits, bend: Speed, wish: Wish, now: Now, speeds: [Speed; 3], end: Way) -> Self {
        let [from, cruise, last] = speeds;
        let rise = |low, high| Curve::new(limits.scale, limits.growth, bend, low, high);
        let fall = |low, high| Curve::new(limits.scale, limits.fall, bend, low, high);
        let falls = cruise < from;
        let lead = if falls { fall(cruise, from) } else { rise(from, cruise) };
        let tail = fall(last, cruise);
        Self {
            limits: *limits,
            wish,
            lead,
            falls,
            cruise,
            tail,
            climbed: lead.way(),
            slowing: end - tail.way(),
            end,
            next: Way::from(now.rest),
            here: Place { way: 0, lead: 0, cruised: 0, tail: 0, pace: Pace::of(from) },
            block: block_length(now.squared, if from < cruise { limits.growth } else { limits.fall }),
        }
    }

    /// Whether the course is also that of this wish within these limits, so that it may go on.
    pub(crate) fn serves(&self, limits: &Limits, bend: Speed, now: Now, wish: Wish) -> bool {
        let own = Limits { top: limits.top, start: limits.start, ..self.limits };
        own == *limits
            && match (self.wish, wish) {
                (Wish::Brake, Wish::Brake) => true,
                (Wish::Brake, Wish::To(pulses)) => Self::toward(limits, bend, now, pulses).is_none(),
                (Wish::Speed(own), Wish::Speed(other)) => own == other,
                (Wish::To(_), Wish::To(pulses)) => {
                    let slowing = self.next > self.slowing;
                    self.end == self.next + (Way::from(pulses - 1) << FRACTION_BITS)
                        && (slowing || limits.top == self.limits.top)
                }
                _ => false,
            }
    }

    /// Pulses were made.
    pub(crate) fn pass(&mut self, pulses: u32) {
        self.next = self.next.saturating_add(Way::from(pulses) << FRACTION_BITS);
    }

    /// The speed at one of the pulses to come; 1 is the next.
    pub(crate) fn speed_at(&self, pulse: u32) -> Speed {
        self.place(self.ahead(pulse)).pace.speed
    }

    /// The pace at the end of the last piece.
    pub(crate) fn pace(&self) -> Pace {
        self.here.pace
    }

    /// The next piece; `None` at the end.
    pub(crate) fn piece(&mut self, rest: u64) -> Option<Piece> {
        if self.next > self.end {
            return None;
        }
        let from = self.next - Way::from(rest);
        let whole = rest == 1 << FRACTION_BITS;
        let pulses_until = |way: Way| ((way - from) >> FRACTION_BITS).min(u32::MAX.into()) as u32;
        let Self { climbed, slowing, .. } = *self;
        let room = if !whole {
            1
        } else if from < climbed {
            pulses_until(climbed)
        } else if from + (1 << FRACTION_BITS) <= slowing {
            let count = pulses_until(slowing).min(longest_cruise(self.limits.scale, self.cruise));
            self.block = MAX_BLOCK;
            return Some(Piece { count, end: square(self.cruise), kind: Kind::Cruise });
        } else if from >= slowing {
            pulses_until(self.end)
        } else {
            1
        };
        let start = self.place(from);
        let (count, end) = self.block(&start, room);
        self.here = end;
        let duration = self.between(&start, &end).max(1);
        Some(Piece { count, end: end.pace.squared, kind: Kind::Curve(duration) })
    }

    /// A block from here with its end, and a guess at the length of the one after it.
    fn block(&mut self, start: &Place, room: u32) -> (u32, Place) {
        let curve = if start.way < self.climbed { &self.lead } else { &self.tail };
        let Pace { speed, squared, .. } = start.pace;
        let most = room.min(longest(self.limits.scale, squared)).min(self.block);
        let mut count = if most < 2 { 1 } else { 1 << most.ilog2() };
        loop {
            let end = self.place(self.ahead(count));
            let slowest = speed.min(end.pace.speed);
            // Near the end of a bend the acceleration itself changes much over a block.
            let bent = curve.bent_at(speed).max(curve.bent_at(end.pace.speed));
            let share = (bent >> 3).clamp(slowest >> (SHARE_BITS + 4), slowest >> SHARE_BITS);
            let limit = u64::from(slowest) * u64::from(share);
            let change = end.pace.squared.abs_diff(squared);
            if count == 1 || change <= limit {
                self.block = if change <= limit / 2 { (2 * count).min(MAX_BLOCK) } else { count };
                return (count, end);
            }
            count /= 2;
        }
    }

    fn ahead(&self, pulse: u32) -> Way {
        self.next.saturating_add(Way::from(pulse - 1) << FRACTION_BITS)
    }

    fn place(&self, way: Way) -> Place {
        let here = &self.here;
        if way == here.way {
            return *here;
        }
        let Self { climbed, slowing, .. } = *self;
        let mut place = Place {
            way,
            lead: self.lead.time(),
            cruised: way.clamp(climbed, slowing) - climbed,
            tail: 0,
            pace: here.pace,
        };
        let mut speed = self.cruise;
        if way < climbed {
            // Seen from the slow end.
            let [way, from] = [way, here.way].map(|way| if self.falls { climbed - way } else { way });
            let mirrored = |time| if self.falls { place.lead - time } else { time };
            let point = self.lead.near(way, from, mirrored(here.lead), here.pace);
            place.lead = mirrored(point.time);
            speed = point.speed;
        } else if way > slowing {
            let whole = self.tail.time();
            let [way, from] = [way, here.way].map(|way| self.end.saturating_sub(way));
            let point = if here.way < slowing {
                self.tail.at(way)
            } else {
                self.tail.near(way, from, whole - here.tail, here.pace)
            };
            place.tail = whole - point.time;
            speed = point.speed;
        }
        if speed != place.pace.speed {
            place.pace = Pace::of(speed);
        }
        place
    }

    fn between(&self, from: &Place, to: &Place) -> SubTicks {
        let curves = (to.lead - from.lead) + (to.tail - from.tail);
        let curves = curves << (FRACTION_BITS - FINE_BITS);
        match to.cruised - from.cruised {
            0 => curves,
            cruised => curves + divide(cruised << self.limits.scale.bits(), self.cruise.into()) as u64,
        }
    }
}

/// The greatest speed, but for 1/1024, that fits, between one that does and one that does not.
fn highest(mut fits_at: Speed, mut too_fast: Speed, fits: impl Fn(Speed) -> bool) -> Speed {
    while too_fast - fits_at > 1 + (fits_at >> 10) {
        let middle = fits_at + (too_fast - fits_at) / 2;
        if fits(middle) { fits_at = middle } else { too_fast = middle }
    }
    fits_at
}

/// The speed at which a motion over so many pulses may begin: the start speed, unless the axis could not
/// stop from it in time.
pub(crate) fn entry(limits: &Limits, bend: Speed, pulses: u64) -> Speed {
    let start = limits.start.min(limits.top);
    let end = Way::from(pulses) << FRACTION_BITS;
    let fits = |speed| Curve::new(limits.scale, limits.fall, bend, limits.stop, speed).way() <= end;
    if start <= limits.stop || fits(start) { start } else { highest(limits.stop, start, fits) }
}
