//! A parameter and its value, for messages with several parameters.

use crate::access::Writable;
use crate::bus::{Parameter, Serial};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::value::Fixed;
use crate::value_error::{LengthError, OutOfRange};

/// A parameter number and a value.
///
/// ```
/// use lexibus::message::Setting;
/// use lexibus::{Flags, Initial, Item, OnSerial, OutOfRange, Parameter, Range, Rw};
///
/// const GAIN: Item<i16, Rw, OnSerial> =
///     Item::new(OnSerial::serial(0x0105), "Gain", Range::From(0), Initial::Unknown, "", Flags::NONE);
///
/// let setting = GAIN.setting(150)?;
/// assert_eq!((setting.parameter, setting.value()), (Parameter(0x0105), &[150, 0][..]));
/// assert_eq!(GAIN.setting(-1), Err(OutOfRange));
/// # Ok::<(), OutOfRange>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Setting {
    /// Number of the parameter.
    pub parameter: Parameter,
    value: [u8; 8],
    length: u8,
}

impl Setting {
    /// Creates a setting from the first `length` bytes of a little-endian value. A `length` above 8 is reduced to 8.
    #[must_use]
    pub fn new(parameter: Parameter, value: [u8; 8], length: usize) -> Self {
        let length = length.min(8);
        let mut bytes = [0; 8];
        bytes.iter_mut().zip(value).take(length).for_each(|(to, from)| *to = from);
        // `length` is at most 8, so the conversion is lossless.
        Self { parameter, value: bytes, length: length as u8 }
    }

    /// Creates a setting from little-endian bytes; returns `None` if there are more than 8 bytes.
    #[must_use]
    pub fn of(parameter: Parameter, bytes: &[u8]) -> Option<Self> {
        let mut value = [0; 8];
        value.get_mut(..bytes.len())?.copy_from_slice(bytes);
        Some(Self::new(parameter, value, bytes.len()))
    }

    /// Returns the value in little-endian byte order.
    #[must_use]
    pub fn value(&self) -> &[u8] {
        self.value.get(..self.length.into()).unwrap_or_default()
    }
}

impl<V: Fixed, A: Writable, L: On<Serial, Route = Parameter>> Item<V, A, L> {
    /// Creates a setting of this parameter, for a message with several parameters.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the value is outside the parameter's range or doesn't fit its type.
    pub fn setting(&self, value: V::Native) -> Result<Setting, OutOfRange> {
        if !V::in_range(value, self.range()) {
            return Err(OutOfRange);
        }
        let mut bytes = [0; 8];
        let length = V::encode(value, &mut bytes)?;
        Ok(Setting::new(self.location().route(), bytes, length))
    }
}

impl Setting {
    /// Copies the setting's value into `value` and returns the length in bytes.
    ///
    /// # Errors
    ///
    /// Returns [`Error::UnexpectedReply`] if the setting is for another parameter, or [`Error::Length`] if the lengths
    /// differ.
    pub fn copy<E>(&self, parameter: Parameter, value: &mut [u8]) -> Result<usize, Error<E>> {
        match self.parameter == parameter {
            true => copy(self.value(), value),
            false => Err(Error::UnexpectedReply),
        }
    }

    /// Decodes the value with the type of `item`. Returns `None` if the setting is for another parameter, or if the
    /// value doesn't have the length of this type.
    #[must_use]
    pub fn value_of<V: Fixed, A, L: On<Serial, Route = Parameter>>(&self, item: &Item<V, A, L>) -> Option<V::Native> {
        (item.location().route() == self.parameter).then(|| V::decode(self.value()).ok())?
    }
}

/// Copies a value and returns its length in bytes, or returns an error if the lengths differ.
pub(super) fn copy<E>(from: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
    if from.len() != value.len() {
        return Err(LengthError::new(value.len(), from.len()).into());
    }
    value.copy_from_slice(from);
    Ok(from.len())
}
