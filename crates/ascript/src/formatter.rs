//! Lays a program out anew.

use crate::compiler::{self, Diagnostic, compile, parse};
use crate::dialect::Dialect;
use crate::layout::{Row, lay_out};

/// The same program in the usual layout: blocks indented, no spaces but those between a word and what it is
/// about, comments behind statements below each other. Comments and blank lines stay, except for blank lines
/// at the end, and comments of their own that stand at the margin stay there. The compiled lines are the same. The
/// result is UTF-8, with line feeds.
///
/// # Errors
/// What the compiler has against the source, if it has errors.
pub fn format(name: &str, source: &[u8], dialect: &Dialect) -> Result<String, Vec<Diagnostic>> {
    let compilation = compile(name, source, dialect);
    if compilation.has_errors() {
        return Err(compilation.diagnostics);
    }
    let source = compiler::read(name, source)?;
    let (lines, _) = parse(&source, dialect);
    let rows = lines.iter().map(|line| Row {
        statement: line.statement,
        comment: line.comment.as_ref().map(|span| source.slice(span)),
        margin: line.comment.as_ref().is_some_and(|span| source.column(span.start) == 1),
    });
    let text = lay_out(rows);
    let trimmed = text.trim_end_matches('\n');
    Ok(if trimmed.is_empty() { String::new() } else { format!("{trimmed}\n") })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::PERFORMAX_2;

    #[test]
    fn layout() {
        let check = |source: &str, expected: &str| {
            let formatted = format("test", source.as_bytes(), &PERFORMAX_2);
            assert_eq!(formatted.as_deref(), Ok(expected), "{source}");
        };
        check("", "");
        check("\n \n", "");
        check("; only this", "; only this\n");
        check("\u{FEFF}V01 = 007\r\n\r\nEND\n\n\n", "V1=7\n\nEND\n");
        check(
            "PRG0 ; first  \n;margin\n  ; inside\nWHILE  DI 1 = 1;wait\nX 100 Y V 2\nENDWHILE\nEND\n",
            "PRG 0                       ; first
;margin
  ; inside
  WHILE DI1=1               ;wait
    X100YV2
  ENDWHILE
END
",
        );
        // A long statement pushes its comment away.
        check(
            "IF MSTX&1234567890>=-2147483648;x\nELSEIF 1=V1-2\nELSE\nENDIF\nEND",
            "IF MSTX&1234567890>=-2147483648  ;x\nELSEIF 1=V1-2\nELSE\nENDIF\nEND\n",
        );
    }

    #[test]
    fn errors_are_told() {
        let errors = format("test", b"V1==1\nEND", &PERFORMAX_2).expect_err("wrong");
        assert_eq!((errors.len(), errors[0].place.line), (1, 1));
    }
}
