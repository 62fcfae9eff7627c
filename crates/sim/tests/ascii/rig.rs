//! A controller on a bench, and short words for talking to it.

use crate::controller::{AXES, CONTROL, DIALECT, HZ, MODEL};
use devices::{Port, model};
use sim::{AxisConfig, DeviceConfig, PinValue, SharedFlash, VirtualDevice};

/// A controller with its machine.
pub struct Rig {
    pub device: VirtualDevice,
}

impl Rig {
    /// Limits far away, home from −200 to 0, motors on.
    pub fn new() -> Self {
        Self::with(|_| ())
    }

    /// With another machine on all axes.
    pub fn with(change: impl Fn(&mut AxisConfig)) -> Self {
        let mut config = config();
        for name in AXES {
            let mut axis = config.axis(name);
            change(&mut axis);
            config.axes.insert(name.into(), axis);
        }
        let mut rig = Self { device: VirtualDevice::new(&config, 1) };
        rig.motors(true);
        rig
    }

    /// On a given flash.
    pub fn on(flash: SharedFlash) -> Self {
        Self { device: VirtualDevice::with_flash(&config(), flash, 1) }
    }

    /// Lets device time pass.
    pub fn pass_ms(&mut self, ms: u64) {
        self.pass_us(1000 * ms);
    }

    /// Lets device time pass.
    pub fn pass_us(&mut self, us: u64) {
        let until = self.device.now() + us * HZ / 1_000_000;
        self.device.advance(until);
    }

    /// Sends bytes over a port and gives what comes back at once.
    pub fn bytes(&mut self, port: Port, bytes: &[u8]) -> Vec<u8> {
        self.device.receive(port, bytes);
        self.device.drain_sent().flat_map(|sent| sent.bytes).collect()
    }

    /// Sends a command over USB; its reply, empty if there is none.
    pub fn say(&mut self, command: &str) -> String {
        let reply = self.bytes(Port::Usb, format!("{command}\r").as_bytes());
        let reply = String::from_utf8(reply).expect("replies are ASCII");
        reply.strip_suffix('\r').unwrap_or(&reply).to_owned()
    }

    /// A command with this reply.
    #[track_caller]
    pub fn check(&mut self, command: &str, reply: &str) {
        assert_eq!(self.say(command), reply, "{command}");
    }

    /// Commands that are done.
    #[track_caller]
    pub fn ok(&mut self, commands: &str) {
        for command in commands.split_whitespace() {
            self.check(command, "OK");
        }
    }

    /// A command whose reply is a number.
    #[track_caller]
    pub fn get(&mut self, command: &str) -> i32 {
        let reply = self.say(command);
        reply.parse().unwrap_or_else(|_| panic!("{command}: {reply}"))
    }

    /// Whether an axis puts out pulses.
    pub fn moves(&mut self, axis: &str) -> bool {
        self.get(&format!("MST{axis}")) & 7 != 0
    }

    /// Lets time pass until all axes rest; the milliseconds it took.
    #[track_caller]
    pub fn until_rest(&mut self) -> u64 {
        for ms in 0..600_000 {
            if AXES.iter().all(|axis| !self.moves(axis)) {
                return ms;
            }
            self.pass_ms(1);
        }
        panic!("the axes do not come to rest");
    }

    /// A motion command, and the milliseconds until all axes rest.
    #[track_caller]
    pub fn run(&mut self, command: &str) -> u64 {
        self.ok(command);
        self.until_rest()
    }

    /// Switches the motors of all axes on or off.
    #[track_caller]
    pub fn motors(&mut self, on: bool) {
        let mask = if on { (1 << AXES.len()) - 1 } else { 0 };
        self.ok(&format!("EO={mask}"));
    }

    /// Drives an input by hand.
    pub fn pin(&mut self, name: &str, on: bool) {
        self.device.drive_pin(name, PinValue::Level(on)).expect("an input");
    }

    /// The level of a pin.
    pub fn level(&self, name: &str) -> bool {
        self.device.read_pin(name).expect("a pin") == PinValue::Level(true)
    }

    /// Drives an analog input by hand, in mV.
    pub fn analog(&mut self, name: &str, mv: f64) {
        self.device.drive_pin(name, PinValue::Number(mv)).expect("an analog input");
    }

    /// Where the shaft is, in pulses.
    pub fn shaft(&self, axis: &str) -> i64 {
        self.device.shaft(axis).expect("an axis")
    }

    /// Switches off and on again.
    pub fn power_cycle(&mut self) {
        self.device.power_cycle();
    }

    /// Compiles a program and downloads it as a host does.
    #[track_caller]
    pub fn download(&mut self, source: &str) {
        let compilation = ascript::compile("test.prg", source.as_bytes(), DIALECT);
        let code = compilation.code.as_ref().unwrap_or_else(|| panic!("{}", compilation.render(false)));
        for (number, line) in code.lines.iter().enumerate() {
            self.check(&format!("SA{number}={line}"), "OK");
        }
    }

    /// Downloads a program and starts the one with this number.
    #[track_caller]
    pub fn start(&mut self, number: u8, source: &str) {
        self.download(source);
        self.ok(&format!("{CONTROL}{number}=1"));
    }
}

fn config() -> DeviceConfig {
    DeviceConfig::new(model(MODEL).expect("the model exists"))
}
