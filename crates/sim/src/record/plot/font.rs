//! The letters of PNG files, and how wide text is: two weights of Inter, cut down to the letters that plots have.
//!
//! The fonts come with the program, so that a picture is the same on every computer. `font/LICENSE.txt` is theirs.

use skrifa::{
    FontRef, GlyphId, MetadataProvider,
    instance::{LocationRef, Size},
    outline::{DrawSettings, OutlinePen},
};
use tiny_skia::PathBuilder;

static REGULAR: &[u8] = include_bytes!("font/Inter-Regular.otf");
static BOLD: &[u8] = include_bytes!("font/Inter-SemiBold.otf");

/// What stands for a letter that the fonts do not have.
const UNKNOWN: char = '?';

/// One weight.
pub(super) struct Font(FontRef<'static>);

impl Font {
    pub fn new(bold: bool) -> Self {
        let bytes = if bold { BOLD } else { REGULAR };
        Self(FontRef::new(bytes).expect("our own fonts can be read"))
    }

    fn glyphs(&self, text: &str) -> impl Iterator<Item = GlyphId> {
        let map = self.0.charmap();
        text.chars().filter_map(move |letter| map.map(letter).or_else(|| map.map(UNKNOWN)))
    }

    /// Width of a text of this size.
    pub fn width(&self, text: &str, size: f64) -> f64 {
        let metrics = self.0.glyph_metrics(Size::new(size as f32), LocationRef::default());
        self.glyphs(text).map(|glyph| f64::from(metrics.advance_width(glyph).unwrap_or(0.0))).sum()
    }

    /// The outline of a text that begins at 0, with y downward.
    pub fn outline(&self, text: &str, size: f64) -> Option<tiny_skia::Path> {
        let size = Size::new(size as f32);
        let metrics = self.0.glyph_metrics(size, LocationRef::default());
        let outlines = self.0.outline_glyphs();
        let mut pen = Pen { path: PathBuilder::new(), x: 0.0 };
        for glyph in self.glyphs(text) {
            if let Some(outline) = outlines.get(glyph) {
                let settings = DrawSettings::unhinted(size, LocationRef::default());
                // A glyph that cannot be drawn would leave a gap; ours can, a test draws them all.
                let _ = outline.draw(settings, &mut pen);
            }
            pen.x += metrics.advance_width(glyph).unwrap_or(0.0);
        }
        pen.path.finish()
    }
}

/// Fonts have y upward.
struct Pen {
    path: PathBuilder,
    x: f32,
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.x + x, -y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.x + x, -y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.path.quad_to(self.x + cx, -cy, self.x + x, -y);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.path.cubic_to(self.x + cx0, -cy0, self.x + cx1, -cy1, self.x + x, -y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_of_a_plot_can_be_drawn() {
        let letters = (' '..='~').chain("°²³µ·×⁰¹⁴⁵⁶⁷⁸⁹−…".chars());
        for font in [Font::new(false), Font::new(true)] {
            for letter in letters.clone() {
                assert!(font.0.charmap().map(letter).is_some(), "{letter:?}");
                let drawn = font.outline(&letter.to_string(), 10.0).is_some();
                assert_eq!(drawn, letter != ' ', "{letter:?}");
            }
        }
    }

    #[test]
    fn a_letter_that_is_missing_shows() {
        let font = Font::new(false);
        assert_eq!(font.width("ж", 10.0), font.width("?", 10.0));
        assert!((font.width("mm", 10.0) - 2.0 * font.width("m", 10.0)).abs() < 1e-6);
    }
}
