//! The page of the CMD-4CR.

use crate::ascii::{self, LOOP_STATUS, Rows, UNITS_OF_SPEED};
use ascript::compiler::ErrorKind;
use ascript::dialect::COMMANDER;
use ascript::isa::Word;
use devices::cmd4cr::guide::{HOMING, STATUS_BITS};
use devices::cmd4cr::table::{AXES, COMMANDS};
use devices::guide::{self, HomingMode, ascii::form};
use motion::pps;
use protocol::hid::ApiError;

const HEAD: &str = "\
# CMD-4CR: conformance

Made from the controller's tables by `cargo xtask docs`; do not edit. Sections and tables are those of the
CMD-4CR manual, version 1.0 (firmware V126BL). What the manual leaves open is settled in
[decisions](cmd-4cr-decisions.md).
";

/// The replies of table 4-41.
const ERRORS: Rows = &[
    ("?Unknown Command: *command*", "the command is not known", "unknown_commands_are_repeated"),
    (
        "?Error Moving",
        "an axis of a motion moves, follows something, or is in an error that was not cleared",
        "axes_that_move_take_no_other_motion",
    ),
    ("?Error Alarm", "a motion with the alarm input on", "an_alarm_that_is_on"),
    ("?Error +Limit", "a motion towards a positive limit that is on", "limits_that_are_on"),
    ("?Error -Limit", "a motion towards a negative limit that is on", "limits_that_are_on"),
    ("?Error ESTOP", "a motion with the emergency stop input on", "an_emergency_stop_that_is_on"),
    ("?Error SNL", "a motion in a StepNLoop error", "a_loop_in_error_does_not_move"),
    ("?Invalid Index", "a number that is out of range, or none", "numbers_out_of_range"),
    ("?Program Error", "a program is in its error state, or cannot start", "programs_in_error"),
    ("?Sub not Initialized", "GS of a subroutine that is not there", "subroutines_that_are_not_there"),
    ("?Buffer Full", "all registers are full, or three motions wait for the external start", "full_buffers"),
    ("?Buffer Disabled", "I or BSTART while the buffer is off", "buffer_commands_without_a_buffer"),
    ("?Buffer Enabled", "SSPD while the buffer is on", "no_other_speed_while_the_buffer_is_on"),
    ("?SSPD Error", "SSPD outside its window, or with S-curves", "speeds_outside_their_window"),
    ("?Override Failed", "T or SSPD where there is nothing to change", "changes_without_a_motion"),
];

