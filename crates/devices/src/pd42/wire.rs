//! Bytes in, replies out: binary frames and ASCII lines on USB and RS-485, frames on CAN, and the
//! heartbeats (manual, sections 3.1 to 3.4, 7.4 and 7.5).

use super::{MILLISECOND, Pd42, gp};
use crate::board::{Board, Port};
use crate::flash::Flash;
use ::motion::Ticks;
use protocol::ascii::{self, Echo, Editor, Line};
use protocol::can;
use protocol::tmcl::{
    CanReply, CanRequest, MemoryReply, PARTIAL_FRAME_TIMEOUT_MS, Receiver, Reply, Request, Status,
    VersionReply,
};
use tmcl::isa::{Command, opcode};
use tmcl::line::{self, Line as Typed};

/// Bit 0 of global parameter 67: start in ASCII mode.
const START_IN_ASCII: i32 = 1;

/// How a command came, and how its reply goes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// USB or RS-485.
    Serial(Port),
    /// CAN; a long reply has eight bytes.
    Can { long: bool },
}

/// What a command is answered with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Response {
    Reply(Status, i32),
    /// The version as text.
    Version([u8; 8]),
    /// A word of the program memory.
    Memory(Command),
    /// A reply, then ASCII mode.
    Ascii,
    /// A reply or none, then a restart.
    Reset {
        reply: bool,
    },
}

impl From<Status> for Response {
    fn from(status: Status) -> Self {
        Self::Reply(status, 0)
    }
}

/// A request for events by command 138.
#[derive(Clone, Copy, Debug)]
struct Wanted {
    link: Link,
    every: bool,
    /// A move has begun since.
    armed: bool,
}

/// A serial port.
struct Serial {
    receiver: Receiver,
    editor: Editor,
    ascii: bool,
}

impl Serial {
    const fn new() -> Self {
        Self { receiver: Receiver::new(), editor: Editor::new(), ascii: false }
    }
}

/// A kind of ports with one heartbeat.
#[derive(Clone, Copy, Debug, Default)]
struct Heartbeat {
    last: Ticks,
    lost: bool,
}

/// State of the ports.
pub struct Wire {
    usb: Serial,
    rs485: Serial,
    wanted: Option<Wanted>,
    /// RS-485 and USB; CAN.
    heartbeats: [Heartbeat; 2],
}

const SERIAL: usize = 0;
const CAN: usize = 1;

impl Wire {
    pub const fn new() -> Self {
        Self {
            usb: Serial::new(),
            rs485: Serial::new(),
            wanted: None,
            heartbeats: [Heartbeat { last: 0, lost: false }; 2],
        }
    }

    /// What global parameter 67 says of the start.
    pub fn start(&mut self, ascii_mode: i32, now: Ticks) {
        self.usb.ascii = ascii_mode & START_IN_ASCII != 0;
        self.rs485.ascii = self.usb.ascii;
        self.heartbeats = [Heartbeat { last: now, lost: false }; 2];
    }

    pub const fn request_event(&mut self, link: Link, every: bool) {
        self.wanted = Some(Wanted { link, every, armed: false });
    }

    pub const fn forget_event(&mut self) {
        self.wanted = None;
    }

    /// Whether a host wants to know when a move ends.
    pub const fn is_asked(&self) -> bool {
        self.wanted.is_some()
    }

    /// A move by MVP has begun.
    pub fn move_begun(&mut self) {
        if let Some(wanted) = &mut self.wanted {
            wanted.armed = true;
        }
    }

    /// Where the event of a finished move goes; it is used up by asking.
    pub fn event_port(&mut self) -> Option<Link> {
        let wanted = self.wanted.as_mut().filter(|wanted| wanted.armed)?;
        wanted.armed = false;
        let link = wanted.link;
        if !wanted.every {
            self.wanted = None;
        }
        Some(link)
    }

    /// Whether a heartbeat is missing: programs cannot move the motor until a command comes.
    pub fn is_silent(&self) -> bool {
        self.heartbeats.iter().any(|heartbeat| heartbeat.lost)
    }

    fn serial(&mut self, port: Port) -> &mut Serial {
        if port == Port::Rs485 { &mut self.rs485 } else { &mut self.usb }
    }
}

