//! The WebSocket that sends a device's state thirty times a second.

use super::view::View;
use crate::desk::Seat;
use axum::extract::ws::{Message, WebSocket};
use std::{sync::Arc, time::Duration};
use tokio::time::{MissedTickBehavior, interval};

/// Between two states.
const PERIOD: Duration = Duration::from_nanos(1_000_000_000 / 30);

/// A client that takes no state for this long is dropped.
const SEND_TIMEOUT: Duration = Duration::from_secs(5);

/// Sends the state of a device until the client leaves, or the device.
pub(super) async fn stream(mut socket: WebSocket, seat: Arc<Seat>) {
    let mut ticks = interval(PERIOD);
    // A client that is slow gets fewer states, not old ones.
    ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
    while !seat.hub.is_closed() {
        tokio::select! {
            _ = ticks.tick() => {
                let text = serde_json::to_string(&View::of(&seat)).expect("a state becomes JSON");
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
