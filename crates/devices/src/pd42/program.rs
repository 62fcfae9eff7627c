//! The standalone program in time: when its next command is due, its waits, its interrupts.

use super::pins::number as pin;
use super::{Pd42, TEN_MILLISECONDS, global_parameters::interrupts as gp};
use crate::board::Board;
use crate::controller::Notice;
use crate::flash::Flash;
use crate::gate::Gate;
#[cfg(feature = "std")]
use crate::rounds::Rounds;
use ::motion::Ticks;
use tmcl::isa::{Command, MoveKind, WaitFor, opcode};
#[cfg(feature = "std")]
use tmcl::vm::Situation;
use tmcl::vm::{Exit, Outcome, Stopped, Wait};

/// Commands that the virtual machine executes at most before anything else is looked at.
const MAX_BATCH: u64 = 1 << 20;

/// How many notices are kept until somebody asks.
pub const NOTICES: usize = 16;

/// Interrupts that follow an input's transitions, with the pin that each looks at.
const TRIGGERS: [(u8, usize); 6] = [
    (gp::STOP_LEFT, pin::STOP_L),
    (gp::STOP_RIGHT, pin::STOP_R),
    (gp::INPUT_0, pin::AIN0),
    (gp::INPUT_1, pin::STOP_L),
    (gp::INPUT_2, pin::STOP_R),
    (gp::INPUT_3, pin::HOME),
];

/// State of the program beyond the virtual machine's.
pub struct Program {
    /// Where the next command of a download goes; `None` in normal mode.
    pub download: Option<usize>,
    /// It came to a command that programs cannot have.
    pub failed: bool,
    /// What a debugger lets through.
    pub gate: Gate,
    /// When its next command is executed.
    next_at: Ticks,
    /// An interrupt may end a wait for a while.
    roused: bool,
    timers: [Option<Ticks>; 3],
    notices: heapless::Deque<Notice, NOTICES>,
    #[cfg(feature = "std")]
    rounds: Rounds<Situation>,
}

impl Program {
    pub const fn new() -> Self {
        Self {
            download: None,
            failed: false,
            gate: Gate::OPEN,
            next_at: 0,
            roused: false,
            timers: [None; 3],
            notices: heapless::Deque::new(),
            #[cfg(feature = "std")]
            rounds: Rounds::new(),
        }
    }

    /// When a timer interrupt is due.
    pub fn timers_due(&self) -> Option<Ticks> {
        self.timers.into_iter().flatten().min()
    }

    pub fn take_notice(&mut self) -> Option<Notice> {
        self.notices.pop_front()
    }

    /// Something has happened that the program does not show: rounds before it tell nothing about those to come.
    pub fn forget_rounds(&mut self) {
        #[cfg(feature = "std")]
        self.rounds.forget();
    }
}

impl<F: Flash> Pd42<F> {
    /// Starts the program from an address or from where it stands; `false` if there is no such address.
    pub fn start_program(&mut self, address: Option<i32>) -> bool {
        let started = self.vm.start(address).is_ok();
        if started {
            self.program.failed = false;
            self.program.next_at = self.now;
        }
        started
    }

    /// Executes the next command, as soon as possible.
    pub fn step_program(&mut self) {
        self.vm.step();
        self.program.next_at = self.now;
    }

    /// When the program's next command is executed; `None` while it stands or waits.
    pub fn program_at(&self) -> Option<Ticks> {
        let goes = self.program_active() && (self.program.roused || self.vm.waiting().is_none());
        goes.then_some(self.program.next_at.max(self.now))
    }

    /// Whether a command is to begin now, and a debugger wants to see it before that. A `WAIT` under way, which
    /// only an interrupt can leave before its end, has begun.
    pub fn is_held(&self) -> bool {
        let begins = self.vm.waiting().is_none() || self.vm.is_interrupted();
        self.program.gate.is_shut() && begins && self.program_at() == Some(self.now)
    }

