//! Tests the export to other formats.

use std::path::Path;

use super::xsd::Schema;
use super::{code, err, file, folder, lexibus, out, COUPLER, DEMO};

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
    for (key, what) in [("color=red", "unknown option `color`"), ("vendor-id=x", "a number of up to 32 bits")] {
        let wrong = lexibus(&["export", "--format", "esi", DEMO, "--set", key]);
        assert_eq!(code(&wrong), 2);
        assert!(err(&wrong).contains(what), "{}", err(&wrong));
    }
    assert_eq!(code(&lexibus(&["export", "--format", "eds", DEMO, "--set", "physics=YY"])), 2);
}

#[test]
fn export_writes_an_image_per_slave() {
    let folder = folder("export_sii");
    let nothing = lexibus(&["export", "--format", "sii", DEMO]);
    assert_eq!((code(&nothing), out(&nothing)), (1, String::new()));
    assert!(err(&nothing).contains("the input describes no EtherCAT slave"), "{}", err(&nothing));
    let path = folder.join("sv1.bin").to_string_lossy().into_owned();
    let mut call = vec!["export", "--format", "sii", COUPLER, "--device", "SV-1", "-A", "warnings", "--out", &path];
    assert_eq!(code(&lexibus(&call)), 0);
    let image = std::fs::read(&path).expect("an image");
    assert_eq!((image.len(), &image[..6]), (2048, &[0x08, 0x0C, 0x00, 0xCC, 0xE8, 0x03][..]));
    assert_eq!(lexibus(&call[..8]).stdout, image, "standard output contains the same bytes");
    call.push("--check");
    assert_eq!(code(&lexibus(&call)), 0);
    call.extend(["--set", "station-alias=12"]);
    let stale = lexibus(&call);
    assert_eq!(code(&stale), 1);
    assert!(err(&stale).contains("is missing or stale"), "{}", err(&stale));
    // The coupler has no ConfigData, which an EEPROM image requires.
    let into = format!("{}/", folder.join("all").to_string_lossy());
    let missing = lexibus(&["export", "--format", "sii", COUPLER, "--out", &into, "-A", "warnings"]);
    assert_eq!(code(&missing), 1);
    assert!(err(&missing).contains("set `config-data`"), "{}", err(&missing));
    let config = ["--set", "config-data=050603446400"];
    let many = [&["export", "--format", "sii", COUPLER, "--out", &into, "-A", "warnings"], &config[..]].concat();
    assert_eq!(code(&lexibus(&many)), 0);
    let mut names: Vec<_> =
        std::fs::read_dir(&into).expect("a folder").map(|entry| entry.expect("a file").file_name()).collect();
    names.sort();
    assert_eq!(names, ["coupler.esi_CP-32.bin", "coupler.esi_SV-1.bin"]);
    let small = lexibus(&[&call[..8], &["--set", "eeprom-size=128"]].concat());
    assert!(err(&small).contains("but the EEPROM has only 128; set `eeprom-size`, with --set"), "{}", err(&small));
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
