//! Tests the CANopen and Modbus RTU clients with frames in the manual of the Eco drive, byte by byte. Quotation marks
//! enclose titles of the manual's sections. If the manual prints a placeholder for the CRC, the test calculates the
//! CRC.

#[path = "support/can_script.rs"]
mod can_script;

use std::convert::Infallible;
use std::future::Future;
use std::pin::Pin;

use can_script::node;
use lexibus::clients::canopen::NmtState;
use lexibus::clients::modbus::tokio_modbus::client::{rtu, Context};
use lexibus::clients::modbus::tokio_modbus::{ExceptionCode, Slave};
use lexibus::clients::modbus::{ModbusClient, ModbusError};
use lexibus::modbus::AsyncRegisterClient;
use lexibus::{
    CobId, Error, Fixed, Flags, Initial, Item, MappedEntry, Modbus, NodeId, On, OnCanOpen, Range, Ro, Rw, Step,
    VisibleString, Writable, WriteRoute,
};
use lexibus_drives::eco::objects::{self, feed_constant, homing_speeds};
use lexibus_drives::eco::types::{
    Command, Controlword, DriveCommand, HomingMethod, Mode, MotionProfile, State, StoreParameters,
};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

type Device = ModbusClient<Context>;

/// Runs `exchange` with a node that expects `request` and responds with `reply`. Returns the result.
fn exchanged<T>(
    node: u8,
    request: &[u8],
    reply: &[u8],
    exchange: impl for<'d> FnOnce(&'d mut Device) -> Pin<Box<dyn Future<Output = T> + 'd>>,
) -> T {
    let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
    runtime.block_on(async {
        let (near, mut far) = tokio::io::duplex(512);
        let mut device = ModbusClient::new(rtu::attach_slave(near, Slave(node)));
        let answer = async {
            let mut sent = vec![0; request.len()];
            far.read_exact(&mut sent).await.expect("a request");
            assert_eq!(sent, request);
            far.write_all(reply).await.expect("an answer");
        };
        tokio::join!(exchange(&mut device), answer).0
    })
}

/// Returns the CRC-16 of a frame as little-endian bytes (MODBUS over Serial Line V1.02, 6.2.2).
fn check(frame: &[u8]) -> [u8; 2] {
    let shift = |crc: u16| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 };
    let crc = frame.iter().fold(0xFFFF, |crc, byte| (0..8).fold(crc ^ u16::from(*byte), |crc, _| shift(crc)));
    crc.to_le_bytes()
}

/// Checks the request that a write with function 16 sends to node 1. The manual prints the address, the 32-bit value
/// and the CRC.
fn written<V, A, L>(line: u32, item: Item<V, A, L>, value: V::Native, address: u16, raw: i32, crc: [u8; 2])
where
    V: Fixed + 'static,
    A: Writable + 'static,
    L: On<Modbus> + Copy + 'static,
    L::Route: WriteRoute<Modbus>,
{
    let head = [[1, 0x10].as_slice(), &address.to_be_bytes(), &[0, 2]].concat();
    let request = [head.as_slice(), &[4], &raw.to_be_bytes(), &crc].concat();
    assert_eq!(check(&request[..11]), crc, "L{line}");
    let reply = [head.as_slice(), &check(&head)].concat();
    exchanged(1, &request, &reply, |device| {
        Box::pin(async move { item.at(device).write_async(value).await.expect("written") })
    });
}

