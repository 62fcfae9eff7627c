//! The page of the PD42-1140.

use devices::pd42::{axis_parameters, global_parameters as gp};
use devices::{Parameter, parameter::Access};
use tmcl::isa::{INTERRUPTS, Mode, TABLE};

/// The test of each command's behaviour, by opcode. The encoding of each is held by `requests`, and that its
/// example assembles by `the_examples_of_the_table_assemble`.
const COMMAND_TESTS: &[(u8, &str)] = &[
    (1, "rotating_left_and_right"),
    (2, "rotating_left_and_right"),
    (3, "stopping_takes_the_ramp"),
    (4, "moving_to_positions"),
    (5, "every_parameter_has_its_default_range_and_access"),
    (6, "every_parameter_has_its_default_range_and_access"),
    (7, "every_storable_parameter_survives_a_restart"),
    (8, "every_storable_parameter_survives_a_restart"),
    (9, "every_parameter_of_the_module_has_its_default_range_and_access"),
    (10, "every_parameter_of_the_module_has_its_default_range_and_access"),
    (11, "user_variables"),
    (12, "user_variables"),
    (13, "reference_search_commands"),
    (14, "outputs"),
    (15, "inputs"),
    (19, "arithmetic_wraps_and_truncates"),
    (20, "comparisons_set_all_flags"),
    (21, "conditional_jumps"),
    (22, "counting_loop"),
    (23, "subroutines_nest_eight_deep"),
    (24, "subroutines_nest_eight_deep"),
    (25, "an_interrupt_needs_enable_vector_and_a_running_program"),
    (26, "an_interrupt_needs_enable_vector_and_a_running_program"),
    (27, "waits_for_the_axis_and_its_switches"),
    (28, "a_program_ends"),
    (30, "coordinates"),
    (31, "coordinates"),
    (32, "coordinates"),
    (33, "arithmetic_wraps_and_truncates"),
    (34, "from_the_accumulator"),
    (35, "from_the_accumulator"),
    (36, "clearing_error_flags"),
    (37, "an_interrupt_needs_enable_vector_and_a_running_program"),
    (38, "an_interrupt_saves_and_restores_the_registers"),
    (39, "coordinates"),
    (40, "arithmetic_wraps_and_truncates"),
    (41, "arithmetic_wraps_and_truncates"),
    (42, "arithmetic_wraps_and_truncates"),
    (43, "arithmetic_wraps_and_truncates"),
    (44, "arithmetic_wraps_and_truncates"),
    (45, "arithmetic_wraps_and_truncates"),
    (46, "from_the_accumulator"),
    (48, "a_restart_leaves_subroutine_and_handler"),
    (49, "counting_loop"),
    (50, "from_the_accumulator"),
    (51, "from_the_accumulator"),
    (55, "indexed_variables"),
    (56, "indexed_variables"),
    (57, "indexed_variables"),
    (64, "refused_everywhere"),
    (65, "refused_everywhere"),
    (66, "refused_everywhere"),
    (67, "refused_everywhere"),
    (68, "refused_everywhere"),
    (69, "refused_everywhere"),
    (70, "refused_everywhere"),
    (71, "refused_everywhere"),
    (80, "conditional_calls"),
    (128, "stop_and_reset"),
    (129, "running_stopping_and_stepping"),
    (130, "running_stopping_and_stepping"),
    (131, "stop_and_reset"),
    (132, "downloading"),
    (133, "downloading"),
    (134, "downloading"),
    (135, "stop_and_reset"),
    (136, "version"),
    (137, "factory_settings"),
    (138, "position_reached_events"),
    (139, "ascii_lines"),
    (255, "software_reset"),
];

/// The test of each interrupt, by number.
const INTERRUPT_TESTS: &[(u8, &str)] = &[
    (0, "bank_3_timers"),
    (1, "bank_3_timers"),
    (2, "bank_3_timers"),
    (3, "interrupts_of_the_axis"),
    (15, "interrupts_of_the_axis"),
    (21, "interrupts_of_the_axis"),
    (27, "bank_3_triggers"),
    (28, "bank_3_triggers"),
    (39, "bank_3_triggers"),
    (40, "bank_3_triggers"),
    (41, "bank_3_triggers"),
    (42, "bank_3_triggers"),
];

