//! Programs on the real controllers.

use super::*;
use crate::{
    config::DeviceConfig,
    device::{Input, PinValue},
    record,
};
use ::tmcl::Command;
use protocol::tmcl::Status;

const MVP: u8 = 4;
const ROR: u8 = 1;
const JA: u8 = 22;
const WAIT: u8 = 27;
const END: u8 = 28;

fn program(commands: &[(u8, u8, u8, i32)]) -> Program {
    let command = |&(opcode, kind, motor, value)| Command { opcode, kind, motor, value };
    Program::Tmcl(commands.iter().map(command).collect())
}

fn device() -> VirtualDevice {
    VirtualDevice::new(&DeviceConfig::new(devices::model("pd42-1140").unwrap()), 1)
}

/// There and back, with rests.
fn there_and_back() -> Program {
    program(&[
        (MVP, 0, 0, 51_200),
        (WAIT, 1, 0, 0),
        (WAIT, 0, 0, 20),
        (MVP, 0, 0, -25_600),
        (WAIT, 1, 0, 0),
        (MVP, 0, 0, 0),
        (WAIT, 1, 0, 0),
        (END, 0, 0, 0),
    ])
}

#[test]
fn a_program_runs_to_its_end() {
    let result = run(&mut device(), &there_and_back(), &RunOptions::default(), |_| ()).unwrap();
    assert_eq!(result.stop_reason, StopReason::Ended);
    assert_eq!(result.instructions, 8);
    let axis = result.axes["0"];
    assert_eq!((axis.position, axis.encoder, axis.steps), (0, 0, 2 * 51_200 + 2 * 25_600));
    let json = serde_json::to_value(&result).unwrap();
    assert_eq!(json["stop_reason"], "ended");
    assert_eq!(json["axes"]["0"]["steps"], 153_600);
}

#[test]
fn the_last_move_comes_to_its_end() {
    let program = program(&[(MVP, 0, 0, 51_200), (END, 0, 0, 0)]);
    let result = run(&mut device(), &program, &RunOptions::default(), |_| ()).unwrap();
    assert_eq!((result.stop_reason, result.axes["0"].position), (StopReason::Ended, 51_200));
}

#[test]
fn the_time_is_a_limit() {
    let program = program(&[(ROR, 0, 0, 500), (JA, 0, 0, 1)]);
    let options = RunOptions { for_seconds: Some(1.5), inputs: Vec::new(), ..RunOptions::default() };
    let mut reports = 0;
    let result = run(&mut device(), &program, &options, |_| reports += 1).unwrap();
    assert_eq!((result.stop_reason, result.device_seconds), (StopReason::TimeUp, 1.5));
    assert!(reports >= 10, "{reports}");
    // One command takes 50 us, and the first is at 0.
    assert_eq!(result.instructions, 30_001);
}

#[test]
fn planned_inputs_count_from_the_start() {
    let program = program(&[(ROR, 0, 0, 500), (JA, 0, 0, 1)]);
    let input = Input { pin: "STOP_R".into(), value: Some(PinValue::Level(true)) };
    let stop = TimedInput { seconds: 0.5, input };
    let options = RunOptions { for_seconds: Some(2.0), inputs: vec![stop], ..RunOptions::default() };
    let mut module = device();
    let stopped = run(&mut module, &program, &options, |_| ()).unwrap().axes["0"].steps;
    let free = RunOptions { for_seconds: Some(2.0), inputs: Vec::new(), ..RunOptions::default() };
    let gone = run(&mut device(), &program, &free, |_| ()).unwrap().axes["0"].steps;
    assert!(stopped > 0 && stopped < gone / 2, "{stopped} of {gone}");
    let unknown = TimedInput { seconds: 0.5, input: Input { pin: "DI1".into(), value: None } };
    let options = RunOptions { for_seconds: None, inputs: vec![unknown], ..RunOptions::default() };
    assert!(matches!(
        run(&mut module, &program, &options, |_| ()),
        Err(RunError::Pin(PinError::Unknown { .. }))
    ));
}

#[test]
fn programs_that_cannot_be_loaded() {
    // The module protects its memory when global parameter 81 is 2.
    let mut module = device();
    let protect = Command { opcode: 9, kind: 81, motor: 0, value: 2 };
    tmcl::send(&mut module, "the lock", protect, Status::OK).unwrap();
    let refused = run(&mut module, &there_and_back(), &RunOptions::default(), |_| ());
    let expected = "the device answers status 5 to the begin of the download";
    assert_eq!(refused.unwrap_err().to_string(), expected);
    let foreign = run(&mut device(), &Program::Ascript(Vec::new()), &RunOptions::default(), |_| ());
    assert_eq!(foreign.unwrap_err().to_string(), "a pd42-1140 has programs of another language");
}

