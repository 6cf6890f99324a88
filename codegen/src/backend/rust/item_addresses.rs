//! The addresses of an item, and the routes through which it is accessed.

mod buses;
mod field;
mod location;
mod paths;
mod register;
mod words;

pub(super) use buses::Buses;

use super::route::{Route, RouteBus};
use super::scope::{ObjectBus, Scope};
use crate::ir::{Binding, Item, RegisterBinding, Type};
use field::Field;

/// Index and sub-index of an object.
pub(super) type ObjectAddress = (u16, u8);

/// The addresses of an item on all buses that generated code supports, the routes to the item, and facts about its
/// value.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ItemAddresses<'i> {
    canopen: Option<(u16, u8)>,
    coe: Option<(u16, u8)>,
    modbus: Option<&'i RegisterBinding>,
    serial: Option<u32>,
    image: Option<Field<'i>>,
    esc: Option<(u16, u16)>,
    routes: [Route<'i>; 6],
    /// Number of bits of the value. 0 if the number is not known.
    bits: u32,
    /// True if the value is a sequence of bytes.
    is_bytes: bool,
    /// True if the value is a text with 16-bit characters. Each register contains the code of one character.
    is_wide: bool,
    /// True if the value is a signed integer.
    is_signed: bool,
}

/// Returns the code that creates an item's address on a bus. Returns `None` if the item has no address on the bus, or
/// if the bus does not allow the access. The access is a write if `writes` is set, and a read otherwise.
pub(super) fn address(scope: &Scope<'_>, item: &Item, bus: RouteBus, writes: bool) -> Option<String> {
    let addresses = ItemAddresses::without_routes(scope, item);
    addresses.is_possible(item, bus, writes).then(|| addresses.address(bus))?
}

impl<'i> ItemAddresses<'i> {
    /// Returns the addresses of an item, without routes.
    fn without_routes(scope: &Scope<'_>, item: &'i Item) -> Self {
        let base = scope.base(item.ty);
        let mut addresses = ItemAddresses::of_value(base);
        for binding in &item.bindings {
            addresses.add(scope, base, binding);
        }
        addresses
    }

    /// Creates an empty set of addresses for a value with this type.
    fn of_value(base: Type) -> Self {
        ItemAddresses {
            bits: base.bits().unwrap_or(0),
            is_bytes: base.is_bytes(),
            is_wide: matches!(base, Type::UnicodeString(_)),
            is_signed: matches!(base, Type::Integer(_)),
            ..ItemAddresses::default()
        }
    }

    /// Adds the address that a binding contains. If an item has several addresses on a bus, only the first address is
    /// used.
    fn add(&mut self, scope: &Scope<'_>, base: Type, binding: &'i Binding) {
        match binding {
            Binding::Object { buses, index, sub_index } => {
                let object = Some((*index, *sub_index));
                self.canopen = self.canopen.or(object.filter(|_| buses.canopen));
                self.coe = self.coe.or(object.filter(|_| buses.coe));
            }
            Binding::Register(register) => self.modbus = self.modbus.or(Some(register)),
            Binding::Parameter(parameter) => self.serial = self.serial.or(Some(parameter.code)),
            Binding::Image(_) => self.image = self.image.or_else(|| Field::of(scope, base, binding)),
            Binding::EscMemory { address, length } => self.esc = self.esc.or(Some((*address, *length))),
            _ => {}
        }
    }

    /// Returns whether the item has an address on a bus.
    fn has(&self, bus: RouteBus) -> bool {
        match bus {
            RouteBus::CanOpen => self.canopen.is_some(),
            RouteBus::CoE => self.coe.is_some(),
            RouteBus::Modbus => self.modbus.is_some(),
            RouteBus::Serial => self.serial.is_some(),
            RouteBus::Image => self.image.is_some(),
            RouteBus::Esc => self.esc.is_some(),
        }
    }

    pub fn buses(&self) -> Buses {
        Buses::of(&self.routes)
    }

    /// Returns the address of the item's object on `bus`. If the item has no object on this bus, returns the address on
    /// the other bus with an object dictionary.
    pub fn object_on(&self, bus: ObjectBus) -> Option<(u16, u8)> {
        match bus {
            ObjectBus::CanOpen => self.canopen.or(self.coe),
            ObjectBus::CoE => self.coe.or(self.canopen),
        }
    }

    /// Returns the address of the item's object: on CANopen, or otherwise on EtherCAT. If the address on EtherCAT
    /// differs from that on CANopen, returns both.
    pub fn objects(&self) -> [Option<(u16, u8)>; 2] {
        [self.canopen.or(self.coe), self.coe.filter(|coe| self.canopen.is_some_and(|canopen| canopen != *coe))]
    }

    /// Returns whether the item is an object on CANopen.
    pub fn is_on_canopen(&self) -> bool {
        self.canopen.is_some()
    }
}
