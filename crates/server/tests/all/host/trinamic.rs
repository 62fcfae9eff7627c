//! A PD42-1140.

use super::stand::{RUNTIME, Stand, device, targets};
use host::{Action, Code, Direction, Error, Level, Model, ProgramAction, ProgramState, Value};
use tmcl::asm::{NoFiles, assemble};

fn motor() -> String {
    "0".into()
}

fn move_to(target: i32, relative: bool) -> Action {
    Action::Move { targets: targets(&[("0", target)]), relative }
}

fn jog(direction: Direction, speed: Option<i32>) -> Action {
    Action::Jog { axis: motor(), direction, speed, held: false }
}

#[test]
fn jogging_and_stopping() {
    let stand = Stand::new(Model::Pd42);
    let before = stand.status();
    assert_eq!(before.axes.keys().collect::<Vec<_>>(), ["0"]);
    assert_eq!((before.absolute, before.axes["0"].enabled), (None, None));
    stand.act(jog(Direction::Negative, Some(500)));
    let there = stand.until("full speed", |status| status.axes["0"].speed == -500);
    assert_eq!(there.axes["0"].state, "moving");
    assert!(there.axes["0"].flags.contains(&"moving".into()));
    stand.act(Action::Stop { axis: Some(motor()) });
    let rest = stand.at_rest("0");
    assert!(rest.position < 0 && rest.encoder.unwrap() < 0, "{rest:?}");
    // Without a speed it is that of positioning.
    stand.write("AP4.0", Value::Number(700));
    stand.act(jog(Direction::Positive, None));
    stand.until("full speed", |status| status.axes["0"].speed == 700);
    stand.act(Action::ChangeSpeed { axis: motor(), speed: 300, acceleration: Some(1000), mode: None });
    stand.until("another speed", |status| status.axes["0"].speed == 300);
    assert_eq!(stand.read("AP5.0"), Value::Number(1000));
    stand.act(Action::Stop { axis: None });
    stand.at_rest("0");
    for action in [
        Action::Abort { axis: None },
        Action::SetMode { absolute: true },
        Action::Power { axis: motor(), on: true },
    ] {
        let done = RUNTIME.block_on(stand.controller.act(&action));
        assert!(matches!(done, Err(Error::Unsupported(_))), "{action:?}: {done:?}");
    }
    assert_eq!(stand.refused(jog(Direction::Positive, Some(3000))), "invalid value (4)");
    stand.stop();
}

#[test]
fn moves() {
    let stand = Stand::new(Model::Pd42);
    stand.act(move_to(51_200, false));
    let there = stand.until("arrived", |status| status.axes["0"].position == 51_200);
    assert_eq!(there.axes["0"].target, Some(51_200));
    stand.at_rest("0");
    stand.act(move_to(-1200, true));
    stand.until("arrived", |status| status.axes["0"].position == 50_000);
    stand.at_rest("0");
    stand.act(move_to(5_000_000, false));
    stand.until("on the way", |status| status.axes["0"].position > 60_000);
    stand.act(Action::ChangeSpeed { axis: motor(), speed: 2000, acceleration: None, mode: None });
    stand.until("faster", |status| status.axes["0"].speed == 2000);
    stand.act(Action::ChangeTarget { axis: motor(), target: 0 });
    stand.until("arrived", |status| status.axes["0"].position == 0);
    stand.at_rest("0");
    stand.act(Action::SetPosition { axis: motor(), value: -9 });
    stand.act(Action::SetEncoder { axis: motor(), value: 99 });
    let axis = stand.axis("0");
    assert_eq!((axis.position, axis.target, axis.encoder), (-9, Some(-9), Some(99)));
    stand.stop();
}