/// The status codes of table 4, when each is sent, and its test.
const STATUSES: &[(u8, &str, &str)] = &[
    (1, "wrong checksum", "a_wrong_checksum_executes_nothing"),
    (2, "unknown command", "refused_everywhere"),
    (3, "unknown type, or one that does not allow it", "other_numbers_are_a_wrong_type"),
    (4, "motor, bank or value out of range", "every_parameter_has_its_default_range_and_access"),
    (5, "program memory is protected, or EEPROM refuses", "gp_81_code_protection"),
    (6, "not available in this mode or state", "refused_everywhere"),
    (100, "executed", "replies"),
    (101, "stored in the program memory", "downloading"),
    (128, "position reached (an event)", "position_reached_events"),
];

const HEAD: &str = "\
# PD42-1140: conformance

Made from the module's tables by `cargo xtask docs`; do not edit. Sections and tables are those of the
PD42-1140 TMCL firmware manual, V1.47. What the manual leaves open is settled in
[decisions](pd42-1140-decisions.md).
";

/// Every entry of the tables.
pub fn page() -> String {
    let mut page = HEAD.to_owned();
    let mut line = |text: String| {
        page.push_str(&text);
        page.push('\n');
    };
    line("\n## Status codes (table 4)\n\n| code | when | test |\n|---|---|---|".into());
    for (code, when, test) in STATUSES {
        line(format!("| {code} | {when} | `{test}` |"));
    }
    line(
        "\n## Commands (tables 5 and 14)\n\nH: sent by a host. P: in a program. A: typed in ASCII mode.\n"
            .into(),
    );
    line(
        "| no. | command | where | section | what it does | example | test |\n|---|---|---|---|---|---|---|"
            .into(),
    );
    for entry in TABLE {
        let modes: String = [(Mode::Direct, 'H'), (Mode::Program, 'P'), (Mode::Ascii, 'A')]
            .into_iter()
            .filter(|&(mode, _)| entry.allows(mode))
            .map(|(_, letter)| letter)
            .collect();
        let modes = if modes.is_empty() { "–".to_owned() } else { modes };
        let test = test_of(COMMAND_TESTS, entry.opcode);
        line(format!(
            "| {} | {} | {modes} | {} | {} | `{}` | `{test}` |",
            entry.opcode,
            entry.mnemonic.unwrap_or("–"),
            entry.doc.section,
            entry.doc.summary,
            entry.doc.example
        ));
    }
    line("\n## Interrupts (table 12)\n\n| no. | symbol | when | test |\n|---|---|---|---|".into());
    for entry in &INTERRUPTS {
        let test = test_of(INTERRUPT_TESTS, entry.number);
        line(format!("| {} | {} | {} | `{test}` |", entry.number, entry.symbol, entry.event));
    }
    for (title, table) in [
        ("Axis parameters (table 16)", axis_parameters::TABLE),
        ("Global parameters, bank 0 (table 18)", gp::module::TABLE),
        ("Global parameters, bank 3 (table 20)", gp::interrupts::TABLE),
    ] {
        line(format!("\n## {title}\n"));
        line("| no. | name | symbol | range | unit | access | default | what it does | test |\n|---|---|---|---|---|---|---|---|---|".into());
        for entry in table {
            line(parameter(entry));
        }
    }
    line(format!(
        "\n## Global parameters, bank 2 (table 19)\n\n\
         | no. | name | range | access | test |\n|---|---|---|---|---|\n\
         | 0–{} | user variables | 32 bits | {} | `user_variables` |\n\
         | {}–255 | user variables | 32 bits | {} | `user_variables` |",
        gp::STORABLE_VARIABLES - 1,
        Access::RWE.letters(),
        gp::STORABLE_VARIABLES,
        Access::RW.letters()
    ));
    page
}

fn parameter(entry: &Parameter) -> String {
    let Parameter { number, low, high, access, default, about } = entry;
    let range = match (*low, *high) {
        (low, high) if high < low => "0 to 4294967295".to_owned(),
        (i32::MIN, i32::MAX) => "32 bits".to_owned(),
        (low, high) => format!("{low} to {high}"),
    };
    format!(
        "| {number} | {} | {} | {range} | {} | {} | {default} | {} | `{}` |",
        about.name,
        about.symbol,
        about.unit,
        access.letters(),
        about.text,
        about.test
    )
}

fn test_of(tests: &[(u8, &'static str)], number: u8) -> &'static str {
    let entry = tests.iter().find(|(of, _)| *of == number);
    entry.unwrap_or_else(|| panic!("number {number} has no test")).1
}
