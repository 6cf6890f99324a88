//! Tests `Builder`, the entry point for build scripts.

use std::path::{Path, PathBuf};

use lexibus_codegen::{BuildError, Builder, Presence};

const EDS: &str = "[DeviceInfo]\nProductName=Valve\n[2000]\nParameterName=Opening\nDataType=0x0005\nAccessType=rw\n\
                   DefaultValue=012\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("builder-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

#[test]
fn output_is_named_after_the_input_and_written_once() {
    let folder = folder("once");
    let input = folder.join("valve.eds");
    std::fs::write(&input, EDS).expect("the input");
    let builder = Builder::new().quiet().out_dir(&folder);
    builder.compile(&input).expect("bindings");
    let output = folder.join("valve.rs");
    let old = std::time::SystemTime::UNIX_EPOCH;
    std::fs::File::options().write(true).open(&output).and_then(|file| file.set_modified(old)).expect("an old file");
    builder.compile(&input).expect("bindings");
    assert_eq!(
        std::fs::metadata(&output).and_then(|data| data.modified()).expect("a time"),
        old,
        "the unchanged file was written again"
    );
    builder.clone().table(Presence::Always).compile(&input).expect("bindings");
    assert_ne!(std::fs::metadata(&output).and_then(|data| data.modified()).expect("a time"), old, "other bytes");
    builder.compile_as(&input, "other.rs").expect("bindings");
    assert!(folder.join("other.rs").is_file());
}

/// Checks the lines that a call of `generate` prints for Cargo in a build script. To capture these lines, the test runs its
/// own program as a child process.
#[test]
fn cargo_watches_the_input_and_what_it_was_compiled_with() {
    const INPUT: &str = "LEXIBUS_TEST_INPUT";
    if let Some(input) = std::env::var_os(INPUT) {
        let input = PathBuf::from(input);
        Builder::new().overlay(input.with_extension("toml")).generate(&input).expect("bindings");
        return;
    }
    // A referenced file must be watched even if it does not exist yet.
    let input = folder("watched").join("valve.xml");
    let esi = "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device><Type ProductCode=\"1\">V</Type>\
        <Name>Valve</Name><Profile><DictionaryFile>Dict.xml</DictionaryFile></Profile></Device></Devices></Descriptions></EtherCATInfo>";
    std::fs::write(&input, esi).expect("the input");
    let overlay =
        "lexibus = 1\n[overlay]\nwhy = \"the manual\"\n[[chapters]]\n[chapters.objects]\n0x2000 = { add = true, name = \"Opening\", type = \"u8\", access = \"rw\", unit = \"%\" }\n";
    std::fs::write(input.with_extension("toml"), overlay).expect("the overlay");
    let mut program = std::process::Command::new(std::env::current_exe().expect("this program"));
    program
        .args(["--exact", "builder::cargo_watches_the_input_and_what_it_was_compiled_with", "--nocapture"])
        .env(INPUT, &input);
    let output = program.output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}");
    for file in [input.clone(), input.with_extension("toml"), input.with_file_name("Dict.xml")] {
        let line = format!("cargo::rerun-if-changed={}\n", file.display());
        assert_eq!(text.matches(&line).count(), 1, "{line}{text}");
    }
}

#[test]
fn errors_are_for_people() {
    let folder = folder("errors");
    let input = folder.join("valve.eds");
    std::fs::write(&input, EDS).expect("the input");
    let builder = Builder::new().quiet().out_dir(&folder);
    let error = builder.clone().strict().compile(&input).expect_err("a repair");
    let text = format!("{error:?}");
    assert!(text.contains("error[EDS020]") && text.contains("valve.eds:7:14"), "{text}");
    builder.clone().strict().allow("octal-number").compile(&input).expect("a repair that is not an error");
    let error = builder.clone().deny("octal-numbr").compile(&input).expect_err("no such code");
    assert!(error.to_string().contains("did you mean `octal-number`?"), "{error}");
    let error = builder.compile(folder.join("missing.eds")).expect_err("no such file");
    assert!(error.to_string().contains("missing.eds"), "{error}");
}

/// The error for a file that describes no device does not state that the file has errors.
#[test]
fn an_empty_description_has_its_own_error() {
    let input = folder("empty").join("vendor.xml");
    let esi = "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices/></Descriptions></EtherCATInfo>";
    std::fs::write(&input, esi).expect("the input");
    let builder = Builder::new().quiet().out_dir(input.with_file_name(""));
    let error = builder.compile(&input).expect_err("no device");
    assert!(matches!(&error, BuildError::Empty { path } if *path == input), "{error}");
    assert!(!input.with_file_name("vendor.rs").exists());
    let error = builder.generate(&input).expect_err("no device");
    assert!(matches!(&error, BuildError::Empty { path } if *path == input), "{error}");
    let text = error.to_string();
    assert!(
        text.ends_with(
            "vendor.xml: there is nothing to generate, because the file describes neither a device nor a module, or is a GSDML without an access point"
        ),
        "{text}"
    );
}

#[test]
fn what_is_chosen_is_what_is_there() {
    let folder = folder("options");
    let input = folder.join("valve.eds");
    std::fs::write(&input, EDS).expect("the input");
    let builder = Builder::new().quiet();
    let plain = builder.generate(&input).expect("bindings");
    assert!(plain.contains("pub struct Valve<C>") && !plain.contains("ENTRIES"));
    let chosen = builder.device_name("Tap").runtime("crate::rt").table(Presence::Feature("table".into()));
    let text = chosen.clone().generate(&input).expect("bindings");
    assert!(text.contains("pub struct Tap<C>") && text.contains("use crate::rt as rt;"));
    assert!(text.contains("#[cfg(feature = \"table\")]"));
    let bare = chosen.accessors(false).generate(&input).expect("bindings");
    assert!(!bare.contains("pub struct Tap") && bare.contains("pub const OPENING"));
}

#[test]
fn of_many_devices_those_that_are_selected() {
    let coupler = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/coupler.esi.xml");
    let builder = Builder::new().quiet();
    let text = builder.clone().device("SV-1@latest").objects("0x6040..0x6041").generate(coupler).expect("bindings");
    assert!(text.contains("pub struct Sv1<C>") && text.contains("STATUSWORD") && !text.contains("MOTOR"));
    let text = builder.clone().device("0x00A10001").module("AI-2").generate(coupler).expect("bindings");
    assert!(text.contains("pub mod ai_2 {") && !text.contains("di_16"));
    let error = builder.clone().device("SV-1@7").generate(coupler).expect_err("no such revision").to_string();
    assert!(error.contains("IO004") && error.contains("SV-1@0x00000007"), "{error}");
    let error = builder.objects("x").generate(coupler).expect_err("no index").to_string();
    assert!(error.contains("expected 0x6040"), "{error}");
}
