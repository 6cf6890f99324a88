//! Tests quirks of EDS and DCF files that the cases in `tests/ui/quirks-eds` cannot show: many repeated sections, and formulas
//! in the API.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Value;
use lexibus_codegen::source::Source;

#[test]
fn e27_every_repetition_is_reported_however_many_sections_there_are() {
    let text = "[DummyUsage]\n".repeat(20) + "[Comments]\nLines=0\n[Comments]\n";
    let checked = check(Source::new("pump.eds", text.into_bytes()), &Options::default());
    let repeated = checked.diagnostics.list().iter().filter(|found| found.code.id == "EDS007");
    let lines: Vec<u32> = repeated.map(|found| checked.sources[0].position(found.span.start).line).collect();
    let expected: Vec<u32> = (2..=20).chain([23]).collect();
    assert_eq!(lines, expected);
}

#[test]
fn e69_formulas_resolve_with_the_node_id() {
    let text = "[2000]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n\
                ParameterValue=$NODEID+0x200\n[DeviceComissioning]\nNodeID=0x11\nBaudrate=125\n";
    let checked = check(Source::new("pump.dcf", text.as_bytes().to_vec()), &Options::default());
    let device = &checked.catalog.as_ref().expect("the file is usable").devices[0];
    let node_id = device.commissioning.as_ref().unwrap().node_id.unwrap();
    let item = device.entry(0x2000, 0).unwrap();
    assert_eq!(item.default.as_ref().unwrap().resolved(node_id), Value::Int(0x191));
    assert_eq!(item.initial().unwrap().resolved(node_id), Value::Int(0x211));
}
