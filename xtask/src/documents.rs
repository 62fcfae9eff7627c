//! Documents that a program writes. One list: the example, and the file that holds what it prints. What pages show
//! of the program itself is looked after by a test of `cli`, which is told here to rewrite it.

use crate::{
    rust::ALL,
    workplace::{Workplace, read},
};
use anyhow::{Context, Result, bail};
use std::{fs, path::Path};

/// A generated document: what an example prints.
struct Document {
    /// The example that prints it.
    example: &'static str,
    arguments: &'static [&'static str],
    file: &'static str,
}

/// A page of the example that writes conformance pages.
macro_rules! conformance {
    ($model:literal) => {
        Document {
            example: "conformance",
            arguments: &[$model],
            file: concat!("docs/conformance/", $model, ".md"),
        }
    };
}

const DOCUMENTS: &[Document] = &[
    conformance!("pd42-1140"),
    conformance!("pmx-2ed"),
    conformance!("cmd-4cr"),
    // The types that the page shares with the server.
    Document { example: "typescript", arguments: &[], file: "web/src/api/contract.ts" },
];

/// The test of the pages, which writes them anew where [`OVERWRITE`] is in its environment.
const PAGES: &[&str] =
    &["test", "--quiet", "--locked", "--workspace", ALL, "--test", "docs", "the_pages_are_true"];
const OVERWRITE: (&str, &str) = ("SNAPSHOTS", "overwrite");

impl Document {
    /// What it has to be.
    fn print(&self, workplace: &Workplace) -> Result<String> {
        let program = workplace.target.join("debug/examples").join(self.example);
        read(&mut workplace.command(program, self.arguments))
    }
}

/// Builds the examples, as the tests do, whose build this shares.
fn build(workplace: &Workplace) -> Result<()> {
    workplace.cargo(&["build", "--quiet", "--locked", "--workspace", ALL, "--examples"])
}

/// Writes every document.
pub fn write(workplace: &Workplace) -> Result<()> {
    build(workplace)?;
    for document in DOCUMENTS {
        let text = document.print(workplace)?;
        let path = workplace.root.join(document.file);
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        fs::write(&path, text).with_context(|| document.file)?;
        println!("wrote {}", document.file);
    }
    read(workplace.command("cargo", PAGES).env(OVERWRITE.0, OVERWRITE.1))?;
    println!("wrote what the pages show");
    Ok(())
}

/// Compares every document with what would be written.
pub fn check(workplace: &Workplace) -> Result<()> {
    build(workplace)?;
    for document in DOCUMENTS {
        let wanted = document.print(workplace)?;
        let present = fs::read_to_string(workplace.root.join(document.file)).unwrap_or_default();
        if let Some(line) = first_difference(&present, &wanted) {
            bail!("{} is out of date from line {line} on: cargo xtask docs", document.file);
        }
        println!("{} is up to date", document.file);
    }
    Ok(())
}

/// The number of the first line that differs, from 1.
fn first_difference(present: &str, wanted: &str) -> Option<usize> {
    let (mut present, mut wanted) = (present.split('\n'), wanted.split('\n'));
    (1..).find_map(|line| match (present.next(), wanted.next()) {
        (None, None) => Some(None),
        (a, b) if a == b => None,
        _ => Some(Some(line)),
    })?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(present: &str, wanted: &str, expected: Option<usize>) {
        assert_eq!(first_difference(present, wanted), expected);
    }

    #[test]
    fn the_first_different_line_is_named() {
        check("a\nb\n", "a\nb\n", None);
        check("a\nb\n", "a\nc\n", Some(2));
        check("", "a\n", Some(1));
        check("a\n", "a\nb\n", Some(2));
        check("a\nb\n", "a\nb", Some(3));
    }
}
