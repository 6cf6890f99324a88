//! Configured values of a device (DCF, XDC), in the order in which the device accepts them.

use std::collections::BTreeMap;

use super::cob_id::has_identifier;
use super::{encoding, types};
use crate::ir::{Device, Group, Item, ObjectCode, Type, TypeDef, Value};
use crate::resolve::{announced_count, is_device_of_number};

/// Bit of a COB-ID that disables the PDO (CiA 301 7.5.2.35 and 7.5.2.37).
const DISABLED: i128 = 1 << 31;

/// Maximum number of entries of a PDO mapping. Greater values of sub-index 0 select a multiplexed PDO or are reserved (CiA 301 7.5.2.36).
pub const MAX_ENTRIES: u8 = 64;

/// The values that configure a device, and the objects that are left out. The fields with values are in the order of
/// the writes.
#[derive(Debug, Default)]
pub struct Configuration {
    /// COB-IDs that disable the PDOs whose communication parameters or mappings are configured.
    pub disable_pdos: Vec<Setting>,
    /// Communication parameters (0x1000 to 0x1FFF), except those of PDOs.
    pub communication: Vec<Setting>,
    /// Values of all other objects.
    pub parameters: Vec<Setting>,
    /// PDO mappings: for each PDO, the number of entries is set to 0, then the entries are written, then their number (CiA 301
    /// 7.5.2.36).
    pub mapping: Vec<Setting>,
    /// Communication parameters of PDOs, except COB-IDs.
    pub pdo_parameters: Vec<Setting>,
    /// COB-IDs that enable PDOs.
    pub enable_pdos: Vec<Setting>,
    /// Configured objects that are not written, each with the reason.
    pub left_out: Vec<((u16, u8), LeftOut)>,
}

/// A value that is written to an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Index and sub-index of the object.
    pub object: (u16, u8),
    /// Bytes of the value. If `adds_node_id` is true, the node-ID is added to the value.
    pub bytes: Vec<u8>,
    /// True if the value depends on the node-ID.
    pub adds_node_id: bool,
    /// True if the setting changes nothing in a device with default values.
    pub is_default: bool,
    /// True if the object cannot be read.
    pub is_write_only: bool,
}

/// The reason why a configured value is not written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeftOut {
    /// The object is read-only or constant.
    ReadOnly,
    /// The object refuses writes during a download (bit 0 of ObjFlags, CiA 306).
    RefusesDownload,
    /// Writing to the object starts an action. Such objects are the error history, the commands that store and restore
    /// parameters, and the controlword and targets of a CiA 402 drive.
    Command,
    /// The entry is not part of the PDO mapping, because its sub-index is greater than the number of entries.
    NotMapped,
    /// The value does not fit the type of the object.
    NoValue,
}

impl LeftOut {
    /// Returns a noun phrase for the objects that are left out for this reason.
    pub fn text(self) -> &'static str {
        match self {
            LeftOut::ReadOnly => "read-only objects",
            LeftOut::RefusesDownload => "objects that refuse writes on download (ObjFlags)",
            LeftOut::Command => "commands, targets of a drive, and the error history",
            LeftOut::NotMapped => "mapping entries above the number of mapped objects",
            LeftOut::NoValue => "objects whose value does not fit the type",
        }
    }
}

