//! A session: each request has its answer, and what follows from it.

use super::{
    capabilities::capabilities,
    messages::{
        Breakpoints, Event, Expression, Launch, OfSource, OfThread, OfVariables, Request, Response, Wanted,
    },
    variables::{register, scopes, variables},
};
use crate::{
    Debugger, Direction, Goal, Stop,
    code::Place,
    console::Console,
    stop::{Condition, show},
    wire::{self, WireError},
};
use devices::ProgramRun;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    io::Write,
    path::{Path, absolute},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// Numbers of breakpoints that are set together: those of one source, at labels, on values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Together {
    Source(usize),
    Labels,
    Values,
}

/// What follows from a request, after its answer.
enum Then {
    Nothing,
    /// The program is there: breakpoints can be set.
    Ready,
    /// It goes somewhere.
    Go(Direction, Goal),
    /// It stands, for this reason.
    Stands(Stop),
    /// That was all.
    End,
}

type Answer = Result<(Value, Then), String>;

/// A session with an editor.
pub struct Session<W, L> {
    output: W,
    launch: L,
    interrupt: Arc<AtomicBool>,
    seq: i64,
    console: Option<Console>,
    stops_on_entry: bool,
    set: BTreeMap<Together, Vec<u32>>,
    /// Whether it stood at its end when it was told to go.
    ended: bool,
}

impl<W: Write, L: FnMut(&Launch) -> Result<Debugger, String>> Session<W, L> {
    pub fn new(output: W, launch: L, interrupt: Arc<AtomicBool>) -> Self {
        Self {
            output,
            launch,
            interrupt,
            seq: 0,
            console: None,
            stops_on_entry: false,
            set: BTreeMap::new(),
            ended: false,
        }
    }

    /// Answers a request and does what follows from it; false if that was the last one.
    pub fn answer(&mut self, request: &Request) -> Result<bool, WireError> {
        let answer = self.handle(request);
        let (body, then, message) = match answer {
            Ok((body, then)) => (body, then, None),
            Err(message) => (Value::Null, Then::Nothing, Some(message)),
        };
        let Request { seq: request_seq, command, .. } = request;
        let seq = self.next();
        let success = message.is_none();
        let kind = "response";
        let response = Response { seq, kind, request_seq: *request_seq, success, command, message, body };
        wire::write(&mut self.output, &response)?;
        match then {
            Then::Nothing => {}
            Then::Ready => self.event("initialized", Value::Null)?,
            Then::Go(direction, goal) => self.go(direction, goal)?,
            Then::Stands(stop) => self.stands(&stop)?,
            Then::End => return Ok(false),
        }
        Ok(true)
    }

    fn next(&mut self) -> i64 {
        self.seq += 1;
        self.seq
    }

    fn event(&mut self, event: &str, body: Value) -> Result<(), WireError> {
        let seq = self.next();
        wire::write(&mut self.output, &Event { seq, kind: "event", event, body })
    }

