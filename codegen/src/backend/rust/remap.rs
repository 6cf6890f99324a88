//! The input of `lexibus::pdo!`: PDOs with a changeable mapping, their limits, and the items that can be mapped.

use super::literal;
use crate::collections::HashMap;
use crate::number::{hex, hex16};

use super::code::{seq, slice, Doc};
use super::context::Context;
use super::field_type;
use super::links::DocModule;
use super::naming::pdos::is_generated;
use super::objects::ObjectModel;
use super::pdo;
use super::reachable::addressable;
use super::scope::ObjectBus;
use crate::facts::pdo::{
    configures, is_changeable, mappable, mapped_bits, mapped_objects, max_bytes_on_ethercat, writable_entries,
    MAX_ENTRY,
};
use crate::ir::{Device, Direction, Item, Mappable, Pdo, MAX_PDO_SUBS};

/// A PDO with a changeable mapping, ready to be printed.
pub(super) struct RemappableModel {
    pub name: String,
    pub title: String,
    pub direction: &'static str,
    /// Rust type of the PDO's COB-ID. PDOs on EtherCAT and PDOs without a default COB-ID use a placeholder type.
    pub cob_id: &'static str,
    /// Constants of the PDO, each with its type and value.
    pub constants: Vec<Doc>,
}

/// Returns the PDOs with a changeable mapping. Adds the mapping arguments of each mappable item to `objects` if such
/// PDOs exist. Returns no PDOs if no item is mappable.
pub(super) fn models(context: &Context<'_>, objects: &mut [ObjectModel]) -> Vec<RemappableModel> {
    let Some(device) = context.device else { return Vec::new() };
    let models = context.names.pdos.iter().filter_map(|named| model(context, device, named.pdo, named.name.clone()));
    let models: Vec<RemappableModel> = models.collect();
    if models.is_empty() || !set_mappable(context, objects) {
        return Vec::new();
    }
    models
}

fn model(context: &Context<'_>, device: &Device, pdo: &Pdo, name: String) -> Option<RemappableModel> {
    if !is_changeable(pdo) {
        return None;
    }
    let mapping = addressable(context).find(|(_, group)| group.index() == Some(pdo.mapping_index));
    let entries = mapping.and_then(|(_, mapping)| writable_entries(mapping));
    let mut constants = vec![Doc::from(format!("INDEX: u16 = {}", hex16(pdo.mapping_index)))];
    let cob_id = match &pdo.communication {
        Some(_) => {
            constants.push(seq!["ENTRIES: usize = ", entries?]);
            on_canopen(device, pdo, &mut constants)?
        }
        None => {
            let entries = entries.or_else(|| configures(device).then_some(MAX_PDO_SUBS));
            constants.push(seq!["ENTRIES: usize = ", entries?]);
            on_ethercat(context, device, pdo, &mut constants)?
        }
    };
    let kept: Vec<Doc> = pdo.entries.iter().filter(|entry| entry.fixed).map(pdo::mapping_line).collect();
    if !kept.is_empty() {
        constants.push(seq!["KEPT: &'static [rt::MappedEntry] = ", slice(kept)]);
    }
    Some(RemappableModel {
        title: match is_generated(pdo) {
            true => format!(
                "{} The default mapping is {}.",
                pdo::title(context, pdo),
                DocModule::OTHER.code(&format!("pdo::{name}"))
            ),
            false => pdo::title(context, pdo),
        },
        direction: match pdo.direction {
            Direction::Receive => "rt::Rpdo",
            Direction::Transmit => "rt::Tpdo",
        },
        cob_id,
        constants,
        name,
    })
}

