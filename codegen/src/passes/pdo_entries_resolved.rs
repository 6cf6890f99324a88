//! After this pass every PDO of an EtherCAT slave or module has exact bit positions, and its entries the types of the items
//! that they map (ETG.2000, RxPdo and TxPdo).

use std::collections::HashMap;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, Entries, Item, Module, Pdo, PdoEntry, PdoEntryKind, Type, TypeDef, TypeId};
use crate::source::Span;

/// Of a device.
pub(super) fn device(device: &mut Device, diagnostics: &mut Diagnostics) {
    let owner = Owner { items: Entries::new(&device.groups), types: &device.types };
    pdos(&mut device.process_data.pdos, &owner, diagnostics);
}

/// Of a module.
pub(super) fn module(module: &mut Module, diagnostics: &mut Diagnostics) {
    let owner = Owner { items: Entries::new(&module.groups), types: &module.types };
    pdos(&mut module.process_data.pdos, &owner, diagnostics);
}

/// What has the PDOs: items, and their types.
struct Owner<'o> {
    items: Entries<'o>,
    types: &'o [TypeDef],
}

impl<'o> Owner<'o> {
    fn item(&self, entry: &PdoEntry) -> Option<&'o Item> {
        self.items.get(entry.index, entry.sub_index)
    }

    /// Length in bits, where fixed.
    fn bits(&self, ty: Type) -> Option<u32> {
        match ty {
            Type::Named(TypeId(at)) => self.types.get(at as usize)?.bits,
            Type::VisibleString(length) | Type::OctetString(length) => length?.checked_mul(8),
            Type::UnicodeString(length) => length?.checked_mul(16),
            basic => basic.bits(),
        }
    }
}

fn pdos(pdos: &mut [Pdo], owner: &Owner<'_>, diagnostics: &mut Diagnostics) {
    // One index on two buses is two PDOs.
    let mut seen: HashMap<(u16, Option<bool>), Span> = HashMap::with_capacity(pdos.len());
    for pdo in pdos {
        if pdo.mapping_index != 0 {
            let first = *seen.entry((pdo.mapping_index, pdo.buses.map(|own| own.coe))).or_insert(pdo.origin.span);
            if first != pdo.origin.span {
                let message = format!("two PDOs have the index 0x{:04X}", pdo.mapping_index);
                diagnostics.push(
                    Diagnostic::new(&codes::DUPLICATE_PDO, pdo.origin.span, message)
                        .label("both are kept")
                        .note_at(first, "the first one"),
                );
            }
        }
        let mut offset = 0u32;
        for entry in &mut pdo.entries {
            entry.bit_offset = offset;
            offset = offset.saturating_add(entry.bits);
            match entry.kind {
                PdoEntryKind::Unnumbered => {}
                _ if entry.index == 0 => entry.kind = PdoEntryKind::Padding,
                _ => resolve(entry, owner, diagnostics),
            }
        }
    }
}

fn resolve(entry: &mut PdoEntry, owner: &Owner<'_>, diagnostics: &mut Diagnostics) {
    let Some(item) = owner.item(entry) else {
        // The objects of a slot belong to its module, and without a dictionary there is nothing to hold against.
        if !entry.depends_on_slot && !owner.items.is_empty() && diagnostics.wants(&codes::MAPPED_OBJECT_MISSING) {
            let message = format!("{} is mapped, but the dictionary doesn't have it", address(entry));
            diagnostics.push(
                Diagnostic::new(&codes::MAPPED_OBJECT_MISSING, entry.origin.span, message)
                    .label("taken as the entry describes it"),
            );
        }
        return;
    };
    entry.kind = PdoEntryKind::Item;
    if entry.name.is_empty() {
        (entry.name, entry.names) = (super::short(&item.name), item.names.clone());
    }
    match owner.bits(item.ty) {
        Some(bits) if bits == entry.bits => entry.ty = item.ty,
        Some(bits) => {
            let message = format!("{} is mapped with {} bits, but has {bits}", address(entry), entry.bits);
            diagnostics.push(
                Diagnostic::new(&codes::MAPPED_LENGTH, entry.origin.span, message)
                    .label("the entry decides the layout")
                    .note_at(item.origin.span, "the mapped object"),
            );
        }
        // A type without a length of its own is as long as the entry, which may know better what it is.
        None if matches!(entry.ty, Type::Opaque(_)) => entry.ty = item.ty,
        None => {}
    }
}

fn address(entry: &PdoEntry) -> String {
    format!("0x{:04X} sub-index {:#x}", entry.index, entry.sub_index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, Direction, Group, ObjectCode};

    #[test]
    fn offsets_add_up_and_types_are_those_of_the_items() {
        let mut group = Group::object(0x6040, ObjectCode::Var);
        let mut item = Item::new(Binding::coe(0x6040, 0));
        (item.name, item.ty) = ("Controlword".into(), Type::Unsigned(16));
        group.items.push(item);
        let mut pdo = Pdo::new(Direction::Receive, 0x1600);
        pdo.entries = vec![PdoEntry::new(0x6040, 0, 16), PdoEntry::new(0, 0, 3), PdoEntry::new(0x6041, 0, 8)];
        let mut device = Device { groups: vec![group], ..Device::default() };
        device.process_data.pdos.push(pdo);
        let mut diagnostics = Diagnostics::default();
        super::device(&mut device, &mut diagnostics);
        let entries = &device.process_data.pdos[0].entries;
        assert_eq!(entries.iter().map(|entry| entry.bit_offset).collect::<Vec<_>>(), [0, 16, 19]);
        assert_eq!((entries[0].ty, entries[0].name.as_str()), (Type::Unsigned(16), "Controlword"));
        let kinds: Vec<_> = entries.iter().map(|entry| entry.kind).collect();
        assert_eq!(kinds, [PdoEntryKind::Item, PdoEntryKind::Padding, PdoEntryKind::Unknown]);
        assert_eq!(diagnostics.list().iter().map(|found| found.code.id).collect::<Vec<_>>(), ["PDO001"]);
    }
}
