//! What a debugger sees. Reading changes nothing here, unlike a host's.

extern crate alloc;

use super::{Pd42, ap, global_parameters as gp};
use crate::board::Board;
use crate::flash::Flash;
use crate::gate::Gate;
use crate::inspect::{Inspect, Quantity, Scope};
use crate::parameter::Table;
use ::motion::{Ticks, tmc429};
use alloc::{borrow::ToOwned, format, vec::Vec};
use tmcl::isa::{Condition, VARIABLES};

/// The registers of a program.
const ACCUMULATOR: &str = "A";
const X: &str = "X";

/// What stands before the number of a user variable.
const VARIABLE: char = 'V';

impl<F: Flash> Inspect for Pd42<F> {
    fn gate(&mut self) -> &mut Gate {
        &mut self.program.gate
    }

    fn next_program(&self) -> Option<(Ticks, usize)> {
        self.program_at().map(|at| (at, 0))
    }

    fn address(&self, program: usize) -> Option<u16> {
        self.vm.frames().next().filter(|_| program == 0)
    }

    fn frames(&self, program: usize) -> Vec<u16> {
        if program == 0 { self.vm.frames().collect() } else { Vec::new() }
    }

    fn value(&self, name: &str, board: &mut dyn Board) -> Option<f64> {
        let parameter = |table: &Table| {
            let mut entries = table.iter();
            entries.find(|entry| entry.about.symbol.eq_ignore_ascii_case(name)).map(|entry| entry.number)
        };
        let value = self
            .register(name)
            .or_else(|| parameter(ap::TABLE).map(|number| self.peek_axis(number, board)))
            .or_else(|| self.peek_module(parameter(gp::module::TABLE)?))
            .or_else(|| parameter(gp::interrupts::TABLE).map(|number| self.memory.interrupts.get(number)))?;
        Some(value.into())
    }

    fn set_register(&mut self, name: &str, value: i32) -> bool {
        match name {
            ACCUMULATOR => self.vm.set_accumulator(value),
            X => self.vm.set_x(value),
            _ => return false,
        }
        self.program.forget_rounds();
        true
    }

    fn quantities(&self) -> Vec<Quantity> {
        let registers = [(ACCUMULATOR, "The accumulator."), (X, "The X register.")].into_iter();
        let conditions =
            Condition::KEYWORDS.iter().map(|keyword| (keyword.name, "Whether the condition holds."));
        let program = registers.chain(conditions).map(|(name, text)| Quantity {
            name: name.to_owned(),
            scope: Scope::Program,
            text,
        });
        let variables = (0..VARIABLES).map(|number| Quantity {
            name: format!("{VARIABLE}{number}"),
            scope: Scope::Variables,
            text: "",
        });
        let tables = [
            (Scope::Axes, ap::TABLE),
            (Scope::Device, gp::module::TABLE),
            (Scope::Device, gp::interrupts::TABLE),
        ];
        let parameters = tables.into_iter().flat_map(|(scope, table)| {
            table.iter().map(move |entry| Quantity {
                name: entry.about.symbol.to_owned(),
                scope,
                text: entry.about.text,
            })
        });
        program.chain(variables).chain(parameters).collect()
    }
}

impl<F: Flash> Pd42<F> {
    /// A register, variable or condition of the program.
    fn register(&self, name: &str) -> Option<i32> {
        match name {
            ACCUMULATOR => return Some(self.vm.accumulator()),
            X => return Some(self.vm.x()),
            _ => {}
        }
        if let Some(number) = name.strip_prefix(VARIABLE).and_then(|number| number.parse().ok()) {
            return Some(self.vm.variable(number));
        }
        let keyword = Condition::KEYWORDS.iter().find(|keyword| keyword.name == name)?;
        Some(self.vm.condition(Condition::from_number(keyword.number)?).into())
    }

    /// What [`get_axis`](Self::get_axis) would give, if that cleared no errors and measured nothing.
    fn peek_axis(&self, number: u8, board: &mut dyn Board) -> i32 {
        let sign = self.axis.direction().sign() as i32;
        let [left, right] = self.stop_switches();
        let mut encoders = self.encoders.clone();
        match number {
            ap::ACTUAL_POSITION => self.axis.position(),
            ap::ACTUAL_SPEED => sign * tmc429::internal(self.axis.speed()),
            ap::POSITION_REACHED => self.reached().into(),
            ap::HOME_SWITCH => self.inputs.home.into(),
            ap::LEFT_SWITCH => left.into(),
            ap::RIGHT_SWITCH => right.into(),
            ap::ACTUAL_ACCELERATION => self.axis.acceleration() * self.memory.axis.get(ap::MAX_ACCELERATION),
            ap::ACTUAL_CURRENT => i32::from(self.power.current()).max(1) - 1,
            ap::LOAD_VALUE => self.power.driver.reading().into(),
            ap::DRIVER_ERRORS => self.driver_flags(),
            ap::ENCODER_POSITION | ap::EXTERNAL_ENCODER | ap::ABSOLUTE_POSITION => {
                encoders.update(board);
                match number {
                    ap::ENCODER_POSITION => encoders.internal.position(),
                    ap::EXTERNAL_ENCODER => encoders.external.position(),
                    _ => encoders.internal.angle() as i32,
                }
            }
            _ => self.memory.axis.get(number),
        }
    }

    /// What a host would read, but for the random number: there is none until somebody asks.
    fn peek_module(&self, number: u8) -> Option<i32> {
        Some(match number {
            gp::module::PROGRAM_STATUS => self.vm.mode() as i32,
            gp::module::DOWNLOAD_MODE => self.program.download.is_some().into(),
            gp::module::PROGRAM_COUNTER => self.vm.counter().into(),
            gp::module::TICK_TIMER => self.timer_ms(),
            gp::module::RANDOM => return None,
            _ => self.memory.module.get(number),
        })
    }
}