    /// Raises an interrupt.
    pub fn raise(&mut self, number: u8) {
        self.vm.raise(number);
        self.program.roused = true;
    }

    /// Runs the program until `horizon`, before which nothing else happens, or until it has done
    /// something after which the horizon may be another.
    pub fn run_program(&mut self, horizon: Ticks, board: &mut dyn Board) {
        let Some(at) = self.program_at() else { return };
        if at > horizon {
            return;
        }
        let budget = ((horizon - at) / self.command_clocks + 1).min(MAX_BATCH) as u32;
        let (executed, exit) = self.vm.run(self.program.gate.limit(budget));
        if !matches!(exit, Exit::Waiting(_)) {
            self.program.gate.executed();
        }
        self.program.next_at = at + Ticks::from(executed) * self.command_clocks;
        match exit {
            Exit::Host(command) => {
                #[cfg(feature = "std")]
                self.skip_rounds(horizon);
                self.step_to(self.program.next_at, board);
                let outputs = self.outputs;
                if !self.is_still(command) {
                    self.program.forget_rounds();
                }
                self.execute_in_program(command, board);
                if self.outputs != outputs {
                    self.program.forget_rounds();
                }
                self.program.next_at += self.command_clocks;
                self.react(board);
            }
            Exit::Wait(wait) => {
                self.step_to(self.program.next_at, board);
                self.program.next_at += self.command_clocks;
                self.begin_wait(wait);
                self.react(board);
            }
            Exit::Waiting(_) => {
                self.program.roused = false;
                self.end_wait();
            }
            Exit::Skipped(fault) => self.notice(fault.address, fault.command, fault.status.0),
            Exit::Stopped(stopped) => {
                // It has ended when its last command begins.
                let last = if stopped == Stopped::Stop { self.command_clocks } else { 0 };
                self.step_to(self.program.next_at - last, board);
                if let Stopped::DirectOnly(command) = stopped {
                    self.program.failed = true;
                    self.notice(self.vm.counter(), command, protocol::tmcl::Status::NOT_AVAILABLE.0);
                }
            }
            Exit::Budget | Exit::Breakpoint | Exit::Idle => {}
        }
    }

    /// A program that asks what it has asked before, with everything as it was, leaves out the rounds until
    /// `horizon`.
    #[cfg(feature = "std")]
    fn skip_rounds(&mut self, horizon: Ticks) {
        let (vm, program) = (&mut self.vm, &mut self.program);
        let (at, instructions) = (program.next_at, vm.instructions());
        let skipped =
            program.rounds.look(at, instructions, horizon, |seen| vm.is_in(seen), || vm.situation());
        if let Some(skipped) = skipped {
            program.next_at += skipped.time;
            vm.count(skipped.instructions);
        }
    }

    /// Whether a command changes nothing but outputs, and reads the same again until something happens.
    fn is_still(&self, command: Command) -> bool {
        let Command { opcode, kind, motor, value } = command;
        let stands = !self.axis.is_moving() && self.search_status() == 0;
        match opcode {
            // The null channel is where the motor is.
            opcode::GIO => (motor, kind) != (0, 11) || stands,
            opcode::SIO => motor == 2,
            opcode::GAP => stands && kind <= super::ap::RIGHT_SWITCH_OFF,
            opcode::MVP if kind == MoveKind::Absolute as u8 && motor == 0 => stands && self.is_there(value),
            opcode::SAP if kind == super::ap::TARGET_POSITION => stands && self.is_there(value),
            opcode::AAP if kind == super::ap::TARGET_POSITION => {
                stands && self.is_there(self.vm.accumulator())
            }
            _ => false,
        }
    }

    /// Whether a move of the motor, which stands, to this position would change nothing.
    fn is_there(&self, target: i32) -> bool {
        let get = |number| self.memory.axis.get(number);
        let usual = get(super::ap::RAMP_MODE) != super::motion::ramp_mode::VELOCITY
            && get(super::ap::EXTENDED_ERRORS) == 0
            && !self.motion.awaited
            && !self.motion.stopped_by_switch
            && !self.wire.is_asked();
        usual && self.axis.position() == target && get(super::ap::TARGET_POSITION) == target
    }

