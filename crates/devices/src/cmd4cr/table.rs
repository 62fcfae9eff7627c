//! The commands of the CMD-4CR (manual, table 4-40 and chapter 2).

use super::polarity;
use crate::ascii::command::{Form, Value, commands};
use Form::{
    Axis, AxisNumber, AxisOf, AxisOrEach, AxisOrFirst, Bare, Helix, Index, MaybeAxis, Numbers, Plane,
    Targets, Way, WayMode,
};

/// The letters of the axes.
pub const AXES: &str = "XYZU";

/// How many axes there are.
pub const AXIS_COUNT: usize = AXES.len();

/// How many of them have a joystick input.
pub const JOYSTICK_AXES: usize = 2;

/// The highest speed, in pulses a second: 16 bits of the speed register times a magnification of 100.
pub const MAX_SPEED_PPS: i32 = 6_553_500;

/// It acts and has no value.
const ACTS: Value = Value::None;

/// Any 32-bit number that the device works out and that can be set.
const COUNTER: Value = Value::Device { read: true, write: Some((i32::MIN, i32::MAX)) };

/// Where axes can be sent, and what their counters can be set to: 28 bits (manual, 1.2).
pub const POSITIONS: core::ops::RangeInclusive<i32> = -134_217_728..=134_217_727;

/// A position that the device counts and that can be set.
const PLACE: Value = Value::Device { read: true, write: Some((*POSITIONS.start(), *POSITIONS.end())) };

/// A number that can only be read.
const READS: Value = Value::Device { read: true, write: None };

/// Text that can only be read.
const TEXT: Value = Value::Text { read: true, write: false };

/// Kept until the power goes.
const fn kept(low: i32, high: i32, default: i32) -> Value {
    Value::Kept { decimals: 0, low, high, default, stored: false }
}

/// Kept, and stored by `STORE` (table 2-19).
const fn stored(low: i32, high: i32, default: i32) -> Value {
    Value::Kept { decimals: 0, low, high, default, stored: true }
}

