//! The signals that ask the process to end.

use crate::Error;
use tokio::{
    runtime::Runtime,
    signal::unix::{Signal, SignalKind, signal},
};

/// SIGINT and SIGTERM, caught.
pub struct Signals<'a> {
    runtime: &'a Runtime,
    interrupt: Signal,
    terminate: Signal,
}

impl<'a> Signals<'a> {
    pub(crate) fn catch(runtime: &'a Runtime) -> Result<Self, Error> {
        let _entered = runtime.enter();
        let catch = |kind| signal(kind).map_err(Error::system("signals"));
        Ok(Self {
            runtime,
            interrupt: catch(SignalKind::interrupt())?,
            terminate: catch(SignalKind::terminate())?,
        })
    }

    /// Waits for one of them.
    pub fn wait(&mut self) {
        let Self { runtime, interrupt, terminate } = self;
        runtime.block_on(async {
            tokio::select! {
                _ = interrupt.recv() => {}
                _ = terminate.recv() => {}
            }
        });
    }
}
