//! The document and the routes say the same.

use crate::common::{call, device, serve_http};
use serde_json::Value;
use std::{fs, path::Path};

const METHODS: [&str; 5] = ["get", "put", "post", "patch", "delete"];

/// The operations of the document: path, method, operation.
fn operations(document: &Value) -> Vec<(&str, &str, &Value)> {
    let paths = document["paths"].as_object().unwrap().iter();
    let all = paths.flat_map(|(path, item)| {
        let item = item.as_object().unwrap().iter();
        item.map(|(method, operation)| (path.as_str(), method.as_str(), operation))
    });
    all.collect()
}

#[test]
fn a_path_has_the_methods_that_the_document_says_and_no_others() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let (status, document) = call(address, "GET", "/api/openapi.json", "");
    assert_eq!(status, 200);
    assert!(document["openapi"].as_str().unwrap().starts_with("3."));
    for (path, item) in document["paths"].as_object().unwrap() {
        for method in METHODS {
            let (status, answer) = call(address, &method.to_uppercase(), path, "");
            let is_known = item.get(method).is_some();
            assert_eq!(status == 405, !is_known, "{method} {path}: {status}");
            assert_ne!(answer["error"], "there is nothing here", "{method} {path}");
        }
    }
    server.stop().unwrap();
}

#[test]
fn every_operation_is_described() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let (_, document) = call(address, "GET", "/api/openapi.json", "");
    let mut names = Vec::new();
    for (path, method, operation) in operations(&document) {
        let place = format!("{method} {path}");
        assert!(METHODS.contains(&method), "{place}");
        assert!(operation["summary"].is_string(), "{place} has no summary");
        assert!(operation["tags"][0].is_string(), "{place} has no tag");
        names.push((operation["operationId"].as_str().unwrap().to_owned(), place.clone()));
        let responses = operation["responses"].as_object().unwrap();
        assert!(responses.contains_key("default") && responses.len() > 1, "{place}");
        for (status, response) in responses {
            assert_ne!(response["description"], "", "{place} {status}");
        }
        let declared: Vec<_> = operation["parameters"].as_array().into_iter().flatten().collect();
        for name in path.split(['{', '}']).skip(1).step_by(2) {
            let here = declared.iter().filter(|one| one["name"] == name && one["in"] == "path");
            assert_eq!(here.count(), 1, "{place}: {name}");
        }
    }
    names.sort();
    for pair in names.windows(2) {
        assert_ne!(pair[0].0, pair[1].0, "{} and {} have the same id", pair[0].1, pair[1].1);
    }
    server.stop().unwrap();
}

#[test]
fn what_the_document_refers_to_is_in_it() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let (_, document) = call(address, "GET", "/api/openapi.json", "");
    let text = document.to_string();
    for reference in text.split("\"$ref\":\"#").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(document.pointer(reference).is_some(), "{reference}");
    }
    server.stop().unwrap();
}

/// The router is made of what has a description; a route that is added in another way would have none.
#[test]
fn no_route_goes_around_the_document() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            if entry.file_type().unwrap().is_dir() {
                folders.push(entry.path());
                continue;
            }
            let text = fs::read_to_string(entry.path()).unwrap();
            assert!(!text.contains(".route(") && !text.contains(".nest("), "{}", entry.path().display());
        }
    }
}
