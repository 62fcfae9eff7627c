//! Assembles 9-byte frames from whatever chunks a port delivers.

use super::frame::{FRAME_LENGTH, Frame};

/// How long a started frame waits for its next byte before it is thrown away.
pub const PARTIAL_FRAME_TIMEOUT_MS: u32 = 50;

/// Collects the bytes of one port. There are no start bytes in TMCL: a silence of
/// [`PARTIAL_FRAME_TIMEOUT_MS`] is what lets both sides agree again on where a frame begins.
#[derive(Clone, Copy, Debug, Default)]
pub struct Receiver {
    bytes: [u8; FRAME_LENGTH],
    length: usize,
    last: u64,
}

impl Receiver {
    /// An empty one.
    pub const fn new() -> Self {
        Self { bytes: [0; FRAME_LENGTH], length: 0, last: 0 }
    }

    /// Takes a byte that came at `now` and gives a frame if it was the ninth. `now` and `timeout` are in
    /// any one unit; a pause of `timeout` or more since the byte before starts a new frame.
    pub fn push(&mut self, byte: u8, now: u64, timeout: u64) -> Option<Frame> {
        if self.length > 0 && now.saturating_sub(self.last) >= timeout {
            self.length = 0;
        }
        self.bytes[self.length] = byte;
        self.length += 1;
        self.last = now;
        if self.length < FRAME_LENGTH {
            return None;
        }
        self.length = 0;
        Some(Frame(self.bytes))
    }

    /// Takes bytes that came together at `now`, up to the end of a frame, and takes them off the front
    /// of `bytes`. Call it until it gives `None`.
    pub fn receive(&mut self, bytes: &mut &[u8], now: u64, timeout: u64) -> Option<Frame> {
        while let Some((&byte, rest)) = bytes.split_first() {
            *bytes = rest;
            if let Some(frame) = self.push(byte, now, timeout) {
                return Some(frame);
            }
        }
        None
    }

    /// Forgets a partial frame.
    pub fn clear(&mut self) {
        self.length = 0;
    }

    /// How many bytes of a frame are waiting for the rest.
    pub const fn pending(&self) -> usize {
        self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tmcl::Request;
    use proptest::prelude::*;

    const REQUEST: Request = Request { address: 1, opcode: 6, kind: 1, motor: 0, value: 0 };

    fn frames(chunks: &[(u64, &[u8])]) -> Vec<Frame> {
        let mut receiver = Receiver::new();
        let mut frames = Vec::new();
        for &(now, mut bytes) in chunks {
            while let Some(frame) = receiver.receive(&mut bytes, now, 50) {
                frames.push(frame);
            }
        }
        frames
    }

    #[test]
    fn a_partial_frame_waits_just_under_the_timeout() {
        let frame = REQUEST.emit();
        let (head, tail) = frame.0.split_at(4);
        assert_eq!(frames(&[(0, head), (49, tail)]), [frame]);
        assert_eq!(frames(&[(0, head), (50, tail)]), []);
        assert_eq!(frames(&[(0, head), (50, &frame.0)]), [frame]);
    }

    #[test]
    fn the_timeout_counts_from_the_last_byte() {
        let frame = REQUEST.emit();
        let slow: Vec<(u64, &[u8])> =
            frame.0.chunks(1).enumerate().map(|(index, byte)| (index as u64 * 49, byte)).collect();
        assert_eq!(frames(&slow), [frame]);
    }

    #[test]
    fn two_frames_in_one_chunk() {
        let frame = REQUEST.emit();
        let twice = [frame.0, frame.0].concat();
        assert_eq!(frames(&[(7, &twice)]), [frame, frame]);
    }

    proptest! {
        /// However a stream is cut, the same frames come out.
        #[test]
        fn chunking_does_not_matter(bytes in prop::collection::vec(any::<u8>(), 0..100), cut in 1usize..20) {
            let chunks: Vec<(u64, &[u8])> = bytes.chunks(cut).map(|chunk| (0, chunk)).collect();
            let expected: Vec<Frame> =
                bytes.chunks_exact(9).map(|frame| Frame(frame.try_into().expect("nine bytes"))).collect();
            prop_assert_eq!(frames(&chunks), expected);
        }

        /// Request and reply give back every frame whose checksum is right, and name the sum otherwise.
        #[test]
        fn parse_and_emit_agree(bytes: [u8; 9]) {
            let frame = Frame(bytes);
            match Request::parse(&frame) {
                Ok(request) => prop_assert_eq!(request.emit(), frame),
                Err(error) => prop_assert_ne!(error.received, error.expected),
            }
            if let Ok(reply) = crate::tmcl::Reply::parse(&frame) {
                prop_assert_eq!(reply.emit(), frame);
            }
        }
    }
}
