//! The decision of an axis: how the speed goes on from here.
//!
//! Over the distance to a target lies a ceiling: the speed from which the stop speed can just be reached
//! there. Below the ceiling the axis speeds up or cruises, on the ceiling it slows down along it, above
//! it the target cannot be held and the axis brakes, to come back from the other side. All of it in v²
//! against pulses, where the ceiling of a trapezoid is a straight line.

use crate::block::{MAX_BLOCK, SHARE_BITS, block_length, longest};
use crate::foot::{self, Key, TRIPLE};
use crate::speed::{Growth, MAX_GROWTH, MAX_SPEED, Scale, Speed, SpeedSquared, root, square};
use crate::train::SubTicks;
use crate::wide::quotient;

/// How an axis approaches its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Constant deceleration.
    Trapezoid,
    /// Speed in proportion to the distance left, so that it decays exponentially in time: the
    /// deceleration is the greatest allowed at first and ever gentler after.
    Soft,
    /// All ramps are jerk-limited: acceleration rises evenly in time to that of the limits and falls
    /// evenly to 0 again. See [`Shape::s_growth`] for an S that takes as long as the straight ramp.
    SCurve {
        /// Over which span of speed the acceleration rises from 0 to its peak: the jerk is the square of
        /// the acceleration by twice the bend. Half the span of a ramp gives an S without a straight
        /// part; a ramp of less than two bends keeps the jerk and stays below the peak.
        bend: Speed,
    },
}

impl Shape {
    /// The peak growth with which an S over `span` takes as long as a straight ramp with `mean`: twice
    /// as much for an S without a straight part.
    pub const fn s_growth(mean: Growth, span: Speed, bend: Speed) -> Growth {
        let span = if span == 0 { 1 } else { span as u128 };
        let bend = if bend as u128 > span.div_ceil(2) { span.div_ceil(2) } else { bend as u128 };
        let peak = quotient(mean as u128 * (span + 2 * bend), span);
        if peak > MAX_GROWTH as u128 { MAX_GROWTH } else { peak as Growth }
    }
}

/// What bounds the motion of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The unit of the speeds.
    pub scale: Scale,
    /// Speed of positioning.
    pub top: Speed,
    /// Speed with which motion begins.
    pub start: Speed,
    /// Speed from which the axis may stand still at once.
    pub stop: Speed,
    /// Acceleration, the greatest of an S.
    pub growth: Growth,
    /// Deceleration, the greatest of an S.
    pub fall: Growth,
    /// How a target is approached.
    pub shape: Shape,
}

impl Limits {
    /// Speeds between the slowest of the scale, so that every spacing fits a train, and the fastest.
    pub(crate) const fn clamped(self) -> Self {
        let slowest = self.scale.slowest();
        Self {
            top: clamp(self.top as u64, slowest as u64, MAX_SPEED as u64) as Speed,
            start: clamp(self.start as u64, slowest as u64, MAX_SPEED as u64) as Speed,
            stop: clamp(self.stop as u64, slowest as u64, MAX_SPEED as u64) as Speed,
            growth: clamp(self.growth, 1, MAX_GROWTH),
            fall: clamp(self.fall, 1, MAX_GROWTH),
            ..self
        }
    }

    /// The bend of jerk-limited ramps.
    pub(crate) fn bend(&self) -> Option<Speed> {
        match self.shape {
            Shape::SCurve { bend } => Some(bend.min(MAX_SPEED)),
            Shape::Trapezoid | Shape::Soft => None,
        }
    }

    /// Speed a pulse, in 2⁻³², that the soft approach takes away; all of it within one at the most.
    fn decay(&self) -> u64 {
        let top = u64::from(self.top);
        let (whole, rest) = (self.fall / top, self.fall % top);
        if whole >> 32 != 0 { 1 << 63 } else { ((whole << 31) + (rest << 31) / top).max(1) }
    }

