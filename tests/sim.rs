//! Tests drivers with simulated devices: the bindings of two drives on each of their buses.

use std::sync::Arc;
use std::time::Duration;

use lexibus::sim::{Connection, Device, Exception, Fault};
use lexibus::table::{AccessRights, Bound, Entry};
use lexibus::{
    AbortCode, Bus, CanOpen, Client, CoE, DataType, Error, Flags, Modbus, NodeId, Object, Pdo, Register, RegisterTable,
    SdoWrite, Timed, WalkError,
};
use lexibus_drives::demo_drive::types::{self, Command, Controlword, ModesOfOperation, State, Statusword};
use lexibus_drives::demo_drive::{self, objects, pdo, DemoDrive};
use lexibus_drives::vector_step::{self, VectorStep};

#[path = "support/now.rs"]
mod now;
use now::now;

const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};

fn demo() -> Device {
    Device::new(demo_drive::ENTRIES).with_node_id(NODE)
}

fn vector() -> Device {
    Device::new(vector_step::ENTRIES).with_node_id(NODE)
}

fn abort<T>(code: AbortCode) -> Result<T, Error<Fault>> {
    Err(Error::Abort(code))
}

fn exception<T>(exception: Exception) -> Result<T, Error<Fault>> {
    Err(Error::Client(Fault::Exception(exception)))
}

/// Returns the state of the drive after it receives a controlword (CiA 402-2 6.2).
fn after(state: State, controlword: u16) -> State {
    let is = |command: Command| controlword & command.mask() == command.value();
    match state {
        State::Fault if is(Command::FaultReset) => State::SwitchOnDisabled,
        State::Fault => State::Fault,
        _ if is(Command::DisableVoltage) => State::SwitchOnDisabled,
        State::SwitchOnDisabled | State::SwitchedOn if is(Command::Shutdown) => State::ReadyToSwitchOn,
        State::ReadyToSwitchOn | State::OperationEnabled if is(Command::SwitchOn) => State::SwitchedOn,
        State::SwitchedOn if is(Command::EnableOperation) => State::OperationEnabled,
        other => other,
    }
}

fn status(state: State) -> Statusword {
    Statusword::from_raw(match state {
        State::SwitchOnDisabled => 0x40,
        State::ReadyToSwitchOn => 0x21,
        State::SwitchedOn => 0x23,
        State::OperationEnabled => 0x27,
        _ => 0x08,
    })
}

/// Returns a simulated drive. Each write to the controlword updates the statusword. If the bit "new set-point" is set in
/// the written value, the actual position is set to the target position.
fn moving_drive() -> Device {
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::SwitchOnDisabled)).unwrap();
    device
        .on_write(objects::CONTROLWORD, |device, controlword| {
            let state = device.get(objects::STATUSWORD)?.state().ok_or(AbortCode::INTERNAL_INCOMPATIBLE)?;
            device.set(objects::STATUSWORD, status(after(state, controlword.raw())))?;
            if controlword.in_profile_position().new_set_point() {
                let target = device.get(objects::TARGET_POSITION)?;
                device.set(objects::POSITION_ACTUAL_VALUE, target)?;
            }
            Ok(())
        })
        .unwrap();
    device
}

#[test]
fn a_driver_enables_the_drive_and_moves_it() {
    let mut drive = DemoDrive::new(moving_drive().into_client::<CanOpen>());
    drive.walk(State::OperationEnabled, DEADLINE).unwrap();
    drive.modes_of_operation().write(ModesOfOperation::ProfilePosition).unwrap();
    drive.target_position().write(-4711).unwrap();
    drive.controlword().write(Controlword::from_raw(0x1F)).unwrap();
    assert_eq!(drive.position_actual_value().read(), Ok(-4711));
    assert_eq!(drive.client().device().get(objects::TARGET_POSITION), Ok(-4711));
}

/// Returns a drive in the state "Fault". Only a rising edge of bit 7 resets the fault (CiA 402-2 6.3). In the returned drive, this
/// bit is already set.
fn faulty_drive() -> Device {
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::Fault)).unwrap();
    device.set_initial(objects::CONTROLWORD, Controlword::from_raw(0x0180)).unwrap();
    let mut before = 0x0180;
    device
        .on_write(objects::CONTROLWORD, move |device, controlword| {
            let state = device.get(objects::STATUSWORD)?.state().ok_or(AbortCode::INTERNAL_INCOMPATIBLE)?;
            let is_edge = before & 0x80 == 0;
            before = controlword.raw();
            let is_ignored = state == State::Fault && !is_edge;
            device.set(objects::STATUSWORD, status(if is_ignored { state } else { after(state, before) }))
        })
        .unwrap();
    device
}

/// Maximum time that the tests wait.
const DEADLINE: Duration = Duration::from_secs(5);

#[test]
fn one_call_leads_a_faulty_drive_to_a_state() {
    let mut drive = DemoDrive::new(faulty_drive().into_client::<CanOpen>());
    assert_eq!(drive.walk(State::OperationEnabled, DEADLINE), Ok(()));
    assert_eq!(drive.statusword().read().map(Statusword::state), Ok(Some(State::OperationEnabled)));
    // Bit 8 keeps its value, because it belongs to no command.
    assert_eq!(drive.controlword().read(), Ok(Controlword::from_raw(0x010F)));
    assert_eq!(drive.walk(State::SwitchOnDisabled, DEADLINE), Ok(()));
    assert_eq!(drive.statusword().read().map(Statusword::state), Ok(Some(State::SwitchOnDisabled)));
    let never = drive.walk(State::FaultReactionActive, DEADLINE);
    assert_eq!(never, Err(WalkError::Unreachable { state: State::SwitchOnDisabled }));

    let mut drive = DemoDrive::new(Timed::new(faulty_drive().into_client::<CanOpen>(), |_| std::future::ready(())));
    assert_eq!(now(drive.walk_async(State::OperationEnabled, DEADLINE)), Ok(()));
}

