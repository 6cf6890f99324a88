//! Boot of a node by the NMT master (CiA 302-2): checks, configuration, start and error control.

mod error;
mod plan;

use super::frame::CanFrame;
use super::guarding::{GuardError, Guarding};
use super::nmt::{NmtCommand, NmtState};
use super::node::{state_of, Node};
use super::port::{AsyncCanPort, CanPort};
use crate::bus::Object;
use crate::client::{AsyncClient, Client};
use crate::configuration::Configuration;
use crate::error::Error;
use crate::text::decode_visible;
use crate::value_error::LengthError;

pub use error::{BootError, VersionText};
pub use plan::{Boot, ErrorControl};

use error::LONGEST_VERSION;
use plan::Checks;

const DEVICE_TYPE: Object = Object::new(0x1000, 0);
const HARDWARE_VERSION: Object = Object::new(0x1009, 0);
const SOFTWARE_VERSION: Object = Object::new(0x100A, 0);
const STORE: Object = Object::new(0x1010, 1);
/// Index of the identity object. Sub-indices 1 to 4 contain the numbers of [`Checks::identity`].
const IDENTITY: u16 = 0x1018;
/// Index of "verify configuration" (CiA 301 7.5.2.23).
const VERIFY: u16 = 0x1020;
const CONFIGURATION_DATE: Object = Object::new(VERIFY, 1);
const CONFIGURATION_TIME: Object = Object::new(VERIFY, 2);

/// Result of the boot of a node. The node has reported Operational, unless the boot has no error control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Booted {
    /// Device type (0x1000).
    pub device_type: u32,
    /// Whether the configuration was written. False if there is no configuration, if the node already has it, or if the
    /// node was kept running.
    pub is_configured: bool,
    /// Whether the boot stored the configuration in the node, with its date if it has one.
    pub is_stored: bool,
    /// Whether the node was already in Operational, and was [kept running](Boot::keep_running).
    pub was_operational: bool,
}

impl Booted {
    /// Returns the error status L of CiA 302-2 if the node was [kept running](Boot::keep_running), otherwise `None`.
    #[must_use]
    pub const fn status(&self) -> Option<char> {
        if self.was_operational {
            Some('L')
        } else {
            None
        }
    }
}

/// Returns the value of an object as a number, or an error if the read failed or the value isn't 4 bytes long.
fn number<E>(object: Object, bytes: [u8; 4], result: Result<usize, Error<E>>) -> Result<u32, BootError<E>> {
    match result {
        Ok(4) => Ok(u32::from_le_bytes(bytes)),
        Ok(length) => Err(BootError::Access { object, error: Error::Length(LengthError::new(4, length)) }),
        Err(error) => Err(BootError::Access { object, error }),
    }
}

/// Returns the text in an object.
fn version<E>(object: Object, bytes: &[u8], result: Result<usize, Error<E>>) -> Result<VersionText, BootError<E>> {
    let text = result.and_then(|length| {
        let text = bytes.get(..length).ok_or(Error::Length(LengthError::new(bytes.len(), length)))?;
        decode_visible(text).map_err(Error::Text)
    });
    text.map(VersionText::new).map_err(|error| BootError::Access { object, error })
}

/// Returns whether the error means that the node doesn't report its state.
const fn is_silence<E>(error: &BootError<E>) -> bool {
    matches!(error, BootError::NoHeartbeat | BootError::Guarding(GuardError::NodeLost))
}

/// Returns the error for an entry of the identity object that differs from the expected value.
const fn other_identity<E>(sub_index: u8, expected: u32, actual: u32) -> BootError<E> {
    match sub_index {
        1 => BootError::VendorId { expected, actual },
        2 => BootError::ProductCode { expected, actual },
        3 => BootError::RevisionNumber { expected, actual },
        _ => BootError::SerialNumber { expected, actual },
    }
}

