//! PDO entries of EtherCAT slaves and modules: bit positions, and types of mapped items (ETG.2000, RxPdo and TxPdo).

use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{CompactString, Device, Entries, Item, Module, Pdo, PdoEntry, PdoEntryKind, Type, TypeDef};
use crate::number::sub_entry;

/// Sets the bit positions and types of a device's PDO entries.
pub(super) fn device(device: &mut Device, diagnostics: &mut Diagnostics) {
    let dictionary = Dictionary { items: Entries::new(&device.groups), types: &device.types };
    pdos(&mut device.process_data.pdos, &dictionary, diagnostics);
}

/// Sets the bit positions and types of a module's PDO entries.
pub(super) fn module(module: &mut Module, diagnostics: &mut Diagnostics) {
    let dictionary = Dictionary { items: Entries::new(&module.groups), types: &module.types };
    pdos(&mut module.process_data.pdos, &dictionary, diagnostics);
}

/// The items that PDO entries can map, and the types of these items.
struct Dictionary<'o> {
    items: Entries<'o>,
    types: &'o [TypeDef],
}

fn pdos(pdos: &mut [Pdo], dictionary: &Dictionary<'_>, diagnostics: &mut Diagnostics) {
    for pdo in pdos {
        let mut offset = 0u32;
        for entry in &mut pdo.entries {
            entry.bit_offset = offset;
            offset = offset.saturating_add(entry.bits);
            if !matches!(entry.kind, PdoEntryKind::Unnumbered | PdoEntryKind::Padding) {
                resolve(entry, dictionary, diagnostics);
            }
        }
    }
}

fn resolve(entry: &mut PdoEntry, dictionary: &Dictionary<'_>, diagnostics: &mut Diagnostics) {
    let Some(item) = dictionary.items.get(entry.index, entry.sub_index) else {
        // Objects whose index depends on the slot belong to a module, and a device without a dictionary describes no objects. In
        // both cases, the object is not reported as missing.
        if !entry.depends_on_slot && !dictionary.items.is_empty() && diagnostics.wants(&codes::MAPPED_OBJECT_MISSING) {
            let message = format!("{} is mapped, but not in the object dictionary", address(entry));
            let found = codes::MAPPED_OBJECT_MISSING.at(entry.origin.span, message);
            diagnostics.push(found.label("an object with the name and type of the entry was added"));
        }
        return;
    };
    entry.kind = PdoEntryKind::Item;
    if entry.name.is_empty() {
        (entry.name, entry.names) = (entry_name(item), item.names.clone());
    }
    // The entry gets the type of the item if the lengths are equal. A type without a fixed length replaces only an opaque type.
    let fits = match Owner::of_types(dictionary.types).fixed_bits(item.ty) {
        Some(bits) => bits == entry.bits,
        None => matches!(entry.ty, Type::Opaque(_)),
    };
    if fits {
        entry.ty = item.ty;
    }
}

/// Returns the name of an item for a PDO entry without a name. Long names are shortened, because many entries can map the same
/// item.
pub(super) fn entry_name(item: &Item) -> CompactString {
    const LONG: usize = 512;
    if item.name.len() > LONG {
        crate::text::brief(&item.name).into()
    } else {
        item.name.clone()
    }
}

/// Returns the index and sub-index of an entry as text for diagnostics.
pub(crate) fn address(entry: &PdoEntry) -> String {
    sub_entry(entry.index, entry.sub_index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, Direction, Group, ObjectCode};

    #[test]
    fn entries_have_offsets_and_the_types_of_their_items() {
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
