//! Command protocols, code tables, state machines and procedures.

use serde::{Deserialize, Serialize};

use super::{Availability, CompactString, Direction, Documentation, Doubt, Scale, Texts, Type, Value};
use crate::source::Origin;

/// A request and its reply.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Message {
    /// Its name.
    pub name: CompactString,
    /// What the request carries, in order; empty where only the device sends.
    pub request: Vec<MessageField>,
    /// What the reply carries, in order; empty where none is sent.
    pub reply: Vec<MessageField>,
    /// When the order is carried out.
    pub completion: Completion,
    /// Who has it.
    pub availability: Option<Box<Availability>>,
    /// States in which the device accepts it; empty = all.
    pub accepted_in: Vec<CompactString>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    pub doubts: Vec<Doubt>,
    /// Where it is declared.
    pub origin: Origin,
}

/// When an order is carried out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Completion {
    /// Before the reply.
    #[default]
    Immediate,
    /// When this status item says so.
    Polled(CompactString),
    /// After so many milliseconds.
    Delayed(u32),
}

/// One field of a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MessageField {
    /// Fixed bytes.
    Constant(Vec<u8>),
    /// A typed value.
    Value {
        /// Its name.
        name: CompactString,
        /// Its type.
        ty: Type,
        /// Order of its bytes, the most significant numbered 0; empty = big-endian.
        byte_order: Vec<u8>,
        /// Unit of the physical value.
        unit: CompactString,
        /// How the raw number relates to it.
        scale: Option<Scale>,
    },
    /// A copy of a part of the request.
    Echo(CompactString),
    /// The code of an item, in the named space.
    ItemCode(CompactString),
    /// Bytes without meaning.
    Padding(u8),
    /// Fields that occur several times.
    Repeat {
        /// The field that holds the number of repetitions; `None` = up to the end.
        count: Option<CompactString>,
        /// The greatest number of repetitions.
        max: Option<u16>,
        /// What is repeated.
        fields: Vec<MessageField>,
    },
    /// All bytes that follow.
    Rest,
}

/// How frames are delimited and checked.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Framing {
    /// First byte.
    pub start: Option<u8>,
    /// Last byte.
    pub end: Option<u8>,
    /// Byte that announces an escaped one.
    pub escape: Option<u8>,
    /// What an escaped byte is combined with (exclusive or).
    pub escape_xor: u8,
    /// Bytes that are escaped.
    pub escaped: Vec<u8>,
    /// How the check is formed, as the source names it.
    pub check: CompactString,
    /// Start value of the check.
    pub check_seed: u32,
    /// Greatest number of data bytes.
    pub max_data: Option<u16>,
}

/// A table of codes with their meaning: alarms, emergency codes, abort codes, channel diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeTable {
    /// Its name.
    pub name: CompactString,
    /// Names of the columns beside code and meaning.
    pub columns: Vec<CompactString>,
    /// Its rows.
    pub rows: Vec<CodeRow>,
    /// Where it is declared.
    pub origin: Origin,
}

/// One code.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeRow {
    /// The code; the first of a range.
    pub code: i128,
    /// The last code of a range.
    pub last: Option<i128>,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Cause and remedy.
    pub documentation: Option<Box<Documentation>>,
    /// The other columns.
    pub cells: Vec<Value>,
}

/// A state machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StateMachine {
    /// Its name.
    pub name: CompactString,
    /// The item that tells the state.
    pub status_item: CompactString,
    /// The item that commands it.
    pub control_item: CompactString,
    /// States: name, mask and value of the status item.
    pub states: Vec<(CompactString, u32, u32)>,
    /// Commands: name, mask and value of the control item.
    pub commands: Vec<(CompactString, u32, u32)>,
    /// Transitions: number, from, to, and the command that causes it (none where the device does).
    pub transitions: Vec<(u16, CompactString, CompactString, Option<CompactString>)>,
}

/// A sequence of steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Procedure {
    /// Its name.
    pub name: CompactString,
    /// Its steps.
    pub steps: Vec<Step>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

/// A step of a procedure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Write a value to an item.
    Write(CompactString, Value),
    /// Wait until an item, under a mask, has a value.
    WaitFor(CompactString, u64, Value),
    /// Wait so many milliseconds.
    Delay(u32),
    /// Send a message.
    Send(CompactString),
    /// Exchange process data once in this direction.
    Exchange(Direction),
    /// Something a person has to do.
    Manual(String),
}
