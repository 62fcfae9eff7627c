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

    /// How long it is in its plane, in pulses.
    pub fn length(&self) -> u32 {
        self.round().map_or(0, |round| (round.slots()[1] >> 32) as u32)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(start: [i32; 2], turn: Turn, end: End, expected: [i32; 2]) {
        let arc = Arc::new([0, 1], start.map(|part| -part), turn, end, None).unwrap();
        let [x, y] = arc.ends();
        assert_eq!([start[0] + x, start[1] + y], expected);
    }

    #[test]
    fn arcs_end_at_their_angle() {
        use Turn::{Clockwise, CounterClockwise};
        for turn in [Clockwise, CounterClockwise] {
            check([1000, 0], turn, End::Circle, [1000, 0]);
            check([1000, 0], turn, End::Angle(90_000), [0, 1000]);
            check([600, -800], turn, End::Angle(180_000), [-1000, 0]);
            check([134_216_773, 0], turn, End::Angle(-90_000), [0, -134_216_773]);
            // The radius is 14.14, 14.14 and 2.24.
            check([10, 10], turn, End::Angle(0), [14, 0]);
            check([10, 10], turn, End::Angle(225_000), [-10, -10]);
            check([-1, 2], turn, End::Angle(360_000), [2, 0]);
            // Half a pulse goes outward; on a diagonal without a point, the second axis is the one that is further
            // out.
            check([11, 0], turn, End::Angle(30_000), [9, 6]);
            check([9, 0], turn, End::Angle(45_000), [6, 7]);
            check([9, 0], turn, End::Angle(-45_000), [6, -7]);
            check([10, 0], turn, End::Angle(135_000), [-7, 7]);
        }
        // The arc of the CMD-4CR manual's tenth example.
        let start = [430_589 - 288_899, 20_623 - 267_403];
        check(start, CounterClockwise, End::Angle(95_000), [-24_801, 283_481]);
    }

    #[test]
    fn an_arc_to_where_it_begins_goes_nowhere() {
        for (start, end) in
            [([5, 0], 0), ([5, 0], 1000), ([5, 0], 359_000), ([-7, -7], 225_000), ([0, 3], -270_000)]
        {
            for turn in [Turn::Clockwise, Turn::CounterClockwise] {
                check(start, turn, End::Angle(end), start);
                let arc =
                    Arc::new([0, 1], start.map(|part| -part), turn, End::Angle(end), Some((2, 5))).unwrap();
                assert!(arc.round().is_none());
            }
        }
    }

    #[test]
    fn arcs_that_are_none() {
        let new = |axes, centre, along| Arc::new(axes, centre, Turn::Clockwise, End::Circle, along).err();
        assert_eq!(new([0, 1], [1, 0], None), None);
        assert_eq!(new([1, 0], [0, -134_216_773], Some((3, i32::MIN))), None);
        assert_eq!(new([0, 1], [0, 0], None), Some(ArcError::Centre));
        assert_eq!(new([0, 1], [1, -134_216_773], None), Some(ArcError::Radius));
        assert_eq!(new([0, 1], [i32::MIN; 2], None), Some(ArcError::Radius));
        assert_eq!(new([2, 2], [1, 0], None), Some(ArcError::Axes));
        assert_eq!(new([0, 1], [1, 0], Some((1, 5))), Some(ArcError::Axes));
    }
}
