//! Lines, arcs and helices of any size, disturbed on their way, never leave their path or a window.
#![no_main]

use libfuzzer_sys::fuzz_target;
use motion::path::{Arc, End, Turn};
use motion::{Axis, Limits, Move, Path, Scale, Shape};

const AXES: usize = 4;

/// Clocks from one look to the next: a path may have half as many slots.
const MOST_CLOCKS: u64 = 1 << 14;

/// How often a path is looked at before it must stand still.
const MOST_LOOKS: usize = 1000;

/// Numbers out of the input; 0 where it ends.
struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    fn next<const LENGTH: usize>(&mut self) -> [u8; LENGTH] {
        let mut number = [0; LENGTH];
        let length = LENGTH.min(self.0.len());
        number[..length].copy_from_slice(&self.0[..length]);
        self.0 = &self.0[length..];
        number
    }

    fn byte(&mut self) -> u8 {
        let [byte] = self.next();
        byte
    }

    /// Of any size.
    fn number(&mut self) -> i32 {
        let size = self.byte() % 32;
        i32::from_le_bytes(self.next()) >> size
    }

    fn limits(&mut self) -> Limits {
        let bits = 31 + u32::from(self.byte()) % 10;
        let scale = Scale::new(bits);
        let [top, start, stop] = [(); 3].map(|()| self.number().unsigned_abs());
        let top = top | 1 << (bits - 12);
        let [growth, fall] = [(); 2].map(|()| u64::from_le_bytes(self.next()) >> (self.byte() % 64));
        let shape = match self.byte() % 3 {
            0 => Shape::Trapezoid,
            1 => Shape::Soft,
            _ => Shape::SCurve { bend: self.number().unsigned_abs() },
        };
        Limits { scale, top, start, stop, growth, fall, shape }
    }

    /// The move and, if it is an arc, where its centre is.
    fn path(&mut self) -> Option<(Move<AXES>, Option<([usize; 2], [i64; 2])>)> {
        if self.byte() % 2 == 0 {
            return Some((Move::Line([(); AXES].map(|()| self.number())), None));
        }
        let [first, second, third] = [(); 3].map(|()| usize::from(self.byte()) % AXES);
        let centre = [(); 2].map(|()| self.number());
        let turn = if self.byte() % 2 == 0 { Turn::Clockwise } else { Turn::CounterClockwise };
        let end = if self.byte() % 2 == 0 { End::Circle } else { End::Angle(self.number()) };
        let along = (self.byte() % 2 == 0).then(|| (third, self.number()));
        let arc = Arc::new([first, second], centre, turn, end, along).ok()?;
        Some((Move::Arc(arc), Some(([first, second], centre.map(i64::from)))))
    }
}

/// Whether axes that have come so far are within half a pulse of the path.
fn is_near(at: [i64; AXES], moves: &Move<AXES>, circle: Option<([usize; 2], [i64; 2])>) -> bool {
    if let Some((axes, centre)) = circle {
        let square = |[x, y]: [i64; 2]| i128::from(x).pow(2) + i128::from(y).pow(2);
        let (n, r) = (square([0, 1].map(|axis| at[axes[axis]] - centre[axis])), square(centre));
        let sum = 4 * (n + r) - 1;
        return sum <= 0 || sum * sum <= 64 * n * r;
    }
    let way = moves.way().map(i128::from);
    let longest = way.into_iter().max_by_key(|way| way.abs()).unwrap_or(0);
    let along = at.iter().zip(way).find(|(_, way)| *way == longest).map_or(0, |(at, _)| i128::from(*at));
    at.iter().zip(way).all(|(at, way)| 2 * (i128::from(*at) * longest - along * way).abs() <= longest.abs())
}

fuzz_target!(|bytes: &[u8]| {
    let mut numbers = Numbers(bytes);
    let limits = numbers.limits();
    let Some((moves, circle)) = numbers.path() else { return };
    let mut axes = [(); AXES].map(|()| Axis::new(limits));
    let mut path = Path::new(limits, &moves, 0, &mut axes);
    let (mut now, mut stopped) = (0, false);
    for look in 0.. {
        let windows = axes.each_mut().map(|axis| {
            let [below, above] = [(); 2].map(|()| i64::from(numbers.number().unsigned_abs()) + 1);
            let window = [axis.odometer() - below, axis.odometer() + above];
            axis.set_window(window[0], window[1]);
            window
        });
        let Some(wake) = path.wake(&axes) else { break };
        assert!(wake > now);
        now += 1 + (wake - now - 1).min(MOST_CLOCKS) * u64::from(numbers.byte()) / 255;
        path.advance(now, &mut axes, |_, train| assert!(train.end() <= now));
        let at = axes.each_ref().map(Axis::odometer);
        assert!(at.iter().zip(windows).all(|(at, [low, high])| (low..=high).contains(at)));
        assert!(is_near(at, &moves, circle), "{at:?} is off the path");
        for axis in 0..AXES {
            assert!(path.involves(axis) || at[axis] == 0);
            assert_eq!(path.direction(axis).is_some(), path.involves(axis));
            path.speed(axis);
        }
        match numbers.byte() {
            _ if look > MOST_LOOKS => path.halt(),
            0 => path.set_limits(numbers.limits(), &mut axes),
            1 => path.stop(&mut axes),
            2 => path.halt(),
            _ => continue,
        }
        stopped = true;
    }
    let at = axes.each_ref().map(Axis::odometer);
    assert!(stopped || at == moves.way().map(i64::from), "{at:?} is not the end");
});
