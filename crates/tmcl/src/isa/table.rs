//! The table of commands. To add one, add an entry here; parser, checks, disassembler and documentation
//! follow.

#[cfg(feature = "std")]
use super::Doc;
use super::opcode::*;
use super::{
    Condition, Field, Flag, Instruction, Keyword, MoveKind, Operand, Operation, RefSearch, Role, WaitFor,
};

const fn kind(role: Role) -> Operand {
    Operand { field: Field::Kind, role, optional: false }
}

const fn motor(role: Role) -> Operand {
    Operand { field: Field::Motor, role, optional: false }
}

const fn value(role: Role) -> Operand {
    Operand { field: Field::Value, role, optional: false }
}

const fn optional(operand: Operand) -> Operand {
    Operand { optional: true, ..operand }
}

/// `CALC` knows no SWAP and has COMP as a command of its own.
const CALC_WORDS: &[Keyword] = Operation::KEYWORDS.split_at(10).0;

/// `CALCX` has no COMP.
const CALCX_WORDS: &[Keyword] = Operation::KEYWORDS.split_at(11).0;

/// `CALCV` has nothing to swap with.
const CALCV_WORDS: &[Keyword] = {
    const WITHOUT_SWAP: [Keyword; 11] = {
        let mut words = [Operation::KEYWORDS[0]; 11];
        let mut index = 0;
        while index < 10 {
            words[index] = Operation::KEYWORDS[index];
            index += 1;
        }
        words[10] = Operation::KEYWORDS[11];
        words
    };
    &WITHOUT_SWAP
};

const OPERATION: Operand = kind(Role::Keyword(Operation::KEYWORDS));
const CONDITION: Operand = kind(Role::Keyword(Condition::KEYWORDS));
const MOVE: Operand = kind(Role::Keyword(MoveKind::KEYWORDS));
const AXIS_PARAMETER: Operand = kind(Role::AxisParameter);
const GLOBAL_PARAMETER: Operand = kind(Role::GlobalParameter);
const BANK: Operand = motor(Role::Bank);
const MOTOR: Operand = motor(Role::Motor);
const COORDINATE: Operand = kind(Role::Coordinate);
const PORT: Operand = kind(Role::Port);
const PORT_BANK: Operand = motor(Role::PortBank);
const INTERRUPT: Operand = kind(Role::Interrupt);
const VARIABLE: Operand = motor(Role::Variable);
const LABEL: Operand = value(Role::Address);
const NUMBER: Operand = value(Role::Number);
const VELOCITY: Operand = value(Role::Velocity);
const USER_FUNCTION: &[Operand] =
    &[optional(kind(Role::Number)), optional(motor(Role::Number)), optional(NUMBER)];

/// Where a command may be used, in the words of the table below.
macro_rules! usage {
    (anywhere) => {
        (true, true, true)
    };
    (direct_and_program) => {
        (true, true, false)
    };
    (program) => {
        (false, true, false)
    };
    (direct) => {
        (true, false, false)
    };
    (ascii_only) => {
        (false, false, true)
    };
}

/// `opcode mnemonic [operands] usage, section, summary, example;`
macro_rules! commands {
    ($($opcode:ident $mnemonic:expr, $operands:expr, $usage:ident, $section:literal, $summary:literal, $example:literal;)*) => {
        /// The instruction set, in the order of the opcodes.
        pub static TABLE: &[Instruction] = &[$(Instruction {
            opcode: $opcode,
            mnemonic: $mnemonic,
            operands: $operands,
            direct: usage!($usage).0,
            program: usage!($usage).1,
            ascii: usage!($usage).2,
            #[cfg(feature = "std")]
            doc: Doc { section: $section, summary: $summary, example: $example },
        },)*];
    };
}

