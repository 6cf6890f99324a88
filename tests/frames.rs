//! Frames that the manual of the Eco drive prints, byte by byte: what comes out of the clients of CANopen and of Modbus RTU.
//! Lines are the manual's; its placeholders for the check are filled with what follows from the bytes in front of it.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::future::Future;
use std::pin::Pin;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, Node};
use lexibus::clients::modbus::tokio_modbus::client::{rtu, Context};
use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::ModbusClient;
use lexibus::{
    AsyncClient, Error, Flags, Initial, Item, NodeId, OnCanOpen, OnModbus, Range, Register, Ro, Rw, VisibleString,
};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

type Here<V> = Item<V, Rw, OnModbus>;
type Device = ModbusClient<Context>;

const CONTROL_WORD: Here<u32> = Here::register(Register::high_first(0x8000, 2), "control word", Flags::NONE);
const MODES_OF_OPERATION: Here<i32> = Here::register(Register::high_first(0x8001, 2), "mode", Flags::NONE);
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

/// Writes 32 bits to node 1: function 16 is answered by the first six bytes of the request and their check.
macro_rules! written {
    ($item:ident = $value:expr, $request:expr, $reply:expr) => {
        exchanged((1, &$request, &$reply), |device| {
            Box::pin(async move { $item.at(device).write_async($value).await.expect("written") })
        });
    };
}

#[test]
fn modbus_writes_of_two_registers() {
    // L1443 to L1495: the same two registers are answered alike, whatever is written.
    const CONTROL: [u8; 8] = [0x01, 0x10, 0x80, 0x00, 0x00, 0x02, 0x68, 0x08];
    const MODE: [u8; 8] = [0x01, 0x10, 0x80, 0x01, 0x00, 0x02, 0x39, 0xC8];
    written!(CONTROL_WORD = 8, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0x08, 0x93, 0xAF], CONTROL);
    written!(CONTROL_WORD = 3, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0x03, 0xD2, 0x68], CONTROL);
    written!(CONTROL_WORD = 0x43, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0x43, 0xD3, 0x98], CONTROL);
    written!(CONTROL_WORD = 0, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0, 0x92, 0x69], CONTROL);
    written!(CONTROL_WORD = 0x23, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0x23, 0xD3, 0xB0], CONTROL);
    written!(CONTROL_WORD = 0x20, [1, 0x10, 0x80, 0, 0, 2, 4, 0, 0, 0, 0x20, 0x93, 0xB1], CONTROL);
    written!(MODES_OF_OPERATION = 6, [1, 0x10, 0x80, 1, 0, 2, 4, 0, 0, 0, 0x06, 0xD3, 0xA7], MODE);
    written!(MODES_OF_OPERATION = 1, [1, 0x10, 0x80, 1, 0, 2, 4, 0, 0, 0, 0x01, 0x92, 0x65], MODE);
    // L1492: the sign goes through both registers.
    written!(MODES_OF_OPERATION = -50, [1, 0x10, 0x80, 1, 0, 2, 4, 0xFF, 0xFF, 0xFF, 0xCE, 0x93, 0xE5], MODE);
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
