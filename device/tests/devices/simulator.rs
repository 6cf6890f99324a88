//! The functions of the crate with simulated devices.

use crate::support::{described, dictionary};
use lexibus::sim::{CanFault, CanNode, Device, FaultyCan};
use lexibus::{AbortCode, CanOpen, Modbus, NodeId, Object};
use lexibus_device::backup::{backup, difference, Backup, Options};
use lexibus_device::restore::{Outcome, Plan, Status};
use lexibus_device::verify::{verify, FindingKind, Options as VerifyOptions};
use lexibus_device::{
    Address, CanOpenConnection, Connection, Description, Failure, ModbusConnection, Network, Protection, Write,
};
use lexibus_drives::{demo_drive, vector_step};

const NODE: u8 = 5;

fn drive() -> Device {
    Device::new(demo_drive::ENTRIES).with_node_id(NodeId::new(NODE).expect("a node-ID"))
}

fn drive_description() -> Description {
    dictionary("demo-drive.eds", Network::CanOpen)
}

fn options() -> Options {
    Options { node_id: Some(NODE), ..Options::default() }
}

fn save(description: &Description, connection: &mut impl Connection) -> Backup {
    backup(description, connection, &options()).expect("a backup")
}

/// Tries to write another valid value to each unprotected parameter of the backup. Returns how many parameters accepted one.
fn change_all(description: &Description, saved: &Backup, connection: &mut impl Connection) -> usize {
    let parameters = saved.entries.iter().filter_map(|entry| description.at(entry.address));
    let restored = parameters.filter(|parameter| parameter.protection().is_none());
    restored.filter(|parameter| crate::support::change(parameter, NODE, connection)).count()
}

fn restore<'d>(description: &'d Description, saved: &Backup, connection: &mut impl Connection) -> Outcome<'d> {
    let plan = Plan::new(description, saved, Some(NODE), &[]);
    assert!(plan.refused.iter().all(|refused| !refused.is_failure), "{:?}", plan.refused);
    plan.execute(connection, &mut |_| true)
}

#[test]
fn a_device_that_matches_its_description_has_no_deviations() {
    let (description, mut device) = (drive_description(), drive());
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let report = verify(&description, &mut connection, &VerifyOptions { node_id: Some(NODE), ..Default::default() });
    let report = report.expect("a report");
    assert_eq!(report.deviations().map(ToString::to_string).collect::<Vec<_>>(), [""; 0]);
    assert!(report.read > 50 && report.unverified_writes > 20, "{}", report.text(true));
    assert_eq!(report.overlay(), None);
}

#[test]
fn a_restore_returns_a_changed_device_to_its_backup() {
    let (description, mut device) = (drive_description(), drive());
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let saved = save(&description, &mut connection);
    assert!(saved.is_complete() && saved.entries.len() > 20, "{:?}", saved.skipped);
    let changed = change_all(&description, &saved, &mut connection);
    let after = save(&description, &mut connection);
    assert!(changed > 10, "{changed} values");
    assert!(difference(&description, &saved, &after).len() >= changed, "{changed}");
    let outcome = restore(&description, &saved, &mut connection);
    assert!(outcome.is_complete(), "{outcome}");
    let again = save(&description, &mut connection);
    assert_eq!(difference(&description, &saved, &again), []);
    assert_eq!(again, saved);
}

#[test]
fn both_formats_contain_the_whole_backup() {
    let (description, mut device) = (drive_description(), drive());
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let saved = save(&description, &mut connection);
    let toml = saved.toml(&description);
    let read = Backup::from_toml(&toml, &description).unwrap_or_else(|error| panic!("{error}\n{toml}"));
    assert_eq!(read, Backup { skipped: Vec::new(), ..saved.clone() });
    let dcf = saved.dcf(&description).expect("a DCF");
    assert_eq!(dcf.lost, []);
    let read = Backup::of_description(&described("backup.dcf", &dcf.text, Network::CanOpen));
    assert_eq!(read, Backup { skipped: Vec::new(), ..saved });
    // The COB-ID of TPDO 1 is relative to the node-ID, so the backup fits any node-ID.
    assert!(toml.contains("address = \"0x1800:01\"") && toml.contains("\"$NODEID+0x180\""), "{toml}");
    assert!(dcf.text.contains("ParameterValue=$NODEID+0x180"));
}

