//! Access to the memory of a slave controller by address.

use ethercrab::error::Error as BusError;
use ethercrab::{Command, MainDevice, SubDevice};

use crate::bus::{Esc, EscMemory};
use crate::client::AsyncClient;
use crate::error::Error;
use crate::value_error::LengthError;

/// Client for the memory of one SubDevice's slave controller (ETG.1000.4). The client reads and writes items that have
/// an address in this memory.
///
/// The client needs no mailbox and works in every state. `ethercrab` and the device use this memory too. Don't write to
/// registers that `ethercrab` or the device uses (states, sync managers, FMMUs).
#[derive(Clone, Copy, Debug)]
pub struct Memory<'m> {
    maindevice: &'m MainDevice<'m>,
    station: u16,
}

impl<'m> Memory<'m> {
    /// Creates the client for `subdevice`.
    pub fn new(maindevice: &'m MainDevice<'m>, subdevice: &SubDevice) -> Self {
        Self { maindevice, station: subdevice.configured_address() }
    }
}

impl AsyncClient for Memory<'_> {
    type Bus = Esc;
    type Error = BusError;

    async fn read(&mut self, memory: EscMemory, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        let command = Command::fprd(self.station, memory.address);
        let received = command.receive_slice(self.maindevice, memory.length).await.map_err(Error::Client)?;
        buffer.iter_mut().zip(received.iter()).for_each(|(to, from)| *to = *from);
        Ok(received.len())
    }

    async fn write(&mut self, memory: EscMemory, data: &[u8]) -> Result<(), Error<BusError>> {
        if data.len() != usize::from(memory.length) {
            return Err(Error::Length(LengthError::new(memory.length.into(), data.len())));
        }
        let command = Command::fpwr(self.station, memory.address);
        command.send_receive_slice(self.maindevice, data).await.map_err(Error::Client)?;
        Ok(())
    }
}
