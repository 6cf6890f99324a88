//! Converts frames to events.

use lexibus::clients::canopen::{CanFrame, NmtCommand, NmtState};
use lexibus::{Emergency, NodeId, TimeOfDay};

use super::block::Blocks;
use super::emergency;
use super::event::{Event, EventKind};
use super::process::Pdos;
use super::sdo;
use crate::description::Description;

/// COB-ID of SYNC (CiA 301 7.3.3).
const SYNC: u32 = 0x080;

/// Converts frames to events with names, values and units.
#[derive(Debug)]
pub struct Interpreter<'d> {
    nodes: Vec<(u8, &'d Description)>,
    pdos: Pdos<'d>,
    pub(super) blocks: Blocks,
}

impl<'d> Interpreter<'d> {
    /// Creates an interpreter for nodes with these node-IDs and descriptions. PDOs of other nodes are not interpreted.
    /// Events of their other messages contain no names of parameters and error codes.
    pub fn new(nodes: impl IntoIterator<Item = (u8, &'d Description)>) -> Self {
        let nodes: Vec<_> = nodes.into_iter().collect();
        let pdos = Pdos::new(&nodes);
        Self { nodes, pdos, blocks: Blocks::default() }
    }

    /// Returns the description of a node.
    pub(super) fn description(&self, node: u8) -> Option<&'d Description> {
        self.nodes.iter().find(|(id, _)| *id == node).map(|(_, description)| *description)
    }

    /// Returns the event of the next frame. Returns `None` for remote frames and for unknown COB-IDs. Known are the PDOs
    /// that a description declares, and the default COB-IDs of NMT, heartbeat, SYNC, TIME, emergency, SDO and LSS messages.
    pub fn interpret(&mut self, frame: &CanFrame) -> Option<Event> {
        if frame.is_remote() {
            return None;
        }
        // PDOs come first, because a description can use a predefined COB-ID for a PDO.
        self.pdos.event(frame).or_else(|| self.service(frame)).or_else(|| sdo::event(self, frame))
    }

    fn service(&self, frame: &CanFrame) -> Option<Event> {
        if let Some((command, node)) = NmtCommand::of(frame) {
            let node = node.map(NodeId::get);
            let everyone = if node.is_none() { " (all nodes)" } else { "" };
            return Some(Event::new(node, EventKind::Nmt, format!("NMT {}{everyone}", command_name(command))));
        }
        if let Some((node, state)) = NmtState::of(frame) {
            let text = match state {
                NmtState::BootUp => "boot-up".to_owned(),
                state => format!("state {}", state_name(state)),
            };
            return Some(Event::new(Some(node.get()), EventKind::State, text));
        }
        if frame.id() == SYNC && frame.data().len() <= 1 {
            let counter = frame.data().first().map(|counter| format!(" {counter}")).unwrap_or_default();
            return Some(Event::new(None, EventKind::Sync, format!("SYNC{counter}")));
        }
        if let Some(time) = TimeOfDay::of(frame) {
            return Some(Event::new(None, EventKind::Time, format!("TIME {time:?}")));
        }
        if matches!(frame.id(), 0x7E4 | 0x7E5) {
            return Some(Event::new(None, EventKind::Lss, "LSS message"));
        }
        let node = frame.id().checked_sub(SYNC).and_then(|node| NodeId::new(node.try_into().ok()?))?;
        let message = Emergency::of(frame, node)?;
        Some(emergency::event(node.get(), &message, self.description(node.get())))
    }
}

fn command_name(command: NmtCommand) -> &'static str {
    match command {
        NmtCommand::Start => "start",
        NmtCommand::Stop => "stop",
        NmtCommand::EnterPreOperational => "enter Pre-operational",
        NmtCommand::ResetNode => "reset node",
        NmtCommand::ResetCommunication => "reset communication",
    }
}

/// Returns the name of an NMT state.
pub(crate) fn state_name(state: NmtState) -> String {
    match state {
        NmtState::BootUp => "Boot-up".to_owned(),
        NmtState::Stopped => "Stopped".to_owned(),
        NmtState::Operational => "Operational".to_owned(),
        NmtState::PreOperational => "Pre-operational".to_owned(),
        NmtState::Unknown(number) => format!("unknown ({number})"),
    }
}
