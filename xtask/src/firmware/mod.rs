//! `cargo xtask firmware`: the images for microcontrollers, built, measured, and tested in QEMU.

mod build;
mod emulator;
mod figures;
mod size;
pub mod toolchain;

use crate::workplace::Workplace;
use anyhow::{Result, bail};
pub use build::clippy;
use build::{EMULATED, Image};
use size::Size;
use toolchain::Toolchain;

/// `cargo xtask firmware` with `arguments`.
pub fn run(workplace: &Workplace, arguments: &[&str]) -> Result<()> {
    match arguments {
        [] => build(workplace, &Toolchain::find(workplace)?).map(drop),
        ["--test"] => check(workplace),
        ["--figures"] => {
            let (_, rows) = test(workplace)?;
            figures::write(&workplace.root, &rows)?;
            meets_goals(&rows)
        }
        ["--run", model, rest @ ..] => {
            build::images(workplace, &Toolchain::find(workplace)?, EMULATED)?;
            emulator::serve(workplace, model, rest)
        }
        _ => bail!("unknown arguments `{}`", arguments.join(" ")),
    }
}

/// Builds the images for every board, and gives those for the emulated one.
fn build(workplace: &Workplace, toolchain: &Toolchain) -> Result<Vec<Image>> {
    let mut emulated = Vec::new();
    for board in build::boards(workplace)? {
        let images = build::images(workplace, toolchain, &board)?;
        for image in &images {
            let Size { flash, ram } = Size::read(&image.path)?;
            println!("{:<10} for {board:<14} {flash:>7} bytes of flash, {ram:>6} of variables", image.model);
        }
        if board == EMULATED {
            emulated = images;
        }
    }
    Ok(emulated)
}

/// Builds and tests every image, and gives its figures.
fn test(workplace: &Workplace) -> Result<(Toolchain, Vec<figures::Row>)> {
    let toolchain = Toolchain::find(workplace)?;
    let images = build(workplace, &toolchain)?;
    let rows = figures::rows(&images, &emulator::test(workplace)?)?;
    println!("{}", figures::table(&rows));
    Ok((toolchain, rows))
}

fn meets_goals(rows: &[figures::Row]) -> Result<()> {
    let missed = figures::missed(rows);
    if !missed.is_empty() {
        bail!("{}", missed.join("\n       "));
    }
    Ok(())
}

/// The step of `cargo xtask test`: the images do what their tests say, and the document tells their size.
pub fn check(workplace: &Workplace) -> Result<()> {
    let (toolchain, rows) = test(workplace)?;
    meets_goals(&rows)?;
    match toolchain {
        Toolchain::Rustup => figures::check(&workplace.root, &rows),
        // Another compiler makes other code.
        Toolchain::Debian { .. } => Ok(()),
    }
}
