//! The keys of a bench file as a list for people.

use super::keys::{BENCH, Form, Key};
use std::fmt::Write;

/// Columns of the list.
const NAME: usize = 18;
const VALUES: usize = 32;

/// All keys of a bench file, table by table: name, values, meaning.
pub fn reference() -> String {
    let mut text = String::new();
    tables(&mut text, "", BENCH);
    text
}

/// A table with its keys, and the tables inside it.
fn tables(text: &mut String, path: &str, keys: &[Key]) {
    if !path.is_empty() {
        let space = if text.is_empty() { "" } else { "\n" };
        // Writing to a text does not fail.
        let _ = writeln!(text, "{space}{path}");
    }
    for key in keys {
        let unit = if key.unit.is_empty() { String::new() } else { format!(", {}", key.unit) };
        let values = match values(key.form) {
            values if values.is_empty() => continue,
            values => format!("{values}{unit}"),
        };
        let _ = writeln!(text, "{:NAME$} {values:VALUES$} {}", key.name, key.about);
    }
    for key in keys {
        let name = [path.trim_matches(['[', ']']), key.name].join(".");
        match key.form {
            Form::Tables(_, keys) => tables(text, &format!("[[{}]]", name.trim_start_matches('.')), keys),
            Form::ByAxis(keys) => tables(text, &format!("[{name}.NAME]"), keys),
            _ => {}
        }
    }
}

/// The values of a key, in a few words; nothing for a table, which has a heading of its own.
fn values(form: Form) -> String {
    match form {
        Form::Model => {
            let models: Vec<_> = devices::MODELS.iter().map(|model| model.name).collect();
            models.join(", ")
        }
        Form::Name => "letters, digits, `.`, `_`, `-`".into(),
        Form::Text => "text".into(),
        Form::Switch => "true, false".into(),
        Form::Whole([least, i64::MAX]) => format!("from {least}"),
        Form::Whole([least, most]) => format!("{least} to {most}"),
        Form::Number([least, most]) => format!("{least} to {most}"),
        Form::Ratio([least, most]) => format!("{least} to {most}, or less than 0"),
        Form::Position => "position".into(),
        Form::Zone => "[first, last]".into(),
        Form::Zones => "[first, last], or two of them".into(),
        Form::Curve(_) => "[[speed, part], ...]".into(),
        Form::Word(words) => words.join(", "),
        Form::Words(words) => format!("[{}]", words.join(", ")),
        Form::Texts => "[text, ...]".into(),
        Form::Tables(..) | Form::ByAxis(_) => String::new(),
    }
}
