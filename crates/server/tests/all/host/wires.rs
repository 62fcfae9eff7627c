//! Wires themselves: buses with several controllers on them, terminals, and what goes wrong.

use super::stand::{RUNTIME, Stand, bus, device, how, serve};
use crate::common::{PATIENCE, directory, free_address};
use host::{Action, Bus, Controller, End, Error, Found, Model, Pending, Value, Wire, WireError, find};
use std::time::Duration;
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt, DuplexStream},
    time::timeout,
};

fn found(address: u8, model: Model, version: &str) -> Found {
    Found { address, model: Some(model.name().into()), version: version.into() }
}

#[test]
fn who_is_alone_is_found_at_once() {
    let check = |model: Model, expected: Found| {
        let (server, _) = serve(vec![device(model, [-1000, 1000])]);
        let bus = bus(&server.ready()[0].1);
        assert_eq!(RUNTIME.block_on(find(&bus)).unwrap(), [expected]);
        server.stop().unwrap();
    };
    check(Model::Pmx2ed, found(0, Model::Pmx2ed, "V128BL"));
    check(Model::Cmd4cr, found(1, Model::Cmd4cr, "V126BL"));
    check(Model::Pd42, found(1, Model::Pd42, "1140V1.47"));
}

/// Controllers that share one endpoint; each has another one of its own.
fn serve_bus(models: &[Model]) -> (server::Server, String) {
    let endpoint = format!("tcp:{}", free_address());
    let devices = models.iter().enumerate().map(|(number, model)| {
        let mut config = device(*model, [-1_000_000, 1_000_000]);
        config.name = number.to_string();
        config.listen.push(endpoint.parse().unwrap());
        config
    });
    (serve(devices.collect()).0, endpoint)
}

/// The endpoint that is a controller's own.
fn own(server: &server::Server, number: usize) -> &str {
    let name = number.to_string();
    &server.ready().iter().find(|(known, _)| *known == name).unwrap().1
}

#[test]
fn two_families_share_a_bus() {
    let (server, endpoint) = serve_bus(&[Model::Pmx2ed, Model::Cmd4cr]);
    let bus = bus(&endpoint);
    RUNTIME.block_on(async {
        let open = |model, address| Controller::open(bus.clone(), how(model, Some(address)));
        let performax = open(Model::Pmx2ed, 0).await.unwrap();
        let commander = open(Model::Cmd4cr, 1).await.unwrap();
        let key = "V9".parse().unwrap();
        performax.write(&key, &Value::Number(5)).await.unwrap();
        commander.write(&key, &Value::Number(6)).await.unwrap();
        // Both talk at the same time.
        for _ in 0..5 {
            let (one, other) = tokio::join!(performax.status(), commander.status());
            assert_eq!((one.unwrap().axes.len(), other.unwrap().axes.len()), (2, 4));
        }
        assert_eq!(performax.read(&key).await.unwrap(), Value::Number(5));
        assert_eq!(commander.read(&key).await.unwrap(), Value::Number(6));
        let nobody = open(Model::Pmx2ed, 7).await.err();
        assert!(matches!(nobody, Some(Error::Wire(WireError::Timeout(_)))), "{nobody:?}");
        let other = open(Model::Cmd4cr, 0).await.err().map(|error| error.to_string());
        assert_eq!(other.as_deref(), Some("a pmx-2ed answers"));
    });
    server.stop().unwrap();
}

/// A wire on which nobody is waited for who is not there.
struct Hurried<W> {
    wire: W,
    /// Whether somebody will answer.
    answers: fn(&[u8]) -> bool,
}

impl<W: Wire> Wire for Hurried<W> {
    fn exchange<'a>(&'a mut self, request: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>> {
        Box::pin(async move {
            if !(self.answers)(request) {
                return self.wire.exchange(request, end, patience.min(Duration::from_millis(1))).await;
            }
            self.wire.settle().await?;
            self.wire.exchange(request, end, PATIENCE).await
        })
    }
}

fn search(endpoint: &str, answers: fn(&[u8]) -> bool) -> Vec<Found> {
    let address = endpoint.strip_prefix("tcp:").unwrap();
    RUNTIME.block_on(async {
        let wire = host::tcp(address).await.unwrap();
        find(&Bus::new(Hurried { wire, answers })).await.unwrap()
    })
}

#[test]
fn everybody_on_a_bus_is_found() {
    let (server, endpoint) = serve_bus(&[Model::Pmx2ed, Model::Cmd4cr]);
    let answers = |request: &[u8]| request.starts_with(b"@00") || request.starts_with(b"@01");
    let expected = [found(0, Model::Pmx2ed, "V128BL"), found(1, Model::Cmd4cr, "V126BL")];
    assert_eq!(search(&endpoint, answers), expected);
    server.stop().unwrap();

    let (server, endpoint) = serve_bus(&[Model::Pd42, Model::Pd42]);
    RUNTIME.block_on(async {
        let wire = host::tcp(own(&server, 1).strip_prefix("tcp:").unwrap()).await.unwrap();
        let module = Controller::open(Bus::new(wire), how(Model::Pd42, None)).await.unwrap();
        module.write(&"GP66".parse().unwrap(), &Value::Number(7)).await.unwrap();
    });
    let answers = |request: &[u8]| matches!(request, [1 | 7, 136, ..]);
    let expected = [1, 7].map(|address| found(address, Model::Pd42, "1140V1.47"));
    assert_eq!(search(&endpoint, answers), expected);
    server.stop().unwrap();
}

