//! Tokens to statements, a line at a time. An error ends its line only.

use super::diagnostic::{ErrorKind, Finding};
use super::lexer::{self, Token, Tokens};
use super::syntax::{Condition, Expression, Statement, Value};
use super::{MAX_MESSAGES, words};
use crate::dialect::Dialect;
use crate::isa::{Comparison, Direction, Entry, Index, Kind, Operator, Place, Suffix, Word};
use crate::line::OPERANDS;
use source::{Source, Span};

/// A line of a source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceLine {
    /// What it says; `None` if that is nothing, or wrong.
    pub statement: Option<Statement>,
    /// Whether it is wrong. A wrong line that begins a block has a statement that begins such a block, so
    /// that its end is not wrong too.
    pub wrong: bool,
    /// Where the statement stands.
    pub span: Span,
    /// The comment behind it, with its `;`.
    pub comment: Option<Span>,
}

/// What a line of tokens gives.
type Result<T> = std::result::Result<T, Finding>;

/// The lines of a source, and what is wrong with those that have no statement. Behind [`MAX_MESSAGES`] wrong
/// lines nothing is read any more: then it is no program.
pub(crate) fn parse(source: &Source, dialect: &Dialect) -> (Vec<SourceLine>, Vec<Finding>) {
    let mut findings = Vec::new();
    let lines = lexer::lines(source).into_iter().map(|Tokens { tokens, comment }| {
        let span = match (tokens.first(), tokens.last()) {
            (Some((_, first)), Some((_, last))) => first.start..last.end,
            _ => 0..0,
        };
        if tokens.is_empty() || findings.len() == MAX_MESSAGES {
            return SourceLine { statement: None, wrong: false, span, comment };
        }
        let mut parser = Parser { source, dialect, tokens: &tokens, position: 0 };
        match parser.line() {
            Ok(statement) => SourceLine { statement: Some(statement), wrong: false, span, comment },
            Err(finding) => {
                findings.push(finding);
                SourceLine { statement: parser.stand_in(), wrong: true, span, comment }
            }
        }
    });
    (lines.collect(), findings)
}

