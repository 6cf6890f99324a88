//! A simulated CAN bus that delays, loses, repeats or corrupts the frames of its nodes.

use std::convert::Infallible;
use std::time::Duration;

use lexibus::clients::canopen::{AsyncCanPort, CanFrame, CanPort};
use lexibus::sim::CanBus;

/// Timeout of the clients under test.
pub const TIMEOUT: Duration = Duration::from_millis(500);

/// Returns the faults of the table with their names. `foreign` is a frame of another node or service.
pub fn faults(foreign: CanFrame) -> [(&'static str, Fault); 6] {
    [
        ("late", Fault::Late(TIMEOUT + Duration::from_millis(100))),
        ("lost", Fault::Lost),
        ("duplicated", Fault::Duplicated),
        ("truncated", Fault::Truncated),
        ("foreign", Fault::Foreign(foreign)),
        ("noise", Fault::Noise),
    ]
}

/// Longest step of the simulated time, after which the frames that the nodes send by themselves are taken.
const STEP: Duration = Duration::from_millis(10);

/// A fault in the answers to one request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    Nothing,
    /// The answers arrive with this delay.
    Late(Duration),
    Lost,
    /// Only the next answer is lost.
    LostOnce,
    Duplicated,
    /// The answers are truncated to half of their length.
    Truncated,
    /// This frame arrives repeatedly instead of the answer.
    Foreign(CanFrame),
    /// A thousand frames of other nodes arrive before the answer.
    Noise,
}

/// A bus with faults. The simulated time advances only while a client waits for a frame.
pub struct Faulty {
    pub bus: CanBus,
    pub fault: Fault,
    now: Duration,
    /// Frames that have not been received, with their arrival times.
    frames: Vec<(Duration, CanFrame)>,
}

impl Faulty {
    pub fn new(bus: CanBus) -> Self {
        let mut faulty = Self { now: bus.now(), bus, fault: Fault::Nothing, frames: Vec::new() };
        faulty.collect();
        faulty.frames.clear();
        faulty
    }

    pub fn time(&self) -> Duration {
        self.now
    }

    /// Returns the number of frames that have not been received.
    pub fn waiting(&self) -> usize {
        self.frames.len()
    }

    /// Moves the clock of the nodes forward, and takes the frames that they have sent.
    fn collect(&mut self) {
        self.bus.advance(self.now.saturating_sub(self.bus.now()));
        let mut sent = Vec::new();
        let mut keep = |frame: &CanFrame| {
            sent.push(*frame);
            false
        };
        CanPort::receive(&mut self.bus, Duration::ZERO, &mut keep).expect("no error");
        sent.into_iter().for_each(|frame| self.answer(frame));
    }

    fn answer(&mut self, frame: CanFrame) {
        let soon = self.now + Duration::from_millis(1);
        match self.fault {
            Fault::Nothing => self.frames.push((soon, frame)),
            Fault::Late(delay) => self.frames.push((self.now + delay, frame)),
            Fault::Lost => {}
            Fault::LostOnce => self.fault = Fault::Nothing,
            Fault::Duplicated => self.frames.extend([(soon, frame), (soon, frame)]),
            Fault::Truncated => {
                let half = frame.data().len() / 2;
                self.frames.extend(CanFrame::new(frame.id(), &frame.data()[..half]).map(|it| (soon, it)));
            }
            Fault::Noise => {
                let other = CanFrame::new(0x123, &[1, 2, 3]).expect("a frame");
                self.frames.extend([(soon, other); 1000]);
                self.frames.push((soon, frame));
            }
            Fault::Foreign(foreign) => {
                self.frames.extend((1..300).map(|at| (self.now + at * TIMEOUT * 2 / 5, foreign)));
            }
        }
    }
}

impl CanPort for Faulty {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        self.collect();
        let is_sent = CanPort::send(&mut self.bus, frame, patience)?;
        self.collect();
        Ok(is_sent)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now + patience;
        loop {
            self.collect();
            let first = (0..self.frames.len()).min_by_key(|&at| self.frames[at].0);
            let next = end.min(self.now + STEP);
            let Some(first) = first.filter(|&at| self.frames[at].0 <= next) else {
                if self.now == end {
                    return Ok(None);
                }
                self.now = next;
                continue;
            };
            let (at, frame) = self.frames.remove(first);
            self.now = self.now.max(at);
            let frame = frame.at(Some(self.now));
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

impl AsyncCanPort for Faulty {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        CanPort::receive(self, patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}
