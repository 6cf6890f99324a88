use core::future::Future;
use std::boxed::Box;
use std::collections::HashMap;
use std::io;

use tokio_modbus::prelude::SlaveContext;
use tokio_modbus::Slave;

use super::*;
use crate::modbus::{Span, TableLimits};
use crate::now::now;
use std::string::String;
use std::vec::Vec;

use tokio_modbus::Request;

use crate::{Flags, Item, OnModbus, Ro, Rw};

type RegisterItem<V, A> = Item<V, A, OnModbus>;
const SPEED: RegisterItem<u32, Rw> = RegisterItem::register(Register::low_first(10, 2), "Speed", Flags::NONE);
const TORQUE: RegisterItem<i16, Rw> = RegisterItem::register(Register::holding(12), "Torque", Flags::NONE);
const UPPER: RegisterItem<u8, Rw> = RegisterItem::register(Register::holding(13).part(8, 8), "Upper", Flags::NONE);
const VALVE: RegisterItem<bool, Rw> =
    RegisterItem::register(Register::new(RegisterTable::Coil, 3, 1), "Valve", Flags::NONE);
const LEVEL: RegisterItem<u16, Ro> =
    RegisterItem::register(Register::new(RegisterTable::Input, 4, 1), "Level", Flags::NONE);
const MISSING: RegisterItem<u16, Rw> = RegisterItem::register(Register::holding(999), "Missing", Flags::NONE);

/// A device that sends each reply one request late. The first request times out.
#[derive(Debug, Default)]
pub(super) struct Late {
    device: Device,
    late: Option<Reply>,
}

impl SlaveContext for Late {
    fn set_slave(&mut self, _: Slave) {}
}

impl sync::Client for Late {
    fn call(&mut self, request: Request<'_>) -> Reply {
        let reply = self.device.answer(request);
        let silent = || Err(tokio_modbus::Error::Transport(io::ErrorKind::TimedOut.into()));
        self.late.replace(reply).unwrap_or_else(silent)
    }
}

#[test]
fn a_late_answer_to_a_write_is_none_to_another() {
    const OTHER: RegisterItem<i16, Rw> = RegisterItem::register(Register::holding(14), "Other", Flags::NONE);
    let mut device = ModbusClient::new(Late::default());
    assert!(matches!(TORQUE.at(&mut device).write(5).map_err(Error::from), Err(Error::Timeout)));
    assert!(matches!(OTHER.at(&mut device).write(5).map_err(Error::from), Err(Error::UnexpectedReply)));
    assert!(matches!(SPEED.at(&mut device).write(5).map_err(Error::from), Err(Error::UnexpectedReply)));
    assert!(matches!(VALVE.at(&mut device).write(true).map_err(Error::from), Err(Error::UnexpectedReply)));
}

#[test]
fn what_no_table_has_isnt_asked_for() {
    const LAST: RegisterItem<u32, Rw> = RegisterItem::register(Register::high_first(0xFFFF, 2), "Last", Flags::NONE);
    const NONE: RegisterItem<bool, Rw> =
        RegisterItem::register(Register::new(RegisterTable::Coil, 5, 0), "None", Flags::NONE);
    let mut device = limited(TableLimits { max_read: 1, max_write: 1, split: true, ..TableLimits::HOLDING });
    let refused =
        [LAST.at(&mut device).write(1), LAST.at(&mut device).read().map(|_| ()), NONE.at(&mut device).write(true)];
    for refused in refused {
        let refused = refused.map_err(Error::from);
        assert!(matches!(refused, Err(Error::Client(ModbusError::NoSuchAddress { .. }))), "{refused:?}");
    }
    assert_eq!(device.context().functions, []);
}

#[test]
fn what_bits_dont_hold_isnt_written() {
    const NIBBLE: RegisterItem<u8, Rw> =
        RegisterItem::register(Register::holding(13).part(4, 4), "Nibble", Flags::NONE);
    const BYTE: RegisterItem<u8, Rw> =
        RegisterItem::register(Register::new(RegisterTable::Coil, 3, 1), "Byte", Flags::NONE);
    let mut device = ModbusClient::new(Device::default());
    for refused in [NIBBLE.at(&mut device).write(0x1F), BYTE.at(&mut device).write(2)] {
        let refused = refused.map_err(Error::from);
        assert!(matches!(refused, Err(Error::OutOfRange(_))), "{refused:?}");
    }
    NIBBLE.at(&mut device).write(0x0F).unwrap();
    BYTE.at(&mut device).write(1).unwrap();
    assert_eq!((device.context().holding[&13], device.context().coils[&3]), (0xF0, true));
}

