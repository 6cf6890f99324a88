//! Tests the LSS slaves of simulated nodes with the LSS master of the Python library `canopen`.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort};
use lexibus::lss::BitRate;
use lexibus::sim::{CanBus, CanNode, Device};
use lexibus::{AccessRights, Bound, DataType, Entry, Flags, NodeId, Object, RawInitial};
use serde_json::{json, Value};

use crate::pty::Pty;
use crate::python::{python, Script};
use crate::slcan::Slcan;

const POLL: Duration = Duration::from_millis(5);

const fn part(sub_index: u8, initial: &'static [u8]) -> Entry {
    Entry {
        object: Some(Object::new(0x1018, sub_index)),
        register: None,
        name: "",
        data_type: DataType::Unsigned32,
        access: AccessRights::ReadOnly,
        flags: Flags::NONE,
        initial: RawInitial::Bytes(initial),
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

const ENTRIES: &[Entry] =
    &[part(1, &[0, 3, 0, 0]), part(2, &[1, 0, 0, 0x80]), part(3, &[2, 0, 1, 0]), part(4, &[0; 4])];

fn address(serial: u32) -> [u32; 4] {
    [0x300, 0x8000_0001, 0x1_0002, serial]
}

/// Connects a bus to the line, until the flag is set.
fn serve(line: Pty, bus: &Mutex<CanBus>, is_ended: &AtomicBool) {
    let mut line = Slcan::new(line);
    while !is_ended.load(Ordering::Relaxed) {
        let request = line.receive(POLL, &mut |_| true).expect("a line");
        let mut bus = bus.lock().expect("no panic");
        if let Some(request) = request {
            bus.send(&request, Duration::ZERO).expect("a bus");
        }
        let mut replies: Vec<CanFrame> = Vec::new();
        let mut keep = |frame: &CanFrame| {
            replies.push(*frame);
            false
        };
        bus.receive(Duration::ZERO, &mut keep).expect("a bus");
        for reply in replies {
            assert!(line.send(&reply, Duration::from_secs(10)).expect("a line"), "the line is full");
        }
    }
}

#[test]
fn lss_master() {
    let Some(python) = python() else { return };
    let line = Pty::open();
    let (mut script, _) = Script::start(python, "canopen_client.py", &[line.path(), "1"]);
    let mut bus = CanBus::new();
    for serial in [0x8000_0001_u32, 0x1000] {
        let mut device = Device::new(ENTRIES);
        device.set_initial_bytes(Object::new(0x1018, 4), &serial.to_le_bytes()).expect("an object");
        bus.add(CanNode::without_node_id(device));
    }
    let bus = Arc::new(Mutex::new(bus));
    let is_ended = Arc::new(AtomicBool::new(false));
    let (served, ended) = (bus.clone(), is_ended.clone());
    let server = thread::spawn(move || serve(line, &served, &ended));

    for (id, serial) in [(5, 0x1000), (6, 0x8000_0001_u32)] {
        assert_eq!(script.ask(json!({ "do": "fast_scan" })), json!(address(serial)));
        let [vendor, product, revision, serial] = address(serial);
        assert_eq!(script.ask(json!({ "do": "inquire" })), json!([vendor, product, revision, serial, 0xFF]));
        assert!(script.ask(json!({ "do": "configure", "node_id": id, "bit_timing": 5 })).is_string(), "5 is reserved");
        assert_eq!(script.ask(json!({ "do": "configure", "node_id": id, "bit_timing": 3 })), Value::Null);
        script.ask(json!({ "do": "wait" }));
    }
    assert_eq!(script.ask(json!({ "do": "fast_scan" })), Value::Null);
    assert_eq!(script.ask(json!({ "do": "select", "address": address(0x1000) })), true);
    let [vendor, product, revision, serial] = address(0x1000);
    assert_eq!(script.ask(json!({ "do": "inquire" })), json!([vendor, product, revision, serial, 5]));
    assert!(script.ask(json!({ "do": "configure", "node_id": 128, "bit_timing": 3 })).is_string());

    is_ended.store(true, Ordering::Relaxed);
    server.join().expect("no panic");
    let mut bus = bus.lock().expect("no panic");
    assert_eq!(bus.nodes().iter().map(CanNode::node_id).collect::<Vec<_>>(), [NodeId::new(6), NodeId::new(5)]);
    // The stored bit rate is used after a restart.
    bus.send(&lexibus::clients::canopen::NmtCommand::ResetNode.frame(None), Duration::ZERO).expect("a bus");
    assert_eq!(bus.nodes()[0].bit_rate(), Some(BitRate::Kbit250));
}
