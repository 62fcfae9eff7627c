//! The page: files that are in the program. They hold no secrets and are the only thing that needs no token.

use axum::{
    body::Body,
    extract::Request,
    http::{HeaderMap, HeaderValue, Method, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};

/// What a browser lets the page do: scripts and styles from this server only, none within the HTML, no frame around
/// it, and talk to nobody else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      font-src 'self'; connect-src 'self'; manifest-src 'self'; base-uri 'none'; \
                      form-action 'none'; frame-ancestors 'none'";

/// What every answer says.
const HEADERS: [(header::HeaderName, &str); 5] = [
    (header::CONTENT_SECURITY_POLICY, POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    (header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
];

/// Where the builder puts files whose names change with their contents.
const HASHED: &str = "/assets/";

/// A file of the page.
struct File {
    /// In a URL.
    path: &'static str,
    kind: &'static str,
    /// Its entity tag; weak, since it is that of both forms.
    tag: &'static str,
    plain: &'static [u8],
    /// The same, as gzip.
    packed: &'static [u8],
}

static FILES: &[File] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// Answers with a file of the page where there is one, and else asks on.
pub(super) async fn serve(request: Request, next: Next) -> Response {
    let asks = matches!(*request.method(), Method::GET | Method::HEAD);
    match find(request.uri().path()).filter(|_| asks) {
        Some(file) => answer(file, request.headers()),
        None => next.run(request).await,
    }
}

/// Adds to an answer what browsers are to know.
pub(super) async fn secure(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    // What is asked of a device is another the next time.
    headers.entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

fn find(path: &str) -> Option<&'static File> {
    let path = if path == "/" { "/index.html" } else { path };
    FILES.iter().find(|file| file.path == path)
}

fn answer(file: &'static File, asked: &HeaderMap) -> Response {
    let lasting =
        if file.path.starts_with(HASHED) { "public, max-age=31536000, immutable" } else { "no-cache" };
    let common =
        [(header::ETAG, file.tag), (header::CACHE_CONTROL, lasting), (header::VARY, "Accept-Encoding")];
    if values(asked, header::IF_NONE_MATCH).any(|tag| tag == file.tag || tag == "*") {
        return (StatusCode::NOT_MODIFIED, common).into_response();
    }
    let kind = [(header::CONTENT_TYPE, file.kind)];
    // What gzip makes larger is sent as it is.
    if file.packed.len() < file.plain.len() && takes_gzip(asked) {
        return (common, kind, [(header::CONTENT_ENCODING, "gzip")], Body::from(file.packed)).into_response();
    }
    (common, kind, Body::from(file.plain)).into_response()
}

fn takes_gzip(asked: &HeaderMap) -> bool {
    values(asked, header::ACCEPT_ENCODING).any(|coding| {
        let (name, weight) = coding.split_once(';').unwrap_or((coding, "q=1"));
        let weight = weight.trim().strip_prefix("q=").and_then(|weight| weight.trim().parse::<f32>().ok());
        ["gzip", "*"].iter().any(|known| name.trim().eq_ignore_ascii_case(known)) && weight != Some(0.0)
    })
}

/// The parts of a header that is a list.
fn values(headers: &HeaderMap, name: header::HeaderName) -> impl Iterator<Item = &str> {
    let texts = headers.get_all(name).into_iter().filter_map(|value| value.to_str().ok());
    texts.flat_map(|text| text.split(',').map(str::trim))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_there_and_begins_with_its_index() {
        let index = find("/").unwrap();
        assert_eq!(index.kind, "text/html; charset=utf-8");
        assert_eq!(index.plain, find("/index.html").unwrap().plain);
        assert!(index.plain.starts_with(b"<!doctype html>"));
        assert!(find("").is_none() && find("/api").is_none() && find("/../Cargo.toml").is_none());
    }

    #[test]
    fn nothing_in_the_html_needs_what_the_policy_forbids() {
        let html = std::str::from_utf8(find("/").unwrap().plain).unwrap();
        for tag in html.split('<').filter(|tag| tag.starts_with("script")) {
            assert!(tag.contains(" src=\"") && tag.ends_with('>'), "an inline script: {tag}");
        }
        for forbidden in ["<style", " style=", " onclick=", " onload=", "javascript:", "http://", "https://"]
        {
            assert!(!html.contains(forbidden), "{forbidden}");
        }
    }

    #[test]
    fn gzip_is_for_those_who_take_it() {
        let check = |text: &str, expected: bool| {
            let mut headers = HeaderMap::new();
            headers.insert(header::ACCEPT_ENCODING, text.parse().unwrap());
            assert_eq!(takes_gzip(&headers), expected, "{text}");
        };
        check("gzip", true);
        check("br, GZIP;q=0.5, deflate", true);
        check("*", true);
        check("gzip;q=0", false);
        check("gzip; q=0.0", false);
        check("br, identity", false);
        check("gzippy", false);
        assert!(!takes_gzip(&HeaderMap::new()));
    }

    #[test]
    fn a_file_that_the_browser_has_is_not_sent_again() {
        let file = find("/").unwrap();
        let check = |tag: &str, expected: StatusCode| {
            let mut headers = HeaderMap::new();
            headers.insert(header::IF_NONE_MATCH, tag.parse().unwrap());
            assert_eq!(answer(file, &headers).status(), expected, "{tag}");
        };
        check(file.tag, StatusCode::NOT_MODIFIED);
        check(&format!("\"x\", {}", file.tag), StatusCode::NOT_MODIFIED);
        check("W/\"0\"", StatusCode::OK);
    }
}
