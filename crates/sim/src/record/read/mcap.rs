//! Messages, read from the front without the index at the end, so that a recording that was cut off is drawn
//! as far as it goes.

use super::{MAX_SECONDS, NS_PER_SECOND, Problem, mark, note};
use crate::record::Plot;
use mcap::{
    records::Record,
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};
use serde::Deserialize;
use std::{collections::BTreeMap, io::BufRead};

/// The longest record: a chunk with its messages.
const MAX_RECORD_BYTES: usize = 64 << 20;

/// What the messages of a topic are.
#[derive(Clone, Debug)]
enum Topic {
    Axis(String),
    Event(String),
    Pin { name: String, unit: String },
    Note,
}

/// The fields of all our messages; each has some of them.
#[derive(Deserialize)]
struct Message<'a> {
    position: Option<f64>,
    encoder: Option<f64>,
    speed: Option<f64>,
    value: Option<f64>,
    #[serde(borrow)]
    event: Option<std::borrow::Cow<'a, str>>,
    #[serde(borrow)]
    text: Option<std::borrow::Cow<'a, str>>,
}

pub(super) fn read(input: &mut impl BufRead, title: &str) -> Result<Plot, Problem> {
    let options = LinearReaderOptions::default().with_record_length_limit(MAX_RECORD_BYTES);
    let mut reader = LinearReader::new_with_options(options);
    let mut topics = BTreeMap::new();
    let mut title = title.to_owned();
    let mut plot: Option<Plot> = None;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(bytes) => {
                let read = input.read(reader.insert(bytes))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { opcode, data } => match mcap::parse_record(opcode, data)? {
                Record::Channel(channel) => {
                    if let Some((device, topic)) = topic(&channel.topic, &channel.metadata) {
                        title = device;
                        topics.insert(channel.id, topic);
                    }
                }
                Record::Message { header, data } => {
                    let Some(topic) = topics.get(&header.channel_id) else { continue };
                    if header.log_time as f64 > MAX_SECONDS * f64::from(NS_PER_SECOND) {
                        return Err(format!("a message at {} ns", header.log_time).into());
                    }
                    let at = header.log_time;
                    let plot = plot.get_or_insert_with(|| Plot::new(&title, NS_PER_SECOND, at));
                    put(plot, at, topic, &serde_json::from_slice(&data)?)?;
                }
                _ => {}
            },
        }
    }
    plot.ok_or_else(|| "there are no messages of a recording in it".into())
}

/// The device and the meaning of a topic; `None` if a plot has no use for it.
fn topic(name: &str, about: &BTreeMap<String, String>) -> Option<(String, Topic)> {
    let mut parts = name.strip_prefix('/')?.splitn(3, '/');
    let device = parts.next()?.to_owned();
    let topic = match (parts.next()?, parts.next()) {
        ("axis", Some(rest)) => match rest.split_once('/') {
            None => Topic::Axis(rest.into()),
            Some((axis, "event")) => Topic::Event(axis.into()),
            Some(_) => return None,
        },
        ("pin", Some(name)) => {
            Topic::Pin { name: name.into(), unit: about.get("unit").cloned().unwrap_or_default() }
        }
        ("note", None) => Topic::Note,
        _ => return None,
    };
    Some((device, topic))
}

fn put(plot: &mut Plot, at: u64, topic: &Topic, message: &Message<'_>) -> Result<(), String> {
    let missing = |what: &str| format!("a message without {what}");
    match topic {
        Topic::Axis(name) => {
            let axis = plot.axis(name).ok_or("too many axes")?;
            let position = message.position.ok_or_else(|| missing("position"))?;
            plot.sample(at, axis, position, message.speed.ok_or_else(|| missing("speed"))?);
            message.encoder.into_iter().for_each(|encoder| plot.encoder(at, axis, position, encoder));
        }
        Topic::Event(name) => {
            let axis = plot.axis(name).ok_or("too many axes")?;
            if let Some(mark) = message.event.as_deref().and_then(mark) {
                plot.mark(at, axis, mark);
            }
        }
        Topic::Pin { name, unit } => {
            let pin = plot.pin(name, unit).ok_or("too many pins")?;
            plot.level(at, pin, message.value.ok_or_else(|| missing("value"))?);
        }
        Topic::Note => {
            if let Some(note) = message.event.as_deref().and_then(note) {
                plot.note(at, note, message.text.as_deref().unwrap_or_default());
            }
        }
    }
    Ok(())
}
