//! Buffered moves: up to a hundred lines, circles and arcs that follow each other without a pause, each with a
//! constant speed of its own (manual, 2.3.4).

use super::motion::{Motion, axes_in};
use super::path::{Curve, held};
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id, MAX_SPEED_PPS, POSITIONS};
use super::{Cmd4cr, HZ};
use crate::ascii::clock::Clocked as _;
use crate::ascii::speeds;
use crate::board::Board;
use crate::flash::Flash;
use ::motion::path::Move;
use ::motion::pps::{self, COMMANDER};

/// Registers of the buffer.
pub const REGISTERS: usize = 100;

/// X, Y and Z: the axes that buffered moves can move, as bits.
pub const MOVABLE: u8 = 0b111;

/// U, which a helix needs, as a bit.
const HELPER: u8 = 0b1000;

/// What has been added and not taken out. A chip sets aside room for all registers; a host takes it when it is needed.
#[cfg(feature = "std")]
type Entries = alloc::collections::VecDeque<Entry>;
#[cfg(not(feature = "std"))]
type Entries = heapless::Deque<Entry, REGISTERS>;

/// What a register holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    shape: Shapes,
    speed_pps: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shapes {
    /// A line to these positions; U stays.
    Line([i32; AXIS_COUNT]),
    Curve(Curve),
}

/// The buffer.
#[derive(Debug)]
pub struct Buffer {
    on: bool,
    /// Moves are taken out and executed.
    runs: bool,
    entries: Entries,
    /// How many were added, and taken out, since it was switched on.
    added: usize,
    taken: usize,
    /// Where the last one ends.
    end: [i32; AXIS_COUNT],
    /// The program that has started it, for its errors.
    program: Option<usize>,
}

impl Buffer {
    pub const fn new() -> Self {
        Self {
            on: false,
            runs: false,
            entries: Entries::new(),
            added: 0,
            taken: 0,
            end: [0; AXIS_COUNT],
            program: None,
        }
    }

    /// Whether moves go to the buffer.
    pub const fn is_on(&self) -> bool {
        self.on
    }

    /// The program that has started it.
    pub const fn program(&self) -> Option<usize> {
        self.program
    }

    /// `BSTAT`: whether it is on, the registers of the next move and of the next free one, and how many are
    /// free.
    pub fn status(&self) -> [usize; 4] {
        let free = REGISTERS - self.entries.len();
        [self.on.into(), self.taken % REGISTERS, self.added % REGISTERS, free]
    }

