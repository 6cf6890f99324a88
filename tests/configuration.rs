//! Tests the configuration of a DCF with a simulated device that accepts changes to PDOs only in the order of CiA 301.

use lexibus::clients::canopen::Node;
use lexibus::configuration::{Phase, Progress};
use lexibus::sim::{CanNode, Device, Fault};
use lexibus::{AbortCode, CanOpen, Configuration, Error, NodeId, RawInitial, SdoWrite};

lexibus::dictionary! {
    /// The conveyor from a UI case of the compiler.
    pub mod conveyor = "tests/ui/configuration/order-of-a-dcf/input.dcf" { table: true, allow: "warnings" };
}

use conveyor::{objects, CONFIGURATION};

const NODE: NodeId = match conveyor::NODE_ID {
    Some(node) => node,
    None => unreachable!(),
};

/// Returns a device that refuses a new SYNC counter overflow value while the SYNC period is not 0 (CiA 301 7.5.2.22). Simulated
/// devices also refuse changes to enabled PDOs (CiA 301 7.5.2.35 to 7.5.2.38).
fn conveyor() -> Device {
    let mut device = Device::new(conveyor::ENTRIES).with_node_id(NODE);
    device
        .on_write(objects::SYNC_COUNTER_OVERFLOW, |device, _| match device.get(objects::SYNC_PERIOD)? {
            0 => Ok(()),
            _ => Err(AbortCode::DEVICE_STATE),
        })
        .unwrap();
    device
}

#[test]
fn a_strict_device_accepts_the_configuration() {
    let mut device = conveyor();
    let mut phases = Vec::new();
    let mut client = device.client::<CanOpen>();
    CONFIGURATION
        .apply(&mut client, NODE, |Progress { phase, done, total, .. }| {
            phases.push(phase);
            assert_eq!((done, total), (phases.len(), CONFIGURATION.writes(NODE).count()));
        })
        .unwrap();
    assert!(phases.windows(2).all(|pair| pair[0] <= pair[1]));
    phases.dedup();
    let all = [
        Phase::DisablePdos,
        Phase::Communication,
        Phase::Parameters,
        Phase::Mapping,
        Phase::PdoParameters,
        Phase::EnablePdos,
    ];
    assert_eq!(phases, all);
    assert_eq!(CONFIGURATION.verify(&mut client, NODE, &mut [0; 32], |difference| panic!("{difference}")), Ok(0));

    assert_eq!(device.get(objects::rpdo_1::COB_ID).map(|id| id.raw()), Ok(0x205));
    assert_eq!(device.get(objects::rpdo_1_mapping::ENTRY_2).map(|entry| entry.raw()), Ok(0x2001_0010));
    assert_eq!(device.get(objects::tpdo_2::COB_ID).map(|id| id.raw()), Ok(0x281));
    assert_eq!(device.get(objects::tpdo_3::COB_ID).map(|id| id.raw()), Ok(0x8000_0385));
    assert_eq!(device.get(objects::GAIN), Ok(2.5));
    assert_eq!(device.get(objects::OFFSET), Ok(-2));
    assert_eq!(device.get(objects::PASSWORD), Ok(0x1234));
    // ObjFlags of the serial number forbid the write.
    assert_eq!(device.get(objects::SERIAL_NUMBER), Ok(0));
}

/// The device must refuse a write if an earlier phase is missing, or if the write is moved to another phase.
#[test]
fn the_strict_device_refuses_another_order() {
    let refused = |configuration: Configuration, write: SdoWrite, code: AbortCode| {
        let mut device = conveyor();
        let error = configuration.apply(&mut device.client::<CanOpen>(), NODE, |_| ()).unwrap_err();
        assert_eq!((error.write, error.error), (write, Error::Abort(code)));
    };
    let enabled = Configuration { disable_pdos: &[], ..CONFIGURATION };
    refused(enabled, SdoWrite::new_u8(0x1600, 0, 0), AbortCode::INVALID_VALUE);
    let early = Configuration { pdo_parameters: CONFIGURATION.enable_pdos, ..CONFIGURATION };
    let early = Configuration { enable_pdos: CONFIGURATION.pdo_parameters, ..early };
    refused(early, SdoWrite::new_u16(0x1801, 3, 100), AbortCode::INVALID_VALUE);
    let period = Configuration { parameters: &CONFIGURATION.communication[2..3], ..CONFIGURATION };
    refused(period, SdoWrite::new_u8(0x1019, 0, 4), AbortCode::DEVICE_STATE);
}

