//! A CMD-4CR: what it has that a PMX-2ED-SA has not.

use super::stand::{RUNTIME, Stand, device, targets};
use ascript::{compile, dialect::COMMANDER};
use host::{Action, Code, Direction, Level, Model, ProgramAction, ProgramState, Value};

fn axis(name: &str) -> String {
    name.into()
}

fn move_to(goals: &[(&str, i32)], relative: bool) -> Action {
    Action::Move { targets: targets(goals), relative }
}

fn jog(name: &str, direction: Direction) -> Action {
    Action::Jog { axis: name.into(), direction, speed: Some(5000), held: false }
}

#[test]
fn jogging_and_stopping() {
    let stand = Stand::new(Model::Cmd4cr);
    let before = stand.status();
    assert_eq!(before.axes.keys().collect::<Vec<_>>(), ["U", "X", "Y", "Z"]);
    stand.act(jog("U", Direction::Negative));
    let there = stand.until("full speed", |status| status.axes["U"].state == "constant speed");
    assert_eq!((there.axes["U"].speed, there.axes["X"].speed), (-5000, 0));
    assert_eq!(stand.refused(jog("U", Direction::Negative)), "?Error Moving");
    stand.act(Action::Stop { axis: Some(axis("U")) });
    let rest = stand.at_rest("U");
    assert_eq!(rest.encoder, Some(rest.position));
    stand.act(jog("Z", Direction::Positive));
    stand.act(Action::Abort { axis: Some(axis("Z")) });
    assert_eq!(stand.axis("Z").state, "idle");
    stand.stop();
}

#[test]
fn moves() {
    let stand = Stand::new(Model::Cmd4cr);
    stand.write("HSPD", Value::Number(50_000));
    stand.act(move_to(&[("X", 10_000), ("Y", -5000), ("Z", 2000), ("U", 1)], false));
    let there = |goals: [i32; 4]| {
        move |status: &host::Status| {
            ["X", "Y", "Z", "U"].into_iter().zip(goals).all(|(axis, goal)| status.axes[axis].position == goal)
        }
    };
    stand.until("arrived", there([10_000, -5000, 2000, 1]));
    stand.at_rest("X");
    stand.act(move_to(&[("X", -4000), ("U", 99)], true));
    stand.until("arrived", there([6000, -5000, 2000, 100]));
    let status = stand.status();
    assert_eq!((status.axes["X"].target, status.axes["Y"].target), (Some(6000), Some(-5000)));
    assert_eq!((status.axes["U"].target, status.absolute), (Some(100), Some(true)));
    stand.stop();
}

#[test]
fn limits_and_their_errors() {
    let stand = Stand::with(Model::Cmd4cr, device(Model::Cmd4cr, [-3000, 3000]));
    stand.act(jog("Y", Direction::Negative));
    let hit = stand.until("hit", |status| status.axes["Y"].error.is_some());
    assert_eq!(hit.alarms, ["Y: negative limit error"]);
    assert_eq!(hit.axes["Y"].negative_limit, Some(true));
    assert!(stand.refused(jog("Y", Direction::Positive)).starts_with("?Error"));
    stand.act(Action::ClearError { axis: axis("Y") });
    stand.act(move_to(&[("Y", 0)], false));
    let back = stand.until("back", |status| status.axes["Y"].position == 0);
    assert_eq!((back.axes["Y"].negative_limit, back.alarms.len()), (Some(false), 0));
    stand.stop();
}

#[test]
fn every_way_of_homing() {
    for mode in 0..13 {
        let stand = Stand::with(Model::Cmd4cr, device(Model::Cmd4cr, [-7000, 7000]));
        stand.write("HSPD", Value::Number(4000));
        stand.write("LSPD", Value::Number(1000));
        stand.act(move_to(&[("X", 3000)], false));
        stand.until("arrived", |status| status.axes["X"].position == 3000);
        stand.at_rest("X");
        stand.act(Action::Home { axis: axis("X"), mode, direction: Direction::Negative });
        stand.until("on the way", |status| {
            status.axes["X"].state != "idle" || status.axes["X"].position != 3000
        });
        stand.until("found", |status| {
            status.axes["X"].state == "idle"
                && (-4000..=4000).contains(&status.axes["X"].position)
                && status.axes["X"].position != 3000
        });
        assert_eq!(stand.axis("X").error, None, "mode {mode}");
        stand.stop();
    }
}

#[test]
fn changes_on_the_fly() {
    let stand = Stand::new(Model::Cmd4cr);
    let change = |speed, mode| Action::ChangeSpeed { axis: axis("X"), speed, acceleration: None, mode };
    stand.write("SSPDMX", Value::Number(1));
    stand.act(jog("X", Direction::Positive));
    stand.until("full speed", |status| status.axes["X"].speed == 5000);
    stand.act(change(3000, None));
    stand.until("another speed", |status| status.axes["X"].speed == 3000);
    stand.act(Action::Abort { axis: None });
    stand.act(move_to(&[("X", 900_000)], false));
    stand.act(Action::ChangeTarget { axis: axis("X"), target: 2000 });
    stand.until("arrived", |status| status.axes["X"].position == 2000);
    stand.act(Action::SetPosition { axis: axis("X"), value: 7 });
    stand.act(Action::SetEncoder { axis: axis("X"), value: 8 });
    assert_eq!((stand.axis("X").position, stand.axis("X").encoder), (7, Some(8)));
    stand.stop();
}

