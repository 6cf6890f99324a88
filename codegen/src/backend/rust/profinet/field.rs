//! A field in a sequence of bytes: its Rust type, and the code that reads and writes the field.

use super::types::type_name;
use super::values::{Enumeration, Values};
use crate::backend::rust::code::{call, seq, Doc};
use crate::backend::rust::value_type::{native, odd};
use crate::ir::{TimeFormat, Type, TypeDef};
use crate::number::hex8;

/// Number of bits in a word, that is, in a `u64`. Only byte strings may be longer than a word.
const WORD: u32 = 64;

/// Position of a field's bits. If a field extends over several bytes without filling them, the field is a part of the
/// big-endian number in these bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FieldPosition {
    pub byte: u32,
    /// Number of bits that are less significant than the field in the same byte or number.
    pub bit: u32,
    pub bits: u32,
}

impl FieldPosition {
    /// Returns the position of `bits` bits at bit offset `offset`. Returns `None` if `bits` is 0, or if the bits extend
    /// beyond `length` bytes.
    pub(super) fn within(length: u32, offset: u32, bits: u32) -> Option<Self> {
        let position = FieldPosition { byte: offset / 8, bit: offset % 8, bits };
        let last_bit = (position.bit + 8).checked_add(bits)?;
        let end = position.byte.checked_add(last_bit.div_ceil(8))? - 1;
        (bits > 0 && end <= length).then_some(position)
    }

    fn is_bytes(self) -> bool {
        self.bit == 0 && self.bits.is_multiple_of(8)
    }

    /// Returns the position in words, such as `bytes 2 and 3`.
    pub(super) fn words(self) -> String {
        let last_bit = self.bit + self.bits - 1;
        let bytes = match (last_bit / 8, self.byte) {
            (0, first) => format!("byte {first}"),
            (1, first) => format!("bytes {first} and {}", first + 1),
            (more, first) => format!("bytes {first} to {}", first + more),
        };
        match self.bits {
            _ if self.is_bytes() => bytes,
            1 => format!("bit {} of {bytes}", self.bit),
            _ if last_bit < 8 => format!("bits {} to {last_bit} of {bytes}", self.bit),
            _ => format!("bits {} to {last_bit} of the big-endian number in {bytes}", self.bit),
        }
    }
}

/// Interpretation of the bits of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FieldKind {
    /// One bit.
    Bit,
    /// A byte that means false if it is 0, and true otherwise.
    Flag,
    /// An integer of a primitive type that fills whole bytes.
    Native {
        signed: bool,
    },
    /// An integer of up to 64 bits that has no primitive type or does not fill whole bytes.
    Number {
        signed: bool,
    },
    Real,
    /// A time type of the runtime that consists of six bytes. The text is the name of the function that decodes the
    /// type; the function that encodes it has the prefix `from_`.
    Time(&'static str),
    Bytes,
}

/// Purpose of the struct that contains a field. The purpose determines the Rust types of integers whose width no
/// primitive type has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// The struct is an image of cyclic data, which is written without checks. Each field therefore has a type that can
    /// hold only valid values.
    Image,
    /// The struct is a record, whose values are checked before the record is written. Integer fields have primitive
    /// types.
    Record,
}

/// A field, ready to be printed.
#[derive(Clone, Copy)]
pub(super) struct Field<'v> {
    kind: FieldKind,
    pub position: FieldPosition,
    pub enumeration: Option<&'v Enumeration>,
    usage: Use,
}

impl<'v> Field<'v> {
    /// Creates a field of type `ty`. `bits` contains the bit offset of the field and its number of bits. Returns `None`
    /// if the field exceeds `length` bytes or has no Rust type.
    pub(super) fn new(values: &'v Values<'_>, ty: Type, bits: (u32, u32), length: u32, usage: Use) -> Option<Self> {
        let position = FieldPosition::within(length, bits.0, bits.1)?;
        let (base, enumeration) = values.resolve(ty);
        let kind = kind(base, position)?;
        let enumeration = enumeration.filter(|_| matches!(kind, FieldKind::Native { .. } | FieldKind::Number { .. }));
        Some(Field { kind, position, enumeration, usage })
    }

    /// Returns the field's original type and its position, in words. For a bit or a bit area, returns only the
    /// position.
    pub(super) fn facts(&self, types: &[TypeDef], ty: Type) -> String {
        let position = self.position.words();
        match self.kind {
            // The description has no type for single bits and bit areas.
            FieldKind::Bit => position,
            FieldKind::Number { .. } if !self.position.is_bytes() => position,
            _ => format!("{}, {position}", type_name(types, ty)),
        }
    }

    /// Returns the field's Rust type for a documentation table.
    pub(super) fn type_link(&self) -> String {
        match self.enumeration {
            Some(enumeration) => format!("[`{}`]({})", enumeration.name, enumeration.path),
            None => format!("`{}`", self.rust_type().trim_start_matches("rt::")),
        }
    }

