//! From a line to the command that it means.

use super::command::{Command, Form};
use super::refusal::Refusal;
use motion::Direction;

/// The most axes that a controller of this language has.
pub const MAX_AXES: usize = 4;

/// A line as a command of a table.
#[derive(Clone, Copy, Debug)]
pub struct Parsed<'a, I: 'static> {
    /// The entry.
    pub command: &'static Command<I>,
    /// The axis, if one was named.
    pub axis: Option<usize>,
    /// The number after the name, if there is one.
    pub index: Option<u16>,
    /// The direction, if one was given.
    pub way: Option<Direction>,
    /// The targets, by axis.
    pub targets: [Option<i32>; MAX_AXES],
    /// What stands after `=`.
    pub value: Option<&'a str>,
}

/// Finds the command that a line means. `axes` are the letters of the axes, in order.
///
/// # Errors
/// [`Refusal::Unknown`], [`Refusal::Index`] for a number after a name that is out of its range, and
/// [`Refusal::Value`] for a target that is no 32-bit number.
pub fn parse<'a, I>(
    table: &'static [Command<I>],
    axes: &str,
    line: &'a str,
) -> Result<Parsed<'a, I>, Refusal> {
    let (left, value) = match line.split_once('=') {
        Some((left, value)) => (left, Some(value)),
        None => (line, None),
    };
    let mut refusal = Refusal::Unknown;
    for command in table {
        let takes = if value.is_some() { command.value.can_set() } else { command.value.can_ask() };
        let Some(rest) = left.strip_prefix(command.name).filter(|_| takes) else { continue };
        let mut parsed =
            Parsed { command, axis: None, index: None, way: None, targets: [None; MAX_AXES], value };
        match parsed.suffix(rest, axes) {
            Ok(true) => return Ok(parsed),
            Ok(false) => {}
            Err(error) => refusal = error,
        }
    }
    Err(refusal)
}

impl<I> Parsed<'_, I> {
    /// Takes what follows the name; `false` if it is not of the command's form.
    fn suffix(&mut self, rest: &str, axes: &str) -> Result<bool, Refusal> {
        let axis = |letter: &str| letter.chars().next().and_then(|letter| axes.find(letter));
        let is_axis = |text: &str| text.len() == 1 && axis(text).is_some();
        match self.command.form {
            Form::Bare => return Ok(rest.is_empty()),
            Form::MaybeAxis if rest.is_empty() => {}
            Form::Axis | Form::MaybeAxis => {
                if !is_axis(rest) {
                    return Ok(false);
                }
                self.axis = axis(rest);
            }
            Form::MaybeIndex(..) if rest.is_empty() => {}
            Form::Index(low, high) | Form::MaybeIndex(low, high) => {
                if rest.is_empty() || !rest.bytes().all(|byte| byte.is_ascii_digit()) {
                    return Ok(false);
                }
                let index = rest.parse().ok().filter(|index| (low..=high).contains(index));
                self.index = Some(index.ok_or(Refusal::Index)?);
            }
            Form::Way | Form::MaybeWay => {
                let Some((letter, sign)) = rest.split_at_checked(rest.len().wrapping_sub(1)) else {
                    return Ok(false);
                };
                self.way = match sign {
                    "+" => Some(Direction::Positive),
                    "-" => Some(Direction::Negative),
                    _ => return Ok(false),
                };
                if letter.is_empty() {
                    return Ok(self.command.form == Form::MaybeWay);
                }
                self.axis = axis(letter);
                return Ok(is_axis(letter));
            }
            Form::AxisNumber => {
                let Some((letter, number)) = rest.split_at_checked(1) else { return Ok(false) };
                let (true, Some(place)) = (is_number(number), axis(letter)) else { return Ok(false) };
                self.axis = Some(place);
                self.targets[place] = Some(number.parse().map_err(|_| Refusal::Value)?);
            }
            Form::Targets => return self.take_targets(rest, axes),
            Form::Each => {
                let count = rest.split(':').count();
                if count != axes.len() || !rest.split(':').all(is_number) {
                    return Ok(false);
                }
                for (target, number) in self.targets.iter_mut().zip(rest.split(':')) {
                    *target = Some(number.parse().map_err(|_| Refusal::Value)?);
                }
            }
        }
        Ok(true)
    }

    fn take_targets(&mut self, mut rest: &str, axes: &str) -> Result<bool, Refusal> {
        let mut numbers = [None; MAX_AXES];
        while let Some(letter) = rest.chars().next() {
            let Some(place) = axes.find(letter) else { return Ok(false) };
            let after = &rest[letter.len_utf8()..];
            let end = after.find(|letter| axes.contains(letter)).unwrap_or(after.len());
            let (number, next) = after.split_at(end);
            if !is_number(number) || numbers[place].replace(number).is_some() {
                return Ok(false);
            }
            rest = next;
        }
        for (target, number) in self.targets.iter_mut().zip(numbers) {
            *target = number.map(str::parse).transpose().map_err(|_| Refusal::Value)?;
        }
        Ok(self.targets.iter().any(Option::is_some))
    }

    /// The axis, index above the least, or 0: which of the command's values is meant, if it has one for
    /// each. `None` for the value of all axes or inputs.
    pub fn place(&self) -> Option<usize> {
        match self.command.form {
            Form::Index(low, _) | Form::MaybeIndex(low, _) => {
                self.index.map(|index| usize::from(index - low))
            }
            _ => self.axis,
        }
    }

    /// What stands after `=` as a number, without its point.
    ///
    /// # Errors
    /// [`Refusal::Value`] if it is none or out of the command's range.
    pub fn number(&self) -> Result<i32, Refusal> {
        let text = self.value.ok_or(Refusal::Value)?;
        let number = fixed(text, self.command.value.decimals()).ok_or(Refusal::Value)?;
        match self.command.value.range() {
            Some((low, high)) if (low..=high).contains(&number) => Ok(number),
            _ => Err(Refusal::Value),
        }
    }
}

