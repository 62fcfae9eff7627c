//! The command line.

use clap::{Args as Group, Parser, Subcommand};
use devices::Model;
use sim::{Endpoint, TimedInput, config::is_name};
use std::{num::NonZero, path::PathBuf, str::FromStr};

/// Virtual stepper motion controllers, and the tools for their programs.
#[derive(Parser)]
#[command(name = "pulsetrain", version, subcommand_required = true, arg_required_else_help = true)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Subcommand)]
pub enum Command {
    /// Serve virtual controllers over TCP, pseudo-terminals, CAN adapters and USB HID
    Serve(ServeArgs),
    /// Run a program in virtual time
    Run(RunArgs),
    /// Play again what `run` or `serve` took down on a tape (.ptr), and print all that happens
    Replay(ReplayArgs),
    /// What bench files may say
    Bench {
        /// What to do
        #[command(subcommand)]
        command: BenchCommand,
    },
    /// Draw a recording
    Plot(PlotArgs),
    /// Run a program line by line in virtual time, forwards and backwards
    Debug(DebugArgs),
    /// The same for editors, which speak the Debug Adapter Protocol over standard input and output
    Dap,
    /// Tell editors about programs while they are typed: the Language Server Protocol over standard input and output
    Lsp(LspArgs),
    /// Assemble a TMCL program
    Asm(AsmArgs),
    /// Print a TMCL program as assembly language
    Disasm(DisasmArgs),
    /// Compile an A-SCRIPT program
    Compile(CompileArgs),
    /// Print a compiled A-SCRIPT program as source
    Decompile(DecompileArgs),
    /// Look for mistakes in a program
    Check(CheckArgs),
    /// Lay out the sources of programs
    Fmt(FmtArgs),
    /// Print a shell's completions
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// What to do with bench files.
#[derive(Subcommand)]
pub enum BenchCommand {
    /// Print all keys of bench files
    Keys,
    /// Print the JSON Schema of bench files, for editors
    Schema,
    /// Look for mistakes in a bench file, and print its devices
    Check {
        /// The bench file
        file: PathBuf,
    },
}

/// Arguments of `serve`.
#[derive(Group)]
#[command(after_help = "\
ENDPOINT is tcp:HOST:PORT (port 0 picks one), pty:PATH (PATH becomes a link to the terminal),
slcan-tcp:HOST:PORT, or hid-tcp:HOST:PORT and hid-unix:PATH for the 64-byte reports of USB HID, of which the
first one from the device is its name. Devices with the same endpoint share an RS-485 or CAN bus; a name
that is there again is the same device at one more endpoint. Without devices and bench file there is one of
each model, on ports 4001, 4002, ... of 127.0.0.1.")]
pub struct ServeArgs {
    /// A device and where it listens
    #[arg(value_name = "MODEL[=NAME]@ENDPOINT")]
    pub devices: Vec<DeviceArg>,
    /// Bench file with devices and the machines that they move
    #[arg(long, value_name = "FILE")]
    pub bench: Option<PathBuf>,
    /// Where HTTP listens
    #[arg(long, value_name = "ADDR:PORT", default_value = "127.0.0.1:8340")]
    pub http: String,
    /// No HTTP
    #[arg(long, conflicts_with = "http")]
    pub no_http: bool,
    /// Certificate for HTTPS (PEM), which other machines may use
    #[arg(long, value_name = "FILE", requires = "tls_key", conflicts_with = "no_http")]
    pub tls_cert: Option<PathBuf>,
    /// Its private key (PEM)
    #[arg(long, value_name = "FILE", requires = "tls_cert")]
    pub tls_key: Option<PathBuf>,
    /// Let other machines connect without TLS: who listens in learns the token
    #[arg(long, conflicts_with_all = ["no_http", "tls_cert"])]
    pub insecure: bool,
    /// Seconds of device time a second
    #[arg(long, value_name = "N", default_value = "1", value_parser = speed, allow_negative_numbers = true)]
    pub speed: f64,
    /// Threads that serve devices, as many as there are processors unless set otherwise
    #[arg(long, value_name = "N")]
    pub workers: Option<NonZero<usize>>,
    /// Directory for flash images; without it they live in memory
    #[arg(long, value_name = "DIR")]
    pub state: Option<PathBuf>,
    /// Faults of the machines, and when they begin
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
    /// Write what happens to a file (.csv, .mcap, .parquet, .png, .svg or .vcd, one for each device; .ptr, a tape of
    /// all)
    #[arg(long, value_name = "FILE")]
    pub record: Vec<PathBuf>,
}

/// Arguments of `run`.
#[derive(Group)]
pub struct RunArgs {
    /// The program: source of TMCL (.tmc) or A-SCRIPT (.prg, .txt), or machine code (.bin)
    pub program: PathBuf,
    /// The controller that runs it
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: &'static Model,
    /// Bench file; its first device of the model tells the machine
    #[arg(long, value_name = "FILE")]
    pub bench: Option<PathBuf>,
    /// Device time after which the run ends
    #[arg(long = "for", value_name = "SECONDS", default_value = "3600", value_parser = seconds, allow_negative_numbers = true)]
    pub limit_s: f64,
    /// Drive a pin (true, false or a number) at a time in seconds, or `release` it
    #[arg(long, value_name = "TIME:PIN=VALUE")]
    pub at: Vec<TimedInput>,
    /// Faults of the machine, and when they begin
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
    /// Write what happened to a file (.csv, .mcap, .parquet or .vcd), or all that the device was told (.ptr)
    #[arg(long, value_name = "FILE")]
    pub record: Vec<PathBuf>,
    /// Draw what happened (.svg or .png)
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `debug`.
#[derive(Group)]
pub struct DebugArgs {
    /// The program: source of TMCL (.tmc) or A-SCRIPT (.prg, .txt), or machine code (.bin)
    pub program: PathBuf,
    /// The controller that runs it
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: &'static Model,
    /// Bench file; its first device of the model tells the machine
    #[arg(long, value_name = "FILE")]
    pub bench: Option<PathBuf>,
    /// Device time after which the program stands
    #[arg(long = "for", value_name = "SECONDS", default_value = "3600", value_parser = seconds, allow_negative_numbers = true)]
    pub limit_s: f64,
    /// Drive a pin (true, false or a number) at a time in seconds, or `release` it
    #[arg(long, value_name = "TIME:PIN=VALUE")]
    pub at: Vec<TimedInput>,
    /// Faults of the machine, and when they begin
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
}

/// Arguments of `replay`.
#[derive(Group)]
pub struct ReplayArgs {
    /// The tape
    #[arg(value_name = "FILE.ptr")]
    pub tape: PathBuf,
    /// Write what happens to a file as well (.csv, .mcap, .parquet, .png, .svg or .vcd), one for each device
    #[arg(long, value_name = "FILE")]
    pub record: Vec<PathBuf>,
}

/// Arguments of `plot`.
#[derive(Group)]
pub struct PlotArgs {
    /// The recording (.csv, .mcap, .parquet or .vcd), or a tape (.ptr), which is played
    #[arg(value_name = "FILE")]
    pub recording: PathBuf,
    /// The picture (.svg or .png), one for each device of a tape; without it FILE with the extension .svg
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}

/// Arguments of `lsp`.
#[derive(Group)]
pub struct LspArgs {
    /// The model that A-SCRIPT programs are for, if the editor's settings say nothing [default: that for which they
    /// are right]
    #[arg(long, value_parser = model)]
    pub device: Option<&'static Model>,
}

/// Arguments of `asm`.
#[derive(Group)]
pub struct AsmArgs {
    /// The source
    #[arg(value_name = "IN.tmc")]
    pub input: PathBuf,
    /// The machine code
    #[arg(short, long, value_name = "OUT.bin", required_unless_present_any = ["symbols", "list"])]
    pub output: Option<PathBuf>,
    /// Write the symbols with their values, one a line
    #[arg(long, value_name = "FILE")]
    pub symbols: Option<PathBuf>,
    /// Print every command with its address and bytes
    #[arg(long)]
    pub list: bool,
}

/// Arguments of `disasm`.
#[derive(Group)]
pub struct DisasmArgs {
    /// The machine code
    #[arg(value_name = "IN.bin")]
    pub input: PathBuf,
}

/// Arguments of `compile`.
#[derive(Group)]
pub struct CompileArgs {
    /// The source
    #[arg(value_name = "IN.prg")]
    pub input: PathBuf,
    /// The controller that is to run it
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: &'static Model,
    /// The compiled lines
    #[arg(short, long, value_name = "OUT", required_unless_present = "list")]
    pub output: Option<PathBuf>,
    /// Print every compiled line with its number
    #[arg(long)]
    pub list: bool,
}

/// Arguments of `decompile`.
#[derive(Group)]
pub struct DecompileArgs {
    /// The compiled lines
    #[arg(value_name = "OUT")]
    pub input: PathBuf,
    /// The controller that they are for
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: &'static Model,
}

/// Arguments of `check`.
#[derive(Group)]
pub struct CheckArgs {
    /// The program: source of TMCL (.tmc) or A-SCRIPT (.prg, .txt), or machine code (.bin)
    pub file: PathBuf,
    /// The controller that is to run it
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: &'static Model,
}

/// Arguments of `fmt`.
#[derive(Group)]
pub struct FmtArgs {
    /// Sources, which are rewritten; `-` is standard input, and the result goes to standard output
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Change nothing; the exit status is 1 if there is something to change
    #[arg(long)]
    pub check: bool,
    /// The controller that they are for
    #[arg(long, value_name = "MODEL", value_parser = model)]
    pub device: Option<&'static Model>,
}

/// `MODEL[=NAME]@ENDPOINT`
#[derive(Clone)]
pub struct DeviceArg {
    /// What it is.
    pub model: &'static Model,
    /// What it is called.
    pub name: String,
    /// Where it listens.
    pub endpoint: Endpoint,
}

impl FromStr for DeviceArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (device, endpoint) = text.split_once('@').ok_or("write MODEL[=NAME]@ENDPOINT")?;
        let (model_name, name) = device.split_once('=').unwrap_or((device, device));
        let model = model(model_name)?;
        if !is_name(name) {
            return Err(format!("`{name}` is not a name: letters, digits, `.`, `_`, `-`"));
        }
        let endpoint = endpoint.parse().map_err(|error| format!("{error}"))?;
        Ok(Self { model, name: name.into(), endpoint })
    }
}

fn model(name: &str) -> Result<&'static Model, String> {
    devices::model(name).ok_or_else(|| {
        let known: Vec<_> = devices::MODELS.iter().map(|model| model.name).collect();
        format!("unknown model `{name}`, known: {}", known.join(", "))
    })
}

fn speed(text: &str) -> Result<f64, String> {
    let range = server::SPEEDS;
    let speed = text.parse().ok().filter(|speed| range.contains(speed));
    speed.ok_or_else(|| format!("a speed is a number from {} to {}", range.start(), range.end()))
}

/// Longest run: the pulses of a century still fit all counters of time.
const MAX_RUN_S: f64 = 1e9;

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=MAX_RUN_S).contains(seconds));
    seconds.ok_or_else(|| format!("a time is a number of seconds from 0 to {MAX_RUN_S}"))
}
