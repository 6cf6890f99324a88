//! Access paths to an item: directly to its address on a bus, or through a window.

use super::ItemAddresses;
use crate::backend::rust::located::Located;
use crate::backend::rust::route::{AccessPath, Route, RouteBus};
use crate::backend::rust::window;
use crate::ir::{Binding, Item, Type};

impl<'i> ItemAddresses<'i> {
    /// Returns the addresses of an item and its routes.
    pub fn of(located: &Located<'_>, item: &'i Item) -> Self {
        let mut addresses = ItemAddresses::without_routes(located, item);
        addresses.routes = addresses.routes(located, item);
        addresses
    }

    /// Returns the routes to an item on all buses.
    pub(super) fn routes(&self, located: &Located<'_>, item: &'i Item) -> [Route<'i>; 6] {
        if !is_plain(item) {
            return RouteBus::ALL.map(|bus| self.route(located, item, bus));
        }
        RouteBus::ALL.map(|bus| if self.has(bus) { plain(item) } else { Route::default() })
    }

    /// Returns whether a bus allows reading the item at its address, or writing it if `writes` is set.
    pub(super) fn is_possible(&self, item: &Item, bus: RouteBus, writes: bool) -> bool {
        let access = if bus == RouteBus::Esc { item.access } else { item.access_on(bus.of_items()) };
        let allows = if writes { access.writable() } else { access.readable() };
        let has_direction = match (bus, self.image) {
            (RouteBus::Image, Some(field)) => field.is_output == writes,
            _ => true,
        };
        self.has(bus) && allows && has_direction
    }

    fn route(&self, located: &Located<'_>, item: &'i Item, bus: RouteBus) -> Route<'i> {
        let access_path = |writes: bool| {
            let is_allowed = if writes { item.access.writable() } else { item.access.readable() };
            let direct = || self.is_possible(item, bus, writes).then(|| self.direct_path(located, item, bus))?;
            is_allowed.then(|| direct().or_else(|| through(located, item, bus, writes)))?
        };
        let (read, write) = (access_path(false), access_path(true));
        let is_partial = item.access.readable() && item.access.writable();
        Route { read, write, is_partial }
    }

    /// Returns the path to the item's address. Returns `None` if the type on the bus cannot be converted to the item's
    /// type.
    fn direct_path(&self, located: &Located<'_>, item: &'i Item, bus: RouteBus) -> Option<AccessPath<'i>> {
        let (ty, bus_type) = (located.base(item.ty), located.base(item.type_on(bus.of_items())));
        let bus_type = match (bus, self.image, self.esc) {
            (RouteBus::Image, Some(field), _) => field.ty.map_or(ty, |field_type| located.base(field_type)),
            (RouteBus::Esc, _, Some((_, length))) => in_memory(ty, length),
            _ => bus_type,
        };
        let limited = item.limits_on(bus.of_items()).filter(|_| is_integer(ty)).map(|limits| (limits, ty.is_signed()));
        let resized = ty.bits() != bus_type.bits() && ty.bits().is_some();
        let is_signed = if resized { narrower(ty, bus_type).is_signed() } else { ty.is_signed() };
        let bits = bus_type.bits().filter(|bits| (1..=64).contains(bits)).and_then(|bits| u8::try_from(bits).ok());
        if resized && !(is_integer(ty) && is_integer(bus_type)) {
            return None;
        }
        Some(AccessPath { window: None, resized: bits.filter(|_| resized), limited, is_signed })
    }
}

/// Returns the route to an item whose type and access rights are the same on all buses.
fn plain<'i>(item: &Item) -> Route<'i> {
    let access_path = Some(AccessPath { window: None, resized: None, limited: None, is_signed: false });
    let (read, write) =
        (access_path.filter(|_| item.access.readable()), access_path.filter(|_| item.access.writable()));
    Route { read, write, is_partial: false }
}

/// Returns the path through a window of the item's parameter space. Returns `None` if no window on the bus can transfer
/// the item.
fn through<'i>(located: &Located<'_>, item: &Item, bus: RouteBus, writes: bool) -> Option<AccessPath<'i>> {
    item.bindings.iter().filter_map(window::indirect).find_map(|binding| {
        let at = window::position(&located.windows, binding, bus, writes)?;
        let window = located.windows.get(at).filter(|window| window::carries(located, item, window))?;
        let (bits, is_signed) = window.value;
        let base = located.base(item.ty);
        let is_signed = if base.bits().unwrap_or(0) <= bits { base.is_signed() } else { is_signed };
        Some(AccessPath { window: Some((at, binding.number)), resized: None, limited: None, is_signed })
    })
}

/// Returns whether an item has no variants, no indirect address, and no address in a process image or in the memory of
/// a slave controller.
fn is_plain(item: &Item) -> bool {
    let is_address =
        |binding: &Binding| !matches!(binding, Binding::Indirect(_) | Binding::Image(_) | Binding::EscMemory { .. });
    item.variants.is_empty() && item.bindings.iter().all(is_address)
}

/// Returns the type of a value in the memory of a slave controller. This is an unsigned integer of `length` bytes if
/// `ty` has a different number of bytes and `length` is at most 8. Otherwise, it is `ty`.
fn in_memory(ty: Type, length: u16) -> Type {
    match (ty.bits(), u8::try_from(length)) {
        (Some(bits), Ok(length @ 1..=8)) if bits.div_ceil(8) != u32::from(length) => Type::Unsigned(8 * length),
        _ => ty,
    }
}

fn is_integer(ty: Type) -> bool {
    matches!(ty, Type::Boolean | Type::Integer(1..=64) | Type::Unsigned(1..=64))
}

fn narrower(one: Type, other: Type) -> Type {
    if one.bits() <= other.bits() {
        one
    } else {
        other
    }
}
