//! Files that a task can wait for.

use std::{
    io,
    os::fd::{AsFd, AsRawFd},
};
use tokio::io::{Interest, unix::AsyncFd};

/// Lets tasks of the present event loop wait until a file is ready.
///
/// # Errors
/// The system refuses.
#[expect(deprecated, reason = "what replaces it is unsafe; it only asks for the file that `AsFd` promises")]
pub(crate) fn watch<T: AsFd + AsRawFd>(file: T, interest: Interest) -> io::Result<AsyncFd<T>> {
    AsyncFd::with_interest(file, interest)
}
