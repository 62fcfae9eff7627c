//! House rules that a compiler does not know, checked on every file that git knows or would add.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Source files above this length have a second idea in them.
const LINES_A_FILE: usize = 800;

/// Files of ours that may say `unsafe`. The workspace's lints forbid it everywhere; a crate that needs it
/// must leave those lints and be named here, with the reason beside it.
const UNSAFE_ALLOWED: &[&str] = &[
    // Where registers are, the vectors of interrupts, the addresses of the stack, and a handler that is declared so.
    "firmware/boards/mps2-an386/src/registers.rs",
    "firmware/boards/mps2-an386/src/vectors.rs",
    "firmware/boards/mps2-an386/src/bench/stack.rs",
    "firmware/boards/mps2-an386/src/watchdog.rs",
    "firmware/boards/nucleo-g474re/src/chip.rs",
    "firmware/boards/nucleo-g474re/src/flash.rs",
    // The handler of faults begins the stack anew.
    "firmware/images/src/fault.rs",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The files of the project, relative to its root: tracked, or new and not ignored.
fn files() -> Vec<PathBuf> {
    let arguments = ["ls-files", "-z", "--cached", "--others", "--exclude-standard"];
    let output = Command::new("git").args(arguments).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let names = String::from_utf8(output.stdout).unwrap();
    let paths = names.split_terminator('\0').map(PathBuf::from).filter(|path| root().join(path).is_file());
    let paths: Vec<_> = paths.collect();
    assert!(paths.iter().any(|path| path == Path::new("Cargo.toml")), "git does not list our files");
    paths
}

/// The text files among them.
fn texts() -> impl Iterator<Item = (PathBuf, String)> {
    files().into_iter().filter_map(|path| {
        let text = String::from_utf8(fs::read(root().join(&path)).ok()?).ok()?;
        Some((path, text))
    })
}

fn is_source(path: &Path) -> bool {
    path.extension().is_some_and(|extension| ["rs", "py", "ts"].iter().any(|ours| extension == *ours))
}

/// Fails with all the places at once.
#[track_caller]
fn none(rule: &str, places: impl Iterator<Item = String>) {
    let places: Vec<_> = places.collect();
    assert!(places.is_empty(), "{rule}:\n{}", places.join("\n"));
}

#[test]
fn no_source_file_is_too_long() {
    // One that is written by a program has as many as it needs.
    let sources = texts().filter(|(path, _)| is_source(path) && !path.ends_with("web/src/api/contract.ts"));
    let long = sources.map(|(path, text)| (path, text.lines().count())).filter(|(_, n)| *n > LINES_A_FILE);
    none("more than 800 lines", long.map(|(path, lines)| format!("{}: {lines}", path.display())));
}

#[test]
fn unsafe_code_is_where_it_is_allowed() {
    let sources = texts().filter(|(path, _)| path.extension().is_some_and(|extension| extension == "rs"));
    let others = sources.filter(|(path, _)| !UNSAFE_ALLOWED.iter().any(|allowed| path == Path::new(allowed)));
    let places = others.flat_map(|(path, text)| {
        let lines: Vec<_> = text.lines().enumerate().filter(|(_, line)| says_unsafe(line)).collect();
        lines.iter().map(|(at, _)| format!("{}:{}", path.display(), at + 1)).collect::<Vec<_>>()
    });
    none("unsafe code", places);
}

/// Whether a line of Rust opens something unsafe; comments may talk about it.
fn says_unsafe(line: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default();
    let mut at = code.match_indices("unsafe ");
    at.any(|(at, word)| {
        let whole = !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let next = code[at + word.len()..].trim_start();
        whole && ["{", "fn ", "impl", "extern", "trait "].iter().any(|opening| next.starts_with(opening))
    })
}

#[test]
fn unsafe_code_is_recognised() {
    // Put together here, or this file would be the first to be found.
    let line = |text: &str| text.replace('?', "unsafe");
    for text in
        ["? { x }", "pub ? fn f();", "    ? impl Send for X {}", "let x = ? { y };", "? impl<T> S for T {}"]
    {
        assert!(says_unsafe(&line(text)), "{text}");
    }
    for text in ["// ? { x }", "forbid(?_code)", "let ?_speed = 3;", "let not_? { a } = b;", "is ? here"] {
        assert!(!says_unsafe(&line(text)), "{text}");
    }
}

#[test]
fn every_crate_has_the_lints_of_the_workspace() {
    let manifests = texts().filter(|(path, _)| path.ends_with("Cargo.toml"));
    // The fuzz targets are a workspace of their own; libFuzzer's macro expands to unsafe code.
    let ours = manifests.filter(|(path, _)| !path.starts_with("fuzz"));
    let without = ours.filter(|(_, text)| {
        let manifest: toml::Table = toml::from_str(text).unwrap();
        // A workspace without a crate of its own is where the lints are.
        if !manifest.contains_key("package") {
            return false;
        }
        let inherits = manifest.get("lints").and_then(|lints| lints.get("workspace"));
        inherits != Some(&toml::Value::Boolean(true))
    });
    none("no `lints.workspace = true`", without.map(|(path, _)| path.display().to_string()));
}

#[test]
fn no_file_names_a_place_on_one_machine() {
    // Split, or this file would be the first to be found.
    let places =
        [["/wo", "rk/"], ["/ro", "ot/"], ["/ho", "me/"], ["/Us", "ers/"]].map(|parts| parts.concat());
    let found = texts().flat_map(|(path, text)| {
        let found =
            text.lines().enumerate().filter(|(_, line)| places.iter().any(|place| starts_path(line, place)));
        found.map(|(at, _)| format!("{}:{}", path.display(), at + 1)).collect::<Vec<_>>()
    });
    none("a path of one machine", found);
}

/// Whether `place` stands in the line as the beginning of an absolute path.
fn starts_path(line: &str, place: &str) -> bool {
    let mut at = line.match_indices(place);
    at.any(|(at, _)| !line[..at].ends_with(|c: char| c.is_alphanumeric() || "._-/}*".contains(c)))
}

#[test]
fn paths_are_recognised() {
    assert!(starts_path("see /x/file", "/x/") && starts_path("/x/", "/x/") && starts_path("pty:/x/y", "/x/"));
    assert!(!starts_path("a/x/b", "/x/") && !starts_path("see /xx/", "/x/") && !starts_path("../x/", "/x/"));
}
