//! Control: one client at a time may have it, and then nobody else changes anything. Stopping is not a matter of
//! control, and neither is looking.
//!
//! While nobody has it, everybody with the token may act, so that programs need to know nothing of it.

use super::{
    Failure, Site,
    guard::{equal, random},
    request::{Answer, Body, Shared, json, unprocessable},
};
use axum::{
    Json,
    extract::{Request, State},
    http::{HeaderMap, HeaderName, Method, StatusCode},
    middleware::Next,
    response::Response,
};
use serde::{Deserialize, Serialize};
use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};
use ts_rs::TS;
use utoipa::ToSchema;

/// The header that shows who has control.
pub const HEADER: HeaderName = HeaderName::from_static("control-lease");

/// How long control lasts unless it is renewed.
const DURATION: Duration = Duration::from_secs(10);

/// Most characters of a holder's name.
const MAX_NAME: usize = 64;

/// Who has control.
#[derive(Default)]
pub struct Control(Mutex<Option<Held>>);

struct Held {
    name: String,
    key: String,
    until: Instant,
}

/// Who has control, seen by one client.
#[derive(Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Lease {
    /// The name that the holder gave itself.
    holder: Option<String>,
    /// Whether the holder is who asks.
    mine: bool,
    /// Seconds until it ends unless it is renewed.
    seconds: f64,
}

/// Asks for control.
#[derive(Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct LeaseRequest {
    /// What others see: 1 to 64 characters.
    name: String,
    /// Whether to take it from its holder.
    #[serde(default)]
    force: bool,
}

/// Control was given.
#[derive(Serialize, TS, ToSchema)]
pub struct LeaseGrant {
    /// What the header `Control-Lease` has to say.
    lease: String,
    /// Seconds until it ends unless it is renewed.
    seconds: f64,
}

impl Control {
    /// Who has control now, as the client with this key sees it.
    fn show(&self, key: Option<&str>) -> Lease {
        match self.held(Instant::now()).as_ref() {
            Some(held) => Lease {
                holder: Some(held.name.clone()),
                mine: held.is(key),
                seconds: held.until.saturating_duration_since(Instant::now()).as_secs_f64(),
            },
            None => Lease { holder: None, mine: false, seconds: 0.0 },
        }
    }

    /// Gives control to a client under a new key, unless somebody else has it and it is not to be taken away.
    fn take(&self, name: &str, force: bool, shown: Option<&str>, key: String) -> Answer<()> {
        let mut held = self.held(Instant::now());
        if let Some(other) = held.as_ref().filter(|other| !force && !other.is(shown)) {
            return Err(locked(&other.name));
        }
        *held = Some(Held { name: name.into(), key, until: Instant::now() + DURATION });
        Ok(())
    }

    /// Lasts anew; false if the client with this key has not got control.
    pub fn renew(&self, key: &str) -> bool {
        let mut held = self.held(Instant::now());
        let mine = held.as_mut().filter(|held| held.is(Some(key)));
        mine.map(|held| held.until = Instant::now() + DURATION).is_some()
    }

    /// Whether the client with this key may change something; else who may.
    pub fn admit(&self, key: Option<&str>) -> Answer<()> {
        match self.held(Instant::now()).as_ref() {
            Some(held) if !held.is(key) => Err(locked(&held.name)),
            _ => Ok(()),
        }
    }

    /// What is held at a time; what is over is forgotten.
    fn held(&self, now: Instant) -> MutexGuard<'_, Option<Held>> {
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        held.take_if(|held| held.until <= now);
        held
    }
}

impl Held {
    fn is(&self, key: Option<&str>) -> bool {
        key.is_some_and(|key| equal(&self.key, key))
    }
}

fn locked(holder: &str) -> Failure {
    let failure = Failure::new(StatusCode::LOCKED, format!("{holder} has control"));
    Failure { holder: Some(holder.into()), ..failure }
}

/// Lets a request through that changes nothing, or whose client may.
pub async fn check(State(site): Shared, request: Request, next: Next) -> Answer<Response> {
    if !matches!(*request.method(), Method::GET | Method::HEAD) {
        site.control.admit(key(request.headers()))?;
    }
    Ok(next.run(request).await)
}

