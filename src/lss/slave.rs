//! Slave side of LSS.

use super::address::LssAddress;
use super::command;
use super::error::Refusal;
use super::fast_scan::Request;
use super::service::{answer_result, number, with_number, LssState, Message};
use crate::node_id::NodeId;

/// The device of an LSS [`Slave`]: its bit timing and its non-volatile memory.
pub trait Host {
    /// Selects the bit timing that [`activate_bit_timing`](Self::activate_bit_timing) activates. Table 0 is the table
    /// of [`BitRate`](super::BitRate).
    ///
    /// # Errors
    ///
    /// Returns the refusal that the slave sends: [`Refusal::NOT_SUPPORTED`] if the device doesn't support the bit
    /// timing.
    fn configure_bit_timing(&mut self, table: u8, index: u8) -> Result<(), Refusal>;

    /// Activates the bit timing after `delay` milliseconds. After the change, the device must not send for another
    /// `delay` milliseconds.
    fn activate_bit_timing(&mut self, delay: u16);

    /// Stores the node-ID (`None` if there is none) and the bit timing in the non-volatile memory.
    ///
    /// # Errors
    ///
    /// Returns the refusal that the slave sends: [`Refusal::NOT_SUPPORTED`] if the device cannot store the settings, or
    /// [`Refusal::STORAGE`] if access to the memory failed.
    fn store(&mut self, node: Option<NodeId>) -> Result<(), Refusal>;
}

/// A [`Host`] that can neither change the bit timing nor store settings.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoHost;

impl Host for NoHost {
    fn configure_bit_timing(&mut self, _: u8, _: u8) -> Result<(), Refusal> {
        Err(Refusal::NOT_SUPPORTED)
    }

    fn activate_bit_timing(&mut self, _: u16) {}

    fn store(&mut self, _: Option<NodeId>) -> Result<(), Refusal> {
        Err(Refusal::NOT_SUPPORTED)
    }
}

/// LSS slave of a device (CiA 305), as a state machine that performs no I/O.
#[derive(Clone, Debug)]
pub struct Slave {
    address: LssAddress,
    state: LssState,
    active: Option<NodeId>,
    pending: Option<NodeId>,
    /// Number of address parts that have matched so far in the service "switch state selective".
    selected: u8,
    /// Position (0 to 3) of the number that the current fastscan compares; `None` before the scan starts.
    scanned: Option<u8>,
}

impl Slave {
    /// Creates a slave in the state Waiting. `node` is the stored node-ID of the device, if it has one.
    #[must_use]
    pub const fn new(address: LssAddress, node: Option<NodeId>) -> Self {
        Self { address, state: LssState::Waiting, active: node, pending: node, selected: 0, scanned: None }
    }

    /// Changes the address of the device.
    #[cfg(feature = "std")]
    pub(crate) fn set_address(&mut self, address: LssAddress) {
        self.address = address;
    }

    /// Returns the LSS state of the slave.
    #[must_use]
    pub const fn state(&self) -> LssState {
        self.state
    }

    /// Returns the node-ID that the device uses. A device without a node-ID takes part only in LSS.
    ///
    /// In a device with a node-ID, a new node-ID takes effect at the next [`restart`](Self::restart). In a device
    /// without a node-ID, the new node-ID takes effect as soon as the master switches the slave to Waiting. The device
    /// then sends its boot-up message.
    #[must_use]
    pub const fn node_id(&self) -> Option<NodeId> {
        self.active
    }

    /// Restarts the communication (NMT command "reset communication"). The device then uses the configured node-ID.
    pub fn restart(&mut self) {
        *self = Self::new(self.address, self.pending);
    }

    /// Processes a message of the master, and returns the answer if there is one.
    pub fn handle(&mut self, request: &Message, host: &mut impl Host) -> Option<Message> {
        let command = request[0];
        let is_selective = (command::SWITCH_SELECTIVE..command::SWITCH_SELECTIVE + 4).contains(&command);
        if !is_selective {
            self.selected = 0;
        }
        match (command, self.state) {
            (command::SWITCH_GLOBAL, _) => {
                self.switch(request[1]);
                None
            }
            (_, LssState::Waiting) if is_selective => self.select(command - command::SWITCH_SELECTIVE, number(request)),
            (command::IDENTIFY_UNCONFIGURED, LssState::Waiting) if self.is_unconfigured() => {
                Some(with_number(command::IDENTIFIED_UNCONFIGURED, 0))
            }
            (command::FAST_SCAN, LssState::Waiting) if self.is_unconfigured() => {
                self.scan(Request::of(request)).then(|| with_number(command::IDENTIFIED, 0))
            }
            (_, LssState::Configuration) => self.configure(request, host),
            _ => None,
        }
    }

    const fn is_unconfigured(&self) -> bool {
        self.active.is_none() && self.pending.is_none()
    }

    fn switch(&mut self, mode: u8) {
        match mode {
            0 => {
                self.state = LssState::Waiting;
                if self.active.is_none() {
                    self.active = self.pending;
                }
            }
            1 => self.state = LssState::Configuration,
            _ => {}
        }
    }

    /// Compares one number of the address. The slave enters Configuration after all four numbers have matched in order.
    fn select(&mut self, part: u8, value: u32) -> Option<Message> {
        let expected = self.address.at(part);
        let is_next = part == 0 || part == self.selected;
        self.selected = if is_next && expected == Some(value) { part + 1 } else { 0 };
        if self.selected < 4 {
            return None;
        }
        self.selected = 0;
        self.state = LssState::Configuration;
        Some(with_number(command::SWITCHED_SELECTIVE, 0))
    }

    /// Processes a fastscan request. Returns whether the slave answers.
    fn scan(&mut self, request: Request) -> bool {
        if request.bit == command::START_SCAN {
            self.scanned = Some(0);
            return true;
        }
        let number = self.address.at(request.part).filter(|_| self.scanned == Some(request.part));
        let (Some(number), Some(mask)) = (number, u32::MAX.checked_shl(request.bit.into())) else { return false };
        if (number ^ request.number) & mask != 0 {
            return false;
        }
        if request.bit == 0 {
            self.scanned = Some(request.next);
            if request.next < request.part {
                self.state = LssState::Configuration;
                self.scanned = None;
            }
        }
        true
    }

    fn configure(&mut self, request: &Message, host: &mut impl Host) -> Option<Message> {
        let [command, first, second, ..] = *request;
        let result = match command {
            command::CONFIGURE_NODE_ID => self.set_node_id(first),
            command::CONFIGURE_BIT_TIMING => host.configure_bit_timing(first, second),
            command::STORE => host.store(self.pending),
            command::ACTIVATE_BIT_TIMING => {
                host.activate_bit_timing(u16::from_le_bytes([first, second]));
                return None;
            }
            command::INQUIRE_NODE_ID => {
                let node = self.active.map_or(command::NO_NODE_ID, NodeId::get);
                return Some(with_number(command, node.into()));
            }
            _ => {
                let number = self.address.at(command.checked_sub(command::INQUIRE)?)?;
                return Some(with_number(command, number));
            }
        };
        Some(answer_result(command, result))
    }

    fn set_node_id(&mut self, node: u8) -> Result<(), Refusal> {
        let id = NodeId::new(node);
        if id.is_none() && node != command::NO_NODE_ID {
            return Err(Refusal::NOT_SUPPORTED);
        }
        self.pending = id;
        Ok(())
    }
}
