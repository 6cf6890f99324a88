//! The order in which a device accepts values.

use std::collections::BTreeMap;

use lexibus_codegen::facts::configuration::{Configuration, LeftOut, Setting};
use lexibus_codegen::facts::encoding;
use lexibus_codegen::ir::Value;

use crate::address::{Address, Network};
use crate::backup::{Backup, Skipped};
use crate::description::Description;
use crate::parameter::Parameter;
use crate::write::Write;

/// Returns the writes of a CANopen device in the order of CiA 301: PDOs are disabled, the communication parameters and
/// all other parameters are written, then the mappings and the parameters of PDOs, and PDOs are enabled again. The
/// parameters that the caller named come last. Other devices get the values in the order of the description.
///
/// `writes` contains the checked writes by address. Also returns the values that this order leaves out.
pub(super) fn ordered<'d>(
    description: &'d Description,
    backup: &Backup,
    node_id: Option<u8>,
    mut writes: BTreeMap<Address, Write<'d>>,
    include: &[Address],
) -> (Vec<Write<'d>>, Vec<Skipped>) {
    if description.network() == Network::Modbus {
        let parameters = description.parameters();
        return (parameters.filter_map(|parameter| writes.remove(&parameter.address())).collect(), Vec::new());
    }
    let mut chosen = backup.clone();
    chosen.entries.retain(|entry| writes.contains_key(&entry.address));
    let catalog = chosen.configured(description);
    let configuration = Configuration::of(&catalog.devices[description.position()]).unwrap_or_default();
    let mut ordered = Vec::new();
    for setting in phases(&configuration) {
        let Some(parameter) = description.object(setting.object.0, setting.object.1) else { continue };
        ordered.extend(write(parameter, setting, node_id));
    }
    for write in &ordered {
        writes.remove(&write.parameter().address());
    }
    let mut left_out = Vec::new();
    for (address, write) in writes {
        if include.contains(&address) {
            ordered.push(write);
        } else {
            left_out.push(Skipped::new(&write.parameter(), reason(&configuration, address)));
        }
    }
    (ordered, left_out)
}

/// Returns the reason why the order of writes leaves out a value.
fn reason(configuration: &Configuration, address: Address) -> &'static str {
    let object = address.object().map(|object| (object.index, object.sub_index));
    let found = configuration.left_out.iter().find(|(left_out, _)| Some(*left_out) == object);
    match found {
        Some((_, LeftOut::NotMapped)) => "the sub-index is above the number of mapped objects",
        Some((_, reason)) => reason.text(),
        None => "the value has no place in the order of writes",
    }
}

fn phases(configuration: &Configuration) -> impl Iterator<Item = &Setting> {
    let Configuration { disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos, .. } =
        configuration;
    [disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos].into_iter().flatten()
}

/// Converts a setting. The node-ID is added to the number of a formula.
fn write<'d>(parameter: Parameter<'d>, setting: &Setting, node_id: Option<u8>) -> Option<Write<'d>> {
    let ty = parameter.basic();
    let value = encoding::value(&setting.bytes, ty)?;
    let value = match value.as_int() {
        Some(number) if setting.adds_node_id => Value::Int(number + i128::from(node_id?)),
        _ => value,
    };
    let bytes = parameter.encode(&value, node_id).unwrap_or_else(|| setting.bytes.clone());
    Some(Write::unchecked(parameter, value, bytes))
}