#[test]
fn a_fault_on_the_way_has_a_code() {
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::SwitchOnDisabled)).unwrap();
    let code = objects::pre_defined_error_field::PRE_DEFINED_ERROR_FIELD1;
    device
        .on_write(objects::CONTROLWORD, move |device, _| {
            device.set(code, types::ErrorFieldEntry::from_raw(0x1234_8611))?;
            device.set(objects::STATUSWORD, status(State::Fault))
        })
        .unwrap();
    let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
    let error = drive.walk(State::OperationEnabled, DEADLINE).unwrap_err();
    assert_eq!(error, WalkError::Fault { state: State::Fault, code: Some(0x8611) });
    assert_eq!(error.to_string(), "a fault occurred: the device is in the state \"fault\", error code 0x8611");
}

#[test]
fn a_drive_that_does_not_move_on() {
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::SwitchOnDisabled)).unwrap();
    let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
    let late = drive.walk(State::OperationEnabled, Duration::from_millis(20)).unwrap_err();
    assert_eq!(late, WalkError::Deadline { state: Some(State::SwitchOnDisabled), status: 0x40 });
    assert_eq!(late.to_string(), "timeout: the device is still in the state \"switch on disabled\"");
    // A fault whose cause persists cannot be reset.
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::Fault)).unwrap();
    let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
    let stays = drive.walk(State::OperationEnabled, Duration::from_millis(20)).unwrap_err();
    assert!(matches!(stays, WalkError::Fault { state: State::Fault, .. }), "{stays}");
}

#[test]
fn process_data_go_both_ways() {
    let mut device = moving_drive();
    for write in pdo::RxPdo2::configuration(NODE).iter().chain(&pdo::TxPdo2::configuration(NODE)) {
        write.send(&mut device.client::<CanOpen>()).unwrap();
    }
    device.set(objects::STATUSWORD, status(State::OperationEnabled)).unwrap();
    // The target position follows the controlword in the PDO. The device stores the target position before it reacts to
    // the controlword.
    let frame = pdo::RxPdo2 { controlword: Controlword::from_raw(0x1F), target_position: 250_000 };
    assert_eq!(device.receive_pdo(pdo::RxPdo2::INDEX, &frame.pack()), Ok(()));
    let answer = pdo::TxPdo2::unpack(&device.transmit_pdo(pdo::TxPdo2::INDEX).unwrap()).unwrap();
    assert_eq!(answer.position_actual_value, 250_000);
    assert_eq!(answer.statusword.state(), Some(State::OperationEnabled));
    assert_eq!(device.receive_pdo(pdo::RxPdo2::INDEX, &[0; 5]), Err(AbortCode::TOO_SHORT));
    // The target position in the PDO exceeds its limit, but the device accepts the controlword.
    let frame = pdo::RxPdo2 { controlword: Controlword::from_raw(0), target_position: 1_000_001 };
    assert_eq!(device.receive_pdo(pdo::RxPdo2::INDEX, &frame.pack()), Err(AbortCode::TOO_HIGH));
    assert_eq!(device.get(objects::TARGET_POSITION), Ok(250_000));
    assert_eq!(device.get(objects::CONTROLWORD), Ok(Controlword::from_raw(0)));
    assert_eq!(device.transmit_pdo(0x1A07), Err(AbortCode::NO_OBJECT));
}

#[test]
fn a_mapping_of_ones_own() {
    let mut device = demo();
    let mut client = device.client::<CanOpen>();
    let mut send =
        |writes: &[SdoWrite]| writes.iter().try_for_each(|write| write.send(&mut client)).map_err(Error::from);
    let unused = SdoWrite::new_u32(0x1800, 1, 0x8000_0185);
    let clear = SdoWrite::new_u8(0x1A00, 0, 0);
    let word = |sub, word| SdoWrite::new_u32(0x1A00, sub, word);
    // The mapping cannot be changed while the PDO is enabled or its number of entries is not 0.
    assert_eq!(send(&[clear]), abort(AbortCode::INVALID_VALUE));
    assert_eq!(send(&[unused, word(1, 0x6064_0020)]), abort(AbortCode::INVALID_VALUE));
    assert_eq!(send(&[clear, word(1, 0x6064_0020)]), Ok(()));
    assert_eq!(send(&[word(1, 0x6083_0020)]), abort(AbortCode::NOT_MAPPABLE));
    assert_eq!(send(&[word(1, 0x6064_0010)]), abort(AbortCode::NOT_MAPPABLE));
    assert_eq!(send(&[word(1, 0x5000_0020)]), abort(AbortCode::NO_OBJECT));
    assert_eq!(send(&[word(1, 0x6064_0120)]), abort(AbortCode::NO_SUB_INDEX));
    assert_eq!(send(&[SdoWrite::new_u8(0x1A00, 0, 2)]), abort(AbortCode::INVALID_VALUE));
    assert_eq!(send(&[word(1, 0), SdoWrite::new_u8(0x1A00, 0, 1)]), abort(AbortCode::INVALID_VALUE));
    // The device rejects COB-IDs of other services, and changes to the COB-ID of an enabled PDO.
    assert_eq!(send(&[SdoWrite::new_u32(0x1800, 1, 0x605)]), abort(AbortCode::INVALID_VALUE));
    assert_eq!(send(&[word(1, 0x6064_0020), SdoWrite::new_u8(0x1A00, 0, 1)]), Ok(()));
    assert_eq!(send(&[SdoWrite::new_u32(0x1800, 1, 0x1B5)]), Ok(()));
    assert_eq!(send(&[SdoWrite::new_u32(0x1800, 1, 0x1B6)]), abort(AbortCode::INVALID_VALUE));
    assert_eq!(send(&[SdoWrite::new_u8(0x1800, 2, 245)]), abort(AbortCode::INVALID_VALUE));
    device.set(objects::POSITION_ACTUAL_VALUE, -2).unwrap();
    assert_eq!(device.transmit_pdo(0x1A00), Ok(vec![0xFE, 0xFF, 0xFF, 0xFF]));
}

