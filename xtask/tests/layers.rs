//! The table of crates in ARCHITECTURE.md is what `cargo metadata` says, and keeps its promises.

use cargo_metadata::{Metadata, MetadataCommand};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// One row of the table.
#[derive(Debug, PartialEq)]
struct Room {
    name: String,
    may_use: BTreeSet<String>,
    no_std: bool,
}

const HEAD: [&str; 4] = ["crate", "what lives there", "may use", "must not know"];

/// Reads the table whose head is [`HEAD`]. `all` means every crate of the table, a dash none.
fn rooms(text: &str) -> Result<Vec<Room>, String> {
    let mut lines = text.lines().map(cells);
    lines.find(|cells| cells.iter().eq(&HEAD)).ok_or("no table of crates")?;
    let rows: Vec<_> = lines.skip(1).take_while(|cells| !cells.is_empty()).collect();
    let names: BTreeSet<String> = rows.iter().flat_map(|row| quoted(row[0])).collect();
    rows.iter()
        .map(|row| {
            let [name, lives, may_use, _] = row[..] else { return Err(format!("not four cells: {row:?}")) };
            let name = quoted(name).pop().ok_or_else(|| format!("no crate named: {row:?}"))?;
            let may_use = match may_use {
                "–" => BTreeSet::new(),
                "all" => names.clone(),
                list => quoted(list).into_iter().collect(),
            };
            let unknown: Vec<_> = may_use.difference(&names).collect();
            if !unknown.is_empty() || (may_use.is_empty() && row[2] != "–") {
                return Err(format!("`{name}` may use what is not in the table: {}", row[2]));
            }
            Ok(Room { name, may_use, no_std: lives.contains("`no_std`") })
        })
        .collect()
}

fn cells(line: &str) -> Vec<&str> {
    let inner = line.trim().strip_prefix('|').and_then(|line| line.strip_suffix('|'));
    inner.map(|inner| inner.split('|').map(str::trim).collect()).unwrap_or_default()
}

/// The words between backticks.
fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn workspace() -> (Metadata, Vec<Room>) {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("Cargo.toml");
    let metadata = MetadataCommand::new().manifest_path(manifest).no_deps().exec().unwrap();
    let text = fs::read_to_string(metadata.workspace_root.join("ARCHITECTURE.md")).unwrap();
    let rooms = rooms(&text).unwrap();
    (metadata, rooms)
}

/// Each crate of ours with the crates of ours that it depends on, for building or for its tests.
fn uses(metadata: &Metadata) -> BTreeMap<String, BTreeSet<String>> {
    let ours = metadata.workspace_packages().into_iter().filter(|package| package.name.as_str() != "xtask");
    ours.map(|package| {
        let own = package.dependencies.iter().filter(|dependency| dependency.path.is_some());
        (package.name.to_string(), own.map(|dependency| dependency.name.clone()).collect())
    })
    .collect()
}

#[test]
fn every_crate_has_a_row_and_every_row_a_crate() {
    let (metadata, rooms) = workspace();
    let rows: Vec<_> = rooms.iter().map(|room| room.name.as_str()).collect();
    let uses = uses(&metadata);
    let mut crates: Vec<_> = uses.keys().map(String::as_str).collect();
    crates.sort_by_key(|name| rows.iter().position(|row| row == name));
    assert_eq!(crates, rows);
}

#[test]
fn a_crate_uses_only_what_its_row_allows() {
    let (metadata, rooms) = workspace();
    let uses = uses(&metadata);
    for room in rooms {
        let more: Vec<_> = uses[&room.name].difference(&room.may_use).collect();
        assert!(more.is_empty(), "`{}` uses {more:?}, which its row in ARCHITECTURE.md forbids", room.name);
    }
}

#[test]
fn a_folder_is_called_like_its_crate() {
    let (metadata, _) = workspace();
    for package in metadata.workspace_packages() {
        let folder = package.manifest_path.parent().and_then(|folder| folder.file_name());
        assert_eq!(folder, Some(package.name.as_str()));
    }
}

#[test]
fn what_promises_no_std_says_so_to_the_compiler() {
    let (metadata, rooms) = workspace();
    let promised: Vec<_> = rooms.iter().filter(|room| room.no_std).collect();
    assert!(!promised.is_empty(), "no row promises `no_std`");
    for room in promised {
        let file = metadata.workspace_root.join(format!("crates/{}/src/lib.rs", room.name));
        let text = fs::read_to_string(&file).unwrap();
        let says = |line: &str| line.starts_with("#![") && line.ends_with("no_std)]") || line == "#![no_std]";
        assert!(text.lines().any(says), "{file} has no #![no_std]");
    }
}

fn table(rows: &str) -> String {
    format!("# Title\n\n| {} |\n|---|---|---|---|\n{rows}\n\nmore text\n", HEAD.join(" | "))
}

#[track_caller]
fn check(rows: &str, expected: &[(&str, &[&str], bool)]) {
    let expected = expected.iter().map(|&(name, may_use, no_std)| {
        let may_use = may_use.iter().map(|&name| name.to_owned()).collect();
        Room { name: name.to_owned(), may_use, no_std }
    });
    assert_eq!(rooms(&table(rows)).unwrap(), expected.collect::<Vec<_>>());
}

#[test]
fn the_table_is_read_as_written() {
    check("| `a` | x. `no_std` | – | y |\n| `b` | x | `a` | – |", &[("a", &[], true), ("b", &["a"], false)]);
    check("| `a` | x | – | y |\n| `b` | x | all | – |", &[("a", &[], false), ("b", &["a", "b"], false)]);
}

#[test]
fn a_table_that_cannot_be_read_is_an_error() {
    for rows in ["| `b` | x | `a` | y |", "| `b` | x | a | y |", "| `b` | x | – |", "| b | x | – | y |"] {
        assert!(rooms(&table(rows)).is_err(), "{rows}");
    }
    assert!(rooms("no table").is_err());
}
