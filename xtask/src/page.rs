//! The page: what is committed in `web/dist` is what the sources in `web/` give, it is small, and it works in a
//! browser.

use crate::{
    rust, tools,
    workplace::{Workplace, run},
};
use anyhow::{Context, Result, bail};
use flate2::{Compression, write::GzEncoder};
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    io::Write,
    path::{Path, PathBuf},
};

/// The most bytes, as gzip, that a browser loads before it shows the first view.
const MAX_FIRST_LOAD: usize = 300_000;

/// Where the compiled tests go.
const TESTS: &str = "web/.tests";

/// A part of the built page, as the builder's manifest says.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Chunk {
    file: String,
    #[serde(default)]
    imports: Vec<String>,
    #[serde(default)]
    css: Vec<String>,
    #[serde(default)]
    assets: Vec<String>,
}

/// Everything about the page.
pub fn check(workplace: &Workplace) -> Result<()> {
    tools::node(workplace)?;
    install(workplace)?;
    run(&mut tool(workplace, "tsc", &["--noEmit", "-p", "web"]))?;
    let _ = fs::remove_dir_all(workplace.root.join(TESTS));
    run(&mut tool(workplace, "tsc", &["-p", "web/tsconfig.test.json"]))?;
    test(workplace, "src", &[])?;
    let built = build(workplace)?;
    compare(&built, &workplace.root.join("web/dist"))?;
    weigh(&built)?;
    let browser = tools::chromium(workplace)?;
    let program = rust::binary(workplace)?;
    test(workplace, "tests", &[("CHROMIUM", &browser), ("PULSETRAIN", &program)])
}

/// Installs what `package-lock.json` says, unless it is there.
fn install(workplace: &Workplace) -> Result<()> {
    let wanted = fs::read_to_string(workplace.root.join("web/package-lock.json"))?;
    let present = workplace.root.join("web/node_modules/.installed");
    if fs::read_to_string(&present).is_ok_and(|present| present == wanted) {
        return Ok(());
    }
    run(&mut workplace.command("npm", &["ci", "--prefix", "web", "--no-audit", "--no-fund"]))?;
    fs::write(&present, wanted).with_context(|| present.display().to_string())
}

/// One of the tools that were installed.
fn tool(workplace: &Workplace, name: &str, arguments: &[&str]) -> std::process::Command {
    workplace.command(workplace.root.join("web/node_modules/.bin").join(name), arguments)
}

/// Runs the compiled tests below a folder of `web/`, one file at a time: each has a browser or wants the processor.
fn test(workplace: &Workplace, folder: &str, environment: &[(&str, &Path)]) -> Result<()> {
    let root = workplace.root.join(TESTS).join(folder);
    let mut files: Vec<_> = files(&root)?.into_keys().filter(|name| name.ends_with(".test.js")).collect();
    if files.is_empty() {
        bail!("there are no tests in web/{folder}");
    }
    files.iter_mut().for_each(|name| *name = format!("{TESTS}/{folder}/{name}"));
    let mut command = workplace.command("node", &["--test", "--test-reporter=spec", "--test-concurrency=1"]);
    run(command.args(files).envs(environment.iter().copied()))
}

/// Builds the page, with the manifest beside it.
fn build(workplace: &Workplace) -> Result<PathBuf> {
    let built = workplace.target.join("page");
    let mut command = tool(workplace, "vite", &["build", "web", "--emptyOutDir", "--manifest", "--outDir"]);
    run(command.arg(&built))?;
    Ok(built)
}

/// Compares the page that was built with the one that is committed, byte by byte.
fn compare(built: &Path, committed: &Path) -> Result<()> {
    let (mut wanted, present) = (files(built)?, files(committed)?);
    wanted.retain(|name, _| !name.starts_with(".vite/"));
    let names: BTreeSet<_> = wanted.keys().chain(present.keys()).collect();
    let other: Vec<_> = names
        .into_iter()
        .filter(|name| wanted.get(*name) != present.get(*name))
        .map(String::as_str)
        .collect();
    if !other.is_empty() {
        bail!("web/dist is not what web/ gives (npm run build in web/): {}", other.join(", "));
    }
    println!("web/dist is what web/ gives: {} files", wanted.len());
    Ok(())
}

