//! What a drive sends.

use super::error::{ErrorNumber, ParameterError, Refusal};
use super::format::{Format, ParameterValue};
use super::request::{CHANGE, HEADER_LEN};
use crate::profinet::be;
use crate::value_error::LengthError;

/// Set in the kind of a response where at least one parameter is refused.
const NEGATIVE: u8 = 0x80;

/// The response to a request: it has been looked through, and all that is in it can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Response<'r> {
    /// How many parameters it has.
    count: u8,
    is_negative: bool,
    parameters: &'r [u8],
}

/// What a drive says of one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer<'r> {
    /// It is changed, or it has no values.
    Done,
    /// Its values.
    Values(Values<'r>),
    /// It is refused.
    Refused(Refusal),
}

/// The values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Values<'r> {
    /// Their format.
    pub format: Format,
    /// How many they are; of a string, how many letters.
    pub count: u8,
    /// Their bytes, one value after the other.
    pub bytes: &'r [u8],
}

impl<'r> Response<'r> {
    /// The response to `request` that is at the start of `data`. Bytes behind it are not looked at.
    ///
    /// A drive whose response would get too long leaves parameters at the end out, and refuses the first of them: fewer
    /// parameters than the request has are only an error where none is refused.
    ///
    /// # Errors
    ///
    /// When the response is to another request, about another axis, of another kind, or has another number of parameters;
    /// when it ends too early. A parameter whose values have a format of unknown length has all that follows, and may
    /// only be the last. A refusal has to have a number.
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
        // A change that was made is confirmed by the first four bytes alone.
        let is_bare = id == CHANGE;
        let parameters = if is_bare { &[] } else { data.get(HEADER_LEN..).unwrap_or_default() };
        let response = Self { count, is_negative, parameters };
        if !is_bare {
            response.check(data.len())?;
        }
        Ok(response)
    }

    /// Whether every parameter can be read.
    fn check(&self, length: usize) -> Result<(), ParameterError> {
        let mut rest = self.parameters;
        for left in (0..self.count).rev() {
            let (values, behind) = Values::split(rest).map_err(|missing| {
                // What is missing counts from the end of the response.
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

    /// How many parameters the response has.
    #[must_use]
    pub const fn count(&self) -> u8 {
        self.count
    }

    /// Whether the drive refused a parameter at least.
    #[must_use]
    pub const fn is_negative(&self) -> bool {
        self.is_negative
    }

    /// What the drive says of each parameter, in the order of the request.
    #[must_use]
    pub const fn answers(&self) -> Answers<'r> {
        Answers { rest: self.parameters, next: 0, count: self.count }
    }

    /// The first parameter that the drive refused.
    #[must_use]
    pub fn refusal(&self) -> Option<Refusal> {
        self.answers().find_map(|answer| match answer {
            Answer::Refused(refusal) => Some(refusal),
            _ => None,
        })
    }

    /// The values of the first parameter.
    ///
    /// # Errors
    ///
    /// When the drive refused it, or sent none.
    pub fn values(&self) -> Result<Values<'r>, ParameterError> {
        match self.answers().next() {
            Some(Answer::Values(values)) => Ok(values),
            Some(Answer::Refused(refusal)) => Err(ParameterError::Refused(refusal)),
            Some(Answer::Done) | None => Err(ParameterError::NoValue),
        }
    }

    /// That the drive refused nothing.
    ///
    /// # Errors
    ///
    /// When it did: the first refusal.
    pub fn done(&self) -> Result<(), ParameterError> {
        match self.refusal() {
            Some(refusal) => Err(ParameterError::Refused(refusal)),
            // The drive says that it refused one, and not which.
            None if self.is_negative => Err(ParameterError::NoValue),
            None => Ok(()),
        }
    }
}

impl<'r> Values<'r> {
    /// The values at the start of `data`, and what follows them; how many bytes are missing as an error.
    fn split(data: &'r [u8]) -> Result<(Self, &'r [u8]), usize> {
        let Some((&[format, count], rest)) = data.split_first_chunk() else { return Err(2 - data.len()) };
        let format = Format(format);
        let length = format.size().map_or(rest.len(), |size| size * usize::from(count));
        let (bytes, rest) = rest.split_at_checked(length).ok_or_else(|| length - rest.len())?;
        // The byte that makes their number even is no part of them. At the end of a response it may be missing.
        let rest = rest.get(length % 2..).unwrap_or_default();
        Ok((Self { format, count, bytes }, rest))
    }

    /// The value at `place`, from 0.
    ///
    /// # Errors
    ///
    /// When the values have a format that isn't that of a `T`, or there are too few.
    pub fn get<T: ParameterValue>(&self, place: usize) -> Result<T, ParameterError> {
        if !T::reads(self.format) {
            return Err(ParameterError::Format(self.format));
        }
        let size = self.format.size().ok_or(ParameterError::Format(self.format))?;
        let value = self.bytes.chunks_exact(size).nth(place).ok_or(ParameterError::NoValue)?;
        Ok(T::from_bytes(value)?)
    }

    /// What a drive says of the parameter with this place in the request.
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

/// What a drive says of each parameter of a request; made by [`Response::answers`].
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
        // A change that was made has nothing more.
        let Ok((values, rest)) = Values::split(self.rest) else { return Some(Answer::Done) };
        self.rest = rest;
        Some(values.answer(parameter))
    }
}
