//! Network management (CiA 301 7.2.8): commands to nodes, and the states that they tell.

use super::frame::CanFrame;
use crate::node_id::NodeId;

/// The identifier of NMT commands.
const COMMANDS: u16 = 0x000;

/// The identifier of heartbeats, less the node-ID (CiA 301 7.3.5).
const ERROR_CONTROL: u16 = 0x700;

/// The identifier of SYNC where object 0x1005 has its usual value (CiA 301 7.3.5).
pub const SYNC: u16 = 0x080;

/// A command to one node, or to all (CiA 301 7.2.8.3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NmtCommand {
    /// To the state operational, in which PDOs are exchanged.
    Start,
    /// To the state stopped, in which nothing is exchanged but NMT and heartbeat.
    Stop,
    /// To the state pre-operational, in which a node is configured.
    EnterPreOperational,
    /// The node starts again, as after power-on.
    ResetNode,
    /// The node's communication starts again; objects 0x1000 to 0x1FFF get their values after power-on.
    ResetCommunication,
}

impl NmtCommand {
    /// The command specifier.
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

    /// The frame that tells it to `node`, or to all nodes.
    #[must_use]
    pub fn frame(self, node: Option<NodeId>) -> CanFrame {
        CanFrame::of(COMMANDS, [self.specifier(), node.map_or(0, NodeId::get)])
    }

    /// What a frame of an NMT master tells: the command, and the node, or all nodes. `None` for other frames.
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

/// The state of a node, as its heartbeat tells it (CiA 301 7.2.8.3.2.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NmtState {
    /// It has just started, and is pre-operational from now on.
    BootUp,
    /// Stopped.
    Stopped,
    /// Operational.
    Operational,
    /// Pre-operational.
    PreOperational,
    /// A number that has no meaning.
    Unknown(u8),
}

impl NmtState {
    /// The state of a number. Bit 7, the toggle bit of node guarding, isn't looked at.
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

    /// The number of the state.
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

    /// The heartbeat by which `node` tells it.
    #[must_use]
    pub fn heartbeat(self, node: NodeId) -> CanFrame {
        CanFrame::of(ERROR_CONTROL + u16::from(node.get()), [self.raw()])
    }

    /// What a heartbeat or boot-up message tells: which node is in which state. `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame) -> Option<(NodeId, Self)> {
        let node = frame.id().checked_sub(ERROR_CONTROL).and_then(|node| NodeId::new(node.try_into().ok()?))?;
        match frame.data() {
            [state] => Some((node, Self::from_raw(*state))),
            _ => None,
        }
    }
}

/// The SYNC message (CiA 301 7.2.5), at which synchronous PDOs are sent and take effect.
#[must_use]
pub fn sync() -> CanFrame {
    CanFrame::of(SYNC, [])
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
