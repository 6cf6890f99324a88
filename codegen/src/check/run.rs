//! Runs the lints of the list.

use super::context::{Context, PdoOwner};
use super::lint::{Lint, Run};
use super::list::{LINTS, WITHOUT_FILE};
use crate::diagnostics::Diagnostics;
use crate::ir::owner::Owner;
use crate::ir::{Catalog, Device, Format, Group, Module};

/// Runs all lints on a resolved catalog.
pub fn check(catalog: &Catalog, diagnostics: &mut Diagnostics) {
    run(LINTS, catalog, diagnostics);
}

impl Lint {
    /// Runs only this lint on a resolved catalog.
    pub fn check(&self, catalog: &Catalog, diagnostics: &mut Diagnostics) {
        run(std::slice::from_ref(self), catalog, diagnostics);
    }

    /// Returns whether the lint runs: it applies to the format or was requested, and at least one of its codes is enabled.
    fn is_active(&self, format: Format, diagnostics: &Diagnostics) -> bool {
        let is_requested = || self.on_request && self.codes.iter().any(|code| diagnostics.asks_for(code));
        (self.formats.contains(&format) || is_requested()) && self.codes.iter().any(|code| diagnostics.wants(code))
    }
}

fn run(lints: &[Lint], catalog: &Catalog, diagnostics: &mut Diagnostics) {
    // The first file describes the devices. The other files are overlays, or files to which the first file refers.
    let format = catalog.files.first().map_or(WITHOUT_FILE, |file| file.format);
    let lints: Vec<&Lint> = lints.iter().filter(|lint| lint.is_active(format, diagnostics)).collect();
    for device in &catalog.devices {
        check_device(&lints, device, &catalog.modules, format, diagnostics);
    }
    for module in &catalog.modules {
        check_module(&lints, module, diagnostics);
    }
    records(&lints, catalog, diagnostics);
    for lint in lints {
        if let Run::Catalog(run) = lint.run {
            run(catalog, diagnostics);
        }
    }
}

fn check_device(lints: &[&Lint], device: &Device, modules: &[Module], format: Format, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    let context = Context { device, modules, format, owner };
    for lint in lints.iter().filter(|lint| lint.needs.is_none_or(|need| need.is_met(device))) {
        match lint.run {
            Run::Device(run) => run(&context, diagnostics),
            Run::Items(run) | Run::ItemsAndRecords(run) => run(owner, diagnostics),
            Run::Pdos(run) => run(&PdoOwner { data: &device.process_data, owner }, diagnostics),
            Run::Records(_) | Run::Catalog(_) => {}
        }
    }
}

fn check_module(lints: &[&Lint], module: &Module, diagnostics: &mut Diagnostics) {
    let groups = [module.fixed_objects.as_slice(), module.groups.as_slice()];
    let owner = Owner { types: &module.types, groups: &groups };
    for lint in lints {
        match lint.run {
            Run::Items(run) | Run::ItemsAndRecords(run) => run(owner, diagnostics),
            Run::Pdos(run) => run(&PdoOwner { data: &module.process_data, owner }, diagnostics),
            Run::Device(_) | Run::Records(_) | Run::Catalog(_) => {}
        }
    }
}

/// Runs the lints for parameter records of PROFINET. Other lints on items are not run, because several parameters with different
/// types and limits can share one list of named values.
fn records(lints: &[&Lint], catalog: &Catalog, diagnostics: &mut Diagnostics) {
    let of_submodules = catalog.submodules.iter().map(|submodule| submodule.records.as_slice());
    let settings = catalog.devices.iter().filter_map(|device| device.profinet.as_ref());
    let blocks = settings.flat_map(|settings| &settings.vendor_blocks);
    let all: Vec<&[Group]> = of_submodules.chain(blocks.map(|block| std::slice::from_ref(&block.record))).collect();
    for records in all {
        let groups = [records];
        for lint in lints {
            match lint.run {
                Run::ItemsAndRecords(run) => run(Owner { types: &catalog.types, groups: &groups }, diagnostics),
                Run::Records(run) => run(records, diagnostics),
                _ => {}
            }
        }
    }
}
