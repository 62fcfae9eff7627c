//! The page of the PMX-2ED-SA.

use crate::ascii::{self, LOOP_STATUS, Rows, UNITS_OF_SPEED};
use ascript::dialect::PERFORMAX_2;
use devices::guide::{self, ascii::form};
use devices::pmx2ed::guide::{HOMING, STATUS_BITS};
use devices::pmx2ed::table::{AXES, COMMANDS, Id};
use motion::pps::PERFORMAX;

const HEAD: &str = "\
# PMX-2ED-SA: conformance

Made from the controller's tables by `cargo xtask docs`; do not edit. Sections and tables are those of the
PMX-2ED-SA manual, revision 1.18 (firmware V128BL). What the manual leaves open is settled in
[decisions](pmx-2ed-decisions.md).
";

/// The replies of table 9.1 and the one that its section 7.11 needs: when each is sent, and its test.
const ERRORS: Rows = &[
    ("?*command*", "the command is not known", "unknown_commands_are_repeated"),
    (
        "?ABS/INC is not in operation",
        "T without a move to a target",
        "a_target_is_changed_only_during_a_move",
    ),
    ("?Clear SNL Error", "a motion command in a StepNLoop error", "a_loop_in_error_does_not_move"),
    ("?ICommandOn", "SSPD during an interpolated move", "on_the_fly_speed"),
    ("?Index out of Range", "the number after the name is out of range", "indices_out_of_range"),
    ("?Invalid Answer", "the value is out of range", "values_out_of_range"),
    ("?Low speed out of range", "LSPD above the high speed in force, or 0", "global_and_individual_speeds"),
    ("?Moving", "a motion or position command while pulses are put out", "moves_are_refused_while_moving"),
    ("?S-curve on", "SSPD with S-curves", "on_the_fly_speed"),
    ("?Speed out of range", "SSPD outside the window of SSPDM", "on_the_fly_speed"),
    ("?SSPD Mode not Initialized", "SSPD without SSPDM", "on_the_fly_speed"),
    ("?Sub not Initialized", "GS of a subroutine that is not there", "subroutines_that_are_not_there"),
    (
        "?State Error",
        "a limit error, the joystick or a state of a program is in the way",
        "limits_latch_errors",
    ),
];

/// The bits of the status word.
const STATUS: [(&str, &str, &str); STATUS_BITS.len()] = guide::rows(&STATUS_BITS);

/// The routines by their sections.
const HOMING_MODES: [(&str, &str, &str); HOMING.len()] = {
    let mut rows = [("", "", ""); HOMING.len()];
    let mut at = 0;
    while at < rows.len() {
        rows[at] = (HOMING[at].section, HOMING[at].name, HOMING[at].test);
        at += 1;
    }
    rows
};

