//! The values of `parameters`: of the objects of a SubDevice and of its modules.

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::{Bus, Device};

use super::declared::{DeclaredModule, DeclaredSubDevice};
use super::modules::Plugged;
use crate::declared::{DeclaredParameter, ObjectName};
use crate::resolve::Writer;
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
    let of_subdevice = declared.parameters.iter().map(|parameter| (owner(device, modules, parameter), parameter));
    let declared: &[DeclaredModule] = declared.modules.as_ref().map_or(&[], |modules| &modules.value);
    let of_modules = plugged.iter().zip(modules).flat_map(|(plugged, module)| {
        let declared = declared.iter().filter(|declared| declared.slot.value == plugged.number);
        declared.flat_map(|declared| &declared.parameters).map(move |parameter| (module, parameter))
    });
    let mut writes = Vec::new();
    for (device, parameter) in of_subdevice.chain(of_modules) {
        let mut writer = Writer { device, bus: Bus::EtherCat, id: 0, writes, diagnostics };
        writer.parameter(parameter);
        writes = writer.writes;
    }
    writes
}

/// Returns the module that contains the object of a parameter of the SubDevice, if the device does not contain an object with this
/// address. In all other cases, returns the device.
fn owner<'d>(device: &'d Device, modules: &'d [Device], parameter: &DeclaredParameter) -> &'d Device {
    let of_module = match parameter.object.value {
        ObjectName::Address(index, _) if device.object(index).is_none() => {
            modules.iter().find(|module| module.object(index).is_some())
        }
        _ => None,
    };
    of_module.unwrap_or(device)
}