    /// Returns the field's Rust type.
    pub(super) fn rust_type(&self) -> String {
        if let Some(enumeration) = self.enumeration {
            return enumeration.path.clone();
        }
        match self.kind {
            FieldKind::Bit | FieldKind::Flag => "bool".to_owned(),
            FieldKind::Number { signed } if self.usage == Use::Image => odd(signed, self.position.bits),
            FieldKind::Native { .. } | FieldKind::Number { .. } => self.native().to_owned(),
            FieldKind::Real => format!("f{}", self.position.bits),
            FieldKind::Time("time_of_day") => "rt::TimeOfDay".to_owned(),
            FieldKind::Time(_) => "rt::TimeDifference".to_owned(),
            FieldKind::Bytes => format!("[u8; {}]", self.position.bits / 8),
        }
    }

    /// Returns the primitive integer that holds the value of the field, or the raw value of an enumeration.
    pub(super) fn native(&self) -> &'static str {
        match self.enumeration {
            Some(enumeration) => enumeration.native,
            None => native(self.is_signed(), self.position.bits),
        }
    }

    fn is_signed(&self) -> bool {
        matches!(self.kind, FieldKind::Native { signed: true } | FieldKind::Number { signed: true })
    }

    /// Returns whether the field is a real number.
    pub(super) fn is_real(&self) -> bool {
        self.kind == FieldKind::Real
    }

    /// Returns whether the field is a Boolean.
    pub(super) fn is_bool(&self) -> bool {
        matches!(self.kind, FieldKind::Bit | FieldKind::Flag)
    }

    /// Returns the length of a byte string. Returns `None` for other fields.
    pub(super) fn byte_string(&self) -> Option<u32> {
        (self.kind == FieldKind::Bytes).then_some(self.position.bits / 8)
    }

    /// Returns the minimum and maximum of an integer. Returns `None` for other fields.
    pub(super) fn range(&self) -> Option<(i128, i128)> {
        let bits = u8::try_from(self.position.bits).ok()?;
        match self.kind {
            FieldKind::Native { signed: true } | FieldKind::Number { signed: true } => {
                Type::Integer(bits).integer_range()
            }
            FieldKind::Native { .. } | FieldKind::Number { .. } => Type::Unsigned(bits).integer_range(),
            _ => None,
        }
    }

    /// Returns whether the Rust type has values that do not fit in the field.
    pub(super) fn is_narrow(&self) -> bool {
        self.usage == Use::Record
            && matches!(self.kind, FieldKind::Number { .. })
            && !matches!(self.position.bits, 8 | 16 | 32 | 64)
    }

    /// Returns whether a `const fn` can read the field in the minimum supported Rust version of the runtime.
    pub(super) fn is_const(&self) -> bool {
        self.kind != FieldKind::Real
    }

    /// Returns an expression that reads the field. `data` is a reference to a byte array.
    pub(super) fn read(&self, data: &str) -> Doc {
        let FieldPosition { byte, bit, bits } = self.position;
        let bytes = || call!("rt::profinet::be::bytes", data, byte);
        let from_bytes = |ty: &str| call!(seq![ty, "::from_be_bytes"], bytes());
        let at = || seq![data, "[", byte, "]"];
        let cut = |name: &str| call!(seq!["rt::profinet::be::", name], data, byte, bit, bits);
        if let Some(enumeration) = self.enumeration {
            // The type of the enumeration can have a different number of bits than the field.
            let is_whole = enumeration.native == native(self.is_signed(), bits);
            let raw = match self.kind {
                FieldKind::Native { signed: false } if bits == 8 && is_whole => at(),
                FieldKind::Native { .. } if bits > 8 && is_whole => from_bytes(enumeration.native),
                _ => cut(&format!("bits_{}", enumeration.native)),
            };
            return call!(seq![enumeration.path, "::from_raw"], raw);
        }
        match self.kind {
            FieldKind::Bit => seq![at(), format_args!(" & {} != 0", hex8(1 << bit))],
            FieldKind::Flag => seq![at(), " != 0"],
            FieldKind::Native { signed: false } if bits == 8 => at(),
            FieldKind::Native { .. } if bits == 8 => seq![at(), " as i8"],
            FieldKind::Native { .. } | FieldKind::Real => from_bytes(&self.rust_type()),
            FieldKind::Number { signed } if self.usage == Use::Image => {
                call!(seq!["rt::", if signed { "Int" } else { "Uint" }, "::from_raw"], cut("number"))
            }
            FieldKind::Number { .. } => cut(&format!("bits_{}", self.native())),
            FieldKind::Time(name) => call!(seq!["rt::profinet::be::", name], data, byte),
            FieldKind::Bytes => bytes(),
        }
    }

    /// Returns a statement that writes `value` to a byte array. `data` is the name of the array, and `reference` is a
    /// mutable reference to it.
    pub(super) fn write(&self, data: &str, reference: &str, value: &str) -> Doc {
        let FieldPosition { byte, bit, bits } = self.position;
        let number = native(self.is_signed(), bits);
        let raw = match self.enumeration {
            Some(other) if other.native != number && matches!(self.kind, FieldKind::Native { .. }) => match number {
                "u8" => format!("{value}.raw() as u8"),
                _ => format!("({value}.raw() as {number})"),
            },
            Some(_) => format!("{value}.raw()"),
            None => value.to_owned(),
        };
        let at = || seq![data, "[", byte, "] = "];
        let put = |bytes: Doc| seq![call!("rt::profinet::be::put", reference, byte, bytes), ";"];
        match self.kind {
            FieldKind::Bit => seq![call!("rt::profinet::be::put_bit", reference, byte, bit, value), ";"],
            FieldKind::Native { signed: false } if bits == 8 => seq![at(), raw, ";"],
            FieldKind::Flag => seq![at(), value, " as u8;"],
            FieldKind::Native { .. } if bits == 8 => seq![at(), raw, " as u8;"],
            FieldKind::Native { .. } | FieldKind::Real => put(seq!["&", raw, ".to_be_bytes()"]),
            FieldKind::Number { .. } => {
                let number = match (self.usage, self.enumeration, self.native()) {
                    (Use::Image, None, _) => format!("{value}.raw()"),
                    (_, _, "u64") => raw,
                    _ => format!("{raw} as u64"),
                };
                seq![call!("rt::profinet::be::put_number", reference, byte, bit, bits, number), ";"]
            }
            FieldKind::Time(name) => put(call!(seq!["&rt::profinet::be::from_", name], value)),
            FieldKind::Bytes => put(seq!["&", value]),
        }
    }
}

