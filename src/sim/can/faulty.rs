//! A simulated CAN bus with faults.

use core::convert::Infallible;
use core::time::Duration;
use std::collections::VecDeque;

use super::super::faults::Faults;
use super::fault::{toggled, truncated, CanError, CanFault};
use super::{CanBus, CanNode};
use crate::clients::canopen::{AsyncCanPort, CanFrame, CanPort};

/// Maximum number of frames that wait for the client. Older frames are lost, as on a real bus.
const MOST_WAITING: usize = 0x1_0000;

/// A simulated CAN bus that a [`FaultyCan`] can wrap. The bus must have a simulated clock, and its methods cannot fail.
pub trait SimulatedCan: CanPort<Error = Infallible> {
    /// Switches all devices on the bus off and on.
    fn power_cycle(&mut self);
}

impl SimulatedCan for CanNode {
    fn power_cycle(&mut self) {
        Self::power_cycle(self);
    }
}

impl SimulatedCan for CanBus {
    fn power_cycle(&mut self) {
        self.nodes().iter_mut().for_each(CanNode::power_cycle);
    }
}

impl<B: SimulatedCan + ?Sized> SimulatedCan for &mut B {
    fn power_cycle(&mut self) {
        B::power_cycle(self);
    }
}

/// A simulated CAN bus with injected faults. CANopen clients use this bus as their CAN port.
///
/// A [`CanFault`] affects one of the frames that the client receives, or all frames that a function selects. All other
/// frames arrive unchanged. Delays elapse in the time of the simulated bus, so tests don't wait for late frames in real
/// time.
///
/// ```
/// use lexibus::clients::canopen::Node;
/// use lexibus::sim::{CanError, CanFault, CanNode, Device, FaultyCan};
/// use lexibus::{Error, NodeId};
/// use lexibus_drives::demo_drive::{DemoDrive, ENTRIES};
///
/// let id = NodeId::new(5).unwrap();
/// let node = CanNode::new(Device::new(ENTRIES).with_node_id(id));
/// let mut drive = DemoDrive::new(Node::new(FaultyCan::new(node), id));
///
/// // The second reply from now on is lost.
/// drive.client().port().inject_nth(CanFault::Lost, 2);
/// drive.producer_heartbeat_time().write(100)?;
/// assert_eq!(drive.producer_heartbeat_time().read().unwrap_err().error, Error::Timeout);
/// assert_eq!(drive.producer_heartbeat_time().read(), Ok(100));
///
/// // The SDO replies of the node cause bus-off.
/// drive.client().port().inject(CanFault::BusOff, |frame| frame.id() == 0x585);
/// assert_eq!(drive.producer_heartbeat_time().read().unwrap_err().error, Error::Client(CanError::BusOff));
/// drive.client().port().clear_faults();
/// drive.client().port().recover();
/// assert_eq!(drive.producer_heartbeat_time().read(), Ok(100));
/// # Ok::<(), Error<CanError>>(())
/// ```
#[derive(Debug)]
pub struct FaultyCan<B> {
    bus: B,
    faults: Faults<CanFault, CanFrame>,
    /// Frames and errors that the client has not received, in the order of their arrival times.
    waiting: VecDeque<(Duration, Result<CanFrame, CanError>)>,
    is_off: bool,
}

impl<B: SimulatedCan> FaultyCan<B> {
    /// Creates a bus without faults.
    pub fn new(bus: B) -> Self {
        Self { bus, faults: Faults::default(), waiting: VecDeque::new(), is_off: false }
    }

    /// Injects a fault into the `n`th frame that arrives from now on: 1 is the next frame. All frames count, including
    /// frames that the client ignores and frames that are lost in the bus-off state. Boot-up messages after a restart
    /// don't count.
    pub fn inject_nth(&mut self, fault: CanFault, n: u64) {
        self.collect();
        self.faults.add_nth(fault, n);
    }

    /// Injects a fault into each frame that `selects` accepts, until [`clear_faults`](Self::clear_faults). `selects` is
    /// called once for each frame that arrives. If several faults affect a frame, the first one that was injected
    /// applies.
    pub fn inject(&mut self, fault: CanFault, selects: impl FnMut(&CanFrame) -> bool + Send + 'static) {
        self.collect();
        self.faults.add(fault, selects);
    }

    /// Removes all faults. Frames that are already late remain late.
    pub fn clear_faults(&mut self) {
        self.collect();
        self.faults.clear();
    }

    /// Ends the bus-off state. Frames that were sent during this state are lost.
    pub fn recover(&mut self) {
        self.collect();
        self.is_off = false;
    }