impl Configuration {
    /// Collects the configured values of a device. Returns `None` if no value is written.
    pub fn of(device: &Device) -> Option<Self> {
        let mut configuration = Configuration::default();
        let mut pdos: BTreeMap<u16, Pdo<'_>> = BTreeMap::new();
        let is_object = |group: &&Group| {
            !matches!(group.object_code(), Some(ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null))
        };
        let is_drive = is_device_of_number(device, 402);
        for group in device.groups.iter().filter(is_object) {
            match group.index() {
                Some(index @ (0x1400..=0x15FF | 0x1800..=0x19FF)) => {
                    pdos.entry(index).or_default().communication = Some(group);
                }
                Some(index @ (0x1600..=0x17FF | 0x1A00..=0x1BFF)) => {
                    pdos.entry(index - 0x200).or_default().mapping = Some(group);
                }
                Some(index) => {
                    let is_command = is_drive && is_motion_command(index);
                    configuration.add_object(index, group, &device.types, is_command.then_some(LeftOut::Command));
                }
                None => {}
            }
        }
        configuration.communication.sort_by_key(|setting| communication_order(setting.object));
        pdos.values().for_each(|pdo| configuration.add_pdo(pdo, &device.types));
        configuration.left_out.sort_by_key(|(object, reason)| (*reason, *object));
        (!configuration.is_empty()).then_some(configuration)
    }

    /// Returns whether the configuration writes no values. Values that are left out do not count.
    fn is_empty(&self) -> bool {
        let phases = [&self.communication, &self.parameters, &self.mapping, &self.pdo_parameters];
        phases.into_iter().chain([&self.disable_pdos, &self.enable_pdos]).all(Vec::is_empty)
    }

    /// Adds the configured values of an object. If `left_out` is given, all values are left out for this reason.
    fn add_object(&mut self, index: u16, group: &Group, types: &[TypeDef], left_out: Option<LeftOut>) {
        let settings = configured(group, types, left_out, &mut self.left_out);
        match index {
            0x1000..=0x1FFF => self.communication.extend(settings),
            _ => self.parameters.extend(settings),
        }
    }

    fn add_pdo(&mut self, pdo: &Pdo<'_>, types: &[TypeDef]) {
        let left_out = &mut self.left_out;
        let communication = pdo.communication.map_or_else(Vec::new, |group| configured(group, types, None, left_out));
        let mapping = pdo.mapping.map_or_else(Vec::new, |group| mapping(group, types, left_out));
        let is_unchanged = communication.iter().chain(&mapping).all(|setting| setting.is_default);
        if communication.is_empty() && mapping.is_empty() {
            return;
        }
        let cob_id = pdo.communication.and_then(cob_id);
        let write = |value: Option<Value>| {
            let (group, value) = (pdo.communication?, value?);
            let setting = setting(group.sub(1)?, &value, types)?;
            Some(Setting { is_default: is_unchanged, ..setting })
        };
        self.disable_pdos.extend(write(cob_id.map(|value| with_flags(value, DISABLED))));
        self.mapping.extend(mapping);
        self.pdo_parameters.extend(communication.into_iter().filter(|setting| setting.object.1 != 1));
        let is_enabled = |value: &&Value| matches!(value, Value::Int(id) | Value::NodeId(id) if id & DISABLED == 0);
        self.enable_pdos.extend(write(cob_id.filter(is_enabled).cloned()));
    }
}

/// Returns whether an object of a CiA 402 drive commands a motion: the controlword, or the target of a mode. A file that a tool
/// saved from a running drive can contain values of these objects. The objects of each further axis are 0x800 higher (CiA 402-2).
pub fn is_motion_command(index: u16) -> bool {
    const AXIS: u16 = 0x800;
    (0x6000..0xA000).contains(&index)
        && matches!(0x6000 + (index - 0x6000) % AXIS, 0x6040 | 0x6042 | 0x6071 | 0x607A | 0x60FF)
}

/// The objects of a PDO.
#[derive(Default)]
struct Pdo<'d> {
    communication: Option<&'d Group>,
    mapping: Option<&'d Group>,
}

/// Returns the configured COB-ID of a PDO, or the default COB-ID if it contains a CAN identifier. Returns `None` if there is no
/// such COB-ID, or if it must not be written.
fn cob_id(communication: &Group) -> Option<&Value> {
    let item = communication.sub(1).filter(|item| reason(communication, item).is_none())?;
    item.configured_value().or_else(|| item.default.as_ref().filter(|value| has_identifier(value)))
}