commands! {
    ROR Some("ROR"), &[MOTOR, VELOCITY], anywhere,
        "3.7.1", "Turns the motor right (position rising) at a speed.", "ROR 0, 1000";
    ROL Some("ROL"), &[MOTOR, VELOCITY], anywhere,
        "3.7.2", "Turns the motor left (position falling) at a speed.", "ROL 0, 1000";
    MST Some("MST"), &[MOTOR], anywhere,
        "3.7.3", "Stops the motor with the deceleration ramp.", "MST 0";
    MVP Some("MVP"), &[MOVE, MOTOR, value(Role::Target)], anywhere,
        "3.7.4", "Moves to a position, by a distance or to a coordinate.", "MVP ABS, 0, 90000";
    SAP Some("SAP"), &[AXIS_PARAMETER, MOTOR, NUMBER], anywhere,
        "3.7.5", "Sets an axis parameter.", "SAP 4, 0, 1000";
    GAP Some("GAP"), &[AXIS_PARAMETER, MOTOR], anywhere,
        "3.7.6", "Reads an axis parameter.", "GAP 1, 0";
    STAP Some("STAP"), &[AXIS_PARAMETER, MOTOR], anywhere,
        "3.7.7", "Stores an axis parameter in the EEPROM.", "STAP 6, 0";
    RSAP Some("RSAP"), &[AXIS_PARAMETER, MOTOR], anywhere,
        "3.7.8", "Restores an axis parameter from the EEPROM.", "RSAP 6, 0";
    SGP Some("SGP"), &[GLOBAL_PARAMETER, BANK, NUMBER], anywhere,
        "3.7.9", "Sets a global parameter or a user variable.", "SGP 66, 0, 3";
    GGP Some("GGP"), &[GLOBAL_PARAMETER, BANK], anywhere,
        "3.7.10", "Reads a global parameter or a user variable.", "GGP 66, 0";
    STGP Some("STGP"), &[GLOBAL_PARAMETER, BANK], anywhere,
        "3.7.11", "Stores a user variable in the EEPROM.", "STGP 42, 2";
    RSGP Some("RSGP"), &[GLOBAL_PARAMETER, BANK], anywhere,
        "3.7.12", "Restores a user variable from the EEPROM.", "RSGP 42, 2";
    RFS Some("RFS"), &[kind(Role::Keyword(RefSearch::KEYWORDS)), MOTOR], anywhere,
        "3.7.13", "Starts or stops the reference search, or tells whether it runs.", "RFS START, 0";
    SIO Some("SIO"), &[PORT, PORT_BANK, NUMBER], anywhere,
        "3.7.14", "Sets an output, or all of them.", "SIO 0, 2, 1";
    GIO Some("GIO"), &[PORT, PORT_BANK], anywhere,
        "3.7.15", "Reads an input or output.", "GIO 0, 1";
    CALC Some("CALC"), &[kind(Role::Keyword(CALC_WORDS)), NUMBER], direct_and_program,
        "3.7.16", "Calculates with the accumulator and a number.", "CALC MUL, -5000";
    COMP Some("COMP"), &[NUMBER], direct_and_program,
        "3.7.17", "Compares the accumulator with a number.", "COMP 1000";
    JC Some("JC"), &[CONDITION, LABEL], program,
        "3.7.18", "Jumps if a condition holds.", "JC GE, 10";
    JA Some("JA"), &[LABEL], program,
        "3.7.19", "Jumps.", "JA 10";
    CSUB Some("CSUB"), &[LABEL], program,
        "3.7.20", "Calls a subroutine.", "CSUB 100";
    RSUB Some("RSUB"), &[], program,
        "3.7.21", "Returns from a subroutine.", "RSUB";
    EI Some("EI"), &[INTERRUPT], direct_and_program,
        "3.7.32", "Enables an interrupt, or with 255 all that are enabled.", "EI 255";
    DI Some("DI"), &[INTERRUPT], direct_and_program,
        "3.7.33", "Disables an interrupt, or with 255 all.", "DI 255";
    WAIT Some("WAIT"), &[kind(Role::Keyword(WaitFor::KEYWORDS)), MOTOR, value(Role::Ticks)], program,
        "3.7.22", "Waits for a time or an event.", "WAIT POS, 0, 0";
    STOP Some("STOP"), &[], program,
        "3.7.23", "Ends the program.", "STOP";
    SCO Some("SCO"), &[COORDINATE, MOTOR, NUMBER], anywhere,
        "3.7.24", "Sets a coordinate; with motor 255, stores it in the EEPROM.", "SCO 1, 0, 1000";
    GCO Some("GCO"), &[COORDINATE, MOTOR, optional(NUMBER)], anywhere,
        "3.7.25", "Reads a coordinate; with motor 255, restores it from the EEPROM.", "GCO 1, 0";
    CCO Some("CCO"), &[COORDINATE, MOTOR], anywhere,
        "3.7.26", "Copies the actual position to a coordinate.", "CCO 3, 0";
    CALCX Some("CALCX"), &[kind(Role::Keyword(CALCX_WORDS))], direct_and_program,
        "3.7.28", "Calculates with the accumulator and the X register.", "CALCX MUL";
    AAP Some("AAP"), &[AXIS_PARAMETER, MOTOR], direct_and_program,
        "3.7.29", "Sets an axis parameter to the accumulator.", "AAP 0, 0";
    AGP Some("AGP"), &[GLOBAL_PARAMETER, BANK], direct_and_program,
        "3.7.30", "Sets a global parameter or a user variable to the accumulator.", "AGP 42, 2";
    CLE Some("CLE"), &[kind(Role::Keyword(Flag::KEYWORDS))], direct_and_program,
        "3.7.31", "Clears an error flag, or all.", "CLE ETO";
    VECT Some("VECT"), &[INTERRUPT, LABEL], direct_and_program,
        "3.7.34", "Sets the handler of an interrupt.", "VECT 0, 50";
    RETI Some("RETI"), &[], program,
        "3.7.35", "Returns from an interrupt handler.", "RETI";
    ACO Some("ACO"), &[COORDINATE, MOTOR], direct_and_program,
        "3.7.27", "Copies the accumulator to a coordinate.", "ACO 1, 0";
    CALCVV Some("CALCVV"), &[OPERATION, VARIABLE, value(Role::Variable)], direct_and_program,
        "3.7.36", "Calculates with two user variables.", "CALCVV SUB, 65, 42";
    CALCVA Some("CALCVA"), &[OPERATION, VARIABLE], direct_and_program,
        "3.7.37", "Calculates with a user variable and the accumulator.", "CALCVA SUB, 27";
    CALCAV Some("CALCAV"), &[OPERATION, VARIABLE], direct_and_program,
        "3.7.38", "Calculates with the accumulator and a user variable.", "CALCAV SUB, 27";
    CALCVX Some("CALCVX"), &[OPERATION, VARIABLE], direct_and_program,
        "3.7.39", "Calculates with a user variable and the X register.", "CALCVX SUB, 27";
    CALCXV Some("CALCXV"), &[OPERATION, VARIABLE], direct_and_program,
        "3.7.40", "Calculates with the X register and a user variable.", "CALCXV SUB, 27";
    CALCV Some("CALCV"), &[kind(Role::Keyword(CALCV_WORDS)), VARIABLE, NUMBER], direct_and_program,
        "3.7.41", "Calculates with a user variable and a number.", "CALCV SUB, 27, 5000";
    MVPA Some("MVPA"), &[MOVE, MOTOR], direct_and_program,
        "3.7.45", "Moves as the accumulator says.", "MVPA ABS, 0";
    RST Some("RST"), &[LABEL], program,
        "3.7.42", "Resets the program and starts it again at an address.", "RST 10";
    DJNZ Some("DJNZ"), &[kind(Role::Variable), LABEL], program,
        "3.7.43", "Counts a user variable down and jumps until it is 0.", "DJNZ 42, 1";
    ROLA Some("ROLA"), &[MOTOR], direct_and_program,
        "3.7.46", "Turns the motor left at the accumulator's speed.", "ROLA 0";
    RORA Some("RORA"), &[MOTOR], direct_and_program,
        "3.7.47", "Turns the motor right at the accumulator's speed.", "RORA 0";
    SIV Some("SIV"), &[NUMBER], direct_and_program,
        "3.7.48", "Sets the user variable that the X register names.", "SIV 3";
    GIV Some("GIV"), &[], direct_and_program,
        "3.7.49", "Reads the user variable that the X register names.", "GIV";
    AIV Some("AIV"), &[], direct_and_program,
        "3.7.50", "Copies the accumulator to the user variable that the X register names.", "AIV";
    UF0 Some("UF0"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF0";
    UF1 Some("UF1"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF1";
    UF2 Some("UF2"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF2";
    UF3 Some("UF3"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF3";
    UF4 Some("UF4"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF4";
    UF5 Some("UF5"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF5";
    UF6 Some("UF6"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF6";
    UF7 Some("UF7"), USER_FUNCTION, ascii_only,
        "3.7.51", "A customer's own command; this firmware has none.", "UF7";
    CALL Some("CALL"), &[CONDITION, LABEL], program,
        "3.7.44", "Calls a subroutine if a condition holds.", "CALL LT, 100";
    STOP_APPLICATION None, &[], direct,
        "3.7.53", "Stops the program.", "128, 0, 0, 0";
    RUN_APPLICATION None, &[kind(Role::Number), value(Role::Address)], direct,
        "3.7.53", "Starts the program: type 0 where it stands, type 1 at an address.", "129, 1, 0, 0";
    STEP_APPLICATION None, &[], direct,
        "3.7.53", "Executes the next command of the program.", "130, 0, 0, 0";
    RESET_APPLICATION None, &[], direct,
        "3.7.53", "Stops the program and clears counter, stack, registers and flags.", "131, 0, 0, 0";
    START_DOWNLOAD None, &[value(Role::Address)], direct,
        "3.7.53", "Stores the commands that follow instead of executing them.", "132, 0, 0, 0";
    END_DOWNLOAD None, &[], direct,
        "3.7.53", "Executes commands again.", "133, 0, 0, 0";
    READ_MEMORY None, &[value(Role::Address)], direct,
        "3.7.53", "Reads a cell of the program memory; the reply has a form of its own.", "134, 0, 0, 0";
    APPLICATION_STATUS None, &[kind(Role::Number)], direct,
        "3.7.53", "Tells what the program does, or reads its registers.", "135, 0, 0, 0";
    FIRMWARE_VERSION None, &[kind(Role::Number)], direct,
        "3.7.53", "Reads the version: type 0 as text, type 1 as a number.", "136, 1, 0, 0";
    FACTORY_SETTINGS None, &[NUMBER], direct,
        "3.7.53", "Sets everything in the EEPROM back; the value must be 1234.", "137, 0, 0, 1234";
    POSITION_REACHED_EVENT None, &[kind(Role::Number), NUMBER], direct,
        "3.7.52", "Asks for a second reply when the target is reached.", "138, 1, 0, 1";
    ASCII_MODE None, &[], direct,
        "3.4.1", "Changes to the ASCII interface.", "139, 0, 0, 0";
    SOFTWARE_RESET None, &[NUMBER], direct,
        "3.7.53", "Restarts the module; the value must be 1234.", "255, 0, 0, 1234";
}
