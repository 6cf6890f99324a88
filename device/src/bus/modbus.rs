//! Modbus connections.

use std::net::{SocketAddr, ToSocketAddrs};
use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
use tokio_serial::{Parity, SerialStream, StopBits};

use super::BusAddress;
use crate::connection::{Connection, ModbusConnection};
use crate::failure::Failure;

/// Default port of Modbus TCP.
const PORT: u16 = 502;

impl BusAddress {
    pub(super) fn connect_modbus(&self, address: u8, timeout: Duration) -> Result<Box<dyn Connection>, Failure> {
        match self {
            BusAddress::Tcp(host) => {
                let link = BlockingLink::tcp(resolve(host)?, Slave(address), timeout);
                let link = link.map_err(|error| Failure::Bus(format!("cannot connect to {host}: {error}")))?;
                Ok(Box::new(ModbusConnection::new(ModbusClient::new(link))))
            }
            BusAddress::Rtu { path, bit_rate, parity, stop_bits } => {
                if address == 0 {
                    return Err(Failure::Bus("address 0 is a broadcast, to which no device replies".to_owned()));
                }
                let line = tokio_serial::new(path, *bit_rate)
                    .parity(match parity {
                        'N' => Parity::None,
                        'O' => Parity::Odd,
                        _ => Parity::Even,
                    })
                    .stop_bits(if *stop_bits == 2 { StopBits::Two } else { StopBits::One });
                let link = BlockingLink::open(async {
                    Ok(Link::rtu(SerialStream::open(&line)?, Slave(address), timeout))
                });
                let link = link.map_err(|error| Failure::Bus(format!("cannot open {path}: {error}")))?;
                Ok(Box::new(ModbusConnection::new(ModbusClient::new(link))))
            }
            _ => Err(Failure::Bus("the bus is not a Modbus line".to_owned())),
        }
    }
}

/// Returns the socket address of `HOST` or `HOST:PORT`.
fn resolve(host: &str) -> Result<SocketAddr, Failure> {
    let found = host.to_socket_addrs().or_else(|_| (host, PORT).to_socket_addrs());
    let address = found.ok().and_then(|mut addresses| addresses.next());
    address.ok_or_else(|| Failure::Bus(format!("cannot resolve the host {host}")))
}
