//! Lints of EtherCAT process data, each with its place.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

/// A slave with one sync manager for outputs and these PDOs, one a line from line 4 on.
fn slave(sync_manager: &str, pdos: &[&str]) -> Compilation {
    let text = format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>x</Name></Vendor><Descriptions><Devices>\n\
         <Device Physics=\"YY\"><Type ProductCode=\"#x10\" RevisionNo=\"#x1\">D</Type><Name>d</Name>\n\
         {sync_manager}\n{}\n</Device></Devices></Descriptions></EtherCATInfo>",
        pdos.join("\n")
    );
    check(Source::new("slave.xml", text.into_bytes()), &Options::default())
}

const OUTPUTS: &str = "<Sm StartAddress=\"#x1100\" ControlByte=\"#x64\" Enable=\"1\" MaxSize=\"2\">Outputs</Sm>";

/// An RxPDO of 16 bits.
fn pdo(index: u16, attributes: &str, exclude: &str) -> String {
    format!(
        "<RxPdo Fixed=\"1\" {attributes}><Index>#x{index:04X}</Index><Name>P{index:X}</Name>{exclude}\
         <Entry><Index>#x7000</Index><SubIndex>{}</SubIndex><BitLen>16</BitLen><Name>O</Name><DataType>UINT</DataType>\
         </Entry></RxPdo>",
        index & 0xFF
    )
}

/// Code, line, message of each finding.
fn findings(compilation: &Compilation) -> Vec<(&'static str, u32, String)> {
    let source = &compilation.sources[0];
    let list = compilation.diagnostics.list().iter();
    list.map(|found| (found.code.id, source.position(found.span.start).line, found.message.clone())).collect()
}

#[test]
fn pdo018_defaults_that_exclude_each_other() {
    let exclude = "<Exclude>#x1602</Exclude>";
    let found = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", exclude), &pdo(0x1602, "Sm=\"0\"", "")]);
    let message = "0x1601 and 0x1602 are both assigned by default, and exclude each other";
    assert_eq!(findings(&found), [("PDO018", 5, message.to_owned())]);
    // The first one is the image.
    let text = found.rust(&Options::default().rust).expect("bindings");
    assert!(text.contains("default_pdos: &[0x1601],") && text.contains("pub p1601: super::pdo::P1601,"));
    assert!(!text.contains("pub p1602:"));
    let chosen = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", exclude), &pdo(0x1602, "", "")]);
    assert_eq!(findings(&chosen), []);
    // It may be the other one that says so, and what is left out excludes nothing.
    let own = slave(
        "",
        &[
            &pdo(0x1601, "Sm=\"0\"", ""),
            &pdo(0x1602, "Sm=\"0\"", "<Exclude>#x1601</Exclude><Exclude>#x1603</Exclude>"),
            &pdo(0x1603, "Sm=\"0\"", ""),
        ],
    );
    assert_eq!(findings(&own), [("PDO018", 5, message.to_owned())]);
    let text = own.rust(&Options::default().rust).expect("bindings");
    assert!(text.contains("default_pdos: &[0x1601, 0x1603],"), "{text}");
}

#[test]
fn pdo019_no_such_sync_manager() {
    let found = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", ""), &pdo(0x1602, "Sm=\"5\"", "")]);
    let message = "0x1602 is assigned to sync manager 5, which isn't described";
    assert_eq!(findings(&found), [("PDO019", 5, message.to_owned())]);
    // What can't be assigned anyway is in nobody's way.
    let exclude = "<Exclude>#x1601</Exclude>";
    let found = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", ""), &pdo(0x1602, "Sm=\"5\"", exclude)]);
    assert_eq!(findings(&found), [("PDO019", 5, message.to_owned())]);
    // Without any sync manager in the description, the number is believed.
    let without = slave("", &[&pdo(0x1602, "Sm=\"2\"", "")]);
    assert_eq!(findings(&without), []);
    let text = without.rust(&Options::default().rust).expect("bindings");
    assert!(text.contains("pub const SYNC_MANAGER: u8 = 2;"));
}

