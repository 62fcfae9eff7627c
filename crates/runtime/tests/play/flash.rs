//! Pages for settings, and the cause of the last stop.

use crate::memory::{Memory, Refusal};
use devices::flash::{Flash, FlashError, PAGE_BYTES, WORD_BYTES};
use devices::{Controller, pd42};
use runtime::Pages;
use runtime::fault::{self, MAX_CAUSE};

const SMALL: u32 = 2048;

/// What [`Flash`] promises, on a chip with smaller words and pages and something else before and behind.
#[test]
fn pages_are_flash() {
    let mut memory = Memory::<4, 2048>::new(4 * PAGE_BYTES);
    memory.bytes.fill(0x55);
    let mut pages = Pages::new(memory, SMALL, 2 * PAGE_BYTES);
    assert_eq!(pages.capacity(), 2 * PAGE_BYTES);
    let end = 2 * PAGE_BYTES;
    pages.erase(0, end).unwrap();
    let word = [7; WORD_BYTES as usize];
    let check = |result: Result<(), FlashError>, expected| assert_eq!(result, expected);
    check(pages.write(end - WORD_BYTES, &word), Ok(()));
    check(pages.write(0, &[word, word].concat()), Ok(()));
    check(pages.write(0, &word), Err(FlashError::NotErased));
    check(pages.write(end, &word), Err(FlashError::Range));
    check(pages.write(end - WORD_BYTES, &[word, word].concat()), Err(FlashError::Range));
    check(pages.write(1, &word), Err(FlashError::Range));
    check(pages.write(WORD_BYTES, &word[1..]), Err(FlashError::Range));
    check(pages.write(u32::MAX - 3, &word), Err(FlashError::Range));
    check(pages.erase(0, SMALL), Err(FlashError::Range));
    check(pages.erase(PAGE_BYTES, 0), Err(FlashError::Range));
    check(pages.erase(0, end + PAGE_BYTES), Err(FlashError::Range));
    let mut bytes = [0; 3];
    check(pages.read(end - 2, &mut bytes), Err(FlashError::Range));
    check(pages.read(u32::MAX, &mut bytes), Err(FlashError::Range));
    check(pages.read(end - WORD_BYTES - 2, &mut bytes), Ok(()));
    assert_eq!(bytes, [0xFF, 0xFF, 7]);
    check(pages.erase(PAGE_BYTES, end), Ok(()));
    check(pages.read(end - WORD_BYTES - 2, &mut bytes), Ok(()));
    assert_eq!(bytes, [0xFF; 3]);
    check(pages.read(0, &mut bytes), Ok(()));
    assert_eq!(bytes, [7; 3]);
}

#[test]
fn only_its_pages_are_touched() {
    let mut memory = Memory::<4, 2048>::new(4 * PAGE_BYTES);
    memory.bytes.fill(0x55);
    {
        let mut pages = Pages::new(&mut memory, SMALL, 2 * PAGE_BYTES);
        pages.erase(0, 2 * PAGE_BYTES).unwrap();
        pages.write(0, &[0; 4096]).unwrap();
    }
    let (begin, end) = (SMALL as usize, (SMALL + 2 * PAGE_BYTES) as usize);
    assert!(memory.bytes[..begin].iter().chain(&memory.bytes[end..]).all(|byte| *byte == 0x55));
    assert!(memory.bytes[begin..end].iter().all(|byte| *byte != 0x55));
}

/// A module keeps its settings in them.
#[test]
fn settings_outlive_the_power() {
    let mut memory = Memory::<4, 1024>::new(pd42::FLASH_BYTES);
    let (set, ask) = (crate::session::tmcl(9, 66, 7), crate::session::tmcl(10, 66, 0));
    for (command, value) in [(ask, 1), (set, 7), (ask, 7)] {
        let mut module = pd42::Pd42::new(Pages::new(&mut memory, 0, pd42::FLASH_BYTES), 1);
        let mut board = Board(Vec::new());
        module.receive(devices::Port::Usb, &command, &mut board);
        assert_eq!(board.0[4..8], i32::to_be_bytes(value), "{:?}", board.0);
    }
}

