//! What is known of each image in numbers: against the goals, and in `docs/firmware.md`.

use super::{build::Image, size::Size};
use anyhow::{Context, Result, bail};
use serde::Deserialize;
use std::{fmt::Write, fs, path::Path};

/// The document, and the lines between which the table stands.
pub const FILE: &str = "docs/firmware.md";
const BEGIN: &str = "<!-- figures: written by cargo xtask firmware --figures -->\n";
const END: &str = "<!-- end of figures -->\n";

/// So many percent may the document be off before the check fails.
const TOLERANCE_PERCENT: u64 = 3;

/// What an image must not exceed.
struct Goal {
    model: &'static str,
    flash: u64,
    ram: u64,
}

const GOALS: &[Goal] = &[
    Goal { model: "pd42-1140", flash: 128 << 10, ram: 32 << 10 },
    Goal { model: "pmx-2ed", flash: 256 << 10, ram: 64 << 10 },
    Goal { model: "cmd-4cr", flash: 256 << 10, ram: 64 << 10 },
];

/// Most instructions that the interrupt may execute for a step, with one axis moving.
const INSTRUCTIONS_A_STEP: u64 = 150;

/// What the tests took down, a line of JSON each.
#[derive(Deserialize)]
struct Note {
    model: String,
    /// Bytes of stack that were ever used, of so many.
    stack_used: Option<u64>,
    stack_size: Option<u64>,
    /// Instructions a step of one axis, in the interrupt and in all, rounded up.
    instructions_a_step: Option<u64>,
    instructions_in_all: Option<u64>,
}

/// The figures of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    model: String,
    size: Size,
    /// What was used of the stack, and what it has.
    stack: u64,
    stack_size: u64,
    instructions_a_step: u64,
    instructions_in_all: u64,
}

/// The figures of all images; `notes` is the file of what the tests took down.
pub fn rows(images: &[Image], notes: &Path) -> Result<Vec<Row>> {
    let text = fs::read_to_string(notes).with_context(|| notes.display().to_string())?;
    let notes = text.lines().map(serde_json::from_str).collect::<Result<Vec<Note>, _>>()?;
    let row = |image: &Image| {
        let of_image = || notes.iter().filter(|note| note.model == image.model);
        let worst = |of: fn(&Note) -> Option<u64>, what: &str| {
            let most = of_image().filter_map(of).max();
            most.with_context(|| format!("no test took down the {what} of {}", image.model))
        };
        Ok(Row {
            model: image.model.clone(),
            size: Size::read(&image.path)?,
            stack: worst(|note| note.stack_used, "stack")?,
            stack_size: worst(|note| note.stack_size, "size of the stack")?,
            instructions_a_step: worst(|note| note.instructions_a_step, "instructions a step")?,
            instructions_in_all: worst(|note| note.instructions_in_all, "instructions in all")?,
        })
    };
    images.iter().map(row).collect()
}

/// The goals that are missed, in words.
pub fn missed(rows: &[Row]) -> Vec<String> {
    let mut missed = Vec::new();
    for Row { model, size, stack_size, instructions_a_step, .. } in rows {
        let Some(goal) = GOALS.iter().find(|goal| goal.model == model) else {
            missed.push(format!("{model} has no goals"));
            continue;
        };
        for (what, is, most) in [
            ("bytes of flash", size.flash, goal.flash),
            ("bytes of variables and stack", size.ram + stack_size, goal.ram),
            ("instructions a step", *instructions_a_step, INSTRUCTIONS_A_STEP),
        ] {
            if is > most {
                missed.push(format!("{model}: {is} {what}, and the goal is {most}"));
            }
        }
    }
    missed
}

/// The table for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = "| image | flash | goal | variables | stack | together | goal | worst stack | \
        instructions a step | goal | in all |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
        .to_owned();
    for Row { model, size, stack, stack_size, instructions_a_step, instructions_in_all } in rows {
        let goal = GOALS.iter().find(|goal| goal.model == model);
        let of = |part: fn(&Goal) -> u64| goal.map_or(String::new(), |goal| grouped(part(goal)));
        let _ = writeln!(
            text,
            "| `{model}` | {} | {} | {} | {} | {} | {} | {} | {instructions_a_step} | {INSTRUCTIONS_A_STEP} \
             | {instructions_in_all} |",
            grouped(size.flash),
            of(|goal| goal.flash),
            grouped(size.ram),
            grouped(*stack_size),
            grouped(size.ram + stack_size),
            of(|goal| goal.ram),
            grouped(*stack),
        );
    }
    text
}

