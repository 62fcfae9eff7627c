//! `debug`, scripted, and `dap`, by a client.

mod common;

use common::{PATIENCE, command, directory, refused};
use serde_json::{Value, json};
use std::{
    io::{BufRead, BufReader, Read, Write},
    path::Path,
    process::{Child, ChildStdin, Stdio},
    sync::mpsc,
    thread,
};

/// A move there and back in a subroutine, again and again, and a program that counts.
const STAGE: &str = "\
PRG 0
EO=3
WHILE V1<3
GOSUB 1
V1=V1+1
ENDWHILE
END
SUB 1
X1000
WAITX
X0
WAITX
ENDSUB
PRG 1
WHILE V1<3
V2=V2+1
DELAY=100
ENDWHILE
END
";

/// What is said to commands that are typed.
fn session(directory: &Path, arguments: &[&str], typed: &str) -> String {
    let mut child = command(directory, &[&["debug"], arguments].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(typed.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_session_is_scripted() {
    let directory = directory(&[("stage.prg", STAGE)]);
    let said = session(
        &directory,
        &["stage.prg", "--device", "pmx-2ed", "--at", "0.5:DI1=true"],
        "break 9\ncontinue\nwhere\nwatch DI1\nc\nreverse-continue\nquit\nnever\n",
    );
    assert!(said.contains("(debug) break 9\nbreakpoint 1: stage.prg:9\n"), "{said}");
    assert!(said.contains("#1 PRG0         stage.prg:4  GOSUB 1\n"), "{said}");
    assert!(said.contains("watch 2: DI1 was 0, is 1\n"), "{said}");
    assert!(!said.contains("never"), "{said}");
}

#[test]
fn what_cannot_be_debugged_is_refused() {
    let directory = directory(&[("wrong.prg", "PRG 0\nFOO\nEND\n"), ("good.prg", STAGE)]);
    refused(&directory, &["debug", "none.prg", "--device", "pmx-2ed"], "none.prg: ");
    refused(&directory, &["debug", "good.prg", "--device", "pd42-1140"], "good.prg: ");
    refused(&directory, &["debug", "good.prg", "--device", "pmx-2ed", "--at", "1:NO=true"], "no pin `NO`");
    let output = common::output(&directory, &["debug", "wrong.prg", "--device", "pmx-2ed"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("wrong.prg:2"));
}

/// A motor that is pushed, and a switch that sticks, at a label and at a line.
const FAULTS: &str = "\
[[fault]]
on = { label = \"SUB1\" }
kind = \"stuck_switch\"
pin = \"DI1\"
value = true
[[fault]]
on = { line = 12 }
kind = \"extra_load\"
axis = \"X\"
load = 2.0
";

#[test]
fn faults_come_and_go() {
    let directory = directory(&[
        ("stage.prg", STAGE),
        ("faults.toml", FAULTS),
        ("wrong.toml", &FAULTS.replace("12", "99")),
        ("other.toml", &FAULTS.replace("SUB1", "SUB7")),
    ]);
    let arguments = ["stage.prg", "--device", "pmx-2ed", "--scenario", "faults.toml"];
    let said =
        session(&directory, &arguments, "p DI1\nwatch DI1\nc\np EX\nrc\np DI1\nc\nuntil 5\np EX PX\nquit\n");
    let told = |text: &str| assert!(said.contains(text), "{text}: {said}");
    told("(debug) c\nwatch 1: DI1 was 0, is 1\n");
    told("(debug) rc\nat the start\n0.000000 s, program 0\n    1 > PRG 0\n(debug) p DI1\nDI1 = 0\n");
    told("EX = 1000\nPX = 0\n");
    let wrong = |scenario, expected: &str| {
        refused(&directory, &["debug", "stage.prg", "--device", "pmx-2ed", "--scenario", scenario], expected);
    };
    wrong("wrong.toml", "wrong.toml:7: fault.on: line: nothing of line 99");
    wrong("other.toml", "there is no `SUB7` in stage.prg");

    let mut editor = Editor::start(&directory);
    let launch = json!({ "program": "stage.prg", "device": "pmx-2ed", "stopOnEntry": true, "scenario": "faults.toml" });
    editor.ask("launch", launch);
    editor.event("initialized");
    editor.ask("configurationDone", json!({}));
    editor.stopped("entry", 1);
    assert_eq!(editor.value("DI1"), "0");
    for line in [2, 3, 4, 8, 9] {
        editor.go("stepIn", 1, "step", line);
    }
    assert_eq!(editor.value("DI1"), "1");
}

/// Somebody at a terminal, which is the program's own.
#[cfg(target_os = "linux")]
struct Terminal {
    child: Child,
    keys: std::fs::File,
    screen: mpsc::Receiver<Vec<u8>>,
    said: String,
}

#[cfg(target_os = "linux")]
impl Terminal {
    /// `setsid` of util-linux makes the terminal the one whose Ctrl-C is a signal.
    fn start(directory: &Path, arguments: &[&str]) -> Self {
        use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&master).unwrap();
        unlockpt(&master).unwrap();
        let name = ptsname(&master, Vec::new()).unwrap().into_string().unwrap();
        let open = || std::fs::OpenOptions::new().read(true).write(true).open(&name).unwrap();
        let child = std::process::Command::new("setsid")
            .args(["--ctty", env!("CARGO_BIN_EXE_pulsetrain")])
            .args(arguments)
            .current_dir(directory)
            .env("TERM", "xterm")
            .stdin(open())
            .stdout(open())
            .stderr(open())
            .spawn()
            .unwrap();
        let keys = std::fs::File::from(master);
        let mut output = keys.try_clone().unwrap();
        let (sender, screen) = mpsc::channel();
        thread::spawn(move || {
            let mut buffer = [0; 4096];
            while let Ok(count @ 1..) = output.read(&mut buffer) {
                if sender.send(buffer[..count].to_vec()).is_err() {
                    return;
                }
            }
        });
        Self { child, keys, screen, said: String::new() }
    }

    fn press(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).unwrap();
    }

    /// Whether this text comes within so long; what came before it is forgotten.
    fn says(&mut self, text: &str, patience: std::time::Duration) -> bool {
        let end = std::time::Instant::now() + patience;
        loop {
            if let Some(at) = self.said.find(text) {
                self.said.drain(..at + text.len());
                return true;
            }
            let left = end.saturating_duration_since(std::time::Instant::now());
            match self.screen.recv_timeout(left) {
                Ok(bytes) => self.said += &String::from_utf8_lossy(&bytes),
                Err(_) => return false,
            }
        }
    }

    #[track_caller]
    fn expect(&mut self, text: &str) {
        assert!(self.says(text, PATIENCE), "`{text}` does not come: {}", self.said);
    }
}

#[cfg(target_os = "linux")]
impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
#[cfg(target_os = "linux")]
fn control_c_stops_what_runs_and_nothing_else() {
    let directory = directory(&[("loop.tmc", "l: JA l\n")]);
    let arguments = ["debug", "loop.tmc", "--device", "pd42-1140", "--for", "1000000"];
    let mut terminal = Terminal::start(&directory, &arguments);
    terminal.expect("(debug) ");
    terminal.press("\x03");
    terminal.expect("nothing runs; `quit` or Ctrl-D leaves");
    terminal.expect("(debug) ");
    for command in ["continue\r", "until 900000s\r"] {
        terminal.press(command);
        // The terminal takes it for a key until the line has been read.
        while {
            terminal.press("\x03");
            !terminal.says("interrupted", std::time::Duration::from_millis(100))
        } {
            assert!(terminal.child.try_wait().unwrap().is_none(), "it has ended: {}", terminal.said);
        }
        terminal.expect("l: JA l");
        terminal.expect("(debug) ");
    }
    terminal.press("print A\r");
    terminal.expect("A = 0");
    terminal.press("quit\r");
    assert_eq!(terminal.child.wait().unwrap().code(), Some(0));
}

/// An editor.
struct Editor {
    child: Child,
    input: ChildStdin,
    messages: mpsc::Receiver<Value>,
    seq: i64,
}

impl Editor {
    fn start(directory: &Path) -> Self {
        let mut child =
            command(directory, &["dap"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let (input, output) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let (sender, messages) = mpsc::channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            loop {
                let mut header = String::new();
                if output.read_line(&mut header).unwrap() == 0 {
                    return;
                }
                let length =
                    header.trim().strip_prefix("Content-Length: ").expect("a header").parse().unwrap();
                output.read_line(&mut header).unwrap();
                let mut message = vec![0; length];
                output.read_exact(&mut message).unwrap();
                let _ = sender.send(serde_json::from_slice(&message).unwrap());
            }
        });
        Self { child, input, messages, seq: 0 }
    }

    fn send(&mut self, command: &str, arguments: Value) {
        self.seq += 1;
        let request =
            json!({ "seq": self.seq, "type": "request", "command": command, "arguments": arguments });
        let text = request.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
    }

    fn message(&self) -> Value {
        self.messages.recv_timeout(PATIENCE).expect("one more message")
    }

    /// Asks, and gives the body of the answer.
    #[track_caller]
    fn ask(&mut self, command: &str, arguments: Value) -> Value {
        self.send(command, arguments);
        let answer = self.message();
        assert_eq!(answer["request_seq"], self.seq, "{answer}");
        assert_eq!(answer["success"], true, "{answer}");
        answer["body"].clone()
    }

    /// The event that comes next.
    #[track_caller]
    fn event(&self, name: &str) -> Value {
        let event = self.message();
        assert_eq!(event["event"], name, "{event}");
        event["body"].clone()
    }

    /// Goes somewhere and stops there, for this reason, in this line of this program.
    #[track_caller]
    fn go(&mut self, command: &str, thread: usize, reason: &str, line: usize) {
        self.ask(command, json!({ "threadId": thread }));
        self.stopped(reason, line);
    }

    #[track_caller]
    fn stopped(&mut self, reason: &str, line: usize) {
        let stopped = self.event("stopped");
        assert_eq!(stopped["reason"], reason, "{stopped}");
        let stack = self.ask("stackTrace", json!({ "threadId": stopped["threadId"] }));
        assert_eq!(stack["stackFrames"][0]["line"], line, "{stopped} {stack}");
    }

    #[track_caller]
    fn value(&mut self, name: &str) -> Value {
        self.ask("evaluate", json!({ "expression": name, "context": "watch" }))["result"].clone()
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn an_editor_steps_to_and_fro() {
    let directory = directory(&[("stage.prg", STAGE)]);
    let mut editor = Editor::start(&directory);
    let can = editor.ask("initialize", json!({ "adapterID": "pulsetrain" }));
    assert_eq!(
        (&can["supportsStepBack"], &can["supportsConfigurationDoneRequest"]),
        (&json!(true), &json!(true))
    );
    let program = directory.join("stage.prg");
    editor.ask("launch", json!({ "program": program, "device": "pmx-2ed", "stopOnEntry": true, "for": 60 }));
    editor.event("initialized");
    let set = editor.ask(
        "setBreakpoints",
        json!({ "source": { "path": program }, "breakpoints": [{ "line": 8 }, { "line": 9, "condition": "V1 = 2" }] }),
    );
    assert_eq!(
        (&set["breakpoints"][0]["verified"], &set["breakpoints"][0]["line"]),
        (&json!(true), &json!(8))
    );
    editor.ask("configurationDone", json!({}));
    editor.stopped("entry", 1);
    let threads = editor.ask("threads", json!({}));
    assert_eq!(threads["threads"].as_array().map(Vec::len), Some(2), "{threads}");

    editor.go("next", 1, "step", 2);
    editor.go("next", 1, "step", 3);
    editor.go("next", 1, "step", 4);
    // The subroutine begins with a breakpoint.
    editor.go("stepIn", 1, "breakpoint", 8);
    editor.go("stepIn", 1, "step", 9);
    let stack = editor.ask("stackTrace", json!({ "threadId": 1 }));
    let names: Vec<_> = stack["stackFrames"].as_array().unwrap().iter().map(|frame| &frame["name"]).collect();
    assert_eq!(names, ["SUB1", "PRG0"]);
    assert_eq!(stack["stackFrames"][1]["line"], 4);
    editor.go("stepOut", 1, "step", 5);
    let after = editor.value("PX");
    editor.go("stepBack", 1, "breakpoint", 8);
    editor.go("stepBack", 1, "step", 4);
    editor.go("continue", 1, "breakpoint", 8);
    editor.go("stepOut", 1, "step", 5);
    assert_eq!(editor.value("PX"), after, "the same again");

    // Twice the unconditional one, then the one with a condition.
    editor.go("continue", 1, "breakpoint", 8);
    editor.go("continue", 1, "breakpoint", 8);
    editor.go("continue", 1, "breakpoint", 9);
    assert_eq!(editor.value("V1"), "2");
    editor.go("reverseContinue", 1, "breakpoint", 8);
    editor.go("reverseContinue", 1, "breakpoint", 8);
    assert_eq!(editor.value("V1"), "1");
    editor.go("reverseContinue", 1, "breakpoint", 8);
    editor.go("reverseContinue", 1, "entry", 1);

    let scopes = editor.ask("scopes", json!({ "frameId": 1 }));
    let scope = |name: &str| {
        let scopes = scopes["scopes"].as_array().unwrap();
        scopes.iter().find(|scope| scope["name"] == name).unwrap()["variablesReference"].clone()
    };
    let variables = editor.ask("variables", json!({ "variablesReference": scope("Variables") }));
    assert_eq!(
        variables["variables"][1],
        json!({ "name": "V1", "value": "0", "variablesReference": 0, "evaluateName": "V1" })
    );
    let pins = editor.ask("variables", json!({ "variablesReference": scope("Pins") }));
    assert!(pins["variables"].as_array().unwrap().iter().any(|pin| pin["name"] == "+LX"), "{pins}");
    let axes = editor.ask("variables", json!({ "variablesReference": scope("Axes") }));
    let x =
        editor.ask("variables", json!({ "variablesReference": axes["variables"][0]["variablesReference"] }));
    assert_eq!(
        x["variables"][0],
        json!({ "name": "position", "value": "0", "variablesReference": 0, "evaluateName": "PX" })
    );
    let x = axes["variables"][0]["variablesReference"].clone();
    let set = json!({ "variablesReference": x, "name": "position", "value": "7" });
    assert_eq!(editor.ask("setVariable", set)["value"], "7");
    assert_eq!(editor.value("PX"), "7");

    // Another value, and another course.
    let set = json!({ "variablesReference": scope("Variables"), "name": "V1", "value": "2" });
    assert_eq!(editor.ask("setVariable", set)["value"], "2");
    editor.ask("setBreakpoints", json!({ "source": { "path": program }, "breakpoints": [] }));
    let id = editor.ask("dataBreakpointInfo", json!({ "name": "V1" }))["dataId"].clone();
    editor.ask("setDataBreakpoints", json!({ "breakpoints": [{ "dataId": id }] }));
    editor.go("continue", 1, "data breakpoint", 6);
    assert_eq!(editor.value("V1"), "3");
    let said = editor.ask("evaluate", json!({ "expression": "axes", "context": "repl" }));
    assert!(said["result"].as_str().unwrap().starts_with("axis "), "{said}");
    editor.ask("continue", json!({ "threadId": 1 }));
    assert_eq!(editor.event("stopped")["text"], "the programs have ended");
    editor.ask("disconnect", json!({}));
    assert_eq!(editor.child.wait().unwrap().code(), Some(0));
}

#[test]
fn an_editor_is_told_what_is_wrong() {
    let directory = directory(&[("wrong.tmc", "MVP FOO\n"), ("loop.tmc", "l: JA l\n")]);
    let mut editor = Editor::start(&directory);
    let fails = |editor: &mut Editor, command: &str, arguments: Value, expected: &str| {
        editor.send(command, arguments);
        let answer = editor.message();
        assert_eq!(answer["success"], false, "{answer}");
        assert!(answer["message"].as_str().unwrap().contains(expected), "{answer}");
    };
    fails(&mut editor, "next", json!({}), "nothing was launched");
    fails(&mut editor, "launch", json!({ "program": "wrong.tmc" }), "device");
    fails(&mut editor, "launch", json!({ "program": "wrong.tmc", "device": "x" }), "unknown model `x`");
    fails(&mut editor, "launch", json!({ "program": "wrong.tmc", "device": "pd42-1140" }), "wrong.tmc:1:");
    editor.ask("launch", json!({ "program": "loop.tmc", "device": "pd42-1140" }));
    editor.event("initialized");
    let set = json!({ "source": { "path": "loop.tmc" }, "breakpoints": [{ "line": 9 }, { "line": 1, "condition": "?" }] });
    let set = editor.ask("setBreakpoints", set);
    assert_eq!(
        (&set["breakpoints"][0]["verified"], &set["breakpoints"][1]["verified"]),
        (&json!(false), &json!(false))
    );
    fails(&mut editor, "evaluate", json!({ "expression": "NONE" }), "nothing is called `NONE`");
    fails(&mut editor, "dance", json!({}), "`dance` is not known");
    // It runs for ever, until somebody stops it.
    editor.ask("configurationDone", json!({}));
    editor.send("pause", json!({ "threadId": 1 }));
    assert_eq!(editor.event("stopped")["reason"], "pause");
    assert_eq!(editor.message()["command"], "pause");
}
