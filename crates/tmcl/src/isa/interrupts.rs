//! The interrupts of the module (manual, table 12).

/// The number that switches all interrupts on or off.
pub const GLOBAL_INTERRUPT: u8 = 255;

/// An interrupt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interrupt {
    /// Its number; lower ones come first.
    pub number: u8,
    /// Its symbol in `Interrupts.inc`.
    pub symbol: &'static str,
    /// When it happens.
    pub event: &'static str,
}

const fn interrupt(number: u8, symbol: &'static str, event: &'static str) -> Interrupt {
    Interrupt { number, symbol, event }
}

/// All of them but [`GLOBAL_INTERRUPT`], in the order of their numbers.
pub static INTERRUPTS: [Interrupt; 12] = [
    interrupt(0, "TI_TIMER0", "period of timer 0"),
    interrupt(1, "TI_TIMER1", "period of timer 1"),
    interrupt(2, "TI_TIMER2", "period of timer 2"),
    interrupt(3, "TI_POSITION0", "axis 0 reaches its target"),
    interrupt(15, "TI_STALL0", "axis 0 stalls"),
    interrupt(21, "TI_DEVIATION0", "encoder of axis 0 deviates"),
    interrupt(27, "TI_LEFT_STOP0", "left stop switch of axis 0 changes"),
    interrupt(28, "TI_RIGHT_STOP0", "right stop switch of axis 0 changes"),
    interrupt(39, "TI_INPUT0", "input 0 changes"),
    interrupt(40, "TI_INPUT1", "input 1 changes"),
    interrupt(41, "TI_INPUT2", "input 2 changes"),
    interrupt(42, "TI_INPUT3", "input 3 changes"),
];

/// The place of an interrupt in [`INTERRUPTS`].
pub fn interrupt_index(number: u8) -> Option<usize> {
    INTERRUPTS.iter().position(|interrupt| interrupt.number == number)
}

/// The include file `Interrupts.inc`: a symbol for each interrupt.
#[cfg(feature = "std")]
pub fn interrupts_include() -> String {
    use core::fmt::Write;
    let mut text = String::from("// Interrupt numbers, for EI, DI, VECT and bank 3 of SGP.\n");
    let global = Interrupt { number: GLOBAL_INTERRUPT, symbol: "TI_GLOBAL", event: "all interrupts" };
    for Interrupt { number, symbol, event } in INTERRUPTS.iter().chain([&global]) {
        writeln!(text, "{symbol} = {number} // {event}").expect("a string takes everything");
    }
    text
}
