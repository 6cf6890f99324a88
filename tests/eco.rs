//! Tests the Eco's bindings on CANopen and EtherCAT with the examples in the manual: requests, scales and PDOs.
//! Quotation marks enclose titles of the manual's sections. The test programs `frames`, `eco_buses` and `eco_siemens` test
//! the Eco on Modbus.

#[path = "support/can_script.rs"]
mod can_script;

use std::convert::Infallible;
use std::time::Duration;

use can_script::{node, Script};
use lexibus::clients::canopen::Node;
use lexibus::codes::Cell;
use lexibus::{
    CanOpen, Error, Fixed, Item, On, OutOfRange, Pdo, ReadRoute, Readable, Rw, SdoWrite, Timed, Writable, WriteRoute,
};
use lexibus_drives::eco::objects::{self, feed_constant, homing_speeds, interpolation_time_period};
use lexibus_drives::eco::objects::{
    drive_parameters_settings, drive_variable_read, drive_variable_write, store_parameter_field,
};
use lexibus_drives::eco::objects::{
    receive_pdo_1_communication_parameter as rpdo, receive_pdo_1_mapping_parameter as rpdo_map,
};
use lexibus_drives::eco::objects::{
    transmit_pdo_1_communication_parameter as tpdo, transmit_pdo_1_mapping_parameter as tpdo_map,
};
use lexibus_drives::eco::types::{
    Command, Controlword, DriveCommand, HomingMethod, MappedObject, Mode, ReceivePdoIdentifier, Statusword,
    StoreParameters, TransmissionType,
};
use lexibus_drives::eco::{self, codes, pdo, procedures};

type Answer<T> = Result<T, Error<Infallible>>;

/// Returns an SDO download request and its confirmation.
fn confirmed(request: [u8; 8]) -> ([u8; 8], [u8; 8]) {
    (request, [0x60, request[1], request[2], request[3], 0, 0, 0, 0])
}

/// Returns whether the node has received all expected requests.
fn is_done(drive: &mut Node<Script>) -> bool {
    drive.port().is_done()
}

/// Writes an item and checks the SDO request.
#[track_caller]
fn writes<V, A, L>(item: Item<V, A, L>, value: V::Native, request: [u8; 8])
where
    V: Fixed,
    A: Writable,
    L: On<CanOpen>,
    L::Route: WriteRoute<CanOpen>,
{
    let mut drive = node(&[confirmed(request)]);
    item.at(&mut drive).write(value).expect("written");
}

fn control(raw: u16) -> Controlword {
    Controlword::from_raw(raw)
}

/// Checks the requests that write a sequence of controlwords.
fn commands(words: &[u16]) {
    for &word in words {
        let [low, high] = word.to_le_bytes();
        writes(objects::CONTROLWORD, control(word), [0x2B, 0x40, 0x60, 0, low, high, 0, 0]);
    }
}

#[test]
fn homing() {
    // Section "Modo Homing".
    writes(feed_constant::FEED_CONSTANT, 6000, [0x23, 0x92, 0x60, 1, 0x70, 0x17, 0, 0]);
    writes(objects::HOMING_METHOD, HomingMethod::MarkerForwards, [0x2F, 0x98, 0x60, 0, 0x22, 0, 0, 0]);
    writes(objects::HOME_OFFSET, -1000, [0x23, 0x7C, 0x60, 0, 0x18, 0xFC, 0xFF, 0xFF]);
    writes(homing_speeds::HOMING_SLOW_SPEED, 1000, [0x23, 0x99, 0x60, 2, 0xE8, 0x03, 0, 0]);
    writes(objects::MODES_OF_OPERATION, Mode::Homing, [0x2F, 0x60, 0x60, 0, 6, 0, 0, 0]);
    // Section "Modo Homing".
    commands(&[0x0000, 0x0080, 0x0000, 0x0006, 0x0007, 0x000F, 0x000F, 0x001F]);
    let start = control(0x000F).in_homing().with_start_homing(true).controlword();
    assert_eq!(start.raw(), 0x001F);
    // Section "Modo Homing": bits 12 and 13 of the statusword.
    assert_eq!(format!("{:?}", Statusword::from_raw(0x1000).in_homing().homing()), "Done");
    assert_eq!(format!("{:?}", Statusword::from_raw(0x2000).in_homing().homing()), "Interrupted");
}

