//! Statements to compiled lines.

use super::diagnostic::{ErrorKind, Finding, Severity};
use super::parser::SourceLine;
use super::syntax::{Condition, Expression, Statement, Value};
use super::{Code, MAX_NESTING};
use crate::dialect::Dialect;
use crate::isa::{Operator, PROGRAMS, SUBROUTINES};
use crate::line::{Line, OPERANDS, Operand, TEMPORARIES, pack};
use source::Span;

/// The lines of the statements, and what is wrong with how they stand together.
pub(super) fn generate(lines: &[SourceLine], dialect: &Dialect) -> (Code, Vec<Finding>) {
    let mut generator = Generator {
        dialect,
        code: Code::default(),
        findings: Vec::new(),
        source_line: 0,
        wrong: false,
        frame: None,
        blocks: Vec::new(),
        programs: [const { None }; PROGRAMS as usize],
        subroutines: [const { None }; SUBROUTINES as usize],
        calls: Vec::new(),
        full: false,
    };
    for (index, line) in lines.iter().enumerate() {
        if let Some(statement) = line.statement {
            generator.source_line = index + 1;
            generator.wrong = line.wrong;
            generator.statement(statement, &line.span);
        }
    }
    generator.close_frame();
    generator.check_calls();
    (generator.code, generator.findings)
}

struct Generator<'a> {
    dialect: &'a Dialect,
    code: Code,
    findings: Vec<Finding>,
    /// The line that is being compiled, from 1.
    source_line: usize,
    /// Whether it has an error already, and only stands for the block that it begins.
    wrong: bool,
    frame: Option<Frame>,
    blocks: Vec<Block>,
    /// Where each program and subroutine begins.
    programs: [Option<Span>; PROGRAMS as usize],
    subroutines: [Option<Span>; SUBROUTINES as usize],
    calls: Vec<(u8, Span)>,
    /// Whether it has been said that the memory is full.
    full: bool,
}

/// A program or subroutine that is being compiled.
struct Frame {
    missing: ErrorKind,
    begin: Span,
}

/// An `IF` or `WHILE` that is not closed yet.
struct Block {
    begin: Span,
    kind: BlockKind,
}

enum BlockKind {
    While {
        /// The first line of the condition, and its last one.
        start: u16,
        test: u16,
    },
    If {
        /// The line that leads on if the last condition does not hold; none behind `ELSE`.
        test: Option<u16>,
        /// The lines that lead from the ends of branches to the `ENDIF`.
        exits: Vec<u16>,
    },
}