    /// The ceiling of v² over a distance in 2⁻³² pulses.
    fn ceiling(&self, distance: Distance) -> SpeedSquared {
        let Distance::Pulses(distance) = distance else { return SpeedSquared::MAX };
        match self.shape {
            // The S has a course of its own and does not come here.
            Shape::Trapezoid | Shape::SCurve { .. } => {
                let rise = (u128::from(self.fall) * u128::from(distance)) >> 32;
                square(self.stop).saturating_add(u64::try_from(rise).unwrap_or(u64::MAX))
            }
            Shape::Soft => {
                // The decay from the top speed takes the whole deceleration; above it, the parabola that
                // goes on from there.
                let decay = self.decay();
                let speed = ((u128::from(decay) * u128::from(distance)) >> 64) as u64;
                if speed <= u64::from(self.top) {
                    return square(speed as Speed).max(square(self.stop));
                }
                let bend =
                    u64::try_from(quotient(u128::from(self.top) << 64, decay.into())).unwrap_or(u64::MAX);
                let rise = (u128::from(self.fall) * u128::from(distance - bend.min(distance))) >> 32;
                let rise = u64::try_from(rise).unwrap_or(u64::MAX);
                square(self.top).saturating_add(rise).max(square(self.stop))
            }
        }
    }

    /// Pulses from the top speed to the stop speed, rounded up.
    fn braking_pulses(&self, top: SpeedSquared) -> u64 {
        match self.shape {
            Shape::Trapezoid | Shape::SCurve { .. } => {
                top.saturating_sub(square(self.stop)).div_ceil(self.fall)
            }
            Shape::Soft if top <= square(self.stop) => 0,
            Shape::Soft => {
                let decay = u128::from(self.decay());
                let pulses = quotient((u128::from(root(top)) << 32) + (decay - 1), decay);
                u64::try_from(pulses).unwrap_or(u64::MAX)
            }
        }
    }

    /// Rounding of v² that is not worth a reaction: far below a quantum of acceleration.
    fn slack(&self, squared: SpeedSquared) -> u64 {
        // Some steps of v, whose root a power of two above stands for.
        (self.fall >> 12) + (8 << (u64::BITS - squared.leading_zeros()).div_ceil(2))
    }
}

/// [`Ord::clamp`] for constants.
const fn clamp(value: u64, least: u64, most: u64) -> u64 {
    if value < least {
        least
    } else if value > most {
        most
    } else {
        value
    }
}

/// How far the axis may go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Distance {
    /// In 2⁻³² pulses.
    Pulses(u64),
    /// No end in sight.
    Endless,
}

impl Distance {
    fn less(self, pulses: u64) -> Self {
        match self {
            Self::Pulses(distance) => Self::Pulses(distance.saturating_sub(pulses << 32)),
            Self::Endless => Self::Endless,
        }
    }
}

/// The next piece of the profile: so many pulses to this v².
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub count: u32,
    pub end: SpeedSquared,
    pub kind: Kind,
}

/// How speed goes over a [`Piece`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// v² changes evenly.
    Ramp,
    /// v changes evenly.
    Glide,
    /// Neither changes.
    Cruise,
    /// A stretch of a course, in this time.
    Curve(SubTicks),
    /// Pulses of a foot, the first one so many away from the slow end.
    Foot(u64),
}

/// Pieces of a ramp that follow a first one and are like it: what was decided once holds for all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    left: u32,
    count: u32,
    /// What a piece adds to v².
    change: i64,
    kind: Kind,
}

impl Run {
    /// Nothing follows.
    pub const NONE: Self = Self { left: 0, count: 0, change: 0, kind: Kind::Ramp };

    /// The next piece, after this v².
    #[inline]
    pub fn next(&mut self, squared: SpeedSquared) -> Option<Piece> {
        self.left = self.left.checked_sub(1)?;
        let Self { count, change, kind, .. } = *self;
        if let Kind::Foot(at) = &mut self.kind {
            // After the last one it means nothing.
            *at = if change < 0 { at.wrapping_sub(count.into()) } else { *at + u64::from(count) };
        }
        Some(Piece { count, end: squared.wrapping_add_signed(change), kind })
    }

