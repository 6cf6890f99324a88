//! Command protocols and code tables.

use super::{
    Availability, Buses, CompactString, Condition, Documentation, Doubts, Item, ItemRef, MessageRef, SharedList, Texts,
    Value,
};
use crate::source::{Origin, Span};

/// A request and its reply.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Message {
    /// Name.
    pub name: CompactString,
    /// Fields of the request in order; empty if only the device sends.
    pub request: Vec<MessageField>,
    /// Fields of the reply in order; empty if the device sends none.
    pub reply: Vec<MessageField>,
    /// When the command is complete.
    pub completion: Completion,
    /// Approximate reply time in milliseconds, if the source states that the reply is delayed.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub reply_time: Option<u32>,
    /// The earlier message that selects this reply, if the meaning of the reply depends on an earlier request.
    pub after: Option<MessageRef>,
    /// Whether the device also sends this reply after power-on, before it has received one of the messages in `after`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub by_default: bool,
    /// The message that the device sends instead of the reply if it rejects the request.
    pub error: Option<MessageRef>,
    /// Side effects.
    pub side_effects: Vec<CompactString>,
    /// Conditions on items under which the device accepts the message.
    pub accepted_when: Vec<Condition>,
    /// Name in other languages.
    pub names: Texts,
    /// Models, firmware versions and buses that support the message.
    pub availability: Option<Box<Availability>>,
    /// States in which the device accepts the message; empty = all.
    pub accepted_in: Vec<CompactString>,
    /// Example frames in the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub examples: Vec<MessageExample>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Ambiguities in the source, with assumptions.
    pub doubts: Doubts,
    /// Location in the source.
    pub origin: Origin,
}

impl Message {
    /// Returns the typed values of request and reply, including those in repeated fields.
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

/// A request and the reply of a device, as bytes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageExample {
    /// Bytes of the request; empty if the source prints none.
    pub request: Vec<u8>,
    /// Bytes of the reply; empty if the source prints none.
    pub reply: Vec<u8>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Location of the request in the source.
    pub request_at: Span,
    /// Location of the reply in the source.
    pub reply_at: Span,
}

/// When a command is complete.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Completion {
    /// Before the reply.
    #[default]
    Immediate,
    /// With the reply, which can take a long time.
    Reply,
    /// When this item, or this field of a reply, has a value.
    Polled {
        /// Name of the item or field, optionally followed by a dot and the name of a bit. Only an item has an id.
        item: ItemRef,
        /// The bits to compare; `None` = all.
        mask: Option<u64>,
        /// The value of a completed command; `None` = any except 0.
        value: Option<Value>,
        /// Whether the reply to the command itself already has a valid value. If not, this value can still refer to the previous
        /// command.
        #[cfg_attr(feature = "serde", serde(default))]
        in_reply: bool,
    },
    /// After this time in milliseconds.
    Delayed(u32),
}

/// One field of a frame. Fields below one byte are packed from the most significant bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum MessageField {
    /// Fixed bytes.
    Constant(Vec<u8>),
    /// Fixed bits that do not fill a byte.
    FixedBits {
        /// Number of bits.
        bits: u8,
        /// Value of the bits.
        value: u64,
    },
    /// A typed value.
    Value(Box<MessageValue>),
    /// A copy of a request field, or of some of its bytes.
    Echo {
        /// Name of the field.
        field: CompactString,
        /// First and last byte of the copy, counted from 0 in the order on the wire; `None` = all.
        bytes: Option<(u8, u8)>,
    },
    /// Bytes of the request, whatever their meaning, counted from 0 at the start of the data. If the request is shorter, the
    /// missing bytes are unknown.
    Copy {
        /// First byte.
        first: u16,
        /// Last byte.
        last: u16,
    },
    /// The code of an item in a parameter space. In a reply, it is the first code of the request.
    ItemCode {
        /// Name of the parameter space.
        space: CompactString,
        /// Length of the code in bits.
        bits: u8,
    },
    /// The value of the item whose code comes before it.
    ItemValue {
        /// Name of the parameter space.
        space: CompactString,
    },
    /// Zero bytes in the length of the value of the item whose code comes before them.
    ItemPadding {
        /// Name of the parameter space.
        space: CompactString,
    },
    /// Number of unused bytes.
    Padding(u8),
    /// Repeated fields.
    Repeat {
        /// Name of the field with the number of repetitions; `None` = up to the end of the data.
        count: Option<CompactString>,
        /// Maximum number of repetitions.
        max: Option<u16>,
        /// The fields of each repetition.
        fields: Vec<MessageField>,
    },
    /// All remaining bytes.
    Rest,
}

