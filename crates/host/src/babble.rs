//! Wires on which anything may come back.

use crate::wire::{End, Pending, Wire, WireError};
use crate::{Action, Bus, Controller, Direction, Key, Model, ProgramAction, Settings, find};
use proptest::prelude::*;
use protocol::tmcl::{Frame, Reply, Request};
use std::{collections::BTreeMap, time::Duration};

/// Answers every request with the next of these, again and again; one without an end is no answer.
struct Babble {
    replies: Vec<Vec<u8>>,
    next: usize,
}

impl Wire for Babble {
    fn exchange<'a>(&'a mut self, _: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>> {
        self.next += 1;
        let mut reply = self.replies[self.next % self.replies.len()].clone();
        Box::pin(async move {
            let length = end.find(&reply).ok_or(WireError::Timeout(patience))?;
            reply.truncate(length);
            Ok(reply)
        })
    }
}

/// Answers everything with nothing, after a while.
struct Slow(Duration);

impl Wire for Slow {
    fn exchange<'a>(&'a mut self, request: &'a [u8], _: End, _: Duration) -> Pending<'a, Vec<u8>> {
        Box::pin(async move {
            if !self.0.is_zero() {
                tokio::time::sleep(self.0).await;
            }
            let frame = request.try_into().map(Frame).ok().and_then(|frame| Request::parse(&frame).ok());
            Ok(match (frame, request) {
                (Some(Request { address, opcode, .. }), _) => {
                    let status = protocol::tmcl::Status::OK;
                    Reply { host: 2, module: address, status, opcode, value: 0 }.emit().0.to_vec()
                }
                (None, b"MST\r" | b"PS\r") => b"0:0\r".to_vec(),
                (None, [b'S', b'L', b'S', ..]) => b"12\r".to_vec(),
                _ => b"0\r".to_vec(),
            })
        })
    }
}

/// A reply that is nearly right, or not at all.
fn reply() -> impl Strategy<Value = Vec<u8>> {
    let frame = (prop::array::uniform8(any::<u8>()), any::<bool>()).prop_map(|(mut body, good)| {
        if good {
            body[2] = 100;
        }
        let sum = protocol::tmcl::checksum(&body);
        [body.as_slice(), &[sum]].concat()
    });
    prop_oneof![
        "(OK|[0-9:.-]{0,20}|[?][a-zA-Z ]*|PRG 0|[ -~]{0,40})\r".prop_map(String::into_bytes),
        frame,
        prop::collection::vec(any::<u8>(), 0..20),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Nothing panics and everything ends, whatever comes back.
    #[test]
    fn any_reply(replies in prop::collection::vec(reply(), 1..8)) {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(async {
            for model in Model::ALL {
                let wire = || Babble { replies: replies.clone(), next: 0 };
                let _ = find(&Bus::new(wire())).await;
                let settings = Settings { model, address: Some(1), bits: Vec::new() };
                let controller = Controller::new(Bus::new(wire()), settings);
                let _ = controller.identify().await;
                let _ = controller.status().await;
                let _ = controller.upload().await.map(|code| code.source());
                let _ = controller.variables(0..8).await;
                let _ = controller.terminal("GAP 1, 0").await;
                let _ = controller.terminal("MSTX").await;
                let _ = controller.stop_all().await;
                let _ = controller.program(0, ProgramAction::Pause).await;
                for key in ["AP207.0", "GP66", "SLRX"] {
                    let _ = controller.read(&key.parse::<Key>().unwrap()).await;
                }
                let axis = model.axes()[0].to_owned();
                let targets: BTreeMap<_, _> = [(axis.clone(), 5)].into();
                let _ = controller.act(&Action::Move { targets, relative: true }).await;
                let change = Action::ChangeSpeed { axis: axis.clone(), speed: i32::MIN, acceleration: None, mode: None };
                let _ = controller.act(&change).await;
                let _ = controller.act(&Action::Home { axis, mode: 1, direction: Direction::Positive }).await;
            }
        });
    }
}

/// Over a slow line the position is asked for each time, and the rest in turn.
#[tokio::test]
async fn slow_lines() {
    let check = async |model: Model, pause_ms: u64, expected: [usize; 3]| {
        let bus = Bus::new(Slow(Duration::from_millis(pause_ms)));
        let controller = Controller::new(bus, Settings { model, address: None, bits: Vec::new() });
        let mut asked = 0;
        for expected in expected {
            let status = controller.status().await.unwrap();
            assert_eq!(status.axes.len(), model.axes().len());
            assert!(!status.inputs.is_empty() && !status.outputs.is_empty() && !status.programs.is_empty());
            let (traffic, next) = controller.traffic().since(asked);
            asked = next;
            assert_eq!(traffic.len() / 2, expected, "{model}");
        }
    };
    check(Model::Pmx2ed, 0, [18, 18, 18]).await;
    check(Model::Pmx2ed, 60, [18, 7, 7]).await;
    // The errors are read once while the axis stands.
    check(Model::Pd42, 0, [17, 16, 16]).await;
    check(Model::Pd42, 60, [17, 12, 12]).await;
}
