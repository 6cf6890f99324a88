//! Writes a configuration to a device.

use core::error;
use core::fmt;

use super::{Configuration, Phase};
use crate::bus::{Bus, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;
use crate::pdo::SdoWrite;

/// Progress of a configuration, reported after each write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Phase of the write.
    pub phase: Phase,
    /// The write that the device accepted.
    pub write: SdoWrite,
    /// Number of completed writes, including this write.
    pub done: usize,
    /// Number of all writes.
    pub total: usize,
}

/// A write of a configuration that failed, with the error of the client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ApplyError<E> {
    /// Phase of the write.
    pub phase: Phase,
    /// The write that failed.
    pub write: SdoWrite,
    /// The error of the client.
    pub error: Error<E>,
}

impl<E: fmt::Display> fmt::Display for ApplyError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}): {}", self.write, self.phase, self.error)
    }
}

impl<E: error::Error + 'static> error::Error for ApplyError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        Some(&self.error)
    }
}

impl Configuration {
    /// Writes the configuration to the device with this node-ID, and calls `progress` after each write.
    ///
    /// The device must be in the NMT state Pre-operational or Operational. A device in Pre-operational sends no PDOs
    /// while the mapping changes.
    ///
    /// # Errors
    ///
    /// Returns the first write that failed, with the error of the client. The remaining values are not written.
    /// Disabled PDOs that the configuration has not enabled again stay disabled.
    pub fn apply<C: Client>(
        self,
        client: &mut C,
        node_id: NodeId,
        mut progress: impl FnMut(Progress),
    ) -> Result<(), ApplyError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        for step in self.steps(node_id) {
            step.write.send(client).map_err(|failed| step.failed(failed.error))?;
            progress(step);
        }
        Ok(())
    }

    /// Writes the configuration through an asynchronous client, as [`apply`](Self::apply) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`apply`](Self::apply).
    pub async fn apply_async<C: AsyncClient>(
        self,
        client: &mut C,
        node_id: NodeId,
        mut progress: impl FnMut(Progress),
    ) -> Result<(), ApplyError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        for step in self.steps(node_id) {
            step.write.send_async(client).await.map_err(|failed| step.failed(failed.error))?;
            progress(step);
        }
        Ok(())
    }

    /// Returns the writes of the configuration in order, each with the progress after this write.
    pub(crate) fn steps(self, node_id: NodeId) -> impl Iterator<Item = Progress> {
        let total = self.settings().count();
        self.settings().zip(1..).map(move |((phase, setting), done)| Progress {
            phase,
            write: setting.resolve(node_id),
            done,
            total,
        })
    }
}

impl Progress {
    /// Adds the phase and the write to an error of the client.
    pub(crate) fn failed<E>(self, error: Error<E>) -> ApplyError<E> {
        ApplyError { phase: self.phase, write: self.write, error }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{AsyncStore, Store, CONFIGURATION, NODE};
    use super::*;
    use crate::abort::AbortCode;
    use crate::now::now;
    use std::string::ToString;
    use std::vec::Vec;

    #[test]
    fn reports_each_write() {
        let (mut device, mut steps) = (Store::default(), Vec::new());
        CONFIGURATION.apply(&mut device, NODE, |progress| steps.push(progress)).unwrap();
        assert_eq!(
            steps.iter().map(|step| step.write).collect::<Vec<_>>(),
            CONFIGURATION.writes(NODE).collect::<Vec<_>>()
        );
        assert!(steps.iter().zip(1..).all(|(step, done)| step.done == done && step.total == 10));
        assert_eq!((steps[0].phase, steps[9].phase), (Phase::DisablePdos, Phase::EnablePdos));
        let enabled = (Object::new(0x1400, 1), [5, 2, 0, 0].to_vec());
        assert_eq!(device.values.last(), Some(&enabled));
    }

    #[test]
    fn stops_at_the_first_error() {
        let object = Object::new(0x2000, 0);
        let (mut device, mut done) = (Store { refused: Some(object), ..Store::default() }, 0);
        let error = CONFIGURATION.apply(&mut device, NODE, |progress| done = progress.done).unwrap_err();
        assert_eq!((error.phase, error.write.object()), (Phase::Parameters, object));
        assert_eq!(error.error, Error::Abort(AbortCode::READ_ONLY));
        assert_eq!((done, device.values.len()), (3, 3));
        let error =
            ApplyError { phase: Phase::Communication, write: SdoWrite::new_u16(0x1017, 0, 5), error: error.error };
        let text =
            ApplyError { error: Error::<AbortCode>::Timeout, phase: error.phase, write: error.write }.to_string();
        assert!(text.starts_with("0x1017:00 = 0x0005 (communication parameters): timeout"), "{text}");
    }

    #[test]
    fn without_blocking() {
        let mut device = AsyncStore(Store::default());
        let mut total = 0;
        now(CONFIGURATION.without_defaults().apply_async(&mut device, NODE, |progress| total = progress.total))
            .unwrap();
        assert_eq!(total, 8);
        device.0.failing = Some(Object::new(0x1600, 0));
        let error = now(CONFIGURATION.apply_async(&mut device, NODE, |_| ())).unwrap_err();
        assert_eq!((error.phase, error.error), (Phase::Mapping, Error::Client(())));
    }
}
