//! Addresses of items of a simulated device.

use crate::bus::Object;
use crate::item::Item;
use crate::location::Location;
use crate::register::Register;
use crate::route::Route;
use crate::value::Value;

/// Address of an item: a handle of the bindings, an object or a register. Programs do not have to implement this trait.
pub trait ItemAddress {
    /// Returns the object of the item, if it has one.
    fn object(&self) -> Option<Object>;

    /// Returns the Modbus register of the item, if it has one.
    fn register(&self) -> Option<Register>;

    /// Returns whether the widths of the item differ between its buses. If the widths differ, the table has several
    /// entries for the item.
    fn is_resized(&self) -> bool {
        false
    }
}

/// Returns the first address that `select` returns for a route of the location.
fn find<T>(location: &impl Location, select: impl Fn(&dyn Route) -> Option<T>) -> Option<T> {
    let mut found = None;
    location.for_each_route(&mut |route| found = found.take().or_else(|| select(route)));
    found
}

impl<V: Value, A, L: Location> ItemAddress for Item<V, A, L> {
    fn object(&self) -> Option<Object> {
        find(self.location(), |route| route.object())
    }

    fn register(&self) -> Option<Register> {
        find(self.location(), |route| route.register())
    }

    fn is_resized(&self) -> bool {
        let is_simulated = |route: &dyn Route| route.object().is_some() || route.register().is_some();
        find(self.location(), |route| (is_simulated(route) && route.is_resized()).then_some(())).is_some()
    }
}

impl ItemAddress for Object {
    fn object(&self) -> Option<Object> {
        Some(*self)
    }

    fn register(&self) -> Option<Register> {
        None
    }
}

impl ItemAddress for Register {
    fn object(&self) -> Option<Object> {
        None
    }

    fn register(&self) -> Option<Register> {
        Some(*self)
    }
}