#[test]
fn positioner() {
    // Section "Modo posizionatore".
    writes(objects::PROFILE_VELOCITY, 20_000, [0x23, 0x81, 0x60, 0, 0x20, 0x4E, 0, 0]);
    writes(objects::PROFILE_ACCELERATION, 200, [0x23, 0x83, 0x60, 0, 0xC8, 0, 0, 0]);
    writes(objects::PROFILE_DECELERATION, 200, [0x23, 0x84, 0x60, 0, 0xC8, 0, 0, 0]);
    writes(objects::MODES_OF_OPERATION, Mode::Positioner, [0x2F, 0x60, 0x60, 0, 1, 0, 0, 0]);
    writes(objects::TARGET_POSITION, 60_000, [0x23, 0x7A, 0x60, 0, 0x60, 0xEA, 0, 0]);
    commands(&[0x004F, 0x005F]);
    writes(objects::TARGET_POSITION, 30_000, [0x23, 0x7A, 0x60, 0, 0x30, 0x75, 0, 0]);
    commands(&[0x000F, 0x001F]);
    let relative = control(0x000F).in_positioner().with_relative(true).with_new_set_point(true).controlword();
    assert_eq!(relative.raw(), 0x005F);
}

#[test]
fn velocity() {
    // Section "Modo controllo di velocità".
    writes(feed_constant::FEED_CONSTANT, 60, [0x23, 0x92, 0x60, 1, 0x3C, 0, 0, 0]);
    writes(objects::PROFILE_ACCELERATION, 5, [0x23, 0x83, 0x60, 0, 5, 0, 0, 0]);
    writes(objects::PROFILE_DECELERATION, 5, [0x23, 0x84, 0x60, 0, 5, 0, 0, 0]);
    writes(objects::MODES_OF_OPERATION, Mode::Velocity, [0x2F, 0x60, 0x60, 0, 3, 0, 0, 0]);
    writes(objects::TARGET_VELOCITY, 1000, [0x23, 0xFF, 0x60, 0, 0xE8, 0x03, 0, 0]);
}

#[test]
fn saving_and_guarding() {
    // Sections "Disabilitazione del drive" and "Salvataggio".
    commands(&[0x0002]);
    let key = [0x23, 0x10, 0x10, 1, 0x73, 0x61, 0x76, 0x65];
    writes(store_parameter_field::SAVE_ALL_PARAMETERS, StoreParameters::Save, key);
    commands(&[0x0006]);
    // Section "Abilitazione e disabilitazione del servizio node guarding". Node guarding is disabled if the guard time
    // and the life time factor are 0.
    writes(objects::GUARD_TIME, 500, [0x2B, 0x0C, 0x10, 0, 0xF4, 0x01, 0, 0]);
    writes(objects::LIFE_TIME_FACTOR, 2, [0x2F, 0x0D, 0x10, 0, 2, 0, 0, 0]);
    writes(objects::GUARD_TIME, 0, [0x2B, 0x0C, 0x10, 0, 0, 0, 0, 0]);
    writes(objects::LIFE_TIME_FACTOR, 0, [0x2F, 0x0D, 0x10, 0, 0, 0, 0, 0]);
}