    fn handle(&mut self, request: &Request) -> Answer {
        match request.command.as_str() {
            "initialize" => return Ok((capabilities(), Then::Nothing)),
            "launch" => return self.launched(&arguments(request)?),
            "terminate" | "disconnect" => return Ok((Value::Null, Then::End)),
            _ => {}
        }
        let debugger = self.console.as_mut().ok_or("nothing was launched")?.debugger();
        let view = |debugger: &mut Debugger| -> Result<(), String> {
            let OfThread { thread_id } = arguments(request)?;
            debugger.view(thread_id.saturating_sub(1));
            Ok(())
        };
        let done = |body: Value| Ok((body, Then::Nothing));
        let goes = |direction, goal| Ok((json!({ "allThreadsContinued": true }), Then::Go(direction, goal)));
        match request.command.as_str() {
            "configurationDone" if self.stops_on_entry => Ok((Value::Null, Then::Stands(Stop::Start))),
            "configurationDone" => Ok((Value::Null, Then::Go(Direction::Forward, Goal::End))),
            "setBreakpoints" => self.break_lines(&arguments(request)?),
            "setFunctionBreakpoints" => self.break_labels(&arguments(request)?),
            "setDataBreakpoints" => self.watch(&arguments(request)?),
            "setExceptionBreakpoints" => done(Value::Null),
            "dataBreakpointInfo" => {
                let OfVariables { name, variables_reference, .. } = arguments(request)?;
                let register = register(debugger, variables_reference, &name);
                let known = register.filter(|name| debugger.value(name).is_some());
                let id = known.map_or(Value::Null, |name| json!(name));
                done(json!({ "dataId": id, "description": name, "accessTypes": ["write"] }))
            }
            "threads" => done(threads(debugger)),
            "stackTrace" => {
                let OfThread { thread_id } = arguments(request)?;
                done(stack(debugger, thread_id.saturating_sub(1)))
            }
            "scopes" => done(scopes(debugger)),
            "variables" => {
                let OfVariables { variables_reference, .. } = arguments(request)?;
                done(variables(debugger, variables_reference))
            }
            "setVariable" => {
                let OfVariables { name, value, variables_reference } = arguments(request)?;
                let register = register(debugger, variables_reference, &name);
                let name = register.ok_or_else(|| format!("`{name}` of an axis cannot be set"))?;
                debugger.set(&name, &value).map_err(|error| error.to_string())?;
                let value = debugger.value(&name).map(show).unwrap_or(value);
                done(json!({ "value": value }))
            }
            "source" => {
                let OfSource { source_reference } = arguments(request)?;
                let files = &debugger.target().code.files;
                let file = source_reference.checked_sub(1).and_then(|number| files.get(number));
                let file = file.ok_or("there is no such source")?;
                done(json!({ "content": file.text }))
            }
            "evaluate" => self.evaluate(&arguments(request)?),
            "completions" => {
                let Expression { expression, .. } = arguments(request)?;
                let console = self.console.as_mut().ok_or("nothing was launched")?;
                let (start, words) = console.complete(&expression);
                let length = expression.len() - start;
                let targets =
                    words.iter().map(|word| json!({ "label": word, "start": start, "length": length }));
                done(json!({ "targets": targets.collect::<Vec<_>>() }))
            }
            "pause" => {
                // It stands already, or it would not have come to this.
                self.interrupt.store(false, Ordering::Relaxed);
                done(Value::Null)
            }
            command => {
                let (direction, goal) = match command {
                    "continue" => (Direction::Forward, Goal::End),
                    "next" => (Direction::Forward, Goal::Over),
                    "stepIn" => (Direction::Forward, Goal::Into),
                    "stepOut" => (Direction::Forward, Goal::Out),
                    "stepBack" => (Direction::Backward, Goal::Over),
                    "reverseContinue" => (Direction::Backward, Goal::End),
                    _ => return Err(format!("`{command}` is not known here")),
                };
                if goal != Goal::End {
                    view(debugger)?;
                }
                goes(direction, goal)
            }
        }
    }

    fn launched(&mut self, launch: &Launch) -> Answer {
        let mut debugger = (self.launch)(launch)?;
        debugger.set_interrupt(self.interrupt.clone());
        self.stops_on_entry = launch.stop_on_entry;
        self.console = Some(Console::new(debugger));
        Ok((Value::Null, Then::Ready))
    }

    fn debugger(&mut self) -> Result<&mut Debugger, String> {
        Ok(self.console.as_mut().ok_or("nothing was launched")?.debugger())
    }

    /// Takes away what was set together before.
    fn forget(&mut self, together: &Together) -> Result<(), String> {
        for number in self.set.remove(together).unwrap_or_default() {
            self.debugger()?.delete(number);
        }
        Ok(())
    }