/// A device that replies at once, and records the function codes of the requests.
#[derive(Debug, Default)]
pub(super) struct Device {
    pub holding: HashMap<u16, u16>,
    coils: HashMap<u16, bool>,
    functions: Vec<u8>,
    pub requests: Vec<String>,
}

impl Device {
    fn answer(&mut self, request: Request<'_>) -> Reply {
        self.functions.push(request.function_code().value());
        self.requests.push(std::format!("{request:?}"));
        let span = |first: u16, count: u16| first..first + count;
        Ok(Ok(match request {
            Request::ReadHoldingRegisters(999, _) => return Ok(Err(ExceptionCode::IllegalDataAddress)),
            Request::ReadHoldingRegisters(first, count) => Response::ReadHoldingRegisters(
                span(first, count).map(|at| self.holding.get(&at).copied().unwrap_or(0)).collect(),
            ),
            Request::ReadInputRegisters(first, count) => {
                Response::ReadInputRegisters(span(first, count).map(|at| at * 2).collect())
            }
            Request::ReadCoils(first, count) => {
                let mut bits: Vec<bool> =
                    span(first, count).map(|at| self.coils.get(&at).copied().unwrap_or(false)).collect();
                bits.resize(bits.len().next_multiple_of(8), false);
                Response::ReadCoils(bits)
            }
            Request::WriteSingleRegister(at, word) => {
                self.holding.insert(at, word);
                Response::WriteSingleRegister(at, word)
            }
            Request::WriteMultipleRegisters(first, words) => {
                self.holding.extend((first..).zip(words.iter().copied()));
                Response::WriteMultipleRegisters(first, words.len() as u16)
            }
            Request::WriteSingleCoil(at, bit) => {
                self.coils.insert(at, bit);
                Response::WriteSingleCoil(at, bit)
            }
            Request::WriteMultipleCoils(first, bits) => {
                self.coils.extend((first..).zip(bits.iter().copied()));
                Response::WriteMultipleCoils(first, bits.len() as u16)
            }
            Request::MaskWriteRegister(at, and, or) => {
                let held = self.holding.entry(at).or_default();
                *held = *held & and | or & !and;
                Response::MaskWriteRegister(at, and, or)
            }
            Request::ReadWriteMultipleRegisters(first, count, to, words) => {
                self.holding.extend((to..).zip(words.iter().copied()));
                let held = |at: u16| self.holding.get(&at).copied().unwrap_or(0);
                Response::ReadWriteMultipleRegisters(span(first, count).map(held).collect())
            }
            _ => return Ok(Err(ExceptionCode::IllegalFunction)),
        }))
    }
}

impl SlaveContext for Device {
    fn set_slave(&mut self, _: Slave) {}
}

impl sync::Client for Device {
    fn call(&mut self, request: Request<'_>) -> Reply {
        self.answer(request)
    }
}

/// The same device for an async context.
type Call<'f, T> = core::pin::Pin<Box<dyn Future<Output = T> + Send + 'f>>;

impl tokio_modbus::client::Client for Device {
    fn call<'s, 'r, 'f>(&'s mut self, request: Request<'r>) -> Call<'f, Reply>
    where
        's: 'f,
        'r: 'f,
    {
        Box::pin(async move { self.answer(request) })
    }

