//! Tests the command line by running the `lexibus` program.

#[path = "../../codegen/tests/corpus_support/xsd.rs"]
mod xsd;

#[path = "../../tests/support/lane.rs"]
mod lane;

#[path = "../../tests/support/python.rs"]
mod python;
#[path = "../../tests/support/root.rs"]
mod root;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use xsd::Schema;

const DEMO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/demo-drive.eds");

const COUPLER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/coupler.esi.xml");

const QUIRKY: &str = "[DeviceInfo]\nProductName=Quirky\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
                      [2000]\nParameterName=Gain\nDataType=0x0006\nAccessType=rw\nDefaultValue=012\n";

/// Creates an empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a temporary file");
    path.to_string_lossy().into_owned()
}

fn lexibus(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lexibus")).args(arguments).output().expect("lexibus runs")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("an exit code")
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

#[test]
fn generate_writes_bindings_and_checks_them() {
    let folder = folder("generate");
    let path = folder.join("drive.rs").to_string_lossy().into_owned();
    let made = lexibus(&["generate", DEMO, "--out", &path]);
    assert_eq!(code(&made), 0, "{}", err(&made));
    let text = std::fs::read_to_string(&path).expect("the bindings");
    assert!(text.contains("pub struct DemoDrive<C>"));
    assert_eq!(out(&lexibus(&["generate", DEMO])), text, "standard output contains the same bytes");

    let deeper = folder.join("new/folder/").to_string_lossy().into_owned();
    assert_eq!(code(&lexibus(&["generate", DEMO, "--out", &deeper])), 0);
    assert!(folder.join("new/folder/demo_drive.rs").is_file());

    assert_eq!(code(&lexibus(&["generate", DEMO, "--out", &path, "--check"])), 0);
    std::fs::write(&path, text + "\n").expect("a stale file");
    let stale = lexibus(&["generate", DEMO, "--out", &path, "--check"]);
    assert_eq!(code(&stale), 1);
    assert!(err(&stale).contains("is stale"), "{}", err(&stale));
    std::fs::remove_file(&path).expect("no file");
    assert_eq!(code(&lexibus(&["generate", DEMO, "--out", &path, "--check"])), 1);
}

#[test]
fn generate_keeps_a_file_whose_bytes_do_not_change() {
    let folder = folder("unchanged");
    let path = folder.join("drive.rs");
    let call = ["generate", DEMO, "--out", path.to_str().expect("UTF-8")];
    lexibus(&call);
    let old = std::time::SystemTime::UNIX_EPOCH;
    std::fs::File::options().write(true).open(&path).and_then(|file| file.set_modified(old)).expect("an old file");
    lexibus(&call);
    assert_eq!(std::fs::metadata(&path).and_then(|data| data.modified()).expect("a time"), old);
}

#[test]
fn many_files_and_folders_go_to_a_folder() {
    let folder = folder("many");
    std::fs::create_dir_all(folder.join("in/deeper")).expect("folders");
    for name in ["in/a.eds", "in/deeper/B C.EDS", "in/deeper/a.dcf"] {
        file(&folder, name, QUIRKY);
    }
    file(&folder, "in/readme.txt", "not a description");
    let (input, output) = (folder.join("in"), folder.join("out"));
    let generated = lexibus(&["generate", input.to_str().expect("UTF-8"), "--out", output.to_str().expect("UTF-8")]);
    assert_eq!(code(&generated), 0, "{}", err(&generated));
    let mut names: Vec<_> = std::fs::read_dir(&output)
        .expect("the output")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["a.rs", "a_2.rs", "b_c.rs"]);
}

#[test]
fn findings_show_the_line_and_decide_the_exit_code() {
    let folder = folder("check");
    let path = file(&folder, "quirky.eds", QUIRKY);
    let lenient = lexibus(&["check", &path, "-A", "missing-mandatory-object"]);
    assert_eq!(code(&lenient), 0);
    let text = err(&lenient);
    assert!(text.contains("warning[EDS020]") && text.contains("quirky.eds:10:14"), "{text}");
    assert!(text.contains("DefaultValue=012") && !text.contains('\u{1b}'), "{text}");
    assert_eq!(code(&lexibus(&["check", &path, "--strict"])), 1);
    assert_eq!(code(&lexibus(&["check", &path, "-D", "octal-number"])), 1);
    assert_eq!(code(&lexibus(&["check", &path, "--strict", "-A", "EDS020"])), 0);
    assert_eq!(code(&lexibus(&["check", &path, "-D", "warnings", "-A", "warnings"])), 0, "the last setting counts");
    assert_eq!(code(&lexibus(&["check", &path, "-A", "warnings", "-D", "warnings"])), 1, "the last setting counts");
    let coloured = lexibus(&["check", &path, "--color", "always"]);
    assert!(err(&coloured).contains('\u{1b}'));
}

#[test]
fn only_the_first_warning_of_a_code_is_in_full() {
    let folder = folder("limited");
    let objects = |count: u32| {
        (0..count).map(|index| {
            format!("[{:X}]\nParameterName=Gain\nDataType=0x0006\nDefaultValue=01{index}\n", 0x2000 + index)
        })
    };
    let text = format!("[DeviceInfo]\nProductName=Octal\n{}", objects(5).collect::<String>());
    let path = file(&folder, "octal.eds", &text);
    let marked = |text: &str| text.matches("^^^ read as").count();

    let some = err(&lexibus(&["check", &path]));
    assert_eq!(some.matches("warning[EDS020]").count(), 3, "{some}");
    assert_eq!((marked(&some), some.matches("= note: read as").count()), (1, 2), "{some}");
    assert!(some.contains("and 2 more of EDS020 (--all)"), "{some}");

    let all = err(&lexibus(&["check", "--all", &path]));
    assert_eq!((all.matches("warning[EDS020]").count(), marked(&all)), (5, 5), "{all}");
}