    fn clear(&mut self) {
        self.runs = false;
        self.taken += self.entries.len();
        self.entries.clear();
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// `BO`, `BUFON`. It does not go together with StepNLoop, a joystick or a manual pulse generator.
    pub fn buffer_on(&mut self) -> Result<(), Refusal> {
        for axis in axes_in(MOVABLE) {
            if self.stations[axis].closed.is_on() {
                return Err(Refusal::ClosedLoop);
            }
            if self.joystick_on(axis) || self.pulser_on(axis) {
                return Err(Refusal::Moving);
            }
        }
        if !self.buffer.on {
            self.buffer = Buffer { on: true, ..Buffer::new() };
        }
        Ok(())
    }

    /// `BF`, `BUFOFF`: what waits is forgotten, the move that is on goes to its end.
    pub fn buffer_off(&mut self) {
        self.buffer.clear();
        self.buffer.on = false;
    }

    /// Whatever waits in the buffer is forgotten.
    pub fn drop_buffer(&mut self) {
        self.buffer.clear();
    }

    /// `BSTART`, `ISTART`: takes moves out until there are none.
    pub fn buffer_start(&mut self, program: Option<usize>, board: &mut dyn Board) -> Result<(), Refusal> {
        if !self.buffer.on {
            return Err(Refusal::BufferDisabled);
        }
        (self.buffer.runs, self.buffer.program) = (true, program);
        self.run_buffer(board)?;
        self.react(board);
        Ok(())
    }

    /// `I`: a line with a speed.
    pub fn buffer_line(&mut self, targets: [i32; 3], speed_pps: i32) -> Result<(), Refusal> {
        if !self.buffer.on {
            return Err(Refusal::BufferDisabled);
        }
        let speed_pps = u32::try_from(speed_pps).ok().filter(|pps| (1..=MAX_SPEED_PPS as u32).contains(pps));
        let speed_pps = speed_pps.ok_or(Refusal::Index)?;
        let [x, y, z] = targets.map(Some);
        let entry = self.line_entry([x, y, z, None], self.incremental, speed_pps);
        self.add_to_buffer(entry)
    }

    /// A motion as an entry of the buffer; `None` if it is none that the buffer takes.
    pub fn buffered(&mut self, motion: &Motion) -> Result<Option<Entry>, Refusal> {
        let speed_pps = self.memory.cells.get(Id::HighSpeed) as u32;
        match *motion {
            Motion::To { targets, incremental } => {
                let lines = self.memory.cells.get(Id::Interpolation) != 0;
                match motion.axes() {
                    axes if axes.count_ones() < 2 || !lines => Ok(None),
                    axes if axes & !MOVABLE != 0 => Err(Refusal::BufferEnabled),
                    _ => Ok(Some(self.line_entry(targets, incremental, speed_pps))),
                }
            }
            Motion::Curve(curve) => {
                let allowed = if curve.rise.is_some() { MOVABLE | HELPER } else { MOVABLE };
                if motion.axes() & !allowed != 0 {
                    return Err(Refusal::BufferEnabled);
                }
                Ok(Some(Entry { shape: Shapes::Curve(curve), speed_pps }))
            }
            Motion::Jog { .. } | Motion::Home { .. } => Ok(None),
        }
    }

    fn line_entry(&self, targets: super::motion::Targets, incremental: bool, speed_pps: u32) -> Entry {
        let from = self.buffer_end();
        let targets = core::array::from_fn(|axis| match targets[axis] {
            Some(target) if incremental => from[axis].wrapping_add(target),
            Some(target) => target,
            None => from[axis],
        });
        Entry { shape: Shapes::Line(targets), speed_pps }
    }

    /// Where the next move added begins.
    fn buffer_end(&self) -> [i32; AXIS_COUNT] {
        let buffered = self.rides.iter().any(|ride| ride.buffered);
        if buffered || !self.buffer.entries.is_empty() {
            self.buffer.end
        } else {
            core::array::from_fn(|axis| self.axes[axis].position())
        }
    }

    /// Puts a move into the next register.
    pub fn add_to_buffer(&mut self, entry: Entry) -> Result<(), Refusal> {
        let from = self.buffer_end();
        let end = match entry.shape {
            Shapes::Line(targets) => targets,
            Shapes::Curve(curve) => {
                let ways: [i32; AXIS_COUNT] = Move::Arc(curve.path(from)?).way();
                core::array::from_fn(|axis| from[axis].wrapping_add(ways[axis]))
            }
        };
        if !end.iter().all(|position| POSITIONS.contains(position)) {
            return Err(Refusal::Index);
        }
        if self.buffer.entries.len() == REGISTERS {
            return Err(Refusal::BufferFull);
        }
        self.buffer.entries.extend([entry]);
        self.buffer.end = end;
        self.buffer.added += 1;
        Ok(())
    }

    /// Whether an axis still has to move for the buffer.
    pub fn is_buffered(&self, axis: usize) -> bool {
        self.buffer.runs && !self.buffer.entries.is_empty() && MOVABLE >> axis & 1 != 0
    }

    /// Takes out the next move when there is none on: it begins in the clock in which the one before ended.
    /// One that its axes do not allow ends it all.
    pub fn run_buffer(&mut self, board: &mut dyn Board) -> Result<(), Refusal> {
        while self.buffer.runs && !self.rides.iter().any(|ride| ride.buffered) {
            let Some(&entry) = self.buffer.entries.front() else {
                self.buffer.runs = false;
                break;
            };
            if let Err(refusal) = self.begin_entry(entry, board) {
                self.drop_buffer();
                return Err(refusal);
            }
            for axis in axes_in(MOVABLE) {
                self.stations[axis].program = self.buffer.program;
            }
            self.buffer.entries.pop_front();
            self.buffer.taken += 1;
        }
        Ok(())
    }

    fn begin_entry(&mut self, entry: Entry, board: &mut dyn Board) -> Result<(), Refusal> {
        let from: [i32; AXIS_COUNT] = core::array::from_fn(|axis| self.axes[axis].position());
        let speed_pps = pps::window(&COMMANDER, entry.speed_pps).stepped(entry.speed_pps);
        let scale = pps::scale(speed_pps, HZ);
        // There are no ramps to join, and a stop is one at once.
        let limits = speeds::constant(pps::speed(speed_pps, scale, HZ), scale);
        match entry.shape {
            Shapes::Line(targets) => {
                let ways = core::array::from_fn(|axis| targets[axis].wrapping_sub(from[axis]));
                for axis in (0..AXIS_COUNT).filter(|&axis| ways[axis] != 0) {
                    self.may_move(axis, [ways[axis] > 0, ways[axis] < 0])?;
                }
                if ways != [0; AXIS_COUNT] {
                    self.start_ride(&Move::Line(ways), limits, ways, false, true, board);
                }
            }
            Shapes::Curve(curve) => {
                let arc = curve.path(from)?;
                let course = Move::Arc(arc);
                for axis in axes_in(curve.axes()) {
                    self.may_move(axis, curve.ways(axis, from))?;
                }
                self.start_ride(&course, held(limits, &arc), course.way(), curve.rise.is_some(), true, board);
            }
        }
        Ok(())
    }
}