#[test]
fn a_frame_has_64_bits_on_can_only() {
    let entries: Vec<Entry> = vector_step::ENTRIES.to_vec();
    let mapping = entries.iter().find(|entry| entry.object == Some(Object::new(0x1600, 3)));
    assert!(mapping.is_some(), "the first mapping has at least three entries");
    let clear = [SdoWrite::new_u32(0x1400, 1, 0x8000_0205), SdoWrite::new_u8(0x1600, 0, 0)];
    let map: Vec<SdoWrite> = (1..=3).map(|sub| SdoWrite::new_u32(0x1600, sub, 0x607A_0020)).collect();
    let count = SdoWrite::new_u8(0x1600, 0, 3);
    let mut device = vector();
    let mut client = device.client::<CanOpen>();
    clear.iter().chain(&map).try_for_each(|write| write.send(&mut client)).unwrap();
    assert_eq!(count.send(&mut client).map_err(Error::from), abort(AbortCode::PDO_LENGTH));
    // EtherCAT has no COB-IDs. If mapping entries are written before sub-index 0 is cleared, the abort codes on
    // EtherCAT and CANopen differ.
    let mut device = vector();
    let mut client = device.client::<CoE>();
    assert_eq!(map[0].send(&mut client).map_err(Error::from), abort(AbortCode(0x0601_0003)));
    clear[1..].iter().chain(&map).try_for_each(|write| write.send(&mut client)).unwrap();
    assert_eq!(count.send(&mut client), Ok(()));
    assert_eq!(device.transmit_pdo(0x1600).map(|data| data.len()), Ok(12));
}

/// Returns a value to write to the entry: its maximum, its minimum if it has no maximum, or 1 if it has no integer limit. An entry
/// without a fixed length gets a text.
fn another(entry: &Entry) -> Vec<u8> {
    let Some(bits) = entry.data_type.bits() else { return b"ab".to_vec() };
    let bytes = match (entry.high, entry.low) {
        (Bound::Signed(value), _) | (Bound::Unlimited, Bound::Signed(value)) => value.to_le_bytes(),
        (Bound::Unsigned(value), _) | (Bound::Unlimited, Bound::Unsigned(value)) => value.to_le_bytes(),
        _ => [1, 0, 0, 0, 0, 0, 0, 0],
    };
    bytes[..bits.div_ceil(8) as usize].to_vec()
}

/// Returns whether writing the object executes a command, or is possible only at certain times.
fn is_special(object: Object) -> bool {
    matches!(object.index, 0x1003 | 0x1010 | 0x1011 | 0x1400..=0x1BFF)
}

fn objects_round_trip<B>(mut device: Device, entries: &[Entry])
where
    B: Bus<Address = Object> + 'static,
    for<'d> Connection<B, &'d mut Device>: Client<Bus = B, Error = Fault>,
{
    let mut written = 0;
    for entry in entries {
        let Some(object) = entry.object else { continue };
        let held = device.bytes(object).unwrap().to_vec();
        let (value, mut buffer) = (another(entry), [0; 64]);
        let mut client = device.client::<B>();
        match client.read(object, &mut buffer) {
            Ok(length) => assert_eq!(buffer[..length], held, "{object}"),
            Err(error) => {
                assert_eq!((entry.access, error), (AccessRights::WriteOnly, Error::Abort(AbortCode::WRITE_ONLY)));
            }
        }
        match client.write(object, &value) {
            Ok(()) => {
                written += 1;
                assert_eq!(device.bytes(object), Ok(value.as_slice()), "{object}");
            }
            Err(error) if is_special(object) => assert!(matches!(error, Error::Abort(_))),
            Err(error) => {
                assert!(matches!(entry.access, AccessRights::ReadOnly | AccessRights::Constant), "{object}");
                assert_eq!(error, Error::Abort(AbortCode::READ_ONLY), "{object}");
            }
        }
    }
    assert!(written > 5);
}

#[test]
fn every_object_is_read_and_written() {
    objects_round_trip::<CanOpen>(demo(), demo_drive::ENTRIES);
    objects_round_trip::<CanOpen>(vector(), vector_step::ENTRIES);
    objects_round_trip::<CoE>(vector(), vector_step::ENTRIES);
}

#[test]
fn every_register_is_read_and_written() {
    let mut device = vector();
    let mut written = 0;
    for entry in vector_step::ENTRIES {
        // Skip the block of program registers, because reading it needs several requests.
        let Some(register) = entry.register.filter(|register| register.count < 100) else { continue };
        let length = entry.data_type.bits().map_or(2 * usize::from(register.count), |bits| bits.div_ceil(8) as usize);
        let (mut buffer, value) = (vec![0; length], another(entry));
        let mut client = device.client::<Modbus>();
        match client.write(register, &value) {
            Ok(()) => written += 1,
            Err(error) => {
                assert!(matches!(entry.access, AccessRights::ReadOnly | AccessRights::Constant), "{entry:?}");
                assert_eq!(error, Error::Client(Fault::Exception(Exception::IllegalDataAddress)), "{entry:?}");
                continue;
            }
        }
        if entry.access == AccessRights::WriteOnly {
            assert_eq!(client.read(register, &mut buffer), exception(Exception::IllegalDataAddress));
            continue;
        }
        assert_eq!(client.read(register, &mut buffer), Ok(length));
        assert_eq!(buffer[..value.len()], value, "{entry:?}");
        // The object of an item must have the same value as its register.
        if let Some(object) = entry.object {
            assert_eq!(device.bytes(object).map(|bytes| bytes[0]), Ok(value[0]), "{entry:?}");
        }
    }
    assert!(written > 200, "{written}");
}

