//! A parameter with its value, for messages that carry several.

use crate::access::Writable;
use crate::bus::{Parameter, Serial};
use crate::error::Error;
use crate::item::Item;
use crate::location::On;
use crate::value::Fixed;
use crate::value_error::{LengthError, OutOfRange};

/// The number of a parameter, and a value for it.
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
    /// The parameter.
    pub parameter: Parameter,
    value: [u8; 8],
    length: u8,
}

impl Setting {
    /// A value of `length` bytes, 8 at most, the least significant first. Further bytes are cut off.
    #[must_use]
    pub fn new(parameter: Parameter, value: [u8; 8], length: usize) -> Self {
        let length = length.min(8);
        let mut bytes = [0; 8];
        bytes[..length].copy_from_slice(&value[..length]);
        // 8 at most.
        Self { parameter, value: bytes, length: length as u8 }
    }

    /// The value of these bytes; `None` for more than 8.
    #[must_use]
    pub fn of(parameter: Parameter, bytes: &[u8]) -> Option<Self> {
        let mut value = [0; 8];
        value.get_mut(..bytes.len())?.copy_from_slice(bytes);
        Some(Self::new(parameter, value, bytes.len()))
    }

    /// The bytes of the value, the least significant first.
    #[must_use]
    pub fn value(&self) -> &[u8] {
        self.value.get(..self.length.into()).unwrap_or_default()
    }
}

impl<V: Fixed, A: Writable, L: On<Serial, Route = Parameter>> Item<V, A, L> {
    /// The parameter with a value, for a message that carries several.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] where the value is outside the item's range or doesn't fit its type.
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
    /// Copies the value of a parameter, for a client.
    ///
    /// # Errors
    ///
    /// [`Error::UnexpectedReply`] where it is another parameter's, [`Error::Length`] where it has another length than `value`.
    pub fn copy<E>(&self, parameter: Parameter, value: &mut [u8]) -> Result<usize, Error<E>> {
        match self.parameter == parameter {
            true => copy(self.value(), value),
            false => Err(Error::UnexpectedReply),
        }
    }

    /// The value as that of `item`; `None` where it is another parameter's, or has another length.
    #[must_use]
    pub fn value_of<V: Fixed, A, L: On<Serial, Route = Parameter>>(&self, item: &Item<V, A, L>) -> Option<V::Native> {
        (item.location().route() == self.parameter).then(|| V::decode(self.value()).ok())?
    }
}

/// Copies a value of the same length.
pub(super) fn copy<E>(from: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
    if from.len() != value.len() {
        return Err(LengthError::new(value.len(), from.len()).into());
    }
    value.copy_from_slice(from);
    Ok(from.len())
}
