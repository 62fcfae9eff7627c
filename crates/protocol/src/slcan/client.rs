//! The client's side: what an adapter's line means.

use super::message::number;
use super::{Line, Message};

/// What an adapter says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event<'a> {
    /// The last command was executed.
    Done,
    /// The last frame is on its way to the bus.
    Sent,
    /// The last command was refused.
    Refused,
    /// A frame came from the bus, with its time stamp in milliseconds if the adapter sends them.
    Received(Message, Option<u16>),
    /// The answer to a question (`V`, `N`, `F`).
    Text(&'a [u8]),
}

impl<'a> Event<'a> {
    /// Reads a line; `None` if it is a damaged frame or too long.
    pub fn parse(line: Line<'a>) -> Option<Self> {
        let text = match line {
            Line::Text(text) => text,
            Line::Bell => return Some(Self::Refused),
            Line::TooLong => return None,
        };
        match text {
            [] => Some(Self::Done),
            [b'z' | b'Z'] => Some(Self::Sent),
            [b't' | b'T' | b'r' | b'R', ..] => {
                let (message, rest) = Message::parse(text)?;
                if rest.is_empty() {
                    return Some(Self::Received(message, None));
                }
                let (time, rest) = number(rest, 4)?;
                rest.is_empty().then_some(Self::Received(message, Some(time as u16)))
            }
            _ => Some(Self::Text(text)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::can;

    #[test]
    fn events() {
        let frame = can::Frame::new(2, &[1]).expect("valid");
        let check = |line, expected| assert_eq!(Event::parse(line), expected);
        check(Line::Text(b""), Some(Event::Done));
        check(Line::Text(b"z"), Some(Event::Sent));
        check(Line::Bell, Some(Event::Refused));
        check(Line::TooLong, None);
        check(Line::Text(b"t002101"), Some(Event::Received(Message::from(&frame), None)));
        check(Line::Text(b"t00210103EA"), Some(Event::Received(Message::from(&frame), Some(1002))));
        check(Line::Text(b"t00210"), None);
        check(Line::Text(b"t00210103"), None);
        check(Line::Text(b"V1013"), Some(Event::Text(b"V1013")));
    }
}
