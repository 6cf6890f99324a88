//! Tests the ESI front end: limits, large files, and files that a description refers to. The cases in
//! `tests/ui/quirks-esi` test variants of ESI that occur in real files.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::Device;
use lexibus_codegen::source::Source;

/// Compiles a text as a file without a folder.
fn read(text: String) -> Compilation {
    check(Source::new("slave.xml", text.into_bytes()), &Options::default())
}

/// Returns an ESI whose Devices element contains `devices`.
fn file(devices: &str) -> String {
    format!(
        "<EtherCATInfo><Vendor><Id>#x1</Id><Name>Maker</Name></Vendor><Descriptions><Devices>{devices}</Devices>\
         </Descriptions></EtherCATInfo>"
    )
}

/// Returns an ESI with one device, which has `elements` in addition to Type and Name.
fn device_file(elements: &str) -> String {
    file(&format!(
        "<Device Physics='YY'><Type ProductCode='#x2' RevisionNo='#x3'>D1</Type><Name>Drive</Name>{elements}</Device>"
    ))
}

/// Returns a Profile element with the data types `types` and the objects `objects`.
fn profile(types: &str, objects: &str) -> String {
    format!("<Profile><Dictionary><DataTypes>{types}</DataTypes><Objects>{objects}</Objects></Dictionary></Profile>")
}

/// Returns an Object element for a read-only object with a single value.
fn var(index: u16, ty: &str) -> String {
    format!(
        "<Object><Index>{index}</Index><Name>Value</Name><Type>{ty}</Type><Flags><Access>ro</Access></Flags></Object>"
    )
}

fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("the file is usable").devices[0]
}

/// Returns the codes of all diagnostics.
fn codes(compilation: &Compilation) -> Vec<&'static str> {
    compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
}

#[test]
fn long_chains_of_base_types_end() {
    let ty = |name: usize, base: &str| {
        format!("<DataType><Name>T{name}</Name><BaseType>{base}</BaseType><BitSize>8</BitSize></DataType>\n")
    };
    let types: String = (0..300).map(|n| ty(n, &format!("T{}", n + 1))).collect();
    let types = types + &ty(300, "USINT");
    let deep = read(device_file(&profile(&types, &var(0x2000, "T0"))));
    assert!(deep.catalog.is_some());
    assert!(codes(&deep).iter().all(|code| *code == "ESI015"), "{:?}", codes(&deep));
}

#[test]
fn pdos_have_more_than_255_entries() {
    let entry = |index: u32, sub_index: u32, bits: u32| {
        format!(
            "<Entry><Index>{index}</Index><SubIndex>{sub_index}</SubIndex><BitLen>{bits}</BitLen><Name>E{sub_index}</Name>\
             <DataType>BOOL</DataType></Entry>"
        )
    };
    let entries: String = (0..300).map(|n| entry(0x6000 + n / 200, n % 200, 1)).collect();
    let entries = entries + &entry(0, 0, 70_000);
    let checked = read(device_file(&format!(
        "<TxPdo Sm='3' Fixed='1'><Index>#x1A00</Index><Name>Inputs</Name>{entries}</TxPdo>"
    )));
    let pdo = &device(&checked).process_data.pdos[0];
    assert_eq!((pdo.mapping_index, pdo.entries.len(), pdo.bits()), (0x1A00, 301, 70_300));
    assert_eq!(pdo.entries[299].bit_offset, 299);
    assert_eq!(codes(&checked), [""; 0]);
}

#[test]
fn too_many_pdos_of_a_sync_manager() {
    let slave = |indices: std::ops::Range<u16>| {
        let pdos = indices.map(|index| {
            format!(
                "<RxPdo Fixed='1' Sm='0'><Index>{index}</Index><Name>P{index:X}</Name><Entry><Index>#x7000</Index>\
                 <SubIndex>{}</SubIndex><BitLen>16</BitLen><Name>O</Name><DataType>UINT</DataType></Entry></RxPdo>",
                index & 0xFF
            )
        });
        let sync_manager = "<Sm StartAddress='#x1100' ControlByte='#x64' Enable='1'>Outputs</Sm>";
        read(device_file(&format!("{sync_manager}{}", pdos.collect::<String>())))
    };
    let found = slave(0x1600..0x16FF);
    let [found] = found.diagnostics.list() else { panic!("{:?}", codes(&found)) };
    let message = "sync manager 0 has 255 default PDOs, but a PDO assignment holds at most 254";
    assert_eq!((found.code.id, found.message.as_str()), ("PDO024", message));
    assert_eq!(codes(&slave(0x1601..0x16FF)), [""; 0]);
}