    /// The first of some pulses on a foot, and the run of the others.
    fn foot(key: &Key, at: u32, pulses: u32, squared: SpeedSquared) -> Option<(Piece, Self)> {
        let growth = if key.rises { key.growth as i64 } else { -(key.growth as i64) };
        let run =
            |left, count: u32, kind| Self { left, count, change: growth.wrapping_mul(count.into()), kind };
        // Those that are left over come first.
        let first = (pulses - 1) % TRIPLE + 1;
        let mut run_first = run(1, first, Kind::Foot(at.into()));
        let piece = run_first.next(squared)?;
        Some((piece, run((pulses - first) / TRIPLE, TRIPLE, run_first.kind)))
    }

    /// What may follow a piece that was chosen at this v² for a wish.
    pub fn after(piece: &Piece, limits: &Limits, squared: SpeedSquared, wish: Wish) -> Self {
        let Piece { count, end, kind } = *piece;
        if kind != Kind::Ramp || count == 1 {
            return Self::NONE;
        }
        let rises = end > squared;
        let [growth, fall] = [limits.growth, limits.fall].map(|growth| growth.saturating_mul(count.into()));
        let change = if rises { growth } else { fall };
        let left = match (wish, rises) {
            // Longer blocks are possible when v² has grown by half.
            (Wish::Speed(speed), true) => (square(speed).saturating_sub(end) / change).min(end / change / 2),
            (Wish::To(pulses), _) if limits.shape == Shape::Trapezoid => {
                // Braking to come back may take more pulses than there are.
                let Some(left) = pulses.checked_sub(count.into()) else { return Self::NONE };
                let ceiling = limits.ceiling(Distance::Pulses(left << 32));
                let blocks = if rises {
                    // With every block v² rises and the ceiling comes down.
                    let until_top = square(limits.top).saturating_sub(end) / growth;
                    let until_ceiling = ceiling.saturating_sub(end) / growth.saturating_add(fall);
                    until_top.min(until_ceiling).min(end / growth / 2)
                } else if end == ceiling {
                    (end / change).saturating_sub(1 << SHARE_BITS)
                } else {
                    0
                };
                blocks.min(left / u64::from(count))
            }
            _ => 0,
        };
        let change = if rises { change as i64 } else { -(change as i64) };
        let last = end.wrapping_add_signed(change.wrapping_mul(left as i64));
        if left == 0 || longest(limits.scale, last) < count {
            return Self::NONE;
        }
        Self { left: left.min(u32::MAX.into()) as u32, count, change, kind }
    }
}

/// What the next pulses are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wish {
    /// A target so many pulses ahead, the started one included; at least 1.
    To(u64),
    /// A speed, at least the slowest of the scale.
    Speed(Speed),
    /// Standstill.
    Brake,
}

/// Where the axis is on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Now {
    /// v², not 0.
    pub squared: SpeedSquared,
    /// What is left of the next pulse, in 2⁻³²: 1 to 2³².
    pub rest: u64,
}

/// The speed with which a motion over so many pulses begins: the start speed, unless it would not stop at its
/// target then, nor on the way back.
pub(crate) fn entry(limits: &Limits, pulses: u64) -> Speed {
    let start = limits.start.min(limits.top);
    let ceiling = limits.ceiling(Distance::Pulses(pulses << 32));
    if square(start) <= ceiling { start } else { root(ceiling) }
}

/// The next piece on the way to a target `pulses` ahead, the started one included, or `None` if the axis
/// is too fast to stop there.
#[inline]
pub(crate) fn toward(limits: &Limits, now: Now, pulses: u64) -> Option<Piece> {
    let distance = Distance::Pulses(((pulses - 1) << 32) + now.rest);
    let ceiling = limits.ceiling(distance);
    if now.squared > ceiling.saturating_add(limits.slack(now.squared)) {
        return None;
    }
    Some(piece(limits, now, square(limits.top), Some((pulses, distance, ceiling))))
}

/// The next piece on the way to a speed.
#[inline]
pub(crate) fn at_speed(limits: &Limits, now: Now, speed: Speed) -> Piece {
    piece(limits, now, square(speed.max(limits.scale.slowest())), None)
}

/// The next piece on the way to standstill; `None` when the axis may stand still now.
pub(crate) fn brake(limits: &Limits, now: Now) -> Option<Piece> {
    let stop = square(limits.stop);
    if now.squared <= stop {
        return None;
    }
    // The line through the first whole pulse at which standstill can be reached.
    let limits = Limits { shape: Shape::Trapezoid, ..*limits };
    let first = part(limits.fall, now.rest);
    let after = (now.squared - stop).saturating_sub(first).div_ceil(limits.fall);
    let distance = Distance::Pulses((after << 32) + now.rest);
    let ceiling = limits.ceiling(distance);
    Some(piece(&limits, now, now.squared, Some((after + 1, distance, ceiling))))
}

