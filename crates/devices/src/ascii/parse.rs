//! From a line to the command that it means.

use super::command::{Command, Form};
use motion::Direction;
use motion::path::Turn;

/// The most axes that a controller of this language has.
pub const MAX_AXES: usize = 4;

/// The most numbers with `:` between.
pub const MAX_NUMBERS: usize = 4;

/// Why a line means no command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParseError {
    /// There is no such command.
    Unknown,
    /// The number after the name is out of range.
    Index,
    /// A value is out of range, or no number.
    Value,
}

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
    /// The axes of a plane, and which way to turn in it.
    pub plane: Option<([usize; 2], Turn)>,
    /// Numbers with `:` between; the form says how many.
    pub numbers: [i32; MAX_NUMBERS],
    /// What stands after `=`.
    pub value: Option<&'a str>,
}

/// Finds the command that a line means. `axes` are the letters of the axes, in order.
///
/// # Errors
/// [`ParseError::Unknown`], [`ParseError::Index`] for a number after a name that is out of its range, and
/// [`ParseError::Value`] for a target that is no 32-bit number.
pub fn parse<'a, I>(
    table: &'static [Command<I>],
    axes: &str,
    line: &'a str,
) -> Result<Parsed<'a, I>, ParseError> {
    let (left, value) = match line.split_once('=') {
        Some((left, value)) => (left, Some(value)),
        None => (line, None),
    };
    let mut error = ParseError::Unknown;
    // Nearly all entries are out with their first letter.
    let first = left.bytes().next();
    for command in table.iter().filter(|it| it.name.is_empty() || it.name.bytes().next() == first) {
        let takes = if value.is_some() { command.value.can_set() } else { command.value.can_ask() };
        let Some(rest) = left.strip_prefix(command.name).filter(|_| takes) else { continue };
        let mut parsed = Parsed {
            command,
            axis: None,
            index: None,
            way: None,
            targets: [None; MAX_AXES],
            plane: None,
            numbers: [0; MAX_NUMBERS],
            value,
        };
        match parsed.suffix(rest, axes) {
            Ok(true) => return Ok(parsed),
            Ok(false) => {}
            Err(found) => error = found,
        }
    }
    Err(error)
}

impl<I> Parsed<'_, I> {
    /// Takes what follows the name; `false` if it is not of the command's form.
    fn suffix(&mut self, rest: &str, axes: &str) -> Result<bool, ParseError> {
        match self.command.form {
            Form::Bare => return Ok(rest.is_empty()),
            Form::MaybeAxis | Form::AxisOrEach if rest.is_empty() => {}
            Form::AxisOrFirst if rest.is_empty() => self.axis = Some(0),
            Form::Axis | Form::MaybeAxis | Form::AxisOrFirst | Form::AxisOrEach => {
                let Some((axis, "")) = take_axis(rest, axes) else { return Ok(false) };
                self.axis = Some(axis);
            }
            Form::AxisOf(count) => {
                let Some((axis, "")) = take_axis(rest, axes) else { return Ok(false) };
                self.axis = Some(axis);
                return Ok(axis < count.into());
            }
            Form::MaybeIndex(..) if rest.is_empty() => {}
            Form::Index(low, high) | Form::MaybeIndex(low, high) => {
                return self.take_index(rest, low, high);
            }
            Form::Way | Form::MaybeWay => {
                let (axis, rest) = match take_axis(rest, axes) {
                    Some((axis, rest)) => (Some(axis), rest),
                    None => (None, rest),
                };
                let Some((way, "")) = take_way(rest) else { return Ok(false) };
                (self.axis, self.way) = (axis, Some(way));
                return Ok(axis.is_some() || self.command.form == Form::MaybeWay);
            }
            Form::WayMode(low, high) => {
                let Some((axis, rest)) = take_axis(rest, axes) else { return Ok(false) };
                let Some((way, rest)) = take_way(rest) else { return Ok(false) };
                (self.axis, self.way) = (Some(axis), Some(way));
                return self.take_index(rest, low.into(), high.into());
            }
            Form::AxisNumber => {
                let Some((axis, number)) = take_axis(rest, axes) else { return Ok(false) };
                if !is_number(number) {
                    return Ok(false);
                }
                self.axis = Some(axis);
                self.targets[axis] = Some(number.parse().map_err(|_| ParseError::Value)?);
            }
            Form::Targets => return self.take_targets(rest, axes),
            Form::Numbers(count) => return self.take_numbers(rest, count),
            Form::Plane(count) => {
                let Some((first, rest)) = take_axis(rest, axes) else { return Ok(false) };
                let Some((second, rest)) = take_axis(rest, axes) else { return Ok(false) };
                let Some((turn, rest)) = take_turn(rest).filter(|_| first != second) else {
                    return Ok(false);
                };
                self.plane = Some(([first, second], turn));
                return self.take_numbers(rest, count);
            }
            Form::Helix(count) => {
                let Some((turn, rest)) = take_turn(rest) else { return Ok(false) };
                self.plane = Some(([0, 1], turn));
                return self.take_numbers(rest, count);
            }
        }
        Ok(true)
    }

    fn take_index(&mut self, rest: &str, low: u16, high: u16) -> Result<bool, ParseError> {
        if rest.is_empty() || !rest.bytes().all(|byte| byte.is_ascii_digit()) {
            return Ok(false);
        }
        let index = rest.parse().ok().filter(|index| (low..=high).contains(index));
        self.index = Some(index.ok_or(ParseError::Index)?);
        Ok(true)
    }

    fn take_numbers(&mut self, rest: &str, count: u8) -> Result<bool, ParseError> {
        if rest.split(':').count() != usize::from(count) || !rest.split(':').all(is_number) {
            return Ok(false);
        }
        for (number, text) in self.numbers.iter_mut().zip(rest.split(':')) {
            *number = text.parse().map_err(|_| ParseError::Value)?;
        }
        Ok(true)
    }

    fn take_targets(&mut self, mut rest: &str, axes: &str) -> Result<bool, ParseError> {
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
            *target = number.map(str::parse).transpose().map_err(|_| ParseError::Value)?;
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
    /// [`ParseError::Value`] if it is none or out of the command's range.
    pub fn number(&self) -> Result<i32, ParseError> {
        let text = self.value.ok_or(ParseError::Value)?;
        let number = fixed(text, self.command.value.decimals()).ok_or(ParseError::Value)?;
        match self.command.value.range() {
            Some((low, high)) if (low..=high).contains(&number) => Ok(number),
            _ => Err(ParseError::Value),
        }
    }
}

