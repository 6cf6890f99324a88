//! Tests which files, folders and devices the commands read.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{code, err, file, folder, lane, lexibus, out, COUPLER, DEMO, QUIRKY};

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
    // Use two input files with the same name. The name of the second output file must get a number.
    let twin = folder.join("in");
    std::fs::create_dir_all(&twin).expect("a folder");
    let mut files = examples();
    files.push(file(&twin, "demo-drive.eds", QUIRKY));
    // Facts that an ESI requires and that files in other formats often lack.
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
        // Only a few of the examples can be exported as GSDML.
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
    // The deepest folder contains two links to the top folder, so the number of paths doubles with each link that a
    // search follows.
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
    assert!(err(&generated).contains("describes neither a device nor a module"), "{}", err(&generated));
    assert!(!err(&generated).contains("read "), "{}", err(&generated));
    // If there are several inputs, an input without a device is skipped.
    std::fs::copy(COUPLER, folder.join("coupler.xml")).expect("a copy");
    std::fs::create_dir(folder.join("a")).expect("a folder");
    std::fs::copy(&empty, folder.join("a/coupler.xml")).expect("a copy");
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
