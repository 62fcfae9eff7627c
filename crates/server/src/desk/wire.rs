//! The wire to a virtual device in this process: its bytes go where those of any other client go.

use crate::{
    endpoint::Sink,
    unit::{Sent, Unit},
};
use devices::Port;
use host::{End, MAX_REPLY_BYTES, Pending, Wire, WireError};
use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};
use tokio::{sync::Notify, time::timeout};

/// A client of a device at one of its ports.
pub(super) struct UnitWire {
    unit: Arc<Unit>,
    port: Port,
    late: Arc<Late>,
}

impl UnitWire {
    /// Plugs a client into a port.
    pub fn new(unit: Arc<Unit>, port: Port) -> Self {
        Self { unit, port, late: Arc::default() }
    }

    fn sink(&self) -> Arc<dyn Sink> {
        Arc::clone(&self.late) as Arc<dyn Sink>
    }

    async fn ask(&self, request: &[u8], end: End) -> Result<Vec<u8>, WireError> {
        self.late.bytes().clear();
        let mut sent: Vec<Sent> = Vec::new();
        self.unit.turn().exchange(self.port, request, &self.sink(), &mut sent);
        let mut reply = Vec::new();
        for part in sent {
            part.pause().await;
            reply.extend(part.bytes);
        }
        loop {
            if let Some(length) = end.find(&reply) {
                reply.truncate(length);
                return Ok(reply);
            }
            if reply.len() >= MAX_REPLY_BYTES {
                return Err(WireError::Endless);
            }
            let more = self.late.came.notified();
            let late = std::mem::take(&mut *self.late.bytes());
            if late.is_empty() {
                more.await;
            }
            reply.extend(late);
        }
    }
}

impl Wire for UnitWire {
    fn exchange<'a>(&'a mut self, request: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>> {
        Box::pin(async move {
            let reply = timeout(patience, self.ask(request, end)).await;
            reply.unwrap_or(Err(WireError::Timeout(patience)))
        })
    }
}

impl Drop for UnitWire {
    fn drop(&mut self) {
        self.unit.hang_up(self.port, &self.sink());
    }
}

/// What a device says later, by itself or because its wire is slow.
#[derive(Default)]
struct Late {
    bytes: Mutex<Vec<u8>>,
    came: Notify,
}

impl Late {
    fn bytes(&self) -> MutexGuard<'_, Vec<u8>> {
        self.bytes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Sink for Late {
    fn push(&self, bytes: &[u8]) {
        let mut late = self.bytes();
        let room = MAX_REPLY_BYTES.saturating_sub(late.len());
        late.extend_from_slice(&bytes[..room.min(bytes.len())]);
        drop(late);
        self.came.notify_one();
    }
}
