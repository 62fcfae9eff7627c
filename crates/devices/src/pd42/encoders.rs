//! The internal SensOstep encoder, the external ABN encoder, and the deviation stops
//! (manual, sections 6.2 and 6.3).

use super::memory::Memory;
use super::pins::encoder as channel;
use super::{Pd42, ap, gp, motion};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::encoder::{ClearOnNull, Encoder, NullLevel};
use tmcl::isa::Condition;

/// Counts of the SensOstep encoder in a turn.
pub const COUNTS_A_TURN: u32 = 1024;

/// How near to its absolute zero the encoder counts as there (input 11 of bank 0), in counts.
const NEAR_ZERO: u32 = 8;

/// Lower bits of axis parameter 210 that are functions, and the one that clears on null.
const FUNCTION_BITS: i32 = 0xF;
const CLEAR_ON_NULL: i32 = 4;

/// Bits of axis parameter 201.
const EXTERNAL_CLEAR: i32 = 4;
const EXTERNAL_EVERY: i32 = 8;
const EXTERNAL_HIGH: i32 = 16;

/// The interrupt of the deviation stops.
const DEVIATION: u8 = 21;

/// Both encoders.
#[derive(Clone, Debug)]
pub struct Encoders {
    pub internal: Encoder,
    pub external: Encoder,
    /// The counts that were seen last; none before the first look.
    raw: Option<i32>,
}

impl Encoders {
    pub const fn new() -> Self {
        Self {
            internal: Encoder::new(9, 25_600, COUNTS_A_TURN),
            external: Encoder::new(8, 256, 1),
            raw: None,
        }
    }

    /// Takes over the parameters.
    pub fn configure<F: Flash>(&mut self, memory: &Memory<F>) {
        let functions = memory.axis.get(ap::ENCODER_PRESCALER);
        self.internal.set_prescaler(functions & !FUNCTION_BITS);
        let clears = functions & CLEAR_ON_NULL != 0;
        self.internal.set_clear_on_null(if clears { ClearOnNull::Always } else { ClearOnNull::Never });
        self.external.set_prescaler(memory.axis.get(ap::EXTERNAL_PRESCALER));
        let functions = memory.axis.get(ap::EXTERNAL_ENCODER_FUNCTIONS);
        self.external.set_clear_on_null(match (functions & EXTERNAL_CLEAR, functions & EXTERNAL_EVERY) {
            (0, _) => ClearOnNull::Never,
            (_, 0) => ClearOnNull::Once,
            _ => ClearOnNull::Always,
        });
        let high = functions & EXTERNAL_HIGH != 0;
        self.external.set_null_level(if high { NullLevel::High } else { NullLevel::Low });
        let reversed = memory.module.get(gp::REVERSE_SHAFT) != 0;
        self.internal.set_reversed(reversed);
        self.external.set_reversed(reversed);
    }

    /// Sets both positions to 0 where the encoders stand, before anything moves.
    pub fn begin(&mut self, board: &mut dyn Board) {
        if self.raw.is_none() {
            self.update(board);
        }
    }

    /// Reads both counters. The first reading is where both positions are 0.
    pub fn update(&mut self, board: &mut dyn Board) {
        let raw = board.encoder(channel::INTERNAL);
        let external = board.encoder(channel::EXTERNAL);
        match self.raw {
            None => {
                self.internal.update(raw);
                self.internal.set_position(0);
                let angle = raw.rem_euclid(COUNTS_A_TURN as i32) as u32;
                let turned = (COUNTS_A_TURN - angle) % COUNTS_A_TURN;
                self.internal.set_angle(if self.internal.reversed() { turned } else { angle });
                self.external.update(external);
                self.external.set_position(0);
            }
            Some(before) => {
                if let Some(zero) = passed_zero(before, raw) {
                    self.internal.null_event(zero, false);
                }
                self.internal.update(raw);
                self.external.update(external);
            }
        }
        self.raw = Some(raw);
    }

    /// Whether the external null channel matters now.
    pub fn watches_null(&self) -> bool {
        self.external.clear_on_null() != ClearOnNull::Never
    }

    /// Whether a deviation stop is on.
    pub fn watched<F: Flash>(&self, memory: &Memory<F>) -> bool {
        memory.axis.get(ap::MAX_DEVIATION) != 0 || memory.axis.get(ap::MAX_EXTERNAL_DEVIATION) != 0
    }

    /// Whether the shaft is near the encoder's absolute zero.
    pub fn near_zero(&self) -> bool {
        let angle = self.internal.angle();
        angle.min(COUNTS_A_TURN - angle) <= NEAR_ZERO
    }
}

/// The count of the absolute zero that was passed last between two readings, if one was.
fn passed_zero(before: i32, now: i32) -> Option<i32> {
    let turn = COUNTS_A_TURN as i32;
    let way = now.wrapping_sub(before);
    if way == 0 {
        return None;
    }
    let beyond = now.rem_euclid(turn);
    let beyond = if way > 0 { beyond } else { (turn - beyond) % turn };
    (beyond < way.abs()).then(|| now.wrapping_sub(beyond * way.signum()))
}

impl<F: Flash> Pd42<F> {
    /// Takes over the parameters; counts so far belong to the settings so far.
    pub fn configure_encoders(&mut self, board: &mut dyn Board) {
        self.encoders.update(board);
        self.encoders.configure(&self.memory);
    }

    /// The external null channel changes.
    pub fn null_channel(&mut self, high: bool, board: &mut dyn Board) {
        self.encoders.external.null_event(board.encoder(channel::EXTERNAL), high);
    }

    /// Too great a difference between position and encoder stops the motor.
    pub fn watch_deviation(&mut self, board: &mut dyn Board) {
        if !self.encoders.watched(&self.memory) {
            return;
        }
        self.encoders.update(board);
        let position = self.axis.position();
        let pairs = [
            (self.encoders.internal.position(), ap::MAX_DEVIATION),
            (self.encoders.external.position(), ap::MAX_EXTERNAL_DEVIATION),
        ];
        let exceeded = pairs.into_iter().any(|(encoder, limit)| {
            let limit = self.memory.axis.get(limit);
            limit > 0 && position.wrapping_sub(encoder).unsigned_abs() > limit.unsigned_abs()
        });
        let errors = self.memory.axis.get(ap::EXTENDED_ERRORS);
        if exceeded && (self.axis.is_moving() || errors & motion::DEVIATION_ERROR == 0) {
            self.stop_hard();
            self.memory.axis.set(ap::EXTENDED_ERRORS, errors | motion::DEVIATION_ERROR);
            self.vm.set_error(Condition::Deviation);
            self.raise(DEVIATION);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::passed_zero;

    #[test]
    fn zeros_between_readings() {
        for (before, now, zero) in [
            (0, 0, None),
            (0, 5, None),
            (-5, 0, Some(0)),
            (-5, 3, Some(0)),
            (5, 0, Some(0)),
            (5, -3, Some(0)),
            (0, -3, None),
            (1000, 1024, Some(1024)),
            (1000, 3000, Some(2048)),
            (3000, 1000, Some(1024)),
        ] {
            assert_eq!(passed_zero(before, now), zero, "{before} to {now}");
        }
    }
}
