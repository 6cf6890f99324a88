//! Encoding of message data.

use core::error;
use core::fmt;

use crate::error::Error;
use crate::from::from;
use crate::range::Range;
use crate::value::Fixed;
use crate::value_error::{LengthError, OutOfRange};

/// Writes the fields of a message in order.
///
/// Numbers are big-endian unless the method has the parameter `order`. Bit fields start at the most significant bit.
#[derive(Debug)]
pub struct Writer<'b> {
    data: &'b mut [u8],
    /// Number of bits written.
    bits: usize,
}

/// Reasons why a message cannot be encoded. A message that cannot be encoded isn't sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum WriteError {
    /// A field is out of range, or a reply contains another parameter than the request.
    OutOfRange(OutOfRange),
    /// A length is wrong: the data are longer than the buffer or than the protocol allows, a value doesn't have the
    /// length of its type, or the request is too short for the reply.
    Length(LengthError),
    /// The parameter doesn't exist, or the protocol has no message for this access to the parameter.
    NoMessage,
}

from! {
    OutOfRange => WriteError::OutOfRange;
    LengthError => WriteError::Length;
}

impl<E> From<WriteError> for Error<E> {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::OutOfRange(error) => Self::OutOfRange(error),
            WriteError::Length(error) => Self::Length(error),
            WriteError::NoMessage => Self::NoMessage,
        }
    }
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange(error) => error.fmt(f),
            Self::Length(error) => error.fmt(f),
            Self::NoMessage => f.write_str("the protocol has no message for this access"),
        }
    }
}

impl error::Error for WriteError {}

/// Checks that the value of a field is within `range`.
///
/// # Errors
///
/// Returns [`WriteError::OutOfRange`] if the value is outside `range`.
#[inline]
pub fn check<V: Fixed>(value: V::Native, range: &Range<V::Native>) -> Result<(), WriteError> {
    match V::in_range(value, range) {
        true => Ok(()),
        false => Err(OutOfRange.into()),
    }
}

impl<'b> Writer<'b> {
    /// Creates a writer at the start of `data`.
    pub fn new(data: &'b mut [u8]) -> Self {
        Self { data, bits: 0 }
    }

    /// Returns the bytes written so far.
    #[must_use]
    pub fn written(&self) -> &[u8] {
        self.data.get(..self.len()).unwrap_or_default()
    }

    /// Returns the number of bytes written.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.bits.div_ceil(8)
    }

    /// Returns whether nothing has been written.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.bits == 0
    }

    /// Reserves the next `count` bytes.
    fn room(&mut self, count: usize) -> Result<&mut [u8], WriteError> {
        let (start, length) = (self.len(), self.data.len());
        let room = self.data.get_mut(start..start.saturating_add(count));
        let room = room.ok_or(LengthError::new(length, start.saturating_add(count)))?;
        self.bits = (start + count) * 8;
        Ok(room)
    }

    /// Writes bytes.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn bytes(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.room(bytes.len())?.copy_from_slice(bytes);
        Ok(())
    }

    /// Writes `count` padding bytes. Padding bytes are 0.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn padding(&mut self, count: usize) -> Result<(), WriteError> {
        self.room(count)?.fill(0);
        Ok(())
    }

    /// Writes the low `width` bits of a number in big-endian byte order. `width` is at most 64.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn number(&mut self, width: u32, number: u64) -> Result<(), WriteError> {
        let mut left = width.min(64);
        while left > 0 {
            let used = (self.bits % 8) as u32;
            let error = LengthError::new(self.data.len(), self.bits / 8 + 1);
            let byte = self.data.get_mut(self.bits / 8).ok_or(error)?;
            let count = left.min(8 - used);
            let part = (number >> (left - count)) as u8 & (0xFF >> (8 - count));
            let before = if used == 0 { 0 } else { *byte };
            *byte = before | part << (8 - used - count);
            self.bits += count as usize;
            left -= count;
        }
        Ok(())
    }

    /// Writes a number in the byte order `order`. `order` lists the bytes in wire order; 0 is the most significant
    /// byte.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn ordered(&mut self, order: &[u8], number: u64) -> Result<(), WriteError> {
        let last = order.len().saturating_sub(1);
        let room = self.room(order.len())?;
        for (to, &position) in room.iter_mut().zip(order) {
            *to = number.checked_shr(8 * (last.saturating_sub(position.into()) as u32)).unwrap_or(0) as u8;
        }
        Ok(())
    }

    /// Converts a little-endian value to the byte order `order` and writes it; see
    /// [`Reader::value`](super::Reader::value).
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn value(&mut self, order: &[u8], value: &[u8]) -> Result<(), WriteError> {
        let room = self.room(value.len())?;
        for (at, to) in room.iter_mut().enumerate() {
            let significance = super::reader::significance(order, value.len(), at);
            *to = value.get(significance).copied().unwrap_or(0);
        }
        Ok(())
    }

    /// Writes `count` bytes of the request, starting with the byte at offset `first`.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer or the request is too short.
    pub fn echo(&mut self, request: &[u8], first: usize, count: usize) -> Result<(), WriteError> {
        self.bytes(part(request, first, count)?)
    }

    /// Checks that the `count` bytes written at offset `at` equal the bytes of the request at offset `first`. This
    /// check ensures that a reply contains the parameter of its request.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if the bytes differ, or [`WriteError::Length`] if the request is too short.
    pub fn same(&self, at: usize, request: &[u8], first: usize, count: usize) -> Result<(), WriteError> {
        let expected = part(request, first, count)?;
        match self.written().get(at..at.saturating_add(count)) == Some(expected) {
            true => Ok(()),
            false => Err(OutOfRange.into()),
        }
    }

    /// Sets the length field at offset `at` to the number of bytes written since offset `first`, in the byte order
    /// `order`.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::OutOfRange`] if the number doesn't fit into the field, or [`WriteError::Length`] if the
    /// field exceeds the buffer.
    pub fn length(&mut self, at: usize, order: &[u8], first: usize) -> Result<(), WriteError> {
        let (length, bits) = (self.len().saturating_sub(first) as u64, self.bits);
        let room = 8 * order.len() as u32;
        if length.checked_shr(room).unwrap_or(0) != 0 {
            return Err(OutOfRange.into());
        }
        self.bits = at * 8;
        let written = self.ordered(order, length);
        self.bits = bits;
        written
    }

    /// Writes `count` bytes of the request, starting with the byte at offset `first`. If the request is shorter, writes
    /// zeros instead of the missing bytes.
    ///
    /// # Errors
    ///
    /// Returns [`WriteError::Length`] if the buffer is too short.
    pub fn copy(&mut self, request: &[u8], first: usize, count: usize) -> Result<(), WriteError> {
        let copied = request.get(first..).unwrap_or_default();
        self.room(count)?
            .iter_mut()
            .zip(copied.iter().chain(core::iter::repeat(&0)))
            .for_each(|(to, from)| *to = *from);
        Ok(())
    }
}