#[test]
fn findings_for_machines() {
    let folder = folder("machines");
    let path = file(&folder, "quirky.eds", QUIRKY);
    let json = lexibus(&["check", &path, "--message-format", "json"]);
    let lines: Vec<serde_json::Value> =
        out(&json).lines().map(|line| serde_json::from_str(line).expect("a JSON line")).collect();
    let octal = lines.iter().find(|line| line["code"] == "EDS020").expect("the finding");
    assert_eq!((octal["line"].as_u64(), octal["column"].as_u64()), (Some(10), Some(14)));
    let sarif = lexibus(&["check", &path, DEMO, "--message-format", "sarif"]);
    let log: serde_json::Value = serde_json::from_str(&out(&sarif)).expect("a JSON document");
    assert_eq!(log["version"], "2.1.0");
    assert!(log["runs"][0]["results"].as_array().is_some_and(|results| !results.is_empty()));
}

#[test]
fn info_prints_a_json_object_a_line() {
    let folder = folder("info");
    let path = file(&folder, "cip.eds", "[File]\nDescText = \"x\";\n[Device]\nVendCode = 1;\n");
    let info = lexibus(&["info", "--format", "json", DEMO, &path, "no such file.eds"]);
    assert_eq!(code(&info), 1, "two of the files have errors");
    let lines: Vec<serde_json::Value> =
        out(&info).lines().map(|line| serde_json::from_str(line).expect("a JSON line")).collect();
    assert_eq!(lines.len(), 3);
    let device = &lines[0]["devices"][0];
    assert_eq!((lines[0]["format"].as_str(), lines[0]["encoding"].as_str()), (Some("eds"), Some("utf-8")));
    assert_eq!((device["name"].as_str(), device["product_code"].as_u64()), (Some("Demo Drive"), Some(0x4021)));
    assert_eq!((device["objects"].as_u64(), device["entries"].as_u64()), (Some(32), Some(59)));
    let pdo = serde_json::json!({"index": 0x1601, "entries": 2, "bits": 48});
    assert_eq!(device["rx_pdos"][1], pdo);
    assert_eq!(lines[1]["errors"], serde_json::json!({"EDS001": 1}));
    assert_eq!(lines[1]["format"], serde_json::Value::Null);
    assert_eq!(lines[2]["errors"], serde_json::json!({"IO001": 1}));
}

#[test]
fn dump_is_the_ir_as_json() {
    let dump = lexibus(&["dump", DEMO]);
    let text = out(&dump);
    let catalog: lexibus_codegen::ir::Catalog = serde_json::from_str(&text).expect("the IR");
    assert_eq!(catalog.devices[0].entry(0x607A, 0).expect("an entry").name, "Target position");
    assert_eq!(lexibus_export::json::dump(&catalog) + "\n", text, "the IR is the same after a round trip");
}

#[test]
fn explain_and_completions() {
    let explained = lexibus(&["explain", "octal-number"]);
    assert!(out(&explained).contains("EDS020"));
    assert!(out(&lexibus(&["explain"])).lines().count() > 60);
    let unknown = lexibus(&["explain", "EDS999x"]);
    assert_eq!(code(&unknown), 2);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(out(&lexibus(&["completions", shell])).contains("lexibus"), "{shell}");
    }
}

