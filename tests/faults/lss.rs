//! Tests the LSS master with slaves whose answers are delayed, lost or corrupted.

use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, LssMaster};
use lexibus::lss::{IdentityPart, LssAddress, LssError, LssState};
use lexibus::sim::{CanBus, CanError, CanFault, CanNode, Device};
use lexibus::{AccessRights, Bound, DataType, Entry, Flags, NodeId, Object, RawInitial};

use crate::faulty::{faults, faulty, foreign, set, Faulty, TIMEOUT};
use crate::matrix::Row;
use crate::now::now;
use crate::random::Random;

const SERIAL: Object = Object::new(0x1018, 4);

const ENTRIES: &[Entry] = &[Entry {
    object: Some(SERIAL),
    register: None,
    name: "",
    data_type: DataType::Unsigned32,
    access: AccessRights::ReadOnly,
    flags: Flags::NONE,
    initial: RawInitial::Bytes(&[0; 4]),
    configured: None,
    low: Bound::Unlimited,
    high: Bound::Unlimited,
    unit: "",
}];

/// Returns a master with one slave, which has no node-ID.
fn master() -> LssMaster<Faulty> {
    let mut bus = CanBus::new();
    bus.add(CanNode::without_node_id(Device::new(ENTRIES)));
    LssMaster::new(faulty(bus)).with_timeout(TIMEOUT)
}

fn id(node: u8) -> NodeId {
    NodeId::new(node).expect("a node-ID")
}

fn set_serial(master: &mut LssMaster<Faulty>, serial: u32) {
    let node = &mut master.port().bus().nodes()[0];
    node.device().set_bytes(SERIAL, &serial.to_le_bytes()).expect("an object");
}

/// Inquires the serial number, which is different for each request.
fn inquire(master: &mut LssMaster<Faulty>, is_async: bool, serial: u32) -> Result<u32, LssError<CanError>> {
    set_serial(master, serial);
    let result = match is_async {
        true => now(master.inquire_async(IdentityPart::SerialNumber)),
        false => master.inquire(IdentityPart::SerialNumber),
    };
    assert!(result.is_err() || result == Ok(serial), "a wrong value");
    result
}

fn name(result: Result<u32, LssError<CanError>>) -> &'static str {
    match result {
        Ok(_) => "right value",
        Err(LssError::Timeout) => "`Timeout`",
        Err(LssError::Client(_)) => "`Client`",
        Err(LssError::SeveralAnswers) => "`SeveralAnswers`",
        Err(other) => panic!("an error without a name in the table: {other:?}"),
    }
}

#[test]
fn late_answers_are_not_those_of_the_next_request() {
    let (mut master, mut random, mut late, mut failed) = (master(), Random::new(5), 0, 0);
    master.switch_global(LssState::Configuration).expect("a bus");
    for serial in 0..10_000 {
        let is_late = random.below(20) == 0;
        let delay = TIMEOUT + Duration::from_millis(random.below(450));
        set(master.port(), is_late.then_some(CanFault::Late(delay)));
        late += u32::from(is_late);
        failed += u32::from(inquire(&mut master, serial % 2 == 0, serial).is_err());
    }
    println!("10,000 inquiries, {late} late: {failed} errors, no wrong value");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late answers");
}

