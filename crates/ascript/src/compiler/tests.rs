use super::*;
use crate::dialect::{COMMANDER, PERFORMAX_2};
use crate::line::{LINES_A_STATEMENT, TEXT_LENGTH};

fn code(source: &str, dialect: &Dialect) -> Code {
    let compilation = compile("test.prg", source.as_bytes(), dialect);
    let Some(code) = compilation.code else { panic!("{}", compilation.render(false)) };
    assert_eq!(code.map.len(), code.lines.len());
    code
}

/// The messages about a source.
fn messages(source: &str, dialect: &Dialect) -> Vec<String> {
    let compilation = compile("a.prg", source.as_bytes(), dialect);
    compilation.diagnostics.iter().map(ToString::to_string).collect()
}

#[test]
fn lines_of_statements() {
    let check = |source: &str, expected: &[&str]| {
        let Code { lines, .. } = code(&format!("PRG 0\n{source}\nEND\n"), &COMMANDER);
        let texts: Vec<String> = lines[1..lines.len() - 1].iter().map(ToString::to_string).collect();
        assert_eq!(texts, *expected, "{source}");
        for line in lines {
            let text = line.to_string();
            assert!(text.len() <= TEXT_LENGTH, "{text}");
            assert_eq!(Line::parse(&text, &COMMANDER), Some(line), "{text}");
        }
    };
    // One line.
    check("V1=5", &["V1 = 5"]);
    check("V1=V2+DI3", &["V1 = V2 + DI3"]);
    check("V1=~IO32", &["V1 = ~IO32"]);
    check("HSPDX=V1", &["HSPDX = V1"]);
    check("X1000", &["X 1000"]);
    check("XV1YV2ZV3UV4", &["X V1 Y V2 Z V3 U V4"]);
    check("HOMEX-6", &["HOMEX- 6"]);
    check("CIRXYPV1:100", &["CIRXYP V1 100"]);
    check("GOSUB 31", &["GOSUB 31"]);
    // Two: a number and a register, or two of one kind.
    check("V1=IO&3", &["T0 = IO", "V1 = T0 & 3"]);
    check("V1=MSTX&7", &["T0 = MSTX", "V1 = T0 & 7"]);
    check("V1=1+2", &["T0 = 1", "V1 = T0 + 2"]);
    check("V1=PX-EX", &["T0 = PX", "V1 = T0 - EX"]);
    check("X1000Y-2000", &["T0 = 1000", "X T0 Y -2000"]);
    check("Y2X1", &["T0 = 1", "X T0 Y 2"]);
    // Three and four.
    check("X1Y2Z3", &["T0 = 1", "T1 = 2", "X T0 Y T1 Z 3"]);
    check("ARCTN1:2:3:4", &["T0 = 1", "T1 = 2", "T2 = 3", "ARCTN T0 T1 T2 4"]);
    // Conditions: the side with the operator comes first.
    check("WHILE 1=1\nENDWHILE", &["T0 = 1", "WHILE T0 = 1 -> 4", "ENDWHILE -> 1"]);
    check("IF 5<V1&3\nENDIF", &["T0 = 3", "IF V1 & T0 > 5 -> 3", "ENDIF"]);
    check(
        "IF DI1=1\nABS\nELSEIF DI1+DI2!=DI3\nINC\nELSE\nSTOP\nENDIF",
        &[
            "T0 = DI1",
            "IF T0 = 1 -> 5",
            "ABS",
            "ELSEIF -> 11",
            "T0 = DI1",
            "T1 = DI2",
            "IF T0 + T1 != DI3 -> 10",
            "INC",
            "ELSE -> 11",
            "STOP",
            "ENDIF",
        ],
    );
}

