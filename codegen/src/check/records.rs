//! Parameter records of PROFINET submodules: parameters and constants outside of their record, and overlapping
//! parameters.

use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Binding, Group, GroupKind, Item, Record};

pub(super) fn check(groups: &[Group], diagnostics: &mut Diagnostics) {
    for group in groups {
        if let GroupKind::Record(record) = &group.kind {
            bounds(group, record, diagnostics);
            overlaps(group, diagnostics);
        }
    }
}

/// Returns the bit offset and the length in bits of a parameter in its record.
fn bits_of(item: &Item) -> Option<(u64, u64)> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Record { bit_offset, bits, .. } => Some((u64::from(*bit_offset), u64::from(*bits))),
        _ => None,
    })
}

fn bounds(group: &Group, record: &Record, diagnostics: &mut Diagnostics) {
    let length = u64::from(record.length);
    for item in &group.items {
        let Some((offset, bits)) = bits_of(item) else { continue };
        let end = (offset + bits).div_ceil(8);
        if end > length {
            let message = format!("the parameter needs a record of {end} bytes, but the record has {length} bytes");
            let found = codes::RECORD_BOUNDS.at(item.origin.span, message).label("kept unchanged");
            diagnostics.push(found.note_at(group.origin.span, "the record"));
        }
    }
    for (offset, bytes) in &record.constants {
        let end = u64::from(*offset) + bytes.len() as u64;
        if end > length {
            let message = format!("a constant needs a record of {end} bytes, but the record has {length} bytes");
            diagnostics.push(codes::RECORD_BOUNDS.at(group.origin.span, message).label("kept unchanged"));
        }
    }
}

fn overlaps(group: &Group, diagnostics: &mut Diagnostics) {
    let mut items: Vec<(u64, u64, &Item)> = Vec::with_capacity(group.items.len());
    items.extend(group.items.iter().filter_map(|item| bits_of(item).map(|(offset, bits)| (offset, bits, item))));
    items.sort_by_key(|&(offset, ..)| offset);
    // The parameter that ends last among the parameters checked so far, and the bit offset of its end.
    let mut last: Option<(u64, &Item)> = None;
    for (offset, bits, item) in items {
        let end = offset + bits;
        if let Some((reach, other)) = last.filter(|&(reach, _)| offset < reach && bits > 0) {
            let message = format!("the parameter `{}` shares bits with `{}`", item.name, other.name);
            let found = codes::PARAMETERS_OVERLAP.at(item.origin.span, message).label("both are kept");
            diagnostics.push(found.note_at(other.origin.span, "the other parameter"));
            if end <= reach {
                continue;
            }
        }
        last = Some((end, item));
    }
}
