//! What is on a page: lines, areas, text and signs, in points of a page that is [`WIDTH`] wide.
//!
//! A drawing only lists them. What they become is the business of [`svg`](super::svg) and [`png`](super::png), so
//! both formats show the same.

/// Width of the page in points.
pub(super) const WIDTH: f64 = 800.0;

/// A place in points from the top left corner.
pub(super) type Place = (f64, f64);

/// A colour: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Color(pub u8, pub u8, pub u8);

pub(super) const WHITE: Color = Color(255, 255, 255);
pub(super) const INK: Color = Color(38, 42, 48);
/// Of numbers and units, which are read second.
pub(super) const GREY: Color = Color(96, 104, 114);
/// Of frames.
pub(super) const EDGE: Color = Color(176, 182, 190);
/// Of what lies behind the curves.
pub(super) const PALE: Color = Color(232, 235, 239);

/// What a small sign looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Disc,
    Ring,
    Square,
    Triangle,
}

/// Which end of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub size: f64,
    pub bold: bool,
    pub color: Color,
    pub anchor: Anchor,
    /// It reads upward.
    pub upright: bool,
}

impl Style {
    pub const fn new(size: f64) -> Self {
        Self { size, bold: false, color: INK, anchor: Anchor::Start, upright: false }
    }

    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub const fn color(self, color: Color) -> Self {
        Self { color, ..self }
    }

    pub const fn anchor(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub const fn upright(self) -> Self {
        Self { upright: true, ..self }
    }
}

/// One thing on a page.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Element {
    Line {
        places: Vec<Place>,
        color: Color,
        width: f64,
        dashed: bool,
    },
    /// A polygon.
    Area {
        corners: Vec<Place>,
        color: Color,
        opacity: f64,
    },
    Disc {
        at: Place,
        radius: f64,
        color: Color,
    },
    /// Its place is on the line on which letters stand.
    Text {
        text: String,
        at: Place,
        style: Style,
    },
}

/// A page, from back to front.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Page {
    pub height: f64,
    pub elements: Vec<Element>,
}

/// How much of the size of a text a capital letter is high, of our font.
const CAPITAL: f64 = 0.727;

impl Page {
    pub fn new(height: f64) -> Self {
        Self { height, elements: Vec::new() }
    }

    pub fn line(&mut self, places: impl IntoIterator<Item = Place>, color: Color, width: f64) {
        let places = places.into_iter().collect();
        self.elements.push(Element::Line { places, color, width, dashed: false });
    }

    pub fn dashed(&mut self, places: impl IntoIterator<Item = Place>, color: Color, width: f64) {
        let places = places.into_iter().collect();
        self.elements.push(Element::Line { places, color, width, dashed: true });
    }

    pub fn area(&mut self, corners: impl IntoIterator<Item = Place>, color: Color, opacity: f64) {
        self.elements.push(Element::Area { corners: corners.into_iter().collect(), color, opacity });
    }

    pub fn rectangle(&mut self, (left, top): Place, (right, bottom): Place, color: Color, opacity: f64) {
        self.area([(left, top), (right, top), (right, bottom), (left, bottom)], color, opacity);
    }

    /// Text whose capitals have `at` in the middle of their height.
    pub fn text(&mut self, text: impl Into<String>, (x, y): Place, style: Style) {
        let drop = style.size * CAPITAL / 2.0;
        let at = if style.upright { (x + drop, y) } else { (x, y + drop) };
        self.elements.push(Element::Text { text: text.into(), at, style });
    }

    /// A small sign, with a white rim that sets it off from what it lies on.
    pub fn sign(&mut self, shape: Shape, at: Place, color: Color) {
        let mut corners = |size: f64, color| match shape {
            Shape::Disc | Shape::Ring => self.elements.push(Element::Disc { at, radius: size, color }),
            Shape::Square => {
                let half = size * 0.9;
                self.rectangle((at.0 - half, at.1 - half), (at.0 + half, at.1 + half), color, 1.0);
            }
            Shape::Triangle => {
                let (x, y) = at;
                let corners = [
                    (x, y - 1.3 * size),
                    (x + 1.2 * size, y + 0.85 * size),
                    (x - 1.2 * size, y + 0.85 * size),
                ];
                self.area(corners, color, 1.0);
            }
        };
        corners(4.3, WHITE);
        corners(3.2, color);
        if shape == Shape::Ring {
            corners(1.8, WHITE);
        }
    }
}
