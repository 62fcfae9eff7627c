//! How a parameter is named.

use std::{fmt, str::FromStr};

/// Most characters of a name.
const MAX_NAME: usize = 16;

/// Which parameter is meant.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// An axis parameter of a TMCL module, as `AP4.0`: number and motor.
    Axis {
        /// Its number.
        number: u8,
        /// The motor.
        motor: u8,
    },
    /// A global parameter of a TMCL module, as `GP66` of bank 0 or `GP42.2` of another.
    Global {
        /// Its number.
        number: u8,
        /// The bank.
        bank: u8,
    },
    /// A command of an ASCII controller that has a value, with its axis or number, as `HSPDX` or `V12`.
    Command(String),
}

/// A name that no parameter can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeyError;

impl FromStr for Key {
    type Err = KeyError;

    fn from_str(name: &str) -> Result<Self, KeyError> {
        let number = |text: &str| text.parse::<u8>().map_err(|_| KeyError);
        let starts = |prefix: &str| {
            name.strip_prefix(prefix).filter(|rest| rest.starts_with(|letter: char| letter.is_ascii_digit()))
        };
        if let Some(rest) = starts("AP") {
            let (parameter, motor) = rest.split_once('.').ok_or(KeyError)?;
            return Ok(Self::Axis { number: number(parameter)?, motor: number(motor)? });
        }
        if let Some(rest) = starts("GP") {
            let (parameter, bank) = rest.split_once('.').unwrap_or((rest, "0"));
            return Ok(Self::Global { number: number(parameter)?, bank: number(bank)? });
        }
        let letters = name.starts_with(|letter: char| letter.is_ascii_uppercase());
        let plain = name.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit());
        if letters && plain && name.len() <= MAX_NAME {
            Ok(Self::Command(name.into()))
        } else {
            Err(KeyError)
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axis { number, motor } => write!(f, "AP{number}.{motor}"),
            Self::Global { number, bank: 0 } => write!(f, "GP{number}"),
            Self::Global { number, bank } => write!(f, "GP{number}.{bank}"),
            Self::Command(name) => f.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        let check = |name: &str, expected: Key| {
            assert_eq!(name.parse(), Ok(expected.clone()), "{name}");
            assert_eq!(expected.to_string(), name);
        };
        check("AP4.0", Key::Axis { number: 4, motor: 0 });
        check("GP66", Key::Global { number: 66, bank: 0 });
        check("GP42.2", Key::Global { number: 42, bank: 2 });
        check("HSPDX", Key::Command("HSPDX".into()));
        check("V12", Key::Command("V12".into()));
        check("AP", Key::Command("AP".into()));
    }

    #[test]
    fn what_is_no_name() {
        for name in
            ["", "AP4", "AP256.0", "AP4.x", "GP1.2.3", "hspd", "V=5", "PX\r", "1A", "X 1", &"V".repeat(17)]
        {
            assert_eq!(name.parse::<Key>(), Err(KeyError), "{name}");
        }
    }
}
