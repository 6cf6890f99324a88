//! Decoding of responses.

use super::error::{ErrorNumber, ParameterError, Refusal};
use super::format::{Format, ParameterValue};
use super::request::{CHANGE, HEADER_LEN};
use crate::profinet::be;
use crate::value_error::LengthError;

/// Bit of the response ID. The bit is set if the drive refused at least one parameter.
const NEGATIVE: u8 = 0x80;

/// A decoded response with a valid structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Response<'r> {
    /// Number of parameters in the response.
    count: u8,
    is_negative: bool,
    parameters: &'r [u8],
}

/// The drive's answer for one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer<'r> {
    /// The drive has changed the parameter, or the parameter has no values.
    Done,
    /// The values of the parameter.
    Values(Values<'r>),
    /// The drive refused the parameter.
    Refused(Refusal),
}

/// The values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Values<'r> {
    /// Format of the values.
    pub format: Format,
    /// Number of values. For strings, the number of values is the number of characters.
    pub count: u8,
    /// Encoded values.
    pub bytes: &'r [u8],
}

impl<'r> Response<'r> {
    /// Decodes the response to `request` at the start of `data`. Bytes after the response are ignored.
    ///
    /// If a response would become too long, the drive refuses one parameter and omits all following parameters.
    /// Therefore, a response with too few parameters is an error only if it contains no refusal.
    ///
    /// # Errors
    ///
    /// - [`ParameterError::OtherReference`], [`ParameterError::OtherAxis`], [`ParameterError::ResponseId`] or
    ///   [`ParameterError::ParameterCount`] if the response doesn't belong to the request.
    /// - [`ParameterError::Length`] if the response is incomplete.
    /// - [`ParameterError::Format`] if a parameter other than the last one has a format of unknown length.
    /// - [`ParameterError::NoValue`] if a refusal has no error number.
    /// - [`ParameterError::NoRequest`] if `request` has fewer than four bytes.
    pub fn decode(request: &[u8], data: &'r [u8]) -> Result<Self, ParameterError> {
        let [own_reference, own_id, own_axis, own_count] =
            *be::chunk(request).map_err(|_| ParameterError::NoRequest)?;
        let [reference, id, axis, count] = *be::chunk(data)?;
        if reference != own_reference {
            return Err(ParameterError::OtherReference { expected: own_reference, actual: reference });
        }
        if id & !NEGATIVE != own_id {
            return Err(ParameterError::ResponseId(id));
        }
        if axis != own_axis {
            return Err(ParameterError::OtherAxis { expected: own_axis, actual: axis });
        }
        let is_negative = id & NEGATIVE != 0;
        if count > own_count || count == 0 || (count < own_count && !is_negative) {
            return Err(ParameterError::ParameterCount { expected: own_count, actual: count });
        }
        // The response to a successful change consists only of the header.
        let is_bare = id == CHANGE;
        let parameters = if is_bare { &[] } else { data.get(HEADER_LEN..).unwrap_or_default() };
        let response = Self { count, is_negative, parameters };
        if !is_bare {
            response.check(data.len())?;
        }
        Ok(response)
    }

    /// Checks that all parameters can be decoded.
    fn check(&self, length: usize) -> Result<(), ParameterError> {
        let mut rest = self.parameters;
        for left in (0..self.count).rev() {
            let (values, behind) = Values::split(rest).map_err(|missing| {
                // `missing` is the number of bytes that are missing at the end of the response.
                LengthError::new(length + missing, length)
            })?;
            if values.format.size().is_none() && left > 0 {
                return Err(ParameterError::Format(values.format));
            }
            if values.format == Format::ERROR && values.count == 0 {
                return Err(ParameterError::NoValue);
            }
            rest = behind;
        }
        Ok(())
    }

    /// Returns the number of parameters.
    #[must_use]
    pub const fn count(&self) -> u8 {
        self.count
    }

    /// Returns whether the drive refused at least one parameter.
    #[must_use]
    pub const fn is_negative(&self) -> bool {
        self.is_negative
    }

