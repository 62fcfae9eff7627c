//! What the module's driver chip does by itself: currents, load measurement, CoolStep
//! (manual, sections 7.2 and 7.3, and the axis parameters 160 to 184).
//!
//! The load of the shaft comes from the board in thousandths of the pull-out torque at full current. The
//! chip's reading falls with it in a straight line and is 0 at the pull-out torque of the present current.

/// Full-scale current, in 32nds.
pub const FULL_CURRENT: u8 = 32;

/// StallGuard2 readings have ten bits.
const MAX_READING: i32 = 1023;

/// Reading without load at threshold 0.
const IDLE_READING: i32 = 512;

/// What a step of the threshold adds to a reading.
const READING_A_THRESHOLD: i32 = 8;

/// Full steps over which the filter averages.
const FILTER_STEPS: usize = 4;

/// Temperatures of the driver in °C, as in the chip's data sheet: warning and shutdown.
pub const WARNING_CELSIUS: i32 = 100;
/// See [`WARNING_CELSIUS`].
pub const SHUTDOWN_CELSIUS: i32 = 150;

/// A current of 0 to 255 in 32nds: 0 to 7 is one, 248 to 255 all.
pub const fn current_of(value: i32) -> u8 {
    (value / 8 + 1) as u8
}

/// Settings of CoolStep, by the numbers of their axis parameters.
#[derive(Clone, Copy, Debug)]
pub struct CoolStep {
    /// 168: the least current is a half (0) or a quarter (1) of the maximum.
    pub minimum: i32,
    /// 169: readings for a step down.
    pub down: i32,
    /// 170: distance of the thresholds.
    pub hysteresis: i32,
    /// 171: steps up for a reading.
    pub up: i32,
    /// 172: lower threshold.
    pub start: i32,
    /// The maximum, in 32nds.
    pub maximum: u8,
}

/// The measuring and regulating part of the driver chip.
#[derive(Clone, Debug)]
pub struct Driver {
    samples: [u16; FILTER_STEPS],
    /// The full step of the last sample.
    full_step: i64,
    /// Whether samples wait for CoolStep.
    fresh: u32,
    reading: u16,
    /// CoolStep's current in 32nds.
    regulated: u8,
    above: u32,
}

impl Driver {
    /// A driver that has not seen a step.
    pub const fn new() -> Self {
        Self {
            samples: [0; FILTER_STEPS],
            full_step: i64::MIN,
            fresh: 0,
            reading: 0,
            regulated: FULL_CURRENT,
            above: 0,
        }
    }

    /// The last StallGuard2 reading.
    pub const fn reading(&self) -> u16 {
        self.reading
    }

    /// CoolStep's current in 32nds.
    pub const fn regulated(&self) -> u8 {
        self.regulated
    }

    /// Takes a measurement if the motor has made a full step since the last one. `current` is in 32nds.
    pub fn measure(&mut self, full_step: i64, load: u16, current: u8, threshold: i32, filtered: bool) {
        let steps = full_step.saturating_sub(self.full_step).unsigned_abs().min(FILTER_STEPS as u64);
        if steps == 0 {
            return;
        }
        let first = self.full_step == i64::MIN;
        let steps = if first { 1 } else { steps };
        self.full_step = full_step;
        self.fresh = self.fresh.saturating_add(steps as u32);
        let share = i32::from(load) * i32::from(FULL_CURRENT) / i32::from(current.max(1));
        let sample = IDLE_READING * (1000 - share) / 1000 + READING_A_THRESHOLD * threshold;
        let sample = sample.clamp(0, MAX_READING) as u16;
        if first {
            self.samples = [sample; FILTER_STEPS];
        }
        self.samples.rotate_left(steps as usize % FILTER_STEPS);
        self.samples[FILTER_STEPS - steps as usize..].fill(sample);
        self.reading = if filtered {
            (self.samples.iter().map(|&sample| u32::from(sample)).sum::<u32>() / FILTER_STEPS as u32) as u16
        } else {
            sample
        };
    }

