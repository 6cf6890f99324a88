//! Layouts of process data.

use super::{pairs, types, Changes, Judgement, Scope};
use lexibus_codegen::facts;
use lexibus_codegen::facts::cob_id::{self, CobId};
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{Direction, Pdo, PdoEntry, PdoEntryKind, ProcessImage, TypeDef};

pub(super) fn compare(old: &Scope<'_>, new: &Scope<'_>, changes: &mut Changes) {
    let key = |own: &Pdo| (own.mapping_index, own.buses.map(|buses| (buses.canopen, buses.coe)));
    for (was, is) in pairs(old.pdos, new.pdos, key, false) {
        let Some(own) = was.or(is) else { continue };
        let buses = if is.is_some() { new.buses } else { old.buses };
        let element = format!("{} {}", facts::pdo::title(own, buses), own.name).trim().to_owned();
        let (Some(was), Some(is)) = (was, is) else {
            changes.existence(&element, was.is_some(), is.is_some());
            continue;
        };
        let layouts = layouts((&was.entries, old.types), (&is.entries, new.types));
        if layouts.0 == layouts.1 {
            // Padding at the end has no place in the layout.
            let length = |own: &Pdo| format!("{} bits", own.bits());
            changes.fact(&element, "length", (length(was), length(is)), Judgement::Breaking);
        }
        changes.fact(&element, "layout", layouts, Judgement::Breaking);
        let fixed = |own: &Pdo| if own.fixed { "fixed" } else { "variable" }.to_owned();
        let judgement = if is.fixed { Judgement::Breaking } else { Judgement::Compatible };
        changes.fact(&element, "mapping", (fixed(was), fixed(is)), judgement);
        let cob_id = |own: &Pdo| {
            let id = own.communication.as_ref().and_then(|own| own.cob_id.as_ref());
            id.map(|id| cob_id::text(id, CobId::of_pdo(own.direction)).unwrap_or_else(|| PLAIN.value(id)))
                .unwrap_or_default()
        };
        changes.fact(&element, "COB-ID", (cob_id(was), cob_id(is)), Judgement::Compatible);
        let manager = |own: &Pdo| own.sync_manager.map(|own| own.to_string()).unwrap_or_default();
        changes.fact(&element, "sync manager", (manager(was), manager(is)), Judgement::Compatible);
        let excludes = |own: &Pdo| own.excludes.iter().map(|own| format!("0x{own:04X}")).collect::<Vec<_>>().join(", ");
        let fewer = was.excludes.iter().all(|own| is.excludes.contains(own)) && was.excludes.len() < is.excludes.len();
        let judgement = if fewer { Judgement::Breaking } else { Judgement::Compatible };
        changes.fact(&element, "excludes", (excludes(was), excludes(is)), judgement);
    }
    images(old, new, changes);
}

fn images(old: &Scope<'_>, new: &Scope<'_>, changes: &mut Changes) {
    let same = |one: &ProcessImage, other: &ProcessImage| one.direction == other.direction && one.name == other.name;
    for was in &old.images {
        let element = format!("image {}", name(was));
        match new.images.iter().find(|own| same(own, was)) {
            Some(is) => {
                let lengths = (was.length.to_string(), is.length.to_string());
                changes.fact(&element, "length", lengths, Judgement::Breaking);
                let layouts = layouts((&was.fields, old.types), (&is.fields, new.types));
                changes.fact(&element, "layout", layouts, Judgement::Breaking);
            }
            None => changes.existence(&element, true, false),
        }
    }
    for is in new.images.iter().filter(|own| !old.images.iter().any(|other| same(own, other))) {
        changes.existence(&format!("image {}", name(is)), false, true);
    }
}

fn name(own: &ProcessImage) -> &str {
    match (own.name.as_str(), own.direction) {
        ("", Direction::Receive) => "to the device",
        ("", Direction::Transmit) => "from the device",
        (name, _) => name,
    }
}

/// What stands where, of both: `0: UNSIGNED16 Controlword, 16: INTEGER32 Target position`. What both begin or end with is left out of
/// long ones.
fn layouts(
    (old, old_types): (&[PdoEntry], &[TypeDef]),
    (new, new_types): (&[PdoEntry], &[TypeDef]),
) -> (String, String) {
    let (mut old, mut new) = (layout(old, old_types), layout(new, new_types));
    if old == new {
        return (String::new(), String::new());
    }
    let first = old.iter().zip(&new).take_while(|(one, other)| one == other).count();
    let rest = (old.len() - first).min(new.len() - first);
    let last = old.iter().rev().zip(new.iter().rev()).take(rest).take_while(|(one, other)| one == other).count();
    let shorten = |list: &mut Vec<String>| {
        if last > 1 {
            list.splice(list.len() - last.., ["…".to_owned()]);
        }
        if first > 1 {
            list.splice(..first, ["…".to_owned()]);
        }
        list.join(", ")
    };
    (shorten(&mut old), shorten(&mut new))
}

fn layout(entries: &[PdoEntry], types: &[TypeDef]) -> Vec<String> {
    let own = entries.iter().filter(|own| own.kind != PdoEntryKind::Padding);
    own.map(|own| format!("{}: {} {}", own.bit_offset, types::written(types, own.ty), own.name)).collect()
}
