//! The commands of the PMX-2ED-SA (manual, table 9.0 and section 7).

use super::polarity;
use crate::ascii::command::{Form, Value, commands};
use Form::{Axis, AxisNumber, Bare, Index, MaybeAxis, MaybeIndex, MaybeWay, Numbers, Targets, Way};

/// The letters of the axes.
pub const AXES: &str = "XY";

/// How many axes there are.
pub const AXIS_COUNT: usize = AXES.len();

/// The highest speed, in pulses a second (table A.0).
pub const MAX_SPEED_PPS: i32 = 6_000_000;

/// It acts and has no value.
const ACTS: Value = Value::None;

/// Any 32-bit number that the device works out and that can be set.
const COUNTER: Value = Value::Device { read: true, write: Some((i32::MIN, i32::MAX)) };

/// A number that can only be read.
const READS: Value = Value::Device { read: true, write: None };

/// Kept until the power goes.
const fn kept(low: i32, high: i32, default: i32) -> Value {
    Value::Kept { decimals: 0, low, high, default, stored: false }
}

/// Kept, and stored by `STORE` (table 7.15).
const fn stored(low: i32, high: i32, default: i32) -> Value {
    Value::Kept { decimals: 0, low, high, default, stored: true }
}

/// The StepNLoop ratio in thousandths.
const RATIO: Value = Value::Kept { decimals: 3, low: 1, high: 999_999, default: 1000, stored: true };

/// Worked out by the device, and writable.
const fn both(low: i32, high: i32) -> Value {
    Value::Device { read: true, write: Some((low, high)) }
}

/// Only written.
const fn writes(low: i32, high: i32) -> Value {
    Value::Device { read: false, write: Some((low, high)) }
}

