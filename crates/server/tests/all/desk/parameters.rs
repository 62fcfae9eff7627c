//! Parameters: every one of them, written, stored, restored.

use super::Rig;
use serde_json::json;

/// The models, each with a parameter that is stored, its default, and one that is not.
const MODELS: [(&str, &str, i64, &str); 3] =
    [("pd42-1140", "AP5.0", 500, "AP7.0"), ("pmx-2ed", "LCAX", 0, "V5"), ("cmd-4cr", "SLEZ", 1000, "V5")];

#[test]
fn all_can_be_read_that_the_catalog_names() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, ..) in MODELS {
        let values = rig.get(&format!("{model}/parameters"));
        let values = values.as_object().unwrap();
        let (_, catalog) = crate::common::call(rig.address, "GET", &format!("/api/models/{model}"), "");
        let mut readable = 0;
        for parameter in catalog["parameters"].as_array().unwrap() {
            let (id, is_text) = (parameter["id"].as_str().unwrap(), parameter["is_text"] == true);
            if parameter["readable"] == false || ["AP207.0", "GP133"].contains(&id) {
                assert!(!values.contains_key(id), "{model} {id}");
                continue;
            }
            readable += 1;
            let value = values.get(id).unwrap_or_else(|| panic!("{model} has no value of {id}"));
            assert_eq!(value.is_string(), is_text, "{model} {id}: {value}");
            if parameter["stored"] == true && !is_text {
                assert_eq!(value.as_f64(), parameter["default"].as_f64(), "{model} {id}");
            }
        }
        assert_eq!(values.len(), readable, "{model}");
    }
    rig.server.stop().unwrap();
}

#[test]
fn what_is_stored_outlives_the_power() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, stored, default, lost) in MODELS {
        let path = |id: &str| format!("{model}/parameters/{id}");
        assert_eq!(rig.get(&path(stored)), default);
        let before = rig.get(&path(lost));
        rig.tell("PUT", &path(stored), "321");
        rig.tell("PUT", &path(lost), "123");
        assert_eq!((rig.get(&path(stored)), rig.get(&path(lost))), (json!(321), json!(123)), "{model}");
        rig.tell("POST", &path("store"), "");
        rig.tell("POST", &format!("{model}/power-cycle"), "");
        assert_eq!(rig.get(&path(stored)), 321, "{model}");
        if model == "pd42-1140" {
            assert_eq!(rig.get(&path(lost)), before, "{model}");
        }
        rig.tell("POST", &path("restore"), "");
        assert_eq!(rig.get(&path(stored)), default, "{model}");
    }
    rig.server.stop().unwrap();
}

#[test]
fn decimals_text_and_numbers_without_a_sign() {
    let rig = Rig::new(&["pd42-1140", "pmx-2ed"]);
    let check = |path: &str, body: &str| {
        rig.tell("PUT", path, body);
        assert_eq!(rig.get(path), serde_json::from_str::<serde_json::Value>(body).unwrap(), "{path}");
    };
    check("pmx-2ed/parameters/SLRX", "2.125");
    check("pmx-2ed/parameters/DN", "\"2ED07\"");
    check("pd42-1140/parameters/GP0.3", "4294967295.0");
    check("pd42-1140/parameters/GP3.2", "-5");
    rig.server.stop().unwrap();
}

#[test]
fn what_cannot_be() {
    let rig = Rig::new(&["pmx-2ed", "pd42-1140"]);
    let refused = |method: &str, path: &str, body: &str, status: u16, words: &str| {
        rig.refused(method, path, body, status, words);
    };
    refused("GET", "pmx-2ed/parameters/AP1.0", "", 404, "a pmx-2ed has no parameter `AP1.0`");
    refused("GET", "pmx-2ed/parameters/JO", "", 422, "`JO` cannot be read");
    refused("PUT", "pmx-2ed/parameters/AI1", "5", 422, "`AI1` cannot be set");
    refused("PUT", "pmx-2ed/parameters/HSPDX", "\"fast\"", 422, "`HSPDX` is a number");
    refused("PUT", "pmx-2ed/parameters/DN", "7", 422, "`DN` is text");
    refused("PUT", "pmx-2ed/parameters/DB", "9", 422, "`DB=9` is refused: ?Invalid Answer");
    let (status, answer) = rig.call("PUT", "pd42-1140/parameters/AP5.0", "5000");
    assert_eq!(status, 422, "{answer}");
    rig.server.stop().unwrap();
}

#[test]
fn a_new_address_is_followed() {
    let rig = Rig::new(&["pd42-1140", "pmx-2ed"]);
    // The reply has the new address already, which is not that of the question.
    rig.tell("PUT", "pd42-1140/parameters/GP66", "9");
    rig.tell("PUT", "pmx-2ed/parameters/DN", "\"2ED07\"");
    rig.tell("POST", "pmx-2ed/parameters/store", "");
    rig.tell("POST", "pmx-2ed/power-cycle", "");
    rig.get("pd42-1140/status");
    rig.get("pmx-2ed/status");
    assert_eq!(rig.get("pd42-1140/parameters/GP66"), 9);
    rig.server.stop().unwrap();
}
