//! Sets of buses and their names in tables.

use super::at::At;
use super::tree::Reader;

/// A set of buses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Buses {
    pub canopen: bool,
    pub ethercat: bool,
    pub modbus: bool,
    pub profinet: bool,
    pub serial: bool,
}

impl Buses {
    pub const ALL: Buses = Buses { canopen: true, ethercat: true, modbus: true, profinet: true, serial: true };
    pub const NONE: Buses = Buses { canopen: false, ethercat: false, modbus: false, profinet: false, serial: false };

    /// Their names in tables.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        let all = [
            (self.canopen, "canopen"),
            (self.ethercat, "ethercat"),
            (self.modbus, "modbus"),
            (self.profinet, "profinet"),
            (self.serial, "serial"),
        ];
        all.into_iter().filter_map(|(is, name)| is.then_some(name))
    }

    /// Those that are in one of both.
    pub fn or(self, other: Buses) -> Buses {
        Buses {
            canopen: self.canopen || other.canopen,
            ethercat: self.ethercat || other.ethercat,
            modbus: self.modbus || other.modbus,
            profinet: self.profinet || other.profinet,
            serial: self.serial || other.serial,
        }
    }

    /// Those that are in both.
    pub fn and(self, other: Buses) -> Buses {
        Buses {
            canopen: self.canopen && other.canopen,
            ethercat: self.ethercat && other.ethercat,
            modbus: self.modbus && other.modbus,
            profinet: self.profinet && other.profinet,
            serial: self.serial && other.serial,
        }
    }
}

/// Reads a list of names of buses. An unknown name is reported.
pub(super) fn read(reader: &mut Reader<'_, '_>, list: &[At<String>]) -> Buses {
    let words = [("canopen", 0), ("ethercat", 1), ("modbus", 2), ("profinet", 3), ("serial", 4)];
    let mut buses = Buses::NONE;
    for name in list {
        match reader.word(name, "bus", &words) {
            Some(0) => buses.canopen = true,
            Some(1) => buses.ethercat = true,
            Some(2) => buses.modbus = true,
            Some(3) => buses.profinet = true,
            Some(4) => buses.serial = true,
            _ => {}
        }
    }
    buses
}
