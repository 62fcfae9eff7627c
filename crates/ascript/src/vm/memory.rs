//! What the threads share: lines, and the variables. On a chip room is set aside for all lines; on a host, where
//! there may be thousands of controllers, there is as much as the programs need.

use crate::isa::{PROGRAMS, SUBROUTINES};
use crate::line::{Line, Operand};
use core::iter::repeat_n;

/// No line.
const NOWHERE: u16 = u16::MAX;

#[cfg(feature = "std")]
type Room<const LINES: usize> = std::vec::Vec<Line>;
#[cfg(not(feature = "std"))]
type Room<const LINES: usize> = heapless::Vec<Line, LINES>;

/// Lines and variables, which all threads of a controller share.
#[derive(Clone, Debug)]
pub struct Memory<const LINES: usize, const VARIABLES: usize> {
    /// Those up to the last one that was written; those behind it are empty.
    pub(super) lines: Room<LINES>,
    pub(super) variables: [i32; VARIABLES],
    /// The line of each `PRG` and `SUB`, or [`NOWHERE`].
    programs: [u16; PROGRAMS as usize],
    subroutines: [u16; SUBROUTINES as usize],
}

impl<const LINES: usize, const VARIABLES: usize> Default for Memory<LINES, VARIABLES> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const LINES: usize, const VARIABLES: usize> Memory<LINES, VARIABLES> {
    /// An empty one, with all variables 0.
    pub const fn new() -> Self {
        assert!(LINES < NOWHERE as usize && VARIABLES <= Operand::VARIABLES as usize);
        Self {
            lines: Room::<LINES>::new(),
            variables: [0; VARIABLES],
            programs: [NOWHERE; PROGRAMS as usize],
            subroutines: [NOWHERE; SUBROUTINES as usize],
        }
    }

    /// A line; `None` if the memory has none there.
    pub fn line(&self, address: u16) -> Option<Line> {
        let address = usize::from(address);
        (address < LINES).then(|| self.lines.get(address).copied().unwrap_or(Line::Empty))
    }

    /// The lines up to the last one that was written.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// Puts a line there. Returns whether the memory reaches that far.
    pub fn set_line(&mut self, address: u16, line: Line) -> bool {
        let address = usize::from(address);
        if address >= LINES {
            return false;
        }
        let missing = (address + 1).saturating_sub(self.lines.len());
        self.lines.extend(repeat_n(Line::Empty, missing));
        let old = core::mem::replace(&mut self.lines[address], line);
        self.find(old);
        self.find(line);
        true
    }

    /// Puts these lines at the beginning of the memory, and nothing behind them. Returns whether there is
    /// room; if not, nothing has changed.
    pub fn load(&mut self, lines: &[Line]) -> bool {
        if lines.len() > LINES {
            return false;
        }
        self.lines.clear();
        self.lines.extend(lines.iter().copied());
        (0..PROGRAMS).for_each(|number| self.find(Line::Program(number)));
        (0..SUBROUTINES).for_each(|number| self.find(Line::Subroutine(number)));
        true
    }

    /// Looks up where the program or subroutine begins that this line is the beginning of. Of several with
    /// one number it is the first.
    fn find(&mut self, mark: Line) {
        let entry = match mark {
            Line::Program(number) => self.programs.get_mut(usize::from(number)),
            Line::Subroutine(number) => self.subroutines.get_mut(usize::from(number)),
            _ => return,
        };
        if let Some(entry) = entry {
            let line = self.lines.iter().position(|&line| line == mark);
            *entry = line.map_or(NOWHERE, |line| line as u16);
        }
    }

    /// The line where a program begins, if there is such a program.
    pub fn program(&self, number: u8) -> Option<u16> {
        self.programs.get(usize::from(number)).copied().filter(|&line| line != NOWHERE)
    }

    /// The line where a subroutine begins, if there is such a subroutine.
    pub fn subroutine(&self, number: u8) -> Option<u16> {
        self.subroutines.get(usize::from(number)).copied().filter(|&line| line != NOWHERE)
    }

    /// A variable; `None` if there is no such variable.
    pub fn variable(&self, index: u8) -> Option<i32> {
        self.variables.get(usize::from(index)).copied()
    }

    /// Sets a variable. Returns whether there is such a variable.
    pub fn set_variable(&mut self, index: u8, value: i32) -> bool {
        let variable = self.variables.get_mut(usize::from(index));
        variable.map(|variable| *variable = value).is_some()
    }
}
