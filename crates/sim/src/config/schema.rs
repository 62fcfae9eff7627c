//! The bench file as JSON Schema, for editors that complete and check TOML by it.

use super::{
    MAX_POINTS, MAX_PULSES,
    keys::{BENCH, Form, Key},
};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft 2020-12) of a bench file.
pub fn schema() -> Value {
    let mut schema = table(BENCH);
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    schema["title"] = "Bench file of pulsetrain".into();
    schema
}

/// A table with these keys and no others.
fn table(keys: &[Key]) -> Value {
    let properties: Map<_, _> = keys.iter().map(|key| (key.name.into(), described(key))).collect();
    let needed: Vec<_> = keys.iter().filter(|key| key.is_needed).map(|key| key.name).collect();
    json!({
        "type": "object",
        "additionalProperties": false,
        "required": needed,
        "properties": properties,
    })
}

fn described(key: &Key) -> Value {
    let mut schema = form(key.form);
    let unit = if key.unit.is_empty() { String::new() } else { format!(" Unit: {}.", key.unit) };
    schema["description"] = format!("{}{unit}", key.about).into();
    schema
}

fn form(form: Form) -> Value {
    match form {
        Form::Model => {
            let models: Vec<_> = devices::MODELS.iter().map(|model| model.name).collect();
            json!({ "enum": models })
        }
        Form::Name => json!({ "type": "string", "pattern": "^[A-Za-z0-9_{-][A-Za-z0-9._{+}-]{0,63}$" }),
        Form::Text => json!({ "type": "string" }),
        Form::Switch => json!({ "type": "boolean" }),
        Form::Whole([least, most]) => json!({ "type": "integer", "minimum": least, "maximum": most }),
        Form::Number([least, most]) => json!({ "type": "number", "minimum": least, "maximum": most }),
        Form::Ratio([least, most]) => json!({ "anyOf": [
            { "type": "number", "minimum": least, "maximum": most },
            { "type": "number", "minimum": -most, "maximum": -least },
        ] }),
        Form::Position => self::form(Form::Whole([-MAX_PULSES, MAX_PULSES])),
        Form::Zone => array(self::form(Form::Position), 2, 2),
        Form::Zones => {
            let zone = self::form(Form::Zone);
            json!({ "anyOf": [zone, array(zone.clone(), 2, 2)] })
        }
        Form::Curve([speed, part]) => {
            let point = [speed, part].map(|most| self::form(Form::Number([0.0, most])));
            let point = json!({ "type": "array", "prefixItems": point, "minItems": 2, "maxItems": 2 });
            array(point, 1, MAX_POINTS)
        }
        Form::Word(words) => json!({ "enum": words }),
        Form::Words(words) => json!({ "type": "array", "items": { "enum": words }, "uniqueItems": true }),
        Form::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        Form::Tables(most, keys) => array(table(keys), 0, most),
        Form::ByAxis(keys) => json!({ "type": "object", "additionalProperties": table(keys) }),
    }
}

fn array(items: Value, least: usize, most: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": least, "maxItems": most })
}
