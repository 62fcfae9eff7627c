//! The pages keep true: their `console` blocks are run and say what is printed, and the pictures that they draw
//! are those of `docs/images`. CONTRIBUTING.md has the rules; with `SNAPSHOTS=overwrite` in the environment the
//! pages and pictures are made to say what is true.

mod common;

use common::{PATIENCE, directory};
use snapbox::{Data, filter::NormalizeToExpected};
use std::{
    collections::BTreeSet,
    env, fs,
    io::{Read, Write},
    os::unix::{fs::symlink, process::ExitStatusExt},
    path::{Path, PathBuf},
    process::{Command, ExitStatus, Stdio},
    sync::mpsc,
    thread,
};

/// What opens and closes a block that is run.
const OPENING: &str = "```console";
const CLOSING: &str = "```";

/// What stands before a command, before the lines that it goes on in, and before another exit status than 0.
const COMMAND: &str = "$ ";
const CONTINUATION: &str = "> ";
const STATUS: &str = "? ";

/// What stands before a line that the reader types into the debugger.
const PROMPT: &str = "(debug) ";

/// Where pages have their pictures.
const IMAGES: &str = "docs/images";

/// A command of a page.
#[derive(Debug, PartialEq)]
struct Step {
    /// The number of its first line, from 0.
    line: usize,
    /// For the shell.
    command: String,
    status: i32,
    /// The lines with what it prints.
    shown: std::ops::Range<usize>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The commands in the `console` blocks of a page.
fn steps(lines: &[&str]) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut inside = false;
    let mut at = 0;
    while at < lines.len() {
        let line = at;
        at += 1;
        if !inside {
            inside = lines[line] == OPENING;
        } else if lines[line] == CLOSING {
            inside = false;
        } else if let Some(first) = lines[line].strip_prefix(COMMAND) {
            let mut command = String::from(first);
            while let Some(more) = lines.get(at).and_then(|line| line.strip_prefix(CONTINUATION)) {
                command = command + "\n" + more;
                at += 1;
            }
            let status = lines.get(at).and_then(|line| line.strip_prefix(STATUS));
            at += usize::from(status.is_some());
            let status = status.map_or(0, |status| status.parse().expect("`? ` and an exit status"));
            steps.push(Step { line, command, status, shown: at..at });
        } else {
            let step = steps.last_mut().filter(|step| step.shown.end == line);
            step.unwrap_or_else(|| panic!("line {}: a block begins with a command", line + 1)).shown.end = at;
        }
    }
    assert!(!inside, "the last block has no end");
    steps
}

/// Runs a command in a directory; its status and everything that it prints.
fn execute(directory: &Path, command: &str, typed: String) -> (ExitStatus, String) {
    let program = Path::new(env!("CARGO_BIN_EXE_pulsetrain")).parent().unwrap();
    let others = env::var_os("PATH").unwrap_or_default();
    let path = env::join_paths([program.into()].into_iter().chain(env::split_paths(&others))).unwrap();
    let mut child = Command::new("sh")
        .args(["-c", &format!("exec 2>&1\n{command}")])
        .current_dir(directory)
        .env("PATH", path)
        .env_remove("PULSETRAIN_TOKEN")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let (mut input, mut output) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
    // Whoever does not read what is typed need not.
    thread::spawn(move || input.write_all(typed.as_bytes()));
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = output.read_to_end(&mut bytes);
        sender.send(read.map(|_| bytes))
    });
    let Ok(output) = receiver.recv_timeout(PATIENCE) else {
        let _ = child.kill();
        panic!("does not end: {command}");
    };
    (child.wait().unwrap(), String::from_utf8(output.unwrap()).expect("text is printed"))
}

/// What a page has to be, after its commands were run in a directory, and what else is wrong.
fn truth(directory: &Path, page: &str) -> (String, Vec<String>) {
    let lines: Vec<_> = page.split('\n').collect();
    let (mut text, mut problems) = (Vec::new(), Vec::new());
    let mut copied = 0;
    for step in steps(&lines) {
        let shown = &lines[step.shown.clone()];
        let typed = shown.iter().filter_map(|line| line.strip_prefix(PROMPT)).map(|line| format!("{line}\n"));
        let (status, printed) = execute(directory, &step.command, typed.collect());
        if status.code() != Some(step.status) {
            let signal = status.signal().map_or(String::new(), |signal| format!(" (signal {signal})"));
            let status = status.code().map_or(signal, |code| code.to_string());
            problems.push(format!("line {}: status {status}:\n{printed}", step.line + 1));
        }
        // What `[..]` and `...` stand for in the page is right whatever it is.
        let expected: String = shown.iter().map(|line| format!("{line}\n")).collect();
        let normalize = NormalizeToExpected::new().redact();
        let printed = normalize.normalize(Data::text(printed), &Data::text(&*expected)).to_string();
        text.extend(lines[copied..step.shown.start].iter().map(|line| (*line).to_owned()));
        text.extend(printed.lines().map(str::to_owned));
        copied = step.shown.end;
    }
    text.extend(lines[copied..].iter().map(|line| (*line).to_owned()));
    (text.join("\n"), problems)
}