#[test]
fn wrong_calls_have_exit_code_2() {
    let folder = folder("usage");
    for call in [
        &["generate"][..],
        &["frobnicate"],
        &["check", DEMO, "-D", "no-such-code"],
        &["check", folder.to_str().expect("UTF-8")],
        &["generate", DEMO, DEMO],
        &["generate", DEMO, "--check"],
        &["generate", DEMO, "--runtime", "a b; c"],
        &["check", DEMO, "--jobs", "0"],
        &["check", DEMO, "--jobs", "99999"],
    ] {
        assert_eq!(code(&lexibus(call)), 2, "{call:?}");
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_jobs() {
    let folder = folder("jobs");
    for number in 0..20 {
        file(&folder, &format!("{number}.eds"), QUIRKY);
    }
    let path = folder.to_str().expect("UTF-8");
    let one = lexibus(&["check", path, "--message-format", "json", "--jobs", "1"]);
    let many = lexibus(&["check", path, "--message-format", "json", "--jobs", "8"]);
    assert_eq!(out(&one), out(&many));
    assert!(out(&one).lines().count() >= 20);
}

/// Control characters in a description or its path must not reach the terminal or start a new line.
#[test]
#[cfg(unix)]
fn control_characters_stay_out_of_what_is_printed() {
    let folder = folder("control");
    let hostile = "G\u{1b}[2Jain\u{7}\u{202e}";
    let quirky = QUIRKY.replace("Gain", hostile).replace("Quirky", "Quir\u{1b}[31mky");
    let old = file(&folder, "a\u{1b}[31m.eds", &quirky);
    let new = file(&folder, "b\nbreaks api: all.eds", &quirky.replace("rw", "ro"));
    let esi = std::fs::read_to_string(COUPLER).expect("the coupler");
    let esi = esi.replace("CP-32 coupler", "Cou&#10;breaks api: pler\u{9b}");
    let modular = file(&folder, "c\u{1b}c.xml", &esi);
    let missing = folder.join("no\u{1b}[2J\nerror: file.eds").to_string_lossy().into_owned();
    // Each command is followed by a part of the hostile text that its output must contain.
    let calls: [(&[&str], &str); 8] = [
        (&["diff", &old, &new], "ain"),
        (&["diff", &modular, &old], "pler"),
        (&["info", &old], "ky"),
        (&["info", &modular], "pler"),
        (&["check", &new], "breaks api: all"),
        (&["export", "--format", "gsdml", &old], "31m"),
        (&["check", &missing], "error: file"),
        (&["diff", &missing, &old], "error: file"),
    ];
    for (call, shown) in calls {
        let output = lexibus(call);
        let text = out(&output) + &err(&output);
        assert!(text.contains(shown), "{call:?}: {text:?}");
        let steers = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
        assert!(!text.contains(steers), "{call:?}: {text:?}");
        assert!(
            !text.lines().any(|line| line.starts_with("breaks api: all") || line.starts_with("breaks api: pler")),
            "{text}"
        );
        assert!(!text.lines().any(|line| line.starts_with("error: file")), "{text}");
    }
}

/// Example files of the repository in all formats.
const EXAMPLES: [&str; 10] = [
    "dictionaries/demo-drive.eds",
    "dictionaries/aec-vector-step.toml",
    "dictionaries/kollmorgen-akd.toml",
    "dictionaries/hsd-sm137-sm140.toml",
    "dictionaries/eco.toml",
    "tests/data/coupler.esi.xml",
    "tests/data/drive.gsdml.xml",
    "benches/instructions/axis.esi.xml",
    "codegen/fuzz/seeds/xdd/gripper.xdd",
    "codegen/tests/quirks_eds/everything.dcf",
];

fn examples() -> Vec<String> {
    EXAMPLES.iter().map(|path| format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))).collect()
}

/// The command line and `build.rs` must generate the same code. `macros/src/lib.rs` contains this test for the macro.
#[test]
fn the_command_line_and_the_build_script_give_the_same_bytes() {
    for path in examples() {
        let by_builder = lexibus_codegen::Builder::new().quiet().generate(&path).expect("bindings");
        assert_eq!(out(&lexibus(&["generate", &path, "-A", "warnings"])), by_builder, "{path}");
    }
    let [pump, overlay] = ["docs/examples/pump.eds", "docs/examples/pump.overlay.toml"]
        .map(|path| format!("{}/../{path}", env!("CARGO_MANIFEST_DIR")));
    let builder = lexibus_codegen::Builder::new().quiet().overlay(&overlay).device("Pump").objects("0x2000..0x2FFF");
    let by_builder = builder.accessors(false).generate(&pump).expect("bindings");
    let call =
        ["generate", &pump, "-A", "warnings", "--overlay", &overlay, "--device", "Pump", "--objects", "0x2000..0x2FFF"];
    let by_command = lexibus(&[&call[..], &["--no-accessors"]].concat());
    assert_eq!(out(&by_command), by_builder, "{}", err(&by_command));
}

/// Returns the paths and contents of all files in a folder.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files.extend(contents(&path)),
            false => files.push((path.clone(), std::fs::read(&path).expect("a file"))),
        }
    }
    files.sort();
    files
}

#[test]
fn output_depends_neither_on_the_order_of_files_nor_on_the_number_of_jobs() {
    let folder = folder("order");
    // Create two input files with the same name. The second output must get a number.
    let twin = folder.join("in");
    std::fs::create_dir_all(&twin).expect("a folder");
    let mut files = examples();
    files.push(file(&twin, "demo-drive.eds", QUIRKY));
    // Facts that an ESI requires and that files in other formats do not contain.
    const FACTS: [&str; 7] =
        ["vendor-id=1", "vendor-name=V", "physics=YY", "product-code=2", "revision=3", "group=G", "order-code=O"];
    for (command, format) in [("generate", ""), ("docs", ""), ("export", "eds"), ("export", "esi"), ("export", "gsdml")]
    {
        let made = |order: &[String], jobs: &str| {
            let out = folder.join("out");
            let _ = std::fs::remove_dir_all(&out);
            let out_path = out.to_string_lossy().into_owned();
            let mut call = vec![command, "-A", "warnings", "--jobs", jobs, "--out", &out_path];
            if !format.is_empty() {
                call.extend(["--format", format]);
            }
            if format == "esi" {
                call.extend(FACTS.iter().flat_map(|fact| ["--set", fact]));
            }
            call.extend(order.iter().map(String::as_str));
            let output = lexibus(&call);
            (contents(&out), self::out(&output), err(&output))
        };
        let expected = made(&files, "1");
        // Only a few of the examples describe PROFINET devices.
        let least = if format == "gsdml" { 1 } else { 5 };
        assert!(expected.0.len() >= least, "{command} {format}: {}", expected.2);
        let mut order = files.clone();
        let all_jobs: &[&str] = if lane::is_full() { &["1", "2", "7"] } else { &["2"] };
        for &jobs in all_jobs {
            order.rotate_left(2);
            order.swap(0, 3);
            assert!(
                made(&order, jobs) == expected,
                "{command} {format}: another output for {order:?} with {jobs} jobs"
            );
        }
    }
}