#[test]
fn what_an_object_refuses() {
    let mut device = demo();
    let mut client = device.client::<CanOpen>();
    let mut write = |index, sub_index, data: &[u8]| client.write(Object::new(index, sub_index), data);
    assert_eq!(write(0x5000, 0, &[0]), abort(AbortCode::NO_OBJECT));
    assert_eq!(write(0x6040, 1, &[0]), abort(AbortCode::NO_SUB_INDEX));
    assert_eq!(write(0x6041, 0, &[0, 0]), abort(AbortCode::READ_ONLY));
    assert_eq!(write(0x1008, 0, b"x"), abort(AbortCode::READ_ONLY));
    assert_eq!(write(0x6040, 0, &[0]), abort(AbortCode::TOO_SHORT));
    assert_eq!(write(0x6040, 0, &[0; 3]), abort(AbortCode::TOO_LONG));
    assert_eq!(write(0x607A, 0, &1_000_001_i32.to_le_bytes()), abort(AbortCode::TOO_HIGH));
    assert_eq!(write(0x607A, 0, &(-1_000_001_i32).to_le_bytes()), abort(AbortCode::TOO_LOW));
    assert_eq!(write(0x6083, 0, &[0; 4]), abort(AbortCode::TOO_LOW));
    let mut buffer = [0; 64];
    assert_eq!(client.read(Object::new(0x2002, 0), &mut buffer), abort(AbortCode::WRITE_ONLY));
    assert_eq!(client.read(Object::new(0x1018, 9), &mut buffer), abort(AbortCode::NO_SUB_INDEX));
}

#[test]
fn values_of_every_kind() {
    let mut drive = DemoDrive::new(demo().into_client::<CanOpen>());
    let mut buffer = [0; 64];
    assert_eq!(drive.manufacturer_device_name().read_into(&mut buffer), Ok("Demo Drive"));
    drive.application_name().write("a longer name of this axis").unwrap();
    assert_eq!(drive.application_name().read_into(&mut buffer), Ok("a longer name of this axis"));
    drive.firmware_image().write(&[7; 300]).unwrap();
    let device = drive.client().device();
    assert_eq!(device.bytes(objects::FIRMWARE_IMAGE), Ok([7; 300].as_slice()));
    device.set(objects::ENCODER_COUNTS, -3).unwrap();
    device.set(objects::MOTOR_TEMPERATURE, 36.5).unwrap();
    device.set(objects::POSITION_ACTUAL_VALUE, i32::MIN).unwrap();
    assert_eq!(drive.encoder_counts().read(), Ok(-3));
    assert_eq!(drive.motor_temperature().read(), Ok(36.5));
    assert_eq!(drive.position_actual_value().read(), Ok(i32::MIN));
    assert_eq!(drive.cob_id_emcy().read().map(|cob_id| cob_id.raw()), Ok(0x85));
    // The constants in `vector_step::objects` belong to another device.
    let device = drive.client().device();
    assert_eq!(device.get(vector_step::objects::RPOSTARG), Err(AbortCode::NO_OBJECT));
    assert_eq!(device.set_bytes(objects::ENCODER_COUNTS, &[0; 4]), Err(AbortCode::TOO_LONG));
}

#[test]
fn reactions_refuse_and_see_everything() {
    let mut device = demo();
    let seen = Arc::new(std::sync::Mutex::new(Vec::new()));
    let list = seen.clone();
    device.on_any_write(move |_, entry| {
        list.lock().unwrap().push(entry.name);
        Ok(())
    });
    let allowed = |mode: ModesOfOperation| matches!(mode.raw(), 1 | 3 | 6);
    device
        .on_write(objects::MODES_OF_OPERATION, move |device, mode| {
            if !allowed(mode) {
                return Err(AbortCode::INVALID_VALUE);
            }
            device.set(objects::MODES_OF_OPERATION_DISPLAY, mode)
        })
        .unwrap();
    let mut drive = DemoDrive::new(device.client::<CanOpen>());
    drive.modes_of_operation().write(ModesOfOperation::Homing).unwrap();
    let refused = drive.modes_of_operation().write(ModesOfOperation::from_raw(7)).map_err(Error::from);
    assert_eq!(refused, abort(AbortCode::INVALID_VALUE));
    assert_eq!(drive.modes_of_operation().read(), Ok(ModesOfOperation::Homing));
    assert_eq!(drive.modes_of_operation_display().read(), Ok(ModesOfOperation::Homing));
    assert_eq!(*seen.lock().unwrap(), ["Modes of operation"; 2]);
    let missing = device.on_write(vector_step::objects::RPOSTARG, |_, _| Ok(()));
    assert_eq!(missing, Err(AbortCode::NO_OBJECT));
}

#[test]
fn a_server_may_have_the_device_in_another_thread() {
    let mut device = vector();
    let server = std::thread::spawn(move || device.read_words(RegisterTable::Holding, 8, 2));
    assert_eq!(server.join().unwrap(), Ok(vec![0, 0]));
}

#[test]
fn faults_of_ones_choosing() {
    let mut device = demo();
    device.fail_next(AbortCode::HARDWARE);
    device.fail_next(Fault::Bus);
    let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
    assert_eq!(drive.statusword().read().map(|_| ()).map_err(Error::from), abort(AbortCode::HARDWARE));
    assert_eq!(drive.controlword().write(Controlword::new()).map_err(Error::from), Err(Error::Client(Fault::Bus)));
    assert!(drive.statusword().read().is_ok());
    let mut device = vector();
    device.fail_next(Exception::ServerDeviceFailure);
    let mut drive = VectorStep::new(device.client::<Modbus>());
    assert_eq!(drive.rpostarg().read().map_err(Error::from), exception(Exception::ServerDeviceFailure));
}

