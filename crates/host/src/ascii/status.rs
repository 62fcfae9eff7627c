//! What the controller says of itself, question by question.

use super::terminal::{is_loop_error, loop_state};
use super::{Unit, malformed};
use crate::bits::{errors, flags};
use crate::error::Result;
use crate::pace::Turns;
use crate::types::{AxisStatus, Level, ProgramState, ProgramStatus, Status};
use std::{collections::BTreeMap, str::FromStr, time::Instant};

/// Bits of the status word that both families have in the same place (PMX-2ED-SA manual, table 7.2; CMD-4CR manual,
/// table 2-28).
mod bit {
    pub const ACCELERATING: u32 = 0;
    pub const DECELERATING: u32 = 1;
    pub const CONSTANT_SPEED: u32 = 2;
    pub const POSITIVE_LIMIT: u32 = 4;
    pub const NEGATIVE_LIMIT: u32 = 5;
    pub const HOME: u32 = 6;
    pub const PERFORMAX_INDEX: u32 = 9;
    pub const COMMANDER_INDEX: u32 = 13;
}

/// Digital inputs and outputs as a name and bits.
type Levels = BTreeMap<String, Level>;

/// What is asked for when it is its turn, and what was heard of it last.
#[derive(Debug, Default)]
pub(super) struct Rest {
    turns: Turns,
    loops: BTreeMap<usize, Loop>,
    enables: u32,
    absolute: Option<bool>,
    inputs: Levels,
    outputs: Levels,
    /// Where each axis was, and which way it has gone to get there.
    ways: Vec<Way>,
    programs: BTreeMap<u8, ProgramStatus>,
}

/// The way of an axis. Its speed is told without a sign.
#[derive(Clone, Copy, Debug)]
struct Way {
    position: i32,
    is_negative: bool,
}

impl Way {
    /// The way to where the axis is now.
    fn on(self, position: i32) -> Self {
        let is_negative = match position.wrapping_sub(self.position) {
            0 => self.is_negative,
            moved => moved < 0,
        };
        Self { position, is_negative }
    }

    /// Whatever the controller says is a speed.
    const fn signed(self, speed: i32) -> i32 {
        if self.is_negative { speed.wrapping_neg() } else { speed }
    }
}

/// StepNLoop of an axis: its status and its delta, which is one only while it is on.
#[derive(Clone, Copy, Debug)]
struct Loop {
    state: i32,
    delta: Option<i32>,
}

/// A question that has its turn.
#[derive(Clone, Copy, Debug)]
enum Question {
    Loop(usize),
    Enables,
    Mode,
    Inputs,
    Outputs,
    Ports,
    Analog(u8),
    Duty(u8),
    Program(u8),
}

impl Unit {
    /// Asks for everything there is to see, or for what moves and a share of the rest.
    pub async fn status(&self, seconds: f64) -> Result<Status> {
        let begin = Instant::now();
        let words = self.each("MST", !self.is_commander()).await?;
        let positions = self.counters("P").await?;
        let encoders = self.counters("E").await?;
        let speeds = self.each("PS", !self.is_commander()).await?;
        // Two of the four were asked of each axis.
        let asked = 2 * self.model.axes().len() + 2;
        let mut rest = self.rest.lock().await;
        let questions = self.questions();
        for number in rest.turns.take(questions.len(), asked as u32, begin.elapsed()) {
            self.look(&mut rest, questions[number]).await?;
        }
        let way = |(number, &position): (usize, &i32)| {
            let first = Way { position, is_negative: false };
            rest.ways.get(number).map_or(first, |before| before.on(position))
        };
        rest.ways = positions.iter().enumerate().map(way).collect();
        let mut status = Status {
            seconds,
            absolute: rest.absolute,
            inputs: rest.inputs.clone(),
            outputs: rest.outputs.clone(),
            programs: rest.programs.values().copied().collect(),
            ..Status::default()
        };
        for (number, name) in self.model.axes().iter().enumerate() {
            let looked = rest.loops.get(&number);
            let loop_state = looked.and_then(|looked| loop_state(looked.state));
            let axis = AxisStatus {
                position: positions[number],
                encoder: Some(encoders[number]),
                speed: rest.ways[number].signed(speeds[number]),
                target: self.targets()[number],
                delta: looked.and_then(|looked| looked.delta),
                enabled: Some(rest.enables >> number & 1 != 0),
                loop_state: loop_state.map(str::to_owned),
                ..self.axis_status(words[number] as u32)
            };
            let failed = loop_state.filter(|_| looked.is_some_and(|looked| is_loop_error(looked.state)));
            let failed = failed.map(|state| format!("StepNLoop: {state}"));
            let error = match (axis.error.clone(), failed) {
                (Some(error), Some(failed)) => Some(format!("{error}, {failed}")),
                (error, failed) => error.or(failed),
            };
            status.alarms.extend(error.iter().map(|error| format!("{name}: {error}")));
            status.axes.insert((*name).into(), AxisStatus { error, ..axis });
        }
        for (number, program) in &rest.programs {
            if program.state == ProgramState::Error {
                status.alarms.push(format!("program {number}: error at line {}", program.counter));
            }
        }
        Ok(status)
    }

    fn questions(&self) -> Vec<Question> {
        use Question::{Analog, Duty, Enables, Inputs, Loop, Mode, Outputs, Ports, Program};
        let dialect = self.dialect;
        let ports = (dialect.ports > 0).then_some(Ports);
        let loops = (0..dialect.axes.len()).map(Loop);
        let levels = [Enables, Mode, Inputs, Outputs].into_iter().chain(ports);
        let analog = (1..=dialect.analog_inputs).map(Analog).chain((1..=dialect.pwm_outputs).map(Duty));
        loops.chain(levels).chain(analog).chain((0..dialect.threads).map(Program)).collect()
    }

