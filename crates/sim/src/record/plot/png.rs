//! A page as PNG: twice as many pixels as points, for screens and for paper.

use super::{
    font::Font,
    page::{Anchor, Color, Element, Page, Place, Style, WIDTH},
};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// Pixels a point.
const SCALE: f32 = 2.0;

/// The bytes of the file, or what is wrong.
pub(super) fn png(page: &Page) -> Result<Vec<u8>, String> {
    let [width, height] = [WIDTH, page.height].map(|points| (points * f64::from(SCALE)).ceil() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or("the page is too large")?;
    pixels.fill(tiny_skia::Color::WHITE);
    let fonts = [Font::new(false), Font::new(true)];
    for element in &page.elements {
        draw(element, &fonts, &mut pixels);
    }
    pixels.encode_png().map_err(|error| error.to_string())
}

fn draw(element: &Element, fonts: &[Font; 2], pixels: &mut Pixmap) {
    let scale = Transform::from_scale(SCALE, SCALE);
    match element {
        Element::Line { places, color, width, dashed } => {
            let Some(path) = path(places, false) else { return };
            let dash = if *dashed { StrokeDash::new(vec![3.0, 3.0], 0.0) } else { None };
            let stroke =
                Stroke { width: *width as f32, line_join: LineJoin::Round, dash, ..Stroke::default() };
            pixels.stroke_path(&path, &paint(*color, 1.0), &stroke, scale, None);
        }
        Element::Area { corners, color, opacity } => {
            let Some(path) = path(corners, true) else { return };
            pixels.fill_path(&path, &paint(*color, *opacity), FillRule::Winding, scale, None);
        }
        Element::Disc { at, radius, color } => {
            let Some(path) = PathBuilder::from_circle(at.0 as f32, at.1 as f32, *radius as f32) else {
                return;
            };
            pixels.fill_path(&path, &paint(*color, 1.0), FillRule::Winding, scale, None);
        }
        Element::Text { text, at, style } => {
            let Style { size, bold, color, anchor, upright } = *style;
            let font = &fonts[usize::from(bold)];
            let Some(path) = font.outline(text, size) else { return };
            let back = match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => font.width(text, size) / 2.0,
                Anchor::End => font.width(text, size),
            };
            let turned = if upright { Transform::from_rotate(-90.0) } else { Transform::identity() };
            let placed = Transform::from_translate(-back as f32, 0.0)
                .post_concat(turned)
                .post_translate(at.0 as f32, at.1 as f32)
                .post_concat(scale);
            pixels.fill_path(&path, &paint(color, 1.0), FillRule::Winding, placed, None);
        }
    }
}

fn path(places: &[Place], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (number, (x, y)) in places.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if number == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(Color(red, green, blue): Color, opacity: f64) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (opacity * 255.0).round() as u8);
    paint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::plot::page::INK;

    #[test]
    fn what_is_on_the_page_is_in_the_picture() {
        let mut page = Page::new(20.0);
        page.rectangle((10.0, 0.0), (20.0, 20.0), Color(255, 0, 0), 1.0);
        page.text("H", (100.0, 10.0), Style::new(20.0).anchor(Anchor::Middle));
        let picture = Pixmap::decode_png(&png(&page).unwrap()).unwrap();
        assert_eq!((picture.width(), picture.height()), (1600, 40));
        let pixel = |x, y| {
            let pixel = picture.pixel(x, y).unwrap();
            Color(pixel.red(), pixel.green(), pixel.blue())
        };
        assert_eq!(pixel(30, 20), Color(255, 0, 0));
        assert_eq!(pixel(18, 20), Color(255, 255, 255));
        // The bar of the letter is in the middle, the room above it empty.
        assert_eq!(pixel(200, 20), INK);
        assert_eq!(pixel(200, 10), Color(255, 255, 255));
    }
}
