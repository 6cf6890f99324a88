//! The values of `parameters`: of the objects of a SubDevice and of its modules.

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::{Bus, Device, Group, GroupKind};

use super::declared::DeclaredSubDevice;
use super::modules::Plugged;
use crate::declared::ObjectName;
use crate::resolve::Writer;
use crate::values::Write;

/// Looks up the objects of `parameters`, and converts their values. An address that the device does not have can be that of a module's
/// object.
pub(super) fn resolve(
    device: &Device,
    plugged: &[Plugged<'_>],
    declared: &DeclaredSubDevice,
    diagnostics: &mut Diagnostics,
) -> Vec<Write> {
    let mut writes = Vec::new();
    for parameter in &declared.parameters {
        let of_module = match parameter.object.value {
            ObjectName::Address(index, _) if device.object(index).is_none() => {
                plugged.iter().find_map(|plugged| object_in_slot(*plugged, index))
            }
            _ => None,
        };
        let device = of_module.as_ref().unwrap_or(device);
        let mut writer = Writer { device, bus: Bus::EtherCat, id: 0, writes, diagnostics };
        writer.parameter(parameter);
        writes = writer.writes;
    }
    writes
}

/// Returns a device with only the object of a module that has an index in its slot.
fn object_in_slot(plugged: Plugged<'_>, index: u16) -> Option<Device> {
    let offsets = plugged.objects();
    let in_slot = |group: &Group| {
        group.index().map(|index| offsets.apply(index, group.depends_on_slot, group.depends_on_slot_group))
    };
    let group = plugged.module.groups.iter().find(|group| in_slot(group) == Some(index))?;
    let GroupKind::Object { code, category, .. } = group.kind else { return None };
    let group = Group { kind: GroupKind::Object { index, code, category }, ..group.clone() };
    let module = plugged.module;
    Some(Device { name: module.name.clone(), types: module.types.clone(), groups: vec![group], ..Device::default() })
}
