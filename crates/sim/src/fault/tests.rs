use super::*;
use crate::{config::Bench, tape::PortName};

const BENCH: &str = "[[device]]\nmodel = \"pd42-1140\"\n[[device]]\nmodel = \"pmx-2ed\"\nname = \"stage\"\n";

fn devices() -> Vec<DeviceConfig> {
    Bench::parse(BENCH, "bench.toml").unwrap().devices
}

fn parse(text: &str) -> Result<Scenario, String> {
    // A program whose labels stand on the addresses that they name, and whose lines are one further.
    let find = |place: &Place| match place {
        Place::Line(line) => Ok(line - 1),
        Place::Label(label) => label.parse().map_err(|_| format!("label: there is no `{label}`")),
    };
    Scenario::parse(text, "day.toml", &devices(), &find).map_err(|error| error.to_string())
}

/// The one fault of the stage, below its device's name in line 2.
fn stage(entries: &str) -> Result<Planned, String> {
    let scenario = parse(&format!("[[fault]]\ndevice = \"stage\"\n{entries}"))?;
    assert_eq!(scenario.of(0).count(), 0);
    Ok(scenario.of(1).next().unwrap().clone())
}

#[track_caller]
fn check(entries: &str, trigger: Trigger, kind: Kind, duration_s: Option<f64>) {
    let planned = stage(entries).unwrap();
    assert_eq!(planned, Planned { trigger, after_s: 0.0, fault: Fault { kind, duration_s } });
    // What a tape says of it is the same.
    let written = serde_json::to_string(&Entry::from(&planned)).unwrap();
    let entry: Entry = serde_json::from_str(&written).unwrap();
    let again = entry.parse(&Parts::of(&devices()[1]), &scenario::no_source);
    assert_eq!(again, Ok(planned), "{written}");
}

#[track_caller]
fn check_error(entries: &str, expected: &str) {
    assert_eq!(stage(entries).unwrap_err(), format!("day.toml:{expected}"));
}

fn name() -> String {
    "X".into()
}

#[test]
fn every_kind_can_be_said() {
    let now = || Trigger::At(0.0);
    let line = Line { port: None, way: None };
    let hid_in = Line { port: Some(PortName::Usb), way: Some(Way::In) };
    let pin = || "+LX".to_string();
    let on = Some(crate::PinValue::Level(true));
    for (entries, kind, duration) in [
        ("kind = 'stuck_switch'\npin = '+LX'", Kind::StuckSwitch { pin: pin(), value: None }, None),
        (
            "kind = 'stuck_switch'\npin = '+LX'\nvalue = true",
            Kind::StuckSwitch { pin: pin(), value: on },
            None,
        ),
        ("kind = 'bouncing_switch'\npin = '+LX'\nms = 5", Kind::BouncingSwitch { pin: pin(), ms: 5 }, None),
        (
            "kind = 'broken_encoder'\naxis = 'X'\nduration = 0.5",
            Kind::BrokenEncoder { axis: name(), encoder: None },
            Some(0.5),
        ),
        ("kind = 'slip'\naxis = 'X'\npulses = 30", Kind::Slip { axis: name(), pulses: 30 }, None),
        (
            "kind = 'extra_load'\naxis = 'X'\nload = 0.5\nduration = 3",
            Kind::ExtraLoad { axis: name(), load: 0.5 },
            Some(3.0),
        ),
        ("kind = 'brown_out'\nduration = 0.2", Kind::BrownOut, Some(0.2)),
        ("kind = 'power_cut'", Kind::PowerCut, None),
        ("kind = 'noise'\nrate = 1e-3", Kind::Noise { line, rate: 1e-3 }, None),
        ("kind = 'loss'\nrate = 1\nport = 'usb'\nway = 'in'", Kind::Loss { line: hid_in, rate: 1.0 }, None),
        ("kind = 'duplication'\nrate = 0.25", Kind::Duplication { line, rate: 0.25 }, None),
        ("kind = 'delay'\nms = 20", Kind::Delay { line, ms: 20 }, None),
        (
            "kind = 'babbling_node'\nport = 'rs485'\nms = 10\nbytes = '400d'",
            Kind::BabblingNode { port: PortName::Rs485, ms: 10, bytes: Some(b"@\r".to_vec()) },
            None,
        ),
    ] {
        check(entries, now(), kind, duration);
    }
    let dip =
        parse("[[fault]]\ndevice = 'pd42-1140'\nat = 1.5\nafter = 0.5\nkind = 'supply_dip'\nvolts = 8\n");
    let fault = Fault { kind: Kind::SupplyDip { volts: 8.0 }, duration_s: None };
    let planned = Planned { trigger: Trigger::At(1.5), after_s: 0.5, fault };
    assert_eq!(dip.unwrap().faults, [(0, planned)]);
    let bench = Bench::parse("[[device]]\nmodel = \"cmd-4cr\"\n", "bench.toml").unwrap();
    let text = "[[fault]]\nkind = 'hand_wheel'\naxis = 'Z'\ncounts = -40\n";
    let wheel = Scenario::parse(text, "day.toml", &bench.devices, &scenario::no_source).unwrap();
    let kind = Kind::HandWheel { axis: "Z".into(), counts: -40 };
    assert_eq!(wheel.of(0).next().unwrap().fault, Fault { kind, duration_s: None });
    assert_eq!(Entry::from(wheel.of(0).next().unwrap()).counts, Some(-40));
}

