//! How a controller is reached, and whether it is.

use super::wire::UnitWire;
use crate::unit::Unit;
use devices::{
    Port,
    guide::{BitKind, Guide, StatusBit},
};
use host::{Bit, Bus, Controller, Error, Settings, WireError, Wires};
use serde::Serialize;
use std::{
    fmt, io,
    str::FromStr,
    sync::{self, Arc},
};
use tokio::sync::{Mutex, watch};
use ts_rs::TS;
use utoipa::ToSchema;

/// The baud rate of all three controllers from the factory.
const DEFAULT_BAUD: u32 = 9600;

/// Whether a controller can be reached.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
#[serde(tag = "state", rename_all = "snake_case")]
pub(crate) enum LinkState {
    /// It answers.
    Up,
    /// Nobody has tried yet, or somebody is trying.
    Connecting,
    /// It does not answer.
    Lost {
        /// Why.
        reason: String,
    },
}

/// Where a real controller is: `serial:/dev/ttyUSB0:9600`, `tcp:HOST:PORT`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At a serial port.
    Serial {
        /// The port.
        path: String,
        /// Bits a second.
        baud: u32,
    },
    /// Behind a TCP port, as that of a serial device server.
    Tcp {
        /// Host and port.
        address: String,
    },
}

/// A text that names no place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a link: write serial:PATH:BAUD or tcp:HOST:PORT")]
pub(crate) struct PlaceError(String);

impl FromStr for Place {
    type Err = PlaceError;

    fn from_str(text: &str) -> Result<Self, PlaceError> {
        let wrong = || PlaceError(text.into());
        match text.split_once(':').ok_or_else(wrong)? {
            ("tcp", address) => {
                let (host, port) = address.rsplit_once(':').ok_or_else(wrong)?;
                let is_port = port.parse::<u16>().is_ok_and(|port| port != 0);
                (!host.is_empty() && is_port).then(|| Self::Tcp { address: address.into() }).ok_or_else(wrong)
            }
            ("serial", rest) => {
                let (path, baud) = match rest.rsplit_once(':') {
                    Some((path, baud)) => (path, baud.parse().map_err(|_| wrong())?),
                    None => (rest, DEFAULT_BAUD),
                };
                (!path.is_empty()).then(|| Self::Serial { path: path.into(), baud }).ok_or_else(wrong)
            }
            _ => Err(wrong()),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial { path, baud } => write!(f, "serial:{path}:{baud}"),
            Self::Tcp { address } => write!(f, "tcp:{address}"),
        }
    }
}

/// The wires to real controllers, which are the whole process': a serial port opens once, whoever hangs on it.
static WIRES: Wires = Wires::new();

impl Place {
    /// The wire there, opened unless it is open.
    pub async fn open(&self) -> io::Result<Bus> {
        let open = async || {
            io::Result::Ok(match self {
                Self::Serial { path, baud } => Bus::new(host::serial(path, *baud)?),
                Self::Tcp { address } => Bus::new(host::tcp(address).await?),
            })
        };
        WIRES.open(&self.to_string(), open).await
    }
}

/// What is at the far end.
pub(crate) enum End {
    /// A device in this process, by this port.
    Unit(Arc<Unit>, Port),
    /// A controller that somebody has connected, with its address if it has company: the one that it had last.
    Real(Place, sync::Mutex<Option<u8>>),
}

/// A wire that is open.
struct Open {
    controller: Arc<Controller>,
    /// The address that it was opened for.
    address: Option<u8>,
}

/// The way to a controller, which opens when it is needed and again when it is lost.
pub(crate) struct Link {
    end: End,
    model: host::Model,
    guide: &'static Guide,
    open: Mutex<Option<Open>>,
    state: watch::Sender<LinkState>,
}

impl Link {
    /// A way that nobody has gone yet.
    pub fn new(end: End, model: host::Model, guide: &'static Guide) -> Self {
        let (open, state) = (Mutex::default(), watch::Sender::new(LinkState::Connecting));
        Self { end, model, guide, open, state }
    }

