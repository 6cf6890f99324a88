//! Tests the communication parameters of PDOs with a simulated node, which sends its PDOs as configured.

use std::time::Duration;

use lexibus::clients::canopen::{self, NmtCommand, Node};
use lexibus::pdo::{PdoParameterError, PdoParameters, TransmissionType};
use lexibus::sim::{CanNode, Device};
use lexibus::{AbortCode, Client, DataType, Entry, Error, NodeId, Object, RawInitial, SdoWrite};
use lexibus_drives::vector_step::{pdo, ENTRIES};

#[path = "support/entry.rs"]
mod entry;
#[path = "support/now.rs"]
mod now;
use now::now;

const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};
const NEW: PdoParameters = PdoParameters::new();

lexibus::pdo! {
    /// A user-defined mapping of the drive.
    pub struct Feedback: lexibus_drives::vector_step::pdo::TxPdo1 { statusword }
}

type Drive = Node<CanNode>;

/// Creates a node in Operational, whose PDOs are all disabled.
fn drive() -> Drive {
    let mut device = Device::new(ENTRIES).with_node_id(NODE);
    for index in (0x1400..0x1404).chain(0x1800..0x1804) {
        let cob_id = device.bytes(Object::new(index, 1)).expect("a PDO").to_vec();
        let disabled = [cob_id[0], cob_id[1], 0, 0x80];
        device.set_bytes(Object::new(index, 1), &disabled).expect("a COB-ID");
    }
    let mut drive = Node::new(CanNode::new(device), NODE);
    drive.nmt(NmtCommand::Start).expect("no error");
    drive
}

fn configure<const N: usize>(drive: &mut Drive, parameters: PdoParameters, configuration: [SdoWrite; N]) {
    parameters.configure(configuration).expect("valid").send(drive).expect("accepted");
}

fn set(drive: &mut Drive, statusword: u16) {
    drive.port().device().set_bytes(Object::new(0x6041, 0), &statusword.to_le_bytes()).expect("a statusword");
}

/// Returns the number of PDOs with COB-ID 0x185 that the node sends within the time `time`.
fn count(drive: &mut Drive, time: Duration) -> usize {
    let mut count = 0;
    let end = drive.port().now() + time;
    loop {
        let left = end.saturating_sub(drive.port().now());
        match canopen::CanPort::receive(drive.port(), left, &mut |frame| frame.id() == 0x185).expect("no error") {
            Some(_) => count += 1,
            None => return count,
        }
    }
}

/// Returns, for each of several SYNC messages, whether the node sends the PDO.
fn after_syncs<const N: usize>(drive: &mut Drive, mut sync: impl FnMut(&mut Drive, usize)) -> [bool; N] {
    core::array::from_fn(|at| {
        sync(drive, at);
        count(drive, Duration::from_millis(1)) == 1
    })
}

#[test]
fn every_nth_sync() {
    for every in [1, 2, 5, 240_u8] {
        let mut drive = drive();
        let parameters = NEW.transmission(TransmissionType::EverySync(every));
        configure(&mut drive, parameters, Feedback::configuration(NODE));
        let sent: [bool; 480] = after_syncs(&mut drive, |drive, _| drive.sync().expect("sent"));
        for (at, is_sent) in sent.into_iter().enumerate() {
            assert_eq!(is_sent, (at + 1) % usize::from(every) == 0, "SYNC {at}, every {every}");
        }
    }
}

#[test]
fn on_sync_if_the_data_changed() {
    let mut drive = drive();
    let parameters = NEW.transmission(TransmissionType::SynchronousAcyclic);
    configure(&mut drive, parameters, Feedback::configuration(NODE));
    let sent: [bool; 5] = after_syncs(&mut drive, |drive, at| {
        if at == 3 {
            set(drive, 0x1234);
        }
        drive.sync().expect("sent");
    });
    assert_eq!(sent, [true, false, false, true, false]);
}

