//! Modbus connections.

use std::net::{SocketAddr, ToSocketAddrs};
use std::time::Duration;

use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient};
use lexibus::modbus::{Limits, TableLimits};
use lexibus_codegen::ir::{ModbusTable, RegisterSpace};
use tokio_serial::{Parity, SerialStream, StopBits};

use super::line::LineConnection;
use super::BusAddress;
use crate::connection::{Connection, ModbusConnection};
use crate::description::Description;
use crate::failure::Failure;

/// Default port of Modbus TCP.
const PORT: u16 = 502;

impl BusAddress {
    pub(super) fn connect_modbus(
        &self,
        description: &Description,
        address: u8,
        timeout: Duration,
    ) -> Result<Box<dyn Connection>, Failure> {
        let limits = limits(&description.device().modbus);
        match self {
            BusAddress::Tcp(host) => {
                let link = BlockingLink::tcp(resolve(host)?, Slave(address), timeout);
                let link = link.map_err(|error| Failure::Bus(format!("cannot connect to {host}: {error}")))?;
                Ok(Box::new(LineConnection(ModbusConnection::new(ModbusClient::new(link).with_limits(limits)))))
            }
            BusAddress::Rtu { path, bit_rate, parity, stop_bits } => {
                if address == 0 {
                    return Err(Failure::Bus(
                        "server address 0 is the broadcast address, to which no device replies".to_owned(),
                    ));
                }
                let line = tokio_serial::new(path, *bit_rate)
                    .parity(match parity {
                        'N' => Parity::None,
                        'O' => Parity::Odd,
                        _ => Parity::Even,
                    })
                    .stop_bits(if *stop_bits == 2 { StopBits::Two } else { StopBits::One });
                let link =
                    BlockingLink::open(async { Ok(Link::rtu(SerialStream::open(&line)?, Slave(address), timeout)) });
                let link = link.map_err(|error| Failure::Bus(format!("cannot open {path}: {error}")))?;
                Ok(Box::new(LineConnection(ModbusConnection::new(ModbusClient::new(link).with_limits(limits)))))
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

/// Returns the functions and request lengths of each table. If the description states none, returns those of the Modbus
/// specification.
fn limits(tables: &[ModbusTable]) -> Limits {
    let of = |space: RegisterSpace, standard: TableLimits| {
        let Some(table) = tables.iter().find(|table| table.space == space) else { return standard };
        TableLimits {
            // `TableLimits` needs a static list.
            functions: Box::leak(table.functions.clone().into_boxed_slice()),
            max_read: table.max_read.unwrap_or(standard.max_read),
            max_write: table.max_write.unwrap_or(standard.max_write),
            split: table.split,
            ..standard
        }
    };
    Limits {
        holding: of(RegisterSpace::Holding, TableLimits::HOLDING),
        input: of(RegisterSpace::Input, TableLimits::INPUT),
        coil: of(RegisterSpace::Coil, TableLimits::COIL),
        discrete: of(RegisterSpace::DiscreteInput, TableLimits::DISCRETE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_description_limits_the_requests() {
        let table = ModbusTable {
            space: RegisterSpace::Holding,
            functions: vec![3, 16],
            max_read: Some(16),
            max_write: None,
            split: true,
        };
        let limits = limits(&[table]);
        assert_eq!((limits.holding.functions, limits.holding.max_read), ([3, 16].as_slice(), 16));
        assert_eq!((limits.holding.max_write, limits.holding.split), (123, true));
        assert_eq!(limits.coil, TableLimits::COIL);
    }
}
