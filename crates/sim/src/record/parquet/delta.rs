//! Whole numbers as differences, many at a time: the encoding `DELTA_BINARY_PACKED` of the format.
//!
//! A block has its least difference in front, and a part of a block as many bits a number as its largest one needs
//! above that.

/// Numbers in a block.
const BLOCK: usize = 256;

/// Numbers in a part of a block.
const PART: usize = 64;

/// Encodes numbers; the differences of two that follow each other wrap.
pub(super) fn encode(numbers: &[i64], out: &mut Vec<u8>) {
    let first = numbers.first().copied().unwrap_or(0);
    unsigned(BLOCK as u64, out);
    unsigned((BLOCK / PART) as u64, out);
    unsigned(numbers.len() as u64, out);
    signed(first, out);
    let pairs = numbers.get(1..).unwrap_or_default().chunks(BLOCK).zip(numbers.chunks(BLOCK));
    for (numbers, before) in pairs {
        let mut differences = [0; BLOCK];
        let count = numbers.len();
        for ((difference, number), before) in differences.iter_mut().zip(numbers).zip(before) {
            *difference = number.wrapping_sub(*before);
        }
        let least = differences[..count].iter().copied().min().unwrap_or(0);
        signed(least, out);
        let widths = out.len();
        out.extend([0; BLOCK / PART]);
        // What the last part has too few of are zeros.
        for (number, part) in differences[..count.next_multiple_of(PART)].chunks_exact(PART).enumerate() {
            let there = count - number * PART;
            let mut above = [0; PART];
            for (above, difference) in above.iter_mut().zip(part).take(there) {
                *above = difference.wrapping_sub(least) as u64;
            }
            let width = u64::BITS - above.iter().fold(0, |any, above| any | above).leading_zeros();
            out[widths + number] = width as u8;
            pack(&above, width, out);
        }
    }
}

/// Writes the low bits of numbers behind one another, the lowest first.
fn pack(numbers: &[u64; PART], width: u32, out: &mut Vec<u8>) {
    if width == 0 {
        return;
    }
    let mut words = [0_u64; PART];
    let (mut word, mut used, mut filled) = (0, 0, 0);
    for number in numbers {
        word |= number << used;
        used += width;
        if used >= u64::BITS {
            words[filled] = word;
            filled += 1;
            used -= u64::BITS;
            // A shift by all bits would be none.
            word = number.checked_shr(width - used).unwrap_or(0);
        }
    }
    // 64 numbers of so many bits are so many whole words.
    words[..width as usize].iter().for_each(|word| out.extend(word.to_le_bytes()));
}

/// Seven bits a byte, the lowest first, with a mark on all but the last.
pub(super) fn unsigned(mut number: u64, out: &mut Vec<u8>) {
    while number >= 0x80 {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

/// The same with the sign in the lowest bit.
fn signed(number: i64, out: &mut Vec<u8>) {
    unsigned(((number << 1) ^ (number >> 63)) as u64, out);
}

#[cfg(test)]
mod tests {
    use crate::record::parquet::chunk::{self, Values};
    use ::parquet::{
        column::reader::{ColumnReader, ColumnReaderImpl},
        data_type::Int64Type,
        file::{
            reader::{FileReader, SerializedFileReader},
            writer::SerializedFileWriter,
        },
        schema::parser::parse_message_type,
    };
    use bytes::Bytes;
    use std::sync::Arc;

    /// The library reads what was written.
    #[track_caller]
    fn check(numbers: &[i64]) {
        let schema = Arc::new(parse_message_type("message table { required int64 number; }").unwrap());
        let mut file = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut file, schema, Arc::default()).unwrap();
        let column = writer.schema_descr().column(0);
        let values = Values::Numbers(numbers, [0, 0]);
        let (bytes, about) = chunk::encode(column, numbers.len(), &values).unwrap();
        let mut group = writer.next_row_group().unwrap();
        group.append_column(&bytes, about).unwrap();
        group.close().unwrap();
        writer.close().unwrap();

        let reader = SerializedFileReader::new(Bytes::from(file)).unwrap();
        let column = reader.get_row_group(0).unwrap().get_column_reader(0).unwrap();
        let ColumnReader::Int64ColumnReader(mut column) = column else { panic!("another type") };
        let read = read(&mut column, numbers.len());
        assert!(read == numbers, "{} numbers", numbers.len());
    }

    fn read(column: &mut ColumnReaderImpl<Int64Type>, count: usize) -> Vec<i64> {
        let mut numbers = Vec::new();
        let (records, ..) = column.read_records(count, None, None, &mut numbers).unwrap();
        assert_eq!(records, count);
        numbers
    }

    #[test]
    fn numbers_of_every_width_come_back() {
        for width in 0..64 {
            let mask = (1_u64 << width) - 1;
            let noise =
                (0..1000_u64).map(|number| (number.wrapping_mul(0x9E37_79B9_7F4A_7C15) & mask) as i64);
            check(&noise.collect::<Vec<_>>());
        }
        check(&[i64::MIN, i64::MAX, 0, -1, i64::MAX, i64::MIN]);
    }

    #[test]
    fn blocks_need_not_be_full() {
        for count in [1, 2, 63, 64, 65, 66, 255, 256, 257, 258, 512, 513, 1025] {
            check(&(0..count).map(|number| 5_000_000 - 2687 * number - number % 3).collect::<Vec<_>>());
        }
    }
}
