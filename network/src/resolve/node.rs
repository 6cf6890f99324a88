//! Resolves one node: the values that configure it, in the order in which they are written.

use std::rc::Rc;

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::facts::configuration::{Configuration, Setting};
use lexibus_codegen::ir::Device;
use lexibus_codegen::source::Span;

use super::cob_ids::CobIds;
use super::described::initial;
use super::pdo;
use super::versions;
use super::writer::Writer;
use crate::declared::DeclaredNode;
use crate::description::{expanded, Description};
use crate::model::{NetworkNode, Write, DISABLED};
use crate::syntax::At;

/// Default COB-ID of EMCY without the node-ID (CiA 301 7.5.2.17).
const EMCY: u32 = 0x80;

/// Resolves a node.
///
/// The order of the writes is that of `dcfgen`: heartbeat consumer, TIME, heartbeat producer, node guarding, error behavior, RPDOs,
/// TPDOs, and all other values in the order of the file.
pub(super) fn resolve(
    declared: &DeclaredNode,
    id: u8,
    description: Rc<Description>,
    cob_ids: &CobIds,
    diagnostics: &mut Diagnostics,
) -> NetworkNode {
    let device = description.device();
    let mut writer = Writer { device, id, writes: Vec::new(), diagnostics };
    let initial = |object| initial(device, object, id);
    writer.change((0x1012, 0), declared.time_cob_id.as_ref());
    writer.change((0x1017, 0), declared.heartbeat.as_ref());
    writer.change((0x100C, 0), declared.guard_time.as_ref());
    writer.change((0x100D, 0), declared.life_time_factor.as_ref());
    for behavior in &declared.error_behavior {
        let (sub_index, value) = behavior.value;
        writer.change((0x1029, sub_index), Some(&At::new(value, behavior.span)));
    }
    let pdos = pdo::resolve(declared, cob_ids, &mut writer);
    declared.parameters.iter().for_each(|parameter| writer.parameter(parameter));
    let mut writes = if declared.is_description_written { described(device, id) } else { Vec::new() };
    writes.append(&mut writer.writes);
    let versions = versions::resolve(device, declared, writer.diagnostics);
    let heartbeat = declared.heartbeat.clone();
    let of_description =
        At::new(initial((0x1017, 0)).and_then(|time| u16::try_from(time).ok()).unwrap_or(0), Span::MISSING);
    let mut node = NetworkNode {
        name: declared.name.clone(),
        id,
        upload_file: String::new(),
        software_file: declared.software_file.as_ref().map_or(String::new(), |file| file.value.clone()),
        software_version: declared.software_version,
        versions,
        device_type: number(initial((0x1000, 0))),
        identity: identity(device, declared, id),
        emcy_cob_id: match device.entry(0x1014, 0) {
            Some(_) => initial((0x1014, 0)).map_or(EMCY + u32::from(id), |cob_id| cob_id as u32),
            None => DISABLED,
        },
        heartbeat: heartbeat.unwrap_or(of_description),
        heartbeat_multiplier: declared.heartbeat_multiplier.clone(),
        guard_time: 0,
        life_time_factor: 0,
        pdos,
        writes,
        assignment: 0,
        restore: declared.restore,
        store: declared.store,
        description: Rc::clone(&description),
    };
    node.guard_time = node.value((0x100C, 0)).and_then(|time| u16::try_from(time).ok()).unwrap_or(0);
    node.life_time_factor = node.value((0x100D, 0)).and_then(|factor| u8::try_from(factor).ok()).unwrap_or(0);
    node.assignment = assignment(declared, &node);
    let folder = declared.upload_folder.as_ref().map(|folder| expanded(&folder.value, &mut Vec::new()));
    let file = format!("{}.bin", node.file_stem());
    node.upload_file = folder.unwrap_or_default().join(file).to_string_lossy().into_owned();
    node
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

fn number(value: Option<i128>) -> u32 {
    value.and_then(|value| u32::try_from(value).ok()).unwrap_or(0)
}

/// Returns the expected identity. Numbers in the header of the description take precedence over the object 0x1018.
fn identity(device: &Device, declared: &DeclaredNode, id: u8) -> [u32; 4] {
    let of_object = |sub_index| number(initial(device, (0x1018, sub_index), id));
    let header = &device.identity;
    [
        header.vendor_id.unwrap_or_else(|| of_object(1)),
        header.product_code.unwrap_or_else(|| of_object(2)),
        declared.revision_number.or(header.revision_number).unwrap_or_else(|| of_object(3)),
        declared.serial_number.or(header.serial_number).unwrap_or_else(|| of_object(4)),
    ]
}

/// Returns the bits of the node in 0x1F81 (CiA 302-2).
fn assignment(declared: &DeclaredNode, node: &NetworkNode) -> u32 {
    let flags = [
        (declared.boot, 0x04),
        (declared.mandatory, 0x08),
        (!declared.reset_communication, 0x10),
        (declared.software_version != 0, 0x20),
        (declared.software_file.is_some(), 0x40),
        (declared.restore != 0, 0x80),
    ];
    let bits = flags.iter().filter(|(is_set, _)| *is_set).fold(1, |bits, (_, bit)| bits | bit);
    bits | u32::from(declared.retry_factor) << 8 | u32::from(node.guard_time) << 16
}
