//! Tests the commands that access devices: questions, reports, exit codes and interruptions, with simulated devices.
#![cfg(unix)]

mod bus_support;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use bus_support::{adapter, modbus_server};
use nix::sys::signal::{kill, Signal};
use nix::unistd::Pid;

/// Timeout in milliseconds that is enough even if other programs occupy the processor.
const PATIENT: &str = "10000";

fn dictionary(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries").join(name);
    path.to_string_lossy().into_owned()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("device").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn lexibus(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lexibus"));
    command.args(arguments).stdin(Stdio::null());
    command
}

fn run(arguments: &[&str]) -> Output {
    lexibus(arguments).output().expect("lexibus runs")
}

fn texts(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn nothing_is_written_without_a_confirmation() {
    let (bus, eds) = (format!("slcan:{}", adapter(Duration::ZERO)), dictionary("demo-drive.eds"));
    let common = ["--bus", &bus, "--node", "5", "--timeout", PATIENT, &eds];
    let output = run(&[&["write"], &common[..], &["Profile velocity", "20000"]].concat());
    let (_, error) = texts(&output);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("0x6081:00 Profile velocity = 20000 (now 1000)"), "{error}");
    assert!(error.contains("add `--yes`"), "{error}");
    let read = || texts(&run(&[&["read"], &common[..], &["0x6081"]].concat())).0;
    assert_eq!(read(), "0x6081:00 Profile velocity = 1000\n");
    let output = run(&[&["write"], &common[..], &["Profile velocity", "20000", "--yes"]].concat());
    assert!(output.status.success(), "{:?}", texts(&output));
    assert_eq!(read(), "0x6081:00 Profile velocity = 20000\n");
    // A value outside the range is not sent, a read-only object is not written, and an unknown name is an error.
    for (name, value, message) in [
        ("Profile velocity", "600000", "above the maximum 500000; the range is 0 … 0x7A120"),
        ("Statusword", "1", "the parameter is read-only"),
        ("Profile speed", "1", "no parameter `Profile speed`"),
    ] {
        let output = run(&[&["write"], &common[..], &[name, value, "--yes"]].concat());
        assert!(!output.status.success() && texts(&output).1.contains(message), "{:?}", texts(&output));
    }
}

#[test]
fn a_backup_of_each_format_is_restored() {
    let (bus, eds) = (format!("slcan:{}", adapter(Duration::ZERO)), dictionary("demo-drive.eds"));
    let folder = folder("formats");
    let common = ["--bus", &bus, "--node", "5", "--timeout", PATIENT, &eds];
    for name in ["axis.dcf", "axis.toml"] {
        let file = folder.join(name).to_string_lossy().into_owned();
        let output = run(&[&["backup"], &common[..], &["--out", &file]].concat());
        assert!(output.status.success(), "{:?}", texts(&output));
        assert!(texts(&output).1.contains("left out: 0x1010:01"), "{:?}", texts(&output));
        run(&[&["write"], &common[..], &["Profile velocity", "7", "--yes"]].concat());
        let restore = [&["restore"], &common[..], &[&file]].concat();
        let output = run(&[&restore[..], &["--dry-run"]].concat());
        let (text, _) = texts(&output);
        assert!(text.contains("write 0x6081:00 Profile velocity = 1000\n"), "{text}");
        assert!(text.contains("nothing was written"), "{text}");
        let output = run(&restore);
        assert_eq!(output.status.code(), Some(2), "{:?}", texts(&output));
        assert_eq!(texts(&run(&[&["read"], &common[..], &["0x6081"]].concat())).0, "0x6081:00 Profile velocity = 7\n");
        let output = run(&[&restore[..], &["--yes"]].concat());
        assert!(output.status.success(), "{:?}", texts(&output));
        assert_eq!(
            texts(&run(&[&["read"], &common[..], &["0x6081"]].concat())).0,
            "0x6081:00 Profile velocity = 1000\n"
        );
    }
    let [dcf, toml] = ["axis.dcf", "axis.toml"].map(|name| folder.join(name).to_string_lossy().into_owned());
    let output = run(&["compare", &eds, &dcf, &toml]);
    assert_eq!((output.status.code(), texts(&output).0.as_str()), (Some(0), "0 differences\n"), "{:?}", texts(&output));
}

#[test]
fn an_interrupted_restore_reports_its_writes() {
    let (bus, eds) = (format!("slcan:{}", adapter(Duration::from_millis(60))), dictionary("demo-drive.eds"));
    let file = folder("interrupt").join("axis.toml").to_string_lossy().into_owned();
    let common = ["--bus", &bus, "--node", "5", "--timeout", PATIENT, &eds];
    let output = run(&[&["backup"], &common[..], &["--out", &file]].concat());
    assert!(output.status.success(), "{:?}", texts(&output));
    let mut restore = lexibus(&[&["restore"], &common[..], &[&file, "--yes"]].concat());
    let child = restore.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("lexibus starts");
    std::thread::sleep(Duration::from_millis(700));
    kill(Pid::from_raw(child.id().try_into().expect("a process ID")), Signal::SIGINT).expect("a signal");
    let output = child.wait_with_output().expect("lexibus ends");
    let (_, error) = texts(&output);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains(": not written\n") && error.contains("interrupted: "), "{error}");
    assert!(error.contains(" values written\n"), "{error}");
}

