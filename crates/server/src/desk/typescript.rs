//! The types that cross HTTP, as TypeScript for the page: written from those here, and from nowhere else.

use super::{
    catalog::Catalog,
    control::TypedLine,
    devices::{NewDevices, WhereToLook},
    live::{Live, LiveRequest},
    machine::{Machine, MovedSwitches},
    models::{FaultKind, ModelInfo},
    program::{Compiled, SourceText},
    seat::Summary,
};
use crate::{
    breaks::Go,
    http::{Lease, LeaseGrant, LeaseRequest, Problem},
};
use host::{Action, Answer, Found, ProgramAction, Value};
use std::collections::BTreeMap;
use ts_rs::{Config, TS, TypeVisitor};

/// The types of the HTTP interface, and all that they consist of, as a TypeScript module.
pub fn typescript() -> String {
    // A script's numbers are exact up to 2⁵³, and nothing here is larger.
    let config = Config::new().with_large_int("number");
    let mut all = Declarations { config: &config, texts: BTreeMap::new() };
    all.visit::<Summary>();
    all.visit::<NewDevices>();
    all.visit::<WhereToLook>();
    all.visit::<Found>();
    all.visit::<ModelInfo>();
    all.visit::<Catalog>();
    all.visit::<FaultKind>();
    all.visit::<Live>();
    all.visit::<LiveRequest>();
    all.visit::<Machine>();
    all.visit::<MovedSwitches>();
    all.visit::<Action>();
    all.visit::<TypedLine>();
    all.visit::<Answer>();
    all.visit::<Value>();
    all.visit::<SourceText>();
    all.visit::<Compiled>();
    all.visit::<ProgramAction>();
    all.visit::<Go>();
    all.visit::<Lease>();
    all.visit::<LeaseRequest>();
    all.visit::<LeaseGrant>();
    all.visit::<Problem>();
    let head = "// The types that cross HTTP. Written by `cargo xtask docs` from those of the server.\n";
    let text = all.texts.into_values().fold(head.to_owned(), |text, declaration| text + "\n" + &declaration);
    text.lines().flat_map(|line| [line.trim_end(), "\n"]).collect()
}

/// The declarations of types by their names.
struct Declarations<'a> {
    config: &'a Config,
    texts: BTreeMap<String, String>,
}

impl TypeVisitor for Declarations<'_> {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        // What has no file of its own in the library's eyes is built into the language.
        if T::output_path().is_none() || self.texts.contains_key(&T::ident(self.config)) {
            return;
        }
        let declaration = format!("{}export {}\n", T::docs().unwrap_or_default(), T::decl(self.config));
        self.texts.insert(T::ident(self.config), declaration);
        T::visit_dependencies(self);
        T::visit_generics(self);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_names_are_declared_once() {
        let text = typescript();
        for name in ["Summary", "LinkState", "ParameterInfo", "AxisStatus", "Traffic", "DebugState", "Held"] {
            assert_eq!(text.matches(&format!("\nexport type {name} = ")).count(), 1, "{name}");
        }
        assert!(!text.contains("bigint") && !text.contains("import "));
    }
}
