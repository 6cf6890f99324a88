//! Where an item is found: at most one address on each bus.

use crate::bus::{Bus, CanOpen, CoE, Modbus, Object, Parameter, Profinet, Record, Register, Serial};

/// Stands in a [`Location`] for a bus on which the item doesn't exist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Absent;

/// An item's address on each bus. Each field is the bus's address type, or [`Absent`].
///
/// ```
/// use lexibus::{Absent, Location, Modbus, Object, On, Register};
///
/// const TARGET_POSITION: Location<Object, Object, Register> = Location {
///     canopen: Object { index: 0x607A, sub_index: 0 },
///     coe: Object { index: 0x607A, sub_index: 0 },
///     modbus: Register { address: 0x8009, words: 2, low_word_first: false },
///     profinet: Absent,
///     serial: Absent,
/// };
/// assert_eq!(On::<Modbus>::address(&TARGET_POSITION).address, 0x8009);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Location<C = Absent, E = Absent, M = Absent, P = Absent, S = Absent> {
    /// On CANopen: [`Object`] or [`Absent`].
    pub canopen: C,
    /// On CANopen over EtherCAT: [`Object`] or [`Absent`].
    pub coe: E,
    /// On Modbus: [`Register`] or [`Absent`].
    pub modbus: M,
    /// On PROFINET: [`Record`] or [`Absent`].
    pub profinet: P,
    /// On a serial protocol: [`Parameter`] or [`Absent`].
    pub serial: S,
}

/// Implemented by the locations that have an address on bus `B`.
#[diagnostic::on_unimplemented(
    message = "this item doesn't exist on `{B}`",
    label = "the item has no address on the client's bus"
)]
pub trait On<B: Bus> {
    /// The item's address on bus `B`.
    fn address(&self) -> B::Address;
}

impl<E, M, P, S> On<CanOpen> for Location<Object, E, M, P, S> {
    fn address(&self) -> Object {
        self.canopen
    }
}

impl<C, M, P, S> On<CoE> for Location<C, Object, M, P, S> {
    fn address(&self) -> Object {
        self.coe
    }
}

impl<C, E, P, S> On<Modbus> for Location<C, E, Register, P, S> {
    fn address(&self) -> Register {
        self.modbus
    }
}

impl<C, E, M, S> On<Profinet> for Location<C, E, M, Record, S> {
    fn address(&self) -> Record {
        self.profinet
    }
}

impl<C, E, M, P> On<Serial> for Location<C, E, M, P, Parameter> {
    fn address(&self) -> Parameter {
        self.serial
    }
}

/// The location of an item that exists on CANopen only.
pub type OnCanOpen = Location<Object>;

/// The location of an item that exists on CANopen over EtherCAT only.
pub type OnCoE = Location<Absent, Object>;

/// The location of an item that has the same object address on CANopen and on CANopen over EtherCAT.
pub type OnCanOpenAndCoE = Location<Object, Object>;

impl OnCanOpen {
    /// An object of a CANopen device.
    #[must_use]
    pub const fn canopen(index: u16, sub_index: u8) -> Self {
        objects(Object { index, sub_index }, Absent)
    }
}

impl OnCoE {
    /// An object of an EtherCAT device.
    #[must_use]
    pub const fn coe(index: u16, sub_index: u8) -> Self {
        objects(Absent, Object { index, sub_index })
    }
}

impl OnCanOpenAndCoE {
    /// An object of a device that speaks CANopen and EtherCAT.
    #[must_use]
    pub const fn object(index: u16, sub_index: u8) -> Self {
        objects(Object { index, sub_index }, Object { index, sub_index })
    }
}

const fn objects<C: Copy, E: Copy>(canopen: C, coe: E) -> Location<C, E> {
    Location { canopen, coe, modbus: Absent, profinet: Absent, serial: Absent }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn object_is_found_on_each_of_its_buses() {
        let object = Object { index: 0x6040, sub_index: 1 };
        assert_eq!(On::<CanOpen>::address(&OnCanOpen::canopen(0x6040, 1)), object);
        assert_eq!(On::<CoE>::address(&OnCoE::coe(0x6040, 1)), object);
        assert_eq!(On::<CanOpen>::address(&OnCanOpenAndCoE::object(0x6040, 1)), object);
        assert_eq!(On::<CoE>::address(&OnCanOpenAndCoE::object(0x6040, 1)), object);
    }

    #[test]
    fn every_bus_has_its_own_address() {
        let everywhere = Location {
            canopen: Object { index: 1, sub_index: 2 },
            coe: Object { index: 3, sub_index: 4 },
            modbus: Register { address: 5, words: 1, low_word_first: false },
            profinet: Record { api: 0, slot: 1, subslot: 1, index: 6, offset: 7 },
            serial: Parameter(8),
        };
        assert_eq!(On::<CanOpen>::address(&everywhere).index, 1);
        assert_eq!(On::<CoE>::address(&everywhere).index, 3);
        assert_eq!(On::<Modbus>::address(&everywhere).address, 5);
        assert_eq!(On::<Profinet>::address(&everywhere).offset, 7);
        assert_eq!(On::<Serial>::address(&everywhere), Parameter(8));
    }
}
