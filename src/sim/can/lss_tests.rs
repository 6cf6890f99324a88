//! Tests of the LSS master with simulated nodes.

use super::*;
use crate::bus::Object;
use crate::clients::canopen::NmtCommand;
use crate::clients::canopen::{CanPort, LssMaster};
use crate::lss::{IdentityPart, LssAddress, LssError, LssState, Refusal};
use crate::now::now;
use crate::table::{AccessRights, Bound, Entry, RawInitial};
use crate::{DataType, Flags};

const fn part(sub_index: u8, initial: &'static [u8]) -> Entry {
    Entry {
        object: Some(Object::new(0x1018, sub_index)),
        register: None,
        name: "",
        data_type: DataType::Unsigned32,
        access: AccessRights::ReadOnly,
        flags: Flags::NONE,
        initial: RawInitial::Bytes(initial),
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

const ENTRIES: &[Entry] =
    &[part(1, &[0x19, 3, 0, 0]), part(2, &[7, 0, 0, 0x80]), part(3, &[2, 0, 1, 0]), part(4, &[0, 0, 0, 0])];

fn address(serial_number: u32) -> LssAddress {
    LssAddress { vendor_id: 0x319, product_code: 0x8000_0007, revision_number: 0x1_0002, serial_number }
}

fn device(serial: u32) -> Device {
    let mut device = Device::new(ENTRIES);
    device.set_initial_bytes(Object::new(0x1018, 4), &serial.to_le_bytes()).unwrap();
    device
}

fn node_id(id: u8) -> NodeId {
    NodeId::new(id).expect("a node-ID")
}

/// Creates a bus with nodes that have these serial numbers and no node-ID, and a node that has node-ID 9.
fn bus(serials: &[u32]) -> CanBus {
    let mut bus = CanBus::new();
    for serial in serials {
        bus.add(CanNode::without_node_id(device(*serial)));
    }
    bus.add(CanNode::new(device(1000).with_node_id(node_id(9))));
    bus
}

fn boot_ups(bus: &mut CanBus) -> Vec<u32> {
    let mut ids = Vec::new();
    let mut note = |frame: &CanFrame| {
        ids.push(frame.id());
        false
    };
    CanPort::receive(bus, Duration::ZERO, &mut note).unwrap();
    ids
}

#[test]
fn each_node_is_found_and_configured() {
    let mut bus = bus(&[0xFFFF_FFFF, 21, 0, 22]);
    assert_eq!(boot_ups(&mut bus), [0x709]);
    let mut master = LssMaster::new(bus);
    for (id, serial) in (1..).zip([0, 21, 22, 0xFFFF_FFFF]) {
        assert_eq!(master.has_unconfigured(), Ok(true));
        assert_eq!(master.fast_scan(), Ok(Some(address(serial))));
        assert_eq!(master.inquire_node_id(), Ok(None));
        assert_eq!(master.configure_node_id(node_id(id)), Ok(()));
        assert_eq!(master.store(), Ok(()));
        assert_eq!(boot_ups(master.port()), []);
        assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
        assert_eq!(boot_ups(master.port()), [0x700 + u32::from(id)]);
    }
    assert_eq!((master.has_unconfigured(), master.fast_scan()), (Ok(false), Ok(None)));
    // Stored node-IDs are used after a restart.
    let mut bus = master.into_port();
    CanPort::send(&mut bus, &NmtCommand::ResetNode.frame(None), Duration::ZERO).unwrap();
    let mut ids = boot_ups(&mut bus);
    ids.sort_unstable();
    assert_eq!(ids, [0x701, 0x702, 0x703, 0x704, 0x709]);
}

#[test]
fn async_scan() {
    let mut master = LssMaster::new(bus(&[5])).with_window(Duration::from_millis(2));
    let start = CanPort::now(master.port()).unwrap();
    assert_eq!(now(master.fast_scan_async()), Ok(Some(address(5))));
    assert_eq!(now(master.configure_node_id_async(node_id(3))), Ok(()));
    assert_eq!(now(master.switch_global_async(LssState::Waiting)), Ok(()));
    assert_eq!(now(master.fast_scan_async()), Ok(None));
    // 133 steps, four answers whose window has to pass, one answer and two unanswered steps whose timeout has to pass.
    assert_eq!(CanPort::now(master.port()).unwrap() - start, Duration::from_millis(2 * (133 + 4) + 3 * 500));
}

#[test]
fn a_configured_node_gets_a_new_node_id() {
    let mut master = LssMaster::new(bus(&[5]));
    boot_ups(master.port());
    assert_eq!(master.switch_selective(address(1001)), Err(LssError::Timeout));
    assert_eq!(master.switch_selective(address(1000)), Ok(()));
    assert_eq!(master.inquire_node_id(), Ok(Some(node_id(9))));
    assert_eq!(master.inquire(IdentityPart::SerialNumber), Ok(1000));
    assert_eq!(master.configure_node_id(node_id(10)), Ok(()));
    assert_eq!(master.configure_bit_timing(0, 5), Err(LssError::Refused(Refusal::NOT_SUPPORTED)));
    assert_eq!(master.switch_global(LssState::Waiting), Ok(()));
    assert_eq!(boot_ups(master.port()), []);
    CanPort::send(master.port(), &NmtCommand::ResetCommunication.frame(Some(node_id(9))), Duration::ZERO).unwrap();
    assert_eq!(boot_ups(master.port()), [0x70A]);
    // The node-ID was not stored.
    CanPort::send(master.port(), &NmtCommand::ResetNode.frame(Some(node_id(10))), Duration::ZERO).unwrap();
    assert_eq!(boot_ups(master.port()), [0x709]);
}

#[test]
fn bit_rates() {
    let mut master = LssMaster::new(bus(&[]));
    let rate = |master: &mut LssMaster<CanBus>| master.port().nodes()[0].bit_rate();
    boot_ups(master.port());
    assert_eq!(master.switch_global(LssState::Configuration), Ok(()));
    assert_eq!(master.configure_bit_rate(BitRate::Kbit250), Ok(()));
    assert_eq!(rate(&mut master), None);
    assert_eq!(master.activate_bit_timing(100), Ok(()));
    assert_eq!(rate(&mut master), Some(BitRate::Kbit250));
    // The node is silent for twice the delay.
    let reset = NmtCommand::ResetNode.frame(None);
    CanPort::send(master.port(), &reset, Duration::ZERO).unwrap();
    assert_eq!(boot_ups(master.port()), []);
    master.port().advance(Duration::from_millis(200));
    CanPort::send(master.port(), &reset, Duration::ZERO).unwrap();
    assert_eq!(boot_ups(master.port()), [0x709]);
}

#[test]
fn several_nodes_in_configuration() {
    let mut master = LssMaster::new(bus(&[7, 7]));
    assert_eq!(master.fast_scan(), Err(LssError::SeveralAnswers));
    assert_eq!(master.switch_global(LssState::Configuration), Ok(()));
    assert_eq!(master.configure_node_id(node_id(5)), Err(LssError::SeveralAnswers));
    assert_eq!(master.inquire_address(), Err(LssError::SeveralAnswers));
    // None of them uses the node-ID after a retry.
    assert_eq!(master.fast_scan(), Err(LssError::SeveralAnswers));
    let nodes = master.port().nodes();
    assert_eq!(nodes.iter().map(CanNode::node_id).collect::<Vec<_>>(), [None, None, Some(node_id(9))]);
}

#[test]
fn a_selected_node_is_the_only_one_in_configuration() {
    let mut master = LssMaster::new(bus(&[7])).with_pause(Duration::from_millis(5));
    assert_eq!(master.switch_global(LssState::Configuration), Ok(()));
    assert_eq!(master.switch_selective(address(1000)), Ok(()));
    assert_eq!(master.configure_node_id(node_id(10)), Ok(()));
    assert_eq!(master.remove_node_id(), Ok(()));
}
