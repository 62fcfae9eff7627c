//! The licences, sources, versions and known advisories of everything we are built from.
//!
//! Why not `cargo deny`: a clean machine would build it for more than four minutes on two cores, and its
//! advisory check needs a clone of the database beside the checkout. `cargo metadata` and the `spdx` crate
//! answer the same questions in a second and offline. `xtask/dependencies.toml` has the rules,
//! `xtask/advisories.toml` the advisories.

use crate::{advisories::Advisories, firmware::toolchain::TARGET, workplace::Workplace};
use anyhow::{Context, Result, bail};
use cargo_metadata::{CargoOpt, Metadata, MetadataCommand, Package, semver::Version};
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// `xtask/dependencies.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rules {
    /// Target triples that we are built for; what only others use is not looked at.
    platforms: Vec<String>,
    /// SPDX identifiers that every crate may have.
    licences: Vec<String>,
    /// Where packages may come from, as `cargo metadata` writes it.
    sources: Vec<String>,
    #[serde(default)]
    licence_exception: Vec<LicenceException>,
    #[serde(default)]
    duplicate: Vec<Duplicate>,
    #[serde(default)]
    banned: Vec<Banned>,
}

/// A licence that one crate alone may have.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LicenceException {
    #[serde(rename = "crate")]
    name: String,
    licence: String,
    #[serde(rename = "why")]
    _why: String,
}

/// A crate that may be there in several incompatible versions.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Duplicate {
    #[serde(rename = "crate")]
    name: String,
    #[serde(rename = "why")]
    _why: String,
}

/// A crate that may not be there at all.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Banned {
    #[serde(rename = "crate")]
    name: String,
    why: String,
}

/// The part of a package that the rules look at.
#[derive(Clone, Debug)]
struct Dependency {
    name: String,
    version: Version,
    licence: Option<String>,
    /// `None` for our own crates.
    source: Option<String>,
}

/// Checks the workspace, the firmware and the fuzz targets.
pub fn check(workplace: &Workplace) -> Result<()> {
    let file = workplace.root.join("xtask/dependencies.toml");
    let rules: Rules =
        toml::from_str(&fs::read_to_string(&file)?).with_context(|| file.display().to_string())?;
    let advisories = Advisories::read(workplace)?;
    let mut all = shipped(workplace, &rules)?;
    let mut problems = duplicates(&all, &rules);
    if workplace.fuzz_manifest().exists() {
        // Only what is shipped has to be free of duplicates; all else holds for the fuzz targets too.
        all.extend(dependencies(&workplace.fuzz_manifest(), &rules.platforms)?);
    }
    let page = page(&fs::read_to_string(workplace.root.join("web/package-lock.json"))?)?;
    println!("{} packages are in the page", page.len());
    all.extend(page);
    all.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    all.dedup_by(|a, b| a.name == b.name && a.version == b.version);
    for dependency in &all {
        let mut found = Vec::from_iter(licence(dependency, &rules));
        found.extend(origin(dependency, &rules));
        if dependency.source.is_some() {
            found.extend(advisories.matching(&dependency.name, &dependency.version));
        }
        problems.extend(
            found.into_iter().map(|problem| format!("{} {}: {problem}", dependency.name, dependency.version)),
        );
    }
    problems.extend(unused_exceptions(&all, &rules));
    let foreign: BTreeSet<&str> =
        all.iter().filter(|one| one.source.is_some()).map(|one| one.name.as_str()).collect();
    let unread = foreign.iter().filter(|name| !advisories.covers(name)).count();
    println!("{} of {} crates are looked up in the advisory list", foreign.len() - unread, foreign.len());
    if !problems.is_empty() {
        bail!("{}", problems.join("\n       "));
    }
    println!(
        "{} crates from elsewhere: licences and sources are in order, none is on the advisory list",
        foreign.len()
    );
    Ok(())
}

/// The names of all packages from elsewhere, for the advisory database.
pub fn foreign_names(workplace: &Workplace) -> Result<BTreeSet<String>> {
    let file = workplace.root.join("xtask/dependencies.toml");
    let rules: Rules =
        toml::from_str(&fs::read_to_string(&file)?).with_context(|| file.display().to_string())?;
    let mut all = shipped(workplace, &rules)?;
    if workplace.fuzz_manifest().exists() {
        all.extend(dependencies(&workplace.fuzz_manifest(), &rules.platforms)?);
    }
    Ok(all.into_iter().filter(|one| one.source.is_some()).map(|one| one.name).collect())
}