#[test]
fn parameters_are_stored() {
    let mut drive = DemoDrive::new(demo().into_client::<CanOpen>());
    drive.profile_velocity().write(7).unwrap();
    assert_eq!(drive.client().write(Object::new(0x1010, 1), b"SAVE"), abort(AbortCode::CANNOT_STORE));
    drive.client().write(Object::new(0x1010, 1), b"save").unwrap();
    drive.profile_velocity().write(8).unwrap();
    drive.profile_acceleration().write(9).unwrap();
    drive.client().device().power_cycle();
    assert_eq!(drive.profile_velocity().read(), Ok(7));
    assert_eq!(drive.profile_acceleration().read(), Ok(10_000));
    // The object does not store the signature. Reading the object returns the storage capabilities of the device.
    assert_eq!(drive.client().device().bytes(Object::new(0x1010, 1)), Ok([1, 0, 0, 0].as_slice()));
}

/// An entry without an address, from which the tests create other entries.
const BLANK: Entry = Entry {
    object: None,
    register: None,
    name: "",
    data_type: DataType::Unsigned8,
    access: AccessRights::ReadWrite,
    flags: Flags::NONE,
    initial: lexibus::RawInitial::Unknown,
    configured: None,
    low: Bound::Unlimited,
    high: Bound::Unlimited,
    unit: "",
};

fn object(index: u16, sub_index: u8, data_type: DataType) -> Entry {
    Entry { object: Some(Object::new(index, sub_index)), data_type, ..BLANK }
}

#[test]
fn parameters_are_restored_by_groups() {
    const ALL: [u16; 3] = [0x1005, 0x2000, 0x6000];
    let mut entries: Vec<Entry> = ALL.map(|index| object(index, 0, DataType::Unsigned8)).into();
    for command in [0x1010, 0x1011] {
        entries.extend((1..=4).map(|group| object(command, group, DataType::Unsigned32)));
    }
    // Each sub-index is listed with the objects that it restores (CiA 301 7.5.2.14).
    for (group, restored) in [(1, &ALL[..]), (2, &ALL[..1]), (3, &ALL[2..]), (4, &ALL[1..2])] {
        let mut device = Device::new(&entries);
        ALL.iter().for_each(|index| device.set_bytes(Object::new(*index, 0), &[7]).unwrap());
        let mut client = device.client::<CanOpen>();
        client.write(Object::new(0x1010, 1), b"save").unwrap();
        assert_eq!(client.write(Object::new(0x1011, group), b"LOAD"), abort(AbortCode::CANNOT_STORE));
        client.write(Object::new(0x1011, group), b"load").unwrap();
        let before = ALL.map(|index| device.bytes(Object::new(index, 0)).unwrap()[0]);
        assert_eq!(before, [7; 3], "values are restored at the next power-on");
        device.power_cycle();
        for index in ALL {
            let expected = if restored.contains(&index) { 0 } else { 7 };
            assert_eq!(device.bytes(Object::new(index, 0)), Ok([expected].as_slice()), "{group}: {index:#X}");
        }
    }
}

#[test]
fn errors_are_forgotten_by_a_zero() {
    let mut entries = [object(0x1003, 0, DataType::Unsigned8), object(0x1003, 1, DataType::Unsigned32)];
    entries[0].initial = lexibus::RawInitial::Bytes(&[1]);
    let mut device = Device::new(&entries);
    let count = Object::new(0x1003, 0);
    assert_eq!(
        device.bytes(count),
        Ok([0].as_slice()),
        "the description states the capacity, not the number of errors"
    );
    device.emit_emergency(0x8110, 0x11, [0; 5]);
    assert_eq!(device.bytes(count), Ok([1].as_slice()));
    let mut client = device.client::<CanOpen>();
    assert_eq!(client.write(count, &[1]), abort(AbortCode::INVALID_VALUE));
    client.write(count, &[0]).unwrap();
    assert_eq!(device.bytes(count), Ok([0].as_slice()));
    assert_eq!(device.bytes(Object::new(0x1003, 1)), Ok([0; 4].as_slice()));
}

#[test]
fn process_images_of_ethercat() {
    let word = |index, sub_index| object(index, sub_index, DataType::Unsigned16);
    let mapping = |index, sub_index| object(index, sub_index, DataType::Unsigned32);
    let mut entries = vec![word(0x2000, 0), object(0x2001, 0, DataType::Unsigned8)];
    for assignment in [0x1C12, 0x1C13] {
        entries.extend([object(assignment, 0, DataType::Unsigned8), word(assignment, 1), word(assignment, 2)]);
    }
    for pdo in [0x1600, 0x1601] {
        entries.extend([object(pdo, 0, DataType::Unsigned8), mapping(pdo, 1), mapping(pdo, 2)]);
    }
    let mut device = Device::new(&entries);
    let mut set = |index, sub_index, bytes: &[u8]| device.set_bytes(Object::new(index, sub_index), bytes).unwrap();
    // The first PDO contains a word and a gap of 8 bits. The second PDO contains a byte.
    for (index, mapped) in [(0x1600, [0x2000_0010_u32, 0x0000_0008]), (0x1601, [0x2001_0008, 0])] {
        set(index, 0, &[if index == 0x1600 { 2 } else { 1 }]);
        set(index, 1, &mapped[0].to_le_bytes());
        set(index, 2, &mapped[1].to_le_bytes());
    }
    for assignment in [0x1C12, 0x1C13] {
        set(assignment, 0, &[2]);
        set(assignment, 1, &[0x00, 0x16]);
        set(assignment, 2, &[0x01, 0x16]);
    }
    assert_eq!(device.receive_image(0x1C12, &[0x34, 0x12, 0xFF, 0x56]), Ok(()));
    assert_eq!(device.bytes(Object::new(0x2000, 0)), Ok([0x34, 0x12].as_slice()));
    assert_eq!(device.bytes(Object::new(0x2001, 0)), Ok([0x56].as_slice()));
    assert_eq!(device.transmit_image(0x1C13), Ok(vec![0x34, 0x12, 0, 0x56]));
    assert_eq!(device.receive_image(0x1C12, &[0; 3]), Err(AbortCode::TOO_SHORT));
    assert_eq!(device.transmit_image(0x1C14), Err(AbortCode::NO_OBJECT));
    // The device refuses one of the two values. It must keep the old value of this object, and store the new value of the other.
    device.on_any_write(|_, entry| match entry.object {
        Some(Object { index: 0x2000, .. }) => Err(AbortCode::INVALID_VALUE),
        _ => Ok(()),
    });
    assert_eq!(device.receive_image(0x1C12, &[1, 1, 1, 1]), Err(AbortCode::INVALID_VALUE));
    assert_eq!(device.transmit_image(0x1C13), Ok(vec![0x34, 0x12, 0, 1]));
    device.set_bytes(Object::new(0x1601, 1), &0x2002_0008_u32.to_le_bytes()).unwrap();
    assert_eq!(device.transmit_image(0x1C13), Err(AbortCode::NO_OBJECT), "a mapped object that does not exist");
}

