//! Builds drive crates outside the workspace, as a user would. Only the full lane runs these tests, because each build
//! compiles the compiler again. The fast lane compiles `tests/drive-crate` as a member of the workspace.

#[path = "support/lane.rs"]
mod lane;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs Cargo in `folder`. Uses the workspace's lock file so that no other versions are downloaded.
fn cargo(folder: &Path, arguments: &[&str]) -> Output {
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("drive-crate"))
        .output()
        .expect("cargo runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_users_crate_compiles_and_its_tests_pass() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pump");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    let source = root().join("tests/drive-crate");
    for name in ["build.rs", "pump.eds", "src/lib.rs"] {
        std::fs::copy(source.join(name), folder.join(name)).expect("a file of the drive crate");
    }
    let manifest = std::fs::read_to_string(source.join("Cargo.toml")).expect("the manifest of the drive crate");
    let manifest = manifest.replace("../..", &root().display().to_string()) + "\n[workspace]\n";
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    let output = cargo(&folder, &["test", "--quiet"]);
    let out = text(&output.stdout);
    assert!(output.status.success(), "{out}\n{}", text(&output.stderr));
    assert!(out.contains("6 passed"), "{out}");
}

/// Creates a crate that consists of `files`. The crate depends on the runtime with all features that the macro can use.
fn crate_of(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2021\"\n[workspace]\n[dependencies]\n\
         lexibus = {{ path = {:?}, features = [\"macros\", \"serde\", \"defmt\"] }}\n\
         serde = {{ version = \"1\", default-features = false, features = [\"derive\"] }}\ndefmt = \"1\"\n",
        root()
    );
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    for (name, text) in files {
        std::fs::write(folder.join(name), text).expect("a temporary file");
    }
    folder
}

/// Creates a crate that contains only a call of `dictionary!` with `eds`.
fn macro_crate(name: &str, eds: &str, options: &str) -> PathBuf {
    let code = format!("lexibus::dictionary! {{\n    pub mod valve = \"valve.eds\" {{ {options} }}\n}}\n");
    crate_of(name, &[("valve.eds", eds), ("src/lib.rs", &code)])
}

const VALVE: &str = "[DeviceInfo]\nProductName=Valve\n[2000]\nParameterName=Opening\nDataType=0x0005\nAccessType=rw\n\
                     DefaultValue=012\n";

#[test]
fn the_macro_shows_the_line_of_an_error_at_its_path() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let folder = macro_crate("macro-error", VALVE, "strict: true");
    let output = cargo(&folder, &["check", "--quiet"]);
    let errors = text(&output.stderr);
    assert!(!output.status.success(), "a repair is an error in strict mode");
    for part in ["error[EDS020]", "valve.eds:7:14", "DefaultValue=012", "src/lib.rs:2:21"] {
        assert!(errors.contains(part), "`{part}` is missing:\n{errors}");
    }
}

#[test]
fn the_macro_warns_and_refuses_unknown_options() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let folder = macro_crate("macro-warning", VALVE, "");
    let output = cargo(&folder, &["check", "--quiet"]);
    let warnings = text(&output.stderr);
    assert!(output.status.success(), "{warnings}");
    assert!(warnings.contains("warning") && warnings.contains("valve.eds:7:14: 012"), "{warnings}");

    let calls = [
        ("{ acessors: true }", "unknown option `acessors`; did you mean `accessors`?", "src/lib.rs:2:35"),
        ("{ table: \"yes\" }", "write `true` without quotes", "src/lib.rs:2:42"),
        ("", "expected `;` or options in braces", "src/lib.rs:2:21"),
    ];
    for (options, message, position) in calls {
        let code = format!("lexibus::dictionary! {{\n    pub mod valve = \"valve.eds\" {options}\n}}\n");
        let folder = crate_of("macro-option", &[("valve.eds", VALVE), ("src/lib.rs", &code)]);
        let errors = text(&cargo(&folder, &["check", "--quiet"]).stderr);
        assert!(errors.contains(message) && errors.contains(position), "{errors}");
    }
}

/// A TPDO with an INTEGER24 and a field of three bits, and a TPDO with a time. The runtime defines the types of these fields.
const SENSOR: &str = "[DeviceInfo]\nProductName=Sensor\nGranularity=1\nNrOfRXPDO=0\nNrOfTXPDO=2\n\
    [1A00]\nParameterName=Mapping\nObjectType=9\n\
    [1A00sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [1A00sub1]\nParameterName=a\nDataType=7\nAccessType=ro\nDefaultValue=0x20000018\n\
    [1A00sub2]\nParameterName=b\nDataType=7\nAccessType=ro\nDefaultValue=0x20010003\n\
    [1A01]\nParameterName=Mapping\nObjectType=9\n\
    [1A01sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
    [1A01sub1]\nParameterName=a\nDataType=7\nAccessType=ro\nDefaultValue=0x20020030\n\
    [2000]\nParameterName=Position\nDataType=0x10\nAccessType=ro\nPDOMapping=1\n\
    [2001]\nParameterName=Bits\nDataType=5\nAccessType=ro\nPDOMapping=1\n\
    [2002]\nParameterName=Time\nDataType=0x0C\nAccessType=ro\nPDOMapping=1\n";

