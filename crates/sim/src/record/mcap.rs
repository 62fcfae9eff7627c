//! MCAP, for Foxglove and whoever else reads it: messages in JSON, each topic with its JSON Schema.
//!
//! | topic | when | fields |
//! |---|---|---|
//! | `/DEVICE/axis/X` | every [`SAMPLE_MS`] while something changes, every [`IDLE_SAMPLES`]th of them, and the last before a change | `position`, `encoder`, `speed` (pulses a second), `target`, `status`, `steps` |
//! | `/DEVICE/axis/X/drive` | at a change | `current` (coil current in 1/32 of the module's maximum), `step`, `parts` |
//! | `/DEVICE/axis/X/event` | | `event`: `started`, `target_reached` or `stopped` |
//! | `/DEVICE/pin/NAME` | at a change | `value`: level 0 or 1, or number in the unit that the channel's `unit` says |
//! | `/DEVICE/port/NAME` | | `direction`: `received` or `sent`; `bytes` in hexadecimal |
//! | `/DEVICE/note` | | `event`: `fault`, `cleared`, `notice` or `power_up`; `text` |
//!
//! Times are nanoseconds of device time from power-up, each rounded down from its clock by itself.

use super::{Mark, Note, RecordError, RecordInfo, Recorder, hex, nanoseconds};
use crate::tape::PortName;
use devices::{AxisState, Drive, Port};
use mcap::{McapError, McapResult, records::MessageHeader};
use motion::{Ticks, Train};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    io::{Seek, Write},
    path::PathBuf,
};

/// How often the axes are looked at.
pub const SAMPLE_MS: u64 = 1;

/// An axis where nothing changes is written this seldom.
pub const IDLE_SAMPLES: u32 = 100;

/// The channels of an axis.
struct AxisChannels {
    state: u16,
    drive: u16,
    event: u16,
    /// What was written last, how often it was left out since, and when the last time was.
    shown: Option<AxisState>,
    same: u32,
    left_out_at: Option<Ticks>,
}

/// All channels.
struct Channels {
    axes: Vec<AxisChannels>,
    pins: Vec<u16>,
    ports: Vec<u16>,
    note: u16,
}

/// The ports in the order of their channels.
const PORTS: [PortName; 3] = [PortName::Usb, PortName::Rs485, PortName::Can];

/// Writes MCAP to a file or elsewhere.
pub struct McapRecorder<W: Write + Seek> {
    writer: mcap::Writer<W>,
    path: PathBuf,
    info: RecordInfo,
    channels: Channels,
    sequence: u32,
    failure: Option<McapError>,
}

impl<W: Write + Seek> McapRecorder<W> {
    /// A recorder that writes to `output`; `path` is its name for messages.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn new(output: W, path: impl Into<PathBuf>, info: &RecordInfo) -> Result<Self, RecordError> {
        let path = path.into();
        let options = mcap::WriteOptions::new().library("pulsetrain").compression(None);
        let made = options.create(output).and_then(|mut writer| {
            let channels = channels(&mut writer, info)?;
            Ok((writer, channels))
        });
        match made {
            Ok((writer, channels)) => {
                Ok(Self { writer, path, info: info.clone(), channels, sequence: 0, failure: None })
            }
            Err(error) => Err(RecordError::Write { path, problem: error.to_string() }),
        }
    }

    fn put(&mut self, at: Ticks, channel_id: u16, message: &Value) {
        if self.failure.is_some() {
            return;
        }
        let time = nanoseconds(at, self.info.clock_hz);
        let header =
            MessageHeader { channel_id, sequence: self.sequence, log_time: time, publish_time: time };
        self.sequence = self.sequence.wrapping_add(1);
        self.failure = self.writer.write_to_known_channel(&header, message.to_string().as_bytes()).err();
    }

    fn put_state(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        let message = json!({
            "position": state.position,
            "encoder": state.encoder,
            "speed": state.speed_mpps as f64 / 1000.0,
            "target": state.target,
            "status": state.status,
            "steps": state.steps,
        });
        self.put(at, self.channels.axes[axis].state, &message);
    }

    fn put_bytes(&mut self, at: Ticks, port: Port, direction: &str, bytes: &[u8]) {
        let place = PORTS.iter().position(|name| *name == port.into());
        let channel = self.channels.ports[place.expect("every port has a channel")];
        self.put(at, channel, &json!({ "direction": direction, "bytes": hex(bytes) }));
    }
}

