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
    /// Its name.
    pub name: CompactString,
    /// What the request carries, in order; empty where only the device sends.
    pub request: Vec<MessageField>,
    /// What the reply carries, in order; empty where none is sent.
    pub reply: Vec<MessageField>,
    /// When the order is carried out.
    pub completion: Completion,
    /// About how many milliseconds the reply takes where it comes late, and where the source says.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub reply_time: Option<u32>,
    /// The message after which a device answers so: the meaning of the reply to one request depends on an earlier one.
    pub after: Option<MessageRef>,
    /// Whether the device answers so after power-on too, before any message of those that others name in `after`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub by_default: bool,
    /// The message that comes instead of the reply where the device refuses.
    pub error: Option<MessageRef>,
    /// What else it does.
    pub side_effects: Vec<CompactString>,
    /// Values of items for which the device accepts it.
    pub accepted_when: Vec<Condition>,
    /// The name in other languages.
    pub names: Texts,
    /// Who has it.
    pub availability: Option<Box<Availability>>,
    /// States in which the device accepts it; empty = all.
    pub accepted_in: Vec<CompactString>,
    /// Frames that the source prints as examples.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub examples: Vec<MessageExample>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    pub doubts: Doubts,
    /// Where it is declared.
    pub origin: Origin,
}

impl Message {
    /// The values of request and reply, those of repeated fields too.
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

/// A request, and what a device answered, byte for byte.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageExample {
    /// The bytes of the request; empty where the source has none.
    pub request: Vec<u8>,
    /// The bytes of the reply; empty where the source has none.
    pub reply: Vec<u8>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where the bytes of the request stand.
    pub request_at: Span,
    /// Where the bytes of the reply stand.
    pub reply_at: Span,
}

/// When an order is carried out.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Completion {
    /// Before the reply.
    #[default]
    Immediate,
    /// When the reply comes, which may take long.
    Reply,
    /// When this item, or field of replies, says so.
    Polled {
        /// Its name, perhaps with that of a bit behind a dot. Only an item has an id.
        item: ItemRef,
        /// The bits that count; all where the source names none.
        mask: Option<u64>,
        /// The value that tells that the order is carried out; `None` = any but 0.
        value: Option<Value>,
        /// Whether the reply to the order tells it already: as long as the order isn't carried out, the reply has another value
        /// for certain. Else what it has may still be about the order before.
        #[cfg_attr(feature = "serde", serde(default))]
        in_reply: bool,
    },
    /// After so many milliseconds.
    Delayed(u32),
}

/// One field of a frame. Fields of less than a byte follow each other from the most significant bit on.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum MessageField {
    /// Fixed bytes.
    Constant(Vec<u8>),
    /// Fixed bits where there is no whole byte of them.
    FixedBits {
        /// How many.
        bits: u8,
        /// Their value.
        value: u64,
    },
    /// A typed value.
    Value(Box<MessageValue>),
    /// A copy of a field of the request, or of a part of it.
    Echo {
        /// The field.
        field: CompactString,
        /// First and last byte of the part, the first byte on the wire numbered 0; `None` = all.
        bytes: Option<(u8, u8)>,
    },
    /// Bytes of the request, whatever they mean there: first and last, the first byte of the data numbered 0. Where a request
    /// is shorter, nothing is known of those that it lacks.
    Copy {
        /// First byte.
        first: u16,
        /// Last byte.
        last: u16,
    },
    /// The code of an item, in the named space. In a reply it is the first code of the request.
    ItemCode {
        /// The space.
        space: CompactString,
        /// Length of the code in bits.
        bits: u8,
    },
    /// The value of the item whose code stands in front, in the named space.
    ItemValue {
        /// The space.
        space: CompactString,
    },
    /// Zeros, as many as the value of the item has whose code stands in front, in the named space.
    ItemPadding {
        /// The space.
        space: CompactString,
    },
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

/// A typed value in a message.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MessageValue {
    /// What it is: an item that is found nowhere else, so that it has no binding.
    pub item: Item,
    /// Order of its bytes on the wire, the most significant numbered 0; empty = big-endian.
    pub byte_order: Vec<u8>,
    /// The field of the same frame from which on the value counts the bytes, where it is a length.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub counts: Option<CompactString>,
}

/// Numbers by which a command protocol addresses items, and the messages that carry their values.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParameterSpace {
    /// Its name.
    pub name: CompactString,
    /// The message that reads a value.
    pub read: Option<MessageRef>,
    /// The message that writes it.
    pub write: Option<MessageRef>,
    /// The message that keeps values over power-off.
    pub store: Option<MessageRef>,
    /// Order of the bytes of longer values on the wire, the most significant numbered 0; empty = big-endian.
    pub byte_order: Vec<u8>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
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
    /// Byte that announces an escaped one.
    pub escape: Option<u8>,
    /// What an escaped byte is combined with (exclusive or).
    pub escape_xor: u8,
    /// Bytes that are escaped.
    pub escaped: Vec<u8>,
    /// How the check is formed: `xor`, `sum`, `crc16`, ….
    pub check: CompactString,
    /// The field of the data from which on the check counts; `None` = from the first byte behind `start`.
    pub check_from: Option<CompactString>,
    /// Whether the check itself is escaped.
    pub check_escaped: bool,
    /// Start value of the check.
    pub check_seed: u32,
    /// Greatest number of data bytes, without start, end, escapes and check.
    pub max_data: Option<u16>,
    /// The field of requests that holds the number of the device for which they are; `None` = devices have no numbers.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub address: Option<CompactString>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

/// A table of codes with their meaning: alarms, emergency codes, abort codes, channel diagnosis.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeTable {
    /// Its name.
    pub name: CompactString,
    /// Names of the columns beside code and meaning.
    pub columns: Vec<CompactString>,
    /// Its rows.
    pub rows: SharedList<CodeRow>,
    /// The only buses on which its codes mean this; all of them where it is empty.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
    /// What it is.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

/// One code.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CodeRow {
    /// The code, or codes, in the notation of the source (`0x8700`, `F125`, `0xFF13 to 0xFF15`); empty if that is decimal.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// The cells in the notation of the source; empty for all that it doesn't write as hexadecimal numbers.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub printed_cells: Vec<CompactString>,
    /// The code; the first of a range.
    pub code: i128,
    /// The last code of a range.
    pub last: Option<i128>,
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Models and firmware versions that have it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub availability: Option<Box<Availability>>,
    /// Cause and remedy.
    pub documentation: Option<Box<Documentation>>,
    /// The other columns.
    pub cells: Vec<Value>,
}

impl CodeRow {
    /// Returns the code, or the codes, as the source prints them: `0x8110`, `F125`, `0xFF13 to 0xFF15`. Decimal if the source has no
    /// other notation.
    pub fn printed_code(&self) -> String {
        match (self.printed.as_str(), self.last) {
            ("", None) => self.code.to_string(),
            ("", Some(last)) => format!("{} to {last}", self.code),
            (printed, _) => printed.to_owned(),
        }
    }
}
