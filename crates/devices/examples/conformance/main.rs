//! Prints the conformance page of a controller: every entry of its manual's tables, from our tables, with the
//! test that holds it. Fails if a test does not exist that the page, or that of the decisions, names.

mod ascii;
mod cmd4cr;
mod pd42;
mod pmx2ed;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// What makes the page of a model.
type Page = fn() -> String;

/// The pages by their model.
const PAGES: &[(&str, Page)] =
    &[("pd42-1140", pd42::page), ("pmx-2ed", pmx2ed::page), ("cmd-4cr", cmd4cr::page)];

fn main() -> ExitCode {
    let model = std::env::args().nth(1).unwrap_or_default();
    let Some((_, page)) = PAGES.iter().find(|(name, _)| *name == model) else {
        let names: Vec<_> = PAGES.iter().map(|(name, _)| *name).collect();
        eprintln!("error: whose page? one of {}", names.join(", "));
        return ExitCode::FAILURE;
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let tests = tests(&root.join("crates"));
    let page = page();
    let decisions = root.join(format!("docs/conformance/{model}-decisions.md"));
    let decisions = fs::read_to_string(decisions).unwrap_or_default();
    let missing: Vec<_> =
        named(&page).chain(named(&decisions)).filter(|name| !tests.contains(*name)).collect();
    if !missing.is_empty() {
        eprintln!("error: no such test: {}", missing.join(", "));
        return ExitCode::FAILURE;
    }
    print!("{page}");
    ExitCode::SUCCESS
}

/// The tests that the tables of a page name: what stands between backticks in the last column.
fn named(page: &str) -> impl Iterator<Item = &str> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let columns = rows.filter_map(|row| row.rsplit(" | ").next());
    columns.flat_map(|column| column.split('`').skip(1).step_by(2))
}

/// The names of all functions in our sources that are tests.
fn tests(folder: &Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap_or_default();
                let mut lines = text.lines().map(str::trim);
                while let Some(line) = lines.next() {
                    if line == "#[test]"
                        && let Some(name) = lines.find_map(|line| line.strip_prefix("fn "))
                    {
                        names.insert(name.split('(').next().unwrap_or_default().to_owned());
                    }
                }
            }
        }
    }
    names
}
