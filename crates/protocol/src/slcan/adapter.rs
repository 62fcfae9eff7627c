//! The adapter's side: what each line does and how it is answered.

use super::message::{number, put};
use super::{BELL, CARRIAGE_RETURN, Identifier, Line, Message, Text};
use crate::can;

/// Time stamps count milliseconds and start again after a minute.
const TIMESTAMP_PERIOD_MS: u64 = 60_000;

/// How the bus timing was set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bitrate {
    /// `S`: bits a second.
    Standard(u32),
    /// `s`: the two timing registers of an SJA1000.
    Registers(u8, u8),
}

/// Whether the adapter is on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channel {
    /// It is not.
    Closed,
    /// It sends and receives.
    Open,
    /// It receives only.
    ListenOnly,
}

/// What comes of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Bytes to send back.
    pub reply: Text,
    /// A frame to put on the bus. Extended and remote frames can be sent, but no TMCL module hears them.
    pub transmit: Option<Message>,
}

/// The state of an adapter.
///
/// Frames from the bus are always passed on without being asked for, and acceptance filters (`M`, `m`)
/// are accepted but let everything pass: the bus behind it is small.
#[derive(Clone, Debug)]
pub struct Adapter {
    channel: Channel,
    bitrate: Option<Bitrate>,
    timestamps: bool,
}

impl Default for Adapter {
    fn default() -> Self {
        Self::new()
    }
}

impl Adapter {
    /// One that has just been plugged in: closed, without a bit rate.
    pub const fn new() -> Self {
        Self { channel: Channel::Closed, bitrate: None, timestamps: false }
    }

    /// Whether it is on the bus.
    pub const fn channel(&self) -> Channel {
        self.channel
    }

    /// The bit rate that was set, if any.
    pub const fn bitrate(&self) -> Option<Bitrate> {
        self.bitrate
    }

    /// Executes a line.
    pub fn execute(&mut self, line: Line<'_>) -> Answer {
        let mut reply = Text::new();
        let mut transmit = None;
        let understood = match line {
            Line::Text(text) => self.command(text, &mut reply, &mut transmit),
            Line::Bell => return Answer { reply, transmit },
            Line::TooLong => None,
        };
        match understood {
            Some(()) => put(&mut reply, CARRIAGE_RETURN),
            None => {
                reply.clear();
                put(&mut reply, BELL);
            }
        }
        Answer { reply, transmit }
    }

    /// The line that tells the client of a frame on the bus at `time_ms`; `None` while the channel is
    /// closed.
    pub fn received(&self, frame: &can::Frame, time_ms: u64) -> Option<Text> {
        if self.channel == Channel::Closed {
            return None;
        }
        let time = self.timestamps.then_some((time_ms % TIMESTAMP_PERIOD_MS) as u16);
        Some(Message::from(frame).emit(time))
    }

    /// `None` refuses the line.
    fn command(&mut self, line: &[u8], reply: &mut Text, transmit: &mut Option<Message>) -> Option<()> {
        let Some((&command, arguments)) = line.split_first() else {
            // An empty line only asks for a sign of life.
            return Some(());
        };
        let closed = (self.channel == Channel::Closed).then_some(());
        let opened = (self.channel != Channel::Closed).then_some(());
        match (command, arguments) {
            (b'S', &[digit]) => {
                let rate = *BITRATES.get(usize::from(digit.checked_sub(b'0')?))?;
                closed?;
                self.bitrate = Some(Bitrate::Standard(rate));
            }
            (b's', _) => {
                let (first, rest) = number(arguments, 2)?;
                let (second, rest) = number(rest, 2)?;
                rest.is_empty().then_some(())?;
                closed?;
                self.bitrate = Some(Bitrate::Registers(first as u8, second as u8));
            }
            (b'O', []) => {
                closed?;
                self.channel = Channel::Open;
            }
            (b'L', []) => {
                closed?;
                self.channel = Channel::ListenOnly;
            }
            (b'C', []) => {
                opened?;
                self.channel = Channel::Closed;
            }
            (b't' | b'T' | b'r' | b'R', _) => {
                let (message, rest) = Message::parse(line)?;
                rest.is_empty().then_some(())?;
                (self.channel == Channel::Open).then_some(())?;
                *transmit = Some(message);
                put(reply, if matches!(message.identifier, Identifier::Standard(_)) { b'z' } else { b'Z' });
            }
            (b'V', []) => append(reply, b"V1013"),
            (b'v', []) => append(reply, b"v1013"),
            (b'N', []) => append(reply, b"NPTRN"),
            (b'F', []) => {
                opened?;
                append(reply, b"F00");
            }
            (b'Z', [digit @ (b'0' | b'1')]) => {
                closed?;
                self.timestamps = *digit == b'1';
            }
            (b'X', [b'0' | b'1']) => (),
            (b'M' | b'm', _) => {
                let (_, rest) = number(arguments, 8)?;
                rest.is_empty().then_some(())?;
                closed?;
            }
            _ => return None,
        }
        Some(())
    }
}

