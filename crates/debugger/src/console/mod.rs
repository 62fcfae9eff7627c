//! The debugger that is typed at: a line is a command, and what it says is text.

mod commands;
mod show;

use crate::{Debugger, Direction, Goal};
pub use commands::COMMANDS;

/// What stands before each line that is typed.
pub const PROMPT: &str = "(debug) ";

/// What came of a line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// What there is to say: lines, each with its end.
    pub text: String,
    /// Whether that was all.
    pub quits: bool,
}

/// Somebody who types at a debugger.
pub struct Console {
    debugger: Debugger,
    /// The last line that an empty one repeats.
    last: String,
    quits: bool,
}

impl Console {
    /// A console for a program that has not begun.
    pub fn new(debugger: Debugger) -> Self {
        Self { debugger, last: String::new(), quits: false }
    }

    /// What it debugs.
    pub fn debugger(&mut self) -> &mut Debugger {
        &mut self.debugger
    }

    /// What is shown before the first line is typed.
    pub fn greeting(&mut self) -> String {
        let device = self.debugger.target().config.model.title;
        format!("{device}; `help` lists the commands\n{}", show::here(&mut self.debugger))
    }

    /// Does what a line says. An empty one is the last step or move once more.
    pub fn execute(&mut self, line: &str) -> Answer {
        let line = line.trim();
        let line = if line.is_empty() { std::mem::take(&mut self.last) } else { line.to_owned() };
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((&line, ""));
        if word.is_empty() {
            return Answer::default();
        }
        let text = match commands::find(word) {
            Some(command) => {
                self.last = if command.repeats { line.clone() } else { String::new() };
                (command.run)(self, rest.trim()).unwrap_or_else(|error| format!("error: {error}\n"))
            }
            None => format!("error: `{word}` is no command; `help` lists them\n"),
        };
        Answer { text, quits: self.quits }
    }

    /// What a line that is being typed may go on with: where the last word begins, and words for it.
    pub fn complete(&mut self, line: &str) -> (usize, Vec<String>) {
        let start = line.rfind(char::is_whitespace).map_or(0, |at| at + 1);
        let word = &line[start..];
        let begins = |name: &str| {
            name.len() >= word.len()
                && name.is_char_boundary(word.len())
                && name[..word.len()].eq_ignore_ascii_case(word)
        };
        let mut words: Vec<String> = if start == 0 {
            COMMANDS.iter().map(|command| command.name.to_owned()).collect()
        } else {
            let labels = self.debugger.target().code.labels().iter().map(|label| label.name.clone());
            let mut words: Vec<_> = labels.collect();
            let device = self.debugger.device();
            words.extend(device.pins().iter().map(|pin| pin.name.to_owned()));
            words.extend(device.quantities().into_iter().map(|quantity| quantity.name));
            words
        };
        words.retain(|name| begins(name));
        words.dedup();
        (start, words)
    }

    fn go(&mut self, direction: Direction, goal: Goal) -> Result<String, String> {
        let stop = self.debugger.go(direction, goal).map_err(|error| error.to_string())?;
        Ok(show::stop(&mut self.debugger, &stop))
    }
}

#[cfg(test)]
mod tests;
