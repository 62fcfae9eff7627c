//! The commands, one entry each.

use super::{Console, show};
use crate::{Direction, Goal, code::Place};
use sim::tape::Act;
use std::fmt::Write as _;

/// A command.
pub struct Command {
    /// Its name.
    pub name: &'static str,
    /// The same in short.
    pub short: &'static str,
    /// What it takes.
    pub arguments: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Whether an empty line does it again.
    pub repeats: bool,
    /// What it says, or what is wrong.
    pub(super) run: fn(&mut Console, &str) -> Result<String, String>,
}

/// An entry that goes somewhere.
macro_rules! goes {
    ($name:literal $short:literal $about:literal $direction:ident $goal:ident) => {
        Command {
            name: $name,
            short: $short,
            arguments: "",
            about: $about,
            repeats: true,
            run: |console, _| console.go(Direction::$direction, Goal::$goal),
        }
    };
}

/// Any other entry.
macro_rules! does {
    ($name:literal $short:literal $arguments:literal $about:literal $run:expr) => {
        Command {
            name: $name,
            short: $short,
            arguments: $arguments,
            about: $about,
            repeats: false,
            run: $run,
        }
    };
}

/// All commands.
pub const COMMANDS: &[Command] = &[
    goes!("continue" "c" "run until a breakpoint, a watch or the end" Forward End),
    goes!("step" "s" "to the next line of the program, into subroutines" Forward Into),
    goes!("next" "n" "to its next line, over subroutines" Forward Over),
    goes!("out" "o" "to the line behind the call of its routine" Forward Out),
    goes!("reverse-continue" "rc" "run backwards until a breakpoint, a watch or the start" Backward End),
    goes!("reverse-step" "rs" "to the line before, into subroutines" Backward Into),
    goes!("reverse-next" "rn" "to the line before, over subroutines" Backward Over),
    goes!("reverse-out" "ro" "to the call of the present routine" Backward Out),
    does!("until" "u" "TIME | PLACE" "run to a time from the start, as 2.5s, or to a place" until),
    does!("break" "b" "PLACE [if NAME > VALUE]" "stop before a place: LINE, FILE:LINE or LABEL" break_at),
    does!("watch" "w" "NAME" "stop when a register, parameter, variable or pin changes" watch),
    does!("delete" "d" "NUMBER" "take a breakpoint or watch away" delete),
    does!("breakpoints" "bl" "" "list breakpoints and watches" |console, _| {
        Ok(show::breakpoints(&mut console.debugger))
    }),
    does!("print" "p" "NAME..." "values of registers, parameters, variables or pins" print),
    does!("set" "" "NAME = VALUE" "set one of them as a host does, or drive an input" set),
    does!("pin" "" "NAME = VALUE | release" "drive an input, or give it back to the machine" pin),
    does!("load" "" "AXIS VALUE" "load of an axis in parts of its pull-out torque" load),
    does!("push" "" "AXIS PULSES" "turn the motor of an axis from outside" push),
    does!("send" "" "COMMAND" "send a host's command over USB" send),
    does!("variables" "v" "" "all variables that are not 0" |console, _| {
        Ok(show::variables(console.debugger.device()))
    }),
    does!("axes" "a" "" "what the axes do" |console, _| Ok(show::axes(console.debugger.device()))),
    does!("where" "bt" "" "the routines that the program is in" |console, _| {
        Ok(show::frames(&mut console.debugger))
    }),
    does!("programs" "t" "" "all programs" |console, _| Ok(show::programs(&mut console.debugger))),
    does!("program" "" "NUMBER" "look at another program" program),
    does!("list" "l" "[PLACE]" "the source around a place" list),
    does!("help" "h" "" "this list" |_, _| Ok(help())),
    does!("quit" "q" "" "leave" |console, _| {
        console.quits = true;
        Ok(String::new())
    }),
];

/// The command of this name.
pub(super) fn find(word: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|command| command.name == word || command.short == word)
}

fn help() -> String {
    let mut text = String::new();
    for Command { name, short, arguments, about, .. } in COMMANDS {
        let usage = format!("{name} {arguments}");
        writeln!(text, "{short:>3} {usage:<34} {about}").expect("a string takes everything");
    }
    text
}

/// The line that a text says, and its file; `None` is a label, or nothing.
fn line_of(console: &mut Console, text: &str) -> Result<Option<Place>, String> {
    let (file, line) = match text.rsplit_once(':') {
        Some((name, line)) => {
            let file = console.debugger.target().code.file(name);
            (file.ok_or_else(|| format!("no source is called `{name}`"))?, line)
        }
        None => {
            let program = console.debugger.program();
            (console.debugger.place(program).map_or(0, |place| place.file), text)
        }
    };
    match line.parse() {
        Ok(line) => Ok(Some(Place { file, line })),
        Err(_) if text.contains(':') => Err(format!("`{line}` is no line")),
        Err(_) => Ok(None),
    }
}

