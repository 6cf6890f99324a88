//! Tests that generated code causes no warnings of rustc and clippy.

use crate::compile_support;
use crate::corpus_support;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use compile_support::{compile, compile_by_rustc, compile_in, document};
use corpus_support::{lane, File};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

fn everything() -> RustOptions {
    RustOptions { table: Presence::Always, ..RustOptions::default() }
}

#[test]
fn every_file_of_the_corpus_compiles_or_is_rejected_with_a_reason() {
    let Some(files) = corpus_support::all_files() else { return };
    let options = Options { rust: everything(), ..Options::default() };
    // Clippy takes 1.5 times as long as rustc. In the fast lane, it checks only the bindings of every eighth device.
    let number = AtomicUsize::new(0);
    let compiled = corpus_support::bindings::each(files, &options, |name, text| {
        let with_clippy = lane::is_full() || number.fetch_add(1, Ordering::Relaxed).is_multiple_of(8);
        let compile = if with_clippy { compile } else { compile_by_rustc };
        compile(name, text)
    });
    assert!(compiled > lane::at_least(500), "only {compiled} different devices");
}

/// Compiles all devices and modules of a file together. If an earlier device or module of the file has
/// the same definition, the generated Rust module re-exports this definition.
#[test]
fn all_devices_of_a_file_compile_and_are_documented_together() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui/quirks-esi");
    let case = std::fs::read(cases.join("equal-definitions-of-devices/input.xml")).expect("a case");
    let mut files = vec![File { name: "a case".to_owned(), bytes: case }];
    files.extend(corpus_support::files_of("esi").into_iter().flatten());
    let options = Options { rust: everything(), ..Options::default() };
    corpus_support::bindings::on_all_processors(files, |File { name, bytes }| {
        let compilation = check(Source::new(name.as_str(), bytes), &options);
        let count = compilation.catalog.as_ref().map_or(0, |catalog| catalog.devices.len());
        if let Some(text) = compilation.rust(&options.rust).filter(|text| count > 1 && text.contains("pub use super")) {
            compile(&name, &text).unwrap_or_else(|message| panic!("{message}"));
            document(&name, &[&text]).unwrap_or_else(|message| panic!("{message}"));
        }
    });
}

const NASTY_NAMES: &str = "[DeviceInfo]\nProductName=\n\
    [2000]\nParameterName=type\nDataType=0x0005\nAccessType=rw\n\
    [2001]\nParameterName=self\nDataType=0x0005\nAccessType=ro\n\
    [2002]\nParameterName=\"\\\" */ } // {{ \u{202e}x\nDataType=0x0009\nAccessType=const\nDefaultValue=a\"b\\c\u{202e}\n\
    [2003]\nParameterName=u32\nDataType=0x0007\nAccessType=rw\nDefaultValue=5\n\
    [2004]\nParameterName=next\nDataType=0x0007\nAccessType=rw\n\
    [2005]\nParameterName=from here to there\nDataType=0x0007\nAccessType=rw\n\
    [2006]\nParameterName=objects\nObjectType=9\nSubNumber=3\n\
    [2006sub0]\nParameterName=rt\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n\
    [2006sub1]\nParameterName=crate\nDataType=0x0008\nAccessType=rw\nDefaultValue=3.14159\n\
    [2006sub2]\nParameterName=Crate\nDataType=0x0011\nAccessType=rw\nLowLimit=-1.5\nHighLimit=2.718281828\n\
    [2007]\nParameterName=\nObjectType=9\n[2007sub0]\nParameterName=\nDataType=5\nAccessType=ro\n\
    [2008]\nParameterName=<b>[link](http://x) `code` #h\nDataType=0x000A\nAccessType=rw\nDefaultValue=00ff\n\
    [2009]\nParameterName=union\nDataType=0x0010\nAccessType=rw\nDefaultValue=-5\nLowLimit=-8\nHighLimit=7\n\
    [200A]\nParameterName=2nd \u{b5}s/\u{b0}C 100%\nDataType=0x001A\nAccessType=wo\n\
    [200B]\nParameterName=time\nDataType=0x000C\nAccessType=rw\nDefaultValue=0x000100000002\n\
    [200C]\nParameterName=client\nDataType=0x001B\nAccessType=rw\nDefaultValue=0xFFFFFFFFFFFFFFFF\n\
    [200D]\nParameterName=\u{65e5}\u{672c}\nDataType=0x000B\nAccessType=rw\nDefaultValue=\u{65e5}\n\
    [200E]\nParameterName=a very long name that goes on and on and on and says nothing, nothing at all, for ever and ever\n\
    DataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x600\n\
    [200F]\nParameterName=below\nDataType=0x0004\nAccessType=rw\nDefaultValue=$NODEID+-5\n";