#[test]
fn on_events() {
    for transmission in [TransmissionType::ManufacturerEvent, TransmissionType::ProfileEvent] {
        let mut drive = drive();
        let parameters = NEW
            .transmission(transmission)
            .inhibit_time(Duration::from_micros(10_500))
            .event_timer(Duration::from_millis(100));
        configure(&mut drive, parameters, Feedback::configuration(NODE));
        assert_eq!(count(&mut drive, Duration::ZERO), 1, "the first PDO");
        let start = drive.port().now();
        set(&mut drive, 1);
        assert_eq!(count(&mut drive, Duration::from_micros(10_400)), 0, "inhibited");
        assert_eq!(count(&mut drive, Duration::from_micros(100)), 1, "{:?}", drive.port().now() - start);
        assert_eq!(count(&mut drive, Duration::from_millis(99)), 0);
        assert_eq!(count(&mut drive, Duration::from_millis(1)), 1, "the event timer");
        assert_eq!(count(&mut drive, Duration::from_millis(1000)), 10);
        drive.sync().expect("sent");
        assert_eq!(count(&mut drive, Duration::ZERO), 0);
        // Another configuration replaces the timers.
        configure(&mut drive, NEW.event_timer(Duration::from_millis(10)), Feedback::configuration_as(0x185));
        assert_eq!(count(&mut drive, Duration::from_millis(1000)), 101);
    }
}

#[test]
fn a_pdo_that_is_enabled_again_starts_anew() {
    let mut drive = drive();
    let event = NEW.transmission(TransmissionType::ProfileEvent);
    for _ in 0..2 {
        configure(&mut drive, event, Feedback::configuration(NODE));
        assert_eq!(count(&mut drive, Duration::from_millis(10)), 1, "the data didn't change");
    }
    let cyclic = NEW.transmission(TransmissionType::EverySync(3));
    for _ in 0..2 {
        configure(&mut drive, cyclic, Feedback::configuration(NODE));
        let sent: [bool; 5] = after_syncs(&mut drive, |drive, _| drive.sync().expect("sent"));
        assert_eq!(sent, [false, false, true, false, false]);
    }
    // If an RPDO is disabled while received data wait for SYNC, the data are lost.
    configure(&mut drive, cyclic, pdo::RxPdo1::configuration(NODE));
    let mut data = [0; pdo::RxPdo1::LEN];
    data[0] = 6;
    drive.send_pdo(pdo::RxPdo1::COB_ID, &data).expect("sent");
    configure(&mut drive, cyclic, pdo::RxPdo1::configuration(NODE));
    drive.sync().expect("sent");
    assert_eq!(drive.port().device().bytes(Object::new(0x6040, 0)).expect("it exists")[0], 0);
}

#[test]
fn received_pdos_on_sync_and_at_once() {
    let controlword = |drive: &mut Drive| drive.port().device().bytes(Object::new(0x6040, 0)).expect("it exists")[0];
    for (transmission, is_at_once) in [
        (TransmissionType::EverySync(3), false),
        (TransmissionType::SynchronousAcyclic, false),
        (TransmissionType::ProfileEvent, true),
        (TransmissionType::ManufacturerEvent, true),
    ] {
        let mut drive = drive();
        configure(&mut drive, NEW.transmission(transmission), pdo::RxPdo1::configuration(NODE));
        let mut data = [0; pdo::RxPdo1::LEN];
        data[0] = 6;
        drive.send_pdo(pdo::RxPdo1::COB_ID, &data).expect("sent");
        assert_eq!(controlword(&mut drive), if is_at_once { 6 } else { 0 }, "{transmission:?}");
        drive.sync().expect("sent");
        assert_eq!(controlword(&mut drive), 6);
    }
}

#[test]
fn remote_requests_are_refused_by_the_cob_id() {
    let mut drive = drive();
    let parameters = NEW.transmission(TransmissionType::ProfileEvent).remote_requests(false);
    configure(&mut drive, parameters, Feedback::configuration(NODE));
    assert_eq!(count(&mut drive, Duration::ZERO), 1);
    let mut buffer = [0; 4];
    assert_eq!(drive.read(Object::new(0x1800, 1), &mut buffer), Ok(4));
    assert_eq!(u32::from_le_bytes(buffer), 0x4000_0185);
}

#[test]
fn parameters_of_an_enabled_pdo_are_refused() {
    let mut drive = drive();
    configure(&mut drive, NEW.transmission(TransmissionType::ProfileEvent), Feedback::configuration(NODE));
    let refused = SdoWrite::new_u16(0x1800, 3, 10).send(&mut drive);
    assert_eq!(refused.map_err(Error::from), Err(Error::Abort(AbortCode::INVALID_VALUE)));
    // The drive has no sub-index for the SYNC start value, so it refuses the configuration, and the PDO stays disabled.
    let parameters = NEW.transmission(TransmissionType::EverySync(1)).sync_start(1);
    let refused = parameters.configure(Feedback::configuration(NODE)).expect("valid").send(&mut drive);
    assert_eq!(refused.map_err(Error::from), Err(Error::Abort(AbortCode::NO_SUB_INDEX)));
    count(&mut drive, Duration::ZERO);
    drive.sync().expect("sent");
    assert_eq!(count(&mut drive, Duration::from_secs(1)), 0);
}

