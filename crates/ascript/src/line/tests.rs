use super::*;
use crate::dialect::{COMMANDER, PERFORMAX_2};

#[test]
fn text_and_bytes() {
    let check = |dialect: &Dialect, text: &str| {
        let line = Line::parse(text, dialect).unwrap_or_else(|| panic!("`{text}` is no line"));
        assert_eq!(line.to_string(), text);
        assert!(text.len() <= TEXT_LENGTH);
        assert_eq!(Line::from_bytes(&line.to_bytes(), dialect), Some(line), "{text}");
    };
    for text in [
        "",
        "PRG 1",
        "END",
        "SUB 31",
        "ENDSUB",
        "GOSUB 0",
        "V1 = 2",
        "V63 = V62",
        "T2 = DI8",
        "V1 = ~MSTX",
        "V1 = V2 >> -2147483648",
        "V1 = T0 | T1",
        "IF T0 = 1 -> 1274",
        "IF T0 & T1 != AI2 -> 0",
        "WHILE ~V1 >= -2147483648 -> 12",
        "WHILE V10 << V20 <= V30 -> 12",
        "ELSEIF -> 7",
        "ELSE -> 7",
        "ENDIF",
        "ENDWHILE -> 3",
        "HSPD = 1000",
        "HSPDY = V1",
        "JOYNOX = -1000",
        "DO2 = T1",
        "EO = 3",
        "X -2147483648",
        "Y V1",
        "X T0 Y 100",
        "DELAY = 4294967295",
        "DELAY = V1",
        "SR1 = 2",
        "JOGX+",
        "JOGY-",
        "HOMEX-",
        "ZOMEY+",
        "WAITX",
        "ABORT",
        "ABORTY",
    ] {
        check(&PERFORMAX_2, text);
    }
    for text in [
        "PRG 3",
        "V99 = 0",
        "HOMEU- 12",
        "ZMOVEX+",
        "U V99",
        "X T0 Y T1 Z T2 U -2147483648",
        "Y V1 U V2",
        "CIRXYP V1 V2",
        "CIRUZN T0 5",
        "ARCXYN T0 T1 95000",
        "CIRTP T0 T1 5",
        "ARCTN T0 T1 T2 -2147483648",
        "IO32 = 1",
        "T0 = SYNSTATU",
        "WHILE V10 >> V20 >= SYNSTATX -> 1799",
        "WHILE V10 >> V20 >= -2147483648 -> 1799",
    ] {
        check(&COMMANDER, text);
    }
}

#[test]
fn no_lines() {
    let check = |dialect: &Dialect, text: &str| assert_eq!(Line::parse(text, dialect), None, "{text}");
    for text in [
        "PRG",
        "PRG 2",
        "SUB 32",
        "SUB -1",
        "GOSUB +1",
        "END 1",
        "V64 = 1",
        "T3 = 1",
        "V1 = 5 + 5",
        "V1 = DI1 + DI2",
        "V1 = DI1 + 5",
        "V1 = 2147483648",
        "V1 = HSPDZ",
        "V1 = ABORT",
        "V1 = JOYENA",
        "V1 = DI9",
        "V1 = DI0",
        "V1 =",
        "V1 = V2 V3",
        "V1 = V2 +",
        "V1 = V2 = V3",
        "1 = V1",
        "IF 1 = 1 -> 5",
        "IF T0 -> 5",
        "IF T0 + 1 -> 5",
        "IF T0 = 1 -> 1275",
        "IF T0 = 1",
        "DI1 = 1",
        "MSTX = 1",
        "DO = DI",
        "DELAY = 4294967296",
        "DELAY = -1",
        "DELAY",
        "DELAY 5",
        "X",
        "X 1 2",
        "X 1 X T0",
        "X 1 Z T0",
        "X DI1",
        "JOGX",
        "JOG+",
        "JOGX+ 1",
        "HOMEX- 6",
        "ABORT 1",
        "SR2 = 1",
        "IF",
        "; text",
        "hspd = 1",
    ] {
        check(&PERFORMAX_2, text);
    }
    for text in ["HOMEX-", "HOMEX- 13", "HOMEX- V1", "CIRXYP 1", "CIRXYP V1 V2 V3", "TOC = 1", "SYNSTATX = 1"]
    {
        check(&COMMANDER, text);
    }
}

#[test]
fn no_bytes() {
    let check = |bytes: [u8; BYTES]| assert_eq!(Line::from_bytes(&bytes, &COMMANDER), None, "{bytes:?}");
    check([255; BYTES]);
    check([15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    // `END` has no number, and nothing uses the immediate.
    check([2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    check([2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
    // A register that is none, an operator that is none, no target.
    check([6, 1, 0, 0xFD, 0xFF, 0, 0, 0, 200, 0, 0, 0]);
    check([6, 1, 11, 2, 3, 0, 0, 0, 0, 0, 0, 0]);
    check([6, 0xFE, 0, 2, 0xFF, 0, 0, 0, 0, 0, 0, 0]);
}

#[test]
fn packed_registers() {
    for index in [0, 1, 255] {
        let place = Place::new(Word::Hspd, index);
        assert_eq!(unpack(pack(place)), Some(place));
    }
    assert_eq!([-1, 0, 0x1_0000 + Word::Hspd as i32].map(unpack), [None; 3]);
}
