//! Names and addresses that are in use: each has one item.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

use compact_str::{format_compact, CompactString};

use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Binding, Item, RegisterBinding, RegisterSpace};
use crate::source::Span;
use crate::text::brief;

/// What is in use so far, and where.
#[derive(Default)]
pub(super) struct Taken {
    names: HashMap<CompactString, Span>,
    addresses: HashMap<CompactString, Span>,
    /// Registers by their first number.
    registers: BTreeMap<(&'static str, u32), Stretch>,
    /// Parts of an address.
    parts: HashMap<CompactString, Vec<Part>>,
}

/// Registers of one item.
struct Stretch {
    last: u32,
    name: CompactString,
    span: Span,
}

/// First bit and number of bits.
type Bits = (u8, u8);

struct Part {
    bits: Bits,
    name: CompactString,
    span: Span,
}

impl Taken {
    /// Takes name and addresses of a register's item; `part` are the bits that it is about, where it isn't all of it.
    pub fn register(&mut self, reader: &mut Reader<'_, '_>, item: &Item, part: Option<Bits>) {
        note(&mut self.names, reader, item.name.clone(), &format!("the name `{}`", brief(&item.name)), item.at.name);
        match part {
            Some(bits) => self.part(reader, item, bits),
            None => self.place(reader, item),
        }
    }

    /// Takes the addresses of an item.
    pub fn place(&mut self, reader: &mut Reader<'_, '_>, item: &Item) {
        for binding in &item.bindings {
            let Some(address) = address(binding) else { continue };
            if !note(&mut self.addresses, reader, address.clone(), &address, item.at.name) {
                continue;
            }
            if let Binding::Register(own) = binding {
                self.stretch(reader, item, own);
            }
        }
    }

    /// Registers that begin elsewhere and reach into these.
    fn stretch(&mut self, reader: &mut Reader<'_, '_>, item: &Item, own: &RegisterBinding) {
        let (space, first) = (space_name(own.space), u32::from(own.address));
        let last = first + u32::from(own.count.max(1)) - 1;
        let before = self.registers.range((space, 0)..(space, first)).next_back();
        let before = before.filter(|(_, other)| other.last >= first);
        let other = before.or_else(|| self.registers.range((space, first)..=(space, last)).next());
        if let Some(((_, start), other)) = other {
            let message = format!(
                "`{}` takes {space} register {}, and `{}` takes {}",
                brief(&item.name),
                numbers(first, last),
                brief(&other.name),
                numbers(*start, other.last)
            );
            let found = Diagnostic::new(&codes::REGISTERS_SHARED, item.at.name, message);
            let found = found.note_at(other.span, "the other one is here");
            reader.diagnostics.push(found.help("one of the two has the wrong number, or a type that is too long"));
        }
        self.registers.insert((space, first), Stretch { last, name: item.name.clone(), span: item.at.name });
    }

    /// Parts of one register share an address, and no bits.
    fn part(&mut self, reader: &mut Reader<'_, '_>, item: &Item, bits: Bits) {
        let Some(address) = item.bindings.iter().find_map(address) else { return };
        let parts = self.parts.entry(address.clone()).or_default();
        let shares = |other: &&Part| {
            let end = |(offset, count): Bits| u16::from(offset) + u16::from(count);
            u16::from(bits.0) < end(other.bits) && u16::from(other.bits.0) < end(bits)
        };
        if let Some(other) = parts.iter().find(shares) {
            let (own, its) = (brief(&item.name), brief(&other.name));
            let message = format!("`{own}` and `{its}` are parts of {address} and share bits");
            let found = Diagnostic::new(&codes::REGISTERS_SHARED, item.at.name, message);
            reader.diagnostics.push(found.note_at(other.span, "the other one is here"));
        }
        parts.push(Part { bits, name: item.name.clone(), span: item.at.name });
    }
}

/// Reports the second use of a name.
fn note(
    seen: &mut HashMap<CompactString, Span>,
    reader: &mut Reader<'_, '_>,
    key: CompactString,
    what: &str,
    span: Span,
) -> bool {
    match seen.entry(key) {
        Entry::Vacant(free) => {
            free.insert(span);
            true
        }
        Entry::Occupied(first) => {
            let diagnostic = Diagnostic::new(&codes::TABLE_DUPLICATE, span, format!("{what} occurs twice"));
            reader.diagnostics.push(diagnostic.note_at(*first.get(), "the first is here"));
            false
        }
    }
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
