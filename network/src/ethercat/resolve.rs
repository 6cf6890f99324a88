//! Resolves a segment: reads the descriptions, and computes the configuration of each SubDevice.

use std::collections::HashMap;
use std::rc::Rc;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::{Bus, Device, Direction};
use lexibus_codegen::source::{Source, Span};

use super::assignment::assign;
use super::declared::{DeclaredSegment, DeclaredSubDevice};
use super::modules::{plug, Plugged};
use super::segment::{Identity, PluggedModule, Segment, SubDevice};
use super::startup::Startup;
use super::{clock, parameters, process_data, sync_managers};
use crate::description::{Description, Descriptions, DeviceReference};

/// Maximum number of SubDevices: their configured station addresses have 16 bits.
const MAX_SUBDEVICES: usize = 65535;

/// Resolves a declared segment. SubDevices without a usable description are reported and left out.
pub(crate) fn resolve(source: &Source, declared: &DeclaredSegment, diagnostics: &mut Diagnostics) -> Segment {
    check_aliases(&declared.subdevices, diagnostics);
    if let Some(subdevice) = declared.subdevices.get(MAX_SUBDEVICES) {
        let message = format!("the segment has more than {MAX_SUBDEVICES} SubDevices");
        diagnostics.push(Diagnostic::new(&codes::NETWORK_VALUE, subdevice.name.span, message));
    }
    let cycle_time = declared.cycle.as_ref().map(|cycle| u64::from(cycle.value) * 1000);
    let mut descriptions = Descriptions::new(source, Bus::EtherCat);
    let mut subdevices = Vec::new();
    for (declared, position) in declared.subdevices.iter().zip(0..=u16::MAX) {
        if let Some(description) = descriptions.of(&reference(declared), diagnostics) {
            subdevices.push(subdevice(declared, position, description, cycle_time, diagnostics));
        }
    }
    let output_bytes = place(&mut subdevices, Direction::Receive, 0);
    let input_bytes = place(&mut subdevices, Direction::Transmit, output_bytes);
    Segment { cycle_time, output_bytes, input_bytes, subdevices }
}

fn reference(declared: &DeclaredSubDevice) -> DeviceReference<'_> {
    DeviceReference {
        title: format!("the SubDevice `{}`", declared.name.value),
        span: declared.name.span,
        device: declared.device.as_ref(),
        model: declared.model.as_ref(),
        folders: &[],
        overlays: &declared.overlays,
    }
}

fn check_aliases(subdevices: &[DeclaredSubDevice], diagnostics: &mut Diagnostics) {
    let mut known: HashMap<u16, (&str, Span)> = HashMap::new();
    for subdevice in subdevices {
        let Some(alias) = subdevice.alias.as_ref().filter(|alias| alias.value != 0) else { continue };
        if let Some((other, span)) = known.insert(alias.value, (&subdevice.name, alias.span)) {
            let message =
                format!("the SubDevice `{}` has the alias {} of `{other}`", subdevice.name.value, alias.value);
            let found = Diagnostic::new(&codes::ALIAS_TWICE, alias.span, message);
            diagnostics.push(found.note_at(span, format!("`{other}` is here")).help("use another alias"));
        }
    }
}

fn subdevice(
    declared: &DeclaredSubDevice,
    position: u16,
    description: Rc<Description>,
    cycle_time: Option<u64>,
    diagnostics: &mut Diagnostics,
) -> SubDevice {
    let device = description.device();
    let assigned = assign(device, declared, diagnostics);
    let plugged = plug(description.catalog(), device, declared, diagnostics);
    let placed = process_data::place(device, &assigned, &plugged);
    process_data::check(device, &placed, assignment_at(declared), diagnostics);
    let module_objects: Vec<Device> = plugged.iter().map(|plugged| plugged.objects_in_slot()).collect();
    let parameters = parameters::resolve(device, &plugged, &module_objects, declared, diagnostics);
    let sync_managers = sync_managers::sync_managers(device, &placed);
    let startup = Startup { device, plugged: &plugged, placed: &placed, parameters: &parameters };
    let (startup, fmmus) = (startup.commands(), sync_managers::fmmus(device, &placed));
    SubDevice {
        name: declared.name.value.clone(),
        position,
        alias: declared.alias.as_ref().map_or(0, |alias| alias.value),
        identity: Identity {
            vendor_id: device.identity.vendor_id,
            product_code: device.identity.product_code,
            revision_number: declared.revision_number.or(device.identity.revision_number),
        },
        modules: plugged.iter().map(shown_module).collect(),
        module_objects,
        startup,
        fmmus,
        sync_managers,
        pdos: process_data::assigned_pdos(&placed),
        dc: clock::resolve(device, declared, cycle_time, diagnostics),
        description: Rc::clone(&description),
    }
}

/// Returns the location for diagnostics of the process data: the location of the first of these that exists: `pdos`,
/// `modules`, the SubDevice's name.
fn assignment_at(declared: &DeclaredSubDevice) -> Span {
    let pdos = declared.pdos.as_ref().map(|pdos| pdos.span);
    pdos.or(declared.modules.as_ref().map(|modules| modules.span)).unwrap_or(declared.name.span)
}

fn shown_module(plugged: &Plugged<'_>) -> PluggedModule {
    let Plugged { number, module, .. } = plugged;
    PluggedModule { slot: *number, ident: module.number, name: module.name.to_string() }
}

/// Gives the FMMUs of one direction consecutive logical addresses from `start`. Returns their total length in bytes.
fn place(subdevices: &mut [SubDevice], direction: Direction, start: u32) -> u32 {
    let fmmus = subdevices.iter_mut().flat_map(|subdevice| &mut subdevice.fmmus);
    fmmus.filter(|fmmu| fmmu.direction == direction).fold(0, |bytes, fmmu| {
        fmmu.logical_address = start + bytes;
        bytes + u32::from(fmmu.length)
    })
}
