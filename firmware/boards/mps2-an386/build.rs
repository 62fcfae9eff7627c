//! Lets the linker find `device.x`, the names of the interrupts.

fn main() {
    let here = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    println!("cargo:rustc-link-search={here}");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=device.x");
}