#[test]
fn no_name_or_text_breaks_out_of_the_code() {
    for accessors in [true, false] {
        let options = Options { rust: RustOptions { accessors, ..everything() }, ..Options::default() };
        let compilation = check(Source::new("nasty \"*/.eds", NASTY_NAMES.into()), &options);
        let text = compilation.rust(&options.rust).expect("bindings");
        compile("nasty names", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
        document("nasty names", &[&text]).unwrap_or_else(|message| panic!("{message}\n{text}"));
    }
}

/// Generates and compiles the Rust code of an ESI file with the PDO elements `pdos`. Returns the code.
fn of_pdos(name: &str, pdos: &str) -> String {
    let text = format!(
        "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device><Type ProductCode=\"#x2\">D</Type><Name>D</Name>\
         <Sm>MBoxOut</Sm><Sm>MBoxIn</Sm><Sm>Outputs</Sm><Sm>Inputs</Sm>{pdos}\
         <Mailbox><CoE PdoAssign=\"1\"/></Mailbox></Device></Devices></Descriptions></EtherCATInfo>"
    );
    let options = Options { rust: everything(), ..Options::default() };
    let text = check(Source::new("d.xml", text.into()), &options).rust(&options.rust).expect("bindings");
    compile(name, &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
    text
}

#[test]
fn more_pdos_than_an_assignment_has_room_for() {
    let pdos = |count: u16| -> String {
        (0..count)
            .map(|at| {
                format!(
                    "<RxPdo Sm=\"2\"><Index>{}</Index><Name>P{at}</Name><Entry><Index>{}</Index><SubIndex>1</SubIndex>\
                     <BitLen>8</BitLen><Name>V{at}</Name><DataType>USINT</DataType></Entry></RxPdo>",
                    0x1600 + at,
                    0x7000 + at
                )
            })
            .collect()
    };
    assert!(of_pdos("254 PDOs", &pdos(254)).contains("new_u8(0x1C12, 0x00, 254)"));
    assert!(!of_pdos("256 PDOs", &pdos(256)).contains("STARTUP"));
}

#[test]
fn pdos_of_one_index_have_their_own_mappings() {
    let pdo = |manager: u8, name: &str, object: u16, bits: u8| {
        format!(
            "<TxPdo Sm=\"{manager}\"><Index>#x1A02</Index><Name>{name}</Name><Entry><Index>{object}</Index>\
             <SubIndex>1</SubIndex><BitLen>{bits}</BitLen><Name>V</Name><DataType>{}</DataType></Entry></TxPdo>",
            if bits == 8 { "USINT" } else { "UINT" }
        )
    };
    let text = of_pdos("PDOs of one index", &(pdo(3, "First", 0x6000, 8) + &pdo(2, "Second", 0x6001, 16)));
    let mappings = text.matches(" as rt::Pdo>::MAPPING").count();
    let first = text.matches("<pdo::First as rt::Pdo>::MAPPING").count();
    assert_eq!((mappings, first), (2, 1), "{text}");
}

#[test]
fn every_edition_of_rust_takes_it() {
    let options = Options { rust: everything(), ..Options::default() };
    let text = check(Source::new("names.eds", NASTY_NAMES.into()), &options).rust(&options.rust).expect("bindings");
    for edition in ["2018", "2021", "2024"] {
        compile_in(edition, edition, &text).unwrap_or_else(|message| panic!("{message}"));
    }
}

/// Names of traits that generated code implements. Each is also the name of an enumeration in the test.
const TRAITS: [&str; 8] = ["from", "eq", "partial eq", "hash", "display", "from str", "copy", "named"];

/// Tests types, values, bits and items with names that the Rust prelude or generated code also uses.
#[test]
fn names_of_the_prelude_and_of_methods_compile() {
    let words = [
        "None",
        "Some",
        "Ok",
        "Err",
        "Default",
        "New",
        "FromRaw",
        "Option",
        "Result",
        "String",
        "Box",
        "Self",
        "Debug",
        "Eq",
        "Clone",
        "Copy",
        "Into",
        "From",
        "Raw",
        "Unknown",
        "Bits",
        "On",
        "Client",
        "Send",
        "Sync",
        "Drop",
        "Fn",
        "Vec",
        "core",
        "with command",
        "new",
        "from raw",
        "into",
        "try into",
        "clone",
        "raw",
        "native",
        "get",
        "set",
        "2nd",
        "_",
        "u64",
    ];
    let mut table = "lexibus = 1\n[device]\nname = \"New\"\nbuses = [\"modbus\", \"canopen\"]\n\
                     [spaces.register]\nmodbus = { table = \"holding\" }\n"
        .to_owned();
    for (at, word) in words.iter().enumerate() {
        let other = words[(at + 7) % words.len()];
        table += &format!("[enums.\"{word}\".values]\n0 = \"{word}\"\n1 = \"{other}\"\n");
        table += &format!("[bits.\"{word} bits\".at]\n0 = \"{word}\"\n1 = \"{other}\"\n");
    }
    for word in TRAITS {
        table += &format!("[enums.\"{word}\".values]\n0 = \"{word}\"\n");
    }
    table += "[[chapters]]\n[chapters.registers]\n";
    for (at, word) in words.iter().enumerate() {
        let (one, other) = (2 * at, 2 * at + 1);
        table += &format!("\"{word}\" = {{ reg = {one}, type = \"u16\", access = \"rw\", enum = \"{word}\" }}\n");
        table +=
            &format!("\"{word} b\" = {{ reg = {other}, type = \"u16\", access = \"rw\", bits = \"{word} bits\" }}\n");
    }
    for (at, word) in TRAITS.iter().enumerate() {
        let reg = 2 * words.len() + at;
        table += &format!("\"{word} t\" = {{ reg = {reg}, type = \"u16\", access = \"rw\", enum = \"{word}\" }}\n");
    }
    table += "[chapters.objects]\n\"0x2000\" = { name = \"New\", code = \"record\" }\n";
    for (at, word) in words.iter().enumerate() {
        let sub = at + 1;
        table +=
            &format!("\"0x2000:{sub}\" = {{ name = \"{word}\", type = \"u8\", access = \"rw\", enum = \"{word}\" }}\n");
    }
    let options = Options { rust: everything(), ..Options::default() };
    let compilation = check(Source::new("names.toml", table.into_bytes()), &options);
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|one| compilation.one_line(one)).collect();
    let text = compilation.rust(&options.rust).unwrap_or_else(|| panic!("{found:#?}"));
    compile("names of the prelude", &text).unwrap_or_else(|message| panic!("{message}"));
    document("names of the prelude", &[&text]).unwrap_or_else(|message| panic!("{message}"));
}

/// Tests PDOs with fields of all kinds: single bits, unusual widths, reals, times, texts, padding, and more than 64 bits.
#[test]
fn pdos_of_every_shape_compile() {
    let mut eds = String::from("[DeviceInfo]\nProductName=Shapes\nGranularity=1\nNrOfRXPDO=0\nNrOfTXPDO=4\n");
    let types = [0x01, 0x02, 0x10, 0x15, 0x05, 0x16, 0x1B, 0x08, 0x11, 0x0C, 0x0A];
    for (number, ty) in types.iter().enumerate() {
        eds += &format!(
            "[{:04X}]\nParameterName=Value {number}\nDataType=0x{ty:04X}\nAccessType=ro\nPDOMapping=1\n",
            0x2000 + number
        );
    }
    let mappings: [&[u32]; 4] = [
        &[0x2000_0001, 0x2000_0001, 0x2004_0003, 0x0005_0008, 0x2001_0008, 0x2002_0018],
        &[0x2007_0020, 0x2005_0018, 0x2004_0008],
        &[0x2009_0030, 0x200A_0010],
        &[0x2003_0040, 0x2006_0040, 0x2008_0040, 0x2000_0001, 0x200A_0058, 0x5000_000C],
    ];
    for (number, words) in mappings.iter().enumerate() {
        let index = 0x1A00 + number;
        eds += &format!("[{index:04X}]\nParameterName=Mapping\nObjectType=9\nSubNumber={}\n", words.len() + 1);
        eds +=
            &format!("[{index:04X}sub0]\nParameterName=n\nDataType=5\nAccessType=rw\nDefaultValue={}\n", words.len());
        for (sub, word) in words.iter().enumerate() {
            let section = format!("{index:04X}sub{:X}", sub + 1);
            eds += &format!("[{section}]\nParameterName=e\nDataType=7\nAccessType=rw\nDefaultValue={word:#x}\n");
        }
    }
    let options = Options { rust: everything(), ..Options::default() };
    let compilation = check(Source::new("shapes.eds", eds.into_bytes()), &options);
    let text = compilation.rust(&options.rust).expect("bindings");
    for number in 1..=4 {
        assert!(text.contains(&format!("pub struct TxPdo{number} ")), "{text}");
    }
    compile("shapes", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
    document("shapes", &[&text]).unwrap_or_else(|message| panic!("{message}\n{text}"));
}

#[test]
fn optional_implementations_are_gated() {
    let eds =
        std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/demo-drive.eds")).expect("the demo");
    let rust = RustOptions {
        debug: Presence::Never,
        partial_eq: Presence::Feature("eq".into()),
        serde: Presence::Feature("serde".into()),
        defmt: Presence::Feature("defmt".into()),
        ..RustOptions::default()
    };
    let compilation = check(Source::new("demo-drive.eds", eds), &Options::default());
    let text = compilation.rust(&rust).expect("bindings");
    assert!(text.contains("#[derive(Clone, Copy)]\n    #[cfg_attr(feature = \"eq\", derive(PartialEq))]"));
    assert!(text.contains("#[cfg_attr(feature = \"serde\", derive(serde::Serialize, serde::Deserialize))]"));
    assert!(!text.contains("Debug"));
    // Suppress the warning of rustc about features that the crate does not declare.
    compile("gated", &format!("#[allow(unexpected_cfgs)]\nmod inner {{\n{text}\n}}\npub use inner::*;\n"))
        .expect("it compiles");
}

/// Tests PDOs whose names also occur in generated code. Some of their entries are longer than a machine word, than the
/// maximum field length, or than the memory of any device.
#[test]
fn process_data_of_any_name_and_length_compile() {
    let entry = |index: u16, bits: u32| {
        format!(
            "<Entry><Index>#x{index:04X}</Index><SubIndex>1</SubIndex><BitLen>{bits}</BitLen><Name>data</Name></Entry>"
        )
    };
    let pdo = |index: u16, name: &str, entries: &str| {
        format!("<TxPdo Sm=\"0\"><Index>#x{index:04X}</Index><Name>{name}</Name>{entries}</TxPdo>")
    };
    let names = "Data Bytes Self image bit view at new rt word value LEN unpack pack B b \
                 clone into try_into into_it from_it as_it is_it next deref borrow";
    let pdos: String = names
        .split(' ')
        .zip(0..)
        .map(|(name, number)| pdo(0x1A00 + number, name, &(entry(0x6000, 3) + &entry(0x6001, 65 + u32::from(number)))))
        .collect();
    let last = pdo(0x1BFF, "Last", &entry(0x6000, 8));
    let module = pdo(0x1A00, "Long", &entry(0x6000, 65536));
    let esi = |long: &str| {
        format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>V</Name></Vendor><Descriptions><Devices>\
         <Device Physics=\"YY\"><Type ProductCode=\"1\" RevisionNo=\"1\">D</Type><Name>D</Name>\
         <Sm StartAddress=\"#x1100\" ControlByte=\"#x20\" Enable=\"1\">Inputs</Sm>{pdos}{long}{last}\
         <Slots><Slot MinInstances=\"0\" MaxInstances=\"1\"><ModuleIdent>1</ModuleIdent></Slot></Slots></Device></Devices>\
         <Modules><Module><Type ModuleIdent=\"1\">M</Type><Name>M</Name>{module}</Module></Modules>\
         </Descriptions></EtherCATInfo>"
    )
    };
    for (lengths, has_image) in [(&[][..], true), (&[65535, 65536], true), (&[u32::MAX, u32::MAX], false)] {
        let long = lengths.iter().zip(0..);
        let long: String = long.map(|(&bits, number)| pdo(0x1B00 + number, "Long", &entry(0x6000, bits))).collect();
        let options = Options { rust: everything(), ..Options::default() };
        let compilation = check(Source::new("lengths.xml", esi(&long).into_bytes()), &options);
        let text = compilation.rust(&options.rust).expect("bindings");
        // The compiler leaves out a process image if its length in bits does not fit into 32 bits.
        assert_eq!(text.contains("pub mod image {"), has_image);
        compile("lengths", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
        document("lengths", &[&text]).unwrap_or_else(|message| panic!("{message}\n{text}"));
    }
}
