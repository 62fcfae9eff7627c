//! The columns, and how each is encoded.

use crate::record::RecordInfo;
use parquet::{
    basic::{ConvertedType, Encoding, Repetition, Type as Physical},
    errors::Result,
    file::{
        metadata::KeyValue,
        properties::{EnabledStatistics, WriterProperties},
        writer::SerializedFileWriter,
    },
    schema::types::{ColumnPath, Type, TypePtr},
};
use std::{io::Write, sync::Arc};

/// A column: its name and type, and whether every row has a value.
pub(super) struct Column {
    pub name: &'static str,
    pub physical: Physical,
    pub is_required: bool,
}

const fn required(name: &'static str, physical: Physical) -> Column {
    Column { name, physical, is_required: true }
}

const fn optional(name: &'static str, physical: Physical) -> Column {
    Column { name, physical, is_required: false }
}

/// The columns in their order.
pub(super) const COLUMNS: [Column; 14] = [
    required("time_ns", Physical::INT64),
    required("event", Physical::BYTE_ARRAY),
    optional("axis", Physical::BYTE_ARRAY),
    optional("position", Physical::INT32),
    optional("encoder", Physical::INT32),
    optional("speed", Physical::DOUBLE),
    optional("target", Physical::INT32),
    optional("status", Physical::INT64),
    optional("steps", Physical::INT64),
    optional("odometer", Physical::INT64),
    optional("pin", Physical::BYTE_ARRAY),
    optional("value", Physical::DOUBLE),
    optional("unit", Physical::BYTE_ARRAY),
    optional("text", Physical::BYTE_ARRAY),
];

/// Bytes of a page before it is closed.
const PAGE_BYTES: usize = 1 << 18;

/// What the file says of itself: the name of the device under this key.
pub(super) const DEVICE_KEY: &str = "pulsetrain.device";
/// Clocks a second of the device.
const CLOCK_KEY: &str = "pulsetrain.clock_hz";

/// A file with nothing in it.
pub(super) fn create<W: Write + Send>(output: W, info: &RecordInfo) -> Result<SerializedFileWriter<W>> {
    SerializedFileWriter::new(output, schema()?, Arc::new(properties(info)))
}

fn schema() -> Result<TypePtr> {
    let fields = COLUMNS.iter().map(|column| {
        let repetition = if column.is_required { Repetition::REQUIRED } else { Repetition::OPTIONAL };
        let text = column.physical == Physical::BYTE_ARRAY;
        let converted = if text { ConvertedType::UTF8 } else { ConvertedType::NONE };
        let field = Type::primitive_type_builder(column.name, column.physical);
        Ok(Arc::new(field.with_repetition(repetition).with_converted_type(converted).build()?))
    });
    let fields = fields.collect::<Result<_>>()?;
    Ok(Arc::new(Type::group_type_builder("recording").with_fields(fields).build()?))
}

/// Text repeats itself, whole numbers differ little from the one before.
fn properties(info: &RecordInfo) -> WriterProperties {
    let about = [(DEVICE_KEY, info.device.clone()), (CLOCK_KEY, info.clock_hz.to_string())];
    let about = about.map(|(key, value)| KeyValue::new(key.to_owned(), value));
    let mut properties = WriterProperties::builder()
        .set_created_by("pulsetrain".into())
        .set_key_value_metadata(Some(about.to_vec()))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_data_page_size_limit(PAGE_BYTES)
        .set_data_page_row_count_limit(usize::MAX);
    for column in &COLUMNS {
        let path = ColumnPath::from(column.name);
        let is_text = column.physical == Physical::BYTE_ARRAY;
        properties = properties.set_column_dictionary_enabled(path.clone(), is_text);
        if matches!(column.physical, Physical::INT32 | Physical::INT64) {
            properties = properties.set_column_encoding(path, Encoding::DELTA_BINARY_PACKED);
        }
    }
    properties.build()
}
