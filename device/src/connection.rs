//! Connections to a device: raw bytes of values over a client of the runtime.

use std::fmt::Display;

use lexibus::{CanOpen, Client, Error};

use crate::address::{Address, Network};
use crate::failure::Failure;

mod registers;

pub use registers::ModbusConnection;
#[cfg(feature = "modbus")]
pub(crate) use registers::ModbusFailure;

/// Transfers the bytes of values to and from one device. The least significant byte of a number comes first.
pub trait Connection {
    /// Returns the protocol of the bus.
    fn network(&self) -> Network;

    /// Reads the value at `address`. On Modbus, `length` is the number of bytes of the value. On CANopen, the device
    /// determines the number of bytes.
    ///
    /// # Errors
    ///
    /// Returns the reason why the value was not transferred.
    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure>;

    /// Writes the value at `address`.
    ///
    /// # Errors
    ///
    /// Returns the reason why the value was not transferred. After a timeout or a bus failure, the device may have accepted
    /// the value.
    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure>;

    /// Reads the basic device identification of a Modbus device (function 43): the IDs of the objects, with their
    /// texts.
    ///
    /// # Errors
    ///
    /// Fails if the connection doesn't support the function, if the bus fails, or if the device refuses the request or sends
    /// no valid reply. The default implementation always fails.
    fn identification(&mut self) -> Result<Vec<(u8, String)>, Failure> {
        Err(Failure::Unsupported("the connection cannot read the device identification".to_owned()))
    }
}

impl<C: Connection + ?Sized> Connection for &mut C {
    fn network(&self) -> Network {
        C::network(self)
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        C::read(self, address, length)
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        C::write(self, address, data)
    }

    fn identification(&mut self) -> Result<Vec<(u8, String)>, Failure> {
        C::identification(self)
    }
}

impl<C: Connection + ?Sized> Connection for Box<C> {
    fn network(&self) -> Network {
        C::network(self)
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        C::read(self, address, length)
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        C::write(self, address, data)
    }

    fn identification(&mut self) -> Result<Vec<(u8, String)>, Failure> {
        C::identification(self)
    }
}

/// Connection to a CANopen device over a client of the runtime, such as [`Node`](lexibus::clients::canopen::Node).
#[derive(Clone, Debug)]
pub struct CanOpenConnection<C> {
    client: C,
}

impl<C> CanOpenConnection<C> {
    /// Creates a connection over `client`.
    pub const fn new(client: C) -> Self {
        Self { client }
    }

    /// Returns the client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the client and drops the connection.
    pub fn into_client(self) -> C {
        self.client
    }
}

/// Length of the buffer for the first attempt to read a value. By default, [`Node`](lexibus::clients::canopen::Node)
/// reads values up to this length without a block transfer, which some devices don't support.
const SHORT: usize = 900;
/// Maximum length of a value that can be read.
const LONG: usize = 1 << 20;

impl<C> Connection for CanOpenConnection<C>
where
    C: Client<Bus = CanOpen>,
    C::Error: Display,
{
    fn network(&self) -> Network {
        Network::CanOpen
    }

    fn read(&mut self, address: Address, _: usize) -> Result<Vec<u8>, Failure> {
        let Address::Object(object) = address else { return Err(wrong_bus()) };
        let mut buffer = vec![0; SHORT];
        let length = match self.client.read(object, &mut buffer) {
            Ok(length) if length <= SHORT => length,
            Ok(_) | Err(Error::Length(_)) => {
                buffer = vec![0; LONG];
                self.client.read(object, &mut buffer).map_err(failure)?
            }
            Err(error) => return Err(failure(error)),
        };
        buffer.truncate(length);
        Ok(buffer)
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        let Address::Object(object) = address else { return Err(wrong_bus()) };
        self.client.write(object, data).map_err(failure)
    }
}

fn wrong_bus() -> Failure {
    Failure::Bus("the address belongs to another bus".to_owned())
}

/// Converts an error of a CANopen client.
fn failure<E: Display>(error: Error<E>) -> Failure {
    match error {
        Error::Timeout => Failure::Timeout,
        Error::Abort(code) => Failure::Abort(code),
        error => Failure::Bus(error.to_string()),
    }
}
