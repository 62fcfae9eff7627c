//! The two ports of the devices of this language: USB, and a serial bus on which commands have an address.

use crate::board::Port;
use heapless::String;
use protocol::performax::{MAX_COMMAND, Receiver};

/// A command for the device; `None` is one that is no line of text.
pub type Heard = Option<String<MAX_COMMAND>>;

/// State of the ports.
#[derive(Debug)]
pub struct Ports {
    /// Of USB and of RS-485.
    receivers: [Receiver; 2],
    /// The device number, as it was at power-up.
    address: u8,
}

impl Default for Ports {
    fn default() -> Self {
        Self::new()
    }
}

impl Ports {
    /// Ports of a device that is switched off.
    pub const fn new() -> Self {
        Self { receivers: [Receiver::new(), Receiver::new()], address: 0 }
    }

    /// The device number at power-up.
    pub const fn power_on(&mut self, address: u8) {
        self.address = address;
    }

    /// The device number in force.
    pub const fn address(&self) -> u8 {
        self.address
    }

    /// Takes a byte; gives a command when it is whole and for this device. On RS-485 only those with its
    /// address are.
    pub fn hear(&mut self, port: Port, byte: u8) -> Option<Heard> {
        let message = self.receiver(port).push(byte)?;
        let text = message.text.ok().and_then(|text| String::try_from(text).ok());
        let meant = message.address.map_or(port == Port::Usb, |address| address == self.address);
        meant.then_some(text)
    }

    /// Forgets a command that has begun at a port.
    pub fn hang_up(&mut self, port: Port) {
        self.receiver(port).clear();
    }

    /// Which receiver is a port's.
    const fn receiver(&mut self, port: Port) -> &mut Receiver {
        match port {
            Port::Rs485 => &mut self.receivers[1],
            Port::Usb | Port::Can => &mut self.receivers[0],
        }
    }
}
