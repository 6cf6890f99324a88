//! Built-in submodules of a PROFINET module or device: duplicate subslots.

use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Catalog, Submodule, SubmoduleId, SubmoduleKind, SubmoduleUse};
use crate::number::hex16;

pub(super) fn check(catalog: &Catalog, diagnostics: &mut Diagnostics) {
    let of_devices = catalog.devices.iter().map(|device| &device.submodules);
    for uses in of_devices.chain(catalog.modules.iter().map(|module| &module.submodules)) {
        if uses.len() > 1 {
            distinct(uses, &catalog.submodules, diagnostics);
        }
    }
}

fn distinct(uses: &[SubmoduleUse], submodules: &[Submodule], diagnostics: &mut Diagnostics) {
    let mut ranges: Vec<(u16, u16, SubmoduleId)> = Vec::new();
    let kind = |submodule: SubmoduleId| submodules.get(submodule.0 as usize).map(|submodule| submodule.kind);
    for of_module in
        uses.iter().filter(|of_module| kind(of_module.submodule).is_some_and(|kind| kind != SubmoduleKind::Pluggable))
    {
        let fixed = of_module.places.fixed.0.iter();
        ranges.extend(fixed.map(|&(first, last)| (first, last, of_module.submodule)));
    }
    ranges.sort_by_key(|&(first, ..)| first);
    let mut before: Option<(u16, SubmoduleId)> = None;
    for (first, last, submodule) in ranges {
        if let Some((_, other)) = before.filter(|&(end, other)| first <= end && other != submodule) {
            report(first, [other, submodule].map(|SubmoduleId(at)| submodules.get(at as usize)), diagnostics);
        }
        if before.is_none_or(|(end, _)| last > end) {
            before = Some((last, submodule));
        }
    }
}

fn report(subslot: u16, pair: [Option<&Submodule>; 2], diagnostics: &mut Diagnostics) {
    let [Some(first), Some(second)] = pair else { return };
    let message = format!("another submodule already occupies subslot {}", hex16(subslot));
    let found = codes::SUBSLOT_TAKEN.at(second.origin.span, message).label("both are kept");
    diagnostics.push(found.note_at(first.origin.span, "the other submodule"));
}
