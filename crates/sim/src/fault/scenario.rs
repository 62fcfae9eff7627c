//! The scenario file: TOML, a table `[[fault]]` for each fault, every mistake as one line with file, line and key.

use super::{Entry, MAX_FAULTS, Parts, Place, Planned, Wrong};
use crate::config::{BenchError, DeviceConfig, Source, read_text};
use serde::Deserialize;
use std::path::Path;

/// The faults of a bench, each with the number of its device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenario {
    /// In the order of the file.
    pub faults: Vec<(usize, Planned)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScenarioFile {
    #[serde(default)]
    fault: Vec<Entry>,
}

/// Finds the address of a place in the source of a program.
pub type Find<'a> = &'a dyn Fn(&Place) -> Result<u32, String>;

/// What there is to find where no source is known.
///
/// # Errors
/// Always: one line of text.
pub fn no_source(_: &Place) -> Result<u32, String> {
    Err("the source of the program is not known here; say `address`".into())
}

impl Scenario {
    /// Reads a scenario for these devices.
    ///
    /// # Errors
    /// [`BenchError`], with the line and key at fault.
    pub fn read(path: &Path, devices: &[DeviceConfig], find: Find<'_>) -> Result<Self, BenchError> {
        let (text, file) = read_text(path)?;
        Self::parse(&text, &file, devices, find)
    }

    /// Reads the text of a scenario; `file` is its name for messages.
    ///
    /// # Errors
    /// [`BenchError`], with the line and key at fault.
    pub fn parse(
        text: &str,
        file: &str,
        devices: &[DeviceConfig],
        find: Find<'_>,
    ) -> Result<Self, BenchError> {
        let source = Source { text, file };
        let (document, content) = source.parse::<ScenarioFile>()?;
        let mut scenario = Self::default();
        for (index, entry) in content.fault.into_iter().enumerate() {
            let number = index.to_string();
            let wrong = |Wrong { key, problem }| source.entry(&document, &["fault", &number, key], problem);
            let device = device(&entry, devices).map_err(wrong)?;
            let planned = entry.parse(&Parts::of(&devices[device]), find).map_err(wrong)?;
            if scenario.of(device).count() == MAX_FAULTS {
                return Err(wrong(Wrong::new("kind", format!("a device has {MAX_FAULTS} faults at most"))));
            }
            scenario.faults.push((device, planned));
        }
        Ok(scenario)
    }

    /// The faults of a device.
    pub fn of(&self, device: usize) -> impl Iterator<Item = &Planned> {
        self.faults.iter().filter(move |(other, _)| *other == device).map(|(_, planned)| planned)
    }
}

/// The number of the device that an entry is about.
fn device(entry: &Entry, devices: &[DeviceConfig]) -> Result<usize, Wrong> {
    let known = || devices.iter().map(|device| device.name.as_str()).collect::<Vec<_>>().join(", ");
    match (&entry.device, devices) {
        (None, [_]) => Ok(0),
        (None, _) => Err(Wrong::new("device", format!("say which: {}", known()))),
        (Some(name), _) => devices
            .iter()
            .position(|device| device.name == *name)
            .ok_or_else(|| Wrong::new("device", format!("unknown device `{name}`, known: {}", known()))),
    }
}
