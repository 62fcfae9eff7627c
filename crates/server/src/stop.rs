//! How every thread learns that it is over: a pipe whose far end is closed.

use crate::Error;
use rustix::{
    event::{PollFd, PollFlags, Timespec, poll},
    io::{Errno, FdFlags},
};
use std::{
    os::fd::{AsFd, BorrowedFd, OwnedFd},
    sync::Arc,
    time::Duration,
};

/// Dropping it tells everybody who watches.
pub(crate) struct Stop {
    watched: Watch,
    _held: OwnedFd,
}

impl Stop {
    pub fn new() -> Result<Self, Error> {
        let open = || {
            let (watched, held) = rustix::pipe::pipe()?;
            rustix::io::fcntl_setfd(&watched, FdFlags::CLOEXEC)?;
            rustix::io::fcntl_setfd(&held, FdFlags::CLOEXEC)?;
            Ok((watched, held))
        };
        let (watched, held) = open().map_err(|errno: Errno| Error::system("pipe")(errno.into()))?;
        Ok(Self { watched: Watch(Arc::new(watched)), _held: held })
    }

    pub fn watch(&self) -> Watch {
        self.watched.clone()
    }
}

/// Shows whether it is over.
#[derive(Clone)]
pub(crate) struct Watch(Arc<OwnedFd>);

impl Watch {
    /// Waits until it is over, but no longer than `timeout`, and says whether it is.
    pub fn within(&self, timeout: Option<Duration>) -> bool {
        !matches!(self.or_readable(None, timeout), Waited::Other)
    }

    /// Waits until it is over, `other` can be read, or the time is up.
    pub fn or_readable(&self, other: Option<BorrowedFd<'_>>, timeout: Option<Duration>) -> Waited {
        let mine = PollFd::from_borrowed_fd(self.0.as_fd(), PollFlags::IN);
        let other = other.map(|fd| PollFd::from_borrowed_fd(fd, PollFlags::IN));
        let mut waits = [mine.clone(), other.clone().unwrap_or(mine)];
        let count = 1 + usize::from(other.is_some());
        let timeout = timeout.map(|span| Timespec {
            tv_sec: i64::try_from(span.as_secs()).unwrap_or(i64::MAX),
            tv_nsec: span.subsec_nanos().into(),
        });
        match poll(&mut waits[..count], timeout.as_ref()) {
            Ok(_) if !waits[0].revents().is_empty() => Waited::Over,
            Ok(_) | Err(Errno::INTR | Errno::AGAIN) => Waited::Other,
            Err(_) => Waited::Over,
        }
    }
}

/// What ended a wait.
pub(crate) enum Waited {
    /// It is over.
    Over,
    /// Something can be read, the time is up, or nothing in particular.
    Other,
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn watchers_wake_at_the_end() {
        let stop = Stop::new().unwrap();
        let watch = stop.watch();
        assert!(!watch.within(Some(Duration::from_millis(5))));
        let thread = std::thread::spawn(move || watch.within(Some(Duration::from_secs(30))));
        let start = Instant::now();
        drop(stop);
        assert!(thread.join().unwrap());
        assert!(start.elapsed() < Duration::from_secs(10));
    }
}
