//! Boot procedure of a node: expected values, configuration and error control.

use core::time::Duration;

use super::{CONFIGURATION_DATE, CONFIGURATION_TIME};
use crate::configuration::Configuration;
use crate::identity::Identity;
use crate::node_id::NodeId;
use crate::time::TimeOfDay;

/// How the master checks that a node is running, after the start of the node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorControl {
    /// A heartbeat that reports Operational must arrive within this time. The configuration has to set the producer
    /// heartbeat time (0x1017) of the node, unless the node has stored this time.
    Heartbeat(Duration),
    /// The node must answer node guarding and report Operational within `life_time_factor + 1` cycles, or within 3
    /// cycles if the factor is less than 2. Use the values of objects 0x100C and 0x100D of the node. To continue node
    /// guarding after the boot, create a [`Guarding`](crate::clients::canopen::Guarding) with the same values, and run
    /// its first cycle within the node life time. Otherwise, the node assumes that the master has failed.
    Guarding {
        /// Time between two cycles, and maximum duration of a cycle.
        guard_time: Duration,
        /// Number of consecutive cycles without a valid answer after which the node is lost.
        life_time_factor: u8,
    },
    /// The state of the node is not checked.
    None,
}

/// Boot procedure for [`Node::boot`](crate::clients::canopen::Node::boot): the expected values, the configuration and
/// the error control of the node.
///
/// Each expected value is optional. As in objects 0x1F84 to 0x1F88 of a CANopen manager, the expected number 0 means
/// that the value is not checked.
///
/// ```
/// use std::time::Duration;
///
/// use lexibus::clients::canopen::{Boot, ErrorControl};
/// use lexibus_drives::demo_drive::IDENTITY;
///
/// /// The heartbeat has to arrive within a second.
/// const BOOT: Boot = Boot::new(ErrorControl::Heartbeat(Duration::from_secs(1)))
///     .reset(Duration::from_secs(5))
///     .device_type(0x0002_0192)
///     .identity(&IDENTITY);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Boot {
    pub(super) checks: Checks,
    pub(super) configuration: Option<Configuration>,
    date: Option<TimeOfDay>,
    pub(super) is_stored: bool,
    pub(super) reset: Option<Duration>,
    pub(super) keeps_running: bool,
    pub(super) error_control: ErrorControl,
}

/// Expected values of the node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Checks {
    pub(super) device_type: u32,
    /// Vendor-ID, product code, revision number and serial number.
    pub(super) identity: [u32; 4],
    pub(super) hardware_version: Option<&'static str>,
    pub(super) software_version: Option<&'static str>,
}

impl Boot {
    /// Creates a boot without checks and without a configuration: it reads the device type (0x1000), starts the node,
    /// and checks that the node is running, if `error_control` isn't [`None`](ErrorControl::None).
    #[must_use]
    pub const fn new(error_control: ErrorControl) -> Self {
        let checks = Checks { device_type: 0, identity: [0; 4], hardware_version: None, software_version: None };
        let reset = None;
        Self { checks, configuration: None, date: None, is_stored: false, reset, keeps_running: false, error_control }
    }

    /// Restarts the node first (NMT command "reset node"), and waits for its boot-up message for at most `patience`.
    #[must_use]
    pub const fn reset(mut self, patience: Duration) -> Self {
        self.reset = Some(patience);
        self
    }

    /// Keeps a node running that is already in Operational, as bit 4 of object 0x1F81 of a CANopen manager does (CiA
    /// 302-2). To determine the state, the master first waits for a heartbeat or uses node guarding. If the node is in
    /// Operational, the master only checks the device type, the identity and the versions. The master neither restarts
    /// nor configures such a node, and doesn't compare the configuration. In this case,
    /// [`Booted::was_operational`](super::Booted::was_operational) is true. A node in another state is booted as
    /// without this option.
    ///
    /// A node that doesn't report its state is restarted if a [restart](Self::reset) is requested. Otherwise, the boot
    /// fails with [`BootError::NoHeartbeat`](super::BootError::NoHeartbeat) or
    /// [`BootError::Guarding`](super::BootError::Guarding). If no restart is requested, the node must therefore have
    /// stored its producer heartbeat time (0x1017): otherwise, the node sends no heartbeat before it is configured.
    ///
    /// Without [error control](ErrorControl::None), the state of the node is unknown, and the option has no effect.
    #[must_use]
    pub const fn keep_running(mut self) -> Self {
        self.keeps_running = true;
        self
    }