impl<F: Flash> Pd42<F> {
    /// A byte comes in on USB or RS-485.
    pub fn serial_byte(&mut self, port: Port, byte: u8, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        let now = self.now;
        if self.wire.serial(port).ascii {
            self.ascii_byte(port, byte, board);
            return;
        }
        let timeout = Ticks::from(PARTIAL_FRAME_TIMEOUT_MS) * MILLISECOND;
        let Some(frame) = self.wire.serial(port).receiver.push(byte, now, timeout) else { return };
        let Some(answers) = self.addressed(port, frame.address()) else { return };
        let link = Link::Serial(port);
        match Request::parse(&frame) {
            Err(_) if answers => {
                let reply = self.reply(0, Status::WRONG_CHECKSUM, 0);
                self.send_serial(port, &reply.emit().0, board);
            }
            Err(_) => {}
            Ok(request) => {
                self.heard(SERIAL);
                let command = Command::from(request);
                let response = self.direct(command, link, board);
                self.answer(link, command, response, answers, board);
            }
        }
    }

    /// A frame comes in on CAN.
    pub fn can_frame(&mut self, bytes: &[u8], board: &mut dyn Board) {
        if self.dead {
            return;
        }
        let Ok(frame) = can::Frame::decode(bytes) else { return };
        let get = |number| self.memory.module.get(number);
        let id = i32::from(frame.id());
        let own = id == get(gp::CAN_ID);
        let secondary = get(gp::CAN_SECONDARY_ID) != 0 && id == get(gp::CAN_SECONDARY_ID);
        if !own && !secondary {
            return;
        }
        let Ok(request) = CanRequest::parse(&frame) else { return };
        self.heard(CAN);
        let link = Link::Can { long: request.long };
        let command = Command::new(request.opcode, request.kind, request.motor, request.value);
        let response = self.direct(command, link, board);
        self.answer(link, command, response, own, board);
    }

    /// Whether a serial address is this module's, and whether it answers to it.
    fn addressed(&self, port: Port, address: u8) -> Option<bool> {
        let get = |number| self.memory.module.get(number);
        let address = i32::from(address);
        if port == Port::Usb || address == get(gp::SERIAL_ADDRESS) {
            Some(true)
        } else if get(gp::SECONDARY_ADDRESS) != 0 && address == get(gp::SECONDARY_ADDRESS) {
            Some(false)
        } else {
            None
        }
    }

    /// A character of the ASCII interface.
    fn ascii_byte(&mut self, port: Port, byte: u8, board: &mut dyn Board) {
        let echo = Echo::from_parameter(self.memory.module.get(gp::ASCII_MODE));
        let address = self.memory.module.get(gp::SERIAL_ADDRESS) as u8;
        let step = self.wire.serial(port).editor.push(byte, address, echo);
        if !step.echo.is_empty() {
            board.send(port, step.echo, 0);
        }
        let Some(typed) = step.line else { return };
        let typed = match typed {
            Line::Command(text) => line::parse(text),
            Line::TooLong => Err(Status::INVALID_COMMAND),
        };
        self.heard(SERIAL);
        let link = Link::Serial(port);
        let (status, value) = match typed {
            Err(status) => (status, 0),
            Ok(Typed::Binary) => {
                self.wire.serial(port).ascii = false;
                self.wire.serial(port).receiver.clear();
                (Status::OK, 0)
            }
            Ok(Typed::Run) => self.typed(Command::new(opcode::RUN_APPLICATION, 0, 0, 0), link, board),
            Ok(Typed::Stop) => self.typed(Command::new(opcode::STOP_APPLICATION, 0, 0, 0), link, board),
            Ok(Typed::Command(command)) => self.typed(command, link, board),
        };
        let host = self.memory.module.get(gp::HOST_ADDRESS) as u8;
        let reply = ascii::reply(host, address, status, value);
        self.send_serial(port, &reply, board);
    }

    fn typed(&mut self, command: Command, link: Link, board: &mut dyn Board) -> (Status, i32) {
        match self.direct(command, link, board) {
            Response::Reply(status, value) => (status, value),
            // The line interface has no other commands.
            Response::Version(_) | Response::Memory(_) | Response::Ascii | Response::Reset { .. } => {
                (Status::NOT_AVAILABLE, 0)
            }
        }
    }

