//! Tests EEPROM images: their size, what is left out if the EEPROM is too small, refusals, and declared content.

use crate::corpus_support::round_trip::options;
use lexibus_codegen::compile::read;
use lexibus_codegen::ir::Device;
use lexibus_codegen::source::Source;
use lexibus_export::sii::{export, Image, NoteKind, Options, Refusal};

const TERMINAL: &str = include_str!("../../../../tests/data/terminal.esi.xml");

/// A mailbox with CoE.
const MAILBOX: &str = r#"<Mailbox DataLinkLayer="1"><CoE SdoInfo="1" PdoUpload="1"/><FoE/><EoE/></Mailbox>"#;

/// Returns the device of an ESI with one device.
fn device(esi: &str) -> Device {
    let catalog = read(Source::new("device.xml", esi.into()), &options()).catalog.expect("an ESI");
    catalog.devices.into_iter().next().expect("a device")
}

/// Replaces a part of the terminal's ESI.
fn with(part: &str, replacement: &str) -> String {
    assert!(TERMINAL.contains(part), "{part}");
    TERMINAL.replace(part, replacement)
}

fn set(facts: &[(&str, &str)]) -> Options {
    let mut options = Options::default();
    facts.iter().for_each(|(key, value)| options.set(key, value).expect("an option"));
    options
}

fn image(esi: &str, facts: &[(&str, &str)]) -> Image {
    export(&device(esi), &set(facts)).expect("an image")
}

fn refusal(esi: &str, facts: &[(&str, &str)]) -> String {
    export(&device(esi), &set(facts)).expect_err("a refusal").to_string()
}

fn notes(image: &Image) -> Vec<(NoteKind, usize)> {
    image.notes.iter().map(|note| (note.kind, note.count)).collect()
}

/// Returns the numbers and contents of the categories.
fn categories(image: &Image) -> Vec<(u16, &[u8])> {
    let (mut rest, mut all) = (&image.bytes[128..], Vec::new());
    while let [kind, high, words, more, ..] = *rest {
        let kind = u16::from_le_bytes([kind, high]);
        if kind == 0xFFFF {
            return all;
        }
        let length = 2 * usize::from(u16::from_le_bytes([words, more]));
        all.push((kind, &rest[4..4 + length]));
        rest = &rest[4 + length..];
    }
    panic!("the image has no end marker");
}

fn numbers(image: &Image) -> Vec<u16> {
    categories(image).into_iter().map(|(number, _)| number).collect()
}

#[test]
fn the_image_has_the_declared_size() {
    let image = image(TERMINAL, &[]);
    assert_eq!(notes(&image), []);
    assert_eq!((image.bytes.len(), image.bytes[0x7C]), (1024, 7));
    assert_eq!(numbers(&image), [10, 30, 40, 41, 50, 51, 60]);
    assert_eq!(image.bytes[..16], [1, 0, 0, 0, 0, 0, 0, 0, 0x05, 0x0A, 0, 0, 0, 0, 0x85, 0]);
    assert!(image.bytes.ends_with(&[0xFF; 100]));
}

#[test]
fn options_take_precedence_over_the_description() {
    let facts = [
        ("vendor-id", "1"),
        ("product-code", "2"),
        ("revision", "3"),
        ("serial-number", "4"),
        ("station-alias", "5"),
        ("config-data", "050603446400"),
        ("eeprom-size", "4096"),
    ];
    let image = image(TERMINAL, &facts);
    assert_eq!((image.bytes.len(), image.bytes[0x7C]), (4096, 31));
    assert_eq!(image.bytes[..10], [0x05, 0x06, 0x03, 0x44, 0x64, 0, 0, 0, 5, 0]);
    let identity: Vec<u8> = (1..=4).flat_map(u32::to_le_bytes).collect();
    assert_eq!(image.bytes[16..32], identity);
}

#[test]
fn a_size_that_is_missing_or_invalid_is_assumed() {
    for size in ["", "<ByteSize>1000</ByteSize>", "<ByteSize>4000000000</ByteSize>"] {
        let image = image(&with("<ByteSize>1024</ByteSize>", size), &[]);
        assert_eq!((image.bytes.len(), notes(&image)), (2048, vec![(NoteKind::EepromSize, 1)]), "{size}");
    }
}