#[test]
fn interpolator() {
    // Section "Modo interpolatore". The mapping entry of the statusword is 0x1A00:02, but the manual prints sub-index 1.
    writes(interpolation_time_period::IP_TIME_UNITS, 1, [0x2F, 0xC2, 0x60, 1, 1, 0, 0, 0]);
    // 513 is the default COB-ID of RPDO 1 for node 1. The example sets this COB-ID in all nodes that share the PDO.
    let of_node_1 = ReceivePdoIdentifier::from_raw(513);
    writes(rpdo::COB_ID_OF_RPDO_1, of_node_1, [0x23, 0x00, 0x14, 1, 0x01, 0x02, 0, 0]);
    assert_eq!((of_node_1.identifier(), of_node_1.valid(), of_node_1.extended()), (0x201, true, false));
    writes(objects::MODES_OF_OPERATION, Mode::Interpolator, [0x2F, 0x60, 0x60, 0, 7, 0, 0, 0]);
    let each_sync = TransmissionType::from_raw(1);
    writes(rpdo::TRANSMISSION_TYPE_OF_RPDO_1, each_sync, [0x2F, 0x00, 0x14, 2, 1, 0, 0, 0]);
    writes(rpdo_map::NUMBER_OF_MAPPED_OBJECTS_OF_RPDO_1, 0, [0x2F, 0x00, 0x16, 0, 0, 0, 0, 0]);
    let set_point = MappedObject::new().with_index(0x60C1).with_sub_index(1).with_length(32);
    writes(rpdo_map::MAPPED_OBJECT_1_OF_RPDO_1, set_point, [0x23, 0x00, 0x16, 1, 0x20, 0x01, 0xC1, 0x60]);
    let word = MappedObject::new().with_index(0x6040).with_length(16);
    writes(rpdo_map::MAPPED_OBJECT_2_OF_RPDO_1, word, [0x23, 0x00, 0x16, 2, 0x10, 0x00, 0x40, 0x60]);
    writes(rpdo_map::NUMBER_OF_MAPPED_OBJECTS_OF_RPDO_1, 2, [0x2F, 0x00, 0x16, 0, 2, 0, 0, 0]);
    writes(tpdo::TRANSMISSION_TYPE_OF_TPDO_1, each_sync, [0x2F, 0x00, 0x18, 2, 1, 0, 0, 0]);
    writes(tpdo_map::NUMBER_OF_MAPPED_OBJECTS_OF_TPDO_1, 0, [0x2F, 0x00, 0x1A, 0, 0, 0, 0, 0]);
    let position = MappedObject::new().with_index(0x6064).with_length(32);
    writes(tpdo_map::MAPPED_OBJECT_1_OF_TPDO_1, position, [0x23, 0x00, 0x1A, 1, 0x20, 0x00, 0x64, 0x60]);
    let state = MappedObject::new().with_index(0x6041).with_length(16);
    writes(tpdo_map::MAPPED_OBJECT_2_OF_TPDO_1, state, [0x23, 0x00, 0x1A, 2, 0x10, 0x00, 0x41, 0x60]);
    writes(tpdo_map::NUMBER_OF_MAPPED_OBJECTS_OF_TPDO_1, 2, [0x2F, 0x00, 0x1A, 0, 2, 0, 0, 0]);
}

/// Returns an SDO request that writes a value of `bits` bits.
fn sdo(index: u16, sub_index: u8, bits: u8, value: u32) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let [a, b, c, d] = value.to_le_bytes();
    [
        if bits == 8 {
            0x2F
        } else if bits == 16 {
            0x2B
        } else {
            0x23
        },
        low,
        high,
        sub_index,
        a,
        b,
        c,
        d,
    ]
}

/// A list of writes: index, sub-index, length in bits, and value.
type Listed<'l> = &'l [(u16, u8, u8, u32)];

/// Sends a procedure to a node. The node expects the writes that the manual prints.
#[track_caller]
fn sends(procedure: &[SdoWrite], listed: Listed<'_>) {
    let script: Vec<_> = listed.iter().map(|row| confirmed(sdo(row.0, row.1, row.2, row.3))).collect();
    let mut drive = node(&script);
    for write in procedure {
        write.send(&mut drive).expect("confirmed");
    }
    assert!(is_done(&mut drive), "all of them are sent");
}

