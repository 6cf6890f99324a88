//! Tests the SDO server of the simulated node with the client of the Python library `canopen`: block transfers, and
//! segmented transfers for comparison.

use lexibus::sim::{CanNode, Device};
use lexibus::{AbortCode, AccessRights, Bound, DataType, Entry, Flags, Object, RawInitial};
use serde_json::{json, Value};

use super::served::{Loses, Served};
use super::types::hex;
use super::{node_id, NODE};
use crate::pty::Pty;
use crate::python::{python, Script};

/// Object of type DOMAIN that can be read and written.
const FIRMWARE: Object = Object::new(0x2002, 0);
/// Object of type DOMAIN that cannot be written.
const IDENTITY: Object = Object::new(0x2003, 0);

const fn domain(object: Object, access: AccessRights) -> Entry {
    Entry {
        object: Some(object),
        register: None,
        name: "",
        data_type: DataType::Domain,
        access,
        flags: Flags::NONE,
        initial: RawInitial::Unknown,
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

fn start(loses: Loses) -> Option<(Script, Served)> {
    let python = python()?;
    let line = Pty::open();
    let (script, _) = Script::start(python, "canopen_client.py", &[line.path(), &NODE.to_string()]);
    let entries = [domain(FIRMWARE, AccessRights::ReadWrite), domain(IDENTITY, AccessRights::ReadOnly)];
    let node = CanNode::new(Device::new(&entries).with_node_id(node_id()));
    Some((script, Served::start(line, node, loses)))
}

fn value(length: usize) -> Vec<u8> {
    (0..length).map(|at| (at * 7 + at / 256) as u8).collect()
}

/// Writes a value with the Python client and reads it back.
fn round_trip(script: &mut Script, served: &Served, length: usize, block: bool, crc: bool) {
    let value = value(length);
    let (index, sub) = (FIRMWARE.index, FIRMWARE.sub_index);
    let write =
        json!({ "do": "download", "index": index, "sub": sub, "data": hex(&value), "block": block, "crc": crc });
    assert_eq!(script.ask(write), Value::Null, "{length}");
    let is_written = served.node.lock().expect("no panic").device().bytes(FIRMWARE) == Ok(&value[..]);
    assert!(is_written, "{length} bytes are written");
    let read = json!({ "do": "upload", "index": index, "sub": sub, "block": block, "crc": crc });
    assert_eq!(script.ask(read), hex(&value), "{length}");
}

#[test]
fn block_transfers() {
    let Some((mut script, served)) = start(|_, _| false) else { return };
    for length in [1, 7, 8, 100, 889, 890, 5000] {
        round_trip(&mut script, &served, length, true, true);
    }
    round_trip(&mut script, &served, 3000, true, false);
    round_trip(&mut script, &served, 300, false, false);
}

#[test]
fn lost_segments() {
    // Request 20 is segment 19 of the download. The replies to the download are its start, four acknowledgments and its
    // end; reply 40 is a segment of the upload.
    let Some((mut script, served)) = start(|id, number| number == if id == 0x605 { 20 } else { 40 }) else { return };
    round_trip(&mut script, &served, 2000, true, true);
}

#[test]
fn refused_block_transfers() {
    let Some((mut script, _served)) = start(|_, _| false) else { return };
    let write = |index: u16, length: usize| json!({ "do": "download", "index": index, "sub": 0, "data": hex(&value(length)), "block": true });
    assert_eq!(script.ask(write(IDENTITY.index, 20)), AbortCode::READ_ONLY.0);
    assert_eq!(script.ask(write(0x5FFF, 20)), AbortCode::NO_OBJECT.0);
    assert_eq!(script.ask(write(FIRMWARE.index, 9000)), AbortCode::OUT_OF_MEMORY.0);
    assert_eq!(script.ask(write(FIRMWARE.index, 20)), Value::Null);
}
