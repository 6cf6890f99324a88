//! The data types of a dictionary: the device's types with their names, and additional types for its objects.
//!
//! The file must define all types that it uses, including basic types. The schema of ETG.2000 checks that each type
//! name refers to a definition. The data type of an object with sub-indices has a sub-item for each sub-index or array
//! of sub-indices. The sub-items contain the access rights.

use std::collections::HashMap;

use compact_str::{format_compact, CompactString};

use super::record::{self, FieldFacts};
use crate::note::{NoteKind, Notes, Subject};
use lexibus_codegen::etg::type_name::{self, Basic, Spelling};
use lexibus_codegen::ir::{Field, Shape, Type, TypeDef, TypeId};
use lexibus_codegen::unique::Unique;

/// The data types of a dictionary during its export.
pub(super) struct Types<'a> {
    pub(super) defs: &'a [TypeDef],
    /// Unique names of the declared types.
    names: Vec<CompactString>,
    used_names: Unique,
    /// Names of basic types that the file defines.
    basic: HashMap<Type, CompactString>,
    /// Additional types, written after those of the device.
    pub(super) added: Vec<AddedType>,
    /// For each declared record that is the type of an object, the properties of its fields.
    pub(super) uses: HashMap<u32, Vec<FieldFacts>>,
    /// Declared records, keyed by the sub-indices and types of their entries.
    pub(super) records: HashMap<Vec<(u8, Type)>, Vec<u32>>,
    /// True if the source is an ESI. The export then keeps the types of PDO entries.
    pub(super) is_esi: bool,
}

/// Returns `name`, with a number appended if it is already used.
pub(super) fn unique(names: &mut Unique, name: &str) -> CompactString {
    names.unique(name, |number| format_compact!("{name} ({number})"))
}

/// A data type that the device does not define: a basic type, an array or a record.
#[derive(Default)]
pub(super) struct AddedType {
    pub(super) name: CompactString,
    pub(super) bits: u32,
    /// Element type and number of elements of an array.
    pub(super) array: Option<(CompactString, u32)>,
    /// Sub-items of a record.
    pub(super) fields: Vec<SubItem>,
}

/// A sub-item of a record type.
pub(super) struct SubItem {
    pub(super) name: CompactString,
    pub(super) sub_index: Option<u16>,
    pub(super) ty: CompactString,
    pub(super) bits: u32,
    pub(super) offset: u32,
    pub(super) facts: Option<FieldFacts>,
}

impl<'a> Types<'a> {
    pub(super) fn new(defs: &'a [TypeDef], is_esi: bool, notes: &mut Notes) -> Self {
        let mut types = Types {
            defs,
            names: Vec::with_capacity(defs.len()),
            used_names: Unique::default(),
            basic: HashMap::new(),
            added: Vec::new(),
            uses: HashMap::new(),
            records: HashMap::new(),
            is_esi,
        };
        for def in defs {
            let name = types.unique(&def.name);
            notes.add_many(NoteKind::Renamed, name != def.name, Subject::Named(&def.name));
            if let Shape::Alias(ty) = def.shape {
                if is_self_named(def, &name) {
                    types.basic.entry(ty).or_insert_with(|| name.clone());
                }
            }
            types.names.push(name);
        }
        for (at, def) in (0u32..).zip(defs) {
            if let Shape::Record(fields) = &def.shape {
                let entries = record::expansion(&types, fields);
                let key = entries.iter().map(|entry| (entry.sub_index, entry.ty)).collect();
                types.records.entry(key).or_default().push(at);
            }
        }
        types
    }

    /// Returns a unique name for a type.
    pub(super) fn unique(&mut self, name: &str) -> CompactString {
        unique(&mut self.used_names, if name.is_empty() { "Type" } else { name })
    }

    /// Returns the name of the declared type at position `at`.
    pub(super) fn name_of(&self, at: u32) -> CompactString {
        self.names.get(at as usize).cloned().unwrap_or_default()
    }