#[test]
fn pdo020_excluded_pdo_missing() {
    let found = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", "<Exclude>#x1607</Exclude>")]);
    assert_eq!(findings(&found), [("PDO020", 4, "0x1601 excludes 0x1607, which isn't described".to_owned())]);
}

#[test]
fn pdo021_image_too_long() {
    let found = slave(OUTPUTS, &[&pdo(0x1601, "Sm=\"0\"", ""), &pdo(0x1602, "Sm=\"0\"", "")]);
    let message = "the PDOs of sync manager 0 have 4 bytes by default, and at most 2 fit";
    assert_eq!(findings(&found), [("PDO021", 3, message.to_owned())]);
}

#[test]
fn pdo024_too_many_pdos() {
    let pdos: Vec<String> = (0x1600..0x16FF).map(|index| pdo(index, "Sm=\"0\"", "")).collect();
    let pdos: Vec<&str> = pdos.iter().map(String::as_str).collect();
    let without_limit = OUTPUTS.replace(" MaxSize=\"2\"", "");
    let message = "sync manager 0 has 255 PDOs by default, and a list of them at most 254";
    assert_eq!(findings(&slave(&without_limit, &pdos)), [("PDO024", 3, message.to_owned())]);
    assert_eq!(findings(&slave(&without_limit, &pdos[1..])), []);
}

#[test]
fn pdo022_entry_too_long() {
    const UINT: &str = "<DataType>UINT</DataType>";
    let long = pdo(0x1601, "Sm=\"0\"", "").replace(">16<", ">65536<").replace(UINT, "");
    let short = pdo(0x1602, "Sm=\"0\"", "").replace(">16<", ">65535<").replace(UINT, "");
    let without_limit = OUTPUTS.replace(" MaxSize=\"2\"", "");
    let found = slave(&without_limit, &[&long, &short]);
    assert_eq!(findings(&found), [("PDO022", 4, "an entry of the PDO 0x1601 has 65536 bits".to_owned())]);
    // It is in the descriptor, and keeps its room in the image.
    let text = found.rust(&Options::default().rust).expect("bindings");
    assert!(text.contains("rt::MappedEntry::new(0x7000, 0x01, 65536)") && !text.contains("pub struct P1601"));
    assert!(text.contains("pub o: [u8; 8192],") && text.contains("get_bytes::<8192>(data, 65536)"), "{text}");
}

#[test]
fn pdo022_in_a_module() {
    let pdo = pdo(0x1601, "", "").replace(">16<", ">65536<");
    let text = format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>x</Name></Vendor><Descriptions><Modules>\n\
         <Module><Type ModuleIdent=\"1\">M</Type><Name>m</Name>{pdo}</Module></Modules></Descriptions></EtherCATInfo>"
    );
    let found = check(Source::new("module.xml", text.into_bytes()), &Options::default());
    assert!(findings(&found).iter().any(|found| found.0 == "PDO022"), "{:?}", findings(&found));
}

/// A slave whose dictionary has 0x7000:1 with these flags, and an RxPDO maps it.
fn mapped(flags: &str) -> Compilation {
    let text = format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>x</Name></Vendor><Descriptions><Devices>\n\
         <Device Physics=\"YY\"><Type ProductCode=\"#x10\" RevisionNo=\"#x1\">D</Type><Name>d</Name>\n\
         <Profile><Dictionary><DataTypes><DataType><Name>UINT</Name><BitSize>16</BitSize></DataType></DataTypes><Objects>\
         <Object><Index>#x7000</Index><Name>O</Name><Type>UINT</Type><BitSize>16</BitSize><Flags>{flags}</Flags></Object>\
         </Objects></Dictionary></Profile>\n{OUTPUTS}\n{}\n</Device></Devices></Descriptions></EtherCATInfo>",
        pdo(0x1600, "Sm=\"0\"", "")
    );
    let mut options = Options::default();
    options.levels.set("mapped-read-only", Level::Warn).unwrap();
    check(Source::new("slave.xml", text.into_bytes()), &options)
}