#[test]
fn a_scan_with_faults_doesnt_return_a_wrong_address() {
    let mut random = Random::new(7);
    let (mut found, mut inconclusive) = (0, 0);
    for _ in 0..80 {
        let (mut master, serial) = (master(), random.below(1 << 32) as u32);
        set_serial(&mut master, serial);
        let fault = match random.below(3) {
            0 => Some(CanFault::Late(Duration::from_millis(random.below(60)))),
            1 => Some(CanFault::Duplicated),
            _ => None,
        };
        set(master.port(), fault);
        match master.fast_scan() {
            Ok(Some(address)) => {
                assert_eq!(address, LssAddress { serial_number: serial, ..LssAddress::default() });
                found += 1;
            }
            // With duplicated answers, the inquiries fail.
            Err(LssError::Inconclusive | LssError::Timeout | LssError::SeveralAnswers) => inconclusive += 1,
            other => panic!("{other:?}"),
        }
        // In the state Waiting, the slave does not answer the next request. Late answers of the scan arrive during the
        // timeout of this request.
        set(master.port(), None);
        assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
        assert_eq!(master.configure_node_id(id(5)), Err(LssError::Timeout));
        assert_eq!(master.fast_scan().map(|address| address.map(|it| it.serial_number)), Ok(Some(serial)));
    }
    println!("80 scans: {found} right, {inconclusive} inconclusive, no wrong address");
    assert!(found > 20 && inconclusive > 10, "{found} {inconclusive}");
}

/// Returns the active node-IDs after the next scan.
fn node_ids(master: &mut LssMaster<Faulty>) -> Vec<Option<NodeId>> {
    set(master.port(), None);
    let _ = master.fast_scan();
    master.port().bus().nodes().iter().map(CanNode::node_id).collect()
}

#[test]
fn a_node_id_that_was_not_confirmed_is_not_used() {
    for fault in [CanFault::Lost, CanFault::Late(TIMEOUT * 2), CanFault::Duplicated] {
        for is_async in [false, true] {
            let mut master = master();
            master.switch_global(LssState::Configuration).expect("a bus");
            set(master.port(), fault);
            let result = match is_async {
                true => now(master.configure_node_id_async(id(5))),
                false => master.configure_node_id(id(5)),
            };
            assert!(matches!(result, Err(LssError::Timeout | LssError::SeveralAnswers)), "{result:?}");
            assert_eq!(node_ids(&mut master), [None], "{fault:?}");
        }
    }
}

#[test]
fn a_second_slave_that_answers_later_is_noticed() {
    let answer = |command| CanFrame::new(0x7E4, &[command, 0, 0, 0, 0, 0, 0, 0]).expect("a frame");
    let mut master = master();
    master.switch_global(LssState::Configuration).expect("a bus");
    // An answer arrives every 200 ms, which is longer than the window. After an answer to this service, the master waits for
    // further answers for the whole timeout.
    set(master.port(), foreign(answer(0x11)));
    assert_eq!(master.configure_node_id(id(5)), Err(LssError::SeveralAnswers));
    assert_eq!(node_ids(&mut master), [None]);
}

#[test]
fn a_lost_or_late_answer_doesnt_end_the_search() {
    let mut master = master();
    set(master.port(), CanFault::Late(Duration::from_millis(100)));
    assert_eq!(master.fast_scan(), Err(LssError::Inconclusive));
    set(master.port(), None);
    master.port().inject_nth(CanFault::Lost, 1);
    assert_eq!(master.fast_scan(), Ok(Some(LssAddress::default())));
}

/// Returns the rows for LSS in the table of faults.
pub fn rows() -> Vec<Row> {
    let frame = CanFrame::new(0x7E4, &[0x5A, 9, 9, 9, 9, 0, 0, 0]).expect("a frame");
    let mut rows = Vec::new();
    for (fault_name, fault) in faults(frame) {
        for is_async in [false, true] {
            let mut master = master();
            master.switch_global(LssState::Configuration).expect("a bus");
            let start = master.port().bus().now();
            set(master.port(), fault);
            let result = name(inquire(&mut master, is_async, 1));
            let middle = master.port().bus().now();
            set(master.port(), None);
            if fault == CanFault::Restart {
                master.switch_global(LssState::Configuration).expect("a bus");
            }
            inquire(&mut master, is_async, 2).expect("the next request is right");
            let (time, next) = (middle - start, master.port().bus().now() - middle);
            rows.push(Row { client: "LSS", is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
        }
    }
    rows
}
