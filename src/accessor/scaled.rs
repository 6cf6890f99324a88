//! Methods that read and write physical values.

use super::Accessor;
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::bus::Bus;
use crate::client::{AsyncClient, Client};
#[cfg(doc)]
use crate::error::Error;
use crate::location::On;
use crate::quantity::Quantity;
use crate::raw_value::limits;
use crate::route::{ReadRoute, WriteRoute};
use crate::value_error::OutOfRange;

impl<C, V: Quantity, A, L> Accessor<'_, C, V, A, L> {
    /// Converts a physical value to the nearest raw value. Doesn't check the range.
    #[inline]
    fn raw<B: Bus, E>(&self, physical: f64, other: V::Other) -> Result<V::Native, AccessError<E>>
    where
        L: On<B, Route: WriteRoute<B>>,
    {
        V::raw(physical, other).map_err(|OutOfRange| {
            let accessed = self.accessed(self.item.location().route().write_address());
            AccessError::unscalable(accessed, physical, limits::<V>(self.item.range()))
        })
    }
}

/// Defines the methods for physical values, blocking and async.
macro_rules! scaled {
    (
        $Client:ident $read:ident $write:ident: $read_scaled:ident $write_scaled:ident $read_scaled_by:ident
        $write_scaled_by:ident $($async:ident $await:ident)?
    ) => {
        impl<C, V: Quantity<Other = ()>, A: Readable, L> Accessor<'_, C, V, A, L> {
            /// Reads the physical value in the item's unit. Returns an `f64`, or an `Option<f64>` if raw values of the
            /// item have a special meaning. `None` means that the device sent such a raw value.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`read`](Accessor::read).
            pub $($async)? fn $read_scaled(&mut self) -> Result<V::Physical, AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                self.$read()$(.$await)?.map(|raw| V::physical(raw, ()))
            }
        }

        impl<C, V: Quantity<Other = ()>, A: Writable, L> Accessor<'_, C, V, A, L> {
            /// Writes the raw value that is nearest to `physical`. `physical` is a value in the item's unit.
            ///
            /// # Errors
            ///
            /// Returns [`Error::OutOfRange`] if the raw value is outside the item's range, doesn't fit its type, or has
            /// a special meaning. An invalid value isn't sent.
            pub $($async)? fn $write_scaled(&mut self, physical: f64) -> Result<(), AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                let raw = self.raw::<C::Bus, _>(physical, ())?;
                self.$write(raw)$(.$await)?
            }
        }

        /// Methods for values whose scale depends on another value. The item's documentation names the other value, and
        /// the caller passes it.
        impl<C, V: Quantity<Other = f64>, A: Readable, L> Accessor<'_, C, V, A, L> {
            /// Reads the physical value in the item's unit. `other` is the value that determines the scale.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`read`](Accessor::read).
            pub $($async)? fn $read_scaled_by(&mut self, other: f64) -> Result<V::Physical, AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                self.$read()$(.$await)?.map(|raw| V::physical(raw, other))
            }
        }

        impl<C, V: Quantity<Other = f64>, A: Writable, L> Accessor<'_, C, V, A, L> {
            /// Writes the raw value that is nearest to `physical`. `other` is the value that determines the scale.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`write_scaled`](Accessor::write_scaled).
            pub $($async)? fn $write_scaled_by(&mut self, physical: f64, other: f64) -> Result<(), AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                let raw = self.raw::<C::Bus, _>(physical, other)?;
                self.$write(raw)$(.$await)?
            }
        }
    };
}

scaled! { Client read write: read_scaled write_scaled read_scaled_by write_scaled_by }
scaled! {
    AsyncClient read_async write_async:
    read_scaled_async write_scaled_async read_scaled_by_async write_scaled_by_async async await
}

#[cfg(test)]
mod tests {
    use super::super::testing::{item, now, Device};
    use crate::{Error, Flags, Fraction, Initial, Item, OnCanOpen, OrNone, OutOfRange, Range, Rw, Scaled};

    const VELOCITY: Item<Scaled<i16, 1, 100>, Rw, OnCanOpen> = Item::new(
        OnCanOpen::canopen(0x6081, 0),
        "Profile velocity",
        Range::Between(0, 1500),
        Initial::Unknown,
        "rev/s",
        Flags::NONE,
    );

    #[test]
    fn physical_values() {
        let mut device = Device::answering(&[0xC8, 0x00]);
        assert_eq!(VELOCITY.at(&mut device).read_scaled(), Ok(2.0));
        assert_eq!(now(VELOCITY.at(&mut device).read_scaled_async()), Ok(2.0));
        assert_eq!(VELOCITY.at(&mut device).read(), Ok(200));
        assert_eq!(VELOCITY.at(&mut device).write_scaled(15.004), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0xDC, 0x05].as_slice()));
        let refused = Err(Error::OutOfRange(OutOfRange));
        assert_eq!(VELOCITY.at(&mut device).write_scaled(15.006).map_err(Error::from), refused);
        assert_eq!(now(VELOCITY.at(&mut device).write_scaled_async(1e9)).map_err(Error::from), refused);
        assert_eq!(device.written, None);
    }

    #[test]
    fn conversions_without_a_device() {
        assert_eq!((VELOCITY.physical(150), VELOCITY.raw(1.5)), (1.5, Ok(150)));
        assert_eq!(VELOCITY.raw(-1.0), Err(OutOfRange));
        let torque = item::<Fraction<i16, 15>, Rw>();
        assert_eq!((torque.physical_by(16_384, 5.0), torque.raw_by(2.5, 5.0)), (2.5, Ok(16_384)));
    }

    #[test]
    fn values_that_are_no_numbers() {
        let mut device = Device::answering(&[0xFF, 0xFF]);
        let temperature = item::<OrNone<Scaled<u16, 1, 10>, 0xFFFF>, Rw>();
        assert_eq!(temperature.at(&mut device).read_scaled(), Ok(None));
        assert_eq!(
            temperature.at(&mut device).write_scaled(6553.5).map_err(Error::from),
            Err(Error::OutOfRange(OutOfRange))
        );
        assert_eq!(temperature.at(&mut device).write(0xFFFF), Ok(()));
    }

    #[test]
    fn values_that_depend_on_others() {
        let mut device = Device::answering(&[0x00, 0x40]);
        let current = item::<Fraction<i16, 15>, Rw>();
        assert_eq!(current.at(&mut device).read_scaled_by(11.0), Ok(5.5));
        assert_eq!(now(current.at(&mut device).read_scaled_by_async(11.0)), Ok(5.5));
        assert_eq!(current.at(&mut device).write_scaled_by(-5.5, 11.0), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0x00, 0xC0].as_slice()));
        assert_eq!(now(current.at(&mut device).write_scaled_by_async(-5.5, 11.0)), Ok(()));
    }
}
