//! Items for which a bus accepts only some values.

use super::{ReadRoute, Route, WriteRoute};
use crate::bus::{Bus, Object};
use crate::bus_address::BusAddress;
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::pdo::{from_bytes, sign_extend};
use crate::register::Register;
use crate::value_error::OutOfRange;

/// Route of an integer for which one bus accepts only some values. Values that are read aren't checked.
///
/// ```
/// use lexibus::{Limited, Object};
///
/// // The modes that a drive accepts on CANopen. On Modbus, -50 stores its parameters.
/// const MODES: Limited<Object> = Limited::new(Object::new(0x6060, 0), true, &[(-127, -127), (-2, -1), (1, 1), (6, 7)]);
/// assert!(MODES.takes(-1) && !MODES.takes(-50));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Limited<R> {
    /// Route to the value.
    pub at: R,
    /// True if the value is in two's complement.
    pub is_signed: bool,
    /// Accepted ranges, each with its first and last value.
    pub values: &'static [(i64, i64)],
}

impl<R> Limited<R> {
    /// Creates a route that accepts only `values` and accesses the item through the route `at`.
    #[must_use]
    pub const fn new(at: R, is_signed: bool, values: &'static [(i64, i64)]) -> Self {
        Self { at, is_signed, values }
    }

    /// Returns whether the route accepts `value`.
    #[must_use]
    pub fn takes(&self, value: i64) -> bool {
        self.values.iter().any(|(first, last)| (*first..=*last).contains(&value))
    }

    fn check(&self, data: &[u8]) -> Result<(), OutOfRange> {
        let raw = from_bytes(data);
        let value = match self.is_signed {
            true => Ok(sign_extend(raw, 8 * data.len() as u32)),
            false => i64::try_from(raw),
        };
        let is_taken = value.is_ok_and(|value| self.takes(value));
        is_taken.then_some(()).ok_or(OutOfRange)
    }
}

impl<R: Route> Route for Limited<R> {
    fn object(&self) -> Option<Object> {
        self.at.object()
    }

    fn register(&self) -> Option<Register> {
        self.at.register()
    }

    fn is_resized(&self) -> bool {
        self.at.is_resized()
    }
}

impl<B: Bus, R: ReadRoute<B>> ReadRoute<B> for Limited<R> {
    read_by!(at);
}

impl<B: Bus, R: WriteRoute<B>> WriteRoute<B> for Limited<R> {
    #[inline]
    fn write_address(&self) -> Option<BusAddress> {
        self.at.write_address()
    }

    fn write<C: Client<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        self.check(data)?;
        self.at.write(client, data)
    }

    async fn write_async<C: AsyncClient<Bus = B>>(&self, client: &mut C, data: &[u8]) -> Result<(), Error<C::Error>> {
        self.check(data)?;
        self.at.write_async(client, data).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Object;

    #[test]
    fn values_by_their_bytes() {
        let signed = Limited::new(Object::new(0x6060, 0), true, &[(-2, -1), (1, 7)]);
        assert_eq!(signed.check(&[0xFE]), Ok(()));
        assert_eq!(signed.check(&[0xFE, 0xFF]), Ok(()));
        assert_eq!(signed.check(&[0xFE, 0x00]), Err(OutOfRange));
        let unsigned = Limited::new(Object::new(0x2000, 0), false, &[(0, 0xFE)]);
        assert_eq!((unsigned.check(&[0xFE]), unsigned.check(&[0xFF])), (Ok(()), Err(OutOfRange)));
        assert_eq!(unsigned.check(&[0xFF; 8]), Err(OutOfRange));
    }
}
