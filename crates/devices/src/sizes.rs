//! How big controllers are, and that they can be statics: a chip has neither an allocator nor a stack for them.

use crate::cmd4cr::Cmd4cr;
use crate::flash::{Flash, FlashError, PAGE_BYTES};
use crate::pd42::Pd42;
use crate::pmx2ed::Pmx2ed;
use crate::{Controller, ProgramRun};
use motion::{Axis, Path};
use std::sync::Mutex;

/// Flash that does not answer.
struct Silent;

impl Flash for Silent {
    fn capacity(&self) -> u32 {
        2 * PAGE_BYTES
    }

    fn read(&mut self, _: u32, _: &mut [u8]) -> Result<(), FlashError> {
        Err(FlashError::PowerLost)
    }

    fn write(&mut self, _: u32, _: &[u8]) -> Result<(), FlashError> {
        Err(FlashError::PowerLost)
    }

    fn erase(&mut self, _: u32, _: u32) -> Result<(), FlashError> {
        Err(FlashError::PowerLost)
    }
}

/// Bytes on a host with 64 bits, where room for programs and the like is taken when it is needed.
#[cfg(feature = "std")]
const CONTROLLER_BYTES: [usize; 3] = [4_100, 3_800, 6_300];
#[cfg(feature = "std")]
const AXIS_BYTES: usize = 400;
#[cfg(feature = "std")]
const PATH_BYTES: usize = 850;
/// With all that a chip sets aside; one with 32 bits takes a little less.
#[cfg(not(feature = "std"))]
const CONTROLLER_BYTES: [usize; 3] = [20_400, 23_500, 46_600];
#[cfg(not(feature = "std"))]
const AXIS_BYTES: usize = 2_400;
#[cfg(not(feature = "std"))]
const PATH_BYTES: usize = 1_300;

#[test]
fn controllers_do_not_grow_unseen() {
    for (name, size, bound) in [
        ("Pd42", size_of::<Pd42<Silent>>(), CONTROLLER_BYTES[0]),
        ("Pmx2ed", size_of::<Pmx2ed<Silent>>(), CONTROLLER_BYTES[1]),
        ("Cmd4cr", size_of::<Cmd4cr<Silent>>(), CONTROLLER_BYTES[2]),
        ("Axis", size_of::<Axis>(), AXIS_BYTES),
        ("Path", size_of::<Path<4>>(), PATH_BYTES),
    ] {
        assert!(size <= bound, "{name} has {size} bytes, more than {bound}");
        assert!(size * 10 > bound * 9, "{name} has {size} bytes, {bound} is too generous");
    }
}

#[test]
fn controllers_are_switched_on_where_they_are() {
    static PD42: Mutex<Pd42<Silent>> = Mutex::new(Pd42::off(Silent));
    static PMX2ED: Mutex<Pmx2ed<Silent>> = Mutex::new(Pmx2ed::off(Silent));
    static CMD4CR: Mutex<Cmd4cr<Silent>> = Mutex::new(Cmd4cr::off(Silent));
    let check = |controller: &dyn Controller| {
        assert_eq!(controller.program(0).map(|program| program.run), Some(ProgramRun::Idle));
    };
    let mut pd42 = PD42.lock().unwrap();
    pd42.power_on(1);
    check(&*pd42);
    let mut pmx2ed = PMX2ED.lock().unwrap();
    pmx2ed.power_on();
    check(&*pmx2ed);
    let mut cmd4cr = CMD4CR.lock().unwrap();
    cmd4cr.power_on();
    check(&*cmd4cr);
    assert_eq!((pmx2ed.number(), cmd4cr.number()), (0, 1));
}
