use super::*;
use crate::record::testing::stage;
use ::parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::Field,
};
use bytes::Bytes;
use motion::{Direction, Moment, train::EVERY_SLOT};

/// Time, event, axis and odometer of all rows of a group.
fn pulses(reader: &SerializedFileReader<Bytes>, group: usize) -> Vec<(i64, i64)> {
    let group = reader.get_row_group(group).unwrap();
    let rows = group.get_row_iter(None).unwrap();
    let pulse = |row: ::parquet::record::Row| {
        let field = |name: &str| row.get_column_iter().find(|(other, _)| *other == name).unwrap().1.clone();
        assert_eq!((field("event"), field("axis")), (Field::Str("pulse".into()), Field::Str("X".into())));
        assert_eq!((field("position"), field("text")), (Field::Null, Field::Null));
        match (field("time_ns"), field("odometer")) {
            (Field::Long(time), Field::Long(odometer)) => (time, odometer),
            other => panic!("{other:?}"),
        }
    };
    rows.map(|row| pulse(row.unwrap())).collect()
}

/// Two full groups, of which the second copies its constant columns, and a rest.
#[test]
fn pulses_are_all_there() {
    let (interval, half) = (43, (GROUP_PULSES + 10) as u32);
    let train = Train {
        start: Moment::at(5_000_000_000),
        interval: interval << 32,
        add: 0,
        jerk: 0,
        count: half,
        direction: Direction::Positive,
        mask: EVERY_SLOT,
    };
    let back = Train { start: Moment::at(train.end()), direction: Direction::Negative, ..train };
    let mut file = Vec::new();
    let mut recorder = ParquetRecorder::new(&mut file, "a.parquet", &stage()).unwrap();
    recorder.train(0, &train);
    recorder.train(0, &back);
    recorder.finish(back.end()).unwrap();
    drop(recorder);

    let reader = SerializedFileReader::new(Bytes::from(file)).unwrap();
    let sizes: Vec<_> = reader.metadata().row_groups().iter().map(|group| group.num_rows()).collect();
    assert_eq!(sizes, [GROUP_PULSES as i64, GROUP_PULSES as i64, 20]);
    let found: Vec<_> = (0..3).flat_map(|group| pulses(&reader, group)).collect();
    let all = (train.edges().zip(1..)).chain(back.edges().zip((0..half as i64).rev()));
    let expected: Vec<_> =
        all.map(|(edge, odometer)| (nanoseconds(edge, 16_000_000) as i64, odometer)).collect();
    assert_eq!(found.len(), expected.len());
    assert!(
        found == expected,
        "the first that differs: {:?}",
        found.iter().zip(&expected).find(|(a, b)| a != b)
    );
}

#[test]
fn a_full_disk_is_told_at_the_end() {
    struct Full(usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            let room = self.0.min(bytes.len());
            self.0 -= room;
            if room == 0 { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(room) }
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    let mut recorder = ParquetRecorder::new(Full(1000), "a.parquet", &stage()).unwrap();
    for number in 0..3 * GROUP_ROWS as u64 {
        recorder.sample(number, 0, &AxisState { position: number as i32, ..AxisState::default() });
    }
    let error = recorder.finish(0).unwrap_err().to_string();
    assert!(error.starts_with("a.parquet: ") && !error.contains('\n'), "{error}");
}
