//! Creates the documentation sites that the scripts open. Each site that several scripts open is created only once. Most
//! scripts open the site of the four drives.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use lexibus_codegen::compile::{check, Options};
use lexibus_site::{Page, Site};

use crate::hostile as descriptions;

/// Creates an empty folder for temporary files.
pub fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

/// Runs `lexibus docs` for `descriptions`. Returns the folder of the site.
fn documented(name: &str, descriptions: &[&str]) -> PathBuf {
    let site = folder(name);
    let dictionaries = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
    let paths = descriptions.iter().map(|name| dictionaries.join(name));
    lexibus(|command| command.arg("docs").args(paths).arg("--out").arg(&site), &[0]);
    site
}

/// Runs `lexibus`. The exit code must be one of `codes`.
fn lexibus(arguments: impl FnOnce(&mut Command) -> &mut Command, codes: &[i32]) {
    let output = arguments(&mut Command::new(env!("CARGO_BIN_EXE_lexibus"))).output().expect("lexibus runs");
    let code = output.status.code().expect("an exit code");
    assert!(codes.contains(&code), "exit code {code}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Returns the site with the four drives whose manuals are transcribed as tables.
pub fn drives() -> PathBuf {
    const ALL: [&str; 4] = ["aec-vector-step.toml", "eco.toml", "hsd-sm137-sm140.toml", "kollmorgen-akd.toml"];
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    SITE.get_or_init(|| documented("drives", &ALL)).clone()
}

/// Returns the site of a single drive.
pub fn alone() -> PathBuf {
    documented("alone", &["demo-drive.eds"])
}

/// Returns the site of a PROFINET device with modules.
pub fn modular() -> PathBuf {
    documented("modular", &["../tests/data/drive.gsdml.xml"])
}

/// Returns the site of a PROFINET station with parameter records.
pub fn station() -> PathBuf {
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    SITE.get_or_init(|| documented("station", &["../tests/data/safe.gsdml.xml"])).clone()
}

/// Returns the site of a CANopen network and an EtherCAT segment.
pub fn networks() -> PathBuf {
    const SEGMENT: &str = "[segment]\ncycle = 1000\n[segment.subdevices.terminals]\ndevice = \"coupler.esi.xml\"\n\
        model = \"CP-32\"\nmodules = { 0 = \"DI-16\", 1 = \"DO-8\", 3 = 0x3001 }\n[segment.subdevices.axis]\n\
        device = \"coupler.esi.xml\"\nmodel = \"SV-1\"\ndc = \"DC\"\nparameters = { \"0x2000:2\" = 250 }\n";
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    let site = SITE.get_or_init(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let (source, site) = (folder("networks-source"), folder("networks"));
        let segment = source.join("segment.toml");
        std::fs::write(&segment, SEGMENT).expect("a temporary file");
        std::fs::copy(root.join("tests/data/coupler.esi.xml"), source.join("coupler.esi.xml")).expect("a description");
        let network = root.join("examples/network/network.toml");
        lexibus(|command| command.arg("docs").args([&network, &segment]).arg("--out").arg(&site), &[0]);
        site
    });
    site.clone()
}

/// Returns the site of an EtherCAT coupler and an EtherCAT drive. The drive has PDOs with a changeable mapping.
pub fn ethercat() -> PathBuf {
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    SITE.get_or_init(|| documented("ethercat", &["../tests/data/coupler.esi.xml"])).clone()
}

/// Returns a site with EtherCAT terminals. One of the terminals is described in two revisions. The site also compares
/// two descriptions.
pub fn terminals() -> PathBuf {
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    SITE.get_or_init(write_terminals).clone()
}

fn write_terminals() -> PathBuf {
    let entry = |ty: &str, bits: u8| {
        format!(
            "<Entry><Index>#x7010</Index><SubIndex>1</SubIndex><BitLen>{bits}</BitLen><Name>Set counter value</Name>\
             <DataType>{ty}</DataType></Entry>"
        )
    };
    let device = |product: &str, revision: &str, name: &str, entry: String| {
        format!(
            "<Device Physics=\"YY\"><Type ProductCode=\"{product}\" RevisionNo=\"{revision}\">{name}</Type><Name>{name}</Name>\
             <GroupType>Terminals</GroupType><RxPdo Fixed=\"1\"><Index>#x1600</Index><Name>Outputs</Name>{entry}</RxPdo></Device>"
        )
    };
    let devices = [
        device("#x04C22C52", "#x00110000", "T1218 counter", entry("UINT", 16)),
        device("#x04C22C52", "#x00120000", "T1218 counter", entry("UDINT", 32)),
        device("#x03F03052", "#x00100000", "T1008 inputs", entry("USINT", 8)),
    ];
    let file = |devices: &[String]| {
        format!(
            "<EtherCATInfo><Vendor><Id>#x77</Id><Name>Example Terminals</Name></Vendor><Descriptions><Groups><Group>\
             <Type>Terminals</Type><Name>Terminals</Name></Group></Groups><Devices>{}</Devices></Descriptions></EtherCATInfo>",
            devices.concat()
        )
    };
    let (source, site) = (folder("terminals-source"), folder("terminals"));
    let [old, path] = ["old", "terminals"].map(|name| source.join(name).with_extension("xml"));
    std::fs::write(&old, file(&devices[..1])).expect("a temporary file");
    std::fs::write(&path, file(&devices)).expect("a temporary file");
    lexibus(
        |command| command.arg("docs").arg(&path).arg("--compare").args([&old, &path]).arg("--out").arg(&site),
        &[0],
    );
    site
}

/// Returns a site with 300 devices. Their names are so long that the list of devices needs two pages.
pub fn many() -> PathBuf {
    let long = "x".repeat(1000);
    let device = |number: usize| {
        format!(
            "<Device Physics=\"YY\"><Type ProductCode=\"{}\" RevisionNo=\"1\">T{number:03}</Type>\
             <Name>Terminal {number:03} {long}</Name><GroupType>Terminals</GroupType></Device>",
            number + 1
        )
    };
    let devices: String = (0..300).map(device).collect();
    let text = format!(
        "<EtherCATInfo><Vendor><Id>#x77</Id><Name>Example Terminals</Name></Vendor><Descriptions><Groups><Group>\
         <Type>Terminals</Type><Name>Terminals</Name></Group></Groups><Devices>{devices}</Devices></Descriptions></EtherCATInfo>"
    );
    let (source, site) = (folder("many-source"), folder("many"));
    let path = source.join("many.xml");
    std::fs::write(&path, text).expect("a temporary file");
    lexibus(|command| command.arg("docs").arg(&path).arg("--out").arg(&site), &[0]);
    site
}

/// Returns a site with 2,000 registers of eight fields each.
pub fn large() -> PathBuf {
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    SITE.get_or_init(write_large).clone()
}

fn write_large() -> PathBuf {
    let field = |at: usize| {
        format!("\"{}-{}\" = {{ name = \"field {at}\", number = true, doc = \"What it does\" }}", 2 * at + 1, 2 * at)
    };
    let fields = (0..8).map(field).collect::<Vec<_>>().join(", ");
    let row = |register: usize| {
        format!("register_{register} = {{ reg = {register}, type = \"u16\", access = \"rw\", doc = \"Number {register} of many\", bits = {{ {fields} }} }}\n")
    };
    let rows: String = (0..2000).map(row).collect();
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Large\"\nbuses = [\"modbus\"]\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"Registers\"\n[chapters.registers]\n{rows}"
    );
    let (source, site) = (folder("large-source"), folder("large"));
    let path = source.join("large.toml");
    std::fs::write(&path, table).expect("a temporary file");
    lexibus(|command| command.arg("docs").arg(&path).arg("--out").arg(&site), &[0]);
    site
}

