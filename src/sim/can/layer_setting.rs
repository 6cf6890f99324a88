//! LSS slave of a node (CiA 305).

use core::time::Duration;

use super::super::device::Device;
use crate::clients::canopen::CanFrame;
use crate::lss::{BitRate, Host, LssAddress, Refusal, Slave, ANSWERS};
use crate::node_id::NodeId;

/// LSS slave of a node, with its non-volatile memory.
#[derive(Clone, Debug)]
pub(super) struct LayerSetting {
    slave: Slave,
    memory: Memory,
}

/// Settings of a node: node-ID and bit rate.
#[derive(Clone, Debug)]
struct Memory {
    stored_node: Option<NodeId>,
    stored_rate: Option<BitRate>,
    configured_rate: Option<BitRate>,
    rate: Option<BitRate>,
    now: Duration,
    /// Time until which the node must not send after a change of its bit rate.
    silent_until: Duration,
}

impl Host for Memory {
    fn configure_bit_timing(&mut self, table: u8, index: u8) -> Result<(), Refusal> {
        let rate = BitRate::from_index(index).filter(|_| table == 0).ok_or(Refusal::NOT_SUPPORTED)?;
        self.configured_rate = Some(rate);
        Ok(())
    }

    fn activate_bit_timing(&mut self, delay: u16) {
        self.rate = self.configured_rate;
        self.silent_until = self.now + 2 * Duration::from_millis(delay.into());
    }

    fn store(&mut self, node: Option<NodeId>) -> Result<(), Refusal> {
        self.stored_node = node;
        self.stored_rate = self.configured_rate;
        Ok(())
    }
}

impl LayerSetting {
    /// Creates a slave after power-on. `node` is the stored node-ID.
    pub fn new(node: Option<NodeId>) -> Self {
        let memory = Memory {
            stored_node: node,
            stored_rate: None,
            configured_rate: None,
            rate: None,
            now: Duration::ZERO,
            silent_until: Duration::ZERO,
        };
        Self { slave: Slave::new(LssAddress::default(), node), memory }
    }

    /// Returns the active node-ID.
    pub const fn node_id(&self) -> Option<NodeId> {
        self.slave.node_id()
    }

    /// Returns the active bit rate.
    pub const fn bit_rate(&self) -> Option<BitRate> {
        self.memory.rate
    }

    /// Returns whether the node neither sends nor receives, because its bit rate changes.
    pub fn is_silent(&self, now: Duration) -> bool {
        now < self.memory.silent_until
    }

    /// Switches the node off and on: the stored settings apply.
    pub fn power_on(&mut self) {
        let Memory { stored_node, stored_rate, .. } = self.memory;
        self.slave = Slave::new(LssAddress::default(), stored_node);
        self.memory.rate = stored_rate.or(self.memory.rate);
        self.memory.configured_rate = self.memory.rate;
    }

    /// Restarts the communication: the configured node-ID applies.
    pub fn restart(&mut self) {
        self.slave.restart();
    }

    /// Processes a message of the master, and returns the answer if there is one.
    pub fn handle(&mut self, device: &Device, frame: &CanFrame, now: Duration) -> Option<CanFrame> {
        let part = |sub_index| device.slots.number(0x1018, sub_index).unwrap_or(0) as u32;
        self.slave.set_address(LssAddress::from_array([1, 2, 3, 4].map(part)));
        self.memory.now = now;
        let request = frame.data().try_into().ok()?;
        let answer = self.slave.handle(&request, &mut self.memory)?;
        CanFrame::new(ANSWERS, &answer)
    }
}
