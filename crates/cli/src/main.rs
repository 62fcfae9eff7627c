//! The program `pulsetrain`.
fn main() {}
