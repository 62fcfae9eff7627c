//! Conversations, frame by frame.

use crate::scripted::Script;
use crate::{Action, Bus, Code, Controller, Direction, Error, Level, Model, ProgramAction, Settings, Value};
use protocol::tmcl::{MemoryReply, Reply, Request, Status};
use tmcl::isa::Command;

fn controller(script: &Script) -> Controller {
    Controller::new(
        Bus::new(script.wire()),
        Settings { model: Model::Pd42, address: Some(1), bits: Vec::new() },
    )
}

/// A command of module 1: opcode, type, motor, value.
type Sent = (u8, u8, u8, i32);

fn request((opcode, kind, motor, value): Sent) -> [u8; 9] {
    Request { address: 1, opcode, kind, motor, value }.emit().0
}

fn reply(status: Status, opcode: u8, value: i32) -> [u8; 9] {
    Reply { host: 2, module: 1, status, opcode, value }.emit().0
}

/// A conversation in which everything is done; values of replies are given.
fn done(conversation: &[(Sent, i32)]) -> Script {
    conversation.iter().fold(Script::default(), |script, &(sent, value)| {
        script.bytes(&request(sent), &reply(Status::OK, sent.0, value))
    })
}

#[tokio::test]
async fn the_manuals_frames() {
    let script = Script::default()
        // 3.7.1, 3.7.4 and 3.7.6, with the checksums of their replies.
        .bytes(&[1, 1, 0, 0, 0, 0, 0x03, 0xE8, 0xED], &[2, 1, 100, 1, 0, 0, 0x03, 0xE8, 0x53])
        .bytes(&[1, 4, 0, 0, 0, 0x01, 0x5F, 0x90, 0xF5], &[2, 1, 100, 4, 0, 0x01, 0x5F, 0x90, 0x5B])
        .bytes(&[1, 6, 1, 0, 0, 0, 0, 0, 0x08], &[2, 1, 100, 6, 0, 0, 0x02, 0xC7, 0x36]);
    let module = controller(&script);
    let jog =
        Action::Jog { axis: "0".into(), direction: Direction::Positive, speed: Some(1000), held: false };
    module.act(&jog).await.unwrap();
    module.act(&Action::Move { targets: [("0".into(), 90_000)].into(), relative: false }).await.unwrap();
    assert_eq!(module.read(&"AP1.0".parse().unwrap()).await.unwrap(), Value::Number(711));
    script.ends();
}

#[tokio::test]
async fn actions() {
    let check = async |action: Action, conversation: &[(Sent, i32)]| {
        let script = done(conversation);
        controller(&script).act(&action).await.unwrap();
        script.ends();
    };
    let axis = || "0".to_owned();
    let jog = |direction, speed| Action::Jog { axis: axis(), direction, speed, held: false };
    check(jog(Direction::Negative, None), &[((6, 4, 0, 0), 700), ((2, 0, 0, 700), 700)]).await;
    check(Action::Move { targets: [(axis(), -5)].into(), relative: true }, &[((4, 1, 0, -5), -5)]).await;
    check(Action::Stop { axis: None }, &[((3, 0, 0, 0), 0)]).await;
    let home = |mode, direction| Action::Home { axis: axis(), mode, direction };
    check(home(3, Direction::Negative), &[((5, 193, 0, 3), 3), ((13, 0, 0, 0), 0)]).await;
    check(home(3, Direction::Positive), &[((5, 193, 0, 67), 67), ((13, 0, 0, 0), 0)]).await;
    check(home(7, Direction::Positive), &[((5, 193, 0, 7), 7), ((13, 0, 0, 0), 0)]).await;
    check(Action::SetPosition { axis: axis(), value: 9 }, &[((5, 1, 0, 9), 9)]).await;
    check(Action::SetEncoder { axis: axis(), value: 9 }, &[((5, 209, 0, 9), 9)]).await;
    check(Action::ClearError { axis: axis() }, &[((6, 207, 0, 0), 1)]).await;
    check(Action::ChangeTarget { axis: axis(), target: 8 }, &[((4, 0, 0, 8), 8)]).await;
    let change = |acceleration| Action::ChangeSpeed { axis: axis(), speed: 300, acceleration, mode: None };
    // In position mode, and in velocity mode to the left.
    check(change(Some(50)), &[((5, 5, 0, 50), 50), ((6, 138, 0, 0), 0), ((5, 4, 0, 300), 300)]).await;
    check(change(None), &[((6, 138, 0, 0), 2), ((6, 2, 0, 0), -700), ((5, 2, 0, -300), -300)]).await;
    let output = |name: &str| Action::Output { name: name.into(), value: Level::Digital(true) };
    check(output("OUT1"), &[((14, 1, 2, 1), 1)]).await;
    check(output("PULLUPS"), &[((14, 0, 0, 1), 1)]).await;
}

