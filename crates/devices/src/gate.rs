//! A gate before the lines of programs, for debuggers. It stands open unless somebody shuts it.

/// Which lines may be executed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lines {
    /// All of them.
    #[default]
    Any,
    /// The next one, and no other.
    One,
    /// None: time stops where one is due.
    None,
}

/// What stands between a program and its next line.
///
/// A line that is held changes nothing: when the gate opens, the controller goes on in the middle of the clock
/// in which it was stopped, as if nobody had looked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gate {
    lines: Lines,
    held: bool,
    /// Before the line that is held, something has changed on which windows depend.
    stale: bool,
}

impl Gate {
    /// One that is open.
    pub const OPEN: Self = Self { lines: Lines::Any, held: false, stale: false };

    /// Says which lines may be executed from now on.
    pub const fn allow(&mut self, lines: Lines) {
        self.lines = lines;
    }

    /// Which lines may be executed.
    pub const fn allowed(&self) -> Lines {
        self.lines
    }

    /// Whether a line is due and waits for the gate.
    pub const fn is_held(&self) -> bool {
        self.held
    }

    /// Whether no line may pass.
    pub(crate) const fn is_shut(&self) -> bool {
        matches!(self.lines, Lines::None)
    }

    /// A line waits. `stale` says whether windows have to be looked at after it.
    pub(crate) const fn hold(&mut self, stale: bool) {
        self.held = true;
        self.stale |= stale;
    }

    /// Time goes on: whether a line waits is seen anew.
    pub(crate) const fn look(&mut self) {
        self.held = false;
    }

    /// A line passes. Gives what [`hold`](Self::hold) was told, if it waited.
    pub(crate) const fn pass(&mut self) -> bool {
        core::mem::replace(&mut self.stale, false)
    }

    /// How many lines of so many may be executed in one go.
    pub(crate) const fn limit(&self, lines: u32) -> u32 {
        if matches!(self.lines, Lines::Any) { lines } else { 1 }
    }

    /// A line was executed.
    pub(crate) const fn executed(&mut self) {
        if matches!(self.lines, Lines::One) {
            self.lines = Lines::None;
        }
    }
}
