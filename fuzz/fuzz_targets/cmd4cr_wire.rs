//! Whatever users do to a CMD-4CR on the simulated machine: nothing may panic, and the controller must still
//! answer and stop afterwards.

#![no_main]

mod ascii;

use devices::cmd4cr::table::{AXES, COMMANDS};
use devices::{Port, model};
use libfuzzer_sys::fuzz_target;
use sim::{DeviceConfig, VirtualDevice};

/// Lets everything come to rest.
const REST: &str = "SACTRL0=0\rSACTRL1=0\rSACTRL2=0\rSACTRL3=0\rBF\rABORT\rJENA=0\r\
    MPEX=0\rMPEY=0\rMPEZ=0\rMPEU=0\rABORT\rSLX=0\rSLY=0\rSLZ=0\rSLU=0\rABORT";

fuzz_target!(|data: &[u8]| {
    let mut device = VirtualDevice::new(&DeviceConfig::new(model("cmd-4cr").unwrap()), 1);
    device.receive(Port::Usb, b"EO=15\r");
    ascii::session(&mut device, COMMANDS, AXES, data);
    ascii::rest(&mut device, REST);
    assert_eq!(ascii::answer(&mut device, "VER"), b"V126BL\r");
    ascii::stands_still(&mut device);
});
