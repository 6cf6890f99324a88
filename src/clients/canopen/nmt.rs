//! Network management (CiA 301 7.2.8): commands to nodes, and the states of nodes.

use super::frame::CanFrame;
use crate::node_id::NodeId;

/// COB-ID of NMT commands.
const COMMANDS: u32 = 0x000;

/// COB-ID of heartbeats without the node-ID (CiA 301 7.3.5).
pub(super) const ERROR_CONTROL: u32 = 0x700;

/// Default COB-ID of SYNC in object 0x1005 (CiA 301 7.3.5).
pub const SYNC: u32 = 0x080;

/// NMT command to one node or to all nodes (CiA 301 7.2.8.3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NmtCommand {
    /// The node enters Operational, the state in which nodes exchange PDOs.
    Start,
    /// The node enters Stopped, a state in which only NMT and error control (heartbeat or node guarding) work.
    Stop,
    /// The node enters Pre-operational, the state for the configuration of nodes.
    EnterPreOperational,
    /// The node restarts, as after power-on.
    ResetNode,
    /// The node restarts its communication. Objects 0x1000 to 0x1FFF are reset to their initial values.
    ResetCommunication,
}

impl NmtCommand {
    /// Returns the command specifier.
    #[must_use]
    pub const fn specifier(self) -> u8 {
        match self {
            Self::Start => 1,
            Self::Stop => 2,
            Self::EnterPreOperational => 128,
            Self::ResetNode => 129,
            Self::ResetCommunication => 130,
        }
    }

    /// Returns the frame that sends this command to `node`, or to all nodes if `node` is `None`.
    #[must_use]
    pub fn frame(self, node: Option<NodeId>) -> CanFrame {
        CanFrame::of(COMMANDS, [self.specifier(), node.map_or(0, NodeId::get)])
    }

    /// Returns the command in a frame of an NMT master, and the addressed node (`None` for all nodes). Returns `None`
    /// for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame) -> Option<(Self, Option<NodeId>)> {
        let (COMMANDS, &[specifier, node]) = (frame.id(), frame.data()) else { return None };
        let all = [Self::Start, Self::Stop, Self::EnterPreOperational, Self::ResetNode, Self::ResetCommunication];
        let command = all.into_iter().find(|command| command.specifier() == specifier)?;
        let node = match node {
            0 => None,
            number => Some(NodeId::new(number)?),
        };
        Some((command, node))
    }
}

/// NMT state of a node, as its heartbeat reports it (CiA 301 7.2.8.3.2.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NmtState {
    /// The node has just started and enters Pre-operational.
    BootUp,
    /// The node is in Stopped. Only NMT and error control (heartbeat or node guarding) work in this state.
    Stopped,
    /// The node is in Operational. PDOs are exchanged in this state.
    Operational,
    /// The node is in Pre-operational. Nodes are configured in this state.
    PreOperational,
    /// A number that doesn't belong to a defined state.
    Unknown(u8),
}

impl NmtState {
    /// Returns the state with this number. Ignores bit 7, the toggle bit of node guarding.
    #[must_use]
    pub const fn from_raw(raw: u8) -> Self {
        match raw & 0x7F {
            0 => Self::BootUp,
            4 => Self::Stopped,
            5 => Self::Operational,
            0x7F => Self::PreOperational,
            other => Self::Unknown(other),
        }
    }

    /// Returns the number of the state.
    #[must_use]
    pub const fn raw(self) -> u8 {
        match self {
            Self::BootUp => 0,
            Self::Stopped => 4,
            Self::Operational => 5,
            Self::PreOperational => 0x7F,
            Self::Unknown(other) => other,
        }
    }

    /// Returns the heartbeat with which `node` reports this state.
    #[must_use]
    pub fn heartbeat(self, node: NodeId) -> CanFrame {
        CanFrame::of(ERROR_CONTROL + u32::from(node.get()), [self.raw()])
    }

    /// Returns the node and its state from a heartbeat or boot-up message. Returns `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame) -> Option<(NodeId, Self)> {
        let node = frame.id().checked_sub(ERROR_CONTROL).and_then(|node| NodeId::new(node.try_into().ok()?))?;
        match frame.data() {
            [state] => Some((node, Self::from_raw(*state))),
            _ => None,
        }
    }
}

/// Returns a SYNC message (CiA 301 7.2.5). Nodes send and apply their synchronous PDOs when they receive SYNC.
#[must_use]
pub fn sync() -> CanFrame {
    CanFrame::of(SYNC, [])
}

/// Returns a SYNC message with a counter (CiA 301 7.2.5.3), or `None` if the counter is outside the range 1 to 240.
#[must_use]
pub fn sync_with_counter(counter: u8) -> Option<CanFrame> {
    matches!(counter, 1..=240).then(|| CanFrame::of(SYNC, [counter]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands() {
        let node = NodeId::new(5);
        let frame = NmtCommand::Start.frame(node);
        assert_eq!((frame.id(), frame.data()), (0, [1, 5].as_slice()));
        assert_eq!(NmtCommand::of(&frame), Some((NmtCommand::Start, node)));
        let everyone = NmtCommand::ResetCommunication.frame(None);
        assert_eq!(
            (everyone.data(), NmtCommand::of(&everyone)),
            ([130, 0].as_slice(), Some((NmtCommand::ResetCommunication, None)))
        );
        assert_eq!(NmtCommand::of(&CanFrame::of(0, [3, 5])), None);
        assert_eq!(NmtCommand::of(&CanFrame::of(0, [1, 200])), None);
        assert_eq!(NmtCommand::of(&CanFrame::of(1, [1, 5])), None);
    }

    #[test]
    fn heartbeats() {
        let node = NodeId::new(127).expect("a node-ID");
        for state in [NmtState::BootUp, NmtState::Stopped, NmtState::Operational, NmtState::PreOperational] {
            assert_eq!(NmtState::of(&state.heartbeat(node)), Some((node, state)));
        }
        assert_eq!(
            NmtState::of(&CanFrame::of(0x705, [0x85])),
            NodeId::new(5).map(|node| (node, NmtState::Operational))
        );
        assert_eq!(NmtState::from_raw(6), NmtState::Unknown(6));
        assert_eq!(NmtState::of(&CanFrame::of(0x700, [5])), None);
        assert_eq!(NmtState::of(&CanFrame::of(0x705, [])), None);
        assert_eq!(NmtState::of(&CanFrame::of(0x6FF, [5])), None);
    }
}
