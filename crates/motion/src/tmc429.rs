//! The units of the TMC429 motion controller: what its registers mean to the kernel.
//!
//! Velocity has 11 integer and 8 fraction bits: `v[pps] = f·v / (2^pulse_div · 2048 · 32)`.
//! Acceleration is `a[pps²] = f²·a / 2^(pulse_div + ramp_div + 29)`. f is the clock of 16 MHz.
//! (PD42-1140 firmware manual, section 6.1.)

use crate::speed::{Growth, MAX_GROWTH, Scale, Speed};

/// Clock of the chip on the module.
pub const CLOCK_HZ: u32 = 16_000_000;

/// The largest velocity and acceleration register value.
pub const MAX_INTERNAL: i32 = 2047;

/// Bits of a kernel speed below the integer unit: the chip's 8 and 12 more.
const UNIT_BITS: u32 = 20;

/// The scale of speeds with this pulse divisor (0 to 13).
pub const fn scale(pulse_div: u32) -> Scale {
    Scale::new(16 + UNIT_BITS + pulse_div)
}

/// A velocity register's value (0 to 2047) as a kernel speed in [`scale`].
pub const fn speed(internal: u32) -> Speed {
    internal << UNIT_BITS
}

/// A kernel speed in [`scale`] as a velocity register would show it.
pub const fn internal(speed: Speed) -> i32 {
    (speed >> UNIT_BITS) as i32
}

/// An acceleration register's value (1 to 2047) with the two divisors.
pub const fn growth(internal: u32, pulse_div: u32, ramp_div: u32) -> Growth {
    let wide = (internal as u128) << (44 + pulse_div - ramp_div);
    if wide > MAX_GROWTH as u128 { MAX_GROWTH } else { wide as Growth }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_are_those_of_the_manual() {
        // Section 6.1.1: 1678 with divisor 3 is about 51,208.5 pps.
        let mpps = scale(3).millipulses_per_second(speed(1678), CLOCK_HZ);
        assert_eq!(mpps, 51_208_496);
        assert_eq!(internal(speed(1678)), 1678);
    }

    #[test]
    fn accelerations_are_those_of_the_manual() {
        // Section 6.1.2: 100 with both divisors 7 and 3 is about 46,566 pps²: v² grows by twice that a pulse.
        let bits = scale(3).bits();
        let growth = growth(100, 3, 7) as f64;
        let pps2 = growth * (16e6f64).powi(2) / 2f64.powi(2 * bits as i32) / 2.0;
        assert!((pps2 - 46_566.1).abs() < 0.1, "{pps2}");
    }

    #[test]
    fn every_divisor_fits() {
        for pulse_div in 0..=13 {
            for ramp_div in 0..=13 {
                for a in [1, 2047] {
                    assert!((1..=MAX_GROWTH).contains(&growth(a, pulse_div, ramp_div)));
                }
            }
            assert!(speed(1) >= scale(pulse_div).slowest());
        }
    }
}
