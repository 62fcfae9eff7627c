use super::*;
use crate::testing::MODELS;

fn parse(text: &str) -> Result<Bench, String> {
    file::parse(text, "bench.toml", MODELS).map_err(|error| error.to_string())
}

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(parse(text).expect_err("it should be refused"), expected);
}

/// The entries of axis 0 of a device, from line 3 on.
#[track_caller]
fn check_axis(entries: &str, expected: &str) {
    check(&format!("[[device]]\nmodel = \"test\"\n[device.axis.0]\n{entries}"), expected);
}

#[test]
fn everything_can_be_said() {
    let text = r#"
        [[device]]
        model = "test"
        name = "stage"
        listen = ["tcp:127.0.0.1:4002", "pty:/run/stage"]
        supply = 36
        temperature = 41.5
        seed = 7
        [device.axis.0]
        negative_limit = -20000
        positive_limit = 1000000
        home = [-200, 0]
        index_every = 4000
        encoder_ratio = 1
        backlash = 3
        load = 0.25
        hard_stops = [-21000, 1001000]
        slowdown = [[-500, -400], [90000, 100000]]
        in_position_ms = 20
        mpg_hz = 400
        switch_hysteresis = 5
        bounce_ms = 3
        normally_closed = ["home", "slowdown"]
        encoder_at = "motor"
        pull_out = [[0, 1], [2000, 0.5]]
        friction = 0.125
        microsteps = 16
        [[device.axis.0.cam]]
        pin = "PORT"
        on = [0, 10]
        normally_closed = true

        [[device]]
        model = "test"
    "#;
    let bench = parse(text).unwrap();
    let axis = AxisConfig {
        negative_limit: -20_000,
        positive_limit: 1_000_000,
        home: [-200, 0],
        index_every: 4000,
        encoder_ratio: 1.0,
        backlash: 3,
        load: 0.25,
        hard_stops: Some([-21_000, 1_001_000]),
        slowdown: [Some([-500, -400]), Some([90_000, 100_000])],
        in_position_ms: Some(20),
        mpg_from: None,
        mpg_hz: 400,
        circumference: None,
        switch_hysteresis: 5,
        bounce_ms: 3,
        normally_closed: vec![Switch::Home, Switch::Slowdown],
        encoder_at: EncoderPlace::Motor,
        pull_out: vec![[0.0, 1.0], [2000.0, 0.5]],
        friction: 0.125,
        microsteps: 16,
        joystick: 0.0,
        cams: vec![Cam { pin: "PORT".into(), on: [0, 10], normally_closed: true }],
    };
    let first = DeviceConfig {
        name: "stage".into(),
        listen: vec!["tcp:127.0.0.1:4002".parse().unwrap(), "pty:/run/stage".parse().unwrap()],
        axes: BTreeMap::from([("0".into(), axis)]),
        supply_v: 36.0,
        temperature_c: 41.5,
        seed: Some(7),
        ..DeviceConfig::new(&MODELS[0])
    };
    assert_eq!(bench.devices, [first, DeviceConfig::new(&MODELS[0])]);
}

#[test]
fn defaults_belong_to_the_model() {
    assert_eq!(AxisConfig::of_model("test").negative_limit, -1_000_000);
    assert_eq!(AxisConfig::of_model("pd42-1140").positive_limit, 10_000_000);
    let usual = AxisConfig {
        negative_limit: -1_000_000,
        positive_limit: 1_000_000,
        home: [-200, 0],
        index_every: 4000,
        encoder_ratio: 1.0,
        backlash: 0,
        load: 0.0,
        hard_stops: None,
        slowdown: [None; 2],
        in_position_ms: None,
        mpg_from: None,
        mpg_hz: 10_000,
        circumference: None,
        switch_hysteresis: 0,
        bounce_ms: 0,
        normally_closed: Vec::new(),
        encoder_at: EncoderPlace::Load,
        pull_out: Vec::new(),
        friction: 0.0,
        microsteps: 1,
        joystick: 0.0,
        cams: Vec::new(),
    };
    assert_eq!(AxisConfig::of_model("pmx-2ed"), usual);
    assert_eq!(DeviceConfig::new(&MODELS[0]).axis("0"), AxisConfig::of_model("test"));
}

#[test]
fn text_that_is_not_toml() {
    check("[[device]\n", "bench.toml:1: unclosed array table, expected `]`");
    check("\n\nmodel = test\n", "bench.toml:3: invalid boolean, expected `true`");
}

