//! A controller on a stand: a virtual one in a server, and a host's end of its wire.

use crate::common::{PATIENCE, TOKEN, call, http_address, settings};
use host::{Action, AxisStatus, Bit, Bus, Controller, Error, Model, Settings, Status, Value};
use server::{Server, Token};
use sim::{AxisConfig, DeviceConfig};
use std::{
    net::SocketAddr,
    sync::LazyLock,
    time::{Duration, Instant},
};

/// How much faster than the wall clock devices go.
pub const SPEED: f64 = 20.0;

/// What all tests wait in.
pub static RUNTIME: LazyLock<tokio::runtime::Runtime> = LazyLock::new(|| {
    let mut builder = tokio::runtime::Builder::new_multi_thread();
    builder.worker_threads(1).enable_all().build().unwrap()
});

pub struct Stand {
    pub server: Server,
    http: SocketAddr,
    pub controller: Controller,
}

/// A device of a model whose axes have their limits here.
pub fn device(model: Model, limits: [i64; 2]) -> DeviceConfig {
    let model = devices::model(model.name()).unwrap();
    let mut config = DeviceConfig::new(model);
    config.name = "a".into();
    config.listen = vec!["tcp:127.0.0.1:0".parse().unwrap()];
    for axis in model.guide.axes {
        let [negative_limit, positive_limit] = limits;
        let usual = AxisConfig::of_model(model.name);
        config.axes.insert((*axis).into(), AxisConfig { negative_limit, positive_limit, ..usual });
    }
    config
}

/// A server that goes fast.
pub fn serve(devices: Vec<DeviceConfig>) -> (Server, SocketAddr) {
    let http = Some(server::HttpSettings::new("127.0.0.1:0", Token::chosen(TOKEN).unwrap()));
    let server = Server::start(server::Settings { http, speed: SPEED, ..settings(devices) }).unwrap();
    let address = http_address(&server);
    (server, address)
}

/// A wire to an endpoint as [`Server::ready`] names it.
pub fn bus(endpoint: &str) -> Bus {
    let address = endpoint.strip_prefix("tcp:").unwrap();
    Bus::new(RUNTIME.block_on(host::tcp(address)).unwrap())
}

/// How to talk to a controller of a model.
pub fn how(model: Model, address: Option<u8>) -> Settings {
    let bits = devices::model(model.name()).unwrap().guide.status_bits.iter();
    let bits = bits.map(|bit| Bit {
        number: bit.bit,
        name: bit.name.into(),
        is_error: bit.kind == devices::guide::BitKind::Error,
    });
    Settings { model, address, bits: bits.collect() }
}

impl Stand {
    /// One with its limits at a million.
    pub fn new(model: Model) -> Self {
        Self::with(model, device(model, [-1_000_000, 1_000_000]))
    }

    /// One of this configuration, with motors that have power.
    pub fn with(model: Model, config: DeviceConfig) -> Self {
        let (server, http) = serve(vec![config]);
        let bus = bus(&server.ready()[0].1);
        let controller = RUNTIME.block_on(Controller::open(bus, how(model, None))).unwrap();
        let stand = Self { server, http, controller };
        if model.actions().contains(&"power") {
            for axis in model.axes() {
                stand.act(Action::Power { axis: (*axis).into(), on: true });
            }
        }
        stand
    }

    pub fn stop(self) {
        self.server.stop().unwrap();
    }

    /// Calls the virtual device over HTTP.
    #[track_caller]
    pub fn call(&self, method: &str, path: &str, body: &str) {
        let (status, answer) = call(self.http, method, &format!("/api/devices/a/{path}"), body);
        assert_eq!(status, 204, "{method} {path}: {answer}");
    }

    /// The power goes and comes again.
    pub fn power_cycle(&self) {
        self.call("POST", "power-cycle", "");
    }

    pub fn status(&self) -> Status {
        RUNTIME.block_on(self.controller.status()).unwrap()
    }

    pub fn axis(&self, name: &str) -> AxisStatus {
        self.status().axes[name].clone()
    }

    #[track_caller]
    pub fn act(&self, action: Action) {
        if let Err(error) = RUNTIME.block_on(self.controller.act(&action)) {
            panic!("{action:?}: {error}");
        }
    }

    /// The words with which an action is refused.
    #[track_caller]
    pub fn refused(&self, action: Action) -> String {
        match RUNTIME.block_on(self.controller.act(&action)) {
            Err(Error::Refused { words, .. }) => words,
            other => panic!("{action:?}: {other:?}"),
        }
    }

    /// A line that is typed, and its reply.
    #[track_caller]
    pub fn says(&self, line: &str) -> String {
        RUNTIME.block_on(self.controller.terminal(line)).unwrap().reply
    }

    #[track_caller]
    pub fn read(&self, key: &str) -> Value {
        RUNTIME.block_on(self.controller.read(&key.parse().unwrap())).unwrap()
    }

    #[track_caller]
    pub fn write(&self, key: &str, value: Value) {
        if let Err(error) = RUNTIME.block_on(self.controller.write(&key.parse().unwrap(), &value)) {
            panic!("{key}: {error}");
        }
    }

    /// Waits until the status is so.
    #[track_caller]
    pub fn until(&self, what: &str, is_so: impl Fn(&Status) -> bool) -> Status {
        let start = Instant::now();
        loop {
            let status = self.status();
            if is_so(&status) {
                return status;
            }
            assert!(start.elapsed() < PATIENCE, "never: {what}: {status:#?}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Waits until an axis stands.
    #[track_caller]
    pub fn at_rest(&self, axis: &str) -> AxisStatus {
        self.until("at rest", |status| status.axes[axis].state == "idle").axes[axis].clone()
    }
}

/// Names and values.
pub fn targets(targets: &[(&str, i32)]) -> std::collections::BTreeMap<String, i32> {
    targets.iter().map(|(axis, target)| ((*axis).into(), *target)).collect()
}
