use super::*;
use devices::flash::FlashError::{NotErased, PowerLost, Range as OutOfRange};

const CAPACITY: u32 = 2 * PAGE_BYTES;

const WORD: usize = WORD_BYTES as usize;

#[test]
fn writing_only_clears_bits() {
    let mut flash = SharedFlash::erased(CAPACITY);
    flash.write(16, &[1, 2, 3, 4, 5, 6, 7, 8]).unwrap();
    assert_eq!(flash.write(16, &[0; WORD]), Err(NotErased));
    assert_eq!(flash.write(8, &[0; 2 * WORD]), Err(NotErased));
    let mut bytes = [0; 10];
    flash.read(15, &mut bytes).unwrap();
    assert_eq!(bytes, [0xFF, 1, 2, 3, 4, 5, 6, 7, 8, 0xFF]);
    flash.erase(0, PAGE_BYTES).unwrap();
    flash.write(16, &[0; WORD]).unwrap();
    assert_eq!(flash.operations(), 3);
}

#[test]
fn ranges_are_checked() {
    let mut flash = SharedFlash::erased(CAPACITY);
    assert_eq!(flash.write(4, &[0; WORD]), Err(OutOfRange));
    assert_eq!(flash.write(0, &[0; WORD - 4]), Err(OutOfRange));
    assert_eq!(flash.write(CAPACITY, &[0; WORD]), Err(OutOfRange));
    assert_eq!(flash.read(CAPACITY - 1, &mut [0; 2]), Err(OutOfRange));
    assert_eq!(flash.read(u32::MAX, &mut [0; 2]), Err(OutOfRange));
    assert_eq!(flash.erase(4, PAGE_BYTES), Err(OutOfRange));
    assert_eq!(flash.erase(PAGE_BYTES, 0), Err(OutOfRange));
    assert_eq!(flash.erase(0, CAPACITY + PAGE_BYTES), Err(OutOfRange));
    assert_eq!(flash.operations(), 0);
    assert_eq!(flash.write(CAPACITY, &[]), Ok(()));
}

/// A write of 16 words that is cut, for some seeds: how many words were done.
fn torn(seed: u64) -> usize {
    let mut flash = SharedFlash::erased(CAPACITY);
    flash.set_seed(seed);
    flash.cut_after(1);
    assert_eq!(flash.write(0, &[0; WORD]), Ok(()));
    assert_eq!(flash.write(64, &[0; 16 * WORD]), Err(PowerLost));
    assert_eq!(flash.read(0, &mut [0; WORD]), Err(PowerLost));
    assert_eq!(flash.write(0, &[0; WORD]), Err(PowerLost));
    assert_eq!(flash.erase(0, PAGE_BYTES), Err(PowerLost));
    assert!(flash.is_cut());
    flash.restore_power();
    let bytes = flash.to_bytes();
    assert_eq!(bytes[..WORD], [0; WORD]);
    let done = bytes[64..][..16 * WORD].iter().take_while(|byte| **byte == 0).count();
    assert!(bytes[64 + done..].iter().all(|byte| *byte == 0xFF));
    assert!(done.is_multiple_of(WORD), "words are whole");
    done / WORD
}

#[test]
fn a_cut_tears_the_operation() {
    let words: Vec<_> = (0..50).map(torn).collect();
    assert_eq!(words, (0..50).map(torn).collect::<Vec<_>>());
    assert!(words.contains(&0) && words.contains(&15) && !words.contains(&16), "{words:?}");
}

#[test]
fn a_torn_erase_leaves_the_rest() {
    let mut flash = SharedFlash::from_bytes(vec![0; CAPACITY as usize]);
    flash.set_seed(7);
    flash.cut_after(0);
    assert_eq!(flash.erase(0, PAGE_BYTES), Err(PowerLost));
    flash.restore_power();
    let erased = flash.to_bytes().iter().filter(|byte| **byte == 0xFF).count();
    assert!(erased < PAGE_BYTES as usize, "{erased}");
    assert_eq!(flash.erase(0, PAGE_BYTES), Ok(()));
}

#[test]
fn what_was_running_is_torn_and_what_waited_never_was() {
    let mut flash = SharedFlash::erased(CAPACITY);
    flash.write(0, &[0; 10 * WORD]).unwrap();
    flash.write(10 * WORD_BYTES, &[0; WORD]).unwrap();
    // Three of ten words, and a half.
    flash.set_time(175, 1_000_000);
    flash.cut_now();
    flash.restore_power();
    assert_eq!(flash.to_bytes().iter().filter(|byte| **byte == 0).count(), 3 * WORD);
}

#[test]
fn an_erase_that_was_torn_keeps_what_it_had_not_reached() {
    let mut flash = SharedFlash::from_bytes(vec![0; CAPACITY as usize]);
    flash.erase(0, PAGE_BYTES).unwrap();
    flash.write(0, &[1; WORD]).unwrap();
    flash.set_time(PAGE_ERASE_US / 2, 1_000_000);
    flash.cut_now();
    flash.restore_power();
    let bytes = flash.to_bytes();
    assert!(bytes[..2048].iter().all(|byte| *byte == 0xFF));
    assert!(bytes[2048..].iter().all(|byte| *byte == 0));
}

#[test]
fn images_survive_in_files() {
    let directory = std::env::temp_dir().join(format!("pulsetrain-flash-{}", std::process::id()));
    let path = image_path(&directory.join("state"), "stage");
    let mut flash = SharedFlash::load(&path, CAPACITY).unwrap();
    assert!(flash.to_bytes().iter().all(|byte| *byte == 0xFF), "a new image is erased");
    flash.write(0, &[1, 2, 3, 4, 5, 6, 7, 8]).unwrap();
    flash.save(&path).unwrap();
    flash.save(&path).unwrap();
    assert_eq!(SharedFlash::load(&path, CAPACITY).unwrap().to_bytes(), flash.to_bytes());
    let names: Vec<_> =
        std::fs::read_dir(path.parent().unwrap()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["stage.flash"]);

    let error = SharedFlash::load(&path, PAGE_BYTES).unwrap_err().to_string();
    assert!(error.ends_with("stage.flash: the flash image has 8192 bytes, the device 4096"), "{error}");
    let error = SharedFlash::load(&directory, CAPACITY).unwrap_err().to_string();
    assert!(!error.contains('\n'), "{error}");
    let error = flash.save(&path.join("below")).unwrap_err().to_string();
    assert!(error.contains("cannot write the flash image"), "{error}");
    std::fs::remove_dir_all(directory).unwrap();
}
