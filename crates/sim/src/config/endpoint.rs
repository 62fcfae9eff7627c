//! Where a device listens: text to and from [`Endpoint`]. Nothing is opened here.

use std::{fmt, net::IpAddr, path::PathBuf, str::FromStr};

/// A place where a device can be reached.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Endpoint {
    /// `tcp:HOST:PORT`: bytes over TCP. Port 0 lets the system pick one.
    Tcp {
        /// Name or address of the interface, an IPv6 address without its brackets.
        host: String,
        /// TCP port.
        port: u16,
    },
    /// `pty:PATH`: a pseudo-terminal; `PATH` becomes a symbolic link to it.
    Pty {
        /// The link.
        path: PathBuf,
    },
    /// `slcan-tcp:HOST:PORT`: CAN frames in SLCAN lines over TCP.
    SlcanTcp {
        /// Name or address of the interface, an IPv6 address without its brackets.
        host: String,
        /// TCP port.
        port: u16,
    },
    /// `hid-tcp:HOST:PORT`: reports of USB HID over TCP.
    HidTcp {
        /// Name or address of the interface, an IPv6 address without its brackets.
        host: String,
        /// TCP port.
        port: u16,
    },
    /// `hid-unix:PATH`: reports of USB HID over a Unix socket.
    HidUnix {
        /// The socket.
        path: PathBuf,
    },
}

/// How each kind is written, for messages.
const FORMS: &str = "tcp:HOST:PORT, pty:PATH, slcan-tcp:HOST:PORT, hid-tcp:HOST:PORT or hid-unix:PATH";

/// Why a text is not an endpoint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EndpointError {
    /// It starts with none of the known kinds.
    #[error("`{0}` is not an endpoint: write {FORMS}")]
    Kind(String),
    /// Host or port is missing.
    #[error("`{0}` needs a host and a port: HOST:PORT")]
    Address(String),
    /// The port is no number up to 65535.
    #[error("`{0}` is not a port: 0 to 65535")]
    Port(String),
    /// The path is empty.
    #[error("the path of {0}: is missing")]
    Path(&'static str),
}

/// Why a device cannot be at an endpoint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlaceError {
    /// It speaks in no reports over USB.
    #[error("a {0} is no HID device")]
    NotHid(&'static str),
    /// Another device is there, and USB is no bus.
    #[error("`{0}` is there already, and a HID endpoint has one device")]
    Taken(String),
    /// It is a file, or open to other machines, and whoever wants it is not at this one.
    #[error(
        "over HTTP devices come that listen on TCP at this machine (127.0.0.1, [::1], localhost), or nowhere"
    )]
    NotLocal,
}

impl Endpoint {
    /// Whether two devices that name it share it. An endpoint whose port the system picks belongs to one
    /// device alone.
    pub fn can_be_shared(&self) -> bool {
        !matches!(
            self,
            Self::Tcp { port: 0, .. } | Self::SlcanTcp { port: 0, .. } | Self::HidTcp { port: 0, .. }
        )
    }

    /// Whether somebody at another machine may open it: it names no file, and only this machine can connect.
    ///
    /// # Errors
    /// [`PlaceError::NotLocal`].
    pub fn check_local(&self) -> Result<(), PlaceError> {
        let is_local = match self {
            Self::Tcp { host, .. } | Self::SlcanTcp { host, .. } | Self::HidTcp { host, .. } => {
                host == "localhost" || host.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
            }
            Self::Pty { .. } | Self::HidUnix { .. } => false,
        };
        is_local.then_some(()).ok_or(PlaceError::NotLocal)
    }

    /// Whether what is there is a device of USB, with reports and a name.
    pub fn is_hid(&self) -> bool {
        matches!(self, Self::HidTcp { .. } | Self::HidUnix { .. })
    }
}

impl FromStr for Endpoint {
    type Err = EndpointError;