/// Tests the frames of the sections "Esempio di configurazione dell'asse" and "Primo metodo di salvataggio".
#[test]
fn modbus_writes_of_two_registers() {
    let off = DriveCommand::new();
    let enabled = off.with_torque_enable(true).with_motion_enable(true);
    let home = enabled.in_homing().with_homing(true).drive_command();
    let start = enabled.in_positioner().with_start_positioning(true).drive_command();
    let save = off.in_save_and_load().with_save(true).drive_command();
    written(1407, feed_constant::FEED_CONSTANT, 60, 0x8002, 60, [0x13, 0xA1]);
    written(1410, objects::PROFILE_ACCELERATION, 100, 0x800A, 100, [0x13, 0xFD]);
    written(1413, objects::PROFILE_DECELERATION, 100, 0x800B, 100, [0xD2, 0x31]);
    written(1416, objects::PROFILE_VELOCITY, 1000, 0x800C, 1000, [0x92, 0x82]);
    written(1419, objects::MOTION_PROFILE_TYPE, MotionProfile::Trapezoidal, 0x801B, 0, [0xD2, 0xD6]);
    written(1422, objects::HOMING_METHOD, HomingMethod::MarkerBackwards, 0x8012, 33, [0xD2, 0xA4]);
    written(1425, objects::HOME_OFFSET, 0, 0x8013, 0, [0xD3, 0x70]);
    written(1428, homing_speeds::HOMING_SLOW_SPEED, 10, 0x8015, 10, [0xD3, 0x5D]);
    written(1431, objects::HOMING_ACCELERATION, 100, 0x8016, 100, [0x12, 0xA4]);
    written(1443, objects::CONTROL_WORD, off.with_alarm_reset(true), 0x8000, 0x08, [0x93, 0xAF]);
    written(1447, objects::MODES_OF_OPERATION, Mode::Homing, 0x8001, 6, [0xD3, 0xA7]);
    written(1451, objects::CONTROL_WORD, enabled, 0x8000, 0x03, [0xD2, 0x68]);
    written(1455, objects::CONTROL_WORD, home, 0x8000, 0x43, [0xD3, 0x98]);
    written(1457, objects::CONTROL_WORD, off, 0x8000, 0, [0x92, 0x69]);
    written(1461, objects::MODES_OF_OPERATION, Mode::Positioner, 0x8001, 1, [0x92, 0x65]);
    written(1464, objects::TARGET_POSITION, 6000, 0x8009, 6000, [0x5C, 0x17]);
    written(1466, objects::CONTROL_WORD, enabled, 0x8000, 0x03, [0xD2, 0x68]);
    written(1471, objects::CONTROL_WORD, start, 0x8000, 0x23, [0xD3, 0xB0]);
    // The value is sign-extended to both registers.
    written(1492, objects::MODES_OF_OPERATION, Mode::SaveAndLoad, 0x8001, -50, [0x93, 0xE5]);
    written(1495, objects::CONTROL_WORD, save, 0x8000, 0x20, [0x93, 0xB1]);
}

#[test]
fn modbus_of_registers_with_an_address_each() {
    // Section "Codice 0x03: lettura dei parametri e dei registri". The text of the section contradicts its tables. The
    // test uses the bytes of the tables. The register at each address has 32 bits.
    let request = [0x05, 0x03, 0x80, 0x00, 0x00, 0x04, 0x6C, 0x4D];
    let reply = [[5, 3, 8].as_slice(), &[0, 0, 0, 0x23, 0xFF, 0xFF, 0xFF, 0xFE]].concat();
    let reply = [reply.as_slice(), &check(&reply)].concat();
    let values = exchanged(5, &request, &reply, |device| {
        let both = (objects::CONTROL_WORD, objects::MODES_OF_OPERATION);
        Box::pin(async move { device.read_block_async(both).await.expect("read") })
    });
    assert_eq!(values, (DriveCommand::from_raw(0x23), Mode::ElectricAxis));
    let request = [0x05, 0x03, 0x80, 0x06, 0x00, 0x02];
    let request = [request.as_slice(), &check(&request)].concat();
    let reply = [0x05, 0x03, 0x04, 0x11, 0x22, 0x33, 0x44, 0x0E, 0x06];
    let value = exchanged(5, &request, &reply, |device| {
        Box::pin(async move { objects::POSITION_ACTUAL_VALUE.at(device).read_async().await.expect("read") })
    });
    assert_eq!(value, 0x1122_3344);
}