    fn disconnect<'s, 'f>(&'s mut self) -> Call<'f, io::Result<()>>
    where
        's: 'f,
    {
        Box::pin(async { Ok(()) })
    }
}

#[test]
fn words_and_functions() {
    let mut device = ModbusClient::new(Device::default());
    SPEED.at(&mut device).write(0x0001_0002).unwrap();
    TORQUE.at(&mut device).write(-5).unwrap();
    assert_eq!((device.context().holding[&10], device.context().holding[&11]), (2, 1));
    assert_eq!(SPEED.at(&mut device).read().unwrap(), 0x0001_0002);
    assert_eq!(TORQUE.at(&mut device).read().unwrap(), -5);
    assert_eq!(device.context().functions, [16, 6, 3, 3]);
    let mut device = ModbusClient::new(Device::default()).with_single_writes(false);
    TORQUE.at(&mut device).write(-5).unwrap();
    assert_eq!(device.into_context().functions, [16]);
}

#[test]
fn parts_keep_the_other_bits() {
    let mut device = ModbusClient::new(Device::default());
    device.context().holding.insert(13, 0x1234);
    UPPER.at(&mut device).write(0xAB).unwrap();
    assert_eq!(device.context().holding[&13], 0xAB34);
    assert_eq!(UPPER.at(&mut device).read().unwrap(), 0xAB);
}

#[test]
fn bits_and_inputs() {
    let mut device = ModbusClient::new(Device::default());
    VALVE.at(&mut device).write(true).unwrap();
    assert!(device.context().coils[&3] && VALVE.at(&mut device).read().unwrap());
    assert_eq!(LEVEL.at(&mut device).read().unwrap(), 8);
    let refused = Client::write(&mut device, LEVEL.location().modbus, &[0, 0]);
    assert!(matches!(refused, Err(Error::Client(ModbusError::ReadOnly))));
}

#[test]
fn exceptions() {
    let mut device = ModbusClient::new(Device::default());
    let Err(Error::Client(error)) = MISSING.at(&mut device).read().map_err(Error::from) else {
        panic!("it doesn't exist")
    };
    assert!(matches!(error, ModbusError::Exception(ExceptionCode::IllegalDataAddress)));
    assert!(std::format!("{error}").starts_with("the device refused: "));
}

#[test]
fn without_blocking() {
    let mut device =
        ModbusClient::new(Context::from(Box::new(Device::default()) as Box<dyn tokio_modbus::client::Client>));
    now(async {
        SPEED.at(&mut device).write_async(70_000).await.unwrap();
        UPPER.at(&mut device).write_async(7).await.unwrap();
        VALVE.at(&mut device).write_async(true).await.unwrap();
        assert_eq!(SPEED.at(&mut device).read_async().await.unwrap(), 70_000);
        assert_eq!(UPPER.at(&mut device).read_async().await.unwrap(), 7);
        assert!(VALVE.at(&mut device).read_async().await.unwrap());
        assert!(MISSING.at(&mut device).read_async().await.is_err());
    });
}

fn limited(holding: TableLimits) -> ModbusClient<Device> {
    ModbusClient::new(Device::default()).with_limits(Limits { holding, ..Limits::STANDARD })
}

#[test]
fn what_the_device_takes() {
    let mut device = limited(TableLimits { functions: &[3, 16], ..TableLimits::HOLDING });
    TORQUE.at(&mut device).write(-5).unwrap();
    assert_eq!(device.context().functions, [16]);
    // The device supports only function 6, which writes one register although the caller prefers function 16.
    let mut device = limited(TableLimits { functions: &[3, 6], ..TableLimits::HOLDING }).with_single_writes(false);
    TORQUE.at(&mut device).write(-5).unwrap();
    let refused = SPEED.at(&mut device).write(70_000).map_err(Error::from);
    assert!(matches!(refused, Err(Error::Client(ModbusError::Function { function: 16, .. }))));
    assert_eq!(device.context().functions, [6]);
    // The device cannot read the registers, so a part of a register cannot be written either.
    let mut device = limited(TableLimits { functions: &[6, 16], ..TableLimits::HOLDING });
    for refused in [TORQUE.at(&mut device).read().map(|_| ()), UPPER.at(&mut device).write(1)] {
        let Err(Error::Client(error)) = refused.map_err(Error::from) else { panic!("it isn't readable") };
        assert_eq!(std::format!("{error}"), "the device doesn't support function 3 for holding registers");
    }
    assert_eq!(device.context().functions, []);
}

#[test]
fn widths() {
    const LONG: RegisterItem<u64, Rw> = RegisterItem::register(Register::high_first(20, 4), "Long", Flags::NONE);
    let narrow = TableLimits { max_read: 2, max_write: 3, ..TableLimits::HOLDING };
    let mut device = limited(narrow);
    SPEED.at(&mut device).write(70_000).unwrap();
    assert!(matches!(
        LONG.at(&mut device).write(1).map_err(Error::from),
        Err(Error::Client(ModbusError::TooLong { count: 4, max: 3 }))
    ));
    let Err(Error::Client(error)) = LONG.at(&mut device).read().map_err(Error::from) else { panic!("it is too long") };
    assert_eq!(std::format!("{error}"), "the value has 4 registers or bits, but the maximum per request is 2");
    assert_eq!(device.context().functions, [16]);

    let mut device = limited(TableLimits { split: true, ..narrow });
    LONG.at(&mut device).write(0x0001_0002_0003_0004).unwrap();
    assert_eq!(LONG.at(&mut device).read().unwrap(), 0x0001_0002_0003_0004);
    assert_eq!(
        device.context().requests,
        [
            "WriteMultipleRegisters(20, [1, 2, 3])",
            "WriteSingleRegister(23, 4)",
            "ReadHoldingRegisters(20, 2)",
            "ReadHoldingRegisters(22, 2)"
        ]
    );

    let mut device = limited(TableLimits { functions: &[3, 6], split: true, ..TableLimits::HOLDING });
    SPEED.at(&mut device).write(0x0001_0002).unwrap();
    assert_eq!(device.context().requests, ["WriteSingleRegister(10, 2)", "WriteSingleRegister(11, 1)"]);
}

#[test]
fn addresses_of_32_bits_are_never_taken_apart() {
    const WIDE: RegisterItem<u64, Rw> =
        RegisterItem::register(Register::high_first(20, 4).words_per_address(2), "Wide", Flags::NONE);
    let mut device = limited(TableLimits { max_write: 3, split: true, ..TableLimits::HOLDING });
    WIDE.at(&mut device).write(0x0001_0002_0003_0004).unwrap();
    assert_eq!(device.context().requests, ["WriteMultipleRegisters(20, [1, 2])", "WriteMultipleRegisters(21, [3, 4])"]);
    let mut device = limited(TableLimits { max_write: 1, split: true, ..TableLimits::HOLDING });
    assert!(WIDE.at(&mut device).write(1).is_err());
    assert_eq!(device.context().functions, []);
}

#[test]
fn a_device_that_changes_bits_itself() {
    let mut device = limited(TableLimits { functions: &[3, 6, 22], ..TableLimits::HOLDING });
    device.context().holding.insert(13, 0x1234);
    UPPER.at(&mut device).write(0xAB).unwrap();
    assert_eq!(device.context().holding[&13], 0xAB34);
    const SWAPPED: RegisterItem<u8, Rw> =
        RegisterItem::register(Register::holding(13).swapped().part(8, 4), "Swapped", Flags::NONE);
    SWAPPED.at(&mut device).write(0xC).unwrap();
    assert_eq!((device.context().holding[&13], SWAPPED.at(&mut device).read().unwrap()), (0xAB3C, 0xC));
    assert_eq!(device.context().functions, [22, 22, 3]);
}

#[test]
fn several_coils() {
    const VALVES: RegisterItem<u16, Rw> =
        RegisterItem::register(Register::new(RegisterTable::Coil, 3, 10), "Valves", Flags::NONE);
    let mut device = ModbusClient::new(Device::default());
    VALVES.at(&mut device).write(0x2A5).unwrap();
    assert_eq!(device.context().functions, [15]);
    let coil = TableLimits { functions: &[1, 5], ..TableLimits::COIL };
    let mut device = ModbusClient::new(Device::default()).with_limits(Limits { coil, ..Limits::STANDARD });
    VALVE.at(&mut device).write(true).unwrap();
    let refused = VALVES.at(&mut device).write(1).map_err(Error::from);
    assert!(matches!(refused, Err(Error::Client(ModbusError::Function { function: 15, .. }))));
    let coil = TableLimits { split: true, ..coil };
    let mut device = ModbusClient::new(Device::default()).with_limits(Limits { coil, ..Limits::STANDARD });
    VALVES.at(&mut device).write(0x2A5).unwrap();
    assert!(device.context().functions.iter().all(|&function| function == 5));
    assert_eq!(VALVES.at(&mut device).read().unwrap(), 0x2A5);
}

#[test]
fn blocks() {
    const READABLE: &[Span] = &[Span::new(10, 13)];
    let mut device = limited(TableLimits { readable: READABLE, ..TableLimits::HOLDING });
    SPEED.at(&mut device).write(70_000).unwrap();
    device.context().holding.insert(13, 0x1234);
    device.context().coils.insert(3, true);
    device.context().requests.clear();
    let values = device.read_block((UPPER, VALVE, SPEED, LEVEL)).unwrap();
    assert_eq!(values, (0x12, true, 70_000, 8));
    assert_eq!(
        device.context().requests,
        ["ReadHoldingRegisters(10, 4)", "ReadCoils(3, 1)", "ReadInputRegisters(4, 1)"]
    );
    let context = Box::new(device.into_context()) as Box<dyn tokio_modbus::client::Client>;
    let mut device = ModbusClient::new(Context::from(context));
    let values = now(device.read_block_async([TORQUE, TORQUE])).unwrap();
    assert_eq!(values, [0, 0]);
    assert!(now(device.read_block_async((MISSING,))).is_err());
}
