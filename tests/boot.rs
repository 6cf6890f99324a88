//! Tests the boot of simulated nodes (CiA 302-2), blocking and asynchronous.

#[path = "support/entry.rs"]
mod entry;
#[path = "support/now.rs"]
mod now;

use std::cell::Cell;
use std::convert::Infallible;
use std::time::Duration;

use entry::entry;
use lexibus::clients::canopen::{
    AsyncCanPort, Boot, BootError, Booted, Buffered, CanFrame, CanPort, ErrorControl, GuardError, NmtCommand, NmtState,
    Node,
};
use lexibus::configuration::Phase;
use lexibus::sim::{CanNode, Device};
use lexibus::table::AccessRights;
use lexibus::{
    AbortCode, Configuration, DataType, Entry, Error, Identity, LengthError, NodeId, Object, SdoWrite, Setting,
    TextError, TimeOfDay,
};
use now::now;

const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};
const SECOND: Duration = Duration::from_secs(1);
const HEARTBEAT: Object = Object::new(0x1017, 0);
const SPEED: Object = Object::new(0x2000, 0);

const fn part(index: u16, sub_index: u8) -> Entry {
    Entry { object: Some(Object::new(index, sub_index)), ..entry(index, DataType::Unsigned32) }
}

const ENTRIES: &[Entry] = &[
    entry(0x1000, DataType::Unsigned32),
    entry(0x1009, DataType::VisibleString),
    entry(0x100A, DataType::VisibleString),
    part(0x1010, 1),
    entry(0x1017, DataType::Unsigned16),
    part(0x1018, 1),
    part(0x1018, 2),
    part(0x1018, 3),
    part(0x1018, 4),
    part(0x1020, 1),
    part(0x1020, 2),
    entry(0x2000, DataType::Unsigned16),
];

/// A node without the objects 0x1010, 0x1018:04 and 0x1020.
const SIMPLE: &[Entry] = &[
    entry(0x1000, DataType::Unsigned32),
    entry(0x100C, DataType::Unsigned16),
    entry(0x100D, DataType::Unsigned8),
    entry(0x1017, DataType::Unsigned16),
    part(0x1018, 1),
    entry(0x2000, DataType::Unsigned16),
];

const CONFIGURATION: Configuration = Configuration {
    communication: &[Setting::fixed(SdoWrite::new_u16(0x1017, 0, 100))],
    parameters: &[Setting::fixed(SdoWrite::new_u16(0x2000, 0, 1500))],
    ..Configuration::EMPTY
};

const DATE: TimeOfDay = TimeOfDay::new(3_600_000, 15_000);

const IDENTITY: Identity = Identity {
    vendor_id: Some(0x1234),
    product_code: Some(7),
    revision_number: Some(0x0001_0002),
    vendor_name: "",
    product_name: "",
    order_code: "",
};

/// A boot that checks all properties of the node and stores the configuration.
const BOOT: Boot = Boot::new(ErrorControl::Heartbeat(SECOND))
    .reset(SECOND)
    .device_type(0x0002_0192)
    .identity(&IDENTITY)
    .serial_number(99)
    .hardware_version("rev B")
    .software_version("1.4.2")
    .configuration(CONFIGURATION)
    .configuration_date(DATE)
    .store();

fn device(entries: &'static [Entry]) -> Device {
    let mut device = Device::new(entries).with_node_id(NODE);
    let mut set = |index, sub_index, value: &[u8]| {
        let object = Object::new(index, sub_index);
        if entries.iter().any(|entry| entry.object == Some(object)) {
            device.set_initial_bytes(object, value).expect("an object");
        }
    };
    set(0x1000, 0, &0x0002_0192_u32.to_le_bytes());
    set(0x1009, 0, b"rev B");
    // The software version is padded with zeros to a fixed length.
    set(0x100A, 0, b"1.4.2\0\0\0");
    for (sub_index, value) in [(1, 0x1234_u32), (2, 7), (3, 0x0001_0002), (4, 99)] {
        set(0x1018, sub_index, &value.to_le_bytes());
    }
    device
}

