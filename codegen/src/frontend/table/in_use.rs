//! Finds items with the same name, the same address, overlapping registers, or overlapping bits of a register.

use std::collections::hash_map::Entry;
use std::collections::BTreeMap;

use compact_str::{format_compact, CompactString};

use super::tree::Reader;
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::firmware::apart;
use crate::ir::{Availability, Binding, Buses, Item, ObjectBuses, RegisterBinding, RegisterSpace};
use crate::number::{self, written_object};
use crate::source::Span;
use crate::text::{brief, numbered};

/// Names and addresses that are in use, with the spans of their items.
#[derive(Default)]
pub(super) struct InUse {
    /// Chapter numbers, by title.
    chapters: HashMap<CompactString, usize>,
    /// Spans of item names, by chapter and name.
    names: HashMap<(usize, CompactString), Span>,
    addresses: HashMap<CompactString, Vec<Holder>>,
    /// Register ranges of items, by Modbus table and first wire address.
    registers: BTreeMap<(&'static str, u32), RegisterRange>,
    /// Items that occupy only some bits of a register, by register address.
    parts: HashMap<CompactString, Vec<Part>>,
}

/// Item that uses an address.
struct Holder {
    span: Span,
    name: CompactString,
    /// Name of the item that accesses the same value at another address.
    same_as: Option<CompactString>,
    availability: Option<Box<Availability>>,
    buses: Option<ObjectBuses>,
}

impl Holder {
    /// Returns whether both items may share an address: no device has both of them on one bus, or both access the same value.
    fn is_apart(&self, other: &Holder) -> bool {
        let is_same = |one: &Holder, other: &Holder| one.same_as.as_ref() == Some(&other.name);
        if is_same(self, other) || is_same(other, self) {
            return true;
        }
        let by_bus =
            self.buses.zip(other.buses).is_some_and(|(one, other)| Buses::from(one).and(other.into()).is_empty());
        by_bus || apart(self.availability.as_deref(), other.availability.as_deref())
    }
}

/// Registers that an item occupies.
struct RegisterRange {
    last: u32,
    name: CompactString,
    span: Span,
    availability: Option<Box<Availability>>,
}

/// First bit and number of bits.
type Bits = (u8, u8);

struct Part {
    bits: Bits,
    name: CompactString,
    span: Span,
    availability: Option<Box<Availability>>,
}

impl InUse {
    /// Adds the name and the addresses of a register's item. `part` is set if the item occupies only some bits of the register. A
    /// name must be unique in its chapter.
    pub fn register(&mut self, reader: &mut Reader<'_, '_>, chapter: &CompactString, item: &Item, part: Option<Bits>) {
        let next = self.chapters.len();
        let chapter = match self.chapters.get(chapter) {
            Some(&number) => number,
            None => *self.chapters.entry(chapter.clone()).or_insert(next),
        };
        match self.names.entry((chapter, item.name.clone())) {
            Entry::Vacant(free) => {
                free.insert(item.at.name);
            }
            Entry::Occupied(first) => {
                let help = "write a `title` in each chapter: names must then be unique only within a chapter";
                twice(reader, &format!("the name `{}`", brief(&item.name)), item, *first.get(), Some(help));
            }
        }
        match part {
            Some(bits) => self.part(reader, item, bits),
            None => self.addresses(reader, item),
        }
    }

    /// Adds the addresses of an item. Two items may share an address only if no device has both of them on one bus, or
    /// if both access the same value.
    pub fn addresses(&mut self, reader: &mut Reader<'_, '_>, item: &Item) {
        for binding in &item.bindings {
            let Some(address) = address(binding) else { continue };
            let buses = match binding {
                Binding::Object { buses, .. } => Some(*buses),
                _ => None,
            };
            let same_as =
                item.related.as_ref().and_then(|related| related.same_as.as_ref()).map(|name| name.name.clone());
            let (span, name) = (item.at.name, item.name.clone());
            let holder = Holder { span, name, same_as, availability: item.availability.clone(), buses };
            let holders = self.addresses.entry(address.clone()).or_default();
            if let Some(first) = holders.iter().find(|other| !other.is_apart(&holder)) {
                twice(reader, &address, item, first.span, None);
                continue;
            }
            let is_first = holders.is_empty();
            holders.push(holder);
            if let (Binding::Register(register), true) = (binding, is_first) {
                self.register_range(reader, item, register);
            }
        }
    }