#[tokio::test]
async fn everything_is_stopped() {
    let script = done(&[((3, 0, 0, 0), 0), ((128, 0, 0, 0), 0), ((3, 0, 0, 0), 0)]);
    controller(&script).stop_all().await.unwrap();
    script.ends();
}

#[tokio::test]
async fn statuses_that_are_refusals() {
    let check = async |status: Status, expected: &str| {
        let script = Script::default().bytes(&request((5, 4, 0, 1)), &reply(status, 5, 0));
        // Of a wrong checksum the module does not know the command, and it is sent once more.
        let script = if status == Status::WRONG_CHECKSUM {
            Script::default()
                .bytes(&request((5, 4, 0, 1)), &reply(status, 0, 0))
                .bytes(&request((5, 4, 0, 1)), &reply(status, 0, 0))
        } else {
            script
        };
        let error = controller(&script).write(&"AP4.0".parse().unwrap(), &Value::Number(1)).await;
        let Err(Error::Refused { request, words }) = error else { panic!("{error:?}") };
        assert_eq!((request.as_str(), words.as_str()), ("SAP 4, 0, 1", expected));
        script.ends();
    };
    check(Status::WRONG_CHECKSUM, "wrong checksum (1)").await;
    check(Status::WRONG_TYPE, "wrong type (3)").await;
    check(Status::INVALID_VALUE, "invalid value (4)").await;
    check(Status::LOCKED, "memory locked (5)").await;
    check(Status::NOT_AVAILABLE, "command not available (6)").await;
    check(Status(77), "status 77").await;
}

#[tokio::test]
async fn a_reply_of_another_module_is_none() {
    let other = Reply { host: 2, module: 5, status: Status::OK, opcode: 3, value: 0 }.emit().0;
    let script = Script::default().bytes(&request((3, 0, 0, 0)), &other);
    let error = controller(&script).act(&Action::Stop { axis: None }).await;
    assert!(matches!(error, Err(Error::Malformed { .. })), "{error:?}");
    script.ends();
}

/// The frame with which a module gives a stored command.
fn stored(opcode: u8, value: i32) -> [u8; 9] {
    MemoryReply { host: 2, opcode, kind: 0, motor: 0, value }.emit().0
}

#[tokio::test]
async fn programs() {
    let read = |address| request((134, 0, 0, address));
    let script = Script::default()
        .bytes(&read(0), &stored(4, 90_000))
        // A byte fell over.
        .bytes(&read(1), &[2, 4, 0, 0, 0, 1, 0x5F, 0x91, 0xF4])
        .bytes(&read(1), &stored(28, 0))
        .bytes(&read(2), &stored(0, 0));
    let expected = Code::Tmcl(vec![Command::new(4, 0, 0, 90_000), Command::STOP]);
    let code = controller(&script).upload().await.unwrap();
    assert_eq!(code, expected);
    assert_eq!(code.source().unwrap(), "    MVP ABS, 0, 90000\n    STOP\n");
    script.ends();

    let script = Script::default()
        .bytes(&request((132, 0, 0, 0)), &reply(Status::OK, 132, 0))
        .bytes(&request((4, 0, 0, 90_000)), &reply(Status::LOADED, 4, 90_000))
        .bytes(&request((28, 0, 0, 0)), &reply(Status::LOADED, 28, 0))
        .bytes(&request((0, 0, 0, 0)), &reply(Status::LOADED, 0, 0))
        .bytes(&request((133, 0, 0, 0)), &reply(Status::OK, 133, 0))
        .bytes(&request((131, 0, 0, 0)), &reply(Status::OK, 131, 0));
    controller(&script).download(&expected).await.unwrap();
    script.ends();

    // Protected against reading.
    let script = Script::default().bytes(&read(0), &reply(Status::NOT_AVAILABLE, 134, 0));
    let refused = controller(&script).upload().await;
    assert!(matches!(refused, Err(Error::Refused { .. })), "{refused:?}");
}