    /// Returns the wrapped bus.
    pub fn bus(&mut self) -> &mut B {
        &mut self.bus
    }

    /// Returns the bus and drops the frames that the client has not received.
    pub fn into_bus(self) -> B {
        self.bus
    }

    /// Returns the number of frames that the client has not received, including late frames.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    fn time(&mut self) -> Duration {
        self.bus.now().unwrap_or_default()
    }

    /// Takes the frames that have already arrived from the bus, and applies the injected faults.
    fn collect(&mut self) {
        while let Some(frame) = self.take(Duration::ZERO) {
            self.arrive(frame);
        }
    }

    fn take(&mut self, patience: Duration) -> Option<CanFrame> {
        self.bus.receive(patience, &mut |_| true).unwrap_or_else(|never| match never {})
    }

    /// Applies the injected faults to an arriving frame.
    fn arrive(&mut self, frame: CanFrame) {
        let fault = self.faults.next(&frame);
        if self.is_off {
            return;
        }
        let time = frame.time().unwrap_or(self.time());
        let Some(fault) = fault else { return self.wait(time, Ok(frame)) };
        match fault {
            CanFault::Late(delay) => self.wait(time.saturating_add(delay), Ok(frame)),
            CanFault::Lost => {}
            CanFault::Duplicated => (0..2).for_each(|_| self.wait(time, Ok(frame))),
            CanFault::Truncated => self.wait(time, Ok(truncated(&frame))),
            CanFault::WrongToggle => self.wait(time, Ok(toggled(&frame))),
            CanFault::Foreign { frame, count, period } => {
                (1..=count).for_each(|at| self.wait(time.saturating_add(period.saturating_mul(at)), Ok(frame)));
            }
            CanFault::Noise(count) => {
                let noise = CanFrame::new(0x123, &[1, 2, 3]).unwrap_or(frame);
                (0..count).for_each(|_| self.wait(time, Ok(noise)));
                self.wait(time, Ok(frame));
            }
            CanFault::Restart => self.restart(),
            CanFault::BusOff => {
                self.waiting.clear();
                self.is_off = true;
            }
            CanFault::ErrorFrame => {
                self.wait(time, Err(CanError::ErrorFrame));
                self.wait(time, Ok(frame));
            }
        }
    }

    /// Restarts all devices. Frames that have not arrived are lost. The first messages of the devices after the restart
    /// have no faults.
    fn restart(&mut self) {
        while self.take(Duration::ZERO).is_some() {}
        self.bus.power_cycle();
        while let Some(frame) = self.take(Duration::ZERO) {
            let time = self.time();
            self.wait(time, Ok(frame));
        }
    }

    /// Adds a frame or an error to the queue. Frames with the same time stay in order.
    fn wait(&mut self, time: Duration, event: Result<CanFrame, CanError>) {
        if self.waiting.len() >= MOST_WAITING {
            self.waiting.pop_front();
        }
        let at = self.waiting.partition_point(|(other, _)| *other <= time);
        self.waiting.insert(at, (time, event));
    }
}