commands! {
/// The commands, in the order of their names where one is not the beginning of another.
COMMANDS: Id {
    Abort "ABORT" MaybeAxis, ACTS; "" "7.7" "ABORTX" "Stops all axes or one at once." stopping;
    Absolute "ABS" Bare, ACTS; "" "7.8" "ABS" "Targets of moves are positions." absolute_and_incremental_moves;
    Acceleration "ACC" MaybeAxis, kept(0, i32::MAX, 300); "ms" "7.1" "ACCX=500" "Time from low to high speed; 0 for an axis takes the global one." accelerations_and_decelerations;
    Analog "AI" Index(1, 2), READS; "mV" "7.14" "AI1" "Analog input." analog_inputs;
    Clear "CLR" Axis, ACTS; "" "7.11" "CLRX" "Clears limit and StepNLoop errors of an axis." limits_latch_errors;
    ClearLoop "CLRS" Axis, ACTS; "" "7.17" "CLRSX" "Clears the StepNLoop error of an axis." a_stall_is_an_error_until_it_is_cleared;
    Baud "DB" Bare, stored(1, 5, 1); "" "6.2.2" "DB=5" "Baud rate from the next start: 1 to 5 for 9600, 19200, 38400, 57600, 115200." every_item_of_table_7_15_is_stored;
    Deceleration "DEC" MaybeAxis, kept(0, i32::MAX, 300); "ms" "7.1" "DECX=500" "Time from high to low speed while EDEC is 1; 0 for an axis takes the global one." accelerations_and_decelerations;
    Inputs "DI" MaybeIndex(1, 8), READS; "" "7.13.1" "DI3" "Digital inputs: all as bits, or one." digital_inputs_and_outputs;
    Outputs "DO" Bare, both(0, 255); "" "7.13.2" "DO=5" "Digital outputs as bits." digital_inputs_and_outputs;
    Output "DO" Index(1, 8), both(0, 1); "" "7.13.2" "DO3=1" "One digital output." digital_inputs_and_outputs;
    OutputsBoot "DOBOOT" Bare, stored(0, 255, 0); "" "7.13.2" "DOBOOT=1" "Digital outputs at power-up." boot_values;
    DeviceName "DN" Bare, Value::Text { read: true, write: true }; "" "6.3" "DN=2ED05" "Device name from the next start, 2ED00 to 2ED99; its last two digits are the address." names_and_addresses;
    Delta "D" Axis, READS; "counts" "7.17" "DX" "StepNLoop: target position now minus encoder." closed_loop_moves_in_encoder_counts;
    OwnDeceleration "EDEC" Bare, stored(0, 1, 0); "" "7.1" "EDEC=1" "1: decelerations are those of DEC, 0: those of ACC." accelerations_and_decelerations;
    Enables "EO" Bare, both(0, 3); "" "7.5" "EO=3" "Motor power as bits." motor_power;
    Enable "EO" Index(1, 2), both(0, 1); "" "7.5" "EO1=1" "Motor power of one axis." motor_power;
    EnablesBoot "EOBOOT" Bare, stored(0, 3, 0); "" "7.5" "EOBOOT=3" "Motor power at power-up." boot_values;
    Encoder "E" Axis, COUNTER; "counts" "7.4" "EX=0" "Encoder position." encoder_decoding_and_polarity;
    Subroutine "GS" Index(0, 31), ACTS; "" "7.19.4" "GS5" "Runs a subroutine of the stored program." subroutines_from_the_host;
    HomeCorrection "HCA" MaybeAxis, stored(i32::MIN, i32::MAX, 1000); "pulses" "7.10.5" "HCA=500" "How far HL goes beyond the home switch; 0 for an axis takes the global one." homing_high_and_low_speed;
    HomeLow "HL" Way, ACTS; "" "7.10.5" "HLX+" "Homes by the home switch at high and low speed." homing_high_and_low_speed;
    Home "H" Way, ACTS; "" "7.10.1" "HX-" "Homes by the home switch at high speed." homing_at_high_speed;
    HighSpeed "HSPD" MaybeAxis, kept(0, MAX_SPEED_PPS, 1000); "pps" "7.1" "HSPDX=2000" "High speed; 0 for an axis takes the global one." global_and_individual_speeds;
    Identity "ID" Bare, Value::Text { read: true, write: false }; "" "9.1" "ID" "PERFORMAX-2ED-SA." identity;
    IgnoreErrors "IERR" Bare, stored(0, 1, 0); "" "7.11" "IERR=1" "1: limits stop the axis without latching an error." limits_latch_errors;
    Incremental "INC" Bare, ACTS; "" "7.8" "INC" "Targets of moves count from the position." absolute_and_incremental_moves;
    Interpolate "I" Numbers(2), ACTS; "" "7.8.2" "I1000:-1000" "Moves both axes along a line." interpolated_moves;
    JoystickOff "JF" Bare, ACTS; "" "7.15" "JF" "Joystick control off." joystick_control;
    JoystickLimits "JL" Index(1, 8), stored(i32::MIN, i32::MAX, 0); "pulses" "7.15" "JL4=10000" "Soft limits of the joystick: X negative outer, inner, positive inner, outer, then Y." joystick_control;
    JoystickOn "JO" Bare, ACTS; "" "7.15" "JO" "Joystick control of both axes on." joystick_control;
    JoystickMask "JO" Bare, stored(0, 3, 0); "" "7.15" "JO=1" "Joystick control of the axes with a bit." joystick_control;
    JoystickValues "JV" Index(1, 6), stored(0, MAX_SPEED_PPS, 0); "pps, pps/ms, mV" "7.15" "JV1=5000" "Joystick: highest speeds of X and Y, their greatest changes, their zero tolerances." joystick_control;
    Jog "J" MaybeWay, ACTS; "" "7.6" "JX+" "Moves without end." jogging;
    LimitCorrection "LCA" MaybeAxis, stored(i32::MIN, i32::MAX, 1000); "pulses" "7.10.2" "LCA=500" "How far L moves away from the limit; 0 for an axis takes the global one." homing_by_a_limit;
    LowSpeed "LSPD" MaybeAxis, kept(0, MAX_SPEED_PPS, 100); "pps" "7.1" "LSPDX=100" "Low speed; 0 for an axis takes the global one." global_and_individual_speeds;
    LimitHome "L" Way, ACTS; "" "7.10.2" "LX-" "Homes by a limit switch." homing_by_a_limit;
    MoveMode "MM" Bare, READS; "" "9.1" "MM" "0: absolute, 1: incremental." absolute_and_incremental_moves;
    Status "MST" MaybeAxis, READS; "" "7.12" "MSTX" "Motor status of an axis as bits, or of both with buffer and move mode." the_status_word;
    Polarity "POL" Axis, stored(0, (1 << 14) - 1, polarity::DEFAULT); "" "7.16" "POLX=96" "Polarities as bits." polarities;
    PulseSpeed "PS" MaybeAxis, READS; "pps" "7.2" "PSX" "Speed now, of an axis or of both; encoder counts a second with StepNLoop." speeds_are_read_while_moving;
    Position "P" Axis, COUNTER; "pulses" "7.4" "PX=0" "Pulse position, or the target position now with StepNLoop." positions_are_set_and_read;
    ReturnToZero "RZ" Bare, stored(0, 1, 0); "" "8.1.11" "RZ=1" "1: homing that ends off zero returns to zero." homing_returns_to_zero;
    ReturnRule "SAP" Bare, both(0, 1); "" "7.19.5" "SAP=1" "Where SUB 31 returns to: 0 the line of the error, 1 the program's first line." errors_run_subroutine_31;
    ProgramStatus "SASTAT" MaybeIndex(0, 1), READS; "" "7.19.3" "SASTAT0" "Program: 0 idle, 1 running, 2 paused, 4 error." programs_are_controlled_by_the_host;
    ProgramLine "SA" Index(0, 1274), Value::Text { read: true, write: true }; "" "9.1" "SA5" "A compiled line of the program, readable and writable." programs_go_up_and_down;
    SCurve "SCV" Axis, stored(0, 1, 0); "" "7.1" "SCVX=1" "1: S-curve acceleration." s_curves;
    LoopAttempts "SLA" Axis, stored(0, i32::MAX, 10); "" "7.17" "SLAX=5" "StepNLoop: corrections that are tried." corrections_that_do_not_help;
    LoopRange "SLE" Axis, stored(0, i32::MAX, 1000); "counts" "7.17" "SLEX=500" "StepNLoop: error range." a_stall_is_an_error_until_it_is_cleared;
    LoopRatio "SLR" Axis, RATIO; "pulses a count" "7.17" "SLRX=2.500" "StepNLoop: ratio, 0.001 to 999.999." closed_loop_moves_in_encoder_counts;
    LoopStatus "SLS" Axis, READS; "" "7.17" "SLSX" "StepNLoop: status, 0 to 13." the_status_of_the_closed_loop;
    LoopTolerance "SLT" Axis, stored(0, i32::MAX, 10); "counts" "7.17" "SLTX=5" "StepNLoop: tolerance." a_slip_is_corrected;
    Loop "SL" Axis, stored(0, 1, 0); "" "7.17" "SLX=1" "StepNLoop on or off." closed_loop_moves_in_encoder_counts;
    RunOnBoot "SLOAD" Bare, stored(0, 3, 0); "" "7.19.7" "SLOAD=1" "Programs that start at power-up, as bits." programs_run_on_boot;
    ProgramCounter "SPC" Index(0, 1), READS; "" "7.19.3" "SPC0" "Line at which a program is." programs_are_controlled_by_the_host;
    ProgramControl "SR" Index(0, 1), writes(0, 3); "" "7.19.2" "SR0=1" "Program: 0 stop, 1 start, 2 pause, 3 continue." programs_are_controlled_by_the_host;
    SpeedMode "SSPDM" Axis, kept(0, 9, 0); "" "7.3" "SSPDMX=2" "Speed window of on-the-fly changes, 0 for none." on_the_fly_speed;
    SetSpeed "SSPD" Axis, writes(0, MAX_SPEED_PPS); "pps" "7.3" "SSPDX=5000" "Changes the speed of a motion." on_the_fly_speed;
    Stop "STOP" MaybeAxis, ACTS; "" "7.7" "STOPX" "Stops all axes or one with deceleration." stopping;
    Store "STORE" Bare, ACTS; "" "7.20" "STORE" "Stores the settings." every_item_of_table_7_15_is_stored;
    Target "T" AxisNumber, ACTS; "" "7.9" "TX2000" "Changes the target of a move." on_the_fly_target;
    TimeOut "TOC" Bare, stored(0, i32::MAX, 0); "ms" "7.18" "TOC=5000" "Communication time-out, 0 for none." communication_time_out;
    Variable "V" Index(0, 63), COUNTER; "" "7.19.6" "V5=100" "Variable of programs." variables;
    Version "VER" Bare, Value::Text { read: true, write: false }; "" "9.1" "VER" "V128BL." identity;
    Move "" Targets, ACTS; "" "7.8" "X1000" "Moves an axis to its target, or both along a line." absolute_and_incremental_moves;
    HomeIndex "ZH" Way, ACTS; "" "7.10.3" "ZHX+" "Homes by the home switch and the Z index." homing_by_home_and_index;
    IndexHome "Z" Way, ACTS; "" "7.10.4" "ZX+" "Homes by the Z index at low speed." homing_by_the_index;
}
}
