//! Restrictions on reads and writes: ObjFlags, conditions, commands, outputs, node-ID and bit rate.

use std::collections::BTreeMap;

use crate::support::{described, dictionary};
use lexibus_device::backup::{backup, Backup, Options};
use lexibus_device::restore::{Plan, Status};
use lexibus_device::verify::{verify, FindingKind, Options as VerifyOptions};
use lexibus_device::{Address, Connection, Description, Failure, Network, Protection, ReadRefusal, Write, WriteError};

const EDS: &str = "[FileInfo]\nFileName=flags.eds\nEDSVersion=4.0\n[DeviceInfo]\nVendorName=Example\nVendorNumber=1\n\
    ProductName=Flags\nProductNumber=2\nRevisionNumber=0\nNrOfRXPDO=0\nNrOfTXPDO=0\n\
    [OptionalObjects]\nSupportedObjects=2\n1=0x1F50\n2=0x1F51\n\
    [1F50]\nParameterName=Program data\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n\
    [1F51]\nParameterName=Program control\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n\
    [ManufacturerObjects]\nSupportedObjects=6\n1=0x2000\n2=0x2001\n3=0x2002\n4=0x2003\n5=0x2004\n6=0x2005\n\
    [2000]\nParameterName=Plain\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n\
    [2001]\nParameterName=No download\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\nObjFlags=1\n\
    [2002]\nParameterName=No scan\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\nObjFlags=2\n\
    [2003]\nParameterName=Node-ID\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n\
    [2004]\nParameterName=CAN baud rate\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n\
    [2005]\nParameterName=Output\nObjectType=0x7\nDataType=0x0005\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n";

const TABLE: &str = r#"
lexibus = 1
[device]
name = "Valve"
buses = ["modbus"]
[spaces.register]
modbus = { table = "holding", first = 0 }
[[chapters]]
title = "Values"
defaults = { access = "rw" }
[chapters.registers]
Plain = { reg = 0, type = "u16" }
Mode = { reg = 1, type = "u16", enum = "Mode" }
Gain = { reg = 2, type = "u16", when = { Mode = [1] } }
Start = { reg = 3, type = "u16", clears = true }
Serial = { reg = 4, type = "u16", once = true }
Zero = { reg = 5, type = "u16", effects = "Sets the position to zero" }
Saved = { reg = 6, type = "u16", save = "Save" }
Save = { reg = 7, type = "u16" }
Live = { reg = 8, type = "u16", save = false }
Slave_address = { reg = 9, type = "u16" }
Closed = { reg = 10, type = "u16", writable = [0, 4] }
[enums.Mode.values]
0 = "manual"
1 = "automatic"
"#;

/// A device with registers or objects that records all reads and writes.
#[derive(Default)]
struct Recorder {
    is_canopen: bool,
    values: BTreeMap<Address, Vec<u8>>,
    reads: Vec<Address>,
    writes: Vec<Address>,
}

impl Connection for Recorder {
    fn network(&self) -> Network {
        if self.is_canopen {
            Network::CanOpen
        } else {
            Network::Modbus
        }
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        self.reads.push(address);
        let length = if length == 0 { 1 } else { length };
        Ok(self.values.get(&address).cloned().unwrap_or_else(|| vec![0; length]))
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        self.writes.push(address);
        self.values.insert(address, data.to_vec());
        Ok(())
    }
}

fn flags() -> Description {
    described("flags.eds", EDS, Network::CanOpen)
}

fn valve() -> Description {
    described("valve.toml", TABLE, Network::Modbus)
}

fn protections(description: &Description) -> Vec<(String, Option<Protection>)> {
    let parameters = description.parameters().filter(|parameter| parameter.access().writable());
    parameters.map(|parameter| (parameter.name(), parameter.protection())).collect()
}

#[test]
fn objects_are_protected_by_their_facts() {
    let expected = [
        ("Program data", Some(Protection::Command)),
        ("Program control", Some(Protection::Command)),
        ("Plain", None),
        ("No download", Some(Protection::RefusesDownload)),
        ("No scan", None),
        ("Node-ID", Some(Protection::NodeId)),
        ("CAN baud rate", Some(Protection::BitRate)),
        ("Output", Some(Protection::Output)),
    ];
    assert_eq!(protections(&flags()), expected.map(|(name, protection)| (name.to_owned(), protection)));
    let description = flags();
    let refusal = |name: &str| description.find(name).expect("a parameter").read_refusal();
    assert_eq!((refusal("No scan"), refusal("Plain")), (Some(ReadRefusal::RefusesScan), None));
}

