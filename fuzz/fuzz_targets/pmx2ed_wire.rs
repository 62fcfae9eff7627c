//! Whatever users do to a PMX-2ED-SA on the simulated machine: nothing may panic, and the controller must still
//! answer and stop afterwards.

#![no_main]

mod ascii;

use devices::pmx2ed::table::{AXES, COMMANDS};
use devices::{Port, model};
use libfuzzer_sys::fuzz_target;
use sim::{DeviceConfig, VirtualDevice};

/// Lets everything come to rest.
const REST: &str = "SR0=0\rSR1=0\rABORT\rJF\rSLX=0\rSLY=0\rABORT";

fuzz_target!(|data: &[u8]| {
    let mut device = VirtualDevice::new(&DeviceConfig::new(model("pmx-2ed").unwrap()), 1);
    device.receive(Port::Usb, b"EO=3\r");
    ascii::session(&mut device, COMMANDS, AXES, data);
    ascii::rest(&mut device, REST);
    assert_eq!(ascii::answer(&mut device, "ID"), b"PERFORMAX-2ED-SA\r");
    ascii::stands_still(&mut device);
});
