use core::future::Future;
use core::pin::pin;
use core::task::{Context as TaskContext, Poll};
use std::boxed::Box;
use std::collections::HashMap;
use std::io;

use tokio_modbus::prelude::SlaveContext;
use tokio_modbus::Slave;

use super::*;
use crate::{Flags, Item, OnModbus, Ro, Rw};

type Here<V, A> = Item<V, A, OnModbus>;
const SPEED: Here<u32, Rw> = Here::register(Register::low_first(10, 2), "Speed", Flags::NONE);
const TORQUE: Here<i16, Rw> = Here::register(Register::holding(12), "Torque", Flags::NONE);
const UPPER: Here<u8, Rw> = Here::register(Register::holding(13).part(8, 8), "Upper", Flags::NONE);
const VALVE: Here<bool, Rw> = Here::register(Register::new(RegisterTable::Coil, 3, 1), "Valve", Flags::NONE);
const LEVEL: Here<u16, Ro> = Here::register(Register::new(RegisterTable::Input, 4, 1), "Level", Flags::NONE);
const MISSING: Here<u16, Rw> = Here::register(Register::holding(999), "Missing", Flags::NONE);

/// A device that answers at once, and keeps the functions that it was asked for.
#[derive(Debug, Default)]
struct Device {
    holding: HashMap<u16, u16>,
    coils: HashMap<u16, bool>,
    functions: Vec<u8>,
}

impl Device {
    fn answer(&mut self, request: Request<'_>) -> Reply {
        self.functions.push(request.function_code().value());
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
                bits.resize(8, false);
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

/// The same for a context that doesn't block.
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

fn now<F: Future>(future: F) -> F::Output {
    match pin!(future).poll(&mut TaskContext::from_waker(&std::task::Waker::from(std::sync::Arc::new(Silent)))) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("the future waits"),
    }
}

struct Silent;

impl std::task::Wake for Silent {
    fn wake(self: std::sync::Arc<Self>) {}
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
    let Err(Error::Client(error)) = MISSING.at(&mut device).read() else { panic!("it doesn't exist") };
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
