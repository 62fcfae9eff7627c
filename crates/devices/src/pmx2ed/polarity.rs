//! Bits of the polarity words (manual, table 7.7).

/// The direction output.
pub const DIRECTION: i32 = 1 << 1;
/// The home input.
pub const HOME: i32 = 1 << 5;
/// The limit inputs.
pub const LIMITS: i32 = 1 << 6;
/// The Z index.
pub const INDEX: i32 = 1 << 7;
/// Encoder decoding: 0 single, 1 double, 2 (and 3) fourfold.
pub const DECODING_SHIFT: u32 = 8;
/// All digital inputs.
pub const INPUTS: i32 = 1 << 10;
/// All digital outputs.
pub const OUTPUTS: i32 = 1 << 11;
/// The enable output.
pub const ENABLE: i32 = 1 << 12;
/// SUB 31 returns to the program's first line.
pub const RESTART: i32 = 1 << 13;

/// Of these there is one for the whole controller: both words have the same bit.
pub const SHARED: i32 = INPUTS | OUTPUTS | RESTART;

/// From the factory: fourfold decoding.
pub const DEFAULT: i32 = 2 << DECODING_SHIFT;

/// By how many bits the decoder's fourfold count is more than what the encoder register counts.
pub const fn decoding_shift(word: i32) -> u32 {
    match word >> DECODING_SHIFT & 3 {
        0 => 2,
        1 => 1,
        _ => 0,
    }
}
