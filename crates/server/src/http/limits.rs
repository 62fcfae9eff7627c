//! How much one client may ask for, so that it leaves something to the others.

use super::Failure;
use axum::{
    body::{Body, to_bytes},
    extract::{Request, State},
    http::{Method, StatusCode, Uri, request::Parts},
    middleware::Next,
    response::Response,
};
use std::{
    collections::HashMap,
    net::{IpAddr, Ipv4Addr},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// Most connections at a time; more wait until one is closed.
pub const MAX_CONNECTIONS: usize = 128;

/// Most WebSockets at a time, so that connections are left for requests.
const MAX_SOCKETS: usize = 112;

/// Most WebSockets of one client.
const MAX_SOCKETS_A_CLIENT: usize = 64;

/// Most changes a second of one client in the long run.
const CHANGES_A_SECOND: f64 = 1000.0;

/// Most changes that it may have saved up for.
const MOST_CHANGES: f64 = 2000.0;

/// Clients whose changes are counted; when there are more, those who have saved up all are forgotten, and if all are
/// at it, everybody.
const MAX_CLIENTS: usize = 1024;

/// Most bytes of a request's body unless its route says otherwise: a number, a line or a short table.
pub const MAX_BODY_BYTES: usize = 4096;

/// Most bytes of any body; routes with files may have more than [`MAX_BODY_BYTES`], but not more than this.
const MAX_ANY_BODY_BYTES: usize = 8 << 20;

/// Most bytes of the head of a request.
pub const MAX_HEAD_BYTES: usize = 16 << 10;

/// Most lines of the head of a request.
pub const MAX_HEADERS: usize = 64;

/// How long a client may take nothing of what it is sent, unless somebody has [other patience](Patience::send).
pub const SEND_TIMEOUT: Duration = Duration::from_secs(30);

/// How long clients may take over something before they lose their connection, or are told so.
#[derive(Clone, Copy, Debug)]
pub struct Patience {
    /// For TLS to begin.
    pub handshake: Duration,
    /// For the head of a request to come, and for how long a connection may be without one.
    pub head: Duration,
    /// For the body of a request to come.
    pub body: Duration,
    /// For taking anything of what they are sent.
    pub send: Duration,
}

impl Default for Patience {
    fn default() -> Self {
        let seconds = Duration::from_secs;
        Self { handshake: seconds(10), head: seconds(60), body: seconds(30), send: SEND_TIMEOUT }
    }
}

/// The other end of a connection.
#[derive(Clone, Copy, Debug)]
pub struct Client(pub IpAddr);

impl Client {
    /// Who sends a request.
    pub fn of(parts: &Parts) -> Self {
        *parts.extensions.get().unwrap_or(&Self(Ipv4Addr::UNSPECIFIED.into()))
    }
}

/// What clients are at.
#[derive(Default)]
pub struct Limits {
    changes: Mutex<HashMap<IpAddr, Savings>>,
    sockets: Mutex<HashMap<IpAddr, usize>>,
}

/// Changes that a client may make at once.
struct Savings {
    changes: f64,
    at: Instant,
}

/// A WebSocket that counts as long as it is open.
pub struct SocketPermit {
    limits: Arc<Limits>,
    client: IpAddr,
}

impl Limits {
    /// Whether a client may change something now.
    fn may_change(&self, Client(client): Client, now: Instant) -> bool {
        let mut all = lock(&self.changes);
        if all.len() >= MAX_CLIENTS && !all.contains_key(&client) {
            all.retain(|_, savings| savings.grown(now) < MOST_CHANGES);
            if all.len() >= MAX_CLIENTS {
                all.clear();
            }
        }
        let savings = all.entry(client).or_insert(Savings { changes: MOST_CHANGES, at: now });
        *savings = Savings { changes: savings.grown(now), at: now };
        let may = savings.changes >= 1.0;
        if may {
            savings.changes -= 1.0;
        }
        may
    }

    fn open_socket(&self, client: IpAddr) -> bool {
        let mut all = lock(&self.sockets);
        let (total, own) = (all.values().sum::<usize>(), all.get(&client).copied().unwrap_or(0));
        let may = total < MAX_SOCKETS && own < MAX_SOCKETS_A_CLIENT;
        if may {
            all.insert(client, own + 1);
        }
        may
    }

    fn close_socket(&self, client: IpAddr) {
        let mut all = lock(&self.sockets);
        let own = all.get_mut(&client).expect("only what was opened is closed");
        *own -= 1;
        if *own == 0 {
            all.remove(&client);
        }
    }
}

impl Savings {
    fn grown(&self, now: Instant) -> f64 {
        let more = now.saturating_duration_since(self.at).as_secs_f64() * CHANGES_A_SECOND;
        (self.changes + more).min(MOST_CHANGES)
    }
}

impl SocketPermit {
    /// For one more WebSocket of a client.
    pub fn of(limits: &Arc<Limits>, Client(client): Client) -> Result<Self, Failure> {
        if limits.open_socket(client) {
            return Ok(Self { limits: Arc::clone(limits), client });
        }
        let message =
            format!("there are {MAX_SOCKETS_A_CLIENT} WebSockets a client, and {MAX_SOCKETS} in all");
        Err(Failure::new(StatusCode::TOO_MANY_REQUESTS, message))
    }
}

impl Drop for SocketPermit {
    fn drop(&mut self) {
        self.limits.close_socket(self.client);
    }
}

/// Lets a request through whose client does not change too much too fast. To stop is never too much.
pub async fn changes(
    State(limits): State<Arc<Limits>>,
    request: Request,
    next: Next,
) -> Result<Response, Failure> {
    let (parts, body) = request.into_parts();
    let looks = matches!(parts.method, Method::GET | Method::HEAD) || stops(&parts.uri);
    if !looks && !limits.may_change(Client::of(&parts), Instant::now()) {
        let message = format!("these are more than {CHANGES_A_SECOND} changes a second");
        return Err(Failure::new(StatusCode::TOO_MANY_REQUESTS, message));
    }
    Ok(next.run(Request::from_parts(parts, body)).await)
}

fn stops(uri: &Uri) -> bool {
    uri.path().ends_with("/stop")
}

/// Waits for the whole body, but not for ever.
pub async fn body(
    State(patience): State<Duration>,
    request: Request,
    next: Next,
) -> Result<Response, Failure> {
    let (parts, body) = request.into_parts();
    let bytes = match tokio::time::timeout(patience, to_bytes(body, MAX_ANY_BODY_BYTES)).await {
        Ok(Ok(bytes)) => bytes,
        Ok(Err(_)) => {
            return Err(Failure::new(
                StatusCode::PAYLOAD_TOO_LARGE,
                "the body is too long, or did not come whole",
            ));
        }
        Err(_) => return Err(Failure::new(StatusCode::REQUEST_TIMEOUT, "the body did not come in time")),
    };
    Ok(next.run(Request::from_parts(parts, Body::from(bytes))).await)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::{Router, middleware};
    use hyper::service::Service;
    use hyper_util::service::TowerToHyperService;

    fn client(number: u32) -> IpAddr {
        Ipv4Addr::from(number).into()
    }

    #[test]
    fn changes_are_saved_up_and_spent() {
        let (limits, begin) = (Limits::default(), Instant::now());
        let spend = |number: u32, now: Instant| {
            (0..5000).filter(|_| limits.may_change(Client(client(number)), now)).count()
        };
        assert_eq!(spend(1, begin), MOST_CHANGES as usize);
        assert_eq!(spend(1, begin), 0);
        assert_eq!(spend(2, begin), MOST_CHANGES as usize, "another one has its own");
        assert_eq!(spend(1, begin + Duration::from_millis(500)), CHANGES_A_SECOND as usize / 2);
        assert_eq!(spend(1, begin + Duration::from_secs(100)), MOST_CHANGES as usize);
    }

    #[tokio::test]
    async fn who_changes_too_much_too_fast_may_look_and_stop() {
        let limits = Arc::new(Limits::default());
        let Client(nobody) = Client::of(&Request::new(()).into_parts().0);
        let later = Instant::now() + Duration::from_secs(60);
        while limits.may_change(Client(nobody), later) {}
        let routes = Router::new().fallback(async || StatusCode::NO_CONTENT);
        let routes = routes.layer(middleware::from_fn_with_state(limits, changes));
        let routes = TowerToHyperService::new(routes);
        for (method, path, expected) in [
            (Method::PUT, "/api/devices/a/pins/b", StatusCode::TOO_MANY_REQUESTS),
            (Method::POST, "/api/devices/a/act", StatusCode::TOO_MANY_REQUESTS),
            (Method::GET, "/api/devices/a/pins/b", StatusCode::NO_CONTENT),
            (Method::POST, "/api/devices/a/stop", StatusCode::NO_CONTENT),
        ] {
            let request = Request::builder().method(&method).uri(path).body(Body::empty()).unwrap();
            assert_eq!(routes.call(request).await.unwrap().status(), expected, "{method} {path}");
        }
    }

    #[test]
    fn clients_are_forgotten() {
        let (limits, begin) = (Limits::default(), Instant::now());
        for number in 0..10 * MAX_CLIENTS as u32 {
            assert!(limits.may_change(Client(client(number)), begin));
            assert!(lock(&limits.changes).len() <= MAX_CLIENTS);
        }
    }

    #[test]
    fn sockets_are_counted_by_client_and_in_all() {
        let limits = Limits::default();
        let open = |number: u32| (0..100).filter(|_| limits.open_socket(client(number))).count();
        assert_eq!(open(1), MAX_SOCKETS_A_CLIENT);
        assert_eq!(open(2), MAX_SOCKETS - MAX_SOCKETS_A_CLIENT);
        assert_eq!(open(3), 0);
        limits.close_socket(client(1));
        assert_eq!(open(3), 1);
        (1..MAX_SOCKETS_A_CLIENT).for_each(|_| limits.close_socket(client(1)));
        assert!(!lock(&limits.sockets).contains_key(&client(1)));
    }
}
