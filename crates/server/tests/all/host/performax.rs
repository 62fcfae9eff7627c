//! A PMX-2ED-SA.

use super::stand::{RUNTIME, Stand, device, targets};
use ascript::{compile, dialect::PERFORMAX_2};
use host::{Action, Code, Direction, Key, Level, Model, ProgramAction, ProgramState, Value};

fn x() -> String {
    "X".into()
}

fn move_to(goals: &[(&str, i32)], relative: bool) -> Action {
    Action::Move { targets: targets(goals), relative }
}

fn jog(direction: Direction, speed: i32) -> Action {
    Action::Jog { axis: x(), direction, speed: Some(speed), held: false }
}

#[test]
fn jogging_and_stopping() {
    let stand = Stand::new(Model::Pmx2ed);
    let before = stand.status();
    assert_eq!(before.axes.keys().collect::<Vec<_>>(), ["X", "Y"]);
    assert_eq!((before.axes["X"].state.as_str(), before.axes["X"].enabled), ("idle", Some(true)));
    stand.act(Action::Power { axis: "Y".into(), on: false });
    stand.act(jog(Direction::Negative, 5000));
    let there = stand.until("full speed", |status| status.axes["X"].state == "constant speed");
    let axis = &there.axes["X"];
    assert_eq!(
        (axis.speed, axis.enabled, axis.flags.as_slice()),
        (-5000, Some(true), &["constant speed".into()][..])
    );
    assert_eq!((there.axes["Y"].state.as_str(), there.axes["Y"].enabled), ("idle", Some(false)));
    assert_eq!(stand.refused(jog(Direction::Negative, 5000)), "?Moving");
    stand.act(Action::Stop { axis: Some(x()) });
    let rest = stand.at_rest("X");
    assert!(rest.position < 0 && rest.speed == 0, "{rest:?}");
    // The encoder turned with the motor.
    assert_eq!(rest.encoder, Some(rest.position));
    stand.act(jog(Direction::Positive, 5000));
    stand.act(Action::Abort { axis: None });
    assert_eq!(stand.axis("X").state, "idle");
    stand.stop();
}

#[test]
fn moves() {
    let stand = Stand::new(Model::Pmx2ed);
    stand.write("HSPD", Value::Number(50_000));
    stand.act(move_to(&[("X", 10_000)], false));
    stand.until("arrived", |status| status.axes["X"].position == 10_000);
    assert_eq!(stand.axis("X").target, Some(10_000));
    stand.act(move_to(&[("X", -4000)], true));
    stand.until("arrived", |status| status.axes["X"].position == 6000);
    assert_eq!(stand.axis("X").target, Some(6000));
    // Along a line, both are where they should be all the time.
    stand.at_rest("X");
    stand.act(move_to(&[("X", 16_000), ("Y", -20_000)], false));
    stand.until("on the way", |status| status.axes["Y"].position < -2000);
    stand.until("arrived", |status| {
        (status.axes["X"].position, status.axes["Y"].position) == (16_000, -20_000)
    });
    assert_eq!(stand.status().absolute, Some(true));
    stand.act(Action::SetMode { absolute: false });
    stand.at_rest("Y");
    stand.act(move_to(&[("Y", 0)], false));
    stand.until("arrived", |status| status.axes["Y"].position == 0);
    assert_eq!(stand.status().absolute, Some(false));
    stand.stop();
}

#[test]
fn limits_and_their_errors() {
    let stand = Stand::with(Model::Pmx2ed, device(Model::Pmx2ed, [-3000, 3000]));
    stand.act(jog(Direction::Positive, 5000));
    let hit = stand.until("hit", |status| status.axes["X"].error.is_some());
    let axis = &hit.axes["X"];
    assert_eq!(axis.error.as_deref(), Some("plus limit error"));
    assert_eq!((axis.positive_limit, axis.negative_limit), (Some(true), Some(false)));
    assert_eq!(hit.alarms, ["X: plus limit error"]);
    assert_eq!(stand.refused(move_to(&[("X", 0)], false)), "?State Error");
    stand.act(Action::ClearError { axis: x() });
    assert_eq!(stand.axis("X").error, None);
    stand.act(move_to(&[("X", 0)], false));
    let back = stand.until("back", |status| status.axes["X"].position == 0);
    assert_eq!((back.axes["X"].positive_limit, back.alarms.len()), (Some(false), 0));
    stand.stop();
}

