//! Addresses of the buses that are connected to the computer: `can:can0`, `slcan:/dev/ttyACM0@500k`, `tcp:192.168.0.5`,
//! `rtu:/dev/ttyUSB0@19200`.

use std::error::Error;
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use lexibus::NodeId;

use crate::address::Network;
use crate::connection::Connection;
use crate::description::Description;
use crate::failure::Failure;
use crate::port::AnyPort;

#[cfg(feature = "modbus")]
mod line;
#[cfg(feature = "modbus")]
mod modbus;

/// The address of a bus that is connected to the computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BusAddress {
    /// `can:NAME`: a CAN interface of Linux (SocketCAN).
    SocketCan(String),
    /// `slcan:PATH` or `slcan:PATH@500k`: a CAN adapter on a serial line. Without a bit rate, the adapter keeps its bit
    /// rate.
    Slcan {
        /// Path of the serial line.
        path: String,
        /// Bit rate of the CAN bus in kbit/s.
        bit_rate: Option<u16>,
    },
    /// `tcp:HOST` or `tcp:HOST:PORT`: Modbus TCP. The default port is 502.
    Tcp(String),
    /// `rtu:PATH` or `rtu:PATH@19200-8E1`: Modbus RTU. The default is 19,200 bit/s with 8 data bits, even parity and one
    /// stop bit (MODBUS over Serial Line V1.02, 2.5.1 and 3.2).
    Rtu {
        /// Path of the serial line.
        path: String,
        /// Bit rate of the line in bit/s.
        bit_rate: u32,
        /// Parity: `N`, `E` or `O`.
        parity: char,
        /// Number of stop bits.
        stop_bits: u8,
    },
}

/// The error for a text that isn't the address of a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BusAddressError(String);

