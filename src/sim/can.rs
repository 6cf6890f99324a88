//! A simulated device as a node on a CAN bus.

mod bus;
mod fault;
mod faulty;
mod guard;
mod layer_setting;
mod nmt;
mod pdo;
mod port;
mod sdo;

use core::time::Duration;
use std::collections::VecDeque;
use std::vec::Vec;

use self::guard::Guard;
use self::layer_setting::LayerSetting;
use self::nmt::Heartbeat;
use self::pdo::Pdos;
use self::sdo::Servers;
use super::device::Device;
use crate::abort::AbortCode;
use crate::clients::canopen::{CanFrame, NmtState};
use crate::lss::{self, BitRate};
use crate::node_id::NodeId;
use crate::pdo::can_id;
use crate::time::TimeOfDay;

pub use self::bus::CanBus;
pub use self::fault::{CanError, CanFault};
pub use self::faulty::{FaultyCan, SimulatedCan};

/// COB-ID of NMT commands (CiA 301 7.2.8.3.1).
const NMT: u32 = 0x000;
/// Maximum number of sent frames that are kept. Older frames are lost, as on a real bus.
const MOST_FRAMES: usize = 1024;

/// A simulated device as a node on a CAN bus.
///
/// The node simulates the SDO server, NMT, heartbeat and emergency messages. The node transmits PDOs on SYNC, on change
/// and by timer, according to their transmission type, inhibit time, event timer and SYNC start value. CANopen clients
/// use the node as their CAN port. The clock of the node is simulated. The clock advances only by
/// [`advance`](Self::advance), by waiting for a frame, and by the access time of the device for each received frame.
/// Tests therefore never wait in real time.
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
/// // The heartbeat of a node in Pre-operational.
/// assert_eq!(drive.client().heartbeat(Duration::from_secs(1))?, Some(NmtState::PreOperational));
/// # Ok::<(), lexibus::Error<core::convert::Infallible>>(())
/// ```
///
/// The SDO server supports expedited, segmented and block transfers of at most 8,192 bytes. The objects 0x1201 to 0x127F
/// declare further SDO channels.
///
/// The node is an LSS slave (CiA 305). The LSS address of the node is in object 0x1018.
/// [`without_node_id`](Self::without_node_id) creates a node that an LSS master has to configure first. [`CanBus`] is a
/// bus with several nodes.
///
/// The node answers node guarding if its producer heartbeat time (0x1017) is 0. The node sends the emergency message
/// 0x8130 if no further guarding request arrives within the node life time (0x100C × 0x100D). The node consumes TIME if
/// bit 31 of object 0x1012 is set. The node doesn't send PDOs in response to remote frames.
#[derive(Debug)]
pub struct CanNode {
    device: Device,
    state: NmtState,
    now: Duration,
    outgoing: VecDeque<CanFrame>,
    heartbeat: Option<Heartbeat>,
    servers: Servers,
    pdos: Pdos,
    refused: Vec<(u16, AbortCode)>,
    is_connected: bool,
    lss: LayerSetting,
    guard: Guard,
    time_of_day: Option<TimeOfDay>,
}

impl CanNode {
    /// Creates a node after power-on, in Pre-operational. The first sent frame is the boot-up message.
    #[must_use]
    pub fn new(device: Device) -> Self {
        let lss = LayerSetting::new(Some(device.node_id()));
        let mut node = Self::with_layer_setting(device, lss);
        node.boot();
        node
    }

    /// Creates a node after power-on that has no node-ID. Until an LSS master assigns a node-ID, the node takes part
    /// only in LSS, and its state is [`NmtState::BootUp`].
    #[must_use]
    pub fn without_node_id(device: Device) -> Self {
        Self::with_layer_setting(device, LayerSetting::new(None))
    }

    fn with_layer_setting(device: Device, lss: LayerSetting) -> Self {
        Self {
            state: NmtState::BootUp,
            now: Duration::ZERO,
            outgoing: VecDeque::new(),
            heartbeat: None,
            servers: Servers::new(&device),
            pdos: Pdos::default(),
            refused: Vec::new(),
            is_connected: true,
            lss,
            guard: Guard::default(),
            time_of_day: None,
            device,
        }
    }

    /// Returns the node-ID, or `None` if the node has none.
    #[must_use]
    pub const fn node_id(&self) -> Option<NodeId> {
        self.lss.node_id()
    }

    /// Returns the time in the last TIME message, or `None` if the node has not consumed a TIME message.
    #[must_use]
    pub const fn time_of_day(&self) -> Option<TimeOfDay> {
        self.time_of_day
    }

    /// Returns the bit rate that an LSS master has activated, or that was stored at power-on. Returns `None` if the bit
    /// rate has not been changed.
    #[must_use]
    pub const fn bit_rate(&self) -> Option<BitRate> {
        self.lss.bit_rate()
    }

    /// Returns the device. If you change values of the device, the node sends the resulting frames before it processes
    /// the next received frame.
    pub fn device(&mut self) -> &mut Device {
        &mut self.device
    }

    /// Returns the device and drops the node.
    #[must_use]
    pub fn into_device(self) -> Device {
        self.device
    }

    /// Returns the NMT state.
    #[must_use]
    pub const fn state(&self) -> NmtState {
        self.state
    }

    /// Returns the simulated time since power-on.
    #[must_use]
    pub const fn now(&self) -> Duration {
        self.now
    }

    /// Disconnects the node from the bus, or connects it again. A disconnected node neither receives nor sends frames,
    /// but its clock continues.
    pub fn set_connected(&mut self, is_connected: bool) {
        self.is_connected = is_connected;
    }