fn node() -> Node<CanNode> {
    Node::new(CanNode::new(device(ENTRIES)), NODE)
}

fn simple() -> Node<CanNode> {
    Node::new(CanNode::new(device(SIMPLE)), NODE)
}

fn boot<P>(node: &mut Node<P>, boot: &Boot, is_async: bool) -> Result<Booted, BootError<Infallible>>
where
    P: CanPort<Error = Infallible> + AsyncCanPort<Error = Infallible>,
{
    match is_async {
        true => now(node.boot_async(boot)),
        false => node.boot(boot),
    }
}

/// Boots two new nodes, one blocking and one asynchronously, and returns the error.
fn failed(new: impl Fn() -> Node<CanNode>, plan: &Boot) -> BootError<Infallible> {
    let [blocking, other] = [false, true].map(|is_async| {
        let mut node = new();
        let error = boot(&mut node, plan, is_async).expect_err("an error");
        let was_started = matches!(error, BootError::NotOperational { .. } | BootError::Guarding(_));
        assert_eq!(node.port().state() == NmtState::Operational, was_started);
        error
    });
    assert_eq!(blocking, other);
    blocking
}

fn bytes(node: &mut Node<CanNode>, object: Object) -> Vec<u8> {
    node.port().device().bytes(object).expect("an object").to_vec()
}

fn date(node: &mut Node<CanNode>) -> [Vec<u8>; 2] {
    [1, 2].map(|sub_index| bytes(node, Object::new(0x1020, sub_index)))
}

#[test]
fn a_node_is_configured_once() {
    for is_async in [false, true] {
        let mut node = node();
        let first = Booted { device_type: 0x0002_0192, is_configured: true, is_stored: true, was_operational: false };
        assert_eq!(boot(&mut node, &BOOT, is_async), Ok(first));
        assert_eq!(node.port().state(), NmtState::Operational);
        assert_eq!((bytes(&mut node, SPEED), bytes(&mut node, HEARTBEAT)), (vec![0xDC, 5], vec![100, 0]));
        assert_eq!(date(&mut node), [15_000_u32, 3_600_000].map(|part| part.to_le_bytes().to_vec()));

        // The node restarts, keeps its configuration and its date, and isn't configured again.
        node.port().device().set_bytes(SPEED, &[1, 0]).expect("an object");
        let again = Booted { is_configured: false, is_stored: false, ..first };
        assert_eq!(boot(&mut node, &BOOT, is_async), Ok(again));
        assert_eq!(bytes(&mut node, SPEED), [0xDC, 5]);

        // The node is configured again if the date differs. In this case, the date is one of the configured parameters.
        let date =
            [Setting::fixed(SdoWrite::new_u32(0x1020, 1, 15_001)), Setting::fixed(SdoWrite::new_u32(0x1020, 2, 0))];
        let parameters = Box::leak(Box::new([CONFIGURATION.parameters[0], date[0], date[1]]));
        let dated = Configuration { parameters, ..CONFIGURATION };
        let plan = Boot::new(ErrorControl::Heartbeat(SECOND)).configuration(dated);
        node.nmt(NmtCommand::EnterPreOperational).expect("a bus");
        assert_eq!(boot(&mut node, &plan.store(), is_async), Ok(first));
        assert_eq!(boot(&mut node, &plan.store(), is_async), Ok(again));
        assert_eq!(boot(&mut node, &plan.configuration_date(DATE), is_async), Ok(Booted { is_stored: false, ..first }));
    }
}

