//! Names and values of frames, and the search for nodes.

use std::time::Duration;

use crate::support::dictionary;
use lexibus::clients::canopen::{CanFrame, CanPort, NmtCommand, Node};
use lexibus::sim::{CanBus, CanNode, Device};
use lexibus::{Client, NodeId, Object};
use lexibus_device::monitor::{EventKind, Interpreter};
use lexibus_device::scan::{scan, Fit};
use lexibus_device::slcan::Decoder;
use lexibus_device::trace::{Line, Reader};
use lexibus_device::{AnyPort, Description, Network};
use lexibus_drives::demo_drive;

fn drive() -> Description {
    dictionary("demo-drive.eds", Network::CanOpen)
}

fn id(node: u8) -> NodeId {
    NodeId::new(node).expect("a node-ID")
}

#[track_caller]
fn shown(description: &Description, frame: (u32, &[u8]), expected: &str) {
    let frame = CanFrame::new(frame.0, frame.1).expect("a frame");
    let event = Interpreter::new([(5, description)]).interpret(&frame);
    assert_eq!(event.map(|event| event.to_string()).as_deref(), Some(expected));
}

#[test]
fn frames_have_names() {
    let drive = drive();
    shown(&drive, (0x000, &[1, 5]), "node 5: NMT start");
    shown(&drive, (0x000, &[129, 0]), "NMT reset node (all nodes)");
    shown(&drive, (0x705, &[0x7F]), "node 5: state Pre-operational");
    shown(&drive, (0x709, &[0]), "node 9: boot-up");
    shown(&drive, (0x080, &[]), "SYNC");
    shown(&drive, (0x080, &[7]), "SYNC 7");
    shown(
        &drive,
        (0x085, &[0x11, 0x86, 0x21, 1, 0, 0, 0, 0]),
        "node 5: EMCY 0x8611 (following error), error register 0x21, vendor data 01 00 00 00 00",
    );
    shown(&drive, (0x085, &[0; 8]), "node 5: EMCY 0x0000: no error");
    shown(&drive, (0x285, &[0x37, 0x02, 0xFE, 0xFF, 0xFF, 0xFF]), "node 5: TPDO 2: Statusword = 567 (ready to switch on, switched on, operation enabled, voltage enabled, remote), Position actual value = -2");
    shown(&drive, (0x605, &[0x40, 0x81, 0x60, 0, 0, 0, 0, 0]), "node 5: SDO upload of 0x6081:00 Profile velocity");
    shown(
        &drive,
        (0x585, &[0x43, 0x81, 0x60, 0, 0xE8, 3, 0, 0]),
        "node 5: SDO upload reply: 0x6081:00 Profile velocity = 1000",
    );
    shown(
        &drive,
        (0x605, &[0x2B, 0x17, 0x10, 0, 100, 0, 0, 0]),
        "node 5: SDO download: 0x1017:00 Producer heartbeat time = 100 ms",
    );
    shown(&drive, (0x585, &[0x80, 0, 0x20, 0, 0x22, 0, 0, 8]), "node 5: SDO abort of 0x2000:00 Motor temperature: 0x08000022: the data cannot be transferred or stored in the present state of the device");
    shown(&drive, (0x606, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), "node 6: SDO upload of 0x1000:00");
}

/// Interprets SDO messages of node 5 in turn.
#[track_caller]
fn exchange(interpreter: &mut Interpreter<'_>, messages: &[(u32, [u8; 8], &str)]) {
    for (id, data, expected) in messages {
        let event = interpreter.interpret(&CanFrame::new(*id, data).expect("a frame")).expect("an event");
        assert_eq!(event.to_string(), format!("node 5: SDO {expected}"));
    }
}

#[test]
fn segments_of_block_transfers_are_not_commands() {
    let drive = drive();
    let interpreter = &mut Interpreter::new([(5, &drive)]);
    // A download with sub-blocks of 33 segments. The sequence numbers 0x20 and 0x21 look like commands.
    exchange(
        interpreter,
        &[
            (0x605, [0xC6, 0x08, 0x10, 0, 238, 0, 0, 0], "block download of 0x1008:00 Manufacturer device name"),
            (0x585, [0xA4, 0x08, 0x10, 0, 33, 0, 0, 0], "block download reply of 0x1008:00 Manufacturer device name"),
        ],
    );
    let segments: Vec<_> =
        (1..=33).map(|sequence| (0x605, [sequence, 0x81, 0x60, 0, 1, 2, 3, 4], "block segment")).collect();
    exchange(interpreter, &segments);
    exchange(
        interpreter,
        &[
            // The server received 32 segments, so the client sends the last one again, and one more.
            (0x585, [0xA2, 32, 33, 0, 0, 0, 0, 0], "block acknowledgement"),
            (0x605, [1, 0x81, 0x60, 0, 1, 2, 3, 4], "block segment"),
            (0x605, [0x82, 0x81, 0x60, 0, 1, 2, 3, 4], "block segment"),
            (0x585, [0xA2, 1, 33, 0, 0, 0, 0, 0], "block acknowledgement"),
            (0x605, [0x81, 0x81, 0x60, 0, 1, 2, 3, 4], "block segment"),
            (0x585, [0xA2, 1, 33, 0, 0, 0, 0, 0], "block acknowledgement"),
            (0x605, [0xC1, 0x34, 0x12, 0, 0, 0, 0, 0], "block end"),
            (0x585, [0xA1, 0, 0, 0, 0, 0, 0, 0], "block end reply"),
            (0x605, [0x40, 0x81, 0x60, 0, 0, 0, 0, 0], "upload of 0x6081:00 Profile velocity"),
        ],
    );
    // An upload, and an abort within its segments.
    exchange(
        interpreter,
        &[
            (0x605, [0xA4, 0x08, 0x10, 0, 127, 0, 0, 0], "block upload of 0x1008:00 Manufacturer device name"),
            (0x585, [0xC6, 0x08, 0x10, 0, 20, 0, 0, 0], "block upload reply of 0x1008:00 Manufacturer device name"),
            (0x605, [0xA3, 0, 0, 0, 0, 0, 0, 0], "block start"),
            (0x585, [0x01, 0x81, 0x60, 0, 1, 2, 3, 4], "block segment"),
            (
                0x605,
                [0x80, 0x08, 0x10, 0, 0, 0, 4, 5],
                "abort of 0x1008:00 Manufacturer device name: 0x05040000: the transfer timed out",
            ),
            (0x585, [0x43, 0x81, 0x60, 0, 0xE8, 3, 0, 0], "upload reply: 0x6081:00 Profile velocity = 1000"),
        ],
    );
}