#[test]
#[cfg(unix)]
fn links_and_pipes_in_a_folder() {
    let folder = folder("links");
    let deep = folder.join("a/b");
    std::fs::create_dir_all(&deep).expect("a folder");
    file(&deep, "drive.eds", QUIRKY);
    // Each folder contains two links to its parent. A search that follows all links would visit 2^32 paths.
    for name in ["one", "other"] {
        std::os::unix::fs::symlink(&folder, deep.join(name)).expect("a link");
    }
    let pipe = folder.join("pipe.eds");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs").success());
    let found = lexibus(&["check", folder.to_str().expect("UTF-8"), "--message-format", "json"]);
    assert_eq!(code(&found), 0, "{}", err(&found));
    let places = out(&found).lines().filter(|line| line.contains("drive.eds")).count();
    assert_eq!(
        places,
        out(&lexibus(&["check", &folder.join("a/b/drive.eds").to_string_lossy(), "--message-format", "json"]))
            .lines()
            .count()
    );
}

#[test]
fn of_many_devices_those_that_are_selected() {
    let generate = |arguments: &[&str]| {
        let output = lexibus(&[&["generate", COUPLER, "-A", "warnings"], arguments].concat());
        assert_eq!(code(&output), 0, "{}", err(&output));
        out(&output)
    };
    let all = generate(&[]);
    assert!(["pub mod cp_32 {", "pub mod sv_1 {", "pub mod modules {"].iter().all(|part| all.contains(part)));
    let drive = generate(&["--device", "0x00A10002@0x00020001", "--objects", "0x6000..0xFFFF"]);
    assert!(drive.contains("pub struct Sv1<C>") && drive.contains("TARGET_POSITION"));
    for absent in ["cp_32", "mod modules", "0x2000:", "MOTOR"] {
        assert!(!drive.contains(absent), "{absent}");
    }
    // The selection of objects must not change the layout of PDOs.
    assert!(drive.contains("pub struct PositionMode"));
    let coupler = generate(&["--device", "cp-*", "--module", "DI-16", "--module", "0x2001"]);
    assert!(coupler.contains("pub mod di_16 {") && coupler.contains("pub mod do_8 {") && !coupler.contains("ai_2"));

    let wrong = lexibus(&["generate", COUPLER, "--device", "SV-2"]);
    assert_eq!((code(&wrong), out(&wrong)), (1, String::new()));
    assert!(err(&wrong).contains("IO004") && err(&wrong).contains("write `SV-1`"), "{}", err(&wrong));
    let wrong = lexibus(&["generate", COUPLER, "--objects", "0x6000..x"]);
    assert_eq!(code(&wrong), 2);
    assert!(err(&wrong).contains("expected 0x6040 or 0x6000..0x67FF"), "{}", err(&wrong));
}

#[test]
fn info_lists_devices_and_modules() {
    let text = out(&lexibus(&["info", COUPLER]));
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    let has = |row: &[&str]| rows.iter().any(|cells| cells.starts_with(row));
    assert!(has(&["SV-1", "SV-1", "0x00020001", "0x00A10002", "8", "10", "4", "SV-1", "servo", "drive"]), "{text}");
    assert!(has(&["AI-2", "0x00003001", "1", "objects,", "2", "entries,", "1", "PDOs", "2", "analogue"]), "{text}");
    let json = out(&lexibus(&["info", "--format", "json", COUPLER]));
    let info: serde_json::Value = serde_json::from_str(&json).expect("one object");
    assert_eq!((info["format"].as_str(), info["devices"].as_array().map(Vec::len)), (Some("esi"), Some(2)));
    assert_eq!(info["devices"][1]["rx_pdos"][0], serde_json::json!({"index": 0x1600, "entries": 2, "bits": 48}));
    assert_eq!(info["modules"][2]["tx_pdos"][0], serde_json::json!({"index": 0x1A00, "entries": 5, "bits": 40}));
    assert!(info.get("daps").is_none());
}

#[test]
fn what_describes_no_device_gives_no_bindings() {
    let folder = folder("nothing");
    let empty = file(&folder, "empty.xml", "<EtherCATInfo><Vendor><Id>1</Id></Vendor></EtherCATInfo>");
    let target = folder.join("empty.rs");
    let generated = lexibus(&["generate", &empty, "--out", &target.to_string_lossy()]);
    assert_eq!((code(&generated), target.exists()), (1, false));
    assert!(err(&generated).contains("describes no device"), "{}", err(&generated));
    // If there are several inputs, an input without a device is skipped.
    std::fs::copy(COUPLER, folder.join("coupler.xml")).expect("a copy");
    let all = lexibus(&["generate", &folder.to_string_lossy(), "--out", &format!("{}/", folder.display())]);
    assert_eq!((code(&all), folder.join("coupler.rs").exists()), (0, true), "{}", err(&all));
}

#[test]
fn folders_are_searched_for_xml_that_describes_devices() {
    let folder = folder("xml");
    std::fs::copy(COUPLER, folder.join("coupler.xml")).expect("a copy");
    file(&folder, "pom.xml", "<project/>");
    file(&folder, "broken.xml", "<EtherCATInfo><Vendor>");
    let checked = lexibus(&["check", &folder.to_string_lossy(), "-A", "warnings"]);
    let text = out(&checked) + &err(&checked);
    assert_eq!(code(&checked), 1, "{text}");
    assert!(text.contains("broken.xml:1:") && !text.contains("pom.xml") && text.contains("2 files"), "{text}");
}