/// The bit rates of `S0` to `S8`.
const BITRATES: [u32; 9] = [10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 800_000, 1_000_000];

fn append(text: &mut Text, bytes: &[u8]) {
    bytes.iter().for_each(|&byte| put(text, byte));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slcan::Lines;
    use proptest::prelude::*;

    /// Everything that is sent back, and how many frames went to the bus.
    fn session(adapter: &mut Adapter, input: &[u8]) -> (Vec<u8>, usize) {
        let mut lines = Lines::new();
        let (mut output, mut frames) = (Vec::new(), 0);
        for &byte in input {
            if let Some(line) = lines.push(byte) {
                let answer = adapter.execute(line);
                output.extend_from_slice(&answer.reply);
                frames += usize::from(answer.transmit.is_some());
            }
        }
        (output, frames)
    }

    #[test]
    fn sessions() {
        let check = |input: &[u8], output: &[u8], frames: usize| {
            let result = session(&mut Adapter::new(), input);
            assert_eq!(result, (output.to_vec(), frames), "{}", input.escape_ascii());
        };
        // What python-can sends when it opens the adapter, and a TMCL request.
        check(b"C\rS8\r\rO\rO\rt0017060100FFFFFFFE\r", b"\x07\r\r\r\x07z\r", 1);
        check(b"O\rS8\rZ1\rM00000000\rC\rS8\rZ1\rM00000000\rmFFFFFFFF\r", b"\r\x07\x07\x07\r\r\r\r\r", 0);
        check(b"t0010\rL\rt0010\r", b"\x07\r\x07", 0);
        check(b"O\rT000000010\rr0018\rR000000018\r", b"\rZ\rz\rZ\r", 3);
        check(b"V\rv\rN\rF\rO\rF\r", b"V1013\rv1013\rNPTRN\r\x07\rF00\r", 0);
        check(b"S9\rS\rS10\rs031C\rs03\rX1\rq\r", b"\x07\x07\x07\r\x07\r\x07", 0);
        check(b"O\rt00100\rt00\r", b"\r\x07\x07", 0);
        check(&b"x".repeat(40), b"", 0);
        check(&[b"x".repeat(40), b"\rV\r".to_vec()].concat(), b"\x07V1013\r", 0);
    }

    #[test]
    fn the_bit_rate_is_known() {
        let mut adapter = Adapter::new();
        session(&mut adapter, b"S6\r");
        assert_eq!(adapter.bitrate(), Some(Bitrate::Standard(500_000)));
        session(&mut adapter, b"s031C\r");
        assert_eq!(adapter.bitrate(), Some(Bitrate::Registers(3, 0x1C)));
    }

    #[test]
    fn frames_from_the_bus() {
        let frame = can::Frame::new(2, &[1, 100, 6, 0, 0, 0, 1]).expect("valid");
        let check = |input: &[u8], expected: Option<&[u8]>| {
            let mut adapter = Adapter::new();
            session(&mut adapter, input);
            assert_eq!(adapter.received(&frame, 61_002).as_deref(), expected);
        };
        check(b"", None);
        check(b"O\r", Some(b"t002701640600000001\r"));
        check(b"L\r", Some(b"t002701640600000001\r"));
        check(b"Z1\rO\r", Some(b"t00270164060000000103EA\r"));
        check(b"O\rC\r", None);
    }

    proptest! {
        #[test]
        fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            session(&mut Adapter::new(), &bytes);
        }
    }
}