/// Returns `count` bytes of the request, starting with the byte at offset `first`.
fn part(request: &[u8], first: usize, count: usize) -> Result<&[u8], LengthError> {
    let end = first.saturating_add(count);
    request.get(first..end).ok_or(LengthError::new(end, request.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_follow_each_other() {
        let mut data = [0xFF; 11];
        let mut writer = Writer::new(&mut data);
        writer.number(4, 0xA5).unwrap();
        writer.number(3, 0b011).unwrap();
        writer.number(1, 1).unwrap();
        writer.ordered(&[2, 3, 0, 1], 0x0102_AB34).unwrap();
        writer.value(&[2, 3, 0, 1], &[0xBE, 0xFD]).unwrap();
        writer.echo(&[1, 2, 3], 1, 1).unwrap();
        writer.copy(&[1, 2, 3], 2, 2).unwrap();
        assert_eq!(writer.written(), [0x57, 0xAB, 0x34, 0x01, 0x02, 0xFD, 0xBE, 2, 3, 0]);
        assert_eq!(writer.number(12, 1), Err(LengthError::new(11, 12).into()));
    }

    #[test]
    fn nothing_is_written_beyond_the_room() {
        let mut data = [0; 2];
        let mut writer = Writer::new(&mut data);
        assert_eq!(writer.bytes(&[1, 2, 3]), Err(LengthError::new(2, 3).into()));
        assert!(writer.is_empty());
        assert_eq!(writer.echo(&[1, 2], 1, 2), Err(LengthError::new(3, 2).into()));
        assert_eq!(writer.padding(2), Ok(()));
        assert_eq!(writer.written(), [0, 0]);
    }

    #[test]
    fn what_comes_back_is_held_against_the_request() {
        let mut data = [0; 4];
        let mut writer = Writer::new(&mut data);
        writer.bytes(&[9, 1, 2]).unwrap();
        assert_eq!(writer.same(1, &[0, 0, 1, 2], 2, 2), Ok(()));
        assert_eq!(writer.same(1, &[0, 0, 1, 3], 2, 2), Err(OutOfRange.into()));
        assert_eq!(writer.same(2, &[2, 0], 0, 2), Err(OutOfRange.into()));
        assert_eq!(writer.same(1, &[0, 0, 1], 2, 2), Err(LengthError::new(4, 3).into()));
    }

    #[test]
    fn lengths_are_known_at_the_end() {
        let mut data = [0; 300];
        let mut writer = Writer::new(&mut data);
        writer.number(16, 0).unwrap();
        writer.bytes(&[7; 4]).unwrap();
        assert_eq!(writer.length(0, &[1, 0], 2), Ok(()));
        assert_eq!(writer.written(), [4, 0, 7, 7, 7, 7]);
        writer.padding(280).unwrap();
        assert_eq!((writer.length(0, &[0], 2), writer.len()), (Err(OutOfRange.into()), 286));
    }

    #[test]
    fn limits() {
        assert_eq!(check::<i16>(5, &Range::To(4)), Err(OutOfRange.into()));
        assert_eq!(check::<i16>(4, &Range::To(4)), Ok(()));
    }
}
