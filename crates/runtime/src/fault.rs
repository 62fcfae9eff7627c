//! Why the firmware stopped the last time, in a flash page of its own.
//!
//! A panic handler [stores](store) the cause, the next start [takes](take) it. The page begins with a head that is
//! written last, so that a cause is there as a whole or not at all; then come the text, and at its end a mark that it
//! was taken. Until the next one is stored it can be [read] all the same.

use core::fmt::{self, Display, Write as _};
use embedded_storage::nor_flash::NorFlash;

/// The most bytes of a cause; more is left out.
pub const MAX_CAUSE: usize = 240;

/// The text of a cause.
pub type Cause = heapless::String<MAX_CAUSE>;

/// Bytes that are written at a time: a multiple of every chip's word.
const WORD: usize = 8;

/// Where the parts of the record are in the page.
const TEXT: u32 = WORD as u32;
const MARK: u32 = TEXT + MAX_CAUSE as u32;

/// Bytes of the record.
pub const RECORD_BYTES: u32 = MARK + WORD as u32;

/// The head begins with this; the length and a checksum follow.
const MAGIC: [u8; 2] = *b"!P";

/// Stores a cause in the page that begins at `page`. Whatever is after the most bytes is left out, and what is not
/// printable becomes a space.
///
/// # Errors
/// Those of the flash. There is no cause then.
pub fn store<F: NorFlash>(flash: &mut F, page: u32, cause: &dyn Display) -> Result<(), F::Error> {
    const {
        assert!(WORD.is_multiple_of(F::WRITE_SIZE), "words do not divide ours");
        assert!(F::ERASE_SIZE >= RECORD_BYTES as usize, "the page is too small");
    }
    flash.erase(page, page + F::ERASE_SIZE as u32)?;
    let mut text = Text { flash, at: page + TEXT, word: [0; WORD], length: 0, sum: SUM, failed: None };
    // A text that breaks off is one that is full or could not be written.
    let _ = write!(text, "{cause}");
    text.write_out();
    let Text { length, sum, failed, .. } = text;
    if let Some(error) = failed {
        return Err(error);
    }
    let [a, b, c, d] = sum.to_le_bytes();
    flash.write(page, &[MAGIC[0], MAGIC[1], length as u8, 0xFF, a, b, c, d])
}

/// The cause that was stored last, if it was not taken yet.
///
/// # Errors
/// Those of the flash.
pub fn take<F: NorFlash>(flash: &mut F, page: u32) -> Result<Option<Cause>, F::Error> {
    let mut mark = [0; WORD];
    flash.read(page + MARK, &mut mark)?;
    let cause = if mark == [0xFF; WORD] { read(flash, page)? } else { None };
    if cause.is_some() {
        flash.write(page + MARK, &[0; WORD])?;
    }
    Ok(cause)
}

/// The cause that was stored last, taken or not.
///
/// # Errors
/// Those of the flash.
pub fn read<F: NorFlash>(flash: &mut F, page: u32) -> Result<Option<Cause>, F::Error> {
    let (mut head, mut text) = ([0; WORD], [0; MAX_CAUSE]);
    flash.read(page, &mut head)?;
    flash.read(page + TEXT, &mut text)?;
    let [m, n, length, _, a, b, c, d] = head;
    let text = text.get(..length.into()).filter(|_| [m, n] == MAGIC);
    let text = text.filter(|text| text.iter().fold(SUM, add) == u32::from_le_bytes([a, b, c, d]));
    let text = text.and_then(|text| str::from_utf8(text).ok());
    Ok(text.and_then(|text| Cause::try_from(text).ok()))
}

/// The checksum of nothing (FNV-1a).
const SUM: u32 = 0x811C_9DC5;

fn add(sum: u32, byte: &u8) -> u32 {
    (sum ^ u32::from(*byte)).wrapping_mul(0x0100_0193)
}

/// A text on its way into flash, word by word: a stack that has run over has little room.
struct Text<'f, F: NorFlash> {
    flash: &'f mut F,
    at: u32,
    word: [u8; WORD],
    length: usize,
    sum: u32,
    failed: Option<F::Error>,
}

impl<F: NorFlash> Text<'_, F> {
    fn push(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.sum = add(self.sum, byte);
            self.word[self.length % WORD] = *byte;
            self.length += 1;
            if self.length.is_multiple_of(WORD) {
                self.write_out();
            }
        }
    }

    /// Writes the word, if there is anything in it.
    fn write_out(&mut self) {
        let filled = self.word != [0; WORD];
        if filled && self.failed.is_none() {
            self.failed = self.flash.write(self.at, &self.word).err();
            self.at += WORD as u32;
        }
        self.word = [0; WORD];
    }
}

impl<F: NorFlash> fmt::Write for Text<'_, F> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for letter in text.chars() {
            let letter = if letter.is_control() { ' ' } else { letter };
            let mut bytes = [0; 4];
            let bytes = letter.encode_utf8(&mut bytes).as_bytes();
            if self.length + bytes.len() > MAX_CAUSE || self.failed.is_some() {
                return Err(fmt::Error);
            }
            self.push(bytes);
        }
        Ok(())
    }
}