#[test]
fn inputs_and_outputs() {
    let stand = Stand::new(Model::Cmd4cr);
    stand.write("IOCFG", Value::Number(0b110));
    stand.act(Action::Output { name: "IO2".into(), value: Level::Digital(true) });
    stand.act(Action::Output { name: "DO4".into(), value: Level::Digital(true) });
    stand.act(Action::Output { name: "PWM1".into(), value: Level::Analog(25.0) });
    stand.call("PUT", "pins/IO32", "true");
    stand.call("PUT", "pins/DI2", "true");
    stand.call("PUT", "pins/AI2", "3000");
    let status = stand.status();
    assert_eq!(status.inputs.len(), 4 + 30 + 2);
    assert_eq!(status.outputs.len(), 4 + 4 + 2 + 2);
    assert_eq!((status.outputs["IO2"], status.outputs["IO3"]), (Level::Digital(true), Level::Digital(false)));
    assert_eq!((status.outputs["DO4"], status.outputs["EO4"]), (Level::Digital(true), Level::Digital(true)));
    assert_eq!(status.outputs["PWM1"], Level::Analog(25.0));
    assert_eq!((status.inputs["IO32"], status.inputs["IO1"]), (Level::Digital(true), Level::Digital(false)));
    assert_eq!((status.inputs["DI2"], status.inputs["AI2"]), (Level::Digital(true), Level::Analog(3000.0)));
    stand.stop();
}

#[test]
fn what_is_stored_outlives_the_power() {
    let stand = Stand::new(Model::Cmd4cr);
    for (key, value) in [("ZCNTX", 3), ("V99", -5), ("SDEU", 1), ("ID", 42)] {
        stand.write(key, Value::Number(value));
    }
    stand.write("SLRZ", Value::Decimal(0.125));
    RUNTIME.block_on(stand.controller.store(&[])).unwrap();
    stand.write("V98", Value::Number(6));
    stand.power_cycle();
    assert_eq!((stand.read("ZCNTX"), stand.read("SDEU")), (Value::Number(3), Value::Number(1)));
    assert_eq!((stand.read("SLRZ"), stand.read("V99")), (Value::Decimal(0.125), Value::Number(-5)));
    assert_eq!(stand.read("V98"), Value::Number(0));
    assert_eq!(RUNTIME.block_on(stand.controller.identify()).unwrap().address, 42);
    stand.stop();
}

/// The program of a source.
fn program(source: &str) -> Code {
    let compilation = compile("test", source.as_bytes(), &COMMANDER);
    Code::Ascript(&COMMANDER, compilation.code.expect(source).lines)
}

#[test]
fn four_programs() {
    let stand = Stand::new(Model::Cmd4cr);
    let controller = &stand.controller;
    let source: String = (0..4)
        .map(|number| format!("PRG {number}\nWHILE 1=1\nV{number}=V{number}+1\nDELAY=5\nENDWHILE\nEND\n"))
        .collect();
    let code = program(&source);
    RUNTIME.block_on(async {
        controller.download(&code).await.unwrap();
        assert_eq!(controller.upload().await.unwrap(), code);
        assert_eq!(program(&code.source().unwrap()), code);
        for number in 0..4 {
            controller.program(number, ProgramAction::Run { at: None }).await.unwrap();
        }
        controller.program(4, ProgramAction::Stop).await.expect_err("there are four");
    });
    let states = |states: [ProgramState; 4]| {
        move |status: &host::Status| status.programs.iter().map(|program| program.state).eq(states)
    };
    use ProgramState::{Idle, Paused, Running};
    stand.until("all run", states([Running; 4]));
    RUNTIME.block_on(controller.program(2, ProgramAction::Pause)).unwrap();
    RUNTIME.block_on(controller.program(3, ProgramAction::Stop)).unwrap();
    stand.until("three run", states([Running, Running, Paused, Idle]));
    let variables = || RUNTIME.block_on(controller.variables(0..4)).unwrap();
    let before = variables();
    stand.until("two count", |_| variables()[0] > before[0] && variables()[1] > before[1]);
    assert_eq!(variables()[2..], before[2..]);
    RUNTIME.block_on(controller.program(2, ProgramAction::Continue)).unwrap();
    stand.until("three count", |_| variables()[2] > before[2]);
    RUNTIME.block_on(controller.stop_all()).unwrap();
    stand.until("none runs", states([Idle; 4]));
    stand.stop();
}

#[test]
fn a_joystick_is_stopped_too() {
    let stand = Stand::new(Model::Cmd4cr);
    for (key, value) in [
        ("JSPDX", 5000),
        ("JDELX", 100),
        ("JLIM1", -1_000_000),
        ("JLIM2", -900_000),
        ("JLIM3", 900_000),
        ("JLIM4", 1_000_000),
    ] {
        stand.write(key, Value::Number(value));
    }
    stand.call("PUT", "pins/AI1", "3300");
    stand.write("JENA", Value::Number(1));
    stand.until("moves", |status| status.axes["X"].position > 100);
    RUNTIME.block_on(stand.controller.stop_all()).unwrap();
    let rest = stand.at_rest("X");
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert_eq!(stand.axis("X").position, rest.position);
    stand.stop();
}
