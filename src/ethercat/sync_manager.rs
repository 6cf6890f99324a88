//! Sync managers and FMMUs (ETG.1000.4 6.6, 6.7).

/// What a sync manager is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SyncManagerPurpose {
    /// Mailbox, master to slave.
    MailboxOut,
    /// Mailbox, slave to master.
    MailboxIn,
    /// Process data, master to slave.
    Outputs,
    /// Process data, slave to master.
    Inputs,
}

/// A sync manager with its settings by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SyncManager {
    /// Its number.
    pub number: u8,
    /// What it is for.
    pub purpose: SyncManagerPurpose,
    /// First address in the memory of the slave controller.
    pub start_address: u16,
    /// Length in bytes by default; 0 where it follows from the assigned PDOs.
    pub default_size: u16,
    /// Least length in bytes, where there is one.
    pub min_size: Option<u16>,
    /// Greatest length in bytes, where there is one.
    pub max_size: Option<u16>,
    /// The control register.
    pub control: u8,
    /// Whether it is enabled.
    pub enable: bool,
    /// Whether it is enabled in Op only.
    pub op_only: bool,
}

/// What an FMMU maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FmmuPurpose {
    /// Process data, master to slave.
    Outputs,
    /// Process data, slave to master.
    Inputs,
    /// The state of the mailbox.
    MailboxState,
    /// Something that the description doesn't tell.
    Other,
}

/// A fieldbus memory management unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fmmu {
    /// What it maps.
    pub purpose: FmmuPurpose,
    /// The sync manager that it maps, where given.
    pub sync_manager: Option<u8>,
    /// Whether it is enabled in Op only.
    pub op_only: bool,
}
