//! The numbers of a device as its commands name them.

extern crate alloc;

use super::{Command, Form, Parsed, Value, parse};
use crate::inspect::{Quantity, Scope};
use alloc::{format, string::String, vec::Vec};

/// Shows a device of this language, with its `table`, to debuggers.
macro_rules! inspect {
    ($device:ident) => {
        impl<F: $crate::flash::Flash> $crate::Inspect for $device<F> {
            fn gate(&mut self) -> &mut $crate::gate::Gate {
                &mut self.programs.gate
            }

            fn next_program(&self) -> Option<(::motion::Ticks, usize)> {
                self.programs.next(self.now)
            }

            fn address(&self, program: usize) -> Option<u16> {
                self.programs.frames(program)?.next()
            }

            fn frames(&self, program: usize) -> alloc::vec::Vec<u16> {
                self.programs.frames(program).into_iter().flatten().collect()
            }

            fn value(&self, name: &str, board: &mut dyn $crate::Board) -> Option<f64> {
                let line = $crate::ascii::inspect::reader(COMMANDS, AXES, name)?;
                let mut reply = protocol::performax::Reply::new();
                self.ask(&line, &mut reply, board);
                reply.as_str().parse().ok()
            }

            fn quantities(&self) -> alloc::vec::Vec<$crate::inspect::Quantity> {
                $crate::ascii::inspect::quantities(COMMANDS, AXES)
            }
        }
    };
}
pub(crate) use inspect;

/// The name of the variables' command.
const VARIABLE: &str = "V";

/// The command that reads the quantity of this name, if there is one.
pub fn reader<'a, I>(table: &'static [Command<I>], axes: &str, name: &'a str) -> Option<Parsed<'a, I>> {
    let line = parse(table, axes, name).ok()?;
    (line.value.is_none() && is_number(line.command.value)).then_some(line)
}

/// Whether this command is the one that a host reads by this name.
pub fn is_read_by<I>(table: &'static [Command<I>], axes: &str, name: &str, command: &Command<I>) -> bool {
    parse(table, axes, name).is_ok_and(|line| core::ptr::eq(line.command, command))
}

/// Whether the command without `=` gives a number.
const fn is_number(value: Value) -> bool {
    value.can_ask() && !matches!(value, Value::None | Value::Text { .. })
}

/// Everything that the commands of a table read.
pub fn quantities<I>(table: &'static [Command<I>], axes: &str) -> Vec<Quantity> {
    let readable = table.iter().filter(|command| is_number(command.value));
    readable
        .flat_map(|command| suffixes(command.form, axes).into_iter().map(|it| quantity(command, &it)))
        .collect()
}

fn quantity<I>(command: &Command<I>, suffix: &str) -> Quantity {
    let scope = match command.form {
        _ if command.name == VARIABLE => Scope::Variables,
        Form::Index(..) | Form::MaybeIndex(..) | Form::Bare => Scope::Device,
        _ if suffix.is_empty() => Scope::Device,
        _ => Scope::Axes,
    };
    Quantity { name: format!("{}{suffix}", command.name), scope, text: command.about.text }
}

/// What can follow the name of a command that reads something.
fn suffixes(form: Form, axes: &str) -> Vec<String> {
    let bare = || [String::new()].into_iter();
    let letters = || axes.chars().map(String::from);
    let numbers = |low: u16, high: u16| (low..=high).map(|number| format!("{number}"));
    match form {
        Form::Bare => bare().collect(),
        Form::Axis | Form::AxisOrFirst | Form::AxisOrEach => letters().collect(),
        Form::AxisOf(count) => letters().take(count.into()).collect(),
        Form::MaybeAxis => bare().chain(letters()).collect(),
        Form::Index(low, high) => numbers(low, high).collect(),
        Form::MaybeIndex(low, high) => bare().chain(numbers(low, high)).collect(),
        _ => Vec::new(),
    }
}