/// Returns the interpretation of a field with the basic type `base`. Returns `None` if the field is neither a sequence
/// of whole bytes nor an integer within one word.
fn kind(base: Type, position: FieldPosition) -> Option<FieldKind> {
    let FieldPosition { bit, bits, .. } = position;
    let is_bytes = position.is_bytes();
    let fits = is_bytes && base.bits() == Some(bits);
    let signed = matches!(base, Type::Integer(_));
    let integer = match bits {
        8 | 16 | 32 | 64 if is_bytes => Some(FieldKind::Native { signed }),
        _ if bit + bits <= WORD => Some(FieldKind::Number { signed }),
        _ => None,
    };
    let bytes = is_bytes.then_some(FieldKind::Bytes);
    match base {
        Type::Boolean if bits == 1 => Some(FieldKind::Bit),
        Type::Boolean if is_bytes && bits == 8 => Some(FieldKind::Flag),
        Type::Real32 | Type::Real64 if fits => Some(FieldKind::Real),
        Type::TimeOfDay if fits => Some(FieldKind::Time("time_of_day")),
        Type::TimeDifference if fits => Some(FieldKind::Time("time_difference")),
        Type::Boolean | Type::Integer(_) | Type::Unsigned(_) => integer.or(bytes),
        Type::Time(TimeFormat::TimeOfDay | TimeFormat::TimeDifference) if fits => integer,
        _ => bytes.or(integer),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn position(offset: u32, bits: u32) -> FieldPosition {
        FieldPosition::within(100, offset, bits).unwrap()
    }

    #[test]
    fn positions_in_words() {
        assert_eq!(position(16, 8).words(), "byte 2");
        assert_eq!(position(16, 16).words(), "bytes 2 and 3");
        assert_eq!(position(16, 32).words(), "bytes 2 to 5");
        assert_eq!(position(19, 1).words(), "bit 3 of byte 2");
        assert_eq!(position(19, 3).words(), "bits 3 to 5 of byte 2");
        assert_eq!(position(14, 4).words(), "bits 6 to 9 of the big-endian number in bytes 1 and 2");
    }

    #[test]
    fn fields_lie_within_their_bytes() {
        assert!(FieldPosition::within(2, 8, 8).is_some() && FieldPosition::within(2, 9, 8).is_none());
        assert!(FieldPosition::within(2, 0, 0).is_none());
        assert!(
            FieldPosition::within(u32::MAX, u32::MAX, 64).is_some()
                && FieldPosition::within(u32::MAX, 9, u32::MAX).is_none()
        );
    }

    #[test]
    fn kinds() {
        assert_eq!(kind(Type::Unsigned(16), position(8, 16)), Some(FieldKind::Native { signed: false }));
        assert_eq!(kind(Type::Integer(24), position(8, 24)), Some(FieldKind::Number { signed: true }));
        assert_eq!(kind(Type::Unsigned(16), position(9, 16)), Some(FieldKind::Number { signed: false }));
        assert_eq!(kind(Type::Unsigned(64), position(9, 64)), None, "the field is longer than a word");
        assert_eq!(kind(Type::Boolean, position(8, 8)), Some(FieldKind::Flag));
        assert_eq!(kind(Type::Opaque(None), position(8, 80)), Some(FieldKind::Bytes));
        assert_eq!(kind(Type::Opaque(None), position(9, 3)), Some(FieldKind::Number { signed: false }));
        assert_eq!(kind(Type::Real32, position(0, 16)), Some(FieldKind::Bytes), "a number of the wrong length");
    }
}
