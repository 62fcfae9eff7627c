//! Columns of a group as whole pages, for those that are known as a whole: what is the same in all rows is written
//! once.

use super::delta;
use bytes::Bytes;
use parquet::{
    basic::{Encoding, EncodingMask},
    column::{
        page::{CompressedPage, Page, PageWriter as _},
        writer::ColumnCloseResult,
    },
    data_type::ByteArray,
    errors::Result,
    file::{
        metadata::ColumnChunkMetaData,
        statistics::Statistics,
        writer::{SerializedPageWriter, TrackedWrite},
    },
    schema::types::ColumnDescPtr,
};

/// What a column has in the rows of a group.
pub(super) enum Values<'a> {
    /// Nothing in any row.
    None,
    /// The same text in each.
    Text(&'a str),
    /// A number in each; the least and the largest are these.
    Numbers(&'a [i64], [i64; 2]),
}

/// Encodes a column of so many rows.
pub(super) fn encode(
    column: ColumnDescPtr,
    rows: usize,
    values: &Values<'_>,
) -> Result<(Bytes, ColumnCloseResult)> {
    let mut data = Vec::new();
    // A column that may have gaps says where there are none.
    if column.max_def_level() > 0 {
        let mut levels = Vec::new();
        run(rows, u8::from(!matches!(values, Values::None)), &mut levels);
        data.extend((levels.len() as u32).to_le_bytes());
        data.extend(levels);
    }
    let (mut dictionary, mut nulls) = (None, 0);
    let (encoding, statistics) = match *values {
        Values::None => {
            nulls = rows as u64;
            (Encoding::PLAIN, None)
        }
        Values::Text(text) => {
            let length = (text.len() as u32).to_le_bytes();
            dictionary = Some([&length, text.as_bytes()].concat());
            // Numbers in the dictionary, of so many bits each: all are 0.
            data.push(1);
            run(rows, 0, &mut data);
            let ends = || Some(ByteArray::from(text));
            (Encoding::RLE_DICTIONARY, Some(Statistics::byte_array(ends(), ends(), None, Some(0), false)))
        }
        Values::Numbers(numbers, [least, most]) => {
            delta::encode(numbers, &mut data);
            let statistics = Statistics::int64(Some(least), Some(most), None, Some(0), false);
            (Encoding::DELTA_BINARY_PACKED, Some(statistics))
        }
    };
    let statistics = statistics.unwrap_or_else(|| nothing(&column, nulls));

    let mut bytes = TrackedWrite::new(Vec::new());
    let mut pages = SerializedPageWriter::new(&mut bytes);
    let mut put = |page: Page| {
        let size = page.buffer().len();
        pages.write_page(CompressedPage::new(page, size))
    };
    let mut written = Vec::new();
    if let Some(dictionary) = dictionary {
        let (buf, encoding) = (dictionary.into(), Encoding::PLAIN);
        written.push(put(Page::DictionaryPage { buf, num_values: 1, encoding, is_sorted: false })?);
    }
    written.push(put(Page::DataPage {
        buf: data.into(),
        num_values: rows as u32,
        encoding,
        def_level_encoding: Encoding::RLE,
        rep_level_encoding: Encoding::RLE,
        statistics: None,
    })?);
    let uncompressed: usize = written.iter().map(|page| page.uncompressed_size).sum();
    let compressed: usize = written.iter().map(|page| page.compressed_size).sum();
    let data_at = written.last().map_or(0, |page| page.offset);
    let encodings = [encoding, Encoding::RLE, Encoding::PLAIN];
    let used = if written.len() > 1 { &encodings[..] } else { &encodings[..2] };
    let metadata = ColumnChunkMetaData::builder(column)
        .set_encodings_mask(EncodingMask::new_from_encodings(used.iter()))
        .set_total_compressed_size(compressed as i64)
        .set_total_uncompressed_size(uncompressed as i64)
        .set_num_values(rows as i64)
        .set_data_page_offset(data_at as i64)
        .set_dictionary_page_offset((written.len() > 1).then_some(0))
        .set_statistics(statistics)
        .build()?;
    let about = ColumnCloseResult {
        bytes_written: compressed as u64,
        rows_written: rows as u64,
        metadata,
        bloom_filter: None,
        column_index: None,
        offset_index: None,
    };
    Ok((bytes.into_inner()?.into(), about))
}

/// A number of one bit, so many times.
fn run(times: usize, number: u8, out: &mut Vec<u8>) {
    delta::unsigned((times as u64) << 1, out);
    out.push(number);
}

/// Of a column without values.
fn nothing(column: &ColumnDescPtr, nulls: u64) -> Statistics {
    use parquet::basic::Type;
    let nulls = Some(nulls);
    match column.physical_type() {
        Type::INT32 => Statistics::int32(None, None, None, nulls, false),
        Type::INT64 => Statistics::int64(None, None, None, nulls, false),
        Type::DOUBLE => Statistics::double(None, None, None, nulls, false),
        _ => Statistics::byte_array(None, None, None, nulls, false),
    }
}
