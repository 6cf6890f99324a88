//! LSS services and their messages (CiA 305).

use super::address::{IdentityPart, LssAddress};
use super::command;
use super::error::{LssError, Refusal};
use crate::node_id::NodeId;

/// Content of an LSS message. An LSS message always has eight bytes.
pub type Message = [u8; 8];

/// State of an LSS slave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LssState {
    /// The slave waits for a switch to Configuration. A slave without a node-ID takes part in fastscan.
    Waiting,
    /// The slave answers inquiries and accepts a node-ID and a bit timing.
    Configuration,
}

impl LssState {
    /// Returns the mode byte of the service "switch state global".
    const fn mode(self) -> u8 {
        match self {
            Self::Waiting => 0,
            Self::Configuration => 1,
        }
    }
}

/// An LSS service of the master, except fastscan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Service {
    /// Switches all slaves to a state. Slaves don't answer.
    SwitchGlobal(LssState),
    /// Switches the slave with this address to the state Configuration.
    SwitchSelective(LssAddress),
    /// Sets the node-ID of the slave in Configuration. `None` removes the node-ID.
    ConfigureNodeId(Option<NodeId>),
    /// Sets the bit timing of the slave in Configuration. Table 0 is the table of [`BitRate`](super::BitRate).
    ConfigureBitTiming {
        /// Number of the table: 0 for the table of CiA 305, 128 to 255 for vendor-specific tables.
        table: u8,
        /// Index in the table.
        index: u8,
    },
    /// Activates the bit timing of all slaves in Configuration. Slaves don't answer.
    ActivateBitTiming {
        /// Delay in milliseconds until the bit timing changes. After the change, nodes must not send for another
        /// `delay` milliseconds.
        delay: u16,
    },
    /// Stores node-ID and bit timing in the non-volatile memory of the slave in Configuration.
    Store,
    /// Reads one number of the address of the slave in Configuration.
    Inquire(IdentityPart),
    /// Reads the node-ID of the slave in Configuration.
    InquireNodeId,
    /// Asks whether there are slaves in Waiting without a node-ID. All these slaves answer.
    IdentifyUnconfigured,
}

/// Creates a message from a command specifier and a number.
pub(super) const fn with_number(command: u8, number: u32) -> Message {
    let [a, b, c, d] = number.to_le_bytes();
    [command, a, b, c, d, 0, 0, 0]
}

/// Creates a message from a command specifier and two bytes.
const fn with_bytes(command: u8, first: u8, second: u8) -> Message {
    [command, first, second, 0, 0, 0, 0, 0]
}

/// Returns bytes 1 to 4 of a message as a little-endian number.
pub(super) const fn number(message: &Message) -> u32 {
    let [_, a, b, c, d, ..] = *message;
    u32::from_le_bytes([a, b, c, d])
}

/// Creates the answer to a service that the slave accepts or refuses.
pub(super) const fn answer_result(command: u8, result: Result<(), Refusal>) -> Message {
    match result {
        Ok(()) => with_bytes(command, 0, 0),
        Err(Refusal { code, specific }) => with_bytes(command, code, specific),
    }
}

impl Service {
    /// Returns message `step` of the service, or `None` after the last message.
    pub(super) fn message(self, step: u8) -> Option<Message> {
        let message = match self {
            Self::SwitchSelective(address) => {
                return address.at(step).map(|number| with_number(command::SWITCH_SELECTIVE + step, number))
            }
            Self::SwitchGlobal(state) => with_bytes(command::SWITCH_GLOBAL, state.mode(), 0),
            Self::ConfigureNodeId(node) => {
                with_bytes(command::CONFIGURE_NODE_ID, node.map_or(command::NO_NODE_ID, NodeId::get), 0)
            }
            Self::ConfigureBitTiming { table, index } => with_bytes(command::CONFIGURE_BIT_TIMING, table, index),
            Self::ActivateBitTiming { delay } => with_number(command::ACTIVATE_BIT_TIMING, delay as u32),
            Self::Store => with_bytes(command::STORE, 0, 0),
            Self::Inquire(part) => with_bytes(command::INQUIRE + part.position(), 0, 0),
            Self::InquireNodeId => with_bytes(command::INQUIRE_NODE_ID, 0, 0),
            Self::IdentifyUnconfigured => with_bytes(command::IDENTIFY_UNCONFIGURED, 0, 0),
        };
        Some(message).filter(|_| step == 0)
    }

    /// Returns the messages of the service, in the order in which they are sent.
    pub fn messages(self) -> impl Iterator<Item = Message> {
        (0..4).map_while(move |step| self.message(step))
    }

    /// Returns the command specifier of the answer, or `None` if slaves don't answer.
    #[must_use]
    pub const fn answer(self) -> Option<u8> {
        Some(match self {
            Self::SwitchGlobal(_) | Self::ActivateBitTiming { .. } => return None,
            Self::SwitchSelective(_) => command::SWITCHED_SELECTIVE,
            Self::ConfigureNodeId(_) => command::CONFIGURE_NODE_ID,
            Self::ConfigureBitTiming { .. } => command::CONFIGURE_BIT_TIMING,
            Self::Store => command::STORE,
            Self::Inquire(part) => command::INQUIRE + part.position(),
            Self::InquireNodeId => command::INQUIRE_NODE_ID,
            Self::IdentifyUnconfigured => command::IDENTIFIED_UNCONFIGURED,
        })
    }

    /// Returns whether several slaves may answer.
    pub(crate) const fn is_for_several(self) -> bool {
        matches!(self, Self::IdentifyUnconfigured)
    }

    /// Returns whether the service configures or stores settings of the slave in Configuration. The answer to such a
    /// service contains an error code.
    #[cfg(feature = "canopen")]
    pub(crate) const fn is_change(self) -> bool {
        matches!(self, Self::ConfigureNodeId(_) | Self::ConfigureBitTiming { .. } | Self::Store)
    }

    /// Returns the value in an answer: a number of the address, a node-ID, or 0 if the answer has no value. Returns an
    /// error if the slave refuses the service or if the node-ID is invalid.
    pub(super) fn value(self, answer: &Message) -> Result<u32, LssError> {
        let [_, code, specific, ..] = *answer;
        match self {
            Self::Inquire(_) => Ok(number(answer)),
            Self::InquireNodeId if code == command::NO_NODE_ID || NodeId::new(code).is_some() => Ok(code.into()),
            Self::InquireNodeId => Err(LssError::UnexpectedReply),
            _ if self.is_change() && code != 0 => Err(LssError::Refused(Refusal { code, specific })),
            _ => Ok(0),
        }
    }
}
