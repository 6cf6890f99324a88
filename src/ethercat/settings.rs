//! Settings of the sync managers, FMMUs and distributed clocks of a slave.

use super::Direction;

/// Settings of a sync manager (ETG.1000.4, 6.7.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SyncManagerSettings {
    /// Number of the sync manager.
    pub number: u8,
    /// Start address in the memory of the slave controller.
    pub start_address: u16,
    /// Length in bytes. For process data, this is the length of the assigned PDOs.
    pub length: u16,
    /// Value of the control register.
    pub control: u8,
    /// True if the sync manager is enabled. A sync manager without data is disabled.
    pub enable: bool,
    /// True if the sync manager is enabled only in Operational.
    pub op_only: bool,
}

impl SyncManagerSettings {
    /// Returns the address of the first register of the sync manager: 0x0800 for sync manager 0.
    #[must_use]
    pub const fn register(&self) -> u16 {
        0x0800 + 8 * self.number as u16
    }

    /// Returns the 8 bytes of the registers: start address, length, control, status, activation and PDI control. The slave
    /// ignores the bytes for the status and the PDI control, which are 0. The bytes do not depend on
    /// [`op_only`](Self::op_only): if it is set, write them only at the transition to Operational.
    #[must_use]
    pub const fn bytes(&self) -> [u8; 8] {
        let ([start, start_high], [length, length_high]) =
            (self.start_address.to_le_bytes(), self.length.to_le_bytes());
        [start, start_high, length, length_high, self.control, 0, self.enable as u8, 0]
    }
}

/// Settings of a fieldbus memory management unit (FMMU), which maps the process data of a sync manager to logical addresses
/// (ETG.1000.4, 6.6.2). These settings map whole bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FmmuSettings {
    /// Number of the FMMU.
    pub number: u8,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Direction of the data.
    pub direction: Direction,
    /// Logical start address.
    pub logical_address: u32,
    /// Length in bytes.
    pub length: u16,
    /// Physical start address.
    pub physical_address: u16,
    /// True if the FMMU is enabled only in Operational.
    pub op_only: bool,
}

impl FmmuSettings {
    /// Returns the address of the first register of the FMMU: 0x0600 for FMMU 0.
    #[must_use]
    pub const fn register(&self) -> u16 {
        0x0600 + 16 * self.number as u16
    }

    /// Returns the 16 bytes for the registers of the FMMU. Writing these bytes enables the FMMU. The mapping starts at bit 0
    /// of the first byte and ends at bit 7 of the last byte. The FMMU writes outputs to the slave, and reads inputs. The
    /// bytes do not depend on [`op_only`](Self::op_only): if it is set, write them only at the transition to Operational.
    #[must_use]
    pub const fn bytes(&self) -> [u8; 16] {
        let [a, b, c, d] = self.logical_address.to_le_bytes();
        let ([length, length_high], [start, start_high]) =
            (self.length.to_le_bytes(), self.physical_address.to_le_bytes());
        let access = match self.direction {
            Direction::Input => 0x01,
            Direction::Output => 0x02,
        };
        [a, b, c, d, length, length_high, 0, 7, start, start_high, 0, access, 1, 0, 0, 0]
    }
}

/// Settings of the distributed clocks of a slave (ETG.2000, `Dc/OpMode`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClockSettings {
    /// Value of the registers 0x0980 and 0x0981 (`AssignActivate`). Bit 9 activates SYNC0, and bit 10 activates SYNC1.
    pub assign_activate: u32,
    /// Times of SYNC0.
    pub sync0: ClockSignal,
    /// Times of SYNC1.
    pub sync1: ClockSignal,
}

/// Times of a SYNC signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClockSignal {
    /// Cycle time in ns.
    pub cycle_time: i64,
    /// Shift time in ns.
    pub shift_time: i64,
    /// True if the shift is relative to the inputs.
    pub relative_to_inputs: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_of_a_sync_manager_and_an_fmmu() {
        let manager = SyncManagerSettings {
            number: 2,
            start_address: 0x1100,
            length: 0x0206,
            control: 0x64,
            enable: true,
            op_only: false,
        };
        assert_eq!((manager.register(), manager.bytes()), (0x0810, [0x00, 0x11, 0x06, 0x02, 0x64, 0, 1, 0]));
        let fmmu = FmmuSettings {
            number: 1,
            sync_manager: 2,
            direction: Direction::Output,
            logical_address: 0x0001_0003,
            length: 0x0206,
            physical_address: 0x1100,
            op_only: false,
        };
        let bytes = [0x03, 0, 1, 0, 0x06, 0x02, 0, 7, 0x00, 0x11, 0, 2, 1, 0, 0, 0];
        assert_eq!((fmmu.register(), fmmu.bytes()), (0x0610, bytes));
        assert_eq!(FmmuSettings { direction: Direction::Input, ..fmmu }.bytes()[11], 1);
    }
}
