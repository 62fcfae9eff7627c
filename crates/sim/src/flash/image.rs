//! Images in files: one a device, replaced as a whole.

use super::SharedFlash;
use std::{
    fs::{self, File},
    io::{self, Write as _},
    path::{Path, PathBuf},
};

/// Why an image cannot be loaded or saved; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The file cannot be read.
    #[error("{}: cannot read the flash image: {problem}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        problem: io::Error,
    },
    /// The file is not an image of this device.
    #[error("{}: the flash image has {found} bytes, the device {expected}", path.display())]
    Size {
        /// The file.
        path: PathBuf,
        /// Bytes of the file.
        found: u64,
        /// Bytes of the device's flash.
        expected: u32,
    },
    /// The file cannot be written.
    #[error("{}: cannot write the flash image: {problem}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        problem: io::Error,
    },
}

/// Where the image of a device lies in a directory of images.
pub fn image_path(directory: &Path, device: &str) -> PathBuf {
    directory.join(format!("{device}.flash"))
}

impl SharedFlash {
    /// The image of a file, or an erased memory if there is no such file yet.
    ///
    /// # Errors
    /// [`ImageError::Read`] and [`ImageError::Size`].
    pub fn load(path: &Path, capacity: u32) -> Result<Self, ImageError> {
        let unreadable = |problem| ImageError::Read { path: path.into(), problem };
        let found = match fs::metadata(path) {
            Ok(metadata) => metadata.len(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::erased(capacity)),
            Err(error) => return Err(unreadable(error)),
        };
        // Before reading: whatever lies there may be large.
        if found != u64::from(capacity) {
            return Err(ImageError::Size { path: path.into(), found, expected: capacity });
        }
        let bytes = fs::read(path).map_err(unreadable)?;
        if bytes.len() != capacity as usize {
            return Err(ImageError::Size {
                path: path.into(),
                found: bytes.len() as u64,
                expected: capacity,
            });
        }
        Ok(Self::from_bytes(bytes))
    }

    /// Writes the image to a file, so that the file holds the old image or the new one whatever happens.
    /// Directories are made.
    ///
    /// # Errors
    /// [`ImageError::Write`].
    pub fn save(&self, path: &Path) -> Result<(), ImageError> {
        let replace = || {
            if let Some(directory) = path.parent() {
                fs::create_dir_all(directory)?;
            }
            let mut name = path.as_os_str().to_owned();
            name.push(".new");
            let mut file = File::create(&name)?;
            file.write_all(&self.to_bytes())?;
            file.sync_all()?;
            drop(file);
            fs::rename(&name, path)
        };
        replace().map_err(|problem| ImageError::Write { path: path.into(), problem })
    }
}
