//! What clients of TCP, pseudo-terminals, CAN adapters and buses see.

use crate::common::{Serial, check, connect, device, directory, eventually, free_address, serve};
use rustix::termios::{LocalModes, OptionalActions, OutputModes};
use std::{
    fs,
    io::{Read, Write},
    net::Shutdown,
    os::unix::fs::symlink,
    time::{Duration, Instant},
};

#[test]
fn clients_get_the_replies_to_their_own_bytes() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let (name, endpoint) = &server.ready()[0];
    assert_eq!(name, "a");
    assert!(endpoint.starts_with("tcp:127.0.0.1:") && !endpoint.ends_with(":0"), "{endpoint}");
    let clients: Vec<_> = (0..10).map(|_| connect(endpoint)).collect();
    for round in 0..20_u8 {
        for (number, mut client) in (0..).zip(&clients) {
            client.write_all(&[128 + number, 160 + round]).unwrap();
        }
        for (number, client) in (0..).zip(&clients) {
            check(client, b"", &[128 + number, 160 + round]);
        }
    }
    server.stop().unwrap();
}

#[test]
fn what_a_device_says_by_itself_goes_to_the_client_that_spoke_last() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let (first, second) = (connect(&server.ready()[0].1), connect(&server.ready()[0].1));
    check(&first, b"!a", b"a?");
    check(&first, b"!a", b"a");
    check(&second, b"b", b"b?");
    // Nobody is there any more.
    check(&second, b"!b", b"b");
    drop(second);
    check(&first, b"a", b"a");
    server.stop().unwrap();
}

#[test]
fn the_pause_before_a_reply_is_kept() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let start = Instant::now();
    check(connect(&server.ready()[0].1), b"p", b"p");
    assert!(start.elapsed() >= Duration::from_millis(200));
    server.stop().unwrap();
}

#[test]
fn all_devices_of_a_bus_hear_and_answer() {
    let bus = format!("tcp:{}", free_address());
    let server = serve(vec![device("a", &[&bus]), device("b", &[&bus, "tcp:127.0.0.1:0"])]);
    let ready = server.ready();
    assert_eq!(ready.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["a", "b", "b"]);
    check(connect(&bus), b"x", b"xx");
    check(connect(&ready[2].1), b"yz", b"yz");
    server.stop().unwrap();
}

