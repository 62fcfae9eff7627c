//! The end: a failed assertion or a fault stops pulses and motors, and stores why. The board then stays as it is until
//! somebody resets it: a motor must not start again by itself.

use crate::board;
use core::fmt::{self, Display};
use core::panic::PanicInfo;
use core::sync::atomic::{AtomicBool, Ordering};
use cortex_m::peripheral::{MPU, SCB};

#[allow(unsafe_code)]
// SAFETY: the linker script has it; only its address is of use.
unsafe extern "C" {
    static _stack_end: u32;
}

/// Bytes below the stack that nobody may touch: more than any function has on it.
const GUARD_BYTES: u32 = 1 << GUARD_BITS;
const GUARD_BITS: u32 = 15;

/// Makes a stack that runs over a fault, whatever the chip has below it: region 0 of the memory protection unit allows
/// nothing there, and outside of it all is as without the unit (Armv7-M manual, B3.5).
pub fn guard_stack() {
    let bottom = (&raw const _stack_end).addr() as u32;
    assert!(bottom.is_multiple_of(GUARD_BYTES), "a region begins at a multiple of its size");
    // SAFETY: the program has nothing below its stack.
    #[allow(unsafe_code)]
    unsafe {
        let mpu = &*MPU::PTR;
        mpu.rbar.write((bottom - GUARD_BYTES) | 1 << 4);
        mpu.rasr.write(1 << 28 | (GUARD_BITS - 1) << 1 | 1);
        mpu.ctrl.write(1 << 2 | 1);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}

/// Stops and stores the cause; if that fails too, it just stops.
fn stop(cause: &dyn Display) -> ! {
    static STOPPED: AtomicBool = AtomicBool::new(false);
    board::stop();
    if !STOPPED.swap(true, Ordering::Relaxed)
        && let Some(mut causes) = board::causes_after_stop()
    {
        // There is nobody left to be told.
        let _ = runtime::fault::store(&mut causes, 0, cause);
    }
    board::stay_stopped()
}

/// A failed assertion, as one line.
struct Assertion<'p>(&'p PanicInfo<'p>);

impl Display for Assertion<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.message())?;
        let Some(place) = self.0.location() else { return Ok(()) };
        // Where the project lay when it was built is of no interest.
        let file = place.file().rsplit_once("crates/").map_or(place.file(), |(_, file)| file);
        write!(f, " ({file}:{})", place.line())
    }
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    stop(&Assertion(info))
}

/// A fault of the core: where, and the registers that say why.
struct Fault {
    /// The instruction; 0 if the stack has run over.
    at: u32,
    status: u32,
    address: u32,
}

/// Kinds of faults by bits of the status register, and the bit that says whether there is an address.
const KINDS: [(&str, u32, u32); 3] = [
    ("memory fault", 0x0000_007F, 1 << 7),
    ("bus fault", 0x0000_7F00, 1 << 15),
    ("usage fault", 0xFFFF_0000, 0),
];

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.at == 0 {
            return f.write_str("the stack has run over");
        }
        let kind = KINDS.iter().find(|(_, bits, _)| self.status & bits != 0);
        let (name, _, addressed) = kind.unwrap_or(&("hard fault", 0, 0));
        write!(f, "{name} at {:#010x}", self.at)?;
        if self.status & addressed != 0 {
            write!(f, ", address {:#010x}", self.address)?;
        }
        Ok(())
    }
}

/// The core's fault handler. The stack may be no more: this takes what it wants to know from its end, if it is there,
/// and begins a new one.
#[allow(unsafe_code)]
// SAFETY: the name is that of the vector; nothing that was on the stack is used after it was begun anew, for this
// never returns. The frame that is read has eight words, the address of the instruction is the seventh.
#[unsafe(naked)]
#[unsafe(export_name = "HardFault")]
unsafe extern "C" fn hard_fault() -> ! {
    core::arch::naked_asm!(
        "mrs r0, msp",
        "movw r1, #:lower16:_stack_end",
        "movt r1, #:upper16:_stack_end",
        "cmp r0, r1",
        "ite lo",
        "movlo r0, #0",
        "ldrhs r0, [r0, #24]",
        "movw r1, #:lower16:_stack_start",
        "movt r1, #:upper16:_stack_start",
        "msr msp, r1",
        "b {faulted}",
        faulted = sym faulted,
    )
}

extern "C" fn faulted(at: u32) -> ! {
    // SAFETY: nothing else runs any more, and reading these registers changes nothing.
    #[allow(unsafe_code)]
    let scb = unsafe { &*SCB::PTR };
    stop(&Fault { at, status: scb.cfsr.read(), address: scb.bfar.read() })
}