    /// Switches the node off and on. The node restarts with its stored values, and sends its boot-up message.
    pub fn power_cycle(&mut self) {
        self.outgoing.clear();
        self.lss.power_on();
        self.adopt_node_id();
        self.device.power_cycle();
        self.boot();
    }

    /// Allows SDO block transfers, or refuses them with the abort code 0x05040001, as a device without block transfers
    /// does. Block transfers are allowed by default.
    pub fn allow_blocks(&mut self, has_blocks: bool) {
        self.servers.allow_blocks(has_blocks);
    }

    /// Returns and removes the errors of received PDOs. Each error consists of the index of the PDO's mapping object
    /// and an abort code: [`AbortCode::TOO_SHORT`] if bytes are missing, otherwise the code of the first refused value.
    /// A real device doesn't report refused values on the bus.
    pub fn take_refused(&mut self) -> Vec<(u16, AbortCode)> {
        core::mem::take(&mut self.refused)
    }

    /// Processes a frame that the node receives.
    pub fn handle(&mut self, frame: &CanFrame) {
        if !self.is_connected {
            return;
        }
        let time = self.device.access_time();
        self.advance(time);
        self.settle();
        match frame.id() {
            _ if self.lss.is_silent(self.now) => {}
            lss::REQUESTS => self.configure(frame),
            _ if self.node_id().is_none() => {}
            _ if frame.is_remote() => self.answer_guarding(frame.id()),
            NMT => self.command(frame),
            _ if self.transfer(frame) || self.consume_time(frame) => {}
            id if self.state == NmtState::Operational => self.process(id, frame.data()),
            _ => {}
        }
        self.settle();
    }

    /// Returns the next frame that the node has sent, or `None` if there is no further frame.
    pub fn next_frame(&mut self) -> Option<CanFrame> {
        self.settle();
        self.outgoing.pop_front()
    }

    /// Moves the clock forward. The node sends the frames that become due, for example heartbeats and PDOs.
    pub fn advance(&mut self, time: Duration) {
        let end = self.now.saturating_add(time);
        self.settle();
        while let Some(next) = self.next_event().filter(|next| *next <= end) {
            self.set_time(next);
            self.settle();
        }
        self.set_time(end);
    }

    /// Moves the clocks of the node and of the device forward.
    fn set_time(&mut self, now: Duration) {
        self.device.step(now.saturating_sub(self.now));
        self.now = now;
    }

    /// Returns the time of the next timer event.
    fn next_event(&self) -> Option<Duration> {
        let heartbeat = self.heartbeat.map(|heartbeat| heartbeat.due);
        let pdos = if self.state == NmtState::Operational { self.pdos.next_event(&self.device) } else { None };
        let step = self.device.next_step().map(|time| self.now.saturating_add(time));
        let events = [heartbeat, pdos, step, self.servers.deadline(), self.guard.deadline()];
        events.into_iter().flatten().filter(|event| *event > self.now).min()
    }

    /// Sends all frames that are due because a timer has expired or the device has changed.
    fn settle(&mut self) {
        if self.node_id().is_none() {
            return;
        }
        self.beat();
        if self.guard.is_expired(self.now) {
            self.fail_life_guarding();
        }
        for frame in self.servers.timed_out(&self.device, self.now) {
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
        if self.is_connected && !self.lss.is_silent(self.now) {
            if self.outgoing.len() >= MOST_FRAMES {
                self.outgoing.pop_front();
            }
            self.outgoing.push_back(frame);
        }
    }

    /// Sends the emergency messages of the device if they are enabled (0x1014, CiA 301 7.5.2.17).
    fn tell(&mut self) {
        const UNUSED: u64 = 1 << 31;
        let default = 0x80 + u64::from(self.device.node_id().get());
        let cob_id = self.device.slots.number(0x1014, 0).unwrap_or(default);
        let emergencies: Vec<_> = self.device.take_emergencies().collect();
        for emergency in emergencies.iter().filter(|_| cob_id & UNUSED == 0) {
            let frame = can_id(cob_id as u32).and_then(|id| CanFrame::new(id, &emergency.to_bytes()));
            frame.into_iter().for_each(|frame| self.emit(frame));
        }
    }

    /// Processes a message of the LSS master.
    fn configure(&mut self, frame: &CanFrame) {
        let before = self.node_id();
        if let Some(answer) = self.lss.handle(&self.device, frame, self.now) {
            self.emit(answer);
        }
        if self.node_id() != before {
            self.restart_communication();
        }
    }

    /// Processes an SDO request. Returns false for any other frame, and in Stopped.
    fn transfer(&mut self, frame: &CanFrame) -> bool {
        if self.state == NmtState::Stopped {
            return false;
        }
        let replies = self.servers.handle(&mut self.device, frame, self.now);
        let is_request = replies.is_some();
        replies.into_iter().flatten().for_each(|reply| self.emit(reply));
        is_request
    }

    /// Processes a SYNC message or a PDO.
    fn process(&mut self, id: u32, data: &[u8]) {
        let sync = can_id(self.device.slots.number(0x1005, 0).unwrap_or(0x80) as u32);
        if Some(id) == sync {
            self.refused.extend(self.pdos.actuate(&mut self.device));
            for frame in self.pdos.sampled(&self.device, self.now, data.first().copied()) {
                self.emit(frame);
            }
        } else {
            self.refused.extend(self.pdos.receive(&mut self.device, id, data));
        }
    }
}

#[cfg(test)]
mod guard_tests;
#[cfg(test)]
mod lss_tests;
#[cfg(test)]
mod tests;
