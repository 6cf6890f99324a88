//! Tests the back end's assumptions about PROFIsafe with corpus files.

use crate::corpus_support;

use corpus_support::lane;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{FParameters, Submodule};
use lexibus_codegen::source::Source;

/// Returns a 16-bit CRC. The polynomial is 0x4EAB, and the initial value is 0.
fn crc16(data: &[u8]) -> u16 {
    data.iter().fold(0, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| if crc & 0x8000 != 0 { crc << 1 ^ 0x4EAB } else { crc << 1 })
    })
}

/// Returns the F_Par_CRC of a record's default values. The CRC covers the F_iPar_CRC, if the record contains it, and then the
/// parameters from F_Check_iPar to F_WD_Time in the order of the record. The bit of F_CRC_Seed is 0.
fn checksum(record: &FParameters) -> u16 {
    let parameter = |name: &str| record.parameters.iter().find(|parameter| parameter.name == name);
    let number = |name: &str| parameter(name).map_or(0, |parameter| parameter.default);
    let label = |name: &str| parameter(name).map_or("", |parameter| parameter.label.as_str());
    let position = |names: &[&str], name: &str| names.iter().position(|entry| *entry == label(name)).unwrap_or(0) as u8;
    let sil = position(&["SIL1", "SIL2", "SIL3", "NoSIL"], "F_SIL");
    let length = position(&["3-Byte-CRC", "2-Byte-CRC", "4-Byte-CRC"], "F_CRC_Length");
    let block = number("F_Block_ID") as u8;
    let mut data = Vec::new();
    if block & 1 != 0 {
        data.extend((number("F_iPar_CRC") as u32).to_be_bytes());
    }
    data.push(position(&["NoCheck", "Check"], "F_Check_iPar") << 1 | sil << 2 | length << 4);
    data.push(block << 3 | (number("F_Par_Version") as u8) << 6);
    for name in ["F_Source_Add", "F_Dest_Add", "F_WD_Time"] {
        data.extend((number(name) as u16).to_be_bytes());
    }
    crc16(&data)
}

#[test]
fn checksums_of_f_parameters_are_those_that_vendors_give() {
    let Some(files) = corpus_support::files_of("gsdml") else { return };
    let (mut checked, mut seeded) = (0, 0);
    for file in files {
        let compilation = check(Source::new(file.name.as_str(), file.bytes), &Options::default());
        let submodules = compilation.catalog.iter().flat_map(|catalog| &catalog.submodules);
        for Submodule { f_parameters, .. } in submodules {
            let Some(record) = f_parameters else { continue };
            let parameter = |name: &str| record.parameters.iter().find(|parameter| parameter.name == name);
            let given = parameter("F_Par_CRC").map(|parameter| parameter.default);
            assert_eq!(given, Some(i128::from(checksum(record))), "{}", file.name);
            checked += 1;
            seeded += usize::from(parameter("F_CRC_Seed").is_some());
        }
    }
    assert!(
        checked > lane::at_least(10) && seeded >= lane::at_least(4),
        "only {checked} records, {seeded} of them with a seed"
    );
}