/// Adds the constants that a CANopen PDO needs. Returns the Rust type of the COB-ID, or `None` if the device supports
/// only fixed mappings or the PDO has no communication parameters.
fn on_canopen(device: &Device, pdo: &Pdo, constants: &mut Vec<Doc>) -> Option<&'static str> {
    let communication = pdo.communication.as_ref()?;
    let settings = device.canopen.as_deref();
    match settings.and_then(|settings| settings.granularity) {
        // CiA 306: granularity 0 means that the mapping is fixed.
        Some(0) => return None,
        Some(bits @ 2..) => constants.push(seq!["GRANULARITY: u32 = ", u32::from(bits)]),
        _ => {}
    }
    let receives = pdo.direction == Direction::Receive;
    let dummies = settings.filter(|_| receives).map_or(&[][..], |settings| &settings.dummies);
    let dummies = dummies.iter().filter_map(|&code| 1_u32.checked_shl(code.into())).fold(0, |all, one| all | one);
    if dummies != 0 {
        constants.push(Doc::from(format!("DUMMIES: u32 = {}", hex(dummies))));
    }
    if communication.writable.contains(&1) {
        constants.push(Doc::from(format!("COMMUNICATION: Option<u16> = Some({})", hex16(communication.index))));
    }
    let timing = pdo::timing_writes(communication);
    if !timing.is_empty() {
        constants.push(seq!["TIMING: &'static [rt::SdoWrite] = ", slice(timing)]);
    }
    match pdo::cob_id(pdo).filter(|_| pdo::has_identifier(pdo)) {
        Some(cob_id) => {
            constants.push(seq!["COB_ID: rt::CobId = ", cob_id]);
            Some("rt::CobId")
        }
        None => Some("rt::pdo::NoCobId"),
    }
}

/// Adds the constants that an EtherCAT PDO needs. Returns the type that is used instead of a COB-ID. Returns `None` if
/// the description is not that of an EtherCAT device, or if it contains only a dictionary.
fn on_ethercat(context: &Context<'_>, device: &Device, pdo: &Pdo, constants: &mut Vec<Doc>) -> Option<&'static str> {
    if context.bus != ObjectBus::CoE || device.dictionary_only {
        return None;
    }
    let bytes = max_bytes_on_ethercat(device, pdo);
    constants.push(seq!["MAX_BITS: u32 = ", u32::from(bytes) * 8]);
    Some("rt::pdo::OnEtherCat")
}

/// Returns the code of an entry's value in the mapping object.
fn word(index: u16, sub_index: u8, bits: u32) -> String {
    literal::word(u32::from(index) << 16 | u32::from(sub_index) << 8 | bits & MAX_ENTRY)
}

/// Adds the mapping arguments to each item that can be mapped. Returns whether at least one item can be mapped.
fn set_mappable(context: &Context<'_>, objects: &mut [ObjectModel]) -> bool {
    let items = context.groups.iter().flat_map(|group| &group.items);
    let items: HashMap<(u16, u8), &Item> = items.filter_map(|item| Some((item.object()?, item))).collect();
    let by_default = mapped_objects(context.pdos);
    let mut any = false;
    for object in objects {
        let outer = if object.has_entries() { "super::super::" } else { "super::" };
        for model in &mut object.items {
            let Some((address, item)) = model.object.and_then(|address| Some((address, items.get(&address)?))) else {
                continue;
            };
            model.mappable = arguments(context, item, address, mappable(item, &by_default), outer);
            any |= model.mappable.is_some();
        }
    }
    any
}

/// Returns the generic arguments of `rt::Mappable`: the type of the field, the direction, and the mapped entry.
fn arguments(
    context: &Context<'_>,
    item: &Item,
    address: (u16, u8),
    into: Mappable,
    outer: &str,
) -> Option<[String; 3]> {
    let (index, sub_index) = address;
    let direction = match (into.rpdo, into.tpdo) {
        (true, true) => "rt::AnyPdo",
        (true, false) => "rt::Rpdo",
        (false, true) => "rt::Tpdo",
        (false, false) => return None,
    };
    let bits = mapped_bits(item, context.types)?;
    let field = field_type::field_type(context, item.ty, bits).path(outer);
    Some([field, direction.to_owned(), word(index, sub_index, bits)])
}