#[test]
fn a_backup_can_be_restored_to_another_node_id() {
    let (description, mut device) = (drive_description(), drive());
    let saved = save(&description, &mut CanOpenConnection::new(device.client::<CanOpen>()));
    let mut other = drive().with_node_id(NodeId::new(9).expect("a node-ID"));
    let mut connection = CanOpenConnection::new(other.client::<CanOpen>());
    let outcome = Plan::new(&description, &saved, Some(9), &[]).execute(&mut connection, &mut |_| true);
    assert!(outcome.is_complete(), "{outcome}");
    let cob_id = connection.read(Address::Object(Object::new(0x1800, 1)), 4).expect("a COB-ID");
    assert_eq!(u32::from_le_bytes(cob_id.try_into().expect("four bytes")) & 0x7FF, 0x189);
}

#[test]
fn protected_parameters_are_restored_only_if_they_are_named() {
    let description = drive_description();
    let controlword = description.find("Controlword").expect("a parameter");
    assert_eq!(controlword.protection(), Some(Protection::Control));
    let saved = Backup {
        entries: ["Controlword", "Modes of operation", "Target position", "Profile velocity"]
            .map(|name| {
                let mut backup = Backup::default();
                let parameter = description.find(name).expect("a parameter");
                backup.entries = Backup::from_toml(
                    &format!("lexibus-backup = 1\nparameters = [{{ name = \"{}\", value = 1 }}]", parameter.path()),
                    &description,
                )
                .expect("a backup")
                .entries;
                backup.entries.remove(0)
            })
            .to_vec(),
        ..Backup::default()
    };
    let plan = Plan::new(&description, &saved, Some(NODE), &[]);
    assert_eq!(plan.writes.iter().map(ToString::to_string).collect::<Vec<_>>(), ["0x6081:00 Profile velocity = 1"]);
    assert_eq!(plan.refused.len(), 3, "{plan}");
    let plan = Plan::new(&description, &saved, Some(NODE), &[controlword.address()]);
    assert_eq!((plan.writes.len(), plan.refused.len()), (2, 2), "{plan}");
}

#[test]
fn modbus_parameters_are_saved_and_restored() {
    let description = dictionary("aec-vector-step.toml", Network::Modbus);
    // Some values of the drive are longer than the maximum length of a request in the Modbus specification.
    let mut device = Device::new(vector_step::ENTRIES).with_modbus_limits(60_000, 60_000);
    let mut connection = ModbusConnection::new(device.client::<Modbus>());
    let saved = save(&description, &mut connection);
    assert!(saved.is_complete(), "{:?}", saved.skipped.iter().find(|skipped| skipped.is_failure));
    let changed = change_all(&description, &saved, &mut connection);
    assert!(changed > 50, "{changed} of {} values", saved.entries.len());
    let read = Backup::from_toml(&saved.toml(&description), &description).expect("a backup");
    let outcome = restore(&description, &read, &mut connection);
    assert!(outcome.is_complete(), "{outcome}");
    assert_eq!(difference(&description, &saved, &save(&description, &mut connection)), []);
}

#[test]
fn an_interrupted_restore_reports_what_was_written() {
    let (description, mut device) = (drive_description(), drive());
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let saved = save(&description, &mut connection);
    let plan = Plan::new(&description, &saved, Some(NODE), &[]);
    let mut left = 7;
    let outcome = plan.execute(&mut connection, &mut |_| {
        left -= 1;
        left >= 0
    });
    assert_eq!((outcome.written(), outcome.is_complete()), (7, false));
    assert!(outcome.states[7..].iter().all(|(_, status)| *status == Status::NotWritten), "{outcome}");
}

#[test]
fn a_refused_value_is_reported_and_the_others_are_written() {
    let (description, mut device) = (drive_description(), drive());
    device.on_write(demo_drive::objects::PROFILE_ACCELERATION, |_, _| Err(AbortCode::DEVICE_STATE)).expect("an object");
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let saved = save(&description, &mut connection);
    let outcome = restore(&description, &saved, &mut connection);
    let refused: Vec<_> = outcome.states.iter().filter(|(_, status)| *status != Status::Written).collect();
    assert_eq!(refused.len(), 1, "{outcome}");
    assert!(outcome.to_string().contains("Profile acceleration"), "{outcome}");
    assert!(outcome.to_string().contains("0x08000022"), "{outcome}");
}

