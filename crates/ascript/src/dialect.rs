//! What the controllers that speak the language have more or less of.

/// Names of axes, of which a dialect has the first ones.
const AXES: &str = "XYZU";

/// A family of controllers; it decides which words there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Family {
    /// Performax (PMX manual, table 10.0).
    Performax = 1,
    /// Commander core (CMD manual, table 5-42).
    Commander = 2,
}

/// The language as one family of controllers has it.
#[derive(Debug, PartialEq, Eq)]
pub struct Dialect {
    /// Its name, for messages.
    pub name: &'static str,
    /// Whose words it has.
    pub family: Family,
    /// Names of the axes, in order.
    pub axes: &'static str,
    /// How many programs run side by side.
    pub threads: u8,
    /// The command with which hosts stop and start them, before the number.
    pub control: &'static str,
    /// How many compiled lines there is room for.
    pub lines: u16,
    /// How many variables there are.
    pub variables: u8,
    /// Digital inputs, numbered from 1; so are the ports below.
    pub inputs: u8,
    /// Digital outputs.
    pub outputs: u8,
    /// Configurable inputs and outputs.
    pub ports: u8,
    /// Analog inputs.
    pub analog_inputs: u8,
    /// PWM outputs.
    pub pwm_outputs: u8,
    /// Homing modes that `HOME` chooses from, numbered from 0; none if it has no choice.
    pub homing_modes: u8,
}

/// Performax with two axes.
pub static PERFORMAX_2: Dialect = Dialect {
    name: "Performax 2ED",
    family: Family::Performax,
    axes: "XY",
    threads: 2,
    control: "SR",
    lines: 1275,
    variables: 64,
    inputs: 8,
    outputs: 8,
    ports: 0,
    analog_inputs: 2,
    pwm_outputs: 0,
    homing_modes: 0,
};

/// Commander core.
pub static COMMANDER: Dialect = Dialect {
    name: "Commander core",
    family: Family::Commander,
    axes: "XYZU",
    threads: 4,
    control: "SACTRL",
    lines: 1800,
    variables: 100,
    inputs: 4,
    outputs: 4,
    ports: 32,
    analog_inputs: 2,
    pwm_outputs: 2,
    homing_modes: 13,
};

impl Dialect {
    /// The number of the axis of this name.
    pub fn axis(&self, name: char) -> Option<u8> {
        self.axes.chars().zip(0..).find(|&(axis, _)| axis == name).map(|(_, number)| number)
    }

    /// How many axes there are.
    pub const fn axis_count(&self) -> u8 {
        self.axes.len() as u8
    }
}

/// The name of an axis.
pub(crate) fn axis_name(axis: u8) -> char {
    AXES.as_bytes().get(usize::from(axis)).copied().map_or('?', char::from)
}
