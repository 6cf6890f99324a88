//! Frames that the manual of the Eco drive prints, byte by byte: what comes out of the clients of CANopen and of Modbus RTU.
//! Lines are the manual's; its placeholders for the check are filled with what follows from the bytes in front of it.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::future::Future;
use std::pin::Pin;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, NmtState, Node};
use lexibus::clients::modbus::tokio_modbus::client::{rtu, Context};
use lexibus::clients::modbus::tokio_modbus::{ExceptionCode, Slave};
use lexibus::clients::modbus::{ModbusClient, ModbusError};
use lexibus::modbus::AsyncRegisterClient;
use lexibus::{
    AsyncClient, CobId, Error, Flags, Initial, Item, MappedEntry, NodeId, OnCanOpen, OnModbus, Range, Register, Ro, Rw,
    Step, VisibleString,
};
use lexibus_drives::demo_drive::types::{Command, Controlword, State, StoreParameters};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

type Here<V> = Item<V, Rw, OnModbus>;
type Device = ModbusClient<Context>;

const TARGET_POSITION: Here<i32> = Here::register(Register::high_first(0x8009, 2), "target position", Flags::NONE);
const D3: Here<u16> = Here::register(Register::holding(3), "d3", Flags::NONE);
const SAVE: Here<u16> = Here::register(Register::holding(0x3802), "save", Flags::NONE);
const SAVE_32: Here<u32> = Here::register(Register::high_first(0x3802, 2), "save", Flags::NONE);

/// What `exchange` gives with a node that expects `request`, and answers `reply`.
fn exchanged<T>(
    (node, request, reply): (u8, &[u8], &[u8]),
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

/// The check of a frame (CRC-16 of Modbus, 6.2.2 of the guide to its serial line), the lower byte first.
fn check(frame: &[u8]) -> [u8; 2] {
    let shift = |crc: u16| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 };
    let crc = frame.iter().fold(0xFFFF, |crc, byte| (0..8).fold(crc ^ u16::from(*byte), |crc, _| shift(crc)));
    crc.to_le_bytes()
}

/// Lines of the manual with function 16 to node 1: the address, the 32 bits, and the check that belongs behind them.
const WRITES: [(u32, u16, i32, [u8; 2]); 20] = [
    (1407, 0x8002, 60, [0x13, 0xA1]),
    (1410, 0x800A, 100, [0x13, 0xFD]),
    (1413, 0x800B, 100, [0xD2, 0x31]),
    (1416, 0x800C, 1000, [0x92, 0x82]),
    (1419, 0x801B, 0, [0xD2, 0xD6]),
    (1422, 0x8012, 33, [0xD2, 0xA4]),
    (1425, 0x8013, 0, [0xD3, 0x70]),
    (1428, 0x8015, 10, [0xD3, 0x5D]),
    (1431, 0x8016, 100, [0x12, 0xA4]),
    (1443, 0x8000, 0x08, [0x93, 0xAF]),
    (1447, 0x8001, 6, [0xD3, 0xA7]),
    (1451, 0x8000, 0x03, [0xD2, 0x68]),
    (1455, 0x8000, 0x43, [0xD3, 0x98]),
    (1457, 0x8000, 0, [0x92, 0x69]),
    (1461, 0x8001, 1, [0x92, 0x65]),
    (1464, 0x8009, 6000, [0x5C, 0x17]),
    (1466, 0x8000, 0x03, [0xD2, 0x68]),
    (1471, 0x8000, 0x23, [0xD3, 0xB0]),
    // The sign goes through both registers.
    (1492, 0x8001, -50, [0x93, 0xE5]),
    (1495, 0x8000, 0x20, [0x93, 0xB1]),
];

#[test]
fn modbus_writes_of_two_registers() {
    for (line, address, value, crc) in WRITES {
        let item = Here::<i32>::register(Register::high_first(address, 2), "register", Flags::NONE);
        let head = [[1, 0x10].as_slice(), &address.to_be_bytes(), &[0, 2]].concat();
        let request = [head.as_slice(), &[4], &value.to_be_bytes(), &crc].concat();
        assert_eq!(check(&request[..11]), crc, "L{line}");
        let reply = [head.as_slice(), &check(&head)].concat();
        exchanged((1, &request, &reply), |device| {
            Box::pin(async move { item.at(device).write_async(value).await.expect("written") })
        });
    }
}

#[test]
fn modbus_of_registers_with_an_address_each() {
    // L1210 and L1243 contradict their own tables; these are the bytes of the tables. Each address has 32 bits.
    fn item(address: u16) -> Here<u32> {
        Here::register(Register::high_first(address, 2).words_per_address(2), "register", Flags::NONE)
    }
    let request = [0x05, 0x03, 0x80, 0x00, 0x00, 0x04, 0x6C, 0x4D];
    let reply = [[5, 3, 8].as_slice(), &[0x11, 0x22, 0x33, 0x44, 0, 0, 0, 6]].concat();
    let reply = [reply.as_slice(), &check(&reply)].concat();
    let values = exchanged((5, &request, &reply), |device| {
        Box::pin(async move { device.read_block_async((item(0x8000), item(0x8001))).await.expect("read") })
    });
    assert_eq!(values, (0x1122_3344, 6));
    let request =
        [[0x05, 0x03, 0x80, 0x00, 0x00, 0x02].as_slice(), &check(&[0x05, 0x03, 0x80, 0x00, 0x00, 0x02])].concat();
    let reply = [0x05, 0x03, 0x04, 0x11, 0x22, 0x33, 0x44, 0x0E, 0x06];
    let value = exchanged((5, &request, &reply), |device| {
        Box::pin(async move { item(0x8000).at(device).read_async().await.expect("read") })
    });
    assert_eq!(value, 0x1122_3344);
}