#[test]
fn modbus_exceptions() {
    // Section "Eccezioni": the function code with bit 7 set, and exception code 02, which is the drive's only
    // exception.
    let reply = [[0x05, 0x86, 0x02].as_slice(), &check(&[0x05, 0x86, 0x02])].concat();
    let request = [0x05, 0x06, 0x00, 0x03, 0x00, 0x0A, 0xF8, 0x49];
    let refused =
        exchanged(5, &request, &reply, |device| Box::pin(async move { objects::D3.at(device).write_async(10).await }));
    let Err(Error::Client(ModbusError::Exception(code))) = refused.map_err(Error::from) else {
        panic!("another error")
    };
    assert_eq!(code, ExceptionCode::IllegalDataAddress);
}

#[test]
fn modbus_of_node_5() {
    // Section "Codice 0x10: scrittura di un registro".
    let request = [0x05, 0x10, 0x80, 0x09, 0x00, 0x02, 0x04, 0x00, 0x00, 0x03, 0xE8, 0x47, 0x8D];
    let reply = [0x05, 0x10, 0x80, 0x09, 0x00, 0x02, 0xB9, 0x8E];
    exchanged(5, &request, &reply, |device| {
        Box::pin(async move { objects::TARGET_POSITION.at(device).write_async(1000).await.expect("written") })
    });
    // Section "Secondo metodo di salvataggio con accesso a 32 bit".
    let request = [0x05, 0x10, 0x38, 0x02, 0x00, 0x02, 0x04, 0x00, 0x00, 0x00, 0x11, 0x94, 0x8B];
    let reply = [0x05, 0x10, 0x38, 0x02, 0x00, 0x02, 0xEC, 0xEC];
    exchanged(5, &request, &reply, |device| {
        Box::pin(async move { objects::SAVE_TO_FLASH_32.at(device).write_async(0x11).await.expect("written") })
    });
    // Sections "Codice 0x06: scrittura di un parametro" and "Secondo metodo di salvataggio con accesso a 16 bit". A
    // response to function 6 repeats the request.
    let request = [0x05, 0x06, 0x00, 0x03, 0x00, 0x0A, 0xF8, 0x49];
    exchanged(5, &request, &request, |device| {
        Box::pin(async move { objects::D3.at(device).write_async(10).await.expect("written") })
    });
    let request = [0x05, 0x06, 0x38, 0x02, 0x00, 0x11, 0xE4, 0xE2];
    exchanged(5, &request, &request, |device| {
        Box::pin(async move { objects::SAVE_TO_FLASH.at(device).write_async(0x11).await.expect("written") })
    });
    // Section "Codice 0x03: lettura dei parametri e dei registri": three registers in one request.
    let request = [0x05, 0x03, 0x00, 0x01, 0x00, 0x03, 0x55, 0x8F];
    let reply = [0x05, 0x03, 0x06, 0x00, 0x14, 0x00, 0x32, 0x00, 0x32, 0x03, 0xAC];
    let values = exchanged(5, &request, &reply, |device| {
        let all = (objects::D1, objects::D2, objects::D3);
        Box::pin(async move { device.read_block_async(all).await.expect("read") })
    });
    assert_eq!(values, (20, 50, 50));
}

#[test]
fn sdo_expedited() -> Result<(), Error<Infallible>> {
    const HEARTBEAT: Item<u16, Rw, OnCanOpen> = Item::object(0x1017, 0, "Producer heartbeat time");
    const VENDOR: Item<u32, Ro, OnCanOpen> = Item::object(0x1018, 1, "Vendor-ID");
    // Section "Device Configuration via SDOs": heartbeat time.
    let mut drive = node(&[([0x2B, 0x17, 0x10, 0, 0xA0, 0x0F, 0, 0], [0x60, 0x17, 0x10, 0, 0, 0, 0, 0])]);
    HEARTBEAT.at(&mut drive).write(4000)?;
    // Section "Device Configuration via SDOs": vendor ID.
    let mut drive = node(&[([0x40, 0x18, 0x10, 1, 0, 0, 0, 0], [0x43, 0x18, 0x10, 1, 6, 0, 0, 0])]);
    assert_eq!(VENDOR.at(&mut drive).read()?, 6);
    Ok(())
}

