//! Breakpoints in a controller that runs in real time. Its time stands while a line is held, and with it the program,
//! the machine and everything else: what is sent to it is answered, if the answer takes no time.

use serde::{Deserialize, Serialize};
use sim::VirtualDevice;
use std::collections::BTreeSet;
use ts_rs::TS;
use utoipa::ToSchema;

/// The most breakpoints of a controller: one for each line of the longest program.
pub const MAX_BREAKPOINTS: usize = 8192;

/// What a debugger lets a controller do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Go {
    /// On, to the next breakpoint.
    Continue,
    /// One line of the program that is held, or of any if none is.
    Step,
    /// To the next line of any program.
    Pause,
}

/// A line that waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct Held {
    /// Its program.
    pub program: usize,
    /// Its address.
    pub address: u16,
}

/// What a debugger sees.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct DebugState {
    /// The line that waits, if one does.
    pub held: Option<Held>,
    /// The addresses at which programs are held.
    pub breakpoints: Vec<u16>,
}

/// The breakpoints of a controller, and what is held at one.
#[derive(Debug, Default)]
pub(crate) struct Breaks {
    addresses: BTreeSet<u16>,
    held: Option<Held>,
    until: Until,
}

/// Where programs are held, breakpoints apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Until {
    #[default]
    Breakpoint,
    LineOf(usize),
    Line,
}

impl Breaks {
    /// Programs are held at these addresses and no others.
    pub fn set(&mut self, addresses: BTreeSet<u16>) {
        self.addresses = addresses;
    }

    /// Goes on in this way. A line that is held is executed first.
    pub fn go(&mut self, go: Go, device: &mut VirtualDevice) {
        let held = self.take_held(device);
        self.until = match (go, held) {
            (Go::Continue, _) => Until::Breakpoint,
            (Go::Step, Some(held)) => Until::LineOf(held.program),
            (Go::Step, None) | (Go::Pause, _) => Until::Line,
        };
        if held.is_some() {
            device.execute_line();
        }
    }

    /// Whether nothing holds programs, or ever will.
    pub fn is_idle(&self) -> bool {
        self.addresses.is_empty() && self.held.is_none() && self.until == Until::Breakpoint
    }

    /// Whether time stands.
    pub fn holds(&mut self, device: &mut VirtualDevice) -> bool {
        self.held = self.take_held(device);
        self.held.is_some()
    }

    /// Lets time pass up to a clock, or until a line is held.
    pub fn advance(&mut self, device: &mut VirtualDevice, due: u64) {
        if self.holds(device) {
            return;
        }
        while let Some(program) = device.advance_to_line(due, false) {
            let address = device.address(program).expect("a line that is due has an address");
            let stops = match self.until {
                Until::Breakpoint => false,
                Until::LineOf(stepped) => stepped == program,
                Until::Line => true,
            };
            if stops || self.addresses.contains(&address) {
                self.until = Until::Breakpoint;
                self.held = Some(Held { program, address });
                return;
            }
            device.execute_line();
        }
    }

    /// What a debugger sees.
    pub fn state(&self) -> DebugState {
        DebugState { held: self.held, breakpoints: self.addresses.iter().copied().collect() }
    }

    /// The line that is held, unless the program has been stopped or the power cut meanwhile.
    fn take_held(&mut self, device: &mut VirtualDevice) -> Option<Held> {
        self.held.take().filter(|held| device.is_held() && device.address(held.program) == Some(held.address))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sim::{DeviceConfig, Program, run};
    use tmcl::asm::{NoFiles, assemble};

    /// Commands 0 and 1 once, then 2 and 3 for ever, ten ticks of 10 ms a round.
    const PROGRAM: &[u8] = b"SGP 0, 2, 5\nSGP 1, 2, 6\nLoop: WAIT TICKS, 0, 10\nJA Loop\n";

    fn device() -> VirtualDevice {
        let program = assemble("test.tmc", PROGRAM, &NoFiles).program.expect("it has no errors");
        let program = Program::Tmcl(program.commands);
        let mut device = VirtualDevice::new(&DeviceConfig::new(devices::model("pd42-1140").unwrap()), 1);
        run::load(&mut device, &program).unwrap();
        run::start(&mut device, &program).unwrap();
        device
    }

    /// Lets a second pass and gives the address that is held then.
    fn held_at(breaks: &mut Breaks, device: &mut VirtualDevice) -> Option<u16> {
        let due = device.now() + u64::from(device.clock_hz());
        breaks.advance(device, due);
        assert!(breaks.held.is_some() || device.now() == due);
        breaks.state().held.map(|held| held.address)
    }

    #[test]
    fn a_breakpoint_holds_at_each_round() {
        let (mut device, mut breaks) = (device(), Breaks::default());
        breaks.set(BTreeSet::from([3]));
        assert_eq!(held_at(&mut breaks, &mut device), Some(3));
        let first = device.now();
        assert_eq!(held_at(&mut breaks, &mut device), Some(3), "without a word nothing goes on");
        assert_eq!(device.now(), first, "and time stands");
        breaks.go(Go::Continue, &mut device);
        assert_eq!(held_at(&mut breaks, &mut device), Some(3));
        let round = device.seconds() - first as f64 / f64::from(device.clock_hz());
        assert!((0.1..0.11).contains(&round), "{round} s");
    }

    #[test]
    fn steps_go_line_by_line() {
        let (mut device, mut breaks) = (device(), Breaks::default());
        breaks.go(Go::Pause, &mut device);
        for address in [0, 1, 2, 3, 2] {
            assert_eq!(held_at(&mut breaks, &mut device), Some(address));
            assert_eq!(device.address(0), Some(address));
            breaks.go(Go::Step, &mut device);
        }
    }

    #[test]
    fn without_breakpoints_nothing_holds() {
        let (mut device, mut breaks) = (device(), Breaks::default());
        breaks.set(BTreeSet::from([2]));
        assert_eq!(held_at(&mut breaks, &mut device), Some(2));
        breaks.set(BTreeSet::new());
        assert!(!breaks.is_idle(), "the line is held until somebody lets it go");
        breaks.go(Go::Continue, &mut device);
        assert!(breaks.is_idle());
        assert_eq!(held_at(&mut breaks, &mut device), None);
    }

    #[test]
    fn a_power_cut_lets_go() {
        let (mut device, mut breaks) = (device(), Breaks::default());
        breaks.set(BTreeSet::from([2]));
        assert_eq!(held_at(&mut breaks, &mut device), Some(2));
        device.power_cycle();
        assert!(!breaks.holds(&mut device));
        assert_eq!(held_at(&mut breaks, &mut device), None, "it does not start by itself");
    }

    #[test]
    fn held_or_not_the_run_is_the_same() {
        let (mut free, mut looked_at, mut breaks) = (device(), device(), Breaks::default());
        breaks.set(BTreeSet::from([2, 3]));
        let due = free.now() + 3 * u64::from(free.clock_hz());
        free.advance(due);
        while looked_at.now() < due {
            breaks.advance(&mut looked_at, due);
            if breaks.held.is_some() {
                breaks.go(Go::Step, &mut looked_at);
            }
        }
        assert_eq!(free.state(), looked_at.state());
    }
}
