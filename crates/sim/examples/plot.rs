//! Runs a compiled TMCL program on a PD42-1140 and draws what happens:
//! `cargo run -p sim --example plot -- PROGRAM.bin PLOT.svg [SECONDS]`.

use sim::{DeviceConfig, Program, RunOptions, VirtualDevice, record, run};
use std::{error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [program, plot, rest @ ..] = arguments.as_slice() else {
        return Err("PROGRAM.bin PLOT.svg [SECONDS]".into());
    };
    let for_seconds = rest.first().map(|seconds| seconds.parse()).transpose()?;
    let model = devices::model("pd42-1140").ok_or("the model is missing")?;
    let mut device = VirtualDevice::new(&DeviceConfig::new(model), 1);
    let recorder = record::create(Path::new(plot), &device.record_info())?;
    device.add_recorder(recorder);
    let options = RunOptions { for_seconds, ..RunOptions::default() };
    let program = Program::Tmcl(tmcl::image::from_bytes(&fs::read(program)?)?);
    let result = run(&mut device, &program, &options, |_| ())?;
    device.finish_recordings()?;
    println!(
        "{} after {} s, {} instructions",
        result.stop_reason.name(),
        result.device_seconds,
        result.instructions
    );
    Ok(())
}