#[test]
fn modbus_of_the_second_map() {
    // L1630 to L1675: the fields of requests that are printed without their bytes.
    let write = [0x05, 0x06, 0x9C, 0x44, 0x00, 0x0A];
    let write = [write.as_slice(), &check(&write)].concat();
    exchanged((5, &write, &write), |device| {
        let item = Here::<u16>::register(Register::holding(40_004), "d3", Flags::NONE);
        Box::pin(async move { item.at(device).write_async(10).await.expect("written") })
    });
    let head = [0x05, 0x10, 0xAC, 0x4A, 0x00, 0x02];
    let write = [head.as_slice(), &[4, 0, 0, 0x03, 0xE8]].concat();
    let write = [write.as_slice(), &check(&write)].concat();
    exchanged((5, &write, &[head.as_slice(), &check(&head)].concat()), |device| {
        let item = Here::<i32>::register(Register::high_first(44_106, 2), "target position", Flags::NONE);
        Box::pin(async move { item.at(device).write_async(1000).await.expect("written") })
    });
}

#[test]
fn modbus_exceptions() {
    // L942, L1085: the function with bit 7 set, and the only code that there is, 02.
    let reply = [[0x05, 0x86, 0x02].as_slice(), &check(&[0x05, 0x86, 0x02])].concat();
    let request = [0x05, 0x06, 0x00, 0x03, 0x00, 0x0A, 0xF8, 0x49];
    let refused =
        exchanged((5, &request, &reply), |device| Box::pin(async move { D3.at(device).write_async(10).await }));
    let Err(Error::Client(ModbusError::Exception(code))) = refused else { panic!("{refused:?}") };
    assert_eq!(code, ExceptionCode::IllegalDataAddress);
}

#[test]
fn modbus_of_node_5() {
    // L1346, L1369.
    let request = [0x05, 0x10, 0x80, 0x09, 0x00, 0x02, 0x04, 0x00, 0x00, 0x03, 0xE8, 0x47, 0x8D];
    let reply = [0x05, 0x10, 0x80, 0x09, 0x00, 0x02, 0xB9, 0x8E];
    exchanged((5, &request, &reply), |device| {
        Box::pin(async move { TARGET_POSITION.at(device).write_async(1000).await.expect("written") })
    });
    // L1610.
    let request = [0x05, 0x10, 0x38, 0x02, 0x00, 0x02, 0x04, 0x00, 0x00, 0x00, 0x11, 0x94, 0x8B];
    let reply = [0x05, 0x10, 0x38, 0x02, 0x00, 0x02, 0xEC, 0xEC];
    exchanged((5, &request, &reply), |device| {
        Box::pin(async move { SAVE_32.at(device).write_async(0x11).await.expect("written") })
    });
    // L1269 and L1532: function 6 is answered by its echo.
    let request = [0x05, 0x06, 0x00, 0x03, 0x00, 0x0A, 0xF8, 0x49];
    exchanged((5, &request, &request), |device| {
        Box::pin(async move { D3.at(device).write_async(10).await.expect("written") })
    });
    let request = [0x05, 0x06, 0x38, 0x02, 0x00, 0x11, 0xE4, 0xE2];
    exchanged((5, &request, &request), |device| {
        Box::pin(async move { SAVE.at(device).write_async(0x11).await.expect("written") })
    });
    // L1123, L1162: three registers at once.
    let request = [0x05, 0x03, 0x00, 0x01, 0x00, 0x03, 0x55, 0x8F];
    let reply = [0x05, 0x03, 0x06, 0x00, 0x14, 0x00, 0x32, 0x00, 0x32, 0x03, 0xAC];
    let words = exchanged((5, &request, &reply), |device| {
        Box::pin(async move {
            let mut bytes = [0; 6];
            device.read(Register::low_first(1, 3), &mut bytes).await.expect("read");
            [0, 2, 4].map(|at| u16::from_le_bytes([bytes[at], bytes[at + 1]]))
        })
    });
    assert_eq!(words, [20, 50, 50]);
}

/// A node that expects requests, and has an answer to each.
struct Script(VecDeque<([u8; 8], [u8; 8])>);

impl CanPort for Script {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        let expected = self.0.front().map(|(request, _)| request.as_slice());
        assert_eq!((frame.id(), Some(frame.data())), (0x605, expected));
        Ok(true)
    }

    fn receive(
        &mut self,
        _: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let answer = self.0.pop_front().and_then(|(_, answer)| CanFrame::new(0x585, &answer));
        assert!(answer.as_ref().map_or(true, wanted));
        Ok(answer)
    }
}

