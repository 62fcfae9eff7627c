//! The picture of a finished recording.

use super::{
    Sign, SvgRecorder,
    canvas::{Canvas, Failure, INK, PALE, Place, Shape, WIDTH, resized},
    path::Path,
    series::{Curves, Extent, Motion},
    ticks::{Ticks as Scale, ticks},
};
use motion::Ticks;
use plotters::{
    prelude::RGBColor,
    style::text_anchor::{HPos, VPos},
};

const HEAD: f64 = 56.0;
const PANEL: f64 = 150.0;
const GAP: f64 = 14.0;
const TIME: f64 = 44.0;
const STRIP: f64 = 16.0;
const FOOT: f64 = 10.0;
pub(super) const LEFT: f64 = 84.0;
pub(super) const RIGHT: f64 = 20.0;
pub(super) const SMALL: f64 = 11.0;

/// A colour an axis, told apart by people who see fewer colours too.
const AXIS_COLORS: [RGBColor; 4] =
    [RGBColor(0, 90, 160), RGBColor(200, 90, 0), RGBColor(0, 130, 90), RGBColor(150, 60, 140)];

/// How events look and what they are called.
const SIGNS: [(Sign, Shape, RGBColor, &str); 3] = [
    (Sign::TargetReached, Shape::Disc, RGBColor(0, 140, 90), "target reached"),
    (Sign::Stopped, Shape::Square, RGBColor(190, 30, 45), "stopped"),
    (Sign::Switch, Shape::Triangle, RGBColor(225, 140, 0), "switch"),
];

/// Seconds and a value.
type Points = Vec<(f64, f64)>;

/// The picture as SVG text, or what is wrong.
pub(super) fn draw(recording: &SvgRecorder, end: Ticks) -> Result<String, String> {
    let pins: Vec<_> = (0..recording.info.pins.len())
        .filter(|pin| recording.levels[*pin].1 && !recording.info.pins[*pin].kind.is_analog())
        .collect();
    let path = Path::of(recording);
    let below = path.as_ref().map_or(FOOT, Path::height);
    let height = HEAD + 3.0 * (PANEL + GAP) + TIME + STRIP * pins.len() as f64 + below;
    let mut text = String::new();
    paint(recording, end, &pins, path.as_ref(), &mut text, height).map_err(|error| error.to_string())?;
    Ok(resized(&text, height))
}

fn paint(
    recording: &SvgRecorder,
    end: Ticks,
    pins: &[usize],
    path: Option<&Path>,
    text: &mut String,
    height: f64,
) -> Result<(), Failure> {
    let canvas = Canvas::new(text, height)?;
    let clock = f64::from(recording.info.clock_hz);
    let origin = recording.origin.unwrap_or(end);
    let time = Range { low: origin as f64 / clock, high: end.max(origin + 1) as f64 / clock };
    let axes: Vec<_> = (0..recording.axes.len()).filter(|axis| recording.axes[*axis].has_moved()).collect();
    heading(recording, &axes, &canvas)?;

    let all = |part: fn(&Motion) -> Option<Extent>, scale: f64| -> Vec<Points> {
        axes.iter().map(|axis| points(&recording.axes[*axis], part, clock, scale)).collect()
    };
    let positions = all(|motion| motion.position, 1.0);
    let speeds = all(|motion| motion.speed, clock);
    let accelerations = axes.iter().map(|axis| slopes(&recording.axes[*axis], clock)).collect();
    let curves = [
        ("position", "pulses", positions),
        ("speed", "pulses/s", speeds),
        ("acceleration", "pulses/s²", accelerations),
    ];
    let seconds = ticks(time.low, time.high, 9);
    let mut top = HEAD;
    for (number, (name, unit, curves)) in curves.into_iter().enumerate() {
        let panel = Panel::new(top, time, &curves);
        panel.grid(&canvas, &seconds, name, unit)?;
        for (axis, curve) in axes.iter().zip(&curves) {
            canvas.line(thinned(curve.iter().map(|point| panel.place(*point))), axis_color(*axis), 1.25)?;
        }
        panel.frame(&canvas)?;
        if number == 0 {
            for (at, _, position, sign) in &recording.marks {
                let (_, shape, color, _) = SIGNS[*sign as usize];
                canvas.sign(shape, panel.place((*at as f64 / clock, *position as f64)), color)?;
            }
        }
        top += PANEL + GAP;
    }
    top -= GAP;
    for second in &seconds.values {
        let x = across(time, *second);
        canvas.text(&seconds.label(*second), (x, top + 6.0), SMALL, (HPos::Center, VPos::Top))?;
    }
    let middle = (LEFT + WIDTH - RIGHT) / 2.0;
    canvas.text("time / s", (middle, top + 22.0), SMALL + 1.0, (HPos::Center, VPos::Top))?;
    top += TIME;
    for pin in pins {
        strip(recording, &canvas, *pin, top, time, end)?;
        top += STRIP;
    }
    if let Some(path) = path {
        path.draw(&canvas, top)?;
    }
    canvas.finish()
}

