//! Sites of documentation that the tests of their formats have in common.

use std::path::{Path, PathBuf};

use lexibus_codegen::backend::docs::{Format, Page, Site};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The pages of these sources.
pub fn site(format: Format, sources: Vec<(String, Source)>) -> Vec<Page> {
    let (mut site, mut pages) = (Site::new(format), Vec::new());
    for (name, source) in sources {
        let own = site.add_compilation(&name, &check(source, &Options::default()));
        assert!(!own.is_empty(), "{name}");
        pages.extend(own);
    }
    pages.extend(site.finish());
    pages
}

/// The pages of these files of the repository.
pub fn files(format: Format, paths: &[&str]) -> Vec<Page> {
    let read = |path: &&str| {
        let name = path.rsplit('/').next().unwrap_or(path).split('.').next().unwrap_or_default().to_owned();
        (name, Source::read(&root().join(path)).expect("a description"))
    };
    site(format, paths.iter().map(read).collect())
}

/// Descriptions of every format.
pub const ALL: [&str; 10] = [
    "dictionaries/aec-vector-step.toml",
    "dictionaries/demo-drive.eds",
    "dictionaries/eco.toml",
    "dictionaries/hsd-sm137-sm140.toml",
    "dictionaries/kollmorgen-akd.toml",
    "tests/data/coupler.esi.xml",
    "tests/data/drive.gsdml.xml",
    "tests/data/heads.gsdml.xml",
    "tests/data/hoist.toml",
    "tests/data/safe.gsdml.xml",
];

/// Text that would be markup, script or the end of something, where it isn't escaped.
pub const HOSTILE: &str =
    "<script>alert(1)</script><img src=x onerror=alert(2)>\\\" ' onload=alert(3) </title></table>&lt; http://x";

/// Descriptions of every format, with hostile text in each field.
pub fn hostile() -> Vec<(String, Source)> {
    let hostile = HOSTILE.replace("\\\"", "");
    let eds = format!(
        "[FileInfo]\nDescription={hostile}\n[DeviceInfo]\nVendorName={hostile}\nProductName={hostile}\nOrderCode={hostile}\n\
         [MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n[1000]\nParameterName={hostile}\nDataType=0x0009\nAccessType=ro\n\
         DefaultValue={hostile}\nDenotation={hostile}\n[Comments]\nLines=1\nLine1={hostile}\n"
    );
    let xml = hostile.replace('&', "&amp;").replace('<', "&lt;");
    let esi = std::fs::read_to_string(root().join("tests/data/coupler.esi.xml")).expect("an ESI");
    let esi = esi.replace("</Name>", &format!("{xml}</Name>")).replace("</Comment>", &format!("{xml}</Comment>"));
    let gsdml = std::fs::read_to_string(root().join("tests/data/drive.gsdml.xml")).expect("a GSDML");
    let gsdml = gsdml.replace(" Value=\"", &format!(" Value=\"{}", xml.replace('"', "&quot;")));
    let table = format!(
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
    );
    vec![
        (hostile.clone(), Source::new("h.eds", eds.into())),
        ("esi".to_owned(), Source::new("h.xml", esi.into())),
        ("gsdml".to_owned(), Source::new("h.xml", gsdml.into())),
        ("table".to_owned(), Source::new("h.toml", table.into())),
    ]
}
