//! How threads and tasks learn that it is over: a pipe whose far end is closed.

use crate::{Error, ready};
use rustix::{
    event::{PollFd, PollFlags, Timespec, poll},
    io::{Errno, FdFlags},
};
use std::{
    io,
    os::fd::{AsFd, OwnedFd},
    sync::Arc,
    time::Duration,
};
use tokio::io::Interest;

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
    pub fn within(&self, timeout: Duration) -> bool {
        let timeout = Timespec {
            tv_sec: i64::try_from(timeout.as_secs()).unwrap_or(i64::MAX),
            tv_nsec: timeout.subsec_nanos().into(),
        };
        match poll(&mut [PollFd::from_borrowed_fd(self.0.as_fd(), PollFlags::IN)], Some(&timeout)) {
            Ok(0) | Err(Errno::INTR | Errno::AGAIN) => false,
            Ok(_) | Err(_) => true,
        }
    }

    /// Waits until it is over.
    ///
    /// # Errors
    /// The system refuses to wait for it.
    pub async fn over(self) -> io::Result<()> {
        ready::watch(self.0, Interest::READABLE)?.readable().await.map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn watchers_wake_at_the_end() {
        let stop = Stop::new().unwrap();
        let watch = stop.watch();
        assert!(!watch.within(Duration::from_millis(5)));
        let thread = std::thread::spawn(move || watch.within(Duration::from_secs(30)));
        let start = Instant::now();
        drop(stop);
        assert!(thread.join().unwrap());
        assert!(start.elapsed() < Duration::from_secs(10));
    }

    #[test]
    fn tasks_wake_at_the_end() {
        let stop = Stop::new().unwrap();
        let over = stop.watch().over();
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let thread = std::thread::spawn(move || runtime.block_on(over));
        drop(stop);
        thread.join().unwrap().unwrap();
    }
}