#[test]
fn every_way_of_homing() {
    for mode in 0..5 {
        // The home switch is from -200 to 0, the index at every 4000th pulse.
        let stand = Stand::with(Model::Pmx2ed, device(Model::Pmx2ed, [-7000, 7000]));
        stand.write("HSPD", Value::Number(4000));
        stand.write("LSPD", Value::Number(1000));
        stand.act(move_to(&[("X", 3000)], false));
        stand.until("arrived", |status| status.axes["X"].position == 3000);
        stand.at_rest("X");
        stand.act(Action::Home { axis: x(), mode, direction: Direction::Negative });
        stand.until("on the way", |status| status.axes["X"].state != "idle");
        let home = stand.at_rest("X");
        assert_eq!(home.error, None, "mode {mode}");
        // Where it is on the machine, by the encoder's index: zero is where the switch or the mark was found.
        let braking = if mode == 0 { 2000 } else { 0 };
        assert!((-braking..=0).contains(&home.position), "mode {mode}: {}", home.position);
        stand.stop();
    }
}

#[test]
fn counters_and_changes_on_the_fly() {
    let stand = Stand::new(Model::Pmx2ed);
    stand.act(Action::SetPosition { axis: x(), value: 1234 });
    stand.act(Action::SetEncoder { axis: x(), value: -77 });
    let axis = stand.axis("X");
    assert_eq!((axis.position, axis.encoder), (1234, Some(-77)));
    let change = |speed, mode| Action::ChangeSpeed { axis: x(), speed, acceleration: None, mode };
    assert_eq!(stand.refused(change(2000, None)), "?SSPD Mode not Initialized");
    stand.write("SSPDMX", Value::Number(1));
    stand.act(jog(Direction::Positive, 1000));
    stand.until("full speed", |status| status.axes["X"].speed == 1000);
    stand.act(change(3000, None));
    stand.until("another speed", |status| status.axes["X"].speed == 3000);
    assert_eq!(stand.refused(change(3000, Some(2))), "?Moving");
    stand.act(Action::Abort { axis: Some(x()) });
    stand.act(move_to(&[("X", 900_000)], false));
    stand.act(Action::ChangeTarget { axis: x(), target: 2000 });
    stand.until("arrived", |status| status.axes["X"].position == 2000);
    stand.at_rest("X");
    let change = Action::ChangeTarget { axis: x(), target: 2000 };
    assert_eq!(stand.refused(change), "?ABS/INC is not in operation");
    stand.stop();
}

#[test]
fn inputs_and_outputs() {
    let stand = Stand::new(Model::Pmx2ed);
    stand.act(Action::Output { name: "DO3".into(), value: Level::Digital(true) });
    stand.act(Action::Output { name: "EO2".into(), value: Level::Digital(false) });
    stand.call("PUT", "pins/DI8", "true");
    stand.call("PUT", "pins/AI1", "1234");
    let status = stand.status();
    assert_eq!(status.inputs.len() + status.outputs.len(), 8 + 2 + 8 + 2);
    assert_eq!(status.outputs["DO3"], Level::Digital(true));
    assert_eq!(status.outputs["DO1"], Level::Digital(false));
    assert_eq!(status.axes["Y"].enabled, Some(false));
    assert_eq!(status.inputs["DI8"], Level::Digital(true));
    assert_eq!(status.inputs["DI1"], Level::Digital(false));
    assert_eq!(status.inputs["AI1"], Level::Analog(1234.0));
    stand.stop();
}

