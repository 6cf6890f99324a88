//! Tests properties of GSDML files that the cases in `tests/ui` cannot show: encodings, limits and damaged files.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::source::{Encoding, Source};

/// A valid GSDML file name.
const NAME: &str = "GSDML-V2.35-Maker-Pump-20200131.xml";

/// Returns a valid GSDML file. `submodule` is the content of its submodule, and `lists` contains additional lists.
fn file(submodule: &str, lists: &str) -> String {
    let texts: String = ["Device", "Speed", "Mode", "Off", "On"]
        .map(|text| format!("<Text TextId=\"T_{text}\" Value=\"{text}\"/>\n"))
        .concat();
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>
<ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\">
<ProfileBody>
<DeviceIdentity VendorID=\"0x0FFF\" DeviceID=\"0x0001\">
<VendorName Value=\"Maker\"/>
</DeviceIdentity>
<ApplicationProcess>
<DeviceAccessPointList>
<DeviceAccessPointItem ID=\"DAP\" ModuleIdentNumber=\"0x00000001\" PhysicalSlots=\"0..4\" FixedInSlots=\"0\">
<ModuleInfo><Name TextId=\"T_Device\"/></ModuleInfo>
<VirtualSubmoduleList>
<VirtualSubmoduleItem ID=\"SUB\" SubmoduleIdentNumber=\"0x00000001\">
{submodule}<ModuleInfo><Name TextId=\"T_Device\"/></ModuleInfo>
</VirtualSubmoduleItem>
</VirtualSubmoduleList>
</DeviceAccessPointItem>
</DeviceAccessPointList>
{lists}<ExternalTextList>
<PrimaryLanguage>
{texts}</PrimaryLanguage>
</ExternalTextList>
</ApplicationProcess>
</ProfileBody>
</ISO15745Profile>
"
    )
}

/// Returns the content of a submodule that has the inputs `items`.
fn inputs(items: &str) -> String {
    format!("<IOData>\n<Input>\n{items}</Input>\n</IOData>\n")
}

/// Returns the content of a submodule with one record.
fn record(length: u32, content: &str) -> String {
    format!(
        "<IOData/>\n<RecordDataList>\n<ParameterRecordDataItem Index=\"10\" Length=\"{length}\">\n<Name TextId=\"T_Mode\"/>\n\
         {content}\n</ParameterRecordDataItem>\n</RecordDataList>\n"
    )
}

fn read(bytes: impl Into<Vec<u8>>) -> Compilation {
    check(Source::new(NAME, bytes.into()), &Options::default())
}

/// Returns the codes of all diagnostics in their order.
fn codes(compilation: &Compilation) -> Vec<&'static str> {
    compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
}

/// Returns the IR as JSON, without files and positions.
fn without_spans(compilation: &Compilation) -> serde_json::Value {
    let mut value = serde_json::to_value(&compilation.catalog).expect("JSON");
    strip(&mut value);
    value
}

fn strip(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Object(fields) => {
            fields.retain(|key, _| !matches!(key.as_str(), "span" | "origin" | "at" | "name_at" | "files"));
            fields.values_mut().for_each(strip);
        }
        serde_json::Value::Array(values) => values.iter_mut().for_each(strip),
        _ => {}
    }
}

#[test]
fn g01_all_encodings_give_one_ir() {
    let text = file(&inputs("<DataItem DataType=\"Unsigned8\" TextId=\"T_Speed\"/>\n"), "");
    let text = text.replace("Value=\"Maker\"", "Value=\"Müller – €\"");
    let declared = text.replace("encoding=\"utf-8\"", "encoding=\"iso-8859-1\"");
    let (cp1252, _, lossy) = encoding_rs::WINDOWS_1252.encode(&declared);
    assert!(!lossy);
    let utf8 = read(text.as_bytes());
    assert!(utf8.catalog.is_some());
    for (bytes, encoding) in [
        ([b"\xef\xbb\xbf", text.as_bytes()].concat(), Encoding::Utf8Bom),
        (cp1252.into_owned(), Encoding::Windows1252),
        (declared.into_bytes(), Encoding::Utf8),
    ] {
        let other = read(bytes);
        assert_eq!(other.sources[0].encoding(), encoding);
        assert_eq!(without_spans(&other), without_spans(&utf8), "{encoding:?}");
    }
}