#[test]
fn sdo_segmented() -> Result<(), Error<Infallible>> {
    const NAME: Item<VisibleString, Ro, OnCanOpen> =
        Item::new(OnCanOpen::canopen(0x1008, 0), "Device name", Range::Full, Initial::Unknown, "", Flags::NONE);
    // Section "Device Configuration via SDOs": segmented transfer.
    let mut drive = node(&[
        ([0x40, 0x08, 0x10, 0, 0, 0, 0, 0], [0x41, 0x08, 0x10, 0, 0x1A, 0, 0, 0]),
        ([0x60, 0, 0, 0, 0, 0, 0, 0], [0x00, 0x54, 0x69, 0x6E, 0x79, 0x20, 0x4E, 0x6F]),
        ([0x70, 0, 0, 0, 0, 0, 0, 0], [0x10, 0x64, 0x65, 0x20, 0x2D, 0x20, 0x4D, 0x65]),
        ([0x60, 0, 0, 0, 0, 0, 0, 0], [0x00, 0x67, 0x61, 0x20, 0x44, 0x6F, 0x6D, 0x61]),
        ([0x70, 0, 0, 0, 0, 0, 0, 0], [0x15, 0x69, 0x6E, 0x73, 0x20, 0x21, 0, 0]),
    ]);
    let mut buffer = [0; 32];
    assert_eq!(NAME.at(&mut drive).read_into(&mut buffer)?, "Tiny Node - Mega Domains !");
    Ok(())
}

#[test]
fn numbers_of_canopen() {
    let node = NodeId::new(1).expect("a node-ID");
    // Section "Process data exchange with PDOs": COB-ID of a disabled TPDO of node 25. Section "Modo interpolatore":
    // COB-ID of an RPDO of node 1.
    assert_eq!(CobId::from_node(0x8000_0180).resolve(NodeId::new(25).expect("a node-ID")), 0x8000_0199);
    assert_eq!(CobId::from_node(0x200).resolve(node), 513);
    // Section "Node Monitoring via Node-Guarding or Heartbeat".
    let states =
        [(NmtState::BootUp, 0), (NmtState::Stopped, 4), (NmtState::Operational, 5), (NmtState::PreOperational, 0x7F)];
    for (state, number) in states {
        let frame = state.heartbeat(node);
        assert_eq!((frame.id(), frame.data()), (1792 + 1, [number].as_slice()));
    }
    // Sections "Modo interpolatore" and "Esempio completo di asse gestito con interpolatore": mapping entries.
    for (index, sub_index, bits, word) in [
        (0x60C1, 1, 32, 0x60C1_0120),
        (0x6040, 0, 16, 0x6040_0010),
        (0x6064, 0, 32, 0x6064_0020),
        (0x6041, 0, 16, 0x6041_0010),
    ] {
        assert_eq!(MappedEntry::new(index, sub_index, bits).word(), word);
    }
    // Section "Modo interpolatore": SYNC.
    assert_eq!(lexibus::clients::canopen::sync().id(), 0x80);
    // Section "Salvataggio su flash": key for storing parameters.
    assert_eq!(StoreParameters::Save.raw().to_le_bytes(), *b"save");
}

#[test]
fn control_words_of_cia_402() {
    // Section "Modo Homing": from a fault to Operation enabled.
    let mut sent = vec![Controlword::from_raw(0).with_command(Command::FaultReset).raw(), 0];
    for state in [State::SwitchOnDisabled, State::ReadyToSwitchOn, State::SwitchedOn] {
        let Step::Command(command) = state.toward(State::OperationEnabled) else { panic!("{state:?}") };
        sent.push(Controlword::from_raw(0).with_command(command).raw());
    }
    assert_eq!(sent, [0x0080, 0x0000, 0x0006, 0x0007, 0x000F]);
}

#[test]
fn profinet_is_big_endian() {
    // Section "Esempio interfaccia con Master Profinet Hilscher": statusword 0x8640.
    let mut image = [0; 2];
    lexibus::profinet::be::put_number(&mut image, 0, 0, 16, 0x8640);
    assert_eq!(image, [0x86, 0x40]);
    assert_eq!(lexibus::profinet::be::number(&image, 0, 0, 16), 0x8640);
}
