//! Tests the services other than SDO transfers: NMT states, heartbeat and emergency messages.

use lexibus::clients::canopen::{NmtCommand, NmtState};
use lexibus::Emergency;
use lexibus::NodeId;
use lexibus_drives::demo_drive::codes;
use serde_json::json;

use super::all_types::AllTypes;
use super::{node_id, start, Error, NODE, PATIENCE};

const FILE: &str = "tests/interop/all-types.toml";

#[test]
fn states_and_heartbeat() -> Result<(), Error> {
    let Some((mut script, node)) = start("heartbeat", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    assert_eq!(device.client().heartbeat(PATIENCE)?, Some(NmtState::BootUp));
    // The heartbeat is disabled by default.
    assert_eq!(device.heartbeat_time().read()?, 0);
    device.heartbeat_time().write(20)?;
    for (command, state, name) in [
        (NmtCommand::EnterPreOperational, NmtState::PreOperational, "PRE-OPERATIONAL"),
        (NmtCommand::Start, NmtState::Operational, "OPERATIONAL"),
        (NmtCommand::Stop, NmtState::Stopped, "STOPPED"),
        (NmtCommand::EnterPreOperational, NmtState::PreOperational, "PRE-OPERATIONAL"),
    ] {
        // The node must ignore commands for other nodes.
        device.client().send(&NmtCommand::Start.frame(NodeId::new(NODE + 1)))?;
        device.client().nmt(command)?;
        // An SDO response proves that the node has processed the command. A node of the Python library also answers SDO
        // requests in the state "Stopped".
        assert_eq!(device.heartbeat_time().read()?, 20);
        assert_eq!(script.ask(json!({ "do": "state" })), name);
        // Discard heartbeats that have already arrived.
        device.client().port().clear().map_err(lexibus::Error::Client)?;
        device.client().wait_for(state, PATIENCE)?;
    }
    device.client().send(&NmtCommand::Start.frame(None))?;
    device.client().wait_for(NmtState::Operational, PATIENCE)?;
    Ok(())
}

/// Emergency messages that arrive during a transfer must be available after it.
#[test]
fn emergencies() -> Result<(), Error> {
    let Some((mut script, node)) = start("emergency", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    script.ask(json!({ "do": "emergency", "code": 0x8110, "register": 0x11, "data": "0102030405" }));
    script.ask(json!({ "do": "emergency", "code": 0, "register": 0, "data": "" }));
    assert_eq!(device.fixed().read()?, 0x1234);
    let first = device.client().emergency(PATIENCE)?.expect("an emergency message");
    assert_eq!(first, Emergency { code: 0x8110, register: 0x11, vendor: [1, 2, 3, 4, 5] });
    assert_eq!(first.alarm::<codes::Emergency>(), codes::Emergency::CanOverrun);
    assert_eq!(first.frame(node_id()).data(), [0x10, 0x81, 0x11, 1, 2, 3, 4, 5]);
    assert!(!first.is_reset());
    let second = device.client().emergency(PATIENCE)?.expect("an emergency message");
    assert_eq!(second, Emergency { code: 0, register: 0, vendor: [0; 5] });
    assert!(second.is_reset());
    Ok(())
}