#[test]
fn registers_are_protected_by_their_facts() {
    let expected = [
        ("Plain", None),
        ("Mode", None),
        ("Gain", None),
        ("Start", Some(Protection::Command)),
        ("Serial", Some(Protection::WriteOnce)),
        ("Zero", Some(Protection::SideEffect)),
        ("Saved", None),
        ("Save", Some(Protection::Command)),
        ("Live", None),
        ("Slave_address", Some(Protection::NodeId)),
        ("Closed", None),
    ];
    assert_eq!(protections(&valve()), expected.map(|(name, protection)| (name.to_owned(), protection)));
}

#[test]
fn a_drive_keeps_its_commands_modes_targets_and_identity_on_the_bus() {
    let description = dictionary("aec-vector-step.toml", Network::CanOpen);
    let protection = |name: &str| description.find(name).unwrap_or_else(|error| panic!("{error}")).protection();
    for index in ["0x6040", "0x6060", "0x607A"] {
        assert_eq!(protection(index), Some(Protection::Control), "{index}");
    }
    assert_eq!(protection("Rcanbaud"), Some(Protection::BitRate));
}

/// Returns the names of the parameters at these addresses.
fn names(description: &Description, addresses: &[Address]) -> Vec<String> {
    addresses.iter().filter_map(|address| description.at(*address)).map(|parameter| parameter.name()).collect()
}

#[test]
fn no_command_reads_parameters_that_refuse_it() {
    let description = flags();
    let mut device = Recorder { is_canopen: true, ..Recorder::default() };
    let report = verify(&description, &mut device, &VerifyOptions::default()).expect("a report");
    assert!(!names(&description, &device.reads).contains(&"No scan".to_owned()));
    let unverifiable = report.findings.iter().filter(|finding| finding.kind == FindingKind::Unverifiable);
    assert_eq!(unverifiable.map(|finding| finding.name.as_str()).collect::<Vec<_>>(), ["No scan"]);
    assert_eq!(device.writes, []);

    let mut device = Recorder { is_canopen: true, ..Recorder::default() };
    backup(&description, &mut device, &Options::default()).expect("a backup");
    assert!(!names(&description, &device.reads).contains(&"No scan".to_owned()));
    assert_eq!(device.writes, []);

    let description = valve();
    let mut device = Recorder::default();
    let report = verify(&description, &mut device, &VerifyOptions::default()).expect("a report");
    assert!(!names(&description, &device.reads).contains(&"Start".to_owned()), "{}", report.text(true));
    assert_eq!(device.writes, []);
}

#[test]
fn a_backup_leaves_out_volatile_values_and_commands() {
    let description = valve();
    let saved = backup(&description, &mut Recorder::default(), &Options::default()).expect("a backup");
    let saved_names: Vec<&str> = saved.entries.iter().map(|entry| entry.name.as_str()).collect();
    let expected = ["Plain", "Mode", "Gain", "Serial", "Zero", "Saved", "Slave_address", "Closed"];
    assert_eq!(saved_names, expected.map(|name| format!("Values/{name}")));
    let live = description.find("Live").expect("a parameter").address();
    let options = Options { include: vec![live], ..Options::default() };
    let saved = backup(&description, &mut Recorder::default(), &options).expect("a backup");
    assert!(saved.entries.iter().any(|entry| entry.name == "Values/Live"));
}

#[test]
fn a_restore_writes_only_values_that_are_listed_and_unprotected() {
    let description = flags();
    let text = "lexibus-backup = 1\nparameters = [\n\
        { name = \"Program control\", value = 1 },\n{ name = \"Plain\", value = 1 },\n{ name = \"No download\", value = 1 },\n\
        { name = \"Node-ID\", value = 2 },\n{ name = \"CAN baud rate\", value = 1 },\n{ name = \"Output\", value = 1 },\n]\n";
    let saved = Backup::from_toml(text, &description).expect("a backup");
    let mut device = Recorder { is_canopen: true, ..Recorder::default() };
    let plan = Plan::new(&description, &saved, Some(1), &[]);
    assert!(plan.execute(&mut device, &mut |_| true).is_complete());
    assert_eq!(names(&description, &device.writes), ["Plain"]);
    assert_eq!(plan.refused.len(), 5, "{plan}");
    // Of the protected parameters, a restore writes only those that the caller names.
    let baud = description.find("CAN baud rate").expect("a parameter").address();
    let plan = Plan::new(&description, &saved, Some(1), &[baud]);
    assert_eq!((plan.writes.len(), plan.refused.len()), (2, 4), "{plan}");
}