/// The place that a text says.
fn place_of(console: &mut Console, text: &str) -> Result<Place, String> {
    if let Some(place) = line_of(console, text)? {
        return Ok(place);
    }
    let code = &console.debugger.target().code;
    let place = code.label(text).and_then(|address| code.place(address));
    place.ok_or_else(|| format!("`{text}` is no line and no label"))
}

fn until(console: &mut Console, text: &str) -> Result<String, String> {
    if let Some(seconds) = text.strip_suffix('s').and_then(|text| text.trim().parse::<f64>().ok()) {
        if seconds.is_nan() || seconds < console.debugger.seconds() {
            return Err("this is in the past: `reverse-continue` goes there".into());
        }
        let clock = console.debugger.clock(seconds);
        return console.go(Direction::Forward, Goal::Clock(clock));
    }
    let place = place_of(console, text)?;
    let found = console.debugger.target().code.find(place);
    let (_, addresses) = found.ok_or_else(|| format!("there is no line of the program at {text}"))?;
    console.go(Direction::Forward, Goal::Addresses(addresses))
}

fn break_at(console: &mut Console, text: &str) -> Result<String, String> {
    let (place, condition) = match text.split_once(" if ") {
        Some((place, condition)) => (place, Some(condition)),
        None => (text, None),
    };
    let place = place_of(console, place.trim())?;
    let condition = condition.map(|text| text.parse()).transpose();
    let condition = condition.map_err(|error: crate::stop::ConditionError| error.to_string())?;
    let breakpoint = console.debugger.break_at(place, condition).map_err(|error| error.to_string())?.clone();
    Ok(show::breakpoint(&console.debugger, &breakpoint))
}

fn watch(console: &mut Console, name: &str) -> Result<String, String> {
    let watch = console.debugger.watch(name).map_err(|error| error.to_string())?;
    Ok(show::watch(watch))
}

fn delete(console: &mut Console, text: &str) -> Result<String, String> {
    let gone = text.parse().is_ok_and(|number| console.debugger.delete(number));
    if gone { Ok(String::new()) } else { Err(format!("there is no breakpoint or watch `{text}`")) }
}

fn print(console: &mut Console, names: &str) -> Result<String, String> {
    let mut text = String::new();
    for name in names.split_whitespace() {
        let value = console.debugger.value(name).ok_or_else(|| format!("nothing is called `{name}`"))?;
        writeln!(text, "{name} = {}", crate::stop::show(value)).expect("a string takes everything");
    }
    Ok(text)
}

/// A name and a value with `=` between.
fn assignment(text: &str) -> Result<(&str, &str), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME = VALUE")?;
    Ok((name.trim(), value.trim()))
}

fn set(console: &mut Console, text: &str) -> Result<String, String> {
    let (name, value) = assignment(text)?;
    console.debugger.set(name, value).map_err(|error| error.to_string())?;
    print(console, name)
}

fn pin(console: &mut Console, text: &str) -> Result<String, String> {
    let (name, value) = assignment(text)?;
    let value = match value {
        "release" => None,
        text => Some(text.parse().map_err(|_| format!("`{text}` is no value: true, false or a number"))?),
    };
    console.debugger.drive(name, value).map_err(|error| error.to_string())?;
    print(console, name)
}

/// An axis and a number.
fn axis<T: std::str::FromStr>(text: &str) -> Result<(String, T), String> {
    let wrong = || "write an axis and a number".to_owned();
    let (axis, number) = text.split_once(char::is_whitespace).ok_or_else(wrong)?;
    Ok((axis.to_uppercase(), number.trim().parse().map_err(|_| wrong())?))
}

fn load(console: &mut Console, text: &str) -> Result<String, String> {
    let (axis, load) = axis(text)?;
    console.debugger.perform(Act::Load(axis, load)).map(|_| String::new())
}

fn push(console: &mut Console, text: &str) -> Result<String, String> {
    let (axis, pulses) = axis(text)?;
    console.debugger.perform(Act::Push(axis, pulses)).map(|_| String::new())
}

fn send(console: &mut Console, text: &str) -> Result<String, String> {
    let answer = console.debugger.send(text).map_err(|error| error.to_string())?;
    Ok(answer + "\n")
}

fn program(console: &mut Console, text: &str) -> Result<String, String> {
    let known = text.parse().is_ok_and(|number| console.debugger.view(number));
    if known { Ok(show::here(&mut console.debugger)) } else { Err(format!("there is no program `{text}`")) }
}

fn list(console: &mut Console, text: &str) -> Result<String, String> {
    let program = console.debugger.program();
    let place = match text {
        "" => console.debugger.place(program).ok_or("the program has no line here")?,
        text => place_of(console, text)?,
    };
    Ok(show::list(&mut console.debugger, place))
}
