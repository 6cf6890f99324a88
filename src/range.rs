//! Ranges of values that an item accepts.

/// Range of values, including its limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Range<T: 'static> {
    /// All values of the integer or floating-point type.
    #[default]
    Full,
    /// This value and all higher values.
    From(T),
    /// This value and all lower values.
    To(T),
    /// All values from the first limit to the second limit.
    Between(T, T),
    /// The union of several ranges, each with its first and last value.
    OneOf(&'static [(T, T)]),
}

impl<T: PartialOrd> Range<T> {
    /// Returns whether the range contains `value`. NaN is only in [`Range::Full`].
    #[must_use]
    #[inline]
    pub fn contains(&self, value: T) -> bool {
        match self {
            Self::Full => true,
            Self::From(low) => *low <= value,
            Self::To(high) => value <= *high,
            Self::Between(low, high) => *low <= value && value <= *high,
            Self::OneOf(list) => list.iter().any(|(low, high)| *low <= value && value <= *high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_belong_to_the_range() {
        assert!(Range::Full.contains(0));
        assert!(Range::From(1).contains(1) && !Range::From(1).contains(0));
        assert!(Range::To(1).contains(1) && !Range::To(1).contains(2));
        let between = Range::Between(-1, 1);
        assert!(between.contains(-1) && between.contains(1));
        assert!(!between.contains(-2) && !between.contains(2));
        let several = Range::OneOf(&[(1, 1), (4, 6)]);
        assert!(several.contains(1) && several.contains(6));
        assert!(!several.contains(2) && !several.contains(7));
    }

    #[test]
    fn not_a_number() {
        assert!(Range::Full.contains(f32::NAN));
        assert!(!Range::Between(0.0, 1.0).contains(f32::NAN));
    }
}