/// A typed value in a message.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageValue {
    /// Name, type and other facts of the value. This item has no binding.
    pub item: Item,
    /// Order of the bytes on the wire. 0 is the most significant byte. Empty = big-endian.
    pub byte_order: Vec<u8>,
    /// The field of the same frame from which the bytes are counted, if the value is a length.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub counts: Option<CompactString>,
}

/// A parameter space of a command protocol: numbers that address items, and the messages that transfer their values.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParameterSpace {
    /// Name.
    pub name: CompactString,
    /// Message that reads a value.
    pub read: Option<MessageRef>,
    /// Message that writes a value.
    pub write: Option<MessageRef>,
    /// Message that writes a value to non-volatile memory.
    pub store: Option<MessageRef>,
    /// Order of the bytes of longer values on the wire. 0 is the most significant byte. Empty = big-endian.
    pub byte_order: Vec<u8>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Location in the source.
    pub origin: Origin,
}

/// How frames are delimited and checked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Framing {
    /// First byte.
    pub start: Option<u8>,
    /// Last byte.
    pub end: Option<u8>,
    /// Byte before an escaped byte.
    pub escape: Option<u8>,
    /// Value that is combined with an escaped byte by exclusive or.
    pub escape_xor: u8,
    /// Bytes that are escaped.
    pub escaped: Vec<u8>,
    /// Algorithm of the checksum: `xor`, `sum`, `crc16`, ….
    pub check: CompactString,
    /// First field that the checksum covers; `None` = from the first byte after `start`.
    pub check_from: Option<CompactString>,
    /// Whether bytes of the checksum are escaped.
    pub check_escaped: bool,
    /// Initial value of the checksum.
    pub check_seed: u32,
    /// Maximum number of data bytes, without start, end, escape bytes and checksum.
    pub max_data: Option<u16>,
    /// Request field with the address of the device; `None` = the protocol has no device addresses.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub address: Option<CompactString>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Location in the source.
    pub origin: Origin,
}

/// A table of codes with their meanings: alarms, emergency codes, abort codes, channel diagnosis.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeTable {
    /// Name.
    pub name: CompactString,
    /// Names of further columns, after code and meaning.
    pub columns: Vec<CompactString>,
    /// Rows.
    pub rows: SharedList<CodeRow>,
    /// Buses on which the codes have these meanings; empty = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
    /// Description.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub documentation: Option<Box<Documentation>>,
    /// Location in the source.
    pub origin: Origin,
}

/// A row of a code table.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeRow {
    /// The code or range as printed (`0x8700`, `F125`, `0xFF13 to 0xFF15`); empty if the source prints decimal numbers.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// Cells as printed, with an empty text for each cell that is not a hexadecimal number.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub printed_cells: Vec<CompactString>,
    /// Code, or first code of a range.
    pub code: i128,
    /// Last code of a range.
    pub last: Option<i128>,
    /// Name.
    pub name: CompactString,
    /// Name in other languages.
    pub names: Texts,
    /// Models and firmware versions that use the code.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub availability: Option<Box<Availability>>,
    /// Cause and remedy.
    pub documentation: Option<Box<Documentation>>,
    /// Values of the further columns.
    pub cells: Vec<Value>,
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