#[test]
fn folders_that_are_too_deep_are_told() {
    let root = folder("deep");
    let nested = |depth: usize| (0..depth).fold(root.join(depth.to_string()), |path, _| path.join("d"));
    for (depth, status) in [(32, 0), (33, 2)] {
        std::fs::create_dir_all(nested(depth)).expect("folders");
        std::fs::copy(DEMO, nested(depth).join("demo.eds")).expect("a copy");
        let checked = lexibus(&["check", &root.join(depth.to_string()).to_string_lossy()]);
        assert_eq!(code(&checked), status, "{depth}: {}", err(&checked));
        assert_eq!(err(&checked).contains("folders are searched to a depth of 32"), status == 2, "{}", err(&checked));
    }
}

#[test]
fn export_writes_an_eds_and_says_what_it_leaves_out() {
    let folder = folder("export");
    let made = lexibus(&["export", "--format", "eds", DEMO]);
    assert_eq!((code(&made), err(&made)), (0, String::new()));
    let text = out(&made);
    assert!(text.starts_with("[FileInfo]\r\nFileName=demo-drive.eds\r\n"), "{text}");
    let path = file(&folder, "again.eds", &text);
    assert_eq!(out(&lexibus(&["export", "--format", "eds", &path])), text, "an export of an export is equal to it");
    assert_eq!(code(&lexibus(&["export", "--format", "eds", DEMO, "--out", &path, "--check"])), 0);
    std::fs::write(&path, "[FileInfo]\n").expect("a stale file");
    let stale = lexibus(&["export", "--format", "eds", DEMO, "--out", &path, "--check"]);
    assert_eq!(code(&stale), 1);
    assert!(err(&stale).contains("is stale"), "{}", err(&stale));

    let many = lexibus(&["export", "--format", "eds", COUPLER, "-A", "warnings"]);
    assert_eq!((code(&many), out(&many)), (1, String::new()));
    assert!(err(&many).contains("describes 2 devices: choose one with --device"), "{}", err(&many));
    let one = lexibus(&["export", "--format", "eds", COUPLER, "--device", "SV-1", "-A", "warnings"]);
    assert_eq!(code(&one), 0, "{}", err(&one));
    let note = "1 × enumeration written as its integer type (first: 0x2000:01)";
    assert!(err(&one).lines().any(|line| line.starts_with("note: ") && line.ends_with(note)), "{}", err(&one));
    let objects = |more: &[&str]| {
        let call = ["export", "--format", "eds", COUPLER, "--device", "SV-1", "-A", "warnings"];
        let text = out(&lexibus(&[&call, more].concat()));
        text.lines().filter(|line| line.len() == 6 && line.starts_with('[')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(objects(&[]).contains(&"[1A00]".to_owned()), "{:?}", objects(&[]));
    assert_eq!(objects(&["--objects", "0x2000"]), ["[2000]"], "mapping objects are not added either");
    let target = folder.join("devices/").to_string_lossy().into_owned();
    assert_eq!(code(&lexibus(&["export", "--format", "eds", COUPLER, "--out", &target])), 0);
    for name in ["devices/coupler.esi_CP-32.eds", "devices/coupler.esi_SV-1.eds"] {
        assert!(folder.join(name).is_file(), "{name}");
    }
}

#[test]
fn export_notes_are_json_lines_on_request() {
    let call = ["export", "--format", "eds", COUPLER, "--device", "SV-1", "-A", "warnings", "--message-format"];
    let json = lexibus(&[&call[..], &["json"]].concat());
    let lines = err(&json);
    let lines = lines.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).expect("a JSON line"));
    let enumeration = lines.into_iter().find(|line| line["name"] == "enumeration").expect("the note");
    assert_eq!((&enumeration["severity"], &enumeration["count"]), (&"note".into(), &1.into()));
    assert_eq!(enumeration["first"], "0x2000:01");
    assert_eq!(code(&lexibus(&[&call[..], &["sarif"]].concat())), 2);
    assert_eq!(code(&lexibus(&["export", DEMO])), 2, "the format is required");
}

#[test]
fn what_has_no_objects_is_not_exported() {
    let folder = folder("no-objects");
    let modules = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/drive.gsdml.xml");
    let target = folder.join("drive.eds");
    let exported = lexibus(&["export", "--format", "eds", modules, "--out", &target.to_string_lossy()]);
    assert_eq!((code(&exported), target.exists()), (1, false));
    assert!(err(&exported).contains("no device with objects"), "{}", err(&exported));
}