impl Generator<'_> {
    fn error(&mut self, kind: ErrorKind, span: &Span, message: &str) {
        self.findings.push(Finding::error(kind, span.clone(), message));
    }

    /// The address of the next line.
    fn here(&self) -> u16 {
        self.code.lines.len() as u16
    }

    fn emit(&mut self, line: Line, span: &Span) {
        if self.code.lines.len() < usize::from(self.dialect.lines) {
            self.code.lines.push(line);
            self.code.map.push(self.source_line);
        } else if !std::mem::replace(&mut self.full, true) {
            let message =
                format!("there is no room: the {} has {} lines", self.dialect.name, self.dialect.lines);
            let finding = Finding::error(ErrorKind::Other, span.clone(), message);
            self.findings.push(finding.hint("a statement takes one to four of them"));
        }
    }

    fn statement(&mut self, statement: Statement, span: &Span) {
        match statement {
            Statement::Program(number) => {
                self.close_frame();
                self.frame = Some(Frame { missing: ErrorKind::MissingEnd, begin: span.clone() });
                if !self.wrong && self.programs[usize::from(number)].replace(span.clone()).is_some() {
                    self.error(ErrorKind::Prg, span, &format!("there is a program {number} already"));
                }
                return self.emit(Line::Program(number), span);
            }
            Statement::Subroutine(number) => {
                self.close_frame();
                self.frame = Some(Frame { missing: ErrorKind::EndSub, begin: span.clone() });
                if !self.wrong && self.subroutines[usize::from(number)].replace(span.clone()).is_some() {
                    self.error(ErrorKind::Sub, span, &format!("there is a subroutine {number} already"));
                }
                return self.emit(Line::Subroutine(number), span);
            }
            Statement::EndSubroutine if self.frame.is_none() => {
                return self.error(ErrorKind::Other, span, "`ENDSUB` without `SUB`");
            }
            _ => (),
        }
        if self.frame.is_none() && !self.begin_without_prg(span) {
            return;
        }
        match statement {
            Statement::End => self.end(ErrorKind::MissingEnd, Line::End, span),
            Statement::EndSubroutine => self.end(ErrorKind::EndSub, Line::EndSubroutine, span),
            Statement::Call(number) => {
                self.calls.push((number, span.clone()));
                self.emit(Line::Call(number), span);
            }
            Statement::Assign(variable, expression) => self.assign(variable, expression, span),
            Statement::Set(place, value) => {
                let ([operand, ..], value) = self.operands([Some(value), None, None, None], span);
                self.emit(Line::Set { place, operand, value }, span);
            }
            Statement::Do(place, values) => {
                let (operands, value) = self.operands(values, span);
                self.emit(Line::Do { place, operands, value }, span);
            }
            Statement::If(condition) => {
                let test = self.test(condition, span, |test| test.into_if());
                self.open(span, BlockKind::If { test: Some(test), exits: Vec::new() });
            }
            Statement::While(condition) => {
                let start = self.here();
                let test = self.test(condition, span, |test| test.into_while());
                self.open(span, BlockKind::While { start, test });
            }
            Statement::ElseIf(_) | Statement::Else => self.branch(statement, span),
            Statement::EndIf => {
                match self.blocks.pop_if(|block| matches!(block.kind, BlockKind::If { .. })) {
                    Some(Block { kind: BlockKind::If { test, exits }, .. }) => {
                        let target = self.here();
                        self.emit(Line::EndIf, span);
                        test.into_iter().chain(exits).for_each(|line| self.lead(line, target));
                    }
                    _ => self.error(ErrorKind::Other, span, "`ENDIF` without `IF`"),
                }
            }
            Statement::EndWhile => {
                match self.blocks.pop_if(|block| matches!(block.kind, BlockKind::While { .. })) {
                    Some(Block { kind: BlockKind::While { start, test }, .. }) => {
                        self.emit(Line::EndWhile { target: start }, span);
                        self.lead(test, self.here());
                    }
                    _ => self.error(ErrorKind::Other, span, "`ENDWHILE` without `WHILE`"),
                }
            }
            Statement::Program(_) | Statement::Subroutine(_) => (),
        }
    }

    /// A program without `PRG` is program 0, if there is no `PRG` before it.
    fn begin_without_prg(&mut self, span: &Span) -> bool {
        let first = self.programs.iter().all(Option::is_none);
        if first {
            self.frame = Some(Frame { missing: ErrorKind::MissingEnd, begin: span.clone() });
            self.programs[0] = Some(span.clone());
            self.emit(Line::Program(0), span);
        } else {
            self.error(ErrorKind::Other, span, "a statement outside of programs and subroutines");
        }
        first
    }

    /// `END` or `ENDSUB`, inside of a frame.
    fn end(&mut self, kind: ErrorKind, line: Line, span: &Span) {
        if self.frame.as_ref().is_some_and(|frame| frame.missing == kind) {
            self.close_blocks();
            self.frame = None;
            self.emit(line, span);
        } else if kind == ErrorKind::MissingEnd {
            // Most likely it was meant to end the subroutine.
            self.error(ErrorKind::EndSub, span, "a subroutine ends with `ENDSUB`");
            self.close_blocks();
            self.frame = None;
        } else {
            self.error(ErrorKind::Other, span, "`ENDSUB` in a program");
        }
    }

    /// Says what is missing where a new program or subroutine, or nothing, follows.
    fn close_frame(&mut self) {
        self.close_blocks();
        if let Some(Frame { missing, begin }) = self.frame.take() {
            let message = match missing {
                ErrorKind::EndSub => "this subroutine has no `ENDSUB`",
                _ => "this program has no `END`",
            };
            self.error(missing, &begin, message);
        }
    }

    fn close_blocks(&mut self) {
        for Block { begin, kind } in std::mem::take(&mut self.blocks) {
            match kind {
                BlockKind::While { .. } => {
                    self.error(ErrorKind::MissingEndWhile, &begin, "this `WHILE` has no `ENDWHILE`");
                }
                BlockKind::If { .. } => {
                    self.error(ErrorKind::MissingEndIf, &begin, "this `IF` has no `ENDIF`");
                }
            }
        }
    }

    fn open(&mut self, span: &Span, kind: BlockKind) {
        if self.blocks.len() == MAX_NESTING {
            let message = format!("`IF` and `WHILE` nest at most {MAX_NESTING} deep");
            self.error(ErrorKind::Other, span, &message);
        }
        self.blocks.push(Block { begin: span.clone(), kind });
    }

    /// `ELSEIF` and `ELSE`.
    fn branch(&mut self, statement: Statement, span: &Span) {
        let exit = self.here();
        let (failed, is_if) = match self.blocks.last_mut() {
            Some(Block { kind: BlockKind::If { test, exits }, .. }) => {
                let failed = test.take();
                exits.extend(failed.map(|_| exit));
                (failed, true)
            }
            _ => (None, false),
        };
        let Some(failed) = failed else {
            let message = if is_if { "behind `ELSE` comes `ENDIF`" } else { "there is no `IF` for this" };
            return self.error(ErrorKind::Other, span, message);
        };
        self.lead(failed, exit + 1);
        let Statement::ElseIf(condition) = statement else {
            return self.emit(Line::Else { target: 0 }, span);
        };
        self.emit(Line::ElseIf { target: 0 }, span);
        let next = self.test(condition, span, |test| test.into_if());
        if let Some(Block { kind: BlockKind::If { test, .. }, .. }) = self.blocks.last_mut() {
            *test = Some(next);
        }
    }

    /// Sets where a line leads to.
    fn lead(&mut self, line: u16, to: u16) {
        match self.code.lines.get_mut(usize::from(line)) {
            Some(
                Line::If { target, .. }
                | Line::While { target, .. }
                | Line::ElseIf { target }
                | Line::Else { target },
            ) => {
                *target = to;
            }
            // The memory is full, which has been said.
            _ => assert!(self.full, "only these lines lead somewhere"),
        }
    }

    fn assign(&mut self, variable: u8, expression: Expression, span: &Span) {
        let Expression { operator, x, y } = expression;
        let ([x, y, ..], value) = self.operands([Some(x), y, None, None], span);
        let target = Operand::variable(variable);
        self.emit(Line::Calculate { target, operator, x, y, value }, span);
    }

    /// The lines of a condition; gives the address of the last one. The side with an operator comes first.
    fn test(&mut self, condition: Condition, span: &Span, line: fn(Test) -> Line) -> u16 {
        let Condition { mut left, mut comparison, mut right } = condition;
        if right.is_compound() {
            std::mem::swap(&mut left, &mut right);
            comparison = comparison.mirrored();
        }
        let Expression { operator, x, y } = left;
        let (operands, value) = self.operands([Some(x), y, Some(right.x), None], span);
        let [x, y, z, _] = operands;
        let test = self.here();
        self.emit(line(Test { operator, comparison, x, y, z, value }), span);
        test
    }

    /// The operands of a line, and its immediate: of those that are numbers or registers the last one
    /// stays in the line, the others are put into temporaries.
    fn operands(&mut self, values: [Option<Value>; OPERANDS], span: &Span) -> ([Operand; OPERANDS], i32) {
        let immediate = |value: &Option<Value>| matches!(value, Some(Value::Number(_) | Value::Register(_)));
        let last = values.iter().rposition(immediate);
        let mut temporary = 0;
        let mut stays = 0;
        let operands = std::array::from_fn(|index| {
            let (operand, value) = match values[index] {
                None => return Operand::NONE,
                Some(Value::Variable(variable)) => return Operand::variable(variable),
                Some(Value::Number(number)) => (Operand::NUMBER, number),
                Some(Value::Register(place)) => (Operand::REGISTER, pack(place)),
            };
            if last == Some(index) {
                stays = value;
                return operand;
            }
            assert!(temporary < TEMPORARIES as u8, "at most four operands, one of which stays");
            let target = Operand::temporary(temporary);
            temporary += 1;
            self.emit(
                Line::Calculate { target, operator: Operator::Copy, x: operand, y: Operand::NONE, value },
                span,
            );
            target
        });
        (operands, stays)
    }

    /// Warns of calls that fail when the program runs.
    fn check_calls(&mut self) {
        for (number, span) in std::mem::take(&mut self.calls) {
            if self.subroutines[usize::from(number)].is_none() {
                self.findings.push(Finding {
                    severity: Severity::Warning,
                    span,
                    message: format!("there is no subroutine {number}"),
                    hint: Some(
                        "unless the device has one, this is an error when the program comes here".into(),
                    ),
                });
            }
        }
    }
}

/// The last line of a condition, before it is known where it leads to.
struct Test {
    operator: Operator,
    comparison: crate::isa::Comparison,
    x: Operand,
    y: Operand,
    z: Operand,
    value: i32,
}

impl Test {
    fn into_if(self) -> Line {
        let Self { operator, comparison, x, y, z, value } = self;
        Line::If { operator, comparison, x, y, z, target: 0, value }
    }

    fn into_while(self) -> Line {
        let Self { operator, comparison, x, y, z, value } = self;
        Line::While { operator, comparison, x, y, z, target: 0, value }
    }
}
