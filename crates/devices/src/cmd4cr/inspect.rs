//! What a debugger sees.

extern crate alloc;

use super::Cmd4cr;
use super::table::{AXES, COMMANDS};

crate::ascii::inspect::inspect!(Cmd4cr);
