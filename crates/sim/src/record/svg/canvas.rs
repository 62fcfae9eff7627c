//! Lines, text and signs on paper, in points of a page that is [`WIDTH`] wide.
//!
//! The library draws on whole units, so a point has [`UNITS`] of them.

use plotters::{
    coord::Shift,
    element::{Circle, PathElement, Polygon, Rectangle, Text},
    prelude::{Color, DrawingArea, IntoDrawingArea, IntoFont, RGBColor, SVGBackend, WHITE},
    style::{
        FontTransform, TextStyle,
        text_anchor::{HPos, Pos, VPos},
    },
};

/// Width of the page in points.
pub(super) const WIDTH: f64 = 800.0;

const UNITS: f64 = 8.0;

pub(super) const INK: RGBColor = RGBColor(40, 40, 40);
pub(super) const PALE: RGBColor = RGBColor(226, 226, 226);

/// A place in points from the top left corner.
pub(super) type Place = (f64, f64);

pub(super) type Failure = Box<dyn std::error::Error>;

/// What a small sign looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Disc,
    Square,
    Triangle,
}

pub(super) struct Canvas<'a>(DrawingArea<SVGBackend<'a>, Shift>);

impl<'a> Canvas<'a> {
    pub fn new(text: &'a mut String, height: f64) -> Result<Self, Failure> {
        let size = ((WIDTH * UNITS) as u32, (height * UNITS) as u32);
        let area = SVGBackend::with_string(text, size).into_drawing_area();
        area.fill(&WHITE)?;
        Ok(Self(area))
    }

    pub fn finish(self) -> Result<(), Failure> {
        Ok(self.0.present()?)
    }

    pub fn line(
        &self,
        places: impl IntoIterator<Item = Place>,
        color: RGBColor,
        width: f64,
    ) -> Result<(), Failure> {
        let places: Vec<_> = places.into_iter().map(units).collect();
        let style = color.stroke_width((width * UNITS) as u32);
        Ok(self.0.draw(&PathElement::new(places, style))?)
    }

    pub fn rectangle(&self, from: Place, to: Place, color: RGBColor, opacity: f64) -> Result<(), Failure> {
        Ok(self.0.draw(&Rectangle::new([units(from), units(to)], color.mix(opacity).filled()))?)
    }

    pub fn text(&self, text: &str, at: Place, size: f64, side: (HPos, VPos)) -> Result<(), Failure> {
        let font = ("sans-serif", size * UNITS).into_font();
        self.write(text, at, TextStyle::from(font).pos(Pos::new(side.0, side.1)))
    }

    /// Text that reads upward.
    pub fn upright(&self, text: &str, at: Place, size: f64) -> Result<(), Failure> {
        let font = ("sans-serif", size * UNITS).into_font().transform(FontTransform::Rotate270);
        self.write(text, at, TextStyle::from(font).pos(Pos::new(HPos::Center, VPos::Center)))
    }

    fn write(&self, text: &str, at: Place, style: TextStyle<'_>) -> Result<(), Failure> {
        Ok(self.0.draw(&Text::new(text, units(at), style.color(&INK)))?)
    }

    pub fn sign(&self, shape: Shape, at: Place, color: RGBColor) -> Result<(), Failure> {
        let (x, y) = at;
        let style = color.filled();
        match shape {
            Shape::Disc => self.0.draw(&Circle::new(units(at), (3.2 * UNITS) as i32, style))?,
            Shape::Square => {
                let corners = [units((x - 2.9, y - 2.9)), units((x + 2.9, y + 2.9))];
                self.0.draw(&Rectangle::new(corners, style))?;
            }
            Shape::Triangle => {
                let corners = [(x, y - 4.0), (x + 3.8, y + 2.8), (x - 3.8, y + 2.8)].map(units);
                self.0.draw(&Polygon::new(corners.to_vec(), style))?;
            }
        }
        Ok(())
    }
}

/// Makes a page that browsers show at its size in points.
pub(super) fn resized(svg: &str, height: f64) -> String {
    let [wide, high] = [WIDTH, height].map(|points| (points * UNITS) as u32);
    let size = format!("width=\"{wide}\" height=\"{high}\"");
    svg.replacen(&size, &format!("width=\"{WIDTH}\" height=\"{height}\""), 1)
}

fn units(place: Place) -> (i32, i32) {
    ((place.0 * UNITS).round() as i32, (place.1 * UNITS).round() as i32)
}
