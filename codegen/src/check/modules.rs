//! PROFINET modules that exceed the limits of their devices: lengths of data and records, and slots.

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{
    Catalog, Device, Group, GroupKind, IoData, IoLengths, Module, Numbers, ProfinetSettings, Submodule, SubmoduleUse,
};
use crate::text::count_of;

/// A limit in bytes, and the device that has this limit, as a position in the catalog.
type Limit = Option<(u32, usize)>;

/// The lowest limits of all devices that accept a module or submodule: for inputs, outputs, their sum, and a record.
type Limits = [Limit; 4];

fn limits_of(settings: &ProfinetSettings, device: usize) -> Limits {
    let IoLengths { input, output, data } = settings.max_lengths;
    let [input, output, data] = [input, output, data].map(|bytes| Some((bytes?.into(), device)));
    [input, output, data, Some((settings.max_record_size, device))]
}

/// Replaces each limit with the corresponding limit in `others` if that limit is lower, or if no limit is set.
fn narrow(limits: &mut Limits, others: Limits) {
    for (limit, other) in limits.iter_mut().zip(others) {
        *limit = [*limit, other].into_iter().flatten().min();
    }
}

pub(super) fn check(catalog: &Catalog, diagnostics: &mut Diagnostics) {
    let Catalog { devices, modules, submodules, .. } = catalog;
    let mut of_modules = vec![Limits::default(); modules.len()];
    let mut of_submodules = vec![Limits::default(); submodules.len()];
    for (position, device) in devices.iter().enumerate() {
        let Some(settings) = &device.profinet else { continue };
        let of_device = limits_of(settings, position);
        for module in &device.modules {
            if let Some(limits) = of_modules.get_mut(module.module.0 as usize) {
                narrow(limits, of_device);
            }
        }
        narrow_uses(&device.submodules, of_device, &mut of_submodules);
        slots(device, settings, modules, diagnostics);
    }
    for (module, &limits) in modules.iter().zip(&of_modules) {
        narrow_uses(&module.submodules, limits, &mut of_submodules);
        lengths(module, limits, catalog, diagnostics);
    }
    for (submodule, [.., record]) in submodules.iter().zip(of_submodules) {
        records(submodule, record, devices, diagnostics);
    }
}

fn narrow_uses(uses: &[SubmoduleUse], of_owner: Limits, of_submodules: &mut [Limits]) {
    for submodule in uses {
        if let Some(limits) = of_submodules.get_mut(submodule.submodule.0 as usize) {
            narrow(limits, of_owner);
        }
    }
}

/// Reports a module if the submodules that are fixed in its subslots have more data than a device that accepts the module can
/// exchange.
fn lengths(module: &Module, limits: Limits, catalog: &Catalog, diagnostics: &mut Diagnostics) {
    let bytes = |data: &Option<Box<IoData>>| data.as_ref().map_or(0, |data| data.image.length + data.image.overhead);
    let (mut input, mut output) = (0u32, 0u32);
    let built_in = module.submodules.iter().filter(|part| !part.places.fixed.is_empty());
    for submodule in built_in.filter_map(|part| catalog.submodules.get(part.submodule.0 as usize)) {
        input = input.saturating_add(bytes(&submodule.input));
        output = output.saturating_add(bytes(&submodule.output));
    }
    let [of_input, of_output, of_data, _] = limits;
    let sums = [
        (input, of_input, "inputs"),
        (output, of_output, "outputs"),
        (input.saturating_add(output), of_data, "inputs and outputs"),
    ];
    for (bytes, limit, what) in sums {
        let Some((limit, device)) = limit.filter(|&(limit, _)| bytes > limit) else { continue };
        let message = format!(
            "the module has {} of {what}, but a device that accepts the module allows at most {limit} bytes",
            count_of(bytes, "byte")
        );
        diagnostics.push(noted(codes::IO_LENGTH.at(module.origin.span, message), catalog.devices.get(device)));
    }
}

fn noted(diagnostic: Diagnostic, device: Option<&Device>) -> Diagnostic {
    match device {
        Some(device) => diagnostic.note_at(device.origin.span, "the device"),
        None => diagnostic,
    }
}

fn records(submodule: &Submodule, limit: Limit, devices: &[Device], diagnostics: &mut Diagnostics) {
    let Some((limit, device)) = limit else { return };
    let length = |group: &Group| match &group.kind {
        GroupKind::Record(record) => record.length,
        _ => 0,
    };
    for group in submodule.records.iter().filter(|group| length(group) > limit) {
        let message =
            format!("the record has {} bytes, but a device that uses it accepts at most {limit} bytes", length(group));
        diagnostics.push(noted(codes::RECORD_SIZE.at(group.origin.span, message), devices.get(device)));
    }
}

/// Reports modules for slots that the device does not have.
fn slots(device: &Device, settings: &ProfinetSettings, modules: &[Module], diagnostics: &mut Diagnostics) {
    if settings.slots.is_empty() {
        return;
    }
    let present = merged(&settings.slots);
    for module in &device.modules {
        let slots = [&module.places.allowed, &module.places.fixed, &module.places.used];
        let ranges = slots.into_iter().flat_map(|numbers| &numbers.0);
        let Some(&(first, last)) = ranges.into_iter().find(|range| !contains(&present, **range)) else { continue };
        let name = modules.get(module.module.0 as usize).map_or("", |module| module.id.as_str());
        let range = if first == last { first.to_string() } else { format!("{first}..{last}") };
        let message =
            format!("the module `{name}` is for slots {range}, but the device does not have all of these slots");
        let found = codes::SLOT_RANGE.at(device.origin.span, message);
        diagnostics.push(found.label("PhysicalSlots lists the slots of the device"));
    }
}

/// Returns the numbers as sorted ranges that neither overlap nor touch.
fn merged(numbers: &Numbers) -> Vec<(u16, u16)> {
    let mut ranges = numbers.0.to_vec();
    ranges.sort_unstable();
    let mut merged: Vec<(u16, u16)> = Vec::with_capacity(ranges.len());
    for (first, last) in ranges {
        match merged.last_mut() {
            Some(before) if u32::from(first) <= u32::from(before.1) + 1 => before.1 = before.1.max(last),
            _ => merged.push((first, last)),
        }
    }
    merged
}

fn contains(ranges: &[(u16, u16)], range: (u16, u16)) -> bool {
    let (first, last) = range;
    let at = ranges.partition_point(|&(_, end)| end < first);
    ranges.get(at).is_some_and(|&(start, end)| start <= first && last <= end)
}