/// The name, and what colours and signs mean.
fn heading(recording: &SvgRecorder, axes: &[usize], canvas: &Canvas<'_>) -> Result<(), Failure> {
    let left = (HPos::Left, VPos::Center);
    canvas.text(&recording.info.device, (LEFT, 18.0), 15.0, left)?;
    let (mut x, y) = (LEFT, 41.0);
    let width = |text: &str| text.len() as f64 * 5.6 + 20.0;
    if recording.info.axes.len() > 1 {
        for axis in axes {
            let name = format!("axis {}", recording.info.axes[*axis]);
            canvas.line([(x, y), (x + 16.0, y)], axis_color(*axis), 1.5)?;
            canvas.text(&name, (x + 20.0, y), SMALL, left)?;
            x += 20.0 + width(&name);
        }
    }
    for (sign, shape, color, name) in SIGNS {
        if recording.marks.iter().any(|(.., other)| *other == sign) {
            canvas.sign(shape, (x + 4.0, y), color)?;
            canvas.text(name, (x + 12.0, y), SMALL, left)?;
            x += 12.0 + width(name);
        }
    }
    Ok(())
}

#[derive(Clone, Copy, Debug)]
struct Range {
    low: f64,
    high: f64,
}

/// The frame of one quantity.
struct Panel {
    top: f64,
    time: Range,
    values: Range,
}

impl Panel {
    fn new(top: f64, time: Range, curves: &[Points]) -> Self {
        let values = curves.iter().flatten().map(|(_, value)| *value);
        let low = values.clone().fold(0.0, f64::min);
        let high = values.fold(0.0, f64::max);
        // A curve does not lie on the frame, and one that is flat has room around it.
        let room = if high > low { (high - low) * 0.06 } else { 1.0 };
        Self { top, time, values: Range { low: low - room, high: high + room } }
    }

    fn place(&self, (second, value): (f64, f64)) -> Place {
        let Range { low, high } = self.values;
        (across(self.time, second), self.top + PANEL * (high - value) / (high - low))
    }

    fn grid(&self, canvas: &Canvas<'_>, seconds: &Scale, name: &str, unit: &str) -> Result<(), Failure> {
        let values = ticks(self.values.low, self.values.high, 6);
        for second in &seconds.values {
            let x = across(self.time, *second);
            canvas.line([(x, self.top), (x, self.top + PANEL)], PALE, 0.5)?;
        }
        for value in &values.values {
            let (_, y) = self.place((0.0, *value));
            canvas.line([(LEFT, y), (WIDTH - RIGHT, y)], if *value == 0.0 { INK } else { PALE }, 0.5)?;
            canvas.text(&values.label(*value), (LEFT - 6.0, y), SMALL, (HPos::Right, VPos::Center))?;
        }
        let middle = self.top + PANEL / 2.0;
        canvas.upright(name, (16.0, middle), SMALL + 1.0)?;
        canvas.upright(&format!("{}{unit}", values.power()), (32.0, middle), SMALL)
    }

