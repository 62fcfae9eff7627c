//! Entries of the tables of commands that Performax and Commander have.

use devices::ascii::{Command, Form, Value};

/// The row of a command: form, values, default, unit, stored, section, text, example, test.
pub fn row<I>(command: &Command<I>, axes: &str) -> String {
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

/// A command as the manuals write it.
pub fn form<I>(command: &Command<I>, axes: &str) -> String {
    let name = command.name;
    let numbers = |names: &[&str]| names.iter().map(|name| format!("[{name}]")).collect::<Vec<_>>().join(":");
    match command.form {
        Form::Bare => name.into(),
        Form::Axis => format!("{name}[axis]"),
        Form::AxisOf(count) => {
            let named = axes.chars().take(count.into()).map(|axis| format!("{name}{axis}"));
            named.collect::<Vec<_>>().join(", ")
        }
        Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach => format!("{name}, {name}[axis]"),
        Form::Index(low, high) => format!("{name}[{low}-{high}]"),
        Form::MaybeIndex(low, high) => format!("{name}, {name}[{low}-{high}]"),
        Form::Way => format!("{name}[axis][+/-]"),
        Form::MaybeWay => format!("{name}[+/-], {name}[axis][+/-]"),
        Form::WayMode(low, high) => format!("{name}[axis][+/-][{low}-{high}]"),
        Form::AxisNumber => format!("{name}[axis][value]"),
        Form::Targets => {
            let targets: Vec<_> = axes.chars().map(|axis| format!("{axis}[target]")).collect();
            format!("{}, {}", targets.join(", "), targets.concat())
        }
        Form::Numbers(count) => {
            format!("{name}{}", numbers(&["X target", "Y target", "Z target", "speed"][..count.into()]))
        }
        Form::Plane(count) => format!("{name}[A1][A2][P/N]{}", numbers(&["C1", "C2", "θ"][..count.into()])),
        Form::Helix(3) => format!("{name}[P/N]{}", numbers(&["C1", "C2", "Z target"])),
        Form::Helix(_) => format!("{name}[P/N]{}", numbers(&["C1", "C2", "θ", "Z target"])),
    }
}