/// A board with one port.
struct Board(Vec<u8>);

impl devices::Board for Board {
    fn clock(&mut self, _: u64) {}
    fn pulses(&mut self, _: usize, _: &motion::Train) {}
    fn drive(&mut self, _: usize, _: devices::Drive) {}
    fn send(&mut self, _: devices::Port, bytes: &[u8], _: u32) {
        self.0.extend(bytes);
    }
    fn output(&mut self, _: usize, _: bool) {}
    fn release(&mut self, _: usize) {}
    fn output_analog(&mut self, _: usize, _: i32) {}
    fn encoder(&mut self, _: usize) -> i32 {
        0
    }
    fn digital(&mut self, _: usize) -> bool {
        false
    }
    fn load(&mut self, _: usize) -> u16 {
        0
    }
    fn analog(&mut self, _: usize) -> i32 {
        0
    }
}

/// The page of the cause, with another one before it.
const PAGE: u32 = 2048;

fn page() -> Memory<8, 2048> {
    Memory::new(2 * PAGE)
}

#[test]
fn a_cause_is_reported_once() {
    fn check(cause: &str, expected: &str) {
        let mut memory = page();
        memory.bytes[PAGE as usize..].fill(0);
        assert_eq!(fault::take(&mut memory, PAGE), Ok(None), "what is no record is no cause");
        fault::store(&mut memory, PAGE, &cause).unwrap();
        assert_eq!(fault::take(&mut memory, PAGE).unwrap().unwrap(), expected);
        assert_eq!(fault::take(&mut memory, PAGE), Ok(None));
        assert_eq!(fault::read(&mut memory, PAGE).unwrap().unwrap(), expected);
        fault::store(&mut memory, PAGE, &"another").unwrap();
        assert_eq!(fault::take(&mut memory, PAGE).unwrap().unwrap(), "another");
        assert!(memory.bytes[..PAGE as usize].iter().all(|byte| *byte == 0xFF));
    }
    check("time moves forward (motion/src/axis.rs:274)", "time moves forward (motion/src/axis.rs:274)");
    check("", "");
    check("12345678", "12345678");
    check("two\nlines\0", "two lines ");
    check(&"x".repeat(MAX_CAUSE), &"x".repeat(MAX_CAUSE));
    check(&"x".repeat(1000), &"x".repeat(MAX_CAUSE));
    // A character that does not fit as a whole ends the text.
    check(&format!("{}µ", "x".repeat(MAX_CAUSE - 1)), &"x".repeat(MAX_CAUSE - 1));
}

/// The power goes after any number of operations of storing and taking: the cause is there or not, never a part of
/// it; and a word that was being written may be anything.
#[test]
fn a_cause_is_whole_or_not_there() {
    let text = "time moves forward (motion/src/axis.rs:274)";
    let mut old = page();
    fault::store(&mut old, PAGE, &"the one before").unwrap();
    let operations = 1 + text.len().div_ceil(8) + 1;
    for cut in 0..=operations {
        for torn in [0x00, 0xF0, 0xA5, 0xFF] {
            let mut memory = old.clone();
            memory.left = cut;
            memory.torn = Some(torn);
            let stored = fault::store(&mut memory, PAGE, &text);
            assert_eq!(stored, if cut < operations { Err(Refusal::PowerLost) } else { Ok(()) });
            memory.left = usize::MAX;
            let cause = fault::read(&mut memory, PAGE).unwrap();
            let expected: &[Option<&str>] = match cut {
                0 => &[Some("the one before"), None],
                _ if cut < operations => &[None],
                _ => &[Some(text)],
            };
            assert!(expected.contains(&cause.as_deref()), "{cause:?} after {cut}");
            memory.left = 0;
            let taken = fault::take(&mut memory, PAGE);
            memory.left = usize::MAX;
            if cause.is_some() {
                assert_eq!(taken, Err(Refusal::PowerLost));
                let again = fault::take(&mut memory, PAGE).unwrap();
                assert!(again.is_none() || again == cause);
                assert_eq!(fault::take(&mut memory, PAGE), Ok(None));
            }
        }
    }
}
