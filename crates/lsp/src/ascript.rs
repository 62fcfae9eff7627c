//! A-SCRIPT.

use crate::program::{Finding, Program, span_of, with_hint};
use ::ascript::{
    Dialect,
    compiler::{Compilation, Severity, compile},
};
use devices::{Language, MODELS};
use source::Source;

/// The compiler takes off one byte order mark. This one is for it, so that places are those of the text.
const MARK: &str = "\u{FEFF}";

/// An A-SCRIPT program.
pub(crate) struct Ascript {
    source: Source,
    compilation: Compilation,
}

/// Reads a program. Where nobody said which controller it is for, it is the first one for which it is right.
pub(crate) fn read(source: &Source, dialect: Option<&'static Dialect>) -> Ascript {
    let marked = [MARK, &source.text].concat();
    let compiled = |dialect| compile(&source.name, marked.as_bytes(), dialect);
    let dialects = || {
        MODELS.iter().filter_map(|model| match model.language {
            Language::Ascript(dialect) => Some(dialect),
            Language::Tmcl => None,
        })
    };
    let (dialect, compilation) = match dialect {
        Some(dialect) => (dialect, compiled(dialect)),
        None => {
            let mut all = dialects().map(|dialect| (dialect, compiled(dialect)));
            let first = all.next().expect("there are controllers with A-SCRIPT");
            if first.1.has_errors() {
                all.find(|(_, compilation)| !compilation.has_errors()).unwrap_or(first)
            } else {
                first
            }
        }
    };
    let _ = dialect;
    Ascript { source: source.clone(), compilation }
}

impl Program for Ascript {
    fn findings(&self) -> Vec<Finding> {
        let finding = |diagnostic: &::ascript::compiler::Diagnostic| Finding {
            span: span_of(&self.source, &diagnostic.place),
            is_error: diagnostic.severity != Severity::Warning,
            code: diagnostic.kind().map(|kind| kind.to_string()),
            message: with_hint(&diagnostic.message, diagnostic.hint.as_deref()),
        };
        self.compilation.diagnostics.iter().map(finding).collect()
    }
}