/// An empty value has no text to mark. The diagnostic must mark its quotation marks.
#[test]
fn g06_an_empty_default_is_reported_at_its_place() {
    let parameter = "<Ref ByteOffset=\"0\" TextId=\"T_Speed\" DataType=\"Unsigned8\" DefaultValue=\"\"/>";
    let text = file(&record(16, parameter), "");
    let compilation = read(text.as_bytes());
    assert_eq!(codes(&compilation), ["GSD013"]);
    let span = compilation.diagnostics.list()[0].span;
    let expected = text.find("DefaultValue=\"\"").expect("the attribute") + "DefaultValue=".len();
    assert_eq!((span.start as usize, &text[span.range()]), (expected, "\"\""));
}

#[test]
fn lengths_that_no_device_has_are_no_reason_to_panic() {
    let items = "<DataItem DataType=\"OctetString\" Length=\"65535\" TextId=\"T_Speed\"/>\n".repeat(9_000);
    let compilation = read(file(&inputs(&items), ""));
    let submodules = &compilation.catalog.as_ref().expect("a catalog").submodules;
    assert!(submodules[0].input.as_ref().expect("inputs").image.length > 0);
}

#[test]
fn named_values_do_not_multiply() {
    let values = "<Assign TextId=\"T_On\" Content=\"1\"/>\n".repeat(10_000);
    let lists =
        format!("<ValueList><ValueItem ID=\"V\"><Assignments>\n{values}</Assignments></ValueItem></ValueList>\n");
    let content: String = (1..=40)
        .map(|bits| {
            format!(
                "<Ref DataType=\"BitArea\" BitLength=\"{bits}\" ByteOffset=\"{}\" DefaultValue=\"0\" TextId=\"T_Mode\" \
                 ValueItemTarget=\"V\"/>\n",
                bits * 8
            )
        })
        .collect();
    let compilation = read(file(&record(400, &content), &lists));
    // The first of the 40 types is not a copy, and the limit allows 20 copies.
    assert_eq!(codes(&compilation), ["IO003"; 19]);
}

#[test]
fn a_long_text_does_not_multiply() {
    let items = "<DataItem DataType=\"Unsigned8\" TextId=\"T_Long\"/>\n".repeat(2_000);
    let long = format!("<PrimaryLanguage>\n<Text TextId=\"T_Long\" Value=\"{}\"/>", "x".repeat(100_000));
    let compilation = read(file(&inputs(&items), "").replace("<PrimaryLanguage>", &long));
    assert_eq!(codes(&compilation), ["IO003"]);
    let data = compilation.catalog.as_ref().unwrap().submodules[0].input.as_ref().unwrap();
    let copied: usize = data.image.fields.iter().map(|field| field.name.len()).sum();
    assert!(copied < 4_000_000, "{copied} bytes");
}

/// A file that is truncated or damaged at any position may cause errors but no panic.
#[test]
fn damage_anywhere_is_no_reason_to_panic() {
    let submodule = record(
        16,
        "<Const Data=\"0x01,0x02\"/>\n<Ref DataType=\"BitArea\" ByteOffset=\"3\" BitOffset=\"1\" BitLength=\"9\" DefaultValue=\"1\" \
         AllowedValues=\"0 2..7\" TextId=\"T_Speed\" ValueItemTarget=\"V\"/>",
    )
    .replace(
        "<IOData/>",
        "<IOData><Input><DataItem DataType=\"Unsigned16\" UseAsBits=\"true\" TextId=\"T_On\"><BitDataItem BitOffset=\"9\" \
         TextId=\"T_Off\"/></DataItem><DataItem DataType=\"OctetString_S\" Length=\"3\" TextId=\"T_On\"/></Input></IOData>",
    );
    let lists = "<ValueList><ValueItem ID=\"V\"><Assignments><Assign TextId=\"T_On\" Content=\"1..3\"/></Assignments>\
                 </ValueItem></ValueList>\n<LogBookEntryList><LogBookEntryItem Status=\"5\"/></LogBookEntryList>\n";
    let text = file(&submodule, lists);
    for at in (0..text.len()).step_by(3) {
        let Some(cut) = text.get(..at) else { continue };
        read(cut);
    }
    for (at, _) in text.match_indices(|letter: char| letter.is_ascii_digit()) {
        for digit in ["-", "99999999999", ".", "\u{e4}", ""] {
            let mut damaged = text.clone();
            damaged.replace_range(at..=at, digit);
            read(damaged);
        }
    }
}