#[test]
fn without_store_the_date_is_not_written() {
    let plan = Boot::new(ErrorControl::Heartbeat(SECOND)).configuration(CONFIGURATION).configuration_date(DATE);
    for is_async in [false, true] {
        let mut node = node();
        let configured =
            Booted { device_type: 0x0002_0192, is_configured: true, is_stored: false, was_operational: false };
        for _ in 0..2 {
            assert_eq!(boot(&mut node, &plan, is_async), Ok(configured));
            assert_eq!(date(&mut node), [[0; 4]; 2]);
        }
        // A node without 0x1020, and a node whose configuration has no date, are configured at each boot.
        assert_eq!(boot(&mut simple(), &plan, is_async), Ok(configured));
        let without_date = plan.configuration_date(TimeOfDay::new(0, 0));
        assert_eq!(boot(&mut node, &without_date, is_async), Ok(configured));
        assert_eq!(boot(&mut node, &without_date.store(), is_async), Ok(Booted { is_stored: true, ..configured }));
        assert_eq!(date(&mut node), [[0; 4]; 2]);
    }
    let store = Object::new(0x1010, 1);
    let error = failed(simple, &plan.store());
    assert_eq!(error, BootError::Store { object: store, error: Error::Abort(AbortCode::NO_OBJECT) });
    assert_eq!(error.status(), Some('J'));
}

#[test]
fn a_node_that_fails_to_store_does_not_get_the_date() {
    const UNABLE: &[Entry] = &[
        entry(0x1000, DataType::Unsigned32),
        Entry { access: AccessRights::ReadOnly, ..part(0x1010, 1) },
        entry(0x1017, DataType::Unsigned16),
        part(0x1020, 1),
        part(0x1020, 2),
        entry(0x2000, DataType::Unsigned16),
    ];
    let unable = || Node::new(CanNode::new(device(UNABLE)), NODE);
    let plan = Boot::new(ErrorControl::None).configuration(CONFIGURATION).configuration_date(DATE).store();
    let error = failed(unable, &plan);
    assert!(matches!(error, BootError::Store { error: Error::Abort(AbortCode::READ_ONLY), .. }), "{error:?}");
    let mut node = unable();
    assert_eq!(node.boot(&plan), Err(error));
    assert_eq!(date(&mut node), [[0; 4]; 2]);
}

#[test]
fn wrong_devices() {
    let (expected, actual) = (1, 0x0002_0192);
    let text = |plan: &Boot| {
        let error = failed(node, plan);
        (error.status(), error.to_string())
    };
    assert_eq!(failed(node, &BOOT.device_type(1)), BootError::DeviceType { expected, actual });
    assert_eq!(failed(node, &BOOT.vendor_id(1)), BootError::VendorId { expected, actual: 0x1234 });
    assert_eq!(failed(node, &BOOT.product_code(1)), BootError::ProductCode { expected, actual: 7 });
    assert_eq!(failed(node, &BOOT.revision_number(1)), BootError::RevisionNumber { expected, actual: 0x0001_0002 });
    assert_eq!(failed(node, &BOOT.serial_number(1)), BootError::SerialNumber { expected, actual: 99 });
    for (plan, status, expected) in [
        (BOOT.device_type(1), 'C', "the device type (0x1000) is 0x00020192 instead of 0x00000001"),
        (BOOT.vendor_id(1), 'D', "the vendor-ID (0x1018:01) is 0x00001234 instead of 0x00000001"),
        (BOOT.product_code(1), 'M', "the product code (0x1018:02) is 0x00000007 instead of 0x00000001"),
        (BOOT.revision_number(1), 'N', "the revision number (0x1018:03) is 0x00010002 instead of 0x00000001"),
        (BOOT.serial_number(1), 'O', "the serial number (0x1018:04) is 0x00000063 instead of 0x00000001"),
        (BOOT.software_version("1.4"), 'H', r#"the software version (0x100A) is "1.4.2" instead of "1.4""#),
    ] {
        assert_eq!(text(&plan), (Some(status), expected.to_string()));
    }
    let hardware = r#"the hardware version (0x1009) is "rev B" instead of "rev A""#;
    assert_eq!(text(&BOOT.hardware_version("rev A")), (None, hardware.to_string()));
    // An expected value of 0 disables the comparison.
    assert!(node().boot(&BOOT.device_type(0).vendor_id(0).product_code(0).revision_number(0).serial_number(0)).is_ok());
}

#[test]
fn objects_that_cannot_be_read() {
    let plan = Boot::new(ErrorControl::None);
    let missing =
        |index, sub_index, code| BootError::Access { object: Object::new(index, sub_index), error: Error::Abort(code) };
    let error = failed(simple, &plan.serial_number(1));
    assert_eq!((error, error.status()), (missing(0x1018, 4, AbortCode::NO_SUB_INDEX), Some('O')));
    let error = failed(simple, &plan.software_version("1"));
    assert_eq!((error, error.status()), (missing(0x100A, 0, AbortCode::NO_OBJECT), Some('H')));
    let error = failed(simple, &plan.hardware_version("1"));
    assert_eq!((error, error.status()), (missing(0x1009, 0, AbortCode::NO_OBJECT), None));

    let version = |text: &'static [u8]| {
        failed(
            || {
                let mut node = node();
                node.port().device().set_initial_bytes(Object::new(0x1009, 0), text).expect("an object");
                node
            },
            &plan.hardware_version("1"),
        )
    };
    let object = Object::new(0x1009, 0);
    let long = Error::Length(LengthError::new(64, 65));
    assert_eq!(version(&[b'1'; 65]), BootError::Access { object, error: long });
    assert_eq!(version(&[0xFF]), BootError::Access { object, error: Error::Text(TextError) });
    assert!(matches!(version(&[b'1'; 64]), BootError::HardwareVersion { actual, .. } if actual.as_str().len() == 64));

    const SHORT: &[Entry] = &[entry(0x1000, DataType::Unsigned16)];
    let error = failed(|| Node::new(CanNode::new(Device::new(SHORT).with_node_id(NODE)), NODE), &plan);
    let length = Error::Length(LengthError::new(4, 2));
    assert_eq!(error, BootError::Access { object: Object::new(0x1000, 0), error: length });
}