/// All topics of a device.
fn channels<W: Write + Seek>(writer: &mut mcap::Writer<W>, info: &RecordInfo) -> McapResult<Channels> {
    let mut schema = |name: &str, properties: Value| {
        let schema = json!({ "title": name, "type": "object", "properties": properties });
        writer.add_schema(name, "jsonschema", schema.to_string().as_bytes())
    };
    let whole = json!({ "type": "integer" });
    let state = json!({
        "position": whole, "encoder": whole, "speed": { "type": "number" }, "target": whole, "status": whole,
        "steps": whole
    });
    let state = schema("pulsetrain.Axis", state)?;
    let drive = schema("pulsetrain.Drive", json!({ "current": whole, "step": whole, "parts": whole }))?;
    let marks = [Mark::Started, Mark::TargetReached, Mark::Stopped].map(Mark::name);
    let event = schema("pulsetrain.Event", json!({ "event": { "type": "string", "enum": marks } }))?;
    let pin = schema("pulsetrain.Pin", json!({ "value": { "type": "number" } }))?;
    let text = json!({ "type": "string" });
    let port = schema("pulsetrain.Bytes", json!({ "direction": text, "bytes": text }))?;
    let notes = Note::ALL.map(Note::name);
    let note =
        schema("pulsetrain.Note", json!({ "event": { "type": "string", "enum": notes }, "text": text }))?;

    let device = &info.device;
    let mut channel = |schema, topic: String, unit: &str| {
        let about = if unit.is_empty() { BTreeMap::new() } else { [("unit".into(), unit.into())].into() };
        writer.add_channel(schema, &topic, "json", &about)
    };
    let axes = info.axes.iter().map(|name| {
        Ok(AxisChannels {
            state: channel(state, format!("/{device}/axis/{name}"), "")?,
            drive: channel(drive, format!("/{device}/axis/{name}/drive"), "")?,
            event: channel(event, format!("/{device}/axis/{name}/event"), "")?,
            shown: None,
            same: 0,
            left_out_at: None,
        })
    });
    let axes = axes.collect::<McapResult<_>>()?;
    let pins = info.pins.iter().map(|of| channel(pin, format!("/{device}/pin/{}", of.name), of.unit));
    let pins = pins.collect::<McapResult<_>>()?;
    let ports = PORTS.iter().map(|of| channel(port, format!("/{device}/port/{}", of.name()), ""));
    let ports = ports.collect::<McapResult<_>>()?;
    Ok(Channels { axes, pins, ports, note: channel(note, format!("/{device}/note"), "")? })
}

impl<W: Write + Seek> Recorder for McapRecorder<W> {
    fn sample_every(&self) -> Option<Ticks> {
        Some(Ticks::from(self.info.clock_hz) * SAMPLE_MS / 1000)
    }