    /// Lets CoolStep act on the measurements since the last time.
    pub fn regulate(&mut self, settings: CoolStep) {
        let lower = settings.start * 32;
        let upper = (settings.start + settings.hysteresis + 1) * 32;
        let least = (settings.maximum / if settings.minimum == 0 { 2 } else { 4 }).max(1);
        self.regulated = self.regulated.clamp(least, settings.maximum);
        for _ in 0..core::mem::take(&mut self.fresh).min(FILTER_STEPS as u32) {
            let reading = i32::from(self.reading);
            if reading < lower {
                self.above = 0;
                self.regulated = (self.regulated + (1 << settings.up)).min(settings.maximum);
            } else if reading >= upper {
                self.above += 1;
                if self.above >= [32, 8, 2, 1][settings.down as usize] {
                    self.above = 0;
                    self.regulated = (self.regulated - 1).max(least);
                }
            }
        }
    }

    /// Forgets what CoolStep had regulated.
    pub fn release(&mut self, maximum: u8) {
        self.regulated = maximum;
        self.above = 0;
        self.fresh = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(load: u16, current: u8, threshold: i32) -> u16 {
        let mut driver = Driver::new();
        driver.measure(0, load, current, threshold, false);
        driver.reading()
    }

    #[test]
    fn currents_come_in_32_steps() {
        for (value, current) in [(0, 1), (7, 1), (8, 2), (127, 16), (247, 31), (248, 32), (255, 32)] {
            assert_eq!(current_of(value), current, "{value}");
        }
    }

    #[test]
    fn the_reading_falls_with_the_load() {
        let readings: Vec<_> = [0, 250, 500, 750, 1000, 1500].map(|load| reading(load, 32, 0)).into();
        assert_eq!(readings, [512, 384, 256, 128, 0, 0]);
        // Half the current has half the torque.
        assert_eq!(reading(500, 16, 0), 0);
    }

    #[test]
    fn a_higher_threshold_is_less_sensitive() {
        assert_eq!(reading(1000, 32, 10), 80);
        assert_eq!(reading(500, 32, -32), 0);
        assert_eq!(reading(0, 32, 63), 1016);
    }

    #[test]
    fn the_filter_averages_four_full_steps() {
        let mut driver = Driver::new();
        driver.measure(0, 0, 32, 0, true);
        for (step, expected) in [(1, 384), (2, 256), (3, 128), (4, 0)] {
            driver.measure(step, 1000, 32, 0, true);
            assert_eq!(driver.reading(), expected);
        }
        driver.measure(4, 0, 32, 0, true);
        assert_eq!(driver.reading(), 0, "no full step, no measurement");
    }

    #[test]
    fn coolstep_steps_up_fast_and_down_slowly() {
        let mut settings = CoolStep { minimum: 0, down: 2, hysteresis: 1, up: 1, start: 4, maximum: 32 };
        let mut driver = Driver::new();
        let run = |driver: &mut Driver, steps: i64, load, settings| {
            for _ in 0..steps {
                driver.measure(driver.full_step.max(0) + 1, load, driver.regulated(), 0, false);
                driver.regulate(settings);
            }
            driver.regulated()
        };
        // No load reads 512, above the upper threshold of 192: a step down for every second reading.
        assert_eq!(run(&mut driver, 20, 0, settings), 22);
        assert_eq!(run(&mut driver, 200, 0, settings), 16, "half is the least");
        settings.minimum = 1;
        assert_eq!(run(&mut driver, 200, 0, settings), 8, "a quarter is the least");
        // A load of 0.9 reads below 128 at every current: up by two a reading.
        assert_eq!(run(&mut driver, 3, 900, settings), 14);
        assert_eq!(run(&mut driver, 30, 900, settings), 32);
    }
}