#[test]
fn a_missing_device_and_a_missing_adapter_are_reported() {
    let (bus, eds) = (format!("slcan:{}", adapter(Duration::ZERO)), dictionary("demo-drive.eds"));
    for (bus, message) in
        [(bus.as_str(), "no reply within the timeout"), ("slcan:/dev/none", "cannot open the CAN adapter")]
    {
        let output = run(&["read", "--bus", bus, "--node", "9", "--timeout", "100", &eds, "0x6081"]);
        assert!(!output.status.success() && texts(&output).1.contains(message), "{:?}", texts(&output));
    }
}

#[test]
fn registers_are_read_and_written_over_tcp() {
    let bus = format!("tcp:127.0.0.1:{}", modbus_server());
    let table = dictionary("aec-vector-step.toml");
    let common = ["--bus", &bus, "--node", "1", &table];
    let output = run(&[&["write"], &common[..], &["Rvel", "15.5 rev/s", "--yes"]].concat());
    let (_, error) = texts(&output);
    assert!(output.status.success() && error.contains("15.50 rev/s (raw 1550)"), "{error}");
    let output = run(&[&["read"], &common[..], &["Rvel"]].concat());
    assert!(texts(&output).0.contains("15.50 rev/s (raw 1550)"), "{:?}", texts(&output));
    let file = folder("tcp").join("axis.toml").to_string_lossy().into_owned();
    let output = run(&[&["backup"], &common[..], &["--out", &file]].concat());
    let saved = std::fs::read_to_string(&file).expect("a backup");
    assert!(saved.contains("value = 1550 }, # 15.50 rev/s (raw 1550)"), "{saved}\n{:?}", texts(&output));
}

#[test]
fn the_identity_of_a_modbus_device_is_compared() {
    let bus = format!("tcp:127.0.0.1:{}", modbus_server());
    let table = std::fs::read_to_string(dictionary("aec-vector-step.toml")).expect("a table");
    let other = folder("identity").join("other.toml");
    std::fs::write(&other, table.replace("vendor = \"AEC s.r.l.\"", "vendor = \"Other Ltd.\"")).expect("a table");
    let verified = |table: &str| texts(&run(&["verify", "--bus", &bus, "--node", "1", table])).0;
    let (same, other) = (verified(&dictionary("aec-vector-step.toml")), verified(&other.to_string_lossy()));
    assert!(same.contains(" parameters read") && !same.contains(": identity"), "{same}");
    assert!(other.contains("different: identity: vendor name: declared Other Ltd., found AEC SRL\n"), "{other}");
}

const ASC: &str = "date Fri Jan 16 09:00:00.000 am 2026\nbase hex  timestamps absolute\n\
    0.001000 1  705             Rx   d 1 7F\n0.002000 1  285             Rx   d 6 37 02 FE FF FF FF\n\
    0.003000 1  123             Rx   d 1 00\nnot a frame\n";

#[test]
fn a_trace_is_decoded_in_each_format() {
    let trace = folder("trace").join("trace.asc");
    std::fs::write(&trace, ASC).expect("a trace");
    let (trace, node) = (trace.to_string_lossy().into_owned(), format!("5={}", dictionary("demo-drive.eds")));
    let decoded = |format: &str| {
        let output = run(&["decode", &trace, &node, "--format", format]);
        let (text, error) = texts(&output);
        assert!(output.status.success() && error.contains("3 frames; 1 have no name"), "{error}");
        text
    };
    let csv = decoded("csv");
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows[..2], ["time,node,kind,address,name,value", "0.001000,5,state,,state Pre-operational,"]);
    assert!(rows[2].starts_with("0.002000,5,pdo,0x6041:00,Statusword,\"567 (ready to switch on, "), "{csv}");
    assert_eq!(rows[3], "0.002000,5,pdo,0x6064:00,Position actual value,-2");
    let json = decoded("json");
    let lines: Vec<serde_json::Value> =
        json.lines().map(|line| serde_json::from_str(line).expect("a JSON object")).collect();
    assert_eq!((&lines[1]["kind"], &lines[1]["node"]), (&"pdo".into(), &5.into()));
    assert_eq!(lines[1]["values"][1]["value"], "-2");
    let table = decoded("table");
    assert!(table.contains("  5  Position actual value  -2\n"), "{table}");
}

