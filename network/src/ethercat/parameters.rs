//! Values of `parameters` for the objects of a SubDevice and of its modules.

use lexibus_codegen::diagnostics::{Diagnostic, Diagnostics};
use lexibus_codegen::ir::{Bus, Device};

use super::declared::{DeclaredModule, DeclaredSubDevice};
use super::modules::Plugged;
use crate::declared::{DeclaredParameter, ObjectName};
use crate::resolve::{named, no_name, Writer};
use crate::values::Write;

/// Looks up the objects of `parameters`, and converts their values: first those of the SubDevice, then those of its modules, sorted by
/// slot. `modules` contains the objects of the modules in `plugged`.
pub(super) fn resolve(
    device: &Device,
    plugged: &[Plugged<'_>],
    modules: &[Device],
    declared: &DeclaredSubDevice,
    diagnostics: &mut Diagnostics,
) -> Vec<Write> {
    let mut writes = Vec::new();
    for parameter in &declared.parameters {
        match misplaced(device, plugged, modules, parameter) {
            Some(found) => diagnostics.push(found),
            None => write(owner(device, modules, parameter), parameter, &mut writes, diagnostics),
        }
    }
    let declared: &[DeclaredModule] = declared.modules.as_ref().map_or(&[], |modules| &modules.value);
    for (plugged, module) in plugged.iter().zip(modules) {
        let declared = declared.iter().filter(|declared| declared.slot.value == plugged.number);
        for parameter in declared.flat_map(|declared| &declared.parameters) {
            write(module, parameter, &mut writes, diagnostics);
        }
    }
    writes
}

fn write(device: &Device, parameter: &DeclaredParameter, writes: &mut Vec<Write>, diagnostics: &mut Diagnostics) {
    let mut writer = Writer { device, bus: Bus::EtherCat, id: 0, writes: std::mem::take(writes), diagnostics };
    writer.parameter(parameter);
    *writes = writer.writes;
}

/// Returns the first module that contains the index of a parameter of the SubDevice, if the device does not contain this
/// index. Otherwise, or if the parameter is given by name, returns the device.
fn owner<'d>(device: &'d Device, modules: &'d [Device], parameter: &DeclaredParameter) -> &'d Device {
    let of_module = match parameter.object.value {
        ObjectName::Address(index, _) if device.object(index).is_none() => {
            modules.iter().find(|module| module.object(index).is_some())
        }
        _ => None,
    };
    of_module.unwrap_or(device)
}

/// Returns a diagnostic for a parameter of the SubDevice whose name only modules have. The help shows the table of the first module that
/// has the name.
fn misplaced(
    device: &Device,
    plugged: &[Plugged<'_>],
    modules: &[Device],
    parameter: &DeclaredParameter,
) -> Option<Diagnostic> {
    let ObjectName::Name(name) = &parameter.object.value else { return None };
    let (plugged, _) = plugged.iter().zip(modules).find(|(_, module)| !named(module, name).is_empty())?;
    if !named(device, name).is_empty() {
        return None;
    }
    let Plugged { number, module, .. } = plugged;
    let table = format!("{number} = {{ module = \"{}\", parameters = {{ \"{name}\" = … }} }}", module.name);
    Some(no_name(device, &parameter.object, name).help(format!("move the value to the table of a module: `{table}`")))
}
