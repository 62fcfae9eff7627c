//! A pseudo-terminal: what a program takes for a serial port.
//!
//! Clients open and close it as often as they like. While none has it open the kernel reports a hang-up
//! at every look, so it is then only looked at now and then. What a client leaves behind (replies it
//! did not read, its line settings, its exclusive lock) is cleared before the next one comes.

use super::{Sink, line::Line};
use crate::ready;
use rustix::{
    fs::{Mode, OFlags},
    io::{Errno, FdFlags},
    pty::OpenptFlags,
    termios::{OptionalActions, QueueSelector},
};
use std::{
    fs, io,
    os::{
        fd::{AsFd, OwnedFd},
        unix::{ffi::OsStringExt, fs::symlink},
    },
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};
use tokio::{io::Interest, task::yield_now, time::sleep};

/// How often a terminal that nobody has open is looked at.
const IDLE_LOOK: Duration = Duration::from_millis(10);

/// Most bytes read at once; more than the kernel buffers.
const READ_BYTES: usize = 4096;

/// A terminal and the link to it.
pub(crate) struct Pty {
    terminal: Terminal,
    link: Link,
}

impl Pty {
    /// Opens a terminal and makes `path` a symbolic link to it.
    pub fn open(path: &Path) -> io::Result<Self> {
        let terminal = Terminal::open()?;
        let link = Link::create(path, &terminal.name)?;
        Ok(Self { terminal, link })
    }

    /// Serves clients for ever, one after the other.
    pub async fn serve(mut self, line: Arc<Line>) {
        loop {
            match self.session(&line).await {
                Ended::Closed if self.terminal.clear().is_ok() => {}
                // Somebody locked it and left, or it is broken: the next client gets a new one.
                Ended::Closed | Ended::Failed => match self.renew() {
                    Ok(()) => {}
                    Err(error) => {
                        eprintln!("warning: {}: {error}", self.link.path.display());
                        return;
                    }
                },
            }
        }
    }

    /// From nobody there until the client has closed.
    async fn session(&self, line: &Arc<Line>) -> Ended {
        let master = &self.terminal.master;
        let sink = Arc::new(MasterSink(Arc::clone(master)));
        let mut client = line.client(sink.clone());
        let (mut open, mut watched) = (false, None);
        loop {
            let heard = {
                let mut bytes = [0; READ_BYTES];
                let heard = rustix::io::read(master, &mut bytes);
                if let Ok(length @ 1..) = heard {
                    client.exchange(&bytes[..length]);
                }
                heard
            };
            match heard {
                Ok(0) | Err(Errno::IO) if open => return Ended::Closed,
                // A closed terminal is always ready, so only the time ends that wait.
                Ok(0) | Err(Errno::IO) => {
                    sleep(IDLE_LOOK).await;
                    continue;
                }
                Ok(_) => {
                    open = true;
                    for reply in client.replies() {
                        reply.pause().await;
                        sink.push(&reply.bytes);
                    }
                    yield_now().await;
                    continue;
                }
                Err(Errno::AGAIN | Errno::INTR) => open = true,
                Err(_) => return Ended::Failed,
            }
            let fresh = || ready::watch(Arc::clone(master), Interest::READABLE);
            let Ok(master) = watched.take().map_or_else(fresh, Ok) else { return Ended::Failed };
            let Ok(mut ready) = master.readable().await else { return Ended::Failed };
            let hung_up = ready.ready().is_read_closed();
            ready.clear_ready();
            drop(ready);
            // A hang-up stays known for good, but somebody may have opened it since.
            watched = Some(master).filter(|_| !hung_up);
        }
    }

    fn renew(&mut self) -> io::Result<()> {
        let terminal = Terminal::open()?;
        self.link.point(&terminal.name)?;
        self.terminal = terminal;
        Ok(())
    }
}

enum Ended {
    Closed,
    Failed,
}

/// The master's end of a pseudo-terminal.
struct Terminal {
    master: Arc<OwnedFd>,
    name: PathBuf,
}

impl Terminal {
    fn open() -> Result<Self, Errno> {
        let master = rustix::pty::openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        rustix::io::fcntl_setfd(&master, FdFlags::CLOEXEC)?;
        rustix::pty::grantpt(&master)?;
        rustix::pty::unlockpt(&master)?;
        rustix::io::ioctl_fionbio(&master, true)?;
        let name = rustix::pty::ptsname(&master, Vec::new())?;
        let name = PathBuf::from(std::ffi::OsString::from_vec(name.into_bytes()));
        let terminal = Self { master: Arc::new(master), name };
        terminal.clear()?;
        Ok(terminal)
    }

    /// Makes the client's end as new: raw, unlocked and empty.
    fn clear(&self) -> Result<(), Errno> {
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC | OFlags::NONBLOCK;
        let slave = rustix::fs::open(&self.name, flags, Mode::empty())?;
        rustix::termios::ioctl_tiocnxcl(&slave)?;
        let mut settings = rustix::termios::tcgetattr(&slave)?;
        settings.make_raw();
        rustix::termios::tcsetattr(&slave, OptionalActions::Now, &settings)?;
        rustix::termios::tcflush(&slave, QueueSelector::IFlush)
    }
}

/// Writes to whoever has the terminal open. What its buffer has no room for is lost, as on a serial line.
struct MasterSink(Arc<OwnedFd>);

impl Sink for MasterSink {
    fn push(&self, bytes: &[u8]) {
        let _ = rustix::io::write(self.0.as_fd(), bytes);
    }
}

/// A symbolic link of our own.
struct Link {
    path: PathBuf,
    target: PathBuf,
}

impl Link {
    /// Makes the link. Only a link that points nowhere, or to `target` already, is replaced.
    fn create(path: &Path, target: &Path) -> io::Result<Self> {
        let mut link = Self { path: path.to_owned(), target: PathBuf::new() };
        match fs::symlink_metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
            Ok(data) if data.is_symlink() && (!path.exists() || fs::read_link(path)? == target) => {}
            Ok(_) => {
                let why = "exists and is not a link left over from an earlier run";
                return Err(io::Error::new(io::ErrorKind::AlreadyExists, why));
            }
        }
        link.point(target)?;
        Ok(link)
    }

    /// Points it elsewhere, in one step, so that there is no moment without a link.
    fn point(&mut self, target: &Path) -> io::Result<()> {
        let mut fresh = self.path.clone().into_os_string();
        fresh.push(format!(".{}", std::process::id()));
        symlink(target, &fresh)?;
        if let Err(error) = fs::rename(&fresh, &self.path) {
            let _ = fs::remove_file(&fresh);
            return Err(error);
        }
        self.target = target.to_owned();
        Ok(())
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        if fs::read_link(&self.path).is_ok_and(|target| target == self.target) {
            let _ = fs::remove_file(&self.path);
        }
    }
}
