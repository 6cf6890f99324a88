//! Runs the functions of the crate with independent programs: servers of `pymodbus`, and a node of the Python library
//! `canopen` behind an slcan adapter on a pseudo-terminal.
#[path = "../../../tests/interop/python.rs"]
#[allow(dead_code)]
mod python;

use std::time::Duration;

use crate::pty::Cable;
use crate::support::{dictionary, file, repository};
use lexibus_device::backup::{backup, difference, Backup, Options, Skipped};
use lexibus_device::restore::{Plan, Status};
use lexibus_device::scan::{scan, Fit};
use lexibus_device::verify::{verify, Options as VerifyOptions, Report};
use lexibus_device::{BusAddress, Connection, Description, Network, Write};
use python::{python, Script};
use serde_json::{json, Value};

const NODE: u8 = 5;
const TIMEOUT: Duration = Duration::from_millis(500);

/// Starts a script that simulates a CANopen node at one end of a cable. Returns the cable, the script and the address of the
/// bus at the other end. Returns `None` if Python or one of its libraries is missing.
fn node(script: &str) -> Option<(Cable, Script, BusAddress)> {
    let python = python()?;
    let cable = Cable::open();
    let [near, far] = cable.ends();
    let (script, eds) = (repository(script), repository("dictionaries/demo-drive.eds"));
    let arguments = [far, eds.to_str().expect("UTF-8"), "5"];
    let (script, _) = Script::start(python, script.to_str().expect("UTF-8"), &arguments);
    let bus = format!("slcan:{near}@500k").parse().expect("a bus");
    Some((cable, script, bus))
}

fn compare(description: &Description, bus: &BusAddress) -> Report {
    let mut connection = bus.connect(description, NODE, TIMEOUT).expect("a connection");
    let options = VerifyOptions { node_id: Some(NODE), ..VerifyOptions::default() };
    verify(description, &mut connection, &options).expect("a report")
}

/// The script changes its node so that it deviates from the EDS, and returns the kind and the address of each
/// deviation.
#[test]
fn each_deviation_is_found_and_no_other() {
    let Some((_cable, mut script, bus)) = node("device/tests/devices/deviations.py") else { return };
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    let report = compare(&description, &bus);
    assert_eq!(report.deviations().count(), 0, "{}", report.text(false));

    let expected = script.ask(json!({ "do": "deviate" }));
    let mut expected: Vec<(String, String)> = serde_json::from_value(expected).expect("kinds and addresses");
    assert!(expected.len() >= 20, "{} deviations", expected.len());
    let report = compare(&description, &bus);
    let found = report.deviations().map(|finding| (finding.kind.name().to_owned(), finding.address.clone()));
    let mut found: Vec<(String, String)> = found.collect();
    expected.sort();
    found.sort();
    assert_eq!(found, expected, "{}", report.text(false));

    let codes: Vec<u32> = report.deviations().filter_map(|finding| finding.abort_code).collect();
    assert!(codes.contains(&0x0800_0022) && codes.contains(&0x0602_0000), "{codes:X?}");
    check_overlay(&report, &bus);
}

/// Checks that with the overlay, `verify` reports no missing or extra parameters and no wrong lengths.
fn check_overlay(report: &Report, bus: &BusAddress) {
    let overlay = report.overlay().expect("an overlay");
    let options = lexibus_codegen::compile::Options {
        overlays: vec![lexibus_codegen::source::Source::new("found.toml", overlay.clone().into_bytes())],
        ..Default::default()
    };
    let eds = lexibus_codegen::source::Source::read(&repository("dictionaries/demo-drive.eds")).expect("an EDS");
    let corrected = Description::compile(eds, Network::CanOpen, &options);
    let corrected = corrected.unwrap_or_else(|error| panic!("{error}\n{overlay}"));
    let again = compare(&corrected, bus);
    for kind in ["missing", "extra"] {
        let left: Vec<_> = again.deviations().filter(|finding| finding.kind.name() == kind).collect();
        assert_eq!(left.len(), 0, "{left:?}\n{overlay}");
    }
    let lengths = again.deviations().filter(|finding| finding.message == "length").count();
    assert_eq!(lengths, 0, "{}\n{overlay}", again.text(false));
}

/// Chapter of the Modbus table with registers for which the server refuses reads, writes or both.
const REFUSED: &str = "What the server refuses";

