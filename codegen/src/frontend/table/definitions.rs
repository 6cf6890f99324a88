//! Units, enumerations and bit fields to which rows refer by name.

use compact_str::{format_compact, CompactString};

use super::at::{At, TextOr};
use super::by_name::ByName;
use super::format::{
    BitEntries, BitTable, BitsTable, Documented, Doubted, EnumTable, NumberOrText, UnitTable, ValueEntries, ValueTable,
};
use super::tree::Reader;
use super::words::ACCESSES;
use super::{conditions, lints, notation, types, value};
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::ir::owner::Owner;
use crate::ir::{BitFieldEntry, BitMeaning, Doubts, EnumValue, Mark, Shape, Trigger, Type, TypeDef, TypeId, Zone};
use crate::number::hex16;
use crate::source::Origin;
use crate::text::brief;

/// Kind of a named definition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum DefinitionKind {
    Enumeration,
    Bits,
}

/// Definitions in a table: enumerations, bit fields and units.
#[derive(Clone, Debug, Default)]
pub(super) struct Definitions {
    pub enums: ByName<EnumTable>,
    pub bits: ByName<BitsTable>,
    pub units: ByName<UnitTable>,
    /// Types that were created so far.
    pub types: Vec<TypeDef>,
    /// Types that were created for each definition, one for each underlying integer type.
    pub made: HashMap<(DefinitionKind, String), Vec<(Type, TypeId)>>,
}

/// Name, documentation, ambiguities and origin of a definition.
pub(super) struct About<'t> {
    name: CompactString,
    doc: Option<&'t str>,
    cite: Option<String>,
    doubts: Doubts,
    origin: Origin,
}

impl About<'_> {
    /// Describes a definition that is inside of a row or bit, and has only a name.
    pub fn inline(name: CompactString, origin: Origin) -> Self {
        About { name, doc: None, cite: None, doubts: Doubts::new(), origin }
    }
}

impl Definitions {
    /// Returns the type of a named definition with the underlying integer type `base`. Returns `None` and reports the name if
    /// it has no definition.
    pub fn named(
        &mut self,
        reader: &mut Reader<'_, '_>,
        kind: DefinitionKind,
        name: &At<String>,
        base: Type,
    ) -> Option<Type> {
        let key = (kind, name.value.clone());
        let made = self.made.get(&key).and_then(|made| made.iter().find(|(type_base, _)| *type_base == base));
        if let Some(&(_, id)) = made {
            return Some(Type::Named(id));
        }
        // The name of the type has a suffix only if the definition declares a base other than `base`.
        let suffix = match self.base(reader, kind, &name.value) {
            Some(default_base) if default_base != base => base.integer_suffix(),
            _ => String::new(),
        };
        let id = match kind {
            DefinitionKind::Enumeration => {
                let Some((found_name, table)) = self.enums.get(&name.value).cloned() else {
                    let known = self.enums.names().map(|known_name| known_name.value.as_str());
                    reader.unresolved("enumeration", &name.value, reader.span(name), known);
                    return None;
                };
                let about = about(reader, &found_name, &suffix, &table);
                self.enumeration(reader, about, base, table.closed, &table.values)
            }
            DefinitionKind::Bits => {
                let Some((found_name, table)) = self.bits.get(&name.value).cloned() else {
                    let known = self.bits.names().map(|known_name| known_name.value.as_str());
                    reader.unresolved("bit field", &name.value, reader.span(name), known);
                    return None;
                };
                let about = about(reader, &found_name, &suffix, &table);
                self.bit_field(reader, about, base, &table.at, table.address)
            }
        };
        self.made.entry(key).or_default().push((base, id));
        Some(Type::Named(id))
    }

    /// Returns the integer type that a definition declares as its base.
    pub fn base(&self, reader: &mut Reader<'_, '_>, kind: DefinitionKind, name: &str) -> Option<Type> {
        let base = match kind {
            DefinitionKind::Enumeration => self.enums.get(name).and_then(|(_, table)| table.base.as_ref()),
            DefinitionKind::Bits => self.bits.get(name).and_then(|(_, table)| table.base.as_ref()),
        }?;
        integer(reader, base)
    }

