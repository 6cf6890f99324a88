//! Tests the SDO server of the simulated node with the client of the Python library `canopen`: block transfers, and
//! segmented transfers for comparison.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort};
use lexibus::sim::{CanNode, Device};
use lexibus::{AbortCode, AccessRights, Bound, DataType, Entry, Flags, Object, RawInitial};
use serde_json::{json, Value};

use super::types::hex;
use super::{node_id, NODE};
use crate::pty::Pty;
use crate::python::{python, Script};
use crate::slcan::Slcan;

/// Object of type DOMAIN that can be read and written.
const FIRMWARE: Object = Object::new(0x2002, 0);
/// Object of the same type that cannot be written.
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
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}
/// Time to wait for a frame before the thread checks whether the test has ended.
const POLL: Duration = Duration::from_millis(20);

/// Selects the frames that the line loses, by their number among the frames with this identifier.
type Loses = fn(id: u32, number: usize) -> bool;

/// The simulated node on a serial line, in a thread.
struct Served {
    node: Arc<Mutex<CanNode>>,
    is_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Served {
    fn start(line: Pty, loses: Loses) -> Self {
        let entries = [domain(FIRMWARE, AccessRights::ReadWrite), domain(IDENTITY, AccessRights::ReadOnly)];
        let node = Arc::new(Mutex::new(CanNode::new(Device::new(&entries).with_node_id(node_id()))));
        let is_ended = Arc::new(AtomicBool::new(false));
        let (served, ended) = (node.clone(), is_ended.clone());
        let thread = thread::spawn(move || {
            let (mut line, mut requests, mut replies) = (Slcan::new(line), 0, 0);
            let mut is_lost = |frame: &CanFrame| {
                let count = if frame.id() == 0x600 + u32::from(NODE) { &mut requests } else { &mut replies };
                *count += 1;
                loses(frame.id(), *count)
            };
            while !ended.load(Ordering::Relaxed) {
                let request = line.receive(POLL, &mut |_| true).expect("a line");
                let mut node = served.lock().expect("no panic");
                if let Some(request) = request.filter(|request| !is_lost(request)) {
                    node.handle(&request);
                }
                while let Some(reply) = node.next_frame() {
                    if !is_lost(&reply) {
                        assert!(line.send(&reply, Duration::from_secs(10)).expect("a line"), "the line is full");
                    }
                }
            }
        });
        Self { node, is_ended, thread: Some(thread) }
    }

    fn value(&self) -> Vec<u8> {
        self.node.lock().expect("no panic").device().bytes(FIRMWARE).expect("an object").to_vec()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.is_ended.store(true, Ordering::Relaxed);
        let result = self.thread.take().map_or(Ok(()), JoinHandle::join);
        assert!(result.is_ok() || thread::panicking(), "the thread of the node has panicked");
    }
}

fn start(loses: Loses) -> Option<(Script, Served)> {
    let python = python()?;
    let line = Pty::open();
    let (script, _) = Script::start(python, "canopen_client.py", &[line.path(), &NODE.to_string()]);
    Some((script, Served::start(line, loses)))
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
    assert!(served.value() == value, "{length} bytes are written");
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