fn node(script: &[([u8; 8], [u8; 8])]) -> Node<Script> {
    Node::new(Script(script.iter().copied().collect()), NodeId::new(5).expect("a node-ID"))
}

#[test]
fn sdo_expedited() -> Result<(), Error<Infallible>> {
    const HEARTBEAT: Item<u16, Rw, OnCanOpen> = Item::object(0x1017, 0, "Producer heartbeat time");
    const VENDOR: Item<u32, Ro, OnCanOpen> = Item::object(0x1018, 1, "Vendor-ID");
    // L2520, L2526.
    let mut own = node(&[([0x2B, 0x17, 0x10, 0, 0xA0, 0x0F, 0, 0], [0x60, 0x17, 0x10, 0, 0, 0, 0, 0])]);
    HEARTBEAT.at(&mut own).write(4000)?;
    // L2560.
    let mut own = node(&[([0x40, 0x18, 0x10, 1, 0, 0, 0, 0], [0x43, 0x18, 0x10, 1, 6, 0, 0, 0])]);
    assert_eq!(VENDOR.at(&mut own).read()?, 6);
    Ok(())
}

#[test]
fn sdo_segmented() -> Result<(), Error<Infallible>> {
    const NAME: Item<VisibleString, Ro, OnCanOpen> =
        Item::new(OnCanOpen::canopen(0x1008, 0), "Device name", Range::Full, Initial::Unknown, "", Flags::NONE);
    // L2590 to L2599.
    let mut own = node(&[
        ([0x40, 0x08, 0x10, 0, 0, 0, 0, 0], [0x41, 0x08, 0x10, 0, 0x1A, 0, 0, 0]),
        ([0x60, 0, 0, 0, 0, 0, 0, 0], [0x00, 0x54, 0x69, 0x6E, 0x79, 0x20, 0x4E, 0x6F]),
        ([0x70, 0, 0, 0, 0, 0, 0, 0], [0x10, 0x64, 0x65, 0x20, 0x2D, 0x20, 0x4D, 0x65]),
        ([0x60, 0, 0, 0, 0, 0, 0, 0], [0x00, 0x67, 0x61, 0x20, 0x44, 0x6F, 0x6D, 0x61]),
        ([0x70, 0, 0, 0, 0, 0, 0, 0], [0x15, 0x69, 0x6E, 0x73, 0x20, 0x21, 0, 0]),
    ]);
    let mut buffer = [0; 32];
    assert_eq!(NAME.at(&mut own).read_into(&mut buffer)?, "Tiny Node - Mega Domains !");
    Ok(())
}

#[test]
fn numbers_of_canopen() {
    let node = NodeId::new(1).expect("a node-ID");
    // L2738, L4432: identifiers of an invalid TPDO of node 25, and of an RPDO of node 1.
    assert_eq!(CobId::from_node(0x8000_0180).resolve(NodeId::new(25).expect("a node-ID")), 0x8000_0199);
    assert_eq!(CobId::from_node(0x200).resolve(node), 513);
    // L3086 to L3123: error control.
    let states =
        [(NmtState::BootUp, 0), (NmtState::Stopped, 4), (NmtState::Operational, 5), (NmtState::PreOperational, 0x7F)];
    for (state, number) in states {
        let frame = state.heartbeat(node);
        assert_eq!((frame.id(), frame.data()), (1792 + 1, [number].as_slice()));
    }
    // L4425 to L4534: mapping entries.
    for (index, sub_index, bits, word) in [
        (0x60C1, 1, 32, 0x60C1_0120),
        (0x6040, 0, 16, 0x6040_0010),
        (0x6064, 0, 32, 0x6064_0020),
        (0x6041, 0, 16, 0x6041_0010),
    ] {
        assert_eq!(MappedEntry::new(index, sub_index, bits).word(), word);
    }
    // L4466: SYNC.
    assert_eq!(lexibus::clients::canopen::sync().id(), 0x80);
    // L3351: the key that stores parameters.
    assert_eq!(StoreParameters::Save.raw().to_le_bytes(), *b"save");
}

#[test]
fn control_words_of_cia_402() {
    // L4284 to L4289, from a fault to operation.
    let mut sent = vec![Controlword::from_raw(0).with_command(Command::FaultReset).raw(), 0];
    for state in [State::SwitchOnDisabled, State::ReadyToSwitchOn, State::SwitchedOn] {
        let Step::Command(command) = state.toward(State::OperationEnabled) else { panic!("{state:?}") };
        sent.push(Controlword::from_raw(0).with_command(command).raw());
    }
    assert_eq!(sent, [0x0080, 0x0000, 0x0006, 0x0007, 0x000F]);
}

#[test]
fn profinet_is_big_endian() {
    // L6175: the status word 0x8640.
    let mut image = [0; 2];
    lexibus::profinet::be::put_number(&mut image, 0, 0, 16, 0x8640);
    assert_eq!(image, [0x86, 0x40]);
    assert_eq!(lexibus::profinet::be::number(&image, 0, 0, 16), 0x8640);
}