    fn execute_in_program(&mut self, command: Command, board: &mut dyn Board) {
        let outcome = if self.wire.is_silent() && Self::is_motion(command) {
            Err(protocol::tmcl::Status::NOT_AVAILABLE)
        } else {
            self.execute(command, board)
        };
        let outcome = match outcome {
            Ok(Some(value)) => Outcome::Value(value),
            Ok(None) => Outcome::Done,
            Err(status) => {
                self.program.forget_rounds();
                self.notice(self.vm.counter(), command, status.0);
                Outcome::Skipped
            }
        };
        self.vm.complete(outcome);
    }

    fn notice(&mut self, address: u16, command: Command, status: u8) {
        let notice = Notice { at: self.now, counter: address.into(), opcode: command.opcode, status };
        // The first ones tell more than the last: a loop repeats itself.
        let _ = self.program.notices.push_back(notice);
    }

    fn begin_wait(&mut self, wait: Wait) {
        if wait.motor != 0 && wait.event != WaitFor::Ticks {
            self.vm.complete(Outcome::Skipped);
            return;
        }
        let limited = wait.ticks != 0 || wait.event == WaitFor::Ticks;
        let span = Ticks::from(wait.ticks) * TEN_MILLISECONDS;
        self.vm.hold(if limited { self.now.saturating_add(span) } else { Ticks::MAX });
        self.end_wait();
    }

    /// Ends a wait that is over.
    pub fn end_wait(&mut self) {
        let Some(hold) = self.vm.waiting() else { return };
        let happened = match hold.event {
            WaitFor::Ticks => false,
            WaitFor::Position => self.reached() && !self.axis.is_moving(),
            WaitFor::HomeSwitch => self.inputs.home,
            WaitFor::LimitSwitch => self.stop_switches().contains(&true),
            WaitFor::RefSearch => self.search_status() == 0,
        };
        if happened || hold.until <= self.now {
            self.vm.wait_over(!happened && hold.event != WaitFor::Ticks);
            self.program.next_at = self.program.next_at.max(self.now);
        }
    }

    /// When the present wait times out.
    pub fn wait_due(&self) -> Option<Ticks> {
        self.vm.waiting().map(|hold| hold.until).filter(|&until| until != Ticks::MAX)
    }

    /// A timer's period was set.
    pub fn set_timer(&mut self, number: u8) {
        if let Some(timer) = self.program.timers.get_mut(usize::from(number)) {
            *timer = None;
            let due = self.timer_period(number).map(|period| self.now.saturating_add(period));
            self.program.timers[usize::from(number)] = due;
        }
    }

    /// Raises the interrupts of timers that are due.
    pub fn run_timers(&mut self) {
        for number in 0..self.program.timers.len() {
            let Some(due) = self.program.timers[number] else { continue };
            if due > self.now {
                continue;
            }
            self.raise(number as u8);
            // Periods that were missed altogether count as one.
            let next = self.timer_period(number as u8).map(|period| {
                let missed = (self.now - due) / period;
                due.saturating_add((missed + 1).saturating_mul(period))
            });
            self.program.timers[number] = next;
        }
    }

    /// A digital input changes: switches block or free, and transitions raise interrupts.
    pub fn input_changed(&mut self, number: usize, on: bool) {
        for (interrupt, pin) in TRIGGERS {
            let inverted = matches!(interrupt, gp::STOP_LEFT | gp::STOP_RIGHT)
                && self.memory.module.get(super::gp::SWITCH_POLARITY) != 0;
            let rising = on != inverted;
            let trigger = self.memory.interrupts.get(interrupt);
            if pin == number && trigger & if rising { 1 } else { 2 } != 0 {
                self.raise(interrupt);
            }
        }
        self.apply_blocks();
    }
}
