//! Third-party clients, unmodified and from their registry, against the program itself.

use crate::{
    rust, tools,
    workplace::{Workplace, run},
};
use anyhow::Result;

/// Builds the program and runs `clients/` with pytest.
pub fn check(workplace: &Workplace) -> Result<()> {
    let python = tools::python(workplace)?;
    let program = rust::binary(workplace)?;
    run(workplace.command(python, &["-m", "pytest", "clients"]).env("PULSETRAIN", program))
}
