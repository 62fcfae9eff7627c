//! Who is there on a wire.

use crate::ascii;
use crate::bus::Bus;
use crate::error::{Error, Result};
use crate::tmcl;
use crate::types::Found;
use crate::wire::{End, WireError};
use std::time::Duration;

/// How long an address gets to answer: a request and a reply at 9600 baud and a converter's delay. With the silence
/// behind it, it is longer than TMCL modules wait for the rest of a frame, so that a line of text never becomes part of
/// one.
const PATIENCE: Duration = Duration::from_millis(80);

/// The highest address of a controller that is told lines of text (PMX-2ED-SA manual, 6.3; CMD-4CR manual, 3.3).
const MAX_ASCII_ADDRESS: u8 = 99;

/// An address that is asked to see whether addresses matter at all: the last one that anybody would choose.
const PROBE: u8 = u8::MAX;

/// Looks for controllers on a wire. Who answers without an address, or to any, is alone there. Otherwise every address
/// is asked, first as text, then as TMCL; that takes most of a minute over a line on which nobody answers.
///
/// # Errors
/// The wire is broken. That nobody answers is no error.
pub async fn find(bus: &Bus) -> Result<Vec<Found>> {
    if let Some(found) = heard(ascii::identify(bus, None, PATIENCE).await)? {
        return Ok(vec![found]);
    }
    // Over USB a module does not look at addresses, and says its own.
    if let Some(found) = heard(tmcl::identify(bus, PROBE, PATIENCE).await)?.filter(|it| it.address != PROBE) {
        return Ok(vec![found]);
    }
    end_line(bus).await?;
    let mut all = Vec::new();
    for address in 0..=MAX_ASCII_ADDRESS {
        all.extend(heard(ascii::identify(bus, Some(address), PATIENCE).await)?);
    }
    for address in 1..=u8::MAX {
        all.extend(heard(tmcl::identify(bus, address, PATIENCE).await)?);
    }
    end_line(bus).await?;
    Ok(all)
}

/// To whoever listens for text a frame was the beginning of a line, which must not become part of the next one.
async fn end_line(bus: &Bus) -> Result<()> {
    let mut talk = bus.talk().await;
    talk.exchange(b"\r", "", End::Silence, PATIENCE, |_| String::new()).await?;
    // Modules have to forget it.
    talk.doubt();
    Ok(())
}

/// Who answered, if somebody did. What makes no sense is no controller of ours.
fn heard(answer: Result<Found>) -> Result<Option<Found>> {
    match answer {
        Ok(found) => Ok(Some(found)),
        Err(Error::Wire(WireError::Timeout(_)) | Error::Malformed { .. } | Error::Refused { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
