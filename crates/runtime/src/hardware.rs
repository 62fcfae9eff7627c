//! What a board implements: the pins and the timer of the player's interrupt, and the rest for the main loop.
//!
//! The two halves share no state here. A board gives the interrupt what it needs ([`Pins`], [`Timer`]) and keeps
//! it there, and the main loop what that needs ([`Hardware`]).

use crate::figures::Figures;
use devices::{Drive, Port};
use motion::Direction;

/// Ticks of the board's free-running timer: the lower 32 bits, which wrap. Moments that are compared are never as
/// much as half of that apart.
pub type TimerTicks = u32;

/// Of the board's clock interrupt, which ends [`Hardware::rest`] so often a second.
pub const TICK_HZ: u32 = 4000;

/// The most axes that a board drives.
pub const MAX_AXES: usize = 4;

/// The most serial ports.
pub const MAX_PORTS: usize = 2;

/// The timer in whose interrupt the player runs.
pub trait Timer {
    /// Ticks a second, from 1 MHz up.
    const HZ: u32;

    /// Now.
    fn now(&self) -> TimerTicks;

    /// When the next interrupt comes. A tick that has passed already, or passes while this is done, makes it come
    /// as soon as the present one is over. `None`: not before [`Hardware::kick`].
    fn set_alarm(&mut self, at: Option<TimerTicks>);
}

/// The pins that the player drives, in the timer's interrupt.
pub trait Pins {
    /// The direction pin, before the first pulse in that direction. Where the driver needs time between the two
    /// pins, this waits.
    fn direction(&mut self, axis: usize, direction: Direction);

    /// The leading edges on the step pins of these axes: axis 0 in the lowest bit.
    fn step(&mut self, axes: u8);

    /// The trailing edges of the same pulses. About as much code lies between as the next pulse takes to find;
    /// where the driver needs more, this waits first.
    fn step_end(&mut self, axes: u8);

    /// The driver stage of the axis changes.
    fn drive(&mut self, axis: usize, drive: Drive);

    /// An output pin changes, or a port becomes an output; numbers as in
    /// [`Controller::pins`](devices::Controller::pins).
    fn output(&mut self, pin: usize, on: bool);

    /// A port becomes an input.
    fn release(&mut self, pin: usize);

    /// An analog output changes, in the unit of the pin times its scale.
    fn output_analog(&mut self, pin: usize, value: i32);

    /// Told of each pulse after its leading edge: when it was due, and by how many ticks it was late.
    #[inline]
    fn played(&mut self, _axis: usize, _direction: Direction, _due: TimerTicks, _late: u32) {}
}

/// A port for bytes.
///
/// Nothing of it is called that would block: reading and writing only after the port said that it is ready. Bytes
/// that come between two turns of the main loop (a tick and what the loop takes, a millisecond at most) are the
/// driver's to keep.
pub trait Serial:
    embedded_io::Read + embedded_io::ReadReady + embedded_io::Write + embedded_io::WriteReady
{
    /// Before the first byte of what is sent: on a bus, the driver's enable pin. A UART that does this by itself
    /// needs nothing here.
    fn begin(&mut self) {}

    /// Everything that was written has left, down to the last bit.
    fn is_sent(&mut self) -> bool {
        true
    }

    /// After [`is_sent`](Self::is_sent): the bus is for others.
    fn end(&mut self) {}
}

/// Everything else, for the main loop.
pub trait Hardware {
    /// The kind of its serial ports.
    type Serial: Serial;

    /// The timer of the player.
    type Timer: Timer;

    /// Now, by the player's timer.
    fn now(&self) -> TimerTicks;

    /// Makes the player's interrupt happen now.
    fn kick(&mut self);

    /// Sleeps until an interrupt: of the [clock](TICK_HZ), the player, a byte that came or was sent. One that came
    /// after the main loop had looked ends this too (as WFI does with interrupts masked, or WFE).
    fn rest(&mut self);

    /// Whether the [clock](TICK_HZ) has ticked since this was asked last.
    fn ticked(&mut self) -> bool;

    /// The watchdog, about 1,000 times a second, from the main loop alone.
    fn feed(&mut self);

    /// The serial ports that there are, [`MAX_PORTS`] at most: [`Port::Usb`] for one that is point to point,
    /// [`Port::Rs485`] for a bus.
    fn ports(&mut self) -> &mut [(Port, Self::Serial)];

    /// The level of a digital pin or an index channel.
    fn level(&mut self, pin: usize) -> bool;

    /// What is on an analog input, in the unit of the pin times its scale.
    fn analog(&mut self, pin: usize) -> i32;

    /// The counter of an encoder's decoder.
    fn encoder(&mut self, channel: usize) -> i32;

    /// The load on the shaft in 1/1000 of the motor's pull-out torque; 0 where nothing measures it.
    fn load(&mut self, _axis: usize) -> u16 {
        0
    }

    /// The counter of the decoder at an axis' pulser input, which wraps; it never changes where there is none.
    fn pulser(&mut self, _axis: usize) -> i32 {
        0
    }

    /// How things stand, 1,000 times a second, for whoever looks.
    fn report(&mut self, _figures: &Figures) {}
}