struct Parser<'a> {
    source: &'a Source,
    dialect: &'a Dialect,
    /// At least one.
    tokens: &'a [(Token, Span)],
    position: usize,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.position).map(|&(token, _)| token)
    }

    /// Where the next token stands, or the end of the line.
    fn span(&self) -> Span {
        match self.tokens.get(self.position) {
            Some((_, span)) => span.clone(),
            None => {
                let end = self.tokens.last().map_or(0, |(_, span)| span.end);
                end..end
            }
        }
    }

    /// From there to the end of the line.
    fn rest(&self, start: usize) -> Span {
        start..self.tokens.last().map_or(start, |(_, span)| span.end)
    }

    /// From there to the token before the next one.
    fn since(&self, start: usize) -> Span {
        start..self.tokens[..self.position].last().map_or(start, |(_, span)| span.end.max(start))
    }

    fn text(&self) -> &'a str {
        self.source.slice(&self.span())
    }

    fn take(&mut self, token: Token) -> bool {
        let found = self.peek() == Some(token);
        self.position += usize::from(found);
        found
    }

    fn found(&self) -> String {
        if self.peek().is_some() { format!("`{}`", self.text()) } else { "the end of the line".into() }
    }

    fn unexpected<T>(&self, kind: ErrorKind, expected: &str) -> Result<T> {
        Err(Finding::error(kind, self.span(), format!("expected {expected}, found {}", self.found())))
    }

    fn line(&mut self) -> Result<Statement> {
        let statement = self.statement()?;
        match self.peek() {
            None => Ok(statement),
            Some(Token::Word) => {
                let (span, found) = (self.rest(self.span().start), self.found());
                let finding = Finding::error(ErrorKind::Token, span, format!("unexpected {found}"));
                Err(finding.hint("a line has one statement"))
            }
            Some(_) => {
                let (span, found) = (self.rest(self.span().start), self.found());
                let finding = Finding::error(ErrorKind::Token, span, format!("unexpected {found}"));
                Err(match statement {
                    Statement::Assign(..) => finding.hint("an assignment has one operator"),
                    Statement::Set(..) | Statement::Do(..) => {
                        finding.hint("only assignments to variables calculate; use one for the result")
                    }
                    _ => finding,
                })
            }
        }
    }

    /// A statement that begins the same block as this line, if it begins one.
    fn stand_in(&self) -> Option<Statement> {
        const ZERO: Expression = Expression::value(Value::Number(0));
        const CONDITION: Condition = Condition { left: ZERO, comparison: Comparison::Equal, right: ZERO };
        match self.source.slice(&self.tokens[0].1) {
            "PRG" => Some(Statement::Program(0)),
            "SUB" => Some(Statement::Subroutine(0)),
            "IF" => Some(Statement::If(CONDITION)),
            "ELSEIF" => Some(Statement::ElseIf(CONDITION)),
            "WHILE" => Some(Statement::While(CONDITION)),
            _ => None,
        }
    }

    fn statement(&mut self) -> Result<Statement> {
        let span = self.span();
        if !self.take(Token::Word) {
            let found = self.found();
            let span = self.rest(span.start);
            return Err(Finding::error(ErrorKind::Unknown, span, format!("{found} begins no statement")));
        }
        let letters = self.source.slice(&span);
        match letters {
            "V" => return self.assignment(span),
            "IF" => return Ok(Statement::If(self.condition()?)),
            "ELSEIF" => return Ok(Statement::ElseIf(self.condition()?)),
            "WHILE" => return Ok(Statement::While(self.condition()?)),
            _ => (),
        }
        if words::target_axis(letters, self.dialect).is_some() {
            self.position -= 1;
            return self.moves();
        }
        let numbered = self.peek() == Some(Token::Number);
        let place = Place::from_letters(letters, numbered, self.dialect)
            .or_else(|| Place::from_letters(letters, false, self.dialect));
        let Some(place) = place else { return self.structure_or_unknown(letters, span) };
        let entry = place.word.entry();
        match entry.kind {
            Kind::Structure => self.structure(place.word),
            Kind::Register | Kind::Command => self.set(place, entry, span),
            Kind::Action => self.action(place, entry),
            Kind::Comment | Kind::Variable => self.unknown(letters, span),
        }
    }

    /// A structure word without its number, or a word that is none.
    fn structure_or_unknown(&mut self, letters: &str, span: Span) -> Result<Statement> {
        match letters {
            "PRG" => self.structure(Word::Prg),
            "SUB" => self.structure(Word::Sub),
            "GOSUB" => self.structure(Word::Gosub),
            _ => self.unknown(letters, span),
        }
    }

    fn unknown<T>(&self, letters: &str, span: Span) -> Result<T> {
        let finding = Finding::error(ErrorKind::Unknown, span, format!("there is no statement `{letters}`"));
        let hint = words::hint(letters, self.peek() == Some(Token::Number), self.dialect);
        Err(Finding { hint, ..finding })
    }

    fn structure(&mut self, word: Word) -> Result<Statement> {
        let (statement, missing, range): (fn(u8) -> Statement, _, _) = match word {
            Word::Prg => (Statement::Program, ErrorKind::PrgNumber, ErrorKind::Prg),
            Word::Sub => (Statement::Subroutine, ErrorKind::SubNumber, ErrorKind::Sub),
            Word::Gosub => (Statement::Call, ErrorKind::SubNumber, ErrorKind::Gosub),
            Word::End => return Ok(Statement::End),
            Word::EndSub => return Ok(Statement::EndSubroutine),
            Word::Else => return Ok(Statement::Else),
            Word::EndIf => return Ok(Statement::EndIf),
            _ => return Ok(Statement::EndWhile),
        };
        if self.peek() != Some(Token::Number) {
            let thing = if word == Word::Prg { "program" } else { "subroutine" };
            let span = self.rest(self.span().start);
            let message = format!("expected the number of a {thing}, found {}", self.found());
            return Err(Finding::error(missing, span, message));
        }
        let index = if word == Word::Prg { Index::Program } else { Index::Subroutine };
        self.index(index, range).map(statement)
    }

    /// The number behind a name, in its range.
    fn index(&mut self, index: Index, kind: ErrorKind) -> Result<u8> {
        let (span, text) = (self.span(), self.text());
        self.position += 1;
        let (first, last) = index.range(self.dialect);
        match text.parse() {
            Ok(number) if (first..=last).contains(&number) => Ok(number),
            _ => {
                let things = words::things(index);
                let message = match last {
                    0 => format!("the {} has no {things}", self.dialect.name),
                    _ => format!("the {} has {things} {first} to {last}", self.dialect.name),
                };
                Err(Finding::error(kind, span, message))
            }
        }
    }

    /// The index of a place that was found by its letters, from the number behind them.
    fn place(&mut self, place: Place) -> Result<Place> {
        match place.word.entry().suffix {
            Suffix::Index(index) => {
                let kind = if index == Index::Program { ErrorKind::Prg } else { ErrorKind::Bit };
                Ok(Place::new(place.word, self.index(index, kind)?))
            }
            _ => Ok(place),
        }
    }

    /// `=`, or why there is none.
    fn equals(&mut self) -> Result<()> {
        if self.take(Token::Equals) {
            return match self.peek() {
                Some(Token::Equals) => {
                    let finding = Finding::error(ErrorKind::Other, self.span(), "one `=` is enough");
                    Err(finding.hint("assignments and conditions have a single `=`"))
                }
                _ => Ok(()),
            };
        }
        let later = self.tokens[self.position..].iter().any(|&(token, _)| token == Token::Equals);
        let span = self.rest(self.span().start);
        Err(if later {
            let message = "only one variable or register can stand left of `=`";
            Finding::error(ErrorKind::Equals, span, message)
        } else {
            Finding::error(ErrorKind::MissingEquals, span, format!("expected `=`, found {}", self.found()))
        })
    }

    /// `V` was taken.
    fn assignment(&mut self, word: Span) -> Result<Statement> {
        if self.peek() != Some(Token::Number) {
            let finding = Finding::error(ErrorKind::Unknown, word, "`V` needs the number of a variable");
            return Err(finding.hint("variables are `V0`, `V1` and so on"));
        }
        let variable = self.index(Index::Variable, ErrorKind::VariableRange)?;
        self.equals()?;
        Ok(Statement::Assign(variable, self.expression(ErrorKind::Assignment)?))
    }

    /// A value, or an operator and its operands. What has no value is an error of the first kind if it is
    /// the first operand, else an [`ErrorKind::OperationArgument`].
    fn expression(&mut self, first: ErrorKind) -> Result<Expression> {
        if self.take(Token::Tilde) {
            let x = self.value(ErrorKind::OperationArgument)?;
            return Ok(Expression { operator: Operator::Not, x, y: None });
        }
        let x = self.value(first)?;
        let operator = match self.peek() {
            Some(Token::Plus | Token::Minus | Token::Operator) => Operator::from_symbol(self.text()),
            _ => None,
        };
        let Some(operator) = operator else { return Ok(Expression::value(x)) };
        self.position += 1;
        let y = self.value(ErrorKind::OperationArgument)?;
        Ok(Expression { operator, x, y: Some(y) })
    }

    fn condition(&mut self) -> Result<Condition> {
        let start = self.span().start;
        let left = self.expression(ErrorKind::OperationArgument)?;
        let comparison = match self.peek() {
            Some(Token::Equals | Token::Comparison) => Comparison::from_symbol(self.text()),
            _ => None,
        };
        let Some(comparison) = comparison else {
            return self.unexpected(ErrorKind::Other, "a comparison: `=`, `!=`, `<`, `>`, `<=` or `>=`");
        };
        self.position += 1;
        if let Some(Token::Equals | Token::Comparison) = self.peek() {
            let finding =
                Finding::error(ErrorKind::Other, self.span(), format!("unexpected {}", self.found()));
            return Err(finding.hint("comparisons are `=`, `!=`, `<`, `>`, `<=` and `>=`"));
        }
        let right = self.expression(ErrorKind::OperationArgument)?;
        if left.is_compound() && right.is_compound() {
            let message = "only one side of a condition can have an operator";
            return Err(Finding::error(ErrorKind::Other, self.since(start), message));
        }
        Ok(Condition { left, comparison, right })
    }

    /// An operand that has a value.
    fn value(&mut self, kind: ErrorKind) -> Result<Value> {
        let span = self.span();
        match self.peek() {
            Some(Token::Number | Token::Minus) => self.number().map(Value::Number),
            Some(Token::Word) => {
                let letters = self.text();
                self.position += 1;
                self.named_value(letters, span, kind)
            }
            _ => self.unexpected(kind, "a number, a variable or a register"),
        }
    }

    /// A variable or a register; its letters were taken.
    fn named_value(&mut self, letters: &str, span: Span, kind: ErrorKind) -> Result<Value> {
        let numbered = self.peek() == Some(Token::Number);
        if letters == "V" && numbered {
            return self.index(Index::Variable, ErrorKind::VariableRange).map(Value::Variable);
        }
        let place = Place::from_letters(letters, numbered, self.dialect);
        let readable = |place: &Place| {
            let entry = place.word.entry();
            entry.kind == Kind::Register
                && entry.access(self.dialect.family).is_some_and(|access| access.reads())
        };
        match place {
            Some(place) if readable(&place) => self.place(place).map(Value::Register),
            Some(_) => Err(Finding::error(kind, span, format!("`{letters}` cannot be read"))),
            None => {
                let hint = words::hint(letters, numbered, self.dialect);
                let message = format!("`{letters}` is no variable or register");
                Err(Finding { hint, ..Finding::error(kind, span, message) })
            }
        }
    }

    /// A number of 32 bits.
    fn number(&mut self) -> Result<i32> {
        let negative = self.peek() == Some(Token::Minus);
        let number = self.wide_number()?;
        i32::try_from(number).map_err(|_| {
            let span = self.since(self.tokens[self.position - 1 - usize::from(negative)].1.start);
            let message = format!("a number is at least {} and at most {}", i32::MIN, i32::MAX);
            Finding::error(ErrorKind::Other, span, message)
        })
    }

    /// A number of any size; beyond 64 bits it is as large as those can say.
    fn wide_number(&mut self) -> Result<i64> {
        let negative = self.take(Token::Minus);
        if self.peek() != Some(Token::Number) {
            let finding = self.unexpected(ErrorKind::Token, "a number");
            return finding.map_err(|finding| finding.hint("only numbers have a sign"));
        }
        let number: i64 = self.text().parse().unwrap_or(i64::MAX);
        self.position += 1;
        Ok(if negative { -number } else { number })
    }

    /// A number or a variable, and nothing else.
    fn simple_value(&mut self, kind: ErrorKind) -> Result<Value> {
        let span = self.span();
        match self.peek() {
            Some(Token::Number | Token::Minus) => self.number().map(Value::Number),
            Some(Token::Word) if self.text() == "V" => {
                self.position += 1;
                if self.peek() != Some(Token::Number) {
                    return self.unexpected(kind, "the number of a variable");
                }
                self.index(Index::Variable, ErrorKind::VariableRange).map(Value::Variable)
            }
            _ => {
                let message = format!("expected a number or a variable, found {}", self.found());
                let finding = Finding::error(kind, self.rest(span.start), message);
                let hint = "assign it to a variable first, then use that";
                Err(if self.peek() == Some(Token::Word) { finding.hint(hint) } else { finding })
            }
        }
    }

    /// A register or a command, which was found by its letters.
    fn set(&mut self, place: Place, entry: &Entry, word: Span) -> Result<Statement> {
        let place = self.place(place)?;
        self.equals()?;
        if !entry.access(self.dialect.family).is_some_and(|access| access.writes()) {
            let span = self.since(word.start);
            let message = format!("`{place}` can be read, but not set");
            return Err(Finding::error(ErrorKind::Equals, span, message));
        }
        if entry.kind == Kind::Register {
            return Ok(Statement::Set(place, self.simple_value(ErrorKind::NotNumberOrVariable)?));
        }
        let value = if place.word == Word::Delay && self.peek() == Some(Token::Number) {
            let span = self.span();
            let number = u32::try_from(self.wide_number()?).map_err(|_| {
                Finding::error(ErrorKind::Other, span, format!("a delay is at most {} ms", u32::MAX))
            })?;
            Value::Number(number as i32)
        } else {
            let (span, value) = (self.span(), self.simple_value(ErrorKind::NotNumberOrVariable)?);
            if let (Word::Delay, Value::Number(_)) = (place.word, value) {
                return Err(Finding::error(
                    ErrorKind::Other,
                    self.since(span.start),
                    "a delay is not negative",
                ));
            }
            value
        };
        Ok(Statement::Do(place, [Some(value), None, None, None]))
    }

    /// An action, which was found by its letters.
    fn action(&mut self, place: Place, entry: &Entry) -> Result<Statement> {
        let place = match entry.suffix {
            Suffix::Direction | Suffix::Home => {
                let direction = match self.peek() {
                    Some(Token::Plus) => Direction::Plus,
                    Some(Token::Minus) => Direction::Minus,
                    _ => return self.unexpected(ErrorKind::Token, "a direction, `+` or `-`"),
                };
                self.position += 1;
                Place::directed(place.word, place.index, direction)
            }
            _ => place,
        };
        let mut values = [None; OPERANDS];
        let count = entry.arguments(self.dialect);
        if entry.suffix == Suffix::Home && count > 0 {
            values[0] = Some(Value::Number(self.homing_mode()?));
            return Ok(Statement::Do(place, values));
        }
        for (argument, value) in values[..count].iter_mut().enumerate() {
            if argument > 0 && !self.take(Token::Colon) {
                return self.unexpected(ErrorKind::Token, &format!("`:` and {count} numbers in all"));
            }
            *value = Some(self.simple_value(ErrorKind::NotNumberOrVariable)?);
        }
        Ok(Statement::Do(place, values))
    }

    fn homing_mode(&mut self) -> Result<i32> {
        let modes = self.dialect.homing_modes;
        if self.peek() != Some(Token::Number) {
            return self.unexpected(ErrorKind::Token, &format!("a homing mode, 0 to {}", modes - 1));
        }
        let (span, text) = (self.span(), self.text());
        self.position += 1;
        match text.parse() {
            Ok(mode) if mode < i32::from(modes) => Ok(mode),
            _ => {
                let message = format!("homing modes are 0 to {}", modes - 1);
                Err(Finding::error(ErrorKind::Other, span, message))
            }
        }
    }

    /// `X1000`, `X1000YV1`.
    fn moves(&mut self) -> Result<Statement> {
        let mut values = [None; OPERANDS];
        let mut single = None;
        while self.peek() == Some(Token::Word) {
            let span = self.span();
            let Some(axis) = words::target_axis(self.text(), self.dialect) else { break };
            self.position += 1;
            if self.peek() == Some(Token::Equals) {
                let name = self.source.slice(&span);
                let hint = format!("a move is `{name}1000`; the position is `P{name}=1000`");
                return self.unexpected(ErrorKind::Token, "a target").map_err(|finding| finding.hint(hint));
            }
            let value = self.simple_value(ErrorKind::NotNumberOrVariable)?;
            let slot = &mut values[usize::from(axis)];
            if slot.replace(value).is_some() {
                let message = "an axis has one target only";
                return Err(Finding::error(ErrorKind::Other, self.since(span.start), message));
            }
            single = Some((words::MOVES[usize::from(axis)], axis, value));
        }
        Ok(match single {
            Some((word, axis, value)) if values.iter().flatten().count() == 1 => {
                Statement::Do(Place::new(word, axis), [Some(value), None, None, None])
            }
            _ => Statement::Do(Place::new(Word::Linear, 0), values),
        })
    }
}
