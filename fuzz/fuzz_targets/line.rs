//! A line for any entry of the tables of commands that Performax and Commander have.

use devices::ascii::{Command, Form};

/// A line of this command's form. The number decides whatever else it needs, with `how` for choices that should
/// not depend on it: its bits 64 and 128 leave out a value and an axis.
pub fn line<I>(command: &Command<I>, axes: &str, how: u8, number: i32) -> String {
    let at = |turn: u32| axes.as_bytes()[(usize::from(how >> 3) + turn as usize) % axes.len()] as char;
    let axis = at(0);
    let sign = if number & 1 == 0 { '+' } else { '-' };
    let turn = if number & 2 == 0 { 'P' } else { 'N' };
    let numbers = |count: u8| {
        let all = (0..count).map(|turns| number.rotate_left(9 * u32::from(turns)).to_string());
        all.collect::<Vec<_>>().join(":")
    };
    let within = |low: u16, high: u16| low + (number.unsigned_abs() >> 3) as u16 % (high - low + 1);
    let name = command.name;
    let line = match command.form {
        Form::Bare => name.to_owned(),
        Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach if how & 128 == 0 => name.to_owned(),
        Form::Axis | Form::AxisOf(_) | Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach => {
            format!("{name}{axis}")
        }
        Form::Index(low, high) | Form::MaybeIndex(low, high) => format!("{name}{}", within(low, high)),
        Form::Way | Form::MaybeWay => format!("{name}{axis}{sign}"),
        Form::WayMode(low, high) => format!("{name}{axis}{sign}{}", within(low.into(), high.into())),
        Form::AxisNumber => format!("{name}{axis}{number}"),
        Form::Targets if how & 128 == 0 => format!("{axis}{number}"),
        Form::Targets => format!("{axis}{number}{}{}", at(1), number.rotate_left(7)),
        Form::Numbers(count) => format!("{name}{}", numbers(count)),
        Form::Plane(count) => format!("{name}{axis}{}{turn}{}", at(1), numbers(count)),
        Form::Helix(count) => format!("{name}{turn}{}", numbers(count)),
    };
    if command.value.can_set() && how & 64 == 0 { format!("{line}={number}") } else { line }
}