#[test]
fn invalid_parameters_are_errors() {
    let long = NEW.inhibit_time(Duration::from_secs(7)).configure(Feedback::configuration(NODE));
    assert_eq!(long.map(|_| ()), Err(PdoParameterError::InhibitTime));
    let received = NEW.sync_start(1).configure(pdo::RxPdo1::configuration(NODE));
    assert_eq!(received.map(|_| ()), Err(PdoParameterError::OnlyTransmitted));
}

#[test]
fn without_blocking() {
    let mut drive = drive();
    let configuration = NEW.transmission(TransmissionType::EverySync(2)).configure(Feedback::configuration(NODE));
    now(configuration.expect("valid").send_async(&mut drive)).expect("accepted");
    let sent: [bool; 4] = after_syncs(&mut drive, |drive, _| now(drive.sync_async()).expect("sent"));
    assert_eq!(sent, [false, true, false, true]);
}

const fn entry(index: u16, sub_index: u8, data_type: DataType, initial: &'static [u8]) -> Entry {
    Entry {
        object: Some(Object::new(index, sub_index)),
        initial: RawInitial::Bytes(initial),
        configured: None,
        ..entry::entry(index, data_type)
    }
}

/// Writes that a PDO struct of [`counting`] would return.
const COUNTING: [SdoWrite; 5] = [
    SdoWrite::new_u32(0x1800, 1, 0x8000_0185),
    SdoWrite::new_u8(0x1A00, 0, 0),
    SdoWrite::new_u32(0x1A00, 1, 0x2000_0010),
    SdoWrite::new_u8(0x1A00, 0, 1),
    SdoWrite::new_u32(0x1800, 1, 0x0000_0185),
];

/// Creates a node with a SYNC start value.
fn counting() -> Drive {
    let device = Device::new(&[
        entry(0x1800, 1, DataType::Unsigned32, &[0x85, 1, 0, 0x80]),
        entry(0x1800, 2, DataType::Unsigned8, &[255]),
        entry(0x1800, 6, DataType::Unsigned8, &[0]),
        entry(0x1A00, 0, DataType::Unsigned8, &[0]),
        entry(0x1A00, 1, DataType::Unsigned32, &[0, 0, 0, 0]),
        entry(0x2000, 0, DataType::Unsigned16, &[0, 0]),
    ]);
    let mut drive = Node::new(CanNode::new(device.with_node_id(NODE)), NODE);
    drive.nmt(NmtCommand::Start).expect("no error");
    drive
}

#[test]
fn the_sync_start_value_is_the_first_sync() {
    /// Sends SYNC messages with the counter values 1 to 4.
    fn counted(drive: &mut Drive, at: usize) {
        drive.sync_with_counter(at as u8 % 4 + 1).expect("sent");
    }
    let (yes, no) = (true, false);
    for (every, start, expected) in [
        (1, 3, [no, no, yes, yes, yes, yes, yes, yes]),
        (2, 3, [no, no, no, yes, no, yes, no, yes]),
        (4, 1, [no, no, no, yes, no, no, no, yes]),
        (4, 2, [no, no, no, no, yes, no, no, no]),
        (4, 0, [no, no, no, yes, no, no, no, yes]),
    ] {
        let mut drive = counting();
        let parameters = NEW.transmission(TransmissionType::EverySync(every)).sync_start(start);
        configure(&mut drive, parameters, COUNTING);
        assert_eq!(after_syncs(&mut drive, counted), expected, "every {every}, start {start}");
    }
    // SYNC messages without a counter: the start value has no effect.
    let mut drive = counting();
    configure(&mut drive, NEW.transmission(TransmissionType::EverySync(2)).sync_start(3), COUNTING);
    assert_eq!(after_syncs(&mut drive, |drive, _| drive.sync().expect("sent")), [no, yes, no, yes]);
    for counter in [0, 241] {
        assert!(matches!(drive.sync_with_counter(counter), Err(Error::OutOfRange(_))));
    }
    let refused = SdoWrite::new_u8(0x1800, 6, 1).send(&mut drive);
    assert_eq!(refused.map_err(Error::from), Err(Error::Abort(AbortCode::INVALID_VALUE)), "the PDO is enabled");
}
