//! Runs a program in virtual time and prints every pulse: `pulses MODEL PROGRAM`, where the program is machine
//! code of TMCL or compiled lines of A-SCRIPT. A line has the axis, `+` or `-`, and the clock of the controller.

use devices::{AxisState, Drive, Language};
use motion::{Direction, Ticks, Train};
use sim::{
    DeviceConfig, Program, RunOptions, VirtualDevice,
    record::{Mark, RecordError, Recorder},
};
use std::{
    error::Error,
    fs,
    io::{BufWriter, Write, stdout},
};

/// Prints trains pulse by pulse.
struct Printer<W: Write>(BufWriter<W>, Result<(), std::io::Error>);

impl<W: Write> Recorder for Printer<W> {
    fn train(&mut self, axis: usize, train: &Train) {
        let sign = if train.direction == Direction::Positive { '+' } else { '-' };
        for edge in train.edges() {
            if self.1.is_ok() {
                self.1 = writeln!(self.0, "{axis} {sign} {edge}");
            }
        }
    }

    fn drive(&mut self, _: Ticks, _: usize, _: Drive) {}

    fn pin(&mut self, _: Ticks, _: usize, _: i32) {}

    fn mark(&mut self, _: Ticks, _: usize, _: Mark) {}

    fn sample(&mut self, _: Ticks, _: usize, _: &AxisState) {}

    fn finish(&mut self, _: Ticks) -> Result<(), RecordError> {
        let done = std::mem::replace(&mut self.1, Ok(())).and_then(|()| self.0.flush());
        done.map_err(|error| RecordError::Write { path: "-".into(), problem: error.to_string() })
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [model, file] = &arguments[..] else { return Err("pulses MODEL PROGRAM".into()) };
    let model = devices::model(model).ok_or("no such model")?;
    let bytes = fs::read(file)?;
    let program = match model.language {
        Language::Tmcl => Program::Tmcl(tmcl::image::from_bytes(&bytes)?),
        Language::Ascript(dialect) => Program::Ascript(ascript::image::from_file(&bytes, dialect)?),
    };
    let mut device = VirtualDevice::new(&DeviceConfig::new(model), 0);
    device.add_recorder(Box::new(Printer(BufWriter::new(stdout()), Ok(()))));
    let result = sim::run(&mut device, &program, &RunOptions::default(), |_| {})?;
    device.finish_recordings()?;
    for (name, axis) in result.axes {
        eprintln!("axis {name}: position {}, steps {}", axis.position, axis.steps);
    }
    Ok(())
}