#[test]
fn procedures_send_what_the_manual_lists() {
    let words = |all: &[u32]| all.iter().map(|word| (0x6040, 0, 16, *word)).collect::<Vec<_>>();
    // Section "Modo Homing". The other examples of the manual print the same sequence.
    sends(&procedures::ENABLE, &words(&[0, 0x80, 0, 6, 7, 0xF]));
    // Sections "Disabilitazione del drive" and "Salvataggio".
    sends(&procedures::DISABLE, &words(&[2]));
    // Section "Abilitazione e disabilitazione del servizio node guarding".
    sends(&procedures::GUARD, &[(0x100C, 0, 16, 500), (0x100D, 0, 8, 2)]);
    sends(&procedures::STOP_GUARDING, &[(0x100C, 0, 16, 0), (0x100D, 0, 8, 0)]);
    // Section "Modo posizionatore".
    let settings = [(0x6092, 1, 32, 6000), (0x6081, 0, 32, 20_000), (0x6083, 0, 32, 200), (0x6084, 0, 32, 200)];
    let target = [(0x6060, 0, 8, 1), (0x607A, 0, 32, 60_000)];
    sends(&procedures::POSITION_BY_402, &[&settings[..], &target, &words(&[0x4F, 0x5F])].concat());
    // Section "Modo controllo di velocità".
    let settings = [(0x6092, 1, 32, 60), (0x6083, 0, 32, 5), (0x6084, 0, 32, 5)];
    sends(&procedures::VELOCITY_BY_402, &[&settings[..], &[(0x6060, 0, 8, 3), (0x60FF, 0, 32, 1000)]].concat());
    // Section "Modo interpolatore". The mapping entry of the statusword is 0x1A00:02, but the manual prints sub-index 1.
    let out = [(0x1400, 2, 8, 1), (0x1600, 0, 8, 0), (0x1600, 1, 32, 0x60C1_0120), (0x1600, 2, 32, 0x6040_0010)];
    let back = [(0x1800, 2, 8, 1), (0x1A00, 0, 8, 0), (0x1A00, 1, 32, 0x6064_0020), (0x1A00, 2, 32, 0x6041_0010)];
    let all = [&out[..], &[(0x1600, 0, 8, 2)], &back, &[(0x1A00, 0, 8, 2)]].concat();
    sends(&procedures::MAP_INTERPOLATOR, &all);
    // Section "Modo interpolatore".
    let settings = [(0x6092, 1, 32, 6000), (0x60C2, 1, 8, 1), (0x6060, 0, 8, 7), (0x6040, 0, 16, 0x1F)];
    sends(&procedures::INTERPOLATE, &settings);
    // The sections "Esempio di configurazione dell'asse" and "Esempio posizionamento punto a punto" print these values
    // for the registers of the same items.
    let motion = [(0x6092, 1, 32, 60), (0x6083, 0, 32, 100), (0x6084, 0, 32, 100), (0x6081, 0, 32, 1000)];
    let homing =
        [(0x6086, 0, 16, 0), (0x6098, 0, 8, 33), (0x607C, 0, 32, 0), (0x6099, 2, 32, 10), (0x609A, 0, 32, 100)];
    sends(&procedures::CONFIGURE_POSITIONER, &[&motion[..], &homing].concat());
}

/// Tests the sequence in section "Salvataggio", which disables the torque, writes the key, sends "Shutdown", and waits for
/// bit 0 of the statusword.
#[test]
fn saving_on_canopen() -> Answer<()> {
    let state = |low| ([0x40, 0x41, 0x60, 0, 0, 0, 0, 0], [0x4B, 0x41, 0x60, 0, low, 0x02, 0, 0]);
    let mut drive = node(&[
        confirmed([0x2B, 0x40, 0x60, 0, 0x02, 0, 0, 0]),
        confirmed([0x23, 0x10, 0x10, 1, 0x73, 0x61, 0x76, 0x65]),
        confirmed([0x2B, 0x40, 0x60, 0, 0x06, 0, 0, 0]),
        state(0x50),
        state(0x50),
        state(0x31),
    ]);
    objects::CONTROLWORD.at(&mut drive).write(control(0x0002))?;
    store_parameter_field::SAVE_ALL_PARAMETERS.at(&mut drive).write(StoreParameters::Save)?;
    objects::CONTROLWORD.at(&mut drive).write(control(0).with_command(Command::Shutdown))?;
    while !objects::STATUSWORD.at(&mut drive).read()?.ready_to_switch_on() {}
    assert!(is_done(&mut drive));
    Ok(())
}

