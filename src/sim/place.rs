//! What names an item of a simulated device.

use crate::bus::Object;
use crate::item::Item;
use crate::location::{Absent, Location};
use crate::register::Register;
use crate::route::{Closed, Limited, Resized, Split, Through};
use crate::value::Value;

/// What names an item: a handle of the bindings, an object, or a register. Bindings need nothing else implemented.
pub trait Place {
    /// Its place in the object dictionary.
    fn object(&self) -> Option<Object>;

    /// Its place on Modbus.
    fn register(&self) -> Option<Register>;

    /// Whether it has another width on some bus: then the table has it more than once.
    fn is_resized(&self) -> bool {
        false
    }
}

/// An address on one bus, or none.
pub trait Part<T> {
    /// The address.
    fn part(&self) -> Option<T>;

    /// Whether the value has another width there.
    fn is_resized(&self) -> bool {
        false
    }
}

impl<T> Part<T> for Absent {
    fn part(&self) -> Option<T> {
        None
    }
}

impl Part<Object> for Object {
    fn part(&self) -> Option<Object> {
        Some(*self)
    }
}

impl Part<Register> for Register {
    fn part(&self) -> Option<Register> {
        Some(*self)
    }
}

impl<T, R: Part<T>> Part<T> for Resized<R> {
    fn part(&self) -> Option<T> {
        self.at.part()
    }

    fn is_resized(&self) -> bool {
        true
    }
}

impl<T, R: Part<T>> Part<T> for Limited<R> {
    fn part(&self) -> Option<T> {
        self.at.part()
    }

    fn is_resized(&self) -> bool {
        self.at.is_resized()
    }
}

impl<T, R: Part<T>, W: Part<T>> Part<T> for Split<R, W> {
    fn part(&self) -> Option<T> {
        self.read.part().or_else(|| self.write.part())
    }

    fn is_resized(&self) -> bool {
        self.read.is_resized() || self.write.is_resized()
    }
}

impl<T> Part<T> for Closed {
    fn part(&self) -> Option<T> {
        None
    }
}

/// A window is no place of the item's own.
impl<T, W> Part<T> for Through<W> {
    fn part(&self) -> Option<T> {
        None
    }
}

impl<C: Part<Object>, E: Part<Object>, M: Part<Register>, P, S, I, X> Place for Location<C, E, M, P, S, I, X> {
    fn object(&self) -> Option<Object> {
        self.canopen.part().or_else(|| self.coe.part())
    }

    fn register(&self) -> Option<Register> {
        self.modbus.part()
    }

    fn is_resized(&self) -> bool {
        self.canopen.is_resized() || self.coe.is_resized() || self.modbus.is_resized()
    }
}

impl<V: Value, A, L: Place> Place for Item<V, A, L> {
    fn object(&self) -> Option<Object> {
        self.location().object()
    }

    fn register(&self) -> Option<Register> {
        self.location().register()
    }

    fn is_resized(&self) -> bool {
        self.location().is_resized()
    }
}

impl Place for Object {
    fn object(&self) -> Option<Object> {
        Some(*self)
    }

    fn register(&self) -> Option<Register> {
        None
    }
}

impl Place for Register {
    fn object(&self) -> Option<Object> {
        None
    }

    fn register(&self) -> Option<Register> {
        Some(*self)
    }
}
