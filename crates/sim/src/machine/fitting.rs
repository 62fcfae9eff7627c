//! What a model comes with before a bench file says anything: the travel of a usual axis and the encoders
//! that its inputs are made for.

/// Where an encoder sits and how it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoder {
    /// Built into the motor: so many counts a revolution on the motor's own shaft, with an absolute zero
    /// in each.
    BuiltIn(i64),
    /// On the driven side, behind the backlash, counting pulses.
    External,
}

/// What belongs to a model.
pub(crate) struct Fitting {
    model: &'static str,
    /// The switches stand this many pulses to either side.
    pub limit: i64,
    /// Into how many positions its own driver divides a full step, if it has one.
    pub full_step: Option<u32>,
    /// The encoders of each axis, in the order of their channels.
    pub encoders: &'static [Encoder],
}

const GENERAL: Fitting =
    Fitting { model: "", limit: 1_000_000, full_step: None, encoders: &[Encoder::External] };

const FITTINGS: &[Fitting] = &[
    // SensOstep has 1,024 positions a revolution (manual 6.2); an ABN encoder may be added (6.3).
    Fitting {
        model: "pd42-1140",
        limit: 10_000_000,
        full_step: Some(256),
        encoders: &[Encoder::BuiltIn(1024), Encoder::External],
    },
];

/// The fitting of a model, by its name.
pub(crate) fn fitting(model: &str) -> &'static Fitting {
    FITTINGS.iter().find(|fitting| fitting.model == model).unwrap_or(&GENERAL)
}
