//! Connections over Modbus.

use lexibus::sim::Fault;
use lexibus::{Client, Error, Modbus, Register, RegisterTable};

use super::wrong_bus;
use crate::address::{Address, Network};
use crate::failure::Failure;
use crate::Connection;

/// Connection to a Modbus device over a client of the runtime.
#[derive(Clone, Debug)]
pub struct ModbusConnection<C> {
    client: C,
}

impl<C> ModbusConnection<C> {
    /// Creates a connection over `client`.
    pub const fn new(client: C) -> Self {
        Self { client }
    }

    /// Returns the client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }
}

/// An error of a Modbus client that can be converted to a [`Failure`].
pub trait ModbusFailure {
    /// Converts the error.
    fn into_failure(self) -> Failure;
}

/// Returns the failure for an exception code. After the codes 5 and 11, the device may have executed the request.
fn exception_of(code: u8) -> Failure {
    match code {
        5 | 11 => Failure::Unconfirmed(code),
        code => Failure::Exception(code),
    }
}

impl ModbusFailure for Fault {
    fn into_failure(self) -> Failure {
        match self {
            Fault::Abort(code) => Failure::Abort(code),
            Fault::Exception(exception) => exception_of(exception.code()),
            other => Failure::Bus(other.to_string()),
        }
    }
}

#[cfg(feature = "modbus")]
impl ModbusFailure for lexibus::clients::modbus::ModbusError {
    fn into_failure(self) -> Failure {
        use lexibus::clients::modbus::tokio_modbus;
        use lexibus::clients::modbus::ModbusError;
        match self {
            ModbusError::Exception(code) => exception_of(code.into()),
            ModbusError::Bus(tokio_modbus::Error::Transport(error)) if error.kind() == std::io::ErrorKind::TimedOut => {
                Failure::Timeout
            }
            ModbusError::Bus(error) => Failure::Bus(error.to_string()),
            error => Failure::Unsupported(error.to_string()),
        }
    }
}

impl<C> Connection for ModbusConnection<C>
where
    C: Client<Bus = Modbus>,
    C::Error: ModbusFailure,
{
    fn network(&self) -> Network {
        Network::Modbus
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        let Address::Register(register) = address else { return Err(wrong_bus()) };
        let mut buffer = vec![0; length.max(1).min(capacity(&register))];
        let read = self.client.read(register, &mut buffer).map_err(failure)?;
        buffer.truncate(read);
        Ok(buffer)
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        let Address::Register(register) = address else { return Err(wrong_bus()) };
        self.client.write(register, data).map_err(failure)
    }
}

/// Returns the number of bytes of the registers, coils or discrete inputs.
fn capacity(register: &Register) -> usize {
    match register.table {
        RegisterTable::Coil | RegisterTable::DiscreteInput => usize::from(register.count).div_ceil(8),
        RegisterTable::Holding | RegisterTable::Input => 2 * usize::from(register.count),
    }
}

/// Converts an error of a Modbus client.
fn failure<E: ModbusFailure>(error: Error<E>) -> Failure {
    match error {
        Error::Client(error) => error.into_failure(),
        Error::Timeout => Failure::Timeout,
        Error::Abort(code) => Failure::Abort(code),
        Error::Length(error) => Failure::Unsupported(error.to_string()),
        _ => Failure::Unsupported("the client cannot transfer the value".to_owned()),
    }
}