#[test]
fn missing_facts_are_named() {
    let bare = with("<Eeprom><ByteSize>1024</ByteSize><ConfigData>0100000000000000050A</ConfigData></Eeprom>", "");
    assert!(refusal(&bare, &[]).ends_with(
        "set `config-data` (First bytes of the EEPROM, which configure the slave controller, such as 050603446400)"
    ));
    assert_eq!(image(&bare, &[("config-data", "0100")]).bytes.len(), 2048);
    let nameless = with(r##" ProductCode="#x00A30001""##, "");
    assert!(refusal(&nameless, &[]).contains("`product-code`"));
    assert_eq!(export(&Device::default(), &Options::default()), Err(Refusal::Nothing));
}

/// Without CoE, only the EEPROM describes the PDOs. With CoE, the object dictionary also describes them.
#[test]
fn a_small_eeprom_contains_what_a_master_needs() {
    let long = with("Short value", &"Short value ".repeat(10));
    let complete = image(&long, &[]);
    let shorter = image(&long, &[("eeprom-size", "512")]);
    assert_eq!(notes(&shorter), [(NoteKind::EntryNames, 5)]);
    let pdos = |image| categories(image).into_iter().find(|(kind, _)| *kind == 50).map(|(_, pdos)| pdos.len());
    assert_eq!(pdos(&shorter), pdos(&complete));
    let message = "the content has 548 bytes, but the EEPROM has only 384; set `eeprom-size`";
    assert_eq!(refusal(&long, &[("eeprom-size", "384")]), message);
    let with_coe = long.replace("<Dc>", &format!("{MAILBOX}<Dc>"));
    let without = image(&with_coe, &[("eeprom-size", "384")]);
    assert_eq!((notes(&without), numbers(&without)), (vec![(NoteKind::PdosLeftOut, 4)], vec![10, 30, 40, 41, 60]));
    assert_eq!(refusal(&with_coe, &[("eeprom-size", "256")]), message.replace("384", "256"));
}

#[test]
fn mailbox_protocols_and_their_details() {
    let coe = with("<Dc>", &format!("{MAILBOX}<Dc>"));
    let image = image(&coe, &[]);
    assert_eq!(image.bytes[0x38], 0x02 | 0x04 | 0x08);
    let general = categories(&image)[1].1;
    assert_eq!((general[5], general[6], general[7]), (0x01 | 0x02 | 0x10, 1, 1));
    assert_eq!(general[11], 0x01 | 0x04 | 0x08 | 0x10, "SafeOp, mailbox data link layer, identification");
    assert_eq!(i16::from_le_bytes([general[12], general[13]]), -130);
    assert_eq!((general[16], general[18], general[19]), (0x33, 0x00, 0x10), "ports and identification register");
}

#[test]
fn facts_that_do_not_fit_are_noted() {
    let long = image(&with("<BitLen>240</BitLen>", "<BitLen>600</BitLen>"), &[]);
    assert_eq!(notes(&long), [(NoteKind::SplitEntry, 1)]);
    let pdos = categories(&long).into_iter().find(|(kind, _)| *kind == 50).expect("the TxPDOs").1;
    let entries: Vec<u8> = pdos[pdos.len() - 24..].chunks(8).map(|entry| entry[5]).collect();
    assert_eq!(entries, [248, 248, 104]);
    // The number of parts is computed without creating them.
    let endless = image(&with("<BitLen>240</BitLen>", "<BitLen>4294967295</BitLen>"), &[]);
    assert_eq!(notes(&endless), [(NoteKind::PdoEntries, 1)]);
    let units = image(&with("<Fmmu>Inputs</Fmmu>", r#"<Fmmu Sm="1" Su="0">Inputs</Fmmu>"#), &[]);
    assert_eq!(notes(&units), [(NoteKind::Setting, 2)]);
    let chinese = image(&with("4 µs", "电机"), &[]);
    assert_eq!(notes(&chinese), [(NoteKind::Character, 1)]);
}

#[test]
fn declared_content_is_exported_as_it_is() {
    let part = "<ByteSize>1024</ByteSize><ConfigData>0100000000000000050A</ConfigData>";
    let right = image(&with(part, "<Data>0100000000000000050A0000000085001234</Data>"), &[]);
    assert_eq!((right.bytes.len(), notes(&right)), (18, vec![]));
    let wrong = image(&with(part, "<Data>0100000000000000050A000000008600</Data>"), &[("serial-number", "1")]);
    assert_eq!((wrong.bytes.len(), wrong.bytes[14]), (16, 0x86));
    assert_eq!(notes(&wrong), [(NoteKind::GivenFact, 1), (NoteKind::Checksum, 1)]);
}

#[test]
fn config_data_may_contain_its_checksum() {
    let config = |data: &str| image(&with("0100000000000000050A", data), &[]);
    let right = config("0100000000000000050A000000008500");
    assert_eq!((right.bytes[14], notes(&right)), (0x85, vec![]));
    let odd = config("0100000000000000050A0000000085");
    assert_eq!((odd.bytes[14], notes(&odd)), (0x85, vec![(NoteKind::ConfigData, 1)]));
    let wrong = config("0100000000000000050A0000000086001122");
    assert_eq!(wrong.bytes[..18], right.bytes[..18]);
    assert_eq!(notes(&wrong), [(NoteKind::ConfigData, 1), (NoteKind::Checksum, 1)]);
}
