//! Any content of the flash: the module starts, stores and reads back.

#![no_main]

use devices::{Port, model};
use libfuzzer_sys::fuzz_target;
use protocol::tmcl::Request;
use sim::{DeviceConfig, SharedFlash, VirtualDevice};

fuzz_target!(|data: &[u8]| {
    let model = model("pd42-1140").unwrap();
    let mut image = vec![0xFF; model.flash_bytes as usize];
    // Pieces at places of the input's choice: page ends and headers are where the structure is.
    let mut rest = data;
    while let [high, low, size, tail @ ..] = rest {
        let at = (usize::from(*high) << 8 | usize::from(*low)) * 4 % image.len();
        let piece = usize::from(*size).min(tail.len()).min(image.len() - at);
        image[at..at + piece].copy_from_slice(&tail[..piece]);
        rest = &tail[piece..];
    }
    let flash = SharedFlash::from_bytes(image);
    let mut device = VirtualDevice::with_flash(&DeviceConfig::new(model), flash, 1);
    let mut send = |opcode, kind, motor, value| -> Vec<u8> {
        device.receive(Port::Usb, &Request { address: 1, opcode, kind, motor, value }.emit().0);
        device.drain_sent().flat_map(|sent| sent.bytes).collect()
    };
    send(5, 4, 0, 321);
    let stored = send(7, 4, 0, 0);
    send(5, 4, 0, 100);
    send(8, 4, 0, 0);
    if stored.get(2) == Some(&100) {
        assert_eq!(send(6, 4, 0, 0)[4..8], 321i32.to_be_bytes());
    }
});