/// Reads an item from a node.
fn read<V, A, L>(drive: &mut Node<Script>, item: Item<V, A, L>) -> Answer<V::Native>
where
    V: Fixed,
    A: Readable,
    L: On<CanOpen>,
    L::Route: ReadRoute<CanOpen>,
{
    Ok(item.at(drive).read()?)
}

#[test]
fn parameters_by_the_window_of_eight_bits() {
    // Section "Lettura parametri drive". When the device has reset the address to 0, the value of d1 is available.
    let mut drive = node(&[
        confirmed([0x2F, 0x00, 0x20, 3, 1, 0, 0, 0]),
        ([0x40, 0x00, 0x20, 3, 0, 0, 0, 0], [0x4F, 0x00, 0x20, 3, 1, 0, 0, 0]),
        ([0x40, 0x00, 0x20, 3, 0, 0, 0, 0], [0x4F, 0x00, 0x20, 3, 0, 0, 0, 0]),
        ([0x40, 0x00, 0x20, 4, 0, 0, 0, 0], [0x4F, 0x00, 0x20, 4, 80, 0, 0, 0]),
    ]);
    drive_parameters_settings::PARAMETER_READ_ADDRESS.at(&mut drive).write(1).expect("written");
    while read(&mut drive, drive_parameters_settings::PARAMETER_READ_ADDRESS).expect("read") != 0 {}
    assert_eq!(read(&mut drive, drive_parameters_settings::PARAMETER_READ_VALUE), Ok(80));
    // Sections "Scrittura parametri drive" and "Esempio completo di asse gestito con interpolatore". The manual writes
    // the value before the address.
    for (address, value) in [(2, 40), (1, 80), (2, 20)] {
        let mut drive = node(&[
            confirmed([0x2F, 0x00, 0x20, 2, value, 0, 0, 0]),
            confirmed([0x2F, 0x00, 0x20, 1, address, 0, 0, 0]),
        ]);
        drive_parameters_settings::PARAMETER_WRITE_VALUE.at(&mut drive).write(value).expect("written");
        drive_parameters_settings::PARAMETER_WRITE_ADDRESS.at(&mut drive).write(address).expect("written");
    }
}