#[test]
fn what_is_stored_outlives_the_power() {
    let stand = Stand::new(Model::Pmx2ed);
    let settings = [
        ("POLX", Value::Number(96)),
        ("SLRX", Value::Decimal(2.5)),
        ("V32", Value::Number(-5)),
        ("V1", Value::Number(7)),
    ];
    for (key, value) in &settings {
        stand.write(key, value.clone());
        assert_eq!(stand.read(key), *value);
    }
    stand.write("DN", Value::Text("2ED07".into()));
    RUNTIME.block_on(stand.controller.store(&[])).unwrap();
    stand.write("HCA", Value::Number(500));
    stand.power_cycle();
    assert_eq!(stand.read("POLX"), Value::Number(96));
    assert_eq!(stand.read("SLRX"), Value::Decimal(2.5));
    assert_eq!(stand.read("V32"), Value::Number(-5));
    assert_eq!(stand.read("V1"), Value::Number(0));
    assert_eq!(stand.read("HCA"), Value::Number(1000));
    assert_eq!(stand.read("DN"), Value::Text("2ED07".into()));
    assert_eq!(RUNTIME.block_on(stand.controller.identify()).unwrap().address, 7);
    let key = |name: &str| name.parse::<Key>().unwrap();
    let defaults = [(key("POLX"), Value::Number(512)), (key("SLRX"), Value::Number(1))];
    RUNTIME.block_on(stand.controller.restore_factory(&defaults)).unwrap();
    stand.power_cycle();
    assert_eq!((stand.read("POLX"), stand.read("SLRX")), (Value::Number(512), Value::Decimal(1.0)));
    stand.stop();
}

/// The program of a source.
fn program(source: &str) -> Code {
    let compilation = compile("test", source.as_bytes(), &PERFORMAX_2);
    Code::Ascript(&PERFORMAX_2, compilation.code.expect(source).lines)
}

#[test]
fn programs_go_down_up_and_run() {
    let stand = Stand::new(Model::Pmx2ed);
    let controller = &stand.controller;
    let long = program(
        "PRG 0\nV1=0\nWHILE 1=1\nV1=V1+1\nDELAY=10\nENDWHILE\nEND\nPRG 1\nV2=5\nEND\nSUB 5\nDO=1\nENDSUB\n",
    );
    let short = program("PRG 0\nHSPD=20000\nX3000\nWAITX\nV3=PX\nEND\n");
    RUNTIME.block_on(async {
        controller.download(&long).await.unwrap();
        assert_eq!(controller.upload().await.unwrap(), long);
        // Of a longer one nothing is left.
        controller.download(&short).await.unwrap();
        assert_eq!(controller.upload().await.unwrap(), short);
        assert_eq!(program(&short.source().unwrap()), short);
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
    });
    let state = |number: usize, state| move |status: &host::Status| status.programs[number].state == state;
    stand.until("ended", |status| status.axes["X"].position == 3000 && state(0, ProgramState::Idle)(status));
    let variables = || RUNTIME.block_on(controller.variables(1..4)).unwrap();
    assert_eq!(variables(), [0, 0, 3000]);
    stand.power_cycle();
    RUNTIME.block_on(async {
        assert_eq!(controller.upload().await.unwrap(), short);
        controller.download(&long).await.unwrap();
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
    });
    stand.until("running", state(0, ProgramState::Running));
    RUNTIME.block_on(controller.program(0, ProgramAction::Pause)).unwrap();
    let paused = stand.until("paused", state(0, ProgramState::Paused));
    let count = variables()[0];
    assert!(paused.programs[0].counter > 0);
    assert_eq!(variables()[0], count);
    RUNTIME.block_on(controller.program(0, ProgramAction::Continue)).unwrap();
    stand.until("counting", |_| variables()[0] > count);
    assert_eq!(variables()[1], 0);
    RUNTIME.block_on(controller.program(1, ProgramAction::Run { at: None })).unwrap();
    stand.until("the other one", |_| variables()[1] == 5);
    RUNTIME.block_on(controller.program(0, ProgramAction::Stop)).unwrap();
    stand.until("ended", state(0, ProgramState::Idle));
    // A download stops what runs.
    RUNTIME.block_on(async {
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
        controller.download(&program("PRG 0\nEND\n")).await.unwrap();
    });
    assert_eq!(stand.status().programs[0].state, ProgramState::Idle);
    stand.stop();
}

