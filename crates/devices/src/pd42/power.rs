//! The motor's current, its load, the supply and the temperature
//! (axis parameters 6, 7, 150, 167 to 183, 200, 204, 208, 214; manual, section 12.1, V1.35).

use super::driver::{self, CoolStep, Driver, FULL_CURRENT, current_of};
use super::{Pd42, TEN_MILLISECONDS, ap, gp, pin};
use crate::board::{Board, Drive};
use crate::flash::Flash;
use ::motion::{Ticks, tmc429};
use tmcl::isa::Condition;

/// Below this the motor and the program stop, in mV.
const SUPPLY_LOW: i32 = 8_500;

/// Above this they go on.
const SUPPLY_GOOD: i32 = 9_500;

/// Clocks without a step after which the driver says standstill.
const STANDSTILL_CLOCKS: Ticks = 1 << 20;

/// What the driver stage is up to.
pub struct Power {
    pub driver: Driver,
    undervoltage: bool,
    overheated: bool,
    warm: bool,
    /// Faults of the coils, as the pins from `SHORT_A` on.
    coils: [bool; 4],
    /// The driver has shut down because of a short.
    shorted: bool,
    /// When the motor came to rest; `None` while it moves.
    rest_since: Option<Ticks>,
    /// The next change of current at rest.
    change_at: Option<Ticks>,
    pub drive: Option<Drive>,
}

impl Power {
    pub const fn new() -> Self {
        Self {
            driver: Driver::new(),
            undervoltage: false,
            overheated: false,
            warm: false,
            coils: [false; 4],
            shorted: false,
            rest_since: Some(0),
            change_at: None,
            drive: None,
        }
    }

    /// As after power-up; the outside stays as it is.
    pub fn restart(&mut self, now: Ticks) {
        let Self { undervoltage, overheated, warm, coils, .. } = *self;
        *self = Self { undervoltage, overheated, warm, coils, rest_since: Some(now), ..Self::new() };
    }

    /// Whether supply and driver let the motor move.
    pub const fn allows_motion(&self) -> bool {
        !self.undervoltage && !self.overheated && !self.shorted
    }

    pub const fn motor_started(&mut self) {
        self.rest_since = None;
    }

    pub const fn motor_stopped(&mut self, now: Ticks) {
        self.rest_since = Some(now);
    }

    /// When the current changes by itself.
    pub const fn due(&self) -> Option<Ticks> {
        self.change_at
    }

    /// The current in force, in 32nds; 0 while the motor is free.
    pub fn current(&self) -> u8 {
        self.drive.map_or(FULL_CURRENT, |drive| drive.current)
    }
}

impl<F: Flash> Pd42<F> {
    /// Finds the present current and tells the board if the driver stage changes.
    pub fn apply_power(&mut self, board: &mut dyn Board) {
        let current = self.wanted_current();
        let get = |number| self.memory.axis.get(number);
        let resolution = get(ap::MICROSTEPS);
        let mut step = 256 >> resolution;
        let interpolated = get(ap::STEP_INTERPOLATION) != 0 && resolution == 4;
        if get(ap::DOUBLE_STEP) != 0 {
            step *= 2;
        }
        if self.memory.module.get(gp::REVERSE_SHAFT) != 0 {
            step = -step;
        }
        let drive = Drive { step, parts: if interpolated { 16 } else { 1 }, current };
        if self.power.drive != Some(drive) {
            self.power.drive = Some(drive);
            board.drive(0, drive);
        }
    }

    fn wanted_current(&mut self) -> u8 {
        let get = |number| self.memory.axis.get(number);
        let run = current_of(get(ap::MAX_CURRENT));
        self.power.change_at = None;
        if get(ap::OFF_TIME) == 0 || !self.power.allows_motion() {
            return 0;
        }
        if let Some(since) = self.power.rest_since {
            let holds = self.motion.stopped_by_switch && get(ap::END_SWITCH_POWER_DOWN) == 0;
            let delay = |number| get(number) as Ticks * TEN_MILLISECONDS;
            let standby = since.saturating_add(delay(ap::POWER_DOWN_DELAY));
            let free = (get(ap::FREEWHEELING) != 0).then(|| since.saturating_add(delay(ap::FREEWHEELING)));
            let now = self.now;
            let next = [(!holds).then_some(standby), free].into_iter().flatten();
            self.power.change_at = next.filter(|&clock| clock > now).min();
            if free.is_some_and(|clock| clock <= now) {
                return 0;
            }
            return if standby <= now && !holds { current_of(get(ap::STANDBY_CURRENT)) } else { run };
        }
        if self.axis.acceleration() != 0 && get(ap::BOOST_CURRENT) != 0 {
            return current_of(get(ap::BOOST_CURRENT));
        }
        if tmc429::internal(self.axis.speed()) < get(ap::COOLSTEP_SPEED) {
            return current_of(get(ap::SLOW_RUN_CURRENT));
        }
        if get(ap::COOLSTEP_START) != 0 {
            return self.power.driver.regulated().min(run);
        }
        run
    }

