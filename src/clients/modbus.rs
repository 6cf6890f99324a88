//! Modbus RTU and TCP, with `tokio-modbus`.
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use lexibus::clients::modbus::tokio_modbus::Slave;
//! use lexibus::clients::modbus::{sync, ModbusClient};
//! use lexibus::{Item, OnModbus, Register, Rw};
//!
//! type Speed = Item<u32, Rw, OnModbus>;
//! const SPEED: Speed = Speed::register(Register::high_first(10, 2), "Speed", lexibus::Flags::NONE);
//!
//! // Without a time limit, a device that is silent is waited for without end.
//! let patience = Some(Duration::from_secs(1));
//! let context = sync::tcp::connect_with_timeout("127.0.0.1:502".parse()?, patience)?;
//! let mut device = ModbusClient::new(context);
//! SPEED.at(&mut device).write(1500)?;
//!
//! // RTU: a serial line of the crate `tokio-serial`, and the number of the device.
//! let line = tokio_serial::new("/dev/ttyUSB0", 19_200);
//! let context = sync::rtu::connect_slave_with_timeout(&line, Slave(5), patience)?;
//! let mut device = ModbusClient::new(context);
//! SPEED.at(&mut device).write(1500)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Contexts that don't block have no time limit of their own: `tokio::time::timeout` gives a call one.
//!
//! Modbus on a serial line doesn't say which request an answer is to. After a call that was given up, by a time limit or by dropping
//! it, the answer may come when the next request waits for its own: a write notices, because its answer repeats it, but a read takes
//! the value of another register of the same length. Make a new context after that; one of TCP numbers its requests, and fails
//! until its answers are in step again.
//!
//! A [`ModbusClient`] of a context of [`sync`] is a [`Client`] and a [`RegisterClient`]; one of a context of [`tcp`] or
//! [`rtu`] is an [`AsyncClient`] and an [`AsyncRegisterClient`].
//!
//! Not every device takes every request. Generated bindings say which ones, in the constant `MODBUS` that
//! [`with_limits`](ModbusClient::with_limits) takes; what the device doesn't take is refused before anything is sent, or sent as
//! what it does take:
//!
//! ```
//! use lexibus::clients::modbus::ModbusClient;
//! use lexibus::modbus::{Limits, TableLimits};
//!
//! // Function 6 isn't among them, so one register is written with function 16, too.
//! const MODBUS: Limits = Limits {
//!     holding: TableLimits { functions: &[3, 16], max_write: 2, ..TableLimits::HOLDING },
//!     ..Limits::STANDARD
//! };
//! # let context = ();
//! let device = ModbusClient::new(context).with_limits(MODBUS);
//! ```
//!
//! Where a value is a part of a register, the register is read before it is written, and nobody else should write it
//! meanwhile; where the limits name function 22, the device does both at once.

use std::error;
use std::fmt;

use tokio_modbus::client::{Client as _, Context};
use tokio_modbus::{ExceptionCode, Response};

pub use tokio_modbus;
pub use tokio_modbus::client::{rtu, sync, tcp};

use crate::bus::Modbus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::modbus::{AsyncRegisterClient, Limits, RegisterClient};
use crate::register::{Register, RegisterTable};

mod request;

use request::{Answer, Echo, Writes};

/// A device behind a context of `tokio-modbus`.
#[derive(Debug)]
pub struct ModbusClient<T> {
    context: T,
    limits: Limits,
    single: bool,
}

impl<T> ModbusClient<T> {
    /// The device that `context` talks to. One register is written with function 6, several with function 16.
    pub const fn new(context: T) -> Self {
        Self { context, limits: Limits::STANDARD, single: true }
    }

    /// The same device, of which it is known which requests it takes.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Whether one register is written with function 6. Some devices know function 16 only. Where the
    /// [limits](Self::with_limits) don't have function 16, it is 6 all the same.
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
    /// The device doesn't take the function that this needs. Nothing was sent.
    Function {
        /// The table.
        table: RegisterTable,
        /// The function.
        function: u8,
    },
    /// The value is longer than what the device takes in one request. Nothing was sent.
    TooLong {
        /// How many registers, or bits, the value has.
        count: u16,
        /// How many one request may be about.
        max: u16,
    },
    /// The table doesn't reach so far, or the value has no register at all. Nothing was sent.
    NoSuchAddress {
        /// Where the value begins.
        address: u16,
        /// How many registers, or bits, it has.
        count: u16,
    },
    /// The transport failed, or the answer is none to the request.
    Bus(tokio_modbus::Error),
}

impl fmt::Display for ModbusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exception(code) => write!(f, "the device refused: {code}"),
            Self::ReadOnly => f.write_str("inputs of Modbus can only be read"),
            Self::Function { table, function } => {
                let table = match table {
                    RegisterTable::Holding => "holding registers",
                    RegisterTable::Input => "input registers",
                    RegisterTable::Coil => "coils",
                    RegisterTable::DiscreteInput => "discrete inputs",
                };
                write!(f, "this needs function {function}, which the device doesn't take for {table}")
            }
            Self::TooLong { count, max } => {
                write!(f, "the value has {count} registers or bits, and a request may be about {max} at most")
            }
            Self::NoSuchAddress { address, count } => {
                write!(f, "no table has {count} registers or bits from address {address} on")
            }
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

impl From<ModbusError> for Error<ModbusError> {
    fn from(error: ModbusError) -> Self {
        Self::Client(error)
    }
}

type Reply = tokio_modbus::Result<Response>;

macro_rules! clients {
    ([$($generics:tt)*] $context:ident: $Client:ident $RegisterClient:ident $($async:ident $await:ident)?) => {
        impl<$($generics)*> $Client for ModbusClient<$context> {
            type Bus = Modbus;
            type Error = ModbusError;

            $($async)? fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<ModbusError>> {
                let mut answer = Answer::new(register, &self.limits)?;
                while let Some(request) = answer.request() {
                    answer.add(self.context.call(request)$(.$await)?)?;
                }
                answer.value(buffer)
            }

            $($async)? fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<ModbusError>> {
                let writes = Writes::new(register, &self.limits, self.single)?;
                let mut held = writes.held(&self.limits)?;
                if let Some(answer) = &mut held {
                    while let Some(request) = answer.request() {
                        answer.add(self.context.call(request)$(.$await)?)?;
                    }
                }
                for request in writes.requests(held.map(Answer::into_words), data)? {
                    let echo = Echo::of(&request);
                    echo.check(self.context.call(request)$(.$await)?)?;
                }
                Ok(())
            }
        }

        impl<$($generics)*> $RegisterClient for ModbusClient<$context> {
            fn limits(&self) -> &Limits {
                &self.limits
            }
        }
    };
}

clients! { [T: sync::Client] T: Client RegisterClient }
clients! { [] Context: AsyncClient AsyncRegisterClient async await }

#[cfg(test)]
mod tests;
