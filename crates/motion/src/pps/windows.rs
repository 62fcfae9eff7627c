//! Speed windows, and what the ramps of a move may be: PMX-2ED-SA manual, table A.0 and sections A.1 and
//! A.2; CMD-4CR manual, table B-46 and sections B.1 and B.2.

/// A row of the table of speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its number in SSPDM. 0 there means none: the window follows from the high speed.
    pub number: u8,
    /// The lowest high speed of the window.
    pub from_pps: u32,
    /// The highest.
    pub to_pps: u32,
    /// The least low speed.
    pub least_low_pps: u32,
    /// Speeds are multiples of this: the magnification of a speed register.
    pub step_pps: u32,
    /// The shortest ramp.
    pub least_ms: u32,
    /// The gentlest acceleration, in pulses a second each second.
    pub delta: u32,
}

/// The windows of the PMX-2ED-SA.
pub const PERFORMAX: [Window; 9] = [
    row(1, [1, 16_000], 1, 1, 300),
    row(2, [16_000, 32_000], 2, 1, 775),
    row(3, [32_000, 80_000], 5, 1, 1900),
    row(4, [80_000, 160_000], 10, 1, 3700),
    row(5, [160_000, 325_000], 20, 1, 7300),
    row(6, [325_000, 815_000], 50, 1, 18_000),
    row(7, [815_000, 1_600_000], 100, 1, 38_400),
    row(8, [1_600_000, 3_200_000], 200, 1, 68_000),
    row(9, [3_200_000, 6_000_000], 400, 1, 135_000),
];

/// The windows of the CMD-4CR. Speeds are in 16-bit registers of the PCL6045BL, times the magnification that the
/// window stands for, so "65K" of table B-46 is 65,535.
pub const COMMANDER: [Window; 7] = [
    magnified(1, 0, 1, 2, 50),
    magnified(2, 1, 2, 1, 100),
    magnified(3, 2, 5, 1, 200),
    magnified(4, 5, 10, 1, 800),
    magnified(5, 10, 20, 1, 1500),
    magnified(6, 20, 50, 1, 3800),
    magnified(7, 50, 100, 1, 7500),
];

/// The largest number in a speed register of the PCL6045BL.
const MAX_REGISTER: u32 = 65_535;

const fn row(number: u8, pps: [u32; 2], least_low_pps: u32, least_ms: u32, delta: u32) -> Window {
    let [from_pps, to_pps] = pps;
    Window { number, from_pps, to_pps, least_low_pps, step_pps: 1, least_ms, delta }
}

/// From the end of the window below, which has its own magnification.
const fn magnified(number: u8, below: u32, magnification: u32, least_ms: u32, delta: u32) -> Window {
    let from_pps = if below == 0 { 1 } else { MAX_REGISTER * below };
    let pps = [from_pps, MAX_REGISTER * magnification];
    Window { step_pps: magnification, ..row(number, pps, magnification, least_ms, delta) }
}

/// The window of a high speed: the slower one at a border, the last one beyond the end.
pub const fn window(windows: &[Window], high_pps: u32) -> &Window {
    let mut at = 0;
    while at + 1 < windows.len() && windows[at].to_pps < high_pps {
        at += 1;
    }
    &windows[at]
}

impl Window {
    /// The longest ramp between two speeds, in milliseconds.
    pub const fn longest_ms(&self, [low_pps, high_pps]: [u32; 2]) -> u32 {
        let longest = high_pps.saturating_sub(low_pps) as u64 * 1000 / self.delta as u64;
        if longest < self.least_ms as u64 {
            self.least_ms
        } else if longest > u32::MAX as u64 {
            u32::MAX
        } else {
            longest as u32
        }
    }

    /// The speed that the registers have where this one is asked for; the least is one step.
    pub const fn stepped(&self, pps: u32) -> u32 {
        let stepped = pps - pps % self.step_pps;
        if stepped == 0 { self.step_pps } else { stepped }
    }