impl<B: SimulatedCan> CanPort for FaultyCan<B> {
    type Error = CanError;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, CanError> {
        self.collect();
        if self.is_off {
            return Err(CanError::BusOff);
        }
        let is_sent = self.bus.send(frame, patience).unwrap_or_else(|never| match never {});
        self.collect();
        Ok(is_sent)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, CanError> {
        let end = self.time().saturating_add(patience);
        loop {
            if self.is_off {
                return Err(CanError::BusOff);
            }
            let due = self.waiting.front().map(|(due, _)| *due).filter(|due| *due <= end);
            let left = due.unwrap_or(end).saturating_sub(self.time());
            if let Some(frame) = self.take(left) {
                self.arrive(frame);
                continue;
            }
            if due.is_none() {
                return Ok(None);
            }
            let Some((_, event)) = self.waiting.pop_front() else { continue };
            let frame = event?.at(Some(self.time()));
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        self.bus.now()
    }
}

/// All futures are ready at the first poll.
impl<B: SimulatedCan> AsyncCanPort for FaultyCan<B> {
    type Error = CanError;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, CanError> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, CanError> {
        CanPort::receive(self, patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        CanPort::now(self)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::super::tests::{node, NODE};
    use super::*;
    use crate::clients::canopen::{NmtCommand, NmtState};

    /// The boot-up message of the node.
    fn boot_up() -> CanFrame {
        NmtState::BootUp.heartbeat(NODE)
    }

    /// Returns the next events: frames and errors.
    fn received<B: SimulatedCan>(bus: &mut FaultyCan<B>, patience: Duration) -> Vec<Result<CanFrame, CanError>> {
        core::iter::from_fn(|| CanPort::receive(bus, patience, &mut |_| true).transpose()).take(3).collect()
    }

    /// Returns what a client receives if the boot-up message has a fault.
    fn events(fault: CanFault) -> Vec<Result<CanFrame, CanError>> {
        let mut bus = FaultyCan::new(CanBus::new());
        bus.inject(fault, |_| true);
        bus.bus().add(node());
        received(&mut bus, Duration::from_secs(1))
    }

    #[test]
    fn each_fault() {
        let (frame, empty) = (boot_up(), CanFrame::new(0x705, &[]).expect("a frame"));
        let other = CanFrame::new(0x706, &[5]).expect("a frame");
        let noise = CanFrame::new(0x123, &[1, 2, 3]).expect("a frame");
        let second = Duration::from_secs(1);
        assert_eq!(events(CanFault::Late(second)), [Ok(frame)]);
        assert_eq!(events(CanFault::Late(second + Duration::from_millis(1))), []);
        assert_eq!(events(CanFault::Lost), []);
        assert_eq!(events(CanFault::Duplicated), [Ok(frame), Ok(frame)]);
        assert_eq!(events(CanFault::Truncated), [Ok(empty)]);
        assert_eq!(events(CanFault::Foreign { frame: other, count: 2, period: second }), [Ok(other), Ok(other)]);
        assert_eq!(events(CanFault::Noise(2)), [Ok(noise), Ok(noise), Ok(frame)]);
        assert_eq!(events(CanFault::ErrorFrame), [Err(CanError::ErrorFrame), Ok(frame)]);
        assert_eq!(events(CanFault::BusOff), [Err(CanError::BusOff); 3]);
        // Only frames before a restart can cause it.
        assert_eq!(events(CanFault::Restart), [Ok(frame)]);
    }

    #[test]
    fn toggle_bits() {
        let frame = |data: &[u8]| CanFrame::new(0x585, data).expect("a frame");
        for (sent, arrives) in [
            ([0x10, 1, 2, 3, 4, 5, 6, 7], [0x00, 1, 2, 3, 4, 5, 6, 7]),
            ([0x20, 0, 0, 0, 0, 0, 0, 0], [0x30, 0, 0, 0, 0, 0, 0, 0]),
            // The replies to an initiated upload and download, and an abort.
            ([0x43, 0, 0x20, 0, 1, 2, 3, 4], [0x43, 0, 0x20, 0, 1, 2, 3, 4]),
            ([0x60, 0, 0x20, 0, 0, 0, 0, 0], [0x60, 0, 0x20, 0, 0, 0, 0, 0]),
            ([0x80, 0, 0x20, 0, 0, 0, 0, 8], [0x80, 0, 0x20, 0, 0, 0, 0, 8]),
        ] {
            assert_eq!(toggled(&frame(&sent)), frame(&arrives));
        }
        let guarding = |state| CanFrame::new(0x705, &[state]).expect("a frame");
        assert_eq!(toggled(&guarding(0x85)), guarding(0x05));
        assert_eq!(toggled(&frame(&[])), frame(&[]));
        let pdo = CanFrame::new(0x185, &[0x10; 8]).expect("a frame");
        assert_eq!(toggled(&pdo), pdo);
    }

    #[test]
    fn bus_off_ends_with_recover() {
        let mut bus = FaultyCan::new(node());
        let start = NmtCommand::Start.frame(None);
        assert_eq!(received(&mut bus, Duration::ZERO), [Ok(boot_up())]);
        bus.inject_nth(CanFault::BusOff, 1);
        bus.bus().power_cycle();
        assert_eq!(received(&mut bus, Duration::ZERO), [Err(CanError::BusOff); 3]);
        assert_eq!(CanPort::send(&mut bus, &start, Duration::ZERO), Err(CanError::BusOff));
        assert_eq!(bus.bus().state(), NmtState::PreOperational, "the frame was not sent");
        // The message of a node that restarts in the meantime is lost.
        bus.bus().power_cycle();
        bus.recover();
        assert_eq!(received(&mut bus, Duration::ZERO), []);
        assert_eq!(CanPort::send(&mut bus, &start, Duration::ZERO), Ok(true));
        assert_eq!(bus.bus().state(), NmtState::Operational);
    }
}