/// A submodule with 40 octets, single bits, an enumeration, a time and a record.
const THING: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ISO15745Profile xmlns="http://www.profibus.com/GSDML/2003/11/DeviceProfile"><ProfileBody>
<DeviceIdentity VendorID="0x1" DeviceID="0x2"><InfoText TextId="T"/><VendorName Value="Example"/></DeviceIdentity>
<DeviceFunction><Family MainFamily="I/O" ProductFamily="Example"/></DeviceFunction>
<ApplicationProcess><DeviceAccessPointList>
<DeviceAccessPointItem ID="D" PNIO_Version="V2.35" PhysicalSlots="0" FixedInSlots="0" ModuleIdentNumber="0x1"
 MinDeviceInterval="32" DNS_CompatibleName="example"><ModuleInfo><Name TextId="T"/><InfoText TextId="T"/></ModuleInfo>
<VirtualSubmoduleList><VirtualSubmoduleItem ID="S" SubmoduleIdentNumber="0x1"><IOData>
<Input><DataItem DataType="OctetString" Length="40" TextId="T"/>
<DataItem DataType="TimeOfDay with date indication" TextId="T"/></Input>
<Output><DataItem DataType="Unsigned8" UseAsBits="true" TextId="T"><BitDataItem BitOffset="3" TextId="T"/></DataItem>
<DataItem DataType="Float64" TextId="T"/></Output></IOData>
<RecordDataList><ParameterRecordDataItem Index="1" Length="50"><Name TextId="T"/>
<Ref ID="R" ValueItemTarget="V" DataType="BitArea" ByteOffset="0" BitLength="3" DefaultValue="0" TextId="T"/>
<Ref ID="Q" DataType="VisibleString" Length="40" ByteOffset="1" DefaultValue="name" TextId="T"/>
</ParameterRecordDataItem></RecordDataList><ModuleInfo><Name TextId="T"/><InfoText TextId="T"/></ModuleInfo>
</VirtualSubmoduleItem></VirtualSubmoduleList></DeviceAccessPointItem></DeviceAccessPointList>
<ValueList><ValueItem ID="V"><Assignments><Assign TextId="T" Content="0"/></Assignments></ValueItem></ValueList>
<ExternalTextList><PrimaryLanguage><Text TextId="T" Value="Thing"/></PrimaryLanguage></ExternalTextList>
</ApplicationProcess></ProfileBody></ISO15745Profile>
"#;

/// A register table with two messages. One message contains a text of 40 bytes, and the other contains a list of such texts.
const NAMES: &str = "lexibus = 1\n[device]\nname = \"Sign\"\nvendor = \"Example\"\n\
    [[messages]]\nname = \"Name\"\nrequest = [{ bytes = [1] }, { field = \"text\", type = \"str(40)\" }]\nreply = [{ bytes = [1] }]\n\
    [[messages]]\nname = \"Names\"\nrequest = [{ bytes = [2] }]\n\
    reply = [{ bytes = [2] }, { repeat = { max = 2, fields = [{ field = \"text\", type = \"str(40)\" }] } }]\n";

const TRAITS: &str = "lexibus::dictionary! {
    pub mod sensor = \"sensor.eds\" { serde: true, defmt: true, allow: \"warnings\" }
}
lexibus::dictionary! {
    pub mod thing = \"thing.gsdml.xml\" { serde: true, defmt: true, allow: \"warnings\" }
}
lexibus::dictionary! {
    pub mod sign = \"sign.toml\" { serde: true, defmt: true, allow: \"warnings\" }
}
use thing::submodules::thing::{Inputs, Outputs, ThingRecord};
fn both<T: serde::Serialize + for<'d> serde::Deserialize<'d> + defmt::Format>() {}
/// All types must implement the traits, including structs with long byte strings.
pub fn all() {
    both::<sensor::pdo::TxPdo1>();
    both::<sensor::pdo::TxPdo2>();
    both::<Inputs>();
    both::<Outputs>();
    both::<ThingRecord>();
    both::<thing::values::V>();
    both::<sign::messages::Name>();
    both::<sign::messages::NamesReplyEntry>();
}
";

