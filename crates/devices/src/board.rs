//! What a controller is soldered to: the one door through which it acts on the world.
//!
//! The simulator's machine stands behind it, and so does a microcontroller's pins. A controller never
//! waits, reads a clock or opens a file: time, bytes and changes of inputs come in through
//! [`Controller`](crate::Controller), everything else goes out and is sampled here.

use motion::{Ticks, Train};

/// A port that takes and gives bytes. Each controller lists the ports it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Port {
    /// USB: point to point, addresses do not count.
    Usb,
    /// RS-485: a bus shared with others.
    Rs485,
    /// CAN; bytes are whole frames in the form of `protocol::can`.
    Can,
}

/// What the driver stage does with the pulses of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Drive {
    /// How far the magnetic field turns a pulse, in the finest microsteps that the driver has; negative if
    /// it is reversed.
    pub step: i16,
    /// Into how many parts the driver divides a pulse; 1 if it does not.
    pub parts: u8,
    /// Coil current in 1/32 of the module's maximum: 0 (the motor turns freely) to 32.
    pub current: u8,
}

/// The far side of a controller's pins.
pub trait Board {
    /// The controller has reached this clock: what it calls next happens now, pulses apart, which have
    /// their own times. Comes before anything else that happens in
    /// [`Controller::advance`](crate::Controller::advance).
    fn clock(&mut self, now: Ticks);

    /// These pulses left the axis. Trains of one axis come in order of time and do not overlap.
    fn pulses(&mut self, axis: usize, train: &Train);

    /// The driver stage of the axis changes.
    fn drive(&mut self, axis: usize, drive: Drive);

    /// Bytes leave through a port. `delay_ms` is the pause that the controller was told to keep first.
    fn send(&mut self, port: Port, bytes: &[u8], delay_ms: u32);

    /// An output pin changes; numbers as in [`Controller::pins`](crate::Controller::pins). A port is an
    /// output from now on.
    fn output(&mut self, pin: usize, on: bool);

    /// A port becomes an input: what is outside decides its level. Where that is another than the
    /// controller was told last, it is told.
    fn release(&mut self, pin: usize);

    /// An analog output changes, in the board's integers: units of the pin times its scale.
    fn output_analog(&mut self, pin: usize, value: i32);

    /// The counter of an encoder's decoder, as it stands now.
    fn encoder(&mut self, channel: usize) -> i32;

    /// The level of a digital input or an index channel, as it is now. Inputs that the controller watches
    /// announce their changes; this is for those that it looks at when it is asked.
    fn digital(&mut self, pin: usize) -> bool;

    /// The load on the shaft now, in 1/1000 of the motor's pull-out torque at full current.
    fn load(&mut self, axis: usize) -> u16;

    /// An analog quantity now, in the board's integers: units of the pin times its scale.
    fn analog(&mut self, pin: usize) -> i32;
}
