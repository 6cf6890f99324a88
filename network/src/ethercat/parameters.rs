//! The values of `parameters`: of the objects of a SubDevice and of its modules.

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::{Bus, Device};

use super::declared::DeclaredSubDevice;
use crate::declared::ObjectName;
use crate::resolve::Writer;
use crate::values::Write;

/// Looks up the objects of `parameters`, and converts their values. An address that the device does not have can be that of a module's
/// object. `modules` contains the objects of the modules.
pub(super) fn resolve(
    device: &Device,
    modules: &[Device],
    declared: &DeclaredSubDevice,
    diagnostics: &mut Diagnostics,
) -> Vec<Write> {
    let mut writes = Vec::new();
    for parameter in &declared.parameters {
        let of_module = match parameter.object.value {
            ObjectName::Address(index, _) if device.object(index).is_none() => {
                modules.iter().find(|module| module.object(index).is_some())
            }
            _ => None,
        };
        let device = of_module.unwrap_or(device);
        let mut writer = Writer { device, bus: Bus::EtherCat, id: 0, writes, diagnostics };
        writer.parameter(parameter);
        writes = writer.writes;
    }
    writes
}
