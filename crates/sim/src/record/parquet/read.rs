//! A table read back, as far as a plot needs it: groups of pulses are passed over, since it draws samples.

use super::schema::DEVICE_KEY;
use crate::record::{
    Plot,
    read::{MAX_SECONDS, NS_PER_SECOND, Problem, Row, put},
};
use motion::Ticks;
use parquet::{
    file::{
        reader::{FileReader, SerializedFileReader},
        statistics::Statistics,
    },
    record::{Field, Row as Record},
};
use std::fs::File;

/// Reads a file; `title` is its name if it does not say one.
pub(in crate::record) fn read(file: File, title: &str) -> Result<Plot, Problem> {
    let reader = SerializedFileReader::new(file)?;
    let about = reader.metadata().file_metadata();
    let named = about.key_value_metadata().into_iter().flatten().find(|pair| pair.key == DEVICE_KEY);
    let title = named.and_then(|pair| pair.value.as_deref()).unwrap_or(title);
    let wanted: Vec<_> = (0..reader.num_row_groups()).filter(|group| !is_pulses(&reader, *group)).collect();
    // Groups do not stand in order of time; the least of all is the beginning.
    let begin = wanted.iter().filter_map(|group| first_time(&reader, *group)).min().unwrap_or(0);
    let mut plot = Plot::new(title, NS_PER_SECOND, time(begin)?);
    for group in wanted {
        for record in reader.get_row_group(group)?.get_row_iter(None)? {
            let record = record?;
            put(&mut plot, &row(&record)?)?;
        }
    }
    Ok(plot)
}

/// Whether all rows of a group are pulses.
fn is_pulses(reader: &SerializedFileReader<File>, group: usize) -> bool {
    match statistics(reader, group, "event") {
        Some(Statistics::ByteArray(events)) => {
            let all = [events.min_bytes_opt(), events.max_bytes_opt()];
            all == [Some("pulse".as_bytes()); 2]
        }
        _ => false,
    }
}

fn first_time(reader: &SerializedFileReader<File>, group: usize) -> Option<i64> {
    match statistics(reader, group, "time_ns")? {
        Statistics::Int64(times) => times.min_opt().copied(),
        _ => None,
    }
}

fn statistics<'a>(
    reader: &'a SerializedFileReader<File>,
    group: usize,
    name: &str,
) -> Option<&'a Statistics> {
    let columns = reader.metadata().row_group(group).columns();
    columns.iter().find(|column| column.column_path().string() == name)?.statistics()
}

fn time(time_ns: i64) -> Result<Ticks, String> {
    let limit = MAX_SECONDS * f64::from(NS_PER_SECOND);
    let time = Ticks::try_from(time_ns).ok().filter(|time| *time as f64 <= limit);
    time.ok_or_else(|| format!("{time_ns} is not a time in nanoseconds"))
}

fn row(record: &Record) -> Result<Row<'_>, String> {
    let mut row = Row::default();
    for (name, field) in record.get_column_iter() {
        let text = match field {
            Field::Str(text) => Some(text.as_str()),
            _ => None,
        };
        let number = match field {
            Field::Int(number) => Some(f64::from(*number)),
            Field::Double(number) => Some(*number).filter(|number| number.is_finite()),
            _ => None,
        };
        match (name.as_str(), field) {
            ("time_ns", Field::Long(time_ns)) => row.at = time(*time_ns)?,
            ("event", _) => row.event = text.unwrap_or_default(),
            ("axis", _) => row.axis = text,
            ("position", _) => row.position = number,
            ("encoder", _) => row.encoder = number,
            ("speed", _) => row.speed = number,
            ("pin", _) => row.pin = text,
            ("value", _) => row.value = number,
            ("unit", _) => row.unit = text,
            ("text", _) => row.text = text,
            _ => {}
        }
    }
    Ok(row)
}