fn with_flags(cob_id: &Value, flags: i128) -> Value {
    match cob_id {
        Value::Int(id) => Value::Int(id | flags),
        Value::NodeId(id) => Value::NodeId(id | flags),
        other => other.clone(),
    }
}

/// Returns the settings that write the configured items of an object. Adds each item that is not written to `left_out`, with the
/// reason. `of_object` is a reason to leave out the whole object.
fn configured(
    group: &Group,
    types: &[TypeDef],
    of_object: Option<LeftOut>,
    left_out: &mut Vec<((u16, u8), LeftOut)>,
) -> Vec<Setting> {
    let mut settings = Vec::new();
    for item in &group.items {
        let (Some(value), Some(object)) = (item.configured_value(), item.object()) else { continue };
        match (of_object.or_else(|| reason(group, item)), setting(item, value, types)) {
            (Some(reason), _) => left_out.push((object, reason)),
            (None, None) => left_out.push((object, LeftOut::NoValue)),
            (None, Some(setting)) => settings.push(setting),
        }
    }
    settings
}

/// Returns the settings that map objects into a PDO. If the number of entries is writable, the settings first clear the mapping,
/// then write all entries and their number. Entries with default values are also written, because some devices lose entries that
/// are not written again.
fn mapping(group: &Group, types: &[TypeDef], left_out: &mut Vec<((u16, u8), LeftOut)>) -> Vec<Setting> {
    let mut settings = configured(group, types, None, left_out);
    let count = group.sub(0).filter(|item| reason(group, item).is_none());
    let number = announced_count(group).and_then(|number| u8::try_from(number).ok());
    let highest = || settings.iter().map(|setting| setting.object.1).max();
    let Some(number) = number.or_else(highest) else { return settings };
    let is_multiplexed = number > MAX_ENTRIES;
    settings.retain(|setting| {
        let is_mapped = setting.object.1 <= number || is_multiplexed;
        if !is_mapped {
            left_out.push((setting.object, LeftOut::NotMapped));
        }
        is_mapped
    });
    let Some(count) = count.filter(|_| !settings.is_empty()) else { return settings };
    let is_default = settings.iter().all(|setting| setting.is_default);
    let of_count = |number: u8| {
        let setting = setting(count, &Value::Int(number.into()), types)?;
        Some(Setting { is_default, ..setting })
    };
    let entry = |sub_index: u8| {
        let item = group.sub(sub_index).filter(|item| reason(group, item).is_none())?;
        let value = if is_multiplexed { item.configured_value() } else { item.initial() };
        Some(Setting { is_default, ..setting(item, value?, types)? })
    };
    let clear = of_count(0);
    let entries = (1..=number.min(MAX_ENTRIES)).filter_map(entry);
    clear.into_iter().chain(entries).chain(of_count(number).filter(|_| number > 0)).collect()
}

/// Returns the reason why an item must not be written, or `None` if it can be written.
fn reason(group: &Group, item: &Item) -> Option<LeftOut> {
    /// Bit of ObjFlags: the object must not be written when a configuration is downloaded.
    const REFUSES_WRITE: u32 = 1;
    match group.index() {
        _ if !item.access.writable() => Some(LeftOut::ReadOnly),
        _ if (group.flags | item.flags) & REFUSES_WRITE != 0 => Some(LeftOut::RefusesDownload),
        // Error history, store parameters and restore default parameters (CiA 301 7.5.2.4, 7.5.2.13 and 7.5.2.14).
        Some(0x1003 | 0x1010 | 0x1011) => Some(LeftOut::Command),
        _ => None,
    }
}

/// Returns the setting that writes a value to an item. Returns `None` if the value does not fit the type of the item, if the value
/// has no bytes in this type, or if the item has no object address.
fn setting(item: &Item, value: &Value, types: &[TypeDef]) -> Option<Setting> {
    let ty: Type = types::basic(types, item.object_type());
    let bytes = match value {
        _ if !encoding::fits(value, ty) => return None,
        Value::NodeId(offset) => encoding::number(*offset, ty),
        value => encoding::bytes(value, ty),
    };
    Some(Setting {
        object: item.object()?,
        bytes: bytes?,
        adds_node_id: matches!(value, Value::NodeId(_)),
        is_default: item.default.as_ref() == Some(value),
        is_write_only: !item.access.readable(),
    })
}

