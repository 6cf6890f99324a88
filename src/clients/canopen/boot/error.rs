//! Errors that can occur during the boot of a node.

use core::error;
use core::fmt;

use super::{DEVICE_TYPE, IDENTITY, SOFTWARE_VERSION, VERIFY};
use crate::bus::Object;
use crate::clients::canopen::guarding::GuardError;
use crate::clients::canopen::nmt::NmtState;
use crate::configuration::ApplyError;
use crate::error::Error;

/// Maximum length of a version text in bytes.
pub(super) const LONGEST_VERSION: usize = 64;

/// Hardware or software version of a node: a text of at most 64 bytes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct VersionText {
    bytes: [u8; LONGEST_VERSION],
    length: usize,
}

impl VersionText {
    /// Creates the version from a text of at most 64 bytes.
    pub(super) fn new(text: &str) -> Self {
        let mut bytes = [0; LONGEST_VERSION];
        bytes.iter_mut().zip(text.as_bytes()).for_each(|(to, from)| *to = *from);
        Self { bytes, length: text.len() }
    }

    /// Returns the text.
    #[must_use]
    pub fn as_str(&self) -> &str {
        self.bytes.get(..self.length).and_then(|text| core::str::from_utf8(text).ok()).unwrap_or_default()
    }
}

impl fmt::Debug for VersionText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_str().fmt(f)
    }
}

impl fmt::Display for VersionText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_str().fmt(f)
    }
}

/// Reason why the boot of a node failed. `E` is the error type of the CAN interface. The letters in the descriptions of
/// the variants are the error statuses of CiA 302-2.
///
/// The letter L is not an error: [`Booted::status`](super::Booted::status) returns this letter. Three letters don't
/// occur:
///
/// - A (the node isn't in the network list 0x1F81): Lexibus has no such list, because the program boots the nodes one
///   by one.
/// - G and I (program download not configured, or failed): the master doesn't download programs. H means that the
///   software version differs or could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BootError<E> {
    /// An NMT command was not sent, or the CAN interface failed outside SDO transfers and node guarding requests.
    Command(Error<E>),
    /// The node did not send its boot-up message after the restart.
    NoBootUp,
    /// E: a node that is to be [kept running](super::Boot::keep_running) sent no heartbeat, and no restart is requested.
    NoHeartbeat,
    /// An object could not be read. The letter depends on the object: B (0x1000), D, M, N or O (0x1018), H (0x100A), J
    /// (0x1020), none (0x1009).
    Access {
        /// The object.
        object: Object,
        /// The error of the client.
        error: Error<E>,
    },
    /// C: the device type (0x1000) differs.
    DeviceType {
        /// Expected value.
        expected: u32,
        /// Value of the node.
        actual: u32,
    },
    /// D: the vendor-ID (0x1018:01) differs.
    VendorId {
        /// Expected value.
        expected: u32,
        /// Value of the node.
        actual: u32,
    },
    /// M: the product code (0x1018:02) differs.
    ProductCode {
        /// Expected value.
        expected: u32,
        /// Value of the node.
        actual: u32,
    },
    /// N: the revision number (0x1018:03) differs.
    RevisionNumber {
        /// Expected value.
        expected: u32,
        /// Value of the node.
        actual: u32,
    },
    /// O: the serial number (0x1018:04) differs.
    SerialNumber {
        /// Expected value.
        expected: u32,
        /// Value of the node.
        actual: u32,
    },
    /// The hardware version (0x1009) differs.
    HardwareVersion {
        /// Expected value.
        expected: &'static str,
        /// Value of the node.
        actual: VersionText,
    },
    /// H: the software version (0x100A) differs. The master doesn't update software.
    SoftwareVersion {
        /// Expected value.
        expected: &'static str,
        /// Value of the node.
        actual: VersionText,
    },
    /// J: a value of the configuration could not be written.
    Configuration(ApplyError<E>),
    /// J: the node did not store the configuration (0x1010), or its date (0x1020) could not be written.
    Store {
        /// The object.
        object: Object,
        /// The error of the client.
        error: Error<E>,
    },
    /// K: the node was started, but did not report Operational in time.
    NotOperational {
        /// The state in the last heartbeat or guarding answer, or `None` if none arrived.
        actual: Option<NmtState>,
    },
    /// F: node guarding failed, either after the start of the node, or before the boot of a node that is to be kept
    /// running.
    Guarding(GuardError<E>),
}

