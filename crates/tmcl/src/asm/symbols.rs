//! Labels and constants, and the value of expressions.

use super::parser::{Expression, Node, Operator, Span};
use source::Source;
use std::collections::BTreeMap;

/// How many constants may be defined by means of each other, in a row, before their definition.
const MAX_CHAIN: usize = 64;

/// What a symbol stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Definition {
    /// An address.
    Label(i64),
    /// An expression in a file, not evaluated yet.
    Pending(Expression),
    /// It is being evaluated.
    Open,
    /// A number.
    Constant(i64),
    /// Its expression is wrong, which has been reported.
    Broken,
}

/// A symbol and where it is defined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    pub(super) file: usize,
    pub(super) span: Span,
    pub(super) definition: Definition,
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ValueError {
    /// Something is wrong at a place of a file.
    At(usize, Span, Reason),
    /// A symbol is wrong where it is defined, and that is reported there.
    Reported,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reason {
    Undefined,
    Overflow,
    DivisionByZero,
    Circular,
    Chain,
}

impl Reason {
    pub(super) fn message(self, text: &str) -> String {
        match self {
            Self::Undefined => format!("`{text}` is not defined"),
            Self::Overflow => format!("the value of `{text}` does not fit 64 bits"),
            Self::DivisionByZero => format!("`{text}` divides by zero"),
            Self::Circular => format!("`{text}` is defined by means of itself"),
            Self::Chain => format!("`{text}` depends on more than {MAX_CHAIN} constants that come later"),
        }
    }
}

#[derive(Default)]
pub(super) struct Symbols {
    pub(super) entries: BTreeMap<String, Entry>,
    depth: usize,
}

impl Symbols {
    /// The value of an expression in a file.
    pub(super) fn evaluate(
        &mut self,
        sources: &[Source],
        file: usize,
        expression: &Expression,
    ) -> Result<i64, ValueError> {
        let fail = |reason| Err(ValueError::At(file, expression.span.clone(), reason));
        match &expression.node {
            Node::Number(Some(value)) => Ok(*value),
            Node::Number(None) => fail(Reason::Overflow),
            Node::Name => match self.resolve(sources, sources[file].slice(&expression.span)) {
                Ok(Ok(value)) => Ok(value),
                Ok(Err(reason)) => fail(reason),
                Err(error) => Err(error),
            },
            Node::Negative(operand) => {
                let operand = self.evaluate(sources, file, operand)?;
                operand.checked_neg().map_or_else(|| fail(Reason::Overflow), Ok)
            }
            Node::Binary(operator, left, right) => {
                let left = self.evaluate(sources, file, left)?;
                let right = self.evaluate(sources, file, right)?;
                if *operator == Operator::Divide && right == 0 {
                    return fail(Reason::DivisionByZero);
                }
                let result = match operator {
                    Operator::Add => left.checked_add(right),
                    Operator::Subtract => left.checked_sub(right),
                    Operator::Multiply => left.checked_mul(right),
                    Operator::Divide => left.checked_div(right),
                };
                result.map_or_else(|| fail(Reason::Overflow), Ok)
            }
        }
    }

    /// The value of a symbol. The inner error is one of the place that uses it, the outer one of its
    /// definition.
    fn resolve(&mut self, sources: &[Source], name: &str) -> Result<Result<i64, Reason>, ValueError> {
        let Some(entry) = self.entries.get_mut(name) else { return Ok(Err(Reason::Undefined)) };
        match &entry.definition {
            Definition::Label(value) | Definition::Constant(value) => Ok(Ok(*value)),
            Definition::Open => Ok(Err(Reason::Circular)),
            Definition::Broken => Err(ValueError::Reported),
            Definition::Pending(_) if self.depth == MAX_CHAIN => Ok(Err(Reason::Chain)),
            Definition::Pending(_) => self.define(sources, name).map(Ok),
        }
    }

    /// Evaluates a constant that has not been.
    pub(super) fn define(&mut self, sources: &[Source], name: &str) -> Result<i64, ValueError> {
        let entry = self.entries.get_mut(name).ok_or(ValueError::Reported)?;
        let file = entry.file;
        let expression = match std::mem::replace(&mut entry.definition, Definition::Open) {
            Definition::Pending(expression) => expression,
            other => {
                let value = match other {
                    Definition::Constant(value) | Definition::Label(value) => Ok(value),
                    _ => Err(ValueError::Reported),
                };
                entry.definition = other;
                return value;
            }
        };
        self.depth += 1;
        let value = self.evaluate(sources, file, &expression);
        self.depth -= 1;
        if let Some(entry) = self.entries.get_mut(name) {
            entry.definition =
                value.as_ref().map_or(Definition::Broken, |&value| Definition::Constant(value));
        }
        value
    }
}
