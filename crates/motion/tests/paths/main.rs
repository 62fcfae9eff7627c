//! Random lines and arcs, every point of which is held against the path in exact arithmetic.
//!
//! 20,000 of each on every run; `PULSETRAIN_PATHS=1000000 cargo test -p motion --test paths` does more, and
//! `PULSETRAIN_SEED=n` begins with that one, and plays it alone if no number of paths is given.

mod arcs;
mod lines;
#[path = "../moves/random.rs"]
mod random;

use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Limits};
use random::Random;

/// Paths of each kind in an ordinary run.
const PATHS: u64 = 20_000;

const AXES: usize = 4;

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.replace('_', "").parse().unwrap_or_else(|_| panic!("{name} is not a number: {text}")))
}

/// Plays with seeds of a row, on all processors.
fn play_all(play: fn(u64)) {
    let first = number("PULSETRAIN_SEED");
    let paths = number("PULSETRAIN_PATHS").unwrap_or(if first.is_some() { 1 } else { PATHS });
    let seeds = first.unwrap_or(0)..first.unwrap_or(0) + paths;
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let seeds = seeds.clone().skip(thread).step_by(threads);
            scope.spawn(move || {
                for seed in seeds {
                    if let Err(cause) = std::panic::catch_unwind(|| play(seed)) {
                        eprintln!("seed {seed}");
                        std::panic::resume_unwind(cause);
                    }
                }
            });
        }
    });
}

fn limits(random: &mut Random) -> Limits {
    let high_pps = random.spread(6_000_000);
    let profile = Profile {
        low_pps: random.spread(high_pps),
        high_pps,
        acceleration_ms: random.spread(500),
        deceleration_ms: random.spread(500),
        s_curve: random.chance(40),
    };
    profile.limits(pps::scale(6_000_000, CLOCK_HZ), CLOCK_HZ)
}

/// Windows of the axes, as far away as the dice say.
fn set_windows(axes: &mut [Axis; AXES], random: &mut Random) -> [[i64; 2]; AXES] {
    axes.each_mut().map(|axis| {
        let [below, above] = [(); 2].map(|()| i64::from(random.spread(300)));
        let [low, high] = [axis.odometer() - below, axis.odometer() + above];
        axis.set_window(low, high);
        [low, high]
    })
}
