//! The lines of a PMX-2ED-SA on every endpoint, buses, and its state over HTTP.

use crate::common::{
    Serial, call, check, commander, connect, directory, eventually, free_address, performax, serve,
    serve_http,
};
use serde_json::{Value, json};
use std::{
    io::{Read, Write},
    net::SocketAddr,
};

/// What is the same on all endpoints that are a device's own.
fn speaks_both_forms(mut port: impl Read + Write) {
    for (sent, expected) in [
        (&b"ID\r"[..], &b"PERFORMAX-2ED-SA\r"[..]),
        (b"@00ID\r", b"PERFORMAX-2ED-SA\r"),
        (b"DN\n", b"2ED00\r"),
        (b"\r\n\n@00DN\r\n", b"2ED00\r"),
        // A packet of USB as it is.
        (b"MM\0\0\0\0\0\0", b"0\r"),
        // Another device is meant: not a sound.
        (b"@01ID\r@00MM\r", b"0\r"),
        (b"@00V1=5\rV1\r@00V2\r", b"OK\r5\r0\r"),
        (b"mm\r", b"?mm\r"),
        (b"V1=6\xFF\rV1\r", b"?\r5\r"),
    ] {
        check(&mut port, sent, expected);
    }
    let too_long = [b"V1=".as_slice(), &[b'7'; 100], b"\rV1\r"].concat();
    check(&mut port, &too_long, b"?\r5\r");
}

#[test]
fn both_forms_of_a_line_are_understood() {
    let link = directory().join("port");
    let pty = format!("pty:{}", link.display());
    let server = serve(vec![performax("a", &["tcp:127.0.0.1:0"]), performax("b", &[&pty])]);
    speaks_both_forms(connect(&server.ready()[0].1));
    speaks_both_forms(&Serial::open(&link).unwrap());
    server.stop().unwrap();
}

