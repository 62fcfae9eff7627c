//! Pins, as a logic analyser shows them: one under the other, those that changed.

use super::{
    Plot, Trace,
    draw::{LEFT, RIGHT, SMALL, Span},
    page::{Anchor, Color, EDGE, GREY, PALE, Page, Style, WIDTH},
    series::{self, Levels},
    ticks::Ticks as Scale,
};

/// Above the first trace.
const HEAD: f64 = 14.0;

/// Heights of a row, and the room in it above and below the trace.
const DIGITAL: f64 = 19.0;
const ANALOG: f64 = 36.0;
const ROOM: f64 = 4.0;

const COLOR: Color = Color(52, 64, 84);

/// The unit of what needs none.
const NO_UNIT: &str = "";

/// A row: the pin and the extremes of its values.
pub(super) struct Row {
    pin: usize,
    span: series::Span,
    is_digital: bool,
}

impl Row {
    fn height(&self) -> f64 {
        if self.is_digital { DIGITAL } else { ANALOG }
    }
}

/// The pins that changed.
pub(super) fn traces(plot: &Plot) -> Vec<Row> {
    let row = |(pin, trace): (usize, &Trace)| {
        let span = trace.levels.span().filter(|span| span.low < span.high)?;
        let is_digital = trace.unit == NO_UNIT && (span.low, span.high) == (0.0, 1.0);
        Some(Row { pin, span, is_digital })
    };
    plot.pins.iter().enumerate().filter_map(row).collect()
}

/// Points of the page that they take.
pub(super) fn height(rows: &[Row]) -> f64 {
    if rows.is_empty() { 0.0 } else { HEAD + rows.iter().map(Row::height).sum::<f64>() }
}

pub(super) fn draw(plot: &Plot, rows: &[Row], top: f64, time: Span, seconds: &Scale, page: &mut Page) {
    if rows.is_empty() {
        return;
    }
    let (mut top, bottom) = (top + HEAD, top + height(rows));
    for second in &seconds.values {
        let x = time.across(*second);
        page.line([(x, top), (x, bottom)], PALE, 0.75);
    }
    for row in rows {
        let trace = &plot.pins[row.pin];
        let (low, high) = (top + row.height() - ROOM, top + ROOM);
        let name = Style::new(SMALL).anchor(Anchor::End);
        if row.is_digital {
            page.text(&trace.name, (LEFT - 7.0, (low + high) / 2.0), name);
        } else {
            page.text(&trace.name, (LEFT - 7.0, high + 6.0), name);
            let range = format!("{} … {} {}", number(row.span.low), number(row.span.high), trace.unit);
            page.text(range.trim_end(), (LEFT - 7.0, low - 5.0), Style { size: 8.5, ..name.color(GREY) });
        }
        let lanes = Lanes { low, high, span: row.span };
        let pieces = pieces(plot, trace, time);
        if row.is_digital {
            lanes.logic(&pieces, page);
        } else {
            lanes.analog(&pieces, page);
        }
        top += row.height();
        page.line([(LEFT, top), (WIDTH - RIGHT, top)], PALE, 0.75);
    }
    page.line([(LEFT, bottom), (WIDTH - RIGHT, bottom)], EDGE, 0.75);
}

/// A number as short as it is exact enough to be read.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').replace('-', "−")
}

/// A piece of a trace: from one place across the page to another it has these values.
struct Piece {
    from: f64,
    to: f64,
    low: f64,
    high: f64,
    last: f64,
}

/// The pieces of a trace. It has the value that it was told last until it is told another.
fn pieces(plot: &Plot, trace: &Trace, time: Span) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut value = None;
    let mut from = time.low;
    let end = std::iter::once((plot.end, &Levels(None)));
    for (to, Levels(told)) in trace.levels.iter().chain(end) {
        let to = plot.seconds(to.min(plot.end)).max(from);
        let (start, stop) = (time.across(from), time.across(to));
        let piece = match (told, value) {
            (Some(span), _) => {
                Piece { from: start, to: stop, low: span.low, high: span.high, last: span.last }
            }
            (None, Some(value)) => Piece { from: start, to: stop, low: value, high: value, last: value },
            (None, None) => continue,
        };
        value = Some(piece.last);
        from = to;
        match pieces.last_mut() {
            Some(before) if (before.low, before.high, before.last) == (piece.low, piece.high, piece.last) => {
                before.to = piece.to;
            }
            _ => pieces.push(piece),
        }
    }
    pieces
}

/// Where a trace is on the page.
struct Lanes {
    low: f64,
    high: f64,
    span: series::Span,
}

impl Lanes {
    fn y(&self, value: f64) -> f64 {
        let part = (value - self.span.low) / (self.span.high - self.span.low);
        self.low + (self.high - self.low) * part
    }

    /// A line that is high or low, filled below where it is high; a block where it changes faster than can be drawn.
    fn logic(&self, pieces: &[Piece], page: &mut Page) {
        let mut line = Vec::new();
        for piece in pieces {
            let (top, bottom) = (self.y(piece.high), self.y(piece.low));
            if piece.low < piece.high {
                page.rectangle((piece.from, top), (piece.to, bottom), COLOR, 0.45);
            } else if piece.last > self.span.low {
                page.rectangle((piece.from, top), (piece.to, self.low), COLOR, 0.14);
            }
            if piece.low < piece.high {
                line.extend([(piece.from, top), (piece.from, bottom), (piece.to, bottom), (piece.to, top)]);
            }
            line.extend([(piece.from, self.y(piece.last)), (piece.to, self.y(piece.last))]);
        }
        page.line(line, COLOR, 1.0);
    }

    /// A line from value to value.
    fn analog(&self, pieces: &[Piece], page: &mut Page) {
        let mut line = Vec::new();
        for piece in pieces {
            if piece.low < piece.high {
                line.extend([(piece.from, self.y(piece.low)), (piece.from, self.y(piece.high))]);
            }
            line.extend([(piece.from, self.y(piece.last)), (piece.to, self.y(piece.last))]);
        }
        page.line(line, COLOR, 1.0);
    }
}
