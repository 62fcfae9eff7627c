//! The way of two axes, one position against the other, with the same scale both ways.

use super::{
    Plot,
    draw::{LEFT, RIGHT, SMALL},
    page::{Anchor, Color, EDGE, GREY, PALE, Page, Place, Shape, Style, WIDTH},
    panel::frame,
    series::Curves,
    ticks::ticks,
};

const GAP: f64 = 26.0;
const FOOT: f64 = 44.0;
const LOWEST: f64 = 150.0;
const HIGHEST: f64 = 420.0;
const COLOR: Color = Color(58, 62, 140);

/// Places closer than this to the last one are not drawn.
const SEEN: f64 = 0.2;

/// The way of the first two axes that moved.
pub(super) struct Path {
    names: [String; 2],
    points: Vec<[f64; 2]>,
    /// Lowest and highest position of each.
    ranges: [[f64; 2]; 2],
}

impl Path {
    /// `None` if fewer than two axes moved.
    pub fn of(plot: &Plot, moved: &[usize]) -> Option<Self> {
        let axes = *moved.first_chunk::<2>()?;
        let points = against(&axes.map(|axis| positions(&plot.axes[axis].1)));
        let range = |axis: usize| {
            let places = points.iter().map(|point| point[axis]);
            let (low, high) = (places.clone().fold(0.0, f64::min), places.fold(0.0, f64::max));
            let room = ((high - low) * 0.04).max(0.5);
            [low - room, high + room]
        };
        let ranges = [range(0), range(1)];
        Some(Self { names: axes.map(|axis| plot.axes[axis].0.clone()), points, ranges })
    }

    fn frame_height(&self) -> f64 {
        let [across, up] = self.ranges.map(|[low, high]| high - low);
        ((WIDTH - RIGHT - LEFT) * up / across).clamp(LOWEST, HIGHEST)
    }

    /// Points of the page that it takes.
    pub fn height(&self) -> f64 {
        GAP + self.frame_height() + FOOT
    }

    pub fn draw(&self, page: &mut Page, top: f64) {
        let (left, right, top) = (LEFT, WIDTH - RIGHT, top + GAP);
        let (width, height) = (right - left, self.frame_height());
        let bottom = top + height;
        let [across, up] = self.ranges.map(|[low, high]| high - low);
        let scale = (width / across).min(height / up);
        // What the frame has to spare is shown on both sides.
        let [[x_low, x_high], [y_low, y_high]] = self.ranges;
        let (spare_x, spare_y) = ((width / scale - across) / 2.0, (height / scale - up) / 2.0);
        let (x_low, x_high) = (x_low - spare_x, x_high + spare_x);
        let (y_low, y_high) = (y_low - spare_y, y_high + spare_y);
        let place =
            |[x, y]: [f64; 2]| -> Place { (left + (x - x_low) * scale, bottom - (y - y_low) * scale) };

        let line = |value: f64| if value == 0.0 { (EDGE, 1.0) } else { (PALE, 0.75) };
        let numbers = Style::new(SMALL).color(GREY);
        // Lines as far apart one way as the other, as long as there is room for the numbers below.
        let columns = ticks(x_low, x_high, 9);
        let step =
            columns.values.get(1).zip(columns.values.first()).map_or(1.0, |(next, first)| next - first);
        let rows = ticks(y_low, y_high, ((y_high - y_low) / step) as usize + 1);
        for value in &columns.values {
            let (x, _) = place([*value, y_low]);
            let (color, width) = line(*value);
            page.line([(x, top), (x, bottom)], color, width);
            page.text(columns.label(*value), (x, bottom + 12.0), numbers.anchor(Anchor::Middle));
        }
        for value in &rows.values {
            let (_, y) = place([x_low, *value]);
            let (color, width) = line(*value);
            page.line([(left, y), (right, y)], color, width);
            page.text(rows.label(*value), (left - 7.0, y), numbers.anchor(Anchor::End));
        }
        let [x_name, y_name] = &self.names;
        let style = Style::new(SMALL).anchor(Anchor::Middle);
        let legend = format!("{x_name} / {}pulses", columns.power());
        page.text(legend, ((left + right) / 2.0, bottom + 30.0), style);
        let legend = format!("{y_name} / {}pulses", rows.power());
        page.text(legend, (36.0, (top + bottom) / 2.0), style.upright());

        let mut places: Vec<Place> = Vec::new();
        for (number, point) in self.points.iter().enumerate() {
            let at = place(*point);
            let near = |other: &Place| (at.0 - other.0).hypot(at.1 - other.1) < SEEN;
            if !places.last().is_some_and(near) || number + 1 == self.points.len() {
                places.push(at);
            }
        }
        frame(page, (left, top), (right, bottom));
        let start = places.first().copied();
        page.line(places, COLOR, 1.5);
        if let Some(start) = start {
            page.sign(Shape::Disc, start, COLOR);
        }
    }
}

/// Times and positions of an axis.
fn positions(curves: &Curves) -> Vec<[f64; 2]> {
    let extents = curves.buckets.iter().filter_map(|(_, motion)| motion.position);
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (time, position) in extents.flat_map(|extent| [extent.first, extent.last]) {
        if points.last().is_none_or(|last| time > last[0]) {
            points.push([time, position]);
        }
    }
    points
}

/// The position of the second axis against that of the first, wherever one of them is known; between two
/// times an axis goes straight on.
fn against(axes: &[Vec<[f64; 2]>; 2]) -> Vec<[f64; 2]> {
    let mut times: Vec<_> = axes.iter().flatten().map(|[time, _]| *time).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut next = [0, 0];
    let points = times.into_iter().map(|time| {
        [0, 1].map(|axis| {
            let known = &axes[axis];
            while known.get(next[axis]).is_some_and(|[at, _]| *at < time) {
                next[axis] += 1;
            }
            match (known[..next[axis]].last(), known.get(next[axis])) {
                (Some([from, before]), Some([to, after])) => {
                    before + (after - before) * (time - from) / (to - from)
                }
                (Some([_, place]), None) | (None, Some([_, place])) => *place,
                (None, None) => 0.0,
            }
        })
    });
    points.collect()
}

#[cfg(test)]
mod tests {
    use super::against;

    #[test]
    fn positions_meet_at_the_same_time() {
        let slow = vec![[0.0, 0.0], [10.0, 100.0]];
        let fast = vec![[0.0, 0.0], [4.0, 0.0], [5.0, -8.0], [12.0, -8.0]];
        let expected = [[0.0, 0.0], [40.0, 0.0], [50.0, -8.0], [100.0, -8.0], [100.0, -8.0]];
        assert_eq!(against(&[slow.clone(), fast.clone()]), expected);
        assert_eq!(against(&[fast, slow]), expected.map(|[one, other]| [other, one]));
    }
}
