//! The host's side of a conversation: one command, one reply.

use super::{ApiError, Packet, unframe};
use crate::performax::Reply;
use core::fmt::Write;

/// How long a reply may take before it counts as lost. Typical are a few milliseconds (manual, 3.1.2).
pub const REPLY_TIME_OUT_MS: u64 = 1_000;

/// What goes on over an open handle. The owner moves the reports and knows the time, in milliseconds from
/// any beginning:
///
/// 1. What can be read at once goes to [`receive`](Self::receive): it is late and is dropped, so that no
///    command gets the reply to the one before.
/// 2. [`send`](Self::send) gives the report to be written.
/// 3. Until [`deadline_ms`](Self::deadline_ms), whatever is read goes to `receive`; then [`poll`](Self::poll).
#[derive(Clone, Debug, Default)]
pub struct Exchange {
    deadline_ms: Option<u64>,
}

impl Exchange {
    /// One in which nothing has been said.
    pub const fn new() -> Self {
        Self { deadline_ms: None }
    }

    /// The report of a command, whose reply is waited for from now on.
    ///
    /// # Errors
    /// [`ApiError::Protected`] while the reply to another one is still to come; [`ApiError::Parameter`] if the
    /// command is empty, longer than 63 characters or no printable ASCII.
    pub fn send(&mut self, command: &str, now_ms: u64) -> Result<Packet, ApiError> {
        if self.deadline_ms.is_some() {
            return Err(ApiError::Protected);
        }
        if command.is_empty() {
            return Err(ApiError::Parameter);
        }
        let packet = Packet::encode(command).map_err(|_| ApiError::Parameter)?;
        self.deadline_ms = Some(now_ms.saturating_add(REPLY_TIME_OUT_MS));
        Ok(packet)
    }

    /// A report came, with or without its ID. It is the reply if one is waited for, and nothing otherwise.
    ///
    /// # Errors
    /// Of a report that is waited for: [`ApiError::ReportId`], [`ApiError::ReportSize`], and
    /// [`ApiError::Read`] if it is no text. The command is over then.
    pub fn receive(&mut self, report: &[u8]) -> Result<Option<Reply>, ApiError> {
        if self.deadline_ms.take().is_none() {
            return Ok(None);
        }
        let packet = unframe(report)?;
        let text = packet.decode().map_err(|_| ApiError::Read)?;
        let mut reply = Reply::new();
        assert!(reply.write_str(text).is_ok(), "a reply has room for a packet");
        Ok(Some(reply))
    }

    /// When the reply is overdue; `None` if none is waited for.
    pub const fn deadline_ms(&self) -> Option<u64> {
        self.deadline_ms
    }

    /// Time has passed.
    ///
    /// # Errors
    /// [`ApiError::TimeOut`] if the reply is overdue. It is no longer waited for.
    pub fn poll(&mut self, now_ms: u64) -> Result<(), ApiError> {
        self.deadline_ms.take_if(|deadline| *deadline <= now_ms).map_or(Ok(()), |_| Err(ApiError::TimeOut))
    }

    /// Gives up a reply that is waited for, as when writing or reading failed.
    pub const fn cancel(&mut self) {
        self.deadline_ms = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hid::frame;

    /// Sends a command, and takes what comes back for it.
    #[track_caller]
    fn check(report: &[u8], expected: Result<&str, ApiError>) {
        let mut exchange = Exchange::new();
        assert_eq!(exchange.send("PX", 5), Ok(Packet::encode("PX").unwrap()));
        let reply = exchange.receive(report).map(|reply| reply.expect("it was asked for"));
        assert_eq!(reply.as_ref().map(Reply::as_str).map_err(|error| *error), expected);
        assert_eq!(exchange.deadline_ms(), None, "over, well or not");
    }

    #[test]
    fn replies() {
        let packet = Packet::encode("-1000").unwrap();
        check(&packet.0, Ok("-1000"));
        check(&frame(&packet), Ok("-1000"));
        check(&Packet::encode("").unwrap().0, Ok(""));
        let full = "?".repeat(63);
        check(&Packet::encode(&full).unwrap().0, Ok(&full));
        check(&[b'?'; 64], Err(ApiError::Read));
        check(&[0xFF; 64], Err(ApiError::Read));
        check(&[1; 65], Err(ApiError::ReportId));
        check(b"OK\0", Err(ApiError::ReportSize));
    }

    #[test]
    fn commands_that_are_none() {
        let mut exchange = Exchange::new();
        for command in ["", "ID\r", "X1000\0", "µ", &"V".repeat(64)] {
            assert_eq!(exchange.send(command, 0), Err(ApiError::Parameter), "{command:?}");
            assert_eq!(exchange.deadline_ms(), None);
        }
        assert!(exchange.send(&"V".repeat(63), 0).is_ok());
    }

    #[test]
    fn one_at_a_time() {
        let mut exchange = Exchange::new();
        assert_eq!(exchange.receive(&[0; 64]), Ok(None), "nobody asked");
        assert_eq!(exchange.receive(&[1; 7]), Ok(None));
        exchange.send("PX", 0).unwrap();
        assert_eq!(exchange.send("PY", 0), Err(ApiError::Protected));
        assert!(exchange.receive(&[0; 64]).unwrap().is_some());
        exchange.send("PY", 0).unwrap();
        exchange.cancel();
        assert_eq!(exchange.receive(&[0; 64]), Ok(None));
    }

    #[test]
    fn lost_replies() {
        let mut exchange = Exchange::new();
        assert_eq!(exchange.poll(u64::MAX), Ok(()));
        exchange.send("PX", 100).unwrap();
        assert_eq!(exchange.deadline_ms(), Some(1100));
        assert_eq!(exchange.poll(1099), Ok(()));
        assert_eq!(exchange.poll(1100), Err(ApiError::TimeOut));
        assert_eq!(exchange.poll(1100), Ok(()), "it is said once");
        let late = Packet::encode("7").unwrap();
        assert_eq!(exchange.receive(&late.0), Ok(None), "late");
        exchange.send("PY", 2000).unwrap();
        let reply = exchange.receive(&Packet::encode("8").unwrap().0).unwrap().unwrap();
        assert_eq!(reply.as_str(), "8");
    }
}