    /// Returns the type on which an alias, a bit field, an enumeration or a scaled type is based. Returns any other
    /// type unchanged.
    pub fn underlying(&self, ty: Type) -> Type {
        Owner::of_types(&self.types).basic(ty)
    }

    /// Returns the length of a basic or named type in bits, or `None` if the length varies or is unknown.
    pub fn bits_of(&self, ty: Type) -> Option<u32> {
        Owner::of_types(&self.types).fixed_bits(ty)
    }

    /// Creates types for unused definitions, so that the compiler reports errors in these definitions, and the output
    /// contains their types.
    pub fn make_unused(&mut self, reader: &mut Reader<'_, '_>) {
        let enums = self.enums.names().map(|name| (DefinitionKind::Enumeration, name.clone()));
        let all: Vec<_> = enums.chain(self.bits.names().map(|name| (DefinitionKind::Bits, name.clone()))).collect();
        for (kind, name) in all {
            // The type may already exist, because another definition refers to it.
            if !self.made.contains_key(&(kind, name.value.clone())) {
                let base = self.base(reader, kind, &name.value).unwrap_or(Type::Unsigned(16));
                self.named(reader, kind, &name, base);
            }
        }
    }

    fn push(&mut self, reader: &Reader<'_, '_>, about: About<'_>, base: Type, shape: Shape) -> TypeId {
        let id = TypeId(self.types.len() as u32);
        self.types.push(TypeDef {
            documentation: reader.documentation(about.doc, about.cite),
            doubts: about.doubts,
            origin: about.origin,
            ..TypeDef::new(about.name, shape, base.bits())
        });
        id
    }

    /// Creates an enumeration with the integer type `base`, and reports invalid values.
    pub fn enumeration(
        &mut self,
        reader: &mut Reader<'_, '_>,
        mut about: About<'_>,
        base: Type,
        closed: bool,
        entries: &ValueEntries,
    ) -> TypeId {
        let mut values = Vec::with_capacity(entries.0.len());
        for (key, entry) in entries.iter() {
            let is_pattern = reader.is_pattern(key);
            let range = notation::range(&key.value).filter(|(first, last)| first <= last);
            let range = range.map(|(first, last)| [first, last].map(|number| value::integer(number, base, is_pattern)));
            let Some([first, last]) = range.filter(|[first, last]| first <= last) else {
                let message = format!("`{}` is not a value", brief(&key.value));
                let help = "write a value such as `3`, `0x10` or `-1`, or a range such as `\"3..7\"`";
                reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
                continue;
            };
            lints::key(reader, key, base);
            let text = ValueTable::default();
            let (name, more) = match &entry.value {
                TextOr::Text(name) => (Some(name.as_str()), &text),
                TextOr::Table(table) => (table.name.as_deref(), &**table),
            };
            let zones = [("reserved", Zone::Reserved), ("vendor", Zone::Vendor)];
            let zone = more.zone.as_ref().and_then(|zone| reader.word(zone, "zone", &zones));
            about.doubts.extend(reader.doubts_of_part(more, key));
            unfilled(reader, key, name);
            let name = name.filter(|name| !nameless(reader, name, key, &about.name, "value"));
            let unnamed = || zone.map_or_else(|| format_compact!("value {first}"), |zone| zone_name(zone).into());
            let (versions, replaced_by) = ([&more.since, &more.until], more.replaced_by.as_deref());
            values.push(EnumValue {
                name: name.map_or_else(unnamed, CompactString::from),
                value: first,
                last: (last > first).then_some(last),
                zone,
                names: reader.original(more.orig.as_deref()),
                when: conditions::condition(reader, more.when.as_ref()),
                availability: conditions::availability(
                    reader,
                    &more.models,
                    versions,
                    replaced_by,
                    more.buses.as_ref(),
                ),
                documentation: reader.documentation_of(more),
                at: Mark(reader.span(key)),
            });
        }
        self.push(reader, about, base, Shape::Enumeration { base, values, closed })
    }

