//! Sync managers (ETG.1000.4 6.7) and FMMUs (ETG.1000.4 6.6).

/// Purpose of a sync manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SyncManagerPurpose {
    /// Mailbox data from master to slave.
    MailboxOut,
    /// Mailbox data from slave to master.
    MailboxIn,
    /// Process data from master to slave.
    Outputs,
    /// Process data from slave to master.
    Inputs,
}

/// A sync manager and its default settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SyncManager {
    /// Number of the sync manager.
    pub number: u8,
    /// Purpose of the sync manager.
    pub purpose: SyncManagerPurpose,
    /// Start address in the memory of the slave controller.
    pub start_address: u16,
    /// Default length in bytes; 0 if the length depends on the assigned PDOs.
    pub default_size: u16,
    /// Minimum length in bytes.
    pub min_size: Option<u16>,
    /// Maximum length in bytes.
    pub max_size: Option<u16>,
    /// Value of the control register.
    pub control: u8,
    /// True if the sync manager is enabled.
    pub enable: bool,
    /// True if the sync manager is enabled only in Operational.
    pub op_only: bool,
}

/// Purpose of an FMMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FmmuPurpose {
    /// Process data from master to slave.
    Outputs,
    /// Process data from slave to master.
    Inputs,
    /// Status of the mailbox.
    MailboxState,
    /// Any other purpose, or no purpose in the device description.
    Other,
}

/// A fieldbus memory management unit (FMMU).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fmmu {
    /// Purpose of the FMMU.
    pub purpose: FmmuPurpose,
    /// Number of the sync manager that the FMMU maps, if known.
    pub sync_manager: Option<u8>,
    /// True if the FMMU is enabled only in Operational.
    pub op_only: bool,
}
