//! What the editor shows beside the source: scopes and what is in them.

use crate::{Debugger, stop::show};
use devices::{Language, inspect::Scope};
use serde_json::{Value, json};

/// What is on pins.
const PINS: usize = 5;

/// What the axes do; each of them is behind it.
const AXES: usize = 6;
const FIRST_AXIS: usize = 100;

/// The scopes of quantities with their numbers.
const SCOPES: [(usize, Scope, &str); 4] = [
    (1, Scope::Program, "Registers"),
    (2, Scope::Variables, "Variables"),
    (3, Scope::Axes, "Axis parameters"),
    (4, Scope::Device, "Device"),
];

/// The scopes that have something in them.
pub fn scopes(debugger: &mut Debugger) -> Value {
    let quantities = debugger.device().quantities();
    let quantities = SCOPES.iter().filter_map(|(number, scope, name)| {
        let some = quantities.iter().any(|quantity| quantity.scope == *scope);
        some.then_some((*number, *name, *scope == Scope::Device || *scope == Scope::Axes))
    });
    let others = [(AXES, "Axes", false), (PINS, "Pins", false)];
    let all = quantities.chain(others).map(|(number, name, expensive)| {
        json!({ "name": name, "variablesReference": number, "expensive": expensive })
    });
    json!({ "scopes": all.collect::<Vec<_>>() })
}

/// What a thing in a scope is called everywhere: what an axis shows is in registers of its device.
pub fn register(debugger: &mut Debugger, reference: usize, name: &str) -> Option<String> {
    let Some(axis) = reference.checked_sub(FIRST_AXIS) else { return Some(name.to_owned()) };
    let axis = *debugger.device().axes().get(axis)?;
    match (debugger.target().config.model.language, name) {
        (Language::Tmcl, "position") => Some("APActualPosition".into()),
        (Language::Tmcl, "encoder") => Some("APEncoderPosition".into()),
        (Language::Tmcl, "target") => Some("APTargetPosition".into()),
        (Language::Ascript(_), "position") => Some(format!("P{axis}")),
        (Language::Ascript(_), "encoder") => Some(format!("E{axis}")),
        _ => None,
    }
}

/// What is in a scope, or in an axis.
pub fn variables(debugger: &mut Debugger, reference: usize) -> Value {
    let device = debugger.device();
    let mut all = Vec::new();
    let entry = |name: &str, value: String, reference: usize| json!({ "name": name, "value": value, "variablesReference": reference, "evaluateName": name });
    if let Some((_, scope, _)) = SCOPES.iter().find(|(number, ..)| *number == reference) {
        for quantity in device.quantities().iter().filter(|quantity| quantity.scope == *scope) {
            if let Some(value) = device.value(&quantity.name) {
                all.push(entry(&quantity.name, show(value), 0));
            }
        }
    } else if reference == PINS {
        for pin in device.pins() {
            if let Ok(value) = device.read_pin(pin.name) {
                all.push(entry(pin.name, show(value), 0));
            }
        }
    } else if reference == AXES {
        for (number, name) in device.axes().iter().enumerate() {
            let position = device.axis(number).position;
            all.push(entry(name, format!("at {position}"), FIRST_AXIS + number));
        }
    } else if let Some(axis) = reference.checked_sub(FIRST_AXIS).filter(|axis| *axis < device.axes().len()) {
        let state = device.axis(axis);
        let speed = state.speed_mpps as f64 / 1000.0;
        for (name, value) in [
            ("position", state.position.to_string()),
            ("encoder", state.encoder.to_string()),
            ("target", state.target.to_string()),
            ("speed", speed.to_string()),
            ("status", state.status.to_string()),
            ("steps", state.steps.to_string()),
        ] {
            let mut shown = json!({ "name": name, "value": value, "variablesReference": 0 });
            if let Some(quantity) = register(debugger, reference, name) {
                shown["evaluateName"] = quantity.into();
            }
            all.push(shown);
        }
    }
    json!({ "variables": all })
}