#[test]
fn values_after_power_on() {
    let mut device = demo();
    device.set_initial(objects::STATUSWORD, status(State::SwitchedOn)).unwrap();
    device.set_initial_bytes(objects::APPLICATION_NAME, b"left").unwrap();
    device.set(objects::STATUSWORD, status(State::Fault)).unwrap();
    device.set_bytes(objects::APPLICATION_NAME, b"right").unwrap();
    device.power_cycle();
    assert_eq!(device.get(objects::STATUSWORD), Ok(status(State::SwitchedOn)));
    assert_eq!(device.bytes(objects::APPLICATION_NAME), Ok(b"left".as_slice()));
}

#[test]
fn one_value_on_three_buses() {
    let mut device = vector();
    VectorStep::new(device.client::<Modbus>()).rpostarg().write(-100_000).unwrap();
    assert_eq!(VectorStep::new(device.client::<CanOpen>()).rpostarg().read(), Ok(-100_000));
    assert_eq!(VectorStep::new(device.client::<CoE>()).rpostarg().read(), Ok(-100_000));
    VectorStep::new(device.client::<CoE>()).rpostarg().write(7).unwrap();
    assert_eq!(device.read_words(RegisterTable::Holding, 8, 2), Ok(vec![7, 0]));
    device.set(vector_step::objects::RPOSTARG, -1).unwrap();
    assert_eq!(device.read_words(RegisterTable::Holding, 8, 2), Ok(vec![0xFFFF; 2]));
    let reacted = device.on_write(vector_step::objects::RPOSTARG, |_, _| Err(AbortCode::DEVICE_STATE));
    assert_eq!(reacted, Ok(()));
    let refused = device.write_words(RegisterTable::Holding, 8, &[1, 2]);
    assert_eq!(refused, Err(Exception::ServerDeviceFailure));
    assert_eq!(device.get(vector_step::objects::RPOSTARG), Ok(-1));
    assert_eq!(device.read_words(RegisterTable::Holding, 8, 2), Ok(vec![0xFFFF; 2]));
}

#[test]
fn blocks_of_registers() {
    let mut device = vector();
    let holding = |entry: &&Entry| entry.register.is_some_and(|register| register.table == RegisterTable::Holding);
    let registers: Vec<Register> =
        vector_step::ENTRIES.iter().filter(holding).filter_map(|entry| entry.register).collect();
    let covered = |address: u16| {
        registers.iter().any(|register| (register.address..register.address + register.count).contains(&address))
    };
    let hole = (1..).find(|address| covered(address - 1) && !covered(*address)).unwrap();
    let first = (0..).find(|first| (*first..first + 20).all(covered)).unwrap();
    let read = |device: &mut Device, address, count| device.read_words(RegisterTable::Holding, address, count);
    assert_eq!(read(&mut device, first, 20).map(|words| words.len()), Ok(20));
    assert_eq!(read(&mut device, hole - 1, 1).map(|words| words.len()), Ok(1));
    assert_eq!(read(&mut device, hole - 1, 2), Err(Exception::IllegalDataAddress));
    assert_eq!(read(&mut device, u16::MAX, 2), Err(Exception::IllegalDataAddress));
    assert_eq!(read(&mut device, first, 0), Err(Exception::IllegalDataValue));
    assert_eq!(read(&mut device, first, 126), Err(Exception::IllegalDataValue));
    assert_eq!(device.read_words(RegisterTable::Input, 0, 1), Err(Exception::IllegalDataAddress));
    assert_eq!(device.read_words(RegisterTable::Coil, 0, 1), Err(Exception::IllegalFunction));
    assert_eq!(device.write_words(RegisterTable::Input, 0, &[0]), Err(Exception::IllegalFunction));
    assert_eq!(device.write_words(RegisterTable::Holding, hole, &[0]), Err(Exception::IllegalDataAddress));
    let mut device = device.with_modbus_limits(20, 2);
    assert_eq!(read(&mut device, first, 21), Err(Exception::IllegalDataValue));
    assert_eq!(device.write_words(RegisterTable::Holding, 8, &[0; 3]), Err(Exception::IllegalDataValue));
}

#[test]
fn an_axis_is_enabled_step_by_step() {
    use vector_step::objects::{CONTROLWORD, STATUSWORD};
    use vector_step::types::{Controlword, State, Statusword};
    let mut device = vector().with_axes(&vector_step::AXES);
    device.axis(2).set(STATUSWORD, Statusword::from_raw(0x40)).unwrap();
    let follows = |device: &mut Device, controlword: Controlword| {
        let status = match controlword.raw() & 0x0F {
            0x06 => 0x21,
            0x07 => 0x23,
            0x0F => 0x27,
            _ => 0x40,
        };
        device.axis(2).set(STATUSWORD, Statusword::from_raw(status))
    };
    device.axis(2).on_write(CONTROLWORD, follows).unwrap();
    let mut drive = VectorStep::new(device.into_client::<CanOpen>());
    let mut axis = drive.axis(2);
    axis.walk(State::OperationEnabled, DEADLINE).unwrap();
    assert_eq!(axis.statusword().read().unwrap().state(), Some(State::OperationEnabled));
    // The state of the first axis must be unchanged.
    assert_ne!(drive.statusword().read().unwrap().raw(), 0x27);
}

