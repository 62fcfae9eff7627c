//! A wire that plays a conversation from a script.

use crate::wire::{End, Pending, Wire, WireError};
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex},
    time::Duration,
};

/// What is to be said, and what comes back; `None` if nothing does.
type Exchange = (Vec<u8>, Option<Vec<u8>>);

/// What is left of the conversation. Clones are the same one.
#[derive(Clone, Default)]
pub struct Script(Arc<Mutex<VecDeque<Exchange>>>);

impl Script {
    /// Expects bytes, and answers.
    pub fn bytes(self, request: &[u8], reply: &[u8]) -> Self {
        self.0.lock().unwrap().push_back((request.to_vec(), Some(reply.to_vec())));
        self
    }

    /// Expects a line, and answers one.
    pub fn line(self, request: &str, reply: &str) -> Self {
        self.bytes(format!("{request}\r").as_bytes(), format!("{reply}\r").as_bytes())
    }

    /// Expects lines `request>reply`, one after the other.
    pub fn lines(self, lines: &[&str]) -> Self {
        lines.iter().fold(self, |script, line| {
            let (request, reply) = line.split_once('>').expect("a request and a reply");
            script.line(request, reply)
        })
    }

    /// Expects bytes, and does not answer.
    pub fn silence(self, request: &[u8]) -> Self {
        self.0.lock().unwrap().push_back((request.to_vec(), None));
        self
    }

    /// Nothing more was to be said.
    #[track_caller]
    pub fn ends(&self) {
        let left = self.0.lock().unwrap();
        let words: Vec<_> = left.iter().map(|(request, _)| request.escape_ascii().to_string()).collect();
        assert_eq!(words, [""; 0], "not said");
    }

    /// The wire.
    pub fn wire(&self) -> impl Wire + 'static {
        Played(self.clone())
    }
}

struct Played(Script);

impl Wire for Played {
    fn exchange<'a>(&'a mut self, request: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>> {
        let next = self.0.0.lock().unwrap().pop_front();
        let said = request.escape_ascii().to_string();
        let (expected, reply) = next.unwrap_or_else(|| panic!("`{said}` is not in the script"));
        assert_eq!(said, expected.escape_ascii().to_string());
        Box::pin(async move {
            let mut reply = reply.ok_or(WireError::Timeout(patience))?;
            let length = end.find(&reply).ok_or(WireError::Timeout(patience))?;
            reply.truncate(length);
            Ok(reply)
        })
    }
}
