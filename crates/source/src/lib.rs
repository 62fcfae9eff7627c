//! Source files of programs, places in them, and what is to be said about a place. What the assembler of one
//! language and the compiler of another have in common.

mod file;
mod place;
mod spelling;

pub use file::{MAX_SOURCE_BYTES, Source, Span};
pub use place::{Level, Place};
pub use spelling::nearest;
