//! Commands of a table one by one.

use super::{Role, Setting, Topic, Usage, topic};
use crate::ascii::{Command, Form, Value, inspect::is_read_by};
use alloc::{
    format,
    string::{String, ToString},
    vec,
    vec::Vec,
};

extern crate alloc;

/// What the manuals call the parts of a line, plane and helix.
const LINE: [&str; 4] = ["X target", "Y target", "Z target", "speed"];
const PLANE: [&str; 3] = ["C1", "C2", "θ"];
const CIRCLE_HELIX: [&str; 3] = ["C1", "C2", "Z target"];
const ARC_HELIX: [&str; 4] = ["C1", "C2", "θ", "Z target"];

/// A command as the manuals write it. `axes` are the letters of the axes.
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
        Form::Numbers(count) => format!("{name}{}", numbers(&LINE[..count.into()])),
        Form::Plane(count) => format!("{name}[A1][A2][P/N]{}", numbers(&PLANE[..count.into()])),
        Form::Helix(3) => format!("{name}[P/N]{}", numbers(&CIRCLE_HELIX)),
        Form::Helix(_) => format!("{name}[P/N]{}", numbers(&ARC_HELIX)),
    }
}

/// The commands of a table.
pub fn commands<I>(table: &'static [Command<I>], axes: &str) -> Vec<Usage> {
    table.iter().map(|command| usage(command, axes)).collect()
}

fn usage<I>(command: &Command<I>, axes: &str) -> Usage {
    let about = &command.about;
    let form = form(command, axes);
    let sets = if command.value.can_set() { format!("{form}, ...=[value]") } else { form.clone() };
    let syntax = match (command.value.can_ask(), command.value.can_set()) {
        (true, true) => sets,
        (false, true) => format!("{form}=[value]"),
        _ => form,
    };
    Usage {
        name: command.name.into(),
        syntax,
        text: about.text,
        example: about.example,
        section: about.section,
        unit: about.unit,
    }
}

/// How a table is shown.
pub(crate) struct Kind<'a, I: 'static> {
    /// The table.
    pub table: &'static [Command<I>],
    /// The names of the axes, one letter each.
    pub names: &'static [&'static str],
    /// The lines of the program, which are not settings.
    pub lines: I,
    /// What the sections have to do with.
    pub topics: &'a [Topic],
    /// Commands that hosts know by what they are for.
    pub roles: &'a [(I, Role)],
}

/// Everything in a table that has a value.
pub(crate) fn settings<I: PartialEq>(kind: &Kind<'_, I>) -> Vec<Setting> {
    let Kind { table, names, lines, .. } = kind;
    let axes = names.concat();
    let valued = table.iter().filter(|it| it.value != Value::None && it.id != *lines);
    let places = |command: &'static Command<I>| {
        places(command.form, names).into_iter().map(move |place| (command, place))
    };
    valued.flat_map(places).map(|(command, place)| setting(kind, &axes, command, place)).collect()
}

/// What follows a name, and the axis that it stands for.
type Place = (String, Option<&'static str>);

fn places(form: Form, axes: &'static [&'static str]) -> Vec<Place> {
    let bare = || vec![(String::new(), None)];
    let each = |count: usize| axes.iter().take(count).map(|axis| (axis.to_string(), Some(*axis)));
    let numbers = |low: u16, high: u16| (low..=high).map(|number| (number.to_string(), None));
    match form {
        Form::Bare => bare(),
        Form::Axis | Form::AxisOrFirst | Form::AxisOrEach => each(axes.len()).collect(),
        Form::AxisOf(count) => each(count.into()).collect(),
        Form::MaybeAxis => bare().into_iter().chain(each(axes.len())).collect(),
        Form::Index(low, high) => numbers(low, high).collect(),
        Form::MaybeIndex(low, high) => bare().into_iter().chain(numbers(low, high)).collect(),
        _ => Vec::new(),
    }
}

fn setting<I: PartialEq>(
    kind: &Kind<'_, I>,
    axes: &str,
    command: &'static Command<I>,
    (suffix, axis): Place,
) -> Setting {
    let (value, about) = (command.value, &command.about);
    let id = format!("{}{suffix}", command.name);
    let title = words(about.title);
    let of_all = command.form == Form::MaybeAxis && axis.is_none();
    // A device has nothing to say of all axes at once but a list.
    let is_list = of_all && matches!(value, Value::Device { .. });
    let default = match value {
        // Axes have none of their own where there is a global one.
        Value::Kept { .. } if command.form == Form::MaybeAxis && axis.is_some() => Some(0),
        Value::Kept { default, .. } => Some(default.into()),
        _ => None,
    };
    // The same name without a value may be another command's, which acts.
    let readable = value.can_ask() && is_read_by(kind.table, axes, &id, command);
    let is_text = is_list || matches!(value, Value::Text { .. });
    Setting {
        group: topic(kind.topics, about.section),
        axis,
        name: if axis.is_some() || suffix.is_empty() { title } else { format!("{title} {suffix}") },
        symbol: id.clone(),
        unit: about.unit,
        text: about.text,
        section: about.section,
        range: value.range().map(|(low, high)| (low.into(), high.into())),
        default,
        decimals: value.decimals(),
        readable,
        writable: value.can_set(),
        stored: matches!(value, Value::Kept { stored: true, .. }),
        stores_itself: false,
        is_text,
        is_touchy: false,
        role: kind.roles.iter().find(|(id, _)| *id == command.id).map(|(_, role)| *role),
        is_setting: readable && value.can_set() && (default.is_some() || is_text),
        id,
    }
}

