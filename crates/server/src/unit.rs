//! A device in real time: the wall clock drives it, and everybody who wants something locks it.
//!
//! Nobody looks at a device in which nothing happens. Whoever has done something to it sees to it that its alarm
//! is set for what follows.

use crate::{
    alarms::Alarms,
    breaks::{Breaks, DebugState, Go},
    clock::Clock,
    endpoint::Sink,
    samples::{Sampler, Samples},
};
use devices::Port;
use sim::{DeviceConfig, DeviceState, VirtualDevice, record::RecordError};
use std::{
    collections::BTreeSet,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError, Weak,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

/// The longest that a device is left alone; for one in which nothing will happen there is no other end.
const LONGEST_NAP: Duration = Duration::from_secs(60);

/// The shortest: what a device does by itself shows up this late at most. A ramp wants to be looked after at each
/// of its trains and a program at every instruction, and they get them in batches.
const SHORTEST_NAP: Duration = Duration::from_millis(5);

/// Bytes that a device sent, and the pause that it wants to be kept before them.
pub(crate) struct Sent {
    pub bytes: Vec<u8>,
    pub pause: Duration,
}

impl Sent {
    /// Keeps the pause.
    pub async fn pause(&self) {
        wait(self.pause).await;
    }
}

/// Lets time pass, if there is any.
pub(crate) async fn wait(pause: Duration) {
    // A timer would take a millisecond for nothing.
    if !pause.is_zero() {
        tokio::time::sleep(pause).await;
    }
}

/// A device that runs.
pub(crate) struct Unit {
    /// Its name, unique on the bench.
    pub name: String,
    speed: f64,
    live: Mutex<Live>,
    alarms: Arc<Alarms>,
    /// Its number among those of its worker.
    number: usize,
    /// It was taken off its bus.
    gone: AtomicBool,
}

struct Live {
    device: VirtualDevice,
    clock: Clock,
    /// The alarm that is set.
    alarm: Option<Instant>,
    /// Somebody debugs.
    breaks: Option<Breaks>,
    /// Somebody wants a chart.
    sampler: Option<Sampler>,
    speakers: Vec<(Port, Weak<dyn Sink>)>,
}

impl Unit {
    /// Switches a device on; its time starts now and runs `speed` times as fast as the wall clock. Its alarms have
    /// this number.
    pub fn new(
        config: &DeviceConfig,
        device: VirtualDevice,
        speed: f64,
        (alarms, number): (Arc<Alarms>, usize),
    ) -> Self {
        let now = Instant::now();
        let clock = Clock::new(device.clock_hz(), speed, now);
        alarms.set(now, number);
        Self {
            name: config.name.clone(),
            speed,
            live: Mutex::new(Live {
                device,
                clock,
                alarm: Some(now),
                breaks: None,
                sampler: None,
                speakers: Vec::new(),
            }),
            alarms,
            number,
            gone: AtomicBool::new(false),
        }
    }

    /// The device to talk to, come to the present time. Nobody else has it meanwhile.
    pub fn turn(&self) -> Turn<'_> {
        let now = Instant::now();
        let mut live = self.live();
        live.advance(now);
        live.drain(Some);
        Turn { unit: self, live, now }
    }

    /// Takes it off the endpoints that it shares with others.
    pub fn take_away(&self) {
        self.gone.store(true, Ordering::Relaxed);
    }

    /// Whether it hangs on its endpoints no longer.
    pub fn is_gone(&self) -> bool {
        self.gone.load(Ordering::Relaxed)
    }

    /// A client leaves. What it had begun to send is forgotten, unless others have spoken since.
    pub fn hang_up(&self, port: Port, client: &Arc<dyn Sink>) {
        let mut turn = self.turn();
        if turn.live.spoke_last(port, client) {
            turn.live.device.hang_up(port);
        }
    }

    /// The device, come to the present time.
    pub fn with<T>(&self, act: impl FnOnce(&mut VirtualDevice) -> T) -> T {
        let mut turn = self.turn();
        let result = act(&mut turn.live.device);
        turn.live.drain(Some);
        result
    }

    /// Holds programs before the lines at these addresses, and nowhere if there are none.
    pub fn set_breakpoints(&self, addresses: BTreeSet<u16>) {
        let mut turn = self.turn();
        turn.live.breaks.get_or_insert_default().set(addresses);
    }

    /// Lets a program that is held go on, or holds one.
    pub fn debug(&self, go: Go) {
        let mut turn = self.turn();
        let Live { device, breaks, .. } = &mut *turn.live;
        breaks.get_or_insert_default().go(go, device);
        turn.live.drain(Some);
    }

    /// What a debugger sees.
    pub fn debug_state(&self) -> DebugState {
        self.turn().live.breaks.as_ref().map(Breaks::state).unwrap_or_default()
    }

    /// Begins to take samples, or ends it.
    pub fn sample(&self, on: bool) {
        let mut turn = self.turn();
        let sampler = on.then(|| Sampler::new(&turn.live.device, self.speed));
        turn.live.sampler = sampler;
    }

    /// The samples until now that nobody has taken yet.
    pub fn samples(&self) -> Samples {
        self.turn().live.sampler.as_mut().map(Sampler::drain).unwrap_or_default()
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

    /// An alarm that was set for this time goes off: the device does what is due.
    pub fn tend(&self, alarm: Instant) {
        let mut live = self.live();
        // Others may have been set, and have gone off, since.
        if live.alarm == Some(alarm) {
            live.alarm = None;
            drop(live);
            drop(self.turn());
        }
    }

    fn live(&self) -> MutexGuard<'_, Live> {
        // A panic inside a device is an assertion on its own invariants; the other devices go on.
        self.live.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Somebody talks to a device.
pub(crate) struct Turn<'a> {
    unit: &'a Unit,
    live: MutexGuard<'a, Live>,
    now: Instant,
}

impl Turn<'_> {
    /// Bytes arrive from a client. What the device sends through the same port because of them is added
    /// to `sent`; what it had sent by itself before goes to the client that spoke last.
    pub fn exchange(&mut self, port: Port, bytes: &[u8], client: &Arc<dyn Sink>, sent: &mut Vec<Sent>) {
        let (live, speed) = (&mut *self.live, self.unit.speed);
        live.speaks(port, client);
        live.device.receive(port, bytes);
        live.drain(|message| {
            if message.port != port {
                return Some(message);
            }
            let pause = Duration::from_millis(message.delay_ms.into()).div_f64(speed);
            sent.push(Sent { bytes: message.bytes, pause });
            None
        });
    }
}

