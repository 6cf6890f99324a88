//! Handle of a single value on a device.

use core::fmt;
use core::marker::PhantomData;
use core::ops::RangeInclusive;

use crate::flags::Flags;
use crate::initial::Initial;
use crate::location::{
    OnCanOpen, OnCanOpenAndCoE, OnCanOpenAndModbus, OnCanOpenCoEAndModbus, OnCoE, OnCoEAndModbus, OnModbus,
};
use crate::quantity::{Exponential, Quantity};
use crate::range::Range;
use crate::register::Register;
use crate::value::Value;
use crate::value_error::OutOfRange;

/// One value of a device, for example an entry of its object dictionary, a register or a parameter.
///
/// `V` is the type of the value. `A` is the access right: [`Ro`](crate::Ro), [`Wo`](crate::Wo), [`Rw`](crate::Rw) or
/// [`Const`](crate::Const). `L` is the [`Location`](crate::Location) of the item. The type of the location determines
/// the buses on which the item exists.
pub struct Item<V: Value, A, L> {
    location: L,
    name: &'static str,
    range: Range<V::Native>,
    initial: Initial<V::Native>,
    unit: &'static str,
    flags: Flags,
    types: PhantomData<fn() -> (V, A)>,
}

impl<V: Value, A, L> Item<V, A, L> {
    /// Creates an item. `name` is the name in the device description. `range` contains the values that can be written.
    /// `unit` is empty if the value has no unit.
    #[must_use]
    pub const fn new(
        location: L,
        name: &'static str,
        range: Range<V::Native>,
        initial: Initial<V::Native>,
        unit: &'static str,
        flags: Flags,
    ) -> Self {
        Self { location, name, range, initial, unit, flags, types: PhantomData }
    }

    /// Returns the location of the item, with its route on each bus.
    #[must_use]
    pub const fn location(&self) -> &L {
        &self.location
    }

    /// Returns the name in the device description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the range of raw values that can be written.
    #[must_use]
    pub const fn range(&self) -> &Range<V::Native> {
        &self.range
    }

    /// Returns the initial value after power-on.
    #[must_use]
    pub const fn initial(&self) -> &Initial<V::Native> {
        &self.initial
    }

    /// Returns the unit of the value; empty if there is none. For a [`Quantity`], this is the unit of the physical
    /// value.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        self.unit
    }

    /// Returns the additional properties of the item.
    #[must_use]
    pub const fn flags(&self) -> Flags {
        self.flags
    }

    /// Returns the item with another range and initial value, for a model of the device in which they differ.
    #[must_use]
    pub const fn of_model(self, range: Range<V::Native>, initial: Initial<V::Native>) -> Self
    where
        L: Copy,
    {
        Self { range, initial, ..self }
    }
}

impl<V: Quantity, A, L> Item<V, A, L> {
    fn checked(&self, raw: V::Native) -> Result<V::Native, OutOfRange> {
        if V::in_range(raw, &self.range) {
            Ok(raw)
        } else {
            Err(OutOfRange)
        }
    }
}

impl<V: Quantity<Other = ()>, A, L> Item<V, A, L> {
    /// Converts a raw value, for example from a PDO, to the physical value in the item's unit.
    #[must_use]
    pub fn physical(&self, raw: V::Native) -> V::Physical {
        V::physical(raw, ())
    }

    /// Converts a physical value in the item's unit to the nearest raw value.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the raw value is outside the item's range, doesn't fit the item's type, or has a
    /// special meaning.
    pub fn raw(&self, physical: f64) -> Result<V::Native, OutOfRange> {
        self.checked(V::raw(physical, ())?)
    }
}

impl<V: Quantity<Other = f64>, A, L> Item<V, A, L> {
    /// Converts a raw value to the physical value in the item's unit. `other` is the value that determines the scale.
    #[must_use]
    pub fn physical_by(&self, raw: V::Native, other: f64) -> V::Physical {
        V::physical(raw, other)
    }

    /// Converts a physical value in the item's unit to the nearest raw value. `other` is the value that determines the
    /// scale.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the raw value is outside the item's range, doesn't fit the item's type, or has a
    /// special meaning.
    pub fn raw_by(&self, physical: f64, other: f64) -> Result<V::Native, OutOfRange> {
        self.checked(V::raw(physical, other)?)
    }
}