#[test]
fn each_axis_has_its_objects() {
    let mut drive = VectorStep::new(vector().with_axes(&vector_step::AXES).into_client::<CanOpen>());
    drive.axis(2).target_position().write(200).unwrap();
    drive.target_position().write(100).unwrap();
    drive.axis(3).rpostarg().write(3).unwrap();
    let device = drive.client().device();
    assert_eq!(device.bytes(Object::new(0x687A, 0)).map(|bytes| bytes[0]), Ok(200));
    assert_eq!(device.bytes(Object::new(0x2008, 3)), Ok([3, 0, 0, 0].as_slice()));
    assert_eq!(device.axis(2).get(vector_step::objects::TARGET_POSITION), Ok(200));
    assert_eq!(device.get(vector_step::objects::TARGET_POSITION), Ok(100));
    assert_eq!(device.axis(4).get(vector_step::objects::TARGET_POSITION), Err(AbortCode::NO_OBJECT));
    let statusword = vector_step::types::Statusword::from_raw(0x37);
    device
        .axis(2)
        .on_write(vector_step::objects::CONTROLWORD, move |device, _| {
            device.axis(2).set(vector_step::objects::STATUSWORD, statusword)
        })
        .unwrap();
    drive.controlword().write(vector_step::types::Controlword::from_raw(15)).unwrap();
    assert_ne!(drive.axis(2).statusword().read(), Ok(statusword));
    drive.axis(2).controlword().write(vector_step::types::Controlword::from_raw(15)).unwrap();
    assert_eq!(drive.axis(2).statusword().read(), Ok(statusword));
}

#[test]
fn errors_are_listed() {
    let mut device = demo();
    device.emit_emergency(0x8110, 0x11, [1, 2, 3, 4, 5]);
    device.emit_emergency(0x2310, 0x03, [0; 5]);
    let data: Vec<[u8; 8]> = device.take_emergencies().map(|emergency| emergency.to_bytes()).collect();
    assert_eq!(data, [[0x10, 0x81, 0x11, 1, 2, 3, 4, 5], [0x10, 0x23, 0x03, 0, 0, 0, 0, 0]]);
    let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
    assert_eq!(drive.error_register().read().map(|value| value.raw()), Ok(3));
    let mut list = drive.pre_defined_error_field();
    assert_eq!(list.pre_defined_error_field1().read().map(|value| value.raw()), Ok(0x2310));
    assert_eq!(list.pre_defined_error_field2().read().map(|value| value.raw()), Ok(0x0201_8110));
}

#[test]
fn a_device_that_is_only_on_modbus() {
    const fn entry(register: Register, data_type: DataType, access: AccessRights) -> Entry {
        Entry { register: Some(register), data_type, access, ..BLANK }
    }
    const STATUS: Register = Register::holding(5);
    const FAULT: Register = Register::holding(5).part(3, 1);
    const READY: Register = Register::holding(5).part(0, 2);
    const SPEED: Register = Register::high_first(6, 2);
    const OUTPUT: Register = Register::new(RegisterTable::Coil, 0, 1);
    const LIMIT: Register = Register::new(RegisterTable::DiscreteInput, 9, 1);
    let mut speed = entry(SPEED, DataType::Integer32, AccessRights::ReadWrite);
    speed.high = Bound::Signed(70_000);
    let entries = [
        entry(STATUS, DataType::Unsigned16, AccessRights::ReadOnly),
        entry(FAULT, DataType::Boolean, AccessRights::ReadWrite),
        entry(READY, DataType::Bits(2), AccessRights::ReadOnly),
        speed,
        entry(OUTPUT, DataType::Boolean, AccessRights::ReadWrite),
        entry(LIMIT, DataType::Boolean, AccessRights::ReadOnly),
    ];
    let mut device = Device::new(&entries);
    // Items that share bits must have consistent values.
    device.set_bytes(STATUS, &[0x0B, 0x80]).unwrap();
    assert_eq!((device.bytes(FAULT), device.bytes(READY)), (Ok([1].as_slice()), Ok([3].as_slice())));
    device.set_bytes(READY, &[1]).unwrap();
    assert_eq!(device.bytes(STATUS), Ok([0x09, 0x80].as_slice()));
    // A write must change only the writable bits of a register.
    device.write_words(RegisterTable::Holding, 5, &[0]).unwrap();
    assert_eq!(device.read_words(RegisterTable::Holding, 5, 1), Ok(vec![0x8001]));
    let mut client = device.client::<Modbus>();
    client.write(FAULT, &[1]).unwrap();
    assert_eq!(client.write(STATUS, &[0, 0]), Ok(()));
    client.write(SPEED, &70_000_i32.to_le_bytes()).unwrap();
    assert_eq!(client.write(SPEED, &70_001_i32.to_le_bytes()), exception(Exception::IllegalDataValue));
    assert_eq!(device.read_words(RegisterTable::Holding, 5, 3), Ok(vec![0x8001, 1, 0x1170]));
    // A write to one of a value's two registers must change only this register.
    device.write_words(RegisterTable::Holding, 7, &[9]).unwrap();
    assert_eq!(device.bytes(SPEED), Ok(0x0001_0009_i32.to_le_bytes().as_slice()));
    let mut client = device.client::<Modbus>();
    client.write(OUTPUT, &[1]).unwrap();
    assert_eq!(client.write(LIMIT, &[1]), exception(Exception::IllegalFunction));
    assert_eq!(device.read_bits(RegisterTable::Coil, 0, 1), Ok(vec![true]));
    assert_eq!(device.read_bits(RegisterTable::Coil, 0, 2), Err(Exception::IllegalDataAddress));
    device.write_bits(RegisterTable::Coil, 0, &[false]).unwrap();
    device.set_bytes(LIMIT, &[1]).unwrap();
    assert_eq!(device.read_bits(RegisterTable::DiscreteInput, 9, 1), Ok(vec![true]));
    let mut bit = [7];
    assert_eq!(device.client::<Modbus>().read(OUTPUT, &mut bit), Ok(1));
    assert_eq!(bit, [0]);
}

