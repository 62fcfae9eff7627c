//! Rates with a baseline in the same run: a plain loop that writes timestamps with `interval += add`.
//!
//! Each figure is the median of many short runs, taken in turn with the baseline's.

use motion::Ticks;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Runs of each piece of work.
const ROUNDS: usize = 1001;

/// Edges a run.
pub const EDGES: usize = 1 << 16;

/// The baseline: timestamps at a spacing that changes evenly.
fn plain(edges: &mut [Ticks], mut interval: u64, add: u64) {
    let mut at = 0u64;
    for edge in edges {
        at = at.wrapping_add(interval);
        interval = interval.wrapping_add(add);
        *edge = at;
    }
}

fn time(work: &mut dyn FnMut() -> usize) -> f64 {
    let begin = Instant::now();
    let done = black_box(work());
    let spent = begin.elapsed().max(Duration::from_nanos(1));
    done as f64 / spent.as_secs_f64() / 1e6
}

fn median(rates: &mut [f64]) -> f64 {
    rates.sort_by(f64::total_cmp);
    rates[rates.len() / 2]
}

/// Millions a second of the work and of the baseline, run in turn.
pub fn compare(name: &str, goal: Option<f64>, work: &mut dyn FnMut() -> usize) {
    if std::env::args().skip(1).any(|filter| !filter.starts_with('-') && !name.contains(&filter)) {
        return;
    }
    let mut edges = vec![0; EDGES];
    let mut baseline = || {
        plain(black_box(&mut edges), black_box(300 << 32), black_box(1 << 20));
        EDGES
    };
    let (mut rates, mut bases) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        rates.push(time(work));
        bases.push(time(&mut baseline));
    }
    let (rate, base) = (median(&mut rates), median(&mut bases));
    let goal = goal.map_or(String::new(), |goal| format!(", goal {goal}"));
    println!("{name:<44} {rate:8.1} M/s, {:6.3} of the baseline's {base:.0} M edges/s{goal}", rate / base);
}
