//! Parameters and commands of TMCL modules one by one.

use super::{Role, Setting, Usage};
use crate::parameter::{Parameter, Table};
use ::tmcl::isa::{Instruction, Mode, TABLE};
use alloc::{format, string::String, vec::Vec};

extern crate alloc;

/// Numbers of a table that have to do with something: the last one, and what.
pub(crate) type Ranges = &'static [(u8, &'static str)];

/// What the entries of a table have in common.
pub(crate) struct Kind<'a> {
    /// The table.
    pub table: &'static Table,
    /// What the numbers have to do with.
    pub groups: Ranges,
    /// The manual's section.
    pub section: &'static str,
    /// The axis that they belong to.
    pub axis: Option<&'static str>,
    /// From a number to what hosts know it by.
    pub id: &'a dyn Fn(u8) -> String,
    /// Entries that are changed by being looked at.
    pub touchy: &'a [u8],
    /// Entries that can be written and are no settings.
    pub states: &'a [u8],
    /// Entries that hosts know by what they are for.
    pub roles: &'a [(u8, Role)],
}

/// The parameters of a table.
pub(crate) fn settings(kind: &Kind<'_>) -> Vec<Setting> {
    kind.table.iter().map(|entry| setting(kind, entry)).collect()
}

fn setting(kind: &Kind<'_>, entry: &'static Parameter) -> Setting {
    let (access, about) = (entry.access, &entry.about);
    let range = match (entry.low, entry.high) {
        (low, high) if high < low => (0, u32::MAX.into()),
        (low, high) => (low.into(), high.into()),
    };
    let group = kind.groups.iter().find(|(last, _)| entry.number <= *last);
    Setting {
        id: (kind.id)(entry.number),
        group: group.map_or("", |(_, name)| *name),
        axis: kind.axis,
        name: about.name.into(),
        symbol: about.symbol.into(),
        unit: about.unit,
        text: about.text,
        section: kind.section,
        range: access.writable().then_some(range),
        default: access.writable().then(|| entry.default.into()),
        decimals: 0,
        readable: true,
        writable: access.writable(),
        stored: access.storable() || access.automatic(),
        stores_itself: access.automatic(),
        is_text: false,
        is_touchy: kind.touchy.contains(&entry.number),
        role: kind.roles.iter().find(|(number, _)| *number == entry.number).map(|(_, role)| *role),
        is_setting: access.writable() && !kind.states.contains(&entry.number),
    }
}

/// The commands that a host can send.
pub fn commands() -> Vec<Usage> {
    TABLE.iter().filter(|entry| entry.allows(Mode::Direct)).map(usage).collect()
}

fn usage(entry: &'static Instruction) -> Usage {
    let name = entry.mnemonic.map_or_else(|| format!("{}", entry.opcode), Into::into);
    Usage {
        syntax: syntax(&name, entry),
        name,
        text: entry.doc.summary,
        example: entry.doc.example,
        section: entry.doc.section,
        unit: "",
    }
}

/// How a command is written; one without a mnemonic is written with its four numbers.
fn syntax(name: &str, entry: &Instruction) -> String {
    if entry.mnemonic.is_none() {
        return format!("{name}, type, motor, value");
    }
    entry.form().replace(['<', '>'], "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pd42;

    #[test]
    fn ids_and_access() {
        let all = (pd42::guide::GUIDE.settings)();
        let check = |id: &str, symbol: &str, group: &str, writable: bool, stored: bool| {
            let it = all.iter().find(|it| it.id == id).unwrap_or_else(|| panic!("no {id}"));
            assert_eq!((it.symbol.as_str(), it.group), (symbol, group), "{id}");
            assert_eq!((it.writable, it.stored), (writable, stored), "{id}");
        };
        check("AP4.0", "APMaxPositioningSpeed", "Motion", true, true);
        check("AP3.0", "APActualSpeed", "Motion", false, false);
        check("AP206.0", "APActualLoadValue", "Encoders and errors", false, false);
        check("GP66", "GPSerialAddress", "Interfaces", true, true);
        check("GP0.3", "GPTimer0Period", "Interrupts", true, false);
        check("GP55.2", "V55", "Variables", true, true);
        check("GP255.2", "V255", "Variables", true, false);
        let touchy: Vec<_> = all.iter().filter(|it| it.is_touchy).map(|it| it.id.as_str()).collect();
        assert_eq!(touchy, ["AP207.0", "GP133"]);
        let states: Vec<_> =
            all.iter().filter(|it| it.writable && !it.is_setting).map(|it| it.id.as_str()).collect();
        assert_eq!(states, ["AP0.0", "AP1.0", "AP2.0", "AP138.0", "AP209.0", "AP216.0", "GP132"]);
        let roles: Vec<_> = all.iter().filter_map(|it| Some((it.id.as_str(), it.role?))).collect();
        let expected = [
            ("AP4.0", Role::HighSpeed),
            ("AP5.0", Role::Acceleration),
            ("AP140.0", Role::Microsteps),
            ("AP153.0", Role::RampDivisor),
            ("AP154.0", Role::PulseDivisor),
        ];
        assert_eq!(roles, expected);
    }

    #[test]
    fn syntax_of_commands() {
        let all = commands();
        let check = |name: &str, expected: &str| {
            let it = all.iter().find(|it| it.name == name).unwrap_or_else(|| panic!("no {name}"));
            assert_eq!(it.syntax, expected);
        };
        check("MVP", "MVP ABS|REL|COORD, motor, position");
        check("GAP", "GAP parameter, motor");
        check("GIV", "GIV");
        check("GCO", "GCO coordinate, motor, [value]");
        check("136", "136, type, motor, value");
        assert!(all.iter().all(|it| it.name != "JA"), "only in programs");
    }
}