#[test]
fn differences_after_a_change() {
    let mut device = conveyor();
    CONFIGURATION.without_defaults().apply(&mut device.client::<CanOpen>(), NODE, |_| ()).unwrap();
    device.set(objects::HEARTBEAT_PERIOD, 7).unwrap();
    device.set(objects::rpdo_1_mapping::NUMBER_OF_ENTRIES, 0).unwrap();
    let mut list = Vec::new();
    let mut buffer = [0; CONFIGURATION.longest_value()];
    let mut client = device.client::<CanOpen>();
    let count = CONFIGURATION.verify(&mut client, NODE, &mut buffer, |difference| list.push(difference.to_string()));
    assert_eq!(list, ["0x1017:00: expected 0x03E8, found 0x0007", "0x1600:00: expected 0x02, found 0x00"]);
    assert_eq!(count, Ok(2));
    device.fail_next(Fault::Bus);
    let count = CONFIGURATION.verify(&mut device.client::<CanOpen>(), NODE, &mut buffer, |_| ());
    assert_eq!(count, Err(Error::Client(Fault::Bus)));
}

/// The texts of the configuration need segmented transfers.
#[test]
fn over_can() {
    let mut node = Node::new(CanNode::new(conveyor()), NODE);
    CONFIGURATION.apply(&mut node, NODE, |_| ()).unwrap();
    let mut buffer = [0; CONFIGURATION.longest_value()];
    assert_eq!(CONFIGURATION.verify(&mut node, NODE, &mut buffer, |difference| panic!("{difference}")), Ok(0));
}

/// Writes the concise DCF to a device as a CANopen manager does, and verifies the values in the device.
#[test]
fn concise_dcf() {
    let mut buffer = [0; CONFIGURATION.concise_dcf_len()];
    let bytes = CONFIGURATION.concise_dcf(NODE, &mut buffer).unwrap();
    let (count, mut rest) = bytes.split_at(4);
    let mut device = conveyor();
    let mut client = device.client::<CanOpen>();
    for _ in 0..u32::from_le_bytes(count.try_into().unwrap()) {
        let (header, value) = rest.split_at(7);
        let object = lexibus::Object::new(u16::from_le_bytes([header[0], header[1]]), header[2]);
        let (value, next) = value.split_at(u32::from_le_bytes(header[3..].try_into().unwrap()) as usize);
        lexibus::Client::write(&mut client, object, value).unwrap();
        rest = next;
    }
    assert!(rest.is_empty());
    assert_eq!(CONFIGURATION.verify(&mut client, NODE, &mut [0; 32], |difference| panic!("{difference}")), Ok(0));
}

#[test]
fn the_static_table_has_the_configured_values() {
    let mut count = 0;
    for entry in conveyor::ENTRIES {
        let (Some(object), Some(configured)) = (entry.object, entry.configured) else { continue };
        let Some(write) = CONFIGURATION.of(object, NODE) else { continue };
        let expected = match configured {
            RawInitial::Bytes(bytes) => bytes.to_vec(),
            RawInitial::NodeId(offset) => (offset + u64::from(NODE.get())).to_le_bytes()[..write.data().len()].to_vec(),
            RawInitial::Unknown => panic!("the value of {object:?} is unknown"),
        };
        assert_eq!(write.data(), expected, "{object:?}");
        count += 1;
    }
    assert!(count > 10, "{count}");
    let device_type = lexibus::table::find(conveyor::ENTRIES, 0x1000, 0).unwrap();
    assert_eq!(device_type.configured, None);
}
