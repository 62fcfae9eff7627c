//! Bits of the polarity words (manual, table 2-17).

/// Pulse output mode, as register RENV1 of the PCL6045BL has it: 0 to 3 pulse and direction with their four
/// logics, 4 and 7 two-pulse, 5 and 6 with 90 degrees between.
pub const PULSE_MODE: i32 = 7;
/// The limit inputs.
pub const LIMITS: i32 = 1 << 3;
/// The home input.
pub const HOME: i32 = 1 << 4;
/// The alarm input.
pub const ALARM: i32 = 1 << 5;
/// The slowdown input.
pub const SLOWDOWN: i32 = 1 << 6;
/// The in-position input.
pub const IN_POSITION: i32 = 1 << 7;
/// The output that clears the deflection counter of a servo driver.
pub const ERROR_CLEAR: i32 = 1 << 8;
/// The enable output.
pub const ENABLE: i32 = 1 << 9;
/// The direction in which the encoder counts.
pub const ENCODER: i32 = 1 << 10;
/// Encoder input: one of the [`input`] modes.
pub const ENCODER_SHIFT: u32 = 11;
/// The Z index.
pub const INDEX: i32 = 1 << 13;
/// The direction in which the manual pulse generator counts.
pub const PULSER: i32 = 1 << 14;
/// Manual pulse generator input: one of the [`input`] modes.
pub const PULSER_SHIFT: u32 = 15;

/// How pulses of an encoder or a manual pulse generator are counted.
pub mod input {
    /// One count an A/B cycle.
    pub const SINGLE: i32 = 0;
    /// Two counts an A/B cycle.
    pub const DOUBLE: i32 = 1;
    /// Four counts an A/B cycle.
    pub const FOURFOLD: i32 = 2;
    /// One count a pulse, up on A and down on B.
    pub const TWO_PULSE: i32 = 3;
}

/// All bits.
pub const ALL: i32 = (1 << 17) - 1;

/// From the factory: fourfold counting of encoder and manual pulse generator.
pub const DEFAULT: i32 = input::FOURFOLD << ENCODER_SHIFT | input::FOURFOLD << PULSER_SHIFT;

/// By how many bits a decoder's fourfold count is more than what is counted.
const fn shift(mode: i32) -> u32 {
    match mode & 3 {
        input::SINGLE => 2,
        input::DOUBLE => 1,
        // What the decoder counts of two-pulse inputs are the pulses.
        _ => 0,
    }
}

/// How the encoder counts: by how many bits coarser than its decoder, and whether the other way round.
pub const fn encoder(word: i32) -> (u32, bool) {
    (shift(word >> ENCODER_SHIFT), word & ENCODER != 0)
}

/// The same of the manual pulse generator.
pub const fn pulser(word: i32) -> (u32, bool) {
    (shift(word >> PULSER_SHIFT), word & PULSER != 0)
}

/// Whether a driver that was wired for mode 0, or for another of its kind, turns the other way: the logic of
/// the direction, or the order of the phases.
pub const fn reverses(word: i32) -> bool {
    matches!(word & PULSE_MODE, 2 | 3 | 6)
}
