use super::*;
use crate::dialect::COMMANDER;

fn compiled(source: &str, dialect: &Dialect) -> Vec<String> {
    let compilation = compile("test.prg", source.as_bytes(), dialect);
    let Some(code) = compilation.code else { panic!("{}", compilation.render(false)) };
    assert_eq!(code.map.len(), code.lines.len());
    for line in &code.lines {
        assert_eq!(Line::parse(&line.to_string(), dialect), Some(*line), "{line}");
    }
    code.lines.iter().map(ToString::to_string).collect()
}

#[test]
fn lines_of_statements() {
    let check = |source: &str, expected: &[&str]| {
        let program = format!("PRG 0\n{source}\nEND\n");
        let lines = compiled(&program, &COMMANDER);
        assert_eq!(lines[1..lines.len() - 1], *expected, "{source}");
    };
    check("V1=5", &["V1 = 5"]);
    check("V1=IO & 3", &["T0 = IO", "V1 = T0 & 3"]);
    check("X1000Y-2000", &["T0 = 1000", "X T0 Y -2000"]);
    check("CIRXYP100:V1", &["CIRXYP 100 V1"]);
    check("IF DI1=1\nENDIF", &["T0 = DI1", "IF T0 = 1 -> 3", "ENDIF"]);
}