#[test]
fn a_device_that_keeps_another_value_is_reported() {
    let (description, mut device) = (drive_description(), drive());
    device
        .on_write(demo_drive::objects::PROFILE_VELOCITY, |device, _| {
            device.set(demo_drive::objects::PROFILE_VELOCITY, 4)
        })
        .expect("an object");
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let saved = save(&description, &mut connection);
    let outcome = restore(&description, &saved, &mut connection);
    assert_eq!(outcome.mismatches.len(), 1, "{outcome}");
    assert!(outcome.to_string().contains("written, but reading it back returned: 4"), "{outcome}");
}

#[test]
fn writes_are_checked_before_anything_is_sent() {
    let (description, mut device) = (drive_description(), drive());
    let refused = |name: &str, text: &str| {
        let parameter = description.find(name).expect("a parameter");
        Write::parse(parameter, text, Some(NODE)).expect_err("no write").to_string()
    };
    assert_eq!(refused("Statusword", "1"), "the parameter is read-only");
    assert!(refused("Profile velocity", "600000").contains("above the maximum"));
    assert!(refused("Profile velocity", "fast").contains("not a value of the type"));
    let unknown = description.find("Profile velocty").expect_err("no parameter").to_string();
    assert!(unknown.contains("did you mean `Profile velocity`?"), "{unknown}");
    let several = description.find("Highest sub-index supported").expect_err("several").to_string();
    assert!(several.contains("0x1018:00"), "{several}");
    let missing = Address::Object(Object::new(0x7777, 0));
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    assert_eq!(connection.read(missing, 4), Err(Failure::Abort(AbortCode::NO_OBJECT)));
}

/// Faults that a client can meet on the bus.
fn faults() -> [CanFault; 10] {
    use std::time::Duration;
    let foreign = lexibus::clients::canopen::CanFrame::new(0x585, &[0x80, 0, 0, 0, 0, 0, 0, 8]).expect("a frame");
    [
        CanFault::Lost,
        CanFault::Duplicated,
        CanFault::Noise(100),
        CanFault::WrongToggle,
        CanFault::Late(Duration::from_millis(800)),
        CanFault::Truncated,
        CanFault::Foreign { frame: foreign, count: 1, period: Duration::from_millis(1) },
        CanFault::Restart,
        CanFault::BusOff,
        CanFault::ErrorFrame,
    ]
}

fn faulty(fault: CanFault, n: u64) -> CanOpenConnection<lexibus::clients::canopen::Node<FaultyCan<CanNode>>> {
    let id = NodeId::new(NODE).expect("a node-ID");
    let mut can = FaultyCan::new(CanNode::new(drive()));
    can.inject_nth(fault, n);
    CanOpenConnection::new(lexibus::clients::canopen::Node::new(can, id))
}

#[test]
fn a_backup_over_a_faulty_bus_is_right_or_fails() {
    let description = drive_description();
    let mut device = drive();
    let expected = save(&description, &mut CanOpenConnection::new(device.client::<CanOpen>()));
    let mut complete = 0;
    for fault in faults() {
        for n in [1, 2, 5, 20, 33] {
            let mut connection = faulty(fault, n);
            match backup(&description, &mut connection, &options()) {
                Ok(found) if found.is_complete() => {
                    assert_eq!(found.entries, expected.entries, "{fault:?} {n}");
                    complete += 1;
                }
                Ok(found) => {
                    let differences = difference(&description, &expected, &found);
                    assert!(differences.iter().all(|difference| difference.new.is_none()), "{fault:?} {differences:?}");
                }
                Err(_) => {}
            }
        }
    }
    assert!(complete >= 10, "{complete} backups were complete");
}