/// What a plot says of a run; the picture itself is for people.
#[test]
fn a_run_is_recorded() {
    let directory = std::env::temp_dir().join(format!("pulsetrain-run-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let mut module = device();
    for name in ["run.csv", "run.mcap", "run.svg", "run.vcd"] {
        let recorder = record::create(&directory.join(name), &module.record_info()).unwrap();
        module.add_recorder(recorder);
    }
    let result = run(&mut module, &there_and_back(), &RunOptions::default(), |_| ()).unwrap();
    module.finish_recordings().unwrap();
    let csv = std::fs::read_to_string(directory.join("run.csv")).unwrap();
    let rows = |event: &str| csv.lines().filter(|line| line.split(',').nth(1) == Some(event)).count();
    assert_eq!((rows("target_reached"), rows("stopped")), (3, 0));
    // One a millisecond, and one of the end.
    assert_eq!(rows("sample"), (result.device_seconds * 1000.0) as usize + 2);
    let svg = std::fs::read_to_string(directory.join("run.svg")).unwrap();
    for text in
        ["pd42-1140", "position", "speed", "acceleration", "target reached", "switch", "HOME", "time / s"]
    {
        assert!(svg.contains(text), "{text}");
    }
    assert!(svg.len() < 200_000, "{} bytes", svg.len());
    let rises = std::fs::read(directory.join("run.vcd")).unwrap();
    let mut rises = vcd::Parser::new(&rises[..]);
    let step = rises.parse_header().unwrap().find_var(&["pd42-1140", "axis_0", "step_0"]).unwrap().code;
    let rise = vcd::Command::ChangeScalar(step, vcd::Value::V1);
    let rises = rises.filter(|command| command.as_ref().is_ok_and(|command| *command == rise)).count();
    assert_eq!(rises as u64, result.axes["0"].steps);
    let messages = std::fs::read(directory.join("run.mcap")).unwrap();
    let messages = mcap::MessageStream::new(&messages).unwrap().map(Result::unwrap);
    let last = messages.filter(|message| message.channel.topic == "/pd42-1140/axis/0").last().unwrap();
    let last: serde_json::Value = serde_json::from_slice(&last.data).unwrap();
    assert_eq!(last["position"], result.axes["0"].position);
    std::fs::remove_dir_all(directory).unwrap();
    let error = record::create(std::path::Path::new("a.xyz"), &module.record_info()).err().unwrap();
    let known = record::FORMATS;
    assert_eq!(error.to_string(), format!("a.xyz: no recording format with this extension, known: {known}"));
}

fn stage() -> VirtualDevice {
    VirtualDevice::new(&DeviceConfig::new(devices::model("pmx-2ed").unwrap()), 1)
}

fn ascript(source: &str) -> Program {
    let compilation = ::ascript::compile("test.prg", source.as_bytes(), &::ascript::dialect::PERFORMAX_2);
    Program::Ascript(compilation.code.unwrap_or_else(|| panic!("{:?}", compilation.diagnostics)).lines)
}

#[test]
fn all_programs_of_a_file_run() {
    let both = ascript("PRG 0\nEO=3\nX4000\nWAITX\nEND\nPRG 1\nDELAY=50\nY-300\nWAITY\nV9=7\nEND\n");
    let mut device = stage();
    let result = run(&mut device, &both, &RunOptions::default(), |_| ()).unwrap();
    assert_eq!((result.stop_reason, result.instructions), (StopReason::Ended, 11));
    let axis = |name: &str| (result.axes[name].position, result.axes[name].encoder, result.axes[name].steps);
    assert_eq!((axis("X"), axis("Y")), ((4000, 4000, 4000), (-300, -300, 300)));
    assert_eq!(exchange(&mut device, b"V9\r").unwrap(), b"7\r");
    // One program alone, and again on the same controller, in place of the old ones.
    let one = ascript("INC\nX-1000\nWAITX\nEND\n");
    for position in [3000, 2000] {
        let result = run(&mut device, &one, &RunOptions::default(), |_| ()).unwrap();
        assert_eq!((result.axes["X"].position, result.axes["Y"].position), (position, -300));
    }
}

#[test]
fn a_program_that_fails_ends_the_run() {
    let source = "EO=1\nHSPD=5000\nJOGX+\nWAITX\nEND\nPRG 1\nWHILE 1=1\nENDWHILE\nEND\n";
    let input = Input { pin: "+LX".into(), value: Some(PinValue::Level(true)) };
    let options = RunOptions {
        for_seconds: Some(10.0),
        inputs: vec![TimedInput { seconds: 0.5, input }],
        ..RunOptions::default()
    };
    let result = run(&mut stage(), &ascript(source), &options, |_| ()).unwrap();
    assert_eq!(result.stop_reason, StopReason::Error);
    assert!((0.5..0.51).contains(&result.device_seconds), "{}", result.device_seconds);
}

#[test]
fn lines_that_a_controller_refuses() {
    let too_long = Program::Ascript(vec![::ascript::Line::End; 1276]);
    let refused = run(&mut stage(), &too_long, &RunOptions::default(), |_| ());
    let expected = "the device answers `?Index out of Range` to `SA1275=END`";
    assert_eq!(refused.unwrap_err().to_string(), expected);
    let foreign = run(&mut stage(), &there_and_back(), &RunOptions::default(), |_| ());
    assert_eq!(foreign.unwrap_err().to_string(), "a pmx-2ed has programs of another language");
}