    /// Pulses are too many for messages.
    fn train(&mut self, _axis: usize, _train: &Train) {}

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        let Drive { step, parts, current } = drive;
        self.put(
            at,
            self.channels.axes[axis].drive,
            &json!({ "current": current, "step": step, "parts": parts }),
        );
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let value = f64::from(level) / f64::from(self.info.pins[pin].scale);
        self.put(at, self.channels.pins[pin], &json!({ "value": value }));
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.put(at, self.channels.axes[axis].event, &json!({ "event": mark.name() }));
    }

    fn note(&mut self, at: Ticks, note: Note, text: &str) {
        self.put(at, self.channels.note, &json!({ "event": note.name(), "text": text }));
    }

    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        let channels = &mut self.channels.axes[axis];
        channels.same += 1;
        let before = channels.shown.filter(|shown| shown != state);
        if channels.shown.is_some() && before.is_none() && channels.same < IDLE_SAMPLES {
            channels.left_out_at = Some(at);
            return;
        }
        let left_out_at = channels.left_out_at.take();
        (channels.shown, channels.same) = (Some(*state), 0);
        // Between two samples a reader draws a line: what stood still until now did not begin to move long ago.
        if let Some((since, before)) = left_out_at.zip(before) {
            self.put_state(since, axis, &before);
        }
        self.put_state(at, axis, state);
    }

    fn received(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.put_bytes(at, port, "received", bytes);
    }

    fn sent(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.put_bytes(at, port, "sent", bytes);
    }

    fn finish(&mut self, _at: Ticks) -> Result<(), RecordError> {
        // Also after a failure: what came before it can be read.
        let finished = self.writer.finish().map(drop);
        match self.failure.take().map_or(finished, Err) {
            Ok(()) => Ok(()),
            Err(error) => Err(RecordError::Write { path: self.path.clone(), problem: error.to_string() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::testing::stage;
    use std::io::Cursor;

    #[test]
    fn a_reader_finds_topics_times_and_values() {
        let mut file = Cursor::new(Vec::new());
        let mut recorder = McapRecorder::new(&mut file, "a.mcap", &stage()).unwrap();
        recorder.pin(0, 0, 12_500);
        recorder.drive(8, 0, Drive { step: 1, parts: 2, current: 31 });
        recorder.mark(1, 0, Mark::Started);
        let mut state = AxisState { position: 1, encoder: -2, speed_mpps: -1500, ..AxisState::default() };
        for sample in 0..=u64::from(IDLE_SAMPLES) + 1 {
            recorder.sample(sample * 16_000, 0, &state);
        }
        state.position = 2;
        recorder.sample(16_000_000, 0, &state);
        recorder.sent(16_000_000, Port::Can, &[1, 255]);
        recorder.note(16_000_000, Note::Fault, "slip");
        recorder.finish(16_000_000).unwrap();
        drop(recorder);

        let file = file.into_inner();
        let messages = mcap::MessageStream::new(&file).unwrap().map(|message| {
            let message = message.unwrap();
            let schema = message.channel.schema.as_ref().unwrap();
            assert_eq!(
                (schema.encoding.as_str(), message.channel.message_encoding.as_str()),
                ("jsonschema", "json")
            );
            let value: Value = serde_json::from_slice(&message.data).unwrap();
            (message.log_time, message.channel.topic.clone(), value)
        });
        let axis = |position| json!({ "position": position, "encoder": -2, "speed": -1.5, "target": 0, "status": 0, "steps": 0 });
        let expected = [
            (0, "/left stage/pin/motor supply", json!({ "value": 12.5 })),
            (500, "/left stage/axis/X/drive", json!({ "current": 31, "step": 1, "parts": 2 })),
            (62, "/left stage/axis/X/event", json!({ "event": "started" })),
            (0, "/left stage/axis/X", axis(1)),
            (100_000_000, "/left stage/axis/X", axis(1)),
            (101_000_000, "/left stage/axis/X", axis(1)),
            (1_000_000_000, "/left stage/axis/X", axis(2)),
            (1_000_000_000, "/left stage/port/can", json!({ "direction": "sent", "bytes": "01ff" })),
            (1_000_000_000, "/left stage/note", json!({ "event": "fault", "text": "slip" })),
        ];
        let expected = expected.map(|(at, topic, value)| (at, topic.to_owned(), value));
        assert_eq!(messages.collect::<Vec<_>>(), expected);
        let summary = mcap::Summary::read(&file).unwrap().unwrap();
        assert_eq!(summary.stats.unwrap().message_count, 9);
    }
}