/// What serde reads is what the table has, in its order.
fn names(keys: &[keys::Key]) -> String {
    keys.iter().map(|key| format!("`{}`", key.name)).collect::<Vec<_>>().join(", ")
}

#[test]
fn keys_that_do_not_exist() {
    check(
        "[[device]]\nmodel = \"test\"\ncolour = 3\n",
        &format!(
            "bench.toml:3: device.colour: unknown field `colour`, expected one of {}",
            names(keys::DEVICE)
        ),
    );
    check_axis(
        "home = [0, 1]\nbacklsh = 3\n",
        &format!(
            "bench.toml:5: device.axis.0.backlsh: unknown field `backlsh`, expected one of {}",
            names(keys::AXIS)
        ),
    );
    check("devices = 1\n", "bench.toml:1: devices: unknown field `devices`, expected `device`");
    check("", "bench.toml:1: bench file: missing field `device`");
    check("[[device]]\nname = \"a\"\n", "bench.toml:1: device: missing field `model`");
}

#[test]
fn values_of_another_type() {
    check(
        "[[device]]\nmodel = 3\n",
        "bench.toml:2: device.model: invalid type: integer `3`, expected a string",
    );
    check_axis(
        "home = [1]\n",
        "bench.toml:4: device.axis.0.home: invalid length 1, expected an array of length 2",
    );
    check_axis(
        "load = \"a\"\n",
        "bench.toml:4: device.axis.0.load: invalid type: string \"a\", expected f64",
    );
    check_axis(
        "backlash = 0.5\n",
        "bench.toml:4: device.axis.0.backlash: invalid type: floating point `0.5`, expected i64",
    );
    check("device = 3\n", "bench.toml:1: device: invalid type: integer `3`, expected a sequence");
}

#[test]
fn devices_that_cannot_be() {
    check("[[device]]\nmodel = \"pd99\"\n", "bench.toml:2: device.model: unknown model `pd99`, known: test");
    let two = "[[device]]\nmodel = \"test\"\n[[device]]\nmodel = \"test\"\nname = \"test\"\n";
    check(two, "bench.toml:5: device.name: there is already a device named `test`");
    let name = "[[device]]\nmodel = \"test\"\nname = \"../a\"\n";
    check(name, "bench.toml:3: device.name: `../a` is not a name: letters, digits, `.`, `_`, `-`");
    let listen = "[[device]]\nmodel = \"test\"\nlisten = [\"udp:a\"]\n";
    let kinds = "write tcp:HOST:PORT, pty:PATH, slcan-tcp:HOST:PORT, hid-tcp:HOST:PORT or hid-unix:PATH";
    check(listen, &format!("bench.toml:3: device.listen: `udp:a` is not an endpoint: {kinds}"));
    let twice = "[[device]]\nmodel = \"test\"\nlisten = [\"tcp:h:1\", \"tcp:h:1\"]\n";
    check(twice, "bench.toml:3: device.listen: `tcp:h:1` is there twice");
    let serial = "[[device]]\nmodel = \"test\"\nlisten = [\"hid-tcp:h:1\"]\n";
    check(serial, "bench.toml:3: device.listen: hid-tcp:h:1: a test is no HID device");
    let supply = "[[device]]\nmodel = \"test\"\nsupply = nan\n";
    check(supply, "bench.toml:3: device.supply: NaN is outside 0 to 1000 V");
    let cold = "[[device]]\nmodel = \"test\"\ntemperature = -300\n";
    check(cold, "bench.toml:3: device.temperature: -300 is outside -273 to 1000 °C");
    let axis = "[[device]]\nmodel = \"test\"\n\n[device.axis.X]\nload = 0\n";
    check(axis, "bench.toml:4: device.axis.X: unknown axis `X`, test has: 0");
}