/// Blocks are longer than a pulse where v² is more than so many times its growth, as a power of two.
const SINGLE_BITS: u32 = SHARE_BITS + 1;

/// How many times `growth` fits the room, `most` at the most; rarely by a division.
fn within(most: u64, room: u64, growth: Growth) -> u64 {
    match growth.checked_mul(most) {
        Some(all) if all <= room => most,
        _ => room / growth,
    }
}

/// The next piece and those that follow it if they lie on a foot: pulses that would come one by one.
#[inline]
pub(crate) fn foot(limits: &Limits, now: Now, wish: Wish) -> Option<(Key, Piece, Run)> {
    let Limits { scale, growth, fall, .. } = *limits;
    let [start, stop] = [limits.start, limits.stop].map(square);
    let Now { squared, rest } = now;
    let (top, pulses) = match wish {
        Wish::To(pulses) if limits.shape == Shape::Trapezoid => (square(limits.top), pulses),
        Wish::To(_) => return None,
        Wish::Speed(speed) => (square(speed), u64::MAX),
        Wish::Brake => (0, squared.saturating_sub(stop) / fall),
    };
    if rest != 1 << 32 {
        return None;
    }
    let down = (1..=foot::LENGTH.into()).contains(&pulses)
        && u128::from(squared) == u128::from(stop) + u128::from(fall) * u128::from(pulses)
        && squared >> SINGLE_BITS < fall;
    let (key, at, pulses) = if down {
        (Key { scale, slow: stop, growth: fall, rises: false }, pulses as u32 - 1, pulses)
    } else if squared == start && squared < top {
        let distance = if pulses == u64::MAX { Distance::Endless } else { Distance::Pulses(pulses << 32) };
        let most = pulses.min(foot::LENGTH.into());
        let most = within(most, top - squared, growth);
        // With every pulse v² rises and the ceiling comes down.
        let most =
            within(most, limits.ceiling(distance).saturating_sub(squared), growth.saturating_add(fall));
        let single = (growth.saturating_mul(1 << SINGLE_BITS) - 1).saturating_sub(squared);
        (Key { scale, slow: start, growth, rises: true }, 0, within(most, single, growth))
    } else {
        return None;
    };
    // Three of the slowest pulses must fit a train.
    if pulses == 0 || longest(scale, key.slow) < TRIPLE {
        return None;
    }
    let (piece, run) = Run::foot(&key, at, pulses as u32, squared)?;
    Some((key, piece, run))
}

/// Pulses that do not count when a time is to be the least: of the first one a part may have been made, and those
/// that braking takes are rounded up.
const UNCOUNTED: u64 = 2;

/// The least time in which an axis that is never faster than `fastest` makes so many pulses, in parts of a clock.
pub(crate) fn least_cruise(limits: &Limits, pulses: u64, fastest: Speed) -> u128 {
    u128::from(limits.scale.spacing(fastest)) * u128::from(pulses.saturating_sub(UNCOUNTED))
}

/// The least time in which it makes so many and stands.
pub(crate) fn least_way(limits: &Limits, now: Now, pulses: u64, fastest: Speed) -> u128 {
    let ceiling = |pulses: u64| limits.ceiling(Distance::Pulses(pulses << 32));
    // Whoever is not above the ceiling never will be.
    let is_above = now.squared > ceiling(pulses).saturating_add(limits.slack(now.squared));
    if limits.shape != Shape::Trapezoid || is_above {
        return least_cruise(limits, pulses, fastest);
    }
    let scale = limits.scale;
    let span = |spacing: SubTicks, pulses: u64| u128::from(spacing) * u128::from(pulses);
    let pulses = pulses.saturating_sub(UNCOUNTED);
    let braking = limits.braking_pulses(square(fastest)).min(pulses);
    let from = root(ceiling(braking).min(square(fastest)));
    span(scale.spacing(fastest), pulses - braking) + span(scale.mean_spacing(from, limits.stop), braking)
}