#[test]
fn stop_switches() {
    let stand = Stand::with(Model::Pd42, device(Model::Pd42, [-30_000, 30_000]));
    stand.act(jog(Direction::Positive, Some(1000)));
    let hit = stand.until("hit", |status| status.axes["0"].positive_limit == Some(true));
    assert!(hit.axes["0"].flags.contains(&"right stop switch".into()));
    assert_eq!(hit.inputs["STOP_R"], Level::Digital(true));
    let rest = stand.at_rest("0").position;
    assert!(rest >= 30_000, "{rest}");
    // One way is free.
    stand.act(jog(Direction::Negative, Some(1000)));
    stand.until("back", |status| status.axes["0"].positive_limit == Some(false));
    stand.until("other end", |status| status.axes["0"].negative_limit == Some(true));
    stand.stop();
}

#[test]
fn every_way_of_homing() {
    let ways = [Direction::Negative, Direction::Positive];
    for (mode, way) in (1..=8).flat_map(|mode| ways.map(|way| (mode, way))) {
        // Of the others, the mode says the direction.
        if mode > 4 && (way == Direction::Negative) == (mode % 2 == 0) {
            continue;
        }
        let stand = Stand::with(Model::Pd42, device(Model::Pd42, [-30_000, 30_000]));
        let start = if mode == 6 || mode == 8 { -20_000 } else { 20_000 };
        stand.act(move_to(start, false));
        stand.until("there", |status| status.axes["0"].position == start);
        stand.at_rest("0");
        stand.act(Action::Home { axis: motor(), mode, direction: way });
        stand.until("on the way", |status| status.axes["0"].state == "homing");
        let axis = stand.at_rest("0");
        assert_eq!((axis.position, axis.target), (0, Some(0)), "mode {mode}");
        let Value::Number(zero) = stand.read("AP197.0") else { panic!() };
        let expected = match (mode, way) {
            (1..=4, Direction::Negative) => -30_000,
            (1..=4, Direction::Positive) => 30_000,
            _ => -100,
        };
        assert!((zero - expected).abs() < 1000, "mode {mode}, {way:?}: {zero}");
        stand.stop();
    }
}

#[test]
fn a_stall_is_remembered_until_it_is_cleared() {
    let stand = Stand::new(Model::Pd42);
    stand.write("AP181.0", Value::Number(100));
    stand.act(jog(Direction::Positive, Some(500)));
    stand.until("full speed", |status| status.axes["0"].speed == 500);
    stand.call("PUT", "axes/0/load", "2.0");
    stand.until("stalled", |status| status.axes["0"].error.is_some());
    // The module has forgotten it with the first look.
    let again = stand.status();
    assert_eq!(again.alarms, ["0: stall"]);
    assert_eq!(stand.read("AP207.0"), Value::Number(0));
    assert_eq!(stand.axis("0").error.as_deref(), Some("stall"));
    stand.act(Action::ClearError { axis: motor() });
    assert_eq!(stand.axis("0").error, None);
    stand.stop();
}

#[test]
fn inputs_and_outputs() {
    let stand = Stand::new(Model::Pd42);
    stand.act(Action::Output { name: "OUT1".into(), value: Level::Digital(true) });
    stand.call("PUT", "pins/AIN0", "1234");
    stand.call("PUT", "pins/SUPPLY", "25.5");
    stand.call("PUT", "pins/HOME", "true");
    let status = stand.status();
    assert_eq!(
        (status.outputs["OUT0"], status.outputs["OUT1"]),
        (Level::Digital(false), Level::Digital(true))
    );
    assert_eq!(
        (status.inputs["AIN0"], status.inputs["SUPPLY"]),
        (Level::Analog(1234.0), Level::Analog(25.5))
    );
    assert_eq!(
        (status.inputs["HOME"], status.inputs["STOP_L"]),
        (Level::Digital(true), Level::Digital(false))
    );
    assert!(status.axes["0"].load.is_some());
    stand.stop();
}