    /// Sets breakpoints instead of those that were set together before.
    fn break_places(&mut self, together: Together, wanted: Vec<(Result<Place, String>, &Wanted)>) -> Answer {
        self.forget(&together)?;
        let (mut numbers, mut bodies) = (Vec::new(), Vec::new());
        for (place, wanted) in wanted {
            let condition = wanted.condition.as_deref().filter(|text| !text.trim().is_empty());
            let condition =
                condition.map(str::parse::<Condition>).transpose().map_err(|error| error.to_string());
            let debugger = self.debugger()?;
            let set = place.and_then(|place| {
                debugger.break_at(place, condition?).cloned().map_err(|error| error.to_string())
            });
            bodies.push(match set {
                Ok(breakpoint) => {
                    numbers.push(breakpoint.number);
                    json!({ "id": breakpoint.number, "verified": true, "line": breakpoint.place.line })
                }
                Err(message) => json!({ "verified": false, "message": message }),
            });
        }
        self.set.insert(together, numbers);
        Ok((json!({ "breakpoints": bodies }), Then::Nothing))
    }

    fn break_lines(&mut self, Breakpoints { source, breakpoints }: &Breakpoints) -> Answer {
        let name = source.path.as_ref().or(source.name.as_ref()).cloned().unwrap_or_default();
        let file = self.debugger()?.target().code.file(&name);
        let place = |wanted: &Wanted| {
            let file = file.ok_or_else(|| format!("{name} is no part of the program"))?;
            Ok(Place { file, line: wanted.line })
        };
        let wanted = breakpoints.iter().map(|wanted| (place(wanted), wanted)).collect();
        self.break_places(Together::Source(file.unwrap_or(usize::MAX)), wanted)
    }

    fn break_labels(&mut self, Breakpoints { breakpoints, .. }: &Breakpoints) -> Answer {
        let code = &self.debugger()?.target().code;
        let place = |wanted: &Wanted| {
            let place = code.label(&wanted.name).and_then(|address| code.place(address));
            place.ok_or_else(|| format!("there is no label `{}`", wanted.name))
        };
        let wanted = breakpoints.iter().map(|wanted| (place(wanted), wanted)).collect();
        self.break_places(Together::Labels, wanted)
    }

    fn watch(&mut self, Breakpoints { breakpoints, .. }: &Breakpoints) -> Answer {
        self.forget(&Together::Values)?;
        let (mut numbers, mut bodies) = (Vec::new(), Vec::new());
        for wanted in breakpoints {
            bodies.push(match self.debugger()?.watch(&wanted.data_id) {
                Ok(watch) => {
                    numbers.push(watch.number);
                    json!({ "id": watch.number, "verified": true })
                }
                Err(error) => json!({ "verified": false, "message": error.to_string() }),
            });
        }
        self.set.insert(Together::Values, numbers);
        Ok((json!({ "breakpoints": bodies }), Then::Nothing))
    }

    /// A name has a value; in the editor's console anything else is a command of the debugger's.
    fn evaluate(&mut self, Expression { expression, context }: &Expression) -> Answer {
        if let Some(value) = self.debugger()?.value(expression.trim()) {
            return Ok((json!({ "result": show(value), "variablesReference": 0 }), Then::Nothing));
        }
        if context.as_deref() != Some("repl") {
            return Err(format!("nothing is called `{expression}`"));
        }
        let before = self.debugger()?.point();
        let console = self.console.as_mut().ok_or("nothing was launched")?;
        let answer = console.execute(expression);
        let moved = self.debugger()?.point() != before;
        let then = match (answer.quits, moved) {
            (true, _) => Then::End,
            (false, true) => Then::Stands(Stop::Step),
            (false, false) => Then::Nothing,
        };
        Ok((json!({ "result": answer.text.trim_end(), "variablesReference": 0 }), then))
    }