#[test]
fn every_event_can_be_said() {
    let on = |event: &str, trigger| {
        check(&format!("kind = 'power_cut'\non = {{ {event} }}"), trigger, Kind::PowerCut, None)
    };
    on("pin = 'HX'", Trigger::Pin { pin: "HX".into(), value: None });
    on("pin = 'DO1', value = false", Trigger::Pin { pin: "DO1".into(), value: Some(false) });
    on("axis = 'X', position = -500", Trigger::Position { axis: name(), position: -500 });
    on("axis = 'X', motion = 'starts'", Trigger::Motion { axis: name(), motion: trigger::Motion::Starts });
    on("axis = 'X', motion = 'stops'", Trigger::Motion { axis: name(), motion: trigger::Motion::Stops });
    on("address = 7", Trigger::Address { program: None, address: 7 });
    on("line = 7, program = 1", Trigger::Address { program: Some(1), address: 6 });
    on("label = '12'", Trigger::Address { program: None, address: 12 });
    on("message = 3, port = 'usb'", Trigger::Message { number: 3, port: Some(PortName::Usb) });
}

#[test]
fn faults_that_cannot_be() {
    let kinds: Vec<_> = KINDS.iter().map(|row| row.name).collect();
    check_error("kind = 'fire'", &format!("3: fault.kind: unknown kind `fire`, known: {}", kinds.join(", ")));
    check_error("kind = 'slip'\naxis = 'X'", "3: fault.kind: slip needs `pulses`");
    check_error("kind = 'slip'\naxis = 'X'\npulses = 1\nrate = 1", "6: fault.rate: slip has no `rate`");
    check_error(
        "kind = 'slip'\naxis = 'X'\npulses = 1\nduration = 1",
        "6: fault.duration: slip has no `duration`",
    );
    check_error("kind = 'slip'\npulses = 1\naxis = 'Q'", "5: fault.axis: unknown axis `Q`, known: X, Y");
    check_error(
        "kind = 'slip'\npulses = 0\naxis = 'X'",
        "4: fault.pulses: 0 is outside 1 to 1099511627776 pulses",
    );
    check_error("kind = 'noise'\nrate = 1.5", "4: fault.rate: 1.5 is outside 0 to 1");
    check_error("kind = 'noise'\nrate = nan", "4: fault.rate: NaN is outside 0 to 1");
    check_error("kind = 'power_cut'\nduration = -1", "4: fault.duration: -1 is outside 0 to 1000000000 s");
    check_error("kind = 'power_cut'\nat = -1", "4: fault.at: -1 is outside 0 to 1000000000 s");
    check_error("kind = 'delay'\nms = 0", "4: fault.ms: 0 is outside 1 to 60000 ms");
    check_error(
        "kind = 'supply_dip'\nvolts = 9",
        "3: fault.kind: a pmx-2ed has no pin that measures its supply",
    );
    check_error(
        "kind = 'broken_encoder'\naxis = 'X'\nencoder = 1",
        "5: fault.encoder: the axis has 1 of them, from 0",
    );
    check_error("kind = 'hand_wheel'\ncounts = 1\naxis = 'X'", "5: fault.axis: axis `X` has no MPG input");
    check_error(
        "kind = 'hand_wheel'\naxis = 'X'\ncounts = 2147483649",
        "5: fault.counts: 2147483649 is outside -2147483648 to 2147483648 counts",
    );
    let output = "`DO1` is an output, only the controller drives it";
    check_error("kind = 'stuck_switch'\npin = 'DO1'", &format!("4: fault.pin: {output}"));
    check_error(
        "kind = 'stuck_switch'\npin = 'HX'\nvalue = 5",
        "5: fault.value: `HX` is digital: true or false",
    );
    check_error("kind = 'bouncing_switch'\nms = 5\npin = 'DI1'", "5: fault.pin: no switch is at `DI1`");
    check_error(
        "kind = 'bouncing_switch'\npin = 'HX'\nms = 1001",
        "5: fault.ms: 1001 is outside 1 to 1000 ms",
    );
    let hex = "write 1 to 64 bytes as pairs of hexadecimal digits";
    for bytes in ["", "0", "0g", &"00".repeat(65)] {
        let babble = format!("kind = 'babbling_node'\nport = 'rs485'\nms = 5\nbytes = '{bytes}'");
        check_error(&babble, &format!("6: fault.bytes: {hex}"));
    }
    check_error("kind = 'noise'\nrate = 'a'", "4: fault.rate: invalid type: string \"a\", expected f64");
    let port = "unknown variant `uart`, expected one of `usb`, `rs485`, `can`";
    check_error("kind = 'noise'\nrate = 1\nport = 'uart'", &format!("5: fault.port: {port}"));
    let many = "[[fault]]\ndevice = 'stage'\nkind = 'power_cut'\n".repeat(MAX_FAULTS + 1);
    let line = 3 * MAX_FAULTS + 3;
    assert_eq!(
        parse(&many).unwrap_err(),
        format!("day.toml:{line}: fault.kind: a device has 256 faults at most")
    );
}

