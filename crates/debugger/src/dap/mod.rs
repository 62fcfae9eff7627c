//! The debugger that editors speak to: the Debug Adapter Protocol.
//!
//! <https://microsoft.github.io/debug-adapter-protocol/specification>. One session: a request comes in, is
//! answered, and what follows from it goes out as events. While the program runs only requests that stop it are
//! heard, the others wait.

mod capabilities;
mod messages;
mod session;
mod variables;

pub use messages::Launch;

use crate::{
    Debugger,
    wire::{self, WireError},
};
use messages::Request;
use session::Session;
use std::{
    io::{BufRead, Write},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    thread,
};

/// Requests that come in while the program runs, and stop it.
const STOPPING: [&str; 3] = ["pause", "terminate", "disconnect"];

/// Speaks with an editor until it says good-bye. `launch` makes what it wants to be debugged.
///
/// # Errors
/// [`WireError`].
pub fn serve(
    mut input: impl BufRead + Send + 'static,
    output: impl Write,
    launch: impl FnMut(&Launch) -> Result<Debugger, String>,
) -> Result<(), WireError> {
    let interrupt: Arc<AtomicBool> = Arc::default();
    let (sender, receiver) = mpsc::channel();
    let stopping = interrupt.clone();
    thread::spawn(move || {
        loop {
            let request = wire::read(&mut input);
            if let Ok(Some(Request { command, .. })) = &request
                && STOPPING.contains(&command.as_str())
            {
                stopping.store(true, Ordering::Relaxed);
            }
            let ends = !matches!(request, Ok(Some(_)));
            if sender.send(request).is_err() || ends {
                return;
            }
        }
    });
    let mut session = Session::new(output, launch, interrupt);
    // The thread has gone where nothing comes any more.
    while let Ok(request) = receiver.recv() {
        match request? {
            Some(request) if session.answer(&request)? => {}
            _ => break,
        }
    }
    Ok(())
}
