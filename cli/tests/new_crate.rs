//! Creates drive crates with `lexibus new --crate`, outside of the workspace. Each crate must be formatted, its tests must pass,
//! and its example must run.

#[path = "../../tests/support/lane.rs"]
mod lane;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A lift with a state machine of its own. An automatic transition follows the first command.
const LIFT: &str = r#"lexibus = 1

[device]
name = "Lift"
vendor = "Example"
buses = ["modbus"]

[spaces.holding]
modbus = { table = "holding", first = 0 }

[[chapters]]
title = "Operation"
space = "holding"

[chapters.registers]
status  = { reg = 0, type = "u16", access = "ro" }
control = { reg = 1, type = "u16", access = "rw" }
height  = { reg = 2, type = "u16", access = "ro", unit = "mm", max = 2500 }
speed   = { reg = 3, type = "u16", access = "rw", unit = "mm/s", min = 10, max = 500, default = 200 }

[machines.lift]
status = "status"
control = "control"

[machines.lift.states]
off = { mask = 0x7, value = 0 }
starting = { mask = 0x7, value = 1 }
ready = { mask = 0x7, value = 2 }
moving = { mask = 0x7, value = 3 }

[machines.lift.commands]
start = { mask = 0x3, value = 1 }
go = { mask = 0x3, value = 2 }
stop = { mask = 0x3, value = 0 }

[[machines.lift.transitions]]
from = "off"
to = "starting"
command = "start"

[[machines.lift.transitions]]
from = "starting"
to = "ready"

[[machines.lift.transitions]]
from = "ready"
to = "moving"
command = "go"

[[machines.lift.transitions]]
from = "moving"
to = "off"
command = "stop"
"#;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn temporary() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
}

fn text(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// Runs Cargo offline in `folder`, with the build folder of the other tests that build crates outside of the workspace.
fn cargo(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", temporary().join("drive-crate"))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{arguments:?}: {}", text(&output));
    text(&output)
}

/// Creates the crate `name` from a description. The crate uses the packages of this workspace instead of the published ones.
fn create(name: &str, description: &Path, options: &[&str]) -> PathBuf {
    let folder = temporary().join(name);
    let _ = std::fs::remove_dir_all(&folder);
    let created = Command::new(env!("CARGO_BIN_EXE_lexibus"))
        .args(["new", "--crate", name, "--from"])
        .arg(description)
        .args(options)
        .arg("--out")
        .arg(&folder)
        .output()
        .expect("lexibus runs");
    assert!(created.status.success(), "{}", text(&created));
    let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).expect("the manifest");
    let git = "{ git = \"https://github.com/lexibus/lexibus\" }";
    let mut own = manifest.replace(
        &format!("lexibus-codegen = {git}"),
        &format!("lexibus-codegen = {{ path = {:?} }}", root().join("codegen")),
    );
    own = own.replace(&format!("lexibus = {git}"), &format!("lexibus = {{ path = {:?} }}", root()));
    assert!(!own.contains("git ="), "{own}");
    std::fs::write(folder.join("Cargo.toml"), own).expect("a manifest");
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    folder
}

/// Tests a crate. Its example must print all `lines`, and `tests` tests must pass.
fn try_out(folder: &Path, tests: usize, lines: &[&str]) {
    cargo(folder, &["fmt", "--check"]);
    let tested = cargo(folder, &["test", "--offline", "--quiet", "--test", "simulated"]);
    assert!(tested.contains(&format!("{tests} passed")), "{tested}");
    let printed = cargo(folder, &["run", "--offline", "--quiet", "--example", "simulated"]);
    for line in lines {
        assert!(printed.lines().any(|printed| printed == *line), "{line:?}: {printed}");
    }
}

#[test]
fn an_eds_becomes_a_crate_that_moves_a_drive() {
    let folder = create("new-eds", &root().join("dictionaries/demo-drive.eds"), &[]);
    try_out(&folder, 2, &["state: OperationEnabled", "position: 100"]);
}

#[test]
fn an_esi_becomes_a_crate_that_enables_a_drive() {
    if lane::skips("a crate from an ESI file") {
        return;
    }
    let folder = create("new-esi", &root().join("examples/support/servo.esi.xml"), &["--device", "SV-1@latest"]);
    try_out(&folder, 2, &["state: OperationEnabled"]);
}

#[test]
fn a_gsdml_becomes_a_crate_that_exchanges_data() {
    if lane::skips("a crate from a GSDML file") {
        return;
    }
    let folder = create("new-gsdml", &root().join("examples/servo.gsdml.xml"), &[]);
    try_out(&folder, 2, &["slot 1, subslot 0x0002: submodule 0x00000001", "start-up records: 1"]);
}

#[test]
fn a_table_becomes_a_crate_on_each_of_its_buses() {
    if lane::skips("crates from register tables") {
        return;
    }
    let table = root().join("dictionaries/eco.toml");
    for bus in ["canopen", "modbus"] {
        let folder = create("new-table", &table, &["--bus", bus]);
        try_out(&folder, 3, &["state: OperationEnabled"]);
    }
}

#[test]
fn a_table_becomes_a_crate_with_its_own_state_machine() {
    if lane::skips("a crate from a register table") {
        return;
    }
    let table = temporary().join("lift.toml");
    std::fs::write(&table, LIFT).expect("a table");
    let folder = create("new-lift", &table, &[]);
    try_out(&folder, 3, &["state: Moving", "height (unit mm): 0", "speed (unit mm/s): 200"]);
}