/// What the program and the firmware are built from.
fn shipped(workplace: &Workplace, rules: &Rules) -> Result<Vec<Dependency>> {
    let mut all = dependencies(&workplace.root.join("Cargo.toml"), &rules.platforms)?;
    all.extend(dependencies(&workplace.firmware_manifest(), &[TARGET.to_owned()])?);
    Ok(all)
}

/// Everything that a workspace is built from on our platforms, with all features.
fn dependencies(manifest: &Path, platforms: &[String]) -> Result<Vec<Dependency>> {
    let filters = platforms.iter().map(|platform| format!("--filter-platform={platform}"));
    let metadata: Metadata = MetadataCommand::new()
        .manifest_path(manifest)
        .features(CargoOpt::AllFeatures)
        .other_options(filters.chain(["--locked".to_owned()]).collect::<Vec<_>>())
        .exec()?;
    let resolved = metadata.resolve.as_ref().context("cargo metadata gave no resolved graph")?;
    let reached: BTreeSet<_> = resolved.nodes.iter().map(|node| &node.id).collect();
    Ok(metadata.packages.iter().filter(|package| reached.contains(&package.id)).map(Dependency::of).collect())
}

/// What the page is made of, from npm's lock file. The tools that build it are not in it.
fn page(lock: &str) -> Result<Vec<Dependency>> {
    #[derive(Deserialize)]
    struct Lock {
        packages: BTreeMap<String, Locked>,
    }
    #[derive(Deserialize)]
    struct Locked {
        version: Option<Version>,
        license: Option<String>,
        #[serde(default)]
        dev: bool,
    }
    let lock: Lock = serde_json::from_str(lock).context("web/package-lock.json")?;
    // Without a folder it is the page itself.
    let named = lock.packages.into_iter().filter_map(|(folder, package)| {
        let name = folder.rsplit_once("node_modules/")?.1.to_owned();
        (!package.dev).then_some((name, package))
    });
    let all = named.map(|(name, Locked { version, license: licence, .. })| {
        let version = version.with_context(|| format!("{name} has no version"))?;
        Ok(Dependency { name, version, licence, source: None })
    });
    all.collect()
}

impl Dependency {
    fn of(package: &Package) -> Self {
        Self {
            name: package.name.to_string(),
            version: package.version.clone(),
            licence: package.license.clone(),
            source: package.source.as_ref().map(ToString::to_string),
        }
    }
}

fn licence(dependency: &Dependency, rules: &Rules) -> Option<String> {
    let Some(text) = &dependency.licence else { return Some("states no licence".to_owned()) };
    // Old crates separate with a slash what SPDX separates with OR.
    let expression = match spdx::Expression::parse_mode(text, spdx::ParseMode::LAX) {
        Ok(expression) => expression,
        Err(error) => return Some(format!("licence `{text}` is no SPDX expression: {}", error.reason)),
    };
    let allowed = |requirement: &spdx::LicenseReq| {
        let wanted = requirement.to_string();
        rules.licences.contains(&wanted)
            || rules.licence_exception.iter().any(|one| one.name == dependency.name && one.licence == wanted)
    };
    (!expression.evaluate(allowed)).then(|| format!("licence `{text}` is not among the allowed ones"))
}

fn origin(dependency: &Dependency, rules: &Rules) -> Option<String> {
    if let Some(banned) = rules.banned.iter().find(|banned| banned.name == dependency.name) {
        return Some(format!("is banned: {}", banned.why));
    }
    let source = dependency.source.as_ref()?;
    (!rules.sources.contains(source)).then(|| format!("comes from {source}"))
}

/// Crates that are there in several incompatible versions and not on the list, and the other way round.
fn duplicates(all: &[Dependency], rules: &Rules) -> Vec<String> {
    let mut versions: BTreeMap<&str, BTreeSet<&Version>> = BTreeMap::new();
    for dependency in all {
        versions.entry(&dependency.name).or_default().insert(&dependency.version);
    }
    let listed = |name: &str| rules.duplicate.iter().any(|one| one.name == name);
    let several = versions.iter().filter(|(_, versions)| versions.len() > 1);
    let unlisted = several.clone().filter(|(name, _)| !listed(name)).map(|(name, versions)| {
        let versions: Vec<_> = versions.iter().map(ToString::to_string).collect();
        format!("{name}: is there in several versions: {}", versions.join(", "))
    });
    let stale = rules.duplicate.iter().filter(|one| several.clone().all(|(name, _)| *name != one.name));
    unlisted.chain(stale.map(|one| format!("{}: is listed as a duplicate and is none", one.name))).collect()
}