#[test]
fn what_is_stored_outlives_the_power() {
    let stand = Stand::new(Model::Pd42);
    stand.write("AP4.0", Value::Number(777));
    stand.write("AP5.0", Value::Number(333));
    stand.write("GP42.2", Value::Number(-5));
    stand.write("GP0.3", Value::Decimal(4_294_967_295.0));
    assert_eq!(stand.read("GP0.3"), Value::Number(-1));
    let keys = ["AP4.0", "GP42.2"].map(|key| key.parse().unwrap());
    RUNTIME.block_on(stand.controller.store(&keys)).unwrap();
    stand.power_cycle();
    assert_eq!((stand.read("AP4.0"), stand.read("AP5.0")), (Value::Number(777), Value::Number(500)));
    assert_eq!(RUNTIME.block_on(stand.controller.variables(42..44)).unwrap(), [-5, 0]);
    let key = "AP1.0".parse().unwrap();
    let refused = RUNTIME.block_on(stand.controller.store(&[key]));
    assert!(matches!(refused, Err(Error::Refused { .. })), "{refused:?}");
    RUNTIME.block_on(stand.controller.restore_factory(&[])).unwrap();
    assert_eq!((stand.read("AP4.0"), stand.read("GP42.2")), (Value::Number(1000), Value::Number(0)));
    stand.stop();
}

/// The program of a source.
fn program(source: &str) -> Code {
    Code::Tmcl(assemble("test", source.as_bytes(), &NoFiles).program.expect(source).commands)
}

#[test]
fn programs_go_down_up_and_run() {
    let stand = Stand::new(Model::Pd42);
    let controller = &stand.controller;
    let long = program(
        "Loop:\n CALC ADD, 1\n AGP 1, 2\n WAIT TICKS, 0, 1\n JA Loop\n SAP 4, 0, 500\n SAP 5, 0, 500\n",
    );
    let short = program("MVP ABS, 0, 3000\nWAIT POS, 0, 0\nSGP 2, 2, 7\nSTOP\n");
    RUNTIME.block_on(async {
        controller.download(&long).await.unwrap();
        assert_eq!(controller.upload().await.unwrap(), long);
        controller.download(&short).await.unwrap();
        assert_eq!(controller.upload().await.unwrap(), short);
        assert_eq!(program(&short.source().unwrap()), short);
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
    });
    let state = |state| move |status: &host::Status| status.programs[0].state == state;
    stand.until("ended", |status| status.axes["0"].position == 3000 && state(ProgramState::Idle)(status));
    let variable = |number: u16| RUNTIME.block_on(controller.variables(number..number + 1)).unwrap()[0];
    assert_eq!(variable(2), 7);
    stand.power_cycle();
    RUNTIME.block_on(async {
        assert_eq!(controller.upload().await.unwrap(), short);
        // From its third command.
        controller.write(&"GP2.2".parse().unwrap(), &Value::Number(0)).await.unwrap();
        controller.program(0, ProgramAction::Run { at: Some(2) }).await.unwrap();
    });
    stand.until("ended", state(ProgramState::Idle));
    assert_eq!((variable(2), stand.axis("0").position), (7, 0));
    RUNTIME.block_on(async {
        controller.download(&long).await.unwrap();
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
    });
    stand.until("counting", |_| variable(1) > 3);
    assert_eq!(stand.status().programs[0].state, ProgramState::Running);
    RUNTIME.block_on(controller.program(0, ProgramAction::Pause)).unwrap();
    stand.until("paused", state(ProgramState::Paused));
    let count = variable(1);
    RUNTIME.block_on(controller.program(0, ProgramAction::Continue)).unwrap();
    stand.until("counting on", |_| variable(1) > count);
    RUNTIME.block_on(async {
        controller.program(0, ProgramAction::Reset).await.unwrap();
        for _ in 0..2 {
            controller.program(0, ProgramAction::Step).await.unwrap();
        }
    });
    let stepped = stand.until("stepped", |status| status.programs[0].counter == 2);
    assert_eq!((stepped.programs[0].state, variable(1)), (ProgramState::Paused, 1));
    RUNTIME.block_on(controller.program(0, ProgramAction::Stop)).unwrap();
    assert_eq!(stand.status().programs[0].state, ProgramState::Idle);
    stand.stop();
}