/// Compares a file with what it has to be, or makes it so.
fn settle(file: &str, wanted: &[u8], problems: &mut Vec<String>) {
    let path = root().join(file);
    let present = fs::read(&path).unwrap_or_default();
    if present == wanted {
        return;
    }
    if env::var_os("SNAPSHOTS").is_some_and(|action| action == "overwrite") {
        return fs::write(&path, wanted).unwrap();
    }
    let [present, wanted] = [&present, wanted].map(String::from_utf8_lossy);
    let (mut before, mut after) = (present.lines(), wanted.lines());
    let differing = (1..).find_map(|line| match (before.next(), after.next()) {
        (None, None) => Some((line, None, None)),
        (before, after) => (before != after).then_some((line, before, after)),
    });
    let (line, before, after) = differing.expect("lines end");
    let show = |line: Option<&str>| line.unwrap_or("(nothing)").chars().take(200).collect::<String>();
    problems.push(format!(
        "{file}, line {line}, is out of date (cargo xtask docs):\n  - {}\n  + {}",
        show(before),
        show(after)
    ));
}

/// The names of the files in a directory, sorted.
fn names(directory: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap());
    let files = entries.filter(|entry| entry.file_type().unwrap().is_file());
    files.map(|file| file.file_name().into_string().unwrap()).collect()
}

#[test]
fn the_pages_are_true() {
    let root = root();
    let pages = names(&root.join("docs")).into_iter().filter(|name| name.ends_with(".md"));
    let pages = pages.map(|name| format!("docs/{name}")).chain(["README.md".into()]);
    let (mut drawn, mut problems) = (BTreeSet::new(), Vec::new());
    for page in pages {
        let text = fs::read_to_string(root.join(&page)).unwrap();
        if !text.lines().any(|line| line == OPENING) {
            continue;
        }
        let sandbox = directory(&[]);
        fs::create_dir_all(sandbox.join(IMAGES)).unwrap();
        symlink(root.join("examples"), sandbox.join("examples")).unwrap();
        let (wanted, wrong) = truth(&sandbox, &text);
        problems.extend(wrong.into_iter().map(|problem| format!("{page}, {problem}")));
        settle(&page, wanted.as_bytes(), &mut problems);
        for picture in names(&sandbox.join(IMAGES)) {
            let file = format!("{IMAGES}/{picture}");
            settle(&file, &fs::read(sandbox.join(&file)).unwrap(), &mut problems);
            drawn.insert(picture);
        }
        fs::remove_dir_all(&sandbox).unwrap();
    }
    let others: Vec<_> = names(&root.join(IMAGES)).difference(&drawn).cloned().collect();
    if !others.is_empty() {
        problems.push(format!("no page draws {}", others.join(", ")));
    }
    assert!(problems.is_empty(), "\n{}", problems.join("\n\n"));
}

#[track_caller]
fn check(page: &str, expected: &str, wrong: &[&str]) {
    let sandbox = directory(&[]);
    let (text, problems) = truth(&sandbox, page);
    assert_eq!((text.as_str(), problems), (expected, wrong.iter().map(|&text| text.to_owned()).collect()));
    fs::remove_dir_all(&sandbox).unwrap();
}

#[test]
fn what_a_command_prints_takes_the_place_of_what_is_there() {
    check("```sh\n$ false\n```\n", "```sh\n$ false\n```\n", &[]);
    check("```console\n$ echo a\nb\n```\n", "```console\n$ echo a\na\n```\n", &[]);
    check("```console\n$ echo a >&2\n```\n", "```console\n$ echo a >&2\na\n```\n", &[]);
    let two = "```console\n$ echo a \\\n> b > file\n$ cat file\na b\n```\nend";
    check(two, two, &[]);
    let typed = "```console\n$ sed 's/^/(debug) /'\n(debug) step\n(debug) quit\n```\n";
    check(typed, typed, &[]);
    check("```console\n$ exit 2\n? 2\n```", "```console\n$ exit 2\n? 2\n```", &[]);
    check("```console\n$ exit 2\n```", "```console\n$ exit 2\n```", &["line 2: status 2:\n"]);
}

#[test]
fn what_is_left_open_stays_open() {
    let page = "```console\n$ echo took 5 s; seq 9\ntook [..] s\n1\n...\n9\n```\n";
    check(page, page, &[]);
    let other = "```console\n$ echo took 5 s; echo 8\ntook [..] s\n8\n```\n";
    check("```console\n$ echo took 5 s; echo 8\ntook [..] s\n1\n...\n9\n```\n", other, &[]);
}
