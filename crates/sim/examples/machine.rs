//! Prints the machines of devices as JSON, one a line: `machine BENCH.toml`, or `machine MODEL...` for models in
//! their usual machines.

use sim::{Bench, DeviceConfig, machine::MachineTable};
use std::{error::Error, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    for argument in std::env::args().skip(1) {
        let devices = match devices::model(&argument) {
            Some(model) => vec![DeviceConfig::new(model)],
            None => Bench::read(Path::new(&argument))?.devices,
        };
        for device in &devices {
            println!("{}", serde_json::to_string(&MachineTable::of(device))?);
        }
    }
    Ok(())
}
