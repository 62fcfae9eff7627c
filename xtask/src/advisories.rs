//! The advisories of the RustSec database that concern crates we are built from.
//!
//! `xtask/advisories.toml` keeps them in the tree, in the database's own terms, so that the check needs no
//! network. `cargo xtask advisories DIR` writes that file from a clone of the database.

use crate::{dependencies, workplace::Workplace};
use anyhow::{Context, Result};
use cargo_metadata::semver::{Version, VersionReq};
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

const FILE: &str = "xtask/advisories.toml";
const HEADER: &str = "\
# Advisories of the RustSec database about the crates we are built from.
# Written by `cargo xtask advisories DIR`, where DIR is a clone of that database.
#
# looked_up: the crates whose advisories are all here; the check names those that are missing.
# advisory: a version is safe if it matches a requirement of `patched` or `unaffected`. `waived` says why
# one that concerns us does no harm; it is written by hand and kept.

";

/// The file.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Advisories {
    looked_up: BTreeSet<String>,
    #[serde(default)]
    advisory: Vec<Advisory>,
}

/// One advisory, with the field names of the database.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
struct Advisory {
    id: String,
    package: String,
    #[serde(default)]
    patched: Vec<String>,
    #[serde(default)]
    unaffected: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    waived: Option<String>,
}

/// The front matter of a file of the database, as far as it is needed.
#[derive(Deserialize)]
struct Entry {
    advisory: EntryAdvisory,
    #[serde(default)]
    versions: EntryVersions,
}

#[derive(Deserialize)]
struct EntryAdvisory {
    id: String,
    package: String,
    withdrawn: Option<String>,
}

#[derive(Default, Deserialize)]
struct EntryVersions {
    #[serde(default)]
    patched: Vec<String>,
    #[serde(default)]
    unaffected: Vec<String>,
}

impl Advisories {
    /// Reads the file, and makes sure that every requirement in it can be read.
    pub fn read(workplace: &Workplace) -> Result<Self> {
        let text = fs::read_to_string(workplace.root.join(FILE)).context(FILE)?;
        let advisories: Self = toml::from_str(&text).context(FILE)?;
        for advisory in &advisories.advisory {
            for requirement in advisory.patched.iter().chain(&advisory.unaffected) {
                VersionReq::parse(requirement).with_context(|| format!("{FILE}: {}", advisory.id))?;
            }
        }
        Ok(advisories)
    }

    /// Whether the advisories of this crate are all in the file.
    pub fn covers(&self, name: &str) -> bool {
        self.looked_up.contains(name)
    }

    /// What is known against this version of a crate.
    pub fn matching<'a>(&'a self, name: &'a str, version: &'a Version) -> impl Iterator<Item = String> + 'a {
        let about = self.advisory.iter().filter(move |advisory| advisory.package == name);
        about.filter(|advisory| advisory.waived.is_none() && advisory.concerns(version)).map(|advisory| {
            match &advisory.patched[..] {
                [] => format!("{}, and no version is patched", advisory.id),
                patched => format!("{}, patched in {}", advisory.id, patched.join(" and ")),
            }
        })
    }
}

impl Advisory {
    fn concerns(&self, version: &Version) -> bool {
        let safe = self.patched.iter().chain(&self.unaffected);
        !safe.filter_map(|one| VersionReq::parse(one).ok()).any(|requirement| requirement.matches(version))
    }
}

/// Writes the file anew from a clone of the database in `directory`.
pub fn refresh(workplace: &Workplace, directory: &Path) -> Result<()> {
    let old = Advisories::read(workplace).unwrap_or_default();
    let looked_up = dependencies::foreign_names(workplace)?;
    let mut advisory = Vec::new();
    for name in &looked_up {
        for path in entries(&directory.join("crates").join(name))? {
            let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
            let Some(mut entry) = parse(&text).with_context(|| path.display().to_string())? else { continue };
            let before = old.advisory.iter().find(|one| one.id == entry.id);
            entry.waived = before.and_then(|one| one.waived.clone());
            advisory.push(entry);
        }
    }
    println!("{} advisories about {} crates", advisory.len(), looked_up.len());
    let text = toml::to_string_pretty(&Advisories { looked_up, advisory })?;
    fs::write(workplace.root.join(FILE), format!("{HEADER}{text}")).context(FILE)
}

/// The advisories of one crate, in order; a crate without any has no folder.
fn entries(directory: &Path) -> Result<Vec<PathBuf>> {
    let Ok(files) = fs::read_dir(directory) else { return Ok(Vec::new()) };
    let mut paths = files.map(|file| Ok(file?.path())).collect::<Result<Vec<_>>>()?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    paths.sort();
    Ok(paths)
}

/// An entry begins with a fenced block of TOML; a withdrawn one is `None`.
fn parse(text: &str) -> Result<Option<Advisory>> {
    let front = text.split("```").nth(1).context("no fenced block")?;
    let front = front.strip_prefix("toml").context("the first fenced block is not TOML")?;
    let Entry { advisory, versions } = toml::from_str(front)?;
    Ok(advisory.withdrawn.is_none().then_some(Advisory {
        id: advisory.id,
        package: advisory.package,
        patched: versions.patched,
        unaffected: versions.unaffected,
        waived: None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENTRY: &str = r#"```toml
[advisory]
id = "RUSTSEC-2099-0001"
package = "wheel"
date = "2099-01-01"
categories = ["denial-of-service"]

[versions]
patched = [">= 1.2.3, < 2.0.0", ">= 2.1.0"]
unaffected = ["< 1.0.0"]
```

# The wheel comes off
"#;

    #[track_caller]
    fn check(version: &str, expected: bool) {
        let advisory = parse(ENTRY).unwrap().unwrap();
        assert_eq!(advisory.concerns(&version.parse().unwrap()), expected, "{version}");
    }

    #[test]
    fn an_entry_of_the_database_says_which_versions_it_concerns() {
        check("0.9.9", false);
        check("1.0.0", true);
        check("1.2.2", true);
        check("1.2.3", false);
        check("2.0.5", true);
        check("2.1.0", false);
    }

    #[test]
    fn a_withdrawn_entry_is_left_out() {
        let text = ENTRY.replace("date =", "withdrawn = \"2099-02-02\"\ndate =");
        assert!(parse(&text).unwrap().is_none());
        assert!(parse("# no front matter").is_err());
    }

    #[test]
    fn only_an_advisory_without_a_waiver_is_reported() {
        let mut advisories =
            Advisories { looked_up: BTreeSet::new(), advisory: vec![parse(ENTRY).unwrap().unwrap()] };
        let version = "1.0.0".parse().unwrap();
        let found: Vec<_> = advisories.matching("wheel", &version).collect();
        assert_eq!(found, ["RUSTSEC-2099-0001, patched in >= 1.2.3, < 2.0.0 and >= 2.1.0"]);
        assert_eq!(advisories.matching("axle", &version).count(), 0);
        advisories.advisory[0].waived = Some("we have no wheels".to_owned());
        assert_eq!(advisories.matching("wheel", &version).count(), 0);
    }

    #[test]
    fn the_file_can_be_read() {
        let advisories = Advisories::read(&Workplace::find().unwrap()).unwrap();
        assert!(advisories.advisory.iter().all(|one| advisories.covers(&one.package)));
    }
}
