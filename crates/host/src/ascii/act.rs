//! What an action is in commands (PMX-2ED-SA manual, 7; CMD-4CR manual, 2).

use super::Unit;
use super::status::List;
use crate::bus::Talk;
use crate::error::{Error, Result};
use crate::types::{Action, Direction, Level};
use std::collections::BTreeMap;

/// The homing commands of a Performax in the order of its manual (7.10).
const PERFORMAX_HOMING: [&str; 5] = ["H", "L", "ZH", "Z", "HL"];

/// The status bit of an axis that follows a joystick (PMX-2ED-SA manual, table 7.2).
const PERFORMAX_JOYSTICK: i32 = 1 << 10;

impl Unit {
    /// Does something.
    pub async fn act(&self, action: &Action) -> Result<()> {
        match action {
            Action::Power { axis, on } => {
                let number = self.axis(axis)? + 1;
                self.tell(&format!("EO{number}={}", u8::from(*on))).await
            }
            Action::Jog { axis, direction, speed, held: _ } => {
                let number = self.axis(axis)?;
                if let Some(speed) = speed {
                    self.tell(&format!("HSPD{axis}={speed}")).await?;
                }
                self.tell(&format!("J{axis}{}", direction.letter())).await?;
                self.targets()[number] = None;
                Ok(())
            }
            Action::Move { targets, relative } => self.move_to(targets, *relative).await,
            Action::Stop { axis } => self.halt("STOP", axis.as_deref()).await,
            Action::Abort { axis } => self.halt("ABORT", axis.as_deref()).await,
            Action::Home { axis, mode, direction } => self.home(axis, *mode, *direction).await,
            Action::SetPosition { axis, value } => {
                let number = self.axis(axis)?;
                self.tell(&format!("P{axis}={value}")).await?;
                self.targets()[number] = None;
                Ok(())
            }
            Action::SetEncoder { axis, value } => {
                self.axis(axis)?;
                self.tell(&format!("E{axis}={value}")).await
            }
            Action::ClearError { axis } => {
                self.axis(axis)?;
                self.tell(&format!("CLR{axis}")).await
            }
            Action::ChangeSpeed { axis, speed, acceleration, mode } => {
                self.axis(axis)?;
                if let Some(mode) = mode {
                    self.tell(&format!("SSPDM{axis}={mode}")).await?;
                }
                if let Some(acceleration) = acceleration {
                    self.tell(&format!("ACC{axis}={acceleration}")).await?;
                }
                self.tell(&format!("SSPD{axis}={speed}")).await
            }
            Action::ChangeTarget { axis, target } => {
                let number = self.axis(axis)?;
                self.in_mode(true, &format!("T{axis}{target}")).await?;
                self.targets()[number] = Some(*target);
                Ok(())
            }
            Action::SetMode { absolute } => self.tell(mode_command(*absolute)).await,
            Action::Output { name, value } => self.put_out(name, *value).await,
        }
    }

    /// Stops all axes and programs. What a program began between the two is stopped too, and an axis that follows a
    /// joystick follows it no longer, because it would go on.
    pub async fn stop_all(&self) -> Result<()> {
        let mut talk = self.bus.talk().await;
        let first = self.tell_in(&mut talk, "STOP").await;
        let mut stopped = Ok(());
        for program in 0..self.dialect.threads {
            let line = format!("{}{program}=0", self.dialect.control);
            stopped = stopped.and(self.tell_in(&mut talk, &line).await);
        }
        let off = if self.is_commander() {
            // It refuses to stop one (CMD-4CR manual, 2.5.1.3).
            matches!(first, Err(Error::Refused { .. })).then_some("JENA=0")
        } else {
            let status: Result<List> = self.ask_in(&mut talk, "MST").await;
            let follows = |word: &i32| word & PERFORMAX_JOYSTICK != 0;
            status.is_ok_and(|List(words)| words.iter().take(2).any(follows)).then_some("JF")
        };
        if let Some(off) = off {
            stopped = stopped.and(self.tell_in(&mut talk, off).await);
        }
        self.tell_in(&mut talk, "STOP").await.and(stopped)
    }

