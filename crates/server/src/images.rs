//! Flash images on disk: loaded at the start, saved soon after each change and at the end.

use crate::{Error, stop::Watch};
use sim::{
    DeviceConfig, SharedFlash,
    flash::{ImageError, image_path},
};
use std::{
    fs::{self, File, TryLockError},
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

/// How often changes are looked for: what a killed process loses at most.
const PERIOD: Duration = Duration::from_millis(100);

/// Locked while a process uses the directory.
const LOCK_FILE: &str = ".lock";

/// The images of all devices. Its clones are the same.
#[derive(Clone)]
pub(crate) struct Images {
    directory: Option<PathBuf>,
    images: Arc<Mutex<Vec<Image>>>,
    /// Others may use the directory once it is released, whoever still has a clone.
    lock: Arc<Mutex<Option<File>>>,
}

/// One device's memory and the file it goes to.
struct Image {
    /// The device.
    name: String,
    flash: SharedFlash,
    path: PathBuf,
    /// How many operations the memory had seen when it was saved.
    saved: u64,
}

impl Images {
    /// Takes the directory for this process; makes it if there is none.
    pub fn open(directory: Option<PathBuf>) -> Result<Self, Error> {
        let lock = directory.as_ref().map(|path| {
            let failed = |source| Error::State { path: path.clone(), source };
            fs::create_dir_all(path).map_err(failed)?;
            let file = File::create(path.join(LOCK_FILE)).map_err(failed)?;
            match file.try_lock() {
                Ok(()) => Ok(file),
                Err(TryLockError::WouldBlock) => Err(Error::StateInUse(path.clone())),
                Err(TryLockError::Error(source)) => Err(failed(source)),
            }
        });
        Ok(Self { directory, images: Arc::default(), lock: Arc::new(Mutex::new(lock.transpose()?)) })
    }

    /// The memory of a device, as its file has it.
    pub fn load(&self, config: &DeviceConfig) -> Result<SharedFlash, Error> {
        let Some(directory) = &self.directory else {
            return Ok(SharedFlash::erased(config.model.flash_bytes));
        };
        let path = image_path(directory, &config.name);
        let flash = SharedFlash::load(&path, config.model.flash_bytes)?;
        let (name, saved) = (config.name.clone(), flash.operations());
        self.images().push(Image { name, saved, flash: flash.clone(), path });
        Ok(flash)
    }

    /// Saves the memory of a device that is no more.
    pub fn forget(&self, name: &str) -> Result<(), ImageError> {
        let mut images = self.images();
        let Some(place) = images.iter().position(|image| image.name == name) else { return Ok(()) };
        images.swap_remove(place).save()
    }

    /// Saves what has changed until it is over; `None` if nothing is ever kept.
    pub fn keeper(&self, stop: Watch) -> Option<impl FnOnce() + Send + 'static> {
        let images = self.clone();
        self.directory.is_some().then_some(move || {
            let mut told = false;
            while !stop.within(PERIOD) {
                for image in &mut *images.images() {
                    if let Err(error) = image.save()
                        && !told
                    {
                        eprintln!("warning: {error}");
                        told = true;
                    }
                }
            }
        })
    }

    /// Saves all that have changed.
    pub fn save(&self) -> Result<(), Error> {
        let results: Vec<_> = self.images().iter_mut().map(Image::save).collect();
        Ok(results.into_iter().collect::<Result<(), _>>()?)
    }

    /// Gives the directory up.
    pub fn release(&self) {
        drop(self.lock.lock().unwrap_or_else(PoisonError::into_inner).take());
    }

    fn images(&self) -> MutexGuard<'_, Vec<Image>> {
        self.images.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Image {
    fn save(&mut self) -> Result<(), ImageError> {
        // Counted before, so that what comes meanwhile is saved next time.
        let operations = self.flash.operations();
        if operations != self.saved {
            self.flash.save(&self.path)?;
            self.saved = operations;
        }
        Ok(())
    }
}
