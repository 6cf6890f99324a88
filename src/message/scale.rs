//! Physical numbers of fields.

use core::fmt;
use core::marker::PhantomData;

use crate::quantity::Quantity;
use crate::value_error::OutOfRange;

/// How a field of a message relates to a physical number: a constant of generated messages, in units that its documentation has.
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
    /// The scale of `Q`.
    #[must_use]
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<Q: Quantity> Scale<Q> {
    /// The physical number.
    #[must_use]
    pub fn physical(self, raw: Q::Native) -> Q::Physical
    where
        Q: Quantity<Other = ()>,
    {
        Q::physical(raw, ())
    }

    /// The nearest raw number.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] where there is no such number.
    pub fn raw(self, physical: f64) -> Result<Q::Native, OutOfRange>
    where
        Q: Quantity<Other = ()>,
    {
        Q::raw(physical, ())
    }

    /// The physical number, where it depends on another one.
    #[must_use]
    pub fn physical_by(self, raw: Q::Native, other: f64) -> Q::Physical
    where
        Q: Quantity<Other = f64>,
    {
        Q::physical(raw, other)
    }

    /// The nearest raw number, where it depends on another one.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] where there is no such number.
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
