//! The panel of a quantity: a grid, and a curve for each axis.

use super::{
    draw::{LEFT, Points, RIGHT, SMALL, Span},
    page::{Anchor, Color, EDGE, GREY, PALE, Page, Place, Style, WIDTH},
    series::{Curves, Extent, Motion},
    ticks::{Ticks as Scale, ticks},
};

/// The frame of one quantity.
pub(super) struct Panel {
    top: f64,
    height: f64,
    time: Span,
    low: f64,
    high: f64,
}

impl Panel {
    /// A panel that has room for the curves. `zero` says that 0 is to be on it.
    pub fn new(top: f64, height: f64, time: Span, curves: &[Points], zero: bool) -> Self {
        let values = curves.iter().flatten().map(|(_, value)| *value);
        let lowest = values.clone().fold(f64::INFINITY, f64::min);
        let highest = values.fold(f64::NEG_INFINITY, f64::max);
        let (mut low, mut high) = if lowest <= highest { (lowest, highest) } else { (0.0, 0.0) };
        // 0 is there, too, unless the curves would lose half of their height to it.
        let (with_low, with_high) = (low.min(0.0), high.max(0.0));
        if zero || with_high - with_low <= 2.0 * (high - low) {
            (low, high) = (with_low, with_high);
        }
        // A curve does not lie on the frame, and one that is flat has room around it.
        let room = if high > low { (high - low) * 0.07 } else { 1.0 };
        Self { top, height, time, low: low - room, high: high + room }
    }

    /// Where a value is on the page.
    pub fn place(&self, (second, value): (f64, f64)) -> Place {
        let y = self.top + self.height * (self.high - value) / (self.high - self.low);
        (self.time.across(second), y)
    }

    /// What lies behind the curves, and the numbers and words beside them.
    pub fn grid(&self, page: &mut Page, seconds: &Scale, name: &str, unit: &str) {
        let values = ticks(self.low, self.high, 6);
        for second in &seconds.values {
            let x = self.time.across(*second);
            page.line([(x, self.top), (x, self.top + self.height)], PALE, 0.75);
        }
        let style = Style::new(SMALL).color(GREY).anchor(Anchor::End);
        for value in &values.values {
            let (_, y) = self.place((0.0, *value));
            let (color, width) = if *value == 0.0 { (EDGE, 1.0) } else { (PALE, 0.75) };
            page.line([(LEFT, y), (WIDTH - RIGHT, y)], color, width);
            page.text(values.label(*value), (LEFT - 7.0, y), style);
        }
        let middle = self.top + self.height / 2.0;
        let style = Style::new(SMALL).anchor(Anchor::Middle).upright();
        page.text(name, (20.0, middle), style.bold());
        page.text(format!("{}{unit}", values.power()), (36.0, middle), style.color(GREY));
    }

    /// The line of a curve.
    pub fn curve(&self, page: &mut Page, points: &Points, color: Color) {
        page.line(thinned(points.iter().map(|point| self.place(*point))), color, 1.5);
    }

    /// The line of a curve beside the one of the same colour.
    pub fn dashed(&self, page: &mut Page, points: &Points, color: Color) {
        page.dashed(thinned(points.iter().map(|point| self.place(*point))), color, 1.2);
    }

    /// The edges, in front of the curves.
    pub fn frame(&self, page: &mut Page) {
        frame(page, (LEFT, self.top), (WIDTH - RIGHT, self.top + self.height));
    }
}

/// A frame around a part of the page.
pub(super) fn frame(page: &mut Page, (left, top): Place, (right, bottom): Place) {
    page.line([(left, top), (right, top), (right, bottom), (left, bottom), (left, top)], EDGE, 0.75);
}

/// The points of a curve: first and last one of each bucket, and the extremes that lie outside these.
pub(super) fn points(curves: &Curves, part: fn(&Motion) -> Option<Extent>, clock: f64, scale: f64) -> Points {
    let mut points: Points = Vec::new();
    for Extent { first, low, high, last } in curves.buckets.iter().filter_map(|(_, motion)| part(motion)) {
        let middle = (first.0 + last.0) / 2.0;
        let extremes = [low, high].into_iter().filter(|extreme| *extreme != first.1 && *extreme != last.1);
        let places = [first].into_iter().chain(extremes.map(|extreme| (middle, extreme))).chain([last]);
        points.extend(places.map(|(at, value)| (at / clock, value * scale)));
    }
    points
}

/// Differences of the speed. Starts from rest, stops and reversals are left out: they are jumps.
pub(super) fn slopes(curves: &Curves, clock: f64) -> Points {
    let speeds: Vec<_> =
        curves.buckets.iter().filter_map(|(_, motion)| motion.speed).map(|speed| speed.last).collect();
    let turns = |pair: &[(f64, f64)]| pair[0].1 * pair[1].1 < 0.0;
    let mut points: Points = Vec::new();
    for (number, pair) in speeds.windows(2).enumerate() {
        let [(from, before), (to, after)] = [pair[0], pair[1]];
        let rests = before == 0.0 && after == 0.0;
        // The first spacing after a reversal, and the last before it, are no spacing of the ramp.
        let near_turn = speeds[number.saturating_sub(1)..].windows(2).take(3).any(turns);
        if to <= from || near_turn || before * after == 0.0 && !rests {
            continue;
        }
        // A step, not a slope: the value holds from one speed to the next.
        let slope = (after - before) / (to - from) * clock * clock;
        points.extend([(from / clock, slope), (to / clock, slope)]);
    }
    points
}

/// Leaves out what nobody would see: places within a little of the line that stays.
fn thinned(places: impl Iterator<Item = Place>) -> Vec<Place> {
    const SEEN: f64 = 0.06;
    let mut kept: Vec<Place> = Vec::new();
    let mut pending: Option<Place> = None;
    // Slopes of the lines from the last place that pass all places left out since.
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for place in places {
        if let (Some(&from), Some(left_out)) = (kept.last(), pending) {
            let run = place.0 - from.0;
            let slope = (place.1 - from.1) / run;
            // Upright lines have no slope and stay.
            if !(run > 0.0 && low <= slope && slope <= high) {
                kept.push(left_out);
                (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
            }
        }
        match kept.last() {
            None => kept.push(place),
            Some(from) => {
                let run = place.0 - from.0;
                if run > 0.0 {
                    low = low.max((place.1 - SEEN - from.1) / run);
                    high = high.min((place.1 + SEEN - from.1) / run);
                } else {
                    (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
                }
                pending = Some(place);
            }
        }
    }
    kept.extend(pending);
    kept
}

#[cfg(test)]
mod tests {
    use super::thinned;

    #[test]
    fn thinning_keeps_the_shape() {
        let flat = (0..1000).map(|x| (f64::from(x), 5.0));
        assert_eq!(thinned(flat), [(0.0, 5.0), (999.0, 5.0)]);
        // A slow bend goes away from a straight line without a sharp corner.
        let bend = |x: i32| (f64::from(x), f64::from(x * x) / 1e4);
        let kept = thinned((0..1000).map(bend));
        assert!(kept.len() < 100, "{}", kept.len());
        for x in 0..1000 {
            let (x, y) = bend(x);
            let after = kept.iter().position(|place| place.0 >= x).unwrap().max(1);
            let ((x0, y0), (x1, y1)) = (kept[after - 1], kept[after]);
            let line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
            assert!((line - y).abs() < 0.45, "{line} for {y} at {x}");
        }
        let step = [(0.0, 0.0), (5.0, 0.0), (5.0, 9.0), (8.0, 9.0)];
        assert_eq!(thinned(step.into_iter()), step);
    }
}
