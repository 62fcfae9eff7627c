//! The words through which whoever runs QEMU is the machine of the controller: 32-bit words at a fixed place of
//! the file that is the board's PSRAM.

use tock_registers::register_structs;
use tock_registers::registers::{ReadOnly, ReadWrite};

/// [`Page::magic`] of a page that an image has set up.
pub const MAGIC: u32 = 0x5054_5242;

/// [`Page::driven`] of a pin that is not driven.
pub const NOT_DRIVEN: u32 = 0x8000_0000;

/// Axes that there is room for.
pub const AXES: usize = 8;

/// Pins that there is room for.
pub const PINS: usize = 128;

/// Encoders that there is room for.
pub const ENCODERS: usize = 16;

/// Bytes of the text of a stop.
pub const CAUSE_BYTES: usize = 240;

/// Edges that there is room for in the log.
pub const LOG_EDGES: usize = 0xE0_0000 / 16;

register_structs! {
    /// What is on a pin from outside.
    pub Input {
        /// 0: nothing, it has its level of rest. 1: `value`. 2: a switch or mark, on where the odometer of `axis`
        /// is from `first` to `last`, and again every `every` pulses unless that is 0; the pin has the level
        /// `rest` outside and the other one inside.
        (0x00 => pub kind: ReadOnly<u32>),
        /// The value of kind 1, the axis of kind 2.
        (0x04 => pub value: ReadOnly<u32>),
        (0x08 => pub first: ReadOnly<u32>),
        (0x0C => pub last: ReadOnly<u32>),
        (0x10 => pub every: ReadOnly<u32>),
        (0x14 => pub rest: ReadOnly<u32>),
        (0x18 => _reserved),
        (0x20 => @END),
    },

    /// What the counter of an encoder says.
    pub Encoder {
        /// 0: the odometer of the axis with its number, modulo the number of axes. 1: `value`. 2: the odometer
        /// of `axis` times a ratio, rounded to the nearest.
        (0x00 => pub kind: ReadOnly<u32>),
        /// The value of kind 1, the axis of kind 2.
        (0x04 => pub value: ReadOnly<u32>),
        (0x08 => pub numerator: ReadOnly<u32>),
        (0x0C => pub denominator: ReadOnly<u32>),
        (0x10 => @END),
    },

    /// A pulse as it was played.
    pub Edge {
        /// The timer's tick when it was due, its lower half first.
        (0x00 => pub due: [ReadWrite<u32>; 2]),
        /// The axis; bit 8: up.
        (0x08 => pub axis: ReadWrite<u32>),
        /// By how many ticks it was late.
        (0x0C => pub late: ReadWrite<u32>),
        (0x10 => @END),
    },

    /// The page. What is said to be the host's is read here only.
    pub Page {
        /// [`MAGIC`], written last; without it the flash is taken for new and erased.
        (0x0000 => pub magic: ReadWrite<u32>),
        /// How often an image has started.
        (0x0004 => pub starts: ReadWrite<u32>),
        /// The host's: a [poke](crate::bench::poke), cleared when it is taken.
        (0x0008 => pub poke: ReadWrite<u32>),
        /// Bytes of the stack that were never used.
        (0x000C => pub stack_unused: ReadWrite<u32>),
        (0x0010 => pub stack_size: ReadWrite<u32>),
        (0x0014 => pub slips: ReadWrite<u32>),
        (0x0018 => pub slipped_ticks: [ReadWrite<u32>; 2]),
        (0x0020 => pub awake_ticks: [ReadWrite<u32>; 2]),
        (0x0028 => pub player_ticks: [ReadWrite<u32>; 2]),
        (0x0030 => pub pulses_played: [ReadWrite<u32>; 2]),
        (0x0038 => pub advances: [ReadWrite<u32>; 2]),
        (0x0040 => pub timer_hz: ReadWrite<u32>),
        (0x0044 => pub axes: ReadWrite<u32>),
        /// The host's: how many edges to log.
        (0x0048 => pub log_wanted: ReadOnly<u32>),
        (0x004C => pub logged: ReadWrite<u32>),
        /// Why it started: 0 power, 1 watchdog.
        (0x0050 => pub start_cause: ReadWrite<u32>),
        /// 1: stopped by an assertion or a fault.
        (0x0054 => pub stopped: ReadWrite<u32>),
        /// Bytes of flash for settings; the page of the cause of a stop follows.
        (0x0058 => pub flash_bytes: ReadWrite<u32>),
        (0x005C => pub dropped_replies: ReadWrite<u32>),
        /// Net pulses played.
        (0x0060 => pub odometer: [ReadWrite<u32>; AXES]),
        /// All pulses played.
        (0x0080 => pub pulses: [ReadWrite<u32>; AXES]),
        /// The driver stages: field a pulse in the lower half, parts, current.
        (0x00A0 => pub drive: [ReadWrite<u32>; AXES]),
        /// Ticks of the timer since the start, at the last report.
        (0x00C0 => pub time: [ReadWrite<u32>; 2]),
        /// The host's: 1 lets the core wait for interrupts without sleeping, so that nothing but its instructions
        /// counts as time, and not how late the host is.
        (0x00C8 => pub spin: ReadOnly<u32>),
        (0x00CC => _free),
        /// What is driven on each pin: 0, 1, the value, or [`NOT_DRIVEN`].
        (0x0100 => pub driven: [ReadWrite<u32>; PINS]),
        /// The host's.
        (0x0300 => pub input: [Input; PINS]),
        /// The host's.
        (0x1300 => pub encoder: [Encoder; ENCODERS]),
        /// The host's: load of each axis in 1/1000 of the pull-out torque.
        (0x1400 => pub load: [ReadOnly<u32>; AXES]),
        /// The host's: counter of each axis' pulser input.
        (0x1420 => pub pulser: [ReadOnly<u32>; AXES]),
        (0x1440 => _free_too),
        /// Bytes of the text that follows: why the image stopped before this start; 0 if it did not.
        (0x8000 => pub cause_bytes: ReadWrite<u32>),
        (0x8004 => pub cause: [ReadWrite<u8>; CAUSE_BYTES]),
        (0x80F4 => _free_as_well),
        /// The log.
        (0x10_0000 => pub log: [Edge; LOG_EDGES]),
        (0xF0_0000 => @END),
    }
}

/// Writes a number of 64 bits, its lower half first.
pub fn set_long(words: &[ReadWrite<u32>; 2], value: u64) {
    use tock_registers::interfaces::Writeable;
    words[0].set(value as u32);
    words[1].set((value >> 32) as u32);
}