#[test]
fn export_writes_an_esi_and_asks_for_what_the_source_lacks() {
    let folder = folder("export_esi");
    let missing = lexibus(&["export", "--format", "esi", DEMO]);
    assert_eq!(code(&missing), 1);
    assert!(err(&missing).contains("`physics` (Kind of each port"), "{}", err(&missing));
    let mut call = vec!["export", "--format", "esi", DEMO, "--set", "physics=YY", "--set", "group=Drives"];
    let made = lexibus(&call);
    assert_eq!(code(&made), 0, "{}", err(&made));
    assert!(out(&made).contains("<GroupType>Drives</GroupType>") && err(&made).contains("note: "), "{}", err(&made));
    let path = folder.join("demo.xml").to_string_lossy().into_owned();
    call.extend(["--out", &path]);
    assert_eq!(code(&lexibus(&call)), 0);
    assert_eq!(std::fs::read_to_string(&path).expect("the ESI"), out(&made), "a file contains the same bytes");
    call.push("--check");
    assert_eq!(code(&lexibus(&call)), 0);
    let many = lexibus(&["export", "--format", "esi", COUPLER, "-A", "warnings"]);
    assert_eq!(code(&many), 0, "{}", err(&many));
    assert!(out(&many).matches("<Device ").count() > 1, "all devices are in one file");
    for (key, what) in [("colour=red", "unknown option `colour`"), ("vendor-id=x", "a number of up to 32 bits")] {
        let wrong = lexibus(&["export", "--format", "esi", DEMO, "--set", key]);
        assert_eq!(code(&wrong), 2);
        assert!(err(&wrong).contains(what), "{}", err(&wrong));
    }
    assert_eq!(code(&lexibus(&["export", "--format", "eds", DEMO, "--set", "physics=YY"])), 2);
}

#[test]
fn export_writes_a_gsdml_under_its_name() {
    let folder = folder("export_gsdml");
    const SOURCES: [&str; 3] = [
        concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/drive.gsdml.xml"),
        concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/heads.gsdml.xml"),
        concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/safe.gsdml.xml"),
    ];
    let nothing = lexibus(&["export", "--format", "gsdml", DEMO]);
    assert_eq!(code(&nothing), 1);
    assert!(err(&nothing).contains("no PROFINET device and no process image"), "{}", err(&nothing));
    let into = format!("{}/", folder.to_string_lossy());
    let call = [&["export", "--format", "gsdml"], &SOURCES[..], &["--out", &into, "-A", "warnings"]].concat();
    let made = lexibus(&call);
    assert_eq!(code(&made), 0, "{}", err(&made));
    let names = std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("a file").file_name());
    let names: Vec<String> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    assert!(names.iter().any(|name| name.ends_with(".xml")), "{names:?}");
    for name in names {
        let again = lexibus(&["check", &folder.join(&name).to_string_lossy()]);
        assert_eq!(code(&again), 0, "{name}: {}", err(&again));
    }
}

/// Runs the commands in the documentation that export the table of the Eco drive as EDS, ESI and GSDML.
#[test]
fn the_eco_as_eds_esi_and_gsdml() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let guide = std::fs::read_to_string(root.join("dictionaries/README.md")).expect("the documentation");
    let (_, after) = guide.split_once("## A table as EDS, ESI and GSDML").expect("the chapter");
    let block = after.split("```").nth(1).expect("the commands").trim_start_matches("sh").replace("\\\n", " ");
    let folder = folder("eco");
    let mut count = 0;
    for line in block.lines().filter(|line| !line.is_empty()) {
        let mut words = line.split_whitespace();
        assert_eq!(words.next(), Some("lexibus"));
        let mut call: Vec<String> = words.map(str::to_owned).collect();
        let out = call.iter().position(|word| word == "--out").expect("an output") + 1;
        call[out] = folder.join(&call[out]).to_string_lossy().into_owned();
        call[1] = root.join(&call[1]).to_string_lossy().into_owned();
        let call: Vec<&str> = call.iter().map(String::as_str).collect();
        let output = lexibus(&call);
        assert_eq!(code(&output), 0, "{line}\n{}", err(&output));
        count += 1;
    }
    assert_eq!(count, 3);
    let gsdml = folder.join("gsdml/GSDML-V2.35-Example-Eco-20240131.xml");
    let (eds, esi) = (folder.join("eco.eds"), folder.join("eco.xml"));
    for path in [&eds, &esi, &gsdml] {
        let output = lexibus(&["check", &path.to_string_lossy()]);
        assert_eq!((code(&output), err(&output).contains("error[")), (0, false), "{}", err(&output));
    }
    for (path, schema) in [(&esi, "esi/EtherCATInfo.xsd"), (&gsdml, "gsdml/GSDML-DeviceProfile-v2.35.xsd")] {
        let Some(schema) = Schema::new(schema) else { continue };
        let text = std::fs::read(path).expect("an export");
        assert_eq!(schema.violations("eco", [("eco.xml", text.as_slice())]), Vec::<String>::new());
    }
}