    async fn look(&self, rest: &mut Rest, question: Question) -> Result<()> {
        let dialect = self.dialect;
        match question {
            Question::Loop(number) => {
                let name = self.model.axes()[number];
                let state = self.ask(&format!("SLS{name}")).await?;
                let delta = match loop_state(state) {
                    Some(_) => Some(self.ask(&format!("D{name}")).await?),
                    None => None,
                };
                rest.loops.insert(number, Loop { state, delta });
            }
            Question::Enables => {
                rest.enables = self.bits_of("EO").await?;
                put(&mut rest.outputs, "EO", rest.enables, dialect.axis_count(), u32::MAX);
            }
            Question::Mode => rest.absolute = Some(self.ask::<i32>("MM").await? == 0),
            Question::Inputs => {
                put(&mut rest.inputs, "DI", self.bits_of("DI").await?, dialect.inputs, u32::MAX)
            }
            Question::Outputs => {
                put(&mut rest.outputs, "DO", self.bits_of("DO").await?, dialect.outputs, u32::MAX)
            }
            Question::Ports => {
                let (levels, driven) = (self.bits_of("IO").await?, self.bits_of("IOCFG").await?);
                put(&mut rest.inputs, "IO", levels, dialect.ports, !driven);
                put(&mut rest.outputs, "IO", levels, dialect.ports, driven);
            }
            Question::Analog(number) => self.measure(&mut rest.inputs, format!("AI{number}")).await?,
            Question::Duty(number) => self.measure(&mut rest.outputs, format!("PWM{number}")).await?,
            Question::Program(number) => {
                rest.programs.insert(number, self.program_status(number).await?);
            }
        }
        Ok(())
    }

    async fn measure(&self, levels: &mut Levels, name: String) -> Result<()> {
        let level = self.ask::<i32>(&name).await?;
        levels.insert(name, Level::Analog(level.into()));
        Ok(())
    }

    /// What a status word says.
    fn axis_status(&self, word: u32) -> AxisStatus {
        let on = |bit: u32| word >> bit & 1 != 0;
        let index = if self.is_commander() { bit::COMMANDER_INDEX } else { bit::PERFORMAX_INDEX };
        let state = match () {
            () if on(bit::ACCELERATING) => "accelerating",
            () if on(bit::DECELERATING) => "decelerating",
            () if on(bit::CONSTANT_SPEED) => "constant speed",
            () => "idle",
        };
        AxisStatus {
            status: word,
            flags: flags(&self.bits, word),
            state: state.into(),
            negative_limit: Some(on(bit::NEGATIVE_LIMIT)),
            positive_limit: Some(on(bit::POSITIVE_LIMIT)),
            home: Some(on(bit::HOME)),
            index: Some(on(index)),
            error: errors(&self.bits, word),
            ..AxisStatus::default()
        }
    }

    async fn program_status(&self, number: u8) -> Result<ProgramStatus> {
        let line = format!("SASTAT{number}");
        let state = match self.ask(&line).await? {
            0 => ProgramState::Idle,
            1 => ProgramState::Running,
            2 => ProgramState::Paused,
            4 => ProgramState::Error,
            other => return Err(malformed(&line, &i32::to_string(&other))),
        };
        Ok(ProgramStatus { state, counter: self.ask(&format!("SPC{number}")).await? })
    }

    /// A counter of every axis. A Commander gives them all at once (CMD-4CR manual, 2.6.1).
    async fn counters(&self, name: &str) -> Result<Vec<i32>> {
        if self.is_commander() {
            self.each(&format!("{name}P"), true).await
        } else {
            self.each(name, false).await
        }
    }

    /// A number of every axis, from one reply `x:y...` or from one for each.
    async fn each(&self, name: &str, together: bool) -> Result<Vec<i32>> {
        let axes = self.model.axes();
        if together {
            let List(mut numbers) = self.ask(name).await?;
            // Behind the status words of a Performax comes more.
            if numbers.len() < axes.len() {
                return Err(malformed(name, "a shorter list"));
            }
            numbers.truncate(axes.len());
            return Ok(numbers);
        }
        let mut numbers = Vec::new();
        for axis in axes {
            numbers.push(self.ask(&format!("{name}{axis}")).await?);
        }
        Ok(numbers)
    }

    /// A number whose bits count.
    async fn bits_of(&self, name: &str) -> Result<u32> {
        Ok(self.ask::<i32>(name).await? as u32)
    }
}

/// Numbers with `:` between.
pub(super) struct List(pub Vec<i32>);

impl FromStr for List {
    type Err = std::num::ParseIntError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.split(':').map(str::parse).collect::<Result<_, _>>().map(Self)
    }
}

/// Sets the bits that are chosen as `name1` and so on, and only those.
fn put(levels: &mut Levels, name: &str, bits: u32, count: u8, chosen: u32) {
    for bit in 0..count {
        let name = format!("{name}{}", bit + 1);
        if chosen >> bit & 1 != 0 {
            levels.insert(name, Level::Digital(bits >> bit & 1 != 0));
        } else {
            levels.remove(&name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_speed_has_the_sign_of_the_way() {
        let mut way = Way { position: 5, is_negative: false };
        for (position, is_negative) in [(5, false), (4, true), (4, true), (9, false), (-20, true)] {
            way = way.on(position);
            assert_eq!((way.position, way.is_negative), (position, is_negative));
        }
        assert_eq!([7, 0, i32::MIN].map(|speed| way.signed(speed)), [-7, 0, i32::MIN]);
        // Where the counter wraps.
        assert!(!Way { position: i32::MAX, is_negative: true }.on(i32::MIN).is_negative);
    }
}
