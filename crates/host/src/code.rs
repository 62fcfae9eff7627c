//! A program as it lies in a controller's memory.

use ascript::decompiler::{DecompileError, decompile};
use ascript::dialect::Dialect;
use ascript::line::Line;
use tmcl::disasm::disassemble;
use tmcl::isa::Command;

/// A program, compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Code {
    /// Lines of A-SCRIPT.
    Ascript(&'static Dialect, Vec<Line>),
    /// Commands of TMCL.
    Tmcl(Vec<Command>),
}

impl Code {
    /// A source that compiles to it.
    ///
    /// # Errors
    /// There is none for these lines of A-SCRIPT.
    pub fn source(&self) -> Result<String, DecompileError> {
        match self {
            Self::Ascript(dialect, lines) => decompile(lines, dialect),
            Self::Tmcl(commands) => Ok(disassemble(commands)),
        }
    }
}
