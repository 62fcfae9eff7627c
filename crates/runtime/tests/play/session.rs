//! A controller on the rig from power-up to the end of a test, and what its pins must have shown.

use crate::memory::Memory;
use crate::rig::{Rig, What};
use crate::tap::{Given, Tap};
use devices::cmd4cr::{self, Cmd4cr};
use devices::pd42::{self, Pd42};
use devices::pmx2ed::{self, Pmx2ed};
use devices::{Controller, Port};
use motion::{Direction, Moment};
use runtime::hardware::TICK_HZ;
use runtime::main_loop::HORIZON;
use runtime::{Figures, Loop, Pages, Queues};

pub type Settings = Pages<Memory<4, 2048>>;
pub type Main<'q, 'c, C, const AXES: usize, const HZ: u32> = Loop<'q, 'c, Tap<C>, Rig<'q, AXES, HZ>, AXES>;

/// The timer is about to wrap when a session begins.
pub const START: u64 = (1 << 32) - 100_000;

fn settings(bytes: u32) -> Settings {
    Pages::new(Memory::new(bytes + 4096), 2048, bytes)
}

pub fn pd42() -> Pd42<Settings> {
    Pd42::new(settings(pd42::FLASH_BYTES), 1)
}

pub fn pmx2ed() -> Pmx2ed<Settings> {
    Pmx2ed::new(settings(pmx2ed::FLASH_BYTES))
}

pub fn cmd4cr() -> Cmd4cr<Settings> {
    Cmd4cr::new(settings(cmd4cr::FLASH_BYTES))
}

/// Switches a controller on, lets the script drive it, and gives what happened.
pub fn session<C: Controller, const AXES: usize, const HZ: u32>(
    controller: C,
    script: impl FnOnce(&mut Main<'_, '_, C, AXES, HZ>),
) -> Heard<C> {
    let mut queues = Queues::<AXES>::new();
    let (plan, player) = queues.split();
    let mut tap = Tap::new(controller);
    let rig = Rig::new(player, tap.pins(), START);
    let mut main = Loop::new(&mut tap, rig, plan);
    script(&mut main);
    let figures = *main.figures();
    let log = std::mem::take(&mut main.hardware().pins.log);
    let steps = main.hardware().pins.steps;
    Heard { hz: HZ, log, steps, figures, tap }
}

/// Lets time pass.
pub fn pass<C: Controller, const AXES: usize, const HZ: u32>(main: &mut Main<'_, '_, C, AXES, HZ>, us: u64) {
    let until = main.hardware().time() + us * u64::from(HZ) / 1_000_000;
    while main.hardware().time() < until {
        main.turn();
        main.rest();
    }
}

/// Sends bytes to it and lets it answer.
pub fn say<C: Controller, const AXES: usize, const HZ: u32>(
    main: &mut Main<'_, '_, C, AXES, HZ>,
    port: Port,
    bytes: &[u8],
) -> Vec<u8> {
    let before = main.hardware().port(port).from_device.len();
    main.hardware().port(port).to_device.extend(bytes);
    pass(main, 3000);
    main.hardware().port(port).from_device[before..].iter().map(|(_, byte)| *byte).collect()
}

/// The same with commands of the ASCII devices; all of them are done.
pub fn commands<C: Controller, const AXES: usize, const HZ: u32>(
    main: &mut Main<'_, '_, C, AXES, HZ>,
    commands: &str,
) {
    for command in commands.split(' ') {
        let reply = say(main, Port::Usb, format!("{command}\r").as_bytes());
        assert_eq!(reply, b"OK\r", "{command}: {}", reply.escape_ascii());
    }
}

/// A TMCL command as it comes over a wire.
pub fn tmcl(opcode: u8, kind: u8, value: i32) -> [u8; 9] {
    let mut frame = [1, opcode, kind, 0, 0, 0, 0, 0, 0];
    frame[4..8].copy_from_slice(&value.to_be_bytes());
    frame[8] = frame.iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte));
    frame
}

/// What happened.
pub struct Heard<C> {
    hz: u32,
    /// At the pins.
    pub log: Vec<(u64, What)>,
    /// Calls of `step`.
    pub steps: usize,
    pub figures: Figures,
    /// What the controller did.
    pub tap: Tap<C>,
}

/// A pulse as the controller planned it.
#[derive(Clone, Copy, Debug)]
struct Planned {
    axis: usize,
    direction: Direction,
    moment: Moment,
}

