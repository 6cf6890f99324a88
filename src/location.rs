//! Where an item is found: at most one address on each bus.

use crate::bus::{Bus, CanOpen, CoE, Modbus, Object, Parameter, Profinet, Record, Serial};
use crate::register::Register;

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
///     modbus: Register::high_first(0x8009, 2),
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

impl<C, E, M, P, S> Location<C, E, M, P, S> {
    /// The address on each bus.
    #[must_use]
    pub const fn new(canopen: C, coe: E, modbus: M, profinet: P, serial: S) -> Self {
        Self { canopen, coe, modbus, profinet, serial }
    }
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
    #[inline]
    fn address(&self) -> Object {
        self.canopen
    }
}

impl<C, M, P, S> On<CoE> for Location<C, Object, M, P, S> {
    #[inline]
    fn address(&self) -> Object {
        self.coe
    }
}

impl<C, E, P, S> On<Modbus> for Location<C, E, Register, P, S> {
    #[inline]
    fn address(&self) -> Register {
        self.modbus
    }
}

impl<C, E, M, S> On<Profinet> for Location<C, E, M, Record, S> {
    #[inline]
    fn address(&self) -> Record {
        self.profinet
    }
}

impl<C, E, M, P> On<Serial> for Location<C, E, M, P, Parameter> {
    #[inline]
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

/// The location of an item that exists on Modbus only.
pub type OnModbus = Location<Absent, Absent, Register>;

/// The location of an item that is an object on CANopen and a register on Modbus.
pub type OnCanOpenAndModbus = Location<Object, Absent, Register>;

/// The location of an item that is an object on CANopen over EtherCAT and a register on Modbus.
pub type OnCoEAndModbus = Location<Absent, Object, Register>;

/// The location of an item that is the same object on CANopen and on CANopen over EtherCAT, and a register on Modbus.
pub type OnCanOpenCoEAndModbus = Location<Object, Object, Register>;

/// The location of an item that exists on PROFINET only, as a part of a record.
pub type OnProfinet = Location<Absent, Absent, Absent, Record>;

/// The location of an item that exists on a serial protocol only.
pub type OnSerial = Location<Absent, Absent, Absent, Absent, Parameter>;

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

impl OnModbus {
    /// A register of a Modbus device.
    #[must_use]
    pub const fn modbus(register: Register) -> Self {
        registers(Absent, Absent, register)
    }
}

impl OnCanOpenAndModbus {
    /// An object that is a register, too.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        registers(Object { index, sub_index }, Absent, register)
    }
}

impl OnCoEAndModbus {
    /// An object that is a register, too.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        registers(Absent, Object { index, sub_index }, register)
    }
}

impl OnCanOpenCoEAndModbus {
    /// An object, the same on both buses, that is a register, too.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        registers(Object { index, sub_index }, Object { index, sub_index }, register)
    }
}

impl OnProfinet {
    /// A part of a record of a PROFINET device.
    #[must_use]
    pub const fn record(part: Record) -> Self {
        Location { canopen: Absent, coe: Absent, modbus: Absent, profinet: part, serial: Absent }
    }
}

impl OnSerial {
    /// A parameter of a serial protocol.
    #[must_use]
    pub const fn serial(number: u32) -> Self {
        Location { canopen: Absent, coe: Absent, modbus: Absent, profinet: Absent, serial: Parameter(number) }
    }
}

const fn registers<C: Copy, E: Copy>(canopen: C, coe: E, modbus: Register) -> Location<C, E, Register> {
    Location { canopen, coe, modbus, profinet: Absent, serial: Absent }
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
    fn a_register_may_be_an_object_too() {
        let (object, register) = (Object { index: 0x2008, sub_index: 1 }, Register::low_first(8, 2));
        let everywhere = OnCanOpenCoEAndModbus::register(0x2008, 1, register);
        assert_eq!(On::<CanOpen>::address(&everywhere), object);
        assert_eq!(On::<CoE>::address(&everywhere), object);
        assert_eq!(On::<Modbus>::address(&everywhere), register);
        assert_eq!(On::<CanOpen>::address(&OnCanOpenAndModbus::register(0x2008, 1, register)), object);
        assert_eq!(On::<CoE>::address(&OnCoEAndModbus::register(0x2008, 1, register)), object);
        assert_eq!(On::<Modbus>::address(&OnModbus::modbus(register)), register);
        assert_eq!(On::<Serial>::address(&OnSerial::serial(70_000)), Parameter(70_000));
    }

    #[test]
    fn every_bus_has_its_own_address() {
        let everywhere = Location {
            canopen: Object { index: 1, sub_index: 2 },
            coe: Object { index: 3, sub_index: 4 },
            modbus: Register::holding(5),
            profinet: Record::new(1, 1, 6, 7),
            serial: Parameter(8),
        };
        assert_eq!(On::<CanOpen>::address(&everywhere).index, 1);
        assert_eq!(On::<CoE>::address(&everywhere).index, 3);
        assert_eq!(On::<Modbus>::address(&everywhere).address, 5);
        assert_eq!(On::<Profinet>::address(&everywhere).offset, 7);
        assert_eq!(On::<Serial>::address(&everywhere), Parameter(8));
    }
}