/// Under each fault, the report of a restore must agree with the values that the device has afterwards.
#[test]
fn a_restore_over_a_faulty_bus_reports_every_value() {
    let description = drive_description();
    let mut device = drive();
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let default = save(&description, &mut connection);
    change_all(&description, &default, &mut connection);
    let target = save(&description, &mut connection);
    let plan = Plan::new(&description, &target, Some(NODE), &[]);
    let (mut complete, mut failed) = (0, 0);
    for fault in faults() {
        for n in [1, 2, 7, 20, 40, 60] {
            let mut connection = faulty(fault, n);
            let outcome = plan.execute(&mut connection, &mut |_| true);
            let device = connection.client().port().bus().device();
            let text = format!("{fault:?} {n}\n{outcome}");
            check_states(&outcome, device, &text);
            if outcome.is_complete() {
                complete += 1;
            } else {
                failed += 1;
            }
        }
    }
    assert!(complete > 0 && failed > 20, "{complete} complete, {failed} failed");
}

/// Checks that the reported states agree with the values of the device.
fn check_states(outcome: &Outcome<'_>, device: &Device, text: &str) {
    let last = |address: Address| {
        let mut same = outcome.states.iter().filter(|(write, _)| write.parameter().address() == address);
        same.rfind(|(_, status)| *status == Status::Written).map(|(write, _)| write.bytes().to_vec())
    };
    let is_reported = |address: Address| {
        let is_open = |status: &Status| !matches!(status, Status::Written);
        outcome.states.iter().any(|(write, status)| write.parameter().address() == address && is_open(status))
            || outcome.mismatches.iter().any(|(write, _)| write.parameter().address() == address)
    };
    for (write, _) in &outcome.states {
        let address = write.parameter().address();
        let Address::Object(object) = address else { unreachable!("CANopen") };
        let held = device.bytes(object).expect("an object").to_vec();
        let is_right = last(address).is_none_or(|expected| expected == held);
        assert!(is_right || is_reported(address), "{write}: {held:?}\n{text}");
    }
}

#[test]
fn deviations_of_a_simulated_device_are_found() {
    let description = drive_description();
    let entries: Vec<lexibus::Entry> =
        demo_drive::ENTRIES.iter().filter(|entry| entry.object != Some(Object::new(0x6081, 0))).copied().collect();
    let mut device = Device::new(&entries);
    let mut connection = CanOpenConnection::new(device.client::<CanOpen>());
    let report = verify(&description, &mut connection, &VerifyOptions::default()).expect("a report");
    let kinds: Vec<_> = report.deviations().map(|finding| (finding.kind, finding.address.as_str())).collect();
    assert_eq!(kinds, [(FindingKind::Missing, "0x6081:00")], "{}", report.text(false));
    assert!(report.html().contains("0x6081:00") && report.json().contains("\"missing\""));
    let overlay = report.overlay().expect("an overlay");
    assert!(overlay.contains("0x6081 = { remove = true }"), "{overlay}");
}

#[test]
fn values_of_other_tools_without_a_place_are_left_out() {
    let (description, mut device) = (drive_description(), drive());
    let text = "lexibus-backup = 1\nparameters = [{ address = \"0x1000:00\", value = 1 }, \
        { address = \"0x1801:01\", value = \"$NODEID+0x280\" }, { address = \"0x1A01:00\", value = 1 }, \
        { address = \"0x1A01:01\", value = 0x60410010 }, { address = \"0x1A01:02\", value = 0 }]";
    let saved = Backup::from_toml(text, &description).expect("a backup");
    let plan = Plan::new(&description, &saved, Some(NODE), &[]);
    let refused: Vec<String> = plan.refused.iter().map(ToString::to_string).collect();
    assert_eq!(refused.len(), 2, "{plan}");
    assert!(refused[0].ends_with("the parameter is read-only"), "{plan}");
    assert!(refused[1].ends_with("the sub-index is above the number of mapped objects"), "{plan}");
    assert!(plan.refused.iter().all(|refused| !refused.is_failure));
    let outcome = plan.execute(&mut CanOpenConnection::new(device.client::<CanOpen>()), &mut |_| true);
    assert!(outcome.is_complete(), "{outcome}");
}