#[test]
fn directions_of_mapped_objects() {
    let wrong = "0x7000 sub-index 0x0 is mapped into an RxPDO, and its PdoMapping has the other direction only";
    let cases = [
        ("<Access>rw</Access><PdoMapping>T</PdoMapping>", vec![("PDO003", 5, wrong.to_owned())]),
        ("<Access>rw</Access><PdoMapping>R</PdoMapping>", vec![]),
        ("<Access>rw</Access>", vec![]),
        (
            "<Access>ro</Access><PdoMapping>R</PdoMapping>",
            vec![("PDO023", 5, "0x7000 sub-index 0x0 is ro and mapped into an RxPDO".to_owned())],
        ),
    ];
    for (flags, expected) in cases {
        assert_eq!(findings(&mapped(flags)), expected, "{flags}");
    }
}

/// A slave whose dictionary has the object 0x2000, a record of the type `DT2000`, one sub-item a line from line 4 on.
fn record(bits: u32, sub_items: &[&str], default: &str) -> Compilation {
    let basic = |name: &str, bits: u32| format!("<DataType><Name>{name}</Name><BitSize>{bits}</BitSize></DataType>");
    let text = format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>x</Name></Vendor><Descriptions><Devices><Device Physics=\"YY\">\
         <Type ProductCode=\"#x10\" RevisionNo=\"#x1\">D</Type><Name>d</Name><Profile><Dictionary><DataTypes>\n{}{}\n\
         <DataType><Name>DT2000</Name><BitSize>{bits}</BitSize>\n{}\n</DataType></DataTypes><Objects><Object>\
         <Index>#x2000</Index><Name>O</Name><Type>DT2000</Type><BitSize>{bits}</BitSize>{default}</Object></Objects>\
         </Dictionary></Profile></Device></Devices></Descriptions></EtherCATInfo>",
        basic("USINT", 8),
        basic("UINT", 16),
        sub_items.join("\n")
    );
    check(Source::new("slave.xml", text.into_bytes()), &Options::default())
}

fn sub_item(sub_index: u8, ty: &str, bits: u8, offset: u32) -> String {
    format!(
        "<SubItem><SubIdx>{sub_index}</SubIdx><Name>s{sub_index}</Name><Type>{ty}</Type><BitSize>{bits}</BitSize>\
         <BitOffs>{offset}</BitOffs><Flags><Access>ro</Access></Flags></SubItem>"
    )
}

#[test]
fn eds049_sub_index_0_of_a_record() {
    let subs = [sub_item(0, "USINT", 8, 0), sub_item(1, "UINT", 16, 16)];
    let subs = [subs[0].as_str(), subs[1].as_str()];
    let default = |value: &str| {
        format!("<Info><SubItem><Name>s0</Name><Info><DefaultData>{value}</DefaultData></Info></SubItem></Info>")
    };
    let found = record(32, &subs, &default("07"));
    let message = "sub-index 0 of 0x2000 says 7, but the highest sub-index is 1";
    assert_eq!(
        findings(&found).iter().map(|(code, _, text)| (*code, text.as_str())).collect::<Vec<_>>(),
        [("EDS049", message)]
    );
    assert_eq!(findings(&record(32, &subs, &default("01"))), []);
}

#[test]
fn esi025_sub_items_share_bits_or_lie_beyond() {
    let places = |bits, offset| {
        let subs = [sub_item(0, "USINT", 8, 0), sub_item(1, "UINT", 16, 16), sub_item(2, "UINT", 16, offset)];
        findings(&record(bits, &subs.each_ref().map(String::as_str), ""))
    };
    assert_eq!(places(48, 32), []);
    let message = "the sub-items `s1` and `s2` share bits: 16 to 31 and 24 to 39";
    assert_eq!(places(48, 24), [("ESI025", 6, message.to_owned())]);
    let message = "the sub-item `s2` reaches to bit 48 of a data type of 40 bits";
    assert_eq!(places(40, 32), [("ESI025", 6, message.to_owned())]);
}
