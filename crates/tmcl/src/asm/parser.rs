//! Tokens to statements, a line at a time. An error ends its line only.

use super::lexer::{self, Spanned, Token};
use source::Source;
use std::ops::Range;

/// How deep parentheses and signs nest.
const MAX_NESTING: usize = 64;

/// Most operators between numbers in a line, which bounds how deep the tree of a long sum gets.
const MAX_OPERATORS: usize = 256;

pub(super) type Span = Range<usize>;

/// A number, or how to get one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expression {
    /// Where it stands.
    pub span: Span,
    /// What it is.
    pub node: Node,
}

/// How to get a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A number; `None` if it does not fit 64 bits.
    Number(Option<i64>),
    /// A symbol or a keyword: the text at the span.
    Name,
    /// A number with the other sign.
    Negative(Box<Expression>),
    /// Two numbers and what is between them.
    Binary(Operator, Box<Expression>, Box<Expression>),
}

/// What is between two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
}

/// What a line says. Spans are those of the names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Statement {
    /// A label.
    Label(Span),
    /// A constant and its value.
    Constant(Span, Expression),
    /// A mnemonic and its operands.
    Command(Span, Vec<Expression>),
    /// The name of a file that is to be read here.
    Include(Span),
    /// No `STOP` is to be appended.
    NoStop,
}

/// Why a line is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// Where.
    pub span: Span,
    /// What is the matter.
    pub message: String,
}

type Result<T> = std::result::Result<T, SyntaxError>;

fn error<T>(span: Span, message: impl Into<String>) -> Result<T> {
    Err(SyntaxError { span, message: message.into() })
}

/// The statements of a source, and what is wrong with the lines that are none.
pub fn parse(source: &Source) -> (Vec<Statement>, Vec<SyntaxError>) {
    let (mut statements, mut errors) = (Vec::new(), Vec::new());
    for tokens in lexer::lines(&source.text) {
        let mut line = Line { source, tokens: &tokens, position: 0, operators: 0 };
        if let Err(error) = line.statements(&mut statements) {
            errors.push(error);
        }
    }
    (statements, errors)
}

struct Line<'a> {
    source: &'a Source,
    /// At least one.
    tokens: &'a [Spanned],
    position: usize,
    operators: usize,
}