/// All 32 bits, stored.
const BITS: Value = stored(i32::MIN, i32::MAX, 0);

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
/// The commands. Their order is their number in flash.
COMMANDS: Id {
    Abort "ABORT" MaybeAxis, ACTS; "" "2.2.3" "ABORTX" "Stops all axes or one at once." stopping;
    Absolute "ABS" Bare, ACTS; "" "2.2.4.1" "ABS" "Targets of moves are positions." absolute_and_incremental_moves;
    Acceleration "ACC" MaybeAxis, kept(0, i32::MAX, 300); "ms" "2.1.4" "ACCX=500" "Time from low to high speed; 0 for an axis takes the global one." accelerations_and_decelerations;
    Analog "AI" Index(1, 2), READS; "mV" "2.1.3.3.2" "AI1" "Analog input." analog_inputs;
    Arc "ARC" Plane(3), ACTS; "" "2.3.2.1" "ARCXYN0:0:90000" "Moves two axes along an arc: centre and angle in 1/1000 degree, P clockwise, N counter-clockwise." arcs;
    ArcHelix "ARCT" Helix(4), ACTS; "" "2.3.3" "ARCTP0:0:45000:500" "Moves X and Y along an arc and Z to its target." helices;
    BufferOff "BF" Bare, ACTS; "" "2.3.4" "BF" "Buffered moves off." buffered_moves;
    BufferOn "BO" Bare, ACTS; "" "2.3.4" "BO" "Buffered moves on." buffered_moves;
    BufferStart "BSTART" Bare, ACTS; "" "2.3.4" "BSTART" "Starts the buffered moves." buffered_moves;
    BufferStatus "BSTAT" Bare, TEXT; "" "2.3.4" "BSTAT" "Buffer: on, start, end, free registers." buffered_moves;
    Circle "CIR" Plane(2), ACTS; "" "2.3.2" "CIRXYP1000:0" "Moves two axes along a circle around its centre, P clockwise, N counter-clockwise." circles;
    CircleHelix "CIRT" Helix(3), ACTS; "" "2.3.3" "CIRTN1000:0:500" "Moves X and Y along a circle and Z to its target." helices;
    Clear "CLR" Axis, ACTS; "" "2.6.2.3" "CLRX" "Clears the errors of an axis." errors_are_cleared_axis_by_axis;
    Delta "D" Axis, READS; "counts" "2.6.1.3" "DX" "StepNLoop: target position now minus encoder." closed_loop_moves_in_encoder_counts;
    Baud "DB" Bare, stored(1, 5, 1); "" "3.2.1" "DB=5" "Baud rate from the next start: 1 to 5 for 9600, 19200, 38400, 57600, 115200." every_item_of_table_2_19_is_stored;
    Deceleration "DEC" MaybeAxis, kept(0, i32::MAX, 300); "ms" "2.1.4" "DECX=500" "Time from high to low speed; 0 for an axis takes the global one." accelerations_and_decelerations;
    Inputs "DI" Bare, READS; "" "2.1.3.2.1" "DI" "High-speed inputs as bits." digital_inputs;
    Input "DI" Index(1, 4), READS; "" "2.1.3.2.1" "DI3" "One high-speed input." digital_inputs;
    InputsPolarity "DIP" Bare, stored(0, 1, 0); "" "2.1.6.3" "DIP=1" "1 inverts the high-speed inputs." digital_inputs;
    Outputs "DO" Bare, both(0, 15); "" "2.1.3.2.2" "DO=5" "High-speed outputs as bits." digital_outputs;
    Output "DO" Index(1, 4), both(0, 1); "" "2.1.3.2.2" "DO3=1" "One high-speed output." digital_outputs;
    OutputsBoot "DOBOOT" Bare, stored(0, 15, 0); "" "2.1.5" "DOBOOT=1" "High-speed outputs at power-up." boot_values;
    OutputsPolarity "DOP" Bare, stored(0, 1, 0); "" "2.1.6.3" "DOP=1" "1 inverts the high-speed outputs." digital_outputs;
    Encoder "E" Axis, PLACE; "counts" "2.6.1.2" "EX=0" "Encoder position." encoder_inputs;
    Interpolation "EINT" Bare, stored(0, 1, 1); "" "2.3.1" "EINT=0" "1: moves of several axes are lines, 0: each axis goes by itself." lines_need_interpolation;
    Enables "EO" Bare, both(0, 15); "" "2.2.1" "EO=3" "Motor power as bits." motor_power;
    Enable "EO" Index(1, 4), both(0, 1); "" "2.2.1" "EO1=1" "Motor power of one axis." motor_power;
    EnablesBoot "EOBOOT" Bare, stored(0, 15, 0); "" "2.1.5" "EOBOOT=3" "Motor power at power-up." boot_values;
    Encoders "EP" Bare, TEXT; "counts" "2.6.1.2" "EP" "Encoder positions of all axes." positions_are_set_and_read;
    ErrorClear "ERC" Axis, stored(0, 3, 0); "" "2.1.6.1" "ERCX=3" "When the error clear output is given: bit 0 at an error stop, bit 1 at the end of homing." error_clear_outputs;
    ErrorClearDelay "ERCD" AxisOrEach, stored(0, 3, 0); "" "2.1.6.1" "ERCDX=1" "Delay of the error clear output: 0, 12 us, 1.6 ms, 104 ms; of all axes if none is named." error_clear_outputs;
    ErrorClearWidth "ERCP" AxisOrEach, stored(0, 6, 0); "" "2.1.6.1" "ERCPX=3" "Width of the error clear output: 12 us, 102 us, 409 us, 1.6 ms, 13 ms, 52 ms, 104 ms; of all axes if none is named." error_clear_outputs;
    EmergencyStop "ESTOP" Bare, ACTS; "" "2.1.3.1.2" "ESTOP" "Stops all axes as the emergency stop input does." emergency_stop;
    ExternalStart "EXST" Bare, stored(0, 1, 0); "" "2.1.3.1.3" "EXST=1" "1: motions wait for the external start input." external_start;
    Subroutine "GS" Index(0, 31), ACTS; "" "2.7.4" "GS5" "Runs a subroutine of the stored program." subroutines_from_the_host;
    Home "H" WayMode(0, 12), ACTS; "" "2.2.5" "HX-12" "Homes in a direction by one of the modes 0 to 12." homing_modes;
    HighSpeed "HSPD" MaybeAxis, kept(0, MAX_SPEED_PPS, 1000); "pps" "2.1.4" "HSPDX=2000" "High speed; 0 for an axis takes the global one." global_and_individual_speeds;
    BufferMove "I" Numbers(4), ACTS; "" "2.3.4" "I1000:2000:3000:5000" "Puts a line to X, Y and Z with a speed into the buffer." buffered_moves;
    Identity "ID" Bare, both(0, 99); "" "3.3" "ID=02" "Identification number from the next start, two digits." identification_numbers;
    IgnoreErrors "IERR" Bare, stored(0, 1, 0); "" "2.1.3.1.1.1" "IERR=1" "1: limits, alarms and emergency stops stop axes without latching an error." errors_can_be_ignored;
    Incremental "INC" Bare, ACTS; "" "2.2.4.1" "INC" "Targets of moves count from the position." absolute_and_incremental_moves;
    InPosition "INP" Axis, stored(0, 1, 0); "" "2.1.6.2" "INPX=1" "1: a motion ends when the driver says that it is in position." in_position_inputs;
    Ports "IO" Bare, both(i32::MIN, i32::MAX); "" "2.1.3.3.1" "IO=64" "Configurable inputs and outputs as 32 bits." configurable_io;
    Port "IO" Index(1, 32), both(0, 1); "" "2.1.3.3.1" "IO19=1" "One configurable input or output." configurable_io;
    PortsBoot "IOBOOT" Bare, BITS; "" "2.1.5" "IOBOOT=255" "Configurable outputs at power-up." boot_values;
    PortsOut "IOCFG" Bare, BITS; "" "2.1.3.3.1" "IOCFG=255" "Configurable inputs and outputs: bits that are 1 are outputs." configurable_io;
    PortsPolarity "IOP" Bare, stored(0, 3, 0); "" "2.1.6.3" "IOP=3" "Bit 0 inverts configurable inputs, bit 1 outputs." configurable_io;
    Jog "J" Way, ACTS; "" "2.2.2" "JX+" "Moves without end." jogging;
    JoystickChange "JDEL" AxisOf(JOYSTICK_AXES as u8), stored(0, MAX_SPEED_PPS, 0); "pps/ms" "2.5.1.2" "JDELX=100" "Joystick: greatest change of the speed." joystick_control;
    JoystickMask "JENA" Bare, stored(0, 3, 0); "" "2.5.1" "JENA=1" "Joystick control of X and Y, as bits." joystick_control;
    JoystickLimits "JLIM" Index(1, 8), stored(i32::MIN, i32::MAX, 0); "pulses" "2.5.1.3" "JLIM4=10000" "Soft limits of the joystick: X negative outer, inner, positive inner, outer, then Y." the_joysticks_soft_limits;
    JoystickMax "JMAX" AxisOf(JOYSTICK_AXES as u8), stored(0, 3300, 3300); "mV" "2.5.1.1" "JMAXX=3250" "Joystick: voltage of the highest positive speed." joystick_control;
    JoystickMin "JMIN" AxisOf(JOYSTICK_AXES as u8), stored(0, 3300, 0); "mV" "2.5.1.1" "JMINX=10" "Joystick: voltage of the highest negative speed." joystick_control;
    JoystickSpeed "JSPD" AxisOf(JOYSTICK_AXES as u8), stored(0, MAX_SPEED_PPS, 0); "pps" "2.5.1.2" "JSPDX=5000" "Joystick: highest speed." joystick_control;
    JoystickTolerance "JTOL" AxisOf(JOYSTICK_AXES as u8), stored(0, 3300, 0); "mV" "2.5.1.1" "JTOLX=50" "Joystick: zero tolerance around the middle." joystick_control;
    LowSpeed "LSPD" MaybeAxis, kept(0, MAX_SPEED_PPS, 100); "pps" "2.1.4" "LSPDX=100" "Low speed; 0 for an axis takes the global one." global_and_individual_speeds;
    Latch "LT" Axis, writes(0, 1); "" "2.1.3.2.1" "LTX=1" "Position latch on or off." latches;
    LatchedEncoder "LTE" Axis, READS; "counts" "2.1.3.2.1" "LTEX" "Latched encoder position." latches;
    LatchedPosition "LTP" Axis, READS; "pulses" "2.1.3.2.1" "LTPX" "Latched pulse position." latches;
    LatchStatus "LTS" Axis, READS; "" "2.1.3.2.1" "LTSX" "Latch: 0 off, 1 waiting, 2 triggered." latches;
    MoveMode "MM" Bare, READS; "" "2.2.4.1" "MM" "0: absolute, 1: incremental." absolute_and_incremental_moves;
    Pulser "MP" Axis, COUNTER; "pulses" "2.5.2.2" "MPX=0" "Manual pulse generator: position behind the gear." the_manual_pulse_generator;
    PulserDivider "MPD" Axis, stored(1, 2048, 2048); "" "2.5.2.2" "MPDX=512" "Manual pulse generator: numerator of the divider by 2048." the_manual_pulse_generator;
    PulserEnable "MPE" Axis, stored(0, 1, 0); "" "2.5.2" "MPEX=1" "Manual pulse generator on or off." the_manual_pulse_generator;
    PulserMultiplier "MPM" Axis, stored(1, 32, 1); "" "2.5.2.2" "MPMX=5" "Manual pulse generator: multiplier." the_manual_pulse_generator;
    Status "MST" Axis, READS; "" "2.6.2.1" "MSTX" "Status of an axis as bits." the_status_word;
    Position "P" Axis, PLACE; "pulses" "2.6.1.1" "PX=0" "Pulse position, or the target position now with StepNLoop." positions_are_set_and_read;
    Polarity "POL" Axis, stored(0, polarity::ALL, polarity::DEFAULT); "" "2.1.6.3" "POLX=69632" "Input modes and polarities as bits." polarities;
    Positions "PP" Bare, TEXT; "pulses" "2.6.1.1" "PP" "Pulse positions of all axes." positions_are_set_and_read;
    PulseSpeed "PS" Axis, READS; "pps" "2.6.2.2" "PSX" "Speed now; encoder counts a second with StepNLoop." speeds_are_read_while_moving;
    Duty "PWM" Index(1, 2), kept(1, 99, 50); "%" "2.1.3.3.3" "PWM1=25" "How long a PWM output is low (PWM1) or high (PWM2)." pwm_outputs;
    ProgramControl "SACTRL" Index(0, 3), writes(0, 3); "" "2.7.8" "SACTRL0=1" "Program: 0 stop, 1 start, 2 pause, 3 continue." programs_are_controlled_by_the_host;
    ReturnRule "SAP" Bare, stored(0, 1, 0); "" "2.7.5" "SAP=1" "Where SUB 31 returns to: 0 the line of the error, 1 the program's first line." errors_run_subroutine_31;
    ProgramStatus "SASTAT" Index(0, 3), READS; "" "2.7.9" "SASTAT0" "Program: 0 idle, 1 running, 2 paused, 4 error." programs_are_controlled_by_the_host;
    ProgramLine "SA" Index(0, 1799), Value::Text { read: true, write: true }; "" "2.7.7" "SA5" "A compiled line of the program, readable and writable." programs_go_up_and_down;
    SCurve "SCV" Axis, kept(0, 1, 0); "" "2.1.4" "SCVX=1" "1: S-curve acceleration." s_curves;
    SlowdownStops "SDC" Axis, stored(0, 1, 0); "" "2.1.3.1.1.2" "SDCX=1" "What the slowdown input does: 0 low speed, 1 decelerate and stop." slowdown_inputs;
    Slowdown "SDE" Axis, stored(0, 3, 0); "" "2.1.3.1.1.2" "SDEX=3" "Slowdown input: bit 0 on, bit 1 latched." slowdown_inputs;
    Loop "SL" Axis, stored(0, 1, 0); "" "2.5.3" "SLX=1" "StepNLoop on or off." closed_loop_moves_in_encoder_counts;
    LoopAttempts "SLA" Axis, stored(0, i32::MAX, 10); "" "2.5.3" "SLAX=5" "StepNLoop: corrections that are tried." corrections_that_do_not_help;
    LoopRange "SLE" Axis, stored(0, i32::MAX, 1000); "counts" "2.5.3" "SLEX=500" "StepNLoop: error range." a_stall_is_an_error_until_it_is_cleared;
    RunOnBoot "SLOAD" Bare, stored(0, 15, 0); "" "2.7.10" "SLOAD=1" "Programs that start at power-up, as bits." programs_run_on_boot;
    RunsOnBoot "SLOAD" Index(0, 3), both(0, 1); "" "2.7.10" "SLOAD2=1" "Whether a program starts at power-up." programs_run_on_boot;
    LoopRatio "SLR" Axis, RATIO; "pulses a count" "2.5.3" "SLRX=2.500" "StepNLoop: ratio, 0.001 to 999.999." closed_loop_moves_in_encoder_counts;
    LoopStatus "SLS" Axis, READS; "" "2.5.3" "SLSX" "StepNLoop: status, 0 to 13." the_status_of_the_closed_loop;
    LoopTolerance "SLT" Axis, stored(0, i32::MAX, 10); "counts" "2.5.3" "SLTX=5" "StepNLoop: tolerance." a_slip_is_corrected;
    ProgramCounter "SPC" Index(0, 3), READS; "" "2.7.9" "SPC0" "Line at which a program is." programs_are_controlled_by_the_host;
    SetSpeed "SSPD" AxisOrFirst, writes(0, MAX_SPEED_PPS); "pps" "2.4.1" "SSPDX=5000" "Changes the speed of a motion." on_the_fly_speed;
    SpeedMode "SSPDM" AxisOrFirst, kept(0, 7, 0); "" "2.4.1" "SSPDMX=2" "Speed window of on-the-fly changes, 0 for none." on_the_fly_speed;
    Stop "STOP" MaybeAxis, ACTS; "" "2.2.3" "STOPX" "Stops all axes or one with deceleration." stopping;
    Store "STORE" Bare, ACTS; "" "2.1.7" "STORE" "Stores the settings." every_item_of_table_2_19_is_stored;
    Sync "SYNC" Axis, kept(0, 12, 0); "" "2.1.3.2.2" "SYNCX=1" "Condition of the synchronisation output: 0 none, 1 equal, 2 below, 3 above, 4 continuous; 8 more for the encoder." synchronisation_outputs;
    SyncOff "SYNF" Axis, ACTS; "" "2.1.3.2.2" "SYNFX" "Synchronisation output and window off." synchronisation_outputs;
    SyncMax "SYNMAX" Axis, kept(i32::MIN, i32::MAX, 0); "" "2.1.3.2.2" "SYNMAXX=9000" "Upper end of the synchronisation window." the_synchronisation_window;
    SyncMin "SYNMIN" Axis, kept(i32::MIN, i32::MAX, 0); "" "2.1.3.2.2" "SYNMINX=1000" "Lower end of the synchronisation window." the_synchronisation_window;
    SyncOn "SYNO" AxisOrFirst, ACTS; "" "2.1.3.2.2" "SYNOX" "Synchronisation output on." synchronisation_outputs;
    SyncPosition "SYNP" Axis, kept(i32::MIN, i32::MAX, 0); "" "2.1.3.2.2" "SYNPX=5000" "Comparator of the synchronisation output, or the distance of its pulses." synchronisation_outputs;
    SyncStatus "SYNS" Axis, READS; "" "2.1.3.2.2" "SYNSX" "Synchronisation output: 0 off, 1 waiting, 2 condition established." synchronisation_outputs;
    SyncWindowOff "SYNWF" Axis, ACTS; "" "2.1.3.2.2" "SYNWFX" "Synchronisation window off." the_synchronisation_window;
    SyncWindowOn "SYNWO" Axis, ACTS; "" "2.1.3.2.2" "SYNWOX" "Synchronisation output on, with its window." the_synchronisation_window;
    Target "T" AxisNumber, ACTS; "" "2.4.2" "TX2000" "Changes the target of a move." on_the_fly_target;
    Variable "V" Index(0, 99), COUNTER; "" "2.7.6" "V5=100" "Variable of programs." variables;
    Version "VER" Bare, TEXT; "" "2.1.1.1" "VER" "V126BL." identity;
    Move "" Targets, ACTS; "" "2.2.4.2" "X1000Y-200" "Moves axes to their targets, several of them along a line." absolute_and_incremental_moves;
    IndexCount "ZCNT" Axis, stored(0, 15, 0); "" "2.2.5.1" "ZCNTX=1" "Index marks that are counted before the one that counts." index_moves;
    IndexMove "ZMOVE" Way, ACTS; "" "2.2.5.1" "ZMOVEX+" "Moves until the index has come often enough." index_moves;
}
}