    /// Whether it is open, and each change of that.
    pub fn state(&self) -> watch::Receiver<LinkState> {
        self.state.subscribe()
    }

    /// Asks the controller something. A wire that fails is closed, and opened anew the next time.
    ///
    /// # Errors
    /// What the controller or the wire says.
    pub async fn ask<T>(
        &self,
        question: impl AsyncFnOnce(&Controller) -> host::Result<T>,
    ) -> host::Result<T> {
        let controller = self.controller().await?;
        let answer = question(&controller).await;
        if let Err(error @ (Error::Wire(_) | Error::OtherModel { .. })) = &answer {
            self.lose(&controller, error).await;
        }
        answer
    }

    /// The controller. The wire to it is opened if it is not.
    ///
    /// # Errors
    /// It cannot be opened, or nobody answers there, or somebody else.
    pub async fn controller(&self) -> host::Result<Arc<Controller>> {
        let mut open = self.open.lock().await;
        let address = self.address();
        if let Some(open) = open.as_ref().filter(|open| open.address == address) {
            return Ok(Arc::clone(&open.controller));
        }
        match self.connect(address).await {
            Ok(controller) => {
                self.say(LinkState::Up);
                let controller = Arc::new(controller);
                *open = Some(Open { controller: Arc::clone(&controller), address });
                Ok(controller)
            }
            Err(error) => {
                *open = None;
                self.say(LinkState::Lost { reason: error.to_string() });
                Err(error)
            }
        }
    }

    /// The controller if it is connected; nothing is waited for.
    pub fn present(&self) -> Option<Arc<Controller>> {
        self.open.try_lock().ok()?.as_ref().map(|open| Arc::clone(&open.controller))
    }

    async fn connect(&self, address: Option<u8>) -> host::Result<Controller> {
        let bus = match &self.end {
            End::Unit(unit, port) => Bus::new(UnitWire::new(Arc::clone(unit), *port)),
            End::Real(place, _) => place.open().await.map_err(WireError::System)?,
        };
        let bit = |bit: &StatusBit| Bit {
            number: bit.bit,
            name: bit.name.into(),
            is_error: bit.kind == BitKind::Error,
        };
        let bits = self.guide.status_bits.iter().map(bit).collect();
        Controller::open(bus, Settings { model: self.model, address, bits }).await
    }

    /// The address that it has now. A search would find that of a device too, and be on every tape.
    fn address(&self) -> Option<u8> {
        match &self.end {
            End::Unit(unit, Port::Rs485) => Some(unit.with(|device| device.bus_address())),
            End::Unit(..) => None,
            End::Real(_, address) => *known(address),
        }
    }

    async fn lose(&self, controller: &Arc<Controller>, error: &Error) {
        let mut open = self.open.lock().await;
        if open.take_if(|open| Arc::ptr_eq(&open.controller, controller)).is_some() {
            if let End::Real(_, address) = &self.end {
                *known(address) = controller.address();
            }
            self.say(LinkState::Lost { reason: error.to_string() });
        }
    }

    fn say(&self, state: LinkState) {
        self.state.send_if_modified(|present| {
            let is_new = *present != state;
            *present = state;
            is_new
        });
    }
}

/// An address is known or not, whoever panicked.
fn known(address: &sync::Mutex<Option<u8>>) -> sync::MutexGuard<'_, Option<u8>> {
    address.lock().unwrap_or_else(sync::PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places() {
        let check = |text: &str, expected: Option<&str>| {
            let place = text.parse::<Place>().ok().map(|place| place.to_string());
            assert_eq!(place.as_deref(), expected, "{text}");
        };
        check("serial:/dev/ttyUSB0:115200", Some("serial:/dev/ttyUSB0:115200"));
        check("serial:/dev/ttyUSB0", Some("serial:/dev/ttyUSB0:9600"));
        check("tcp:box:4001", Some("tcp:box:4001"));
        check("tcp:[::1]:4001", Some("tcp:[::1]:4001"));
        for wrong in ["", "serial:", "serial:/dev/x:fast", "tcp:4001", "tcp:box:0", "tcp::1", "usb:1"] {
            check(wrong, None);
        }
    }
}
