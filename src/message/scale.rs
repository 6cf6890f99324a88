//! Physical values of message fields.

use core::fmt;
use core::marker::PhantomData;

use crate::quantity::Quantity;
use crate::value_error::OutOfRange;

/// The scale of a message field, which converts between raw and physical values. Generated messages have a constant of
/// this type for each scaled field.
///
/// The documentation of the constant names the unit.
///
/// ```
/// use lexibus::message::Scale;
/// use lexibus::{Fraction, OutOfRange, Scaled};
///
/// const OVERRIDE: Scale<Scaled<u16, 1, 10>> = Scale::new();
/// const CURRENT: Scale<Fraction<i16, 15>> = Scale::new();
///
/// assert_eq!(OVERRIDE.raw(12.5)?, 125);
/// assert_eq!(CURRENT.physical_by(16_384, 11.0), 5.5);
/// # Ok::<(), OutOfRange>(())
/// ```
pub struct Scale<Q>(PhantomData<Q>);

impl<Q> Scale<Q> {
    /// Creates the scale of the quantity `Q`.
    #[must_use]
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<Q: Quantity> Scale<Q> {
    /// Converts a raw value to the physical value.
    #[must_use]
    pub fn physical(self, raw: Q::Native) -> Q::Physical
    where
        Q: Quantity<Other = ()>,
    {
        Q::physical(raw, ())
    }

    /// Converts a physical value to the nearest raw value.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the raw value doesn't fit the type or has a special meaning.
    pub fn raw(self, physical: f64) -> Result<Q::Native, OutOfRange>
    where
        Q: Quantity<Other = ()>,
    {
        Q::raw(physical, ())
    }

    /// Converts a raw value to the physical value. The scale depends on the value `other`.
    #[must_use]
    pub fn physical_by(self, raw: Q::Native, other: f64) -> Q::Physical
    where
        Q: Quantity<Other = f64>,
    {
        Q::physical(raw, other)
    }

    /// Converts a physical value to the nearest raw value. The scale depends on the value `other`.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the raw value doesn't fit the type or has a special meaning.
    pub fn raw_by(self, physical: f64, other: f64) -> Result<Q::Native, OutOfRange>
    where
        Q: Quantity<Other = f64>,
    {
        Q::raw(physical, other)
    }
}

impl<Q> Clone for Scale<Q> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Q> Copy for Scale<Q> {}

impl<Q> fmt::Debug for Scale<Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Scale")
    }
}
