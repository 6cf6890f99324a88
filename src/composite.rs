//! Numbers that a device keeps in several items.

use crate::value_error::OutOfRange;

/// How a device splits one number over `N` items: digits to a base, the most significant one first, and perhaps a sign in an item of
/// its own.
///
/// The items are read and written one after the other; between two of them, the number isn't whole.
///
/// ```
/// use lexibus::Composite;
///
/// // Pulses a turn, hundreds in one parameter and units in the next:
/// const PULSES: Composite<2> = Composite::new(100);
/// assert_eq!(PULSES.join([40, 96]), Ok(4096));
/// assert_eq!(PULSES.split(4096), Ok([40, 96]));
/// assert!(PULSES.split(10_000).is_err());
///
/// // Ten thousands, hundreds and units, beside a sign that is 1 below zero:
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
    /// Digits to this base, from 0 to one below it. A base below 2 has no digits: every number is out of range.
    #[must_use]
    pub const fn new(base: u16) -> Self {
        Self { base, negative: None }
    }

    /// The same with an item for the sign, which has the value `negative` below zero and 0 otherwise.
    #[must_use]
    pub const fn signed(base: u16, negative: u16) -> Self {
        Self { base, negative: Some(negative) }
    }

    /// The number of its digits, the most significant one first.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] where a digit isn't below the base, or the number has more than 32 bits.
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

    /// The digits of a number, the most significant one first.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] where `N` digits aren't enough.
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

    /// The number of its sign and its digits.
    ///
    /// # Errors
    ///
    /// As of [`join`](Self::join); and where the sign is none, or the amount isn't one of an `i32`.
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

    /// Sign and digits of a number.
    ///
    /// # Errors
    ///
    /// As of [`split`](Self::split); and where the number is below 0, and nothing has a sign.
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
