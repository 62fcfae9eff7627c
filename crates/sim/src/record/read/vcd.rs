//! Waveforms. Of an axis its counters and speed are read, not its step wire, so that a plot is that of the other
//! formats.

use super::{MAX_SECONDS, NS_PER_SECOND, Problem, mark, note};
use crate::record::{Plot, vcd::SAMPLE_MS};
use motion::Ticks;
use std::{collections::BTreeMap, io::BufRead};
use vcd::{Command, IdCode, Parser, Value, Vector};

/// How long a counter has surely kept its value when it changes: they are looked at so often.
const SAMPLE_NS: Ticks = SAMPLE_MS * 1_000_000;

/// What a variable is.
#[derive(Clone, Copy)]
enum Meaning {
    Position(usize),
    Encoder(usize),
    Speed(usize),
    Pin(usize),
}

/// An axis as it was sampled last.
#[derive(Clone, Copy, Default)]
struct Sample {
    at: Ticks,
    position: f64,
    /// `None` if the file has none.
    encoder: Option<f64>,
    speed: f64,
    /// It has changed since it was put into the plot.
    is_new: bool,
}

impl Sample {
    fn put(&self, plot: &mut Plot, at: Ticks, axis: usize) {
        plot.sample(at, axis, self.position, self.speed);
        self.encoder.into_iter().for_each(|encoder| plot.encoder(at, axis, self.position, encoder));
    }
}

struct Waveforms {
    plot: Plot,
    scopes: Vec<String>,
    units: BTreeMap<String, String>,
    variables: BTreeMap<IdCode, Meaning>,
    axes: Vec<Sample>,
    /// The values of pins at the beginning. A dump begins with values that only say which variables there are.
    first: BTreeMap<usize, f64>,
    now: Ticks,
    /// Nanoseconds of a step of time.
    step_ns: f64,
}

pub(super) fn read(input: &mut impl BufRead, title: &str) -> Result<Plot, Problem> {
    let mut parser = Parser::new(input);
    let mut waveforms = Waveforms {
        plot: Plot::new(title, NS_PER_SECOND, 0),
        scopes: Vec::new(),
        units: BTreeMap::new(),
        variables: BTreeMap::new(),
        axes: Vec::new(),
        first: BTreeMap::new(),
        now: 0,
        step_ns: 1.0,
    };
    while let Some(command) = parser.next() {
        // The parser says the line in its message.
        let command = command?;
        waveforms.take(command).map_err(|text| Problem::at(parser.line(), text))?;
    }
    if waveforms.variables.is_empty() {
        return Err("there are no axes and no pins of a recording in it".into());
    }
    waveforms.settle();
    Ok(waveforms.plot)
}

impl Waveforms {
    fn take(&mut self, command: Command) -> Result<(), String> {
        match command {
            Command::ScopeDef(_, name) => {
                if self.scopes.is_empty() {
                    self.plot.set_title(&name);
                }
                self.scopes.push(name);
            }
            Command::Upscope => drop(self.scopes.pop()),
            Command::Timescale(steps, unit) => {
                self.step_ns = f64::from(steps) * f64::from(NS_PER_SECOND) / unit.divisor() as f64;
            }
            Command::Comment(text) => self.comment(&text),
            Command::VarDef(_, _, code, name, _) => self.define(code, &name)?,
            Command::Timestamp(at) => {
                let at = at as f64 * self.step_ns;
                if at > MAX_SECONDS * f64::from(NS_PER_SECOND) {
                    return Err(format!("a change at {at} ns"));
                }
                if at as Ticks > self.now {
                    self.settle();
                    self.now = at as Ticks;
                }
            }
            Command::ChangeScalar(code, value) => self.change(code, f64::from(u8::from(value == Value::V1))),
            Command::ChangeVector(code, value) => self.change(code, counter(&value)),
            Command::ChangeReal(code, value) if value.is_finite() => self.change(code, value),
            _ => {}
        }
        Ok(())
    }

    /// Units before the first change, events behind it.
    fn comment(&mut self, text: &str) {
        let mut words = text.trim().splitn(3, ' ');
        let (Some(kind), Some(first)) = (words.next(), words.next()) else { return };
        let rest = words.next().unwrap_or_default();
        if kind == "unit" {
            self.units.insert(first.into(), rest.into());
        } else if kind == "axis"
            && let Some(mark) = mark(rest)
            && let Some(axis) = self.plot.axis(first)
        {
            self.axes.resize(self.axes.len().max(axis + 1), Sample::default());
            self.plot.mark(self.now, axis, mark);
        } else if kind == "event"
            && let Some(note) = note(first)
        {
            self.plot.note(self.now, note, rest);
        }
    }

    fn define(&mut self, code: IdCode, name: &str) -> Result<(), String> {
        let Some(scope) = self.scopes.last() else { return Ok(()) };
        let meaning = if let Some(axis) = scope.strip_prefix("axis_") {
            let quantity = name.strip_suffix(axis).and_then(|name| name.strip_suffix('_'));
            let number = self.plot.axis(axis).ok_or("too many axes")?;
            self.axes.resize(self.axes.len().max(number + 1), Sample::default());
            match quantity {
                Some("position") => Meaning::Position(number),
                Some("encoder") => Meaning::Encoder(number),
                Some("speed") => Meaning::Speed(number),
                _ => return Ok(()),
            }
        } else if scope == "pins" {
            let unit = self.units.get(name).map_or("", String::as_str);
            Meaning::Pin(self.plot.pin(name, unit).ok_or("too many pins")?)
        } else {
            return Ok(());
        };
        self.variables.insert(code, meaning);
        Ok(())
    }

    fn change(&mut self, code: IdCode, value: f64) {
        match self.variables.get(&code) {
            Some(Meaning::Pin(pin)) if self.now == 0 => drop(self.first.insert(*pin, value)),
            Some(Meaning::Pin(pin)) => self.plot.level(self.now, *pin, value),
            Some(Meaning::Position(axis)) => self.sample(*axis).position = value,
            Some(Meaning::Encoder(axis)) => self.sample(*axis).encoder = Some(value),
            Some(Meaning::Speed(axis)) => self.sample(*axis).speed = value,
            None => {}
        }
    }

    /// The sample of an axis, which is about to change. Until then it was as it was.
    fn sample(&mut self, axis: usize) -> &mut Sample {
        let sample = &mut self.axes[axis];
        if !sample.is_new && self.now > sample.at + SAMPLE_NS {
            sample.put(&mut self.plot, self.now - SAMPLE_NS, axis);
        }
        (sample.at, sample.is_new) = (self.now, true);
        sample
    }

    /// All changes of this time have been told.
    fn settle(&mut self) {
        for (pin, value) in std::mem::take(&mut self.first) {
            self.plot.level(self.now, pin, value);
        }
        for (axis, sample) in self.axes.iter_mut().enumerate() {
            if std::mem::take(&mut sample.is_new) {
                sample.put(&mut self.plot, sample.at, axis);
            }
        }
        self.plot.finish(self.now);
    }
}

/// The number that a counter's wires are.
fn counter(value: &Vector) -> f64 {
    let bits = value.iter().fold(0_u32, |bits, wire| bits << 1 | u32::from(wire == Value::V1));
    f64::from(bits as i32)
}