#[test]
fn can_frames_go_through_an_adapter() {
    let server = serve(vec![device("a", &["slcan-tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    assert!(endpoint.starts_with("slcan-tcp:127.0.0.1:"), "{endpoint}");
    let client = connect(&endpoint["slcan-".len()..]);
    check(&client, b"S8\rO\rt1232AABB\r", b"\r\rz\rt1232AABB\r");
    // A line in two pieces, a wrong one, and a second client with an adapter of its own.
    (&client).write_all(b"t12").unwrap();
    check(connect(&endpoint["slcan-".len()..]), b"t1230\r", b"\x07");
    check(&client, b"30\rhello\r", b"z\rt1230\r\x07");
    server.stop().unwrap();
}

#[test]
fn too_many_clients_are_turned_away_until_one_leaves() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    let mut clients: Vec<_> = (0..64).map(|_| connect(endpoint)).collect();
    clients.iter().for_each(|client| check(client, b"a", b"a"));
    assert_eq!(connect(endpoint).read(&mut [0]).unwrap(), 0, "the 65th is closed");
    drop(clients.pop());
    eventually("room for one more", || {
        let mut client = connect(endpoint);
        client.write_all(b"b").is_ok() && matches!(client.read(&mut [0]), Ok(1))
    });
    server.stop().unwrap();
}

#[test]
fn stopping_ends_connections() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let endpoint = server.ready()[0].1.clone();
    let mut client = connect(&endpoint);
    check(&client, b"a", b"a");
    let start = Instant::now();
    server.stop().unwrap();
    assert!(start.elapsed() < Duration::from_secs(2));
    assert_eq!(client.read(&mut [0]).unwrap(), 0);
    assert!(std::net::TcpStream::connect(endpoint.split_once(':').unwrap().1).is_err());
}

#[test]
fn a_client_that_half_closes_still_gets_its_reply() {
    let server = serve(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let mut client = connect(&server.ready()[0].1);
    client.write_all(b"abc").unwrap();
    client.shutdown(Shutdown::Write).unwrap();
    let mut all = Vec::new();
    client.read_to_end(&mut all).unwrap();
    assert_eq!(all, b"abc");
    server.stop().unwrap();
}

#[test]
fn a_terminal_is_raw_and_can_be_opened_again_and_again() {
    let link = directory().join("port");
    let server = serve(vec![device("a", &[&format!("pty:{}", link.display())])]);
    assert_eq!(server.ready()[0].1, format!("pty:{}", link.display()));
    let all: Vec<u8> = (0..=255).filter(|byte| !b"!.pwr".contains(byte)).collect();
    for round in 0..6 {
        let serial = Serial::open(&link).unwrap();
        check(&serial, &all, &all);
        if round % 2 == 0 {
            // Closed and opened again too fast for anybody to notice.
            continue;
        }
        // Replies that nobody reads are not there for the next client.
        (&serial).write_all(b"stale").unwrap();
        drop(serial);
        std::thread::sleep(Duration::from_millis(200));
    }
    server.stop().unwrap();
    assert!(fs::symlink_metadata(&link).is_err(), "the link is removed");
}

#[test]
fn a_terminal_forgets_settings_and_unread_replies_of_the_last_client() {
    let link = directory().join("port");
    let server = serve(vec![device("a", &[&format!("pty:{}", link.display())])]);
    let serial = Serial::open(&link).unwrap();
    check(&serial, b"a", b"a");
    let mut settings = rustix::termios::tcgetattr(&serial.0).unwrap();
    settings.local_modes |= LocalModes::ICANON | LocalModes::ECHO;
    settings.output_modes |= OutputModes::OPOST | OutputModes::ONLCR;
    rustix::termios::tcsetattr(&serial.0, OptionalActions::Now, &settings).unwrap();
    rustix::termios::ioctl_tiocexcl(&serial.0).unwrap();
    (&serial).write_all(b"stale").unwrap();
    drop(serial);
    // Whoever is not the superuser gets a new terminal here, because the old one stays locked.
    eventually("the terminal is as new", || {
        std::thread::sleep(Duration::from_millis(50));
        let Ok(serial) = Serial::open(&link) else { return false };
        !rustix::termios::tcgetattr(&serial.0).unwrap().local_modes.contains(LocalModes::ICANON)
    });
    check(&Serial::open(&link).unwrap(), b"\nb\n", b"\nb\n");
    server.stop().unwrap();
}

#[test]
fn an_idle_terminal_costs_nothing() {
    let link = directory().join("port");
    let server = serve(vec![device("a", &[&format!("pty:{}", link.display())])]);
    check(&Serial::open(&link).unwrap(), b"a", b"a");
    let before = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    std::thread::sleep(Duration::from_millis(500));
    let after = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    let nanos = (after.tv_sec - before.tv_sec) * 1_000_000_000 + (after.tv_nsec - before.tv_nsec);
    // Other tests run in the same process under `cargo test`, so this only catches a loop without a wait.
    assert!(nanos < 450_000_000, "{nanos} ns of processor time in half a second");
    server.stop().unwrap();
}

#[test]
fn links_are_replaced_only_if_they_are_dead() {
    let directory = directory();
    let attempt = |name: &str| {
        let settings =
            crate::common::settings(vec![device("a", &[&format!("pty:{}/{name}", directory.display())])]);
        server::Server::start(settings).map_err(|error| error.to_string())
    };
    symlink("/nowhere/at/all", directory.join("dangling")).unwrap();
    attempt("dangling").unwrap().stop().unwrap();
    fs::write(directory.join("file"), "precious").unwrap();
    symlink(directory.join("file"), directory.join("alive")).unwrap();
    for name in ["file", "alive"] {
        let error = attempt(name).err().expect("refused");
        assert_eq!(
            error,
            format!(
                "pty:{}/{name}: exists and is not a link left over from an earlier run",
                directory.display()
            )
        );
    }
    assert_eq!(fs::read_to_string(directory.join("alive")).unwrap(), "precious");
    assert!(attempt("missing/port").is_err());
}

#[test]
fn an_address_in_use_is_an_error() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let _listener = std::net::TcpListener::bind(taken).unwrap();
    let endpoint = format!("tcp:{taken}");
    let error = server::Server::start(crate::common::settings(vec![device("a", &[&endpoint])]))
        .err()
        .expect("refused");
    assert!(error.to_string().starts_with(&format!("{endpoint}: ")), "{error}");
}
