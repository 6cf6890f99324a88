//! Tests broadcasts with servers of `pymodbus`, which execute writes to unit 0 and don't reply.

use std::time::{Duration, Instant};

use lexibus::clients::modbus::tokio_modbus::prelude::SlaveContext;
use lexibus::clients::modbus::tokio_modbus::Slave;
use lexibus::clients::modbus::{BlockingLink, Link, ModbusClient, ModbusError, TURNAROUND};
use lexibus::modbus::{AsyncRegisterClient as _, RegisterClient as _};
use serde_json::json;
use tokio_serial::SerialStream;

use crate::block_on;
use crate::modbus::registers::objects::{HIGH_I16, HIGH_U16, HIGH_U32};
use crate::modbus::registers::Registers;
use crate::modbus::{over_rtu, over_tcp, Error, BAUD, DEVICE, OPTIONAL, PATIENCE};

/// Sends broadcasts, then a request to one device.
macro_rules! broadcasts {
    ($access:ident, $script:ident, $device:ident) => {
        let start = Instant::now();
        $device.client().context().set_slave(Slave::broadcast());
        $access!($device.high_u16(), write 0xA55A)?;
        $access!($device.client(), write_block (HIGH_I16, HIGH_U32), (-2, 0x1234_5678))?;
        $access!($device.client(), write_masked HIGH_U16, 0, 0x00FF)?;
        $access!($device.coil(), write true)?;
        assert!(start.elapsed() >= 4 * TURNAROUND && start.elapsed() < PATIENCE, "{:?}", start.elapsed());
        let refused = $access!($device.high_u16(), read).map_err(Error::from);
        assert!(matches!(refused, Err(Error::Client(ModbusError::Broadcast))), "{refused:?}");

        $device.client().context().set_slave(DEVICE);
        assert_eq!($access!($device.client(), read_block (HIGH_U16, HIGH_I16, HIGH_U32))?, (0xA500, -2, 0x1234_5678));
        assert!($access!($device.coil(), read)?);
        assert_eq!($script.functions(), json!([6, 16, 22, 5, 3, 1]));
    };
}

#[test]
fn rtu_blocking() -> Result<(), Error> {
    let Some((mut script, cable)) = over_rtu() else { return Ok(()) };
    let line = tokio_serial::new(cable.ends()[0], BAUD);
    let link = BlockingLink::open(async { Ok(Link::rtu(SerialStream::open(&line)?, DEVICE, PATIENCE)) });
    let mut device = Registers::new(ModbusClient::new(link.expect("a serial line")).with_limits(OPTIONAL));
    broadcasts! { blocking, script, device }
    Ok(())
}

#[test]
fn rtu_not_blocking() -> Result<(), Error> {
    let Some((mut script, cable)) = over_rtu() else { return Ok(()) };
    block_on(async {
        let line = SerialStream::open(&tokio_serial::new(cable.ends()[0], BAUD)).expect("a serial line");
        let link = Link::rtu(line, DEVICE, PATIENCE);
        let mut device = Registers::new(ModbusClient::new(link).with_limits(OPTIONAL));
        broadcasts! { awaited, script, device }
        Ok(())
    })
}

/// The server doesn't reply to a broadcast, like a gateway.
#[test]
fn tcp_blocking() -> Result<(), Error> {
    let Some((mut script, address)) = over_tcp() else { return Ok(()) };
    let link = BlockingLink::tcp(address, DEVICE, PATIENCE).expect("a connection").with_turnaround(TURNAROUND);
    let mut device = Registers::new(ModbusClient::new(link).with_limits(OPTIONAL));
    broadcasts! { blocking, script, device }
    Ok(())
}

/// Without the setting for gateways, unit 0 must reply.
#[test]
fn tcp_without_a_turnaround_delay() {
    let Some((mut script, address)) = over_tcp() else { return };
    let link = BlockingLink::tcp(address, Slave::broadcast(), Duration::from_secs(1)).expect("a connection");
    let mut device = Registers::new(ModbusClient::new(link));
    assert!(matches!(device.high_u16().write(5).map_err(Error::from), Err(Error::Timeout)));
    assert_eq!(script.at("high_u16"), 5);
}