#[test]
fn large_files_are_read_in_time() {
    let mut devices = String::new();
    for product in 0..400 {
        let objects: String = (0x2000..0x2028).map(|index| var(index, "UINT")).collect();
        let _ = write!(devices, "<Device><Type ProductCode='{product}'>T</Type>{}</Device>", profile("", &objects));
    }
    let text = file(&devices);
    let (length, start) = (text.len(), Instant::now());
    let checked = read(text);
    assert_eq!(checked.catalog.expect("the file is usable").devices.len(), 400);
    assert!(start.elapsed().as_secs() < 60, "{length} bytes took {:?}", start.elapsed());
}

#[test]
fn small_files_do_not_grow() {
    // The file has a record type that contains a long array, and many objects of this record type.
    let types =
        "<DataType><Name>A</Name><BaseType>USINT</BaseType><BitSize>2040</BitSize><ArrayInfo><LBound>1</LBound>\
                 <Elements>255</Elements></ArrayInfo></DataType>\
                 <DataType><Name>R</Name><BitSize>2048</BitSize>\
                 <SubItem><SubIdx>0</SubIdx><Name>N</Name><Type>USINT</Type><BitSize>8</BitSize><BitOffs>0</BitOffs>\
                 <Flags><Access>rw</Access></Flags></SubItem>\
                 <SubItem><Name>E</Name><Type>A</Type><BitSize>2040</BitSize><BitOffs>8</BitOffs></SubItem></DataType>";
    let object = |n: u32| format!("<Object><Index>{}</Index><Name>O</Name><Type>R</Type></Object>\n", 0x2000 + n);
    let objects: String = (0..3000).map(object).collect();
    let checked = read(device_file(&profile(types, &objects)));
    let items: usize = device(&checked).groups.iter().map(|group| group.items.len()).sum();
    assert!(items <= lexibus_codegen::limits::MAX_DERIVED_ITEMS, "{items} items");
    let found: Vec<_> = checked.diagnostics.list().iter().filter(|found| found.code.id == "IO003").collect();
    assert_eq!((found.len(), found[0].notes.len()), (1, 0));
}

/// Returns the path of a description that refers to three files. Several devices refer to the same file, and the references contain
/// a cycle.
fn referring() -> PathBuf {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui/quirks-esi");
    cases.join("x24-files-next-to-the-description/input.xml")
}

#[test]
fn each_file_is_read_once() {
    let checked = check(Source::read(&referring()).unwrap(), &Options::default());
    assert_eq!((checked.sources.len(), codes(&checked)), (4, vec![]));
}

#[test]
fn no_file_is_read_for_a_source_in_memory() {
    let bytes = std::fs::read(referring()).unwrap();
    let checked = check(Source::new("input.xml", bytes), &Options::default());
    let missing = codes(&checked).iter().filter(|code| **code == "XML005").count();
    assert_eq!((checked.sources.len(), missing), (1, 3));
    assert_eq!(checked.catalog.expect("the file is usable").devices.len(), 2);
}

#[test]
fn a_damaged_file_is_left_out() {
    let folder = std::env::temp_dir().join(format!("lexibus-esi-damaged-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let main = device_file("").replace("<Vendor>", "<InfoReference>modules.xml</InfoReference><Vendor>");
    std::fs::write(folder.join("main.xml"), main).unwrap();
    std::fs::write(folder.join("modules.xml"), "<EtherCATModule>").unwrap();
    let checked = check(Source::read(&folder.join("main.xml")).unwrap(), &Options::default());
    std::fs::remove_dir_all(folder).unwrap();
    assert_eq!((device(&checked).name.as_str(), codes(&checked)), ("Drive", vec!["XML005"]));
}
