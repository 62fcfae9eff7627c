use super::*;
use crate::record::{Mark, Note, RecordInfo, create, testing::stage};
use devices::AxisState;
use motion::{Direction, Moment, Ticks, Train, train::EVERY_SLOT};
use std::fs;

const FORMATS: &[&str] =
    if cfg!(feature = "parquet") { &["csv", "mcap", "parquet", "vcd"] } else { &["csv", "mcap", "vcd"] };

const HZ: Ticks = 16_000_000;

fn file(name: &str, extension: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("pulsetrain-read-{}-{name}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder.join(format!("left stage.{extension}"))
}

fn remove(name: &str) {
    let folder = file(name, "").parent().map(Path::to_owned);
    fs::remove_dir_all(folder.unwrap()).unwrap();
}

/// One axis goes from 0 to 300 in the second half of a second and loses 40 pulses at its end; a supply that dips, a switch, and a fault.
fn record(path: &Path) {
    let info: RecordInfo = stage();
    let mut recorder = create(path, &info).unwrap();
    recorder.pin(0, 0, 24_000);
    recorder.pin(0, 1, 0);
    let every = recorder.sample_every().unwrap();
    assert_eq!(every, HZ / 1000);
    let sample = |recorder: &mut dyn super::super::Recorder, from: Ticks, to: Ticks| {
        for number in from..to {
            let position = number.saturating_sub(500) * 3 / 5;
            let speed_mpps = if (500..1000).contains(&number) { 600_000 } else { 0 };
            let encoder = position.min(260) as i32;
            let state = AxisState { position: position as i32, encoder, speed_mpps, ..AxisState::default() };
            recorder.sample(number * every, 0, &state);
        }
    };
    sample(&mut *recorder, 0, 500);
    recorder.mark(HZ / 2, 0, Mark::Started);
    let (start, interval) = (Moment::at(HZ / 2), (HZ / 600) << 32);
    let train = Train {
        start,
        interval,
        add: 0,
        jerk: 0,
        count: 300,
        direction: Direction::Positive,
        mask: EVERY_SLOT,
    };
    recorder.train(0, &train);
    sample(&mut *recorder, 500, 600);
    recorder.note(HZ * 6 / 10, Note::Fault, "supply dip");
    recorder.pin(HZ * 6 / 10, 0, 12_500);
    sample(&mut *recorder, 600, 800);
    recorder.note(HZ * 8 / 10, Note::Cleared, "supply dip");
    recorder.pin(HZ * 8 / 10, 0, 24_000);
    recorder.pin(HZ * 8 / 10, 1, 1);
    sample(&mut *recorder, 800, 1001);
    recorder.mark(HZ, 0, Mark::TargetReached);
    recorder.finish(HZ).unwrap();
}

#[test]
fn every_format_tells_the_same() {
    for extension in FORMATS {
        let path = file("same", extension);
        record(&path);
        let plot = read(&path).unwrap_or_else(|error| panic!("{error}"));
        let expected = [
            "from 0.000000 to 1.000000",
            "axis X: [0.0, 0.0, 300.0], encoder elsewhere",
            "pin motor_supply: 12.5 to 24, then 24 V",
            "pin +LX: 0 to 1, then 1 ",
            "0.500000 X Started",
            "1.000000 X TargetReached",
            "0.600000 Fault supply dip",
            "0.800000 Cleared supply dip",
        ];
        assert_eq!(plot.summary(), expected, "{extension}");
    }
    remove("same");
}

/// Whatever is cut off or turned around, there is an answer: a plot of what is there, or what is wrong.
#[test]
fn broken_files_are_told_and_never_panic() {
    for extension in FORMATS {
        let path = file("broken", extension);
        record(&path);
        let whole = fs::read(&path).unwrap();
        let broken = file("broken-copy", extension);
        for part in 0..60 {
            let mut bytes = whole.clone();
            let at = whole.len() * part / 60;
            match part % 3 {
                0 => bytes.truncate(at),
                1 => bytes[at] ^= 0x41,
                _ => bytes[at..(at + 40).min(whole.len())].fill(0xFF),
            }
            fs::write(&broken, &bytes).unwrap();
            if let Err(error) = read(&broken) {
                let text = error.to_string();
                assert!(text.contains("left stage.") && !text.contains('\n'), "{text}");
            }
        }
    }
    remove("broken");
    remove("broken-copy");
}

#[track_caller]
fn check_wrong(extension: &str, text: &str, expected: &str) {
    let path = file("wrong", extension);
    fs::write(&path, text).unwrap();
    let Err(error) = read(&path) else { panic!("{text} can be read") };
    let told = error.to_string();
    assert_eq!(told.strip_prefix(&*path.to_string_lossy()), Some(expected));
}

#[test]
fn a_wrong_line_is_named() {
    let head = "seconds,event,axis,position,speed";
    check_wrong("csv", "time,what\n", ":1: the table of a recording has the columns `seconds` and `event`");
    check_wrong(
        "csv",
        &format!("{head}\n0,sample,X,1,0\n-1,sample,X,1,0\n"),
        ":3: `-1` is not a time in seconds",
    );
    check_wrong("csv", &format!("{head}\n0,sample,X,far,0\n"), ":2: `far` is not a number");
    check_wrong("csv", &format!("{head}\n0,sample,X,,0\n"), ":2: `sample` needs a position");
    check_wrong("csv", &format!("{head}\n0,sample,,1,0\n"), ":2: `sample` needs an axis");
    check_wrong("csv", &format!("{head}\n"), ": there is nothing in it");
    check_wrong("vcd", "$enddefinitions $end\n", ": there are no axes and no pins of a recording in it");
    check_wrong("txt", "", &format!(": no recording with this extension can be read, known: {READABLE}"));
    remove("wrong");
}