#[test]
fn machines_that_cannot_be() {
    check_axis(
        "negative_limit = 5\npositive_limit = 5\n",
        "bench.toml:5: device.axis.0.positive_limit: the negative limit 5 must lie below the positive limit 5",
    );
    check_axis(
        "negative_limit = 2000000\n",
        "bench.toml:4: device.axis.0.negative_limit: \
         the negative limit 2000000 must lie below the positive limit 1000000",
    );
    check_axis("home = [1, 0]\n", "bench.toml:4: device.axis.0.home: 1 must not lie above 0");
    let far =
        "bench.toml:4: device.axis.0.home: 9000000000000 is outside -1099511627776 to 1099511627776 pulses";
    check_axis("home = [1, 9000000000000]\n", far);
    let every = "bench.toml:4: device.axis.0.index_every: 0 is outside 1 to 1099511627776 pulses";
    check_axis("index_every = 0\n", every);
    let backlash = "bench.toml:4: device.axis.0.backlash: -1 is outside 0 to 1099511627776 pulses";
    check_axis("backlash = -1\n", backlash);
    let ratio = "bench.toml:4: device.axis.0.encoder_ratio: 0 is outside 0.000001 to 1000000 counts a pulse";
    check_axis("encoder_ratio = 0.0\n", ratio);
    check_axis("load = -0.5\n", "bench.toml:4: device.axis.0.load: -0.5 is outside 0 to 1000");
    let stops =
        "bench.toml:4: device.axis.0.hard_stops: 0, where the axis starts, must lie between the stops";
    check_axis("hard_stops = [1, 5]\n", stops);
    check_axis("slowdown = [1, 0]\n", "bench.toml:4: device.axis.0.slowdown: 1 must not lie above 0");
    let forms = "expected one zone as `[0, 5]` or two as `[[0, 5], [10, 15]]`";
    check_axis("slowdown = 3\n", &format!("bench.toml:4: device.axis.0.slowdown: {forms}"));
    let gap = "bench.toml:4: device.axis.0.slowdown: the second zone must begin above 5, with a gap";
    check_axis("slowdown = [[0, 5], [6, 9]]\n", gap);
    let far = "9000000000000 is outside -1099511627776 to 1099511627776 pulses";
    check_axis(
        "slowdown = [[0, 5], [10, 9000000000000]]\n",
        &format!("bench.toml:4: device.axis.0.slowdown: {far}"),
    );
    let late = "bench.toml:4: device.axis.0.in_position_ms: 0 is outside 1 to 60000 ms";
    check_axis("in_position_ms = 0\n", late);
    let itself = "bench.toml:4: device.axis.0.mpg_from: an axis does not follow itself";
    check_axis("mpg_from = \"0\"\n", itself);
    check_axis("mpg_from = \"X\"\n", "bench.toml:4: device.axis.0.mpg_from: unknown axis `X`, known: 0");
    let cut = "the second zone must begin above 5, with a gap";
    check_axis(
        "switch_hysteresis = 3\nslowdown = [[0, 5], [12, 20]]\n",
        &format!("bench.toml:5: device.axis.0.slowdown: {cut}"),
    );
    check_axis("bounce_ms = 5000\n", "bench.toml:4: device.axis.0.bounce_ms: 5000 is outside 0 to 1000 ms");
    let words = "expected one of `negative_limit`, `positive_limit`, `home`, `slowdown`";
    check_axis(
        "normally_closed = [\"index\"]\n",
        &format!("bench.toml:4: device.axis.0.normally_closed: unknown variant `index`, {words}"),
    );
    let rising =
        "bench.toml:4: device.axis.0.pull_out: speeds must rise from point to point, and torques must not";
    check_axis("pull_out = [[0, 0.5], [100, 0.6]]\n", rising);
    check_axis("pull_out = [[100, 0.5], [100, 0.4]]\n", rising);
    check_axis("pull_out = []\n", "bench.toml:4: device.axis.0.pull_out: 1 to 64 points");
    check_axis("pull_out = [[0, 1, 2]]\n", "bench.toml:4: device.axis.0.pull_out: 2 values, not 3");
    check_axis("home = [0, 1, 2]\n", "bench.toml:4: device.axis.0.home: 2 values, not 3");
    let fast = "bench.toml:4: device.axis.0.pull_out: 2000000 is outside 0 to 1000000";
    check_axis("pull_out = [[0, 0.5], [2000000, 0.4]]\n", fast);
    let points = format!("pull_out = {:?}", vec![[0, 1]; MAX_POINTS + 1]);
    check_axis(&points, "bench.toml:4: device.axis.0.pull_out: 1 to 64 points");
    check_axis(
        "friction = 1\n",
        "bench.toml:4: device.axis.0.friction: what is lost to the speed needs `pull_out`",
    );
    let wheel = "bench.toml:4: device.axis.0.mpg_hz: 0 is outside 1 to 1000000 counts a second";
    check_axis("mpg_hz = 0\n", wheel);
}

