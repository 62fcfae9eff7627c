//! An encoder counter as a controller shows it: hardware counts times a prescaler.
//!
//! The register has a fixed number of fraction bits and the prescaler is a whole number of the smallest
//! fraction, so every count adds exactly and nothing is ever rounded in the register; only a reading is
//! rounded down to whole positions. All of it wraps as the hardware's counters do.

/// When a null channel clears the position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClearOnNull {
    /// It does not.
    #[default]
    Never,
    /// With the next null event, then no more.
    Once,
    /// With every null event.
    Always,
}

/// Which level of the null channel is the null.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NullLevel {
    /// The channel falls at the null.
    #[default]
    Low,
    /// The channel rises at the null.
    High,
}

/// A scaled encoder counter. PD42-1140 firmware manual, sections 6.2 and 6.3.
#[derive(Clone, Debug)]
pub struct Encoder {
    /// Position in 2^−`fraction_bits`, modulo 2³² positions.
    register: u64,
    fraction_bits: u32,
    prescaler: i32,
    raw: i32,
    reversed: bool,
    counts_per_revolution: u32,
    angle: u32,
    clear: ClearOnNull,
    null: NullLevel,
}

/// The most fraction bits of a prescaler.
pub const MAX_FRACTION_BITS: u32 = 32;

impl Encoder {
    /// A counter at position 0 and angle 0, when the decoder's count is 0.
    ///
    /// The prescaler is `prescaler / 2^fraction_bits`: 9 bits are axis parameter 210, 8 bits 217. One
    /// revolution of the shaft is `counts_per_revolution` of the decoder.
    ///
    /// # Panics
    /// With more than [`MAX_FRACTION_BITS`], or without counts a revolution.
    pub const fn new(fraction_bits: u32, prescaler: i32, counts_per_revolution: u32) -> Self {
        assert!(fraction_bits <= MAX_FRACTION_BITS, "too many fraction bits");
        assert!(counts_per_revolution > 0, "a revolution has counts");
        Self {
            register: 0,
            fraction_bits,
            prescaler,
            raw: 0,
            reversed: false,
            counts_per_revolution,
            angle: 0,
            clear: ClearOnNull::Never,
            null: NullLevel::Low,
        }
    }

    /// Takes the decoder's present count. Between two calls it moves by less than 2³¹ either way.
    pub fn update(&mut self, raw: i32) {
        let moved = i64::from(raw.wrapping_sub(self.raw));
        self.raw = raw;
        let moved = if self.reversed { -moved } else { moved };
        self.register = self.register.wrapping_add((moved * i64::from(self.prescaler)) as u64);
        let turn = i64::from(self.counts_per_revolution);
        self.angle = (i64::from(self.angle) + moved).rem_euclid(turn) as u32;
    }

    /// The null channel changed to `high` when the decoder's count was `raw`. Whether that cleared the
    /// position.
    ///
    /// Events come in the order in which they happened, before the [`Encoder::update`] with the count
    /// that the decoder has reached since.
    pub fn null_event(&mut self, raw: i32, high: bool) -> bool {
        self.update(raw);
        let cleared = self.clear != ClearOnNull::Never && high == (self.null == NullLevel::High);
        if cleared {
            self.register = 0;
            if self.clear == ClearOnNull::Once {
                self.clear = ClearOnNull::Never;
            }
        }
        cleared
    }

    /// The position, rounded down.
    pub fn position(&self) -> i32 {
        (self.register >> self.fraction_bits) as i32
    }

    /// Overwrites the position; its fraction becomes 0.
    pub fn set_position(&mut self, position: i32) {
        self.register = (i64::from(position) << self.fraction_bits) as u64;
    }

    /// The prescaler's numerator.
    pub fn prescaler(&self) -> i32 {
        self.prescaler
    }

    /// Changes the prescaler for the counts that come; the position stays. A negative one counts the
    /// other way, 0 holds the position.
    pub fn set_prescaler(&mut self, prescaler: i32) {
        self.prescaler = prescaler;
    }

    /// Whether the position falls when the decoder's count rises.
    pub fn reversed(&self) -> bool {
        self.reversed
    }

    /// Turns the counting direction around, of position and angle; the position stays.
    pub fn set_reversed(&mut self, reversed: bool) {
        if reversed != self.reversed {
            self.reversed = reversed;
            self.angle = (self.counts_per_revolution - self.angle) % self.counts_per_revolution;
        }
    }

    /// When the null channel clears the position. After a [`ClearOnNull::Once`] this is `Never` again.
    pub fn clear_on_null(&self) -> ClearOnNull {
        self.clear
    }

    /// Arms or disarms clearing.
    pub fn set_clear_on_null(&mut self, clear: ClearOnNull) {
        self.clear = clear;
    }

    /// Chooses the level that is the null.
    pub fn set_null_level(&mut self, level: NullLevel) {
        self.null = level;
    }

    /// Where in its revolution the shaft stands, in counts of the decoder: 0 to a revolution's less one.
    /// Neither prescaler nor position matter.
    pub fn angle(&self) -> u32 {
        self.angle
    }

