//! Data types of the application process, before conversion.

use super::reader::{Reader, Texts};
use crate::frontend::xml::{Given, Read};
use crate::ir::{CompactString, EnumValue, Type};
use crate::source::{Origin, Span};
use crate::syntax::xml::Tag;

/// Type of a parameter, array element or structure field.
#[derive(Clone, Debug)]
pub(super) enum TypeRef<'a> {
    /// Basic type, such as `<UDINT/>`.
    Basic(Type, Span),
    /// Reference to a data type, such as `<dataTypeIDRef uniqueIDRef="…"/>`.
    Named(Given<'a>),
}

impl<'a> TypeRef<'a> {
    /// Reads an element that names a type. Returns `None` for any other element.
    pub fn read(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Option<Self>> {
        if let Some(ty) = basic(tag.name) {
            return Ok(Some(TypeRef::Basic(ty, tag.span)));
        }
        if tag.name != "dataTypeIDRef" {
            return Ok(None);
        }
        let given = reader.attribute(tag, "uniqueIDRef")?;
        Ok((!given.is_missing()).then_some(TypeRef::Named(given)))
    }

    pub fn span(&self) -> Span {
        match self {
            TypeRef::Basic(_, span) => *span,
            TypeRef::Named(given) => given.span,
        }
    }
}

/// Data type as written in the file.
pub(super) struct RawType<'a> {
    pub name: CompactString,
    pub texts: Texts<'a>,
    pub kind: DataTypeKind<'a>,
    pub origin: Origin,
}

/// Kind of a data type, with its parts: an array, a structure, an enumeration, or a type derived from another type.
pub(super) enum DataTypeKind<'a> {
    Array {
        dimensions: Vec<(i32, u32)>,
        element: Option<TypeRef<'a>>,
    },
    /// Positions of the structure's variables in the list of parameters.
    Struct(Vec<usize>),
    Enum {
        base: Option<TypeRef<'a>>,
        values: Vec<EnumValue>,
    },
    Derived {
        base: Option<TypeRef<'a>>,
        count: Option<u32>,
    },
}

/// Returns the CiA 301 type of a basic type of IEC 61131-3, as mapped by CiA 311.
fn basic(name: &str) -> Option<Type> {
    Some(match name {
        "BOOL" => Type::Boolean,
        "SINT" => Type::Integer(8),
        "INT" => Type::Integer(16),
        "DINT" => Type::Integer(32),
        "LINT" => Type::Integer(64),
        "USINT" | "BYTE" | "CHAR" => Type::Unsigned(8),
        "UINT" | "WORD" => Type::Unsigned(16),
        "UDINT" | "DWORD" => Type::Unsigned(32),
        "ULINT" | "LWORD" => Type::Unsigned(64),
        "REAL" => Type::Real32,
        "LREAL" => Type::Real64,
        "STRING" => Type::VisibleString(None),
        "WSTRING" => Type::UnicodeString(None),
        "BITSTRING" => Type::OctetString(None),
        _ => return None,
    })
}

/// Returns an enumeration value whose name and documentation come from `texts`.
pub(super) fn enum_value(value: i128, texts: &Texts<'_>) -> EnumValue {
    let name = texts.labels.name();
    let (names, documentation) = (texts.labels.except(&name), texts.documentation());
    EnumValue { names, documentation, ..EnumValue::new(name, value) }
}
