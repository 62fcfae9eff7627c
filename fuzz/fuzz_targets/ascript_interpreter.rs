//! Made-up programs do the same in the virtual machine as in an interpreter of their statements.
#![no_main]

use ascript::dialect::{COMMANDER, PERFORMAX_2};
use ascript::reference::{Choices, compare, program};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|choices: &[u8]| {
    for dialect in [&PERFORMAX_2, &COMMANDER] {
        compare(&program(&mut Choices::new(choices), dialect), dialect);
    }
});