    /// Adds the registers of an item. Reports registers that overlap those of another item.
    fn register_range(&mut self, reader: &mut Reader<'_, '_>, item: &Item, register: &RegisterBinding) {
        let (space, first) = (space_name(register.space), u32::from(register.address));
        let last = u32::from(register.last());
        let before = self.registers.range((space, 0)..(space, first)).next_back();
        let before = before.filter(|(_, other)| other.last >= first);
        let other = before.or_else(|| self.registers.range((space, first)..=(space, last)).next());
        let other = other.filter(|(_, other)| !apart(other.availability.as_deref(), item.availability.as_deref()));
        if let Some(((_, start), other)) = other {
            let (name, other_name) = (brief(&item.name), brief(&other.name));
            let range = |first, last| numbered(space, &[numbers(first, last)]);
            let (registers, other_registers) = (range(first, last), range(*start, other.last));
            let message = format!("`{name}` ({registers}) overlaps `{other_name}` ({other_registers})");
            let found = codes::SHARED_REGISTERS.at(item.at.name, message).note_at(other.span, "the other item");
            reader.diagnostics.push(found.help("correct the register number of one item, or use a shorter type"));
        }
        let availability = item.availability.clone();
        let range = RegisterRange { last, name: item.name.clone(), span: item.at.name, availability };
        self.registers.insert((space, first), range);
    }

    /// Adds an item that occupies only some bits of a register. Several items may share a register, but not the same bits.
    fn part(&mut self, reader: &mut Reader<'_, '_>, item: &Item, bits: Bits) {
        let Some(address) = item.bindings.iter().find_map(address) else { return };
        let parts = self.parts.entry(address.clone()).or_default();
        let shares = |other: &&Part| {
            let end = |(offset, count): Bits| u16::from(offset) + u16::from(count);
            u16::from(bits.0) < end(other.bits)
                && u16::from(other.bits.0) < end(bits)
                && !apart(other.availability.as_deref(), item.availability.as_deref())
        };
        if let Some(other) = parts.iter().find(shares) {
            let (name, other_name) = (brief(&item.name), brief(&other.name));
            let message = format!("`{name}` and `{other_name}` are parts of {address}, but overlap");
            let found = codes::SHARED_REGISTERS.at(item.at.name, message).note_at(other.span, "the other item");
            reader.diagnostics.push(found.help("correct `part` or the register number of one item"));
        }
        let availability = item.availability.clone();
        parts.push(Part { bits, name: item.name.clone(), span: item.at.name, availability });
    }
}

/// Reports the second use of a name or address.
fn twice(reader: &mut Reader<'_, '_>, what: &str, item: &Item, first: Span, help: Option<&'static str>) {
    let found = codes::TABLE_DUPLICATE.at(item.at.name, format!("{what} occurs twice"));
    reader.diagnostics.push(Diagnostic { help: help.map(Into::into), ..found.note_at(first, "first use") });
}

fn numbers(first: u32, last: u32) -> String {
    number::range(first, last, |number| number.to_string())
}

fn space_name(space: RegisterSpace) -> &'static str {
    match space {
        RegisterSpace::Holding => "holding register",
        RegisterSpace::Input => "input register",
        RegisterSpace::Coil => "coil",
        RegisterSpace::DiscreteInput => "discrete input",
    }
}

/// Returns a text that identifies an address, or `None` if items may share the address.
fn address(binding: &Binding) -> Option<CompactString> {
    Some(match binding {
        Binding::Object { index, sub_index, .. } => format_compact!("object {}", written_object(*index, *sub_index)),
        Binding::Register(register) => format_compact!("{} {}", space_name(register.space), register.address),
        Binding::Parameter(parameter) => format_compact!("parameter {} of `{}`", parameter.code, parameter.space),
        Binding::Ascii(name) => format_compact!("`{name}`"),
        _ => return None,
    })
}