#[test]
fn everything_is_stopped() {
    let stand = Stand::new(Model::Pd42);
    let controller = &stand.controller;
    RUNTIME.block_on(async {
        controller.download(&program("Loop:\n ROR 0, 500\n JA Loop\n")).await.unwrap();
        controller.program(0, ProgramAction::Run { at: None }).await.unwrap();
    });
    stand.until("moves", |status| status.axes["0"].speed > 0);
    RUNTIME.block_on(controller.stop_all()).unwrap();
    let rest = stand.at_rest("0");
    assert_eq!(stand.status().programs[0].state, ProgramState::Idle);
    assert_eq!(stand.axis("0").position, rest.position);
    // A search ends too.
    stand.act(Action::Home { axis: motor(), mode: 1, direction: Direction::Negative });
    RUNTIME.block_on(controller.stop_all()).unwrap();
    stand.at_rest("0");
    stand.stop();
}

#[test]
fn a_stop_ends_a_download() {
    let stand = Stand::new(Model::Pd42);
    let controller = &stand.controller;
    let source = "SAP 4, 0, 500\n".repeat(2000);
    stand.act(jog(Direction::Positive, Some(500)));
    let code = program(&source);
    let (loaded, stopped) = RUNTIME.block_on(async {
        let stop = async {
            tokio::time::sleep(std::time::Duration::from_millis(5)).await;
            controller.stop_all().await
        };
        tokio::join!(controller.download(&code), stop)
    });
    assert!(matches!(loaded, Err(Error::Interrupted)), "{loaded:?}");
    stopped.unwrap();
    stand.at_rest("0");
    // Commands are executed again, and not stored.
    stand.act(move_to(0, false));
    stand.until("back", |status| status.axes["0"].position == 0);
    // One that is dropped in the middle does no harm either.
    RUNTIME.block_on(async {
        let patience = std::time::Duration::from_millis(5);
        tokio::time::timeout(patience, controller.download(&code)).await.expect_err("too early");
    });
    stand.act(move_to(5, false));
    stand.until("there", |status| status.axes["0"].position == 5);
    stand.stop();
}

#[test]
fn lines_that_are_typed() {
    let stand = Stand::new(Model::Pd42);
    let answer = |line: &str| RUNTIME.block_on(stand.controller.terminal(line)).unwrap();
    let typed = answer(" gap 4, 0");
    assert_eq!((typed.request.as_str(), typed.reply.as_str(), typed.ok), ("GAP 4, 0", "1000", true));
    assert_eq!(typed.text, "ok (100), value 1000");
    assert_eq!(typed.hex_request, "01 06 04 00 00 00 00 00 0B");
    assert_eq!(typed.hex_reply, "02 01 64 06 00 00 03 E8 58");
    let bytes = answer("01 06 04 00 00 00 00 00 0B");
    assert_eq!((bytes.request, bytes.reply), (typed.request, typed.reply));
    let version = answer("01 88 00 00 00 00 00 00 89");
    assert_eq!((version.reply.as_str(), version.ok), ("02 31 31 34 30 56 31 34 37", true));
    let refused = answer("SAP 4, 0, 9999");
    assert_eq!((refused.text.as_str(), refused.ok), ("invalid value (4), value 0", false));
    assert_eq!(answer("MVP ABS, 0, 1000").text, "ok (100), value 1000");
    stand.until("moved", |status| status.axes["0"].position == 1000);
    for line in ["", "FLY 0", "SAP 4", "01 06 04 00 00 00 00 00 0C", "MST 0\nMST 0\nMST 0"] {
        let answer = RUNTIME.block_on(stand.controller.terminal(line));
        assert!(matches!(answer, Err(Error::Value(_))), "{line}: {answer:?}");
    }
    stand.stop();
}
