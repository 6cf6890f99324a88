//! Names and addresses that are in use: each has one item.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

use compact_str::{format_compact, CompactString};

use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::firmware::apart;
use crate::ir::{Availability, Binding, Buses, Item, ObjectBuses, RegisterBinding, RegisterSpace};
use crate::source::Span;
use crate::text::brief;

/// What is in use so far, and where.
#[derive(Default)]
pub(super) struct Taken {
    /// Numbers of chapters, by their titles.
    chapters: HashMap<CompactString, usize>,
    /// Names by their chapter.
    names: HashMap<(usize, CompactString), Span>,
    addresses: HashMap<CompactString, Vec<Holder>>,
    /// Registers by their first number.
    registers: BTreeMap<(&'static str, u32), Stretch>,
    /// Parts of an address.
    parts: HashMap<CompactString, Vec<Part>>,
}

/// An item at an address.
struct Holder {
    span: Span,
    name: CompactString,
    /// The item of which it is another name.
    same_as: Option<CompactString>,
    availability: Option<Box<Availability>>,
    buses: Option<ObjectBuses>,
}

impl Holder {
    /// Whether no device has both on one bus, or one is another name of the other: as long, or with fewer or more bits.
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

/// Registers of one item.
struct Stretch {
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

impl Taken {
    /// Takes name and addresses of a register's item; `part` are the bits that it is about, where it isn't all of it. A name is
    /// an item's own in its chapter.
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
                let help = "chapters tell rows of one name apart: give each a `title` of its own";
                twice(reader, &format!("the name `{}`", brief(&item.name)), item, *first.get(), Some(help));
            }
        }
        match part {
            Some(bits) => self.part(reader, item, bits),
            None => self.place(reader, item),
        }
    }

    /// Takes the addresses of an item. Of two items at one, no model and no firmware may have both.
    pub fn place(&mut self, reader: &mut Reader<'_, '_>, item: &Item) {
        for binding in &item.bindings {
            let Some(address) = address(binding) else { continue };
            let buses = match binding {
                Binding::Object { buses, .. } => Some(*buses),
                _ => None,
            };
            let same_as = item.related.as_ref().and_then(|own| own.same_as.as_ref()).map(|own| own.name.clone());
            let (span, name) = (item.at.name, item.name.clone());
            let holder = Holder { span, name, same_as, availability: item.availability.clone(), buses };
            let holders = self.addresses.entry(address.clone()).or_default();
            if let Some(first) = holders.iter().find(|other| !other.is_apart(&holder)) {
                twice(reader, &address, item, first.span, None);
                continue;
            }
            let is_first = holders.is_empty();
            holders.push(holder);
            if let (Binding::Register(own), true) = (binding, is_first) {
                self.stretch(reader, item, own);
            }
        }
    }

    /// Registers that begin elsewhere and reach into these.
    fn stretch(&mut self, reader: &mut Reader<'_, '_>, item: &Item, register: &RegisterBinding) {
        let (space, first) = (space_name(register.space), u32::from(register.address));
        let last = u32::from(register.last());
        let before = self.registers.range((space, 0)..(space, first)).next_back();
        let before = before.filter(|(_, other)| other.last >= first);
        let other = before.or_else(|| self.registers.range((space, first)..=(space, last)).next());
        let other = other.filter(|(_, other)| !apart(other.availability.as_deref(), item.availability.as_deref()));
        if let Some(((_, start), other)) = other {
            let message = format!(
                "`{}` takes {space} register {}, and `{}` takes {}",
                brief(&item.name),
                numbers(first, last),
                brief(&other.name),
                numbers(*start, other.last)
            );
            let found = Diagnostic::new(&codes::SHARED_REGISTERS, item.at.name, message);
            let found = found.note_at(other.span, "the other one is here");
            reader.diagnostics.push(found.help("one of the two has the wrong number, or a type that is too long"));
        }
        let availability = item.availability.clone();
        let stretch = Stretch { last, name: item.name.clone(), span: item.at.name, availability };
        self.registers.insert((space, first), stretch);
    }

    /// Parts of one register share an address, and no bits.
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
            let (own, its) = (brief(&item.name), brief(&other.name));
            let message = format!("`{own}` and `{its}` are parts of {address} and share bits");
            let found = Diagnostic::new(&codes::SHARED_REGISTERS, item.at.name, message);
            let found = found.note_at(other.span, "the other one is here");
            reader.diagnostics.push(found.help("one of the two has the wrong bits in `part`, or the wrong number"));
        }
        let availability = item.availability.clone();
        parts.push(Part { bits, name: item.name.clone(), span: item.at.name, availability });
    }
}

/// Reports the second use of a name or an address.
fn twice(reader: &mut Reader<'_, '_>, what: &str, item: &Item, first: Span, help: Option<&'static str>) {
    let found = Diagnostic::new(&codes::TABLE_DUPLICATE, item.at.name, format!("{what} occurs twice"));
    let found = found.note_at(first, "the first is here");
    reader.diagnostics.push(match help {
        Some(help) => found.help(help),
        None => found,
    });
}

fn numbers(first: u32, last: u32) -> String {
    match first == last {
        true => first.to_string(),
        false => format!("{first} to {last}"),
    }
}

fn space_name(space: RegisterSpace) -> &'static str {
    match space {
        RegisterSpace::Holding => "holding",
        RegisterSpace::Input => "input",
        RegisterSpace::Coil => "coil",
        RegisterSpace::DiscreteInput => "discrete input",
    }
}

/// How a binding is told apart from others; `None` where two items may share it.
fn address(binding: &Binding) -> Option<CompactString> {
    Some(match binding {
        Binding::Object { index, sub_index, .. } => format_compact!("object 0x{index:04X}:{sub_index}"),
        Binding::Register(own) => format_compact!("{} register {}", space_name(own.space), own.address),
        Binding::Parameter { space, code } => format_compact!("parameter {code} of `{space}`"),
        Binding::Ascii(name) => format_compact!("`{name}`"),
        _ => return None,
    })
}