    /// Tells an absolute sensor's angle at the decoder's present count, taken modulo a revolution.
    pub fn set_angle(&mut self, angle: u32) {
        self.angle = angle % self.counts_per_revolution;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(fraction_bits: u32, prescaler: i32, raws: &[i32], positions: &[i32]) {
        let mut encoder = Encoder::new(fraction_bits, prescaler, 1024);
        let got: Vec<_> = raws
            .iter()
            .map(|&raw| {
                encoder.update(raw);
                encoder.position()
            })
            .collect();
        assert_eq!(got, positions, "prescaler {prescaler}/2^{fraction_bits}");
    }

    #[test]
    fn counts_times_prescaler() {
        check(9, 25_600, &[1, 1024, 0, -3], &[50, 51_200, 0, -150]);
        check(9, 200, &[1, 2, 3, 1024], &[0, 0, 1, 400]);
        check(8, 32, &[7, 8, 15, 16, -1, -8, -9], &[0, 1, 1, 2, -1, -1, -2]);
        check(8, 16_384, &[1, -1], &[64, -64]);
        check(8, -256, &[5, -5], &[-5, 5]);
        check(8, 0, &[5, -5], &[0, 0]);
    }

    #[test]
    fn decoder_and_position_wrap() {
        check(8, 256, &[i32::MAX, i32::MIN, i32::MIN + 9], &[i32::MAX, i32::MIN, i32::MIN + 9]);
        // Twice the largest count is two short of a full circle.
        check(8, 512, &[i32::MAX, i32::MIN], &[-2, 0]);
    }

    #[test]
    fn millions_of_counts_do_not_drift() {
        for prescaler in [200, 1, 25_599, -77] {
            let mut encoder = Encoder::new(9, prescaler, 1024);
            let mut raw = 0i32;
            let mut total = 0i128;
            let mut step = 1i32;
            for _ in 0..3_000_000 {
                step = step.wrapping_mul(1_103_515_245).wrapping_add(12_345);
                let moved = (step >> 16) % 7 + 1;
                raw = raw.wrapping_add(moved);
                total += i128::from(moved);
                encoder.update(raw);
            }
            let expected = (total * i128::from(prescaler)).div_euclid(512) as i32;
            assert_eq!(encoder.position(), expected, "prescaler {prescaler}");
        }
    }

    #[test]
    fn a_new_prescaler_keeps_the_position() {
        let mut encoder = Encoder::new(8, 384, 1024);
        encoder.update(3);
        assert_eq!(encoder.position(), 4);
        encoder.set_prescaler(128);
        assert_eq!(encoder.position(), 4);
        // 4.5 and a half: the fraction was kept as well.
        encoder.update(4);
        assert_eq!(encoder.position(), 5);
    }

    #[test]
    fn a_written_position_counts_on() {
        let mut encoder = Encoder::new(9, 256, 1024);
        encoder.update(1);
        encoder.set_position(-1000);
        encoder.update(2);
        assert_eq!(encoder.position(), -1000);
        encoder.update(3);
        assert_eq!(encoder.position(), -999);
        encoder.set_position(i32::MIN);
        assert_eq!(encoder.position(), i32::MIN);
    }

    #[test]
    fn reversal_turns_position_and_angle() {
        let mut encoder = Encoder::new(8, 256, 1000);
        encoder.update(10);
        encoder.set_reversed(true);
        assert_eq!((encoder.position(), encoder.angle()), (10, 990));
        encoder.update(30);
        assert_eq!((encoder.position(), encoder.angle()), (-10, 970));
        encoder.set_reversed(false);
        assert_eq!((encoder.position(), encoder.angle()), (-10, 30));
    }

    /// Null pulses of one count's width at 100 and 300 while the decoder runs to 350.
    fn check_null(clear: ClearOnNull, level: NullLevel, expected: [i32; 4]) {
        let mut encoder = Encoder::new(8, 512, 1024);
        encoder.set_clear_on_null(clear);
        encoder.set_null_level(level);
        let mut seen = [0; 4];
        encoder.null_event(100, true);
        encoder.null_event(101, false);
        encoder.update(200);
        seen[0] = encoder.position();
        encoder.null_event(300, true);
        seen[1] = encoder.position();
        encoder.null_event(301, false);
        seen[2] = encoder.position();
        encoder.update(350);
        seen[3] = encoder.position();
        assert_eq!(seen, expected, "{clear:?} {level:?}");
        let after = if clear == ClearOnNull::Once { ClearOnNull::Never } else { clear };
        assert_eq!(encoder.clear_on_null(), after);
    }

    #[test]
    fn null_clears_where_it_happens() {
        use ClearOnNull::{Always, Never, Once};
        check_null(Never, NullLevel::High, [400, 600, 602, 700]);
        check_null(Once, NullLevel::High, [200, 400, 402, 500]);
        check_null(Once, NullLevel::Low, [198, 398, 400, 498]);
        check_null(Always, NullLevel::High, [200, 0, 2, 100]);
        check_null(Always, NullLevel::Low, [198, 398, 0, 98]);
    }

    #[test]
    fn the_angle_ignores_prescaler_and_position() {
        let mut encoder = Encoder::new(9, 25_600, 1024);
        encoder.set_angle(1000);
        encoder.update(100);
        encoder.set_position(7);
        encoder.set_prescaler(16);
        assert_eq!(encoder.angle(), 76);
        encoder.update(-100);
        assert_eq!(encoder.angle(), 900);
        encoder.update(i32::MIN);
        let gone = i64::from(i32::MIN);
        assert_eq!(i64::from(encoder.angle()), (1000 + gone).rem_euclid(1024));
    }
}