#[test]
fn an_axis_that_goes_round() {
    let ends = "an axis that goes round has no ends";
    for key in ["negative_limit", "positive_limit"] {
        check_axis(
            &format!("circumference = 800\n{key} = 5\n"),
            &format!("bench.toml:5: device.axis.0.{key}: {ends}"),
        );
    }
    check_axis(
        "circumference = 800\nindex_every = 300\n",
        "bench.toml:5: device.axis.0.index_every: 300 must divide the circumference 800",
    );
    let zone = "bench.toml:5: device.axis.0.slowdown: one zone only on an axis that goes round";
    check_axis("circumference = 800\nslowdown = [[0, 5], [100, 105]]\n", zone);
    let bench = parse("[[device]]\nmodel = \"test\"\n[device.axis.0]\ncircumference = 800\n").unwrap();
    assert_eq!(bench.devices[0].axis("0").index_every, 800);
}

#[test]
fn cams_that_cannot_be() {
    let cam = |pin: &str, on: &str| format!("[[device.axis.0.cam]]\npin = \"{pin}\"\non = {on}\n");
    let at = |entry: &str, problem: &str| format!("bench.toml:{entry}: {problem}");
    check_axis(&cam("IN9", "[0, 5]"), &at("5: device.axis.0.cam.0.pin", "the device has no pin `IN9`"));
    check_axis(&cam("OUT", "[0, 5]"), &at("5: device.axis.0.cam.0.pin", "`OUT` is no digital input"));
    check_axis(&cam("PORT", "[6, 5]"), &at("6: device.axis.0.cam.0.on", "6 must not lie above 5"));
    let far = "9000000000000 is outside -1099511627776 to 1099511627776 pulses";
    check_axis(&cam("PORT", "[0, 9000000000000]"), &at("6: device.axis.0.cam.0.on", far));
    let twice = cam("PORT", "[0, 5]") + &cam("PORT", "[8, 9]");
    check_axis(&twice, &at("3: device.axis", "two cams on `PORT`"));
    check_axis(&cam("PORT", "[0, 5]").repeat(17), &at("4: device.axis.0.cam", "16 at most"));
}

#[test]
fn a_file_that_is_not_there() {
    let error = Bench::read(Path::new("/nowhere/bench.toml")).unwrap_err().to_string();
    assert!(error.starts_with("/nowhere/bench.toml: ") && !error.contains('\n'), "{error}");
}

#[test]
fn the_same_endpoint_is_a_bus() {
    let device = |name: &str, listen: &[&str]| DeviceConfig {
        name: name.into(),
        listen: listen.iter().map(|text| text.parse().unwrap()).collect(),
        ..DeviceConfig::new(&MODELS[0])
    };
    let devices = [
        device("a", &["tcp:h:0", "tcp:h:1"]),
        device("b", &["tcp:h:1"]),
        device("c", &["tcp:h:0", "pty:/p"]),
    ];
    let buses: Vec<_> =
        buses(&devices).into_iter().map(|bus| (bus.endpoint.to_string(), bus.members)).collect();
    let expected = [("tcp:h:0", vec![0]), ("tcp:h:1", vec![0, 1]), ("tcp:h:0", vec![2]), ("pty:/p", vec![2])];
    assert_eq!(buses, expected.map(|(endpoint, members)| (endpoint.to_string(), members)));
}

#[test]
fn the_examples_can_be_read() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/bench");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        Bench::read(&path).unwrap_or_else(|error| panic!("{error}"));
        names.push(path);
    }
    assert!(names.len() >= 3, "{names:?}");
}

