//! A wire with everybody who talks over it: one request at a time, all of them noted.

use crate::traffic::{TrafficLog, hex};
use crate::wire::{End, Wire, WireError};
use std::{sync::Arc, time::Duration};
use tokio::sync::{Mutex, MutexGuard};

/// How long a reply may take. A module may pause a quarter of a second (TMCL global parameter 75), a slow line takes
/// another tenth.
pub(crate) const PATIENCE: Duration = Duration::from_secs(1);

/// How long a reply may take when much is written to flash.
pub(crate) const FLASH_PATIENCE: Duration = Duration::from_secs(5);

/// A wire that one or several controllers are reached by. Its clones are the same wire.
#[derive(Clone)]
pub struct Bus {
    link: Arc<Mutex<Link>>,
    traffic: TrafficLog,
}

struct Link {
    wire: Box<dyn Wire>,
    /// A reply may still come that belongs to no request: one was given up, or whoever asked has gone.
    unsure: bool,
}

impl Bus {
    /// Takes a wire.
    pub fn new(wire: impl Wire + 'static) -> Self {
        // Somebody else may have talked over it before.
        let link = Link { wire: Box::new(wire), unsure: true };
        Self { link: Arc::new(Mutex::new(link)), traffic: TrafficLog::default() }
    }

    /// What went over the wire.
    pub const fn traffic(&self) -> &TrafficLog {
        &self.traffic
    }

    /// The wire for oneself; others wait, in the order in which they came.
    pub(crate) async fn talk(&self) -> Talk<'_> {
        Talk { link: self.link.lock().await, traffic: &self.traffic }
    }
}

/// Somebody has the wire for himself.
pub(crate) struct Talk<'a> {
    link: MutexGuard<'a, Link>,
    traffic: &'a TrafficLog,
}

impl Talk<'_> {
    /// A request and its reply, in bytes. `words` is what the request says, `read` what a reply does.
    pub async fn exchange(
        &mut self,
        request: &[u8],
        words: &str,
        end: End,
        patience: Duration,
        read: impl FnOnce(&[u8]) -> String,
    ) -> Result<Vec<u8>, WireError> {
        if self.link.unsure {
            self.link.wire.settle().await?;
        }
        // Until the reply is here it can be given up at any time.
        self.link.unsure = true;
        self.traffic.note(true, request, words.to_owned());
        let reply = self.link.wire.exchange(request, end, patience).await;
        match &reply {
            Ok(reply) => {
                self.link.unsure = false;
                if end != End::Silence {
                    self.traffic.note(false, reply, read(reply));
                }
            }
            Err(error) => self.traffic.note(false, &[], error.to_string()),
        }
        reply
    }

    /// What came was no reply to what was asked: others may be on their way.
    pub fn doubt(&mut self) {
        self.link.unsure = true;
    }
}

/// Bytes for people: as text if they are, else in hexadecimal.
pub(crate) fn shown(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_end().chars().all(|letter| !letter.is_control()) => text.trim_end().to_owned(),
        _ => hex(bytes),
    }
}