const TABLES: &[(&str, Rows)] = &[
    ("Units of speed (table 7.0)", UNITS_OF_SPEED),
    ("Enable outputs (table 7.1)", &[("0", "EO1, X", "motor_power"), ("1", "EO2, Y", "motor_power")]),
    ("Motor status (table 7.2)", &STATUS),
    (
        "Digital inputs and outputs (tables 7.3 and 7.4)",
        &[
            ("0 to 7", "DI1 to DI8", "digital_inputs_and_outputs"),
            ("0 to 7", "DO1 to DO8", "digital_inputs_and_outputs"),
        ],
    ),
    (
        "Joystick (tables 7.5 and 7.6)",
        &[
            ("AI1, AI2", "X, Y", "joystick_control"),
            ("JV1, JV2", "highest speed of X, Y", "joystick_control"),
            ("JV3, JV4", "greatest change of X, Y", "joystick_control"),
            ("JV5, JV6", "zero tolerance of X, Y", "joystick_control"),
            ("JL1 to JL4", "soft limits of X", "the_joysticks_soft_limits"),
            ("JL5 to JL8", "soft limits of Y", "registers"),
        ],
    ),
    (
        "Polarity (table 7.7)",
        &[
            ("0", "pulse: kept, the driver is built in", "polarities"),
            ("1", "direction", "polarities"),
            ("2 to 4", "not used", "polarities"),
            ("5", "home", "polarities"),
            ("6", "limits", "polarities"),
            ("7", "Z index", "polarities"),
            ("8, 9", "encoder decoding 1X, 2X, 4X", "encoder_decoding_and_polarity"),
            ("10", "digital inputs", "polarities"),
            ("11", "digital outputs", "polarities"),
            ("12", "enable output", "polarities"),
            ("13", "SUB 31 returns to the first line", "polarities"),
        ],
    ),
    (
        "StepNLoop parameters and behaviour (tables 7.8 and 7.10)",
        &[
            ("SLR", "ratio", "closed_loop_moves_in_encoder_counts"),
            ("SLT", "tolerance: no correction within it", "a_slip_is_corrected"),
            ("SLE", "range: stall error on the way", "a_stall_is_an_error_until_it_is_cleared"),
            ("SLE", "range: range error at rest", "the_status_of_the_closed_loop"),
            ("SLA", "attempts: attempt error beyond them", "corrections_that_do_not_help"),
        ],
    ),
    ("StepNLoop status (table 7.9)", LOOP_STATUS),
    (
        "Program control and status (tables 7.11 and 7.12)",
        &[
            ("SR 0", "stop", "programs_are_controlled_by_the_host"),
            ("SR 1", "start", "programs_are_controlled_by_the_host"),
            ("SR 2", "pause", "programs_are_controlled_by_the_host"),
            ("SR 3", "continue", "programs_are_controlled_by_the_host"),
            ("SASTAT 0", "idle", "programs_are_controlled_by_the_host"),
            ("SASTAT 1", "running", "programs_are_controlled_by_the_host"),
            ("SASTAT 2", "paused", "programs_are_controlled_by_the_host"),
            ("SASTAT 4", "error", "errors_run_subroutine_31"),
        ],
    ),
    (
        "Operators (table 7.13)",
        &[
            ("+ - * / %", "arithmetic; division rounds down", "variables"),
            (">> <<", "shifts", "variables"),
            ("& \\| ~", "bits", "variables"),
        ],
    ),
    (
        "Run on boot (table 7.14)",
        &[("0", "program 0", "programs_run_on_boot"), ("1", "program 1", "programs_run_on_boot")],
    ),
    ("Homing (section 7.10)", &HOMING_MODES),
    (
        "Ramps of positional moves (section A.2)",
        &[
            ("1, 2", "a ramp longer than half the way", "short_moves_are_symmetric"),
            ("3", "triangle", "short_moves_are_symmetric"),
        ],
    ),
    (
        "Example programs (section 10.2)",
        &[
            ("1", "there and back", "example_1_there_and_back"),
            ("2", "back and forth", "example_2_endless_moves"),
            ("3", "ten times", "example_3_counted_moves"),
            ("4", "while an input is on", "example_4_moves_on_input"),
            ("5", "a step at each edge", "example_5_step_on_edge"),
            ("6", "positions by inputs", "example_6_positions_by_input"),
            ("7", "a program controls another", "example_7_stop_by_input"),
            ("8", "time-out watched by a program", "example_8_watchdog"),
        ],
    ),
];

/// Every entry of the tables.
pub fn page() -> String {
    let mut stored: Vec<_> = ascii::stored(COMMANDS)
        .map(|command| match command.id {
            Id::JoystickMask => (form(command, AXES), "the_joystick_mask_is_stored"),
            _ => (form(command, AXES), "every_item_of_table_7_15_is_stored"),
        })
        .collect();
    stored.extend([
        ("DN".into(), "every_item_of_table_7_15_is_stored"),
        ("V32 to V63".into(), "variables"),
        ("program".into(), "a_download_is_in_flash_at_once"),
    ]);
    [
        HEAD.into(),
        ascii::commands("table 9.0", COMMANDS, AXES),
        ascii::errors("table 9.1", ERRORS),
        ascii::tables(TABLES),
        ascii::in_flash("table 7.15", &stored),
        ascii::windows("table A.0", &PERFORMAX),
        ascii::statements("table 10.0", "", &PERFORMAX_2, |entry| format!("`{}`", entry.doc.test)),
    ]
    .concat()
}
