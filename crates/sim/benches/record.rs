//! How many pulses a second the recordings take, in trains as a ramp and a cruise have them. The yardsticks: what it
//! takes to expand the trains and to copy 16 bytes a pulse, and CSV with every pulse.
//!
//! `cargo bench -p sim --bench record --features parquet`

use devices::Pin;
use divan::{Bencher, black_box, counter::ItemsCount};
use motion::{Direction, Moment, Train, train::EVERY_SLOT};
use sim::record::{CsvRecorder, Detail, RecordInfo, Recorder, VcdRecorder};
use std::io::sink;

fn main() {
    divan::main();
}

/// Pulses of a measurement.
const PULSES: u32 = 1 << 20;

/// Pulses of a train: of a cruise between two looks at the machine, and of a ramp.
const LENGTHS: [u32; 2] = [4096, 64];

static PINS: &[Pin] = &[];

fn info() -> RecordInfo {
    RecordInfo { device: "stage".into(), clock_hz: 16_000_000, axes: &["X"], pins: PINS }
}

/// 370,000 pulses a second, there and back.
fn trains(length: u32) -> Vec<Train> {
    let mut start = Moment::at(16_000_000);
    let train = |number| {
        let direction = if number % 2 == 0 { Direction::Positive } else { Direction::Negative };
        let train = Train {
            start,
            interval: (43 << 32) + 77_777,
            add: 5000,
            jerk: 0,
            count: length,
            direction,
            mask: EVERY_SLOT,
        };
        start = train.moment(length);
        train
    };
    (0..PULSES / length).map(train).collect()
}

fn record(bencher: Bencher<'_, '_>, length: u32, recorder: impl Fn() -> Box<dyn Recorder>) {
    let trains = trains(length);
    bencher.counter(ItemsCount::new(PULSES)).bench_local(|| {
        let mut recorder = recorder();
        for train in &trains {
            recorder.train(0, black_box(train));
        }
        recorder.finish(0).expect("a sink takes everything");
    });
}

#[divan::bench(args = LENGTHS)]
fn expand_and_copy(bencher: Bencher<'_, '_>, length: u32) {
    let trains = trains(length);
    let (mut pulses, mut copy) = (vec![(0, 0); PULSES as usize], vec![(0, 0); PULSES as usize]);
    bencher.counter(ItemsCount::new(PULSES)).bench_local(|| {
        let edges = trains.iter().flat_map(Train::edges).zip(1_i64..);
        for (pulse, edge) in pulses.iter_mut().zip(edges) {
            *pulse = edge;
        }
        copy.copy_from_slice(black_box(&pulses));
        black_box(copy[0])
    });
}

#[cfg(feature = "parquet")]
#[divan::bench(args = LENGTHS)]
fn parquet(bencher: Bencher<'_, '_>, length: u32) {
    record(bencher, length, || {
        Box::new(sim::record::ParquetRecorder::new(sink(), "-", &info()).expect("a sink takes everything"))
    });
}

#[divan::bench(args = LENGTHS)]
fn csv(bencher: Bencher<'_, '_>, length: u32) {
    record(bencher, length, || Box::new(CsvRecorder::new(sink(), "-", &info(), Detail::Edges)));
}

#[divan::bench(args = LENGTHS)]
fn vcd(bencher: Bencher<'_, '_>, length: u32) {
    record(bencher, length, || Box::new(VcdRecorder::new(sink(), "-", &info())));
}
