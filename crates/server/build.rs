//! Puts the built page, `web/dist`, into the program: every file as it is and compressed.

use flate2::{Compression, write::GzEncoder};
use std::{
    collections::BTreeMap,
    env,
    error::Error,
    fmt::Write as _,
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    io::Write as _,
    path::{Path, PathBuf},
};

/// What the page may consist of, by extension. Another kind of file is an error: it would be served as the wrong thing.
const KINDS: [(&str, &str); 8] = [
    ("css", "text/css; charset=utf-8"),
    ("html", "text/html; charset=utf-8"),
    ("ico", "image/x-icon"),
    ("js", "text/javascript; charset=utf-8"),
    ("png", "image/png"),
    ("svg", "image/svg+xml"),
    ("webmanifest", "application/manifest+json"),
    ("woff2", "font/woff2"),
];

fn main() -> Result<(), Box<dyn Error>> {
    let dist = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("../../web/dist");
    let out = PathBuf::from(env::var("OUT_DIR")?);
    println!("cargo::rerun-if-changed={}", dist.display());
    let mut files = BTreeMap::new();
    collect(&dist, "", &mut files)?;

    let mut table = String::from("&[\n");
    for (number, (path, file)) in files.iter().enumerate() {
        let bytes = fs::read(file)?;
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        packed.write_all(&bytes)?;
        let packed_file = out.join(format!("{number}.gz"));
        fs::write(&packed_file, packed.finish()?)?;
        let mut hasher = DefaultHasher::new();
        bytes.hash(&mut hasher);
        writeln!(
            table,
            "File {{ path: {path:?}, kind: {:?}, tag: \"W/\\\"{:016x}\\\"\", plain: include_bytes!({file:?}), packed: \
             include_bytes!({packed_file:?}) }},",
            kind(file)?,
            hasher.finish(),
        )?;
    }
    table.push(']');
    fs::write(out.join("page.rs"), table)?;
    Ok(())
}

/// The files of a folder and those below it, by their path in URLs.
fn collect(folder: &Path, prefix: &str, files: &mut BTreeMap<String, PathBuf>) -> Result<(), Box<dyn Error>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in entries {
        let entry = entry?;
        let name =
            entry.file_name().into_string().map_err(|name| format!("{}: not UTF-8", name.display()))?;
        let (path, file) = (format!("{prefix}/{name}"), entry.path());
        if entry.file_type()?.is_dir() {
            collect(&file, &path, files)?;
        } else {
            files.insert(path, file.canonicalize()?);
        }
    }
    Ok(())
}

fn kind(file: &Path) -> Result<&'static str, String> {
    let extension = file.extension().and_then(|extension| extension.to_str());
    let kind = KINDS.iter().find(|(known, _)| Some(*known) == extension);
    kind.map(|(_, kind)| *kind).ok_or_else(|| format!("{}: no such kind of file is served", file.display()))
}