#[test]
fn devices_that_are_not_there() {
    let error = |device: &str| parse(&format!("[[fault]]\nkind = 'power_cut'\n{device}")).unwrap_err();
    assert_eq!(error(""), "day.toml:1: fault.device: say which: pd42-1140, stage");
    let unknown = "day.toml:3: fault.device: unknown device `a`, known: pd42-1140, stage";
    assert_eq!(error("device = 'a'"), unknown);
    // Where there is one it need not be named.
    let text = "[[fault]]\nkind = 'power_cut'\n";
    let alone = Scenario::parse(text, "day.toml", &devices()[..1], &scenario::no_source).unwrap();
    assert_eq!(alone.of(0).count(), 1);
    assert_eq!(parse("").unwrap(), Scenario::default());
}

#[test]
fn events_that_cannot_be() {
    let error = |event: &str, expected: &str| {
        check_error(&format!("kind = 'power_cut'\non = {{ {event} }}"), &format!("4: fault.on: {expected}"));
    };
    let forms = "an event is one of: pin (value); axis and position; axis and motion; address (program); line (program); \
                 label (program); message (port)";
    for event in [
        "",
        "axis = 'X'",
        "pin = 'HX', address = 3",
        "value = true",
        "axis = 'X', position = 3, motion = 'stops'",
    ] {
        error(event, forms);
    }
    error("axis = 'Q', position = 1", "axis: unknown axis `Q`, known: X, Y");
    error(
        "axis = 'X', position = 9000000000000",
        "position: 9000000000000 is outside -1099511627776 to 1099511627776 pulses",
    );
    error("pin = 'AI1'", "pin: `AI1` is analog, and changes all the time");
    error("label = 'loop'", "label: there is no `loop`");
    error("message = 0", "message: the first one is 1");
    check_error(
        "kind = 'power_cut'\nat = 1\non = { pin = 'HX' }",
        "5: fault.on: it is `at` a time or `on` an event, not both",
    );
    let source = "the source of the program is not known here; say `address`";
    let text = "[[fault]]\nkind = 'power_cut'\non = { line = 3 }\n";
    let unknown = Scenario::parse(text, "day.toml", &devices()[..1], &scenario::no_source).unwrap_err();
    assert_eq!(unknown.to_string(), format!("day.toml:3: fault.on: {source}"));
}

#[test]
fn looks_are_evenly_spaced() {
    for clock_hz in [16_000_000, 19_660_800, 1_000_000, 20_000] {
        let (mut now, mut looks) = (0, 0);
        while now < u64::from(clock_hz) {
            let next = trigger::next_look(now, clock_hz);
            assert!(next > now);
            // From anywhere between it is the same.
            assert_eq!(trigger::next_look((now + next) / 2, clock_hz).max(next), next.max(now + 1));
            (now, looks) = (next, looks + 1);
        }
        assert_eq!(looks, trigger::LOOKS_PER_SECOND);
    }
}

/// The table of kinds says which tests hold them.
#[test]
fn each_kind_has_its_tests() {
    let tests = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    for file in ["pd42/faults.rs", "ascii/faults.rs", "cmd4cr/following.rs"] {
        let text = std::fs::read_to_string(tests.join(file)).unwrap();
        // Not every controller has what these are at.
        let is_here = |row: &&KindRow| match row.name {
            "supply_dip" => file.starts_with("pd42"),
            "hand_wheel" => file.starts_with("cmd4cr"),
            _ => !file.starts_with("cmd4cr"),
        };
        for row in KINDS.iter().filter(is_here) {
            assert!(text.contains(&format!("#[test]\nfn {}() {{", row.test)), "{}: {}", file, row.test);
        }
    }
}

/// The page of the documentation has the tables.
#[test]
fn the_page_has_every_kind_and_event() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/faults.md");
    let page = std::fs::read_to_string(page).unwrap();
    let code = |keys: &[&str]| keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
    let kinds = KINDS.iter().map(|row| {
        let lasts = if row.lasts { "" } else { " No `duration`." };
        format!("| `{}` | {} | {} | {}{lasts} |\n", row.name, code(row.needs), code(row.may), row.text)
    });
    let events =
        TRIGGERS.iter().map(|row| format!("| {} | {} | {} |\n", code(row.needs), code(row.may), row.text));
    for row in kinds.chain(events) {
        assert!(page.contains(&row), "{row}");
    }
}