#[test]
fn conditions_are_checked_before_a_write() {
    let description = valve();
    let find = |name: &str| description.find(name).expect("a parameter");
    let mut device = Recorder::default();
    let write = Write::parse(find("Gain"), "3", None).expect("a value");
    let refused = write.execute(&mut device).expect_err("the mode is manual");
    assert_eq!(refused, WriteError::Condition("Mode is 1".to_owned()));
    assert_eq!(device.writes, []);
    Write::parse(find("Mode"), "automatic", None).expect("a value").execute(&mut device).expect("a write");
    write.execute(&mut device).expect("a write");
    assert_eq!(names(&description, &device.writes), ["Mode", "Gain"]);
    assert!(matches!(Write::parse(find("Closed"), "3", None), Err(WriteError::Excluded(..))));
}

#[test]
fn a_condition_that_does_not_hold_is_reported_by_a_restore() {
    let description = valve();
    let text = "lexibus-backup = 1\nparameters = [{ name = \"Gain\", value = 3 }, { name = \"Plain\", value = 4 }]\n";
    let saved = Backup::from_toml(text, &description).expect("a backup");
    let mut device = Recorder::default();
    let outcome = Plan::new(&description, &saved, None, &[]).execute(&mut device, &mut |_| true);
    assert!(!outcome.is_complete());
    assert_eq!(names(&description, &device.writes), ["Plain"]);
    let refused = outcome.states.iter().filter(|(_, status)| matches!(status, Status::Refused(_)));
    assert_eq!(refused.map(|(write, _)| write.parameter().name()).collect::<Vec<_>>(), ["Gain"]);
}

#[test]
fn files_that_are_no_backups_are_refused() {
    let description = valve();
    let error = |text: &str| Backup::from_toml(text, &description).expect_err("no backup").to_string();
    assert!(error("parameters = []").contains("`lexibus-backup = 1` is missing"));
    assert!(error("lexibus-backup = 1\nparameters = [{ value = 1 }]").contains("neither an address nor a name"));
    assert!(error("lexibus-backup = 1\nparameters = [{ name = \"Plain\" }]").contains("the value is missing"));
    assert!(error("lexibus-backup = 1\nparameters = [{ name = \"Plan\", value = 1 }]").contains("did you mean"));
    let other = "lexibus-backup = 1\nparameters = [{ address = \"0\", name = \"Gain\", value = 1 }]";
    assert!(error(other).contains("states another name for this address: `Gain`"));
    assert!(error("lexibus-backup = 1").contains("no list `parameters`"));
    for id in ["0", "300", "\"1\""] {
        let text = format!("lexibus-backup = 1\nnode-id = {id}\nparameters = []");
        assert!(error(&text).contains("`node-id` must be an integer from 1 to 255"), "{id}");
    }
    // The plan refuses a value that doesn't fit the type.
    let text = "lexibus-backup = 1\nparameters = [{ name = \"Plain\", value = 70000 }]";
    let saved = Backup::from_toml(text, &description).expect("a backup");
    let plan = Plan::new(&description, &saved, None, &[]);
    assert!(plan.writes.is_empty() && plan.refused[0].is_failure, "{plan}");
}

/// If an item of a Modbus device is also an object on another bus, it has the protection of the object.
#[test]
fn registers_that_are_also_commands_of_a_drive_are_protected() {
    let description = dictionary("eco.toml", Network::Modbus);
    let protection = |name: &str| description.find(name).unwrap_or_else(|error| panic!("{error}")).protection();
    for name in ["modes_of_operation", "target_velocity", "target_position"] {
        assert_eq!(protection(name), Some(Protection::Control), "{name}");
    }
    assert_eq!(protection("control_word"), Some(Protection::Command));
}

/// Protected parameters that the user named are written after all unprotected ones, and the slave address last.
#[test]
fn the_address_of_the_device_is_written_last() {
    let description = valve();
    let entries =
        ["Slave_address", "Zero", "Plain"].map(|name| format!("{{ name = \"{name}\", value = 1 }}")).join(", ");
    let saved =
        Backup::from_toml(&format!("lexibus-backup = 1\nparameters = [{entries}]"), &description).expect("a backup");
    let included = ["Slave_address", "Zero"].map(|name| description.find(name).expect("a parameter").address());
    let mut device = Recorder::default();
    assert!(Plan::new(&description, &saved, None, &included).execute(&mut device, &mut |_| true).is_complete());
    assert_eq!(names(&description, &device.writes), ["Plain", "Zero", "Slave_address"]);
}

/// On CANopen, a command that the user named is written before the node-ID and the bit rate, too.
#[test]
fn the_node_id_and_the_bit_rate_are_written_last() {
    let description = flags();
    let entries = ["Node-ID", "CAN baud rate", "Program control", "Plain"]
        .map(|name| format!("{{ name = \"{name}\", value = 1 }}"))
        .join(", ");
    let saved =
        Backup::from_toml(&format!("lexibus-backup = 1\nparameters = [{entries}]"), &description).expect("a backup");
    let included = ["Node-ID", "CAN baud rate", "Program control"]
        .map(|name| description.find(name).expect("a parameter").address());
    let mut device = Recorder { is_canopen: true, ..Recorder::default() };
    assert!(Plan::new(&description, &saved, Some(1), &included).execute(&mut device, &mut |_| true).is_complete());
    let written = names(&description, &device.writes);
    assert_eq!(written[..2], ["Plain", "Program control"], "{written:?}");
    assert_eq!(written.len(), 4);
}