/// Returns the sort key of a communication parameter. Devices refuse a new SYNC counter overflow value (0x1019) while
/// the SYNC period (0x1006) is not 0 (CiA 301 7.5.2.22). The SYNC period and window (0x1006 and 0x1007) therefore
/// follow 0x1019, and the COB-ID (0x1005), which starts the SYNC producer, follows them.
fn communication_order(object: (u16, u8)) -> (u16, u16, u8) {
    let (index, sub_index) = object;
    let rank = match index {
        0x1005 => 0x101B,
        0x1006 | 0x1007 => 0x101A,
        other => other,
    };
    (rank, index, sub_index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Access, Binding, Configured, ObjectBuses};

    /// Sub-index, access rights, default value and configured value of an item.
    type Row = (u8, Access, Option<i128>, Option<i128>);

    const RW: Access = Access::ReadWrite;
    const RO: Access = Access::ReadOnly;

    fn object(index: u16, ty: Type, rows: &[Row]) -> Group {
        let item = |&(sub_index, access, default, configured): &Row| {
            let mut item = Item::new(Binding::Object { buses: ObjectBuses::CANOPEN, index, sub_index });
            item.ty = if sub_index == 0 && rows.len() > 1 { Type::Unsigned(8) } else { ty };
            item.access = access;
            item.default = default.map(Value::Int);
            let value = configured.map(Value::Int);
            item.configured = value.map(|value| Box::new(Configured { value: Some(value), ..Configured::default() }));
            item
        };
        Group { items: rows.iter().map(item).collect(), ..Group::object(index, ObjectCode::Record) }
    }

    fn configuration(groups: Vec<Group>) -> Configuration {
        Configuration::of(&Device { groups, ..Device::default() }).unwrap_or_default()
    }

    /// Returns the sub-indices and values of settings.
    fn values(settings: &[Setting]) -> Vec<(u8, u32)> {
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
        settings.iter().map(|setting| (setting.object.1, number(&setting.bytes))).collect()
    }

    fn mapping_of(rows: &[Row]) -> Configuration {
        configuration(vec![object(0x1600, Type::Unsigned(32), rows)])
    }

    #[test]
    fn commands_of_a_drive_are_left_out() {
        let objects = |profile| {
            let value = |index| object(index, Type::Unsigned(16), &[(0, RW, Some(0), Some(15))]);
            let device_type = object(0x1000, Type::Unsigned(32), &[(0, RO, Some(profile), None)]);
            configuration(vec![device_type, value(0x6040), value(0x6060), value(0x687A)])
        };
        let drive = objects(0x0002_0192);
        assert_eq!(drive.left_out, [((0x6040, 0), LeftOut::Command), ((0x687A, 0), LeftOut::Command)]);
        assert_eq!(drive.parameters.iter().map(|setting| setting.object.0).collect::<Vec<_>>(), [0x6060]);
        assert_eq!(objects(0x0002_0191).parameters.len(), 3);
    }

    #[test]
    fn a_device_without_configured_values() {
        let heartbeat = object(0x1017, Type::Unsigned(16), &[(0, RW, Some(5), None)]);
        assert!(Configuration::of(&Device { groups: vec![heartbeat], ..Device::default() }).is_none());
        let only_left_out = object(0x1000, Type::Unsigned(32), &[(0, RO, None, Some(5))]);
        assert!(Configuration::of(&Device { groups: vec![only_left_out], ..Device::default() }).is_none());
    }

    #[test]
    fn a_mapping_is_written_as_a_whole() {
        let all =
            mapping_of(&[(0, RW, Some(2), None), (1, RW, Some(7), None), (2, RW, None, Some(8)), (3, RW, None, None)]);
        assert_eq!(values(&all.mapping), [(0, 0), (1, 7), (2, 8), (0, 2)]);
        assert!(all.disable_pdos.is_empty() && all.mapping.iter().all(|setting| !setting.is_default));
        let empty = mapping_of(&[(0, RW, Some(1), Some(0)), (1, RW, Some(7), Some(7))]);
        assert_eq!(values(&empty.mapping), [(0, 0)]);
        assert_eq!(empty.left_out, [((0x1600, 1), LeftOut::NotMapped)]);
        let unknown_number = mapping_of(&[(0, RW, None, None), (1, RW, None, Some(7))]);
        assert_eq!(values(&unknown_number.mapping), [(0, 0), (1, 7), (0, 1)]);
        let same = mapping_of(&[(0, RW, Some(1), Some(1)), (1, RW, Some(7), Some(7))]);
        assert!(same.mapping.iter().all(|setting| setting.is_default));
    }

    #[test]
    fn a_mapping_with_a_fixed_number() {
        let fixed = mapping_of(&[(0, RO, Some(1), Some(1)), (1, RW, None, Some(7)), (2, RW, None, Some(8))]);
        assert_eq!(values(&fixed.mapping), [(1, 7)]);
        assert_eq!(fixed.left_out, [((0x1600, 0), LeftOut::ReadOnly), ((0x1600, 2), LeftOut::NotMapped)]);
    }

    /// The number 255 selects a multiplexed PDO with destination address mode.
    #[test]
    fn a_multiplexed_pdo() {
        let multiplexed = mapping_of(&[(0, RW, Some(0), Some(255)), (1, RW, Some(0), None), (2, RW, None, Some(8))]);
        assert_eq!(values(&multiplexed.mapping), [(0, 0), (2, 8), (0, 255)]);
    }

    #[test]
    fn an_unchanged_pdo_is_marked() {
        let pdo = |transmission| {
            let communication = object(
                0x1800,
                Type::Unsigned(32),
                &[(0, RO, Some(2), None), (1, RW, Some(0x181), None), (2, RW, Some(255), Some(transmission))],
            );
            configuration(vec![communication])
        };
        let changed = pdo(1);
        assert_eq!(values(&changed.disable_pdos), [(1, 0x8000_0181)]);
        assert_eq!(values(&changed.pdo_parameters), [(2, 1)]);
        assert_eq!(values(&changed.enable_pdos), [(1, 0x181)]);
        let is_default = |configuration: &Configuration| {
            [&configuration.disable_pdos, &configuration.pdo_parameters, &configuration.enable_pdos]
                .map(|settings| settings[0].is_default)
        };
        assert_eq!(is_default(&changed), [false; 3]);
        assert_eq!(is_default(&pdo(255)), [true; 3]);
    }

    /// The default COB-ID of a disabled PDO often contains no CAN identifier, so it cannot enable the PDO.
    #[test]
    fn a_cob_id_without_an_identifier() {
        let rows = [(0, RO, Some(2), None), (1, RW, Some(0x8000_0000), None), (2, RW, Some(255), Some(1))];
        let pdo = configuration(vec![object(0x1800, Type::Unsigned(32), &rows)]);
        assert_eq!((pdo.disable_pdos.len(), pdo.pdo_parameters.len(), pdo.enable_pdos.len()), (0, 1, 0));
    }

    #[test]
    fn the_sync_producer_starts_last() {
        let indices = [0x1005, 0x1006, 0x1014, 0x1017, 0x1019];
        let groups = indices.map(|index| object(index, Type::Unsigned(16), &[(0, RW, None, Some(1))]));
        let order: Vec<u16> =
            configuration(groups.into()).communication.iter().map(|setting| setting.object.0).collect();
        assert_eq!(order, [0x1014, 0x1017, 0x1019, 0x1006, 0x1005]);
    }
}
