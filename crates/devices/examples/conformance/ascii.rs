//! Entries of the tables of commands that Performax and Commander have.

use ascript::dialect::Dialect;
use ascript::isa::{self, Entry};
use devices::ascii::{Command, Value};
use devices::guide::ascii::form;
use motion::pps::Window;

/// A table of a manual: its rows, with the test of each.
pub type Rows = &'static [(&'static str, &'static str, &'static str)];

/// The status of StepNLoop.
pub const LOOP_STATUS: Rows = &[
    ("0", "idle", "the_status_of_the_closed_loop"),
    ("1", "moving", "the_status_of_the_closed_loop"),
    ("2", "correcting", "a_slip_is_corrected"),
    ("3", "stopping", "the_status_of_the_closed_loop"),
    ("4", "aborting", "the_status_of_the_closed_loop"),
    ("5", "jogging", "the_status_of_the_closed_loop"),
    ("6", "homing", "the_status_of_the_closed_loop"),
    ("7", "Z homing", "the_status_of_the_closed_loop"),
    ("8", "range error", "the_status_of_the_closed_loop"),
    ("9", "attempt error", "corrections_that_do_not_help"),
    ("10", "stall error", "a_stall_is_an_error_until_it_is_cleared"),
    ("11", "limit error", "the_status_of_the_closed_loop"),
    ("12", "off", "the_status_of_the_closed_loop"),
    ("13", "limit homing", "the_status_of_the_closed_loop"),
];

/// The units of speeds.
pub const UNITS_OF_SPEED: Rows = &[
    ("StepNLoop off", "pulses a second", "speeds_are_read_while_moving"),
    ("interpolated moves", "pulses a second", "closed_loop_moves_in_encoder_counts"),
    ("StepNLoop on", "encoder counts a second", "closed_loop_moves_in_encoder_counts"),
];

/// The commands of a controller.
pub fn commands<I>(of: &str, commands: &[Command<I>], axes: &str) -> String {
    let head = "| command | values | default | unit | stored | section | what it does | example | test |";
    let rows: Vec<_> = commands.iter().map(|command| row(command, axes)).collect();
    format!("\n## Commands ({of})\n\n{head}\n|---|---|---|---|---|---|---|---|---|\n{}\n", rows.join("\n"))
}

/// The errors of a controller.
pub fn errors(of: &str, errors: Rows) -> String {
    table(&format!("Errors ({of})"), ["reply", "when"], errors)
}

/// Tables by their titles.
pub fn tables<'a>(tables: impl IntoIterator<Item = &'a (&'a str, Rows)>) -> String {
    tables.into_iter().map(|(title, rows)| table(title, ["entry", "meaning"], rows)).collect()
}

fn table(title: &str, [first, second]: [&str; 2], rows: Rows) -> String {
    let rows: String =
        rows.iter().map(|(of, what, test)| format!("| {of} | {what} | `{test}` |\n")).collect();
    format!("\n## {title}\n\n| {first} | {second} | test |\n|---|---|---|\n{rows}")
}

/// The commands whose values are stored.
pub fn stored<I>(commands: &[Command<I>]) -> impl Iterator<Item = &Command<I>> {
    commands.iter().filter(|command| matches!(command.value, Value::Kept { stored: true, .. }))
}

/// What is in flash, with the test of each.
pub fn in_flash(of: &str, items: &[(String, &str)]) -> String {
    let rows: String = items.iter().map(|(item, test)| format!("| {item} | `{test}` |\n")).collect();
    format!("\n## Stored in flash ({of})\n\n| item | test |\n|---|---|\n{rows}")
}

/// The windows of speed of a family.
pub fn windows(of: &str, windows: &[Window]) -> String {
    let head = "| window | high speed in pps | least low speed | shortest ramp in ms | δ | test |";
    let mut text = format!("\n## Speed windows ({of})\n\n{head}\n|---|---|---|---|---|---|\n");
    for Window { number, from_pps, to_pps, least_low_pps, least_ms, delta, .. } in windows {
        text.push_str(&format!(
            "| {number} | {from_pps} to {to_pps} | {least_low_pps} | {least_ms} | {delta} | \
             `ramps_have_the_ranges_of_the_manuals_examples` |\n"
        ));
    }
    text
}

/// The statements of a dialect, with a note above them and the tests of each.
pub fn statements(of: &str, note: &str, dialect: &Dialect, tests: impl Fn(&Entry) -> String) -> String {
    let mut text = format!("\n## Program statements ({of})\n{note}");
    text.push_str("\n| statement | section | what it does | example | test |\n|---|---|---|---|---|\n");
    for entry in isa::TABLE.iter().filter(|entry| entry.access(dialect.family).is_some()) {
        text.push_str(&format!(
            "| {} | {} | {} | `{}` | {} |\n",
            entry.form(dialect),
            entry.section(dialect.family),
            entry.doc.summary,
            entry.doc.example,
            tests(entry)
        ));
    }
    text
}

/// The row of a command: form, values, default, unit, stored, section, text, example, test.
fn row<I>(command: &Command<I>, axes: &str) -> String {
    let (values, default, stored) = match command.value {
        Value::None => (String::new(), String::new(), ""),
        Value::Kept { decimals, low, high, default, stored } => {
            (range(low, high, decimals), fixed(default, decimals), if stored { "STORE" } else { "" })
        }
        Value::Device { write: Some((low, high)), .. } => (range(low, high, 0), String::new(), ""),
        Value::Device { write: None, .. } => ("read only".into(), String::new(), ""),
        Value::Text { write: true, .. } => ("text".into(), String::new(), ""),
        Value::Text { write: false, .. } => ("text, read only".into(), String::new(), ""),
    };
    let about = &command.about;
    format!(
        "| {} | {values} | {default} | {} | {stored} | {} | {} | `{}` | `{}` |",
        form(command, axes),
        about.unit,
        about.section,
        about.text,
        about.example,
        about.test
    )
}

fn range(low: i32, high: i32, decimals: u8) -> String {
    match (low, high) {
        (i32::MIN, i32::MAX) => "32 bits".into(),
        _ => format!("{} to {}", fixed(low, decimals), fixed(high, decimals)),
    }
}

fn fixed(value: i32, decimals: u8) -> String {
    if decimals == 0 { value.to_string() } else { format!("{:.3}", f64::from(value) / 1000.0) }
}
