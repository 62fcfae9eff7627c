//! The input for a manual pulse generator: from quadrature edges to pulses of an axis.
//!
//! A hand wheel, or an encoder that the axis follows, gives edges of two phases. The input counts all of
//! them or some, and a gear of whole numbers turns counts into pulses. Nothing is rounded away: what a count
//! lacks for a pulse waits for the next one, so the axis stands where the ratio says after any way there and
//! back.

/// The denominator of the gear's divider.
pub const DIVISIONS: u32 = 2048;

/// Largest multiplier of the gear.
pub const MAX_MULTIPLIER: u32 = 32;

/// How edges become pulses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gear {
    /// How much fewer counts there are than edges, as a power of two: 0 counts each of the four edges of a
    /// cycle, 2 one of them.
    pub shift: u32,
    /// Whether the axis turns the other way.
    pub reversed: bool,
    /// 1 to [`MAX_MULTIPLIER`] pulses a count, before the divider.
    pub multiplier: u32,
    /// 1 to [`DIVISIONS`]: this part of them comes out.
    pub divider: u32,
}

/// A pulser input.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pulser {
    /// Edges that have not become a count.
    edges: i64,
    /// Parts of a pulse, in [`DIVISIONS`] of one.
    parts: i64,
}

impl Pulser {
    /// An input that nothing has come in at.
    pub const fn new() -> Self {
        Self { edges: 0, parts: 0 }
    }

    /// Edges arrive, up or down: the pulses that the axis is to make for them, with their sign.
    ///
    /// # Panics
    /// If the gear is none that there can be.
    pub fn take(&mut self, edges: i32, gear: Gear) -> i64 {
        assert!((1..=MAX_MULTIPLIER).contains(&gear.multiplier), "a multiplier of {}", gear.multiplier);
        assert!((1..=DIVISIONS).contains(&gear.divider), "a divider of {}", gear.divider);
        assert!(gear.shift <= 2, "a cycle has four edges");
        self.edges += i64::from(edges);
        let counts = self.edges >> gear.shift;
        self.edges -= counts << gear.shift;
        let counts = if gear.reversed { -counts } else { counts };
        self.parts += counts * i64::from(gear.multiplier * gear.divider);
        let pulses = self.parts.div_euclid(DIVISIONS.into());
        self.parts -= pulses * i64::from(DIVISIONS);
        pulses
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVEN: Gear = Gear { shift: 0, reversed: false, multiplier: 1, divider: DIVISIONS };

    /// Edges, and the pulses that come out for each.
    #[track_caller]
    fn check(gear: Gear, turns: &[(i32, i64)]) {
        let mut pulser = Pulser::new();
        for &(edges, pulses) in turns {
            assert_eq!(pulser.take(edges, gear), pulses, "{edges} edges through {gear:?}");
        }
    }

    #[test]
    fn edges_are_counted() {
        check(EVEN, &[(7, 7), (-9, -9), (i32::MIN, i32::MIN.into())]);
        check(Gear { reversed: true, ..EVEN }, &[(7, -7), (-9, 9)]);
        check(Gear { shift: 1, ..EVEN }, &[(1, 0), (1, 1), (3, 1), (-1, 0), (-4, -2)]);
        check(Gear { shift: 2, ..EVEN }, &[(3, 0), (1, 1), (-1, -1), (1, 1), (400, 100), (-404, -101)]);
    }

    #[test]
    fn the_gear_is_exact() {
        // The manual's example (CMD-4CR, 2.5.2.2): 100 in, 125 out.
        check(Gear { multiplier: 5, divider: 512, ..EVEN }, &[(100, 125)]);
        check(Gear { divider: 1, ..EVEN }, &[(2047, 0), (1, 1), (-1, -1), (1, 1), (-2048, -1)]);
        check(Gear { multiplier: 32, ..EVEN }, &[(i32::MAX, 32 * i64::from(i32::MAX))]);
    }

    /// Where the axis comes to depends on where the wheel is, not on how it came there.
    #[test]
    fn no_way_loses_anything() {
        // Numbers without a pattern, always the same.
        let mut state = 1_u64;
        let mut any = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as u32
        };
        for _ in 0..2000 {
            let (multiplier, divider) = (1 + any() % MAX_MULTIPLIER, 1 + any() % DIVISIONS);
            let gear = Gear { shift: any() % 3, reversed: any() % 2 == 0, multiplier, divider };
            let mut pulser = Pulser::new();
            let (mut edges, mut pulses) = (0, 0);
            for _ in 0..10 {
                let turn = (any() as i32) >> (any() % 31);
                let turn = if any() % 2 == 0 { turn } else { -turn };
                edges += i128::from(turn);
                pulses += i128::from(pulser.take(turn, gear));
                let counts = (edges >> gear.shift) * if gear.reversed { -1 } else { 1 };
                let exact = counts * i128::from(multiplier * divider);
                assert_eq!(pulses, exact.div_euclid(DIVISIONS.into()), "{edges} edges through {gear:?}");
            }
        }
    }
}
