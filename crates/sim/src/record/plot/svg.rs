//! A page as SVG. Text stays text, so that it can be searched and edited; it is drawn in the font of the reader's
//! system that comes closest.

use super::page::{Anchor, Color, Element, Page, Place, Style, WIDTH};
use std::fmt::{self, Write};

const FONTS: &str = "Inter, 'Helvetica Neue', Helvetica, Arial, sans-serif";

/// The text of the file.
pub(super) fn svg(page: &Page) -> String {
    let mut text = String::new();
    write(page, &mut text).expect("a string takes everything");
    text
}

fn write(page: &Page, to: &mut String) -> fmt::Result {
    let height = Number(page.height);
    writeln!(
        to,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" font-family=\"{FONTS}\">"
    )?;
    writeln!(to, "<rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#fff\"/>")?;
    for element in &page.elements {
        match element {
            Element::Line { places, color, width, dashed } => {
                let dashes = if *dashed { " stroke-dasharray=\"3 3\"" } else { "" };
                let width = Number(*width);
                writeln!(
                    to,
                    "<polyline fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
                     stroke-linejoin=\"round\"{dashes} points=\"{}\"/>",
                    Places(places)
                )?;
            }
            Element::Area { corners, color, opacity } => {
                let through = if *opacity < 1.0 {
                    format!(" fill-opacity=\"{}\"", Number(*opacity))
                } else {
                    String::new()
                };
                writeln!(to, "<polygon fill=\"{color}\"{through} points=\"{}\"/>", Places(corners))?;
            }
            Element::Disc { at: (x, y), radius, color } => {
                let [x, y, radius] = [*x, *y, *radius].map(Number);
                writeln!(to, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{color}\"/>")?;
            }
            Element::Text { text, at, style } => write_text(text, *at, *style, to)?,
        }
    }
    writeln!(to, "</svg>")
}

fn write_text(text: &str, (x, y): Place, style: Style, to: &mut String) -> fmt::Result {
    let Style { size, bold, color, anchor, upright } = style;
    let [x, y, size] = [x, y, size].map(Number);
    let anchor = match anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let weight = if bold { " font-weight=\"600\"" } else { "" };
    let place = if upright {
        format!("transform=\"translate({x} {y}) rotate(-90)\"")
    } else {
        format!("x=\"{x}\" y=\"{y}\"")
    };
    write!(to, "<text {place} font-size=\"{size}\"{weight} fill=\"{color}\"{anchor}>")?;
    for letter in text.chars() {
        match letter {
            '<' => to.push_str("&lt;"),
            '&' => to.push_str("&amp;"),
            '>' => to.push_str("&gt;"),
            // Nothing else below a space may stand in XML.
            letter if letter < ' ' => to.push(' '),
            letter => to.push(letter),
        }
    }
    writeln!(to, "</text>")
}

/// A number with at most two digits behind the point.
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding 0 turns −0 into 0.
        write!(to, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

struct Places<'a>(&'a [Place]);

impl fmt::Display for Places<'_> {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, (x, y)) in self.0.iter().enumerate() {
            let gap = if number == 0 { "" } else { " " };
            write!(to, "{gap}{},{}", Number(*x), Number(*y))?;
        }
        Ok(())
    }
}

impl fmt::Display for Color {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(red, green, blue) = self;
        write!(to, "#{red:02x}{green:02x}{blue:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_plain_text() {
        let mut page = Page::new(10.5);
        page.line([(0.0, 1.0), (2.345, -0.001)], Color(1, 2, 255), 0.5);
        page.rectangle((0.0, 0.0), (1.0, 1.0), Color(0, 0, 0), 0.25);
        page.text("a < b & c\n", (4.0, 5.0), Style::new(10.0).anchor(Anchor::End));
        let expected = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" height=\"10.5\" \
            viewBox=\"0 0 800 10.5\" font-family=\"Inter, 'Helvetica Neue', Helvetica, Arial, sans-serif\">\n\
            <rect width=\"800\" height=\"10.5\" fill=\"#fff\"/>\n\
            <polyline fill=\"none\" stroke=\"#0102ff\" stroke-width=\"0.5\" stroke-linejoin=\"round\" \
            points=\"0,1 2.35,0\"/>\n\
            <polygon fill=\"#000000\" fill-opacity=\"0.25\" points=\"0,0 1,0 1,1 0,1\"/>\n\
            <text x=\"4\" y=\"8.64\" font-size=\"10\" fill=\"#262a30\" text-anchor=\"end\">a &lt; b &amp; c </text>\n\
            </svg>\n";
        assert_eq!(svg(&page), expected);
    }
}
