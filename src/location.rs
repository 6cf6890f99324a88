//! Locations: the routes to an item on all of its buses.

use crate::bus::{
    Bus, CanOpen, CoE, Esc, EscMemory, Modbus, Object, Parameter, ProcessImage, Profinet, Record, Serial,
};
use crate::image_field::ImageField;
use crate::register::Register;
use crate::route::Route;

/// Location of an item: one route for each bus on which the item exists. [`location!`](crate::location!) declares
/// location types.
///
/// This crate declares the location types of common combinations of buses, for example [`OnCanOpenAndCoE`]. Generated
/// code declares all other location types.
pub trait Location: Copy {
    /// Calls `visit` with the route of each bus.
    fn for_each_route(&self, visit: &mut dyn FnMut(&dyn Route));
}

/// Route to an item on bus `B`. A location implements this trait for each bus on which its items exist.
#[diagnostic::on_unimplemented(
    message = "this item doesn't exist on `{B}`",
    label = "the client's bus is `{B}`, on which the device doesn't have this item",
    note = "`{Self}` lists the buses on which the item exists"
)]
pub trait On<B: Bus> {
    /// Type of the route: a [`ReadRoute`](crate::ReadRoute), a [`WriteRoute`](crate::WriteRoute) or both.
    type Route: Copy;

    /// Returns the route to the item on bus `B`.
    fn route(&self) -> Self::Route;
}

/// Declares a location type: a struct with one field for each bus on which its items exist. Each field declares the bus
/// and the type of the route. The route is usually an address on the bus.
///
/// ```
/// use lexibus::{CanOpen, Modbus, Object, On, Register, Resized};
///
/// lexibus::location! {
///     /// Object with another width than the register.
///     pub struct OnCanOpenResizedAndModbus {
///         canopen: CanOpen => Resized<Object>,
///         modbus: Modbus => Register,
///     }
/// }
///
/// const TARGET_POSITION: OnCanOpenResizedAndModbus = OnCanOpenResizedAndModbus {
///     canopen: Resized::signed(Object::new(0x607A, 0), 32),
///     modbus: Register::high_first(0x8009, 4),
/// };
/// assert_eq!(On::<Modbus>::route(&TARGET_POSITION).address, 0x8009);
/// ```
///
/// An access through a client for any other bus causes a compile-time error:
///
/// ```compile_fail,E0277
/// # use lexibus::{Client, Flags, Initial, Item, Modbus, OnCanOpen, Range, Ro};
/// # const STATUSWORD: Item<u16, Ro, OnCanOpen> = Item::object(0x6041, 0, "Statusword");
/// fn read(mut client: impl Client<Bus = Modbus>) {
///     let _ = STATUSWORD.at(&mut client).read(); // an item that exists on CANopen only
/// }
/// ```
#[macro_export]
macro_rules! location {
    (
        $(#[$attribute:meta])*
        $visibility:vis struct $name:ident { $($field:ident: $bus:ty => $route:ty),* $(,)? }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $visibility struct $name {
            $(
                #[doc = concat!("Route on [`", stringify!($bus), "`].")]
                pub $field: $route,
            )*
        }

        impl $name {
            /// Creates a location from one route per bus, in the order of the fields.
            #[must_use]
            #[allow(dead_code)]
            pub const fn new($($field: $route),*) -> Self {
                Self { $($field),* }
            }
        }

        impl $crate::Location for $name {
            fn for_each_route(&self, visit: &mut dyn FnMut(&dyn $crate::Route)) {
                let _ = &visit;
                $(visit(&self.$field);)*
            }
        }

        $(
            impl $crate::On<$bus> for $name {
                type Route = $route;

                #[inline]
                fn route(&self) -> $route {
                    self.$field
                }
            }
        )*
    };
}

location! {
    /// Location of an item that exists only on CANopen.
    pub struct OnCanOpen { canopen: CanOpen => Object }
}
location! {
    /// Location of an item that exists only on CANopen over EtherCAT.
    pub struct OnCoE { coe: CoE => Object }
}
location! {
    /// Location of an item that is an object on CANopen and on CANopen over EtherCAT.
    pub struct OnCanOpenAndCoE { canopen: CanOpen => Object, coe: CoE => Object }
}
location! {
    /// Location of an item that exists only on Modbus.
    pub struct OnModbus { modbus: Modbus => Register }
}
location! {
    /// Location of an item that is an object on CANopen and a register on Modbus.
    pub struct OnCanOpenAndModbus { canopen: CanOpen => Object, modbus: Modbus => Register }
}
location! {
    /// Location of an item that is an object on CANopen over EtherCAT and a register on Modbus.
    pub struct OnCoEAndModbus { coe: CoE => Object, modbus: Modbus => Register }
}
location! {
    /// Location of an item that is an object on CANopen and on CANopen over EtherCAT, and a register on Modbus.
    pub struct OnCanOpenCoEAndModbus { canopen: CanOpen => Object, coe: CoE => Object, modbus: Modbus => Register }
}
location! {
    /// Location of an item that exists only on PROFINET, in a record.
    pub struct OnProfinet { profinet: Profinet => Record }
}
location! {
    /// Location of an item that exists only as a parameter of a serial protocol.
    pub struct OnSerial { serial: Serial => Parameter }
}
location! {
    /// Location of an item that exists only in a fixed process image.
    pub struct OnImage { image: ProcessImage => ImageField }
}
location! {
    /// Location of an item that exists only in the memory of an EtherCAT slave controller.
    pub struct OnEsc { esc: Esc => EscMemory }
}

impl OnCanOpen {
    /// Creates the location of a CANopen object.
    #[must_use]
    pub const fn canopen(index: u16, sub_index: u8) -> Self {
        Self { canopen: Object { index, sub_index } }
    }
}

impl OnCoE {
    /// Creates the location of an object of an EtherCAT device.
    #[must_use]
    pub const fn coe(index: u16, sub_index: u8) -> Self {
        Self { coe: Object { index, sub_index } }
    }
}

impl OnCanOpenAndCoE {
    /// Creates the location of an object with the same address on CANopen and EtherCAT.
    #[must_use]
    pub const fn object(index: u16, sub_index: u8) -> Self {
        let object = Object { index, sub_index };
        Self { canopen: object, coe: object }
    }
}

impl OnModbus {
    /// Creates the location of a Modbus register.
    #[must_use]
    pub const fn modbus(register: Register) -> Self {
        Self { modbus: register }
    }
}

impl OnCanOpenAndModbus {
    /// Creates the location of a CANopen object that is also a Modbus register.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        Self { canopen: Object { index, sub_index }, modbus: register }
    }
}

