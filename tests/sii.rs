//! Tests EEPROM images of EtherCAT slaves with `ethercrab`, which reads the images from simulated SubDevices. The
//! SubDevices refuse sync managers that differ from their description. The settings of sync managers and FMMUs that
//! `ethercrab` writes are compared with the output of the network compiler.

use std::path::Path;

use ethercrab::subdevice_group::{Op, PreOp};
use ethercrab::{DefaultLock, MainDevice, SubDeviceGroup};
use lexibus::clients::ethercat::Sdo;
use lexibus::AbortCode;
use lexibus_codegen::compile::{read, Options as Reading};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_export::sii;
use lexibus_network::compile::compile;

#[path = "../examples/support/ethercat/mod.rs"]
mod ethercat;
#[path = "support/segment.rs"]
mod segment;
#[path = "../network/tests/support/settings.rs"]
mod settings;

use ethercat::objects::Dictionary;
use ethercat::{Servo, SubDevice};
use segment::with_segment;
use settings::{fmmu_settings, manager_settings};

lexibus::dictionary! {
    /// A drive with a mailbox. The master reads its PDOs from the object dictionary.
    pub mod servo = "examples/support/servo.esi.xml" { table: true, strict: true }
}

lexibus::dictionary! {
    /// A terminal without a mailbox. The master reads its PDOs from the EEPROM.
    pub mod terminal = "tests/data/terminal.esi.xml" { strict: true }
}

const SERVO_FILE: &str = "examples/support/servo.esi.xml";
const TERMINAL_FILE: &str = "tests/data/terminal.esi.xml";
const SERVO: &str = include_str!("../examples/support/servo.esi.xml");
const TERMINAL: &str = include_str!("data/terminal.esi.xml");

type Group<S> = SubDeviceGroup<4, 64, DefaultLock, S>;

/// Exports the EEPROM image of the only device of an ESI.
fn image(esi: &str, facts: &[(&str, &str)]) -> Vec<u8> {
    let catalog = read(Source::new("device.xml", esi.into()), &Reading::default()).catalog.expect("an ESI");
    let mut options = sii::Options::default();
    facts.iter().for_each(|(key, value)| options.set(key, value).expect("an option"));
    sii::export(&catalog.devices[0], &options).expect("an image").bytes
}

async fn pre_op(maindevice: &'static MainDevice<'static>) -> Group<PreOp> {
    maindevice.init_single_group(|| 1_000_000).await.expect("all SubDevices in Pre-Operational")
}

async fn op(maindevice: &'static MainDevice<'static>) -> Group<Op> {
    pre_op(maindevice).await.into_op(maindevice).await.expect("all SubDevices in Operational")
}

/// Compiles a network file whose segment contains only the device of the description file `path`.
fn compiled(path: &str) -> lexibus_network::ethercat::SubDevice {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = format!("[segment]\ncycle = 1000\n[segment.subdevices.one]\ndevice = \"{path}\"\n");
    let name = root.join("network.toml").to_string_lossy().into_owned();
    let compilation = compile(Source::new(name, text.into()), Levels::lenient());
    assert!(compilation.diagnostics.list().is_empty(), "{:?}", compilation.diagnostics.list());
    compilation.network.and_then(|network| network.segment).expect("a segment").subdevices.swap_remove(0)
}

/// Checks that the registers of each sync manager and each FMMU contain the settings that the network compiler computes for
/// the device. The logical addresses are not compared, because the master places inputs before outputs. `lengths` contains
/// the lengths of the sync managers.
async fn check_registers(maindevice: &MainDevice<'_>, group: &Group<Op>, path: &str, lengths: &[u16]) {
    let subdevice = group.subdevice(maindevice, 0).expect("a SubDevice");
    let compiled = compiled(path);
    assert_eq!(compiled.sync_managers.iter().map(|manager| manager.length).collect::<Vec<_>>(), lengths);
    for manager in &compiled.sync_managers {
        let settings = manager_settings(manager);
        let set: [u8; 8] = subdevice.register_read(settings.register()).await.expect("the registers");
        let expected = settings.bytes();
        assert_eq!((&set[..5], set[6] & 1), (&expected[..5], expected[6]), "sync manager {}", manager.number);
    }
    assert_eq!(compiled.fmmus.len(), 2);
    for fmmu in &compiled.fmmus {
        let settings = fmmu_settings(fmmu);
        let set: [u8; 16] = subdevice.register_read(settings.register()).await.expect("the registers");
        assert_eq!(set[4..], settings.bytes()[4..], "FMMU {}", fmmu.number);
    }
}

