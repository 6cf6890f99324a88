//! Modbus RTU and TCP, with `tokio-modbus`.
//!
//! ```no_run
//! use lexibus::clients::modbus::{sync, ModbusClient};
//! use lexibus::{Item, OnModbus, Register, Rw};
//!
//! type Speed = Item<u32, Rw, OnModbus>;
//! const SPEED: Speed = Speed::register(Register::high_first(10, 2), "Speed", lexibus::Flags::NONE);
//!
//! let context = sync::tcp::connect("127.0.0.1:502".parse()?)?;
//! let mut device = ModbusClient::new(context);
//! SPEED.at(&mut device).write(1500)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`ModbusClient`] of a context of [`sync`] is a [`Client`]; one of a context of [`tcp`] or [`rtu`] is an [`AsyncClient`].
//! Where a value is a part of a register, the register is read before it is written; nobody else should write it meanwhile.

use std::error;
use std::fmt;
use std::vec;
use std::vec::Vec;

use tokio_modbus::client::{Client as _, Context};
use tokio_modbus::{ExceptionCode, Request, Response};

pub use tokio_modbus;
pub use tokio_modbus::client::{rtu, sync, tcp};

use crate::bus::Modbus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::register::{Register, RegisterTable};

/// A device behind a context of `tokio-modbus`.
#[derive(Debug)]
pub struct ModbusClient<T> {
    context: T,
    single: bool,
}

impl<T> ModbusClient<T> {
    /// The device that `context` talks to. One register is written with function 6, several with function 16.
    pub const fn new(context: T) -> Self {
        Self { context, single: true }
    }

    /// Whether one register is written with function 6. Some devices know function 16 only.
    #[must_use]
    pub fn with_single_writes(self, single: bool) -> Self {
        Self { single, ..self }
    }

    /// The context.
    pub fn context(&mut self) -> &mut T {
        &mut self.context
    }

    /// Gives the context back.
    pub fn into_context(self) -> T {
        self.context
    }
}

/// What can go wrong on Modbus.
#[derive(Debug)]
#[non_exhaustive]
pub enum ModbusError {
    /// The device refused.
    Exception(ExceptionCode),
    /// Inputs and discrete inputs can only be read. Nothing was sent.
    ReadOnly,
    /// The transport failed, or the answer is none to the request.
    Bus(tokio_modbus::Error),
}

impl fmt::Display for ModbusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exception(code) => write!(f, "the device refused: {code}"),
            Self::ReadOnly => f.write_str("inputs of Modbus can only be read"),
            Self::Bus(error) => error.fmt(f),
        }
    }
}

impl error::Error for ModbusError {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Bus(error) => error.source(),
            _ => None,
        }
    }
}

type Reply = tokio_modbus::Result<Response>;

fn response(reply: Reply) -> Result<Response, Error<ModbusError>> {
    match reply {
        Ok(Ok(response)) => Ok(response),
        Ok(Err(code)) => Err(Error::Client(ModbusError::Exception(code))),
        Err(error) => Err(Error::Client(ModbusError::Bus(error))),
    }
}

/// What asks for a value.
fn read_request(register: Register) -> Request<'static> {
    let Register { address, count, .. } = register;
    match register.table {
        RegisterTable::Holding => Request::ReadHoldingRegisters(address, count),
        RegisterTable::Input => Request::ReadInputRegisters(address, count),
        RegisterTable::Coil => Request::ReadCoils(address, count),
        RegisterTable::DiscreteInput => Request::ReadDiscreteInputs(address, count),
    }
}

/// The registers of an answer.
fn words(reply: Reply, count: u16) -> Result<Vec<u16>, Error<ModbusError>> {
    match response(reply)? {
        Response::ReadHoldingRegisters(words) | Response::ReadInputRegisters(words)
            if words.len() == usize::from(count) =>
        {
            Ok(words)
        }
        _ => Err(Error::UnexpectedReply),
    }
}

/// Puts the value of an answer to the start of `buffer`.
fn value(register: Register, reply: Reply, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
    if matches!(register.table, RegisterTable::Holding | RegisterTable::Input) {
        return Ok(register.decode(&words(reply, register.count)?, buffer)?);
    }
    let (Response::ReadCoils(bits) | Response::ReadDiscreteInputs(bits)) = response(reply)? else {
        return Err(Error::UnexpectedReply);
    };
    // What is missing to a whole byte comes along.
    let bits = bits.get(..usize::from(register.count)).ok_or(Error::UnexpectedReply)?;
    for (byte, bits) in buffer.iter_mut().zip(bits.chunks(8)) {
        *byte = bits.iter().rev().fold(0, |byte, bit| byte << 1 | u8::from(*bit));
    }
    Ok(bits.len().div_ceil(8))
}

/// Whether the registers are read before they are written, because only a part of them changes.
fn is_part(register: Register) -> bool {
    register.table == RegisterTable::Holding && register.part.is_some()
}

/// What writes a value: `held` is what the registers hold, where only a part of them changes.
fn write_request(
    register: Register,
    held: Option<Vec<u16>>,
    data: &[u8],
    single: bool,
) -> Result<Request<'static>, Error<ModbusError>> {
    match register.table {
        RegisterTable::Holding => {
            let mut words = held.unwrap_or_else(|| vec![0; usize::from(register.count)]);
            register.encode(data, &mut words)?;
            Ok(match words.as_slice() {
                [word] if single => Request::WriteSingleRegister(register.address, *word),
                _ => Request::WriteMultipleRegisters(register.address, words.into()),
            })
        }
        RegisterTable::Coil => Ok(write_coils(register, data)),
        RegisterTable::Input | RegisterTable::DiscreteInput => Err(Error::Client(ModbusError::ReadOnly)),
    }
}

/// What writes bits.
fn write_coils(register: Register, data: &[u8]) -> Request<'static> {
    let bit = |at: usize| data.get(at / 8).is_some_and(|byte| byte >> (at % 8) & 1 == 1);
    match register.count {
        1 => Request::WriteSingleCoil(register.address, bit(0)),
        count => Request::WriteMultipleCoils(register.address, (0..usize::from(count)).map(bit).collect()),
    }
}

/// Whether the answer to a write says that it was done.
fn written(reply: Reply) -> Result<(), Error<ModbusError>> {
    match response(reply)? {
        Response::WriteSingleRegister(..)
        | Response::WriteMultipleRegisters(..)
        | Response::WriteSingleCoil(..)
        | Response::WriteMultipleCoils(..) => Ok(()),
        _ => Err(Error::UnexpectedReply),
    }
}

impl<T: sync::Client> Client for ModbusClient<T> {
    type Bus = Modbus;
    type Error = ModbusError;

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
        value(register, self.context.call(read_request(register)), buffer)
    }

    fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<ModbusError>> {
        let held = match is_part(register) {
            true => Some(words(self.context.call(read_request(register)), register.count)?),
            false => None,
        };
        let request = write_request(register, held, data, self.single)?;
        written(self.context.call(request))
    }
}

impl AsyncClient for ModbusClient<Context> {
    type Bus = Modbus;
    type Error = ModbusError;

    async fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
        value(register, self.context.call(read_request(register)).await, buffer)
    }

    async fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<ModbusError>> {
        let held = match is_part(register) {
            true => Some(words(self.context.call(read_request(register)).await, register.count)?),
            false => None,
        };
        let request = write_request(register, held, data, self.single)?;
        written(self.context.call(request).await)
    }
}

#[cfg(test)]
mod tests;