impl<E> BootError<E> {
    /// Returns the letter of the error status in CiA 302-2, or `None` for errors without a letter.
    #[must_use]
    pub const fn status(&self) -> Option<char> {
        Some(match self {
            Self::Access { object, .. } => match (object.index, object.sub_index) {
                (index, _) if index == DEVICE_TYPE.index => 'B',
                (IDENTITY, 1) => 'D',
                (IDENTITY, 2) => 'M',
                (IDENTITY, 3) => 'N',
                (IDENTITY, _) => 'O',
                (VERIFY, _) => 'J',
                (index, _) if index == SOFTWARE_VERSION.index => 'H',
                _ => return None,
            },
            Self::DeviceType { .. } => 'C',
            Self::VendorId { .. } => 'D',
            Self::ProductCode { .. } => 'M',
            Self::RevisionNumber { .. } => 'N',
            Self::SerialNumber { .. } => 'O',
            Self::SoftwareVersion { .. } => 'H',
            Self::Configuration(_) | Self::Store { .. } => 'J',
            Self::NoHeartbeat => 'E',
            Self::NotOperational { .. } => 'K',
            Self::Guarding(_) => 'F',
            Self::Command(_) | Self::NoBootUp | Self::HardwareVersion { .. } => return None,
        })
    }
}

impl<E: fmt::Display> fmt::Display for BootError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |f: &mut fmt::Formatter<'_>, name, expected: &u32, actual: &u32| {
            write!(f, "the {name} is {actual:#010X} instead of {expected:#010X}")
        };
        match self {
            Self::Command(error) => error.fmt(f),
            Self::NoBootUp => f.write_str("the node did not send its boot-up message after the restart"),
            Self::NoHeartbeat => f.write_str("the node sent no heartbeat"),
            Self::Access { object, error } => write!(f, "cannot read {object}: {error}"),
            Self::DeviceType { expected, actual } => number(f, "device type (0x1000)", expected, actual),
            Self::VendorId { expected, actual } => number(f, "vendor-ID (0x1018:01)", expected, actual),
            Self::ProductCode { expected, actual } => number(f, "product code (0x1018:02)", expected, actual),
            Self::RevisionNumber { expected, actual } => number(f, "revision number (0x1018:03)", expected, actual),
            Self::SerialNumber { expected, actual } => number(f, "serial number (0x1018:04)", expected, actual),
            Self::HardwareVersion { expected, actual } => {
                write!(f, "the hardware version (0x1009) is {actual:?} instead of {expected:?}")
            }
            Self::SoftwareVersion { expected, actual } => {
                write!(f, "the software version (0x100A) is {actual:?} instead of {expected:?}")
            }
            Self::Configuration(error) => write!(f, "the configuration failed: {error}"),
            Self::Store { object, error } => write!(f, "the node did not store its configuration: {object}: {error}"),
            Self::NotOperational { actual: Some(state) } => write!(f, "the node is in {state:?} after its start"),
            Self::NotOperational { actual: None } => f.write_str("the node sent no heartbeat after its start"),
            Self::Guarding(error) => error.fmt(f),
        }
    }
}

impl<E: error::Error + 'static> error::Error for BootError<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Command(error) => error.source(),
            Self::Access { error, .. } | Self::Store { error, .. } => Some(error),
            Self::Configuration(error) => Some(error),
            Self::Guarding(error) => error.source(),
            _ => None,
        }
    }
}
