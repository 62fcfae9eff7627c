//! The instruction set: one table, an entry a command, and the types it speaks in.

mod interrupts;
mod keywords;
mod table;

#[cfg(feature = "std")]
pub use interrupts::interrupts_include;
pub use interrupts::{GLOBAL_INTERRUPT, INTERRUPTS, Interrupt, interrupt_index};
pub use keywords::{Condition, Flag, Keyword, MoveKind, Operation, RefSearch, WaitFor};
pub use table::TABLE;

use core::ops::RangeInclusive;
use protocol::tmcl::{Request, Status};

/// Commands that fit the program memory.
pub const PROGRAM_LENGTH: usize = 2048;

/// User variables (global parameter bank 2).
pub const VARIABLES: usize = 256;

/// The global parameter bank of the user variables.
pub const VARIABLE_BANK: u8 = 2;

/// The highest number of a coordinate.
pub const MAX_COORDINATE: u8 = 20;

/// A command: what a request carries and a program memory cell holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Command {
    /// The command's number.
    pub opcode: u8,
    /// The type field.
    pub kind: u8,
    /// The motor or bank field.
    pub motor: u8,
    /// The value.
    pub value: i32,
}

impl Command {
    /// An empty program memory cell.
    pub const EMPTY: Self = Self::new(0, 0, 0, 0);

    /// The end of a program.
    pub const STOP: Self = Self::new(opcode::STOP, 0, 0, 0);

    /// A command of these fields.
    pub const fn new(opcode: u8, kind: u8, motor: u8, value: i32) -> Self {
        Self { opcode, kind, motor, value }
    }

    /// Its entry in the table, if it has one.
    pub fn instruction(self) -> Option<&'static Instruction> {
        instruction(self.opcode)
    }

    /// The content of one of its fields.
    pub const fn field(self, field: Field) -> i32 {
        match field {
            Field::Kind => self.kind as i32,
            Field::Motor => self.motor as i32,
            Field::Value => self.value,
        }
    }
}

impl From<Request> for Command {
    fn from(request: Request) -> Self {
        Self::new(request.opcode, request.kind, request.motor, request.value)
    }
}

/// The numbers of the commands that code has to name.
#[allow(missing_docs)] // The table says what each of them does.
pub mod opcode {
    pub const ROR: u8 = 1;
    pub const ROL: u8 = 2;
    pub const MST: u8 = 3;
    pub const MVP: u8 = 4;
    pub const SAP: u8 = 5;
    pub const GAP: u8 = 6;
    pub const STAP: u8 = 7;
    pub const RSAP: u8 = 8;
    pub const SGP: u8 = 9;
    pub const GGP: u8 = 10;
    pub const STGP: u8 = 11;
    pub const RSGP: u8 = 12;
    pub const RFS: u8 = 13;
    pub const SIO: u8 = 14;
    pub const GIO: u8 = 15;
    pub const CALC: u8 = 19;
    pub const COMP: u8 = 20;
    pub const JC: u8 = 21;
    pub const JA: u8 = 22;
    pub const CSUB: u8 = 23;
    pub const RSUB: u8 = 24;
    pub const EI: u8 = 25;
    pub const DI: u8 = 26;
    pub const WAIT: u8 = 27;
    pub const STOP: u8 = 28;
    pub const SCO: u8 = 30;
    pub const GCO: u8 = 31;
    pub const CCO: u8 = 32;
    pub const CALCX: u8 = 33;
    pub const AAP: u8 = 34;
    pub const AGP: u8 = 35;
    pub const CLE: u8 = 36;
    pub const VECT: u8 = 37;
    pub const RETI: u8 = 38;
    pub const ACO: u8 = 39;
    pub const CALCVV: u8 = 40;
    pub const CALCVA: u8 = 41;
    pub const CALCAV: u8 = 42;
    pub const CALCVX: u8 = 43;
    pub const CALCXV: u8 = 44;
    pub const CALCV: u8 = 45;
    pub const MVPA: u8 = 46;
    pub const RST: u8 = 48;
    pub const DJNZ: u8 = 49;
    pub const ROLA: u8 = 50;
    pub const RORA: u8 = 51;
    pub const SIV: u8 = 55;
    pub const GIV: u8 = 56;
    pub const AIV: u8 = 57;
    pub const UF0: u8 = 64;
    pub const UF1: u8 = 65;
    pub const UF2: u8 = 66;
    pub const UF3: u8 = 67;
    pub const UF4: u8 = 68;
    pub const UF5: u8 = 69;
    pub const UF6: u8 = 70;
    pub const UF7: u8 = 71;
    pub const CALL: u8 = 80;
    pub const STOP_APPLICATION: u8 = 128;
    pub const RUN_APPLICATION: u8 = 129;
    pub const STEP_APPLICATION: u8 = 130;
    pub const RESET_APPLICATION: u8 = 131;
    pub const START_DOWNLOAD: u8 = 132;
    pub const END_DOWNLOAD: u8 = 133;
    pub const READ_MEMORY: u8 = 134;
    pub const APPLICATION_STATUS: u8 = 135;
    pub const FIRMWARE_VERSION: u8 = 136;
    pub const FACTORY_SETTINGS: u8 = 137;
    pub const POSITION_REACHED_EVENT: u8 = 138;
    pub const ASCII_MODE: u8 = 139;
    pub const SOFTWARE_RESET: u8 = 255;
}

/// A field of a command that an operand can go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// The type field.
    Kind,
    /// The motor or bank field.
    Motor,
    /// The value.
    Value,
}

