//! Files in TOML: every mistake as one line with file, line and key.

use serde::de::DeserializeOwned;
use std::path::Path;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// Why a bench file cannot be used; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The file cannot be read.
    #[error("{file}: {problem}")]
    Read {
        /// Name of the file.
        file: String,
        /// What the system says.
        problem: std::io::Error,
    },
    /// It is not TOML.
    #[error("{file}:{line}: {problem}")]
    Syntax {
        /// Name of the file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// An entry is unknown, missing or impossible.
    #[error("{file}:{line}: {key}: {problem}")]
    Entry {
        /// Name of the file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The key with all tables that it is in, as `device.axis.X.home`.
        key: String,
        /// What is wrong.
        problem: String,
    },
}

/// The text of a file, and its name for messages.
pub(crate) fn read(path: &Path) -> Result<(String, String), BenchError> {
    let file = path.display().to_string();
    match std::fs::read_to_string(path) {
        Ok(text) => Ok((text, file)),
        Err(problem) => Err(BenchError::Read { file, problem }),
    }
}

/// The text of a file and its name for messages.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub text: &'a str,
    pub file: &'a str,
}

impl<'a> Source<'a> {
    /// What is in it, and its table with the place of each entry.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<(DeTable<'a>, T), BenchError> {
        let document = DeTable::parse(self.text).map_err(|error| self.syntax(&error))?.into_inner();
        let content = toml::from_str(self.text).map_err(|error| self.mistyped(&document, &error))?;
        Ok((document, content))
    }

    fn line(&self, offset: usize) -> usize {
        self.text.bytes().take(offset).filter(|byte| *byte == b'\n').count() + 1
    }

    fn syntax(&self, error: &toml::de::Error) -> BenchError {
        let line = self.line(error.span().map_or(0, |span| span.start));
        BenchError::Syntax { file: self.file.into(), line, problem: one_line(error.message()) }
    }

    /// What serde found wrong, with the key that its span lies in.
    fn mistyped(&self, document: &DeTable<'_>, error: &toml::de::Error) -> BenchError {
        let offset = error.span().map_or(0, |span| span.start);
        let mut keys = Vec::new();
        let key = if find(document, offset, &mut keys) { keys.join(".") } else { "bench file".into() };
        let line = self.line(offset);
        BenchError::Entry { file: self.file.into(), line, key, problem: one_line(error.message()) }
    }

    /// An entry by its path, in which an element of an array is its number. Where the entry is not in
    /// the file the innermost table that is there is meant.
    pub fn entry(&self, document: &DeTable<'_>, path: &[&str], problem: String) -> BenchError {
        let mut offset = 0;
        let mut table = Some(document);
        let mut array = None;
        for key in path {
            let (place, value) = match (table, array) {
                (Some(table), _) => match table.get_key_value(*key) {
                    Some((key, value)) => (key.span().start, value),
                    None => break,
                },
                (None, Some(elements)) => {
                    let elements: &toml::de::DeArray<'_> = elements;
                    let value = key.parse().ok().and_then(|index: usize| elements.get(index));
                    let Some(value) = value else { break };
                    (value.span().start, value)
                }
                _ => break,
            };
            offset = place;
            table = value.get_ref().as_table();
            array = value.get_ref().as_array();
        }
        // The line says which device it is.
        let keys: Vec<_> =
            path.iter().enumerate().filter(|(place, _)| *place != 1).map(|(_, key)| *key).collect();
        BenchError::Entry { file: self.file.into(), line: self.line(offset), key: keys.join("."), problem }
    }
}

/// Finds the innermost key that `offset` lies in.
fn find(table: &DeTable<'_>, offset: usize, keys: &mut Vec<String>) -> bool {
    table.iter().any(|(key, value)| {
        keys.push(key.get_ref().to_string());
        let inside = key.span().contains(&offset) || find_in(value, offset, keys);
        if !inside {
            keys.pop();
        }
        inside
    })
}

fn find_in(value: &Spanned<DeValue<'_>>, offset: usize, keys: &mut Vec<String>) -> bool {
    // The span of a table ends with its heading, its entries may come later.
    let nested = match value.get_ref() {
        DeValue::Table(table) => find(table, offset, keys),
        DeValue::Array(values) => values.iter().any(|value| find_in(value, offset, keys)),
        _ => false,
    };
    nested || value.span().contains(&offset)
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