/// With the models that there are.
#[test]
fn a_device_is_set_only_what_it_has() {
    let check = |entries: &str, expected: &str| {
        let text = format!("[[device]]\nmodel = \"pmx-2ed\"\n{entries}");
        assert_eq!(Bench::parse(&text, "bench.toml").unwrap_err().to_string(), expected);
    };
    check("supply = 24", "bench.toml:3: device.supply: pmx-2ed has no pin that measures this");
    let driver = "the device has its own driver, and a parameter for this";
    let pd42 = "[[device]]\nmodel = \"pd42-1140\"\n[device.axis.0]\nmicrosteps = 16\n";
    let error = Bench::parse(pd42, "bench.toml").unwrap_err().to_string();
    assert_eq!(error, format!("bench.toml:4: device.axis.0.microsteps: {driver}"));
    check("temperature = 24", "bench.toml:3: device.temperature: pmx-2ed has no pin that measures this");
    for (entry, key, input) in [
        ("slowdown = [0, 1]", "slowdown", "slowdown"),
        ("in_position_ms = 5", "in_position_ms", "in-position"),
        ("mpg_from = \"X\"", "mpg_from", "MPG"),
        ("mpg_hz = 5", "mpg_hz", "MPG"),
        ("normally_closed = [\"slowdown\"]", "normally_closed", "slowdown"),
    ] {
        let problem = format!("the device has no {input} input for this axis");
        check(&format!("[device.axis.Y]\n{entry}"), &format!("bench.toml:4: device.axis.Y.{key}: {problem}"));
    }
    check("[device.axis.0]", "bench.toml:3: device.axis.0: unknown axis `0`, pmx-2ed has: X, Y");
    let both = "[device.axis.X]\nhome = [5, 6]\n[device.axis.Y]\nbacklash = 2\n";
    let bench = Bench::parse(&format!("[[device]]\nmodel = \"pmx-2ed\"\n{both}"), "bench.toml").unwrap();
    let device = &bench.devices[0];
    assert_eq!((device.axis("X").home, device.axis("X").backlash), ([5, 6], 0));
    assert_eq!((device.axis("Y").home, device.axis("Y").backlash), ([-200, 0], 2));
}

#[test]
fn a_hid_endpoint_has_one_device() {
    let bench = |endpoints: [&str; 2]| {
        let device = |(name, endpoint)| {
            format!("[[device]]\nmodel = \"pmx-2ed\"\nname = \"{name}\"\nlisten = [\"{endpoint}\"]\n")
        };
        let text: String = ["a", "b"].into_iter().zip(endpoints).map(device).collect();
        Bench::parse(&text, "bench.toml").map(|bench| bench.devices.len()).map_err(|error| error.to_string())
    };
    let taken = "`a` is there already, and a HID endpoint has one device";
    for endpoint in ["hid-tcp:h:1", "hid-unix:/run/a"] {
        assert_eq!(bench([endpoint; 2]), Err(format!("bench.toml:8: device.listen: {endpoint}: {taken}")));
    }
    assert_eq!(bench(["hid-tcp:h:0"; 2]), Ok(2), "one each");
    assert_eq!(bench(["hid-tcp:h:1", "hid-tcp:h:2"]), Ok(2));
    assert_eq!(bench(["tcp:h:1"; 2]), Ok(2));
}

#[test]
fn one_entry_can_be_many_devices() {
    let text =
        "[[device]]\nmodel = \"test\"\ncount = 3\nlisten = [\"tcp:h:{4000+n}\", \"tcp:h:9\"]\nseed = 5\n";
    let devices = parse(text).unwrap().devices;
    let names: Vec<_> = devices.iter().map(|device| device.name.as_str()).collect();
    assert_eq!(names, ["test-1", "test-2", "test-3"]);
    assert_eq!(devices[2].listen[0].to_string(), "tcp:h:4003");
    assert_eq!(devices[1].seed, Some(5));
    let buses = buses(&devices);
    assert_eq!(buses.iter().map(|bus| bus.members.len()).collect::<Vec<_>>(), [1, 3, 1, 1]);

    let entry = |entries: &str| format!("[[device]]\nmodel = \"test\"\n{entries}");
    check(
        &(entry("count = 10000\n") + "[[device]]\nmodel = \"test\""),
        "bench.toml:1: device: 10000 devices at most",
    );
    check(&entry("count = 0"), "bench.toml:3: device.count: 0 is outside 1 to 10000");
    check(
        &entry("count = 2\nname = \"a\""),
        "bench.toml:4: device.name: where there is a `count` it has `{n}` in it",
    );
    check(
        &entry("count = 2\nlisten = [\"tcp:h:{4000}\"]"),
        "bench.toml:4: device.listen: `{4000}` is not of the form `{n}` or `{4000+n}`",
    );
    check(
        &entry("count = 2\nlisten = [\"tcp:h:{65534+n}\"]"),
        "bench.toml:4: device.listen: `65536` is not a port: 0 to 65535",
    );
}
