//! Conversations, word by word.

use crate::scripted::Script;
use crate::{Action, Bit, Bus, Controller, Direction, Error, Key, Level, Model, Settings, Value};
use std::collections::BTreeMap;

fn controller(script: &Script, model: Model, address: Option<u8>) -> Controller {
    let bit = |number, name: &str, is_error| Bit { number, name: name.into(), is_error };
    let bits = vec![bit(1, "decelerating", false), bit(4, "+limit", false), bit(7, "+limit error", true)];
    Controller::new(Bus::new(script.wire()), Settings { model, address, bits })
}

/// An action on a Performax that is alone, or on a Commander with address 1.
async fn check(model: Model, action: Action, conversation: &[&str]) {
    let script = Script::default().lines(conversation);
    let address = (model == Model::Cmd4cr).then_some(1);
    controller(&script, model, address).act(&action).await.expect(conversation[0]);
    script.ends();
}

#[tokio::test]
async fn actions() {
    use Model::{Cmd4cr, Pmx2ed};
    let x = || "X".to_owned();
    let targets = |targets: &[(&str, i32)]| {
        targets.iter().map(|(axis, it)| (String::from(*axis), *it)).collect::<BTreeMap<_, _>>()
    };
    check(Pmx2ed, Action::Power { axis: "Y".into(), on: true }, &["EO2=1>OK"]).await;
    check(Cmd4cr, Action::Power { axis: "U".into(), on: false }, &["@01EO4=0>OK"]).await;
    let jog = |speed| Action::Jog { axis: x(), direction: Direction::Negative, speed, held: false };
    check(Pmx2ed, jog(None), &["JX->OK"]).await;
    check(Pmx2ed, jog(Some(500)), &["HSPDX=500>OK", "JX->OK"]).await;
    let both = targets(&[("X", 1000), ("Y", -1000)]);
    let line = |relative| Action::Move { targets: both.clone(), relative };
    check(Pmx2ed, line(false), &["MM>0", "I1000:-1000>OK"]).await;
    check(Cmd4cr, line(false), &["@01MM>0", "@01X1000Y-1000>OK"]).await;
    // The mode stays what it was.
    let relative = ["PX>10", "PY>20", "MM>0", "INC>OK", "I1000:-1000>OK", "ABS>OK"];
    check(Pmx2ed, line(true), &relative).await;
    let one = |relative| Action::Move { targets: targets(&[("Y", 5)]), relative };
    check(Pmx2ed, one(false), &["MM>1", "ABS>OK", "Y5>OK", "INC>OK"]).await;
    check(Pmx2ed, one(true), &["PY>7", "MM>1", "Y5>OK"]).await;
    check(Pmx2ed, Action::Stop { axis: None }, &["STOP>OK"]).await;
    check(Pmx2ed, Action::Stop { axis: Some(x()) }, &["STOPX>OK"]).await;
    check(Pmx2ed, Action::Abort { axis: Some(x()) }, &["ABORTX>OK"]).await;
    let home = |mode| Action::Home { axis: x(), mode, direction: Direction::Positive };
    for (mode, line) in [(0, "HX+>OK"), (1, "LX+>OK"), (2, "ZHX+>OK"), (3, "ZX+>OK"), (4, "HLX+>OK")] {
        check(Pmx2ed, home(mode), &[line]).await;
    }
    check(Cmd4cr, home(12), &["@01HX+12>OK"]).await;
    check(Pmx2ed, Action::SetPosition { axis: x(), value: -5 }, &["PX=-5>OK"]).await;
    check(Pmx2ed, Action::SetEncoder { axis: x(), value: 5 }, &["EX=5>OK"]).await;
    check(Cmd4cr, Action::ClearError { axis: x() }, &["@01CLRX>OK"]).await;
    let change = |acceleration, mode| Action::ChangeSpeed { axis: x(), speed: 2000, acceleration, mode };
    check(Pmx2ed, change(None, None), &["SSPDX=2000>OK"]).await;
    check(Pmx2ed, change(Some(50), Some(2)), &["SSPDMX=2>OK", "ACCX=50>OK", "SSPDX=2000>OK"]).await;
    check(Pmx2ed, Action::ChangeTarget { axis: x(), target: 9 }, &["MM>0", "TX9>OK"]).await;
    check(Pmx2ed, Action::SetMode { absolute: false }, &["INC>OK"]).await;
    let output = |name: &str, value| Action::Output { name: name.into(), value };
    check(Pmx2ed, output("DO8", Level::Digital(true)), &["DO8=1>OK"]).await;
    check(Cmd4cr, output("IO32", Level::Digital(false)), &["@01IO32=0>OK"]).await;
    check(Cmd4cr, output("PWM2", Level::Analog(25.0)), &["@01PWM2=25>OK"]).await;
}

#[tokio::test]
async fn what_is_refused_before_it_is_sent() {
    let script = Script::default();
    let unit = controller(&script, Model::Pmx2ed, None);
    let x = || "X".to_owned();
    let output = |name: &str, value| Action::Output { name: name.into(), value };
    for action in [
        Action::Power { axis: "Z".into(), on: true },
        Action::Stop { axis: Some(String::new()) },
        Action::Stop { axis: Some("X\rABORT".into()) },
        Action::Move { targets: [].into(), relative: false },
        Action::Home { axis: x(), mode: 5, direction: Direction::Positive },
        output("DO9", Level::Digital(true)),
        output("PWM1", Level::Digital(true)),
        output("PX", Level::Analog(5.0)),
    ] {
        let error = unit.act(&action).await.expect_err("refused");
        assert!(matches!(error, Error::NoSuch(_) | Error::Value(_)), "{action:?}: {error}");
    }
    for line in ["", "  ", "X1000\rABORT", "µ", &"V".repeat(65)] {
        assert!(matches!(unit.terminal(line).await, Err(Error::Value(_))), "{line}");
    }
}

#[tokio::test]
async fn what_the_controller_refuses() {
    let script = Script::default().lines(&["MM>1", "ABS>OK", "X5>?Moving", "INC>OK"]);
    let unit = controller(&script, Model::Pmx2ed, None);
    let error = unit.act(&Action::Move { targets: [("X".into(), 5)].into(), relative: false }).await;
    let Err(Error::Refused { request, words }) = error else { panic!("{error:?}") };
    assert_eq!((request.as_str(), words.as_str()), ("X5", "?Moving"));
    script.ends();
}

#[tokio::test]
async fn lost_and_strange_replies() {
    // Reading is tried once more.
    let script = Script::default().silence(b"PX\r").line("PX", "5");
    let unit = controller(&script, Model::Pmx2ed, None);
    let position = Key::Command("PX".into());
    assert_eq!(unit.read(&position).await.expect("second try"), Value::Number(5));
    let script = Script::default().line("MM", "OK").line("MM", "OK");
    let unit = controller(&script, Model::Pmx2ed, None);
    let error = unit.act(&Action::ChangeTarget { axis: "X".into(), target: 9 }).await;
    assert!(matches!(error, Err(Error::Malformed { .. })), "{error:?}");
    // Doing is not: it may have been done.
    let script = Script::default().silence(b"JX+\r");
    let unit = controller(&script, Model::Pmx2ed, None);
    let jog = Action::Jog { axis: "X".into(), direction: Direction::Positive, speed: None, held: false };
    assert!(matches!(unit.act(&jog).await, Err(Error::Wire(_))));
    script.ends();
}
