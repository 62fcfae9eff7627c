use super::*;

#[test]
fn the_table_is_whole_and_sorted() {
    let opcodes: Vec<u8> = TABLE.iter().map(|entry| entry.opcode).collect();
    let expected: Vec<u8> = (1..=15)
        .chain(19..=28)
        .chain(30..=46)
        .chain(48..=51)
        .chain(55..=57)
        .chain(64..=71)
        .chain([80])
        .chain(128..=139)
        .chain([255])
        .collect();
    assert_eq!(opcodes, expected);
    for opcode in 0..=255 {
        assert_eq!(instruction(opcode).is_some(), expected.contains(&opcode));
    }
}

#[test]
fn a_field_takes_one_operand_and_optional_ones_come_last() {
    for entry in TABLE {
        for (index, operand) in entry.operands.iter().enumerate() {
            let rest = &entry.operands[index + 1..];
            assert!(rest.iter().all(|other| other.field != operand.field), "{entry:?}");
            assert!(!operand.optional || rest.iter().all(|other| other.optional), "{entry:?}");
        }
    }
}

#[test]
fn availability() {
    let check = |mode, refused: &[u8]| {
        for entry in TABLE {
            let expected =
                if refused.contains(&entry.opcode) { Err(Status::NOT_AVAILABLE) } else { Ok(entry) };
            assert_eq!(available(entry.opcode, mode), expected, "{entry:?}");
        }
    };
    let program_only = [21, 22, 23, 24, 27, 28, 38, 48, 49, 80];
    let user_functions: Vec<u8> = (64..=71).collect();
    let direct_only: Vec<u8> = (128..=139).chain([255]).collect();
    let not_typed: Vec<u8> =
        [19, 20, 25, 26].into_iter().chain(33..=46).chain([50, 51, 55, 56, 57]).collect();
    check(Mode::Direct, &[&program_only[..], &user_functions].concat());
    check(Mode::Program, &[&direct_only[..], &user_functions].concat());
    check(Mode::Ascii, &[&program_only[..], &user_functions, &direct_only, &not_typed].concat());
    assert_eq!(available(0, Mode::Direct), Err(Status::INVALID_COMMAND));
    assert_eq!(available(16, Mode::Program), Err(Status::INVALID_COMMAND));
}

#[test]
fn mnemonics_in_any_case() {
    for entry in TABLE {
        if let Some(name) = entry.mnemonic {
            assert_eq!(by_mnemonic(&name.to_lowercase()), Some(entry));
        }
    }
    assert_eq!(by_mnemonic("MVPXA"), None);
}

#[test]
fn a_command_is_eight_bytes() {
    assert_eq!(size_of::<Command>(), 8);
}

#[test]
fn interrupts_are_sorted_by_number() {
    assert!(INTERRUPTS.is_sorted_by_key(|interrupt| interrupt.number));
    assert_eq!(interrupt_index(21), Some(5));
    assert_eq!(interrupt_index(4), None);
    assert_eq!(interrupt_index(GLOBAL_INTERRUPT), None);
}
