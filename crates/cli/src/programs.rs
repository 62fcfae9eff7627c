//! Program files: what `run` loads.

use crate::Failure;
use std::{fs, path::Path};

/// Largest program file; far above the 2,048 commands that a module holds.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// The machine code of a program file.
pub fn load(path: &Path) -> Result<Vec<u8>, Failure> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("bin") => read(path),
        _ => Err(Failure::Line(format!("{}: a program is a .bin file", path.display()))),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let failed = |error: std::io::Error| Failure::Line(format!("{}: {error}", path.display()));
    // Asked first: whatever lies there may be large.
    let length = fs::metadata(path).map_err(failed)?.len();
    if length > MAX_FILE_BYTES {
        return Err(Failure::Line(format!("{}: {length} bytes are no program", path.display())));
    }
    fs::read(path).map_err(failed)
}
