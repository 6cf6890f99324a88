//! Events on a bus.

use std::fmt;

use serde::Serialize;

/// An event on the bus.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Event {
    /// Node that sent the message, or to which it was sent. `None` for SYNC, TIME and LSS messages, and for NMT commands to all
    /// nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<u8>,
    /// Kind of the event.
    pub kind: EventKind,
    /// The event as text, without the node and the values.
    pub text: String,
    /// Values with their names.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Named>,
}

/// A value with its name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Named {
    /// Address of the parameter or object.
    pub address: String,
    /// Name of the parameter. For an SDO message, the address, followed by the path if the parameter is known.
    pub name: String,
    /// Value as text, or its bytes if it cannot be decoded.
    pub value: String,
}

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// An NMT command.
    Nmt,
    /// A heartbeat, a boot-up message or a reply of node guarding.
    State,
    /// A SYNC message.
    Sync,
    /// A TIME message.
    Time,
    /// An emergency message.
    Emergency,
    /// A PDO.
    Pdo,
    /// A message of an SDO transfer.
    Sdo,
    /// An LSS message (layer setting services).
    Lss,
}

impl EventKind {
    /// Returns the name of the kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            EventKind::Nmt => "nmt",
            EventKind::State => "state",
            EventKind::Sync => "sync",
            EventKind::Time => "time",
            EventKind::Emergency => "emergency",
            EventKind::Pdo => "pdo",
            EventKind::Sdo => "sdo",
            EventKind::Lss => "lss",
        }
    }
}

impl Event {
    pub(super) fn new(node: Option<u8>, kind: EventKind, text: impl Into<String>) -> Self {
        Self { node, kind, text: text.into(), values: Vec::new() }
    }
}

impl fmt::Display for Event {
    /// Writes one line: `node 5: TPDO 2: Position actual value = -2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.node {
            Some(node) => write!(f, "node {node}: {}", self.text)?,
            None => f.write_str(&self.text)?,
        }
        for (at, value) in self.values.iter().enumerate() {
            let separator = if at == 0 { ": " } else { ", " };
            write!(f, "{separator}{} = {}", value.name, value.value)?;
        }
        Ok(())
    }
}
