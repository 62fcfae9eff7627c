//! Above the panels: the name, what colours and signs mean, and what happened around the axes.

use super::{
    Plot,
    draw::{LEFT, RIGHT, SIGNS, SMALL, Span, axis_color, with_encoder},
    font::Font,
    page::{Anchor, Color, INK, Page, Place, Style, WIDTH},
};
use crate::record::Note;

const TITLE: f64 = 15.0;
/// From one line of the legend to the next, and of notes.
const LINE: f64 = 17.0;
const LANE: f64 = 14.0;
/// Most lines of notes; those that find no room have a line through the panels and no words.
const MAX_LANES: usize = 6;
/// Between two words in a line.
const SPACE: f64 = 18.0;

const FAULT: Color = Color(200, 40, 60);

/// A word of the legend: where it is, and what it means.
enum Word {
    Axis(usize),
    Encoder,
    Sign(usize),
}

/// What is above the panels, and where.
pub(super) struct Heading {
    words: Vec<(Place, Word, String)>,
    /// Note, left end of its text, and lane.
    labels: Vec<(usize, f64, usize)>,
    lanes: usize,
    top: f64,
}

impl Heading {
    pub fn of(plot: &Plot, axes: &[usize], time: Span) -> Self {
        let font = Font::new(false);
        let mut words = Vec::new();
        if plot.axes.len() > 1 {
            words.extend(
                axes.iter().map(|axis| (Word::Axis(*axis), 22.0, format!("axis {}", plot.axes[*axis].0))),
            );
        }
        if with_encoder(plot, axes).next().is_some() {
            words.push((Word::Encoder, 22.0, "encoder".into()));
        }
        for (number, (sign, .., name)) in SIGNS.iter().enumerate() {
            if plot.marks.iter().any(|(.., other)| other == sign) {
                words.push((Word::Sign(number), 12.0, (*name).into()));
            }
        }
        let (mut x, mut y) = (LEFT, 42.0);
        let mut placed = Vec::new();
        for (word, sign_width, text) in words {
            let width = sign_width + font.width(&text, SMALL);
            if x > LEFT && x + width > WIDTH - RIGHT {
                (x, y) = (LEFT, y + LINE);
            }
            placed.push(((x, y), word, text));
            x += width + SPACE;
        }
        let top = y + LINE;
        let (labels, lanes) = lanes(plot, time, &font);
        Self { words: placed, labels, lanes, top }
    }

    /// Points of the page that it takes.
    pub fn height(&self) -> f64 {
        self.top + if self.lanes == 0 { 0.0 } else { self.lanes as f64 * LANE + 4.0 }
    }

    pub fn draw(&self, plot: &Plot, page: &mut Page) {
        page.text(&plot.title, (LEFT, 20.0), Style::new(TITLE).bold());
        for ((x, y), word, text) in &self.words {
            let (at, indent) = (
                (*x, *y),
                match word {
                    Word::Axis(axis) => {
                        page.line([(*x, *y), (x + 16.0, *y)], axis_color(*axis), 2.0);
                        22.0
                    }
                    Word::Encoder => {
                        page.dashed([(*x, *y), (x + 16.0, *y)], INK, 1.2);
                        22.0
                    }
                    Word::Sign(number) => {
                        let (_, shape, color, _) = SIGNS[*number];
                        page.sign(shape, (x + 4.0, *y), color);
                        12.0
                    }
                },
            );
            page.text(text, (at.0 + indent, at.1), Style::new(SMALL));
        }
        for (note, x, lane) in &self.labels {
            let (_, kind, text) = &plot.notes[*note];
            let at = (x + 4.0, self.top + (*lane as f64 + 0.5) * LANE);
            page.text(label(*kind, text), at, Style::new(9.5).color(color(*kind)).anchor(Anchor::Start));
        }
    }
}

/// What is written of a note.
fn label(note: Note, text: &str) -> String {
    match note {
        Note::PowerUp => format!("power up {text}"),
        Note::Cleared => format!("{text} over"),
        Note::Fault | Note::Notice => text.into(),
    }
}

fn color(note: Note) -> Color {
    if note == Note::Fault { FAULT } else { INK }
}

/// Whether a note has words: the end of a fault is the end of its band.
fn has_words(plot: &Plot, note: usize) -> bool {
    let (_, kind, text) = &plot.notes[note];
    let begun = |(_, kind, other): &(_, Note, String)| *kind == Note::Fault && other == text;
    *kind != Note::Cleared || !plot.notes[..note].iter().any(begun)
}

/// Where the words of the notes go: beside their time, in the first lane that has room.
fn lanes(plot: &Plot, time: Span, font: &Font) -> (Vec<(usize, f64, usize)>, usize) {
    let mut ends: Vec<f64> = Vec::new();
    let mut labels = Vec::new();
    for note in (0..plot.notes.len()).filter(|note| has_words(plot, *note)) {
        let (at, kind, text) = &plot.notes[note];
        let width = font.width(&label(*kind, text), 9.5) + 8.0;
        let right = WIDTH - RIGHT;
        let x = time.across(plot.seconds(*at)).min(right - width).max(LEFT);
        let lane = ends.iter().position(|end| *end <= x);
        let lane = match lane {
            Some(lane) => lane,
            None if ends.len() < MAX_LANES => {
                ends.push(0.0);
                ends.len() - 1
            }
            None => continue,
        };
        ends[lane] = x + width;
        labels.push((note, x, lane));
    }
    (labels, ends.len())
}

/// Behind the panels: how long faults lasted.
pub(super) fn bands(plot: &Plot, time: Span, (top, bottom): (f64, f64), page: &mut Page) {
    for (number, (from, note, text)) in plot.notes.iter().enumerate() {
        if *note == Note::Fault {
            let over = |(_, note, other): &&(_, Note, String)| *note == Note::Cleared && other == text;
            let until = plot.notes[number..].iter().find(over).map_or(plot.end, |(at, ..)| *at);
            let [left, right] = [*from, until].map(|at| time.across(plot.seconds(at)));
            page.rectangle((left, top), (right, bottom), FAULT, 0.07);
        }
    }
}

/// In front of the panels: when it happened.
pub(super) fn lines(plot: &Plot, time: Span, (top, bottom): (f64, f64), page: &mut Page) {
    for (at, note, _) in &plot.notes {
        let x = time.across(plot.seconds(*at));
        let color = if *note == Note::Cleared { FAULT } else { color(*note) };
        page.dashed([(x, top - 3.0), (x, bottom)], color, 0.75);
    }
}