macro_rules! boot {
    (
        $Port:ident $Client:ident $send_step:ident: $boot:ident $nmt:ident $wait_for:ident $guard:ident $number:ident $version:ident $check:ident
        $date:ident $configure:ident $write:ident $store:ident $discard_states:ident $run:ident $is_running:ident $state:ident $($async:ident $await:ident)?
    ) => {
        impl<P: $Port> Node<P> {
            /// Boots the node, as the NMT master of CiA 302-2 does. The steps have this order:
            ///
            /// 1. Restart, if it is [requested](Boot::reset). With [`Boot::keep_running`], the master first determines
            ///    the state of the node. If the node is already in Operational, it keeps running, and the master only
            ///    checks it.
            /// 2. Check of the device type, the identity and the versions.
            /// 3. [Configuration](Boot::configuration), unless the node already has it. With [`Boot::store`], the node
            ///    stores the configuration, and then the date of the configuration.
            /// 4. Start of the node (NMT). With error control, the master then waits for a heartbeat or a node guarding
            ///    answer that reports Operational.
            ///
            /// The node must be in Pre-operational, unless it is restarted. A node in Operational would send PDOs
            /// during the configuration, and a node in Stopped has no SDO server.
            ///
            /// After an error, the node can be in Operational only in two cases: the error is
            /// [`BootError::NotOperational`], [`BootError::Guarding`] or [`BootError::Command`], or the node is to be
            /// [kept running](Boot::keep_running).
            ///
            /// # Errors
            ///
            /// Returns the error of the step that failed. [`BootError::status`] returns the error status of CiA 302-2.
            pub $($async)? fn $boot(&mut self, boot: &Boot) -> Result<Booted, BootError<P::Error>> {
                if boot.keeps_running && self.$is_running(boot)$(.$await)?? {
                    let device_type = self.$check(&boot.checks)$(.$await)??;
                    return Ok(Booted { device_type, is_configured: false, is_stored: false, was_operational: true });
                }
                if let Some(patience) = boot.reset {
                    self.$nmt(NmtCommand::ResetNode)$(.$await)?.map_err(BootError::Command)?;
                    match self.$wait_for(NmtState::BootUp, patience)$(.$await)? {
                        Err(Error::Timeout) => return Err(BootError::NoBootUp),
                        result => result.map_err(BootError::Command)?,
                    }
                }
                let device_type = self.$check(&boot.checks)$(.$await)??;
                let (mut is_configured, mut is_stored) = (false, false);
                if let Some(configuration) = boot.configuration {
                    let date = boot.date(self.id());
                    if date.is_none() || self.$date()$(.$await)?? != date {
                        self.$configure(configuration)$(.$await)??;
                        is_configured = true;
                        if boot.is_stored {
                            self.$store(date)$(.$await)??;
                            is_stored = true;
                        }
                    }
                }
                self.$discard_states()$(.$await)?.map_err(BootError::Command)?;
                self.$nmt(NmtCommand::Start)$(.$await)?.map_err(BootError::Command)?;
                self.$run(boot.error_control)$(.$await)??;
                Ok(Booted { device_type, is_configured, is_stored, was_operational: false })
            }

            /// Returns whether the node is in Operational. A node that doesn't report its state is restarted if a restart is
            /// requested. In Stopped, the node has no SDO server, so its state must be known before its objects are read.
            $($async)? fn $is_running(&mut self, boot: &Boot) -> Result<bool, BootError<P::Error>> {
                match self.$state(boot.error_control)$(.$await)? {
                    Err(error) if boot.reset.is_some() && is_silence(&error) => Ok(false),
                    state => state.map(|state| state == NmtState::Operational),
                }
            }

            /// Returns the state of a node that may be running. Without error control, the state is unknown: the method
            /// returns Pre-operational, so that the node is booted.
            $($async)? fn $state(&mut self, error_control: ErrorControl) -> Result<NmtState, BootError<P::Error>> {
                match error_control {
                    ErrorControl::None => Ok(NmtState::PreOperational),
                    ErrorControl::Heartbeat(patience) => {
                        self.$discard_states()$(.$await)?.map_err(BootError::Command)?;
                        let id = self.id();
                        let is_heartbeat = &mut |frame: &CanFrame| state_of(frame, id).is_some();
                        let frame = self.port().receive(patience, is_heartbeat)$(.$await)?;
                        let frame = frame.map_err(|error| BootError::Command(Error::Client(error)))?;
                        frame.and_then(|frame| state_of(&frame, id)).ok_or(BootError::NoHeartbeat)
                    }
                    ErrorControl::Guarding { guard_time, life_time_factor } => {
                        // One lost frame doesn't mean that the node is lost.
                        let mut guarding = Guarding::new(guard_time, life_time_factor.max(2));
                        loop {
                            match self.$guard(&mut guarding)$(.$await)? {
                                Err(GuardError::NoAnswer | GuardError::ToggleBit) => {}
                                result => return result.map_err(BootError::Guarding),
                            }
                        }
                    }
                }
            }

            $($async)? fn $number(&mut self, object: Object) -> Result<u32, BootError<P::Error>> {
                let mut bytes = [0; 4];
                let result = <Self as $Client>::read(self, object, &mut bytes)$(.$await)?;
                number(object, bytes, result)
            }

            $($async)? fn $version(&mut self, object: Object) -> Result<VersionText, BootError<P::Error>> {
                let mut bytes = [0; LONGEST_VERSION];
                let result = <Self as $Client>::read(self, object, &mut bytes)$(.$await)?;
                version(object, &bytes, result)
            }

            /// Compares the node with the expected values, and returns the device type.
            $($async)? fn $check(&mut self, checks: &Checks) -> Result<u32, BootError<P::Error>> {
                let (expected, actual) = (checks.device_type, self.$number(DEVICE_TYPE)$(.$await)??);
                if expected != 0 && expected != actual {
                    return Err(BootError::DeviceType { expected, actual });
                }
                let device_type = actual;
                for (sub_index, expected) in (1..).zip(checks.identity).filter(|(_, expected)| *expected != 0) {
                    let actual = self.$number(Object::new(IDENTITY, sub_index))$(.$await)??;
                    if expected != actual {
                        return Err(other_identity(sub_index, expected, actual));
                    }
                }
                if let Some(expected) = checks.hardware_version {
                    let actual = self.$version(HARDWARE_VERSION)$(.$await)??;
                    if expected != actual.as_str() {
                        return Err(BootError::HardwareVersion { expected, actual });
                    }
                }
                if let Some(expected) = checks.software_version {
                    let actual = self.$version(SOFTWARE_VERSION)$(.$await)??;
                    if expected != actual.as_str() {
                        return Err(BootError::SoftwareVersion { expected, actual });
                    }
                }
                Ok(device_type)
            }

            /// Returns the date of the configuration of the node, or `None` if the node refuses the read of object
            /// 0x1020.
            $($async)? fn $date(&mut self) -> Result<Option<[u32; 2]>, BootError<P::Error>> {
                let mut date = [0; 2];
                for (part, object) in date.iter_mut().zip([CONFIGURATION_DATE, CONFIGURATION_TIME]) {
                    match self.$number(object)$(.$await)? {
                        Err(BootError::Access { error: Error::Abort(_), .. }) => return Ok(None),
                        number => *part = number?,
                    }
                }
                Ok(Some(date))
            }

            /// Writes the configuration without its date.
            $($async)? fn $configure(&mut self, configuration: Configuration) -> Result<(), BootError<P::Error>> {
                let steps = configuration.steps(self.id());
                for step in steps.filter(|step| step.write.object().index != VERIFY) {
                    let result = step.write.$send_step(self)$(.$await)?;
                    result.map_err(|failed| BootError::Configuration(step.failed(failed.error)))?;
                }
                Ok(())
            }

            $($async)? fn $write(&mut self, object: Object, data: &[u8]) -> Result<(), BootError<P::Error>> {
                let result = <Self as $Client>::write(self, object, data)$(.$await)?;
                result.map_err(|error| BootError::Store { object, error })
            }

            /// Stores the configuration, and then its date. If the node fails to store the configuration, the date is
            /// not written.
            $($async)? fn $store(&mut self, date: Option<[u32; 2]>) -> Result<(), BootError<P::Error>> {
                self.$write(STORE, b"save")$(.$await)??;
                let Some(date) = date else { return Ok(()) };
                for (object, part) in [CONFIGURATION_DATE, CONFIGURATION_TIME].into_iter().zip(date) {
                    self.$write(object, &part.to_le_bytes())$(.$await)??;
                }
                self.$write(STORE, b"save")$(.$await)?
            }

            /// Waits until the node reports Operational. Without error control, returns at once.
            $($async)? fn $run(&mut self, error_control: ErrorControl) -> Result<(), BootError<P::Error>> {
                let (id, mut actual) = (self.id(), None);
                match error_control {
                    ErrorControl::None => Ok(()),
                    ErrorControl::Heartbeat(patience) => {
                        let is_started = &mut |frame: &CanFrame| {
                            actual = state_of(frame, id).or(actual);
                            state_of(frame, id) == Some(NmtState::Operational)
                        };
                        let frame = self.port().receive(patience, is_started)$(.$await)?;
                        let frame = frame.map_err(|error| BootError::Command(Error::Client(error)))?;
                        frame.map(|_| ()).ok_or(BootError::NotOperational { actual })
                    }
                    ErrorControl::Guarding { guard_time, life_time_factor } => {
                        let mut guarding = Guarding::new(guard_time, life_time_factor);
                        for _ in 0..=life_time_factor.max(2) {
                            match self.$guard(&mut guarding)$(.$await)? {
                                Ok(NmtState::Operational) => return Ok(()),
                                Ok(state) => actual = Some(state),
                                Err(GuardError::NoAnswer | GuardError::ToggleBit) => continue,
                                Err(error) => return Err(BootError::Guarding(error)),
                            }
                            let pause = self.port().receive(guard_time, &mut |_| false)$(.$await)?;
                            pause.map_err(|error| BootError::Command(Error::Client(error)))?;
                        }
                        Err(BootError::NotOperational { actual })
                    }
                }
            }
        }
    };
}

boot! {
    CanPort Client send: boot nmt wait_for guard boot_number boot_version boot_check boot_date boot_configure boot_write boot_store
    discard_states boot_run boot_is_running boot_state
}
boot! {
    AsyncCanPort AsyncClient send_async: boot_async nmt_async wait_for_async guard_async boot_number_async boot_version_async
    boot_check_async boot_date_async boot_configure_async boot_write_async boot_store_async discard_states_async boot_run_async
    boot_is_running_async boot_state_async
    async await
}
