//! Decoding of message data.

/// Reads the fields of a message in order.
///
/// Numbers are big-endian unless the method has the parameter `order`. Bit fields start at the most significant bit.
/// The methods that read or check data return `None` if the data are too short or don't match.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'r> {
    data: &'r [u8],
    /// Number of bits read.
    bits: usize,
}

/// Returns the significance of the byte at wire position `at` in a value of `length` bytes. The least significant byte
/// has the significance 0.
///
/// `order` lists the bytes of the longest possible value in wire order; 0 is the most significant byte. A shorter value
/// consists of the low bytes of the longest value, in the same order. A value is big-endian if it is longer than
/// `order` or if `order` is empty.
pub(super) fn significance(order: &[u8], length: usize, at: usize) -> usize {
    let big_endian = length.saturating_sub(1).saturating_sub(at);
    let Some(missing) = order.len().checked_sub(length) else { return big_endian };
    let mut positions = order.iter().map(|&position| usize::from(position)).filter(|position| *position >= missing);
    let ordered = positions.nth(at).and_then(|position| order.len().checked_sub(1 + position));
    ordered.unwrap_or(big_endian)
}

impl<'r> Reader<'r> {
    /// Creates a reader at the start of `data`.
    #[must_use]
    pub const fn new(data: &'r [u8]) -> Self {
        Self { data, bits: 0 }
    }

    /// Returns the number of unread bytes. A partly read byte doesn't count.
    #[must_use]
    pub fn left(&self) -> usize {
        self.data.len().saturating_sub(self.bits.div_ceil(8))
    }

