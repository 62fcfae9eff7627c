//! The page of a plot: where everything is.

use super::{
    Plot, Sign,
    heading::{self, Heading},
    page::{Anchor, Color, GREY, INK, Page, Shape, Style, WIDTH},
    panel::{self, Panel},
    path::Path,
    series::Curves,
    ticks::ticks,
    trace,
};

const PANEL: f64 = 148.0;
const GAP: f64 = 16.0;
const TIME: f64 = 46.0;
const FOOT: f64 = 6.0;
pub(super) const LEFT: f64 = 92.0;
pub(super) const RIGHT: f64 = 22.0;
pub(super) const SMALL: f64 = 11.0;

/// Ticks of time at most.
const TIME_TICKS: usize = 9;

/// A colour an axis, told apart by people who see fewer colours too.
const AXIS_COLORS: [Color; 4] =
    [Color(0, 90, 170), Color(213, 94, 0), Color(0, 140, 105), Color(160, 70, 150)];

/// How events look and what they are called.
pub(super) const SIGNS: [(Sign, Shape, Color, &str); 4] = [
    (Sign::Started, Shape::Ring, Color(90, 98, 108), "started"),
    (Sign::Switch, Shape::Triangle, Color(230, 145, 0), "switch"),
    (Sign::TargetReached, Shape::Disc, Color(0, 145, 95), "target reached"),
    (Sign::Stopped, Shape::Square, Color(195, 35, 50), "stopped"),
];

pub(super) fn axis_color(axis: usize) -> Color {
    AXIS_COLORS[axis % AXIS_COLORS.len()]
}

/// A stretch of time, in seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub low: f64,
    pub high: f64,
}

impl Span {
    /// A clock may be less than what a second late in a long recording can tell apart.
    fn length(self) -> f64 {
        (self.high - self.low).max(f64::MIN_POSITIVE)
    }

    /// Where a second is on the page.
    pub fn across(self, second: f64) -> f64 {
        let part = ((second - self.low) / self.length()).clamp(0.0, 1.0);
        LEFT + (WIDTH - RIGHT - LEFT) * part
    }
}

/// Draws a plot.
pub(super) fn page(plot: &Plot) -> Page {
    let time = Span { low: plot.seconds(plot.origin), high: plot.seconds(plot.end.max(plot.origin + 1)) };
    let axes: Vec<_> = (0..plot.axes.len()).filter(|axis| plot.axes[*axis].1.has_moved()).collect();
    let heading = Heading::of(plot, &axes, time);
    let traces = trace::traces(plot);
    let path = Path::of(plot, &axes);
    let head = heading.height();
    let bottom = head + 3.0 * (PANEL + GAP) - GAP + trace::height(&traces);
    let below = path.as_ref().map_or(FOOT, Path::height);
    let mut page = Page::new(bottom + TIME + below);

    let seconds = ticks(time.low, time.high, TIME_TICKS);
    heading.draw(plot, &mut page);
    heading::bands(plot, time, (head, bottom), &mut page);
    let mut top = head;
    for (number, (name, unit, curves)) in quantities(plot, &axes).into_iter().enumerate() {
        let panel = Panel::new(top, PANEL, time, &curves, number > 0);
        panel.grid(&mut page, &seconds, name, unit);
        for (axis, curve) in axes.iter().zip(&curves) {
            panel.curve(&mut page, curve, axis_color(*axis));
        }
        // Behind those of the axes there are those of their encoders.
        for (axis, curve) in with_encoder(plot, &axes).zip(curves.iter().skip(axes.len())) {
            panel.dashed(&mut page, curve, axis_color(axis));
        }
        panel.frame(&mut page);
        if number == 0 {
            signs(plot, &axes, &panel, &mut page);
        }
        top += PANEL + GAP;
    }
    trace::draw(plot, &traces, top - GAP, time, &seconds, &mut page);
    heading::lines(plot, time, (head, bottom), &mut page);
    let style = Style::new(SMALL).color(GREY).anchor(Anchor::Middle);
    for second in &seconds.values {
        page.text(seconds.label(*second), (time.across(*second), bottom + 12.0), style);
    }
    let middle = ((LEFT + WIDTH - RIGHT) / 2.0, bottom + 30.0);
    page.text("time / s", middle, style.color(INK));
    if let Some(path) = path {
        path.draw(&mut page, bottom + TIME);
    }
    page
}

/// The axes whose encoders have curves of their own.
pub(super) fn with_encoder(plot: &Plot, axes: &[usize]) -> impl Iterator<Item = usize> {
    axes.iter().copied().filter(|axis| plot.axes[*axis].1.has_other_encoder())
}

/// The three panels: name, unit, and a curve for each axis; among the positions one more for each encoder that has one.
fn quantities(plot: &Plot, axes: &[usize]) -> [(&'static str, &'static str, Vec<Points>); 3] {
    let clock = f64::from(plot.clock_hz);
    let of = |curve: &dyn Fn(&Curves) -> Points| axes.iter().map(|axis| curve(&plot.axes[*axis].1)).collect();
    let mut positions: Vec<Points> =
        of(&|curves| panel::points(curves, |motion| motion.position, clock, 1.0));
    positions.extend(
        with_encoder(plot, axes)
            .map(|axis| panel::points(&plot.axes[axis].1, |motion| motion.encoder, clock, 1.0)),
    );
    [
        ("position", "pulses", positions),
        ("speed", "pulses/s", of(&|curves| panel::points(curves, |motion| motion.speed, clock, clock))),
        ("acceleration", "pulses/s²", of(&|curves| panel::slopes(curves, clock))),
    ]
}