/// What an operand is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// One of these words.
    Keyword(&'static [Keyword]),
    /// Number of an axis parameter.
    AxisParameter,
    /// Number of a global parameter, in the bank that follows.
    GlobalParameter,
    /// A bank of global parameters.
    Bank,
    /// Number of a motor.
    Motor,
    /// Number of a coordinate.
    Coordinate,
    /// Number of an input or output.
    Port,
    /// A bank of inputs or outputs.
    PortBank,
    /// Number of a user variable.
    Variable,
    /// Number of an interrupt.
    Interrupt,
    /// An address in the program memory: a label.
    Address,
    /// A position, a distance or the number of a coordinate, as the first operand says.
    Target,
    /// A speed in the motion controller's internal units.
    Velocity,
    /// A time in units of 10 ms; −1 takes the accumulator's.
    Ticks,
    /// Any number.
    Number,
}

/// An operand of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Where it goes.
    pub field: Field,
    /// What it is.
    pub role: Role,
    /// Whether it can be left out; it is 0 then. Only the last ones can.
    pub optional: bool,
}

impl Operand {
    /// What it is called in messages and documentation.
    pub const fn name(&self) -> &'static str {
        match self.role {
            Role::Keyword(_) => "keyword",
            Role::AxisParameter | Role::GlobalParameter => "parameter",
            Role::Bank | Role::PortBank => "bank",
            Role::Motor => "motor",
            Role::Coordinate => "coordinate",
            Role::Port => "port",
            Role::Variable => "variable",
            Role::Interrupt => "interrupt",
            Role::Address => "label",
            Role::Target => "position",
            Role::Velocity => "velocity",
            Role::Ticks => "ticks",
            Role::Number => "value",
        }
    }

    /// How a program writes it: `<motor>`, `[<value>]`, `<ABS|REL|COORD>`.
    #[cfg(feature = "std")]
    pub fn form(&self) -> String {
        let name = match self.role {
            Role::Keyword(words) => words.iter().map(|word| word.name).collect::<Vec<_>>().join("|"),
            _ => self.name().to_owned(),
        };
        if self.optional { format!("[<{name}>]") } else { format!("<{name}>") }
    }

    /// The numbers that fit. A value field takes signed and unsigned 32-bit numbers; which of them a
    /// parameter accepts is the device's business.
    pub const fn range(&self) -> RangeInclusive<i64> {
        match (self.role, self.field) {
            (Role::Address, _) => 0..=PROGRAM_LENGTH as i64 - 1,
            (Role::Coordinate, _) => 0..=MAX_COORDINATE as i64,
            (Role::Variable, _) => 0..=VARIABLES as i64 - 1,
            (_, Field::Kind | Field::Motor) => 0..=u8::MAX as i64,
            (_, Field::Value) => i32::MIN as i64..=u32::MAX as i64,
        }
    }
}

/// Where a command may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// Sent by a host and executed at once.
    Direct,
    /// Executed from the program memory.
    Program,
    /// Typed at the ASCII interface (manual 3.4).
    Ascii,
}

/// An entry of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// The command's number.
    pub opcode: u8,
    /// Its name in programs. Commands that only make sense from a host have none.
    pub mnemonic: Option<&'static str>,
    /// Its operands in the order they are written.
    pub operands: &'static [Operand],
    /// Whether it can be sent.
    pub direct: bool,
    /// Whether a program can execute it.
    pub program: bool,
    /// Whether it can be typed.
    pub ascii: bool,
    /// Text for people.
    #[cfg(feature = "std")]
    pub doc: Doc,
}

/// What people read about a command; left out of firmware.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doc {
    /// The section of the manual.
    pub section: &'static str,
    /// What it does, in a line.
    pub summary: &'static str,
    /// A line of a program; for commands without a mnemonic, what to send.
    pub example: &'static str,
}

impl Instruction {
    /// Whether it can be used so.
    pub const fn allows(&self, mode: Mode) -> bool {
        match mode {
            Mode::Direct => self.direct,
            Mode::Program => self.program,
            Mode::Ascii => self.ascii && self.direct,
        }
    }

    /// How a program writes it: `MVP <ABS|REL|COORD>, <motor>, <position>`; empty without a mnemonic.
    #[cfg(feature = "std")]
    pub fn form(&self) -> String {
        let Some(mnemonic) = self.mnemonic else { return String::new() };
        let operands: Vec<_> = self.operands.iter().map(Operand::form).collect();
        format!("{mnemonic} {}", operands.join(", ")).trim_end().to_owned()
    }
}

/// For each opcode the index of its entry, or [`NONE`].
static INDEX: [u8; 256] = index();
const NONE: u8 = u8::MAX;

const fn index() -> [u8; 256] {
    let mut index = [NONE; 256];
    let mut entry = 0;
    while entry < TABLE.len() {
        let opcode = TABLE[entry].opcode as usize;
        assert!(index[opcode] == NONE, "an opcode stands in the table once");
        index[opcode] = entry as u8;
        entry += 1;
    }
    index
}

/// The entry of an opcode.
pub fn instruction(opcode: u8) -> Option<&'static Instruction> {
    TABLE.get(usize::from(INDEX[usize::from(opcode)]))
}

/// The entry of a mnemonic, in any case.
pub fn by_mnemonic(mnemonic: &str) -> Option<&'static Instruction> {
    TABLE.iter().find(|entry| entry.mnemonic.is_some_and(|name| name.eq_ignore_ascii_case(mnemonic)))
}

/// The entry of an opcode if it can be used so; otherwise the status that says why not:
/// [`Status::INVALID_COMMAND`] or [`Status::NOT_AVAILABLE`].
pub fn available(opcode: u8, mode: Mode) -> Result<&'static Instruction, Status> {
    let entry = instruction(opcode).ok_or(Status::INVALID_COMMAND)?;
    if entry.allows(mode) { Ok(entry) } else { Err(Status::NOT_AVAILABLE) }
}

#[cfg(test)]
mod tests;