#[test]
fn a_drive_starts_with_its_image() {
    let facts = [("serial-number", "4711"), ("station-alias", "0x1234")];
    let image = image(SERVO, &facts);
    let subdevice = SubDevice::new(&servo::DEVICE, Servo::new()).with_eeprom(image.clone());
    with_segment(vec![subdevice], |maindevice| async move {
        let group = pre_op(maindevice).await;
        let subdevice = group.subdevice(maindevice, 0).expect("a SubDevice");
        let (identity, described) = (subdevice.identity(), servo::DEVICE.identity);
        assert_eq!(Some(identity.vendor_id), described.vendor_id);
        assert_eq!(Some(identity.product_id), described.product_code);
        assert_eq!(Some(identity.revision), described.revision_number);
        assert_eq!(identity.serial, 4711);
        assert_eq!(subdevice.name(), described.order_code);
        let description = subdevice.description().await.expect("a text");
        assert_eq!(description.as_deref(), Some(described.product_name));
        assert_eq!(subdevice.read_alias_address_from_eeprom(maindevice).await, Ok(0x1234));
        assert_eq!(subdevice.eeprom_size(maindevice).await, Ok(image.len()));
        // The mailbox works, because its sync managers are right.
        let mut drive = servo::DemoServo::new(Sdo::new(maindevice, &subdevice));
        assert_eq!(drive.target_position().read_async().await, Ok(0));
        let group = group.into_op(maindevice).await.expect("Operational");
        check_registers(maindevice, &group, SERVO_FILE, &[128, 128, 6, 7]).await;
    });
}

/// The process data of the terminal.
struct Terminal;

impl Dictionary for Terminal {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        match (index, sub_index) {
            (0x6000, 1) => Ok(vec![1, 2, 3, 4]),
            (0x6001, 1) => Ok((0..30).collect()),
            _ => Err(AbortCode::NO_OBJECT.0),
        }
    }

    fn write(&mut self, _: u16, _: u8, _: &[u8]) -> Result<(), u32> {
        Ok(())
    }
}

/// `ethercrab` takes the PDOs from the EEPROM: their sync managers, and the lengths of their entries.
#[test]
fn a_terminal_without_a_mailbox_exchanges_data_with_its_image() {
    let subdevice = SubDevice::new(&terminal::DEVICE, Terminal).with_eeprom(image(TERMINAL, &[]));
    with_segment(vec![subdevice], |maindevice| async move {
        let group = op(maindevice).await;
        let subdevice = group.subdevice(maindevice, 0).expect("a SubDevice");
        assert_eq!(subdevice.name(), "TM-4");
        // `ethercrab` replaces characters outside of ASCII.
        let description = subdevice.description().await.expect("a text");
        assert_eq!(description.as_deref(), Some("TM-4 terminal, 4 ?s"));
        assert_eq!((subdevice.outputs_raw().len(), subdevice.inputs_raw().len()), (3, 34));
        check_registers(maindevice, &group, TERMINAL_FILE, &[3, 34]).await;
        group.tx_rx(maindevice).await.expect("an exchange");
        let expected: Vec<u8> = [1, 2, 3, 4].into_iter().chain(0..30).collect();
        let subdevice = group.subdevice(maindevice, 0).expect("a SubDevice");
        assert_eq!(subdevice.inputs_raw()[..], expected[..]);
    });
}