/// Something else that it planned.
#[derive(Debug, PartialEq)]
struct Event {
    clock: u64,
    what: What,
    /// How many pulses of each axis come before.
    after: Vec<usize>,
}

impl<C: Controller> Heard<C> {
    /// The pulses of each axis, and everything else.
    fn planned(&self) -> (Vec<Vec<Planned>>, Vec<Event>) {
        let axes = self.tap.axes().len();
        let (mut pulses, mut events) = (vec![Vec::new(); axes], Vec::new());
        for given in &self.tap.given {
            match given {
                Given::Train(axis, train) => pulses[*axis].extend((1..=train.count).map(|k| Planned {
                    axis: *axis,
                    direction: train.direction,
                    moment: train.moment(k),
                })),
                Given::Event(clock, what) => {
                    let after = pulses.iter().map(Vec::len).collect();
                    events.push(Event { clock: *clock, what: *what, after });
                }
            }
        }
        (pulses, events)
    }

    /// The ticks that a moment takes, from clock 0.
    fn ticks(&self, moment: Moment) -> f64 {
        let clocks = moment.ticks as f64 + f64::from(moment.fraction) / 4_294_967_296.0;
        clocks * f64::from(self.hz) / f64::from(self.tap.clock_hz())
    }

    /// Everything that the controller did happened at the pins, once and in order. Pulses of an axis are never
    /// nearer to each other than planned, but for `jitter_us`. Gives the number of pulses.
    pub fn check_order(&self, jitter_us: f64) -> usize {
        let (pulses, mut events) = self.planned();
        events.reverse();
        let mut seen = vec![0; pulses.len()];
        let mut last: Vec<Option<u64>> = vec![None; pulses.len()];
        let jitter = jitter_us * f64::from(self.hz) / 1e6 + 2.0;
        for (at, what) in &self.log {
            match what {
                What::Pulse(axis, direction, _) => {
                    let pulses = &pulses[*axis];
                    let planned = pulses.get(seen[*axis]).expect("no pulse that was not planned");
                    assert_eq!((planned.axis, planned.direction), (*axis, *direction));
                    if let Some(last) = last[*axis].replace(*at) {
                        let spacing = self.ticks(planned.moment) - self.ticks(pulses[seen[*axis] - 1].moment);
                        let real = (at - last) as f64;
                        assert!(real >= spacing - jitter, "{real} ticks, not {spacing}, before {planned:?}");
                    }
                    seen[*axis] += 1;
                }
                event => {
                    let planned = events.pop().expect("nothing that was not planned");
                    assert_eq!((*event, &seen), (planned.what, &planned.after), "at {at}");
                }
            }
        }
        assert_eq!((seen, events), (pulses.iter().map(Vec::len).collect::<Vec<_>>(), vec![]));
        self.log.iter().filter(|(_, what)| matches!(what, What::Pulse(..))).count()
    }

    /// And all of it in its tick, up to what the interrupt takes. Gives the number of pulses.
    pub fn check_ticks(&self) -> usize {
        assert_eq!(self.figures.slips, 0);
        let (pulses, events) = self.planned();
        // Setting the outputs at power-up takes a while.
        let first = self.log.iter().find_map(|(at, what)| match what {
            What::Pulse(axis, _, due) => {
                let late = (*at as u32).wrapping_sub(*due);
                Some(*at - u64::from(late) - self.ticks(pulses[*axis][0].moment) as u64)
            }
            _ => None,
        });
        let zero = first.expect("something moves");
        let horizon = u64::from(self.hz / TICK_HZ * HORIZON);
        assert!((horizon..4 * horizon).contains(&(zero - START)), "it begins soon");
        let late = f64::from(self.hz) / 1e6 * 4.0 + 3.0;
        let mut seen = vec![0; pulses.len()];
        let mut events = events.into_iter();
        for (at, what) in &self.log {
            let real = *at as f64 - zero as f64;
            let exact = if let What::Pulse(axis, _, due) = what {
                let planned = pulses[*axis][seen[*axis]];
                seen[*axis] += 1;
                let exact = self.ticks(planned.moment);
                let tick = zero.wrapping_add(exact as u64) as u32;
                assert!(tick.wrapping_sub(*due).wrapping_add(1) <= 2, "{tick}, not {due}: {planned:?}");
                exact
            } else {
                match events.next().unwrap().clock {
                    0 => continue,
                    clock => self.ticks(Moment::at(clock)),
                }
            };
            assert!((-1.0..late).contains(&(real - exact)), "{what:?} at {real}, not {exact}");
        }
        self.check_order(4.0)
    }
}
