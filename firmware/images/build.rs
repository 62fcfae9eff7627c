//! Where each image lies: a linker script an image, with the memory that its controller may have and no more. An image
//! that is larger does not link.

use std::{env, fs, path::Path};

/// The memory of an image, in KiB. The stack is a part of the RAM, at its bottom: one that runs over ends in a fault
/// and not in something else's data.
struct Memory {
    image: &'static str,
    flash: u32,
    ram: u32,
    stack: u32,
}

const IMAGES: &[Memory] = &[
    Memory { image: "pd42-1140", flash: 128, ram: 32, stack: 6 },
    Memory { image: "pmx-2ed", flash: 256, ram: 48, stack: 12 },
    Memory { image: "cmd-4cr", flash: 256, ram: 64, stack: 12 },
];

/// Where a board has its memory.
struct Board {
    feature: &'static str,
    flash: u32,
    ram: u32,
    /// KiB of flash from there on that an image may have.
    room: u32,
}

const BOARDS: &[Board] = &[
    Board { feature: "MPS2_AN386", flash: 0, ram: 0x2000_0000, room: 4096 },
    // The last 4 KiB of the first bank are for the cause of a stop.
    Board { feature: "NUCLEO_G474RE", flash: 0x0800_0000, ram: 0x2000_0000, room: 252 },
];

fn main() {
    let out = env::var("OUT_DIR").expect("cargo sets it");
    let chosen = |board: &&Board| env::var_os(format!("CARGO_FEATURE_{}", board.feature)).is_some();
    let Some(board) = BOARDS.iter().find(chosen) else {
        panic!("choose a board: --features mps2-an386 or nucleo-g474re")
    };
    for Memory { image, flash, ram, stack } in IMAGES {
        let place = Path::new(&out).join(image);
        fs::create_dir_all(&place).expect("cargo's directory can be written");
        let script = format!(
            "MEMORY {{\n  FLASH : ORIGIN = {:#x}, LENGTH = {}K\n  STACK : ORIGIN = {:#x}, LENGTH = {stack}K\n  \
             RAM : ORIGIN = {:#x}, LENGTH = {}K\n}}\n\
             _stack_end = ORIGIN(STACK);\n_stack_start = ORIGIN(STACK) + LENGTH(STACK);\n",
            board.flash,
            (*flash).min(board.room),
            board.ram,
            board.ram + stack * 1024,
            ram - stack,
        );
        fs::write(place.join("memory.x"), script).expect("cargo's directory can be written");
        println!("cargo:rustc-link-arg-bin={image}=-L{}", place.display());
        println!("cargo:rustc-link-arg-bin={image}=-Tlink.x");
    }
    println!("cargo:rerun-if-changed=build.rs");
}