impl OnCoEAndModbus {
    /// Creates the location of an object of an EtherCAT device that is also a Modbus register.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        Self { coe: Object { index, sub_index }, modbus: register }
    }
}

impl OnCanOpenCoEAndModbus {
    /// Creates the location of an object that is also a Modbus register. The object has the same address on CANopen and
    /// EtherCAT.
    #[must_use]
    pub const fn register(index: u16, sub_index: u8, register: Register) -> Self {
        let object = Object { index, sub_index };
        Self { canopen: object, coe: object, modbus: register }
    }
}

impl OnProfinet {
    /// Creates the location of a value in a PROFINET record.
    #[must_use]
    pub const fn record(part: Record) -> Self {
        Self { profinet: part }
    }
}

impl OnSerial {
    /// Creates the location of a parameter of a serial protocol.
    #[must_use]
    pub const fn serial(number: u32) -> Self {
        Self { serial: Parameter(number) }
    }
}

impl OnImage {
    /// Creates the location of a field in a fixed process image.
    #[must_use]
    pub const fn field(field: ImageField) -> Self {
        Self { image: field }
    }
}

impl OnEsc {
    /// Creates the location of `length` bytes in the memory of a slave controller.
    #[must_use]
    pub const fn memory(address: u16, length: u16) -> Self {
        Self { esc: EscMemory::new(address, length) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

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

    location! {
        struct Everywhere {
            canopen: CanOpen => Object,
            coe: CoE => Object,
            modbus: Modbus => Register,
            profinet: Profinet => Record,
            serial: Serial => Parameter,
            image: ProcessImage => ImageField,
            esc: Esc => EscMemory,
        }
    }
    location! { struct Nowhere {} }

    #[test]
    fn every_bus_has_its_own_address() {
        let field = ImageField::output(24, 32);
        let everywhere = Everywhere {
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
    #[test]
    fn each_route_is_visited() {
        fn addresses(location: &impl Location) -> Vec<(Option<Object>, Option<Register>)> {
            let mut addresses = Vec::new();
            location.for_each_route(&mut |route| addresses.push((route.object(), route.register())));
            addresses
        }
        let (object, register) = (Object::new(0x2008, 1), Register::holding(8));
        let location = OnCanOpenAndModbus::register(0x2008, 1, register);
        assert_eq!(addresses(&location), [(Some(object), None), (None, Some(register))]);
        assert_eq!(addresses(&OnSerial::serial(1)), [(None, None)]);
        assert_eq!(addresses(&Nowhere::new()), []);
    }
}
