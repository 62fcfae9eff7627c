//! The loop that executes lines.

use super::{Action, Exit, Fault, Memory, State, Thread};
use crate::isa::{Comparison, Operator, Place};
use crate::line::{Line, OPERANDS, Operand, TEMPORARIES};

impl Thread {
    /// Executes at most `budget` lines, and tells how many it executed and why it came back. A line that
    /// the device is asked to write or do is among them; one that waits for a register or fails is not yet.
    /// While the device is busy it executes nothing and says again what it has asked for.
    pub fn run<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        memory: &mut Memory<LINES, VARIABLES>,
        budget: u32,
    ) -> (u32, Exit) {
        if self.state != State::Running {
            return (0, Exit::Idle);
        }
        if let Some(exit) = self.pending {
            return (0, exit);
        }
        let mut executed = 0;
        let exit = loop {
            // A register that was read for the line is gone once a burst executes it.
            let burst = self.burst(memory, budget - executed);
            executed += burst;
            if executed == budget {
                break Exit::Budget;
            }
            let Some(&line) = memory.lines.get(usize::from(self.counter)) else {
                break Exit::Fault(Fault::NoLine);
            };
            match self.execute(line, memory) {
                Ok(Step::Done) => executed += 1,
                Ok(Step::Leave(exit)) => {
                    executed += 1;
                    break exit;
                }
                Err(exit) => break exit,
            }
        };
        if matches!(exit, Exit::Read(_) | Exit::Write(..) | Exit::Do(_)) {
            self.pending = Some(exit);
        }
        self.instructions += u64::from(executed);
        (executed, exit)
    }

    /// Executes at most `limit` lines that calculate and decide, with the state in local variables; ends at
    /// the first line of another kind, or one that cannot be executed yet. This is the hot loop.
    fn burst<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        memory: &mut Memory<LINES, VARIABLES>,
        limit: u32,
    ) -> u32 {
        let Memory { lines, variables, .. } = memory;
        let mut counter = usize::from(self.counter);
        let mut values = Values { variables, temporaries: self.temporaries, fetched: self.fetched };
        let mut left = limit;
        while left > 0 {
            let Some(line) = lines.get(counter) else { break };
            let mut next = counter + 1;
            match *line {
                Line::Calculate { target, operator, x, y, value } => {
                    let Some(x) = values.get(x, value) else { break };
                    let Some(y) = values.second(operator, y, value) else { break };
                    let Some(result) = operator.apply(x, y) else { break };
                    let Some(place) = values.storage(target) else { break };
                    *place = result;
                }
                Line::If { operator, comparison, x, y, z, target, value }
                | Line::While { operator, comparison, x, y, z, target, value } => {
                    let Some(holds) = values.holds(operator, comparison, [x, y, z], value) else { break };
                    if !holds {
                        next = usize::from(target);
                    }
                }
                Line::EndWhile { target } | Line::Else { target } | Line::ElseIf { target } => {
                    next = usize::from(target);
                }
                Line::EndIf | Line::Program(_) | Line::Subroutine(_) => (),
                _ => break,
            }
            values.fetched = None;
            counter = next;
            left -= 1;
        }
        self.temporaries = values.temporaries;
        self.fetched = values.fetched;
        self.counter = counter as u16;
        limit - left
    }

    /// Executes the line at the counter, which no [`burst`](Self::burst) would. `Err` if it is not done.
    #[inline(never)]
    fn execute<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        line: Line,
        memory: &mut Memory<LINES, VARIABLES>,
    ) -> Result<Step, Exit> {
        let mut values =
            Values { variables: &mut memory.variables, temporaries: self.temporaries, fetched: None };
        match line {
            Line::Empty => Err(Exit::Fault(Fault::NoLine)),
            Line::Call(number) => {
                let target = memory.subroutine(number).ok_or(Exit::Fault(Fault::NoSubroutine(number)))?;
                if !self.can_call() || self.stack.push(self.counter + 1).is_err() {
                    return Err(Exit::Fault(Fault::CallDepth));
                }
                self.counter = target;
                Ok(Step::Done)
            }
            Line::EndSubroutine if self.return_from_subroutine() => Ok(Step::Done),
            Line::End | Line::EndSubroutine => {
                self.stop();
                Ok(Step::Leave(Exit::Stopped))
            }
            Line::Set { place, operand, value } => {
                let value = values.get(operand, value).ok_or(Exit::Fault(Fault::NoVariable))?;
                Ok(Step::Leave(Exit::Write(place, value)))
            }
            Line::Do { place, operands, value } => {
                Ok(Step::Leave(Exit::Do(action(place, operands, value, &mut values)?)))
            }
            // A burst executes these unless it lacks the register, or a variable, or divides by zero.
            _ => Err(match line.register() {
                Some(place) if self.fetched.is_none() => Exit::Read(place),
                _ => {
                    let (operands, value) = line.operands();
                    let target =
                        if let Line::Calculate { target, .. } = line { target } else { Operand::NONE };
                    values.fetched = self.fetched;
                    let missing = |operand: &Operand| {
                        *operand != Operand::NONE && values.get(*operand, value).is_none()
                    };
                    let missing = operands.iter().chain([&target]).any(missing);
                    Exit::Fault(if missing { Fault::NoVariable } else { Fault::DivisionByZero })
                }
            }),
        }
    }
}

