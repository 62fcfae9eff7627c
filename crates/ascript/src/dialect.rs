//! What the controllers that speak the language have more or less of.

/// The language as one family of controllers has it.
#[derive(Debug)]
pub struct Dialect {
    /// Its name, for messages.
    pub name: &'static str,
    /// Names of the axes, in order.
    pub axes: &'static str,
    /// How many programs run side by side.
    pub threads: u8,
    /// How many compiled lines there is room for.
    pub lines: u16,
    /// How many variables there are.
    pub variables: u8,
}

/// Performax with two axes.
pub static PERFORMAX_2: Dialect =
    Dialect { name: "Performax 2ED", axes: "XY", threads: 2, lines: 1275, variables: 64 };

/// Commander core.
pub static COMMANDER: Dialect =
    Dialect { name: "Commander core", axes: "XYZU", threads: 4, lines: 1800, variables: 100 };
