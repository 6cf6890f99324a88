//! Buses, and sets of buses.

use std::fmt;

use super::ObjectBuses;

/// A bus or protocol through which a client accesses a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Bus {
    /// The CANopen bus.
    CanOpen,
    /// The EtherCAT bus.
    EtherCat,
    /// Modbus RTU or TCP.
    Modbus,
    /// PROFINET IO.
    Profinet,
    /// A serial line with a command protocol.
    Serial,
}

impl Bus {
    /// All buses, in the order of [`Buses::iter`].
    pub const ALL: [Bus; 5] = [Bus::CanOpen, Bus::EtherCat, Bus::Modbus, Bus::Profinet, Bus::Serial];

    /// Returns the name of the bus in register tables and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Bus::CanOpen => "canopen",
            Bus::EtherCat => "ethercat",
            Bus::Modbus => "modbus",
            Bus::Profinet => "profinet",
            Bus::Serial => "serial",
        }
    }

    /// Returns the bus with this name in register tables.
    pub fn from_name(name: &str) -> Option<Self> {
        Bus::ALL.into_iter().find(|bus| bus.name() == name)
    }
}

impl fmt::Display for Bus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of buses. The serialized form is a list of names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Vec<Bus>", into = "Vec<Bus>"))]
pub struct Buses(u8);

impl Buses {
    /// The empty set.
    pub const NONE: Buses = Buses(0);
    /// The set of all buses.
    pub const ALL: Buses = Buses((1 << Bus::ALL.len()) - 1);

    /// Returns whether the set is empty.
    pub fn is_empty(&self) -> bool {
        *self == Buses::NONE
    }

    /// Returns whether the set contains a bus.
    pub fn contains(self, bus: Bus) -> bool {
        self.0 & (1 << bus as u8) != 0
    }

    /// Returns the union of two sets.
    pub fn or(self, other: Buses) -> Buses {
        Buses(self.0 | other.0)
    }

    /// Returns the intersection of two sets.
    pub fn and(self, other: Buses) -> Buses {
        Buses(self.0 & other.0)
    }

    /// Returns the buses of the set, in the order of [`Bus::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Bus> {
        Bus::ALL.into_iter().filter(move |bus| self.contains(*bus))
    }

    /// Returns the buses of the set that have an object dictionary.
    pub fn with_objects(self) -> ObjectBuses {
        ObjectBuses { canopen: self.contains(Bus::CanOpen), coe: self.contains(Bus::EtherCat) }
    }
}

impl FromIterator<Bus> for Buses {
    fn from_iter<I: IntoIterator<Item = Bus>>(list: I) -> Self {
        list.into_iter().fold(Buses::NONE, |all, bus| Buses(all.0 | 1 << bus as u8))
    }
}

impl From<ObjectBuses> for Buses {
    fn from(objects: ObjectBuses) -> Self {
        let canopen = objects.canopen.then_some(Bus::CanOpen);
        canopen.into_iter().chain(objects.coe.then_some(Bus::EtherCat)).collect()
    }
}

impl From<Vec<Bus>> for Buses {
    fn from(list: Vec<Bus>) -> Self {
        list.into_iter().collect()
    }
}

impl From<Buses> for Vec<Bus> {
    fn from(buses: Buses) -> Self {
        buses.iter().collect()
    }
}

impl fmt::Display for Buses {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.iter().map(Bus::name).collect::<Vec<_>>().join(", "))
    }
}
