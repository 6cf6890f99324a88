//! Resolves one node: determines the values that configure it, in the order in which they are written.

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::facts::configuration::{Configuration, Setting};
use lexibus_codegen::ir::{Bus, Device};
use lexibus_codegen::source::Span;

use super::cob_ids::CobIds;
use super::described_node::DescribedNode;
use super::pdo;
use super::pdo_values::{configured, report_multiplexed};
use super::versions;
use super::writer::Writer;
use crate::declared::DeclaredNode;
use crate::description::{expanded, Description};
use crate::model::{
    file_stem, NetworkNode, BOOT, DISABLED, KEEP_RUNNING, MANDATORY, RESTORE, UPDATE_SOFTWARE, VERIFY_SOFTWARE,
};
use crate::syntax::At;
use crate::values::{Values, Write};

/// Default COB-ID of EMCY without the node-ID (CiA 301 7.5.2.17).
const EMCY: u32 = 0x80;

/// Resolves a node.
///
/// The configured values of the description come first, unless `is_description_written` is false. The order of the other
/// writes is that of `dcfgen`: heartbeat consumer, TIME, heartbeat producer, node guarding, error behavior, RPDOs, TPDOs,
/// and `parameters` in the order of the file. `heartbeat::monitor_master` adds the heartbeat consumer.
pub(super) fn resolve(node: DescribedNode<'_>, cob_ids: &CobIds, diagnostics: &mut Diagnostics) -> NetworkNode {
    let DescribedNode { declared, id, description, parameters } = node;
    let writes = writes(declared, id, &description, cob_ids, parameters, diagnostics);
    let values = Values { device: description.device(), id, writes: &writes };
    let versions = versions::resolve(values.device, declared, diagnostics);
    let pdos = configured(declared, values);
    report_multiplexed(declared, &pdos, values, diagnostics);
    let guard_time = values.number((0x100C, 0)).unwrap_or(0);
    let heartbeat_at = declared.heartbeat.as_ref().map_or(Span::MISSING, |heartbeat| heartbeat.span);
    NetworkNode {
        name: declared.name.clone(),
        id,
        upload_file: upload_file(declared),
        software_file: declared.software_file.as_ref().map_or(String::new(), |file| file.value.clone()),
        software_version: declared.software_version,
        versions,
        device_type: values.number((0x1000, 0)).unwrap_or(0),
        identity: identity(declared, values),
        emcy_cob_id: match values.device.entry(0x1014, 0) {
            Some(_) => values.number((0x1014, 0)).unwrap_or(EMCY + u32::from(id)),
            None => DISABLED,
        },
        heartbeat: At::new(values.number((0x1017, 0)).unwrap_or(0), values.set_at((0x1017, 0)).or(heartbeat_at)),
        heartbeat_multiplier: declared.heartbeat_multiplier.clone(),
        guard_time,
        life_time_factor: values.number((0x100D, 0)).unwrap_or(0),
        pdos,
        assignment: assignment(declared, guard_time),
        restore: declared.restore,
        store: declared.store,
        writes,
        description,
    }
}

/// Returns the values that configure a node, without the entries of 0x1016 that `heartbeat::monitor_master` adds.
fn writes(
    declared: &DeclaredNode,
    id: u8,
    description: &Description,
    cob_ids: &CobIds,
    parameters: Vec<Write>,
    diagnostics: &mut Diagnostics,
) -> Vec<Write> {
    let device = description.device();
    let writes = if declared.is_description_written { described(device, id) } else { Vec::new() };
    let mut writer = Writer { device, bus: Bus::CanOpen, id, writes, diagnostics };
    writer.change((0x1012, 0), declared.time_cob_id.as_ref());
    writer.change((0x1017, 0), declared.heartbeat.as_ref());
    writer.change((0x100C, 0), declared.guard_time.as_ref());
    writer.change((0x100D, 0), declared.life_time_factor.as_ref());
    for behavior in &declared.error_behavior {
        let (sub_index, value) = behavior.value;
        writer.change((0x1029, sub_index), Some(&At::new(value, behavior.span)));
    }
    pdo::write(declared, cob_ids, &mut writer);
    writer.writes.extend(parameters);
    writer.writes
}

/// Returns the path under which the master finds the node's concise DCF.
fn upload_file(declared: &DeclaredNode) -> String {
    let folder = declared.upload_folder.as_ref().map(|folder| expanded(&folder.value, &mut Vec::new()));
    let file = format!("{}.bin", file_stem(&declared.name.value));
    folder.unwrap_or_default().join(file).to_string_lossy().into_owned()
}

/// Returns the writes of the values that the description configures.
fn described(device: &Device, id: u8) -> Vec<Write> {
    let Some(configuration) = Configuration::of(device) else { return Vec::new() };
    let Configuration { disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos, .. } =
        configuration;
    let settings =
        [disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos].into_iter().flatten();
    let write = |setting: Setting| {
        let number = setting.bytes.iter().rev().fold(0u64, |number, byte| number.wrapping_shl(8) | u64::from(*byte));
        let bytes = match setting.adds_node_id {
            true => (number + u64::from(id)).to_le_bytes()[..setting.bytes.len().min(8)].to_vec(),
            false => setting.bytes,
        };
        Write { object: setting.object, value: None, bytes, span: Span::MISSING }
    };
    settings.map(write).collect()
}

/// Returns the expected identity. The precedence of the sources is: network file (revision number and serial number), header
/// of the description, object 0x1018.
fn identity(declared: &DeclaredNode, values: Values<'_>) -> [u32; 4] {
    let of_object = |sub_index| values.number((0x1018, sub_index)).unwrap_or(0);
    let header = &values.device.identity;
    [
        header.vendor_id.unwrap_or_else(|| of_object(1)),
        header.product_code.unwrap_or_else(|| of_object(2)),
        declared.revision_number.or(header.revision_number).unwrap_or_else(|| of_object(3)),
        declared.serial_number.or(header.serial_number).unwrap_or_else(|| of_object(4)),
    ]
}

/// Returns the value of 0x1F81 for the node (CiA 302-2).
fn assignment(declared: &DeclaredNode, guard_time: u16) -> u32 {
    let flags = [
        (declared.boot, BOOT),
        (declared.mandatory, MANDATORY),
        (!declared.reset_communication, KEEP_RUNNING),
        (declared.software_version != 0, VERIFY_SOFTWARE),
        (declared.software_file.is_some(), UPDATE_SOFTWARE),
        (declared.restore != 0, RESTORE),
    ];
    let bits = flags.iter().filter(|(is_set, _)| *is_set).fold(1, |bits, (_, bit)| bits | bit);
    bits | u32::from(declared.retry_factor) << 8 | u32::from(guard_time) << 16
}
