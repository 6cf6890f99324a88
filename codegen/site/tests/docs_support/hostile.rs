//! Device descriptions whose texts contain markup.

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../../tests/support/root.rs"]
mod root;

use lexibus_codegen::source::Source;

/// A TOML string with markup, quotes and URLs.
const HOSTILE: &str =
    "<script>alert(1)</script><img src=x onerror=alert(2)>\\\" ' onload=alert(3) </title></table>&lt; http://x";

/// Returns names and sources of descriptions whose texts contain the markup of [`HOSTILE`].
pub fn descriptions() -> Vec<(String, Source)> {
    let hostile = HOSTILE.replace("\\\"", "");
    let eds = format!(
        "[FileInfo]\nDescription={hostile}\n[DeviceInfo]\nVendorName={hostile}\nProductName={hostile}\nOrderCode={hostile}\n\
         [MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n[1000]\nParameterName={hostile}\nDataType=0x0009\nAccessType=ro\n\
         DefaultValue={hostile}\nDenotation={hostile}\n[Comments]\nLines=1\nLine1={hostile}\n"
    );
    let xml = hostile.replace('&', "&amp;").replace('<', "&lt;");
    let esi = data("coupler.esi.xml");
    let esi = esi.replace("</Name>", &format!("{xml}</Name>")).replace("</Comment>", &format!("{xml}</Comment>"));
    let gsdml = data("drive.gsdml.xml");
    let gsdml = gsdml.replace(" Value=\"", &format!(" Value=\"{}", xml.replace('"', "&quot;")));
    vec![
        (hostile.clone(), Source::new("h.eds", eds.into())),
        ("esi".to_owned(), Source::new("h.xml", esi.into())),
        ("gsdml".to_owned(), Source::new("h.xml", gsdml.into())),
        ("table".to_owned(), Source::new("h.toml", table().into())),
    ]
}

fn data(name: &str) -> String {
    let path = root::root().join("tests/data").join(name);
    std::fs::read_to_string(path).expect("a description")
}

/// Returns a register table in which all texts contain the markup.
pub fn table() -> String {
    format!(
        "lexibus = 1\n[device]\nname = \"{HOSTILE}\"\nvendor = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\nbuses = [\"modbus\", \"serial\"]\n\
         doubt = {{ says = \"{HOSTILE}\", chose = \"{HOSTILE}\", why = \"{HOSTILE}\" }}\n[manual]\nlanguage = \"it\"\n\
         [spaces.register]\nmodbus = {{ table = \"holding\" }}\n[[chapters]]\ntitle = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\n[chapters.registers]\n\
         \"{HOSTILE}\" = {{ reg = 1, type = \"u16\", access = \"rw\", unit = \"{HOSTILE}\", orig = \"{HOSTILE}\", doc = \"{HOSTILE}\", \
         effects = [\"{HOSTILE}\"], bits = {{ 0 = {{ name = \"{HOSTILE}\", doc = \"{HOSTILE}\" }}, \"2-1\" = {{ name = \"x\", values = {{ 1 = \"{HOSTILE}\" }} }} }} }}\n\
         mode = {{ reg = 2, type = \"u16\", access = \"rw\", enum = {{ 1 = \"{HOSTILE}\" }} }}\n\
         [codes.\"{HOSTILE}\"]\ncolumns = [\"{HOSTILE}\"]\n[codes.\"{HOSTILE}\".rows]\n1 = {{ name = \"{HOSTILE}\", doc = \"{HOSTILE}\", cells = [\"{HOSTILE}\"] }}\n\
         [machines.\"{HOSTILE}\"]\nstatus = \"mode\"\ndoc = \"{HOSTILE}\"\n[machines.\"{HOSTILE}\".states]\n\"{HOSTILE}\" = {{ mask = 1, value = 1 }}\nidle = {{ mask = 1, value = 0 }}\n\
         [machines.\"{HOSTILE}\".commands]\n\"{HOSTILE}\" = {{ mask = 1, value = 1 }}\n\
         [[machines.\"{HOSTILE}\".transitions]]\nfrom = \"idle\"\nto = \"{HOSTILE}\"\ncommand = \"{HOSTILE}\"\n\
         [procedures.\"{HOSTILE}\"]\ndoc = \"{HOSTILE}\"\nsteps = [{{ manual = \"{HOSTILE}\" }}]\n\
         [[messages]]\nname = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\nrequest = [{{ field = \"{HOSTILE}\", type = \"u8\", doc = \"{HOSTILE}\" }}]\n"
    )
}
