//! A-SCRIPT, the language of the Performax and Commander controllers: its words, virtual machine, compiler,
//! decompiler and formatter.
//!
//! [`isa`] is the one table of words. A program becomes compiled lines ([`mod@line`]) in a memory that up to
//! four threads execute ([`vm`]). This crate does not know which device runs it: what is not arithmetic,
//! a condition or a call is handed to the device. A [`Dialect`] says what the families have more or less of.
//!
//! Words, lines and machine need no allocator; the compiler ([`compile`]), decompiler ([`decompile`]),
//! formatter ([`format()`]) and program files ([`image`]) are behind the feature `std`.
#![cfg_attr(not(any(test, feature = "std")), no_std)]

#[cfg(feature = "std")]
pub mod compiler;
#[cfg(feature = "std")]
pub mod decompiler;
pub mod dialect;
#[cfg(feature = "std")]
mod formatter;
#[cfg(feature = "std")]
pub mod image;
pub mod isa;
#[cfg(feature = "std")]
mod layout;
pub mod line;
#[cfg(feature = "std")]
pub mod reference;
pub mod vm;

#[cfg(feature = "std")]
pub use compiler::compile;
#[cfg(feature = "std")]
pub use decompiler::decompile;
pub use dialect::Dialect;
#[cfg(feature = "std")]
pub use formatter::format;
pub use isa::{Direction, Place, Word};
pub use line::Line;
pub use vm::{Action, Exit, Fault, Memory, State, Thread};
