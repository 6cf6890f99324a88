//! G01, G02, G08, G12: encodings, names of files, and the text list.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::{Encoding, Source};

use crate::support::*;

#[test]
fn g01_encodings() {
    let parts = Parts {
        languages: "<Language xml:lang=\"de\">\n<Text TextId=\"T_Device\" Value=\"Gerät\"/>\n</Language>\n",
        ..Parts::default()
    };
    let text = file(&parts).replace("Value=\"Maker\"", "Value=\"Müller – €\"");
    let declared = text.replace("encoding=\"utf-8\"", "encoding=\"iso-8859-1\"");
    let (cp1252, _, lossy) = encoding_rs::WINDOWS_1252.encode(&declared);
    assert!(!lossy);
    let utf8 = check(Source::new(NAME, text.as_bytes().to_vec()), &Options::default());
    for (bytes, encoding, codes) in [
        ([b"\xef\xbb\xbf", text.as_bytes()].concat(), Encoding::Utf8Bom, &["GSD009"][..]),
        // Bytes 0x80 to 0x9F are those of Windows-1252, whatever ISO 8859-1 has there.
        (cp1252.to_vec(), Encoding::Windows1252, &["GSD009"]),
        // What is UTF-8 is read so, whatever is declared.
        (declared.as_bytes().to_vec(), Encoding::Utf8, &["XML003", "GSD009"]),
    ] {
        let other = check(Source::new(NAME, bytes), &Options::default());
        let catalog = other.catalog.as_ref().expect("a catalogue");
        assert_eq!(catalog.files[0].encoding, encoding);
        assert_eq!(stripped(&other), stripped(&utf8));
        let device = &catalog.devices[0];
        assert_eq!((device.identity.vendor_name.as_str(), device.names[0].text.as_str()), ("Müller – €", "Gerät"));
        assert_eq!(other.diagnostics.list().iter().map(|found| found.code.id).collect::<Vec<_>>(), codes);
    }
    let undeclared = check(Source::new(NAME, encoding_rs::WINDOWS_1252.encode(&text).0.to_vec()), &Options::default());
    let found = undeclared.diagnostics.list().iter().find(|found| found.code.id == "XML003").expect("a finding");
    let place = undeclared.sources[0].position(found.span.start);
    assert_eq!((place.line, place.column), (6, 21));
}

#[test]
fn g02_names_of_files() {
    let text = file(&Parts::default());
    let versioned = text.replace(
        "<ISO15745Profile ",
        "<ISO15745Profile xsi:schemaLocation=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile \
         ..\\xsd\\GSDML-DeviceProfile-V2.42.xsd\" ",
    );
    for (name, lints) in [
        ("GSDML-V2.41-Maker-Pump-20211213.xml", 0),
        ("folder/GSDML-V2.25-#Maker-Pump one-20230311-013349.xml", 0),
        ("gsdml-v2.34-maker-pump-20200101.xml", 1),
        ("GSDML V2.34 Maker Pump.xml", 1),
        ("gsdml.xml", 1),
    ] {
        let plain = check(Source::new(name, text.as_bytes().to_vec()), &options(&["GSD003"]));
        assert_eq!(plain.diagnostics.list().len(), lints, "{name}");
        // It is a lint that nobody gets who doesn't ask for it.
        let quiet = check(Source::new(name, text.as_bytes().to_vec()), &Options::default());
        assert!(quiet.diagnostics.list().is_empty());
        // The version is that of the schema, also where the name says another.
        let other = check(Source::new(name, versioned.as_bytes().to_vec()), &options(&["GSD003"]));
        assert_eq!(other.catalog.as_ref().unwrap().devices[0].header.format_version, "2.42");
        let [found] = other.diagnostics.list() else { panic!("{name}: not one finding") };
        let place = other.sources[0].position(found.span.start);
        let expected = if lints == 0 { (2, 38) } else { (1, 1) };
        assert_eq!((found.code.id, (place.line, place.column)), ("GSD003", expected), "{name}");
    }
}

#[test]
fn g08_texts_that_are_missing() {
    let checked = inputs(
        "<DataItem DataType=\"Unsigned8\" TextId=\"T_None\"/>\n<DataItem DataType=\"Unsigned16\"/>\n\
         <DataItem DataType=\"Float32+Unsigned8\" TextId=\"T_Nothing\"/>",
    );
    let names: Vec<&str> = checked.input().image.fields.iter().map(|field| field.name.as_str()).collect();
    assert_eq!(names, ["T_None", "", "T_Nothing", "T_Nothing status"]);
    assert_eq!(checked.codes(), ["GSD008"; 3]);
    let expected = [
        checked.place_of("TextId=\"|T_None\""),
        checked.place_of("<|DataItem DataType=\"Unsigned16\""),
        // Once for the value and its status.
        checked.place_of("TextId=\"|T_Nothing\""),
    ];
    assert_eq!(checked.places("GSD008"), expected);
}