#[test]
fn a_statement_takes_one_to_four_lines() {
    let operands = ["V1", "5", "DI1"];
    let mut counts = [false; LINES_A_STATEMENT];
    let mut check = |statement: String| {
        let source = format!("PRG 0\nIF V1=V2\n{statement}\nENDIF\nEND\n");
        let count = code(&source, &COMMANDER).addresses(3).count();
        assert!((1..=LINES_A_STATEMENT).contains(&count), "{statement}: {count} lines");
        counts[count - 1] = true;
    };
    for x in operands {
        for y in operands {
            check(format!("V1={x}*{y}"));
            for z in operands {
                check(format!("ELSEIF {x}+{y}<{z}"));
                check(format!("ELSEIF {z}={x}|{y}"));
            }
        }
    }
    for (x, y) in [("V1", "V2"), ("1", "V2"), ("V1", "2"), ("1", "2")] {
        check(format!("X{x}Y{y}Z{x}U{y}"));
        check(format!("ARCTP{x}:{y}:{x}:{y}"));
    }
    assert_eq!(counts, [true; LINES_A_STATEMENT]);
}

#[test]
fn map_to_the_source() {
    let code = code("\nV1=1 ; one\n\nX1Y2\nEND\n", &PERFORMAX_2);
    assert_eq!(code.map, [2, 2, 4, 4, 5]);
    assert_eq!(code.addresses(4).collect::<Vec<_>>(), [2, 3]);
    assert_eq!(code.addresses(1).count(), 0);
}

/// The manual's example of each error (CMD manual, table 5-43), and what is said about it.
#[test]
fn errors_of_the_manual() {
    let check = |source: &str, expected: &[&str]| {
        let own_frame = ["SUB", "PRG"].iter().any(|word| source.starts_with(word));
        let source = if own_frame { source.to_owned() } else { format!("PRG 0\n{source}\nEND\n") };
        let found = messages(&source, &COMMANDER);
        let expected: Vec<String> = expected.iter().map(|text| format!("a.prg:{text}")).collect();
        assert_eq!(found, expected, "{source}");
    };
    check("PRGA\nEND", &["1:1: error: Unknown Error: there is no statement `PRGA` (did you mean `PRG`?)"]);
    check("DO10=1", &["2:3: error: BIT Error: the Commander core has digital outputs 1 to 4"]);
    check(
        "DELAY=V1+200",
        &[
            "2:9: error: Token Error: unexpected `+` (only assignments to variables calculate; use one for the result)",
        ],
    );
    check("V2+1=V3", &["2:3: error: = Error: only one variable or register can stand left of `=`"]);
    check("V1= ABS", &["2:5: error: Assignment Error: `ABS` cannot be read"]);
    check("V1=V2+ABS", &["2:7: error: Operation Argument Error: `ABS` cannot be read"]);
    check(
        "DO=PX",
        &[
            "2:4: error: Error not Number of Var: expected a number or a variable, found `PX` (assign it to a variable first, then use that)",
        ],
    );
    check("V200=1", &["2:2: error: Var Range Error: the Commander core has variables 0 to 99"]);
    check("HSPD*1000", &["2:5: error: Missing =: expected `=`, found `*`"]);
    check("GOSUB900", &["2:6: error: Error GOSUB: the Commander core has subroutines 0 to 31"]);
    check("GOSUB DI1", &["2:7: error: Error SUB Number: expected the number of a subroutine, found `DI`"]);
    check("SUB5000\nENDSUB", &["1:4: error: Error SUB: the Commander core has subroutines 0 to 31"]);
    check("SUB 1\nABS", &["1:1: error: Error ENDSUB: this subroutine has no `ENDSUB`"]);
    check("PRG200\nEND", &["1:4: error: Error PRG: the Commander core has programs 0 to 3"]);
    check("PRG XI3\nEND", &["1:5: error: Error PRG Number: expected the number of a program, found `XI`"]);
    check("PRG 0\nABS", &["1:1: error: Missing END: this program has no `END`"]);
    check("WHILE 1=1", &["2:1: error: Missing ENDWHILE: this `WHILE` has no `ENDWHILE`"]);
    check("IF 1=1", &["2:1: error: Missing ENDIF: this `IF` has no `ENDIF`"]);
    check("V1==V2", &["2:4: error: Error: one `=` is enough (assignments and conditions have a single `=`)"]);
}

/// The kinds of the errors in a source, with line and column.
fn kinds(source: &str, dialect: &Dialect) -> Vec<(ErrorKind, usize, usize)> {
    let diagnostics = compile("", source.as_bytes(), dialect).diagnostics;
    diagnostics
        .iter()
        .filter_map(|found| Some((found.kind()?, found.place.line, found.place.column)))
        .collect()
}

