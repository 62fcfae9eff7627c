//! Conversations, frame by frame.

use crate::scripted::Script;
use crate::{Action, Bus, Controller, Model, Settings};

#[tokio::test]
async fn a_move() {
    let script = Script::default().bytes(
        // TMCL manual, 3.7.4.
        &[0x01, 0x04, 0x00, 0x00, 0x00, 0x01, 0x5F, 0x90, 0xF5],
        &[0x02, 0x01, 0x64, 0x04, 0x00, 0x01, 0x5F, 0x90, 0x5B],
    );
    let settings = Settings { model: Model::Pd42, address: Some(1), bits: Vec::new() };
    let module = Controller::new(Bus::new(script.wire()), settings);
    module.act(&Action::Move { targets: [("0".into(), 90_000)].into(), relative: false }).await.unwrap();
    script.ends();
}
