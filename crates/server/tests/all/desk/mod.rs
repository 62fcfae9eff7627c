//! What the page asks of the server, over HTTP and WebSocket, with all three controllers.

mod catalog;
mod coming;
mod held;
mod live;
mod parameters;
mod programs;
mod work;

use crate::common::{TOKEN, call, connect_ws, eventually, serve_http};
use serde_json::Value;
use server::Server;
use sim::DeviceConfig;
use std::net::SocketAddr;

/// A server with devices.
pub struct Rig {
    /// It runs.
    pub server: Server,
    /// Where its HTTP is.
    pub address: SocketAddr,
}

impl Rig {
    /// A device of each of these models, named like it, that nobody else talks to.
    pub fn new(models: &[&str]) -> Self {
        let device = |model: &&str| DeviceConfig::new(devices::model(model).unwrap());
        Self::with(models.iter().map(device).collect())
    }

    /// These devices.
    pub fn with(devices: Vec<DeviceConfig>) -> Self {
        let (server, address) = serve_http(devices);
        Self { server, address }
    }

    /// A call below `/api/devices/`.
    pub fn call(&self, method: &str, path: &str, body: &str) -> (u16, Value) {
        call(self.address, method, &format!("/api/devices/{path}"), body)
    }

    /// A call that gives something.
    #[track_caller]
    pub fn get(&self, path: &str) -> Value {
        let (status, answer) = self.call("GET", path, "");
        assert_eq!(status, 200, "GET {path}: {answer}");
        answer
    }

    /// A call that does something.
    #[track_caller]
    pub fn tell(&self, method: &str, path: &str, body: &str) {
        let (status, answer) = self.call(method, path, body);
        assert_eq!(status, 204, "{method} {path} {body}: {answer}");
    }

    /// A call that is refused in these words.
    #[track_caller]
    pub fn refused(&self, method: &str, path: &str, body: &str, expected: u16, words: &str) {
        let (status, answer) = self.call(method, path, body);
        let said = answer["error"].as_str().unwrap_or_default();
        assert_eq!((status, said), (expected, words), "{method} {path} {body}");
    }

    /// Waits until an axis of a device stands at a position.
    #[track_caller]
    pub fn arrives(&self, device: &str, axis: &str, position: i64) {
        eventually(&format!("{axis} at {position}"), || {
            let status = self.get(&format!("{device}/status"));
            let axis = &status["axes"][axis];
            axis["position"] == position && axis["speed"] == 0
        });
    }

    /// The WebSocket of a device, message by message.
    pub fn live(&self, device: &str) -> impl FnMut() -> Value + use<> {
        let mut socket = connect_ws(self.address, &format!("/api/devices/{device}/live?token={TOKEN}"));
        move || serde_json::from_str(&socket.read().unwrap().into_text().unwrap()).unwrap()
    }
}