const SECTION_2_1: &[(&str, Rows)] = &[
    (
        "Slowdown inputs (tables 2-1 and 2-2)",
        &[
            ("SDE bit 0", "on", "slowdown_inputs"),
            ("SDE bit 1", "latched", "slowdown_inputs"),
            ("SDC 0", "low speed", "slowdown_inputs"),
            ("SDC 1", "decelerates and stops", "slowdown_inputs_that_stop"),
        ],
    ),
    (
        "Latches (tables 2-3 and 2-4)",
        &[
            ("DI1 to DI4", "latch X, Y, Z, U", "latches"),
            ("LTS 0", "off", "latches"),
            ("LTS 1", "waits for its input", "latches"),
            ("LTS 2", "triggered", "latches"),
        ],
    ),
    (
        "High-speed inputs and outputs (tables 2-5, 2-8 and 2-9)",
        &[
            ("DI bits 0 to 3", "DI1 to DI4", "digital_inputs"),
            ("DO bits 0 to 3", "DO1 to DO4", "digital_outputs"),
            ("DOBOOT bits 0 to 3", "DO1 to DO4 at power-up", "boot_values"),
        ],
    ),
    (
        "Synchronisation outputs (tables 2-6 and 2-7)",
        &[
            ("DO1 to DO4", "of X, Y, Z, U", "synchronisation_outputs"),
            ("at position", "counter = comparator", "synchronisation_outputs"),
            ("< and > position", "counter below or above", "synchronisation_outputs"),
            ("continuous", "at every multiple", "continuous_synchronisation"),
            ("window", "continuous, between SYNMIN and SYNMAX", "the_synchronisation_window"),
            ("SYNS 0", "off", "synchronisation_outputs"),
            ("SYNS 1", "waits for the condition", "synchronisation_outputs"),
            ("SYNS 2", "condition established", "synchronisation_outputs"),
        ],
    ),
    (
        "Configurable inputs and outputs (tables 2-10 and 2-18)",
        &[
            ("IO bits 0 to 31", "IO1 to IO32", "configurable_io"),
            ("IOP bit 0", "logic of inputs", "configurable_io"),
            ("IOP bit 1", "logic of outputs", "configurable_io"),
            ("IOBOOT", "outputs at power-up", "boot_values"),
        ],
    ),
    (
        "Analog inputs and PWM (tables 2-11 and 2-23, section 2.1.3.3.3)",
        &[
            ("AI1", "joystick of X", "joystick_control"),
            ("AI2", "joystick of Y", "joystick_control"),
            ("PWM1", "how long it is low", "pwm_outputs"),
            ("PWM2", "how long it is high", "pwm_outputs"),
        ],
    ),
    (
        "Error clear output (tables 2-13 to 2-15)",
        &[
            ("ERC bit 0", "at an error stop", "error_stops"),
            ("ERC bit 1", "at the end of homing", "error_clear_outputs"),
            ("ERCD 0 to 3", "0, 12 µs, 1.6 ms, 104 ms", "error_clear_outputs"),
            ("ERCP 0 to 6", "12 µs, 102 µs, 409 µs, 1.6 ms, 13 ms, 52 ms, 104 ms", "error_clear_outputs"),
        ],
    ),
    (
        "System settings (table 2-12)",
        &[
            ("ERC, ERCD, ERCP", "error clear output", "error_clear_outputs"),
            ("EXST", "external start", "external_start"),
            ("IERR", "no error flags", "errors_can_be_ignored"),
            ("INP", "in-position input", "in_position_inputs"),
            ("POL", "input modes and polarities", "polarities"),
            ("SCV", "S-curves", "s_curves"),
            ("SDC, SDE", "slowdown input", "slowdown_inputs"),
            ("STORE", "to flash", "every_item_of_table_2_19_is_stored"),
        ],
    ),
    (
        "In-position input (table 2-16)",
        &[("0", "not used", "in_position_inputs"), ("1", "used", "in_position_inputs")],
    ),
    (
        "Polarity (table 2-17)",
        &[
            ("0 to 2", "pulse output mode", "pulse_output_modes"),
            ("3", "limits", "polarities"),
            ("4", "home", "polarities"),
            ("5", "alarm", "polarities"),
            ("6", "slowdown", "polarities"),
            ("7", "in position", "polarities"),
            ("8", "error clear", "polarities"),
            ("9", "enable", "polarities"),
            ("10", "direction of the encoder", "encoder_inputs"),
            ("11, 12", "encoder input: x1, x2, x4, two-pulse", "encoder_inputs"),
            ("13", "Z index", "polarities"),
            ("14", "direction of the pulse generator", "inputs_of_the_manual_pulse_generator"),
            ("15, 16", "its input: x1, x2, x4, two-pulse", "inputs_of_the_manual_pulse_generator"),
        ],
    ),
    (
        "Functions of the HID library (table 3-36)",
        &[
            ("GetCommanderHIDnumber, GetCommanderHIDName", "names of devices", "names"),
            (
                "OpenCommanderHID, CloseCommanderHID",
                "a client has reports of its own",
                "clients_have_reports_of_their_own",
            ),
            ("SendReceiveCommanderHID", "a command and its reply", "a_commander"),
        ],
    ),
    (
        "Baud rates (table 3-39)",
        &[("1 to 5", "9600, 19200, 38400, 57600, 115200", "every_item_of_table_2_19_is_stored")],
    ),
];

/// The bits of the status word.
const STATUS: [(&str, &str, &str); STATUS_BITS.len()] = guide::rows(&STATUS_BITS);

const SECTION_2_2: &[(&str, Rows)] = &[
    (
        "Motor power (tables 2-20 and 2-21)",
        &[
            ("EO bits 0 to 3", "EO1 to EO4: X, Y, Z, U", "motor_power"),
            ("EOBOOT bits 0 to 3", "at power-up", "boot_values"),
        ],
    ),
    (
        "Move mode (table 2-22)",
        &[
            ("0", "absolute", "absolute_and_incremental_moves"),
            ("1", "incremental", "absolute_and_incremental_moves"),
        ],
    ),
    (
        "Joystick (tables 2-24 and 2-25)",
        &[
            ("JENA bit 0", "X", "joysticks_of_some_axes"),
            ("JENA bit 1", "Y", "joysticks_of_some_axes"),
            (
                "JLIM1 to JLIM4",
                "X: negative outer, inner, positive inner, outer",
                "the_joysticks_soft_limits",
            ),
            ("JLIM5 to JLIM8", "Y: the same", "the_joysticks_soft_limits"),
            ("JMAX, JMIN, JTOL", "voltages", "the_joysticks_voltages"),
            ("JSPD, JDEL", "highest speed, greatest change", "joystick_control"),
        ],
    ),
    (
        "StepNLoop behaviour (table 2-26)",
        &[
            ("up to SLT", "in position", "a_slip_is_corrected"),
            ("beyond SLT, moving", "goes on", "a_slip_is_corrected"),
            ("beyond SLT, at rest", "is corrected", "a_slip_is_corrected"),
            ("beyond SLE, moving", "stall error", "a_stall_is_an_error_until_it_is_cleared"),
            ("beyond SLE, at rest", "range error", "the_status_of_the_closed_loop"),
            ("more than SLA corrections", "attempt error", "corrections_that_do_not_help"),
        ],
    ),
    ("StepNLoop status (table 27)", LOOP_STATUS),
    ("Axis status (table 2-28)", &STATUS),
    ("Units of speed (table 2-29)", UNITS_OF_SPEED),
];

