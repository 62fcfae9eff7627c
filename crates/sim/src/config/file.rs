//! The bench file: TOML to [`Bench`], every mistake as one line with file, line and key.

use super::source::{self, BenchError, Source};
use super::{
    AxisConfig, Bench, DEFAULT_SUPPLY_V, DEFAULT_TEMPERATURE_C, DeviceConfig, Endpoint, MAX_DEVICES,
    MAX_IN_POSITION_MS, MAX_MPG_HZ, MAX_PULSES,
};
use crate::flash::SharedFlash;
use devices::{Controller, Model, Wiring};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::Path};

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct BenchFile {
    device: Vec<DeviceEntry>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct DeviceEntry {
    model: String,
    name: Option<String>,
    #[serde(default)]
    listen: Vec<String>,
    supply: Option<f64>,
    temperature: Option<f64>,
    seed: Option<u64>,
    #[serde(default)]
    axis: BTreeMap<String, AxisEntry>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct AxisEntry {
    negative_limit: Option<i64>,
    positive_limit: Option<i64>,
    home: Option<[i64; 2]>,
    index_every: Option<i64>,
    encoder_ratio: Option<f64>,
    backlash: Option<i64>,
    load: Option<f64>,
    hard_stops: Option<[i64; 2]>,
    slowdown: Option<SlowdownEntry>,
    in_position_ms: Option<u32>,
    mpg_from: Option<String>,
    mpg_hz: Option<u32>,
}

/// Where the slowdown switch is on.
#[derive(Deserialize, Serialize)]
#[serde(untagged, expecting = "expected one zone as `[0, 5]` or two as `[[0, 5], [10, 15]]`")]
enum SlowdownEntry {
    One([i64; 2]),
    Two([[i64; 2]; 2]),
}

impl From<&DeviceConfig> for DeviceEntry {
    fn from(config: &DeviceConfig) -> Self {
        let DeviceConfig { model, name, listen, axes, supply_v, temperature_c, seed } = config;
        let usual = DeviceConfig::new(model);
        // What is usual need not be said, and may not where the device has no such pin.
        let unusual = |value: f64, usual: f64| (value != usual).then_some(value);
        let controller = (model.build)(Box::new(SharedFlash::erased(model.flash_bytes)), 0);
        let entry = |(axis, config): (&String, &AxisConfig)| {
            (axis.clone(), AxisEntry::new(config, &AxisConfig::of_model(model.name), controller.axes()))
        };
        Self {
            model: model.name.into(),
            name: Some(name.clone()),
            listen: listen.iter().map(ToString::to_string).collect(),
            supply: unusual(*supply_v, usual.supply_v),
            temperature: unusual(*temperature_c, usual.temperature_c),
            seed: *seed,
            axis: axes.iter().map(entry).collect(),
        }
    }
}

impl AxisEntry {
    /// What an axis has that others do not.
    fn new(config: &AxisConfig, usual: &AxisConfig, names: &[&str]) -> Self {
        fn unusual<T: PartialEq + Copy>(value: T, usual: T) -> Option<T> {
            (value != usual).then_some(value)
        }
        Self {
            negative_limit: unusual(config.negative_limit, usual.negative_limit),
            positive_limit: unusual(config.positive_limit, usual.positive_limit),
            home: unusual(config.home, usual.home),
            index_every: unusual(config.index_every, usual.index_every),
            encoder_ratio: unusual(config.encoder_ratio, usual.encoder_ratio),
            backlash: unusual(config.backlash, usual.backlash),
            load: unusual(config.load, usual.load),
            hard_stops: config.hard_stops,
            slowdown: match config.slowdown {
                [Some(one), None] => Some(SlowdownEntry::One(one)),
                [Some(one), Some(two)] => Some(SlowdownEntry::Two([one, two])),
                _ => None,
            },
            in_position_ms: config.in_position_ms,
            mpg_from: config.mpg_from.map(|axis| names[axis].into()),
            mpg_hz: unusual(config.mpg_hz, usual.mpg_hz),
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
    let source = Source { text, file };
    let (document, bench) = source.parse::<BenchFile>()?;
    let at = |path: &[&str], problem: String| source.entry(&document, path, problem);

    if bench.device.len() > MAX_DEVICES {
        return Err(at(&["device"], format!("{MAX_DEVICES} devices at most")));
    }
    let mut devices: Vec<DeviceConfig> = Vec::new();
    for (index, entry) in bench.device.into_iter().enumerate() {
        let number = index.to_string();
        let wrong = |path: &[&str], problem: String| at(&[&["device", &number], path].concat(), problem);
        let device = device(entry, models, &wrong)?;
        if devices.iter().any(|other| other.name == device.name) {
            return Err(wrong(&["name"], format!("there is already a device named `{}`", device.name)));
        }
        for endpoint in &device.listen {
            let place = device.fits(endpoint, &devices);
            place.map_err(|error| wrong(&["listen"], format!("{endpoint}: {error}")))?;
        }
        devices.push(device);
    }
    Ok(Bench { devices })
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
    if !(0.0..=1000.0).contains(&supply_v) {
        return Err(wrong(&["supply"], format!("{supply_v} V is outside 0 to 1000 V")));
    }
    let temperature_c = entry.temperature.unwrap_or(DEFAULT_TEMPERATURE_C);
    if !(-273.0..=1000.0).contains(&temperature_c) {
        return Err(wrong(&["temperature"], format!("{temperature_c} °C is outside -273 to 1000 °C")));
    }
    // Only a controller itself knows its axes.
    let names = controller.axes();
    let mut axes = BTreeMap::new();
    for (axis, entry) in entry.axis {
        let Some(number) = names.iter().position(|name| *name == axis) else {
            let problem = format!("unknown axis `{axis}`, {} has: {}", model.name, names.join(", "));
            return Err(wrong(&["axis", &axis], problem));
        };
        let wrong = |key: &str, problem| wrong(&["axis", &axis, key], problem);
        let usual = AxisConfig::of_model(model.name);
        let usual = signals(controller.as_ref(), number, &entry, usual, &wrong)?;
        let config = axis_config(entry, usual, &wrong)?;
        axes.insert(axis, config);
    }
    Ok(DeviceConfig { model, name, listen, axes, supply_v, temperature_c, seed: entry.seed })
}

/// What is wired to an axis beside its switches: `usual` with that.
fn signals(
    controller: &dyn Controller,
    axis: usize,
    entry: &AxisEntry,
    usual: AxisConfig,
    wrong: &dyn Fn(&str, String) -> BenchError,
) -> Result<AxisConfig, BenchError> {
    let has = |wiring: Wiring| controller.pins().iter().any(|pin| pin.wiring == wiring);
    let missing = [
        ("slowdown", entry.slowdown.is_some() && !has(Wiring::Slowdown(axis)), "slowdown"),
        ("in_position_ms", entry.in_position_ms.is_some() && !has(Wiring::InPosition(axis)), "in-position"),
        ("mpg_from", entry.mpg_from.is_some() && !controller.has_pulser(axis), "MPG"),
        ("mpg_hz", entry.mpg_hz.is_some() && !controller.has_pulser(axis), "MPG"),
    ];
    if let Some((key, _, input)) = missing.into_iter().find(|(_, missing, _)| *missing) {
        return Err(wrong(key, format!("the device has no {input} input for this axis")));
    }
    let slowdown = match entry.slowdown {
        None => usual.slowdown,
        Some(SlowdownEntry::One(zone)) => [Some(zone), None],
        Some(SlowdownEntry::Two(zones)) => zones.map(Some),
    };
    let ends: Vec<_> = slowdown.into_iter().flatten().flatten().collect();
    if let [_, end, start, _] = ends[..]
        && end.saturating_add(1) >= start
    {
        return Err(wrong("slowdown", format!("the second zone must begin above {end}, with a gap")));
    }
    if let Some(pair) = ends.windows(2).find(|pair| pair[0] > pair[1]) {
        return Err(wrong("slowdown", format!("{} must not lie above {}", pair[0], pair[1])));
    }
    if let Some(end) = ends.iter().find(|end| !(-MAX_PULSES..=MAX_PULSES).contains(*end)) {
        return Err(wrong("slowdown", format!("{end} is outside -{MAX_PULSES} to {MAX_PULSES} pulses")));
    }
    if let Some(ms) = entry.in_position_ms.filter(|ms| !(1..=MAX_IN_POSITION_MS).contains(ms)) {
        return Err(wrong("in_position_ms", format!("{ms} is outside 1 to {MAX_IN_POSITION_MS} ms")));
    }
    let names = controller.axes();
    let mpg_from = match &entry.mpg_from {
        None => None,
        Some(name) => match names.iter().position(|other| other == name) {
            None => {
                return Err(wrong("mpg_from", format!("unknown axis `{name}`, known: {}", names.join(", "))));
            }
            Some(other) if other == axis => {
                return Err(wrong("mpg_from", "an axis does not follow itself".into()));
            }
            other => other,
        },
    };
    let mpg_hz = entry.mpg_hz.unwrap_or(usual.mpg_hz);
    if !(1..=MAX_MPG_HZ).contains(&mpg_hz) {
        return Err(wrong("mpg_hz", format!("{mpg_hz} is outside 1 to {MAX_MPG_HZ} counts a second")));
    }
    Ok(AxisConfig { slowdown, in_position_ms: entry.in_position_ms, mpg_from, mpg_hz, ..usual })
}

/// `usual` with the machine that an entry describes.
fn axis_config(
    entry: AxisEntry,
    usual: AxisConfig,
    wrong: &dyn Fn(&str, String) -> BenchError,
) -> Result<AxisConfig, BenchError> {
    // Said only where it was given, so that the message points to a line that exists.
    let limit_key = if entry.positive_limit.is_some() { "positive_limit" } else { "negative_limit" };
    let config = AxisConfig {
        negative_limit: entry.negative_limit.unwrap_or(usual.negative_limit),
        positive_limit: entry.positive_limit.unwrap_or(usual.positive_limit),
        home: entry.home.unwrap_or(usual.home),
        index_every: entry.index_every.unwrap_or(usual.index_every),
        encoder_ratio: entry.encoder_ratio.unwrap_or(usual.encoder_ratio),
        backlash: entry.backlash.unwrap_or(usual.backlash),
        load: entry.load.unwrap_or(usual.load),
        hard_stops: entry.hard_stops,
        ..usual
    };
    let [home, stops] = [config.home, config.hard_stops.unwrap_or([-1, 1])];
    let positions = [
        ("negative_limit", config.negative_limit),
        ("positive_limit", config.positive_limit),
        ("home", home[0]),
        ("home", home[1]),
        ("hard_stops", stops[0]),
        ("hard_stops", stops[1]),
    ];
    for (key, position) in positions {
        if !(-MAX_PULSES..=MAX_PULSES).contains(&position) {
            return Err(wrong(key, format!("{position} is outside -{MAX_PULSES} to {MAX_PULSES} pulses")));
        }
    }
    let [low, high] = [config.negative_limit, config.positive_limit];
    if low >= high {
        let problem = format!("the negative limit {low} must lie below the positive limit {high}");
        return Err(wrong(limit_key, problem));
    }
    if home[0] > home[1] {
        return Err(wrong("home", format!("{} must not lie above {}", home[0], home[1])));
    }
    if stops[0] > 0 || stops[1] < 0 || stops[0] == stops[1] {
        return Err(wrong("hard_stops", "0, where the axis starts, must lie between the stops".into()));
    }
    if !(1..=MAX_PULSES).contains(&config.index_every) {
        return Err(wrong(
            "index_every",
            format!("{} is outside 1 to {MAX_PULSES} pulses", config.index_every),
        ));
    }
    if !(0..=MAX_PULSES).contains(&config.backlash) {
        return Err(wrong("backlash", format!("{} is outside 0 to {MAX_PULSES} pulses", config.backlash)));
    }
    // The ratio becomes a fraction with 32 bits below the point.
    if !(1e-6..=1e6).contains(&config.encoder_ratio.abs()) {
        let problem = format!("{} is outside 0.000001 to 1000000 counts a pulse", config.encoder_ratio);
        return Err(wrong("encoder_ratio", problem));
    }
    if !(0.0..=1000.0).contains(&config.load) {
        return Err(wrong("load", format!("{} is outside 0 to 1000", config.load)));
    }
    Ok(config)
}

/// Whether a device can be called so: a name is also a file's name and a part of a URL.
pub fn is_name(name: &str) -> bool {
    !name.starts_with('.')
        && (1..=64).contains(&name.len())
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"._-".contains(&byte))
}
