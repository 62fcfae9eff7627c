//! A device in real time: the wall clock drives it, and everybody who wants something locks it.

use crate::{clock::Clock, endpoint::Sink};
use devices::Port;
use sim::{DeviceConfig, DeviceState, VirtualDevice, record::RecordError};
use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
    time::{Duration, Instant},
};

/// The longest that a device is left alone: what it does by itself shows up this late at most.
const LONGEST_NAP: Duration = Duration::from_millis(10);

/// The shortest: a running program wants to be woken for every instruction, and gets them in batches.
const SHORTEST_NAP: Duration = Duration::from_millis(1);

/// Bytes that a device sent, and the pause that it wants to be kept before them.
pub(crate) struct Sent {
    pub bytes: Vec<u8>,
    pub pause: Duration,
}

/// A device that runs.
pub(crate) struct Unit {
    /// Its name, unique on the bench.
    pub name: String,
    /// Its model's name.
    pub model: &'static str,
    speed: f64,
    live: Mutex<Live>,
}

struct Live {
    device: VirtualDevice,
    clock: Clock,
    speakers: Vec<(Port, Weak<dyn Sink>)>,
}

impl Unit {
    /// Switches a device on; its time starts now and runs `speed` times as fast as the wall clock.
    pub fn new(config: &DeviceConfig, device: VirtualDevice, speed: f64) -> Self {
        let clock = Clock::new(device.clock_hz(), speed, Instant::now());
        Self {
            name: config.name.clone(),
            model: config.model.name,
            speed,
            live: Mutex::new(Live { device, clock, speakers: Vec::new() }),
        }
    }

    /// Bytes arrive from a client. What the device sends through the same port because of them is added
    /// to `sent`; what it had sent by itself before goes to the client that spoke last.
    pub fn exchange(&self, port: Port, bytes: &[u8], client: &Arc<dyn Sink>, sent: &mut Vec<Sent>) {
        let mut live = self.catch_up();
        live.speaks(port, client);
        live.device.receive(port, bytes);
        let speed = self.speed;
        live.drain(|message| {
            if message.port != port {
                return Some(message);
            }
            let pause = Duration::from_millis(message.delay_ms.into()).div_f64(speed);
            sent.push(Sent { bytes: message.bytes, pause });
            None
        });
    }

    /// A client leaves. What it had begun to send is forgotten, unless others have spoken since.
    pub fn hang_up(&self, port: Port, client: &Arc<dyn Sink>) {
        let mut live = self.catch_up();
        if live.spoke_last(port, client) {
            live.device.hang_up(port);
        }
    }

    /// The device, come to the present time.
    pub fn with<T>(&self, act: impl FnOnce(&mut VirtualDevice) -> T) -> T {
        let mut live = self.catch_up();
        let result = act(&mut live.device);
        live.drain(Some);
        result
    }

    /// The state of the device now.
    pub fn state(&self) -> DeviceState {
        self.with(|device| device.state())
    }

    /// Ends what is recorded of the device, at the present time.
    pub fn finish_recordings(&self) -> Result<(), RecordError> {
        self.with(|device| {
            device.end_tape();
            device.finish_recordings()
        })
    }

    /// Lets the device do what is due, and says how long it may then be left alone.
    pub fn tend(&self) -> Duration {
        let live = self.catch_up();
        live.clock.until(live.device.now(), live.device.wake()).clamp(SHORTEST_NAP, LONGEST_NAP)
    }

    fn catch_up(&self) -> MutexGuard<'_, Live> {
        // A panic inside a device is an assertion on its own invariants; the other devices go on.
        let mut live = self.live.lock().unwrap_or_else(PoisonError::into_inner);
        let Live { device, clock, .. } = &mut *live;
        let due = clock.due(Instant::now(), device.now());
        device.advance(due);
        live.drain(Some);
        live
    }
}

impl Live {
    /// From now on this client gets what the device sends by itself through the port.
    fn speaks(&mut self, port: Port, client: &Arc<dyn Sink>) {
        if self.spoke_last(port, client) {
            return;
        }
        match self.speakers.iter_mut().find(|(other, _)| *other == port) {
            Some((_, speaker)) => *speaker = Arc::downgrade(client),
            None => self.speakers.push((port, Arc::downgrade(client))),
        }
    }

    fn spoke_last(&self, port: Port, client: &Arc<dyn Sink>) -> bool {
        let speaker = self.speakers.iter().find(|(other, _)| *other == port);
        speaker.is_some_and(|(_, speaker)| std::ptr::addr_eq(speaker.as_ptr(), Arc::as_ptr(client)))
    }

    /// Takes out what the device sent; what `answer` gives back goes to the last speaker.
    fn drain(&mut self, mut answer: impl FnMut(sim::Sent) -> Option<sim::Sent>) {
        let Self { device, speakers, .. } = self;
        for message in device.drain_sent().filter_map(&mut answer) {
            let speaker = speakers.iter().find(|(port, _)| *port == message.port);
            if let Some(client) = speaker.and_then(|(_, client)| client.upgrade()) {
                client.push(&message.bytes);
            }
        }
    }
}
