//! A row of a table, whatever file it comes from.

use super::{MAX_SECONDS, NS_PER_SECOND, mark, note};
use crate::record::Plot;
use motion::Ticks;

/// A row: the columns that a plot has use for.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::record) struct Row<'a> {
    pub at: Ticks,
    pub event: &'a str,
    pub axis: Option<&'a str>,
    pub position: Option<f64>,
    pub encoder: Option<f64>,
    pub speed: Option<f64>,
    pub pin: Option<&'a str>,
    pub value: Option<f64>,
    pub unit: Option<&'a str>,
    pub text: Option<&'a str>,
}

/// Puts a row into a plot; rows of events that it does not show are passed over.
pub(in crate::record) fn put(plot: &mut Plot, row: &Row<'_>) -> Result<(), String> {
    let missing = |what: &str| format!("`{}` needs a {what}", row.event);
    if row.event == "sample" {
        let axis = axis(plot, row)?;
        let position = row.position.ok_or_else(|| missing("position"))?;
        plot.sample(row.at, axis, position, row.speed.ok_or_else(|| missing("speed"))?);
        row.encoder.into_iter().for_each(|encoder| plot.encoder(row.at, axis, position, encoder));
    } else if row.event == "pin" {
        let name = row.pin.ok_or_else(|| missing("pin"))?;
        let pin = plot.pin(name, row.unit.unwrap_or_default()).ok_or("too many pins")?;
        plot.level(row.at, pin, row.value.ok_or_else(|| missing("value"))?);
    } else if let Some(mark) = mark(row.event) {
        let axis = axis(plot, row)?;
        plot.mark(row.at, axis, mark);
    } else if let Some(note) = note(row.event) {
        plot.note(row.at, note, row.text.unwrap_or_default());
    }
    Ok(())
}

fn axis(plot: &mut Plot, row: &Row<'_>) -> Result<usize, String> {
    let name = row.axis.ok_or_else(|| format!("`{}` needs an axis", row.event))?;
    plot.axis(name).ok_or_else(|| "too many axes".into())
}

/// Seconds in a text as nanoseconds.
pub(super) fn nanoseconds(text: &str) -> Result<Ticks, String> {
    let seconds: Option<f64> = text.parse().ok().filter(|seconds| (0.0..=MAX_SECONDS).contains(seconds));
    let seconds = seconds.ok_or_else(|| format!("`{text}` is not a time in seconds"))?;
    Ok((seconds * f64::from(NS_PER_SECOND)).round() as Ticks)
}

/// A number in a text; `None` if it is empty.
pub(super) fn number(text: &str) -> Result<Option<f64>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.map(Some).ok_or_else(|| format!("`{text}` is not a number"))
}