impl<B, const BASE: u32, const BITS: u32, A, L> Item<Exponential<B, BASE, BITS>, A, L>
where
    Exponential<B, BASE, BITS>: Quantity<Native = B::Native, Other = f64>,
    B: Value,
{
    /// Converts a physical value to a mantissa and an exponent. Tries `exponents` in order, and returns the first
    /// exponent whose mantissa is in the item's range, with this mantissa. The lowest exponent gives the highest
    /// resolution. Write the mantissa to this item, and the exponent to the item that contains the exponent.
    ///
    /// ```
    /// use lexibus::{Exponential, Flags, Initial, Item, OnSerial, OutOfRange, Range, Rw};
    ///
    /// const GAIN: Item<Exponential<u16, 2, 15>, Rw, OnSerial> =
    ///     Item::new(OnSerial::serial(0x1000), "Gain", Range::To(32_767), Initial::Unknown, "", Flags::NONE);
    ///
    /// assert_eq!(GAIN.mantissa_and_exponent(1.5, 0..=6), Ok((24_576, 1)));
    /// assert_eq!(GAIN.mantissa_and_exponent(70.0, 0..=6), Err(OutOfRange));
    /// ```
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the mantissa is out of range for every element of `exponents`.
    pub fn mantissa_and_exponent(
        &self,
        physical: f64,
        exponents: RangeInclusive<i8>,
    ) -> Result<(B::Native, i8), OutOfRange> {
        exponents
            .filter_map(|exponent| Some((self.raw_by(physical, exponent.into()).ok()?, exponent)))
            .next()
            .ok_or(OutOfRange)
    }
}

macro_rules! objects {
    ($location:ty, $on:ident: $object:ident, $with_default:ident, $flagged:ident, $flagged_with_default:ident) => {
        impl<V: Value, A> Item<V, A, $location> {
            /// Creates an entry of the object dictionary with the full range, without initial value, unit and flags.
            #[must_use]
            pub const fn $object(index: u16, sub_index: u8, name: &'static str) -> Self {
                Self::new(<$location>::$on(index, sub_index), name, Range::Full, Initial::Unknown, "", Flags::NONE)
            }

            /// Creates an entry of the object dictionary with the initial value `default`.
            #[must_use]
            pub const fn $with_default(index: u16, sub_index: u8, name: &'static str, default: V::Native) -> Self {
                Self::new(
                    <$location>::$on(index, sub_index),
                    name,
                    Range::Full,
                    Initial::Value(default),
                    "",
                    Flags::NONE,
                )
            }

            /// Creates an entry of the object dictionary with `flags`, for example for PDO mapping.
            #[must_use]
            pub const fn $flagged(index: u16, sub_index: u8, name: &'static str, flags: Flags) -> Self {
                Self::new(<$location>::$on(index, sub_index), name, Range::Full, Initial::Unknown, "", flags)
            }

            /// Creates an entry of the object dictionary with `flags` and the initial value `default`.
            #[must_use]
            pub const fn $flagged_with_default(
                index: u16,
                sub_index: u8,
                name: &'static str,
                flags: Flags,
                default: V::Native,
            ) -> Self {
                Self::new(<$location>::$on(index, sub_index), name, Range::Full, Initial::Value(default), "", flags)
            }
        }
    };
}

objects!(OnCanOpen, canopen: object, object_with_default, flagged_object, flagged_object_with_default);
objects!(OnCoE, coe: coe_object, coe_object_with_default, flagged_coe_object, flagged_coe_object_with_default);
objects!(
    OnCanOpenAndCoE,
    object: shared_object,
    shared_object_with_default,
    flagged_shared_object,
    flagged_shared_object_with_default
);

macro_rules! registers {
    ($location:ty, $on:ident, ($($argument:ident: $ty:ty),*)) => {
        impl<V: Value, A> Item<V, A, $location> {
            /// Creates an item in a register, without range and unit.
            #[must_use]
            pub const fn register($($argument: $ty,)* register: Register, name: &'static str, flags: Flags) -> Self {
                let location = <$location>::$on($($argument,)* register);
                Self::new(location, name, Range::Full, Initial::Unknown, "", flags)
            }

            /// Creates an item in a register, with range and unit.
            #[must_use]
            pub const fn register_within(
                $($argument: $ty,)*
                register: Register,
                name: &'static str,
                range: Range<V::Native>,
                unit: &'static str,
                flags: Flags,
            ) -> Self {
                let location = <$location>::$on($($argument,)* register);
                Self::new(location, name, range, Initial::Unknown, unit, flags)
            }
        }
    };
}