#[tokio::test]
async fn a_download_that_fails_is_ended() {
    let code = Code::Tmcl(vec![Command::STOP]);
    let script = Script::default()
        .bytes(&request((132, 0, 0, 0)), &reply(Status::OK, 132, 0))
        .bytes(&request((28, 0, 0, 0)), &reply(Status::INVALID_VALUE, 28, 0))
        .bytes(&request((133, 0, 0, 0)), &reply(Status::OK, 133, 0));
    let refused = controller(&script).download(&code).await;
    assert!(matches!(refused, Err(Error::Refused { .. })), "{refused:?}");
    script.ends();
    // Even if the wire fails: as soon as there is a reply.
    let script = Script::default()
        .bytes(&request((132, 0, 0, 0)), &reply(Status::OK, 132, 0))
        .silence(&request((28, 0, 0, 0)))
        .silence(&request((133, 0, 0, 0)))
        .bytes(&request((133, 0, 0, 0)), &reply(Status::OK, 133, 0))
        .bytes(&request((3, 0, 0, 0)), &reply(Status::OK, 3, 0));
    let module = controller(&script);
    assert!(matches!(module.download(&code).await, Err(Error::Wire(_))));
    module.act(&Action::Stop { axis: None }).await.unwrap();
    script.ends();
    // Control commands would not be stored, but executed.
    let script = Script::default();
    let control = Code::Tmcl(vec![Command::new(137, 0, 0, 1234)]);
    assert!(matches!(controller(&script).download(&control).await, Err(Error::Value(_))));
}

#[tokio::test]
async fn what_a_program_is_told() {
    let check = async |action: ProgramAction, conversation: &[(Sent, i32)]| {
        let script = done(conversation);
        controller(&script).program(0, action).await.unwrap();
        script.ends();
    };
    check(ProgramAction::Run { at: None }, &[((131, 0, 0, 0), 0), ((129, 1, 0, 0), 0)]).await;
    check(ProgramAction::Run { at: Some(50) }, &[((129, 1, 0, 50), 50)]).await;
    check(ProgramAction::Stop, &[((128, 0, 0, 0), 0)]).await;
    check(ProgramAction::Pause, &[((128, 0, 0, 0), 0), ((135, 1, 0, 0), 7)]).await;
    check(ProgramAction::Continue, &[((129, 0, 0, 0), 0)]).await;
    check(ProgramAction::Step, &[((130, 0, 0, 0), 0), ((135, 1, 0, 0), 8)]).await;
    check(ProgramAction::Reset, &[((131, 0, 0, 0), 0)]).await;
}

#[tokio::test]
async fn a_module_is_followed_to_another_address() {
    const SGP: u8 = 9;
    let at = |address, (opcode, kind, motor, value): Sent| {
        Request { address, opcode, kind, motor, value }.emit().0
    };
    let from = |module, status, opcode, value| Reply { host: 2, module, status, opcode, value }.emit().0;
    // Whether the reply to the change comes from the new address or from the old one.
    for replies_from in [7, 1] {
        let script = Script::default()
            .bytes(&at(1, (SGP, 66, 0, 0)), &from(1, Status::INVALID_VALUE, SGP, 0))
            .bytes(&at(1, (SGP, 66, 0, 7)), &from(replies_from, Status::OK, SGP, 7))
            .bytes(&at(7, (3, 0, 0, 0)), &from(7, Status::OK, 3, 0))
            .bytes(&at(7, (SGP, 66, 0, 9)), &from(9, Status::OK, SGP, 9))
            .bytes(&at(9, (3, 0, 0, 0)), &from(9, Status::OK, 3, 0));
        let module = controller(&script);
        let key = "GP66.0".parse().unwrap();
        assert!(module.write(&key, &Value::Number(0)).await.is_err());
        assert_eq!(module.address(), Some(1));
        module.write(&key, &Value::Number(7)).await.unwrap();
        module.act(&Action::Stop { axis: None }).await.unwrap();
        assert!(module.terminal("SGP 66, 0, 9").await.unwrap().ok);
        module.act(&Action::Stop { axis: None }).await.unwrap();
        assert_eq!(module.address(), Some(9));
        script.ends();
    }
}
