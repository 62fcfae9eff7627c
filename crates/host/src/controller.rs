//! A controller at the other end of a wire.

use crate::ascii::Unit;
use crate::bits::Bit;
use crate::bus::Bus;
use crate::code::Code;
use crate::error::{Error, Result};
use crate::key::Key;
use crate::model::Model;
use crate::tmcl::Module;
use crate::traffic::TrafficLog;
use crate::types::{Action, Answer, Found, ProgramAction, Status, Value};
use crate::wire::WireError;
use std::ops::Range;

/// How a controller is reached and shown.
#[derive(Clone, Debug)]
pub struct Settings {
    /// What it is.
    pub model: Model,
    /// Its address on a bus; `None` if it is alone at the other end, where addresses do not matter.
    pub address: Option<u8>,
    /// The bits of the status word of its axes.
    pub bits: Vec<Bit>,
}

/// A controller, virtual or real: all that can be known of it comes over its wire.
///
/// Everything can be done at the same time by several tasks; requests go out one after the other. What takes many
/// requests, as an upload does, lets others in between, so that a stop never waits for long. Whatever is dropped in the
/// middle leaves the wire in order for the next one.
pub struct Controller {
    bus: Bus,
    model: Model,
    kind: Kind,
}

enum Kind {
    Ascii(Unit),
    Tmcl(Module),
}

impl Controller {
    /// A controller that nobody has talked to yet.
    pub fn new(bus: Bus, settings: Settings) -> Self {
        let Settings { model, address, bits } = settings;
        let kind = match model.dialect() {
            Some(dialect) => Kind::Ascii(Unit::new(bus.clone(), model, dialect, address, bits)),
            None => Kind::Tmcl(Module::new(bus.clone(), address, bits)),
        };
        Self { bus, model, kind }
    }

    /// A controller that is there, and is what it should be.
    ///
    /// # Errors
    /// Nobody answers, or it is [another model](Error::OtherModel).
    pub async fn open(bus: Bus, settings: Settings) -> Result<Self> {
        let controller = Self::new(bus, settings);
        let found = controller.identify().await?;
        if found.model.as_deref() == Some(controller.model.name()) {
            return Ok(controller);
        }
        Err(Error::OtherModel { found: found.model.unwrap_or(found.version) })
    }

    /// What it is.
    pub const fn model(&self) -> Model {
        self.model
    }

    /// Its address on a bus as far as is known, since it may have been changed over this wire; `None` if it does not
    /// matter.
    pub fn address(&self) -> Option<u8> {
        match &self.kind {
            Kind::Ascii(unit) => unit.address(),
            Kind::Tmcl(module) => module.address(),
        }
    }

    /// What went over its wire.
    pub const fn traffic(&self) -> &TrafficLog {
        self.bus.traffic()
    }

    /// Who it says that it is.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn identify(&self) -> Result<Found> {
        match self.identify_once().await {
            // Somebody else may have been in the middle of something.
            Err(Error::Wire(WireError::Timeout(_)) | Error::Malformed { .. }) => self.identify_once().await,
            found => found,
        }
    }

    async fn identify_once(&self) -> Result<Found> {
        match &self.kind {
            Kind::Ascii(unit) => unit.identify().await,
            Kind::Tmcl(module) => module.identify().await,
        }
    }

    /// What it is doing.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn status(&self) -> Result<Status> {
        let seconds = self.traffic().seconds();
        match &self.kind {
            Kind::Ascii(unit) => unit.status(seconds).await,
            Kind::Tmcl(module) => module.status(seconds).await,
        }
    }

    /// Does something.
    ///
    /// # Errors
    /// [`Error`]. An action of several commands may have been done in part.
    pub async fn act(&self, action: &Action) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.act(action).await,
            Kind::Tmcl(module) => module.act(action).await,
        }
    }

    /// Stops all axes with their deceleration ramps, and all programs.
    ///
    /// # Errors
    /// [`Error`]. All was tried nevertheless, as far as anybody answers.
    pub async fn stop_all(&self) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.stop_all().await,
            Kind::Tmcl(module) => module.stop_all().await,
        }
    }

    /// The value of a parameter. Some commands of ASCII controllers act when they stand alone: the key has to be of
    /// one that has a value.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn read(&self, key: &Key) -> Result<Value> {
        match &self.kind {
            Kind::Ascii(unit) => unit.read(key).await,
            Kind::Tmcl(module) => module.read(key).await,
        }
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn write(&self, key: &Key, value: &Value) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.write(key, value).await,
            Kind::Tmcl(module) => module.write(key, value).await,
        }
    }

    /// Stores parameters so that they outlive the power. TMCL modules store these, one by one; ASCII controllers all
    /// that can be stored.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn store(&self, keys: &[Key]) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.store().await,
            Kind::Tmcl(module) => module.store(keys).await,
        }
    }

    /// Gives all settings the values that they had from the factory. TMCL modules do it themselves and start again;
    /// ASCII controllers, which cannot, are set to these and store them.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn restore_factory(&self, defaults: &[(Key, Value)]) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.restore(defaults).await,
            Kind::Tmcl(module) => module.restore().await,
        }
    }

    /// A line that somebody typed. ASCII controllers get it as it is. For TMCL modules it is a command as in programs,
    /// such as `MVP ABS, 0, 1000` or `GAP 1, 0`, or all of its nine bytes in hexadecimal.
    ///
    /// # Errors
    /// [`Error`]; a refusal is none, but an answer.
    pub async fn terminal(&self, line: &str) -> Result<Answer> {
        match &self.kind {
            Kind::Ascii(unit) => unit.terminal(line).await,
            Kind::Tmcl(module) => module.terminal(line).await,
        }
    }

    /// Replaces the program in its memory.
    ///
    /// # Errors
    /// [`Error`]. The memory has a part of the program then.
    pub async fn download(&self, code: &Code) -> Result<()> {
        match (&self.kind, code) {
            (Kind::Ascii(unit), Code::Ascript(_, lines)) => unit.download(lines).await,
            (Kind::Tmcl(module), Code::Tmcl(commands)) => module.download(commands).await,
            _ => Err(Error::Value("the program is in another language".into())),
        }
    }

    /// The program in its memory.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn upload(&self) -> Result<Code> {
        match &self.kind {
            Kind::Ascii(unit) => unit.upload().await,
            Kind::Tmcl(module) => module.upload().await,
        }
    }

    /// Tells one of its programs what to do.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn program(&self, number: u8, action: ProgramAction) -> Result<()> {
        match &self.kind {
            Kind::Ascii(unit) => unit.program(number, action).await,
            Kind::Tmcl(module) => module.program(number, action).await,
        }
    }

    /// Variables of its programs.
    ///
    /// # Errors
    /// [`Error`].
    pub async fn variables(&self, numbers: Range<u16>) -> Result<Vec<i32>> {
        if numbers.end > self.model.variables() {
            return Err(Error::NoSuch(format!("variable {}", numbers.end - 1)));
        }
        let count = numbers.end.saturating_sub(numbers.start);
        match &self.kind {
            Kind::Ascii(unit) => unit.variables(numbers.start, count).await,
            Kind::Tmcl(module) => module.variables(numbers.start, count).await,
        }
    }
}