/// Returns a site for descriptions that contain markup. The file `diff.html` of the site compares two versions of a
/// description.
pub fn hostile() -> PathBuf {
    let root = folder("hostile");
    let (mut site, mut pages) = (Site::default(), Vec::new());
    for (name, source) in descriptions::descriptions() {
        let catalog = check(source, &Options::default()).catalog.expect("a device");
        pages.extend(site.add(&name, &catalog));
    }
    pages.extend(site.finish());
    pages.iter().for_each(|page| write(&root, page));
    difference(&root);
    root
}

fn write(root: &Path, page: &Page) {
    let path = root.join(&page.path);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    std::fs::write(path, &page.text).expect("a page");
}

/// Writes an HTML comparison of two tables. The names of the files also contain markup.
fn difference(root: &Path) {
    let table = descriptions::table();
    let versions = [table.clone(), table.replace("reg = 1,", "reg = 3,").replace("alert(1)", "alert(4)")];
    let folder = folder("versions");
    let [old, new] = ["<img src=x onerror=alert(5)> old.toml", "<img src=x onerror=alert(6)> new.toml"]
        .map(|name| folder.join(name));
    for (path, text) in [&old, &new].into_iter().zip(versions) {
        std::fs::write(path, text).expect("a temporary file");
    }
    let out = root.join("diff.html");
    lexibus(|command| command.arg("diff").args([&old, &new]).args(["--format", "html", "--out"]).arg(&out), &[1]);
}
