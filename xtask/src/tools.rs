//! What the steps need beside Rust, and how it gets here. Nothing is installed that is already there;
//! what is not a Debian package goes into the target directory and nowhere else.

use crate::workplace::{Workplace, read, run, succeeds};
use anyhow::{Context, Result, bail};
use std::{fs, path::PathBuf, process::Command};

const NEXTEST: &str = "0.9.143";
const CARGO_FUZZ: &str = "0.13.2";

/// The oldest Node, as `web/package.json` says.
const NODE: (u32, u32) = (20, 19);

/// `cargo nextest`.
pub fn nextest(workplace: &Workplace) -> Result<()> {
    cargo_tool(workplace, "nextest", "cargo-nextest", NEXTEST)
}

/// `cargo fuzz`, with the C++ compiler that libFuzzer is built with.
pub fn cargo_fuzz(workplace: &Workplace) -> Result<()> {
    if !succeeds(&mut workplace.command("c++", &["--version"])) {
        debian_package(workplace, "g++", "the command c++")?;
    }
    cargo_tool(workplace, "fuzz", "cargo-fuzz", CARGO_FUZZ)
}

/// `qemu-system-arm`.
pub fn qemu(workplace: &Workplace) -> Result<()> {
    if succeeds(&mut workplace.command("qemu-system-arm", &["--version"])) {
        return Ok(());
    }
    debian_package(workplace, "qemu-system-arm", "the command qemu-system-arm")
}

/// Node with npm, for the page alone.
pub fn node(workplace: &Workplace) -> Result<()> {
    let version = |workplace: &Workplace| read(&mut workplace.command("node", &["--version"]));
    if !version(workplace).is_ok_and(|version| is_new_enough(&version))
        || !succeeds(&mut workplace.command("npm", &["--version"]))
    {
        debian_package(workplace, "npm", "Node with npm")?;
    }
    let version = version(workplace)?;
    if !is_new_enough(&version) {
        bail!("the page needs Node {}.{} or newer, this is {}", NODE.0, NODE.1, version.trim());
    }
    Ok(())
}

/// Whether `v20.19.1` and the like are [`NODE`] at least.
fn is_new_enough(version: &str) -> bool {
    let mut numbers = version.trim().trim_start_matches('v').split('.').map(str::parse);
    matches!((numbers.next(), numbers.next()), (Some(Ok(major)), Some(Ok(minor))) if (major, minor) >= NODE)
}

/// A browser, the one that Debian has.
pub fn chromium(workplace: &Workplace) -> Result<PathBuf> {
    let path = PathBuf::from("/usr/bin/chromium");
    if !path.exists() {
        debian_package(workplace, "chromium", "the browser chromium")?;
    }
    Ok(path)
}

/// The name of an installed nightly toolchain.
pub fn nightly(workplace: &Workplace) -> Result<String> {
    let list = read(&mut workplace.command("rustup", &["toolchain", "list"]))?;
    let names = list.lines().filter_map(|line| line.split_whitespace().next());
    names
        .filter(|name| name.starts_with("nightly"))
        .max()
        .map(str::to_owned)
        .context("libFuzzer needs a nightly toolchain: rustup toolchain install nightly --profile minimal")
}

/// The Python of a virtual environment with exactly the packages of `clients/requirements.txt`. A copy of
/// that file lies in the environment; when the two differ, the environment is made anew.
pub fn python(workplace: &Workplace) -> Result<PathBuf> {
    let environment = workplace.target.join("venv");
    let python = environment.join("bin/python");
    let (wanted, present) =
        (workplace.root.join("clients/requirements.txt"), environment.join("requirements.txt"));
    let wanted = fs::read_to_string(&wanted).with_context(|| wanted.display().to_string())?;
    if fs::read_to_string(&present).is_ok_and(|present| present == wanted)
        && succeeds(&mut workplace.command(&python, &["--version"]))
    {
        return Ok(python);
    }
    if !succeeds(&mut workplace.command("python3", &["-c", "import ensurepip, venv"])) {
        debian_package(workplace, "python3-venv", "the Python modules venv and ensurepip")?;
    }
    let shown = environment.to_string_lossy();
    run(&mut workplace.command("python3", &["-m", "venv", "--clear", &shown]))?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "-r"];
    run(workplace.command(&python, &install).arg("clients/requirements.txt"))?;
    run(&mut workplace.command(&python, &["-m", "pip", "check", "--disable-pip-version-check"]))?;
    fs::write(&present, wanted).with_context(|| present.display().to_string())?;
    Ok(python)
}

/// Installs a cargo subcommand into the target directory unless one is found.
fn cargo_tool(workplace: &Workplace, subcommand: &str, package: &str, version: &str) -> Result<()> {
    if succeeds(&mut workplace.command("cargo", &[subcommand, "--version"])) {
        return Ok(());
    }
    let root = workplace.target.join("tools");
    let arguments = ["install", "--quiet", "--locked", "--version", version, package, "--root"];
    run(workplace.command("cargo", &arguments).arg(root))
}

/// Installs a Debian package, as root or with a sudo that asks for no password.
fn debian_package(workplace: &Workplace, package: &str, what: &str) -> Result<()> {
    let install = ["install", "-qq", "--yes", "--no-install-recommends", package];
    debian_update(workplace)
        .and_then(|()| run(&mut apt_get(workplace, &install)?))
        .with_context(|| format!("{what} is missing: apt-get install {package}"))
}

/// Fetches the list of Debian packages.
pub fn debian_update(workplace: &Workplace) -> Result<()> {
    run(&mut apt_get(workplace, &["update", "-qq"])?)
}

/// `apt-get` with the rights that it needs.
fn apt_get(workplace: &Workplace, arguments: &[&str]) -> Result<Command> {
    let root = read(&mut workplace.command("id", &["-u"])).is_ok_and(|id| id.trim() == "0");
    let sudo: &[&str] = if root {
        &[]
    } else if succeeds(&mut workplace.command("sudo", &["-n", "true"])) {
        &["sudo", "-n"]
    } else {
        bail!("only root may install Debian packages");
    };
    let words = [sudo, &["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"], arguments].concat();
    Ok(workplace.command(words[0], &words[1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_of_node() {
        for (version, expected) in
            [("v20.19.0\n", true), ("v22.0.0", true), ("v20.18.9", false), ("v18.20.4", false), ("", false)]
        {
            assert_eq!(is_new_enough(version), expected, "{version}");
        }
    }
}