/// Seconds and a value.
pub(super) type Points = Vec<(f64, f64)>;

fn signs(plot: &Plot, axes: &[usize], panel: &Panel, page: &mut Page) {
    // Where two are at one place, the later in the list covers the other.
    for (sign, shape, color, _) in SIGNS {
        for (at, axis, _) in
            plot.marks.iter().filter(|(_, axis, other)| axes.contains(axis) && *other == sign)
        {
            if let Some(position) = plot.axes[*axis].1.position_at(*at) {
                page.sign(shape, panel.place((plot.seconds(*at), position)), color);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{
        Mark, Note, Picture,
        plot::page::{Element, Place},
    };

    fn texts(plot: &Plot) -> Vec<String> {
        let text = |element| match element {
            Element::Text { text, .. } => Some(text),
            _ => None,
        };
        page(plot).elements.into_iter().filter_map(text).collect()
    }

    fn places(plot: &Plot) -> Vec<Place> {
        let places = |element| match element {
            Element::Line { places, .. } | Element::Area { corners: places, .. } => places,
            Element::Disc { at, .. } | Element::Text { at, .. } => vec![at],
        };
        page(plot).elements.into_iter().flat_map(places).collect()
    }

    /// Two axes of which one moves, a switch, an analog input, and a fault that ends.
    fn plot() -> Plot {
        let mut plot = Plot::new("stage", 1000, 0);
        let axes = ["X", "Y"].map(|name| plot.axis(name).unwrap());
        let (switch, input) = (plot.pin("+LX", "").unwrap(), plot.pin("AI1", "mV").unwrap());
        let still = plot.pin("DO1", "").unwrap();
        for pin in [switch, still] {
            plot.level(0, pin, 0.0);
        }
        plot.level(0, input, 2500.0);
        plot.mark(100, axes[0], Mark::Started);
        for at in 0..=1000_u32 {
            let speed = f64::from(at.min(1000 - at)) / 10.0;
            plot.sample(at.into(), axes[0], f64::from(at), speed);
            plot.sample(at.into(), axes[1], 0.0, 0.0);
        }
        plot.note(400, Note::Fault, "slip of X");
        plot.level(500, switch, 1.0);
        plot.level(600, input, 100.0);
        plot.note(700, Note::Cleared, "slip of X");
        plot.mark(1000, axes[0], Mark::TargetReached);
        plot.finish(1000);
        plot
    }

    #[test]
    fn what_happened_is_named_once() {
        let texts = texts(&plot());
        let count = |text: &str| texts.iter().filter(|other| *other == text).count();
        for text in [
            "stage",
            "axis X",
            "started",
            "target reached",
            "slip of X",
            "+LX",
            "AI1",
            "100 … 2500 mV",
            "time / s",
        ] {
            assert_eq!(count(text), 1, "{text}: {texts:?}");
        }
        for text in ["axis Y", "stopped", "DO1", "slip of X over"] {
            assert_eq!(count(text), 0, "{text}: {texts:?}");
        }
    }

    /// An encoder that counts every tenth pulse, and is so much behind after half of the way.
    #[track_caller]
    fn check_encoder(lost: i32, shown: bool) {
        let mut plot = Plot::new("stage", 1000, 0);
        let axis = plot.axis("X").unwrap();
        for at in 0..=1000_i32 {
            let turned = if at < 500 { at } else { at - lost };
            let encoder = turned - turned.rem_euclid(10);
            plot.sample(at as u64, axis, at.into(), 1000.0);
            plot.encoder(at as u64, axis, at.into(), encoder.into());
        }
        plot.finish(1000);
        let is_curve = |element: &Element| matches!(element, Element::Line { dashed: true, color, .. } if *color == axis_color(axis));
        let curves: Vec<_> = page(&plot).elements.into_iter().filter(is_curve).collect();
        assert_eq!(curves.len(), usize::from(shown), "{lost} lost");
        assert_eq!(texts(&plot).contains(&"encoder".to_owned()), shown);
    }

    #[test]
    fn an_encoder_that_says_something_else_has_a_curve() {
        check_encoder(0, false);
        check_encoder(2, false);
        check_encoder(40, true);
        check_encoder(-40, true);
    }

    #[test]
    fn everything_is_on_the_page() {
        let plot = plot();
        let height = page(&plot).height;
        for (x, y) in places(&plot) {
            assert!((0.0..=WIDTH).contains(&x) && (0.0..=height).contains(&y), "{x}, {y}");
        }
    }

    #[test]
    fn a_plot_of_nothing_and_one_of_too_much_can_be_drawn() {
        let mut odd = Plot::new("odd", 1, u64::MAX / 2);
        let (axis, pin) = (odd.axis("X").unwrap(), odd.pin("P", "").unwrap());
        for (at, value) in [(0, 1e15), (u64::MAX / 2, -1e15), (5, f64::MAX), (u64::MAX / 2 + 1, f64::MIN)] {
            odd.sample(at, axis, value, -value);
            odd.level(at, pin, value);
            odd.mark(at, axis, Mark::Stopped);
        }
        for plot in [Plot::new("", 1, 0), odd] {
            for picture in [Picture::Svg, Picture::Png] {
                assert!(!plot.draw(picture).unwrap().is_empty());
            }
            assert!(places(&plot).iter().all(|(x, y)| x.is_finite() && y.is_finite()));
        }
    }
}
