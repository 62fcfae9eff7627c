//! The images, built for a board.

use super::toolchain::{TARGET, Toolchain};
use crate::workplace::{Workplace, run};
use anyhow::{Context, Result};
use cargo_metadata::MetadataCommand;
use std::{fs, path::PathBuf};

/// The crate whose programs are the images: one a controller, named like its model.
const CRATE: &str = "images";

/// The board that QEMU emulates.
pub const EMULATED: &str = "mps2-an386";

/// All boards; each is a feature of the images.
pub const BOARDS: [&str; 2] = [EMULATED, "nucleo-g474re"];

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

/// Cargo's choice of a board.
const fn for_board(board: &str) -> [&str; 5] {
    ["-p", CRATE, "--no-default-features", "--features", board]
}

/// The names of all images.
fn models(workplace: &Workplace) -> Result<Vec<String>> {
    let metadata = MetadataCommand::new().manifest_path(workplace.firmware_manifest()).no_deps().exec()?;
    let images = metadata.packages.iter().find(|package| package.name.as_str() == CRATE);
    let targets = &images.with_context(|| format!("firmware/ has no crate `{CRATE}`"))?.targets;
    Ok(targets.iter().filter(|target| target.is_bin()).map(|target| target.name.clone()).collect())
}