fn save(description: &Description, connection: &mut impl Connection) -> Backup {
    let backup = backup(description, connection, &Options { node_id: Some(NODE), ..Options::default() });
    let backup = backup.expect("a backup");
    let is_expected = |skipped: &Skipped| !skipped.is_failure || skipped.name.starts_with(REFUSED);
    assert!(backup.skipped.iter().all(is_expected), "{:?}", backup.skipped);
    backup
}

/// Tries to change all unprotected parameters of a backup, and restores the backup from its TOML text. Returns the
/// unprotected parameters that did not accept another value.
fn changed_and_restored(description: &Description, connection: &mut impl Connection) -> Vec<String> {
    let saved = save(description, connection);
    let parameters = saved.entries.iter().filter_map(|entry| description.at(entry.address));
    let restorable = parameters.filter(|parameter| parameter.protection().is_none());
    let (changed, kept): (Vec<_>, Vec<_>) =
        restorable.partition(|parameter| crate::support::change(parameter, NODE, connection));
    assert!(difference(description, &saved, &save(description, connection)).len() >= changed.len());
    let read = Backup::from_toml(&saved.toml(description), description).expect("a backup");
    let plan = Plan::new(description, &read, Some(NODE), &[]);
    let outcome = plan.execute(connection, &mut |_| true);
    let failed = outcome.states.iter().filter(|(_, status)| *status != Status::Written);
    let is_expected = |write: &Write<'_>| write.parameter().path().starts_with(REFUSED);
    assert!({ failed }.all(|(write, _)| is_expected(write)) && outcome.mismatches.is_empty(), "{outcome}\n{plan}");
    assert_eq!(difference(description, &saved, &save(description, connection)), []);
    kept.iter().map(ToString::to_string).collect()
}

#[test]
fn a_canopen_node_gets_its_parameters_back() {
    let Some((_cable, mut script, bus)) = node("tests/interop/canopen_node.py") else { return };
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    let mut connection = bus.connect(&description, NODE, TIMEOUT).expect("a connection");
    let velocity = description.find("Profile velocity").expect("a parameter");
    Write::parse(velocity, "4711", None).expect("a value").execute(&mut connection).expect("a write");
    assert_eq!(script.ask(json!({ "do": "get", "index": 0x6081 })), json!(4711));
    let kept = changed_and_restored(&description, &mut connection);
    assert_eq!(kept, [""; 0], "all values changed");
    assert_eq!(script.ask(json!({ "do": "get", "index": 0x6081 })), json!(4711));
}

#[test]
fn a_scan_finds_the_node_and_its_description() {
    let Some((_cable, _script, bus)) = node("tests/interop/canopen_node.py") else { return };
    let mut port = bus.open_port().expect("a port");
    let nodes = scan(&mut port, Duration::from_millis(300)).expect("a scan");
    assert_eq!(nodes.iter().map(|node| node.node_id).collect::<Vec<_>>(), [NODE]);
    assert_eq!((nodes[0].product_code, nodes[0].name.as_deref()), (Some(0x4021), Some("Demo Drive")));
    assert_eq!(nodes[0].fit(&dictionary("demo-drive.eds", Network::CanOpen)), Some(Fit::Revision));
    assert_eq!(nodes[0].fit(&file("docs/examples/pump.eds", Network::CanOpen)), None);
}

#[test]
fn modbus_servers_get_their_parameters_back() {
    let Some(python) = python() else { return };
    let description = file("tests/interop/registers.toml", Network::Modbus);
    let script = repository("tests/interop/modbus_server.py");
    let script = script.to_str().expect("UTF-8");
    let (_server, port) = Script::start(python, script, &["tcp"]);
    let bus: BusAddress = format!("tcp:127.0.0.1:{port}").parse().expect("a bus");
    check_modbus(&description, &bus);

    let cable = Cable::open();
    let [near, far] = cable.ends();
    let (_server, ready) = Script::start(python, script, &["rtu", far]);
    assert_eq!(ready, Value::Null);
    check_modbus(&description, &format!("rtu:{near}@115200-8N1").parse().expect("a bus"));
}

fn check_modbus(description: &Description, bus: &BusAddress) {
    let mut connection = bus.connect(description, 1, TIMEOUT).expect("a connection");
    let kept = changed_and_restored(description, &mut connection);
    assert!(kept.iter().all(|parameter| parameter.contains(REFUSED)), "{kept:?}");
}
