//! Tests the demo drive's checked-in bindings with a node that is created from the drive's exported EDS.

use lexibus::{AbortCode, Item, OnCanOpen, Rw, Step};
use lexibus_drives::demo_drive::codes::DriveErrors;
use lexibus_drives::demo_drive::pdo::{RxPdo1, RxPdo2, TxPdo1, TxPdo2};
use lexibus_drives::demo_drive::types::{Controlword, ModesOfOperation, State, Statusword, StoreParameters};
use lexibus_drives::demo_drive::DemoDrive;
use serde_json::json;

use super::pdo::{configure, expected, frame, receive, used};
use super::refusals::assert_aborted;
use super::{node_id, start, Error, NODE, PATIENCE};

const FILE: &str = "dictionaries/demo-drive.eds";

#[test]
fn parameters_of_the_drive() -> Result<(), Error> {
    let Some((mut script, node)) = start("demo-parameters", FILE) else { return Ok(()) };
    let mut drive = DemoDrive::new(node);
    let mut buffer = [0; 64];
    assert_eq!(drive.manufacturer_device_name().read_into(&mut buffer)?, "Demo Drive");
    assert_eq!(drive.identity_object().product_code().read()?, 0x4021);
    assert_eq!(drive.rpdo_2_communication().cob_id().read()?.raw(), 0x300 + u32::from(NODE));
    assert_eq!(drive.store_parameters().save_all_parameters().read()?, StoreParameters::OnCommand);
    drive.store_parameters().save_all_parameters().write(StoreParameters::Save)?;
    assert_eq!(script.get(0x1010, 1), u32::from_le_bytes(*b"save"));
    drive.modes_of_operation().write(ModesOfOperation::Homing)?;
    assert_eq!(script.get(0x6060, 0), 6);
    drive.application_name().write("the name of an axis, in segments")?;
    assert_eq!(script.get(0x2001, 0), "the name of an axis, in segments");
    drive.firmware_image().write(&[0x5A; 1000])?;
    assert_eq!(script.get(0x2002, 0), "5a".repeat(1000));
    script.set(0x2000, 0, json!(42.5));
    assert_eq!(drive.motor_temperature().read()?, 42.5);
    script.set(0x2010, 2, json!(-1234));
    assert_eq!(drive.analog_inputs().input_2().read()?, -1234);
    script.set(0x2020, 0, json!(-0x12_3456));
    assert_eq!(drive.encoder_counts().read()?, -0x12_3456);
    Ok(())
}

#[test]
fn limits_of_the_drive() -> Result<(), Error> {
    const NAIVE: Item<i32, Rw, OnCanOpen> = Item::object(0x607A, 0, "");
    const MEASURED: Item<i32, Rw, OnCanOpen> = Item::object(0x6064, 0, "");
    let Some((mut script, node)) = start("demo-limits", FILE) else { return Ok(()) };
    let mut drive = DemoDrive::new(node);
    drive.target_position().write(-1_000_000)?;
    assert_eq!(script.get(0x607A, 0), -1_000_000);
    assert!(matches!(drive.target_position().write(1_000_001).map_err(Error::from), Err(Error::OutOfRange(_))));
    assert_aborted(NAIVE.at(drive.client()).write(1_000_001), AbortCode::TOO_HIGH);
    assert_aborted(NAIVE.at(drive.client()).write(-1_000_001), AbortCode::TOO_LOW);
    assert_aborted(MEASURED.at(drive.client()).write(0), AbortCode::READ_ONLY);
    assert_eq!(drive.target_position().read()?, -1_000_000);
    Ok(())
}

/// Goes from a fault to each state and back. Lexibus selects the commands. The Python library determines the resulting
/// states with its own tables.
#[test]
fn the_state_machine() -> Result<(), Error> {
    let Some((mut script, node)) = start("demo-states", FILE) else { return Ok(()) };
    let mut drive = DemoDrive::new(node);
    script.ask(json!({ "do": "drive", "state": "FAULT" }));
    let mut state = drive.statusword().read()?.state().expect("a state");
    assert_eq!(state, State::Fault);
    for target in [
        State::SwitchOnDisabled,
        State::OperationEnabled,
        State::QuickStopActive,
        State::OperationEnabled,
        State::SwitchedOn,
        State::ReadyToSwitchOn,
        State::SwitchOnDisabled,
    ] {
        for _ in 0..4 {
            let Step::Command(command) = state.toward(target) else { break };
            drive.controlword().write(Controlword::new().with_command(command))?;
            state = drive.statusword().read()?.state().expect("a state");
        }
        assert_eq!(state, target);
    }
    Ok(())
}

#[test]
fn pdos_of_the_drive() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("demo-pdos", FILE) else { return Ok(()) };
    let id = u32::from(NODE);
    configure(&mut node, RxPdo1::configuration(node_id()))?;
    configure(&mut node, RxPdo2::configuration(node_id()))?;
    configure(&mut node, TxPdo1::configuration(node_id()))?;
    configure(&mut node, TxPdo2::configuration(node_id()))?;
    assert_eq!(used(&mut script, "rx", 1), expected::<RxPdo1>(0x200 + id, 255));
    assert_eq!(used(&mut script, "rx", 2), expected::<RxPdo2>(0x300 + id, 1));
    assert_eq!(used(&mut script, "tx", 1), expected::<TxPdo1>(0x180 + id, 255));
    assert_eq!(used(&mut script, "tx", 2), expected::<TxPdo2>(0x280 + id, 1));

    let controlword = Controlword::from_raw(0x001F);
    node.send(&frame(0x300 + id, &RxPdo2 { controlword, target_position: -100_000 }.pack()))?;
    assert_eq!(script.ask(json!({ "do": "receive", "number": 2 })), json!([0x001F, -100_000]));
    node.send(&frame(0x200 + id, &RxPdo1 { controlword }.pack()))?;
    assert_eq!(script.ask(json!({ "do": "receive", "number": 1 })), json!([0x001F]));

    script.ask(json!({ "do": "load", "number": 1, "values": [0x0250] }));
    script.ask(json!({ "do": "load", "number": 2, "values": [0x1637, -123_456] }));
    // The node sends the second PDO after SYNC.
    node.sync()?;
    let received = receive(&mut node, 0x280 + id);
    let statusword = Statusword::from_raw(0x1637);
    assert_eq!(TxPdo2::unpack(received.data())?, TxPdo2 { statusword, position_actual_value: -123_456 });
    assert_eq!(statusword.state(), Some(State::OperationEnabled));
    script.ask(json!({ "do": "transmit", "number": 1 }));
    let received = receive(&mut node, 0x180 + id);
    let statusword = Statusword::from_raw(0x0250);
    assert_eq!(TxPdo1::unpack(received.data())?, TxPdo1 { statusword });
    assert_eq!(statusword.state(), Some(State::SwitchOnDisabled));
    Ok(())
}

#[test]
fn emergencies_of_the_drive() -> Result<(), Error> {
    let Some((mut script, mut node)) = start("demo-emergency", FILE) else { return Ok(()) };
    let emergency = json!({ "do": "emergency", "code": 0x8611, "register": 0x21, "data": "0102030405" });
    script.ask(emergency);
    let emergency = node.emergency(PATIENCE)?.expect("an emergency message");
    assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
    assert_eq!((emergency.register, emergency.vendor), (0x21, [1, 2, 3, 4, 5]));
    assert!(!emergency.is_reset());
    script.ask(json!({ "do": "emergency", "code": 0, "register": 0, "data": "" }));
    let gone = node.emergency(PATIENCE)?.expect("an emergency message");
    assert!(gone.is_reset());
    Ok(())
}
