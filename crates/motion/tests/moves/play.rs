//! Plays a scenario on an axis with the oracle watching.

use crate::oracle::{Extremes, Oracle, Settings, velocity};
use crate::random::Random;
use crate::scenario::{Op, Scenario, Wait, goal_source};
use motion::{Axis, Goal};

/// Pulses after which a scenario is cut short: most, and one in a thousand.
const MOST_PULSES: [u64; 2] = [1 << 13, 1 << 21];

/// Pulses for which a goal speed is watched at the end.
const CRUISE: u32 = 200;

/// Pulses after which a goal speed is left.
const ENDLESS: u32 = 3000;

/// What a run gave.
#[derive(Clone, Copy, Default)]
pub struct Outcome {
    pub pulses: u64,
    /// The last goal was a position and the axis stands there.
    pub arrived: bool,
    pub extremes: Extremes,
}

struct Player<'a> {
    axis: Axis,
    oracle: Oracle,
    now: u64,
    most_pulses: u64,
    random: Random,
    /// The calls made, as Rust source.
    calls: Option<&'a mut Vec<String>>,
}

/// Plays a scenario; `calls` gets every call that was made.
pub fn play(scenario: &Scenario, calls: Option<&mut Vec<String>>) -> Result<Outcome, String> {
    let axis = Axis::new(scenario.units.limits());
    let random = Random::new(!scenario.seed);
    let oracle = Oracle::new(scenario.units);
    let most_pulses = MOST_PULSES[usize::from(scenario.seed % 1000 == 999)];
    let mut player = Player { axis, oracle, now: 0, most_pulses, random, calls };
    player.note(|| format!("let mut axis = Axis::new({});", scenario.units.source()));
    player.shift(scenario.position)?;
    player.goal(Goal::Position(scenario.position))?;
    let mut units = scenario.units;
    for (wait, op) in &scenario.ops {
        player.wait(*wait)?;
        match *op {
            Op::Target(way) => player.goal(Goal::Position(player.axis.position().wrapping_add(way)))?,
            Op::Speed(way, speed) => player.goal(Goal::Speed(way, motion::tmc429::speed(speed)))?,
            Op::Shift(way) => player.shift(player.axis.position().wrapping_add(way))?,
            Op::Limits(mut new) => {
                let speed = player.oracle.speed_at_most();
                if speed != 0.0 && new.pulse_div != units.pulse_div {
                    // The speed must mean something in the new scale, and a goal speed the same.
                    let range = velocity(1, new.pulse_div)..velocity(2047, new.pulse_div);
                    if !range.contains(&speed) || matches!(player.axis.goal(), Goal::Speed(..)) {
                        new.pulse_div = units.pulse_div;
                    }
                }
                units = new;
                player.note(|| format!("axis.set_limits({});", units.source()));
                player.axis.set_limits(units.limits());
                player.changed(|settings| settings.units = units)?;
            }
            Op::Block(way, stop) => {
                player.note(|| {
                    let stop = stop.map_or("None".into(), |stop| format!("Some(Stop::{stop:?})"));
                    format!("axis.set_blocked(Direction::{way:?}, {stop});")
                });
                player.axis.set_blocked(way, stop);
                player.changed(|settings| settings.blocked[way as usize] = stop)?;
            }
            Op::Halt => {
                player.note(|| "axis.halt();".into());
                player.axis.halt();
                let goal = player.axis.goal();
                player.changed(|settings| (settings.goal, settings.halted) = (goal, true))?;
            }
        }
        if player.oracle.steps > player.most_pulses {
            return Ok(player.outcome(false));
        }
    }
    player.finish()
}

impl Player<'_> {
    fn note(&mut self, call: impl FnOnce() -> String) {
        if let Some(calls) = &mut self.calls {
            calls.push(call());
        }
    }

    fn changed(&mut self, change: impl FnOnce(&mut Settings)) -> Result<(), String> {
        self.oracle.changed(change, &self.axis)
    }

    fn goal(&mut self, goal: Goal) -> Result<(), String> {
        self.note(|| format!("axis.set_goal({});", goal_source(goal)));
        self.axis.set_goal(goal);
        self.changed(|settings| settings.goal = goal)
    }

    fn shift(&mut self, position: i32) -> Result<(), String> {
        self.note(|| format!("axis.set_position({position});"));
        self.axis.set_position(position);
        self.changed(|settings| settings.position = position)
    }

    fn advance(&mut self, now: u64) -> Result<(), String> {
        self.note(|| format!("axis.advance({now}, |_| {{}});"));
        self.now = now;
        let Self { axis, oracle, .. } = self;
        let mut result = Ok(());
        axis.advance(now, |train| {
            if result.is_ok() {
                result = oracle.train(train, now);
            }
        });
        result?;
        oracle.passed(now);
        oracle.look(axis)
    }

    /// Goes on for so many pulses, or to rest.
    fn go(&mut self, pulses: u32) -> Result<(), String> {
        let from = self.axis.odometer();
        let low = from.saturating_sub(pulses.into());
        let high = from.saturating_add(pulses.into());
        self.note(|| format!("axis.set_window({low}, {high});"));
        self.axis.set_window(low, high);
        let most = self.oracle.steps + self.most_pulses;
        while (low + 1..high).contains(&self.axis.odometer()) && self.oracle.steps < most {
            let Some(wake) = self.axis.wake() else { break };
            let now = self.axis.odometer();
            if self.random.chance(10) {
                let looked = self.now + (wake - self.now) * u64::from(self.random.below(256)) / 256;
                self.advance(looked)?;
                if looked < wake && self.axis.odometer() == now && self.axis.wake() != Some(wake) {
                    return Err(format!("wake was {wake}, and then {:?}", self.axis.wake()));
                }
            } else {
                self.advance(wake)?;
                let after = self.axis.odometer();
                if after == now {
                    return Err(format!("woke at {wake} for nothing"));
                }
                if !(low..=high).contains(&after) {
                    return Err(format!("woke at {after} outside of {low} to {high}"));
                }
            }
        }
        Ok(())
    }

    fn wait(&mut self, wait: Wait) -> Result<(), String> {
        if wait.pulses > 0 {
            // Goals that never end are left after a while.
            let endless = matches!(self.axis.goal(), Goal::Speed(_, 1..));
            self.go(if endless { wait.pulses.min(ENDLESS) } else { wait.pulses })?;
        }
        let from = self.axis.odometer();
        self.axis.set_window(from - 1, from + 1);
        let next = self.axis.wake().unwrap_or(self.now + 1000);
        let part = (next - self.now) * u64::from(wait.part) / 255;
        self.advance((self.now + part).min(next - 1))
    }

    /// To the end of the last goal.
    fn finish(mut self) -> Result<Outcome, String> {
        match self.axis.goal() {
            Goal::Speed(_, 1..) => {
                // To the goal speed, if that is not too far, and a while at it.
                let ramp = self.oracle.way_of_ramp() as u32;
                self.go(ramp.min(ENDLESS) + ENDLESS)?;
                self.go(CRUISE)?;
                Ok(self.outcome(false))
            }
            goal => {
                self.go(u32::MAX)?;
                let arrived = !self.axis.is_moving();
                let there = matches!(goal, Goal::Position(target) if target == self.axis.position());
                if arrived && self.axis.wake().is_some() {
                    return Err("rests and wakes".into());
                }
                Ok(self.outcome(arrived && there))
            }
        }
    }

    fn outcome(&self, arrived: bool) -> Outcome {
        Outcome { pulses: self.oracle.steps, arrived, extremes: self.oracle.extremes }
    }
}
