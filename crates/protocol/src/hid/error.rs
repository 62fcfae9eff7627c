//! What the functions of the vendor's library return (manual, 3.1.2.2 to 3.1.2.7).

use core::fmt;

/// What a function returns that did what it was asked.
pub const SUCCEEDED: i32 = 1;

/// What a function returns for a question without an answer, as for the name of a device that is one beyond
/// the last. Where the communication failed it returns an [`ApiError`].
pub const FAILED: i32 = 0;

/// How communication with a device fails (table 3-37). The discriminant is the number that is returned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(i32)]
pub enum ApiError {
    /// The device does not answer in time.
    TimeOut = -1,
    /// The connection broke.
    Communication = -2,
    /// What was asked for makes no sense here.
    Function = -3,
    /// No device has this name.
    NoDevice = -4,
    /// The way to the device is not there.
    NoPath = -5,
    /// The device does not let us in.
    Refused = -6,
    /// The handle belongs to no open device.
    Handle = -7,
    /// A buffer of the caller is too small.
    SmallMemory = -8,
    /// There is no more memory.
    NoMemory = -9,
    /// Somebody else has it at the moment.
    Protected = -10,
    /// The report was not sent.
    Write = -11,
    /// The report that came cannot be read.
    Read = -12,
    /// An argument is wrong.
    Parameter = -13,
    /// The device was found and not opened.
    Open = -14,
    /// The report that came has another ID than 0.
    ReportId = -15,
    /// The report that came is too short or too long.
    ReportSize = -16,
    /// None of the others.
    Unknown = -255,
}

impl ApiError {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 17] = [
        Self::TimeOut,
        Self::Communication,
        Self::Function,
        Self::NoDevice,
        Self::NoPath,
        Self::Refused,
        Self::Handle,
        Self::SmallMemory,
        Self::NoMemory,
        Self::Protected,
        Self::Write,
        Self::Read,
        Self::Parameter,
        Self::Open,
        Self::ReportId,
        Self::ReportSize,
        Self::Unknown,
    ];

    /// The number that a function returns.
    pub const fn code(self) -> i32 {
        self as i32
    }

    /// The error with this number.
    pub fn of_code(code: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|error| error.code() == code)
    }

    /// What it means, for people.
    pub const fn text(self) -> &'static str {
        match self {
            Self::TimeOut => "no answer in time",
            Self::Communication => "the connection to the device broke",
            Self::Function => "this cannot be asked for now",
            Self::NoDevice => "there is no such device",
            Self::NoPath => "there is no way to the device",
            Self::Refused => "the device refuses the connection",
            Self::Handle => "the handle belongs to no open device",
            Self::SmallMemory => "the buffer is too small",
            Self::NoMemory => "out of memory",
            Self::Protected => "the device is in use",
            Self::Write => "the report cannot be sent",
            Self::Read => "the report cannot be read",
            Self::Parameter => "an argument is wrong",
            Self::Open => "the device cannot be opened",
            Self::ReportId => "the report has an unknown ID",
            Self::ReportSize => "the report has the wrong size",
            Self::Unknown => "unknown error",
        }
    }
}

impl fmt::Display for ApiError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}

impl core::error::Error for ApiError {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Table 3-37.
    #[test]
    fn codes() {
        let codes: Vec<i32> = ApiError::ALL.map(ApiError::code).to_vec();
        assert_eq!(codes, (1..=16).map(|code| -code).chain([-255]).collect::<Vec<_>>());
        let check = |code, expected| assert_eq!(ApiError::of_code(code), expected);
        check(-1, Some(ApiError::TimeOut));
        check(-10, Some(ApiError::Protected));
        check(-16, Some(ApiError::ReportSize));
        check(-255, Some(ApiError::Unknown));
        for code in [SUCCEEDED, FAILED, -17, -254, i32::MIN, i32::MAX] {
            check(code, None);
        }
    }

    #[test]
    fn every_error_has_words_of_its_own() {
        let texts: BTreeSet<String> = ApiError::ALL.iter().map(ToString::to_string).collect();
        assert_eq!(texts.len(), ApiError::ALL.len());
        assert!(!texts.contains(""));
    }
}
