//! Command protocols and code tables.

use std::sync::Arc;

use super::{
    Availability, Buses, CompactString, Condition, DeviceStateRef, Documentation, Doubts, FactOrigin, FieldId,
    FieldRef, Item, ItemRef, MessageId, MessageRef, SharedList, SpaceRef, Texts, Value,
};
use crate::source::{Origin, Span};

/// A message of a command protocol: a request and its reply.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Message {
    /// Name of the message.
    pub name: CompactString,
    /// Fields of the request, in order; empty if only the device sends data.
    pub request: Vec<MessageField>,
    /// Fields of the reply, in order; empty if the device sends no reply.
    pub reply: Vec<MessageField>,
    /// Request field with the name in [`Framing::address`]. Set by the stage `resolve`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub address: Option<FieldId>,
    /// Request field with the name in [`Framing::check_from`]. Set by the stage `resolve`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub check_from: Option<FieldId>,
    /// The event that completes the command.
    pub completion: Completion,
    /// Approximate reply time in milliseconds, if the source states that the reply is delayed.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub reply_time: Option<u32>,
    /// The earlier message whose request determines the meaning of this reply, if there is one.
    pub after: Option<MessageRef>,
    /// True if the reply also has this meaning after power-on, before the device has received a request that determines the
    /// meaning.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub by_default: bool,
    /// The message that the device sends instead of the reply if it rejects the request.
    pub error: Option<MessageRef>,
    /// Side effects of the request on the device, as texts.
    pub side_effects: Vec<CompactString>,
    /// Conditions on items under which the device accepts the message.
    pub accepted_when: Vec<Condition>,
    /// Name of the message in other languages.
    pub names: Texts,
    /// Models and firmware versions that support the message, and the replacement for the message.
    pub availability: Option<Box<Availability>>,
    /// States in which the device accepts the message; empty = all.
    pub accepted_in: Vec<DeviceStateRef>,
    /// Example frames of the message in the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub examples: Vec<MessageExample>,
    /// Description of the message from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the message, with the assumptions made.
    pub doubts: Doubts,
    /// Location of the message in the source.
    pub origin: Origin,
}

impl Message {
    /// Returns the typed values of the request and the reply, including values in repeated fields.
    pub fn values(&self) -> impl Iterator<Item = &MessageValue> {
        values(&self.request).chain(values(&self.reply))
    }
}

fn values(fields: &[MessageField]) -> Box<dyn Iterator<Item = &MessageValue> + '_> {
    Box::new(fields.iter().flat_map(|field| -> Box<dyn Iterator<Item = &MessageValue>> {
        match field {
            MessageField::Value(value) => Box::new(std::iter::once(value.as_ref())),
            MessageField::Repeat { fields, .. } => values(fields),
            _ => Box::new(std::iter::empty()),
        }
    }))
}

/// An example from the source: the bytes of a request and of the reply to it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageExample {
    /// Bytes of the request; empty if the source prints none.
    pub request: Vec<u8>,
    /// Bytes of the reply; empty if the source prints none.
    pub reply: Vec<u8>,
    /// Description of the example from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the request in the source.
    pub request_at: Span,
    /// Location of the reply in the source.
    pub reply_at: Span,
}

/// The event that completes a command.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Completion {
    /// The command is complete before the device sends the reply.
    #[default]
    Immediate,
    /// The command is complete when the device sends the reply, which can take a long time.
    Reply,
    /// The command is complete when an item, or a field of a reply, has a certain value.
    Polled {
        /// Name of the item or field, optionally followed by a dot and the name of a bit. The reference has an id only if it
        /// refers to an item. Several replies can have a field with this name, so [`MessageValue::completes`] refers to the
        /// command instead.
        item: ItemRef,
        /// Mask of the bits to compare; `None` = all bits.
        mask: Option<u64>,
        /// Value that indicates completion; `None` = any value except 0.
        value: Option<Value>,
        /// True if the value in the reply to the command already refers to this command. Otherwise, the value in that reply can
        /// refer to the previous command.
        #[cfg_attr(feature = "serde", serde(default))]
        in_reply: bool,
    },
    /// The command is complete after this time in milliseconds.
    Delayed(u32),
}

/// One field of a frame. Fields shorter than one byte are packed from the most significant bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum MessageField {
    /// Bytes with a fixed value.
    Constant(Vec<u8>),
    /// Fixed bits that do not fill a byte.
    FixedBits {
        /// Number of fixed bits.
        bits: u8,
        /// Value of the fixed bits.
        value: u64,
    },
    /// A typed value.
    Value(Box<MessageValue>),
    /// A copy of a request field, or of some of its bytes.
    Echo {
        /// The copied field of the request.
        field: FieldRef,
        /// First and last copied byte of the field, counted from 0 in the order on the wire; `None` = all bytes.
        bytes: Option<(u8, u8)>,
    },
    /// A copy of bytes of the request, regardless of their meaning. The first data byte has the number 0. Bytes that a
    /// shorter request lacks are unknown.
    Copy {
        /// Number of the first copied byte in the request.
        first: u16,
        /// Number of the last copied byte in the request.
        last: u16,
    },
    /// The number of a parameter. In a reply, it equals the first parameter number in the request.
    ItemCode {
        /// The parameter space.
        space: SpaceRef,
        /// Length of the parameter number in bits.
        bits: u8,
    },
    /// The value of the parameter whose number precedes this field. In a reply without a parameter number, the number is in the
    /// request.
    ItemValue {
        /// The parameter space.
        space: SpaceRef,
    },
    /// Zero bytes in place of the value of the parameter whose number precedes this field.
    ItemPadding {
        /// The parameter space.
        space: SpaceRef,
    },
    /// This number of unused bytes.
    Padding(u8),
    /// Fields that are repeated.
    Repeat {
        /// Field of the same list with the number of repetitions; `None` = the fields are repeated up to the end of the data.
        count: Option<FieldRef>,
        /// Maximum number of repetitions.
        max: Option<u16>,
        /// Fields of a single repetition.
        fields: Vec<MessageField>,
    },
    /// All remaining bytes of the frame.
    Rest,
}

