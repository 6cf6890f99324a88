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
//! previous request for each further request of the same length. After a late reply, a context of [`tcp`] rejects every
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
//! bits in one step. If the limits contain function 23, [`RegisterClient::exchange`] writes and reads with one request.
//!
//! # Broadcasts
//!
//! A [`Link`] with `Slave(0)` sends broadcasts on RTU: all devices execute the write, and no device replies (MODBUS
//! over Serial Line V1.02, 2.1). A write returns after the request was sent and the [turnaround
//! delay](Link::with_turnaround) has passed. `Ok` therefore doesn't mean that any device executed the write. A read
//! returns [`ModbusError::Broadcast`], and so does a write of a part of a register without function 22.
//!
//! ```no_run
//! # use std::time::Duration;
//! # use lexibus::clients::modbus::tokio_modbus::Slave;
//! # use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
//! # use lexibus::{Item, OnModbus, Register, Rw};
//! use lexibus::clients::modbus::tokio_modbus::prelude::SlaveContext;
//! # type Speed = Item<u32, Rw, OnModbus>;
//! # const SPEED: Speed = Speed::register(Register::high_first(10, 2), "Speed", lexibus::Flags::NONE);
//! # fn stop(mut device: ModbusClient<BlockingLink<tokio_serial::SerialStream>>) -> Result<(), Box<dyn std::error::Error>> {
//! device.context().set_slave(Slave::broadcast());
//! SPEED.at(&mut device).write(0)?; // all drives on the line stop
//! device.context().set_slave(Slave(5));
//! # Ok(())
//! # }
//! ```
//!
//! On TCP, unit 0 is the device at the other end of the connection, which replies (MODBUS Messaging on TCP/IP V1.0b,
//! 4.4.1). A gateway that forwards unit 0 as a broadcast doesn't reply; call [`Link::with_turnaround`] for such a
//! gateway. Contexts of `tokio-modbus` without a [`Link`] wait for a reply to a broadcast.

use std::error;
use std::fmt;

use tokio::io::{AsyncRead, AsyncWrite};
use tokio_modbus::client::{Client as _, Context};
use tokio_modbus::{ExceptionCode, Request, Response};

pub use tokio_modbus;
pub use tokio_modbus::client::{rtu, sync, tcp};

use crate::bus::Modbus;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::modbus::{masked, AsyncRegisterClient, Limits, RegisterClient};
use crate::register::{Register, RegisterTable};

mod exchange;
mod line;
mod link;
mod request;

use exchange::ReadWrite;
pub use link::{BlockingLink, Link, TURNAROUND};
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

    /// Sets the limits of the device: the functions that it supports, and the maximum number of registers or bits in a
    /// request.
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
    /// Devices don't reply to a broadcast, so a broadcast cannot read. The read was not sent. If
    /// [`RegisterClient::exchange`] doesn't use function 23, the write was sent before this error occurred.
    Broadcast,
    /// The device doesn't support the function for this access. The request was not sent.
    Function {
        /// Table of the register.
        table: RegisterTable,
        /// Function code.
        function: u8,
    },
    /// The value is longer than the maximum of one request. The request was not sent.
    TooLong {
        /// Number of registers or bits of the value.
        count: u16,
        /// Maximum number of registers or bits in one request.
        max: u16,
    },
    /// The value ends after the last address of the table, or has no registers. The request was not sent.
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
            Self::Broadcast => f.write_str("a broadcast cannot read, because devices don't reply to it"),
            Self::Function { table, function } => {
                write!(f, "the device doesn't support function {function} for {}s", table.name())
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

impl ModbusError {
    /// Returns whether another attempt may succeed. This is the case after [`Bus`](Self::Bus), and after the exceptions
    /// 6 (server device busy) and 11 (gateway target device failed to respond).
    #[must_use]
    pub const fn is_transient(&self) -> bool {
        use ExceptionCode::{GatewayTargetDevice, ServerDeviceBusy};
        matches!(self, Self::Bus(_) | Self::Exception(ServerDeviceBusy | GatewayTargetDevice))
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

            fn is_transient(&self, error: &ModbusError) -> bool {
                error.is_transient()
            }
        }

        impl<$($generics)*> $RegisterClient for ModbusClient<$context> {
            fn limits(&self) -> &Limits {
                &self.limits
            }

            $($async)? fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<ModbusError>> {
                if self.limits.holding.names(22) {
                    let request = Request::MaskWriteRegister(address, and, or);
                    let echo = Echo::of(&request);
                    return echo.check(self.context.call(request)$(.$await)?);
                }
                let (register, mut held) = (Register::holding(address), [0; 2]);
                $Client::read(self, register, &mut held)$(.$await)??;
                let word = masked(u16::from_le_bytes(held), and, or);
                $Client::write(self, register, &word.to_le_bytes())$(.$await)?
            }

            $($async)? fn write_and_read(
                &mut self,
                write: Register,
                data: &[u8],
                read: Register,
                buffer: &mut [u8],
            ) -> Result<usize, Error<ModbusError>> {
                if let Some(exchange) = ReadWrite::new(write, read, &self.limits) {
                    let request = exchange.request(data)?;
                    return exchange.value(self.context.call(request)$(.$await)?, buffer);
                }
                $Client::write(self, write, data)$(.$await)??;
                $Client::read(self, read, buffer)$(.$await)?
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
