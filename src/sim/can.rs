//! A node on a CAN bus, frame by frame.

mod pdo;
mod sdo;

use core::convert::Infallible;
use core::time::Duration;
use std::collections::VecDeque;
use std::vec::Vec;

use self::pdo::Pdos;
use self::sdo::Channel;
use super::device::Device;
use crate::abort::AbortCode;
use crate::clients::canopen::{AsyncCanPort, CanFrame, CanPort, NmtCommand, NmtState};
use crate::node_id::NodeId;

/// The commands of network management (CiA 301 7.2.8.3.1), on this identifier.
const NMT: u16 = 0x000;
/// SDO requests, plus the node-ID.
const SDO_REQUEST: u16 = 0x600;
/// So many frames wait for somebody to take them; older ones are lost, as on a bus.
const MOST_FRAMES: usize = 1024;

/// A simulated device as a node on a CAN bus, frame by frame: the SDO server, network management, heartbeat, emergency
/// messages, and PDOs on SYNC, on change and by their timers.
///
/// It is the port that clients of CANopen run on. It has a clock of its own, which only [`advance`](Self::advance) and
/// waiting for a frame move on: no test waits for real.
///
/// ```
/// use core::time::Duration;
///
/// use lexibus::clients::canopen::{NmtState, Node};
/// use lexibus::sim::{CanNode, Device};
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::{DemoDrive, ENTRIES};
///
/// let id = NodeId::new(5).unwrap();
/// let node = CanNode::new(Device::new(ENTRIES).with_node_id(id));
/// let mut drive = DemoDrive::new(Node::new(node, id));
/// drive.producer_heartbeat_time().write(100)?;
/// assert_eq!(drive.producer_heartbeat_time().read(), Ok(100));
/// // The heartbeat of a node that is pre-operational.
/// assert_eq!(drive.client().heartbeat(Duration::from_secs(1))?, Some(NmtState::PreOperational));
/// # Ok::<(), lexibus::Error<core::convert::Infallible>>(())
/// ```
///
/// Not simulated: SDO block transfers, node guarding and other remote requests, LSS, and identifiers of 29 bits.
#[derive(Debug)]
pub struct CanNode {
    device: Device,
    state: NmtState,
    now: Duration,
    outgoing: VecDeque<CanFrame>,
    heartbeat: Option<Heartbeat>,
    channel: Channel,
    pdos: Pdos,
    refused: Vec<(u16, AbortCode)>,
    is_connected: bool,
}

/// When the next heartbeat is due.
#[derive(Clone, Copy, Debug)]
struct Heartbeat {
    period: Duration,
    due: Duration,
}

impl CanNode {
    /// A node after power-on: its boot-up message waits, and it is pre-operational.
    #[must_use]
    pub fn new(device: Device) -> Self {
        let mut node = Self {
            state: NmtState::PreOperational,
            now: Duration::ZERO,
            outgoing: VecDeque::new(),
            heartbeat: None,
            channel: Channel::new(device.node_id()),
            pdos: Pdos::default(),
            refused: Vec::new(),
            is_connected: true,
            device,
        };
        node.boot();
        node
    }

    /// The device. What it changes is sent with the next frame that somebody asks for.
    pub fn device(&mut self) -> &mut Device {
        &mut self.device
    }

    /// Gives the device back.
    #[must_use]
    pub fn into_device(self) -> Device {
        self.device
    }

    /// The state of network management.
    #[must_use]
    pub const fn state(&self) -> NmtState {
        self.state
    }

    /// The time since power-on, by the node's own clock.
    #[must_use]
    pub const fn now(&self) -> Duration {
        self.now
    }

    /// Takes the node off the bus, or puts it back. Off it, it neither receives nor sends, and its clock goes on.
    pub fn set_connected(&mut self, is_connected: bool) {
        self.is_connected = is_connected;
    }

    /// Values that PDOs brought and the device refused, and the mapping objects of these PDOs. A device says nothing of them
    /// on the bus.
    pub fn take_refused(&mut self) -> Vec<(u16, AbortCode)> {
        core::mem::take(&mut self.refused)
    }

    /// The node receives a frame.
    pub fn handle(&mut self, frame: &CanFrame) {
        if !self.is_connected {
            return;
        }
        self.settle();
        let node = u16::from(self.device.node_id().get());
        match frame.id() {
            NMT => self.command(frame),
            id if id == SDO_REQUEST + node => self.transfer(frame),
            id if self.state == NmtState::Operational => self.process(id, frame.data()),
            _ => {}
        }
        self.settle();
    }

    /// The next frame that the node has sent; `None` where it has sent nothing.
    pub fn next_frame(&mut self) -> Option<CanFrame> {
        self.settle();
        self.outgoing.pop_front()
    }

    /// Moves the clock on. Heartbeats and PDOs that are due meanwhile are sent.
    pub fn advance(&mut self, time: Duration) {
        let end = self.now.saturating_add(time);
        self.settle();
        while let Some(next) = self.next_event().filter(|next| *next <= end) {
            self.now = next;
            self.settle();
        }
        self.now = end;
    }