#[test]
fn a_terminal_is_a_serial_port() {
    let link = directory().join("port");
    let mut config = device(Model::Pmx2ed, [-1000, 1000]);
    config.listen = vec![format!("pty:{}", link.display()).parse().unwrap()];
    let (server, _) = serve(vec![config]);
    RUNTIME.block_on(async {
        let bus = Bus::new(host::serial(&link, 9600).unwrap());
        let unit = Controller::open(bus, how(Model::Pmx2ed, None)).await.unwrap();
        unit.act(&Action::SetPosition { axis: "Y".into(), value: 12 }).await.unwrap();
        assert_eq!(unit.status().await.unwrap().axes["Y"].position, 12);
        assert!(host::serial("/nowhere", 9600).is_err());
    });
    server.stop().unwrap();
}

#[test]
fn half_a_line_of_somebody_else_does_no_harm() {
    let (server, _) = serve(vec![device(Model::Pmx2ed, [-1_000_000, 1_000_000])]);
    let endpoint = &server.ready()[0].1;
    RUNTIME.block_on(async {
        let mut other = tokio::net::TcpStream::connect(endpoint.strip_prefix("tcp:").unwrap()).await.unwrap();
        other.write_all(b"X100").await.unwrap();
        tokio::time::sleep(Duration::from_millis(50)).await;
        let bus = Bus::new(host::tcp(endpoint.strip_prefix("tcp:").unwrap()).await.unwrap());
        let unit = Controller::open(bus, how(Model::Pmx2ed, None)).await.unwrap();
        assert_eq!(unit.status().await.unwrap().axes["X"].state, "idle");
    });
    server.stop().unwrap();
}

#[test]
fn a_server_that_goes_is_noticed() {
    let stand = Stand::new(Model::Pd42);
    let Stand { server, controller, .. } = stand;
    server.stop().unwrap();
    let lost = RUNTIME.block_on(controller.status());
    assert!(matches!(lost, Err(Error::Wire(WireError::Closed | WireError::System(_)))), "{lost:?}");
}

/// A controller behind a pipe whose other end is ours.
fn pipe(model: Model) -> (Controller, DuplexStream) {
    let (near, far) = tokio::io::duplex(1000);
    (Controller::new(Bus::new(host::StreamWire::new(near)), how(model, None)), far)
}

/// What was asked.
async fn heard(far: &mut DuplexStream) -> String {
    let mut bytes = [0; 100];
    let count = timeout(Duration::from_secs(5), far.read(&mut bytes)).await.expect("a request").unwrap();
    bytes[..count].escape_ascii().to_string()
}

#[test]
fn a_late_reply_is_nobodys() {
    RUNTIME.block_on(async {
        let (unit, mut far) = pipe(Model::Pmx2ed);
        let key = "V1".parse().unwrap();
        let answers = async {
            // The first reply comes in two halves, with the line feed of a converter behind it.
            assert_eq!(heard(&mut far).await, "V1\\r");
            far.write_all(b"1").await.unwrap();
            tokio::time::sleep(Duration::from_millis(20)).await;
            far.write_all(b"0\r\n").await.unwrap();
            assert_eq!(heard(&mut far).await, "V1\\r");
            far.write_all(b"11\r\n").await.unwrap();
            // The third is late; the question comes again.
            assert_eq!(heard(&mut far).await, "V1\\r");
            tokio::time::sleep(Duration::from_millis(1020)).await;
            far.write_all(b"12\r").await.unwrap();
            assert_eq!(heard(&mut far).await, "V1\\r");
            far.write_all(b"13\r").await.unwrap();
        };
        let asks = async {
            for expected in [10, 11, 13] {
                assert_eq!(unit.read(&key).await.unwrap(), Value::Number(expected));
            }
        };
        tokio::join!(answers, asks);
    });
}

#[test]
fn damaged_frames() {
    RUNTIME.block_on(async {
        let (module, mut far) = pipe(Model::Pd42);
        let good = [2, 1, 100, 6, 0, 0, 0, 5, 114];
        let request = "\\x01\\x06\\x01\\x00\\x00\\x00\\x00\\x00\\x08";
        let answers = async {
            // A byte that fell over on its way here: the question comes again.
            assert_eq!(heard(&mut far).await, request);
            far.write_all(&[2, 1, 100, 6, 0, 0, 0, 4, 114]).await.unwrap();
            assert_eq!(heard(&mut far).await, request);
            far.write_all(&good).await.unwrap();
            // One that fell over on its way there: nothing was done, so even a command comes again.
            let mst = "\\x01\\x03\\x00\\x00\\x00\\x00\\x00\\x00\\x04";
            assert_eq!(heard(&mut far).await, mst);
            far.write_all(&[2, 1, 1, 0, 0, 0, 0, 0, 4]).await.unwrap();
            assert_eq!(heard(&mut far).await, mst);
            far.write_all(&[2, 1, 100, 3, 0, 0, 0, 0, 106]).await.unwrap();
            // The answer to another question.
            assert_eq!(heard(&mut far).await, mst);
            far.write_all(&good).await.unwrap();
        };
        let asks = async {
            assert_eq!(module.read(&"AP1.0".parse().unwrap()).await.unwrap(), Value::Number(5));
            module.act(&Action::Stop { axis: None }).await.unwrap();
            let strange = module.act(&Action::Stop { axis: None }).await;
            assert!(matches!(strange, Err(Error::Malformed { .. })), "{strange:?}");
        };
        tokio::join!(answers, asks);
    });
}
