//! The F-parameter record of PROFIsafe.

use crate::backend::rust::code::{call, seq, slice, Data, Declaration, Doc};
use crate::ir::{FParameter, FParameters};
use crate::number::hex16;

/// The F-parameter record, ready to be printed.
pub(in crate::backend::rust) struct FRecordModel {
    pub index: u16,
    pub transfer_sequence: u16,
    pub length: u32,
    /// The constant `F_PARAMETERS`, which describes the record.
    pub constant: Declaration,
}

/// F-parameters: the GSDML name, the field in the runtime's struct, and the variant of the runtime's `FField`.
const PARAMETERS: [(&str, &str, &str); 12] = [
    ("F_Check_iPar", "check_i_par", "CheckIPar"),
    ("F_SIL", "sil", "Sil"),
    ("F_CRC_Length", "crc_length", "CrcLength"),
    ("F_CRC_Seed", "crc_seed", "CrcSeed"),
    ("F_Passivation", "passivation", "Passivation"),
    ("F_Block_ID", "block_id", "BlockId"),
    ("F_Par_Version", "par_version", "ParVersion"),
    ("F_Source_Add", "source_address", "SourceAddress"),
    ("F_Dest_Add", "destination_address", "DestinationAddress"),
    ("F_WD_Time", "watchdog_time", "WatchdogTime"),
    ("F_WD_Time_2", "watchdog_time_2", "WatchdogTime2"),
    ("F_iPar_CRC", "i_par_crc", "IParCrc"),
];

/// GSDML labels of values, with their numbers in the record. `CRC-Seed24/32` is the only label of F_CRC_Seed and stands
/// for the value 0 of this bit. The checksums over the default values in vendor files confirm this value.
const LABELS: [(&str, u32); 12] = [
    ("NoCheck", 0),
    ("Check", 1),
    ("SIL1", 0),
    ("SIL2", 1),
    ("SIL3", 2),
    ("NoSIL", 3),
    ("3-Byte-CRC", 0),
    ("2-Byte-CRC", 1),
    ("4-Byte-CRC", 2),
    ("CRC-Seed24/32", 0),
    ("Device/Module", 0),
    ("Channel", 1),
];

pub(super) fn model(record: &FParameters) -> FRecordModel {
    let default = |name: &str| find(record, name).map_or(0, number);
    let block_id = default("F_Block_ID");
    let length = 10 + if block_id & 1 != 0 { 4 } else { 0 } + if block_id & 2 != 0 { 2 } else { 0 };
    let default = |&(name, field, _): &_| (field, Doc::from(literal(field, default(name))));
    let limits = PARAMETERS.iter().filter_map(|&(name, _, variant)| limit(find(record, name)?, variant));
    let values = [
        ("index", Doc::from(hex16(record.index))),
        ("transfer_sequence", seq![record.transfer_sequence]),
        ("default", Data::fields("rt::profinet::FParameters", PARAMETERS.iter().map(default))),
        ("limits", slice(limits)),
    ];
    let docs = format!("F-parameters (PROFIsafe): record {} of {length} bytes.", hex16(record.index));
    let start = seq!["const F_PARAMETERS: rt::profinet::FRecord<", length, ">"];
    let constant = Declaration::new([docs], start, Data::fields("rt::profinet::FRecord", values));
    FRecordModel { index: record.index, transfer_sequence: record.transfer_sequence, length, constant }
}

fn find<'r>(record: &'r FParameters, name: &str) -> Option<&'r FParameter> {
    record.parameters.iter().find(|parameter| parameter.name == name)
}

fn label(text: &str) -> Option<u32> {
    LABELS.iter().find(|(label, _)| *label == text).map(|(_, number)| *number)
}

/// Returns the default value in the encoding of the record.
fn number(parameter: &FParameter) -> u32 {
    label(&parameter.label).unwrap_or_else(|| u32::try_from(parameter.default).unwrap_or(0))
}

fn literal(field: &str, value: u32) -> String {
    match field {
        "check_i_par" | "crc_seed" => (value != 0).to_string(),
        "sil" => format!("rt::profinet::Sil::{}", ["Sil1", "Sil2", "Sil3", "NoSil"][value as usize & 3]),
        "crc_length" => {
            let names = ["ThreeBytes", "TwoBytes", "FourBytes", "Reserved"];
            format!("rt::profinet::FCrcLength::{}", names[value as usize & 3])
        }
        "passivation" => {
            format!("rt::profinet::FPassivation::{}", ["DeviceOrModule", "Channel"][value as usize & 1])
        }
        "block_id" => (value & 7).to_string(),
        "par_version" => (value & 3).to_string(),
        "i_par_crc" => value.to_string(),
        _ => (value & 0xFFFF).to_string(),
    }
}

/// Returns the allowed values of an F-parameter. Returns `None` if all values are allowed.
fn limit(parameter: &FParameter, variant: &str) -> Option<Doc> {
    let default = number(parameter);
    let mut list: Vec<(u32, u32)> = parameter
        .allowed
        .iter()
        .filter_map(|&(first, last)| {
            let last = u32::try_from(last.min(i128::from(u32::MAX))).ok()?;
            Some((u32::try_from(first.max(0)).ok()?, last)).filter(|(first, last)| first <= last)
        })
        .collect();
    list.extend(parameter.allowed_labels.iter().filter_map(|text| label(text)).map(|number| (number, number)));
    if !parameter.changeable {
        list = vec![(default, default)];
    }
    if list.is_empty() || list.contains(&(0, u32::MAX)) {
        return None;
    }
    let list = slice(list.iter().map(|(first, last)| format!("({first}, {last})")));
    Some(call!("rt::profinet::FLimit::new", seq!["rt::profinet::FField::", variant], list))
}
