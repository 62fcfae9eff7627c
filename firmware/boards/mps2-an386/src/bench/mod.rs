//! The machine on the board's pins: whoever runs QEMU looks at the [page] and writes what is on the inputs.

pub mod inputs;
pub mod log;
pub mod page;
pub mod poke;
pub mod stack;
pub mod zone;

use crate::registers::PAGE;
use crate::timer::HZ;
use page::{CAUSE_BYTES, ENCODERS, MAGIC, NOT_DRIVEN, set_long};
use runtime::Figures;
use tock_registers::interfaces::{Readable, Writeable};

/// Whether an image has been here before: the file of the PSRAM is not a new one.
pub fn is_known() -> bool {
    PAGE.magic.get() == MAGIC
}

/// Sets up what the image writes, at its start.
pub fn begin(axes: usize, flash_bytes: u32, by_watchdog: bool) {
    let page = &*PAGE;
    page.poke.set(0);
    page.stack_size.set(stack::size());
    page.timer_hz.set(HZ);
    page.axes.set(axes as u32);
    page.logged.set(0);
    page.start_cause.set(by_watchdog.into());
    page.stopped.set(0);
    page.flash_bytes.set(flash_bytes);
    page.cause_bytes.set(0);
    page.odometer.iter().chain(&page.pulses).chain(&page.drive).for_each(|word| word.set(0));
    page.driven.iter().for_each(|word| word.set(NOT_DRIVEN));
    figures(&Figures::default());
}

/// The last thing of a start: why the image had stopped before, and that it is here.
pub fn open(cause: &str) {
    let page = &*PAGE;
    let bytes = cause.as_bytes();
    let bytes = &bytes[..bytes.len().min(CAUSE_BYTES)];
    page.cause.iter().zip(bytes).for_each(|(place, &byte)| place.set(byte));
    page.cause_bytes.set(bytes.len() as u32);
    page.starts.set(page.starts.get() + 1);
    page.magic.set(MAGIC);
}

/// How things stand.
pub fn figures(figures: &Figures) {
    let page = &*PAGE;
    page.slips.set(figures.slips);
    page.dropped_replies.set(figures.dropped_replies);
    set_long(&page.slipped_ticks, figures.slipped_ticks);
    set_long(&page.awake_ticks, figures.awake_ticks);
    set_long(&page.player_ticks, figures.player_ticks);
    set_long(&page.pulses_played, figures.pulses);
    set_long(&page.advances, figures.advances);
}

/// The drivers' currents are off and nothing is driven.
pub fn stop() {
    let page = &*PAGE;
    page.drive.iter().for_each(|drive| drive.set(drive.get() & 0x00FF_FFFF));
    page.driven.iter().for_each(|word| word.set(NOT_DRIVEN));
    page.stopped.set(1);
}

/// What the counter of an encoder says.
pub fn encoder(channel: usize, axes: usize) -> i32 {
    let Some(encoder) = PAGE.encoder.get(channel % ENCODERS) else { return 0 };
    let axis = (encoder.value.get() as usize).min(axes - 1);
    match encoder.kind.get() {
        1 => encoder.value.get() as i32,
        2 => {
            let (numerator, denominator) = (encoder.numerator.get() as i32, encoder.denominator.get().max(1));
            let scaled = i64::from(inputs::odometer(axis)) * i64::from(numerator);
            (scaled + i64::from(denominator / 2)).div_euclid(i64::from(denominator)) as i32
        }
        _ => inputs::odometer(channel % axes),
    }
}
