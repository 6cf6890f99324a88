//! Writes FMMUs, sync managers and sync units.

use super::options::Area;
use super::text::hex;
use super::Context;
use crate::xml::Xml;
use lexibus_codegen::ir::{CompactString, Device, EtherCatSettings, Fmmu, SyncManager, SyncManagerPurpose};
use lexibus_codegen::source::Origin;

/// Writes FMMUs, sync managers and sync units. If the source has no sync managers, the export derives them from the
/// memory areas in the options. If the source also has no FMMUs, the export derives them from these sync managers.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, device: &Device, settings: &EtherCatSettings) {
    let declared = &device.process_data.sync_managers;
    let given = if declared.is_empty() { given(context) } else { Vec::new() };
    let managers = if declared.is_empty() { &given } else { declared };
    let derived: Vec<Fmmu> =
        if settings.fmmus.is_empty() { given.iter().filter_map(mapped).collect() } else { Vec::new() };
    for fmmu in settings.fmmus.iter().chain(&derived) {
        xml.open("Fmmu");
        xml.flag("OpOnly", fmmu.op_only, "true");
        xml.optional("Sm", fmmu.sync_manager);
        xml.optional("Su", fmmu.sync_unit);
        xml.content(&fmmu.purpose);
        xml.close();
    }
    managers.iter().for_each(|manager| sync_manager(xml, manager));
    for unit in &settings.sync_units {
        xml.open("Su");
        xml.flag("SeparateSu", unit.separate, "true");
        xml.flag("SeparateFrame", unit.separate_frame, "true");
        xml.flag("DependOnInputState", unit.depends_on_input_state, "true");
        xml.flag("FrameRepeatSupport", unit.frame_repeat, "true");
        xml.content(&unit.name);
        xml.close();
    }
}

fn sync_manager(xml: &mut Xml, manager: &SyncManager) {
    xml.open("Sm");
    xml.optional("MinSize", manager.size_range.0);
    xml.optional("MaxSize", manager.size_range.1);
    xml.optional("DefaultSize", manager.default_size);
    xml.optional("StartAddress", (manager.start_address != 0).then(|| hex(manager.start_address, 4)));
    xml.optional("ControlByte", (manager.control != 0).then(|| hex(manager.control, 2)));
    xml.flag("Enable", manager.enable, "1");
    xml.flag("OpOnly", manager.op_only, "true");
    xml.flag("Virtual", manager.is_virtual, "true");
    xml.content(&manager.label);
    xml.close();
}

/// Returns the sync managers for the memory areas in the options, numbered from 0.
fn given(context: &Context<'_>) -> Vec<SyncManager> {
    let options = context.options;
    // The control byte (ETG.1000.4, 6.7.2) selects the mode (mailbox or three buffers), the direction, and an interrupt
    // for the host.
    let areas = [
        (SyncManagerPurpose::MailboxOut, 0x26, options.mailbox_out()),
        (SyncManagerPurpose::MailboxIn, 0x22, options.mailbox_in()),
        (SyncManagerPurpose::Outputs, 0x24, options.outputs()),
        (SyncManagerPurpose::Inputs, 0x20, options.inputs()),
    ];
    let given = areas.into_iter().filter_map(|(purpose, control, area)| Some((purpose, control, area?)));
    let manager = |(number, (purpose, control, Area { start, length }))| SyncManager {
        number,
        purpose,
        label: CompactString::const_new(purpose.label()),
        start_address: start,
        default_size: length,
        size_range: (None, None),
        control,
        enable: true,
        op_only: false,
        is_virtual: false,
        origin: Origin::default(),
    };
    (0..).zip(given).map(manager).collect()
}

/// Returns the FMMU for a process data sync manager, or `None` for a mailbox sync manager.
fn mapped(manager: &SyncManager) -> Option<Fmmu> {
    let is_mapped = matches!(manager.purpose, SyncManagerPurpose::Outputs | SyncManagerPurpose::Inputs);
    is_mapped.then(|| Fmmu { purpose: manager.label.clone(), ..Fmmu::default() })
}