    fn frame(&self, canvas: &Canvas<'_>) -> Result<(), Failure> {
        let (right, bottom) = (WIDTH - RIGHT, self.top + PANEL);
        let corners =
            [(LEFT, self.top), (right, self.top), (right, bottom), (LEFT, bottom), (LEFT, self.top)];
        canvas.line(corners, INK, 0.75)
    }
}

fn across(time: Range, second: f64) -> f64 {
    LEFT + (WIDTH - RIGHT - LEFT) * (second - time.low) / (time.high - time.low)
}

fn axis_color(axis: usize) -> RGBColor {
    AXIS_COLORS[axis % AXIS_COLORS.len()]
}

/// The points of a curve: first and last one of each bucket, and the extremes that lie outside these.
fn points(curves: &Curves, part: fn(&Motion) -> Option<Extent>, clock: f64, scale: f64) -> Points {
    let mut points: Points = Vec::new();
    for Extent { first, low, high, last } in curves.buckets.iter().filter_map(|(_, motion)| part(motion)) {
        let middle = (first.0 + last.0) / 2.0;
        let extremes = [low, high].into_iter().filter(|extreme| *extreme != first.1 && *extreme != last.1);
        let places = [first].into_iter().chain(extremes.map(|extreme| (middle, extreme))).chain([last]);
        points.extend(places.map(|(at, value)| (at / clock, value * scale)));
    }
    points
}

/// Differences of the speed. A start from rest and a stop are left out: they are jumps.
fn slopes(curves: &Curves, clock: f64) -> Points {
    let speeds: Vec<_> =
        curves.buckets.iter().filter_map(|(_, motion)| motion.speed).map(|speed| speed.last).collect();
    let mut points: Points = Vec::new();
    for pair in speeds.windows(2) {
        let [(from, before), (to, after)] = [pair[0], pair[1]];
        let jumps = before == 0.0 || after == 0.0 || to <= from;
        let slope = if jumps { 0.0 } else { (after - before) / (to - from) * clock * clock };
        // A step, not a slope: the value holds from one speed to the next.
        points.extend([(from / clock, slope), (to / clock, slope)]);
    }
    points
}

/// Leaves out what nobody would see: places within a fifth of a point of the line that stays.
fn thinned(places: impl Iterator<Item = Place>) -> Vec<Place> {
    const SEEN: f64 = 0.2;
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

/// One pin: a bar where it is on, paler where it changes faster than can be drawn.
fn strip(
    recording: &SvgRecorder,
    canvas: &Canvas<'_>,
    pin: usize,
    top: f64,
    time: Range,
    end: Ticks,
) -> Result<(), Failure> {
    let clock = f64::from(recording.info.clock_hz);
    let (high, low) = (top + 3.0, top + STRIP - 3.0);
    let color = RGBColor(70, 80, 95);
    let name = recording.info.pins[pin].name;
    canvas.text(name, (LEFT - 6.0, (high + low) / 2.0), SMALL, (HPos::Right, VPos::Center))?;
    canvas.line([(LEFT, low), (WIDTH - RIGHT, low)], PALE, 0.5)?;
    let mut bars: Vec<(f64, f64, f64)> = Vec::new();
    let mut from = time.low;
    let mut level = false;
    let until_end = std::iter::once((end, None));
    let buckets = recording.pins[pin].iter().map(|(to, levels)| (to, Some(levels)));
    for (to, levels) in buckets.chain(until_end) {
        let to = (to.min(end) as f64 / clock).max(from);
        let mixed = levels.is_some_and(|levels| levels.on && levels.off);
        let changed = levels.and_then(|levels| levels.last);
        let opacity = if mixed { 0.5 } else { f64::from(u8::from(changed.unwrap_or(level))) };
        match bars.last_mut() {
            Some(last) if last.2 == opacity => last.1 = to,
            _ => bars.push((from, to, opacity)),
        }
        level = changed.unwrap_or(level);
        from = to;
    }
    for (from, to, opacity) in bars {
        if opacity > 0.0 {
            canvas.rectangle((across(time, from), high), (across(time, to), low), color, opacity)?;
        }
    }
    Ok(())
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