    /// Creates a bit field with the integer type `base`, and reports invalid bits.
    pub fn bit_field(
        &mut self,
        reader: &mut Reader<'_, '_>,
        mut about: About<'_>,
        base: Type,
        entries: &BitEntries,
        address: Option<u32>,
    ) -> TypeId {
        let mut fields = Vec::new();
        for (key, meanings) in entries.iter() {
            let Some((offset, bits)) = bits_of_key(reader, key, base, address) else { continue };
            for meaning in &meanings.value.0 {
                let plain = BitTable::default();
                let (name, table) = match meaning {
                    TextOr::Text(name) => (Some(name.as_str()), &plain),
                    TextOr::Table(table) => (table.name.as_deref(), &**table),
                };
                about.doubts.extend(reader.doubts_of_part(table, key));
                if name.is_some_and(|name| name.contains("{n")) && bits > 1 {
                    for number in 0..bits {
                        let name = name.map(|name| notation::filled(name, number.into(), None));
                        let position = (offset.saturating_add(number), 1);
                        fields.push(self.field(reader, &about.name, key, position, name.as_deref(), table));
                    }
                    continue;
                }
                fields.push(self.field(reader, &about.name, key, (offset, bits), name, table));
            }
        }
        fields.sort_by_key(|field| field.offset);
        self.push(reader, about, base, Shape::BitField { base, fields })
    }

    fn field(
        &mut self,
        reader: &mut Reader<'_, '_>,
        owner: &str,
        key: &At<String>,
        position: (u8, u8),
        name: Option<&str>,
        table: &BitTable,
    ) -> BitFieldEntry {
        let (offset, bits) = position;
        unfilled(reader, key, name);
        let name = name.filter(|name| table.reserved.is_some() || !nameless(reader, name, key, owner, "bit"));
        let is_named = name.is_some();
        let name = name.map_or_else(|| format_compact!("bit {}", key.value), CompactString::from);
        let meaning = self.meaning(reader, owner, &name, key, bits, table);
        let triggers = [
            ("rising", Trigger::Rising),
            ("falling", Trigger::Falling),
            ("toggle", Trigger::Toggle),
            ("self_clearing", Trigger::SelfClearing),
        ];
        let (versions, replaced_by) = ([&table.since, &table.until], table.replaced_by.as_deref());
        BitFieldEntry {
            name: if matches!(meaning, BitMeaning::Reserved { .. }) && !is_named {
                CompactString::default()
            } else {
                name
            },
            names: reader.original(table.orig.as_deref()),
            offset,
            bits,
            meaning,
            when: conditions::condition(reader, table.when.as_ref()),
            trigger: table.trigger.as_ref().and_then(|trigger| reader.word(trigger, "trigger", &triggers)),
            access: table.access.as_ref().and_then(|access| reader.word(access, "access right", &ACCESSES)),
            availability: conditions::availability(reader, &table.models, versions, replaced_by, None),
            documentation: reader.documentation_of(table),
            at: Mark(reader.span(key)),
        }
    }

    fn meaning(
        &mut self,
        reader: &mut Reader<'_, '_>,
        owner: &str,
        name: &str,
        key: &At<String>,
        bits: u8,
        table: &BitTable,
    ) -> BitMeaning {
        if let Some(reserved) = &table.reserved {
            let write = match reserved {
                NumberOrText::Number(0) => Some(false),
                NumberOrText::Number(1) => Some(true),
                NumberOrText::Text(text) if text == "keep" => None,
                _ => {
                    let message = "`reserved` must be 0, 1 or \"keep\"";
                    reader.report(&codes::TABLE_VALUE, reader.span(key), message);
                    None
                }
            };
            return BitMeaning::Reserved { write };
        }
        let base = Type::Unsigned(bits);
        if let Some(named) = &table.enumeration {
            return match self.named(reader, DefinitionKind::Enumeration, named, base) {
                Some(Type::Named(id)) => BitMeaning::Enumeration(id),
                _ => BitMeaning::Number,
            };
        }
        if let Some(values) = &table.values {
            let about = About::inline(format_compact!("{owner} {name}"), reader.origin(key));
            return BitMeaning::Enumeration(self.enumeration(reader, about, base, false, values));
        }
        match bits {
            1 if !table.number => BitMeaning::Flag { inverted: table.inverted },
            _ => BitMeaning::Number,
        }
    }
}