    /// Reads `count` bytes.
    pub fn bytes(&mut self, count: usize) -> Option<&'r [u8]> {
        let start = self.bits.div_ceil(8);
        let bytes = self.data.get(start..start.checked_add(count)?)?;
        self.bits = (start + count) * 8;
        Some(bytes)
    }

    /// Skips `count` bytes.
    pub fn skip(&mut self, count: usize) -> Option<()> {
        self.bytes(count).map(|_| ())
    }

    /// Reads bytes and checks that they equal `expected`.
    pub fn constant(&mut self, expected: &[u8]) -> Option<()> {
        (self.bytes(expected.len())? == expected).then_some(())
    }

    /// Reads `count` bytes and checks that they equal the bytes of the request that start at offset `first`.
    pub fn echo(&mut self, request: &[u8], first: usize, count: usize) -> Option<()> {
        self.constant(request.get(first..first.checked_add(count)?)?)
    }

    /// Reads `count` bytes and compares them with the bytes of the request that start at offset `first`. If the request
    /// is shorter, the remaining bytes are not compared.
    pub fn copy(&mut self, request: &[u8], first: usize, count: usize) -> Option<()> {
        let expected = request.get(first..).unwrap_or_default();
        self.bytes(count)?.iter().zip(expected).all(|(byte, expected)| byte == expected).then_some(())
    }

    /// Reads a number of `width` bits and checks that the number equals `expected`.
    pub fn fixed(&mut self, width: u32, expected: u64) -> Option<()> {
        (self.number(width)? == expected).then_some(())
    }

    /// Reads a number in the byte order `order` and checks that the number equals `expected`.
    pub fn fixed_in(&mut self, order: &[u8], expected: u64) -> Option<()> {
        (self.ordered(order)? == expected).then_some(())
    }

    /// Checks that `length` equals the number of bytes from offset `first` to the end of the data.
    pub fn counted(&self, first: usize, length: u64) -> Option<()> {
        let rest = self.data.len().checked_sub(first)?;
        (u64::try_from(rest) == Ok(length)).then_some(())
    }

    /// Reads a big-endian number of `width` bits. `width` is at most 64.
    pub fn number(&mut self, width: u32) -> Option<u64> {
        let (mut left, mut number) = (width.min(64), 0_u64);
        while left > 0 {
            let byte = *self.data.get(self.bits / 8)?;
            let used = (self.bits % 8) as u32;
            let count = left.min(8 - used);
            let part = byte >> (8 - used - count) & (0xFF >> (8 - count));
            number = number << count | u64::from(part);
            self.bits += count as usize;
            left -= count;
        }
        Some(number)
    }

    /// Reads a number in the byte order `order`. `order` lists the bytes in wire order; 0 is the most significant byte.
    pub fn ordered(&mut self, order: &[u8]) -> Option<u64> {
        let bytes = self.bytes(order.len())?;
        let last = order.len().saturating_sub(1);
        let number = bytes.iter().zip(order).fold(0, |number, (byte, &position)| {
            let shift = 8 * last.saturating_sub(position.into()) as u32;
            number | u64::from(*byte).checked_shl(shift).unwrap_or(0)
        });
        Some(number)
    }

    /// Reads a value of `length` bytes and returns the value in little-endian byte order. `length` is at most 8.
    ///
    /// `order` lists the bytes of the longest possible value in wire order; 0 is the most significant byte. A shorter
    /// value consists of the low bytes of the longest value, in the same order. A value is big-endian if it is longer
    /// than `order` or if `order` is empty.
    pub fn value(&mut self, order: &[u8], length: usize) -> Option<[u8; 8]> {
        let mut value = [0; 8];
        let bytes = self.bytes(length)?;
        for (at, byte) in bytes.iter().enumerate() {
            *value.get_mut(significance(order, length, at))? = *byte;
        }
        Some(value)
    }

    /// Reads all unread bytes except the last `tail` bytes.
    pub fn but(&mut self, tail: usize) -> Option<&'r [u8]> {
        self.bytes(self.left().checked_sub(tail)?)
    }

    /// Checks that all data have been read.
    pub fn end(&self) -> Option<()> {
        (self.bits == self.data.len() * 8).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_follow_each_other() {
        let data = [0x57, 0xAB, 0x34, 0x01, 0x02, 0xFD, 0xBE, 2, 9];
        let mut reader = Reader::new(&data);
        assert_eq!((reader.number(4), reader.number(3), reader.number(1)), (Some(5), Some(3), Some(1)));
        assert_eq!(reader.ordered(&[2, 3, 0, 1]), Some(0x0102_AB34));
        assert_eq!(reader.value(&[2, 3, 0, 1], 2), Some([0xBE, 0xFD, 0, 0, 0, 0, 0, 0]));
        assert_eq!((reader.echo(&[1, 2], 1, 1), reader.end()), (Some(()), None));
        assert_eq!((reader.but(2), reader.but(0), reader.end()), (None, Some(&[9][..]), Some(())));
        assert_eq!((reader.number(1), reader.bytes(1)), (None, None));
    }

    #[test]
    fn orders_of_values() {
        let of = |order: &[u8], length| -> [usize; 4] { core::array::from_fn(|at| significance(order, length, at)) };
        assert_eq!(of(&[2, 3, 0, 1], 4), [1, 0, 3, 2]);
        assert_eq!(of(&[2, 3, 0, 1], 2)[..2], [1, 0]);
        assert_eq!(of(&[3, 2, 1, 0], 2)[..2], [0, 1]);
        assert_eq!(of(&[], 4), [3, 2, 1, 0]);
        assert_eq!(of(&[1, 0], 4), [3, 2, 1, 0]);
        // Values with an empty `order` are big-endian.
        assert_eq!(of(&[5, 9], 2)[..2], [1, 0]);
    }

    #[test]
    fn copies_of_the_request() {
        let mut reader = Reader::new(&[3, 9, 0x2F]);
        assert_eq!((reader.copy(&[1, 2, 3], 2, 2), reader.fixed(4, 2), reader.fixed(4, 3)), (Some(()), Some(()), None));
        assert_eq!(Reader::new(&[4]).copy(&[1, 2, 3], 2, 1), None);
        let mut reader = Reader::new(&[3, 0, 9]);
        assert_eq!(
            (reader.fixed_in(&[1, 0], 3), reader.counted(1, 2), reader.counted(4, 0)),
            (Some(()), Some(()), None)
        );
    }

    #[test]
    fn numbers_across_bytes() {
        let mut reader = Reader::new(&[0b1010_1100, 0b0111_0000]);
        assert_eq!((reader.number(3), reader.number(9), reader.left()), (Some(0b101), Some(0b0_1100_0111), 0));
        assert_eq!((reader.end(), reader.number(4), reader.end()), (None, Some(0), Some(())));
    }
}
