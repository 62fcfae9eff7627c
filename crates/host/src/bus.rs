//! A wire with everybody who talks over it: one request at a time, all of them noted.

use crate::traffic::{TrafficLog, hex};
use crate::wire::{End, Wire, WireError};
use std::{
    collections::BTreeMap,
    sync::{
        Arc, Weak,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};
use tokio::sync::{Mutex, MutexGuard};

/// How long a reply may take. A module may pause a quarter of a second (TMCL global parameter 75), a slow line takes
/// another tenth.
pub(crate) const PATIENCE: Duration = Duration::from_secs(1);

/// How long a reply may take when much is written to flash.
pub(crate) const FLASH_PATIENCE: Duration = Duration::from_secs(5);

/// A wire that one or several controllers are reached by. Its clones are the same wire.
#[derive(Clone)]
pub struct Bus {
    line: Arc<Line>,
    traffic: TrafficLog,
}

struct Line {
    link: Mutex<Link>,
    /// The other side has gone, or the system has nothing more to do with it.
    broken: AtomicBool,
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
        let line = Line { link: Mutex::new(link), broken: AtomicBool::new(false) };
        Self { line: Arc::new(line), traffic: TrafficLog::default() }
    }

    /// What went over the wire.
    pub const fn traffic(&self) -> &TrafficLog {
        &self.traffic
    }

    /// Whether nothing will ever come over it again.
    fn is_broken(&self) -> bool {
        self.line.broken.load(Ordering::Relaxed)
    }

    /// The wire for oneself; others wait, in the order in which they came.
    pub(crate) async fn talk(&self) -> Talk<'_> {
        let Self { line, traffic } = self;
        Talk { link: line.link.lock().await, broken: &line.broken, traffic }
    }
}

/// Somebody has the wire for himself.
pub(crate) struct Talk<'a> {
    link: MutexGuard<'a, Link>,
    broken: &'a AtomicBool,
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
            let settled = self.link.wire.settle().await;
            settled.inspect_err(|error| self.judge(error))?;
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
            Err(error) => {
                self.traffic.note(false, &[], error.to_string());
                self.judge(error);
            }
        }
        reply
    }

    /// Whether an error is the end of the wire.
    fn judge(&self, error: &WireError) {
        if matches!(error, WireError::Closed | WireError::System(_)) {
            self.broken.store(true, Ordering::Relaxed);
        }
    }

    /// What came was no reply to what was asked: others may be on their way.
    pub fn doubt(&mut self) {
        self.link.unsure = true;
    }
}

/// The wires that are open, by name, so that controllers on one bus share it. A wire is closed when nobody uses it any
/// more.
#[derive(Default)]
pub struct Wires(Mutex<BTreeMap<String, (Weak<Line>, TrafficLog)>>);

impl Wires {
    /// None is open.
    pub const fn new() -> Self {
        Self(Mutex::const_new(BTreeMap::new()))
    }

    /// The wire of this name. It is opened unless somebody has it open and it works.
    ///
    /// # Errors
    /// It cannot be opened.
    pub async fn open<E>(&self, name: &str, open: impl AsyncFnOnce() -> Result<Bus, E>) -> Result<Bus, E> {
        let mut wires = self.0.lock().await;
        wires.retain(|_, (line, _)| line.strong_count() > 0);
        if let Some((line, traffic)) = wires.get(name)
            && let Some(line) = line.upgrade()
        {
            let bus = Bus { line, traffic: traffic.clone() };
            if !bus.is_broken() {
                return Ok(bus);
            }
        }
        // What is broken gives way, whoever still holds it.
        wires.remove(name);
        let bus = open().await?;
        wires.insert(name.to_owned(), (Arc::downgrade(&bus.line), bus.traffic.clone()));
        Ok(bus)
    }
}

/// Bytes for people: as text if they are, else in hexadecimal.
pub(crate) fn shown(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_end().chars().all(|letter| !letter.is_control()) => text.trim_end().to_owned(),
        _ => hex(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scripted::Script;
    use crate::{Controller, Error, Model, Settings, StreamWire};
    use std::convert::Infallible;

    #[tokio::test]
    async fn wires_are_shared_while_they_work() {
        let wires = Wires::default();
        let mut opened = 0;
        let mut open = async |name: &str| {
            let (near, far) = tokio::io::duplex(100);
            let mut is_new = false;
            let bus = wires.open(name, async || {
                is_new = true;
                Ok::<_, Infallible>(Bus::new(StreamWire::new(near)))
            });
            let bus = bus.await.unwrap_or_else(|never| match never {});
            opened += i32::from(is_new);
            (bus, far, opened)
        };
        let (first, far, count) = open("a").await;
        assert_eq!(count, 1);
        let (again, _, count) = open("a").await;
        assert_eq!(count, 1);
        let (_, _, count) = open("b").await;
        assert_eq!(count, 2);
        // Nobody has it any more.
        let (_, _, count) = open("b").await;
        assert_eq!(count, 3);
        drop(far);
        let settings = Settings { model: Model::Pmx2ed, address: None, bits: Vec::new() };
        let lost = Controller::open(first, settings).await.err();
        assert!(matches!(lost, Some(Error::Wire(WireError::Closed))), "{lost:?}");
        // One who has the broken one does not keep others from a new one.
        let (_, _, count) = open("a").await;
        assert_eq!(count, 4);
        drop(again);
    }

    #[tokio::test]
    async fn what_was_given_up_is_settled_first() {
        // A request that is dropped in the middle leaves a reply that is nobody's.
        let (near, mut far) = tokio::io::duplex(100);
        let bus = Bus::new(StreamWire::new(near));
        let ask = async |line: &[u8]| {
            let mut talk = bus.talk().await;
            talk.exchange(line, "", End::Line, PATIENCE, shown).await
        };
        let soon = Duration::from_millis(100);
        tokio::time::timeout(soon, ask(b"V1\r")).await.expect_err("nobody answers");
        tokio::io::AsyncWriteExt::write_all(&mut far, b"late\r").await.unwrap();
        let answers = async {
            tokio::time::sleep(soon).await;
            tokio::io::AsyncWriteExt::write_all(&mut far, b"mine\r").await.unwrap();
        };
        let (reply, ()) = tokio::join!(ask(b"V2\r"), answers);
        assert_eq!(reply.unwrap(), b"mine\r");
    }

    #[tokio::test]
    async fn everything_is_noted() {
        let script = Script::default().line("ID", "01").silence(b"VER\r");
        let bus = Bus::new(script.wire());
        let mut talk = bus.talk().await;
        talk.exchange(b"ID\r", "ID", End::Line, PATIENCE, shown).await.unwrap();
        talk.exchange(b"VER\r", "VER", End::Line, PATIENCE, shown).await.unwrap_err();
        let (traffic, _) = bus.traffic().since(0);
        let words: Vec<_> = traffic.iter().map(|it| (it.out, it.hex.as_str(), it.text.as_str())).collect();
        let expected = [
            (true, "49 44 0D", "ID"),
            (false, "30 31 0D", "01"),
            (true, "56 45 52 0D", "VER"),
            (false, "", "no reply within 1000 ms"),
        ];
        assert_eq!(words, expected);
        assert!(traffic.is_sorted_by_key(|it| it.at));
    }
}