#[test]
fn a_node_that_does_not_answer() {
    let silent = || {
        let mut node = node();
        node.port().set_connected(false);
        node
    };
    let error = failed(silent, &BOOT);
    assert_eq!((error, error.status()), (BootError::NoBootUp, None));
    let error = failed(silent, &Boot::new(ErrorControl::None));
    let object = Object::new(0x1000, 0);
    assert_eq!((error, error.status()), (BootError::Access { object, error: Error::Timeout }, Some('B')));
}

#[test]
fn a_configuration_that_the_node_refuses() {
    const REFUSED: SdoWrite = SdoWrite::new_u16(0x2001, 0, 1);
    const SETTINGS: &[Setting] = &[Setting::fixed(REFUSED)];
    let error = failed(node, &BOOT.configuration(Configuration { parameters: SETTINGS, ..CONFIGURATION }));
    let BootError::Configuration(cause) = error else { panic!("{error}") };
    assert_eq!((cause.phase, cause.write), (Phase::Parameters, REFUSED));
    assert_eq!((cause.error, error.status()), (Error::Abort(AbortCode::NO_OBJECT), Some('J')));
    assert!(error.to_string().starts_with("the configuration failed: 0x2001:00 = 0x0001 (parameters"), "{error}");
}

#[test]
fn no_heartbeat() {
    let error = failed(simple, &Boot::new(ErrorControl::Heartbeat(SECOND)));
    assert_eq!((error, error.status()), (BootError::NotOperational { actual: None }, Some('K')));
    assert_eq!(error.to_string(), "the node sent no heartbeat after its start");
    assert!(simple().boot(&Boot::new(ErrorControl::None)).is_ok());
}

#[test]
fn guarding() {
    let control = ErrorControl::Guarding { guard_time: Duration::from_millis(100), life_time_factor: 3 };
    for is_async in [false, true] {
        let mut node = simple();
        assert!(boot(&mut node, &Boot::new(control).reset(SECOND), is_async).is_ok());
        assert_eq!(node.port().state(), NmtState::Operational);
    }
    // A node with a heartbeat producer doesn't answer node guarding.
    const SLOW: &[Setting] = &[Setting::fixed(SdoWrite::new_u16(0x1017, 0, 60_000))];
    let error = failed(node, &Boot::new(control).configuration(Configuration { communication: SLOW, ..CONFIGURATION }));
    assert_eq!((error, error.status()), (BootError::Guarding(GuardError::NodeLost), Some('F')));
}

