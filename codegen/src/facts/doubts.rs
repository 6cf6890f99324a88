//! Collects the ambiguities of a device and of its definitions.

use crate::collections::HashSet;
use crate::ir::{Catalog, CompactString, Device, Doubt, Doubts};

/// Returns the ambiguities that concern the device as a whole, its models, types, code tables, state machines, procedures,
/// process images and composites, and the types of its modules. For a PROFINET device, also returns those of the types of all
/// submodules. Each ambiguity has the name of its element, which is empty for the device. The order is that of the source. An
/// ambiguity of a definition that became several types occurs once, with the first of these types.
pub fn of_device<'d>(catalog: &'d Catalog, device: &'d Device) -> Vec<(&'d str, &'d Doubt)> {
    let of_modules = device.accepted_modules(&catalog.modules).flat_map(|module| &module.types);
    let of_submodules = catalog.types.iter().filter(|_| device.profinet.is_some());
    let types = device.types.iter().chain(of_modules).chain(of_submodules);
    let models = device.variants.iter().map(|model| (&model.name, &model.doubts));
    let lists = models
        .chain(types.map(|definition| (&definition.name, &definition.doubts)))
        .chain(device.code_tables.iter().map(|table| (&table.name, &table.doubts)))
        .chain(device.machines.iter().map(|machine| (&machine.name, &machine.doubts)))
        .chain(device.procedures.iter().map(|procedure| (&procedure.name, &procedure.doubts)))
        .chain(device.process_data.images.iter().map(|image| (&image.name, &image.doubts)))
        .chain(device.composites.iter().map(|composite| (&composite.name, &composite.doubts)));
    let named =
        |(name, doubts): (&'d CompactString, &'d Doubts)| doubts.iter().map(move |doubt| (name.as_str(), doubt));
    let mut all: Vec<_> = device.doubts.iter().map(|doubt| ("", doubt)).chain(lists.flat_map(named)).collect();
    let mut known = HashSet::default();
    all.retain(|(_, doubt)| known.insert(*doubt));
    all.sort_by_key(|(_, doubt)| (doubt.origin.span.file, doubt.origin.span.start));
    all
}
