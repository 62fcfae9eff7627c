//! What a controller says of itself while somebody looks, over a WebSocket.

use super::{hold::Holder, hub::Watching, link::LinkState, seat::Seat};
use crate::{
    breaks::DebugState,
    http::{Answer, Place, SHORT_MESSAGE, Shared, Site, Upgrade, at},
    samples::Samples,
};
use axum::{
    extract::{
        State,
        ws::{Message, WebSocket},
    },
    response::Response,
};
use host::{Controller, Status, Traffic};
use serde::{Deserialize, Serialize};
use std::{
    sync::{Arc, Weak},
    time::Duration,
};
use tokio::{
    sync::broadcast::error::RecvError,
    time::{Instant, MissedTickBehavior, interval, timeout},
};
use ts_rs::TS;
use utoipa::ToSchema;

/// How often traffic and the debugger are looked at.
const LOOK: Duration = Duration::from_millis(33);

/// Something is said at least this often, so that the page knows that the server is there.
const ALIVE: Duration = Duration::from_secs(2);

/// A client that takes nothing for this long is dropped.
const SEND_TIMEOUT: Duration = Duration::from_secs(5);

/// Most messages of traffic at a time: those before them are left out.
const MAX_TRAFFIC: usize = 500;

/// A message.
#[derive(Debug, Serialize, TS, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(crate) enum Live {
    /// What it is doing.
    Status {
        /// All of it.
        status: Arc<Status>,
    },
    /// What its axes did since the last such message.
    Samples {
        /// In the order of time.
        samples: Arc<Samples>,
    },
    /// What went over the wire since the last such message.
    Traffic {
        /// In the order of time.
        traffic: Vec<Traffic>,
    },
    /// Whether it can be reached.
    Link {
        /// How it is now.
        link: LinkState,
    },
    /// What a debugger sees.
    Debug {
        /// How it is now.
        debug: DebugState,
    },
}

/// What a client says: which jogs that began with `held` go on. It has to be said at least every 600 ms, and the page
/// says it every 200. An axis that this WebSocket has held and no longer names stops, and all of them do when it closes.
#[derive(Debug, Deserialize, TS, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum LiveRequest {
    /// These go on.
    Hold {
        /// The axes.
        axes: Vec<String>,
        /// The present lease of whoever says it, unless the address of the WebSocket has it (`lease`); while somebody
        /// has control nobody else holds anything.
        #[serde(default)]
        #[ts(optional)]
        lease: Option<String>,
    },
}

/// A WebSocket that says what a controller is doing, and hears which jogs are held
#[utoipa::path(get, path = "/api/devices/{device}/live", tag = "devices", responses((status = 101)))]
pub(crate) async fn live(State(site): Shared, place: Place<String>, upgrade: Upgrade) -> Answer<Response> {
    let seat = site.desk.find(&at(place)?)?;
    let lease = upgrade.lease().map(str::to_owned);
    Ok(upgrade.run(SHORT_MESSAGE, move |socket| talk(socket, seat, site, lease)))
}

/// Tells a client until it leaves, or the controller is taken away.
async fn talk(socket: WebSocket, seat: Arc<Seat>, site: Arc<Site>, lease: Option<String>) {
    let watching = Watching::begin(&seat);
    let holder = Holder::new(&seat);
    let (mut status, mut samples, mut link) = (watching.status(), watching.samples(), seat.link_state());
    let mut client = Client { socket, spoken: Instant::now() };
    let mut debugged = Debugged::default();
    let mut overheard = Overheard::default();
    let mut looks = interval(LOOK);
    looks.set_missed_tick_behavior(MissedTickBehavior::Skip);
    // What is known already is said first.
    status.mark_changed();
    link.mark_changed();
    while !seat.hub.is_closed() {
        let messages = tokio::select! {
            Ok(()) = link.changed() => vec![Live::Link { link: link.borrow_and_update().clone() }],
            Ok(()) = status.changed() => {
                let status = status.borrow_and_update().clone();
                status.into_iter().map(|status| Live::Status { status }).collect()
            }
            batch = samples.recv() => match batch {
                Ok(samples) => vec![Live::Samples { samples }],
                // Whoever is slow has a gap in the chart.
                Err(RecvError::Lagged(_)) => vec![],
                Err(RecvError::Closed) => return,
            },
            _ = looks.tick() => {
                let mut messages: Vec<_> = debugged.look(&seat).into_iter().collect();
                messages.extend(overheard.look(&seat));
                if messages.is_empty() && client.spoken.elapsed() >= ALIVE {
                    messages.push(Live::Link { link: link.borrow().clone() });
                }
                messages
            }
            // Pings are answered by the library; what makes no sense is of no interest.
            message = client.socket.recv() => match message {
                Some(Ok(Message::Close(_))) | Some(Err(_)) | None => return,
                Some(Ok(Message::Text(text))) => {
                    if let Ok(LiveRequest::Hold { axes, lease: own }) = serde_json::from_str(&text)
                        && site.control.admit(own.as_deref().or(lease.as_deref())).is_ok()
                    {
                        holder.hold(&axes);
                    }
                    vec![]
                }
                Some(Ok(_)) => vec![],
            }
        };
        for message in messages {
            if !client.tell(&message).await {
                return;
            }
        }
    }
}

struct Client {
    socket: WebSocket,
    /// When something was said last.
    spoken: Instant,
}

impl Client {
    /// Whether the message was taken.
    async fn tell(&mut self, message: &Live) -> bool {
        let text = serde_json::to_string(message).expect("a message becomes JSON");
        self.spoken = Instant::now();
        matches!(timeout(SEND_TIMEOUT, self.socket.send(Message::text(text))).await, Ok(Ok(())))
    }
}

/// What was said of the debugger.
#[derive(Default)]
struct Debugged(Option<DebugState>);

impl Debugged {
    fn look(&mut self, seat: &Seat) -> Option<Live> {
        let debug = seat.device()?.debug_state();
        if self.0.as_ref() == Some(&debug) {
            return None;
        }
        self.0 = Some(debug.clone());
        Some(Live::Debug { debug })
    }
}

/// What was said of the traffic.
#[derive(Default)]
struct Overheard {
    of: Weak<Controller>,
    next: u64,
}

impl Overheard {
    fn look(&mut self, seat: &Seat) -> Option<Live> {
        let controller = seat.link()?.present()?;
        if !std::ptr::eq(self.of.as_ptr(), Arc::as_ptr(&controller)) {
            // Another connection has a log of its own.
            *self = Self { of: Arc::downgrade(&controller), next: 0 };
        }
        let (mut traffic, next) = controller.traffic().since(self.next);
        self.next = next;
        traffic.drain(..traffic.len().saturating_sub(MAX_TRAFFIC));
        (!traffic.is_empty()).then_some(Live::Traffic { traffic })
    }
}
