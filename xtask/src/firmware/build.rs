//! The images, built for a board.

use super::toolchain::{TARGET, Toolchain};
use crate::workplace::{Workplace, run};
use anyhow::{Context, Result};
use cargo_metadata::{MetadataCommand, Package};
use std::{fs, path::PathBuf};

/// The crate whose programs are the images: one a controller, named like its model.
const CRATE: &str = "images";

/// The board that QEMU emulates.
pub const EMULATED: &str = "mps2-an386";

/// A built image.
pub struct Image {
    /// The controller.
    pub model: String,
    /// The ELF file.
    pub path: PathBuf,
}

/// Where the images of a board are.
pub fn folder(workplace: &Workplace, board: &str) -> PathBuf {
    workplace.target.join("firmware/images").join(board)
}

/// Builds every image for a board.
pub fn images(workplace: &Workplace, toolchain: &Toolchain, board: &str) -> Result<Vec<Image>> {
    let builds = workplace.target.join("firmware").join(toolchain.name());
    let mut command = toolchain.cargo(workplace, &["build", "--release", "--locked"]);
    command.args(for_board(board)).args(["--target", TARGET, "--target-dir"]);
    run(command.arg(&builds))?;
    let folder = folder(workplace, board);
    fs::create_dir_all(&folder)?;
    // Copies, because the next board's images have the same names.
    let keep = |model: String| {
        let built = builds.join(TARGET).join("release").join(&model);
        let path = folder.join(&model);
        fs::copy(&built, &path).with_context(|| built.display().to_string())?;
        Ok(Image { model, path })
    };
    models(workplace)?.into_iter().map(keep).collect()
}

/// Clippy on everything for each of the boards.
pub fn clippy(workplace: &Workplace) -> Result<()> {
    let toolchain = Toolchain::find(workplace)?;
    if let Toolchain::Debian { .. } = toolchain {
        println!("Debian's compiler has no clippy: the firmware is only built");
        return Ok(());
    }
    let builds = workplace.target.join("firmware").join(toolchain.name());
    for board in boards(workplace)? {
        let mut command = toolchain.cargo(workplace, &["clippy", "--locked"]);
        command.args(for_board(&board)).args(["--target", TARGET, "--target-dir"]).arg(&builds);
        run(command.args(["--", "-D", "warnings"]))?;
    }
    Ok(())
}

/// Cargo's choice of a board.
const fn for_board(board: &str) -> [&str; 5] {
    ["-p", CRATE, "--no-default-features", "--features", board]
}

/// The boards: each is a feature of the images.
pub fn boards(workplace: &Workplace) -> Result<Vec<String>> {
    let features = package(workplace)?.features.into_keys();
    Ok(features.filter(|feature| feature != "default").collect())
}

/// The names of all images.
fn models(workplace: &Workplace) -> Result<Vec<String>> {
    let targets = package(workplace)?.targets.into_iter();
    Ok(targets.filter(|target| target.is_bin()).map(|target| target.name).collect())
}

/// The crate of the images.
fn package(workplace: &Workplace) -> Result<Package> {
    let metadata = MetadataCommand::new().manifest_path(workplace.firmware_manifest()).no_deps().exec()?;
    let mut packages = metadata.packages.into_iter();
    let found = packages.find(|package| package.name.as_str() == CRATE);
    found.with_context(|| format!("firmware/ has no crate `{CRATE}`"))
}
