//! Anything typed at the ASCII interface, with any address and echo setting.
#![no_main]

use libfuzzer_sys::fuzz_target;
use protocol::ascii::{Echo, Editor, LINE_LENGTH, Line, reply};
use protocol::tmcl::Status;
use tmcl::line;

fuzz_target!(|input: (u8, i32, Vec<u8>)| {
    let (address, parameter, bytes) = input;
    let echo = Echo::from_parameter(parameter);
    let mut editor = Editor::new();
    for byte in bytes {
        let step = editor.push(byte, address, echo);
        assert!(echo != Echo::Off || step.echo.is_empty());
        if let Some(Line::Command(text)) = step.line {
            assert!(text.len() < LINE_LENGTH);
            if let Err(status) = line::parse(text) {
                reply(address, address, status, parameter);
            }
        }
    }
    reply(address, address, Status(address), parameter);
});