    fn from_str(text: &str) -> Result<Self, EndpointError> {
        match text.split_once(':') {
            Some(("tcp", rest)) => host_and_port(rest).map(|(host, port)| Self::Tcp { host, port }),
            Some(("slcan-tcp", rest)) => {
                host_and_port(rest).map(|(host, port)| Self::SlcanTcp { host, port })
            }
            Some(("hid-tcp", rest)) => host_and_port(rest).map(|(host, port)| Self::HidTcp { host, port }),
            Some(("pty", "")) => Err(EndpointError::Path("pty")),
            Some(("pty", path)) => Ok(Self::Pty { path: path.into() }),
            Some(("hid-unix", "")) => Err(EndpointError::Path("hid-unix")),
            Some(("hid-unix", path)) => Ok(Self::HidUnix { path: path.into() }),
            _ => Err(EndpointError::Kind(text.into())),
        }
    }
}

fn host_and_port(text: &str) -> Result<(String, u16), EndpointError> {
    let missing = || EndpointError::Address(text.into());
    let (host, port) = text.rsplit_once(':').ok_or_else(missing)?;
    let bare = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
    // Without brackets nobody can tell where an IPv6 address ends.
    if bare.unwrap_or(host).is_empty() || (bare.is_none() && host.contains(':')) {
        return Err(missing());
    }
    // `parse` alone would take "+80".
    let digits = !port.is_empty() && port.bytes().all(|byte| byte.is_ascii_digit());
    let number = port.parse().ok().filter(|_| digits).ok_or_else(|| EndpointError::Port(port.into()))?;
    Ok((bare.unwrap_or(host).into(), number))
}

impl fmt::Display for Endpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, host, port) = match self {
            Self::Tcp { host, port } => ("tcp", host, port),
            Self::SlcanTcp { host, port } => ("slcan-tcp", host, port),
            Self::HidTcp { host, port } => ("hid-tcp", host, port),
            Self::HidUnix { path } => return write!(f, "hid-unix:{}", path.display()),
            Self::Pty { path } => return write!(f, "pty:{}", path.display()),
        };
        if host.contains(':') {
            write!(f, "{kind}:[{host}]:{port}")
        } else {
            write!(f, "{kind}:{host}:{port}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: Result<&str, &str>) {
        let got = text.parse::<Endpoint>().map(|endpoint| endpoint.to_string());
        assert_eq!(got.as_deref().map_err(ToString::to_string), expected.map_err(str::to_string));
    }

    #[test]
    fn endpoints_survive_a_round_trip() {
        for text in [
            "tcp:127.0.0.1:4001",
            "tcp:localhost:0",
            "tcp:[::1]:4001",
            "pty:/run/motor",
            "slcan-tcp:h:65535",
            "hid-tcp:[::]:4005",
            "hid-unix:/run/motor:1",
        ] {
            check(text, Ok(text));
        }
    }

    #[test]
    fn other_texts_are_refused() {
        let kind = "`udp:h:1` is not an endpoint: write tcp:HOST:PORT, pty:PATH, slcan-tcp:HOST:PORT, \
                    hid-tcp:HOST:PORT or hid-unix:PATH";
        check("udp:h:1", Err(kind));
        check("tcp:4001", Err("`4001` needs a host and a port: HOST:PORT"));
        check("tcp::4001", Err("`:4001` needs a host and a port: HOST:PORT"));
        check("tcp:::1:4001", Err("`::1:4001` needs a host and a port: HOST:PORT"));
        check("tcp:h:65536", Err("`65536` is not a port: 0 to 65535"));
        check("tcp:h:+80", Err("`+80` is not a port: 0 to 65535"));
        check("tcp:h:", Err("`` is not a port: 0 to 65535"));
        check("pty:", Err("the path of pty: is missing"));
        check("hid-tcp:4001", Err("`4001` needs a host and a port: HOST:PORT"));
        check("hid-unix:", Err("the path of hid-unix: is missing"));
    }

    #[test]
    fn a_port_that_is_picked_is_never_shared() {
        assert!(!"tcp:h:0".parse::<Endpoint>().unwrap().can_be_shared());
        assert!(!"hid-tcp:h:0".parse::<Endpoint>().unwrap().can_be_shared());
        assert!("tcp:h:1".parse::<Endpoint>().unwrap().can_be_shared());
        assert!("pty:/p".parse::<Endpoint>().unwrap().can_be_shared());
    }
}
