//! Any bytes as a program file: what is accepted is written back the same, by way of the disassembler.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tmcl::asm::{NoFiles, assemble};
use tmcl::isa::PROGRAM_LENGTH;
use tmcl::{Command, disasm, image};

fuzz_target!(|bytes: &[u8]| {
    if let Ok(commands) = image::from_bytes(bytes) {
        assert_eq!(image::to_bytes(&commands), bytes);
    }
    // Few inputs have right checksums, so the records are taken without them, too.
    let commands: Vec<Command> = bytes
        .as_chunks::<7>()
        .0
        .iter()
        .take(PROGRAM_LENGTH)
        .map(|&[opcode, kind, motor, a, b, c, d]| {
            Command::new(opcode, kind, motor, i32::from_be_bytes([a, b, c, d]))
        })
        .collect();
    let text = disasm::disassemble(&commands);
    let assembly = assemble("fuzz.tmc", text.as_bytes(), &NoFiles);
    assert_eq!(assembly.program.map(|program| program.commands), Some(commands), "{text}");
});
