//! Groups of pulses of one axis.

use super::{GROUP_PULSES, schema::COLUMNS};
use bytes::Bytes;
use motion::{Direction, Ticks, train::Edges};
use parquet::{
    basic::Type as Physical,
    column::writer::{ColumnCloseResult, ColumnWriter, get_column_writer},
    data_type::{ByteArray, Int64Type},
    errors::{ParquetError, Result},
    file::writer::{SerializedFileWriter, SerializedPageWriter, SerializedRowGroupWriter, TrackedWrite},
};
use std::io::Write;

const NS_PER_SECOND: u64 = 1_000_000_000;

/// The pulses of an axis that wait for their group to be full.
#[derive(Default)]
pub(super) struct Pulses {
    axis: &'static str,
    clock_hz: u64,
    /// Pulses until now: up less down.
    odometer: i64,
    times: Vec<i64>,
    odometers: Vec<i64>,
    /// The columns of a full group that are the same in each.
    constant: Vec<(Bytes, ColumnCloseResult)>,
}

impl Pulses {
    pub fn new(axis: &'static str, clock_hz: u32) -> Self {
        Self { axis, clock_hz: clock_hz.into(), ..Self::default() }
    }

    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    pub fn is_full(&self) -> bool {
        self.times.len() == GROUP_PULSES
    }

    /// Takes as many edges as there is room for.
    pub fn add(&mut self, edges: &mut Edges, direction: Direction) {
        let (room, sign) = (GROUP_PULSES - self.times.len(), direction.sign());
        let count = edges.len().min(room);
        // A second of the clock for the whole run of them, so that the rest of the sum is small.
        let Some(first) = edges.clone().next() else { return };
        let second = first / self.clock_hz;
        let (begin, begin_ns) = (second * self.clock_hz, second * NS_PER_SECOND);
        let clock_hz = self.clock_hz;
        let time = |edge: Ticks| (begin_ns + (edge - begin) * NS_PER_SECOND / clock_hz) as i64;
        self.times.extend(edges.take(count).map(time));
        let from = self.odometer;
        self.odometers.extend((1..=count as i64).map(|number| from + number * sign));
        self.odometer += count as i64 * sign;
    }

    /// Writes them as a group, and forgets them.
    pub fn write<W: Write + Send>(&mut self, writer: &mut SerializedFileWriter<W>) -> Result<()> {
        let rows = self.times.len();
        if rows != GROUP_PULSES || self.constant.is_empty() {
            self.constant = self.constants(writer, rows)?;
        }
        let mut group = writer.next_row_group()?;
        let levels = vec![1; rows];
        let mut constant = self.constant.iter();
        for column in &COLUMNS {
            match column.name {
                "time_ns" => whole_numbers(&mut group, &self.times, &levels)?,
                "odometer" => whole_numbers(&mut group, &self.odometers, &levels)?,
                _ => {
                    let (bytes, about) = constant.next().ok_or_else(missing)?;
                    group.append_column(bytes, about.clone())?;
                }
            }
        }
        group.close()?;
        self.times.clear();
        self.odometers.clear();
        Ok(())
    }

    /// Encodes the columns that are the same in all rows.
    fn constants<W: Write + Send>(
        &self,
        writer: &SerializedFileWriter<W>,
        rows: usize,
    ) -> Result<Vec<(Bytes, ColumnCloseResult)>> {
        let varies = |name: &str| matches!(name, "time_ns" | "odometer");
        let columns = COLUMNS.iter().enumerate().filter(|(_, column)| !varies(column.name));
        columns
            .map(|(number, column)| {
                let mut bytes = TrackedWrite::new(Vec::new());
                let pages = Box::new(SerializedPageWriter::new(&mut bytes));
                let description = writer.schema_descr().column(number);
                let encoder = get_column_writer(description, writer.properties().clone(), pages);
                let value = match column.name {
                    "event" => Some("pulse"),
                    "axis" => Some(self.axis),
                    _ => None,
                };
                let about = constant(encoder, value, column.physical, rows)?;
                Ok((Bytes::from(bytes.into_inner()?), about))
            })
            .collect()
    }
}

/// A column that has the same text in all rows, or nothing.
fn constant(
    encoder: ColumnWriter<'_>,
    value: Option<&str>,
    physical: Physical,
    rows: usize,
) -> Result<ColumnCloseResult> {
    let values = vec![ByteArray::from(value.unwrap_or_default()); if value.is_some() { rows } else { 0 }];
    let levels = Some(vec![i16::from(value.is_some()); rows]);
    let levels = levels.as_deref();
    match encoder {
        ColumnWriter::ByteArrayColumnWriter(mut encoder) => {
            encoder.write_batch(&values, levels, None)?;
            encoder.close()
        }
        ColumnWriter::Int32ColumnWriter(mut encoder) => {
            encoder.write_batch(&[], levels, None)?;
            encoder.close()
        }
        ColumnWriter::Int64ColumnWriter(mut encoder) => {
            encoder.write_batch(&[], levels, None)?;
            encoder.close()
        }
        ColumnWriter::DoubleColumnWriter(mut encoder) => {
            encoder.write_batch(&[], levels, None)?;
            encoder.close()
        }
        _ => Err(ParquetError::General(format!("no column has the type {physical}"))),
    }
}

fn whole_numbers<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[i64],
    levels: &[i16],
) -> Result<()> {
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<Int64Type>().write_batch(values, Some(levels), None)?;
    column.close()
}

fn missing() -> ParquetError {
    ParquetError::General("the schema has other columns".into())
}
