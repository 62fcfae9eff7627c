//! The bench file: TOML to [`Bench`], every mistake as one line with file, line and key.

use super::{
    AxisConfig, Bench, DEFAULT_SUPPLY_V, DEFAULT_TEMPERATURE_C, DeviceConfig, Endpoint, MAX_DEVICES,
    PlaceError,
};
use super::{
    axis::{AxisEntry, check_cams},
    fleet, keys,
    source::{self, BenchError, Source},
};
use crate::flash::SharedFlash;
use devices::{Model, Wiring};
use serde::{Deserialize, Serialize};
use std::{
    collections::{BTreeMap, HashSet},
    path::Path,
};

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct BenchFile {
    device: Vec<DeviceEntry>,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct DeviceEntry {
    model: String,
    count: Option<usize>,
    name: Option<String>,
    #[serde(default)]
    listen: Vec<String>,
    supply: Option<f64>,
    temperature: Option<f64>,
    seed: Option<u64>,
    #[serde(default)]
    axis: BTreeMap<String, AxisEntry>,
}

impl From<&DeviceConfig> for DeviceEntry {
    fn from(config: &DeviceConfig) -> Self {
        let DeviceConfig { model, name, listen, axes, supply_v, temperature_c, seed } = config;
        let usual = DeviceConfig::new(model);
        // What is usual need not be said, and may not where the device has no such pin.
        let unusual = |value: f64, usual: f64| (value != usual).then_some(value);
        let controller = (model.build)(Box::new(SharedFlash::erased(model.flash_bytes)), 0);
        let entry = |(axis, config): (&String, &AxisConfig)| {
            (axis.clone(), AxisEntry::of(config, &AxisConfig::of_model(model.name), controller.axes()))
        };
        Self {
            model: model.name.into(),
            count: None,
            name: Some(name.clone()),
            listen: listen.iter().map(ToString::to_string).collect(),
            supply: unusual(*supply_v, usual.supply_v),
            temperature: unusual(*temperature_c, usual.temperature_c),
            seed: *seed,
            axis: axes.iter().map(entry).collect(),
        }
    }
}

/// The text of a bench file with these devices.
pub fn text(devices: &[DeviceConfig]) -> String {
    let file = BenchFile { device: devices.iter().map(Into::into).collect() };
    // Numbers, texts and tables only.
    toml::to_string(&file).expect("a bench can be written as TOML")
}

pub(super) fn read(path: &Path) -> Result<Bench, BenchError> {
    let (text, file) = source::read(path)?;
    parse(&text, &file, devices::MODELS)
}

pub(super) fn parse(text: &str, file: &str, models: &'static [Model]) -> Result<Bench, BenchError> {
    parse_where(text, file, models, |_| Ok(()))
}

/// The same where not every endpoint may be opened.
pub(super) fn parse_where(
    text: &str,
    file: &str,
    models: &'static [Model],
    may: fn(&Endpoint) -> Result<(), PlaceError>,
) -> Result<Bench, BenchError> {
    let source = Source { text, file };
    let (document, bench) = source.parse::<BenchFile>()?;
    let at = |path: &[&str], problem: String| source.entry(&document, path, problem);

    // What was written, and not what was taken of it: of an array that is too long that is less.
    let table = text.parse().expect("a bench file is a table");
    keys::check(keys::BENCH, &table).map_err(|wrong| {
        let path: Vec<_> = wrong.path.iter().map(String::as_str).collect();
        at(&path, wrong.problem)
    })?;
    let count: usize =
        bench.device.iter().map(|entry| entry.count.unwrap_or(1)).fold(0, usize::saturating_add);
    if count > MAX_DEVICES {
        return Err(at(&["device"], format!("{MAX_DEVICES} devices at most")));
    }
    let mut devices: Vec<DeviceConfig> = Vec::new();
    let mut names = HashSet::new();
    for (index, entry) in bench.device.into_iter().enumerate() {
        let number = index.to_string();
        let wrong = |path: &[&str], problem: String| at(&[&["device", &number], path].concat(), problem);
        for entry in each(entry, &wrong)? {
            let device = device(entry, models, &wrong)?;
            if !names.insert(device.name.clone()) {
                return Err(wrong(&["name"], format!("there is already a device named `{}`", device.name)));
            }
            for endpoint in &device.listen {
                let place = may(endpoint).and_then(|()| device.fits(endpoint, &devices));
                place.map_err(|error| wrong(&["listen"], format!("{endpoint}: {error}")))?;
            }
            devices.push(device);
        }
    }
    Ok(Bench { devices })
}

/// The entries of the devices that one entry stands for.
fn each(entry: DeviceEntry, wrong: Wrong<'_>) -> Result<Vec<DeviceEntry>, BenchError> {
    let Some(count) = entry.count else { return Ok(vec![entry]) };
    if entry.name.as_ref().is_some_and(|name| !fleet::is_numbered(name)) {
        return Err(wrong(&["name"], "where there is a `count` it has `{n}` in it".into()));
    }
    let name = entry.name.clone().unwrap_or_else(|| format!("{}-{{n}}", entry.model));
    let numbered =
        |key, text: &str, number| fleet::numbered(text, number).map_err(|problem| wrong(&[key], problem));
    let one = |number| {
        let listen = entry.listen.iter().map(|endpoint| numbered("listen", endpoint, number));
        Ok(DeviceEntry {
            name: Some(numbered("name", &name, number)?),
            listen: listen.collect::<Result<_, _>>()?,
            ..entry.clone()
        })
    };
    (1..=count).map(one).collect()
}

type Wrong<'a> = &'a dyn Fn(&[&str], String) -> BenchError;

fn device(
    entry: DeviceEntry,
    models: &'static [Model],
    wrong: Wrong<'_>,
) -> Result<DeviceConfig, BenchError> {
    let Some(model) = models.iter().find(|model| model.name == entry.model) else {
        let known: Vec<_> = models.iter().map(|model| model.name).collect();
        return Err(wrong(
            &["model"],
            format!("unknown model `{}`, known: {}", entry.model, known.join(", ")),
        ));
    };
    let name = entry.name.unwrap_or_else(|| model.name.into());
    if !is_name(&name) {
        return Err(wrong(&["name"], format!("`{name}` is not a name: letters, digits, `.`, `_`, `-`")));
    }
    let mut listen = Vec::new();
    for text in &entry.listen {
        let endpoint: Endpoint = text.parse().map_err(|error| wrong(&["listen"], format!("{error}")))?;
        if listen.contains(&endpoint) && endpoint.can_be_shared() {
            return Err(wrong(&["listen"], format!("`{text}` is there twice")));
        }
        listen.push(endpoint);
    }
    let controller = (model.build)(Box::new(SharedFlash::erased(model.flash_bytes)), 0);
    let has = |wiring: Wiring| controller.pins().iter().any(|pin| pin.wiring == wiring);
    for (key, given, wiring) in
        [("supply", entry.supply, Wiring::Supply), ("temperature", entry.temperature, Wiring::Temperature)]
    {
        if given.is_some() && !has(wiring) {
            return Err(wrong(&[key], format!("{} has no pin that measures this", model.name)));
        }
    }
    let supply_v = entry.supply.unwrap_or(DEFAULT_SUPPLY_V);
    let temperature_c = entry.temperature.unwrap_or(DEFAULT_TEMPERATURE_C);
    // Only a controller itself knows its axes.
    let names = controller.axes();
    let mut axes = BTreeMap::new();
    for (axis, entry) in entry.axis {
        let Some(number) = names.iter().position(|name| *name == axis) else {
            let problem = format!("unknown axis `{axis}`, {} has: {}", model.name, names.join(", "));
            return Err(wrong(&["axis", &axis], problem));
        };
        let at = |key: &str, problem| {
            let keys: Vec<_> = ["axis", &axis].into_iter().chain(key.split('.')).collect();
            wrong(&keys, problem)
        };
        let config = entry.config(model.name, controller.as_ref(), number, &at)?;
        axes.insert(axis, config);
    }
    check_cams(axes.values()).map_err(|problem| wrong(&["axis"], problem))?;
    Ok(DeviceConfig { model, name, listen, axes, supply_v, temperature_c, seed: entry.seed })
}

/// Whether a device can be called so: a name is also a file's name and a part of a URL.
pub fn is_name(name: &str) -> bool {
    !name.starts_with('.')
        && (1..=64).contains(&name.len())
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"._-".contains(&byte))
}
