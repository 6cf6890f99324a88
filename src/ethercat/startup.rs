//! Start-up commands.

use super::depends_on::Growth;
use super::mailbox::{InitCommand, Transition};
use crate::bus::{CoE, Object};
use crate::client::{AsyncClient, Client};
use crate::pdo::{SdoWrite, SdoWriteError};

/// A value that the master writes to an object during a state transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StartupCommand {
    /// The transition during which the value is written.
    pub transition: Transition,
    /// The object to write.
    pub object: Object,
    /// True if complete access is used, which transfers all sub-indices at once, starting at `object`.
    pub complete_access: bool,
    /// The value to write.
    pub data: StartupData,
}

/// The value of a [`StartupCommand`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartupData {
    /// The value of an SDO write.
    Number(SdoWrite),
    /// The bytes of an initialization command, as the device description declares them.
    Bytes(&'static [u8]),
}

impl StartupCommand {
    /// Creates a command from an SDO write.
    #[must_use]
    pub const fn of_write(transition: Transition, write: SdoWrite) -> Self {
        Self { transition, object: write.object(), complete_access: false, data: StartupData::Number(write) }
    }

    /// Creates a command from an initialization command of the device description. `growth` is added to a
    /// slot-dependent index.
    pub(super) fn of_init(command: &InitCommand, transition: Transition, growth: Growth) -> Self {
        let index = command.index.wrapping_add(growth.of(command.depends_on));
        Self {
            transition,
            object: Object { index, sub_index: command.sub_index },
            complete_access: command.complete_access,
            data: StartupData::Bytes(command.data),
        }
    }

    /// Returns the command as an SDO write, without the information about complete access.
    #[must_use]
    pub const fn write(&self) -> SdoWrite {
        match self.data {
            StartupData::Number(write) => write,
            StartupData::Bytes(bytes) => SdoWrite::new_bytes(self.object.index, self.object.sub_index, bytes),
        }
    }

    /// Returns the bytes to write.
    #[must_use]
    pub const fn data(&self) -> &[u8] {
        match &self.data {
            StartupData::Number(write) => write.data(),
            StartupData::Bytes(bytes) => bytes,
        }
    }

    /// Writes the value through a CoE client.
    ///
    /// [`Client`] doesn't support complete access. If the command uses complete access, this method writes the bytes to
    /// a single sub-index. For such commands, use the functions of the bus library instead.
    ///
    /// # Errors
    ///
    /// Returns the error of the client, with the object and the value.
    pub fn send<C: Client<Bus = CoE>>(&self, client: &mut C) -> Result<(), SdoWriteError<C::Error>> {
        self.write().send(client)
    }

    /// Writes the value through an asynchronous CoE client, as [`send`](Self::send) does.
    ///
    /// # Errors
    ///
    /// Returns the error of the client, with the object and the value.
    pub async fn send_async<C: AsyncClient<Bus = CoE>>(&self, client: &mut C) -> Result<(), SdoWriteError<C::Error>> {
        self.write().send_async(client).await
    }
}

/// Converts an SDO write into a command for the transition from Pre-Operational to Safe-Operational. The generated
/// constant `STARTUP` is a list of SDO writes.
impl From<SdoWrite> for StartupCommand {
    fn from(write: SdoWrite) -> Self {
        Self::of_write(Transition::PS, write)
    }
}

impl From<&SdoWrite> for StartupCommand {
    fn from(write: &SdoWrite) -> Self {
        (*write).into()
    }
}

/// Sends start-up commands: those of an [`Assignment`](super::Assignment) or a [`SlotPlan`](super::SlotPlan), or the constant
/// `STARTUP` of a generated device.
///
/// The slave must be in Pre-Operational. For commands with complete access, see [`StartupCommand::send`].
///
/// ```
/// use lexibus::ethercat::{configure, Assignment};
/// use lexibus::{Client, CoE, SdoWriteError};
///
/// fn set_up<C: Client<Bus = CoE>>(client: &mut C, assignment: &Assignment) -> Result<(), SdoWriteError<C::Error>> {
///     configure(client, assignment.startup())
/// }
/// ```
///
/// # Errors
///
/// Returns the first write that failed. The remaining commands are not sent.
pub fn configure<C: Client<Bus = CoE>>(
    client: &mut C,
    commands: impl IntoIterator<Item: Into<StartupCommand>>,
) -> Result<(), SdoWriteError<C::Error>> {
    commands.into_iter().try_for_each(|command| command.into().send(client))
}

/// Sends start-up commands through an asynchronous client, as [`configure`] does.
///
/// # Errors
///
/// Returns the first write that failed. The remaining commands are not sent.
pub async fn configure_async<C: AsyncClient<Bus = CoE>>(
    client: &mut C,
    commands: impl IntoIterator<Item: Into<StartupCommand>>,
) -> Result<(), SdoWriteError<C::Error>> {
    for command in commands {
        command.into().send_async(client).await?;
    }
    Ok(())
}