#[test]
fn everything_is_stopped() {
    let stand = Stand::new(Model::Pmx2ed);
    let controller = &stand.controller;
    let code = program("PRG 0\nWHILE 1=1\nJOGX+\nENDWHILE\nEND\nPRG 1\nWHILE 1=1\nJOGY-\nENDWHILE\nEND\n");
    RUNTIME.block_on(async {
        controller.download(&code).await.unwrap();
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
        controller.program(1, ProgramAction::Run { at: None }).await.unwrap();
    });
    stand.until("both move", |status| status.axes.values().all(|axis| axis.state != "idle"));
    RUNTIME.block_on(controller.stop_all()).unwrap();
    stand.until("all at rest", |status| {
        status.axes.values().all(|axis| axis.state == "idle")
            && status.programs.iter().all(|program| program.state == ProgramState::Idle)
    });
    let positions = || stand.status().axes.values().map(|axis| axis.position).collect::<Vec<_>>();
    assert_eq!(positions(), positions());
    stand.stop();
}

#[test]
fn a_joystick_is_stopped_too() {
    let stand = Stand::new(Model::Pmx2ed);
    for (key, value) in [
        ("JV1", 5000),
        ("JV3", 100),
        ("JL1", -1_000_000),
        ("JL2", -900_000),
        ("JL3", 900_000),
        ("JL4", 1_000_000),
    ] {
        stand.write(key, Value::Number(value));
    }
    stand.call("PUT", "pins/AI1", "5000");
    assert_eq!(stand.says("JO=1"), "OK");
    stand.until("moves", |status| status.axes["X"].position > 100);
    RUNTIME.block_on(stand.controller.stop_all()).unwrap();
    let rest = stand.at_rest("X");
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert_eq!(stand.axis("X").position, rest.position);
    stand.stop();
}

#[test]
fn a_closed_loop_and_its_stall() {
    let stand = Stand::new(Model::Pmx2ed);
    assert_eq!((stand.axis("X").loop_state, stand.axis("X").delta), (None, None));
    stand.write("SLX", Value::Number(1));
    stand.act(move_to(&[("X", 2000)], false));
    let there = stand.until("arrived", |status| {
        status.axes["X"].position == 2000 && status.axes["X"].loop_state.as_deref() == Some("idle")
    });
    assert_eq!(there.axes["X"].delta, Some(0));
    stand.call("PUT", "axes/X/load", "2.0");
    stand.act(move_to(&[("X", 50_000)], false));
    let stalled = stand.until("stalled", |status| status.axes["X"].error.is_some());
    assert_eq!(stalled.alarms, ["X: StepNLoop: stalled"]);
    stand.act(Action::ClearError { axis: x() });
    assert_eq!(stand.axis("X").error, None);
    stand.stop();
}

#[test]
fn lines_that_are_typed() {
    let stand = Stand::new(Model::Pmx2ed);
    let answer = |line: &str| RUNTIME.block_on(stand.controller.terminal(line)).unwrap();
    let typed = answer(" PX=5 ");
    assert_eq!(
        (typed.request.as_str(), typed.reply.as_str(), typed.text.as_str(), typed.ok),
        ("PX=5", "OK", "done", true)
    );
    assert_eq!((typed.hex_request.as_str(), typed.hex_reply.as_str()), ("50 58 3D 35 0D", "4F 4B 0D"));
    let wrong = answer("px");
    assert_eq!((wrong.reply.as_str(), wrong.ok), ("?px", false));
    stand.call("PUT", "pins/+LX", "true");
    assert_eq!(answer("MSTX").text, "plus limit input, home input, Z index");
    let (traffic, _) = stand.controller.traffic().since(0);
    let last: Vec<_> = traffic[traffic.len() - 2..].iter().map(|it| (it.out, it.text.as_str())).collect();
    assert_eq!(last, [(true, "MSTX"), (false, "592")]);
    stand.stop();
}
