//! Homing and `ZMOVE` (manual, 2.2.5 and appendix A).

use super::Cmd4cr;
use super::erc::Occasion;
use super::refusal::Refusal;
use super::table::Id;
use crate::ascii::station::{Task, side};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::Direction;
use ::motion::closed_loop::Motion;
use ::motion::homing::routine::{self, Inputs, Outcome, Settings};
use ::motion::homing::{Homing, commander};

/// What StepNLoop calls a mode (manual, table 27): by the home input, by the index, by a limit.
const fn motion(mode: Option<usize>) -> Motion {
    match mode {
        Some(0 | 1 | 9) => Motion::Home,
        Some(6 | 7 | 8 | 12) => Motion::LimitHome,
        _ => Motion::IndexHome,
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// `H` with a mode, `ZMOVE` without.
    pub fn home(
        &mut self,
        axis: usize,
        way: Direction,
        mode: Option<usize>,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        let motion = motion(mode);
        // A mode that seeks the limit has found it.
        let into = |other| way == other && motion != Motion::LimitHome;
        self.may_move(axis, [into(Direction::Positive), into(Direction::Negative)])?;
        self.forget_slowdown(axis, board);
        let limits = self.limits(axis);
        let settings = Settings {
            limits,
            slow: limits.start,
            correction: 0,
            index_marks: self.memory.cells.at(Id::IndexCount, axis) as u8 + 1,
            return_to_zero: false,
        };
        let steps = mode.map_or(commander::Z_MOVE, |mode| commander::MODES[mode]);
        let station = &mut self.stations[axis];
        station.program = program;
        station.closed.begin(&self.axes[axis], motion);
        station.task = Task::Home(Homing::new(steps, way, settings));
        self.run_homing(axis, board);
        Ok(())
    }

    /// Lets a homing routine take notice of inputs and axis.
    pub fn run_homing(&mut self, axis: usize, board: &mut dyn Board) {
        if !matches!(self.stations[axis].task, Task::Home(_)) {
            return;
        }
        let on = self.limits_on(axis);
        let limits = [Direction::Negative, Direction::Positive].map(|way| on[side(way)]);
        let inputs = Inputs {
            home: self.home_on(axis, board),
            limits,
            index: self.index_on(axis, board),
            slowdown: self.guards[axis].slow,
        };
        let station = &mut self.stations[axis];
        let Task::Home(homing) = &mut station.task else { return };
        let outcome = homing.poll(&mut self.axes[axis], inputs);
        let clear = homing.take_clear();
        if homing.take_zeroed() {
            station.zero(&self.axes[axis], board.encoder(axis));
            self.recount(axis, board);
        }
        match clear {
            Some(routine::Occasion::Stop) => self.clear_deflection(axis, Occasion::ErrorStop),
            Some(routine::Occasion::Home) => self.clear_deflection(axis, Occasion::Home),
            None => {}
        }
        match outcome {
            None => {}
            Some(Outcome::Found) => self.stations[axis].task = Task::Stop,
            Some(Outcome::Limit(way)) => {
                self.stations[axis].task = Task::Stop;
                self.limit_hit(axis, way);
            }
        }
        self.settle();
    }
}
