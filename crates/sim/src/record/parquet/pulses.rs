//! Groups of pulses of one axis.

use super::{
    GROUP_PULSES,
    chunk::{self, Values},
    schema::COLUMNS,
};
use crate::record::nanoseconds;
use motion::{Direction, Ticks, train::Edges};
use parquet::{errors::Result, file::writer::SerializedFileWriter};
use std::io::Write;

const NS_PER_SECOND: u64 = 1_000_000_000;

/// The pulses of an axis that wait for their group to be full.
#[derive(Default)]
pub(super) struct Pulses {
    axis: &'static str,
    clock: Clock,
    /// Pulses until now: up less down.
    odometer: i64,
    times: Vec<i64>,
    odometers: Vec<i64>,
}

impl Pulses {
    pub fn new(axis: &'static str, clock_hz: u32) -> Self {
        Self { axis, clock: Clock::new(clock_hz), ..Self::default() }
    }

    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    pub fn is_full(&self) -> bool {
        self.times.len() == GROUP_PULSES
    }

    /// Takes as many edges as there is room for.
    pub fn add(&mut self, edges: &mut Edges, direction: Direction) {
        let (from, sign) = (self.times.len(), direction.sign());
        let count = edges.len().min(GROUP_PULSES - from);
        self.times.resize(from + count, 0);
        for (time, edge) in self.times[from..].iter_mut().zip(edges) {
            *time = edge as i64;
        }
        self.clock.to_nanoseconds(&mut self.times[from..]);
        let before = self.odometer;
        self.odometers.extend((1..=count as i64).map(|number| before + number * sign));
        self.odometer += count as i64 * sign;
    }

    /// Writes them as a group, and forgets them.
    pub fn write<W: Write + Send>(&mut self, writer: &mut SerializedFileWriter<W>) -> Result<()> {
        let descriptions: Vec<_> = writer.schema_descr().columns().to_vec();
        let mut group = writer.next_row_group()?;
        for (column, description) in COLUMNS.iter().zip(descriptions) {
            let values = match column.name {
                "time_ns" => numbers(&self.times),
                "odometer" => numbers(&self.odometers),
                "event" => Values::Text("pulse"),
                "axis" => Values::Text(self.axis),
                _ => Values::None,
            };
            let (bytes, about) = chunk::encode(description, self.times.len(), &values)?;
            group.append_column(&bytes, about)?;
        }
        group.close()?;
        self.times.clear();
        self.odometers.clear();
        Ok(())
    }
}

fn numbers(numbers: &[i64]) -> Values<'_> {
    let ends = numbers
        .iter()
        .fold([i64::MAX, i64::MIN], |[least, most], number| [least.min(*number), most.max(*number)]);
    Values::Numbers(numbers, ends)
}

/// From clocks to nanoseconds, rounded down, without a division each.
#[derive(Default)]
struct Clock {
    hz: u32,
    /// A clock is so many nanoseconds by so many.
    nanoseconds: u64,
    clocks: u64,
    /// 2⁶⁴ by `clocks`, rounded up. To multiply with it instead of dividing is exact for less than `exact`.
    inverse: u64,
    exact: u64,
}

impl Clock {
    fn new(hz: u32) -> Self {
        let (mut divisor, mut rest) = (NS_PER_SECOND, u64::from(hz));
        while rest > 0 {
            (divisor, rest) = (rest, divisor % rest);
        }
        let (nanoseconds, clocks) = (NS_PER_SECOND / divisor, u64::from(hz) / divisor);
        // The error of the inverse is less than one; by this the product stays below the next whole number.
        Self {
            hz,
            nanoseconds,
            clocks,
            inverse: (u64::MAX / clocks).wrapping_add(1),
            exact: u64::MAX / clocks,
        }
    }

    /// Clocks that do not fall become nanoseconds.
    fn to_nanoseconds(&self, times: &mut [i64]) {
        let (Some(first), Some(last)) = (times.first(), times.last()) else { return };
        // Counted from a whole second, so that the rest of the sum is small.
        let second = *first as Ticks / Ticks::from(self.hz);
        let (begin, begin_ns) = (second * Ticks::from(self.hz), second * NS_PER_SECOND);
        let is_short =
            (*last as Ticks - begin).checked_mul(self.nanoseconds).is_some_and(|all| all < self.exact);
        // With whole nanoseconds a clock there is nothing to divide, and no inverse.
        if is_short && self.clocks > 1 {
            for time in times {
                let product =
                    u128::from((*time as Ticks - begin) * self.nanoseconds) * u128::from(self.inverse);
                *time = (begin_ns + (product >> u64::BITS) as u64) as i64;
            }
        } else {
            for time in times {
                *time = nanoseconds(*time as Ticks, self.hz) as i64;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nanoseconds_are_those_of_a_division() {
        let day = 86_400;
        for hz in [1, 1000, 1_000_000_000, 16_000_000, 19_660_800, 19_660_801, u32::MAX] {
            let clock = Clock::new(hz);
            let spans =
                [vec![0, 1, 2], vec![u64::from(hz) - 1, u64::from(hz)], vec![5, 5 + 40 * u64::from(hz)]];
            let long = (0..1000).map(|number| day * u64::from(hz) + number * 7919 + number % 5).collect();
            for clocks in spans.into_iter().chain([long]) {
                let mut times: Vec<_> = clocks.iter().map(|clock| *clock as i64).collect();
                clock.to_nanoseconds(&mut times);
                let expected: Vec<_> = clocks.iter().map(|at| nanoseconds(*at, hz) as i64).collect();
                assert_eq!(times, expected, "{hz} Hz");
            }
        }
    }
}
