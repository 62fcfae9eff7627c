//! Parts of replies.

use super::Value;
use core::fmt::{Arguments, Display, Write};
use protocol::performax::Reply;

/// Adds to a reply.
///
/// # Panics
/// If it does not fit: all replies are far shorter than there is room for.
pub fn say(reply: &mut Reply, text: Arguments<'_>) {
    assert!(reply.write_fmt(text).is_ok(), "replies fit");
}

/// Numbers with `:` between.
pub fn list<N: Display>(reply: &mut Reply, numbers: impl Iterator<Item = N>) {
    for (place, number) in numbers.enumerate() {
        say(reply, format_args!("{}{number}", if place == 0 { "" } else { ":" }));
    }
}

/// A number, with the decimals that its command has.
pub fn number(reply: &mut Reply, value: Value, number: i32) {
    match value {
        Value::Kept { decimals: 3, .. } => say(reply, format_args!("{}.{:03}", number / 1000, number % 1000)),
        _ => say(reply, format_args!("{number}")),
    }
}
