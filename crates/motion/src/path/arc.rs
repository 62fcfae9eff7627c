//! An arc as it is asked for.

use super::angle::{self, TURN};
use super::round::Round;

/// The largest radius in pulses. (CMD-4CR manual, section 2.3.2.)
pub const MAX_RADIUS: u32 = 134_216_773;

/// Which way round, seen with the first axis to the right and the second up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// As the hands of a clock.
    Clockwise,
    /// The other way.
    CounterClockwise,
}

/// Where an arc ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where it began, after a full circle.
    Circle,
    /// At this angle: thousandths of a degree counter-clockwise from the first axis' positive direction, as
    /// seen from the centre.
    Angle(i32),
}

/// Why there is no such arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcError {
    /// The centre is the start.
    Centre,
    /// The radius is beyond [`MAX_RADIUS`].
    Radius,
    /// An axis has two parts in it.
    Axes,
}

/// An arc, a circle, or with a third axis a helix. (CMD-4CR manual, sections 2.3.2 and 2.3.3.)
///
/// The start lies on the circle, and so does the end: it is the point next to the ideal one that a circle
/// through the start comes through. On the axis that is the faster one there it is rounded to the nearest
/// position, half a pulse going outward, and on the other to the position that is nearest to the circle then.
/// So an arc to a multiple of 90° ends where its coordinates rounded lie, a full circle exactly at its start,
/// and no end is more than half a pulse off the circle. An arc that would end at its start goes nowhere;
/// only [`End::Circle`] is a full circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    axes: [usize; 2],
    /// Seen from the centre.
    start: [i32; 2],
    turn: Turn,
    /// In 2⁻⁶⁴ of a turn.
    travel: u128,
    way: [i32; 2],
    along: Option<(usize, i32)>,
}

impl Arc {
    /// An arc of two axes about a centre, seen from the start. On a helix another axis goes its way `along`,
    /// evenly with the angle.
    ///
    /// # Errors
    /// If there is no such circle, or the axes are not different ones.
    pub fn new(
        axes: [usize; 2],
        centre: [i32; 2],
        turn: Turn,
        end: End,
        along: Option<(usize, i32)>,
    ) -> Result<Self, ArcError> {
        let [first, second] = axes;
        if first == second || along.is_some_and(|(third, _)| axes.contains(&third)) {
            return Err(ArcError::Axes);
        }
        if centre == [0, 0] {
            return Err(ArcError::Centre);
        }
        let squared: u128 = centre.iter().map(|part| u128::from(part.unsigned_abs()).pow(2)).sum();
        if squared > u128::from(MAX_RADIUS).pow(2) {
            return Err(ArcError::Radius);
        }
        let start = centre.map(|part| -part);
        let travel = match end {
            End::Circle => TURN,
            End::Angle(end) => {
                let travel = angle::of_millidegrees(end).wrapping_sub(angle::of_point(start.map(i64::from)));
                let travel = if turn == Turn::Clockwise { travel.wrapping_neg() } else { travel };
                u128::from(travel)
            }
        };
        let mut arc = Self { axes, start, turn, travel, way: [0; 2], along };
        if end != End::Circle
            && let Some(round) = arc.round()
        {
            arc.way = round.way().map(|way| way as i32);
            if arc.way == [0, 0] {
                arc.travel = 0;
            }
        }
        Ok(arc)
    }

    /// Both axes.
    pub fn axes(&self) -> [usize; 2] {
        self.axes
    }

    /// The way of both axes from start to end.
    pub fn ends(&self) -> [i32; 2] {
        self.way
    }

    /// The axis that goes along, and its way.
    pub fn along(&self) -> Option<(usize, i32)> {
        self.along
    }

    /// The motion; `None` if it goes nowhere.
    pub(super) fn round(&self) -> Option<Round> {
        let slots = self.along.map_or(0, |(_, way)| way.unsigned_abs());
        (self.travel > 0)
            .then(|| Round::new(self.start.map(i64::from), self.turn == Turn::Clockwise, self.travel, slots))
    }
}