/// A node that doesn't receive the frames for which the function returns true.
struct Deaf<F>(CanNode, F);

impl<F: FnMut(&CanFrame) -> bool> CanPort for Deaf<F> {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        match (self.1)(frame) {
            true => Ok(true),
            false => CanPort::send(&mut self.0, frame, patience),
        }
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        CanPort::receive(&mut self.0, patience, wanted)
    }
}

impl<F: FnMut(&CanFrame) -> bool> AsyncCanPort for Deaf<F> {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        CanPort::receive(self, patience, wanted)
    }
}

/// Returns a node that ignores the NMT command "start".
fn stubborn(node: CanNode) -> Deaf<impl FnMut(&CanFrame) -> bool> {
    Deaf(node, |frame: &CanFrame| matches!(NmtCommand::of(frame), Some((NmtCommand::Start, _))))
}

/// Heartbeats from before the start don't confirm the start, even if they are still in the buffer of the interface.
#[test]
fn a_node_that_does_not_start() {
    let guarding = ErrorControl::Guarding { guard_time: Duration::from_millis(100), life_time_factor: 1 };
    for is_async in [false, true] {
        let mut started = CanNode::new(device(ENTRIES));
        started.device().set_bytes(HEARTBEAT, &[100, 0]).expect("an object");
        started.handle(&NmtCommand::Start.frame(None));
        started.advance(SECOND);
        started.handle(&NmtCommand::EnterPreOperational.frame(None));
        let mut node = Node::new(Buffered::<_, 32>::new(stubborn(started)), NODE);
        let error = boot(&mut node, &Boot::new(ErrorControl::Heartbeat(SECOND)), is_async).expect_err("not started");
        assert_eq!(error, BootError::NotOperational { actual: Some(NmtState::PreOperational) });
        assert_eq!(error.to_string(), "the node is in PreOperational after its start");

        let mut node = Node::new(Buffered::<_, 32>::new(stubborn(CanNode::new(device(SIMPLE)))), NODE);
        let error = boot(&mut node, &Boot::new(guarding), is_async).expect_err("not started");
        assert_eq!(error, BootError::NotOperational { actual: Some(NmtState::PreOperational) });
    }
}

#[test]
fn a_running_node_keeps_running() {
    let plan = BOOT.keep_running();
    for is_async in [false, true] {
        let mut node = node();
        // The node has no heartbeat before its first configuration. Without a restart, its state is unknown.
        let silent = boot(&mut node, &Boot::new(ErrorControl::Heartbeat(SECOND)).keep_running(), is_async);
        assert_eq!(silent, Err(BootError::NoHeartbeat));
        assert_eq!(silent.map_err(|error| error.status()), Err(Some('E')));
        assert_eq!(node.port().state(), NmtState::PreOperational);
        // A node without a heartbeat is restarted and booted.
        let restarted = boot(&mut node, &plan, is_async).expect("a node without a heartbeat is restarted");
        assert_eq!((restarted.is_configured, restarted.was_operational), (true, false));
        assert_eq!(node.port().state(), NmtState::Operational);
        let mut node = self::node();
        node.port().device().set_initial_bytes(HEARTBEAT, &100_u16.to_le_bytes()).expect("an object");
        node.nmt(NmtCommand::ResetNode).expect("a bus");
        let first = boot(&mut node, &plan, is_async).expect("a node in Pre-operational is booted");
        assert_eq!((first.is_configured, first.was_operational, first.status()), (true, false, None));
        // A restart would reset this value.
        node.port().device().set_bytes(SPEED, &77_u16.to_le_bytes()).expect("an object");
        let again = boot(&mut node, &plan, is_async).expect("a running node");
        let expected =
            Booted { device_type: 0x0002_0192, is_configured: false, is_stored: false, was_operational: true };
        assert_eq!((again, again.status()), (expected, Some('L')));
        assert_eq!((bytes(&mut node, SPEED), node.port().state()), (vec![77, 0], NmtState::Operational));
        // A wrong device is reported as an error, but isn't stopped.
        let other = boot(&mut node, &plan.serial_number(1), is_async);
        assert_eq!(other, Err(BootError::SerialNumber { expected: 1, actual: 99 }));
        assert_eq!(node.port().state(), NmtState::Operational);
    }
}

