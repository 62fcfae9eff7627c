//! The messages of the protocol, as far as they are used.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::PathBuf;

/// What an editor asks.
#[derive(Clone, Debug, Deserialize)]
pub struct Request {
    /// Its number.
    pub seq: i64,
    /// What it is.
    pub command: String,
    /// What it is about.
    #[serde(default)]
    pub arguments: Value,
}

/// An answer.
#[derive(Debug, Serialize)]
pub struct Response<'a> {
    pub seq: i64,
    #[serde(rename = "type")]
    pub kind: &'static str,
    pub request_seq: i64,
    pub success: bool,
    pub command: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    #[serde(skip_serializing_if = "Value::is_null")]
    pub body: Value,
}

/// What the editor is told without having asked.
#[derive(Debug, Serialize)]
pub struct Event<'a> {
    pub seq: i64,
    #[serde(rename = "type")]
    pub kind: &'static str,
    pub event: &'a str,
    #[serde(skip_serializing_if = "Value::is_null")]
    pub body: Value,
}

/// What a launch configuration says; `editors/vscode/package.json` has the same.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(serde::Serialize))]
#[serde(rename_all = "camelCase")]
pub struct Launch {
    /// The program: a source or machine code.
    pub program: PathBuf,
    /// The model of the controller.
    pub device: String,
    /// A bench file; its first device of the model tells the machine.
    pub bench: Option<PathBuf>,
    /// Seconds of device time that it runs at most.
    #[serde(rename = "for")]
    pub seconds: Option<f64>,
    /// Inputs that change on the way: `TIME:PIN=VALUE`.
    #[serde(default)]
    pub at: Vec<String>,
    /// A scenario: faults of the machine, and when they begin.
    pub scenario: Option<PathBuf>,
    /// Whether to stop before the first line.
    #[serde(default)]
    pub stop_on_entry: bool,
}

/// A source of the editor.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct SourceName {
    pub name: Option<String>,
    pub path: Option<String>,
}

/// A breakpoint that the editor wants.
#[derive(Clone, Debug, Deserialize)]
pub struct Wanted {
    /// The line, of one in a source.
    #[serde(default)]
    pub line: usize,
    /// The name, of one at a label.
    #[serde(default)]
    pub name: String,
    /// What it looks at, of one that watches a value.
    #[serde(default, rename = "dataId")]
    pub data_id: String,
    pub condition: Option<String>,
}

/// Of `setBreakpoints` and its relatives: all that are wanted from now on.
#[derive(Clone, Debug, Deserialize)]
pub struct Breakpoints {
    #[serde(default)]
    pub source: SourceName,
    #[serde(default)]
    pub breakpoints: Vec<Wanted>,
}

/// What is about a thread.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OfThread {
    #[serde(default = "first_thread")]
    pub thread_id: usize,
}

const fn first_thread() -> usize {
    1
}

/// What is about variables.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OfVariables {
    #[serde(default)]
    pub variables_reference: usize,
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub value: String,
}

/// Of `source`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OfSource {
    pub source_reference: usize,
}

/// Of `evaluate`, and of `completions`, where it is `text`.
#[derive(Clone, Debug, Deserialize)]
pub struct Expression {
    #[serde(alias = "text")]
    pub expression: String,
    pub context: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Map, Value};

    #[test]
    fn the_extension_of_vs_code_offers_what_a_launch_takes() {
        let package = include_str!("../../../../editors/vscode/package.json");
        let contributes = &serde_json::from_str::<Value>(package).unwrap()["contributes"];
        let launch = &contributes["debuggers"][0]["configurationAttributes"]["launch"];

        let least: Launch = serde_json::from_str(r#"{ "program": "", "device": "" }"#).unwrap();
        let all: Map<String, Value> = serde_json::from_value(serde_json::to_value(least).unwrap()).unwrap();
        let offered = launch["properties"].as_object().unwrap();
        assert!(offered.keys().eq(all.keys()), "{:?}, {:?}", offered.keys(), all.keys());
        for key in all.keys() {
            let mut without = all.clone();
            without.remove(key);
            let is_needed = serde_json::from_value::<Launch>(without.into()).is_err();
            assert_eq!(
                launch["required"].as_array().unwrap().contains(&Value::from(&**key)),
                is_needed,
                "{key}"
            );
        }

        let mut models: Vec<_> = devices::MODELS.iter().map(|model| model.name).collect();
        assert_eq!(offered["device"]["enum"], Value::from(models.clone()));
        models.insert(0, "");
        let setting = &contributes["configuration"]["properties"]["pulsetrain.model"];
        assert_eq!(setting["enum"], Value::from(models));
    }
}
