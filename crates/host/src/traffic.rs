//! What went over the wire, for people who look on.

use serde::Serialize;
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Instant,
};
use tokio::task_local;
use ts_rs::TS;
use utoipa::ToSchema;

task_local! {
    /// Whether what a task says now is of no interest to whoever looks for commands.
    static POLLING: bool;
}

/// Asks something that is asked over and over, and marks it so in the log.
pub async fn polling<T>(question: impl Future<Output = T>) -> T {
    POLLING.scope(true, question).await
}

/// How many messages are remembered.
pub const TRAFFIC_LENGTH: usize = 2000;

/// A request or a reply.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Traffic {
    /// When, in seconds since the wire was opened.
    pub at: f64,
    /// Whether the host sent it.
    pub out: bool,
    /// Its bytes, in hexadecimal.
    pub hex: String,
    /// What it says.
    pub text: String,
    /// Whether it was asked to see what the controller is doing, over and over, and not because somebody wanted
    /// something.
    pub polled: bool,
}

/// The newest messages of a wire. Its clones are the same log.
#[derive(Clone, Debug)]
pub struct TrafficLog {
    begin: Instant,
    ring: Arc<Mutex<Ring>>,
}

#[derive(Debug, Default)]
struct Ring {
    messages: VecDeque<Traffic>,
    /// How many messages there were before the first one that is still there.
    forgotten: u64,
}

impl Default for TrafficLog {
    fn default() -> Self {
        Self { begin: Instant::now(), ring: Arc::default() }
    }
}

impl TrafficLog {
    /// The messages from a number on, counted from 0, and the number that the next one will have. Those that are
    /// forgotten are left out.
    pub fn since(&self, number: u64) -> (Vec<Traffic>, u64) {
        let ring = self.ring();
        let skip = number.saturating_sub(ring.forgotten) as usize;
        let messages = ring.messages.iter().skip(skip).cloned().collect();
        (messages, ring.forgotten + ring.messages.len() as u64)
    }

    /// Seconds since the wire was opened.
    pub fn seconds(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    /// One more.
    pub(crate) fn note(&self, out: bool, bytes: &[u8], text: String) {
        let polled = POLLING.try_with(|polling| *polling).unwrap_or(false);
        let message = Traffic { at: self.seconds(), out, hex: hex(bytes), text, polled };
        let mut ring = self.ring();
        if ring.messages.len() == TRAFFIC_LENGTH {
            ring.messages.pop_front();
            ring.forgotten += 1;
        }
        ring.messages.push_back(message);
    }

    fn ring(&self) -> MutexGuard<'_, Ring> {
        // A message is there or not, whoever panicked.
        self.ring.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Bytes as `01 0A FF`.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let words: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_in_hexadecimal() {
        assert_eq!(hex(&[]), "");
        assert_eq!(hex(&[1, 10, 255]), "01 0A FF");
    }

    #[tokio::test]
    async fn what_is_asked_over_and_over_is_marked() {
        let log = TrafficLog::default();
        polling(async { log.note(true, b"ID\r", "ID".into()) }).await;
        log.note(true, b"PX\r", "PX".into());
        let marks: Vec<_> = log.since(0).0.iter().map(|it| it.polled).collect();
        assert_eq!(marks, [true, false]);
    }

    #[test]
    fn the_newest_are_remembered() {
        let log = TrafficLog::default();
        let texts = |number| {
            let (messages, next) = log.since(number);
            (messages.into_iter().map(|it| it.text).collect::<Vec<_>>(), next)
        };
        assert_eq!(texts(0), (vec![], 0));
        log.note(true, b"ID\r", "ID".into());
        log.note(false, b"01\r", "01".into());
        assert_eq!(texts(0), (vec!["ID".into(), "01".into()], 2));
        assert_eq!(texts(1), (vec!["01".into()], 2));
        assert_eq!(texts(2), (vec![], 2));
        // A number from a wire that is no more.
        assert_eq!(texts(99), (vec![], 2));
        for number in 2..=TRAFFIC_LENGTH {
            log.note(true, &[], number.to_string());
        }
        let (messages, next) = texts(0);
        assert_eq!((messages.len(), next), (TRAFFIC_LENGTH, TRAFFIC_LENGTH as u64 + 1));
        assert_eq!(messages[0], "01");
        assert_eq!(texts(next - 1).0, [TRAFFIC_LENGTH.to_string()]);
    }
}