/// The lease that a request shows.
pub fn key(headers: &HeaderMap) -> Option<&str> {
    headers.get(HEADER)?.to_str().ok()
}

/// Who has control
#[utoipa::path(get, path = "/api/lease", tag = "control", responses((status = 200, body = Lease)))]
pub async fn show(State(site): Shared, headers: HeaderMap) -> Json<Lease> {
    Json(site.control.show(key(&headers)))
}

/// Take control
///
/// It ends by itself unless it is renewed.
#[utoipa::path(
    post, path = "/api/lease", tag = "control",
    request_body = LeaseRequest, responses((status = 200, body = LeaseGrant))
)]
pub async fn take(State(site): Shared, headers: HeaderMap, body: Body) -> Answer<Json<LeaseGrant>> {
    let LeaseRequest { name, force } = json(body)?;
    let length = name.chars().count();
    if !(1..=MAX_NAME).contains(&length) || name.chars().any(char::is_control) {
        return Err(unprocessable(format!("a name has 1 to {MAX_NAME} characters")));
    }
    let lease = random().map_err(|why| Failure::new(StatusCode::INTERNAL_SERVER_ERROR, why.to_string()))?;
    site.control.take(&name, force, key(&headers), lease.clone())?;
    Ok(Json(LeaseGrant { lease, seconds: DURATION.as_secs_f64() }))
}

/// Keep control
#[utoipa::path(put, path = "/api/lease", tag = "control", responses((status = 204)))]
pub async fn renew(State(site): Shared, headers: HeaderMap) -> Answer<StatusCode> {
    let renewed = key(&headers).is_some_and(|key| site.control.renew(key));
    if renewed { Ok(StatusCode::NO_CONTENT) } else { Err(not_held(&site)) }
}

/// Give control up
#[utoipa::path(delete, path = "/api/lease", tag = "control", responses((status = 204)))]
pub async fn drop(State(site): Shared, headers: HeaderMap) -> Answer<StatusCode> {
    let mine = site.control.held(Instant::now()).take_if(|held| held.is(key(&headers)));
    mine.map(|_| StatusCode::NO_CONTENT).ok_or_else(|| not_held(&site))
}

/// Somebody without control wants to keep it or give it up.
fn not_held(site: &Arc<Site>) -> Failure {
    match site.control.admit(None) {
        Err(locked) => locked,
        Ok(()) => Failure::new(StatusCode::LOCKED, "nobody has control, or it is over"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(control: &Control, key: Option<&str>, holder: Option<&str>, mine: bool) {
        let seen = control.show(key);
        assert_eq!((seen.holder.as_deref(), seen.mine), (holder, mine));
        assert_eq!(control.admit(key).is_ok(), holder.is_none() || mine);
        assert!(seen.seconds <= DURATION.as_secs_f64() && (seen.seconds > 0.0) == holder.is_some());
    }

    #[test]
    fn one_has_it_and_another_can_take_it() {
        let control = Control::default();
        check(&control, None, None, false);
        check(&control, Some("1"), None, false);
        control.take("a", false, None, "1".into()).unwrap();
        check(&control, Some("1"), Some("a"), true);
        check(&control, Some("2"), Some("a"), false);
        check(&control, None, Some("a"), false);
        let refused = control.take("b", false, Some("2"), "3".into()).unwrap_err();
        assert_eq!((refused.status, refused.holder.as_deref()), (StatusCode::LOCKED, Some("a")));
        control.take("a again", false, Some("1"), "4".into()).unwrap();
        check(&control, Some("1"), Some("a again"), false);
        control.take("b", true, None, "5".into()).unwrap();
        check(&control, Some("4"), Some("b"), false);
        check(&control, Some("5"), Some("b"), true);
    }

    #[test]
    fn it_ends_unless_it_is_renewed() {
        let control = Control::default();
        assert!(!control.renew("1"));
        control.take("a", false, None, "1".into()).unwrap();
        let begin = Instant::now();
        assert!(control.held(begin + DURATION / 2).is_some());
        assert!(control.renew("1") && !control.renew("2"));
        assert!(control.held(begin + 2 * DURATION).is_none());
        check(&control, Some("1"), None, false);
        assert!(!control.renew("1"));
    }
}