/// A node in Stopped doesn't answer SDO requests.
#[test]
fn a_stopped_node_is_restarted() {
    let guarding = ErrorControl::Guarding { guard_time: Duration::from_millis(100), life_time_factor: 3 };
    for is_async in [false, true] {
        for control in [ErrorControl::Heartbeat(SECOND), ErrorControl::None, guarding] {
            let plan = Boot::new(control).keep_running();
            let mut node = simple();
            if control != guarding {
                node.port().device().set_initial_bytes(HEARTBEAT, &100_u16.to_le_bytes()).expect("an object");
            }
            node.nmt(NmtCommand::ResetNode).expect("a bus");
            node.nmt(NmtCommand::Stop).expect("a bus");
            let error = boot(&mut node, &plan, is_async).expect_err("no restart");
            assert_eq!(error, BootError::Access { object: Object::new(0x1000, 0), error: Error::Timeout });
            let booted = boot(&mut node, &plan.reset(SECOND), is_async).expect("a restart");
            assert_eq!((booted.was_operational, node.port().state()), (false, NmtState::Operational), "{control:?}");
        }
    }
}

#[test]
fn a_lost_guarding_request() {
    for (is_async, life_time_factor) in [(false, 1), (true, 1), (false, 3), (true, 3)] {
        let plan = Boot::new(ErrorControl::Guarding { guard_time: Duration::from_millis(100), life_time_factor });
        let mut running = CanNode::new(device(SIMPLE));
        running.handle(&NmtCommand::Start.frame(None));
        // Number of guarding requests that will be lost.
        let lost = Cell::new(1);
        let is_lost = |frame: &CanFrame| {
            let is_lost = frame.is_remote() && lost.get() > 0;
            lost.set(lost.get() - u32::from(is_lost));
            is_lost
        };
        let mut node = Node::new(Deaf(running, is_lost), NODE);
        let booted = boot(&mut node, &plan.keep_running(), is_async).expect("a running node");
        assert!(booted.was_operational);
        // If a node never answers, the boot fails with `NodeLost`, or restarts the node if the plan has a reset.
        lost.set(1000);
        let failed = boot(&mut node, &plan.keep_running(), is_async);
        assert_eq!(failed, Err(BootError::Guarding(GuardError::NodeLost)));
        assert_eq!(node.port().0.state(), NmtState::Operational);
        let failed = boot(&mut node, &plan.keep_running().device_type(1).reset(SECOND), is_async);
        assert_eq!(failed, Err(BootError::DeviceType { expected: 1, actual: 0x0002_0192 }));
        assert_eq!(node.port().0.state(), NmtState::PreOperational, "the node was restarted");
    }
}

#[test]
fn a_running_node_with_guarding() {
    let control = ErrorControl::Guarding { guard_time: Duration::from_millis(100), life_time_factor: 3 };
    for is_async in [false, true] {
        let mut node = simple();
        let plan = Boot::new(control).keep_running();
        let first = boot(&mut node, &plan, is_async).expect("a node");
        let again = boot(&mut node, &plan, is_async).expect("a node");
        assert_eq!((first.was_operational, again.was_operational), (false, true));
        // Without error control, the state of the node is unknown, so the node is booted again.
        let blind = boot(&mut node, &Boot::new(ErrorControl::None).keep_running(), is_async).expect("a node");
        assert!(!blind.was_operational);
    }
}