#[test]
fn a_monitor_shows_states_and_values_until_it_is_interrupted() {
    let bus = format!("slcan:{}", adapter(Duration::ZERO));
    let node = format!("5={}", dictionary("demo-drive.eds"));
    let mut monitor =
        lexibus(&["monitor", "--bus", &bus, "--read", "0x6081", "--period", "100", "--format", "json", &node]);
    let child = monitor.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("lexibus starts");
    std::thread::sleep(Duration::from_millis(1500));
    kill(Pid::from_raw(child.id().try_into().expect("a process ID")), Signal::SIGINT).expect("a signal");
    let output = child.wait_with_output().expect("lexibus ends");
    let (text, error) = texts(&output);
    assert!(output.status.success(), "{error}");
    assert!(text.contains("\"text\":\"state Pre-operational\"") && text.contains("\"value\":\"1000\""), "{text}");
}

#[test]
fn a_report_is_written_in_each_format() {
    let (bus, eds) = (format!("slcan:{}", adapter(Duration::ZERO)), dictionary("demo-drive.eds"));
    let common = ["verify", "--bus", &bus, "--node", "5", "--timeout", PATIENT, &eds];
    let (text, _) = texts(&run(&[&common[..], &["--changed"]].concat()));
    assert!(text.contains("changed: 0x1017:00 Producer heartbeat time: value: declared 0 ms, found 100 ms"), "{text}");
    let (json, _) = texts(&run(&[&common[..], &["--format", "json"]].concat()));
    let report: serde_json::Value = serde_json::from_str(&json).expect("a JSON object");
    assert_eq!((&report["device"], report["findings"].as_array().map(Vec::len)), (&"Demo Drive".into(), Some(0)));
    let page = folder("report").join("report.html");
    let output = run(&[&common[..], &["--format", "html", "--out", &page.to_string_lossy()]].concat());
    assert!(output.status.success(), "{:?}", texts(&output));
    assert!(std::fs::read_to_string(page).expect("a page").starts_with("<!DOCTYPE html>"));
    // The description is for another product, so `verify` finds deviations and the exit code is 1.
    let pump = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/pump.eds");
    let overlay = folder("overlay").join("found.toml");
    let pump = pump.to_string_lossy().into_owned();
    let arguments = ["verify", "--bus", &bus, "--node", "5", &pump, "--write-overlay", &overlay.to_string_lossy()];
    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(1), "{:?}", texts(&output));
    assert!(texts(&output).0.contains("different: 0x1018:"), "{:?}", texts(&output));
    assert!(std::fs::read_to_string(overlay).expect("an overlay").starts_with("lexibus = 1\n"));
}

#[test]
fn a_scan_reports_nodes_as_json() {
    let bus = format!("slcan:{}", adapter(Duration::ZERO));
    let output = run(&["scan", "--bus", &bus, "--format", "json", &dictionary("demo-drive.eds")]);
    let (text, error) = texts(&output);
    let node: serde_json::Value = serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}{error}"));
    assert_eq!((&node["node_id"], &node["product_code"]), (&5.into(), &0x4021.into()));
    assert!(node["files"][0].as_str().is_some_and(|file| file.ends_with("demo-drive.eds")), "{text}");
}

#[test]
fn a_blf_file_is_not_read_as_text() {
    let trace = folder("blf").join("trace.blf");
    std::fs::write(&trace, b"LOGG\x90\0\0\0").expect("a file");
    let trace = trace.to_string_lossy().into_owned();
    let output = run(&["decode", &trace, &format!("5={}", dictionary("demo-drive.eds"))]);
    let (_, error) = texts(&output);
    assert!(
        !output.status.success() && error.contains(&format!("`python -m can.logconvert {trace} trace.asc`")),
        "{error}"
    );
}

/// Writes a network file with the simulated drive and another node. Returns the path of the file.
fn network(name: &str, bus: &str, more: &str) -> PathBuf {
    let folder = folder(name);
    let eds = dictionary("demo-drive.eds");
    let text = format!(
        "[network]\nbit_rate = 500\n{bus}\n[master]\nid = 127\n[nodes]\naxis2 = {{ id = 6, device = \"{eds}\" }}\n\
         [nodes.axis1]\nid = 5\ndevice = \"{eds}\"\n{more}\n"
    );
    std::fs::write(folder.join("network.toml"), text).expect("a network file");
    folder.join("network.toml")
}