/// A connection on which one access fails. `left` is initially the number of this access, counted from 1. With
/// [`AccessFault::Broken`], all later accesses fail, too.
struct Faulty<C> {
    inner: C,
    fault: AccessFault,
    left: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum AccessFault {
    /// The request is lost. The device doesn't execute it.
    LostRequest,
    /// The reply is lost. The device executes the request.
    LostReply,
    /// The device refuses the request.
    Exception,
    /// The interface fails, also in all later accesses.
    Broken,
}

impl<C: Connection> Faulty<C> {
    fn access<T>(&mut self, access: impl FnOnce(&mut C) -> Result<T, Failure>) -> Result<T, Failure> {
        self.left = self.left.saturating_sub(usize::from(self.left > 0 && self.left != usize::MAX));
        match self.fault {
            _ if self.left > 0 => access(&mut self.inner),
            AccessFault::Broken => Err(Failure::Bus("the interface failed".to_owned())),
            fault => {
                self.left = usize::MAX;
                match fault {
                    AccessFault::Exception => Err(Failure::Exception(4)),
                    AccessFault::LostReply => access(&mut self.inner).and(Err(Failure::Timeout)),
                    _ => Err(Failure::Timeout),
                }
            }
        }
    }
}

impl<C: Connection> Connection for Faulty<C> {
    fn network(&self) -> Network {
        self.inner.network()
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        self.access(|inner| inner.read(address, length))
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        self.access(|inner| inner.write(address, data))
    }
}

/// Under each fault of a Modbus access, the report of a restore must agree with the registers of the device.
#[test]
fn a_restore_over_a_faulty_modbus_line_reports_every_value() {
    let description = dictionary("aec-vector-step.toml", Network::Modbus);
    let mut device = Device::new(vector_step::ENTRIES).with_modbus_limits(60_000, 60_000);
    let mut connection = ModbusConnection::new(device.client::<Modbus>());
    let default = save(&description, &mut connection);
    change_all(&description, &default, &mut connection);
    let target = save(&description, &mut connection);
    let plan = Plan::new(&description, &target, Some(NODE), &[]);
    let mut incomplete = 0;
    for fault in [AccessFault::LostRequest, AccessFault::LostReply, AccessFault::Exception, AccessFault::Broken] {
        for n in [1, 2, 17, plan.writes.len() / 2, plan.writes.len()] {
            let mut device = Device::new(vector_step::ENTRIES).with_modbus_limits(60_000, 60_000);
            let inner = ModbusConnection::new(device.client::<Modbus>());
            let mut connection = Faulty { inner, fault, left: n };
            let outcome = plan.execute(&mut connection, &mut |_| true);
            incomplete += usize::from(!outcome.is_complete());
            for (write, status) in &outcome.states {
                let held = connection.inner.read(write.parameter().address(), write.bytes().len()).expect("a value");
                let is_right = *status != Status::Written || held == write.bytes();
                assert!(is_right, "{fault:?} {n}: {write}: {held:?}\n{outcome}");
            }
        }
    }
    assert_eq!(incomplete, 20, "each restore with a fault is reported as incomplete");
}

#[test]
fn an_object_of_another_axis_is_not_unknown() {
    let stepper = dictionary("aec-vector-step.toml", Network::CanOpen);
    let found =
        |address: &str| stepper.find(address).map(|parameter| parameter.to_string()).map_err(|error| error.to_string());
    let first = found("0x6081").expect("an object of the first axis");
    let message = |address: &str, axis: u8| {
        format!(
            "`{address}` is an object of axis {axis}, but only objects of the first axis can be accessed, here {first}"
        )
    };
    assert_eq!(found("0x6881"), Err(message("0x6881", 2)));
    assert_eq!(found("0x7081"), Err(message("0x7081", 3)));
    assert_eq!(found("0x7881"), Err("the description has no parameter `0x7881`".to_owned()));
}

#[test]
fn the_identity_is_unverifiable_on_modbus() {
    let description = dictionary("aec-vector-step.toml", Network::Modbus);
    let mut device = Device::new(vector_step::ENTRIES);
    let mut connection = ModbusConnection::new(device.client::<Modbus>());
    let report = verify(&description, &mut connection, &VerifyOptions::default()).expect("a report");
    let identity = report.findings.iter().find(|finding| finding.address == "identity").expect("a finding");
    assert_eq!((identity.kind.name(), identity.kind.is_deviation()), ("unverifiable", false));
    let parameters = report.findings.iter().filter(|finding| finding.kind == identity.kind).count() - 1;
    assert!(report.text(false).contains(&format!("unverifiable: {parameters} parameters")), "{}", report.text(false));
}