/// `growth` over a part of a pulse in 2⁻³².
fn part(growth: Growth, rest: u64) -> u64 {
    ((u128::from(growth) * u128::from(rest)) >> 32) as u64
}

#[inline]
fn piece(limits: &Limits, now: Now, top: SpeedSquared, end: Option<(u64, Distance, SpeedSquared)>) -> Piece {
    let (pulses, distance, ceiling) = end.unwrap_or((u64::MAX, Distance::Endless, SpeedSquared::MAX));
    let Now { squared, rest } = now;
    let Limits { growth, fall, .. } = *limits;
    if rest == 1 << 32 && pulses > 1 {
        let on_ceiling = ceiling <= squared.saturating_add(limits.slack(squared));
        let whole = if on_ceiling && squared > square(limits.stop) {
            slow_down(limits, squared, pulses, distance)
        } else if squared < top {
            let most = block_length(squared, growth).min(longest(limits.scale, squared));
            shorten(most, pulses, |count| {
                let to = squared + growth * u64::from(count);
                (to <= top && to <= limits.ceiling(distance.less(count.into()))).then_some(to)
            })
            .map(|(count, end)| Piece { count, end, kind: Kind::Ramp })
        } else if squared == top {
            cruise(limits, top, pulses)
        } else {
            let most = block_length(squared - (squared >> 4), fall).min(longest(limits.scale, squared));
            shorten(most, pulses, |count| {
                let to = squared.checked_sub(fall * u64::from(count))?;
                (to >= top && to <= limits.ceiling(distance.less(count.into()))).then_some(to)
            })
            .map(|(count, end)| Piece { count, end, kind: Kind::Ramp })
        };
        if let Some(piece) = whole {
            return piece;
        }
    }
    let wish = if squared < top {
        squared.saturating_add(part(growth, rest)).min(top)
    } else {
        squared.saturating_sub(part(fall, rest)).max(top)
    };
    let after = match distance {
        Distance::Pulses(distance) => limits.ceiling(Distance::Pulses(distance - rest)),
        Distance::Endless => SpeedSquared::MAX,
    };
    Piece { count: 1, end: wish.min(after), kind: Kind::Ramp }
}

/// Along the ceiling.
fn slow_down(limits: &Limits, squared: SpeedSquared, pulses: u64, distance: Distance) -> Option<Piece> {
    let (most, kind) = match limits.shape {
        Shape::Trapezoid | Shape::SCurve { .. } => {
            (block_length(squared - (squared >> 4), limits.fall), Kind::Ramp)
        }
        Shape::Soft => (MAX_BLOCK, Kind::Glide),
    };
    let most = most.min(longest(limits.scale, squared));
    let (count, end) = shorten(most, pulses, |count| {
        let to = limits.ceiling(distance.less(count.into()));
        (to < squared && squared - to <= to >> SHARE_BITS).then_some(to)
    })?;
    Some(Piece { count, end, kind })
}

/// As far as the top speed lies under the ceiling, but not longer than a train lasts.
fn cruise(limits: &Limits, top: SpeedSquared, pulses: u64) -> Option<Piece> {
    let braking = if pulses == u64::MAX { 0 } else { limits.braking_pulses(top) };
    let count = pulses.saturating_sub(braking).min(longest_cruise(limits.scale, root(top)).into());
    (count > 0).then_some(Piece { count: count as u32, end: top, kind: Kind::Cruise })
}

/// The most pulses at a speed that fit a train.
pub(crate) fn longest_cruise(scale: Scale, speed: Speed) -> u32 {
    u32::try_from((1 << 62) / scale.spacing(speed)).unwrap_or(u32::MAX)
}

/// The longest block of a power of two of pulses, of at least two, that is possible.
fn shorten(
    longest: u32,
    pulses: u64,
    end: impl Fn(u32) -> Option<SpeedSquared>,
) -> Option<(u32, SpeedSquared)> {
    let mut count = longest;
    while count > 1 {
        if u64::from(count) <= pulses
            && let Some(end) = end(count)
        {
            return Some((count, end));
        }
        count /= 2;
    }
    None
}