const PDO: [(&str, &str); 3] = [("0x1800:01", "\"$NODEID+0x180\""), ("0x1A00:00", "1"), ("0x1A00:01", "0x60640020")];

fn backup_of_pdo(description: &Description, values: &[(&str, &str)]) -> Backup {
    let entries: Vec<String> =
        values.iter().map(|(address, value)| format!("{{ address = \"{address}\", value = {value} }}")).collect();
    let text = format!("lexibus-backup = 1\nparameters = [{}]", entries.join(", "));
    Backup::from_toml(&text, description).expect("a backup")
}

/// A backup that lacks a value of a PDO must not enable the PDO with the default COB-ID or mapping.
#[test]
fn a_pdo_is_restored_as_a_whole_or_not_at_all() {
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    let plan = |values: &[(&str, &str)]| Plan::new(&description, &backup_of_pdo(&description, values), Some(5), &[]);
    assert!(!plan(&PDO).writes.is_empty());
    for left_out in 0..PDO.len() {
        let values: Vec<(&str, &str)> =
            PDO.iter().enumerate().filter(|(at, _)| *at != left_out).map(|(_, value)| *value).collect();
        let plan = plan(&values);
        let of_pdo =
            |write: &&Write<'_>| write.parameter().address().object().is_some_and(|object| object.index == 0x1800);
        assert_eq!(plan.writes.iter().filter(of_pdo).count(), 0, "{left_out}: {plan}");
        assert!(left_out == 1 || plan.refused.iter().any(|refused| refused.is_failure), "{plan}");
    }
}

/// A refused value of a PDO, or a mapping entry without a value, leaves the PDO as it is.
#[test]
fn a_pdo_with_a_refused_value_or_without_an_entry_is_not_restored() {
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    for (address, value) in [("0x1800:02", "300"), ("0x1A00:00", "2")] {
        let mut values = PDO.to_vec();
        values.retain(|(other, _)| *other != address);
        values.push((address, value));
        let plan = Plan::new(&description, &backup_of_pdo(&description, &values), Some(5), &[]);
        assert!(plan.writes.is_empty(), "{address}: {plan}");
        assert!(plan.refused.iter().any(|refused| refused.is_failure), "{plan}");
    }
}

/// A mapping entry above the number of mapped objects isn't written, even if it is named.
#[test]
fn an_entry_that_is_not_mapped_is_not_written() {
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    let values = [
        ("0x1801:01", "\"$NODEID+0x280\""),
        ("0x1A01:00", "1"),
        ("0x1A01:01", "0x60410010"),
        ("0x1A01:02", "0x60640020"),
    ];
    let entry = description.find("0x1A01:02").expect("an object").address();
    let plan = Plan::new(&description, &backup_of_pdo(&description, &values), Some(5), &[entry]);
    assert!(!plan.writes.is_empty() && plan.writes.iter().all(|write| write.parameter().address() != entry), "{plan}");
    assert!(plan.to_string().contains("above the number of mapped objects"), "{plan}");
}

/// If the device refuses a mapping entry, the restore leaves the PDO disabled.
#[test]
fn a_pdo_with_a_refused_entry_stays_disabled() {
    struct Refusing(Recorder, Address);
    impl Connection for Refusing {
        fn network(&self) -> Network {
            Network::CanOpen
        }
        fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
            self.0.read(address, length)
        }
        fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
            if address == self.1 {
                return Err(Failure::Abort(lexibus::AbortCode::NOT_MAPPABLE));
            }
            self.0.write(address, data)
        }
    }
    let description = dictionary("demo-drive.eds", Network::CanOpen);
    let address = |text: &str| description.find(text).expect("an object").address();
    let recorder = Recorder { is_canopen: true, ..Recorder::default() };
    let mut device = Refusing(recorder, address("0x1A00:01"));
    let plan = Plan::new(&description, &backup_of_pdo(&description, &PDO), Some(5), &[]);
    let outcome = plan.execute(&mut device, &mut |_| true);
    assert!(!outcome.is_complete());
    assert_eq!(device.0.values[&address("0x1800:01")][3] & 0x80, 0x80, "the PDO is disabled");
    assert_eq!(outcome.states.last().map(|(_, status)| status.clone()), Some(Status::NotWritten));
}