#[test]
fn errors_in_a_line() {
    use ErrorKind::*;
    let check = |statement: &str, kind: ErrorKind, column: usize| {
        let end = match statement.split(' ').next() {
            Some("IF") => "ENDIF\n",
            Some("WHILE") => "ENDWHILE\n",
            _ => "",
        };
        let found = kinds(&format!("PRG 0\n{statement}\n{end}END\n"), &PERFORMAX_2);
        assert_eq!(found, [(kind, 2, column)], "{statement}");
    };
    for (statement, column) in [
        ("10=64", 1),
        ("HSPDZ=1", 1),
        ("hspd=1", 1),
        ("WAIT", 1),
        ("V=1", 1),
        ("?", 1),
        ("=1", 1),
        ("BUFON", 1),
        ("XYV1", 1),
    ] {
        check(statement, Unknown, column);
    }
    for (statement, column) in
        [("DI9=1", 3), ("V1=DI0", 6), ("IF EO3=1", 6), ("V1=V2+AI3", 9), ("EO99999=1", 3)]
    {
        check(statement, Bit, column);
    }
    for (statement, column) in [
        ("ABS 1", 5),
        ("ABS ABS", 5),
        ("V1=V2+V3+V4", 9),
        ("V1=V2 V3", 7),
        ("JOGX", 5),
        ("JOGX=1", 5),
        ("WAITX+", 6),
        ("X=5", 2),
        ("V1=-V2", 5),
        ("X-Y", 3),
        ("END 1", 5),
        ("V1=5:6", 5),
    ] {
        check(statement, Token, column);
    }
    for (statement, column) in [("DI1=1", 1), ("MSTX=0", 1), ("HSPD+1=5", 5), ("V1+V2=V3", 3), ("V1 V2=5", 4)]
    {
        check(statement, Equals, column);
    }
    for (statement, column) in [("V1=", 4), ("V1=+5", 4), ("V1=JOYENA", 4), ("V1=FOO", 4), ("V1=X", 4)] {
        check(statement, Assignment, column);
    }
    for (statement, column) in
        [("V1=V2+", 7), ("V1=~", 5), ("V1=V2+*3", 7), ("IF ABS=1", 4), ("IF V1=", 7), ("WHILE V1=FOO", 10)]
    {
        check(statement, OperationArgument, column);
    }
    for (statement, column) in [("HSPD=", 6), ("SR0=DI1", 5), ("DELAY=DI", 7), ("X", 2), ("X~1", 2)] {
        check(statement, NotNumberOrVariable, column);
    }
    for (statement, column) in
        [("V64=1", 2), ("V1=V64", 5), ("XV64", 3), ("IF V1=V999999", 8), ("HSPD=V64", 7)]
    {
        check(statement, VariableRange, column);
    }
    for (statement, column) in [("V1", 3), ("V1 5", 4), ("DELAY 100", 7), ("SR0", 4), ("DO1-1", 4)] {
        check(statement, MissingEquals, column);
    }
    check("GOSUB 32", Gosub, 7);
    check("GOSUB", SubNumber, 6);
    check("GOSUB -1", SubNumber, 7);
    check("SR2=1", Prg, 3);
    for (statement, column) in [
        ("IF V1", 6),
        ("IF V1==V2", 7),
        ("IF V1=>V2", 7),
        ("IF V1<>V2", 7),
        ("IF V1+1=V2+1", 4),
        ("V1=2147483648", 4),
        ("V1=V2-99999999999999999999", 7),
        ("DELAY=4294967296", 7),
        ("DELAY=-1", 7),
        ("X1X2", 3),
        ("ENDIF", 1),
        ("ENDWHILE", 1),
        ("ELSE", 1),
        ("ELSEIF 1=1", 1),
        ("ENDSUB", 1),
    ] {
        check(statement, Other, column);
    }
}

