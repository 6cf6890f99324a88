//! Numbers that a device stores in several items.

use crate::value_error::OutOfRange;

/// Encoding of one number in `N` items that contain its digits, the most significant digit first. An additional item
/// can contain the sign of the number.
///
/// A client accesses the items one after the other. Between two writes, the device has some digits of the old number
/// and some of the new one.
///
/// ```
/// use lexibus::Composite;
///
/// // Pulses per revolution: one parameter contains the hundreds, the next one contains the units.
/// const PULSES: Composite<2> = Composite::new(100);
/// assert_eq!(PULSES.join([40, 96]), Ok(4096));
/// assert_eq!(PULSES.split(4096), Ok([40, 96]));
/// assert!(PULSES.split(10_000).is_err());
///
/// // Ten thousands, hundreds, units, and a sign item that is 1 for negative numbers.
/// const OFFSET: Composite<3> = Composite::signed(100, 1);
/// assert_eq!(OFFSET.join_signed(1, [1, 23, 45]), Ok(-12_345));
/// assert_eq!(OFFSET.split_signed(-12_345), Ok((1, [1, 23, 45])));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Composite<const N: usize> {
    base: u16,
    negative: Option<u16>,
}

impl<const N: usize> Composite<N> {
    /// Creates an unsigned encoding with this base. Digits are 0 to `base` - 1. If the base is below 2,
    /// [`split`](Self::split) rejects every number.
    #[must_use]
    pub const fn new(base: u16) -> Self {
        Self { base, negative: None }
    }

    /// Creates an encoding with a sign item. The sign is `negative` for negative numbers and 0 for all others.
    #[must_use]
    pub const fn signed(base: u16, negative: u16) -> Self {
        Self { base, negative: Some(negative) }
    }

    /// Returns the number with these digits, the most significant digit first.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if a digit isn't below the base, or if the number needs more than 32 bits.
    #[expect(clippy::indexing_slicing, reason = "`at` is below `N`")]
    pub const fn join(&self, digits: [u16; N]) -> Result<u32, OutOfRange> {
        let mut number: u32 = 0;
        let mut at = 0;
        while at < N {
            if digits[at] >= self.base {
                return Err(OutOfRange);
            }
            number = match number.checked_mul(self.base as u32) {
                Some(number) => match number.checked_add(digits[at] as u32) {
                    Some(number) => number,
                    None => return Err(OutOfRange),
                },
                None => return Err(OutOfRange),
            };
            at += 1;
        }
        Ok(number)
    }

    /// Returns the digits of a number, the most significant digit first.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the number has more than `N` digits.
    #[expect(clippy::indexing_slicing, reason = "`at` is below `N`")]
    pub const fn split(&self, number: u32) -> Result<[u16; N], OutOfRange> {
        let mut digits = [0; N];
        let (mut rest, mut at) = (number, N);
        while at > 0 && self.base > 1 {
            at -= 1;
            digits[at] = (rest % self.base as u32) as u16;
            rest /= self.base as u32;
        }
        match rest {
            0 if self.base > 1 => Ok(digits),
            _ => Err(OutOfRange),
        }
    }

    /// Returns the number with this sign and these digits.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`join`](Self::join), and [`OutOfRange`] if the sign is invalid or the absolute value
    /// doesn't fit in an `i32`.
    pub const fn join_signed(&self, sign: u16, digits: [u16; N]) -> Result<i32, OutOfRange> {
        let amount = match self.join(digits) {
            Ok(amount) if amount <= i32::MAX as u32 => amount as i32,
            _ => return Err(OutOfRange),
        };
        match (sign, self.negative) {
            (0, _) => Ok(amount),
            (sign, Some(negative)) if sign == negative => Ok(-amount),
            _ => Err(OutOfRange),
        }
    }

    /// Returns the sign and the digits of a number.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`split`](Self::split), and [`OutOfRange`] if the number is negative and the encoding has
    /// no sign.
    pub const fn split_signed(&self, number: i32) -> Result<(u16, [u16; N]), OutOfRange> {
        let sign = match (number < 0, self.negative) {
            (false, _) => 0,
            (true, Some(negative)) => negative,
            (true, None) => return Err(OutOfRange),
        };
        match self.split(number.unsigned_abs()) {
            Ok(digits) => Ok((sign, digits)),
            Err(error) => Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_come_back() {
        const PAIR: Composite<2> = Composite::new(100);
        for number in [0, 1, 99, 100, 4096, 9999] {
            assert_eq!(PAIR.split(number).map(|digits| PAIR.join(digits)), Ok(Ok(number)));
        }
        assert_eq!(PAIR.split(10_000), Err(OutOfRange));
        assert_eq!(PAIR.join([100, 0]), Err(OutOfRange));
    }

    #[test]
    fn signs_are_told_apart() {
        const OFFSET: Composite<3> = Composite::signed(100, 1);
        for number in [0, 1, -1, 999_999, -999_999] {
            let (sign, digits) = OFFSET.split_signed(number).expect("digits");
            assert_eq!(OFFSET.join_signed(sign, digits), Ok(number));
        }
        assert_eq!(OFFSET.split_signed(i32::MIN), Err(OutOfRange));
        assert_eq!(OFFSET.join_signed(2, [0, 0, 1]), Err(OutOfRange));
        assert_eq!(Composite::<2>::new(100).split_signed(-1), Err(OutOfRange));
    }

    #[test]
    fn impossible_bases_and_lengths_are_out_of_range() {
        for base in [0, 1] {
            assert_eq!(Composite::<2>::new(base).split(0), Err(OutOfRange));
            assert_eq!(Composite::<2>::new(base).join([1, 1]), Err(OutOfRange));
        }
        assert_eq!(Composite::<3>::new(u16::MAX).join([u16::MAX - 1; 3]), Err(OutOfRange));
        assert_eq!(Composite::<8>::new(16).split(u32::MAX), Ok([15; 8]));
        assert_eq!(Composite::<8>::new(16).join_signed(0, [15; 8]), Err(OutOfRange));
    }
}