    async fn halt(&self, command: &str, axis: Option<&str>) -> Result<()> {
        if let Some(axis) = axis {
            self.axis(axis)?;
        }
        self.tell(&format!("{command}{}", axis.unwrap_or_default())).await
    }

    async fn move_to(&self, targets: &BTreeMap<String, i32>, relative: bool) -> Result<()> {
        let mut goals = vec![None; self.dialect.axes.len()];
        for (axis, target) in targets {
            goals[self.axis(axis)?] = Some(*target);
        }
        let letters = self.dialect.axes.chars();
        let line = match goals[..] {
            // Lines have a command of their own (PMX-2ED-SA manual, 7.8.2).
            [Some(x), Some(y)] if !self.is_commander() => format!("I{x}:{y}"),
            _ => letters
                .zip(&goals)
                .filter_map(|(axis, goal)| goal.map(|goal| format!("{axis}{goal}")))
                .collect(),
        };
        if line.is_empty() {
            return Err(Error::Value("a move has a target".into()));
        }
        if relative {
            for (axis, goal) in self.model.axes().iter().zip(&mut goals) {
                if let Some(goal) = goal {
                    *goal = self.ask::<i32>(&format!("P{axis}")).await?.wrapping_add(*goal);
                }
            }
        }
        self.in_mode(!relative, &line).await?;
        for (known, goal) in self.targets().iter_mut().zip(goals) {
            *known = goal.or(*known);
        }
        Ok(())
    }

    /// Says a line whose targets are meant so; the mode stays what it was.
    async fn in_mode(&self, absolute: bool, line: &str) -> Result<()> {
        let mut talk = self.bus.talk().await;
        let was_absolute = self.is_absolute(&mut talk).await?;
        if was_absolute == absolute {
            return self.tell_in(&mut talk, line).await;
        }
        self.tell_in(&mut talk, mode_command(absolute)).await?;
        let done = self.tell_in(&mut talk, line).await;
        self.tell_in(&mut talk, mode_command(was_absolute)).await.and(done)
    }

    /// Whether targets are positions.
    async fn is_absolute(&self, talk: &mut Talk<'_>) -> Result<bool> {
        Ok(self.ask_in::<i32>(talk, "MM").await? == 0)
    }

    async fn home(&self, axis: &str, mode: u8, direction: Direction) -> Result<()> {
        let number = self.axis(axis)?;
        let way = direction.letter();
        let line = if self.is_commander() {
            (mode < self.dialect.homing_modes).then(|| format!("H{axis}{way}{mode}"))
        } else {
            PERFORMAX_HOMING.get(usize::from(mode)).map(|command| format!("{command}{axis}{way}"))
        };
        let line = line.ok_or_else(|| Error::Value(format!("there is no homing mode {mode}")))?;
        self.tell(&line).await?;
        self.targets()[number] = None;
        Ok(())
    }

    /// Sets an output; enable outputs are outputs too.
    async fn put_out(&self, name: &str, value: Level) -> Result<()> {
        let dialect = self.dialect;
        let outputs = [("DO", dialect.outputs), ("EO", dialect.axis_count()), ("IO", dialect.ports)];
        let numbered =
            |(prefix, count): (&str, u8)| (1..=count).any(|number| *name == format!("{prefix}{number}"));
        let is_digital = outputs.into_iter().any(numbered);
        if !is_digital && !numbered(("PWM", dialect.pwm_outputs)) {
            return Err(Error::NoSuch(name.into()));
        }
        let value = match value {
            Level::Digital(on) if is_digital => f64::from(u8::from(on)),
            Level::Analog(value) => value,
            Level::Digital(_) => return Err(Error::Value(format!("{name} takes a number"))),
        };
        self.tell(&format!("{name}={value}")).await
    }
}

const fn mode_command(absolute: bool) -> &'static str {
    if absolute { "ABS" } else { "INC" }
}
