//! TMCL, the language of Trinamic's modules: instruction set, virtual machine, assembler, disassembler,
//! formatter.
//!
//! [`isa`] is the one table of commands. From it come the checks of [`vm`], the operands of [`mod@line`]
//! (a typed command), of the assembler and of the disassembler, and the documentation. This crate does
//! not know which device runs it: what touches a motor, a parameter or a pin is handed to the device.
//!
//! Instruction set, machine and typed lines need no allocator; the assembler with the formatter (`asm`), the
//! disassembler (`disasm`) and program files (`image`) are behind the feature `std`.
#![cfg_attr(not(any(test, feature = "std")), no_std)]

#[cfg(feature = "std")]
pub mod asm;
#[cfg(feature = "std")]
pub mod disasm;
#[cfg(feature = "std")]
pub mod image;
pub mod isa;
pub mod line;
pub mod vm;

pub use isa::Command;
pub use vm::Vm;
