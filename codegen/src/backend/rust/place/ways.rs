//! The ways to an item: to its own address on a bus, and through a window.

use super::Place;
use crate::backend::rust::located::Located;
use crate::backend::rust::route::{Net, Route, Way};
use crate::backend::rust::window;
use crate::ir::{Binding, Item, Type};

impl<'i> Place<'i> {
    /// The addresses of an item, and the routes to it.
    pub fn of(located: &Located<'_>, item: &'i Item) -> Self {
        let mut place = Place::addresses(located, item);
        place.routes = place.routes(located, item);
        place
    }

    /// The routes to an item on all buses.
    pub(super) fn routes(&self, located: &Located<'_>, item: &'i Item) -> [Route<'i>; 6] {
        if !is_plain(item) {
            return Net::ALL.map(|net| self.route(located, item, net));
        }
        Net::ALL.map(|net| if self.has(net) { plain(item) } else { Route::default() })
    }

    /// Whether a bus lets the item be read, or written, at its address.
    pub(super) fn is_possible(&self, item: &Item, net: Net, writes: bool) -> bool {
        let access = if net == Net::Esc { item.access } else { item.access_on(net.of_items()) };
        let allows = if writes { access.writable() } else { access.readable() };
        let goes = match (net, self.image) {
            (Net::Image, Some(field)) => field.is_output == writes,
            _ => true,
        };
        self.has(net) && allows && goes
    }

    fn route(&self, located: &Located<'_>, item: &'i Item, net: Net) -> Route<'i> {
        let way = |writes: bool| {
            let is_allowed = if writes { item.access.writable() } else { item.access.readable() };
            let direct = || self.is_possible(item, net, writes).then(|| self.own_way(located, item, net))?;
            is_allowed.then(|| direct().or_else(|| through(located, item, net, writes)))?
        };
        let (read, write) = (way(false), way(true));
        let is_partial = item.access.readable() && item.access.writable();
        Route { read, write, is_partial }
    }

    /// The way to the item's own address; none where its type can't have the width that it has there.
    fn own_way(&self, located: &Located<'_>, item: &'i Item, net: Net) -> Option<Way<'i>> {
        let (own, there) = (located.base(item.ty), located.base(item.type_on(net.of_items())));
        let there = match (net, self.image, self.esc) {
            (Net::Image, Some(field), _) => field.ty.map_or(own, |ty| located.base(ty)),
            (Net::Esc, _, Some((_, length))) => in_memory(own, length),
            _ => there,
        };
        let limited =
            item.limits_on(net.of_items()).filter(|_| is_integer(own)).map(|own_limits| (own_limits, own.is_signed()));
        let resized = own.bits() != there.bits() && own.bits().is_some();
        let is_signed = if resized { narrower(own, there).is_signed() } else { own.is_signed() };
        let bits = there.bits().filter(|bits| (1..=64).contains(bits)).and_then(|bits| u8::try_from(bits).ok());
        if resized && !(is_integer(own) && is_integer(there)) {
            return None;
        }
        Some(Way { window: None, resized: bits.filter(|_| resized), limited, is_signed })
    }
}

/// The route to an item that is the same everywhere.
fn plain<'i>(item: &Item) -> Route<'i> {
    let way = Some(Way { window: None, resized: None, limited: None, is_signed: false });
    let (read, write) = (way.filter(|_| item.access.readable()), way.filter(|_| item.access.writable()));
    Route { read, write, is_partial: false }
}

/// The way through a window of the item's space on a bus.
fn through<'i>(located: &Located<'_>, item: &Item, net: Net, writes: bool) -> Option<Way<'i>> {
    item.bindings.iter().filter_map(window::indirect).find_map(|binding| {
        let at = window::position(&located.windows, binding, net, writes)?;
        let own = located.windows.get(at).filter(|own| window::carries(located, item, own))?;
        let (bits, is_signed) = own.value;
        let base = located.base(item.ty);
        let is_signed = if base.bits().unwrap_or(0) <= bits { base.is_signed() } else { is_signed };
        Some(Way { window: Some((at, binding.number)), resized: None, limited: None, is_signed })
    })
}

/// Whether an item is the same on every bus on which it has an address, and nowhere else.
fn is_plain(item: &Item) -> bool {
    let is_address =
        |binding: &Binding| !matches!(binding, Binding::Indirect(_) | Binding::Image(_) | Binding::EscMemory { .. });
    item.variants.is_empty() && item.bindings.iter().all(is_address)
}

/// A number in so many bytes of a slave controller.
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
