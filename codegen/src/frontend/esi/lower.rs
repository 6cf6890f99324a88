//! Converts the dictionary and the PDOs of a device or module to types, groups and process data of the IR.

use super::description::{EntryType, OtherFiles, Target};
use super::dictionary::Dictionary;
use super::items;
use super::pdos::Pdos;
use super::reader::Reader;
use super::types::Types;
use crate::diagnostics::{codes, Diagnostics};
use crate::etg::type_name;
use crate::frontend::xml::Given;
use crate::ir::{Group, PdoEntry, PdoEntryKind, ProcessData, Type, TypeDef};

/// Converts the data types, objects and PDOs of a device or module. The type of a PDO entry
/// can be one of these data types.
///
/// PDO entries whose type may be in a file of `other_files` are resolved later.
pub(super) fn lower<'a>(
    reader: &mut Reader<'_, '_>,
    dictionary: Dictionary<'a>,
    pdos: Pdos<'a>,
    data: &mut ProcessData,
    other_files: &mut OtherFiles,
) -> (Vec<TypeDef>, Vec<Group>) {
    let Dictionary { types: mut raw, objects, mut subs, units, .. } = dictionary;
    let values = raw.iter_mut().map(|ty| std::mem::take(&mut ty.values)).collect();
    let mut types = Types::new(reader, &raw, values);
    let has_files = other_files.files.iter().any(|file| file.target == Target::Dictionary);
    pdos.finish(data, |given, entry| {
        if has_files && entry.kind != PdoEntryKind::Padding && !given.is_empty() && !types.knows(&given.text) {
            other_files.types.push(EntryType::new(entry, given));
            return Type::Opaque(None);
        }
        entry_type(reader, &mut types, given, entry)
    });
    let groups = items::build(reader, &mut types, raw, objects, &mut subs, &units);
    (types.into_defs(), groups)
}

/// Returns the type that a PDO entry names. If the entry names no type, returns an unsigned integer type of the entry's length, or
/// raw bytes if the entry is padding or does not have 1 to 64 bits.
fn entry_type(reader: &mut Reader<'_, '_>, types: &mut Types<'_>, given: &Given<'_>, entry: &PdoEntry) -> Type {
    if given.is_empty() {
        return match u8::try_from(entry.bits) {
            Ok(bits @ 1..=64) if entry.kind != PdoEntryKind::Padding => Type::Unsigned(bits),
            _ => Type::Opaque(None),
        };
    }
    // The type name of a padding entry has no effect unless it is the name of a basic type.
    if entry.kind == PdoEntryKind::Padding && type_name::basic(&given.text).is_none() {
        return Type::Opaque(None);
    }
    let ty = types.resolve(reader, given);
    check_length(reader.diagnostics, entry, given, types.bits(ty));
    ty
}

/// Reports a PDO entry, except padding, whose length differs from the length of its type. `bits` is the length of the
/// type.
pub(super) fn check_length(diagnostics: &mut Diagnostics, entry: &PdoEntry, ty: &Given<'_>, bits: Option<u32>) {
    match bits {
        Some(bits)
            if bits != entry.bits && entry.kind != PdoEntryKind::Padding && diagnostics.wants(&codes::ENTRY_LENGTH) =>
        {
            let message = format!("the PDO entry has {} bits, but {} has {bits}", entry.bits, ty.text);
            diagnostics.push(codes::ENTRY_LENGTH.at(ty.span, message).label("BitLen is used for the layout"));
        }
        _ => {}
    }
}
