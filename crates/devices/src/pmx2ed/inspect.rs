//! What a debugger sees.

extern crate alloc;

use super::Pmx2ed;
use super::table::{AXES, COMMANDS};

crate::ascii::inspect::inspect!(Pmx2ed);
