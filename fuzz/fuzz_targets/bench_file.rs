//! Any bench file: a bench or a one-line message, and a bench that is accepted can be switched on.

#![no_main]

use libfuzzer_sys::fuzz_target;
use sim::{Bench, VirtualDevice};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match Bench::parse(text, "bench.toml") {
        Ok(bench) => {
            for config in bench.devices.iter().take(4) {
                let mut device = VirtualDevice::new(config, 1);
                device.advance(16_000);
            }
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
    }
});
