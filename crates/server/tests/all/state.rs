//! Flash images on disk.

use crate::common::{check, connect, device, directory, eventually, settings};
use server::{Server, Settings};
use std::{fs, path::Path};

fn start(state: &Path) -> Result<Server, String> {
    let devices = vec![device("bird", &["tcp:127.0.0.1:0"])];
    let settings = Settings { state: Some(state.to_owned()), ..settings(devices) };
    Server::start(settings).map_err(|error| error.to_string())
}

#[test]
fn flash_survives_a_restart() {
    let state = directory().join("made/on/demand");
    let server = start(&state).unwrap();
    check(connect(&server.ready()[0].1), b"r", b"\xFF");
    check(connect(&server.ready()[0].1), b"wxa", b"a");
    server.stop().unwrap();
    let server = start(&state).unwrap();
    check(connect(&server.ready()[0].1), b"r", b"x");
    server.stop().unwrap();
}

#[test]
fn changes_are_saved_soon() {
    let state = directory();
    let server = start(&state).unwrap();
    check(connect(&server.ready()[0].1), b"wya", b"a");
    let image = state.join("bird.flash");
    eventually("the image is on disk", || fs::read(&image).is_ok_and(|bytes| bytes[0] == b'y'));
    server.stop().unwrap();
}

#[test]
fn one_process_at_a_time() {
    let state = directory();
    let server = start(&state).unwrap();
    let error = start(&state).err().expect("refused");
    assert_eq!(error, format!("{}: another process keeps its state here", state.display()));
    server.stop().unwrap();
    start(&state).unwrap().stop().unwrap();
}

#[test]
fn a_wrong_image_is_refused_and_kept() {
    let state = directory();
    fs::write(state.join("bird.flash"), "short").unwrap();
    let error = start(&state).err().expect("refused");
    assert!(error.contains("bird.flash") && error.contains("5 bytes"), "{error}");
    assert_eq!(fs::read(state.join("bird.flash")).unwrap(), b"short");
}
