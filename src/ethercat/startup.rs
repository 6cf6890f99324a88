//! The commands of a start-up list.

use super::depends_on::Growth;
use super::mailbox::{InitCommand, Transition};
use crate::bus::{CoE, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
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

    /// What a description asks for, at the place of its module.
    pub(super) fn of_init(command: &InitCommand, transition: Transition, growth: Growth) -> Self {
        let index = command.index.wrapping_add(growth.of(command.depends_on));
        Self {
            transition,
            object: Object { index, sub_index: command.sub_index },
            complete_access: command.complete_access,
            data: StartupData::Bytes(command.data),
        }
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
    pub fn send<C: Client<Bus = CoE>>(&self, client: &mut C) -> Result<(), Error<C::Error>> {
        client.write(self.object, self.data())
    }

    /// Writes it without blocking.
    ///
    /// # Errors
    ///
    /// Those of the client.
    pub async fn send_async<C: AsyncClient<Bus = CoE>>(&self, client: &mut C) -> Result<(), Error<C::Error>> {
        client.write(self.object, self.data()).await
    }
}

/// Sends a start-up list, such as that of an [`Assignment`](super::Assignment) or a [`SlotPlan`](super::SlotPlan), while
/// the slave is in Pre-Operational. Commands with complete access go out as [`StartupCommand::send`] says.
///
/// ```
/// use lexibus::ethercat::{configure, Assignment};
/// use lexibus::{Client, CoE, Error};
///
/// fn set_up<C: Client<Bus = CoE>>(client: &mut C, assignment: &Assignment) -> Result<(), Error<C::Error>> {
///     configure(client, assignment.startup())
/// }
/// ```
///
/// # Errors
///
/// The first error of the client, after which nothing more is sent.
pub fn configure<C: Client<Bus = CoE>>(
    client: &mut C,
    commands: impl IntoIterator<Item = StartupCommand>,
) -> Result<(), Error<C::Error>> {
    commands.into_iter().try_for_each(|command| command.send(client))
}

/// Sends a start-up list without blocking, as [`configure`] does.
///
/// # Errors
///
/// The first error of the client, after which nothing more is sent.
pub async fn configure_async<C: AsyncClient<Bus = CoE>>(
    client: &mut C,
    commands: impl IntoIterator<Item = StartupCommand>,
) -> Result<(), Error<C::Error>> {
    for command in commands {
        command.send_async(client).await?;
    }
    Ok(())
}