    /// The time that a ramp between two speeds really takes when this one is asked for.
    pub const fn clamp_ms(&self, ms: u32, ends_pps: [u32; 2]) -> u32 {
        let longest = self.longest_ms(ends_pps);
        if ms < self.least_ms {
            self.least_ms
        } else if ms > longest {
            longest
        } else {
            ms
        }
    }
}

/// Acceleration and deceleration of a move of so many pulses, in milliseconds.
///
/// Where either ramp alone would take more than half of the way, the deceleration is that of the
/// acceleration, and if the high speed is not reached the highest one lies in the middle.
pub const fn positional(
    pulses: u32,
    ends_pps: [u32; 2],
    [acceleration_ms, deceleration_ms]: [u32; 2],
) -> [u32; 2] {
    let [low_pps, high_pps] = ends_pps;
    // The way of a ramp is its time by the mean speed, of an S as well.
    let sum = low_pps as u128 + high_pps as u128;
    let half = 1000 * pulses as u128;
    if acceleration_ms as u128 * sum > half || deceleration_ms as u128 * sum > half {
        [acceleration_ms; 2]
    } else {
        [acceleration_ms, deceleration_ms]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_follow_each_other() {
        for windows in [&PERFORMAX[..], &COMMANDER] {
            assert_eq!(windows[0].from_pps, 1);
            for (number, row) in (1..).zip(windows) {
                assert_eq!(row.number, number);
                assert!(row.from_pps < row.to_pps);
                assert_eq!(window(windows, row.to_pps), row);
                assert_eq!(window(windows, row.from_pps + 1), row);
            }
            assert!(windows.is_sorted_by(|a, b| a.to_pps == b.from_pps && a.delta < b.delta));
            assert_eq!(window(windows, u32::MAX), &windows[windows.len() - 1]);
            assert_eq!(window(windows, 0), &windows[0]);
        }
    }

    /// Low and high speed, shortest and longest ramp.
    #[track_caller]
    fn check_range(windows: &[Window], ends: [u32; 2], least_ms: u32, longest_ms: u32) {
        let window = window(windows, ends[1]);
        assert_eq!([window.least_ms, window.longest_ms(ends)], [least_ms, longest_ms]);
        assert_eq!(window.clamp_ms(0, ends), least_ms);
        assert_eq!(window.clamp_ms(u32::MAX, ends), longest_ms);
        assert_eq!(window.clamp_ms(longest_ms, ends), longest_ms);
    }

    #[test]
    fn ramps_have_the_ranges_of_the_manuals_examples() {
        // Section A.1.
        check_range(&PERFORMAX, [10_000, 20_000], 1, 12_903);
        check_range(&PERFORMAX, [9000, 900_000], 1, 23_203);
        // Section B.1, but for the least time, which table B-46 has as 2 ms up to 65,000 pps.
        check_range(&COMMANDER, [10_000, 20_000], 2, 200_000);
        check_range(&COMMANDER, [9000, 900_000], 1, 594_000);
        // The registers' ends.
        let ends = COMMANDER.map(|row| row.to_pps);
        assert_eq!(ends, [65_535, 131_070, 327_675, 655_350, 1_310_700, 3_276_750, 6_553_500]);
        // Nothing to gain, or less than the gentlest acceleration gains in the shortest time.
        check_range(&PERFORMAX, [500, 500], 1, 1);
        check_range(&PERFORMAX, [500, 400], 1, 1);
        check_range(&COMMANDER, [500, 500], 2, 2);
    }

    #[test]
    fn a_short_move_slows_down_as_it_sped_up() {
        // Both ramps between 1000 and 9000 pps: 5 pulses a millisecond.
        let check = |pulses, times, expected| {
            assert_eq!(positional(pulses, [1000, 9000], times), expected, "{pulses} {times:?}");
        };
        check(1000, [100, 100], [100, 100]);
        check(1000, [50, 100], [50, 100]);
        check(999, [50, 100], [50, 50]);
        check(1000, [100, 50], [100, 50]);
        check(999, [100, 50], [100, 100]);
        check(0, [100, 50], [100, 100]);
        check(u32::MAX, [u32::MAX, 1], [u32::MAX, u32::MAX]);
    }
}