#[test]
fn traits_of_other_crates_reach_every_generated_type() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let files = [("sensor.eds", SENSOR), ("thing.gsdml.xml", THING), ("sign.toml", NAMES), ("src/lib.rs", TRAITS)];
    let output = cargo(&crate_of("macro-traits", &files), &["check", "--quiet"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// Tests a crate with ten descriptions. If one description changes, the build script must rewrite only the bindings of this
/// description. If nothing changes, Cargo must run no command.
#[test]
fn a_change_rewrites_only_its_bindings() {
    const COUNT: usize = 10;
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ten-valves");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a temporary file");
    let manifest = format!(
        "[package]\nname = \"ten-valves\"\nversion = \"0.1.0\"\nedition = \"2021\"\n[workspace]\n\
         [dependencies]\nlexibus = {{ path = {:?} }}\n[build-dependencies]\nlexibus-codegen = {{ path = {:?} }}\n",
        root(),
        root().join("codegen")
    );
    write("Cargo.toml", &manifest);
    write(
        "build.rs",
        "fn main() -> Result<(), lexibus_codegen::BuildError> {\n    \
         (0..10).try_for_each(|at| lexibus_codegen::Builder::new().compile(format!(\"valve_{at}.eds\")))\n}\n",
    );
    let module = |at| format!("pub mod valve_{at} {{ include!(concat!(env!(\"OUT_DIR\"), \"/valve_{at}.rs\")); }}\n");
    write("src/lib.rs", &(0..COUNT).map(module).collect::<String>());
    (0..COUNT).for_each(|at| write(&format!("valve_{at}.eds"), VALVE));
    let build = || {
        let output = cargo(&folder, &["build", "-v"]);
        let log = text(&output.stderr);
        assert!(output.status.success(), "{log}");
        let running: Vec<String> = log.lines().filter(|line| line.contains("Running `")).map(str::to_owned).collect();
        running
    };
    build();
    let out = out_folder();
    let times = || -> Vec<_> {
        let time = |at| std::fs::metadata(out.join(format!("valve_{at}.rs"))).and_then(|file| file.modified());
        (0..COUNT).map(|at| time(at).expect("the bindings")).collect()
    };
    assert_eq!(build(), Vec::<String>::new(), "an unchanged build runs nothing");
    let before = times();
    // File systems store the times of files with limited resolution, and Cargo compares these times.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    write("valve_3.eds", &VALVE.replace("Opening", "Position"));
    let running = build();
    // Cargo runs the build script, and compiles the crate.
    assert!(running.len() == 2 && running[0].contains("build-script-build"), "{running:#?}");
    let after = times();
    let changed: Vec<usize> = (0..COUNT).filter(|at| before[*at] != after[*at]).collect();
    assert_eq!(changed, [3]);
    assert_eq!(build(), Vec::<String>::new(), "an unchanged build runs nothing");
}

/// Returns the newest folder into which the build script of `ten-valves` wrote.
fn out_folder() -> PathBuf {
    let builds = Path::new(env!("CARGO_TARGET_TMPDIR")).join("drive-crate/debug/build");
    let folders = std::fs::read_dir(builds).expect("the build folder").flatten().map(|entry| entry.path());
    let is_own =
        |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("ten-valves-"));
    let outs = folders.filter(is_own).map(|path| path.join("out")).filter(|out| out.join("valve_0.rs").is_file());
    outs.max_by_key(|out| std::fs::metadata(out).and_then(|out| out.modified()).ok()).expect("an output folder")
}

/// The first program of the book must print the output that the chapter shows. The test assembles the program from the blocks
/// of the chapter.
#[test]
fn the_crate_of_the_book() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pump-control");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("src")).expect("a folder for temporary files");
    std::fs::copy(root().join("docs/examples/pump.eds"), folder.join("pump.eds")).expect("the description");
    let chapter = std::fs::read_to_string(root().join("docs/src/getting-started.md")).expect("the chapter");
    let mut printed = None;
    for part in chapter.split("<!-- file: ").skip(1) {
        let (name, rest) = part.split_once(" -->\n```").expect("a block after its file name");
        let (_, rest) = rest.split_once('\n').expect("a block");
        let (block, _) = rest.split_once("\n```").expect("the end of a block");
        match name {
            "output" => printed = block.strip_prefix("$ cargo run\n").map(str::to_owned),
            "Cargo.toml" => {
                // Use the crates of this workspace in place of the published crates.
                let dependency = |name: &str, path: &Path| format!("{name} = {{ path = {path:?} }}\n");
                let patch = dependency("lexibus", root()) + &dependency("lexibus-codegen", &root().join("codegen"));
                let manifest = format!("{block}\n\n[workspace]\n\n[patch.crates-io]\n{patch}");
                std::fs::write(folder.join(name), manifest).expect("a manifest");
            }
            _ => std::fs::write(folder.join(name), format!("{block}\n")).expect("a file of the chapter"),
        }
    }
    let output = cargo(&folder, &["run", "--quiet"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout).trim_end(), printed.expect("the output differs from the chapter"));
}