    fn go(&mut self, direction: Direction, goal: Goal) -> Result<(), WireError> {
        let Some(console) = &mut self.console else { return Ok(()) };
        match console.debugger().go(direction, goal) {
            Ok(stop) => {
                let ended = matches!(stop, Stop::Ended | Stop::Time);
                // Whoever goes on from the end wants to leave; before that the way back is open.
                if std::mem::replace(&mut self.ended, ended) && ended {
                    return self.event("terminated", Value::Null);
                }
                self.stands(&stop)
            }
            Err(error) => {
                let body = json!({ "category": "stderr", "output": format!("{error}\n") });
                self.event("output", body)?;
                self.event("terminated", Value::Null)
            }
        }
    }

    /// Tells where and why it stands.
    fn stands(&mut self, stop: &Stop) -> Result<(), WireError> {
        let Some(console) = &mut self.console else { return Ok(()) };
        let debugger = console.debugger();
        let (thread, seconds) = (debugger.program() + 1, debugger.seconds());
        let (reason, text) = match stop {
            Stop::Start => ("entry", "at the start".into()),
            Stop::Step => ("step", String::new()),
            Stop::Breakpoint(number) => ("breakpoint", format!("breakpoint {number}")),
            Stop::Watch { name, before, now, .. } => {
                ("data breakpoint", format!("{name} was {}, is {}", show(*before), show(*now)))
            }
            Stop::Time => ("pause", "the time is up".into()),
            Stop::Ended => ("pause", "the programs have ended".into()),
            Stop::Failed(program) => ("exception", format!("program {program} went into its error state")),
            Stop::Interrupted => ("pause", String::new()),
        };
        let numbers: Vec<u32> = match stop {
            Stop::Breakpoint(number) | Stop::Watch { number, .. } => vec![*number],
            _ => Vec::new(),
        };
        let description = format!("{seconds:.6} s {text}");
        let body = json!({
            "reason": reason,
            "description": description.trim_end(),
            "text": text,
            "threadId": thread,
            "allThreadsStopped": true,
            "hitBreakpointIds": numbers,
        });
        self.event("stopped", body)
    }
}

/// The arguments of a request.
fn arguments<T: DeserializeOwned>(request: &Request) -> Result<T, String> {
    let arguments = match &request.arguments {
        Value::Null => json!({}),
        arguments => arguments.clone(),
    };
    serde_json::from_value(arguments).map_err(|error| format!("{}: {error}", request.command))
}

/// The programs that have something to do, and the one in view.
fn threads(debugger: &mut Debugger) -> Value {
    let view = debugger.program();
    let programs = debugger.device().programs().enumerate();
    let active = programs.filter(|(number, program)| *number == view || program.run != ProgramRun::Idle);
    let threads = active.map(|(number, _)| json!({ "id": number + 1, "name": format!("program {number}") }));
    json!({ "threads": threads.collect::<Vec<_>>() })
}

/// Where a program is.
fn stack(debugger: &mut Debugger, program: usize) -> Value {
    let frames = debugger.frames(program);
    let code = &debugger.target().code;
    let frames = frames.into_iter().enumerate().map(|(number, address)| {
        let name = code.routine(address).map_or_else(|| format!("address {address}"), str::to_owned);
        let id = program * 1000 + number + 1;
        match code.place(address) {
            Some(place) => {
                json!({ "id": id, "name": name, "source": source(debugger, place.file), "line": place.line, "column": 1 })
            }
            None => json!({ "id": id, "name": name, "line": 0, "column": 0 }),
        }
    });
    let frames: Vec<_> = frames.collect();
    json!({ "totalFrames": frames.len(), "stackFrames": frames })
}

/// A source: a file, or one that only the debugger has.
fn source(debugger: &Debugger, number: usize) -> Value {
    let file = &debugger.target().code.files[number];
    let path = Path::new(&file.name);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match absolute(path).ok().filter(|path| path.is_file()) {
        Some(path) => json!({ "name": name, "path": path }),
        None => json!({ "name": name, "sourceReference": number + 1 }),
    }
}
