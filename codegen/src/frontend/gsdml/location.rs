//! Bit offset, length, type and enumeration of a value in a record or diagnosis.

use super::data_type::DataType;
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Given;
use crate::ir::Type;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Bit offset, length and type of a value in a record or diagnosis.
pub(super) struct Location {
    pub data_type: Option<DataType>,
    pub ty: Type,
    pub bit_offset: u32,
    pub bits: u32,
}

impl Location {
    /// Returns the type of the raw value, without the scale of a named number type.
    pub fn number(&self) -> Type {
        match self.data_type {
            Some(DataType::Number(number)) => number.base,
            _ => self.ty,
        }
    }
}

impl<'a> Reader<'a, '_> {
    /// Returns the location that the attributes `DataType`, `ByteOffset`, `BitOffset`, `BitLength` and `Length`
    /// describe.
    pub fn location(&mut self, tag: &Tag<'a>, data_type: &Given<'a>, attributes: [&Given<'a>; 4]) -> Location {
        let [byte, bit, bits, length] = attributes;
        let byte = self.unsigned(byte, u32::MAX / 8 - 1, "byte offset").unwrap_or(0);
        let length = self.unsigned(length, u16::MAX.into(), "length");
        let data_type = self.data_type(tag, data_type);
        let mut bit_offset = byte * 8;
        if matches!(data_type, Some(DataType::Bit | DataType::BitArea)) {
            bit_offset += self.unsigned(bit, 7, "bit offset").unwrap_or(0);
        }
        let (ty, bits) = match data_type {
            Some(DataType::Bit) => (Type::Boolean, 1),
            Some(DataType::BitArea) => {
                let bits = self.unsigned(bits, 64, "number of bits").unwrap_or(1).max(1);
                (Type::Unsigned(u8::try_from(bits).unwrap_or(64)), bits)
            }
            Some(data_type) => {
                let (ty, bytes) = data_type.lower(length, &mut self.format.types);
                (ty, bytes * 8)
            }
            None => (Type::Opaque(None), length.unwrap_or(0) * 8),
        };
        Location { data_type, ty, bit_offset, bits }
    }

    /// Returns the data type that `given` names, ignoring case. Reports a name in the wrong case. Returns `None` and reports the
    /// name if it is missing or GSDML does not define it.
    pub fn data_type(&mut self, tag: &Tag<'a>, given: &Given<'a>) -> Option<DataType> {
        if !self.require(tag, given, "DataType", "kept as raw bytes") {
            return None;
        }
        let found = DataType::find(&given.text);
        if found.is_some() {
            return found;
        }
        let similar = DataType::find_in_any_case(&given.text);
        if let Some((name, _)) = similar {
            let message = format!("the data type `{}` has the wrong case", brief(&given.text));
            self.report(&codes::UNKNOWN_GSDML_TYPE, given.span, message, format!("read as `{name}`"));
        } else {
            let message = format!("`{}` is not a data type of GSDML", brief(&given.text));
            let diagnostic = codes::UNKNOWN_GSDML_TYPE.at(given.span, message);
            let diagnostic = diagnostic.label("kept as raw bytes of the declared length");
            let is_real = matches!(given.text.as_ref(), "Float" | "Real" | "REAL");
            let help = "write `Float32` for a 4-byte number";
            self.diagnostics.push(if is_real { diagnostic.help(help) } else { diagnostic });
        }
        similar.map(|(_, ty)| ty)
    }

    /// Returns the enumeration that the `ValueItem` called `target` defines for values of the type `ty`.
    pub fn named_values(&mut self, target: &Given<'a>, ty: Type) -> Option<Type> {
        if target.is_missing() {
            return None;
        }
        // A single bit with named values also becomes an enumeration.
        let base = if ty == Type::Boolean { Type::Unsigned(1) } else { ty };
        if matches!(base, Type::Integer(_) | Type::Unsigned(_)) {
            return Some(self.format.types.enumeration(target, base));
        }
        let message = "only integers can have named values";
        self.report(&codes::GSDML_VALUE, target.span, message, "kept, but has no effect");
        None
    }
}
