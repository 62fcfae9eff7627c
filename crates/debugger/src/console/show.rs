//! What the console shows.

use crate::{
    Debugger,
    code::Place,
    stop::{Breakpoint, Stop, Watch, show as value},
};
use devices::{ProgramRun, inspect::Scope};
use sim::{PinValue, VirtualDevice};
use std::fmt::Write as _;

/// Lines that are shown before and behind a place.
const AROUND: usize = 5;

/// Writing to a string.
macro_rules! line {
    ($text:expr, $($format:tt)*) => { writeln!($text, $($format)*).expect("a string takes everything") };
}

/// Why the device stands, and where.
pub fn stop(debugger: &mut Debugger, stop: &Stop) -> String {
    let mut text = match stop {
        Stop::Start => "at the start\n".into(),
        Stop::Step => String::new(),
        Stop::Breakpoint(number) => format!("breakpoint {number}\n"),
        Stop::Watch { number, name, before, now } => {
            format!("watch {number}: {name} was {}, is {}\n", value(*before), value(*now))
        }
        Stop::Time => "the time is up\n".into(),
        Stop::Ended => "the programs have ended\n".into(),
        Stop::Failed(program) => format!("program {program} went into its error state\n"),
        Stop::Interrupted => "interrupted\n".into(),
    };
    text += &here(debugger);
    text
}

/// The time, and the line of the program in view.
pub fn here(debugger: &mut Debugger) -> String {
    let (program, seconds) = (debugger.program(), debugger.seconds());
    let several = debugger.device().programs().count() > 1;
    let which = if several { format!(", program {program}") } else { String::new() };
    let mut text = format!("{seconds:.6} s{which}\n");
    match debugger.place(program) {
        Some(place) => {
            let (next, code) = (debugger.is_next(program), &debugger.target().code);
            let sign = if next { '>' } else { ' ' };
            line!(text, "{:>5} {sign} {}", place.line, code.text(place).unwrap_or_default().trim_end());
        }
        None => text += "      behind the end of the program\n",
    }
    text
}

/// A breakpoint.
pub fn breakpoint(debugger: &Debugger, breakpoint: &Breakpoint) -> String {
    let Breakpoint { number, place, condition, .. } = breakpoint;
    let condition = condition.as_ref().map(|condition| format!(" if {condition}")).unwrap_or_default();
    format!("breakpoint {number}: {}{condition}\n", name(debugger, *place))
}

/// A watch.
pub fn watch(watch: &Watch) -> String {
    format!("watch {}: {} = {}\n", watch.number, watch.name, value(watch.value))
}

/// All of them.
pub fn breakpoints(debugger: &mut Debugger) -> String {
    let breakpoints = debugger.breakpoints().iter().map(|it| breakpoint(debugger, it));
    breakpoints.chain(debugger.watches().iter().map(watch)).collect()
}

fn name(debugger: &Debugger, place: Place) -> String {
    let file = debugger.target().code.files.get(place.file);
    format!("{}:{}", file.map_or("?", |file| file.name.as_str()), place.line)
}

/// All variables that are not 0.
pub fn variables(device: &mut VirtualDevice) -> String {
    let mut text = String::new();
    for quantity in device.quantities().iter().filter(|quantity| quantity.scope == Scope::Variables) {
        let found = device.value(&quantity.name);
        if let Some(found) = found.filter(|found| *found != PinValue::Number(0.0)) {
            line!(text, "{} = {}", quantity.name, value(found));
        }
    }
    if text.is_empty() { "all variables are 0\n".into() } else { text }
}

/// What the axes do.
pub fn axes(device: &mut VirtualDevice) -> String {
    let head = ["axis", "position", "encoder", "target", "speed", "status"];
    let mut text = String::new();
    let mut row = |cells: [String; 6]| {
        let [axis, rest @ ..] = cells;
        let rest: String = rest.iter().map(|cell| format!("{cell:>12}")).collect();
        line!(text, "{axis:<4}{rest}");
    };
    row(head.map(String::from));
    for (number, name) in device.axes().iter().enumerate() {
        let axis = device.axis(number);
        let speed = axis.speed_mpps as f64 / 1000.0;
        row([
            (*name).into(),
            axis.position.to_string(),
            axis.encoder.to_string(),
            axis.target.to_string(),
            format!("{speed:.1}"),
            axis.status.to_string(),
        ]);
    }
    text
}

/// The routines that the program in view is in.
pub fn frames(debugger: &mut Debugger) -> String {
    let mut text = String::new();
    for (number, address) in debugger.frames(debugger.program()).into_iter().enumerate() {
        let code = &debugger.target().code;
        let routine = code.routine(address).unwrap_or("-");
        match code.place(address) {
            Some(place) => {
                let source = code.text(place).unwrap_or_default().trim();
                line!(text, "#{number} {routine:<12} {}  {source}", name(debugger, place));
            }
            None => line!(text, "#{number} {routine:<12} address {address}"),
        }
    }
    text
}

/// All programs.
pub fn programs(debugger: &mut Debugger) -> String {
    let mut text = String::new();
    let states: Vec<_> = debugger.device().programs().map(|program| program.run).collect();
    for (program, run) in states.into_iter().enumerate() {
        let sign = if program == debugger.program() { '>' } else { ' ' };
        let state = match run {
            ProgramRun::Idle => "idle",
            ProgramRun::Running => "running",
            ProgramRun::Paused => "paused",
            ProgramRun::Error => "error",
        };
        let place = debugger.place(program).filter(|_| run != ProgramRun::Idle);
        let place = place.map(|place| name(debugger, place)).unwrap_or_default();
        line!(text, "{sign} {program} {state:<8} {place}");
    }
    text
}

/// The source around a place: `>` is where the program in view is, `*` a breakpoint.
pub fn list(debugger: &mut Debugger, place: Place) -> String {
    let here = debugger.place(debugger.program());
    let code = &debugger.target().code;
    let mut text = String::new();
    for line in place.line.saturating_sub(AROUND).max(1)..=place.line + AROUND {
        let place = Place { line, ..place };
        let Some(source) = code.text(place) else { break };
        let sign = if here == Some(place) { '>' } else { ' ' };
        let stops = debugger.breakpoints().iter().any(|breakpoint| breakpoint.place == place);
        line!(text, "{:>5}{}{sign} {}", line, if stops { '*' } else { ' ' }, source.trim_end());
    }
    text
}
