//! Who compiles for the microcontroller: rustup's toolchain where its target is there or can be fetched, else
//! Debian's compiler, unpacked into the target directory, which builds its own core library.

use crate::workplace::{Workplace, read, run, succeeds};
use anyhow::{Context, Result, bail};
use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The target of all boards.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// `debian` in this variable forces Debian's compiler.
pub const CHOICE: &str = "PULSETRAIN_TOOLCHAIN";

/// Debian's packages of a compiler that is new enough for us, with the sources of the core library.
const PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

/// A compiler for [`TARGET`].
pub enum Toolchain {
    /// The one that compiles everything else.
    Rustup,
    /// Debian's, with the linker of rustup's.
    Debian {
        /// Where its packages are unpacked.
        root: PathBuf,
        /// `rust-lld`.
        linker: PathBuf,
    },
}

impl Toolchain {
    /// The first that can be had.
    pub fn find(workplace: &Workplace) -> Result<Self> {
        let choice = env::var(CHOICE).unwrap_or_default();
        let sysroot = sysroot(workplace)?;
        match choice.as_str() {
            "debian" => {}
            "" if sysroot.join("lib/rustlib").join(TARGET).exists() => return Ok(Self::Rustup),
            "" if succeeds(&mut workplace.command("rustup", &["target", "add", TARGET])) => {
                return Ok(Self::Rustup);
            }
            "" => println!("rustup cannot fetch the target {TARGET}: Debian's compiler instead"),
            other => bail!("{CHOICE}={other}: only `debian` is known"),
        }
        let root = workplace.target.join("debian-rust");
        unpack(workplace, &root)?;
        Ok(Self::Debian { root, linker: lld(&sysroot)? })
    }

    /// Its name, which is also that of its folder of builds.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Rustup => "rustup",
            Self::Debian { .. } => "debian",
        }
    }

    /// Cargo in the workspace `firmware/`, whose configuration names the target.
    pub fn cargo(&self, workplace: &Workplace, arguments: &[&str]) -> Command {
        let mut command = match self {
            Self::Rustup => workplace.command("cargo", arguments),
            Self::Debian { root, linker } => {
                let mut command = workplace.command(root.join("usr/bin/cargo"), arguments);
                let linker_variable =
                    format!("CARGO_TARGET_{}_LINKER", TARGET.to_uppercase().replace('-', "_"));
                command
                    .arg("-Zbuild-std=core")
                    .env("RUSTC_BOOTSTRAP", "1")
                    .env("RUSTC", root.join("usr/bin/rustc"))
                    .env("LD_LIBRARY_PATH", libraries(root))
                    .env(linker_variable, linker);
                command
            }
        };
        command.current_dir(workplace.root.join("firmware"));
        command
    }
}

/// Where the compiler of everything else lives.
fn sysroot(workplace: &Workplace) -> Result<PathBuf> {
    Ok(read(&mut workplace.command("rustc", &["--print", "sysroot"]))?.trim().into())
}

/// `rust-lld` of a toolchain, which lies in the folder of its host.
fn lld(sysroot: &Path) -> Result<PathBuf> {
    let hosts = fs::read_dir(sysroot.join("lib/rustlib"))?;
    let places = hosts.filter_map(|host| Some(host.ok()?.path().join("bin/rust-lld")));
    let mut present = places.filter(|place| place.exists());
    present.next().with_context(|| format!("{} has no rust-lld", sysroot.display()))
}

/// The folder of the compiler's shared libraries. Debian names it after the machine.
fn libraries(root: &Path) -> PathBuf {
    let folder = |path: &Path| {
        path.file_name().is_some_and(|name| name.to_string_lossy().ends_with("-linux-gnu")) && path.is_dir()
    };
    let entries = fs::read_dir(root.join("usr/lib")).into_iter().flatten();
    let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.find(|path| folder(path)).unwrap_or_else(|| root.join("usr/lib"))
}

/// Downloads the packages, with all that they need and that is not installed, and unpacks them. Nothing is
/// installed, so nothing of it can be in the way of another toolchain.
fn unpack(workplace: &Workplace, root: &Path) -> Result<()> {
    let complete = root.join("complete");
    if complete.exists() {
        return Ok(());
    }
    let downloads = workplace.target.join("debian-rust-packages");
    for folder in [root, &downloads] {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
    }
    fs::create_dir_all(&downloads)?;
    let plan = [&["install", "--simulate", "--no-install-recommends"], &PACKAGES[..]].concat();
    let plan = || read(&mut workplace.command("apt-get", &plan));
    let plan = plan().or_else(|_| {
        // A fresh machine has no list of packages yet.
        crate::tools::debian_update(workplace)?;
        plan()
    });
    let plan = plan.context("neither rustup nor Debian has a compiler for the firmware")?;
    run(workplace.command("apt-get", &["download", "-q"]).args(to_install(&plan)).current_dir(&downloads))?;
    for package in fs::read_dir(&downloads)? {
        let package = package?.path();
        run(workplace.command("dpkg", &["-x"]).arg(&package).arg(root))?;
        fs::remove_file(package)?;
    }
    fs::write(complete, "")?;
    Ok(())
}

/// The packages that a simulated installation would install.
fn to_install(plan: &str) -> impl Iterator<Item = &str> {
    plan.lines().filter_map(|line| line.strip_prefix("Inst ")?.split(' ').next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_be_installed_is_read_from_the_plan() {
        let plan = "Reading package lists...\nInst libllvm22 (1:22 Debian:12 [amd64])\nInst rustc-web (1)\n\
            Conf libllvm22 (1:22)\nRemv rustc\n";
        assert_eq!(to_install(plan).collect::<Vec<_>>(), ["libllvm22", "rustc-web"]);
    }
}
