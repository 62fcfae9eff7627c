//! The steps that Rust's own tools do.

use crate::{
    firmware::{self, toolchain::TARGET},
    tools,
    workplace::{Workplace, read, run},
};
use anyhow::Result;
use std::path::PathBuf;

/// What is off in a plain build because its libraries take long to build; the checks have it on.
pub const OPTIONAL: &str = "parquet";
/// The argument that has it on.
pub const ALL: &str = "--features=parquet";

/// `cargo fmt --check` on the workspace, the firmware and the fuzz targets.
pub fn format(workplace: &Workplace) -> Result<()> {
    workplace.cargo(&["fmt", "--all", "--check"])?;
    workplace.cargo(&["fmt", "--manifest-path", "firmware/Cargo.toml", "--all", "--check"])?;
    if workplace.fuzz_manifest().exists() {
        workplace.cargo(&["fmt", "--manifest-path", "fuzz/Cargo.toml", "--check"])?;
    }
    Ok(())
}

/// Clippy on libraries, programs, tests, examples and benches, and on the firmware.
pub fn clippy(workplace: &Workplace) -> Result<()> {
    workplace.cargo(&["clippy", "--locked", "--workspace", "--all-targets", ALL, "--", "-D", "warnings"])?;
    firmware::clippy(workplace)
}

/// The `no_std` crates without their default features: for a bare-metal target where its core library is
/// installed, which proves that nothing pulls in `std`; else on the host, which proves that they build.
pub fn no_std(workplace: &Workplace) -> Result<()> {
    let mut arguments = vec!["check", "--locked", "--no-default-features", "--lib"];
    for name in ["motion", "protocol", "tmcl", "ascript", "devices", "runtime"] {
        arguments.extend(["-p", name]);
    }
    let sysroot = read(&mut workplace.command("rustc", &["--print", "sysroot"]))?;
    let core = std::path::Path::new(sysroot.trim()).join("lib/rustlib").join(TARGET);
    if core.exists() {
        arguments.extend(["--target", TARGET]);
    } else {
        println!("{TARGET} is not installed (rustup target add {TARGET}): on the host instead");
    }
    workplace.cargo(&arguments)
}

/// Every test of the workspace.
pub fn tests(workplace: &Workplace) -> Result<()> {
    tools::nextest(workplace)?;
    workplace.cargo(&["nextest", "run", "--locked", "--workspace", ALL])
}

/// The examples in doc comments, which nextest does not run.
pub fn doc_tests(workplace: &Workplace) -> Result<()> {
    workplace.cargo(&["test", "--quiet", "--locked", "--workspace", ALL, "--doc"])
}

/// The API documentation; a dead link is an error.
pub fn rustdoc(workplace: &Workplace) -> Result<()> {
    let mut command = workplace.command("cargo", &["doc", "--locked", "--workspace", ALL, "--no-deps"]);
    run(command.env("RUSTDOCFLAGS", "-D warnings"))
}

/// The program as a plain build has it, and with the rest of the workspace, so that libraries are as clippy has had them;
/// whether all that is optional compiles too, the other steps show.
pub fn plain(workplace: &Workplace) -> Result<()> {
    workplace.cargo(&["check", "--locked", "--workspace"])
}

/// Builds the program with everything in it, as the tests do, whose build it shares. Gives its path.
pub fn binary(workplace: &Workplace) -> Result<PathBuf> {
    workplace.cargo(&["build", "--locked", "--workspace", "--bins", ALL])?;
    Ok(workplace.target.join("debug/pulsetrain"))
}
