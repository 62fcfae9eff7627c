//! Classic CAN data frames with an 11-bit identifier, and their flat form at a controller's port.
//!
//! The flat form of a frame is two bytes of identifier, MSB first, then its data. One chunk of bytes is
//! one frame, so no length is needed.

use core::fmt;

/// The largest 11-bit identifier.
pub const MAX_ID: u16 = 0x7FF;

/// Most data bytes in a frame.
pub const MAX_DATA: usize = 8;

/// Most bytes in the flat form.
pub const MAX_FLAT: usize = 2 + MAX_DATA;

/// A data frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Frame {
    id: u16,
    length: u8,
    data: [u8; MAX_DATA],
}

/// Why bytes are not a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameError {
    /// Fewer than two or more than [`MAX_FLAT`] bytes, or more than [`MAX_DATA`] data bytes.
    Length,
    /// The identifier is above [`MAX_ID`].
    Identifier,
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Length => "a CAN frame has 0 to 8 data bytes",
            Self::Identifier => "the CAN identifier is above 7FFh",
        })
    }
}

impl core::error::Error for FrameError {}

impl Frame {
    /// A frame of this identifier and data.
    pub fn new(id: u16, data: &[u8]) -> Result<Self, FrameError> {
        if id > MAX_ID {
            return Err(FrameError::Identifier);
        }
        let mut bytes = [0; MAX_DATA];
        bytes.get_mut(..data.len()).ok_or(FrameError::Length)?.copy_from_slice(data);
        Ok(Self { id, length: data.len() as u8, data: bytes })
    }

    /// Its identifier, at most [`MAX_ID`].
    pub const fn id(&self) -> u16 {
        self.id
    }

    /// Its data, at most [`MAX_DATA`] bytes.
    pub fn data(&self) -> &[u8] {
        &self.data[..usize::from(self.length)]
    }

    /// Reads the flat form.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (id, data) = bytes.split_first_chunk().ok_or(FrameError::Length)?;
        Self::new(u16::from_be_bytes(*id), data)
    }

    /// Writes the flat form into `buffer` and gives the part that was used.
    pub fn encode<'a>(&self, buffer: &'a mut [u8; MAX_FLAT]) -> &'a [u8] {
        let (id, data) = buffer.split_at_mut(2);
        id.copy_from_slice(&self.id.to_be_bytes());
        data.copy_from_slice(&self.data);
        &buffer[..2 + usize::from(self.length)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn flat_form() {
        let check = |bytes: &[u8], expected: Result<(u16, &[u8]), FrameError>| {
            let frame = Frame::decode(bytes);
            assert_eq!(frame.as_ref().map(|frame| (frame.id(), frame.data())), expected.as_ref().copied());
            if let Ok(frame) = frame {
                assert_eq!(frame.encode(&mut [0; MAX_FLAT]), bytes);
            }
        };
        check(&[0, 1], Ok((1, &[])));
        check(&[7, 0xFF, 1, 2, 3], Ok((0x7FF, &[1, 2, 3])));
        check(&[0, 2, 1, 2, 3, 4, 5, 6, 7, 8], Ok((2, &[1, 2, 3, 4, 5, 6, 7, 8])));
        check(&[0, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9], Err(FrameError::Length));
        check(&[], Err(FrameError::Length));
        check(&[0], Err(FrameError::Length));
        check(&[8, 0], Err(FrameError::Identifier));
    }

    proptest! {
        #[test]
        fn decode_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..20)) {
            if let Ok(frame) = Frame::decode(&bytes) {
                let mut buffer = [0; MAX_FLAT];
                prop_assert_eq!(frame.encode(&mut buffer), &bytes[..]);
            }
        }
    }
}