#[test]
fn a_site_of_documentation() {
    let folder = folder("site");
    let out = folder.join("pages");
    let output = lexibus(&["docs", DEMO, COUPLER, "--out", &out.to_string_lossy()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let read = |path: &str| std::fs::read_to_string(out.join(path)).unwrap_or_else(|_| panic!("{path}"));
    assert!(read("index.html").contains("href=\"lexibus/demo-drive-0x00004021/0x00010000/index.html\""));
    assert!(read("lexibus/demo-drive-0x00004021/0x00010000/profile-objects.html").contains("id=\"0x6040\""));
    for shared in ["site.css", "site.js", "search.js"] {
        assert!(!read(shared).is_empty());
    }
    // Pages of an earlier call are removed. Other files stay.
    let coupler = std::fs::read_dir(&out).expect("a folder").filter_map(|entry| Some(entry.ok()?.path()));
    let coupler = coupler.filter(|path| path.is_dir() && !path.ends_with("lexibus")).collect::<Vec<_>>();
    assert_eq!(coupler.len(), 1, "{coupler:?}");
    std::fs::write(coupler[0].join("notes.html"), "<title>My notes</title>").expect("a file");
    // A description with errors removes nothing.
    let broken = file(&folder, "broken.eds", "");
    assert_eq!(code(&lexibus(&["docs", DEMO, &broken, "--out", &out.to_string_lossy()])), 1);
    assert!(std::fs::read_dir(&coupler[0]).expect("a folder").count() > 1);
    let call = |further: &[&str]| lexibus(&[&["docs", DEMO, "--out", &out.to_string_lossy()], further].concat());
    let output = call(&["--check"]);
    assert!(code(&output) == 1 && err(&output).contains("modules.html is not part of"), "{}", err(&output));
    assert_eq!(code(&call(&[])), 0);
    assert_eq!(std::fs::read_dir(&coupler[0]).expect("a folder").count(), 1, "only the notes");
    assert_eq!(code(&call(&["--check"])), 0);
    // A missing output folder and an output that cannot be written are errors.
    let file = file(&folder, "occupied", "");
    assert_eq!(code(&lexibus(&["docs", DEMO, "--out", &file])), 1);
    assert_eq!(code(&lexibus(&["docs", DEMO])), 2);
}

#[test]
fn pages_of_markdown() {
    let folder = folder("markdown");
    let out = folder.join("pages");
    let call = |further: &[&str]| {
        let out = out.to_string_lossy();
        lexibus(&[&["docs", DEMO, "--format", "markdown", "--out", &out], further].concat())
    };
    // `--check` fails because the pages do not exist yet.
    assert_eq!(code(&call(&["--check"])), 1);
    assert_eq!(code(&call(&[])), 0);
    assert_eq!(code(&call(&["--check"])), 0);
    let summary = std::fs::read_to_string(out.join("SUMMARY.md")).expect("a summary");
    // Pages with the changes between two descriptions, which the list of devices leads to.
    assert_eq!(code(&call(&["--compare", DEMO, COUPLER])), 0);
    let page = out.join("_compare/demo-drive-to-coupler-esi.md");
    let changes = std::fs::read_to_string(&page).expect("a comparison");
    let has = |text: &str| changes.contains(text);
    assert!(has("# demo-drive → coupler.esi") && has("| breaks api, wire | device |"), "{changes}");
    let first = std::fs::read_to_string(out.join("README.md")).expect("a list");
    assert!(first.contains("(_compare/demo-drive-to-coupler-esi.md)"), "{first}");
    assert_eq!(code(&call(&[])), 0);
    assert!(!page.exists(), "comparisons that are not asked for are removed");
    assert!(
        summary.contains(
            "\n- [Demo Drive](lexibus/demo-drive-0x00004021/0x00010000/index.md)\n  - [Communication objects]"
        ),
        "{summary}"
    );
    let page = out.join("lexibus/demo-drive-0x00004021/0x00010000/profile-objects.md");
    std::fs::write(&page, "<!-- Written by lexibus docs -->\n# Old\n").expect("a page");
    let output = call(&["--check"]);
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("profile-objects.md is stale"), "{}", err(&output));
    assert_eq!(code(&call(&[])), 0);
    assert!(std::fs::read_to_string(&page).expect("a page").contains("<a id=\"0x6040\"></a>"));
    // Files that `lexibus docs` did not write must not be overwritten.
    std::fs::write(out.join("README.md"), "# A project\n\nPages are made by `lexibus docs`.\n").expect("a file");
    let output = call(&[]);
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("README.md exists and was not written by `lexibus docs`"), "{}", err(&output));
    assert_eq!(
        std::fs::read_to_string(out.join("README.md")).expect("a file"),
        "# A project\n\nPages are made by `lexibus docs`.\n"
    );
    let latin = b"# Gr\xFC\xDFe\n";
    std::fs::write(out.join("README.md"), latin).expect("a file");
    assert_eq!(code(&call(&[])), 1);
    assert_eq!(std::fs::read(out.join("README.md")).expect("a file"), latin, "in any encoding");
}

#[test]
fn changes_between_two_versions() {
    let folder = folder("diff");
    let old = file(&folder, "old.eds", QUIRKY);
    let wider = file(&folder, "wider.eds", &QUIRKY.replace("DefaultValue=012", "DefaultValue=5"));
    let other = file(&folder, "other.eds", &QUIRKY.replace("DataType=0x0006", "DataType=0x0007"));
    let output = lexibus(&["diff", &old, &old]);
    assert_eq!((code(&output), out(&output).as_str()), (0, "no changes\n"));
    let output = lexibus(&["diff", &old, &wider]);
    assert_eq!(
        (code(&output), out(&output).as_str()),
        (
            0,
            "breaks behavior: 0x2000:00 Gain: default 10, now 5\n\
             1 change; breaking: api 0, wire 0, behavior 1; compatible: 0; no effect: 0\n"
        )
    );
    let output = lexibus(&["diff", &old, &wider, "--show", "breaking"]);
    assert_eq!(out(&output).lines().count(), 1, "the summary also counts the changes that are not shown");
    let output = lexibus(&["diff", &old, &other]);
    assert_eq!(code(&output), 1);
    assert!(
        out(&output).starts_with("breaks api, wire: 0x2000:00 Gain: type UNSIGNED16, now UNSIGNED32\n"),
        "{}",
        out(&output)
    );
    let output = lexibus(&["diff", &old, &other, "--format", "json"]);
    let line: serde_json::Value = serde_json::from_str(out(&output).lines().next().expect("a change")).expect("JSON");
    let judgement = [&line["api"], &line["wire"], &line["behavior"]];
    assert_eq!(
        (&line["fact"], judgement),
        (&"type".into(), [&"breaking".into(), &"breaking".into(), &"unaffected".into()])
    );
    let page = folder.join("page.html");
    lexibus(&["diff", &old, &other, "--format", "html", "--out", &page.to_string_lossy()]);
    assert!(std::fs::read_to_string(page).expect("a page").contains("<td><b>breaks api, wire</b>"));
    assert_eq!(code(&lexibus(&["diff", &old, "nowhere.eds"])), 2);
    let broken = file(&folder, "broken.toml", "lexibus = 1\n[device]\n");
    assert_eq!(code(&lexibus(&["diff", &old, &broken])), 1);
}

