//! Programs made up from a list of numbers. They compile, and their loops come to an end.

use crate::compiler::syntax::{Condition, Expression, Statement, Value};
use crate::dialect::Dialect;
use crate::isa::{Comparison, Kind, Operator, Place, SUBROUTINES, Suffix, Word, words};
use crate::line::OPERANDS;
use std::fmt::Write;

/// How deep blocks nest.
const DEPTH: usize = 4;

/// Most statements, so that the lines fit every memory.
const STATEMENTS: usize = 150;

/// The variables that loops count with, one a level; nothing else writes them.
const COUNTERS: u8 = 50;

/// Most rounds of a loop.
const ROUNDS: usize = 3;

/// A list of numbers that decisions are made with; when it is used up they are all 0.
#[derive(Clone, Debug)]
pub struct Choices<'a>(std::slice::Iter<'a, u8>);

impl<'a> Choices<'a> {
    /// Decisions from these bytes.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes.iter())
    }

    /// A number below `count`.
    fn below(&mut self, count: usize) -> usize {
        usize::from(self.0.next().copied().unwrap_or(0)) % count
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    fn number(&mut self) -> i32 {
        match self.below(4) {
            0 => self.pick(&[0, 1, -1, 2, 31, 32, i32::MAX, i32::MIN]),
            1 => i32::from_le_bytes([(); 4].map(|()| self.below(256) as u8)),
            _ => self.below(10) as i32,
        }
    }
}

/// The source of a program for this dialect: all its threads, and a few subroutines.
pub fn program(choices: &mut Choices<'_>, dialect: &Dialect) -> String {
    let mut writer = Writer { choices, dialect, text: String::new(), statements: 0 };
    for number in 0..dialect.threads {
        writer.frame(Statement::Program(number), Statement::End);
    }
    for number in [0, 1, SUBROUTINES - 1] {
        writer.frame(Statement::Subroutine(number), Statement::EndSubroutine);
    }
    writer.text
}

struct Writer<'a, 'b> {
    choices: &'a mut Choices<'b>,
    dialect: &'a Dialect,
    text: String,
    statements: usize,
}

impl Writer<'_, '_> {
    fn write(&mut self, statement: Statement) {
        writeln!(self.text, "{statement}").expect("a string takes everything");
    }

    fn frame(&mut self, begin: Statement, end: Statement) {
        self.write(begin);
        self.block(0);
        self.write(end);
    }

    fn block(&mut self, depth: usize) {
        while self.statements < STATEMENTS && self.choices.below(8) > 0 {
            self.statements += 1;
            match self.choices.below(16) {
                0..=2 if depth < DEPTH => self.branches(depth),
                3 if depth < DEPTH => self.counted_loop(depth),
                4 => {
                    let number = self.choices.pick(&[0, 1, 2, SUBROUTINES - 1]);
                    self.write(Statement::Call(number));
                }
                5..=8 => {
                    let statement = self.device_statement();
                    self.write(statement);
                }
                _ => {
                    let expression = self.expression();
                    let variable = self.choices.below(8) as u8;
                    self.write(Statement::Assign(variable, expression));
                }
            }
        }
    }

    fn branches(&mut self, depth: usize) {
        let condition = self.condition();
        self.write(Statement::If(condition));
        self.block(depth + 1);
        for _ in 0..self.choices.below(3) {
            let condition = self.condition();
            self.write(Statement::ElseIf(condition));
            self.block(depth + 1);
        }
        if self.choices.below(2) == 0 {
            self.write(Statement::Else);
            self.block(depth + 1);
        }
        self.write(Statement::EndIf);
    }

    /// A loop with a counter of its own. A subroutine may call itself inside of a loop, so counters only
    /// ever grow: each loop ends, but a second one of a level may have fewer rounds.
    fn counted_loop(&mut self, depth: usize) {
        let counter = Value::Variable(COUNTERS + depth as u8);
        let rounds = Value::Number(1 + self.choices.below(ROUNDS) as i32);
        let one = Expression { operator: Operator::Add, x: counter, y: Some(Value::Number(1)) };
        self.write(Statement::While(Condition {
            left: Expression::value(counter),
            comparison: Comparison::Less,
            right: Expression::value(rounds),
        }));
        self.write(Statement::Assign(COUNTERS + depth as u8, one));
        self.block(depth + 1);
        self.write(Statement::EndWhile);
    }

    fn condition(&mut self) -> Condition {
        let (comparison, _) = self.choices.pick(&Comparison::ALL);
        let (compound, simple) = (self.expression(), Expression::value(self.value()));
        match self.choices.below(2) {
            0 => Condition { left: compound, comparison, right: simple },
            _ => Condition { left: simple, comparison, right: compound },
        }
    }

    fn expression(&mut self) -> Expression {
        let (operator, _) = self.choices.pick(&Operator::ALL);
        let x = self.value();
        let y = (operator.operands() == 2).then(|| self.value());
        Expression { operator, x, y }
    }

    fn value(&mut self) -> Value {
        match self.choices.below(4) {
            0 => {
                let family = self.dialect.family;
                let readable = words(family).filter(|entry| {
                    entry.kind == Kind::Register && entry.access(family).is_some_and(|access| access.reads())
                });
                let word = self.choices.pick(&readable.map(|entry| entry.word).collect::<Vec<_>>());
                Value::Register(self.place(word))
            }
            _ => self.simple_value(),
        }
    }

    fn simple_value(&mut self) -> Value {
        match self.choices.below(2) {
            0 => Value::Number(self.choices.number()),
            _ => Value::Variable(self.choices.below(8) as u8),
        }
    }

    /// A word with an axis, number or direction that it can have.
    fn place(&mut self, word: Word) -> Place {
        let all = (0..=u8::MAX).map(|index| Place::new(word, index));
        let there: Vec<_> = all.filter(|place| place.exists(self.dialect)).collect();
        self.choices.pick(&there)
    }

    fn device_statement(&mut self) -> Statement {
        let family = self.dialect.family;
        let writable = words(family).filter(|entry| {
            let kind = matches!(entry.kind, Kind::Register | Kind::Action | Kind::Command);
            kind && entry.access(family).is_some_and(|access| access.writes())
        });
        let word = self.choices.pick(&writable.map(|entry| entry.word).collect::<Vec<_>>());
        let (place, entry) = (self.place(word), word.entry());
        if entry.kind == Kind::Register {
            return Statement::Set(place, self.simple_value());
        }
        let mut values = [None; OPERANDS];
        let count = match (entry.kind, entry.suffix) {
            (Kind::Command, _) => 1,
            (_, Suffix::Targets) => 2 + self.choices.below(usize::from(self.dialect.axis_count()) - 1),
            _ => entry.arguments(self.dialect),
        };
        for value in &mut values[..count] {
            *value = Some(match entry.suffix {
                Suffix::Home => {
                    Value::Number(self.choices.below(usize::from(self.dialect.homing_modes)) as i32)
                }
                _ => self.simple_value(),
            });
        }
        Statement::Do(place, values)
    }
}