/// A number with at most so many digits after its point, as if it had no point.
fn fixed(text: &str, decimals: u8) -> Option<i32> {
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    let room = usize::from(decimals);
    if !is_number(whole) || part.len() > room || !part.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let scale = 10i64.pow(decimals.into());
    let missing = 10i64.pow((room - part.len()) as u32);
    let part = if part.is_empty() { 0 } else { part.parse::<i64>().ok()? * missing };
    let part = if whole.starts_with('-') { -part } else { part };
    i64::from(whole.parse::<i32>().ok()?).checked_mul(scale)?.checked_add(part)?.try_into().ok()
}

/// Digits, perhaps with a sign before.
fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pmx2ed::table::{AXES, COMMANDS, Id};

    fn meant(line: &str) -> Result<Parsed<'_, Id>, Refusal> {
        parse(COMMANDS, AXES, line)
    }

    #[test]
    fn every_example_means_its_entry() {
        for command in COMMANDS {
            let parsed = meant(command.about.example).expect(command.about.example);
            assert_eq!(parsed.command.id, command.id, "{}", command.about.example);
        }
    }

    #[test]
    fn what_follows_the_name() {
        let check = |line, id, place, value| {
            let parsed = meant(line).expect(line);
            assert_eq!((parsed.command.id, parsed.place(), parsed.value), (id, place, value), "{line}");
        };
        check("ACC", Id::Acceleration, None, None);
        check("ACC=5", Id::Acceleration, None, Some("5"));
        check("ACCY=", Id::Acceleration, Some(1), Some(""));
        check("DI", Id::Inputs, None, None);
        check("DI8", Id::Inputs, Some(7), None);
        check("DO8=1", Id::Output, Some(7), Some("1"));
        check("V0", Id::Variable, Some(0), None);
        check("SA1274=a=b", Id::ProgramLine, Some(1274), Some("a=b"));
        check("SLX", Id::Loop, Some(0), None);
        check("SLSX", Id::LoopStatus, Some(0), None);
        check("SLOAD", Id::RunOnBoot, None, None);
        check("LX-", Id::LimitHome, Some(0), None);
        check("LCAX", Id::LimitCorrection, Some(0), None);
        check("HY+", Id::Home, Some(1), None);
        check("HLY+", Id::HomeLow, Some(1), None);
        check("EX", Id::Encoder, Some(0), None);
        check("EO1", Id::Enable, Some(0), None);
        check("JO", Id::JoystickOn, None, None);
        check("JO=1", Id::JoystickMask, None, Some("1"));
        check("J-", Id::Jog, None, None);
        check("TOC", Id::TimeOut, None, None);
        check("TY-5", Id::Target, Some(1), None);
    }

    #[test]
    fn directions_and_targets() {
        let way = |line| meant(line).map(|parsed| parsed.way);
        assert_eq!(way("JX+"), Ok(Some(Direction::Positive)));
        assert_eq!(way("ZHY-"), Ok(Some(Direction::Negative)));
        let check = |line, x, y| {
            let targets = meant(line).expect(line).targets;
            assert_eq!(targets, [x, y, None, None], "{line}");
        };
        check("X5", Some(5), None);
        check("Y-5", None, Some(-5));
        check("X+5Y6", Some(5), Some(6));
        check("Y6X5", Some(5), Some(6));
        check("I-1:2147483647", Some(-1), Some(i32::MAX));
        check("TX-2147483648", Some(i32::MIN), None);
    }

    #[test]
    fn what_is_no_command() {
        let check = |line, refusal| assert_eq!(meant(line).map(|it| it.command.id), Err(refusal), "{line}");
        for line in
            ["", "X", "XX", "X1X2", "x1", "X1Z2", "I1", "I1:2:3", "PZ", "JX", "T5", "ID=1", "SSPDX", "VER1"]
        {
            check(line, Refusal::Unknown);
        }
        for line in ["DI0", "DO9=1", "V64", "V70000", "SA1275", "GS32", "AI3"] {
            check(line, Refusal::Index);
        }
        for line in ["X2147483648", "I0:99999999999", "TX-2147483649"] {
            check(line, Refusal::Value);
        }
    }

    #[test]
    fn numbers() {
        let check = |line, number| assert_eq!(meant(line).and_then(|it| it.number()), number, "{line}");
        check("V1=-2147483648", Ok(i32::MIN));
        check("V1=+7", Ok(7));
        check("V1=2147483648", Err(Refusal::Value));
        check("V1=", Err(Refusal::Value));
        check("V1=1.5", Err(Refusal::Value));
        check("V1=0x10", Err(Refusal::Value));
        check("V1= 1", Err(Refusal::Value));
        check("EO=3", Ok(3));
        check("EO=4", Err(Refusal::Value));
        check("SLRX=2.5", Ok(2500));
        check("SLRX=0.001", Ok(1));
        check("SLRX=999.999", Ok(999_999));
        check("SLRX=3", Ok(3000));
        check("SLRX=1.", Ok(1000));
        for line in ["SLRX=0", "SLRX=1000", "SLRX=0.0001", "SLRX=.5", "SLRX=-1", "SLRX=1.2.3", "SLRX=9999999"]
        {
            check(line, Err(Refusal::Value));
        }
    }
}
