//! A module on a bench, and short words for talking to it.

use devices::{Port, model};
use motion::Ticks;
use protocol::tmcl::{Frame, Reply, Request, Status};
use sim::{AxisConfig, DeviceConfig, PinValue, SharedFlash, VirtualDevice};
use tmcl::asm::{NoFiles, assemble};

/// Clocks of a millisecond.
pub const MS: Ticks = 16_000;

/// A module with its machine.
pub struct Rig {
    pub device: VirtualDevice,
}

impl Rig {
    /// End switches far away, home from −200 to 0.
    pub fn new() -> Self {
        Self::with(|_| ())
    }

    /// With another machine.
    pub fn with(change: impl FnOnce(&mut AxisConfig)) -> Self {
        let mut config = DeviceConfig::new(model("pd42-1140").expect("the model exists"));
        let mut axis = config.axis("0");
        change(&mut axis);
        config.axes.insert("0".into(), axis);
        Self { device: VirtualDevice::new(&config, 1) }
    }

    /// On a given flash.
    pub fn on(flash: SharedFlash) -> Self {
        let config = DeviceConfig::new(model("pd42-1140").expect("the model exists"));
        Self { device: VirtualDevice::with_flash(&config, flash, 1) }
    }

    /// Lets device time pass.
    pub fn pass_ms(&mut self, ms: u64) {
        let until = self.device.now() + ms * MS;
        self.device.advance(until);
    }

    /// Sends bytes over a port and gives what comes back at once.
    pub fn bytes(&mut self, port: Port, bytes: &[u8]) -> Vec<u8> {
        self.device.receive(port, bytes);
        self.device.drain_sent().flat_map(|sent| sent.bytes).collect()
    }

    /// Sends a command over USB; status and value of the reply.
    pub fn send(&mut self, opcode: u8, kind: u8, motor: u8, value: i32) -> (u8, i32) {
        let request = Request { address: 1, opcode, kind, motor, value };
        let reply = self.bytes(Port::Usb, &request.emit().0);
        let frame: [u8; 9] = reply.try_into().expect("one reply of nine bytes");
        let reply = Reply::parse(&Frame(frame)).expect("a good checksum");
        assert_eq!(reply.opcode, opcode);
        (reply.status.0, reply.value)
    }

    /// A command that is executed; its value.
    pub fn ok(&mut self, opcode: u8, kind: u8, motor: u8, value: i32) -> i32 {
        let (status, value) = self.send(opcode, kind, motor, value);
        assert_eq!(status, Status::OK.0, "command {opcode}, type {kind}, value {value}");
        value
    }

    /// Sets an axis parameter.
    pub fn sap(&mut self, number: u8, value: i32) {
        assert_eq!(self.ok(5, number, 0, value), value);
    }

    /// Reads an axis parameter.
    pub fn gap(&mut self, number: u8) -> i32 {
        self.ok(6, number, 0, 0)
    }

    /// Sets a global parameter.
    pub fn sgp(&mut self, number: u8, bank: u8, value: i32) {
        assert_eq!(self.ok(9, number, bank, value), value);
    }

    /// Reads a global parameter.
    pub fn ggp(&mut self, number: u8, bank: u8) -> i32 {
        self.ok(10, number, bank, 0)
    }

    /// `MVP ABS`.
    pub fn move_to(&mut self, position: i32) {
        self.ok(4, 0, 0, position);
    }

    /// Lets time pass until the axis rests; the milliseconds it took.
    pub fn until_rest(&mut self) -> u64 {
        for ms in 1..600_000 {
            self.pass_ms(1);
            if self.gap(3) == 0 && self.device.axis(0).speed_mpps == 0 {
                return ms;
            }
        }
        panic!("the axis does not come to rest");
    }

    /// Drives an input by hand.
    pub fn pin(&mut self, name: &str, on: bool) {
        self.device.drive_pin(name, PinValue::Level(on)).expect("an input");
    }

    /// Drives an analog input by hand.
    pub fn analog(&mut self, name: &str, value: f64) {
        self.device.drive_pin(name, PinValue::Number(value)).expect("an analog input");
    }

    /// Where the shaft is, in 1/256 full steps.
    pub fn shaft(&self) -> i64 {
        self.device.shaft("0").expect("there is one axis")
    }
}

/// Assembles a program and downloads it as a host does.
pub fn program(rig: &mut Rig, source: &str) {
    let assembly = assemble("test.tmc", source.as_bytes(), &NoFiles);
    let program = assembly.program.as_ref().unwrap_or_else(|| panic!("{}", assembly.render(false)));
    rig.ok(132, 0, 0, 0);
    for command in &program.commands {
        let (status, _) = rig.send(command.opcode, command.kind, command.motor, command.value);
        assert_eq!(status, Status::LOADED.0, "{command:?}");
    }
    rig.ok(133, 0, 0, 0);
}

/// Downloads a program and starts it at address 0.
pub fn start(rig: &mut Rig, source: &str) {
    program(rig, source);
    rig.ok(129, 1, 0, 0);
}

/// A module whose motor runs at a steady speed.
pub fn running(speed: i32) -> Rig {
    let mut rig = Rig::new();
    rig.sap(5, 2000);
    rig.ok(1, 0, 0, speed);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), speed);
    rig
}