#[test]
fn unknown_and_short_frames_have_no_values() {
    let drive = drive();
    let mut interpreter = Interpreter::new([(5, &drive)]);
    assert_eq!(interpreter.interpret(&CanFrame::new(0x123, &[1]).expect("a frame")), None);
    assert_eq!(interpreter.interpret(&CanFrame::remote(0x185, 2).expect("a frame")), None);
    let short = interpreter.interpret(&CanFrame::new(0x285, &[0x37, 2]).expect("a frame")).expect("a PDO");
    assert_eq!((short.kind, short.values.len()), (EventKind::Pdo, 1));
}

#[test]
fn a_scan_finds_all_nodes_and_their_descriptions() {
    let mut bus = CanBus::new();
    for node in [1, 5, 127] {
        bus.add(CanNode::new(Device::new(demo_drive::ENTRIES).with_node_id(id(node))));
        // The period of the heartbeat is shorter than the timeout. The heartbeats must not extend the search.
        Node::new(&mut bus, id(node)).write(Object::new(0x1017, 0), &10_u16.to_le_bytes()).expect("a write");
    }
    let found = scan(&mut bus, Duration::from_millis(100)).expect("a scan");
    assert_eq!(found.iter().map(|node| node.node_id).collect::<Vec<_>>(), [1, 5, 127]);
    assert_eq!(found[1].fit(&drive()), Some(Fit::Revision));
    // The search changes no state and sends no NMT command.
    assert!(bus.nodes().iter().all(|node| node.state() == lexibus::clients::canopen::NmtState::PreOperational));
}

#[test]
fn the_traffic_of_a_simulated_drive_has_names() {
    let drive = drive();
    let mut interpreter = Interpreter::new([(5, &drive)]);
    let mut bus = CanBus::new();
    bus.add(CanNode::new(Device::new(demo_drive::ENTRIES).with_node_id(id(5))));
    let mut node = Node::new(&mut bus, id(5));
    node.nmt(NmtCommand::Start).expect("a command");
    node.write(Object::new(0x1017, 0), &100_u16.to_le_bytes()).expect("a write");
    bus.nodes()[0].device().set_bytes(Object::new(0x6041, 0), &[0x37, 2]).expect("an object");
    let mut port = AnyPort::new(bus);
    let mut texts = Vec::new();
    while let Some(frame) = port.receive(Duration::from_millis(250), &mut |_| true).expect("a bus") {
        texts.extend(interpreter.interpret(&frame).map(|event| event.to_string()));
        if texts.len() > 20 {
            break;
        }
    }
    assert!(texts.iter().any(|text| text == "node 5: state Operational"), "{texts:?}");
    assert!(texts.iter().any(|text| text.starts_with("node 5: TPDO 1: Statusword = ")), "{texts:?}");
}

/// Returns the next pseudo-random number (xorshift64).
fn random(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

#[test]
fn no_frame_and_no_line_causes_a_panic() {
    let (drive, stepper) = (drive(), dictionary("aec-vector-step.toml", Network::CanOpen));
    let mut interpreter = Interpreter::new([(5, &drive), (6, &stepper)]);
    let (mut state, mut events, mut frames) = (0x9E37_79B9_7F4A_7C15, 0, 0);
    for _ in 0..200_000 {
        let number = random(&mut state);
        let data = random(&mut state).to_le_bytes();
        let frame = CanFrame::new((number & 0x7FF) as u32, &data[..(number >> 16) as usize % 9]).expect("a frame");
        events += usize::from(interpreter.interpret(&frame).is_some());
    }
    let pieces = [
        "(",
        ")",
        "1.5",
        " can0 ",
        "185",
        "#",
        "0A",
        "[2]",
        "R",
        "T",
        "t1852",
        "date",
        "base dec",
        "d",
        "Rx",
        "\r",
        "é",
        " ",
        "x",
        "-1",
        "(1.5) can0 ",
        "1.5 1 185 Rx d 1 0A ",
        "185#0A",
    ];
    let slcan = ["t185", "T", "00000185", "r", "2", "0A", "1234", "é", "x", "\r", "\r", "\x07"];
    let (mut reader, mut decoder, mut decoded) = (Reader::new(), Decoder::default(), 0);
    for _ in 0..100_000 {
        let count = random(&mut state) % 9;
        let mut line = |pieces: &[&str]| {
            (0..count).map(|_| pieces[random(&mut state) as usize % pieces.len()]).collect::<String>()
        };
        frames += usize::from(matches!(reader.line(&line(&pieces)), Line::Frame(_)));
        decoder.push(line(&slcan).as_bytes());
        decoded += std::iter::from_fn(|| decoder.next_frame()).count();
    }
    assert!(
        events > 5_000 && frames > 10 && decoded > 10,
        "{events} events, {frames} frames of traces, {decoded} of an adapter"
    );
}
