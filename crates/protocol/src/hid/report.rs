//! Reports as they travel: cut out of a stream, or with the ID that libraries for HID put before them.

use super::{ApiError, Packet};
use crate::performax::PACKET_LENGTH;

/// The only report ID: that of a device whose reports have none.
const REPORT_ID: u8 = 0;

/// Bytes of a report with its ID.
pub const FRAME_LENGTH: usize = 1 + PACKET_LENGTH;

/// A report with the ID before it, as libraries for HID want it for writing.
pub fn frame(packet: &Packet) -> [u8; FRAME_LENGTH] {
    let mut bytes = [REPORT_ID; FRAME_LENGTH];
    bytes[1..].copy_from_slice(&packet.0);
    bytes
}

/// The report that was read, with the ID before it or without: libraries differ.
///
/// # Errors
/// [`ApiError::ReportId`], [`ApiError::ReportSize`].
pub fn unframe(bytes: &[u8]) -> Result<Packet, ApiError> {
    let report = match bytes {
        [id, report @ ..] if bytes.len() == FRAME_LENGTH => match *id {
            REPORT_ID => report,
            _ => return Err(ApiError::ReportId),
        },
        report => report,
    };
    report.try_into().map(Packet).map_err(|_| ApiError::ReportSize)
}

/// Cuts a stream of bytes into reports, which follow each other in it without anything between.
#[derive(Clone, Debug)]
pub struct Reports {
    bytes: [u8; PACKET_LENGTH],
    length: usize,
}

impl Default for Reports {
    fn default() -> Self {
        Self::new()
    }
}

impl Reports {
    /// At the beginning of a stream.
    pub const fn new() -> Self {
        Self { bytes: [0; PACKET_LENGTH], length: 0 }
    }

    /// Takes a byte and gives the report that it completes, if any.
    pub fn push(&mut self, byte: u8) -> Option<Packet> {
        self.bytes[self.length] = byte;
        self.length = (self.length + 1) % PACKET_LENGTH;
        (self.length == 0).then_some(Packet(self.bytes))
    }

    /// Whether the stream stands between two reports.
    pub const fn is_empty(&self) -> bool {
        self.length == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn frames() {
        let packet = Packet::encode("PX").unwrap();
        let framed = frame(&packet);
        assert_eq!(framed[..4], *b"\0PX\0");
        assert_eq!(framed.len(), 65);
        let check = |bytes: &[u8], expected| assert_eq!(unframe(bytes), expected);
        check(&framed, Ok(packet));
        check(&packet.0, Ok(packet));
        check(&framed[..63], Err(ApiError::ReportSize));
        check(&[framed.as_slice(), &[0]].concat(), Err(ApiError::ReportSize));
        check(&[], Err(ApiError::ReportSize));
        check(&[[1].as_slice(), &packet.0].concat(), Err(ApiError::ReportId));
        // Without an ID the first byte is text.
        let full = Packet([b'V'; PACKET_LENGTH]);
        check(&full.0, Ok(full));
    }

    proptest! {
        #[test]
        fn streams_are_cut_every_64_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            let mut reports = Reports::new();
            let got: Vec<Packet> = bytes.iter().filter_map(|byte| reports.push(*byte)).collect();
            let (whole, rest) = bytes.as_chunks::<PACKET_LENGTH>();
            prop_assert_eq!(got, whole.iter().copied().map(Packet).collect::<Vec<_>>());
            prop_assert_eq!(reports.is_empty(), rest.is_empty());
        }
    }
}
