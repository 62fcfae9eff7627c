//! Images in QEMU: for users, and under the tests of `clients/`.

use super::build::{EMULATED, folder};
use crate::{
    rust, tools,
    workplace::{Workplace, run},
};
use anyhow::Result;
use std::{fs, path::PathBuf, process::Command};

/// How often a test that fails is tried again.
const RERUNS: &str = "2";

/// Builds what tells the emulated boards which machine hangs on their pins.
fn machines(workplace: &Workplace) -> Result<PathBuf> {
    workplace.cargo(&["build", "--quiet", "--locked", "-p", "sim", "--examples"])?;
    Ok(workplace.target.join("debug/examples"))
}

/// A controller in QEMU until it is interrupted.
pub fn serve(workplace: &Workplace, model: &str, arguments: &[&str]) -> Result<()> {
    tools::qemu(workplace)?;
    let examples = machines(workplace)?;
    let mut command = workplace.command("python3", &["clients/image.py", model]);
    command.arg("--images").arg(folder(workplace, EMULATED)).args(arguments);
    run(command.env("PULSETRAIN_EXAMPLES", examples))
}

/// The tests of `clients/` against images in place of the server. Gives the file of the figures that they took
/// down.
pub fn test(workplace: &Workplace) -> Result<PathBuf> {
    tools::qemu(workplace)?;
    let python = tools::python(workplace)?;
    let examples = machines(workplace)?;
    let program = rust::binary(workplace)?;
    let figures = workplace.target.join("firmware/figures.json");
    fs::write(&figures, "")?;
    // QEMU's time goes on while the host does something else, and an image that was away is late.
    let again = ["--reruns", RERUNS, "--reruns-delay", "1"];
    let mut command: Command = workplace.command(python, &["-m", "pytest", "clients"]);
    command.args(again);
    command
        .env("PULSETRAIN", program)
        .env("PULSETRAIN_IMAGES", folder(workplace, EMULATED))
        .env("PULSETRAIN_EXAMPLES", examples)
        .env("PULSETRAIN_FIGURES", &figures);
    run(&mut command)?;
    Ok(figures)
}