registers!(OnModbus, modbus, ());
registers!(OnCanOpenAndModbus, register, (index: u16, sub_index: u8));
registers!(OnCoEAndModbus, register, (index: u16, sub_index: u8));
registers!(OnCanOpenCoEAndModbus, register, (index: u16, sub_index: u8));

impl<V: Value, A> Item<V, A, OnCoE> {
    /// Returns the same entry with `offset` added to the index. Use this method for a module in another slot.
    #[must_use]
    pub const fn shifted(self, offset: u16) -> Self {
        let object = self.location.coe;
        let location = OnCoE::coe(object.index.wrapping_add(offset), object.sub_index);
        Self { location, ..self }
    }
}

// Implemented by hand because derived implementations would require `V: Copy` and `A: Copy`.
impl<V: Value, A, L: Copy> Copy for Item<V, A, L> {}

impl<V: Value, A, L: Copy> Clone for Item<V, A, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V: Value, A, L: fmt::Debug> fmt::Debug for Item<V, A, L>
where
    V::Native: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Item")
            .field("location", &self.location)
            .field("name", &self.name)
            .field("data_type", &V::DATA_TYPE)
            .field("range", &self.range)
            .field("initial", &self.initial)
            .field("unit", &self.unit)
            .field("flags", &self.flags)
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rw, VisibleString};
    use std::format;

    const SPEED: Item<u32, Rw, OnCanOpen> = Item::new(
        OnCanOpen::canopen(0x6081, 0),
        "Profile velocity",
        Range::To(3000),
        Initial::Value(100),
        "0.01 rev/s",
        Flags::RPDO,
    );
    const NAME: Item<VisibleString, Rw, OnCanOpen> =
        Item::new(OnCanOpen::canopen(0x1008, 0), "Name", Range::Full, Initial::Value("Drive"), "", Flags::NONE);
    const _: () = assert!(SPEED.flags().contains(Flags::RPDO));

    #[test]
    fn getters() {
        assert_eq!(SPEED.location().canopen.index, 0x6081);
        assert_eq!((SPEED.name(), SPEED.unit()), ("Profile velocity", "0.01 rev/s"));
        assert_eq!(*SPEED.range(), Range::To(3000));
        assert_eq!(*NAME.initial(), Initial::Value("Drive"));
    }

    #[test]
    fn entries_of_other_slots() {
        const INPUT: Item<u8, Rw, OnCoE> = Item::coe_object(0x6000, 1, "Input");
        const OTHER: Item<u8, Rw, OnCoE> = INPUT.shifted(0x30);
        assert_eq!((OTHER.location().coe.index, OTHER.location().coe.sub_index, OTHER.name()), (0x6030, 1, "Input"));
    }

    #[test]
    fn registers() {
        type Everywhere = Item<i32, Rw, OnCanOpenCoEAndModbus>;
        type OnRegisters = Item<u16, Rw, OnModbus>;
        const SPEED: Everywhere = Everywhere::register_within(
            0x203F,
            1,
            Register::low_first(63, 2),
            "Speed",
            Range::From(0),
            "rev/s",
            Flags::RPDO,
        );
        assert_eq!((SPEED.location().coe.index, SPEED.location().modbus.count), (0x203F, 2));
        assert_eq!((*SPEED.range(), *SPEED.initial(), SPEED.unit()), (Range::From(0), Initial::Unknown, "rev/s"));
        const STATUS: OnRegisters = OnRegisters::register(Register::holding(5), "Status", Flags::NONE);
        assert_eq!((STATUS.location().modbus.address, *STATUS.range()), (5, Range::Full));
    }

    #[test]
    fn copies_and_prints_whatever_its_access() {
        struct Unprintable;
        let item: Item<u8, Unprintable, OnCanOpen> =
            Item::new(OnCanOpen::canopen(0x1001, 0), "Error register", Range::Full, Initial::Unknown, "", Flags::NONE);
        let copy = item;
        assert_eq!(format!("{item:?}"), format!("{copy:?}"));
    }
}
