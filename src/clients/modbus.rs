//! Modbus RTU and TCP, with `tokio-modbus`.
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use lexibus::clients::modbus::tokio_modbus::Slave;
//! use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
//! use lexibus::{Item, OnModbus, Register, Rw};
//!
//! type Speed = Item<u32, Rw, OnModbus>;
//! const SPEED: Speed = Speed::register(Register::high_first(10, 2), "Speed", lexibus::Flags::NONE);
//!
//! let timeout = Duration::from_secs(1);
//! let mut device = ModbusClient::new(BlockingLink::tcp("127.0.0.1:502".parse()?, Slave(1), timeout)?);
//! SPEED.at(&mut device).write(1500)?;
//!
//! // RTU needs a serial line of the crate `tokio-serial` and the address of the device.
//! let line = tokio_serial::new("/dev/ttyUSB0", 19_200);
//! let link = BlockingLink::open(async {
//!     Ok(Link::rtu(tokio_serial::SerialStream::open(&line)?, Slave(5), timeout))
//! })?;
//! let mut device = ModbusClient::new(link);
//! SPEED.at(&mut device).write(1500)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Link`] has a timeout and discards late replies. Contexts of `tokio-modbus` work too, but they don't discard late
//! replies, and async contexts have no timeout. After a late reply, a context of [`rtu`] returns the value of the
//! previous request for each request with the same length. After a late reply, a context of [`tcp`] rejects every
//! reply. Create a new context if a reply was late.
//!
//! With a [`BlockingLink`] or a context of [`sync`], a [`ModbusClient`] is a [`Client`] and a [`RegisterClient`]. With a
//! [`Link`] or a context of [`tcp`] or [`rtu`], it is an [`AsyncClient`] and an [`AsyncRegisterClient`].
//!
//! Some devices don't support all requests. Generated bindings list the supported requests in the constant `MODBUS`,
//! for [`with_limits`](ModbusClient::with_limits). A client with these limits uses only supported requests. If no
//! supported request fits, the client returns an error and sends nothing:
//!
//! ```
//! use lexibus::clients::modbus::ModbusClient;
//! use lexibus::modbus::{Limits, TableLimits};
//!
//! // The device doesn't support function 6, so function 16 writes a single register too.
//! const MODBUS: Limits = Limits {
//!     holding: TableLimits { functions: &[3, 16], max_write: 2, ..TableLimits::HOLDING },
//!     ..Limits::STANDARD
//! };
//! # let context = ();
//! let device = ModbusClient::new(context).with_limits(MODBUS);
//! ```
//!
//! To write a value that is a part of a register, the client reads the register and then writes it. No other client
//! should write the register between the read and the write. If the limits contain function 22, the device changes the
//! bits in one step.

use std::error;
use std::fmt;

use tokio::io::{AsyncRead, AsyncWrite};
use tokio_modbus::client::{Client as _, Context};
use tokio_modbus::{ExceptionCode, Response};

pub use tokio_modbus;
pub use tokio_modbus::client::{rtu, sync, tcp};

use crate::bus::Modbus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::modbus::{AsyncRegisterClient, Limits, RegisterClient};
use crate::register::{Register, RegisterTable};

mod link;
mod request;

pub use link::{BlockingLink, Link};
use request::{Answer, Echo, Writes};

/// Client for a device, over a context of `tokio-modbus`.
#[derive(Debug)]
pub struct ModbusClient<T> {
    context: T,
    limits: Limits,
    single: bool,
}

impl<T> ModbusClient<T> {
    /// Creates a client over `context`. The client writes one register with function 6, and several registers with
    /// function 16.
    pub const fn new(context: T) -> Self {
        Self { context, limits: Limits::STANDARD, single: true }
    }

    /// Returns the client with the limits of the device: the supported requests.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Sets whether a single register is written with function 6; some devices support only function 16. The client
    /// uses function 6 in any case if the [limits](Self::with_limits) don't contain function 16.
    #[must_use]
    pub fn with_single_writes(self, single: bool) -> Self {
        Self { single, ..self }
    }

    /// Returns the context.
    pub fn context(&mut self) -> &mut T {
        &mut self.context
    }

    /// Returns the context and drops the client.
    pub fn into_context(self) -> T {
        self.context
    }
}

/// Error of a Modbus access.
#[derive(Debug)]
#[non_exhaustive]
pub enum ModbusError {
    /// The device refused the request.
    Exception(ExceptionCode),
    /// Input registers and discrete inputs are read-only. Nothing was sent.
    ReadOnly,
    /// The device doesn't support the function for this access. Nothing was sent.
    Function {
        /// Table of the register.
        table: RegisterTable,
        /// Function code.
        function: u8,
    },
    /// The value is longer than the maximum of one request. Nothing was sent.
    TooLong {
        /// Number of registers or bits of the value.
        count: u16,
        /// Maximum number of registers or bits in one request.
        max: u16,
    },
    /// The value ends after the last address of the table, or has no registers. Nothing was sent.
    NoSuchAddress {
        /// First wire address of the value.
        address: u16,
        /// Number of registers or bits of the value.
        count: u16,
    },
    /// The transport failed, or the reply doesn't match the request.
    Bus(tokio_modbus::Error),
}

impl fmt::Display for ModbusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exception(code) => write!(f, "the device refused: {code}"),
            Self::ReadOnly => f.write_str("Modbus inputs are read-only"),
            Self::Function { table, function } => {
                let table = match table {
                    RegisterTable::Holding => "holding registers",
                    RegisterTable::Input => "input registers",
                    RegisterTable::Coil => "coils",
                    RegisterTable::DiscreteInput => "discrete inputs",
                };
                write!(f, "the device doesn't support function {function} for {table}")
            }
            Self::TooLong { count, max } => {
                write!(f, "the value has {count} registers or bits, but the maximum per request is {max}")
            }
            Self::NoSuchAddress { address, count } => {
                write!(f, "invalid address range: {count} registers or bits from address {address} on")
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
    ([$($generics:tt)*] $context:ty: $Client:ident $RegisterClient:ident $($async:ident $await:ident)?) => {
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
clients! {
    [T: AsyncRead + AsyncWrite + Unpin + Send + 'static] Link<T>: AsyncClient AsyncRegisterClient async await
}

#[cfg(test)]
mod tests;
