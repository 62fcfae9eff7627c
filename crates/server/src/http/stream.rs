//! The WebSocket that sends a device's state thirty times a second.

use super::{Site, view::View};
use axum::extract::ws::{Message, WebSocket};
use std::{sync::Arc, time::Duration};
use tokio::time::{MissedTickBehavior, interval};

/// Between two states.
const PERIOD: Duration = Duration::from_nanos(1_000_000_000 / 30);

/// A client that takes no state for this long is dropped.
const SEND_TIMEOUT: Duration = Duration::from_secs(5);

/// Sends the state of the device with this number until the client leaves.
pub(super) async fn stream(mut socket: WebSocket, site: Arc<Site>, number: usize) {
    let (unit, endpoints) = &site.units[number];
    let mut ticks = interval(PERIOD);
    // A client that is slow gets fewer states, not old ones.
    ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
    loop {
        tokio::select! {
            _ = ticks.tick() => {
                let text = serde_json::to_string(&View::of(unit, endpoints)).expect("a state becomes JSON");
                let sent = tokio::time::timeout(SEND_TIMEOUT, socket.send(Message::text(text))).await;
                if !matches!(sent, Ok(Ok(()))) {
                    return;
                }
            }
            // Pings are answered by the library; anything else a client says is of no interest.
            message = socket.recv() => match message {
                Some(Ok(Message::Close(_))) | Some(Err(_)) | None => return,
                Some(Ok(_)) => {}
            }
        }
    }
}