/// An exception that nothing needs any more would let something in later.
fn unused_exceptions(all: &[Dependency], rules: &Rules) -> Vec<String> {
    let exceptions = rules.licence_exception.iter();
    let unused = exceptions.filter(|one| all.iter().all(|dependency| dependency.name != one.name));
    unused.map(|one| format!("{}: has a licence exception and is not used", one.name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules() -> Rules {
        toml::from_str(
            r#"
            platforms = []
            licences = ["MIT", "Apache-2.0"]
            sources = ["registry+home"]
            licence_exception = [{ crate = "odd", licence = "NCSA", why = "" }]
            duplicate = [{ crate = "twin", why = "" }]
            banned = [{ crate = "evil", why = "reasons" }]
            "#,
        )
        .unwrap()
    }

    fn dependency(name: &str, version: &str, licence: &str, source: &str) -> Dependency {
        let text = |text: &str| (!text.is_empty()).then(|| text.to_owned());
        let version = version.parse().unwrap();
        Dependency { name: name.to_owned(), version, licence: text(licence), source: text(source) }
    }

    #[track_caller]
    fn check_licence(name: &str, text: &str, fine: bool) {
        let problem = licence(&dependency(name, "1.0.0", text, ""), &rules());
        assert_eq!(problem.is_none(), fine, "{name}: {text}: {problem:?}");
    }

    #[test]
    fn licences() {
        check_licence("a", "MIT", true);
        check_licence("a", "MIT/GPL-3.0-only", true);
        check_licence("a", "GPL-3.0-only", false);
        check_licence("a", "MIT AND GPL-3.0-only", false);
        check_licence("a", "Apache-2.0 WITH LLVM-exception", false);
        check_licence("a", "Mine", false);
        check_licence("a", "", false);
        check_licence("odd", "(MIT OR Apache-2.0) AND NCSA", true);
        check_licence("a", "(MIT OR Apache-2.0) AND NCSA", false);
    }

    #[test]
    fn the_page_has_what_is_no_tool() {
        let lock = r#"{ "packages": {
            "": { "version": "0.0.0", "license": "MIT" },
            "node_modules/@a/b": { "version": "1.2.3", "license": "ISC" },
            "node_modules/@a/b/node_modules/c": { "version": "2.0.0" },
            "node_modules/tool": { "version": "3.0.0", "dev": true }
        } }"#;
        let all = page(lock).unwrap();
        let names: Vec<_> = all.iter().map(|one| (one.name.as_str(), one.licence.as_deref())).collect();
        assert_eq!(names, [("@a/b", Some("ISC")), ("c", None)]);
    }

    #[track_caller]
    fn check_origin(name: &str, source: &str, fine: bool) {
        let problem = origin(&dependency(name, "1.0.0", "MIT", source), &rules());
        assert_eq!(problem.is_none(), fine, "{name}: {source}: {problem:?}");
    }

    #[test]
    fn sources_and_bans() {
        check_origin("a", "registry+home", true);
        check_origin("a", "git+elsewhere", false);
        check_origin("ours", "", true);
        check_origin("evil", "registry+home", false);
    }

    #[track_caller]
    fn check_duplicates(all: &[(&str, &str)], expected: &[&str]) {
        let all: Vec<_> =
            all.iter().map(|(name, version)| dependency(name, version, "MIT", "registry+home")).collect();
        assert_eq!(duplicates(&all, &rules()), expected);
    }

    #[test]
    fn duplicates_are_on_the_list_and_the_list_is_true() {
        check_duplicates(&[("twin", "1.0.0"), ("twin", "2.0.0"), ("a", "1.0.0")], &[]);
        check_duplicates(
            &[("twin", "1.0.0"), ("twin", "2.0.0"), ("a", "1.0.0"), ("a", "2.0.0")],
            &["a: is there in several versions: 1.0.0, 2.0.0"],
        );
        check_duplicates(&[("twin", "1.0.0")], &["twin: is listed as a duplicate and is none"]);
    }

    #[test]
    fn exceptions_are_needed() {
        assert_eq!(unused_exceptions(&[], &rules()).len(), 1);
        assert!(unused_exceptions(&[dependency("odd", "1.0.0", "MIT", "")], &rules()).is_empty());
    }
}