/// What became of a line that is done or handed over.
enum Step {
    Done,
    Leave(Exit),
}

/// Everything that an operand can name.
struct Values<'a, const VARIABLES: usize> {
    variables: &'a mut [i32; VARIABLES],
    temporaries: [i32; TEMPORARIES],
    /// What the device has read for the line.
    fetched: Option<i32>,
}

impl<const VARIABLES: usize> Values<'_, VARIABLES> {
    /// The value of an operand of a line with this immediate; `None` if it is yet to be read, or there is
    /// no such variable.
    #[inline(always)]
    fn get(&self, operand: Operand, value: i32) -> Option<i32> {
        if let Some(&variable) = self.variables.get(usize::from(operand.0)) {
            return Some(variable);
        }
        match operand {
            Operand::NUMBER => Some(value),
            Operand::REGISTER => self.fetched,
            _ => operand.as_temporary().map(|index| self.temporaries[usize::from(index)]),
        }
    }

    /// The value of a second operand, 0 if the operator has none.
    #[inline(always)]
    fn second(&self, operator: Operator, operand: Operand, value: i32) -> Option<i32> {
        if operator.operands() == 1 { Some(0) } else { self.get(operand, value) }
    }

    /// Where a result goes.
    #[inline(always)]
    fn storage(&mut self, target: Operand) -> Option<&mut i32> {
        if let Some(variable) = self.variables.get_mut(usize::from(target.0)) {
            return Some(variable);
        }
        target.as_temporary().map(|index| &mut self.temporaries[usize::from(index)])
    }

    /// Whether a condition holds.
    #[inline(always)]
    fn holds(
        &self,
        operator: Operator,
        comparison: Comparison,
        [x, y, z]: [Operand; 3],
        value: i32,
    ) -> Option<bool> {
        let x = self.get(x, value)?;
        let left = match operator {
            Operator::Copy => x,
            _ => operator.apply(x, self.second(operator, y, value)?)?,
        };
        Some(comparison.holds(left, self.get(z, value)?))
    }
}

fn action<const VARIABLES: usize>(
    place: Place,
    operands: [Operand; OPERANDS],
    value: i32,
    values: &mut Values<'_, VARIABLES>,
) -> Result<Action, Exit> {
    let mut found = [None; OPERANDS];
    for (found, operand) in found.iter_mut().zip(operands).filter(|(_, operand)| *operand != Operand::NONE) {
        *found = Some(values.get(operand, value).ok_or(Exit::Fault(Fault::NoVariable))?);
    }
    Ok(Action::new(place, found))
}