#[test]
fn g12_languages_that_lack_texts() {
    let all: String = ["Device", "Info", "Speed", "Torque", "Ready", "Fault", "Mode", "Off", "On", "Help"]
        .map(|text| format!("<Text TextId=\"T_{text}\" Value=\"fr {text}\"/>\n"))
        .concat();
    let languages = format!(
        "<Language xml:lang=\"de\">\n<Text TextId=\"T_Speed\" Value=\"Drehzahl\"/>\n</Language>\n\
         <Language xml:lang=\"fr\">\n{all}</Language>\n"
    );
    let submodule = "<IOData>\n<Input>\n<DataItem DataType=\"Unsigned8\" TextId=\"T_Speed\"/>\n\
                     <DataItem DataType=\"Unsigned8\" TextId=\"T_Torque\"/>\n</Input>\n</IOData>\n";
    let checked = read(&Parts { submodule, languages: &languages, ..Parts::default() });
    let names = |name: &str| -> Vec<(String, String)> {
        let names = checked.field(name).names.iter();
        names.map(|local| (local.language.to_string(), local.text.to_string())).collect()
    };
    let local = |language: &str, text: &str| (language.to_owned(), text.to_owned());
    assert_eq!(names("Speed"), [local("de", "Drehzahl"), local("fr", "fr Speed")]);
    // Where a language lacks a text, the name in the primary language stands for it.
    assert_eq!(names("Torque"), [local("fr", "fr Torque")]);
    let found = checked.assert_only("GSD009", "<Language xml:lang=\"de\">");
    assert!(found.message.starts_with("9 texts"), "{}", found.message);
}

#[test]
fn texts_that_are_listed_twice_or_not_used() {
    let languages = "<Language xml:lang=\"de\">\n<Text TextId=\"T_Device\" Value=\"Gerät\"/>\n\
                     <Text TextId=\"T_Device\" Value=\"Anderes\"/>\n<Text TextId=\"T_Only\" Value=\"Nur\"/>\n</Language>\n";
    let checked = read_with(&Parts { languages, ..Parts::default() }, &["GSD022"]);
    assert_eq!(checked.device().names[0].text, "Gerät");
    assert_eq!(checked.places("GSD010"), [checked.place_of("<Text TextId=\"|T_Device\" Value=\"Anderes")]);
    assert_eq!(checked.places("GSD022").len(), 9);
    assert_eq!(checked.places("GSD022").last(), Some(&checked.place_of("|T_Only")));
    assert_eq!(extension(&checked.catalog().extensions, "Text/de/T_Only"), Some("Nur"));
    assert_eq!(extension(&checked.catalog().extensions, "Text/primary/T_Speed"), Some("Speed"));
    // Nor has the primary language the text.
    assert_eq!(checked.places("GSD008"), [checked.place_of("|T_Only")]);
    let languages = "<Language xml:lang=\"de\">\n<Text TextId=\"T_Device\" Value=\"Gerät\"/>\n</Language>\n\
                     <Language xml:lang=\"de\">\n<Text TextId=\"T_Info\" Value=\"Auskunft\"/>\n</Language>\n";
    let checked = read(&Parts { languages, ..Parts::default() });
    let documentation = checked.device().documentation.as_ref().expect("a description");
    assert_eq!((documentation.text.as_str(), documentation.translations[0].text.as_str()), ("Info", "Auskunft"));
    assert_eq!(checked.places("GSD010"), [checked.place_of("|<Language xml:lang=\"de\">\n<Text TextId=\"T_Info\"")]);
    // The same text twice is one translation; another one is kept beside it.
    let languages = ["Gerät", "Gerät", "Antrieb", "Antrieb"]
        .map(|text| format!("<Language xml:lang=\"de\">\n<Text TextId=\"T_Device\" Value=\"{text}\"/>\n</Language>\n"));
    let checked = read(&Parts { languages: &languages.concat(), ..Parts::default() });
    let texts: Vec<&str> = checked.device().names.iter().map(|local| local.text.as_str()).collect();
    assert_eq!(texts, ["Gerät", "Antrieb"]);
    assert_eq!(checked.places("GSD010").len(), 3);
}

#[test]
fn a_long_text_does_not_multiply() {
    let items = "<DataItem DataType=\"Unsigned8\" TextId=\"T_Long\"/>\n".repeat(2_000);
    let submodule = format!("<IOData>\n<Input>\n{items}</Input>\n</IOData>\n");
    let text = file(&Parts { submodule: &submodule, ..Parts::default() });
    let long = format!("<PrimaryLanguage>\n<Text TextId=\"T_Long\" Value=\"{}\"/>", "x".repeat(100_000));
    let text = text.replace("<PrimaryLanguage>", &long);
    let compilation = check(Source::new(NAME, text.into_bytes()), &Options::default());
    assert_eq!(compilation.diagnostics.list().iter().map(|found| found.code.id).collect::<Vec<_>>(), ["IO003"]);
    let data = compilation.catalog.as_ref().unwrap().submodules[0].input.as_ref().unwrap();
    let copied: usize = data.image.fields.iter().map(|field| field.name.len()).sum();
    assert!(copied < 4_000_000, "{copied} bytes");
}
