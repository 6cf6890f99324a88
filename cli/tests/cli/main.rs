//! Tests the command line by running the `lexibus` program.

mod documentation;
mod exports;
mod inputs;

#[path = "../../../codegen/tests/corpus_support/xsd.rs"]
mod xsd;

#[path = "../../../tests/support/lane.rs"]
mod lane;

#[path = "../../../tests/support/python.rs"]
mod python;
#[path = "../../../tests/support/root.rs"]
mod root;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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
    let colored = lexibus(&["check", &path, "--color", "always"]);
    assert!(err(&colored).contains('\u{1b}'));
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
    // Calls that print hostile text, each with the part of this text that its output must contain.
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
        (&["import", "none.csv"], 1),
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
    assert_eq!(missing.status.code(), Some(1));
}