    /// Returns the answers in the order of the request.
    #[must_use]
    pub const fn answers(&self) -> Answers<'r> {
        Answers { rest: self.parameters, next: 0, count: self.count }
    }

    /// Returns the first refusal.
    #[must_use]
    pub fn refusal(&self) -> Option<Refusal> {
        self.answers().find_map(|answer| match answer {
            Answer::Refused(refusal) => Some(refusal),
            _ => None,
        })
    }

    /// Returns the values of the first parameter.
    ///
    /// # Errors
    ///
    /// Returns [`ParameterError::Refused`] if the drive refused the parameter, or [`ParameterError::NoValue`] if the
    /// parameter has no values.
    pub fn values(&self) -> Result<Values<'r>, ParameterError> {
        match self.answers().next() {
            Some(Answer::Values(values)) => Ok(values),
            Some(Answer::Refused(refusal)) => Err(ParameterError::Refused(refusal)),
            Some(Answer::Done) | None => Err(ParameterError::NoValue),
        }
    }

    /// Checks that the drive refused no parameter.
    ///
    /// # Errors
    ///
    /// Returns [`ParameterError::Refused`] with the first refusal. Returns [`ParameterError::NoValue`] if the response
    /// reports a refusal but contains none.
    pub fn done(&self) -> Result<(), ParameterError> {
        match self.refusal() {
            Some(refusal) => Err(ParameterError::Refused(refusal)),
            // The response ID reports a refusal, but no parameter is refused.
            None if self.is_negative => Err(ParameterError::NoValue),
            None => Ok(()),
        }
    }
}

impl<'r> Values<'r> {
    /// Decodes the values of the first parameter in `data`, and returns the values and the remaining data. If the
    /// values are incomplete, returns the number of missing bytes as an error.
    fn split(data: &'r [u8]) -> Result<(Self, &'r [u8]), usize> {
        let Some((&[format, count], rest)) = data.split_first_chunk() else { return Err(2 - data.len()) };
        let format = Format(format);
        let length = format.size().map_or(rest.len(), |size| size * usize::from(count));
        let (bytes, rest) = rest.split_at_checked(length).ok_or_else(|| length - rest.len())?;
        // Values with an odd length are followed by a padding byte. This byte may be missing at the end of a response.
        let rest = rest.get(length % 2..).unwrap_or_default();
        Ok((Self { format, count, bytes }, rest))
    }

    /// Returns the value at position `place`, starting at 0.
    ///
    /// # Errors
    ///
    /// Returns [`ParameterError::Format`] if `T` cannot read the format, or [`ParameterError::NoValue`] if there are
    /// too few values.
    pub fn get<T: ParameterValue>(&self, place: usize) -> Result<T, ParameterError> {
        if !T::reads(self.format) {
            return Err(ParameterError::Format(self.format));
        }
        let size = self.format.size().ok_or(ParameterError::Format(self.format))?;
        let value = self.bytes.chunks_exact(size).nth(place).ok_or(ParameterError::NoValue)?;
        Ok(T::from_bytes(value)?)
    }

    /// Converts the values to an answer. `parameter` is the position of the parameter in the request.
    fn answer(self, parameter: u8) -> Answer<'r> {
        match self.format {
            Format::ZERO => Answer::Done,
            Format::ERROR => {
                let mut words = self.bytes.chunks_exact(2).map(|word| be::bytes(word, 0)).map(u16::from_be_bytes);
                match words.next() {
                    Some(number) => {
                        let number = ErrorNumber(number);
                        Answer::Refused(Refusal { parameter, number, information: words.next() })
                    }
                    None => Answer::Values(self),
                }
            }
            _ => Answer::Values(self),
        }
    }
}

/// An iterator over the answers of a [`Response`].
#[derive(Clone, Debug)]
pub struct Answers<'r> {
    rest: &'r [u8],
    next: u8,
    count: u8,
}

impl<'r> Iterator for Answers<'r> {
    type Item = Answer<'r>;

    fn next(&mut self) -> Option<Answer<'r>> {
        let parameter = self.next;
        self.next = parameter.checked_add(1).filter(|next| *next <= self.count)?;
        // The response to a successful change has no values.
        let Ok((values, rest)) = Values::split(self.rest) else { return Some(Answer::Done) };
        self.rest = rest;
        Some(values.answer(parameter))
    }
}