#[test]
fn errors_of_the_commander() {
    use ErrorKind::*;
    let check = |statement: &str, kind: ErrorKind, column: usize| {
        let found = kinds(&format!("PRG 0\n{statement}\nEND\n"), &COMMANDER);
        assert_eq!(found, [(kind, 2, column)], "{statement}");
    };
    check("HOMEX-", Token, 7);
    check("HOMEX6", Token, 6);
    check("HOMEX-13", Other, 7);
    check("HOMEX-V1", Token, 7);
    check("CIRXYP100", Token, 10);
    check("CIRXYP1:2:3", Token, 10);
    check("CIRXXP1:2", Unknown, 1);
    check("CIRXYP1:DI", NotNumberOrVariable, 9);
    check("ARCXYP1:2", Token, 10);
    check("IO33=1", Bit, 3);
    check("TOC=1", Unknown, 1);
}

#[test]
fn errors_between_lines() {
    use ErrorKind::*;
    let check = |source: &str, expected: &[(ErrorKind, usize)]| {
        let found = kinds(source, &PERFORMAX_2);
        let found: Vec<_> = found.into_iter().map(|(kind, line, _)| (kind, line)).collect();
        assert_eq!(found, expected, "{source}");
    };
    check("", &[]);
    check("SUB 1\nENDSUB\n", &[]);
    check("SUB 1\nENDSUB\nABS\nEND\nPRG 1\nEND\n", &[]);
    check("ABS\n", &[(MissingEnd, 1)]);
    check("PRG 0\nPRG 1\nEND\n", &[(MissingEnd, 1)]);
    check("PRG 0\nSUB 1\nENDSUB\n", &[(MissingEnd, 1)]);
    check("SUB 1\nPRG 0\nEND\n", &[(EndSub, 1)]);
    check("SUB 1\nABS\nEND\n", &[(EndSub, 3)]);
    check("PRG 0\nENDSUB\nEND\n", &[(Other, 2)]);
    check("PRG 0\nEND\nABS\n", &[(Other, 3)]);
    check("PRG 0\nEND\nEND\n", &[(Other, 3)]);
    check("ABS\nEND\nABS\nEND\n", &[(Other, 3), (Other, 4)]);
    check("ABS\nEND\nPRG 0\nEND\n", &[(Prg, 3)]);
    check("PRG 1\nEND\nPRG 1\nEND\n", &[(Prg, 3)]);
    check("SUB 1\nENDSUB\nSUB 1\nENDSUB\n", &[(Sub, 3)]);
    check("PRG 2\nABS\nEND\nPRG 3\nABS\nEND\n", &[(Prg, 1), (Prg, 4)]);
    // Ends of blocks that begin wrong are not wrong too.
    check(
        "PRG 0\nIF V1==1\nELSEIF V1\nELSE\nENDIF\nWHILE\nENDWHILE\nEND\n",
        &[(Other, 2), (Other, 3), (OperationArgument, 6)],
    );
    check("ENDSUB\n", &[(Other, 1)]);
    check("PRG 0\nIF 1=1\nWHILE 1=1\nENDIF\nENDWHILE\nEND\n", &[(MissingEndIf, 2), (Other, 4)]);
    check("PRG 0\nIF 1=1\nELSE\nELSE\nENDIF\nEND\n", &[(Other, 4)]);
    check("PRG 0\nIF 1=1\nELSE\nELSEIF 1=1\nENDIF\nEND\n", &[(Other, 4)]);
    // Every error in one go.
    let source = "PRG 0\nABX\nV1=V2+\nWHILE 1=1\nDO9=1\nEND\nSUB 99\nENDSUB\n";
    check(source, &[(Unknown, 2), (OperationArgument, 3), (MissingEndWhile, 4), (Bit, 5), (Sub, 7)]);
}

