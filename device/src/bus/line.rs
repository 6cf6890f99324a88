//! Modbus connections that can read the device identification, over TCP or a serial line.

use lexibus::clients::modbus::tokio_modbus::bytes::Bytes;
use lexibus::clients::modbus::tokio_modbus::{Request, Response};
use lexibus::clients::modbus::{sync, ModbusClient, ModbusError};

use crate::address::{Address, Network};
use crate::connection::{Connection, ModbusConnection, ModbusFailure as _};
use crate::failure::Failure;

/// Number of objects in the basic device identification: vendor name, product code, revision.
const BASIC: usize = 3;

/// A Modbus connection over TCP or a serial line.
pub(super) struct LineConnection<L>(pub ModbusConnection<ModbusClient<L>>);

impl<L: sync::Client> Connection for LineConnection<L> {
    fn network(&self) -> Network {
        self.0.network()
    }

    fn read(&mut self, address: Address, length: usize) -> Result<Vec<u8>, Failure> {
        self.0.read(address, length)
    }

    fn write(&mut self, address: Address, data: &[u8]) -> Result<(), Failure> {
        self.0.write(address, data)
    }

    fn identification(&mut self) -> Result<Vec<(u8, String)>, Failure> {
        let unsupported = |reason: &str| Failure::Unsupported(reason.to_owned());
        let (mut objects, mut first) = (Vec::new(), 0);
        // Each valid reply contains at least one object, so three requests are enough.
        for _ in 0..BASIC {
            // Function 43, read device identification, basic (MODBUS Application Protocol V1.1b3, 6.21).
            let request = Request::try_from(Bytes::copy_from_slice(&[0x2B, 0x0E, 0x01, first]));
            let request = request.map_err(|_| unsupported("the client cannot send the request"))?;
            let reply =
                self.0.client().context().call(request).map_err(|error| ModbusError::Bus(error).into_failure())?;
            let reply = reply.map_err(|exception| ModbusError::Exception(exception).into_failure())?;
            let Response::ReadDeviceIdentification(reply) = reply else {
                return Err(unsupported("the device sent an unexpected reply"));
            };
            objects.extend(reply.device_id_objects.iter().map(|object| (object.id, text(&object.value))));
            if !reply.more_follows {
                break;
            }
            first = reply.next_object_id;
        }
        Ok(objects)
    }
}

/// Returns the text of an object without padding (spaces and zero bytes).
fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).trim_matches(['\0', ' ']).to_owned()
}