    /// When the node does something by itself, without anything being received or changed.
    fn next_event(&self) -> Option<Duration> {
        let heartbeat = self.heartbeat.map(|heartbeat| heartbeat.due);
        let pdos = if self.state == NmtState::Operational { self.pdos.next_event(&self.device) } else { None };
        let events = [heartbeat, pdos, self.channel.deadline()];
        events.into_iter().flatten().filter(|event| *event > self.now).min()
    }

    /// Sends what is due by now, and what the device has to tell.
    fn settle(&mut self) {
        self.beat();
        if let Some(frame) = self.channel.timed_out(self.now) {
            self.emit(frame);
        }
        if self.state != NmtState::Stopped {
            self.tell();
        }
        if self.state == NmtState::Operational {
            for frame in self.pdos.changed(&self.device, self.now) {
                self.emit(frame);
            }
        }
    }

    fn emit(&mut self, frame: CanFrame) {
        if self.is_connected {
            if self.outgoing.len() >= MOST_FRAMES {
                self.outgoing.pop_front();
            }
            self.outgoing.push_back(frame);
        }
    }

    /// Sends the heartbeat when it is due (0x1017, CiA 301 7.2.8.3.2.2).
    fn beat(&mut self) {
        let period = Duration::from_millis(self.device.slots.number(0x1017, 0).unwrap_or(0));
        if period.is_zero() {
            self.heartbeat = None;
            return;
        }
        let heartbeat = self.heartbeat.filter(|heartbeat| heartbeat.period == period);
        let mut heartbeat = heartbeat.unwrap_or(Heartbeat { period, due: self.now + period });
        while heartbeat.due <= self.now {
            self.emit(self.state.heartbeat(self.device.node_id()));
            heartbeat.due += period;
        }
        self.heartbeat = Some(heartbeat);
    }

    /// Sends the emergency messages of the device, where it may (0x1014, CiA 301 7.5.2.17).
    fn tell(&mut self) {
        const UNUSED: u64 = 1 << 31;
        let default = 0x80 + u64::from(self.device.node_id().get());
        let cob_id = self.device.slots.number(0x1014, 0).unwrap_or(default);
        let emergencies: Vec<_> = self.device.take_emergencies().collect();
        for emergency in emergencies.iter().filter(|_| cob_id & UNUSED == 0) {
            if let Some(frame) = CanFrame::new(cob_id as u16 & 0x7FF, &emergency.to_bytes()) {
                self.emit(frame);
            }
        }
    }

    /// Sends the boot-up message, after which the node is pre-operational (CiA 301 7.2.8.3.3).
    fn boot(&mut self) {
        self.heartbeat = None;
        self.channel = Channel::new(self.device.node_id());
        self.enter(NmtState::PreOperational);
        self.emit(NmtState::BootUp.heartbeat(self.device.node_id()));
        self.settle();
    }

    fn enter(&mut self, state: NmtState) {
        if self.state != state {
            self.pdos = Pdos::default();
        }
        if state == NmtState::Stopped {
            self.channel = Channel::new(self.device.node_id());
        }
        self.state = state;
    }

    /// A command of network management to this node, or to all.
    fn command(&mut self, frame: &CanFrame) {
        let is_addressed = |node: Option<NodeId>| node.map_or(true, |node| node == self.device.node_id());
        match NmtCommand::of(frame).filter(|(_, node)| is_addressed(*node)).map(|(command, _)| command) {
            Some(NmtCommand::Start) => self.enter(NmtState::Operational),
            Some(NmtCommand::Stop) => self.enter(NmtState::Stopped),
            Some(NmtCommand::EnterPreOperational) => self.enter(NmtState::PreOperational),
            Some(NmtCommand::ResetNode) => {
                self.device.power_cycle();
                self.boot();
            }
            Some(NmtCommand::ResetCommunication) => {
                let is_communication = |index: u16| (0x1000..=0x1FFF).contains(&index);
                self.device.reset(|entry| entry.object.is_some_and(|object| is_communication(object.index)));
                self.boot();
            }
            None => {}
        }
    }

    fn transfer(&mut self, frame: &CanFrame) {
        if self.state == NmtState::Stopped {
            return;
        }
        if let Some(answer) = self.channel.handle(&mut self.device, frame, self.now) {
            self.emit(answer);
        }
    }

    /// SYNC, or a PDO.
    fn process(&mut self, id: u16, data: &[u8]) {
        let sync = self.device.slots.number(0x1005, 0).unwrap_or(0x80) as u16 & 0x7FF;
        if id == sync {
            self.refused.extend(self.pdos.actuate(&mut self.device));
            for frame in self.pdos.sampled(&self.device, self.now) {
                self.emit(frame);
            }
        } else {
            self.refused.extend(self.pdos.receive(&mut self.device, id, data));
        }
    }
}

/// A bus with this node and no other. Waiting for a frame moves its clock on.
impl CanPort for CanNode {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        self.handle(frame);
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now.saturating_add(patience);
        loop {
            while let Some(frame) = self.next_frame() {
                if wanted(&frame) {
                    return Ok(Some(frame));
                }
            }
            match self.next_event().filter(|next| *next <= end) {
                Some(next) => self.now = next,
                None => {
                    self.now = end;
                    return Ok(None);
                }
            }
        }
    }
}

/// The same; its futures are ready at once.
impl AsyncCanPort for CanNode {
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
}

#[cfg(test)]
mod tests;
