//! Dates and durations of CANopen.

use core::cmp::Ordering;
use core::time::Duration;

use crate::data_type::DataType;
use crate::range::Range;
use crate::value::{decode_raw, encode_raw, Fixed, Value};
use crate::value_error::{LengthError, OutOfRange};

/// A date with the time of day (CiA 301 7.1.6.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TimeOfDay {
    /// Milliseconds after midnight, 28 bits.
    pub milliseconds: u32,
    /// Days since January 1, 1984.
    pub days: u16,
}

/// A duration (CiA 301 7.1.6.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TimeDifference {
    /// Milliseconds in addition to the days, 28 bits.
    pub milliseconds: u32,
    /// Days.
    pub days: u16,
}

/// Mask of the bits for the milliseconds. The four bits above the milliseconds are reserved.
const MILLISECONDS: u32 = 0x0FFF_FFFF;

macro_rules! time {
    ($($time:ident)*) => {$(
        impl $time {
            /// Creates a value. A write returns [`OutOfRange`] if `milliseconds` has more than 28 bits. A PDO contains
            /// only the low 28 bits.
            #[must_use]
            pub const fn new(milliseconds: u32, days: u16) -> Self {
                Self { milliseconds, days }
            }

            /// Returns the 48 bits that are sent: 28 bits of milliseconds, 4 reserved bits, 16 bits of days. Higher
            /// bits of `milliseconds` are discarded.
            #[must_use]
            pub const fn raw(self) -> u64 {
                (self.milliseconds & MILLISECONDS) as u64 | (self.days as u64) << 32
            }

            /// Creates a value from the 48 bits that a device sends. Ignores reserved bits and all bits above bit 47.
            #[must_use]
            pub const fn from_raw(raw: u64) -> Self {
                Self { milliseconds: raw as u32 & MILLISECONDS, days: (raw >> 32) as u16 }
            }
        }

        impl PartialOrd for $time {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                Some(self.cmp(other))
            }
        }

        impl Ord for $time {
            fn cmp(&self, other: &Self) -> Ordering {
                (self.days, self.milliseconds).cmp(&(other.days, other.milliseconds))
            }
        }

        impl Value for $time {
            type Native = Self;
            const DATA_TYPE: DataType = DataType::$time;
        }

        impl Fixed for $time {
            const BITS: u32 = 48;

            #[inline]
            fn encode(native: Self, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
                if native.milliseconds > MILLISECONDS {
                    return Err(OutOfRange);
                }
                Ok(encode_raw(native.raw(), Self::BITS, buffer))
            }

            #[inline]
            fn decode(bytes: &[u8]) -> Result<Self, LengthError> {
                decode_raw(bytes, Self::BITS).map(Self::from_raw)
            }

            #[inline]
            fn in_range(value: Self, range: &Range<Self>) -> bool {
                range.contains(value)
            }
        }
    )*};
}

time! { TimeOfDay TimeDifference }

/// Seconds of a day.
const DAY: u64 = 86_400;

/// Days from January 1, 1970 to January 1, 1984.
const FIRST_DAY: u64 = 5113;

impl TimeOfDay {
    /// Converts a time since January 1, 1970, 00:00 UTC. Returns `None` if the date is before January 1, 1984 or after
    /// June 6, 2163. Drops fractions of a millisecond.
    ///
    /// ```
    /// use std::time::{Duration, SystemTime};
    ///
    /// use lexibus::TimeOfDay;
    ///
    /// let moon = TimeOfDay::from_unix_time(Duration::from_millis(946_684_800_250)).expect("a date since 1984");
    /// assert_eq!(moon, TimeOfDay::new(250, 5844));
    /// assert_eq!(moon.unix_time(), Duration::from_millis(946_684_800_250));
    /// let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).ok().and_then(TimeOfDay::from_unix_time);
    /// ```
    #[must_use]
    pub fn from_unix_time(time: Duration) -> Option<Self> {
        let days = u16::try_from((time.as_secs() / DAY).checked_sub(FIRST_DAY)?).ok()?;
        let milliseconds = (time.as_secs() % DAY) as u32 * 1000 + time.subsec_millis();
        Some(Self { milliseconds, days })
    }

    /// Returns whether the time of day is less than 24 hours.
    #[cfg(feature = "canopen")]
    pub(crate) const fn is_valid(self) -> bool {
        (self.milliseconds as u64) < DAY * 1000
    }

    /// Returns the time since January 1, 1970, 00:00 UTC.
    #[must_use]
    pub fn unix_time(self) -> Duration {
        let days = FIRST_DAY + u64::from(self.days);
        Duration::from_secs(days * DAY) + Duration::from_millis(self.milliseconds.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn travels_in_six_bytes() {
        let time = TimeOfDay { milliseconds: 0x0123_4567, days: 0x89AB };
        let mut buffer = [0; 8];
        assert_eq!(TimeOfDay::encode(time, &mut buffer), Ok(6));
        assert_eq!(buffer[..6], [0x67, 0x45, 0x23, 0x01, 0xAB, 0x89]);
        assert_eq!(TimeOfDay::decode(&buffer[..6]), Ok(time));
        assert_eq!(TimeOfDay::decode(&buffer), Err(LengthError { expected: 6, actual: 8 }));
    }

    #[test]
    fn reserved_bits_are_ignored_and_never_sent() {
        let span = TimeDifference::from_raw(u64::MAX);
        assert_eq!(span, TimeDifference { milliseconds: MILLISECONDS, days: u16::MAX });
        assert_eq!(span.raw(), 0xFFFF_0FFF_FFFF);
        let late = TimeDifference { milliseconds: MILLISECONDS + 1, days: 0 };
        assert_eq!(TimeDifference::encode(late, &mut [0; 8]), Err(OutOfRange));
    }

    #[test]
    fn unix_time() {
        let first = Duration::from_secs(FIRST_DAY * DAY);
        assert_eq!(TimeOfDay::from_unix_time(first), Some(TimeOfDay::default()));
        assert_eq!(TimeOfDay::from_unix_time(first - Duration::from_nanos(1)), None);
        let last = TimeOfDay { milliseconds: 86_399_999, days: u16::MAX };
        assert_eq!(TimeOfDay::from_unix_time(last.unix_time()), Some(last));
        assert_eq!(TimeOfDay::from_unix_time(last.unix_time() + Duration::from_millis(1)), None);
    }

    #[test]
    fn days_count_before_milliseconds() {
        assert!(TimeOfDay { milliseconds: 9, days: 1 } < TimeOfDay { milliseconds: 0, days: 2 });
    }
}
