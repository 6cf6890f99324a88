//! Where an item is found: at most one route on each bus.

use crate::bus::{
    Bus, CanOpen, CoE, Esc, EscMemory, Modbus, Object, Parameter, ProcessImage, Profinet, Record, Serial,
};
use crate::image_field::ImageField;
use crate::register::Register;

/// Stands in a [`Location`] for a bus on which the item doesn't exist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Absent;

/// How an item is reached on each bus. Each field is a route, as a rule the bus's address itself, or [`Absent`].
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
///     image: Absent,
///     esc: Absent,
/// };
/// assert_eq!(On::<Modbus>::route(&TARGET_POSITION).address, 0x8009);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Location<C = Absent, E = Absent, M = Absent, P = Absent, S = Absent, I = Absent, X = Absent> {
    /// On CANopen: an [`Object`], another route over objects, or [`Absent`].
    pub canopen: C,
    /// On CANopen over EtherCAT: the same.
    pub coe: E,
    /// On Modbus: a [`Register`], another route over registers, or [`Absent`].
    pub modbus: M,
    /// In a record of PROFINET: a [`Record`], or [`Absent`].
    pub profinet: P,
    /// On a serial protocol: a [`Parameter`], or [`Absent`].
    pub serial: S,
    /// In a fixed process image: an [`ImageField`](crate::ImageField), another route over such fields, or [`Absent`].
    pub image: I,
    /// In the memory of an EtherCAT slave controller: an [`EscMemory`](crate::EscMemory), or [`Absent`].
    pub esc: X,
}

impl<C, E, M, P, S, I, X> Location<C, E, M, P, S, I, X> {
    /// The route on each bus.
    #[must_use]
    pub const fn new(canopen: C, coe: E, modbus: M, profinet: P, serial: S, image: I, esc: X) -> Self {
        Self { canopen, coe, modbus, profinet, serial, image, esc }
    }
}

/// Says how an item is reached on bus `B`.
pub trait On<B: Bus> {
    /// The way there, as a [`ReadRoute`](crate::ReadRoute), a [`WriteRoute`](crate::WriteRoute) or both; [`Absent`] where there is
    /// none.
    type Route: Copy;

    /// The item's route on bus `B`.
    fn route(&self) -> Self::Route;
}

macro_rules! on {
    ($($bus:ident $field:ident $location:ident<$($parameter:ident),*> $(, $other:ident)*;)*) => {$(
        impl<R: Copy $(, $other)*> On<$bus> for $location<$($parameter),*> {
            type Route = R;

            #[inline]
            fn route(&self) -> R {
                self.$field
            }
        }
    )*};
}

on! {
    CanOpen canopen Location<R, E, M, P, S, I, X>, E, M, P, S, I, X;
    CoE coe Location<C, R, M, P, S, I, X>, C, M, P, S, I, X;
    Modbus modbus Location<C, E, R, P, S, I, X>, C, E, P, S, I, X;
    Profinet profinet Location<C, E, M, R, S, I, X>, C, E, M, S, I, X;
    Serial serial Location<C, E, M, P, R, I, X>, C, E, M, P, I, X;
    ProcessImage image Location<C, E, M, P, S, R, X>, C, E, M, P, S, X;
    Esc esc Location<C, E, M, P, S, I, R>, C, E, M, P, S, I;
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

/// The location of an item that exists in a fixed process image only.
pub type OnImage = Location<Absent, Absent, Absent, Absent, Absent, ImageField>;

/// The location of an item that exists in the memory of an EtherCAT slave controller only.
pub type OnEsc = Location<Absent, Absent, Absent, Absent, Absent, Absent, EscMemory>;

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
        Location::new(Absent, Absent, Absent, part, Absent, Absent, Absent)
    }
}

impl OnSerial {
    /// A parameter of a serial protocol.
    #[must_use]
    pub const fn serial(number: u32) -> Self {
        Location::new(Absent, Absent, Absent, Absent, Parameter(number), Absent, Absent)
    }
}

impl OnImage {
    /// A field of a fixed process image.
    #[must_use]
    pub const fn field(field: ImageField) -> Self {
        Location::new(Absent, Absent, Absent, Absent, Absent, field, Absent)
    }
}

impl OnEsc {
    /// Memory of a slave controller.
    #[must_use]
    pub const fn memory(address: u16, length: u16) -> Self {
        Location::new(Absent, Absent, Absent, Absent, Absent, Absent, EscMemory::new(address, length))
    }
}

const fn registers<C: Copy, E: Copy>(canopen: C, coe: E, modbus: Register) -> Location<C, E, Register> {
    Location::new(canopen, coe, modbus, Absent, Absent, Absent, Absent)
}

const fn objects<C: Copy, E: Copy>(canopen: C, coe: E) -> Location<C, E> {
    Location::new(canopen, coe, Absent, Absent, Absent, Absent, Absent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn object_is_found_on_each_of_its_buses() {
        let object = Object { index: 0x6040, sub_index: 1 };
        assert_eq!(On::<CanOpen>::route(&OnCanOpen::canopen(0x6040, 1)), object);
        assert_eq!(On::<CoE>::route(&OnCoE::coe(0x6040, 1)), object);
        assert_eq!(On::<CanOpen>::route(&OnCanOpenAndCoE::object(0x6040, 1)), object);
        assert_eq!(On::<CoE>::route(&OnCanOpenAndCoE::object(0x6040, 1)), object);
    }

    #[test]
    fn a_register_may_be_an_object_too() {
        let (object, register) = (Object { index: 0x2008, sub_index: 1 }, Register::low_first(8, 2));
        let everywhere = OnCanOpenCoEAndModbus::register(0x2008, 1, register);
        assert_eq!(On::<CanOpen>::route(&everywhere), object);
        assert_eq!(On::<CoE>::route(&everywhere), object);
        assert_eq!(On::<Modbus>::route(&everywhere), register);
        assert_eq!(On::<CanOpen>::route(&OnCanOpenAndModbus::register(0x2008, 1, register)), object);
        assert_eq!(On::<CoE>::route(&OnCoEAndModbus::register(0x2008, 1, register)), object);
        assert_eq!(On::<Modbus>::route(&OnModbus::modbus(register)), register);
        assert_eq!(On::<Serial>::route(&OnSerial::serial(70_000)), Parameter(70_000));
    }

    #[test]
    fn every_bus_has_its_own_address() {
        let field = ImageField::output(24, 32);
        let everywhere = Location {
            canopen: Object { index: 1, sub_index: 2 },
            coe: Object { index: 3, sub_index: 4 },
            modbus: Register::holding(5),
            profinet: Record::new(1, 1, 6, 7),
            serial: Parameter(8),
            image: field,
            esc: EscMemory::new(0x120, 2),
        };
        assert_eq!(On::<CanOpen>::route(&everywhere).index, 1);
        assert_eq!(On::<CoE>::route(&everywhere).index, 3);
        assert_eq!(On::<Modbus>::route(&everywhere).address, 5);
        assert_eq!(On::<Profinet>::route(&everywhere).offset, 7);
        assert_eq!(On::<Serial>::route(&everywhere), Parameter(8));
        assert_eq!(On::<ProcessImage>::route(&everywhere), field);
        assert_eq!(On::<ProcessImage>::route(&OnImage::field(field)), field);
        assert_eq!(On::<Esc>::route(&everywhere), On::<Esc>::route(&OnEsc::memory(0x120, 2)));
    }
}
