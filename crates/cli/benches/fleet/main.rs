//! Fleets: `pulsetrain serve` with many controllers, each with a client that polls it five times a second, a tenth
//! of them in motion all the time; and an echo server with the same number of connections in the same run.
//!
//! `cargo bench -p cli --bench fleet -- [MODEL=COUNT]... [SECONDS]`, by default 2000 of the PD42-1140 for 10 seconds.
//! Everything stays on 127.0.0.1. Late replies are what clients see; processor time and memory are the server's.

mod load;
mod peer;

use load::{Late, Talk};
use peer::Peer;
use std::time::Duration;

/// How many controllers there are unless said otherwise.
const COUNT: usize = 2000;

/// How long clients poll unless said otherwise.
const SPAN: Duration = Duration::from_secs(10);

/// What is asked of the server with the usual count.
const MAX_CORE_PART: f64 = 1.0;
const MAX_P999: Duration = Duration::from_millis(50);
const MAX_CONTROLLER_KIB: f64 = 16.0;

/// What was measured of one server.
struct Row {
    name: String,
    late: Late,
    core_part: f64,
    kib: f64,
}

fn main() {
    let arguments: Vec<_> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if arguments.first().is_some_and(|first| first == peer::ECHO) {
        return peer::echo();
    }
    let (mut fleets, mut span) = (Vec::new(), SPAN);
    for argument in &arguments {
        match argument.split_once('=') {
            Some((model, count)) => fleets.push((model.to_owned(), count.parse().expect("a count"))),
            None => span = Duration::from_secs_f64(argument.parse().expect("MODEL=COUNT or seconds")),
        }
    }
    if fleets.is_empty() {
        fleets.push(("pd42-1140".to_owned(), COUNT));
    }
    peer::raise_file_limit();
    println!("polled 5 times a second for {span:?}, a tenth in motion, one worker");
    println!(
        "{:<17} {:>9} {:>9} {:>9} {:>9} {:>6} {:>10} {:>7} {:>8}",
        "", "p50", "p99", "p99.9", "longest", "missed", "replies/s", "a core", "KiB each"
    );
    let mut wrong = Vec::new();
    for (model, count) in fleets {
        let talk = load::talk(&model);
        let few = Peer::serve(&model, 1).resident_kib();
        let served = measure(&format!("{count} {model}"), Peer::serve(&model, count), talk, span, few);
        let echoed = measure(&format!("{count} echoes"), Peer::echo(count), talk, span, 0.0);
        println!(
            "{:<17} {:>9.2} {:>9.2} {:>9.2} {:>9.2} {:>6} {:>10} {:>7.2}",
            "ratio",
            part(served.late.at(0.5), echoed.late.at(0.5)),
            part(served.late.at(0.99), echoed.late.at(0.99)),
            part(served.late.at(0.999), echoed.late.at(0.999)),
            part(served.late.at(1.0), echoed.late.at(1.0)),
            "",
            "",
            served.core_part / echoed.core_part,
        );
        wrong.extend(judge(&served));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

/// Lets a server be polled and prints its row. `few` is the memory of one with a single device.
fn measure(name: &str, peer: Peer, talk: &'static Talk, span: Duration, few: f64) -> Row {
    let count = peer.addresses.len();
    // Before anybody is connected: connections are the system's and the clients' business.
    let kib = (peer.resident_kib() - few) / count.saturating_sub(1).max(1) as f64;
    let before = peer.processor_seconds();
    let (late, took) = load::poll(&peer.addresses, talk, span);
    let core_part = (peer.processor_seconds() - before) / took.as_secs_f64();
    let row = Row { name: name.to_owned(), late, core_part, kib };
    let late = &row.late;
    println!(
        "{:<17} {:>9.2?} {:>9.2?} {:>9.2?} {:>9.2?} {:>6} {:>10.0} {:>6.1}% {:>8.1}",
        row.name,
        late.at(0.5),
        late.at(0.99),
        late.at(0.999),
        late.at(1.0),
        late.missed,
        late.replies() as f64 / took.as_secs_f64(),
        100.0 * row.core_part,
        row.kib,
    );
    row
}

fn judge(row: &Row) -> Vec<String> {
    let Row { name, late, core_part, kib } = row;
    let mut wrong = Vec::new();
    if late.missed > 0 {
        wrong.push(format!("{name}: {} polls had no reply before the next one", late.missed));
    }
    if late.at(0.999) > MAX_P999 {
        wrong.push(format!("{name}: one reply of a thousand takes {:.1?}", late.at(0.999)));
    }
    if *core_part > MAX_CORE_PART {
        wrong.push(format!("{name}: {:.0} % of a core", 100.0 * core_part));
    }
    if *kib > MAX_CONTROLLER_KIB {
        wrong.push(format!("{name}: a controller takes {kib:.1} KiB"));
    }
    wrong
}

fn part(a: Duration, b: Duration) -> f64 {
    a.as_secs_f64() / b.as_secs_f64()
}
