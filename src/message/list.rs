//! Repeated fields.

use core::iter::FusedIterator;

use super::setting::copy;
use super::{Reader, Setting, WriteError, Writer};
use crate::bus::Parameter;
use crate::error::Error;
use crate::value_error::{LengthError, OutOfRange};

/// One occurrence of a group of repeated fields in a message.
pub trait Group: Copy {
    /// Length in bytes.
    const LENGTH: usize;

    /// Writes the fields.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if a field is out of range, or [`WriteError::Length`] if the buffer is too
    /// short.
    fn write(&self, to: &mut Writer<'_>) -> Result<(), WriteError>;

    /// Reads the fields of the group; returns `None` if the data don't match.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

/// A list of [`Group`]s. A list to send contains a slice of groups; a received list contains undecoded bytes.
#[derive(Clone, Copy, Debug)]
pub struct List<'a, G> {
    source: Source<'a, G>,
}

#[derive(Clone, Copy, Debug)]
enum Source<'a, G> {
    Sent(&'a [G]),
    Received(&'a [u8]),
}

impl<G: Copy> Source<'_, G> {
    /// Removes and returns the first group. In a received list, `read` decodes the group.
    fn take_next(&mut self, read: impl FnOnce(&mut Reader<'_>) -> Option<G>) -> Option<G> {
        match self {
            Source::Sent(groups) => {
                let (first, rest) = groups.split_first()?;
                *groups = rest;
                Some(*first)
            }
            Source::Received(bytes) => {
                let mut reader = Reader::new(bytes);
                let next = read(&mut reader)?;
                *bytes = reader.but(0)?;
                Some(next)
            }
        }
    }
}

impl<'a, G: Group> List<'a, G> {
    /// Creates a list from received bytes. Returns `None` if the last group is incomplete or a group is invalid.
    #[must_use]
    pub fn received(bytes: &'a [u8]) -> Option<Self> {
        let mut whole = bytes.chunks(G::LENGTH.max(1));
        let is_list = whole.all(|bytes| G::read(&mut Reader::new(bytes)).is_some());
        is_list.then_some(Self { source: Source::Received(bytes) })
    }

    /// Returns the number of groups.
    #[must_use]
    pub fn len(&self) -> usize {
        match self.source {
            Source::Sent(groups) => groups.len(),
            Source::Received(bytes) => bytes.len() / G::LENGTH.max(1),
        }
    }

    /// Returns whether the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns an iterator over the groups.
    #[must_use]
    pub fn iter(&self) -> ListIter<'a, G> {
        ListIter { source: self.source }
    }

    /// Writes all groups.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if a field is out of range, or [`WriteError::Length`] if the buffer is too
    /// short.
    pub fn write(&self, to: &mut Writer<'_>) -> Result<(), WriteError> {
        self.iter().try_for_each(|group| group.write(to))
    }
}

impl<'a, G> From<&'a [G]> for List<'a, G> {
    fn from(groups: &'a [G]) -> Self {
        Self { source: Source::Sent(groups) }
    }
}

impl<'a, G, const N: usize> From<&'a [G; N]> for List<'a, G> {
    fn from(groups: &'a [G; N]) -> Self {
        Self { source: Source::Sent(groups) }
    }
}

impl<'a, G: Group> IntoIterator for List<'a, G> {
    type Item = G;
    type IntoIter = ListIter<'a, G>;

    fn into_iter(self) -> ListIter<'a, G> {
        self.iter()
    }
}

impl<G: Group + PartialEq> PartialEq for List<'_, G> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

/// An iterator over the groups of a [`List`].
#[derive(Clone, Debug)]
pub struct ListIter<'a, G> {
    source: Source<'a, G>,
}

impl<G: Group> Iterator for ListIter<'_, G> {
    type Item = G;

    fn next(&mut self) -> Option<G> {
        self.source.take_next(G::read)
    }
}

impl<G: Group> FusedIterator for ListIter<'_, G> {}

/// A list of parameters and their values. A list to send contains a slice of [`Setting`]s; a received list contains
/// undecoded bytes.
///
/// The type of a parameter determines the length of its value.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    source: Source<'a, Setting>,
    rule: SettingsRule,
}

/// The encoding of parameter numbers and values in a message.
#[derive(Clone, Copy, Debug)]
pub struct SettingsRule {
    /// Length of a parameter number in bits.
    pub code_bits: u32,
    /// Byte order of the values; see [`Reader::value`].
    pub order: &'static [u8],
    /// Ranges of parameters in ascending order: first number, last number, length of a value in bytes.
    pub lengths: &'static [(u32, u32, u8)],
}