impl fmt::Display for BusAddressError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` is not the address of a bus; examples: can:can0, slcan:/dev/ttyACM0@500k, tcp:192.168.0.5, rtu:/dev/ttyUSB0@19200-8E1",
            self.0
        )
    }
}

impl Error for BusAddressError {}

impl FromStr for BusAddress {
    type Err = BusAddressError;

    fn from_str(text: &str) -> Result<Self, BusAddressError> {
        let error = || BusAddressError(text.to_owned());
        let (kind, rest) = text.split_once(':').filter(|(_, rest)| !rest.is_empty()).ok_or_else(error)?;
        let (path, setting) = rest.rsplit_once('@').map_or((rest, None), |(path, setting)| (path, Some(setting)));
        match kind {
            "can" => Ok(BusAddress::SocketCan(rest.to_owned())),
            "slcan" => {
                let bit_rate = setting.map(|setting| kilobits(setting).ok_or_else(error)).transpose()?;
                Ok(BusAddress::Slcan { path: path.to_owned(), bit_rate })
            }
            "tcp" => Ok(BusAddress::Tcp(rest.to_owned())),
            "rtu" => line(path, setting.unwrap_or("19200")).ok_or_else(error),
            _ => Err(error()),
        }
    }
}

/// Parses a bit rate: `500`, `500k`, `1M`. Returns the bit rate in kbit/s, or `None` if the text isn't a bit rate for which
/// slcan has a command.
fn kilobits(text: &str) -> Option<u16> {
    let number = match text.strip_suffix('M') {
        Some(number) => number.parse::<u16>().ok()?.checked_mul(1000)?,
        None => text.strip_suffix('k').unwrap_or(text).parse().ok()?,
    };
    crate::slcan::setup(number).map(|_| number)
}

/// Parses the settings of an RTU line: `19200`, `19200-8E1`.
fn line(path: &str, setting: &str) -> Option<BusAddress> {
    let (bit_rate, format) = setting.split_once('-').unwrap_or((setting, "8E1"));
    let (parity, stop_bits) = match format.as_bytes() {
        [b'8', parity @ (b'N' | b'E' | b'O'), stop_bits @ (b'1' | b'2')] => (char::from(*parity), stop_bits - b'0'),
        _ => return None,
    };
    let bit_rate = bit_rate.parse().ok().filter(|rate| *rate > 0)?;
    Some(BusAddress::Rtu { path: path.to_owned(), bit_rate, parity, stop_bits })
}

impl BusAddress {
    /// Returns the protocol of the bus.
    #[must_use]
    pub fn network(&self) -> Network {
        match self {
            BusAddress::SocketCan(_) | BusAddress::Slcan { .. } => Network::CanOpen,
            BusAddress::Tcp(_) | BusAddress::Rtu { .. } => Network::Modbus,
        }
    }

    /// Opens the CAN interface.
    ///
    /// # Errors
    ///
    /// Fails if the bus isn't a CAN bus, if it cannot be opened, or if this build doesn't support it.
    pub fn open_port(&self) -> Result<AnyPort, Failure> {
        match self {
            BusAddress::SocketCan(name) => AnyPort::socketcan(name),
            BusAddress::Slcan { path, bit_rate } => AnyPort::slcan(path, *bit_rate),
            BusAddress::Tcp(_) | BusAddress::Rtu { .. } => {
                Err(Failure::Bus("the bus is not a CAN bus; use can:INTERFACE or slcan:PATH".to_owned()))
            }
        }
    }

    /// Connects to a device. `address` is the node-ID on CANopen, or the server address on Modbus. `timeout` is the
    /// maximum time for a reply. No request is sent to the device.
    ///
    /// On Modbus, reads and writes use only the functions and request lengths that `description` states for the table. If it
    /// states none, they use those of the Modbus specification. The memory for the lists of functions is never freed.
    ///
    /// # Errors
    ///
    /// Fails if the bus cannot be opened, or if this build doesn't support it. Also fails if `address` isn't in the range 1
    /// to 127 on CANopen, or is 0 on Modbus RTU.
    pub fn connect(
        &self,
        description: &Description,
        address: u8,
        timeout: Duration,
    ) -> Result<Box<dyn Connection>, Failure> {
        match self.network() {
            Network::CanOpen => {
                let id = NodeId::new(address)
                    .ok_or_else(|| Failure::Bus("the node-ID is not in the range 1 to 127".to_owned()))?;
                Ok(Box::new(self.open_port()?.connection(id, timeout)))
            }
            Network::Modbus => self.connect_modbus(description, address, timeout),
        }
    }

    #[cfg(not(feature = "modbus"))]
    fn connect_modbus(&self, _: &Description, _: u8, _: Duration) -> Result<Box<dyn Connection>, Failure> {
        Err(Failure::Bus("this build doesn't support Modbus (feature `modbus`)".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses() {
        let parsed = |text: &str| text.parse::<BusAddress>().ok();
        assert_eq!(parsed("can:can0"), Some(BusAddress::SocketCan("can0".into())));
        let slcan = |bit_rate| Some(BusAddress::Slcan { path: "/dev/ttyACM0".into(), bit_rate });
        assert_eq!(parsed("slcan:/dev/ttyACM0"), slcan(None));
        assert_eq!(parsed("slcan:/dev/ttyACM0@500k"), slcan(Some(500)));
        assert_eq!(parsed("slcan:/dev/ttyACM0@1M"), slcan(Some(1000)));
        assert_eq!(parsed("slcan:/dev/ttyACM0@33k"), None);
        assert_eq!(parsed("tcp:127.0.0.1:1502"), Some(BusAddress::Tcp("127.0.0.1:1502".into())));
        let rtu = |bit_rate, parity, stop_bits| {
            Some(BusAddress::Rtu { path: "/dev/ttyUSB0".into(), bit_rate, parity, stop_bits })
        };
        assert_eq!(parsed("rtu:/dev/ttyUSB0"), rtu(19_200, 'E', 1));
        assert_eq!(parsed("rtu:/dev/ttyUSB0@115200-8N2"), rtu(115_200, 'N', 2));
        for wrong in ["", "can0", "can:", "usb:1", "rtu:/dev/ttyUSB0@0", "rtu:/dev/ttyUSB0@9600-7E1"] {
            assert_eq!(parsed(wrong), None, "{wrong}");
        }
    }
}
