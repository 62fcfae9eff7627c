//! Executes the statements of a program, block by block.

use super::{Event, reading};
use crate::compiler::syntax::{Condition, Expression, Statement, Value};
use crate::compiler::{Source, parse};
use crate::dialect::Dialect;
use crate::isa::Operator;
use crate::line::OPERANDS;
use crate::vm::{Action, CALL_DEPTH, Fault};
use std::collections::HashMap;

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It came to its end.
    Stopped,
    /// A line could not be executed.
    Fault(Fault),
    /// It had all the events it was allowed.
    Events,
}

/// A statement, with the statements inside.
#[derive(Clone, Debug)]
enum Node {
    Plain(Statement),
    While(Condition, Vec<Node>),
    /// Branches with their conditions; that of `ELSE` has none.
    If(Vec<(Option<Condition>, Vec<Node>)>),
}

/// A program as a tree, and its variables.
#[derive(Clone, Debug)]
pub struct Interpreter {
    programs: HashMap<u8, Vec<Node>>,
    subroutines: HashMap<u8, Vec<Node>>,
    variables: Vec<i32>,
    trace: Vec<Event>,
    events: usize,
    depth: usize,
}

impl Interpreter {
    /// One for a source without errors, with all variables 0.
    pub fn new(source: &str, dialect: &Dialect) -> Self {
        let (lines, _) = parse(&Source::new("", source.as_bytes()), dialect);
        let mut statements = lines.into_iter().filter_map(|line| line.statement).peekable();
        let mut interpreter = Self {
            programs: HashMap::new(),
            subroutines: HashMap::new(),
            variables: vec![0; usize::from(dialect.variables)],
            trace: Vec::new(),
            events: 0,
            depth: 0,
        };
        while let Some(&statement) = statements.peek() {
            let (frames, number) = match statement {
                Statement::Subroutine(number) => (&mut interpreter.subroutines, number),
                Statement::Program(number) => (&mut interpreter.programs, number),
                _ => (&mut interpreter.programs, 0),
            };
            if matches!(statement, Statement::Subroutine(_) | Statement::Program(_)) {
                statements.next();
            }
            frames.insert(number, block(&mut statements));
            statements.next();
        }
        interpreter
    }

    /// The variables.
    pub fn variables(&self) -> &[i32] {
        &self.variables
    }

    /// Executes a program until it ends or has had so many events; gives these, and how it ended.
    pub fn run(&mut self, program: u8, events: usize) -> (Vec<Event>, End) {
        self.events = events;
        let end = match self.programs.get(&program).cloned() {
            Some(nodes) => self.block(&nodes).err().unwrap_or(End::Stopped),
            None => End::Stopped,
        };
        (std::mem::take(&mut self.trace), end)
    }

    fn block(&mut self, nodes: &[Node]) -> Result<(), End> {
        nodes.iter().try_for_each(|node| self.node(node))
    }

    fn node(&mut self, node: &Node) -> Result<(), End> {
        match node {
            Node::While(condition, body) => {
                while self.holds(*condition)? {
                    self.block(body)?;
                }
                Ok(())
            }
            Node::If(branches) => {
                for (condition, body) in branches {
                    if condition.map_or(Ok(true), |condition| self.holds(condition))? {
                        return self.block(body);
                    }
                }
                Ok(())
            }
            Node::Plain(Statement::Call(number)) => {
                let nodes = self.subroutines.get(number).cloned().ok_or(Fault::NoSubroutine(*number))?;
                if self.depth == CALL_DEPTH {
                    return Err(Fault::CallDepth.into());
                }
                self.depth += 1;
                self.block(&nodes)?;
                self.depth -= 1;
                Ok(())
            }
            Node::Plain(Statement::Assign(variable, expression)) => {
                self.variables[usize::from(*variable)] = self.expression(*expression)?;
                Ok(())
            }
            Node::Plain(Statement::Set(place, value)) => {
                let value = self.value(*value)?;
                self.event(Event::Write(*place, value))
            }
            Node::Plain(Statement::Do(place, values)) => {
                let mut found = [None; OPERANDS];
                for (found, value) in found.iter_mut().zip(values) {
                    *found = value.map(|value| self.value(value)).transpose()?;
                }
                self.event(Event::Do(Action::new(*place, found)))
            }
            Node::Plain(statement) => unreachable!("{statement} is not plain"),
        }
    }

    fn event(&mut self, event: Event) -> Result<(), End> {
        self.trace.push(event);
        if self.trace.len() == self.events { Err(End::Events) } else { Ok(()) }
    }

    fn value(&mut self, value: Value) -> Result<i32, End> {
        match value {
            Value::Number(number) => Ok(number),
            Value::Variable(index) => Ok(self.variables[usize::from(index)]),
            Value::Register(place) => {
                let value = reading(self.trace.len());
                self.event(Event::Read(place)).map(|()| value)
            }
        }
    }

    /// The values of the operands.
    fn operands(&mut self, Expression { operator, x, y }: Expression) -> Result<(Operator, i32, i32), End> {
        Ok((operator, self.value(x)?, y.map_or(Ok(0), |y| self.value(y))?))
    }

    fn expression(&mut self, expression: Expression) -> Result<i32, End> {
        let (operator, x, y) = self.operands(expression)?;
        Ok(operator.apply(x, y).ok_or(Fault::DivisionByZero)?)
    }

    /// All registers are read before anything is calculated, those of the side with an operator first.
    fn holds(&mut self, Condition { left, comparison, right }: Condition) -> Result<bool, End> {
        let mirrored = right.is_compound();
        let (first, second) = if mirrored { (right, left) } else { (left, right) };
        let (operator, x, y) = self.operands(first)?;
        let second = self.expression(second)?;
        let first = operator.apply(x, y).ok_or(Fault::DivisionByZero)?;
        let (left, right) = if mirrored { (second, first) } else { (first, second) };
        Ok(comparison.holds(left, right))
    }
}

/// The statements up to the one that ends the block, which stays.
fn block<I: Iterator<Item = Statement>>(statements: &mut std::iter::Peekable<I>) -> Vec<Node> {
    let mut nodes = Vec::new();
    while let Some(statement) = statements.next_if(|statement| !statement.closes()) {
        nodes.push(match statement {
            Statement::While(condition) => {
                let body = block(statements);
                statements.next();
                Node::While(condition, body)
            }
            Statement::If(condition) => {
                let mut branches = vec![(Some(condition), block(statements))];
                loop {
                    match statements.next() {
                        Some(Statement::ElseIf(condition)) => {
                            branches.push((Some(condition), block(statements)));
                        }
                        Some(Statement::Else) => branches.push((None, block(statements))),
                        _ => break Node::If(branches),
                    }
                }
            }
            statement => Node::Plain(statement),
        });
    }
    nodes
}