impl Line<'_> {
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

    fn take(&mut self, token: Token) -> bool {
        let found = self.peek() == Some(token);
        self.position += usize::from(found);
        found
    }

    fn unexpected<T>(&self, expected: &str) -> Result<T> {
        let span = self.span();
        let found = match self.peek() {
            None => "the end of the line".to_owned(),
            Some(_) => format!("`{}`", self.source.slice(&span)),
        };
        error(span, format!("expected {expected}, found {found}"))
    }

    fn statements(&mut self, statements: &mut Vec<Statement>) -> Result<()> {
        loop {
            let span = self.span();
            match self.peek() {
                None => return Ok(()),
                Some(Token::Directive) => {
                    self.position += 1;
                    statements.push(self.directive(span)?);
                }
                Some(Token::Name) => {
                    self.position += 1;
                    if self.take(Token::Colon) {
                        // A command may follow on the same line.
                        statements.push(Statement::Label(span));
                        continue;
                    }
                    if self.take(Token::Equals) {
                        let value = self.expression(0)?;
                        statements.push(Statement::Constant(span, value));
                    } else {
                        let operands = self.operands()?;
                        statements.push(Statement::Command(span, operands));
                    }
                }
                Some(_) => return self.unexpected("a label, a name or a command"),
            }
            return if self.peek().is_none() { Ok(()) } else { self.unexpected("the end of the line") };
        }
    }

    fn directive(&self, span: Span) -> Result<Statement> {
        let text = self.source.slice(&span);
        let text = text.split("//").next().unwrap_or_default();
        let body = text[1..].trim_start();
        let (word, rest) = body.split_once([' ', '\t', '"', '<']).unwrap_or((body, ""));
        if word.trim_end().eq_ignore_ascii_case("nostop") {
            return Ok(Statement::NoStop);
        }
        if !word.eq_ignore_ascii_case("include") {
            let end = span.start + text.trim_end().len();
            return error(span.start..end, "unknown directive; there are `#include` and `#nostop`");
        }
        let name = rest.trim_matches([' ', '\t', '"', '<', '>']);
        if name.is_empty() {
            return error(span, "`#include` needs the name of a file");
        }
        let start = span.start + text.rfind(name).unwrap_or(0);
        Ok(Statement::Include(start..start + name.len()))
    }

    fn operands(&mut self) -> Result<Vec<Expression>> {
        let mut operands = Vec::new();
        if self.peek().is_none() {
            return Ok(operands);
        }
        loop {
            operands.push(self.expression(0)?);
            if !self.take(Token::Comma) {
                return Ok(operands);
            }
        }
    }

    /// Sums and differences, from left to right.
    fn expression(&mut self, depth: usize) -> Result<Expression> {
        let mut left = self.term(depth)?;
        loop {
            let operator = match self.peek() {
                Some(Token::Plus) => Operator::Add,
                Some(Token::Minus) => Operator::Subtract,
                _ => return Ok(left),
            };
            self.position += 1;
            let right = self.term(depth)?;
            left = self.binary(operator, left, right)?;
        }
    }

    /// Products and quotients, from left to right.
    fn term(&mut self, depth: usize) -> Result<Expression> {
        let mut left = self.factor(depth)?;
        loop {
            let operator = match self.peek() {
                Some(Token::Star) => Operator::Multiply,
                Some(Token::Slash) => Operator::Divide,
                _ => return Ok(left),
            };
            self.position += 1;
            let right = self.factor(depth)?;
            left = self.binary(operator, left, right)?;
        }
    }

    fn binary(&mut self, operator: Operator, left: Expression, right: Expression) -> Result<Expression> {
        let span = left.span.start..right.span.end;
        self.operators += 1;
        if self.operators > MAX_OPERATORS {
            return error(span, format!("a line has at most {MAX_OPERATORS} operators"));
        }
        Ok(Expression { span, node: Node::Binary(operator, Box::new(left), Box::new(right)) })
    }

    fn factor(&mut self, depth: usize) -> Result<Expression> {
        let span = self.span();
        if depth > MAX_NESTING {
            return error(span, format!("an expression nests at most {MAX_NESTING} deep"));
        }
        let Some(token) = self.peek() else { return self.unexpected("a number or a name") };
        let text = self.source.slice(&span);
        let node = match token {
            Token::Name => Node::Name,
            Token::Decimal => Node::Number(text.parse().ok()),
            Token::Hexadecimal => Node::Number(digits(text, 16)),
            Token::Binary => Node::Number(digits(text, 2)),
            Token::Minus | Token::Plus => {
                self.position += 1;
                let operand = self.factor(depth + 1)?;
                if token == Token::Plus {
                    return Ok(operand);
                }
                let span = span.start..operand.span.end;
                return Ok(Expression { span, node: Node::Negative(Box::new(operand)) });
            }
            Token::Open => {
                self.position += 1;
                let inner = self.expression(depth + 1)?;
                let end = self.span().end;
                if !self.take(Token::Close) {
                    return self.unexpected("`)`");
                }
                return Ok(Expression { span: span.start..end, node: inner.node }.with_name_of(inner.span));
            }
            _ => return self.unexpected("a number or a name"),
        };
        self.position += 1;
        Ok(Expression { span, node })
    }
}

impl Expression {
    /// A name is read from its span, so parentheses around it must not widen that.
    fn with_name_of(self, span: Span) -> Self {
        if self.node == Node::Name { Self { span, ..self } } else { self }
    }
}

/// The number behind a prefix of `$`, `%` or two characters.
fn digits(text: &str, radix: u32) -> Option<i64> {
    let prefix = if text.starts_with(['$', '%']) { 1 } else { 2 };
    i64::from_str_radix(&text[prefix..], radix).ok()
}
