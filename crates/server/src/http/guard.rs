//! Who may ask: the token, and the checks of the headers `Host` and `Origin` that keep other people's web pages out.

use super::{Failure, Site};
use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, Uri, header},
    middleware::Next,
    response::Response,
};
use std::{net::IpAddr, sync::Arc};
use subtle::ConstantTimeEq;

/// Random bytes of a token.
const TOKEN_BYTES: usize = 24;

/// Characters that a token of the user may have: those that stand in a URL as they are.
const TOKEN_MARKS: &[u8] = b"-._~";

/// What every request must show.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// A new one, from the system's random numbers.
    ///
    /// # Errors
    /// The system has none.
    pub fn random() -> Result<Self, getrandom::Error> {
        random().map(Self)
    }

    /// One that the user chose; `None` if it is empty or has characters that a URL would have to escape.
    pub fn chosen(text: &str) -> Option<Self> {
        let plain = |byte: &u8| byte.is_ascii_alphanumeric() || TOKEN_MARKS.contains(byte);
        (!text.is_empty() && text.as_bytes().iter().all(plain)).then(|| Self(text.to_owned()))
    }

    /// The token as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    fn is(&self, shown: &str) -> bool {
        equal(&self.0, shown)
    }
}

/// A secret that nobody guesses.
///
/// # Errors
/// The system has no random numbers.
pub(super) fn random() -> Result<String, getrandom::Error> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Whether a secret is the right one, in a time that says nothing of how much of it is.
pub(super) fn equal(secret: &str, shown: &str) -> bool {
    secret.as_bytes().ct_eq(shown.as_bytes()).into()
}

/// Lets a request through that comes for us, and not from somebody else's page.
pub(super) async fn place(
    State(site): State<Arc<Site>>,
    request: Request,
    next: Next,
) -> Result<Response, Failure> {
    let Some(host) = host(request.headers()).filter(|host| is_ours(host, site.address.ip())) else {
        return Err(Failure::new(
            StatusCode::FORBIDDEN,
            "the Host header names neither this machine nor the address that is listened on",
        ));
    };
    // Programs that are no browsers say no origin.
    if request.headers().get(header::ORIGIN).is_some_and(|origin| !is_origin(origin, host)) {
        return Err(Failure::new(StatusCode::FORBIDDEN, "the request comes from a page of another server"));
    }
    Ok(next.run(request).await)
}

/// Lets a request through that shows the token.
pub(super) async fn token(
    State(site): State<Arc<Site>>,
    request: Request,
    next: Next,
) -> Result<Response, Failure> {
    let shown = bearer(request.headers()).or_else(|| {
        // A browser's WebSocket cannot set headers.
        is_websocket(request.headers()).then(|| query(request.uri(), "token")).flatten()
    });
    match shown {
        Some(shown) if site.token.is(shown) => Ok(next.run(request).await),
        Some(_) => Err(Failure::new(StatusCode::UNAUTHORIZED, "wrong token")),
        None => Err(Failure::new(
            StatusCode::UNAUTHORIZED,
            "the request needs the header Authorization: Bearer TOKEN",
        )),
    }
}

fn host(headers: &HeaderMap) -> Option<&str> {
    headers.get(header::HOST)?.to_str().ok()
}

fn bearer(headers: &HeaderMap) -> Option<&str> {
    let (scheme, token) = headers.get(header::AUTHORIZATION)?.to_str().ok()?.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| token.trim())
}

fn is_websocket(headers: &HeaderMap) -> bool {
    let upgrade = headers.get(header::UPGRADE).and_then(|value| value.to_str().ok());
    upgrade.is_some_and(|value| value.eq_ignore_ascii_case("websocket"))
}

/// A value of the query, as it stands there.
pub(super) fn query<'a>(uri: &'a Uri, name: &str) -> Option<&'a str> {
    uri.query()?.split('&').find_map(|pair| pair.strip_prefix(name)?.strip_prefix('='))
}

/// Whether a host, with or without a port, is this machine. A page of somebody else whose name was made
/// to point here shows up with that name, so names other than `localhost` are refused.
fn is_ours(host: &str, bound: IpAddr) -> bool {
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or(rest),
        None => host.split(':').next().unwrap_or(host),
    };
    match name.parse::<IpAddr>() {
        Ok(address) => address.is_loopback() || address == bound || bound.is_unspecified(),
        Err(_) => name.eq_ignore_ascii_case("localhost"),
    }
}

/// Whether a page of this origin was sent by this host. The scheme is not compared: something in front of us may add TLS.
fn is_origin(origin: &HeaderValue, host: &str) -> bool {
    let address = origin.to_str().ok().and_then(|origin| origin.split_once("://"));
    address.is_some_and(|(scheme, address)| {
        matches!(scheme, "http" | "https") && address.eq_ignore_ascii_case(host)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, Ipv6Addr};

    #[test]
    fn hosts() {
        let local = IpAddr::V4(Ipv4Addr::LOCALHOST);
        let any = IpAddr::V4(Ipv4Addr::UNSPECIFIED);
        let lan = IpAddr::V4(Ipv4Addr::new(192, 168, 1, 5));
        let check = |host: &str, bound: IpAddr, expected: bool| {
            assert_eq!(is_ours(host, bound), expected, "{host} on {bound}");
        };
        check("127.0.0.1:8340", local, true);
        check("localhost:8340", local, true);
        check("LOCALHOST", local, true);
        check("[::1]:8340", IpAddr::V6(Ipv6Addr::LOCALHOST), true);
        check("192.168.1.5:80", lan, true);
        check("192.168.1.5:80", any, true);
        check("192.168.1.6:80", lan, false);
        check("evil.example:8340", local, false);
        check("evil.example:8340", any, false);
        check("localhost.evil.example", local, false);
        check("127.0.0.1.evil.example", local, false);
        check("", local, false);
        check("[", local, false);
    }

    #[test]
    fn origins() {
        let check = |origin: &str, expected: bool| {
            assert_eq!(is_origin(&origin.parse().unwrap(), "localhost:8340"), expected, "{origin}");
        };
        check("http://localhost:8340", true);
        check("https://LOCALHOST:8340", true);
        check("http://localhost", false);
        check("http://localhost:5173", false);
        check("http://evil.example", false);
        check("http://localhost:8340.evil.example", false);
        check("file://localhost:8340", false);
        check("null", false);
        check("", false);
    }

    #[test]
    fn tokens() {
        let token = Token::random().unwrap();
        assert_eq!(token.as_str().len(), 2 * TOKEN_BYTES);
        assert!(token.is(token.as_str()));
        assert!(!token.is(""));
        assert!(!token.is(&token.as_str()[1..]));
        assert_ne!(token.as_str(), Token::random().unwrap().as_str());
        assert!(Token::chosen("a-B_9.~").is_some());
        for bad in ["", "a b", "a&b", "ä", "a\n"] {
            assert!(Token::chosen(bad).is_none(), "{bad:?}");
        }
    }

    #[test]
    fn headers_and_queries() {
        let mut headers = HeaderMap::new();
        assert_eq!(bearer(&headers), None);
        headers.insert(header::AUTHORIZATION, "bearer  abc".parse().unwrap());
        assert_eq!(bearer(&headers), Some("abc"));
        headers.insert(header::AUTHORIZATION, "Basic abc".parse().unwrap());
        assert_eq!(bearer(&headers), None);
        assert_eq!(query(&Uri::from_static("/x?a=1&token=abc"), "token"), Some("abc"));
        assert_eq!(query(&Uri::from_static("/x?tokens=abc"), "token"), None);
    }
}