#[test]
fn hints() {
    let check = |statement: &str, dialect: &Dialect, expected: &str| {
        let compilation = compile("", format!("PRG 0\n{statement}\nEND\n").as_bytes(), dialect);
        let hint = compilation.diagnostics[0].hint.as_deref();
        assert_eq!(hint, Some(expected), "{statement}");
    };
    check("hspd=100", &PERFORMAX_2, "words are in upper case: `HSPD`");
    check("x100", &PERFORMAX_2, "words are in upper case: `X`");
    check("WIATX", &PERFORMAX_2, "did you mean `WAITX`?");
    check("V1=MTSX", &PERFORMAX_2, "did you mean `MSTX`?");
    check("EWHILE", &PERFORMAX_2, "did you mean `WHILE`?");
    check("WAIT", &PERFORMAX_2, "`WAIT` needs an axis, as `WAITX`");
    check("SR=1", &PERFORMAX_2, "`SR` needs a number, as `SR1`");
    check("CIR1:2", &COMMANDER, "`CIR` needs two axes and `P` or `N`, as `CIRXYP`");
    check("ARCT1:2:3:4", &COMMANDER, "`ARCT` needs `P` or `N`, as `ARCTP`");
    check("BUFON", &PERFORMAX_2, "the Commander core has it, the Performax 2ED has not");
    check("WAITZ", &PERFORMAX_2, "the Commander core has it, the Performax 2ED has not");
    check("TOC=5", &COMMANDER, "the Performax 2ED has it, the Commander core has not");
    check("X=5", &COMMANDER, "a move is `X1000`; the position is `PX=1000`");
    check("V1=-V2", &COMMANDER, "only numbers have a sign");
    check("ABS INC", &COMMANDER, "a line has one statement");
    check("V1=V2+V3+V4", &COMMANDER, "an assignment has one operator");
    check("GOSUB 7", &COMMANDER, "unless the device has one, this is an error when the program comes here");
}

#[test]
fn warnings_are_no_errors() {
    let compilation = compile("a.prg", b"PRG 0\nGOSUB 7\nEND\n", &PERFORMAX_2);
    assert!(!compilation.has_errors());
    assert_eq!(compilation.diagnostics[0].severity, Severity::Warning);
}

#[test]
fn rendered() {
    let compilation = compile("a.prg", b"PRG 0\n  DO10=1 ; no\nEND\n", &PERFORMAX_2);
    let expected = "\
error: BIT Error: the Performax 2ED has digital outputs 1 to 8
 --> a.prg:2:5
  |
2 |   DO10=1 ; no
  |     ^^
";
    assert_eq!(compilation.render(false), expected);
}

#[test]
fn bounds() {
    let nested = |depth: usize| {
        let (open, close) = ("WHILE 1=1\nIF 1=1\n".repeat(depth / 2), "ENDIF\nENDWHILE\n".repeat(depth / 2));
        kinds(&format!("PRG 0\n{open}{close}END\n"), &PERFORMAX_2)
    };
    const { assert!(MAX_NESTING >= 16) };
    assert_eq!(nested(MAX_NESTING), []);
    assert_eq!(nested(MAX_NESTING + 2).len(), 1);

    let long =
        |statements: usize| kinds(&format!("PRG 0\n{}END\n", "V1=1\n".repeat(statements)), &PERFORMAX_2);
    assert_eq!(long(1273), []);
    assert_eq!(long(1274), [(ErrorKind::Other, 1276, 1)]);
    assert_eq!(long(5000).len(), 1);
    // What does not fit leads nowhere.
    let blocks = "IF DI1=1\nELSEIF DI2=1\nELSE\nENDIF\nWHILE 1=1\nENDWHILE\n".repeat(500);
    assert_eq!(kinds(&format!("PRG 0\n{blocks}END\n"), &PERFORMAX_2).len(), 1);

    for wrong in ["ABX\n", "PRG 0\nENDIF\nEND\n"] {
        assert_eq!(kinds(&wrong.repeat(MAX_MESSAGES + 10), &PERFORMAX_2).len(), MAX_MESSAGES, "{wrong}");
    }
    // Warnings do not hide an error behind them.
    let warnings = "GOSUB 9\n".repeat(MAX_MESSAGES);
    assert!(compile("", format!("{warnings}ENDIF\nEND\n").as_bytes(), &PERFORMAX_2).has_errors());

    let huge = vec![b'\n'; MAX_SOURCE_BYTES + 1];
    assert!(compile("", &huge, &PERFORMAX_2).has_errors());
    assert!(!compile("", &huge[1..], &PERFORMAX_2).has_errors());
}
