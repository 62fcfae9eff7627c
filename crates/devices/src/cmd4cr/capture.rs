//! Position latches and synchronisation outputs (manual, 2.1.3.2).

use super::table::{AXIS_COUNT, Id};
use super::{Cmd4cr, HZ};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::Ticks;
use ::motion::compare::Condition;
use ::motion::sync::{Rule, Sync};

/// How long a pulse of the continuous mode is: 10 µs.
const PULSE: Ticks = (HZ as Ticks).div_ceil(100_000);

/// `SYNC`: the counter is that of the encoder.
const ENCODER: i32 = 8;

/// `LTS` (manual, table 2-4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LatchStatus {
    Off = 0,
    Waiting = 1,
    Triggered = 2,
}

/// Latch and comparator of an axis.
#[derive(Debug)]
pub struct Capture {
    status: LatchStatus,
    /// What was latched last.
    position: i32,
    encoder: i32,
    sync: Sync,
    /// Counts of the encoder's decoder between which the comparator has nothing to do.
    window: Option<(i32, i32)>,
}

impl Capture {
    pub const fn new() -> Self {
        Self { status: LatchStatus::Off, position: 0, encoder: 0, sync: Sync::new(), window: None }
    }

    /// When the pulse of the continuous mode ends.
    pub fn due(&self) -> Option<Ticks> {
        self.sync.due()
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// `LT`: the latch waits for its input, or no longer.
    pub fn set_latch(&mut self, axis: usize, on: bool) {
        self.captures[axis].status = if on { LatchStatus::Waiting } else { LatchStatus::Off };
    }

    /// `LTS`.
    pub fn latch_status(&self, axis: usize) -> i32 {
        self.captures[axis].status as i32
    }

    /// `LTP`.
    pub fn latched_position(&self, axis: usize) -> i32 {
        self.captures[axis].position
    }

    /// `LTE`.
    pub fn latched_encoder(&self, axis: usize) -> i32 {
        self.captures[axis].encoder
    }

    /// The input of an axis' latch has come on.
    pub fn latch(&mut self, axis: usize, board: &mut dyn Board) {
        if self.captures[axis].status == LatchStatus::Waiting {
            let (position, encoder) = (self.position(axis), self.encoder(axis, board));
            let capture = &mut self.captures[axis];
            (capture.status, capture.position, capture.encoder) = (LatchStatus::Triggered, position, encoder);
        }
    }

    /// What the comparator of an axis is to look for.
    fn rule(&self, axis: usize) -> Rule {
        let position = self.memory.cells.at(Id::SyncPosition, axis);
        match self.memory.cells.at(Id::Sync, axis) & !ENCODER {
            1 => Rule::While(Condition::Equal(position)),
            2 => Rule::While(Condition::Below(position)),
            3 => Rule::While(Condition::Above(position)),
            4 => Rule::Every(position.unsigned_abs()),
            _ => Rule::Never,
        }
    }

    fn compares_encoder(&self, axis: usize) -> bool {
        self.memory.cells.at(Id::Sync, axis) & ENCODER != 0
    }

    /// The counter that the comparator looks at.
    fn compared(&self, axis: usize, board: &mut dyn Board) -> i32 {
        if self.compares_encoder(axis) { self.encoder(axis, board) } else { self.axes[axis].position() }
    }

    /// `SYNO`, `SYNWO`: the output follows the comparator, with its window or without.
    pub fn sync_on(&mut self, axis: usize, window: bool, board: &mut dyn Board) {
        let counter = self.compared(axis, board);
        let rule = self.rule(axis);
        let bounds = self.sync_window(axis);
        let sync = &mut self.captures[axis].sync;
        // A window that is opened later leaves the multiples where they are.
        if !window || !sync.is_on() {
            sync.switch_on(rule, counter);
        }
        sync.set_window(window.then_some(bounds));
        self.compare(board);
    }

    /// `SYNF`: output and window off.
    pub fn sync_off(&mut self, axis: usize, board: &mut dyn Board) {
        self.captures[axis].sync.switch_off();
        self.compare(board);
    }

    /// `SYNWF`: window off.
    pub fn sync_window_off(&mut self, axis: usize) {
        self.captures[axis].sync.set_window(None);
    }

    fn sync_window(&self, axis: usize) -> [i32; 2] {
        [Id::SyncMin, Id::SyncMax].map(|id| self.memory.cells.at(id, axis))
    }

    /// Condition or comparator of an axis were set: what follows them begins again.
    pub fn sync_changed(&mut self, axis: usize, board: &mut dyn Board) {
        let (rule, counter) = (self.rule(axis), self.compared(axis, board));
        let sync = &mut self.captures[axis].sync;
        if sync.is_on() {
            sync.switch_on(rule, counter);
            self.compare(board);
        }
    }

    /// The window of an axis was set.
    pub fn sync_window_changed(&mut self, axis: usize) {
        let window = self.sync_window(axis);
        let sync = &mut self.captures[axis].sync;
        if sync.has_window() {
            sync.set_window(Some(window));
        }
    }

    /// `SYNS`.
    pub fn sync_status(&self, axis: usize) -> i32 {
        self.captures[axis].sync.status() as i32
    }

    /// A counter of an axis was set: that is no way that it went.
    pub fn recount(&mut self, axis: usize, board: &mut dyn Board) {
        let counter = self.compared(axis, board);
        self.captures[axis].sync.renumber(counter);
    }

    /// Shows the comparators the counters, and sees to it that they are shown them next where something
    /// changes.
    pub fn compare(&mut self, board: &mut dyn Board) {
        for axis in 0..AXIS_COUNT {
            if !self.captures[axis].sync.is_on() {
                if self.is_synchronised(axis) {
                    self.synchronise_output(axis, None, board);
                    self.axes[axis].set_marks(i64::MIN, i64::MAX);
                    self.captures[axis].window = None;
                }
                continue;
            }
            let counter = self.compared(axis, board);
            let sync = &mut self.captures[axis].sync;
            sync.reach(counter, self.now + PULSE);
            sync.expire(self.now);
            let (level, room) = (sync.level(), sync.room());
            self.synchronise_output(axis, Some(level), board);
            let (marks, window) = match room {
                None => ((i64::MIN, i64::MAX), None),
                Some(room) if self.compares_encoder(axis) => {
                    let encoder = &self.stations[axis].encoder;
                    ((i64::MIN, i64::MAX), Some(encoder.window(room, board.encoder(axis))))
                }
                Some([down, up]) => {
                    let odometer = self.axes[axis].odometer();
                    ((odometer - i64::from(down), odometer + i64::from(up)), None)
                }
            };
            self.axes[axis].set_marks(marks.0, marks.1);
            self.captures[axis].window = window;
        }
    }

    /// Where the encoder of an axis has to be told.
    pub fn captured_window(&self, axis: usize) -> Option<(i32, i32)> {
        self.captures.get(axis)?.window
    }
}
