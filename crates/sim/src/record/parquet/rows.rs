//! Rows of all kinds but pulses.

use devices::AxisState;
use parquet::{
    data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type},
    errors::{ParquetError, Result},
    file::writer::{SerializedFileWriter, SerializedRowGroupWriter},
};
use std::io::Write;

/// A row that waits for its group.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub time_ns: i64,
    pub event: &'static str,
    pub axis: Option<&'static str>,
    pub state: Option<AxisState>,
    pub pin: Option<&'static str>,
    pub value: Option<f64>,
    pub unit: Option<&'static str>,
    pub text: Option<String>,
}

impl Row {
    pub fn new(time_ns: i64, event: &'static str) -> Self {
        Self { time_ns, event, axis: None, state: None, pin: None, value: None, unit: None, text: None }
    }
}

/// Writes a group, column by column in the order of the schema.
pub(super) fn write_rows<W: Write + Send>(rows: &[Row], writer: &mut SerializedFileWriter<W>) -> Result<()> {
    let mut group = writer.next_row_group()?;
    let whole = &mut group;
    column::<Int64Type, _>(whole, rows, |row| Some(row.time_ns))?;
    column::<ByteArrayType, _>(whole, rows, |row| Some(row.event.into()))?;
    column::<ByteArrayType, _>(whole, rows, |row| row.axis.map(ByteArray::from))?;
    column::<Int32Type, _>(whole, rows, |row| row.state.map(|state| state.position))?;
    column::<Int32Type, _>(whole, rows, |row| row.state.map(|state| state.encoder))?;
    column::<DoubleType, _>(whole, rows, |row| row.state.map(|state| state.speed_mpps as f64 / 1000.0))?;
    column::<Int32Type, _>(whole, rows, |row| row.state.map(|state| state.target))?;
    column::<Int64Type, _>(whole, rows, |row| row.state.map(|state| state.status.into()))?;
    column::<Int64Type, _>(whole, rows, |row| row.state.map(|state| state.steps as i64))?;
    column::<Int64Type, _>(whole, rows, |_| None)?;
    column::<ByteArrayType, _>(whole, rows, |row| row.pin.map(ByteArray::from))?;
    column::<DoubleType, _>(whole, rows, |row| row.value)?;
    column::<ByteArrayType, _>(whole, rows, |row| row.unit.map(ByteArray::from))?;
    column::<ByteArrayType, _>(whole, rows, |row| row.text.as_deref().map(ByteArray::from))?;
    group.close().map(drop)
}

/// Writes the next column.
fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    rows: &[Row],
    value: impl Fn(&Row) -> Option<T::T>,
) -> Result<()> {
    let mut column = group.next_column()?.ok_or(ParquetError::General("a column too many".into()))?;
    let all: Vec<_> = rows.iter().map(value).collect();
    let levels: Vec<i16> = all.iter().map(|value| value.is_some().into()).collect();
    let values: Vec<_> = all.into_iter().flatten().collect();
    // Without a gap in the schema there are no levels to say where values are missing.
    column.typed::<T>().write_batch(&values, Some(&levels), None)?;
    column.close()
}