    /// Sends what a command is answered with, and does what follows an answer.
    fn answer(
        &mut self,
        link: Link,
        command: Command,
        response: Response,
        answers: bool,
        board: &mut dyn Board,
    ) {
        let reads = matches!(command.opcode, opcode::GAP | opcode::GGP | opcode::GIO);
        let suppressed = self.memory.module.get(gp::SUPPRESS_REPLY) != 0 && !reads;
        if answers && !suppressed && !self.dead {
            self.send_response(link, command, response, board);
        }
        match response {
            Response::Ascii => {
                if let Link::Serial(port) = link {
                    let serial = self.wire.serial(port);
                    serial.ascii = true;
                    serial.editor.clear();
                }
            }
            Response::Reset { .. } if !self.dead => self.reset(board),
            _ => {}
        }
    }

    fn send_response(&mut self, link: Link, command: Command, response: Response, board: &mut dyn Board) {
        let host = self.memory.module.get(gp::HOST_ADDRESS) as u8;
        let (status, value) = match response {
            Response::Reply(status, value) => (status, value),
            Response::Ascii | Response::Reset { reply: true } => (Status::OK, command.value),
            Response::Reset { reply: false } => return,
            Response::Version(text) => {
                let reply = VersionReply { host, text };
                match link {
                    Link::Serial(port) => self.send_serial(port, &reply.emit().0, board),
                    Link::Can { long } => self.send_can(reply.emit_can(self.can_reply_id(), long), board),
                }
                return;
            }
            Response::Memory(Command { opcode, kind, motor, value }) => {
                let reply = MemoryReply { host, opcode, kind, motor, value };
                match link {
                    Link::Serial(port) => self.send_serial(port, &reply.emit().0, board),
                    Link::Can { long } => self.send_can(reply.emit_can(self.can_reply_id(), long), board),
                }
                return;
            }
        };
        self.send_status(link, command.opcode, status, value, board);
    }

    fn send_status(&self, link: Link, opcode: u8, status: Status, value: i32, board: &mut dyn Board) {
        match link {
            Link::Serial(port) => self.send_serial(port, &self.reply(opcode, status, value).emit().0, board),
            Link::Can { long } => {
                let module = self.memory.module.get(gp::CAN_ID) as u8;
                let id = self.can_reply_id();
                let reply = CanReply { id, module, status, opcode, value, long };
                self.send_can(reply.emit(), board);
            }
        }
    }

    /// Says, unasked, that the axis has reached its target.
    pub fn send_position_reached(&self, link: Link, board: &mut dyn Board) {
        let status = Status::POSITION_REACHED;
        self.send_status(link, opcode::POSITION_REACHED_EVENT, status, 1, board);
    }

    fn reply(&self, opcode: u8, status: Status, value: i32) -> Reply {
        let get = |number| self.memory.module.get(number) as u8;
        Reply { host: get(gp::HOST_ADDRESS), module: get(gp::SERIAL_ADDRESS), status, opcode, value }
    }

    fn can_reply_id(&self) -> u16 {
        self.memory.module.get(gp::CAN_REPLY_ID) as u16
    }

    fn send_serial(&self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        let pause = self.memory.module.get(gp::TELEGRAM_PAUSE) as u32;
        board.send(port, bytes, if port == Port::Rs485 { pause } else { 0 });
    }

    fn send_can(&self, frame: Option<can::Frame>, board: &mut dyn Board) {
        let frame = frame.expect("identifiers have 11 bits, by their range");
        board.send(Port::Can, frame.encode(&mut [0; can::MAX_FLAT]), 0);
    }

    /// A valid command has come.
    fn heard(&mut self, kind: usize) {
        self.wire.heartbeats[kind] = Heartbeat { last: self.now, lost: false };
    }

    fn heartbeat_limit(&self, kind: usize) -> Option<Ticks> {
        let number = [gp::SERIAL_HEARTBEAT, gp::CAN_HEARTBEAT][kind];
        let limit = self.memory.module.get(number) as Ticks;
        let heartbeat = self.wire.heartbeats[kind];
        (limit != 0 && !heartbeat.lost).then(|| heartbeat.last.saturating_add(limit * MILLISECOND))
    }

    /// When the next heartbeat will be missing.
    pub fn heartbeat_due(&self) -> Option<Ticks> {
        [SERIAL, CAN].into_iter().filter_map(|kind| self.heartbeat_limit(kind)).min()
    }

    /// Stops the motor when a heartbeat is missing.
    pub fn watch_heartbeats(&mut self) {
        for kind in [SERIAL, CAN] {
            if self.heartbeat_limit(kind).is_some_and(|due| due <= self.now) {
                self.wire.heartbeats[kind].lost = true;
                self.stop_motor();
            }
        }
    }
}
