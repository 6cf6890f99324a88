//! What isn't a transfer: the node's state, its heartbeat and its emergencies.

use lexibus::clients::canopen::{Emergency, NmtCommand, NmtState};
use lexibus_drives::demo_drive::codes;
use serde_json::json;

use super::all_types::AllTypes;
use super::{node_id, start, Error, Node, NODE, PATIENCE};

const FILE: &str = "tests/interop/all-types.toml";

#[test]
fn states_and_heartbeat() -> Result<(), Error> {
    let Some((mut script, node)) = start("heartbeat", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    assert_eq!(device.client().heartbeat(PATIENCE)?, Some(NmtState::BootUp));
    // Off by default.
    assert_eq!(device.heartbeat_time().read()?, 0);
    device.heartbeat_time().write(20)?;
    for (command, state, name) in [
        (NmtCommand::EnterPreOperational, NmtState::PreOperational, "PRE-OPERATIONAL"),
        (NmtCommand::Start, NmtState::Operational, "OPERATIONAL"),
        (NmtCommand::Stop, NmtState::Stopped, "STOPPED"),
        (NmtCommand::EnterPreOperational, NmtState::PreOperational, "PRE-OPERATIONAL"),
    ] {
        let node = device.client();
        // Of another node first: it isn't meant.
        node.send(&NmtCommand::Start.frame(lexibus::NodeId::new(NODE + 1)))?;
        node.nmt(command)?;
        node.wait_for(state, PATIENCE)?;
        assert_eq!(script.ask(json!({ "do": "state" })), name);
    }
    // All nodes.
    let node = device.client();
    node.send(&NmtCommand::Start.frame(None))?;
    node.wait_for(NmtState::Operational, PATIENCE)
}

fn emergency(node: &mut Node) -> Result<Emergency, Error> {
    Ok(node.emergency(PATIENCE)?.expect("an emergency message"))
}

#[test]
fn emergencies() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("emergency", FILE) else { return Ok(()) };
    script.ask(json!({ "do": "emergency", "code": 0x8110, "register": 0x11, "data": "0102030405" }));
    let received = emergency(&mut node)?;
    assert_eq!(received, Emergency { code: 0x8110, register: 0x11, vendor: [1, 2, 3, 4, 5] });
    assert_eq!(received.alarm::<codes::Emergency>(), codes::Emergency::CanOverrun);
    assert_eq!(received.frame(node_id()).data(), [0x10, 0x81, 0x11, 1, 2, 3, 4, 5]);
    script.ask(json!({ "do": "emergency", "code": 0, "register": 0, "data": "" }));
    assert!(emergency(&mut node)?.is_reset());
    Ok(())
}
