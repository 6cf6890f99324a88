//! Clients of simulated devices.

use core::borrow::BorrowMut;
use core::fmt;
use core::marker::PhantomData;
use core::time::Duration;

use super::device::{Device, Network};
use super::fault::Fault;
use crate::bus::{CanOpen, CoE, Modbus, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::modbus::{AsyncRegisterClient, RegisterClient};
use crate::register::Register;

/// Blocking and async client for a simulated device on the bus `B`. [`Device::client`] creates a client. `D` is the
/// device or a reference to the device.
pub struct Connection<B, D = Device> {
    device: D,
    bus: PhantomData<fn() -> B>,
}

impl Device {
    /// Creates a client for this device on the bus `B`: [`CanOpen`](crate::CanOpen), [`CoE`](crate::CoE) or
    /// [`Modbus`](crate::Modbus).
    pub fn client<B>(&mut self) -> Connection<B, &mut Self> {
        Connection::new(self)
    }

    /// Creates a client that owns the device.
    #[must_use]
    pub fn into_client<B>(self) -> Connection<B, Self> {
        Connection::new(self)
    }
}

impl<B, D: BorrowMut<Device>> Connection<B, D> {
    const fn new(device: D) -> Self {
        Self { device, bus: PhantomData }
    }

    /// Returns the device.
    pub fn device(&mut self) -> &mut Device {
        self.device.borrow_mut()
    }

    /// Returns the device, or the reference to the device, and drops the client.
    pub fn into_device(self) -> D {
        self.device
    }
}

impl<B, D: fmt::Debug> fmt::Debug for Connection<B, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Connection").field("device", &self.device).finish()
    }
}

impl From<Fault> for Error<Fault> {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Abort(code) => Error::Abort(code),
            other => Error::Client(other),
        }
    }
}

macro_rules! client {
    ($Client:ident $($async:ident)?: $bus:ident, $address:ty, $read:expr, $write:expr) => {
        impl<D: BorrowMut<Device>> $Client for Connection<$bus, D> {
            type Bus = $bus;
            type Error = Fault;

            $($async)? fn read(&mut self, address: $address, buffer: &mut [u8]) -> Result<usize, Error<Fault>> {
                $read(self.device(), address, buffer)
            }

            $($async)? fn write(&mut self, address: $address, data: &[u8]) -> Result<(), Error<Fault>> {
                $write(self.device(), address, data)
            }

            /// Advances the simulated time of the device, and returns at once.
            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<Fault>> {
                self.device().step(time);
                Ok(())
            }
        }
    };
}

macro_rules! clients {
    ($($client:tt)*) => {
        client! { Client: $($client)* }
        client! { AsyncClient async: $($client)* }
    };
}

clients! { CanOpen, Object, upload, |device, object, data| download(device, Network::CanOpen, object, data) }
clients! { CoE, Object, upload, |device, object, data| download(device, Network::EtherCat, object, data) }
clients! { Modbus, Register, Device::read_register, Device::write_register }

macro_rules! register_client {
    ($RegisterClient:ident $($async:ident)?) => {
        /// The simulated device supports the functions 22 and 23.
        impl<D: BorrowMut<Device>> $RegisterClient for Connection<Modbus, D> {
            $($async)? fn mask_register(&mut self, address: u16, and: u16, or: u16) -> Result<(), Error<Fault>> {
                Ok(self.device().mask(address, and, or)?)
            }

            $($async)? fn write_and_read(
                &mut self,
                write: Register,
                data: &[u8],
                read: Register,
                buffer: &mut [u8],
            ) -> Result<usize, Error<Fault>> {
                self.device().exchange_registers(write, data, read, buffer)
            }
        }
    };
}

register_client! { RegisterClient }
register_client! { AsyncRegisterClient async }

fn upload(device: &mut Device, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Fault>> {
    device.access();
    let value = device.upload(object)?;
    buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
    Ok(value.len())
}

fn download(device: &mut Device, network: Network, object: Object, data: &[u8]) -> Result<(), Error<Fault>> {
    device.access();
    Ok(device.download(network, object, data)?)
}
