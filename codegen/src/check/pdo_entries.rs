//! PDOs of EtherCAT slaves and modules: duplicate indices and wrong lengths (ETG.2000, RxPdo and TxPdo).

use super::context::PdoOwner;
use crate::collections::{HashMap, HashMapExt};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{stated, Item, Pdo, PdoEntry, PdoEntryKind};
use crate::number::hex16;
use crate::resolve::address;
use crate::source::Span;
use crate::text::count_of;

/// Reports PDOs that share an index, and PDO entries whose length differs from that of the mapped item.
pub(super) fn check(owner: &PdoOwner<'_>, diagnostics: &mut Diagnostics) {
    // Two PDOs may share an index if they are on different buses.
    let mut seen: HashMap<(u16, Option<bool>), Span> = HashMap::with_capacity(owner.data.pdos.len());
    for pdo in &owner.data.pdos {
        if pdo.mapping_index != 0 {
            let key = (pdo.mapping_index, pdo.buses.map(|buses| buses.coe));
            let first = *seen.entry(key).or_insert(pdo.origin.span);
            if first != pdo.origin.span {
                diagnostics.push(duplicate(pdo, first));
            }
        }
        for entry in pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item) {
            if let Some(item) = owner.described(entry) {
                let bits = owner.owner.fixed_bits(stated::ty(owner.owner, item)).filter(|bits| *bits != entry.bits);
                bits.into_iter().for_each(|bits| diagnostics.push(length(entry, item, bits)));
            }
        }
    }
}

fn duplicate(pdo: &Pdo, first: Span) -> Diagnostic {
    let message = format!("two PDOs have the index {}", hex16(pdo.mapping_index));
    codes::DUPLICATE_PDO.at(pdo.origin.span, message).label("both are kept").note_at(first, "first PDO with this index")
}

fn length(entry: &PdoEntry, item: &Item, bits: u32) -> Diagnostic {
    let message =
        format!("{} is mapped with {}, but the object has {bits}", address(entry), count_of(entry.bits, "bit"));
    let found = codes::MAPPED_LENGTH.at(entry.origin.span, message).label("the length of the entry is used");
    found.note_at(item.origin.span, "the mapped object")
}