impl SettingsRule {
    /// Returns the length of a parameter's value in bytes, or `None` if the parameter doesn't exist.
    #[must_use]
    pub fn length(&self, parameter: Parameter) -> Option<usize> {
        let behind = self.lengths.partition_point(|(first, ..)| *first <= parameter.0);
        let (_, last, length) = self.lengths.get(behind.checked_sub(1)?)?;
        (parameter.0 <= *last).then_some((*length).into())
    }

    /// Returns whether the parameter of `setting` exists.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the length of the value differs from the length of the parameter's type.
    pub fn takes(&self, setting: &Setting) -> Result<bool, LengthError> {
        match self.length(setting.parameter) {
            None => Ok(false),
            Some(length) if length == setting.value().len() => Ok(true),
            Some(length) => Err(LengthError::new(length, setting.value().len())),
        }
    }

    /// Writes a parameter number.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if the number has more bits than the field, or [`WriteError::Length`] if the
    /// buffer is too short.
    pub fn write_code(&self, parameter: Parameter, to: &mut Writer<'_>) -> Result<(), WriteError> {
        match self.code_bits < 32 && parameter.0 >> self.code_bits != 0 {
            true => Err(OutOfRange.into()),
            false => to.number(self.code_bits, parameter.0.into()),
        }
    }

    /// Reads a parameter number; returns `None` if the data are too short.
    pub fn read_code(&self, from: &mut Reader<'_>) -> Option<Parameter> {
        from.number(self.code_bits)?.try_into().ok().map(Parameter)
    }

    /// Writes a parameter number and a value.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if the number has more bits than the field. Returns [`WriteError::Length`] if
    /// the buffer is too short, or if the length of the value differs from the length of the parameter's type.
    pub fn write(&self, setting: &Setting, to: &mut Writer<'_>) -> Result<(), WriteError> {
        self.takes(setting)?;
        self.put(setting, to)
    }

    fn put(&self, setting: &Setting, to: &mut Writer<'_>) -> Result<(), WriteError> {
        self.write_code(setting.parameter, to)?;
        to.value(self.order, setting.value())
    }

    /// Reads a parameter number and a value; returns `None` if the parameter doesn't exist or the data are too short.
    pub fn read(&self, from: &mut Reader<'_>) -> Option<Setting> {
        let parameter = self.read_code(from)?;
        let length = self.length(parameter)?;
        Some(Setting::new(parameter, from.value(self.order, length)?, length))
    }

    /// Reads a parameter number and a value. The value ends before the last `tail` bytes of the data, which are not
    /// read. Returns `None` if the data are too short or the value has more than 8 bytes.
    pub fn read_to(&self, from: &mut Reader<'_>, tail: usize) -> Option<Setting> {
        let parameter = self.read_code(from)?;
        let length = from.left().checked_sub(tail)?;
        Some(Setting::new(parameter, from.value(self.order, length)?, length))
    }

    /// Writes a parameter number, and zeros instead of the parameter's value.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::NoMessage`] if the parameter doesn't exist, [`WriteError::OutOfRange`] if the number has
    /// more bits than the field, or [`WriteError::Length`] if the buffer is too short.
    pub fn write_blank(&self, parameter: Parameter, to: &mut Writer<'_>) -> Result<(), WriteError> {
        let length = self.length(parameter).ok_or(WriteError::NoMessage)?;
        self.write_code(parameter, to)?;
        to.padding(length)
    }

    /// Reads a parameter number and skips the value of the parameter; returns `None` if the parameter doesn't exist or
    /// the data are too short.
    pub fn read_blank(&self, from: &mut Reader<'_>) -> Option<Parameter> {
        let parameter = self.read_code(from)?;
        from.skip(self.length(parameter)?)?;
        Some(parameter)
    }

    /// Copies a received value into `value`, in little-endian byte order. Returns the length of the value in bytes.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Length`] if the length of `value` differs from the length of the received value, or if the
    /// received value has more than 8 bytes.
    pub fn copy<E>(&self, bytes: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
        let found =
            Reader::new(bytes).value(self.order, bytes.len()).ok_or(LengthError::new(value.len(), bytes.len()))?;
        copy(found.get(..bytes.len()).unwrap_or_default(), value)
    }
}

impl<'a> Settings<'a> {
    /// Creates a list to send.
    #[must_use]
    pub const fn sent(settings: &'a [Setting], rule: SettingsRule) -> Self {
        Self { source: Source::Sent(settings), rule }
    }

    /// Creates a list from received bytes. Returns `None` if the bytes are incomplete or contain an unknown parameter.
    #[must_use]
    pub fn received(bytes: &'a [u8], rule: SettingsRule) -> Option<Self> {
        let settings = Self { source: Source::Received(bytes), rule };
        let mut all = settings.iter();
        all.by_ref().for_each(drop);
        matches!(all.source, Source::Received([])).then_some(settings)
    }