const SECTION_2_7: &[(&str, Rows)] = &[
    (
        "Conditions and operators (tables 2-30 and 2-32)",
        &[
            ("= != > < >= <=", "comparisons", "branches"),
            ("+ - * / %", "arithmetic; division rounds down", "variables"),
            (">> <<", "shifts", "variables"),
            ("& \\| ~", "bits", "variables"),
        ],
    ),
    (
        "Return from SUB 31 (table 2-31)",
        &[
            ("0", "to the line of the error", "errors_run_subroutine_31"),
            ("1", "to the program's first line", "errors_run_subroutine_31"),
        ],
    ),
    (
        "Program control and status (tables 2-33 and 2-34)",
        &[
            ("SACTRL 0", "stop", "programs_are_controlled_by_the_host"),
            ("SACTRL 1", "start", "programs_are_controlled_by_the_host"),
            ("SACTRL 2", "pause", "programs_are_controlled_by_the_host"),
            ("SACTRL 3", "continue", "programs_are_controlled_by_the_host"),
            ("SASTAT 0", "idle", "programs_are_controlled_by_the_host"),
            ("SASTAT 1", "running", "programs_are_controlled_by_the_host"),
            ("SASTAT 2", "paused", "programs_are_controlled_by_the_host"),
            ("SASTAT 4", "error", "programs_in_error"),
        ],
    ),
    ("Run on boot (table 2-35)", &[("0 to 3", "programs 0 to 3", "programs_run_on_boot")]),
    (
        "Command sequences (section 4.3)",
        &[
            ("4.3.1", "jog", "sequence_1_jogs"),
            ("4.3.2", "moves of two axes", "sequence_2_moves_axes_by_themselves"),
            ("4.3.3", "counters", "sequence_3_clears_counters"),
            ("4.3.4", "homing", "sequence_4_homes"),
            ("4.3.5", "line", "sequence_5_moves_along_a_line"),
            ("4.3.6", "circle", "sequence_6_moves_around_a_circle"),
            ("4.3.7", "speed on the fly", "sequence_7_changes_the_speed"),
            ("4.3.8", "synchronisation", "sequence_8_synchronises_an_output"),
            ("4.3.9", "inputs and outputs", "sequence_9_follows_an_input"),
        ],
    ),
    (
        "Example programs (section 5.4)",
        &[
            ("1", "there and back", "example_1_there_and_back"),
            ("2", "buffered contour", "example_2_buffered_contour"),
            ("3", "back and forth", "example_3_endless_moves"),
            ("4", "ten times", "example_4_counted_moves"),
            ("5", "while an input is on", "example_5_moves_on_input"),
            ("6", "a step at each edge", "example_6_step_on_edge"),
            ("7", "positions by inputs, errors", "example_7_positions_by_input"),
            ("8", "a program controls another", "example_8_stop_by_input"),
            ("9", "alarm", "example_9_alarm"),
            ("9", "alarm, without SUB 31", "example_9_alarm_watched_by_a_program"),
            ("10", "laser", "example_10_laser"),
        ],
    ),
];

const APPENDICES: &[(&str, Rows)] = &[
    (
        "Index moves, counts of marks and pulses of homing (section 2.2.5, appendix A)",
        &[
            ("ZCNT", "index marks", "index_marks_are_counted"),
            ("ZMOVE", "index alone", "index_moves"),
            ("ERC", "pulse at zero", "error_clear_outputs"),
            ("limits", "error cleared by homing that seeks them", "homing_modes"),
        ],
    ),
    (
        "Ramps of positional moves (section B.2)",
        &[
            ("1, 2", "a ramp longer than half the way", "short_moves_are_symmetric"),
            ("3", "triangle", "short_moves_are_symmetric"),
        ],
    ),
    (
        "Interpolation (appendix C)",
        &[
            ("C.1", "lines of two to four axes", "lines_need_interpolation"),
            ("C.3", "arcs", "arcs"),
            ("C.4", "circles", "circles"),
            ("C.5", "helices, with the U axis", "helices"),
            ("C.6", "error stop of all axes", "limits_latch_errors"),
            ("C.6", "slowdown input of all axes", "slowdown_inputs_of_interpolated_moves"),
        ],
    ),
];