    /// Whether anything follows from how fast the motor goes.
    pub fn speed_matters(&self) -> bool {
        let get = |number| self.memory.axis.get(number);
        get(ap::BOOST_CURRENT) != 0 || get(ap::COOLSTEP_SPEED) != 0 || self.motion.search.is_some()
    }

    /// Whether anything acts on the load while the motor moves.
    pub fn load_matters(&self) -> bool {
        self.memory.axis.get(ap::STOP_ON_STALL) != 0 || self.memory.axis.get(ap::COOLSTEP_START) != 0
    }

    /// Measures the load and lets stall stop and CoolStep act on it.
    pub fn measure_load(&mut self, board: &mut dyn Board) {
        if !self.axis.is_moving() || self.power.current() == 0 {
            return;
        }
        let get = |number| self.memory.axis.get(number);
        let full_step = self.axis.odometer() >> get(ap::MICROSTEPS);
        let filtered = get(ap::STALLGUARD_FILTER) != 0;
        let current = self.power.current();
        let load = board.load(0);
        self.power.driver.measure(full_step, load, current, get(ap::STALLGUARD_THRESHOLD), filtered);
        let run = current_of(get(ap::MAX_CURRENT));
        if get(ap::COOLSTEP_START) != 0 && tmc429::internal(self.axis.speed()) >= get(ap::COOLSTEP_SPEED) {
            let settings = CoolStep {
                minimum: get(ap::COOLSTEP_MINIMUM),
                down: get(ap::COOLSTEP_DOWN),
                hysteresis: get(ap::COOLSTEP_HYSTERESIS),
                up: get(ap::COOLSTEP_UP),
                start: get(ap::COOLSTEP_START),
                maximum: run,
            };
            self.power.driver.regulate(settings);
        } else {
            self.power.driver.release(run);
        }
        self.watch_stall();
    }

    /// The supply has another voltage, in mV.
    pub fn supply_changed(&mut self, millivolts: i32) {
        if millivolts < SUPPLY_LOW && !self.power.undervoltage {
            self.power.undervoltage = true;
            self.stop_hard();
            self.vm.stop();
        } else if millivolts > SUPPLY_GOOD && self.power.undervoltage {
            self.power.undervoltage = false;
            if self.memory.module.get(gp::AUTO_START) != 0 {
                self.vm.reset();
                self.start_program(Some(0));
            }
        }
    }

    /// The driver has another temperature, in 0.1 °C.
    pub fn temperature_changed(&mut self, decidegrees: i32) {
        self.power.warm = decidegrees >= driver::WARNING_CELSIUS * 10;
        let hot = decidegrees >= driver::SHUTDOWN_CELSIUS * 10;
        if hot && !self.power.overheated {
            self.power.overheated = true;
            self.stop_hard();
            self.vm.set_error(Condition::Shutdown);
        } else if !self.power.warm {
            // The driver comes back when it has cooled below its warning.
            self.power.overheated = false;
        }
    }

    /// The driver finds a fault of a coil, or that it is gone.
    pub fn coil_changed(&mut self, number: usize, on: bool) {
        self.power.coils[number - pin::SHORT_A] = on;
        self.watch_shorts();
    }

    /// A short shuts the driver down while it lasts, unless axis parameter 177 forbids it.
    pub fn watch_shorts(&mut self) {
        let [short_a, short_b, ..] = self.power.coils;
        let shut = (short_a || short_b) && self.memory.axis.get(ap::SHORT_PROTECTION_OFF) == 0;
        if shut && !self.power.shorted {
            self.power.shorted = true;
            self.stop_hard();
            self.vm.set_error(Condition::Shutdown);
        }
        self.power.shorted = shut;
    }

    /// Axis parameter 208.
    pub fn driver_flags(&self) -> i32 {
        let moving = self.axis.is_moving();
        let still = self.power.rest_since.is_some_and(|since| self.now - since >= STANDSTILL_CLOCKS);
        let [short_a, short_b, open_a, open_b] = self.power.coils;
        let protected = self.memory.axis.get(ap::SHORT_PROTECTION_OFF) == 0;
        let idle = moving && self.power.current() == 0;
        let bits = [
            moving && self.power.driver.reading() == 0,
            self.power.overheated,
            self.power.warm,
            short_a && protected,
            short_b && protected,
            moving && (idle || open_a),
            moving && (idle || open_b),
            still,
        ];
        bits.iter().rev().fold(0, |flags, &bit| flags << 1 | i32::from(bit))
    }
}