/// Returns the name with `suffix`, the documentation, the ambiguities and the origin of a named definition.
fn about<'t, T: Documented + Doubted>(
    reader: &mut Reader<'_, '_>,
    name: &At<String>,
    suffix: &str,
    table: &'t T,
) -> About<'t> {
    let origin = reader.origin(name);
    let doubts = reader.doubts_of(table, origin);
    About { name: format_compact!("{}{suffix}", name.value), doc: table.doc(), cite: table.cited(), doubts, origin }
}

/// Returns the first bit and the number of bits that a key names. The key `0x221:3-2` names the bits 3 and 2 of the byte at the
/// address 0x221. `first` is the address of the first byte. Returns `None` and reports the key if it is invalid.
fn bits_of_key(reader: &mut Reader<'_, '_>, key: &At<String>, base: Type, first: Option<u32>) -> Option<(u8, u8)> {
    let Some((byte, bits)) = key.value.split_once(':') else {
        let found = notation::bits(&key.value);
        if found.is_none() {
            let message = format!("`{}` is neither a bit number nor a range of bits", brief(&key.value));
            let help = "write a bit such as `7`, or a range such as `\"3-2\"`";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
        }
        return found;
    };
    let byte = notation::integer(byte);
    let bits = notation::bits(bits).filter(|(offset, bits)| offset + bits <= 8);
    let (Some(byte), Some((offset, bits))) = (byte, bits) else {
        let message = format!("`{}` is neither a bit nor a range of bits in a byte", brief(&key.value));
        let help = "write a bit such as `\"0x221:3\"`, or a range such as `\"0x221:3-2\"`";
        reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
        return None;
    };
    let Some(first) = first else {
        let message =
            format!("`{}` names a bit by its byte address, but the bit field has no `address`", brief(&key.value));
        let help = "add `address`, the address of the first byte";
        reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
        return None;
    };
    let bytes = base.bits().unwrap_or(0).div_ceil(8);
    let number = byte.checked_sub(first.into()).and_then(|number| u8::try_from(number).ok());
    let number = number.filter(|&number| u32::from(number) < bytes);
    if number.is_none() {
        let message = format!("the byte at {} is outside of the {base} at {}", hex16(byte), hex16(first));
        reader.diagnostics.push(codes::BIT_OUTSIDE_TYPE.at(reader.span(key), message).label("left out"));
    }
    // The result fits `u8` because an integer has at most 64 bits.
    Some((number?.saturating_mul(8).saturating_add(offset), bits))
}

/// Returns whether the name of a value or bit is empty. Reports an empty name.
fn nameless(reader: &mut Reader<'_, '_>, name: &str, key: &At<String>, owner: &str, what: &str) -> bool {
    let is_empty = name.trim().is_empty();
    if is_empty {
        let message = format!("{what} {} of `{}` has an empty name", brief(&key.value), brief(owner));
        let found = codes::EMPTY_NAME.at(reader.span(key), message);
        let help =
            format!("write a name, mark the {what} as reserved, or delete the {what} if the manual does not have it");
        reader.diagnostics.push(found.label(format!("named `{what} {}`", brief(&key.value))).help(help));
    }
    is_empty
}

fn zone_name(zone: Zone) -> &'static str {
    match zone {
        Zone::Reserved => "reserved",
        Zone::Vendor => "vendor",
    }
}

/// Reports a name with a placeholder such as `{n}` for which there is no value.
pub(super) fn unfilled(reader: &mut Reader<'_, '_>, key: &At<String>, name: Option<&str>) {
    if let Some(name) = name.filter(|name| name.contains('{')) {
        let message = format!("the placeholder in the name `{}` has no value", brief(name));
        let found = codes::TABLE_VALUE.at(reader.span(key), message);
        reader.diagnostics.push(found.help("use `{n}` with several bits or a `count`, and `{sub}` with objects"));
    }
}

/// Returns the integer type called `name`. Returns `None` and reports the name if it is not an integer type.
pub(super) fn integer(reader: &mut Reader<'_, '_>, name: &At<String>) -> Option<Type> {
    let integer = types::single(&name.value).filter(|ty| matches!(ty, Type::Unsigned(_) | Type::Integer(_)));
    if integer.is_none() {
        let message = format!("`{}` is not an integer type such as `u16`", brief(&name.value));
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
    }
    integer
}