/// Digits in groups of three.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let (head, tail) = digits.split_at((digits.len() - 1) % 3 + 1);
    tail.as_bytes()
        .chunks(3)
        .fold(head.to_owned(), |text, group| text + "," + &String::from_utf8_lossy(group))
}

/// Writes the table into the document.
pub fn write(root: &Path, rows: &[Row]) -> Result<()> {
    let file = root.join(FILE);
    let text = fs::read_to_string(&file).context(FILE)?;
    let (before, _, after) = parts(&text)?;
    fs::write(&file, format!("{before}{BEGIN}{}{END}{after}", table(rows))).context(FILE)
}

/// Fails where the sizes of the document are not those of the images.
pub fn check(root: &Path, rows: &[Row]) -> Result<()> {
    let text = fs::read_to_string(root.join(FILE)).context(FILE)?;
    let written = parts(&text)?.1;
    for row in rows {
        let name = format!("| `{}` |", row.model);
        let line = written.lines().find(|line| line.starts_with(&name));
        let cells: Vec<u64> = line.map(numbers).unwrap_or_default();
        let [flash, _, ram, ..] = cells[..] else { bail!("{FILE} has no sizes of {}: {REMEDY}", row.model) };
        for (what, said, is) in [("flash", flash, row.size.flash), ("variables", ram, row.size.ram)] {
            if said.abs_diff(is) * 100 > is * TOLERANCE_PERCENT {
                bail!("{FILE} says {said} bytes of {what} for {}, which has {is}: {REMEDY}", row.model);
            }
        }
    }
    Ok(())
}

const REMEDY: &str = "cargo xtask firmware --figures";

/// What stands before, between and behind the marks.
fn parts(text: &str) -> Result<(&str, &str, &str)> {
    let (before, rest) = text.split_once(BEGIN).with_context(|| format!("{FILE} has no line {BEGIN}"))?;
    let (between, after) = rest.split_once(END).with_context(|| format!("{FILE} has no line {END}"))?;
    Ok((before, between, after))
}

/// The numbers in the cells of a line.
fn numbers(line: &str) -> Vec<u64> {
    line.split('|').filter_map(|cell| cell.trim().replace(',', "").parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(model: &str, flash: u64, ram: u64, stack_size: u64, instructions_a_step: u64) -> Row {
        let size = Size { flash, ram };
        Row {
            model: model.to_owned(),
            size,
            stack: 0,
            stack_size,
            instructions_a_step,
            instructions_in_all: 0,
        }
    }

    #[track_caller]
    fn check_goals(row: Row, expected: &[&str]) {
        assert_eq!(missed(&[row]), expected);
    }

    #[test]
    fn goals_are_flash_memory_and_instructions() {
        check_goals(row("pd42-1140", 131_072, 30_000, 2768, 150), &[]);
        check_goals(
            row("pd42-1140", 131_073, 30_000, 2769, 151),
            &[
                "pd42-1140: 131073 bytes of flash, and the goal is 131072",
                "pd42-1140: 32769 bytes of variables and stack, and the goal is 32768",
                "pd42-1140: 151 instructions a step, and the goal is 150",
            ],
        );
        check_goals(row("other", 0, 0, 0, 0), &["other has no goals"]);
    }

    #[test]
    fn digits_stand_in_groups() {
        for (number, expected) in [(0, "0"), (999, "999"), (1000, "1,000"), (1_234_567, "1,234,567")] {
            assert_eq!(grouped(number), expected);
        }
    }

    /// A document with these rows, in a folder of its own.
    fn document(name: &str, rows: &[Row]) -> std::path::PathBuf {
        let root = std::env::temp_dir().join(format!("pulsetrain-figures-{}-{name}", std::process::id()));
        fs::create_dir_all(root.join("docs")).unwrap();
        fs::write(root.join(FILE), format!("before\n{BEGIN}{END}after\n")).unwrap();
        write(&root, rows).unwrap();
        root
    }

    #[test]
    fn the_document_may_be_a_little_off() {
        let root = document("off", &[row("pd42-1140", 100_000, 20_000, 1000, 100)]);
        let text = fs::read_to_string(root.join(FILE)).unwrap();
        assert!(text.starts_with("before\n") && text.ends_with("after\n") && text.contains("| 100,000 |"));
        check(&root, &[row("pd42-1140", 103_000, 19_500, 1, 1)]).unwrap();
        assert!(check(&root, &[row("pd42-1140", 104_000, 20_000, 1000, 100)]).is_err());
        assert!(check(&root, &[row("pd42-1140", 100_000, 18_000, 1000, 100)]).is_err());
        assert!(check(&root, &[row("cmd-4cr", 100_000, 20_000, 1000, 100)]).is_err());
        fs::remove_dir_all(root).unwrap();
    }
}