/// The words of an identifier: `HighSpeed` is `High speed`.
fn words(identifier: &str) -> String {
    let mut words = String::new();
    for letter in identifier.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
            words.extend(letter.to_lowercase());
        } else {
            words.push(letter);
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cmd4cr, pmx2ed};

    fn pmx(id: &str) -> Setting {
        let all = (pmx2ed::guide::GUIDE.settings)();
        all.into_iter().find(|it| it.id == id).unwrap_or_else(|| panic!("no {id}"))
    }

    #[test]
    fn names() {
        assert_eq!(words("OwnDeceleration"), "Own deceleration");
        assert_eq!(words("Baud"), "Baud");
    }

    #[test]
    fn a_value_of_each_axis_and_of_all() {
        let check = |id: &str, axis: Option<&str>, default: i64| {
            let it = pmx(id);
            assert_eq!((it.axis, it.default, it.name.as_str()), (axis, Some(default), "High speed"), "{id}");
            assert_eq!((it.range, it.unit, it.section), (Some((0, 6_000_000)), "pps", "7.1"));
        };
        check("HSPD", None, 1000);
        check("HSPDX", Some("X"), 0);
        check("HSPDY", Some("Y"), 0);
    }

    #[test]
    fn what_cannot_be_read_or_set() {
        let check = |id: &str, readable: bool, writable: bool, is_text: bool| {
            let it = pmx(id);
            assert_eq!((it.readable, it.writable, it.is_text), (readable, writable, is_text), "{id}");
        };
        check("PX", true, true, false);
        check("AI1", true, false, false);
        check("DN", true, true, true);
        check("MST", true, false, true);
        check("MSTX", true, false, false);
        check("SR0", false, true, false);
        // Without a value it switches the joystick on.
        check("JO", false, true, false);
    }

    #[test]
    fn stored_ones_and_decimals() {
        let it = pmx("SLRX");
        assert_eq!((it.stored, it.decimals, it.default, it.range), (true, 3, Some(1000), Some((1, 999_999))));
        assert!(!pmx("HSPD").stored);
    }

    #[test]
    fn lines_of_programs_are_no_settings() {
        assert!((cmd4cr::guide::GUIDE.settings)().iter().all(|it| !it.id.starts_with("SA0")));
        assert_eq!((cmd4cr::guide::GUIDE.settings)().iter().filter(|it| it.id.starts_with('V')).count(), 101);
    }

    #[test]
    fn roles_and_settings() {
        let roles = |settings: Vec<Setting>, role: Role| -> Vec<String> {
            settings.into_iter().filter(|it| it.role == Some(role)).map(|it| it.id).collect()
        };
        let all = || (cmd4cr::guide::GUIDE.settings)();
        assert_eq!(roles(all(), Role::HighSpeed), ["HSPD", "HSPDX", "HSPDY", "HSPDZ", "HSPDU"]);
        assert_eq!(roles(all(), Role::PulserEnable), ["MPEX", "MPEY", "MPEZ", "MPEU"]);
        let all = || (pmx2ed::guide::GUIDE.settings)();
        assert_eq!(roles(all(), Role::SpeedWindow), ["SSPDMX", "SSPDMY"]);
        assert_eq!(roles(all(), Role::PulserEnable), [""; 0]);
        for (id, expected) in [("HSPDX", true), ("DN", true), ("PX", false), ("DO1", false), ("AI1", false)] {
            assert_eq!(pmx(id).is_setting, expected, "{id}");
        }
    }

    #[test]
    fn syntax() {
        let all = (pmx2ed::guide::GUIDE.commands)();
        let check = |name: &str, expected: &str| {
            let it = all.iter().find(|it| it.name == name).unwrap_or_else(|| panic!("no {name}"));
            assert_eq!(it.syntax, expected);
        };
        check("HSPD", "HSPD, HSPD[axis], ...=[value]");
        check("SR", "SR[0-1]=[value]");
        check("STOP", "STOP, STOP[axis]");
        check("", "X[target], Y[target], X[target]Y[target]");
    }
}