    pub(super) fn def(&self, ty: Type) -> Option<&'a TypeDef> {
        let Type::Named(TypeId(at)) = ty else { return None };
        self.defs.get(at as usize)
    }

    /// Returns the fields of the declared record at position `at`, or an empty list if the declared type is not a record.
    pub(super) fn fields(&self, at: u32) -> &'a [Field] {
        match self.defs.get(at as usize).map(|def| &def.shape) {
            Some(Shape::Record(fields)) => fields,
            _ => &[],
        }
    }

    /// Returns the name under which other elements refer to a type, and its length in bits. Adds the definition of a
    /// basic type if it is missing.
    pub(super) fn reference(&mut self, ty: Type, notes: &mut Notes, subject: Subject<'_>) -> (CompactString, u32) {
        let bits = self.bits(ty);
        if bits.is_none() && !matches!(ty, Type::Opaque(_) | Type::Domain) {
            notes.add(NoteKind::UnknownLength, subject);
        }
        let bits = bits.unwrap_or(0);
        if let (Type::Named(id), Some(_)) = (ty, self.def(ty)) {
            return (self.name_of(id.0), bits);
        }
        if let Some(name) = self.basic.get(&ty) {
            return (name.clone(), bits);
        }
        let (written, is_known) = match ty {
            Type::Time(format) => (Type::OctetString(Some(format.bytes())), false),
            Type::Opaque(_) | Type::Named(_) => (Type::Domain, false),
            known => (known, true),
        };
        notes.add_many(NoteKind::UnknownType, !is_known, subject);
        if let Some(name) = self.basic.get(&written) {
            return (name.clone(), bits);
        }
        let name = self.unique(&basic_name(written));
        self.basic.insert(written, name.clone());
        self.added.push(AddedType { name: name.clone(), bits, ..AddedType::default() });
        (name, bits)
    }

    /// Returns the length of a type in bits if it is known.
    pub(super) fn bits(&self, ty: Type) -> Option<u32> {
        match ty {
            Type::Named(_) => self.def(ty)?.bits.or_else(|| self.underlying(ty).bits()),
            Type::VisibleString(length) | Type::OctetString(length) => length?.checked_mul(8),
            Type::UnicodeString(length) => length?.checked_mul(16),
            basic => basic.bits(),
        }
    }

    /// Returns the base type of an alias, enumeration, bit field or scaled type, and any other type unchanged.
    pub(super) fn underlying(&self, ty: Type) -> Type {
        match self.def(ty).map(|def| &def.shape) {
            Some(
                Shape::Enumeration { base, .. }
                | Shape::BitField { base, .. }
                | Shape::Scaled { base, .. }
                | Shape::Alias(base),
            ) => *base,
            _ => ty,
        }
    }

    /// Returns the element type of an array, the lower bound of its first dimension, and the number of elements in all
    /// dimensions.
    pub(super) fn elements(&self, ty: Type) -> Option<(Type, i32, u32)> {
        match &self.def(ty)?.shape {
            Shape::Array { element, dimensions } => {
                let count = dimensions.iter().fold(1u32, |count, &(_, elements)| count.saturating_mul(elements));
                Some((*element, dimensions.first().map_or(1, |&(lower, _)| lower), count))
            }
            _ => None,
        }
    }
}

/// Returns whether an alias needs no base type, because its name is the name of the aliased type or the aliased type is
/// unknown.
pub(super) fn is_self_named(def: &TypeDef, name: &str) -> bool {
    let Shape::Alias(ty) = def.shape else { return false };
    if let Type::Opaque(_) = ty {
        return type_name::basic(name).is_none();
    }
    match type_name::basic(name) {
        Some((Basic::Type(named), Spelling::Standard | Spelling::Alias)) => sized(named, def.bits) == ty,
        _ => false,
    }
}

/// Returns the basic type `ty`, with the declared size if there is one.
fn sized(ty: Type, bits: Option<u32>) -> Type {
    let Some(bits) = bits.filter(|&bits| bits > 0) else { return ty };
    let bytes = Some(bits / 8).filter(|_| bits % 8 == 0);
    match ty {
        Type::VisibleString(None) => Type::VisibleString(bytes),
        Type::OctetString(None) => Type::OctetString(bytes),
        Type::UnicodeString(None) => Type::UnicodeString(bytes.map(|bytes| bytes / 2)),
        Type::Integer(_) => u8::try_from(bits).map_or(ty, Type::Integer),
        Type::Unsigned(_) => u8::try_from(bits).map_or(ty, Type::Unsigned),
        _ => ty,
    }
}

/// Returns the ETG.1000.6 name of a basic type, or a name that readers interpret as this type.
pub(super) fn basic_name(ty: Type) -> CompactString {
    match ty {
        Type::Unsigned(bits @ (24 | 40 | 48 | 56)) => format_compact!("UINT{bits}"),
        Type::Unsigned(8 | 16 | 32 | 64) | Type::Integer(8 | 16 | 32 | 64) => type_name::name_of(ty).into(),
        Type::Integer(bits) => format_compact!("INT{bits}"),
        Type::Unsigned(bits) => format_compact!("BIT{bits}"),
        Type::VisibleString(Some(length)) => format_compact!("STRING({length})"),
        Type::OctetString(Some(length @ 1..)) => format_compact!("ARRAY [0..{}] OF BYTE", length - 1),
        Type::OctetString(Some(0)) => "OCTET_STRING(0)".into(),
        Type::UnicodeString(Some(length)) => format_compact!("UNICODE_STRING({length})"),
        Type::Domain | Type::Time(_) | Type::Opaque(_) | Type::Named(_) => "DOMAIN".into(),
        named => type_name::name_of(named).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_basic_types_are_read_as_these() {
        let octets = [Some(1), Some(9), Some(0), None].map(Type::OctetString);
        let widths = (1..=64).flat_map(|bits| [Type::Integer(bits), Type::Unsigned(bits)]);
        let others = [
            Type::Boolean,
            Type::Real32,
            Type::Real64,
            Type::VisibleString(Some(12)),
            Type::VisibleString(None),
            Type::UnicodeString(Some(3)),
            Type::UnicodeString(None),
            Type::TimeOfDay,
            Type::TimeDifference,
            Type::Domain,
        ];
        for ty in widths.chain(octets).chain(others) {
            let read = type_name::basic(&basic_name(ty)).map(|(basic, _)| basic);
            assert_eq!(read, Some(Basic::Type(ty)), "{}", basic_name(ty));
        }
    }
}
