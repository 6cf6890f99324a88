//! The order in which a device accepts values.

use std::collections::{BTreeMap, BTreeSet};

use lexibus_codegen::facts::configuration::{Configuration, LeftOut, Setting, MAX_ENTRIES};
use lexibus_codegen::facts::encoding;
use lexibus_codegen::facts::pdo::is_mapping;
use lexibus_codegen::ir::Value;

use crate::address::{Address, Network};
use crate::backup::{Backup, Skipped};
use crate::description::Description;
use crate::parameter::Parameter;
use crate::protection::Protection;
use crate::write::Write;

/// Returns the writes in the order in which the device gets them. On CANopen, the PDOs are disabled first and enabled last,
/// because a mapping can be changed only while the PDO is disabled (CiA 301). Between these steps, the order is:
/// communication parameters except those of PDOs, all other parameters, PDO mappings, communication parameters of PDOs.
///
/// On Modbus, the order is that of the description. Protected parameters that the caller named come last, and among them
/// those that set the node-ID or the bit rate. Objects of PDOs keep their order.
///
/// The values of a PDO are left out if one of them is refused, or if the COB-ID or a mapping entry is missing.
///
/// `writes` contains the checked writes by address. The second list contains the values that this order leaves out.
pub(super) fn ordered<'d>(
    description: &'d Description,
    backup: &Backup,
    node_id: Option<u8>,
    mut writes: BTreeMap<Address, Write<'d>>,
    include: &[Address],
) -> (Vec<Write<'d>>, Vec<Skipped>) {
    if description.network() == Network::Modbus {
        let parameters = description.parameters();
        let mut list: Vec<_> = parameters.filter_map(|parameter| writes.remove(&parameter.address())).collect();
        list.sort_by_key(|write| rank(&write.parameter()));
        return (list, Vec::new());
    }
    let mut chosen = backup.clone();
    chosen.entries.retain(|entry| writes.contains_key(&entry.address));
    let catalog = chosen.configured(description);
    let configuration = Configuration::of(&catalog.devices[description.position()]).unwrap_or_default();
    let settings: Vec<(Parameter<'d>, &Setting)> = phases(&configuration)
        .filter_map(|setting| Some((description.object(setting.object.0, setting.object.1)?, setting)))
        .collect();
    let incomplete = incomplete_pdos(description, backup, &writes, &settings);
    let is_incomplete = |index: u16| pdo(index).is_some_and(|pdo| incomplete.contains(&pdo));
    let mut ordered = Vec::new();
    for (parameter, setting) in settings.into_iter().filter(|(_, setting)| !is_incomplete(setting.object.0)) {
        ordered.extend(write(parameter, setting, node_id));
    }
    for write in &ordered {
        writes.remove(&write.parameter().address());
    }
    let mut left_out = Vec::new();
    for (address, write) in writes {
        if address.object().is_some_and(|object| is_incomplete(object.index)) {
            left_out.push(Skipped::failed(
                &write.parameter(),
                "a value of the PDO is missing or refused, so the PDO is not changed",
            ));
        } else if include.contains(&address) && address.object().is_none_or(|object| pdo(object.index).is_none()) {
            ordered.push(write);
        } else {
            left_out.push(Skipped::new(&write.parameter(), reason(&configuration, address)));
        }
    }
    ordered.sort_by_key(|write| rank(&write.parameter()));
    (ordered, left_out)
}

/// Returns the PDOs that are not restored, as the indices of their communication parameters. A PDO is not restored if one of
/// its values is refused. It is not restored either if the backup lacks a value that `settings` needs, or if a mapped entry
/// has no value.
fn incomplete_pdos(
    description: &Description,
    backup: &Backup,
    writes: &BTreeMap<Address, Write<'_>>,
    settings: &[(Parameter<'_>, &Setting)],
) -> BTreeSet<u16> {
    let is_writable = |parameter: &Parameter<'_>| parameter.access().writable();
    let missing = settings.iter().filter(|(parameter, _)| is_writable(parameter));
    let missing = missing.filter(|(parameter, _)| !writes.contains_key(&parameter.address()));
    let missing = missing.map(|(_, setting)| setting.object.0);
    let refused = backup.entries.iter().map(|entry| entry.address).filter(|address| !writes.contains_key(address));
    let refused = refused.filter(|address| description.at(*address).is_none_or(|parameter| is_writable(&parameter)));
    let refused = refused.filter_map(|address| Some(address.object()?.index));
    let set: BTreeSet<(u16, u8)> = settings.iter().map(|(_, setting)| setting.object).collect();
    let is_unmapped = |index: u16, sub_index: u8| {
        let parameter = description.object(index, sub_index);
        !set.contains(&(index, sub_index)) && parameter.is_none_or(|parameter| is_writable(&parameter))
    };
    let unmapped = settings.iter().filter(|(_, setting)| is_mapping(setting.object.0) && setting.object.1 == 0);
    let unmapped = unmapped.filter_map(|(_, setting)| Some((setting.object.0, *setting.bytes.first()?)));
    let unmapped = unmapped.filter(|&(index, number)| {
        number <= MAX_ENTRIES && (1..=number).any(|sub_index| is_unmapped(index, sub_index))
    });
    missing.chain(refused).chain(unmapped.map(|(index, _)| index)).filter_map(pdo).collect()
}

/// Returns the index of the communication parameters of the PDO to which an object belongs, or `None` if it belongs to
/// no PDO.
pub(super) fn pdo(index: u16) -> Option<u16> {
    match index {
        0x1400..=0x15FF | 0x1800..=0x19FF => Some(index),
        0x1600..=0x17FF | 0x1A00..=0x1BFF => Some(index - 0x200),
        _ => None,
    }
}

/// Returns a number for sorting: protected parameters come after all others, and the node-ID and the bit rate come
/// last. Objects of PDOs count as not protected, so that their order doesn't change.
fn rank(parameter: &Parameter<'_>) -> u8 {
    let is_of_pdo = parameter.address().object().is_some_and(|object| pdo(object.index).is_some());
    match parameter.protection().filter(|_| !is_of_pdo) {
        Some(Protection::NodeId | Protection::BitRate) => 2,
        Some(_) => 1,
        None => 0,
    }
}

/// Returns the reason why the order of writes leaves out a value.
fn reason(configuration: &Configuration, address: Address) -> &'static str {
    let object = address.object().map(|object| (object.index, object.sub_index));
    let found = configuration.left_out.iter().find(|(left_out, _)| Some(*left_out) == object);
    match found {
        Some((_, LeftOut::NotMapped)) => "the sub-index is above the number of mapped objects",
        Some((_, reason)) => reason.text(),
        None => "no step of the restore writes this parameter",
    }
}

fn phases(configuration: &Configuration) -> impl Iterator<Item = &Setting> {
    let Configuration { disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos, .. } =
        configuration;
    [disable_pdos, communication, parameters, mapping, pdo_parameters, enable_pdos].into_iter().flatten()
}

/// Converts a setting to a write. Adds the node-ID if the setting is a formula. Returns `None` if the setting is a formula
/// and the node-ID is unknown, or if the bytes are not a value of the type.
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