/// The operations of the drawings of appendix A.
fn homing_rows() -> Vec<String> {
    let mut rows = Vec::new();
    for HomingMode { id: mode, name: what, .. } in &HOMING {
        let by_home = !matches!(mode, 6..=8 | 12);
        rows.push(format!("| {mode}, operation 1 | {what} | `homing_modes` |"));
        if by_home {
            rows.push(format!("| {mode}, operation 2 | started on the home switch | `operations_2_and_3` |"));
            rows.push(format!("| {mode}, operation 3 | started away from it | `operations_2_and_3` |"));
        }
        if *mode == 0 {
            for (operation, what) in [
                (1, "slows down on the slowdown switch, stops at home"),
                (2, "started on the slowdown switch"),
                (3, "started on it and away from home"),
                (4, "started away from both"),
            ] {
                rows.push(format!(
                    "| {mode} with SD, operation {operation} | {what} | `operations_of_mode_0` |"
                ));
            }
        } else {
            let test = "every_mode_with_a_switch_around_home";
            rows.push(format!("| {mode} with SD | the slowdown switch around home | `{test}` |"));
        }
    }
    rows
}

/// The test on the device of what a group of statements does; the entry's own test holds the language.
const fn effect(word: Word) -> &'static str {
    match word {
        Word::Comment
        | Word::Prg
        | Word::End
        | Word::Sub
        | Word::EndSub
        | Word::Gosub
        | Word::If
        | Word::ElseIf
        | Word::Else
        | Word::EndIf
        | Word::While
        | Word::EndWhile
        | Word::V => "branches_loops_and_subroutines",
        Word::Abort | Word::AbortAxis | Word::Stop | Word::StopAxis | Word::Jog => "jogs_and_stops",
        Word::Abs | Word::Inc | Word::X | Word::Y | Word::Z | Word::U | Word::Linear | Word::Wait => {
            "moves_and_modes"
        }
        Word::Eclear | Word::Store | Word::Sr => "errors_settings_and_other_programs",
        Word::Delay => "lines_take_their_time",
        Word::Home | Word::ZMove => "homing_and_index_moves",
        Word::Cir | Word::Arc | Word::CirT | Word::ArcT => "circles_arcs_and_helices",
        Word::BufOn | Word::BufOff | Word::IStart => "buffered_moves_of_programs",
        Word::SynOn | Word::SynOff => "synchronisation_of_programs",
        Word::Sspd => "speeds_and_targets_on_the_fly",
        Word::MpgE | Word::Pwm | Word::Lt | Word::Lts | Word::Lte | Word::Ltp => {
            "latches_and_more_of_programs"
        }
        _ => "registers",
    }
}

/// Every entry of the tables.
pub fn page() -> String {
    let items =
        ascii::stored(COMMANDS).map(|command| form(command, AXES)).chain(["ID".into(), "V[0-99]".into()]);
    let mut stored: Vec<_> = items.map(|item| (item, "every_item_of_table_2_19_is_stored")).collect();
    stored.push(("program".into(), "a_download_is_in_flash_at_once"));
    let codes = ApiError::ALL.iter().map(|error| format!("| {} | {error} | `codes` |\n", error.code()));
    let homing = homing_rows().into_iter().map(|row| row + "\n");
    let kinds = ErrorKind::ALL.iter().map(|kind| format!("| {kind} | `errors_of_the_manual` |\n"));
    let note =
        "\nThe first test is that of the language, the second one that of the effect on the controller.\n";
    [
        HEAD.into(),
        ascii::commands("table 4-40", COMMANDS, AXES),
        ascii::errors("table 4-41", ERRORS),
        ascii::tables([SECTION_2_1, SECTION_2_2, SECTION_2_7, APPENDICES].into_iter().flatten()),
        "\n## Error codes of the HID library (table 3-37)\n\n| code | meaning | test |\n|---|---|---|\n"
            .into(),
        codes.collect(),
        "\n## Homing modes (appendix A)\n\n| entry | meaning | test |\n|---|---|---|\n".into(),
        homing.collect(),
        ascii::in_flash("table 2-19", &stored),
        ascii::windows("table B-46", &pps::COMMANDER),
        ascii::statements("table 5-42", note, &COMMANDER, |entry| {
            format!("`{}` `{}`", entry.doc.test, effect(entry.word))
        }),
        "\n## Errors of the compiler (table 5-43)\n\n| error | test |\n|---|---|\n".into(),
        kinds.collect(),
    ]
    .concat()
}
