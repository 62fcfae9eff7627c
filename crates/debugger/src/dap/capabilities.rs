//! What the adapter says that it can.

use serde_json::{Value, json};

/// The body of the answer to `initialize`.
pub fn capabilities() -> Value {
    json!({
        "supportsConfigurationDoneRequest": true,
        "supportsFunctionBreakpoints": true,
        "supportsConditionalBreakpoints": true,
        "supportsDataBreakpoints": true,
        "supportsEvaluateForHovers": true,
        "supportsStepBack": true,
        "supportsSetVariable": true,
        "supportsCompletionsRequest": true,
        "supportsTerminateRequest": true,
    })
}