    /// Returns an iterator over the parameters and values.
    #[must_use]
    pub const fn iter(&self) -> SettingsIter<'a> {
        SettingsIter { source: self.source, rule: self.rule }
    }

    /// Writes all parameters and values.
    ///
    /// # Errors
    ///
    /// - [`WriteError::NoMessage`] if a parameter doesn't exist. Without the length of this parameter, the device
    ///   couldn't find the next parameter.
    /// - [`WriteError::OutOfRange`] if a parameter number has more bits than the field.
    /// - [`WriteError::Length`] if the buffer is too short, or if the length of a value differs from the length of the
    ///   parameter's type.
    pub fn write(&self, to: &mut Writer<'_>) -> Result<(), WriteError> {
        self.iter().try_for_each(|setting| match self.rule.takes(&setting)? {
            true => self.rule.put(&setting, to),
            false => Err(WriteError::NoMessage),
        })
    }
}

impl<'a> IntoIterator for Settings<'a> {
    type Item = Setting;
    type IntoIter = SettingsIter<'a>;

    fn into_iter(self) -> SettingsIter<'a> {
        self.iter()
    }
}

impl PartialEq for Settings<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

/// An iterator over [`Settings`].
#[derive(Clone, Debug)]
pub struct SettingsIter<'a> {
    source: Source<'a, Setting>,
    rule: SettingsRule,
}

impl Iterator for SettingsIter<'_> {
    type Item = Setting;

    fn next(&mut self) -> Option<Setting> {
        let rule = self.rule;
        self.source.take_next(|reader| rule.read(reader))
    }
}

impl FusedIterator for SettingsIter<'_> {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Sample(i16);

    impl Group for Sample {
        const LENGTH: usize = 2;

        fn write(&self, to: &mut Writer<'_>) -> Result<(), WriteError> {
            to.number(16, self.0 as u16 as u64)
        }

        fn read(from: &mut Reader<'_>) -> Option<Self> {
            Some(Sample(from.number(16)? as i16))
        }
    }

    const RULE: SettingsRule =
        SettingsRule { code_bits: 16, order: &[2, 3, 0, 1], lengths: &[(0x105, 0x105, 2), (0x10C, 0x10D, 4)] };

    #[test]
    fn lists_are_the_same_sent_and_received() {
        let (sent, mut data) = ([Sample(-578), Sample(7)], [0; 4]);
        let mut writer = Writer::new(&mut data);
        List::from(&sent).write(&mut writer).unwrap();
        assert_eq!(writer.written(), [0xFD, 0xBE, 0, 7]);
        let received = List::received(&data).unwrap();
        assert_eq!((received, received.len()), (List::from(&sent), 2));
        assert_eq!(List::<Sample>::received(&data[..3]), None);
    }

    #[test]
    fn settings_are_as_long_as_their_parameters() {
        let settings = [
            Setting::of(Parameter(0x105), &[150, 0]).unwrap(),
            Setting::of(Parameter(0x10C), &[0x34, 0xAB, 2, 1]).unwrap(),
        ];
        let mut data = [0; 16];
        let mut writer = Writer::new(&mut data);
        Settings::sent(&settings, RULE).write(&mut writer).unwrap();
        let expected = [0x01, 0x05, 0x00, 150, 0x01, 0x0C, 0xAB, 0x34, 0x01, 0x02];
        assert_eq!(writer.written(), expected);
        let received = Settings::received(&expected, RULE).unwrap();
        assert_eq!(received.iter().collect::<Vec<_>>(), settings);
        assert_eq!(Settings::received(&expected[..9], RULE), None);
        assert_eq!(Settings::received(&[1, 6, 0, 0], RULE), None);
        let setting = |number, value: &[u8]| Setting::of(Parameter(number), value).unwrap();
        assert_eq!(RULE.takes(&setting(0x105, &[1, 2])), Ok(true));
        assert_eq!(RULE.takes(&setting(0x10C, &[1, 2])), Err(LengthError::new(4, 2)));
        assert_eq!(RULE.takes(&setting(0x106, &[1, 2])), Ok(false));
        // Settings that the device would misinterpret are not sent.
        let written = |settings: &[Setting]| Settings::sent(settings, RULE).write(&mut Writer::new(&mut [0; 16]));
        assert_eq!(written(&[setting(0x106, &[1, 2])]), Err(WriteError::NoMessage));
        assert_eq!(written(&[setting(0x10C, &[1, 2])]), Err(LengthError::new(4, 2).into()));
        let alone = RULE.write(&setting(0x105, &[1]), &mut Writer::new(&mut [0; 16]));
        assert_eq!(alone, Err(LengthError::new(2, 1).into()));
        let lengths = [0x104, 0x105, 0x106, 0x10D, 0x10E].map(|number| RULE.length(Parameter(number)));
        assert_eq!(lengths, [None, Some(2), None, Some(4), None]);
    }
}
