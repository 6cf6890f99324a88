//! The NMT slave of a simulated node: commands, boot-up and heartbeat.

use core::time::Duration;

use super::guard::Guard;
use super::pdo::Pdos;
use super::CanNode;
use crate::clients::canopen::{CanFrame, NmtCommand, NmtState};
use crate::node_id::NodeId;

/// Heartbeat producer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heartbeat {
    period: Duration,
    pub due: Duration,
}

impl CanNode {
    /// Sends the heartbeat if it is due (0x1017, CiA 301 7.2.8.3.2.2).
    pub(super) fn beat(&mut self) {
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

    /// Sends the boot-up message and enters Pre-operational (CiA 301 7.2.8.3.3). A node without a node-ID first waits
    /// until an LSS master assigns a node-ID.
    pub(super) fn boot(&mut self) {
        self.heartbeat = None;
        self.guard = Guard::default();
        self.servers.reset();
        if self.node_id().is_none() {
            self.enter(NmtState::BootUp);
            return;
        }
        self.enter(NmtState::PreOperational);
        self.emit(NmtState::BootUp.heartbeat(self.device.node_id()));
        self.settle();
    }

    pub(super) fn enter(&mut self, state: NmtState) {
        if self.state != state {
            self.pdos = Pdos::default();
        }
        if state == NmtState::Stopped {
            self.servers.reset();
        }
        self.state = state;
    }

    /// Executes an NMT command that is addressed to this node or to all nodes.
    pub(super) fn command(&mut self, frame: &CanFrame) {
        let is_addressed = |node: Option<NodeId>| node.map_or(true, |node| node == self.device.node_id());
        match NmtCommand::of(frame).filter(|(_, node)| is_addressed(*node)).map(|(command, _)| command) {
            Some(NmtCommand::Start) => self.enter(NmtState::Operational),
            Some(NmtCommand::Stop) => self.enter(NmtState::Stopped),
            Some(NmtCommand::EnterPreOperational) => self.enter(NmtState::PreOperational),
            Some(NmtCommand::ResetNode) => self.power_cycle(),
            Some(NmtCommand::ResetCommunication) => {
                self.lss.restart();
                self.restart_communication();
            }
            None => {}
        }
    }

    pub(super) fn restart_communication(&mut self) {
        let is_communication = |index: u16| (0x1000..=0x1FFF).contains(&index);
        self.adopt_node_id();
        self.device.reset(|entry| entry.object.is_some_and(|object| is_communication(object.index)));
        self.boot();
    }

    /// Sets the node-ID of the device to that of the LSS slave.
    pub(super) fn adopt_node_id(&mut self) {
        if let Some(node) = self.node_id() {
            self.device.set_node_id(node);
        }
    }
}