#[test]
fn without_blocking() {
    let mut drive = VectorStep::new(vector().into_client::<Modbus>());
    let read = now(async {
        drive.rpostarg().write_async(5).await?;
        drive.rpostarg().read_async().await
    });
    assert_eq!(read, Ok(5));
    let mut drive = DemoDrive::new(demo().into_client::<CanOpen>());
    assert_eq!(now(drive.profile_velocity().read_async()), Ok(1000));
}

/// Tests the same drivers with the real SDO client, frame by frame.
#[cfg(feature = "canopen")]
mod frames {
    use std::time::Duration;

    use lexibus::clients::canopen::{CanFrame, NmtCommand, NmtState, Node};
    use lexibus::sim::CanNode;

    use lexibus_drives::demo_drive::codes::DriveErrors;

    use super::*;

    const PATIENCE: Duration = Duration::from_millis(100);

    fn receive(node: &mut CanNode, id: u32) -> CanFrame {
        let frame = lexibus::clients::canopen::CanPort::receive(node, PATIENCE, &mut |frame| frame.id() == id);
        frame.unwrap().expect("a frame")
    }

    #[test]
    fn a_driver_over_sdo_and_pdo() {
        let mut drive = DemoDrive::new(Node::new(CanNode::new(moving_drive()), NODE));
        drive.walk(State::OperationEnabled, DEADLINE).unwrap();
        for write in pdo::RxPdo2::configuration(NODE).iter().chain(&pdo::TxPdo2::configuration(NODE)) {
            write.send(drive.client()).unwrap();
        }
        let node = drive.client();
        node.nmt(NmtCommand::Start).unwrap();
        // TPDO 1 is event-driven. The node sends this TPDO as soon as it enters the state "Operational".
        let first = receive(node.port(), 0x185);
        assert_eq!(pdo::TxPdo1::unpack(first.data()).unwrap().statusword.state(), Some(State::OperationEnabled));
        let frame = pdo::RxPdo2 { controlword: Controlword::from_raw(0x1F), target_position: -70_000 };
        node.send(&CanFrame::new(0x305, &frame.pack()).unwrap()).unwrap();
        node.sync().unwrap();
        let answer = receive(node.port(), 0x285);
        assert_eq!(pdo::TxPdo2::unpack(answer.data()).unwrap().position_actual_value, -70_000);
        assert_eq!(drive.target_position().read(), Ok(-70_000));
    }

    #[test]
    fn every_kind_of_value_and_abort() {
        let mut drive = DemoDrive::new(Node::new(CanNode::new(demo()), NODE));
        let mut buffer = [0; 64];
        assert_eq!(drive.manufacturer_device_name().read_into(&mut buffer), Ok("Demo Drive"));
        drive.application_name().write("a longer name of this axis").unwrap();
        assert_eq!(drive.application_name().read_into(&mut buffer), Ok("a longer name of this axis"));
        drive.firmware_image().write(&[7; 300]).unwrap();
        drive.client().port().device().set(objects::ENCODER_COUNTS, -3).unwrap();
        assert_eq!(drive.encoder_counts().read(), Ok(-3));
        let mut write = |index, sub, data: &[u8]| drive.client().write(Object::new(index, sub), data);
        let codes = [
            (write(0x5000, 0, &[0]), AbortCode::NO_OBJECT),
            (write(0x6040, 1, &[0]), AbortCode::NO_SUB_INDEX),
            (write(0x6041, 0, &[0, 0]), AbortCode::READ_ONLY),
            (write(0x6040, 0, &[0; 5]), AbortCode::TOO_LONG),
            (write(0x607A, 0, &[0xFF, 0xFF, 0xFF, 0x7F]), AbortCode::TOO_HIGH),
            (write(0x1A00, 0, &[0]), AbortCode::INVALID_VALUE),
            (drive.client().read(Object::new(0x2002, 0), &mut buffer).map(|_| ()), AbortCode::WRITE_ONLY),
        ];
        for (result, code) in codes {
            assert_eq!(result, Err(Error::Abort(code)));
        }
    }

    #[test]
    fn alarms_and_heartbeats() {
        let mut drive = DemoDrive::new(Node::new(CanNode::new(demo()), NODE));
        drive.client().wait_for(NmtState::BootUp, PATIENCE).unwrap();
        drive.producer_heartbeat_time().write(50).unwrap();
        drive.client().nmt(NmtCommand::Start).unwrap();
        drive.client().wait_for(NmtState::Operational, PATIENCE).unwrap();
        drive.client().port().device().emit_emergency(0x8611, 0x21, [0; 5]);
        let emergency = drive.client().emergency(PATIENCE).unwrap().unwrap();
        assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
        assert_eq!(drive.error_register().read().map(|value| value.raw()), Ok(0x21));
        // If no frames arrive, waiting only advances the clock of the node.
        drive.client().port().set_connected(false);
        assert_eq!(drive.client().heartbeat(Duration::from_secs(3600)), Ok(None));
        assert_eq!(drive.statusword().read().map(|_| ()).map_err(Error::from), Err(Error::Timeout));
        assert_eq!(now(drive.statusword().read_async()).map(|_| ()).map_err(Error::from), Err(Error::Timeout));
        drive.client().port().set_connected(true);
        assert_eq!(now(drive.profile_velocity().read_async()), Ok(1000));
    }

    #[test]
    fn an_axis_of_three() {
        let device = vector().with_axes(&vector_step::AXES);
        let mut drive = VectorStep::new(Node::new(CanNode::new(device), NODE));
        drive.axis(3).target_position().write(300).unwrap();
        assert_eq!(drive.axis(3).target_position().read(), Ok(300));
        assert_eq!(drive.client().port().device().bytes(Object::new(0x707A, 0)).map(|bytes| bytes[1]), Ok(1));
    }
}