/// Counts what a browser loads first, and holds it to the limit.
fn weigh(built: &Path) -> Result<()> {
    let manifest = fs::read_to_string(built.join(".vite/manifest.json")).context("the builder's manifest")?;
    let chunks: BTreeMap<String, Chunk> = serde_json::from_str(&manifest)?;
    let mut total = 0;
    for name in first_load(&chunks)? {
        let bytes = fs::read(built.join(&name)).with_context(|| name.clone())?;
        let packed = packed(&bytes)?;
        println!("{packed:>9} of {:>9} bytes  {name}", bytes.len());
        total += packed;
    }
    println!("{total:>9} bytes are loaded first, {MAX_FIRST_LOAD} may be");
    if total > MAX_FIRST_LOAD {
        bail!("the first load of the page is too large");
    }
    Ok(())
}

/// The files that the browser asks for before the first view: the index, what it names, and what that imports.
fn first_load(chunks: &BTreeMap<String, Chunk>) -> Result<BTreeSet<String>> {
    let mut files = BTreeSet::from(["index.html".to_owned()]);
    let mut open = vec!["index.html"];
    let mut seen = BTreeSet::new();
    while let Some(name) = open.pop() {
        if !seen.insert(name) {
            continue;
        }
        let chunk = chunks.get(name).with_context(|| format!("the manifest has no `{name}`"))?;
        files.insert(chunk.file.clone());
        files.extend(chunk.css.iter().chain(&chunk.assets).cloned());
        open.extend(chunk.imports.iter().map(String::as_str));
    }
    Ok(files)
}

/// How many bytes something has as gzip, the way that the server sends it.
fn packed(bytes: &[u8]) -> Result<usize> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    // What gzip makes larger is sent as it is.
    Ok(encoder.finish()?.len().min(bytes.len()))
}

/// The files below a folder by their path in it, with what is in them.
fn files(root: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(root)?.to_string_lossy().into_owned();
            found.insert(name, fs::read(path)?);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_loaded_first_is_followed_through_imports() {
        let chunks = serde_json::from_str(
            r#"{
                "index.html": { "file": "a.js", "imports": ["_b.js"], "dynamicImports": ["d.ts"], "css": ["a.css"] },
                "_b.js": { "file": "b.js", "imports": ["index.html"], "assets": ["b.svg"] },
                "d.ts": { "file": "d.js", "imports": ["_b.js"] }
            }"#,
        );
        let files = first_load(&chunks.unwrap()).unwrap();
        assert_eq!(Vec::from_iter(&files), ["a.css", "a.js", "b.js", "b.svg", "index.html"]);
        assert!(first_load(&BTreeMap::new()).is_err());
    }

    #[test]
    fn pages_are_compared_byte_by_byte() {
        let root = std::env::temp_dir().join(format!("xtask-page-{}", std::process::id()));
        let (built, committed) = (root.join("built"), root.join("committed"));
        for folder in [&built, &committed] {
            fs::create_dir_all(folder.join("assets")).unwrap();
            fs::write(folder.join("assets/a.js"), "a").unwrap();
        }
        fs::create_dir_all(built.join(".vite")).unwrap();
        fs::write(built.join(".vite/manifest.json"), "{}").unwrap();
        let same = compare(&built, &committed);
        fs::write(committed.join("assets/a.js"), "b").unwrap();
        fs::write(committed.join("old.js"), "").unwrap();
        let other = compare(&built, &committed).unwrap_err().to_string();
        fs::remove_dir_all(&root).unwrap();
        same.unwrap();
        assert!(other.ends_with(": assets/a.js, old.js"), "{other}");
    }

    #[test]
    fn what_cannot_be_packed_counts_as_it_is() {
        assert_eq!(packed(b"a").unwrap(), 1);
        assert!(packed(&[b'a'; 10_000]).unwrap() < 100);
    }
}
