//! Names of documents: URIs, as far as files beside each other need them.

/// The URI of a file that is named in another one.
pub(crate) fn beside(uri: &str, name: &str) -> String {
    let name = name.replace('\\', "/");
    // Scheme and authority stay: `file://`, `inmemory://model`.
    let root =
        uri.find("://").map_or(0, |at| uri[at + 3..].find('/').map_or(uri.len(), |path| at + 3 + path));
    let folder = uri[root..].rfind('/').map_or("", |end| &uri[root..root + end]);
    let mut path: Vec<String> = if name.starts_with('/') {
        Vec::new()
    } else {
        folder.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect()
    };
    for part in name.split('/') {
        match part {
            "" | "." => (),
            ".." => drop(path.pop()),
            part => path.push(encode(part)),
        }
    }
    format!("{}/{}", &uri[..root], path.join("/"))
}

/// Whether two URIs name the same document, however they are written.
pub(crate) fn same(a: &str, b: &str) -> bool {
    a == b || decode(a) == decode(b)
}

/// The path of a `file:` URI on this machine.
pub fn to_path(uri: &str) -> Option<String> {
    let path = decode(uri.strip_prefix("file://")?);
    path.starts_with('/').then_some(path)
}

/// The extension of a document's name, in lower case.
pub(crate) fn extension(uri: &str) -> Option<String> {
    let name = uri.rsplit('/').next().unwrap_or_default();
    let name = name.split(['?', '#']).next().unwrap_or_default();
    name.rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase())
}

/// The last part of a URI, for people.
pub(crate) fn name(uri: &str) -> String {
    decode(uri.rsplit('/').next().unwrap_or(uri))
}

fn encode(part: &str) -> String {
    let mut text = String::new();
    for byte in part.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => text.push(byte.into()),
            _ => text.push_str(&format!("%{byte:02X}")),
        }
    }
    text
}

fn decode(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        let mut digits = rest.clone();
        let mut digit = || digits.next().and_then(|digit| char::from(digit).to_digit(16));
        match (byte, digit(), digit()) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((high << 4 | low) as u8);
                rest = digits;
            }
            _ => bytes.push(byte),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_beside_each_other() {
        let check = |uri, name, expected| assert_eq!(beside(uri, name), expected, "{uri} {name}");
        check("file:///home/a/main.tmc", "axis.inc", "file:///home/a/axis.inc");
        check("file:///home/a/main.tmc", "..\\lib/./axis one.inc", "file:///home/lib/axis%20one.inc");
        check("file:///home/a/main.tmc", "/etc/x.inc", "file:///etc/x.inc");
        check("file:///main.tmc", "../../x.inc", "file:///x.inc");
        check("inmemory://page/main.tmc", "x.inc", "inmemory://page/x.inc");
        check("inmemory://page", "x.inc", "inmemory://page/x.inc");
        check("untitled:1", "x.inc", "/x.inc");
        check("", "", "/");
    }

    #[test]
    fn parts_of_a_uri() {
        assert!(same("file:///c%3A/a%20b.tmc", "file:///c:/a b.tmc"));
        assert!(!same("file:///a.tmc", "file:///b.tmc"));
        assert_eq!(to_path("file:///a%20b/%C3%A4.tmc").as_deref(), Some("/a b/ä.tmc"));
        assert_eq!(to_path("file://host/a"), None.or_else(|| to_path("http://a")));
        assert_eq!(extension("file:///a.b/Main.TMC?x").as_deref(), Some("tmc"));
        assert_eq!(extension("file:///a.b/main"), None);
        assert_eq!(name("file:///a/b%20c.tmc"), "b c.tmc");
        assert_eq!(decode("%4%zz%"), "%4%zz%");
    }
}