#[test]
fn a_client_that_leaves_leaves_no_half_line() {
    let server = serve(vec![performax("a", &["tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    for beginning in [&b"V1=5"[..], b"\xFF\xFE", &[b'x'; 80]] {
        let mut client = connect(endpoint);
        check(&client, b"MM\r", b"0\r");
        client.write_all(beginning).unwrap();
        // It is gone when the other side closes too.
        client.shutdown(std::net::Shutdown::Write).unwrap();
        assert_eq!(client.read(&mut [0; 10]).unwrap(), 0);
        check(connect(endpoint), b"V1\r", b"0\r");
    }
    // One that is only quiet keeps its half, and another client's leaving does not matter.
    let (quiet, other) = (connect(endpoint), connect(endpoint));
    check(&other, b"MM\r", b"0\r");
    (&quiet).write_all(b"V1").unwrap();
    check(&quiet, b"\r", b"0\r");
    server.stop().unwrap();
}

/// Where a device goes along each axis.
fn targets(address: SocketAddr, name: &str) -> [Value; 2] {
    let axes = call(address, "GET", &format!("/api/devices/{name}"), "").1["axes"].take();
    ["X", "Y"].map(|axis| axes[axis]["target"].clone())
}

#[test]
fn devices_of_a_bus_have_addresses() {
    let (bus, link) = (format!("tcp:{}", free_address()), directory().join("bus"));
    let pty = format!("pty:{}", link.display());
    let names = ["a", "b", "c"];
    let (server, address) =
        serve_http(names.iter().map(|name| performax(name, &["tcp:127.0.0.1:0", &bus, &pty])).collect());
    let own = |name: &str| {
        let ready = server.ready().iter().find(|(known, _)| known == name);
        connect(&ready.unwrap().1)
    };
    check(own("b"), b"DN=2ED07\rSTORE\r", b"OK\rOK\r");
    check(own("c"), b"DN=2ED99\rSTORE\r", b"OK\rOK\r");
    // Names take effect with the power: until then all three answer to 00.
    check(connect(&bus), b"@00MM\r", b"0\r0\r0\r");
    for name in names {
        assert_eq!(call(address, "POST", &format!("/api/devices/{name}/power-cycle"), "").0, 204);
    }
    for (round, terminal) in [(1, false), (2, true)] {
        let station = |sent: &[u8], expected: &[u8]| {
            if terminal {
                check(&Serial::open(&link).unwrap(), sent, expected);
            } else {
                check(connect(&bus), sent, expected);
            }
        };
        station(b"@00DN\r@07DN\r@99DN\r", b"2ED00\r2ED07\r2ED99\r");
        // Nobody is meant by these.
        station(b"MM\r@01MM\r@7MM\r@00MM\r", b"0\r");
        station(b"@00V9=1\r@99V9=3\r@07V9=2\r", b"OK\rOK\rOK\r");
        station(b"@99V9\r@00V9\r@07V9\r", b"3\r1\r2\r");
        station(format!("@07X{round}00\r").as_bytes(), b"OK\r");
        eventually("the axis arrives", || targets(address, "b") == [json!(round * 100), json!(0)]);
        assert_eq!(
            [targets(address, "a"), targets(address, "c")],
            [[json!(0), json!(0)], [json!(0), json!(0)]]
        );
        check(own("b"), b"ABORT\r@07MM\r@00MM\rV9\r", b"OK\r0\r2\r");
    }
    server.stop().unwrap();
}

/// Both families on one bus: two Commanders, whose number from the factory is 01, and a Performax, which is 00.
#[test]
fn families_share_a_bus() {
    let bus = format!("tcp:{}", free_address());
    let endpoints = ["tcp:127.0.0.1:0", &bus];
    let devices = vec![commander("a", &endpoints), commander("b", &endpoints), performax("p", &endpoints)];
    let (server, address) = serve_http(devices);
    let own = |name: &str| {
        let ready = server.ready().iter().find(|(known, _)| known == name);
        connect(&ready.unwrap().1)
    };
    check(own("b"), b"ID=42\rSTORE\r", b"OK\rOK\r");
    // Numbers take effect with the power: until then both answer to 01.
    check(connect(&bus), b"@01V1\r", b"0\r0\r");
    assert_eq!(call(address, "POST", "/api/devices/b/power-cycle", "").0, 204);
    check(connect(&bus), b"@01ID\r@42ID\r@00ID\r", b"01\r42\rPERFORMAX-2ED-SA\r");
    check(connect(&bus), b"ID\r@02ID\r@42U500\r", b"OK\r");
    let at = |name: &str, axis: &str| {
        let state = call(address, "GET", &format!("/api/devices/{name}"), "").1;
        state["axes"][axis]["position"].clone()
    };
    eventually("the axis arrives", || at("b", "U") == json!(500));
    assert_eq!(at("a", "U"), json!(0));
    server.stop().unwrap();
}

#[test]
fn pins_axes_and_programs_over_http() {
    let (server, address) = serve_http(vec![performax("stage", &["tcp:127.0.0.1:0"])]);
    let client = connect(&server.ready()[0].1);
    let pin = |method: &str, pin: &str, body: &str| {
        call(address, method, &format!("/api/devices/stage/pins/{pin}"), body)
    };
    let state = || call(address, "GET", "/api/devices/stage", "").1;
    // A plus sign in a path is a plus sign, written as it is or escaped.
    for name in ["+LX", "%2BLX"] {
        assert_eq!(pin("GET", name, ""), (200, json!(false)));
        assert_eq!(pin("PUT", name, "true").0, 204);
        assert_eq!(pin("GET", name, ""), (200, json!(true)));
        assert_eq!(state()["axes"]["X"]["status"].as_u64().unwrap() & 0x30, 0x10, "the plus limit is on");
        assert_eq!(pin("DELETE", name, "").0, 204);
        assert_eq!(pin("GET", name, ""), (200, json!(false)));
    }
    assert_eq!(pin("GET", "-LY", ""), (200, json!(false)));
    assert_eq!(pin("GET", "HX", ""), (200, json!(true)));
    assert_eq!(pin("GET", "AI2", ""), (200, json!(2500.0)));
    assert_eq!(pin("PUT", "AI2", "1250").0, 204);
    check(&client, b"AI2\r", b"1250\r");
    assert_eq!(pin("PUT", "DI3", "true").0, 204);
    check(&client, b"DI\rDO=5\rEO=3\r", b"4\rOK\rOK\r");
    for (name, on) in [("DO1", true), ("DO2", false), ("DO3", true), ("EO2", true)] {
        assert_eq!(pin("GET", name, ""), (200, json!(on)), "{name}");
    }
    assert_eq!(pin("PUT", "DO1", "true").0, 422);
    assert_eq!(pin("GET", "+LZ", "").0, 404);

    check(&client, b"HSPD=20000\rX2000\rY-1000\r", b"OK\rOK\rOK\r");
    let moving = state();
    assert_eq!(
        (&moving["axes"]["X"]["target"], &moving["axes"]["Y"]["target"]),
        (&json!(2000), &json!(-1000))
    );
    assert!(
        moving["axes"]["X"]["speed"].as_f64() > Some(0.0)
            && moving["axes"]["Y"]["speed"].as_f64() < Some(0.0)
    );
    eventually("both axes arrive", || {
        let axes = state()["axes"].take();
        ["X", "Y"].iter().all(|axis| axes[axis]["speed"] == 0.0)
    });
    let axes = state()["axes"].take();
    let axis = |name: &str| ["position", "encoder", "steps"].map(|value| axes[name][value].as_i64().unwrap());
    assert_eq!((axis("X"), axis("Y")), ([2000, 2000, 2000], [-1000, -1000, 1000]));

    let program = b"SA0=PRG 0\rSA1=WHILE V1 = 0 -> 3\rSA2=ENDWHILE -> 1\rSA3=END\rSR0=1\r";
    check(&client, program, &b"OK\r".repeat(5));
    assert_eq!(state()["programs"][0]["state"], "running");
    assert_eq!(state()["programs"][1]["state"], "idle");
    check(&client, b"SR0=2\r", b"OK\r");
    assert_eq!(state()["programs"][0]["state"], "paused");
    server.stop().unwrap();
}
