//! Random moves, every pulse of which is checked against an oracle that shares nothing with the kernel.
//!
//! 100,000 moves on every run; `PULSETRAIN_MOVES=10000000 cargo test -p motion --test moves` does more.
//! `PULSETRAIN_SEED=n` begins with that move, and plays it alone if no number of moves is given. A failure
//! is printed as the shortest list of calls that still fails.

mod oracle;
mod play;
mod random;
mod scenario;

use play::{Outcome, play};
use scenario::Scenario;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Moves of an ordinary run.
const MOVES: u64 = 100_000;

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.replace('_', "").parse().unwrap_or_else(|_| panic!("{name} is not a number: {text}")))
}

/// Plays a scenario; a panic of the kernel is a failure like others.
fn judge(scenario: &Scenario, calls: Option<&mut Vec<String>>) -> Result<Outcome, String> {
    catch_unwind(AssertUnwindSafe(|| play(scenario, calls)))
        .unwrap_or_else(|cause| Err(cause.downcast_ref::<String>().cloned().unwrap_or("panic".into())))
}

/// The simplest scenario found that still fails, as Rust calls.
fn report(mut scenario: Scenario) -> String {
    let seed = scenario.seed;
    let until = Instant::now() + Duration::from_secs(10);
    'simpler: loop {
        for simpler in scenario.simpler() {
            if Instant::now() > until {
                break 'simpler;
            }
            if judge(&simpler, None).is_err() {
                scenario = simpler;
                continue 'simpler;
            }
        }
        break;
    }
    let mut calls = Vec::new();
    let error = judge(&scenario, Some(&mut calls)).err().unwrap_or_default();
    let from = calls.len().saturating_sub(60);
    format!(
        "seed {seed}: {error}\n{:?}\n{}\n",
        scenario,
        [&calls[..from.min(8)], &calls[from..]].concat().join("\n")
    )
}

#[test]
fn moves_are_exact() {
    let first_seed = number("PULSETRAIN_SEED");
    let moves = number("PULSETRAIN_MOVES").unwrap_or(if first_seed.is_some() { 1 } else { MOVES });
    let first_seed = first_seed.unwrap_or(0);
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let failed = AtomicBool::new(false);
    let run = |first: u64| {
        let (mut all, mut arrived) = (Outcome::default(), 0);
        for seed in (first..moves).step_by(threads as usize).map(|n| first_seed + n) {
            if failed.load(Ordering::Relaxed) {
                break;
            }
            let scenario = Scenario::random(seed);
            match judge(&scenario, None) {
                Ok(outcome) => {
                    all.pulses += outcome.pulses;
                    all.extremes.merge(&outcome.extremes);
                    arrived += u64::from(outcome.arrived);
                }
                Err(_) => {
                    failed.store(true, Ordering::Relaxed);
                    panic!("{}", report(scenario));
                }
            }
        }
        (all, arrived)
    };
    let (mut all, mut arrived) = (Outcome::default(), 0);
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|first| scope.spawn(move || run(first))).collect();
        for worker in workers {
            let (part, there) = worker.join().unwrap_or_else(|cause| std::panic::resume_unwind(cause));
            all.pulses += part.pulses;
            all.extremes.merge(&part.extremes);
            arrived += there;
        }
    });
    println!("{moves} moves, {arrived} to a target, {} pulses; {:?}", all.pulses, all.extremes);
    assert!(moves < 100 || arrived > moves / 2, "most moves end on a target");
}
