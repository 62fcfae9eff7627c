//! The axis parameters of the PD42-1140 (manual, chapter 4, table 16).

use crate::parameter::parameters;

const MIN: i32 = i32::MIN;
const MAX: i32 = i32::MAX;

parameters! {
    /// All axis parameters, by number.
    TABLE {
        0 TARGET_POSITION APTargetPosition, "Target position" [MIN, MAX] RW = 0 "µsteps"
            "Where the axis goes in position mode. Writing selects position mode." ap_0_target_position;
        1 ACTUAL_POSITION APActualPosition, "Actual position" [MIN, MAX] RW = 0 "µsteps"
            "Where the axis is. Written at standstill, the target follows and nothing moves." ap_1_actual_position;
        2 TARGET_SPEED APTargetSpeed, "Target speed" [-2047, 2047] RW = 0 "int"
            "Speed wanted in velocity mode. Writing selects velocity mode." ap_2_target_speed;
        3 ACTUAL_SPEED APActualSpeed, "Actual speed" [-2047, 2047] R = 0 "int"
            "Present speed, with its sign." ap_3_actual_speed;
        4 MAX_SPEED APMaxPositioningSpeed, "Maximum positioning speed" [1, 2047] RWE = 1000 "int"
            "Top speed of positioning ramps." ap_4_limits_positioning;
        5 MAX_ACCELERATION APMaxAcceleration, "Maximum acceleration" [1, 2047] RWE = 500 "int"
            "Acceleration and deceleration of all ramps." ap_5_acceleration;
        6 MAX_CURRENT APMaxCurrent, "Maximum current" [0, 255] RWE = 255 "1/255"
            "Current while the motor runs, in 32 steps of 8." ap_6_run_current;
        7 STANDBY_CURRENT APStandbyCurrent, "Standby current" [0, 255] RW = 32 "1/255"
            "Current while the motor rests, after the power down delay." ap_7_standby_current;
        8 POSITION_REACHED APPositionReached, "Position reached flag" [0, 1] R = 1 ""
            "1 while target and actual position are equal." ap_8_position_reached;
        9 HOME_SWITCH APHomeSwitch, "Home switch state" [0, 1] R = 0 ""
            "Logical state of the home switch." ap_9_home_switch;
        10 RIGHT_SWITCH APRightLimitSwitch, "Right limit switch state" [0, 1] R = 0 ""
            "Logical state of the right stop switch." ap_10_and_11_stop_switches;
        11 LEFT_SWITCH APLeftLimitSwitch, "Left limit switch state" [0, 1] R = 0 ""
            "Logical state of the left stop switch." ap_10_and_11_stop_switches;
        12 RIGHT_SWITCH_OFF APRightLimitSwitchDisable, "Right limit switch disable" [0, 1] RWE = 0 ""
            "1: the right stop switch does not stop the motor." ap_12_and_13_disable_switches;
        13 LEFT_SWITCH_OFF APLeftLimitSwitchDisable, "Left limit switch disable" [0, 1] RWE = 0 ""
            "1: the left stop switch does not stop the motor." ap_12_and_13_disable_switches;
        130 MIN_SPEED APMinSpeed, "Minimum speed" [1, 2047] RWE = 1 "int"
            "Speed at which a ramp may end; it starts at 1." ap_130_stop_speed;
        135 ACTUAL_ACCELERATION APActualAcceleration, "Actual acceleration" [-2047, 2047] R = 0 "int"
            "Present acceleration; negative while the motor slows down." ap_135_actual_acceleration;
        138 RAMP_MODE APRampMode, "Ramp mode" [0, 2] RW = 0 ""
            "0 position mode, 1 position mode with soft approach, 2 velocity mode." ap_138_ramp_mode;
        140 MICROSTEPS APMicrostepResolution, "Microstep resolution" [0, 8] RW = 8 ""
            "Microsteps in a full step, as a power of two: 0 full steps to 8 (256)." ap_140_microsteps;
        149 SOFT_STOP APSoftStopFlag, "Soft stop flag" [0, 1] RWE = 0 ""
            "How a stop switch stops: 0 at once, 1 with the deceleration ramp." ap_149_soft_stop;
        150 END_SWITCH_POWER_DOWN APEndSwitchPowerDown, "End switch power down mode" [0, 1] RW = 0 ""
            "After a stop by an end switch: 0 keeps the run current, 1 goes to standby." ap_150_end_switch_power_down;
        153 RAMP_DIVISOR APRampDivisor, "Ramp divisor" [0, 13] RWE = 3 ""
            "Exponent that scales accelerations: lower is faster." ap_153_and_154_divisors;
        154 PULSE_DIVISOR APPulseDivisor, "Pulse divisor" [0, 13] RWE = 2 ""
            "Exponent that scales speeds: lower is faster." ap_153_and_154_divisors;
        160 STEP_INTERPOLATION APStepInterpolation, "Step interpolation enable" [0, 1] RW = 0 ""
            "With 16 microsteps, each one is made as 16 of 1/256." ap_160_and_161_steps;
        161 DOUBLE_STEP APDoubleStep, "Double step enable" [0, 1] RW = 0 ""
            "Each microstep is made twice." ap_160_and_161_steps;
        162 CHOPPER_BLANK_TIME APChopperBlankTime, "Chopper blank time" [0, 3] RW = 2 ""
            "How long the comparator ignores the switching event." chopper_parameters_are_kept;
        163 CONSTANT_TOFF APConstantTOffMode, "Constant TOff mode" [0, 1] RW = 0 ""
            "Chopper: 0 spread cycle, 1 constant off time." chopper_parameters_are_kept;
        164 FAST_DECAY_COMPARATOR_OFF APDisableFastDecayComparator, "Disable fast decay comparator" [0, 1] RW = 0 ""
            "1: constant off time without the comparator in fast decay." chopper_parameters_are_kept;
        165 HYSTERESIS_END APChopperHysteresisEnd, "Chopper hysteresis end / fast decay time" [0, 15] RW = 3 ""
            "Hysteresis after its decrements, or the fast decay time." chopper_parameters_are_kept;
        166 HYSTERESIS_START APChopperHysteresisStart, "Chopper hysteresis start / sine wave offset" [0, 8] RW = 4 ""
            "Hysteresis above its end, or the sine wave offset." chopper_parameters_are_kept;
        167 OFF_TIME APChopperOffTime, "Chopper off time" [0, 15] RW = 5 ""
            "0 switches the driver off and the motor turns freely." ap_167_off_time_zero_frees_the_motor;
        168 COOLSTEP_MINIMUM APSmartEnergyCurrentMinimum, "SmartEnergy current minimum" [0, 1] RW = 0 ""
            "Least current of CoolStep: 0 half of the maximum, 1 a quarter." coolstep_follows_the_load;
        169 COOLSTEP_DOWN APSmartEnergyCurrentDownStep, "SmartEnergy current down step" [0, 3] RW = 0 ""
            "Readings above the upper threshold for each step down: 32, 8, 2, 1." coolstep_follows_the_load;
        170 COOLSTEP_HYSTERESIS APSmartEnergyHysteresis, "SmartEnergy hysteresis" [0, 15] RW = 0 ""
            "Upper threshold is 32 times (this + start + 1)." coolstep_follows_the_load;
        171 COOLSTEP_UP APSmartEnergyCurrentUpStep, "SmartEnergy current up step" [0, 3] RW = 0 ""
            "Steps up for each reading below the lower threshold: 1, 2, 4, 8." coolstep_follows_the_load;
        172 COOLSTEP_START APSmartEnergyHysteresisStart, "SmartEnergy hysteresis start" [0, 15] RW = 0 ""
            "Lower threshold is 32 times this; 0 switches CoolStep off." coolstep_follows_the_load;
        173 STALLGUARD_FILTER APStallGuardFilter, "StallGuard2 filter enable" [0, 1] RW = 0 ""
            "1: a reading is the mean of four full steps." ap_173_filter;
        174 STALLGUARD_THRESHOLD APStallGuardThreshold, "StallGuard2 threshold" [-64, 63] RW = 0 ""
            "Higher values need more load until a stall is seen." ap_174_threshold;
        175 SLOPE_HIGH APSlopeControlHighSide, "Slope control high side" [0, 3] RW = 3 ""
            "Slope of the driver's high side." chopper_parameters_are_kept;
        176 SLOPE_LOW APSlopeControlLowSide, "Slope control low side" [0, 3] RW = 3 ""
            "Slope of the driver's low side." chopper_parameters_are_kept;
        177 SHORT_PROTECTION_OFF APShortProtectionDisable, "Short protection disable" [0, 1] RW = 0 ""
            "1 switches the short to ground protection off." ap_177_short_protection;
        178 SHORT_TIMER APShortDetectionTimer, "Short detection timer" [0, 3] RW = 0 ""
            "How long a short is watched: 3.2, 1.6, 1.2 or 0.8 µs." chopper_parameters_are_kept;
        179 VSENSE APVsense, "Vsense" [0, 1] R = 1 ""
            "Full scale of the sense resistors; fixed." chopper_parameters_are_kept;
        180 ACTUAL_CURRENT APSmartEnergyActualCurrent, "SmartEnergy actual current" [0, 31] R = 31 "1/32"
            "Current in force, one less than its 32nds." ap_6_run_current;
        181 STOP_ON_STALL APStopOnStall, "Stop on stall" [0, 2047] RW = 0 "int"
            "Above this speed a load value of 0 stops the motor; 0 never." ap_181_stop_on_stall;
        182 COOLSTEP_SPEED APSmartEnergyThresholdSpeed, "SmartEnergy threshold speed" [0, 2047] RW = 0 "int"
            "Above this speed CoolStep works." ap_182_and_183_slow_run;
        183 SLOW_RUN_CURRENT APSmartEnergySlowRunCurrent, "SmartEnergy slow run current" [0, 255] RW = 0 "1/255"
            "Current below the threshold speed." ap_182_and_183_slow_run;
        184 RANDOM_TOFF APRandomTOffMode, "Random TOff mode" [0, 1] RW = 0 ""
            "1 varies the chopper's off time." chopper_parameters_are_kept;
        193 SEARCH_MODE APReferenceSearchMode, "Reference search mode" [1, 136] RW = 1 ""
            "1 to 8; +64 takes the other end switch (1 to 4), +128 inverts the home switch (5 to 8)." ap_193_reference_search_modes;
        194 SEARCH_SPEED APReferenceSearchSpeed, "Reference search speed" [0, 2047] RW = 500 "int"
            "Speed for finding the switch." ap_194_and_195_search_speeds;
        195 SWITCH_SPEED APReferenceSwitchSpeed, "Reference switch speed" [0, 2047] RW = 100 "int"
            "Speed for the switching points." ap_194_and_195_search_speeds;
        196 END_SWITCH_DISTANCE APEndSwitchDistance, "End switch distance" [MIN, MAX] R = 0 "µsteps"
            "Distance of the end switches, after search modes 2 and 3." ap_196_end_switch_distance;
        197 LAST_REFERENCE APLastReferencePosition, "Last reference position" [MIN, MAX] R = 0 "µsteps"
            "Position of the zero point before it was set to zero." ap_197_last_reference;
        200 BOOST_CURRENT APBoostCurrent, "Boost current" [0, 255] RW = 0 "1/255"
            "Current while the speed changes; 0 uses the maximum current." ap_200_boost_current;
        201 EXTERNAL_ENCODER_FUNCTIONS APExternalEncoderFunctions, "External encoder special functions" [0, 31] RW = 0 ""
            "Bit 2 clear on null, bit 3 on every one, bit 4 null is active high." ap_201_external_null_channel;
        204 FREEWHEELING APFreewheeling, "Freewheeling" [0, 65535] RWE = 0 "10 ms"
            "After this standstill the motor has no current; 0 never." ap_204_freewheeling;
        206 LOAD_VALUE APActualLoadValue, "Actual load value" [0, 1023] R = 0 ""
            "StallGuard2 reading: falls as the load rises, 0 at a stall." ap_206_load_value;
        207 EXTENDED_ERRORS APExtendedErrorFlags, "Extended error flags" [0, 3] R = 0 ""
            "1 StallGuard error, 2 deviation error; cleared when read and by a motion command." ap_207_extended_errors;
        208 DRIVER_ERRORS APDriverErrorFlags, "TMC262 error flags" [0, 255] R = 0 ""
            "Bits 0 StallGuard, 1 overtemperature, 2 its warning, 3-4 short, 5-6 open load, 7 standstill." ap_208_driver_flags;
        209 ENCODER_POSITION APEncoderPosition, "Encoder position" [MIN, MAX] RW = 0 "µsteps"
            "Counter of the SensOstep encoder." ap_209_and_210_encoder;
        210 ENCODER_PRESCALER APEncoderPrescaler, "Encoder prescaler" [MIN, MAX] RW = 25600 "1/512"
            "Multiplies encoder counts; the low four bits select functions, 4 clears on null." ap_209_and_210_encoder;
        212 MAX_DEVIATION APMaxEncoderDeviation, "Maximum encoder deviation" [0, MAX] RW = 0 "encoder steps"
            "A greater difference of position and encoder stops the motor; 0 never." ap_212_deviation;
        214 POWER_DOWN_DELAY APPowerDownDelay, "Power down delay" [1, 65535] RWE = 200 "10 ms"
            "Standstill before the standby current." ap_7_standby_current;
        215 ABSOLUTE_POSITION APAbsoluteResolverValue, "Absolute resolver value" [0, 1023] R = 0 ""
            "Angle of the shaft within a turn." ap_215_absolute_value;
        216 EXTERNAL_ENCODER APExternalEncoderPosition, "External encoder position" [MIN, MAX] RW = 0 "µsteps"
            "Counter of the external encoder." ap_216_and_217_external_encoder;
        217 EXTERNAL_PRESCALER APExternalEncoderPrescaler, "External encoder prescaler" [MIN, MAX] RW = 256 "1/256"
            "Multiplies external encoder counts." ap_216_and_217_external_encoder;
        218 MAX_EXTERNAL_DEVIATION APMaxExternalDeviation, "Maximum external encoder deviation" [0, MAX] RW = 0 "encoder steps"
            "A greater difference of position and external encoder stops the motor; 0 never." ap_218_external_deviation;
    }
}