#[test]
fn a_node_of_a_network_is_accessed_by_name() {
    let adapter = adapter(Duration::ZERO);
    let file = network("nodes", &format!("bus = \"slcan:{adapter}\""), "");
    let folder = file.parent().expect("a folder");
    let in_folder = |arguments: &[&str]| {
        let output = lexibus(arguments).current_dir(folder).output().expect("lexibus runs");
        (output.status.code(), texts(&output).0, texts(&output).1)
    };
    let (code, text, error) = in_folder(&["read", "axis1", "Profile velocity"]);
    assert_eq!((code, text.as_str()), (Some(0), "0x6081:00 Profile velocity = 1000\n"), "{error}");
    let (code, _, error) = in_folder(&["write", "axis1", "Profile velocity", "20000", "--yes"]);
    assert_eq!(code, Some(0), "{error}");
    let (code, text, error) = in_folder(&["backup", "axis1", "--out", "axis.toml"]);
    assert_eq!(code, Some(0), "{text}{error}");
    let (code, text, _) = in_folder(&["restore", "axis1", "axis.toml", "--dry-run"]);
    assert!(code == Some(0) && text.contains("write 0x6081:00 Profile velocity = 20000\n"), "{text}");
    let (code, text, error) = in_folder(&["verify", "axis1"]);
    assert!(code == Some(0) && text.starts_with("0 deviations"), "{text}{error}");
    let monitor = ["monitor", "axis1", "--read", "0x6081", "--duration", "2000", "--format", "csv"];
    let (code, text, error) = in_folder(&monitor);
    assert!(code == Some(0) && text.contains(",5,sdo,0x6081:00,Profile velocity,20000\n"), "{text}{error}");
    let (code, text, error) = in_folder(&["monitor", "--duration", "2000"]);
    assert!(code == Some(0) && text.contains("node 5: state Pre-operational\n"), "{text}{error}");
    // A node that the network file does not contain is an error. `--overlay` is an error, because the network file
    // names the overlays itself.
    let (code, _, error) = in_folder(&["read", "axis3", "0x6081"]);
    assert!(code == Some(2) && error.contains("has no node `axis3`. Its nodes are axis2 (6), axis1 (5)."), "{error}");
    let (code, _, error) = in_folder(&["read", "axis1", "0x6081", "--overlay", "x.toml"]);
    assert!(code == Some(2) && error.contains("need a description file"), "{error}");
    // `--network` selects a network file in another folder. Without it, a node name is an error, because the working
    // folder has no `network.toml`.
    let path = file.to_string_lossy();
    let output = run(&["read", "--network", &path, "--bus", &format!("slcan:{adapter}@500k"), "axis1", "0x6081"]);
    assert_eq!(texts(&output).0, "0x6081:00 Profile velocity = 20000\n", "{:?}", texts(&output));
    let (_, error) = texts(&run(&["read", "axis1", "0x6081"]));
    assert!(error.contains("--network to use the name of a node"), "{error}");
    let (_, error) = texts(&run(&["read", &dictionary("demo-drive.eds"), "0x6081"]));
    assert!(error.contains("add the node-ID or server address"), "{error}");
}

#[test]
fn faults_of_a_network_file_are_reported_with_their_line() {
    for (name, bus, more, message) in [
        ("no-bus", "", "", "states no bus: add the key `bus`"),
        ("wrong-bus", "bus = \"usb:1\"", "", "network.toml:3:7: "),
        ("wrong-network", "bus = \"tcp:127.0.0.1\"", "", "needs a CAN bus"),
        ("wrong-key", "bus = \"can:can0\"", "speed = 5", "network.toml:11:1: the key `speed` is unknown [NET002]"),
    ] {
        let file = network(name, bus, more);
        let output = run(&["read", "--network", &file.to_string_lossy(), "axis1", "0x6081"]);
        assert!(!output.status.success() && texts(&output).1.contains(message), "{:?}", texts(&output));
    }
}

#[test]
fn pdos_have_the_mapping_of_the_network_file() {
    let more =
        "tpdo = { 2 = { cob_id = 0x1F5, transmission = 255, map = [\"Position actual value\", \"Statusword\"] } }";
    let file = network("mapping", "", more);
    let trace = file.with_file_name("trace.log");
    std::fs::write(&trace, "(1.0) can0 1F5#FEFFFFFF3702\n").expect("a trace");
    let output = run(&["decode", &trace.to_string_lossy(), "--network", &file.to_string_lossy(), "axis1"]);
    let (text, error) = texts(&output);
    assert!(
        text.starts_with("1.000000 node 5: TPDO 2: Position actual value = -2, Statusword = 567 ("),
        "{text}{error}"
    );
}
