//! One command of a start-up list.

use super::mailbox::Transition;
use crate::bus::{CoE, Object};
use crate::client::{AsyncClient, Client};
use crate::pdo::SdoWrite;

/// A value to be written to an object on a change of state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StartupCommand {
    /// On which change of state.
    pub transition: Transition,
    /// Where it is written.
    pub object: Object,
    /// Whether all sub-indices are written at once, from `object` on.
    pub complete_access: bool,
    /// What is written.
    pub data: StartupData,
}

/// The bytes of a [`StartupCommand`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartupData {
    /// A number of at most 8 bytes.
    Number(SdoWrite),
    /// Bytes of the description.
    Bytes(&'static [u8]),
}

impl StartupCommand {
    /// A write of a number.
    #[must_use]
    pub const fn of_write(transition: Transition, write: SdoWrite) -> Self {
        Self { transition, object: write.object(), complete_access: false, data: StartupData::Number(write) }
    }

    /// The bytes to be written.
    #[must_use]
    pub const fn data(&self) -> &[u8] {
        match &self.data {
            StartupData::Number(write) => write.data(),
            StartupData::Bytes(bytes) => bytes,
        }
    }

    /// Writes it through a client of CANopen over EtherCAT. Complete access has to be asked for by the client's own
    /// means: of such a command, nothing but the bytes is sent.
    ///
    /// # Errors
    ///
    /// Those of the client.
    pub fn send<C: Client<Bus = CoE>>(&self, client: &mut C) -> Result<(), crate::Error<C::Error>> {
        client.write(self.object, self.data())
    }

    /// Writes it without blocking.
    ///
    /// # Errors
    ///
    /// Those of the client.
    pub async fn send_async<C: AsyncClient<Bus = CoE>>(&self, client: &mut C) -> Result<(), crate::Error<C::Error>> {
        client.write(self.object, self.data()).await
    }
}