    /// Sets the expected device type (0x1000).
    #[must_use]
    pub const fn device_type(mut self, expected: u32) -> Self {
        self.checks.device_type = expected;
        self
    }

    /// Sets the expected vendor-ID, product code and revision number (0x1018) to those of a device description. Numbers
    /// that are missing in the description are not checked.
    #[must_use]
    pub const fn identity(self, identity: &Identity) -> Self {
        const fn number(number: Option<u32>) -> u32 {
            match number {
                Some(number) => number,
                None => 0,
            }
        }
        self.vendor_id(number(identity.vendor_id))
            .product_code(number(identity.product_code))
            .revision_number(number(identity.revision_number))
    }

    /// Sets the expected vendor-ID (0x1018:01).
    #[must_use]
    pub const fn vendor_id(mut self, expected: u32) -> Self {
        let [_, product_code, revision_number, serial_number] = self.checks.identity;
        self.checks.identity = [expected, product_code, revision_number, serial_number];
        self
    }

    /// Sets the expected product code (0x1018:02).
    #[must_use]
    pub const fn product_code(mut self, expected: u32) -> Self {
        let [vendor_id, _, revision_number, serial_number] = self.checks.identity;
        self.checks.identity = [vendor_id, expected, revision_number, serial_number];
        self
    }

    /// Sets the expected revision number (0x1018:03). Both halves, major and minor, must be equal. The value 0 removes
    /// the check, for example after [`identity`](Self::identity).
    #[must_use]
    pub const fn revision_number(mut self, expected: u32) -> Self {
        let [vendor_id, product_code, _, serial_number] = self.checks.identity;
        self.checks.identity = [vendor_id, product_code, expected, serial_number];
        self
    }

    /// Sets the expected serial number (0x1018:04).
    #[must_use]
    pub const fn serial_number(mut self, expected: u32) -> Self {
        let [vendor_id, product_code, revision_number, _] = self.checks.identity;
        self.checks.identity = [vendor_id, product_code, revision_number, expected];
        self
    }

    /// Sets the expected manufacturer hardware version (0x1009), of at most 64 bytes.
    #[must_use]
    pub const fn hardware_version(mut self, expected: &'static str) -> Self {
        self.checks.hardware_version = Some(expected);
        self
    }

    /// Sets the expected manufacturer software version (0x100A), of at most 64 bytes.
    #[must_use]
    pub const fn software_version(mut self, expected: &'static str) -> Self {
        self.checks.software_version = Some(expected);
        self
    }

    /// Sets the configuration of the node, for example the generated constant `CONFIGURATION`. The configuration is
    /// written unless object 0x1020 of the node contains the date of the configuration.
    ///
    /// The date of the configuration is the [`configuration_date`](Self::configuration_date) if it is set, and
    /// otherwise the value of 0x1020 in the configuration. A configuration without a date is written at each boot.
    #[must_use]
    pub const fn configuration(mut self, configuration: Configuration) -> Self {
        self.configuration = Some(configuration);
        self
    }

    /// Sets the date of the configuration. This date takes precedence over a date in the configuration itself. The date
    /// January 1, 1984, 0:00 means that there is no date.
    #[must_use]
    pub const fn configuration_date(mut self, date: TimeOfDay) -> Self {
        self.date = Some(date);
        self
    }

    /// Stores the configuration in the node (0x1010:01) after it was written. If the node confirms the command, the
    /// date of the configuration is written to 0x1020 and stored, too. Without this option, 0x1020 is never written,
    /// because the node loses the configuration when it restarts.
    ///
    /// The node must confirm the store command within the [timeout](crate::clients::canopen::Node::with_timeout) of the
    /// client.
    #[must_use]
    pub const fn store(mut self) -> Self {
        self.is_stored = true;
        self
    }

    /// Returns the values of 0x1020:01 and 0x1020:02, or `None` if the configuration has no date.
    pub(super) fn date(&self, node: NodeId) -> Option<[u32; 2]> {
        let number = |object| {
            let write = self.configuration?.of(object, node)?;
            write.data().try_into().ok().map(u32::from_le_bytes)
        };
        let date = match self.date {
            Some(date) => [date.days.into(), date.milliseconds],
            None => [number(CONFIGURATION_DATE)?, number(CONFIGURATION_TIME)?],
        };
        Some(date).filter(|date| *date != [0; 2])
    }
}