/// Tests the objects 0x2005 and 0x2006. These objects give access to parameters by number, and to registers from
/// address 0x8000. Instead of polling the acknowledgement, reads and writes wait for 3 ms.
#[test]
fn parameters_and_registers_by_the_window_of_32_bits() -> Answer<()> {
    let mut waited = Vec::new();
    let mut drive = Timed::new(
        node(&[
            confirmed([0x2B, 0x05, 0x20, 1, 0x01, 0x00, 0, 0]),
            ([0x40, 0x05, 0x20, 2, 0, 0, 0, 0], [0x43, 0x05, 0x20, 2, 80, 0, 0, 0]),
            confirmed([0x23, 0x06, 0x20, 2, 40, 0, 0, 0]),
            confirmed([0x2B, 0x06, 0x20, 1, 0x02, 0x00, 0, 0]),
            confirmed([0x2B, 0x05, 0x20, 1, 0x01, 0x80, 0, 0]),
            ([0x40, 0x05, 0x20, 2, 0, 0, 0, 0], [0x43, 0x05, 0x20, 2, 0xFE, 0xFF, 0xFF, 0xFF]),
            confirmed([0x23, 0x06, 0x20, 2, 0x03, 0, 0, 0]),
            confirmed([0x2B, 0x06, 0x20, 1, 0x00, 0x80, 0, 0]),
        ]),
        |time| waited.push(time),
    );
    assert_eq!(objects::D1.at(&mut drive).read()?, 80);
    objects::D2.at(&mut drive).write(40)?;
    // Registers R01 and R00. A negative value is sign-extended to 32 bits.
    assert_eq!(objects::MODES_OF_OPERATION.at(&mut drive).read()?, Mode::ElectricAxis);
    let enabled = DriveCommand::new().with_torque_enable(true).with_motion_enable(true);
    objects::CONTROL_WORD.at(&mut drive).write(enabled)?;
    assert!(is_done(drive.client()));
    // A value outside the range of d2 must not be sent.
    assert_eq!(objects::D2.at(&mut drive).write(100).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    assert_eq!(waited, [Duration::from_millis(3); 4]);
    Ok(())
}

/// Tests direct access to the objects 0x2005 and 0x2006. The test polls the acknowledgement in these objects.
#[test]
fn the_window_of_32_bits_with_its_acknowledgement() -> Answer<()> {
    let address = |index, number| ([0x40, index, 0x20, 1, 0, 0, 0, 0], [0x4B, index, 0x20, 1, number, 0, 0, 0]);
    let mut drive = node(&[
        confirmed([0x2B, 0x05, 0x20, 1, 0x01, 0x00, 0, 0]),
        address(0x05, 1),
        address(0x05, 0),
        ([0x40, 0x05, 0x20, 2, 0, 0, 0, 0], [0x43, 0x05, 0x20, 2, 80, 0, 0, 0]),
        confirmed([0x23, 0x06, 0x20, 2, 40, 0, 0, 0]),
        confirmed([0x2B, 0x06, 0x20, 1, 0x02, 0x00, 0, 0]),
        address(0x06, 2),
        address(0x06, 0),
    ]);
    drive_variable_read::VARIABLE_READ_ADDRESS.at(&mut drive).write(1)?;
    while drive_variable_read::VARIABLE_READ_ADDRESS.at(&mut drive).read()? != 0 {}
    assert_eq!(drive_variable_read::VARIABLE_READ_VALUE.at(&mut drive).read()?, 80);
    drive_variable_write::VARIABLE_WRITE_VALUE.at(&mut drive).write(40)?;
    drive_variable_write::VARIABLE_WRITE_ADDRESS.at(&mut drive).write(2)?;
    while drive_variable_write::VARIABLE_WRITE_ADDRESS.at(&mut drive).read()? != 0 {}
    assert!(is_done(&mut drive));
    Ok(())
}

#[test]
fn windows_take_numbers_of_registers_and_parameters_only() {
    // The manual prints these ranges for the objects 0x2005 and 0x2006.
    for (address, fits) in
        [(1, true), (99, true), (0x8000, true), (0x8FFF, true), (100, false), (0x7FFF, false), (0x9000, false)]
    {
        assert_eq!(drive_variable_read::VARIABLE_READ_ADDRESS.range().contains(address), fits, "{address}");
        assert_eq!(drive_variable_write::VARIABLE_WRITE_ADDRESS.range().contains(address), fits, "{address}");
    }
}

#[test]
fn scales_follow_the_feed_constant() {
    // Section "Modo posizionatore": 6000 units per turn, 200 rpm, acceleration within 100 ms.
    assert_eq!(objects::PROFILE_VELOCITY.raw_by(200.0, 6000.0), Ok(20_000));
    let rate = 200.0 / 60.0 / 0.1;
    assert_eq!(objects::PROFILE_ACCELERATION.raw_by(rate, 6000.0), Ok(200));
    // Section "Modo Homing": 10 rpm.
    assert_eq!(homing_speeds::HOMING_SLOW_SPEED.raw_by(10.0, 6000.0), Ok(1000));
    // Section "Modo controllo di velocità": 60 units per turn, so speeds are in rpm; 1000 rpm, acceleration within 200
    // ms.
    assert_eq!(objects::TARGET_VELOCITY.raw_by(1000.0, 60.0), Ok(1000));
    assert_eq!(objects::PROFILE_DECELERATION.raw_by(1000.0 / 60.0 / 0.2, 60.0), Ok(5));
    // Section "Modo posizionatore": ten turns and five turns.
    assert_eq!(objects::TARGET_POSITION.raw_by(10.0, 6000.0), Ok(60_000));
    assert!((objects::TARGET_POSITION.physical_by(30_000, 6000.0) - 5.0).abs() < 1e-9);
}

#[test]
fn a_window_that_is_off_is_no_number() {
    // The value 0xFFFFFFFF of object 0x6065 disables the following-error check.
    let off = [0x43, 0x65, 0x60, 0, 0xFF, 0xFF, 0xFF, 0xFF];
    let mut drive = node(&[([0x40, 0x65, 0x60, 0, 0, 0, 0, 0], off)]);
    assert_eq!(objects::FOLLOWING_ERROR_WINDOW.at(&mut drive).read(), Ok(u32::MAX));
    assert_eq!(objects::FOLLOWING_ERROR_WINDOW.physical_by(u32::MAX, 60.0), None);
    assert_eq!(objects::VELOCITY_WINDOW.physical(0xFFFF), None);
    assert_eq!(objects::VELOCITY_WINDOW.physical(7), Some(7.0));
}

#[test]
fn pdos_of_ethercat() {
    // Section "PDO" of the EtherCAT chapter: the controlword and the setpoint occupy six bytes in little-endian order.
    let enabled = control(0x000F).in_interpolator().with_interpolate(true).controlword();
    let out = pdo::InterpolatedPosition { controlword: enabled, position_set_point: -2 };
    assert_eq!(out.pack(), [0x1F, 0, 0xFE, 0xFF, 0xFF, 0xFF]);
    let indices = [
        <pdo::InterpolatedPosition as Pdo>::INDEX,
        <pdo::Mode as Pdo>::INDEX,
        <pdo::Position as Pdo>::INDEX,
        <pdo::Velocity as Pdo>::INDEX,
        <pdo::Status as Pdo>::INDEX,
        <pdo::ModeDisplay as Pdo>::INDEX,
        <pdo::ActualPosition as Pdo>::INDEX,
        <pdo::ActualVelocity as Pdo>::INDEX,
    ];
    assert_eq!(indices, [0x1600, 0x1601, 0x1602, 0x1603, 0x1A00, 0x1A01, 0x1A02, 0x1A03]);
    let lengths = [pdo::InterpolatedPosition::LEN, pdo::Mode::LEN, pdo::Status::LEN, pdo::ModeDisplay::LEN];
    assert_eq!(lengths, [6, 4, 2, 4]);
    let answer = pdo::ActualPosition::unpack(&[0x37, 0x16, 0x70, 0x17, 0, 0]).expect("six bytes");
    assert_eq!((answer.position_actual_value, answer.statusword.target_reached()), (6000, true));
}

lexibus::pdo! {
    /// RPDO 1 with the mapping of section "Modo interpolatore". The setpoint precedes the controlword.
    pub struct SetPoint: lexibus_drives::eco::pdo::RxPdo1 { position_set_point: interpolation_data_record::position_set_point, controlword }
}

#[test]
fn the_mapping_of_the_example() {
    let frame = SetPoint { position_set_point: 6000, controlword: control(0x001F) }.pack();
    assert_eq!(frame, [0x70, 0x17, 0, 0, 0x1F, 0]);
    let words: Vec<u32> = SetPoint::MAPPING.iter().map(|entry| entry.word()).collect();
    assert_eq!(words, [0x60C1_0120, 0x6040_0010]);
}

#[test]
fn values_of_several_parameters() {
    // P1 and P2 contain the hundreds and units of a number. H5 to H8 contain sign, tens of thousands, hundreds and units.
    assert_eq!(eco::PULSES_PER_TURN.split(4096), Ok([40, 96]));
    assert_eq!(eco::SPACE_OFFSET.join_signed(1, [12, 34, 56]), Ok(-123_456));
    let both: [Item<u16, Rw, _>; 2] = [objects::P1, objects::P2];
    assert_eq!(both.map(|item| item.name()), ["P1", "P2"]);
}

#[test]
fn alarms_have_codes_of_their_own_on_each_bus() {
    let general = codes::GENERAL_ALARMS.iter().find(|row| row.first == 16).expect("an alarm");
    assert_eq!(general.name, "following error");
    let code = |alarm| codes::ETHERCAT_ALARMS.iter().find(|row| row.first == alarm).map(|row| row.cells);
    assert_eq!(code(16), Some([Cell::Number(0x8611)].as_slice()));
    assert_eq!(code(30), Some([Cell::Empty].as_slice()));
    let names = [codes::ETHERCAT_ALARMS, codes::PROFINET_ALARMS]
        .map(|table| table.iter().find(|row| row.first == 33).map(|row| row.name));
    assert_eq!(names, [Some("PDO mapping failed"), Some("fieldbus not started properly")]);
}
