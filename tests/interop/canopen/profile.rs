//! Tests a simulated CiA 402 drive with the CiA 402 profile of the Python library `canopen`. The library reads the PDO
//! mappings. It uses its own tables to select the commands for state transitions, and to confirm modes.

use lexibus::sim::{CanNode, Device};
use lexibus::Object;
use lexibus_drives::vector_step::ENTRIES;
use serde_json::json;

use super::served::Served;
use super::{exported, node_id, NODE};
use crate::pty::Pty;
use crate::python::{python, Script};

const FILE: &str = "dictionaries/aec-vector-step.toml";
const ACTUAL_POSITION: Object = Object::new(0x6064, 0);

/// Starts the simulated drive and the Python master, which sets the drive to Operational.
fn start(test: &str) -> Option<(Script, Served)> {
    let python = python()?;
    let line = Pty::open();
    let eds = exported(test, FILE);
    let arguments = [line.path(), eds.to_str().expect("UTF-8"), &NODE.to_string()];
    let (mut script, _) = Script::start(python, "canopen_drive.py", &arguments);
    let node = CanNode::new(Device::new(ENTRIES).with_node_id(node_id()).with_cia402());
    let served = Served::start(line, node, |_, _| false);
    assert_eq!(script.ask(json!({ "do": "setup" })), json!([true, true]), "the library uses PDOs");
    assert_eq!(script.ask(json!({ "do": "wait_state", "state": "SWITCH ON DISABLED" })), "SWITCH ON DISABLED");
    Some((script, served))
}

fn lead(script: &mut Script, state: &str) {
    assert_eq!(script.ask(json!({ "do": "state", "state": state })), state);
}

#[test]
fn states_of_the_library() {
    let Some((mut script, _served)) = start("profile-states") else { return };
    for state in [
        "OPERATION ENABLED",
        "SWITCHED ON",
        "READY TO SWITCH ON",
        "SWITCH ON DISABLED",
        "OPERATION ENABLED",
        "SWITCH ON DISABLED",
    ] {
        lead(&mut script, state);
    }
}

#[test]
fn modes_and_profile_position() {
    let Some((mut script, served)) = start("profile-position") else { return };
    assert_eq!(script.ask(json!({ "do": "mode", "mode": "PROFILED POSITION" })), "PROFILED POSITION");
    lead(&mut script, "OPERATION ENABLED");
    for target in [30, -20] {
        assert_eq!(script.ask(json!({ "do": "move", "target": target })), target);
        let position = served.node.lock().expect("no panic").device().bytes(ACTUAL_POSITION).map(<[u8]>::to_vec);
        assert_eq!(position, Ok(i32::to_le_bytes(target).to_vec()));
    }
    assert_eq!(script.ask(json!({ "do": "mode", "mode": "HOMING" })), "HOMING");
    assert_eq!(script.ask(json!({ "do": "get", "index": 0x6061, "sub": 0 })), 6);
}

#[test]
fn homing_of_the_library() {
    let Some((mut script, served)) = start("profile-homing") else { return };
    let begin = served.node.lock().expect("no panic").device().set_bytes(ACTUAL_POSITION, &500_i32.to_le_bytes());
    assert_eq!(begin, Ok(()));
    assert_eq!(script.ask(json!({ "do": "home" })), true);
    assert_eq!(served.node.lock().expect("no panic").device().bytes(ACTUAL_POSITION), Ok(&[0; 4][..]));
}

#[test]
fn a_fault_stops_the_drive_of_the_library() {
    let Some((mut script, served)) = start("profile-fault") else { return };
    lead(&mut script, "OPERATION ENABLED");
    served.node.lock().expect("no panic").device().fail(0x8611).expect("a drive");
    assert_eq!(script.ask(json!({ "do": "wait_state", "state": "FAULT" })), "FAULT");
    assert_eq!(script.ask(json!({ "do": "get", "index": 0x603F, "sub": 0 })), 0x8611);
    lead(&mut script, "OPERATION ENABLED");
}