/// A typed value in a message.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageValue {
    /// Name, type and other facts of the value. The item has no address.
    pub item: Item,
    /// Byte order on the wire as a list of byte numbers, in which 0 is the most significant byte; empty = big-endian.
    pub byte_order: Vec<u8>,
    /// First counted field of the same list, if the value is the number of bytes from this field to the end of the data.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub counts: Option<FieldRef>,
    /// The command whose completion the value indicates, if the value is in a reply and not in a repeated field. If several
    /// commands poll a value with this name, this is the command that the reply answers. If the reply answers none of these
    /// commands, this is the first of them, provided that all have the same completion condition. Set by the stage
    /// `resolve`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub completes: Option<PolledCommand>,
}

/// A command whose completion is indicated by a value in a reply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolledCommand {
    /// The message of the command. Its completion contains the mask and the expected value.
    pub message: MessageId,
    /// Index of the compared field in the list of fields of the value's bit-field type; `None` = the mask of the completion
    /// determines the compared bits.
    pub bits: Option<u32>,
}

/// A parameter space of a command protocol: numbers that address items, and messages that transfer the values of these items.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParameterSpace {
    /// Name of the parameter space.
    pub name: CompactString,
    /// Message that reads a parameter.
    pub read: Option<MessageRef>,
    /// Message that writes a parameter.
    pub write: Option<MessageRef>,
    /// Message that writes a parameter to non-volatile memory.
    pub store: Option<MessageRef>,
    /// Byte order of values on the wire as a list of byte numbers, in which 0 is the most significant byte; empty = big-endian.
    pub byte_order: Vec<u8>,
    /// Description of the parameter space from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the parameter space in the source.
    pub origin: Origin,
}

/// Framing of a command protocol: the delimiters, escapes and checksum of frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Framing {
    /// Byte at the start of a frame.
    pub start: Option<u8>,
    /// Byte at the end of a frame.
    pub end: Option<u8>,
    /// Byte that precedes an escaped byte.
    pub escape: Option<u8>,
    /// Value that is combined with an escaped byte by exclusive or.
    pub escape_xor: u8,
    /// Byte values that are escaped.
    pub escaped: Vec<u8>,
    /// Name of the checksum algorithm: `xor`, `sum`, `crc16`, ….
    pub check: CompactString,
    /// Name of the first field that the checksum covers; `None` = the checksum covers all data bytes. If the request of a
    /// message has this field, [`Message::check_from`] is the id of the field.
    pub check_from: Option<CompactString>,
    /// True if bytes of the checksum are escaped.
    pub check_escaped: bool,
    /// Initial value of the checksum.
    pub check_seed: u32,
    /// Maximum number of data bytes, without start, end, escape bytes and checksum.
    pub max_data: Option<u16>,
    /// Name of the request field with the address of the device; `None` = the protocol has no device addresses. If the request of
    /// a message has this field, [`Message::address`] is the id of the field.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub address: Option<CompactString>,
    /// Description of the framing from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the framing in the source.
    pub origin: Origin,
}

/// A table of codes with their meanings: alarms, emergency codes, abort codes, channel diagnosis.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeTable {
    /// Name of the code table.
    pub name: CompactString,
    /// Names of the further columns, after code and meaning.
    pub columns: Vec<CompactString>,
    /// Rows of the table.
    pub rows: SharedList<CodeRow>,
    /// Buses on which the codes have these meanings; empty = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
    /// Description of the code table.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the code table and its rows, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Origin of the code table; `None` = the description itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stated_by: Option<Box<FactOrigin>>,
    /// Location of the code table in the source.
    pub origin: Origin,
}

/// A row of a code table.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeRow {
    /// The code or range as printed (`0x8700`, `F125`, `0xFF13 to 0xFF15`); empty if the source prints decimal numbers.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// Hexadecimal numbers in the further columns, as printed. The text is empty for a cell without a hexadecimal number.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub printed_cells: Vec<CompactString>,
    /// Code, or first code of a range.
    pub code: i128,
    /// Last code of a range.
    pub last: Option<i128>,
    /// Name of the code.
    pub name: CompactString,
    /// Name of the code in other languages.
    pub names: Texts,
    /// Models and firmware versions that use the code.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub availability: Option<Box<Availability>>,
    /// Description of cause and remedy.
    pub documentation: Option<Arc<Documentation>>,
    /// Values of the cells in the further columns.
    pub cells: Vec<Value>,
    /// Origin of the row; `None` = that of the code table.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stated_by: Option<Box<FactOrigin>>,
}

impl CodeRow {
    /// Returns the code or range as printed: `0x8110`, `F125`, `0xFF13 to 0xFF15`. Codes without a printed notation are decimal.
    pub fn printed_code(&self) -> String {
        match (self.printed.as_str(), self.last) {
            ("", None) => self.code.to_string(),
            ("", Some(last)) => format!("{} to {last}", self.code),
            (printed, _) => printed.to_owned(),
        }
    }
}