impl Drop for Turn<'_> {
    /// Sets the alarm for what comes next, unless one will go off before that.
    fn drop(&mut self) {
        let Live { device, clock, alarm, breaks, .. } = &mut *self.live;
        // While a line is held nothing happens by itself.
        let nap = match breaks.as_mut().is_some_and(|breaks| breaks.holds(device)) {
            true => LONGEST_NAP,
            false => clock.until(device.now(), device.wake()).clamp(SHORTEST_NAP, LONGEST_NAP),
        };
        let at = self.now + nap;
        if alarm.is_none_or(|set| at < set) {
            *alarm = Some(at);
            self.unit.alarms.set(at, self.unit.number);
        }
    }
}

impl Live {
    /// Comes to the present time, or to a line that is held.
    fn advance(&mut self, now: Instant) {
        let Self { device, clock, breaks, sampler, .. } = self;
        let mut held = breaks.as_mut().is_some_and(|breaks| breaks.holds(device));
        if !held {
            let due = clock.due(now, device.now(), device.wake());
            loop {
                let stop = sampler.as_ref().map_or(due, |sampler| sampler.next().min(due));
                match breaks {
                    Some(breaks) => breaks.advance(device, stop),
                    None => device.advance(stop),
                }
                held = breaks.as_mut().is_some_and(|breaks| breaks.holds(device));
                match sampler.as_mut().filter(|sampler| !held && sampler.next() <= device.now()) {
                    Some(sampler) => sampler.take(device),
                    None => break,
                }
            }
        }
        if held {
            clock.stand(now, device.now());
        } else if breaks.as_ref().is_some_and(Breaks::is_idle) {
            device.release_lines();
            *breaks = None;
        }
    }

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