#[test]
fn the_command_line_imports() {
    let folder = folder("import");
    let call = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lexibus"));
        command.current_dir(&folder).args(arguments).output().expect("lexibus runs")
    };
    std::fs::write(folder.join("pump.csv"), "Nom;Address;Type;Access\nSpeed;1;u16;rw\nTorque;2;what;ro\n")
        .expect("a list");
    let made = call(&["import", "pump.csv", "--map", "name=Nom", "--out", "pump.toml"]);
    let text = String::from_utf8_lossy(&made.stderr).into_owned();
    assert_eq!(made.status.code(), Some(0), "{text}");
    assert!(text.contains("pump.csv:3:10") && text.contains("warning[CSV003]") && text.contains("1 warning"), "{text}");
    assert_eq!(call(&["check", "pump.toml"]).status.code(), Some(0));
    let printed = call(&["import", "pump.csv", "-A", "warnings"]);
    assert_eq!(printed.stdout, std::fs::read(folder.join("pump.toml")).expect("the table"));
    assert!(printed.stderr.is_empty());
    for (arguments, code) in [
        (&["import", "pump.csv", "--out", "pump.toml"][..], 2),
        (&["import", "none.csv"], 2),
        (&["import", "pump.csv", "--delimiter", "xx"], 2),
        (&["import", "pump.csv", "--map", "nme=Nom"], 2),
        (&["import", "pump.csv", "--map", "name=Name"], 1),
        (&["import", "pump.csv", "--strict"], 1),
        (&["import", "pump.csv", "--delimiter", ","], 1),
    ] {
        assert_eq!(call(arguments).status.code(), Some(code), "{arguments:?}");
    }
}

#[test]
fn the_command_line_switches_profiles_off() {
    let run = |arguments: &[&str]| {
        let output = lexibus(arguments);
        assert!(output.status.success(), "{}", err(&output));
        out(&output)
    };
    assert!(run(&["generate", DEMO]).contains("types::ModesOfOperation"));
    assert!(!run(&["generate", DEMO, "--no-profiles"]).contains("ModesOfOperation"));
    assert!(
        !run(&["export", DEMO, "--format", "eds"]).contains("Mode wanted"),
        "profiles do not change an exported EDS"
    );
}

#[test]
fn the_command_line_takes_overlays() {
    const EDS: &str = "[DeviceInfo]\nVendorNumber=0x6A\nProductName=Pump 3\nProductNumber=7\nRevisionNumber=2\n\
        [1018]\nParameterName=Identity\nObjectType=9\nSubNumber=2\n\
        [1018sub0]\nParameterName=Entries\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
        [1018sub1]\nParameterName=Vendor\nDataType=7\nAccessType=ro\nDefaultValue=0x6A\n\
        [2000]\nParameterName=Speed\nDataType=6\nAccessType=rw\nDefaultValue=5\n";
    const OVERLAY: &str = "lexibus = 1\n[overlay]\nwhy = \"as the manual has it\"\n[[chapters]]\n[chapters.objects]\n\
        0x2000 = { unit = \"rpm\" }\n0x2999 = { unit = \"rpm\" }\n";
    let folder = folder("overlay-cli");
    let (input, overlay) = (folder.join("pump.eds"), folder.join("pump.toml"));
    std::fs::write(&input, EDS).expect("the description");
    std::fs::write(&overlay, OVERLAY).expect("the overlay");
    let run = |command: &str| {
        let mut call = Command::new(env!("CARGO_BIN_EXE_lexibus"));
        call.arg(command)
            .arg(&input)
            .arg("--overlay")
            .arg(&overlay)
            .args(["-A", "warnings", "-W", "TAB030"])
            .output()
            .expect("lexibus runs")
    };
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let generated = run("generate");
    assert!(generated.status.success() && text(&generated.stdout).contains("Unit rpm"));
    assert!(text(&generated.stderr).contains("pump.toml:7:1"), "{}", text(&generated.stderr));
    assert!(text(&run("dump").stdout).contains("\"overlay\""));
    assert!(text(&run("info").stdout).contains("TAB030"));
    assert!(text(&run("check").stderr).contains("TAB030"));
    let missing = Command::new(env!("CARGO_BIN_EXE_lexibus"))
        .args(["check", &input.to_string_lossy(), "--overlay", "nowhere.toml"])
        .output()
        .expect("lexibus runs");
    assert_eq!(missing.status.code(), Some(2));
}