/// Takes the letter of an axis.
fn take_axis<'a>(text: &'a str, axes: &str) -> Option<(usize, &'a str)> {
    let letter = text.chars().next()?;
    Some((axes.find(letter)?, &text[letter.len_utf8()..]))
}

/// Takes a direction.
fn take_way(text: &str) -> Option<(Direction, &str)> {
    match text.split_at_checked(1)? {
        ("+", rest) => Some((Direction::Positive, rest)),
        ("-", rest) => Some((Direction::Negative, rest)),
        _ => None,
    }
}

/// Takes which way to turn.
fn take_turn(text: &str) -> Option<(Turn, &str)> {
    match text.split_at_checked(1)? {
        ("P", rest) => Some((Turn::Clockwise, rest)),
        ("N", rest) => Some((Turn::CounterClockwise, rest)),
        _ => None,
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
    use crate::cmd4cr::table as cmd;
    use crate::pmx2ed::table::{AXES, COMMANDS, Id};
    use Direction::{Negative, Positive};
    use Turn::{Clockwise, CounterClockwise};

    fn meant(line: &str) -> Result<Parsed<'_, Id>, ParseError> {
        parse(COMMANDS, AXES, line)
    }

    /// The same with four axes and all forms.
    fn meant_by_four(line: &str) -> Result<Parsed<'_, cmd::Id>, ParseError> {
        parse(cmd::COMMANDS, cmd::AXES, line)
    }

    #[test]
    fn every_example_means_its_entry() {
        for command in COMMANDS {
            let parsed = meant(command.about.example).expect(command.about.example);
            assert_eq!(parsed.command.id, command.id, "{}", command.about.example);
        }
        for command in cmd::COMMANDS {
            let parsed = meant_by_four(command.about.example).expect(command.about.example);
            assert_eq!(parsed.command.id, command.id, "{}", command.about.example);
        }
    }

    #[test]
    fn names_that_begin_alike() {
        let check = |line, id, axis| {
            let parsed = meant_by_four(line).expect(line);
            assert_eq!((parsed.command.id, parsed.axis), (id, axis), "{line}");
        };
        check("U5", cmd::Id::Move, None);
        check("SLU", cmd::Id::Loop, Some(3));
        check("LTU=1", cmd::Id::Latch, Some(3));
        check("LTEU", cmd::Id::LatchedEncoder, Some(3));
        check("MPZ", cmd::Id::Pulser, Some(2));
        check("EP", cmd::Id::Encoders, None);
        check("PP", cmd::Id::Positions, None);
        check("JMAXY", cmd::Id::JoystickMax, Some(1));
        check("SLOAD=3", cmd::Id::RunOnBoot, None);
        check("SLOAD3=1", cmd::Id::RunsOnBoot, None);
        check("SYNO", cmd::Id::SyncOn, Some(0));
        check("SSPD=70000", cmd::Id::SetSpeed, Some(0));
        check("SSPDM=2", cmd::Id::SpeedMode, Some(0));
        check("ERCD=2", cmd::Id::ErrorClearDelay, None);
        check("ERCDZ=2", cmd::Id::ErrorClearDelay, Some(2));
    }

    #[test]
    fn curves() {
        let check = |line, plane, numbers| {
            let parsed = meant_by_four(line).expect(line);
            assert_eq!((parsed.plane, parsed.numbers), (Some(plane), numbers), "{line}");
        };
        check("CIRXZP1000:-5", ([0, 2], Clockwise), [1000, -5, 0, 0]);
        check("CIRUYN0:0", ([3, 1], CounterClockwise), [0; 4]);
        check("ARCXYN-1:2:90000", ([0, 1], CounterClockwise), [-1, 2, 90_000, 0]);
        check("CIRTP1:2:3", ([0, 1], Clockwise), [1, 2, 3, 0]);
        check("ARCTN1:2:3:4", ([0, 1], CounterClockwise), [1, 2, 3, 4]);
    }

    #[test]
    fn homing_modes() {
        let check = |line, axis, way, mode| {
            let parsed = meant_by_four(line).expect(line);
            let found = (parsed.axis, parsed.way, parsed.index);
            assert_eq!(found, (Some(axis), Some(way), Some(mode)), "{line}");
        };
        check("HX+0", 0, Positive, 0);
        check("HU-12", 3, Negative, 12);
    }

    #[test]
    fn what_is_no_command_of_four_axes() {
        let check = |line, error| {
            assert_eq!(meant_by_four(line).map(|it| it.command.id), Err(error), "{line}");
        };
        for line in [
            "CLR",
            "CLRV",
            "JMAXZ",
            "JMAX",
            "J+",
            "JX",
            "HX+",
            "H-1",
            "HX1",
            "HX+-1",
            "CIRXXP1:2",
            "CIRXP1:2",
            "CIRXYA1:2",
            "CIRXYP1",
            "CIRXYP1:2:3",
            "CIRXYP1:2:",
            "ARCXYP1:2",
            "ARCTP1:2:3",
            "ARCT1:2:3:4",
            "I1:2:3",
            "I1:2:3:4:5",
            "I1:2:3:",
            "SYNF",
            "EP=1",
            "X1Y2X3",
            "SSPD",
            "DN",
            "ABS1",
        ] {
            check(line, ParseError::Unknown);
        }
        for line in
            ["HX+13", "HX-70000", "IO0", "IO33", "DO5=1", "V100", "GS32", "SLOAD4=1", "PWM3", "SACTRL4=1"]
        {
            check(line, ParseError::Index);
        }
        for line in ["CIRXYP1:2147483648", "I1:2:3:2147483648", "ARCTP-2147483649:1:1:1"] {
            check(line, ParseError::Value);
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
        assert_eq!(way("JX+"), Ok(Some(Positive)));
        assert_eq!(way("ZHY-"), Ok(Some(Negative)));
        let numbers = meant("I-1:2147483647").map(|line| line.numbers);
        assert_eq!(numbers, Ok([-1, i32::MAX, 0, 0]));
        let check = |line, x, y| {
            let targets = meant(line).expect(line).targets;
            assert_eq!(targets, [x, y, None, None], "{line}");
        };
        check("X5", Some(5), None);
        check("Y-5", None, Some(-5));
        check("X+5Y6", Some(5), Some(6));
        check("Y6X5", Some(5), Some(6));
        check("TX-2147483648", Some(i32::MIN), None);
    }

    #[test]
    fn what_is_no_command() {
        let check = |line, refusal| assert_eq!(meant(line).map(|it| it.command.id), Err(refusal), "{line}");
        for line in
            ["", "X", "XX", "X1X2", "x1", "X1Z2", "I1", "I1:2:3", "PZ", "JX", "T5", "ID=1", "SSPDX", "VER1"]
        {
            check(line, ParseError::Unknown);
        }
        for line in ["DI0", "DO9=1", "V64", "V70000", "SA1275", "GS32", "AI3"] {
            check(line, ParseError::Index);
        }
        for line in ["X2147483648", "I0:99999999999", "TX-2147483649"] {
            check(line, ParseError::Value);
        }
    }

    #[test]
    fn numbers() {
        let check = |line, number| assert_eq!(meant(line).and_then(|it| it.number()), number, "{line}");
        check("V1=-2147483648", Ok(i32::MIN));
        check("V1=+7", Ok(7));
        check("V1=2147483648", Err(ParseError::Value));
        check("V1=", Err(ParseError::Value));
        check("V1=1.5", Err(ParseError::Value));
        check("V1=0x10", Err(ParseError::Value));
        check("V1= 1", Err(ParseError::Value));
        check("EO=3", Ok(3));
        check("EO=4", Err(ParseError::Value));
        check("SLRX=2.5", Ok(2500));
        check("SLRX=0.001", Ok(1));
        check("SLRX=999.999", Ok(999_999));
        check("SLRX=3", Ok(3000));
        check("SLRX=1.", Ok(1000));
        for line in ["SLRX=0", "SLRX=1000", "SLRX=0.0001", "SLRX=.5", "SLRX=-1", "SLRX=1.2.3", "SLRX=9999999"]
        {
            check(line, Err(ParseError::Value));
        }
    }
}
