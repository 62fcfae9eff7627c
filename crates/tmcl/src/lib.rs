//! TMCL, the language of Trinamic's modules: instruction set, virtual machine, assembler, disassembler.
//!
//! [`isa`] is the one table of commands. From it come the checks of [`vm`], the operands of [`line`]
//! (a typed command), of the assembler and of the disassembler, and the documentation. This crate does
//! not know which device runs it: what touches a motor, a parameter or a pin is handed to the device.
#![cfg_attr(not(any(test, feature = "std")), no_std)]

pub mod isa;
pub mod line;
pub mod vm;

pub use isa::Command;
pub use vm::Vm;
