//! Modbus registers and the encoding of values in them.

use crate::pdo::mask;
use crate::value::byte_len;
use crate::value_error::LengthError;

/// The four address tables of Modbus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RegisterTable {
    /// Holding registers (4x), accessed by the functions 3, 6, 16, 22 and 23.
    #[default]
    Holding,
    /// Input registers (3x), accessed by function 4.
    Input,
    /// Coils (0x), which are single bits, accessed by the functions 1, 5 and 15.
    Coil,
    /// Discrete inputs (1x), which are single bits, accessed by function 2.
    DiscreteInput,
}

impl RegisterTable {
    /// Returns the term for one entry of the table, for example "holding register".
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Holding => "holding register",
            Self::Input => "input register",
            Self::Coil => "coil",
            Self::DiscreteInput => "discrete input",
        }
    }
}

/// Order of the registers of one value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum WordOrder {
    /// A number with its most significant word at the lowest address.
    #[default]
    HighFirst,
    /// A number with its least significant word at the lowest address.
    LowFirst,
    /// A text or a byte string. The upper half of the register at the lowest address contains the first byte.
    Bytes,
}

/// A bit field of a number in one or more registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RegisterPart {
    /// Bit offset; bit 0 is the least significant bit.
    pub first: u8,
    /// Length in bits.
    pub bits: u8,
}

/// One or more consecutive registers or bits of a Modbus table.
///
/// A [`Client`](crate::Client) transfers a number as bytes, the least significant byte first. Modbus transmits words.
/// [`Register::decode`] and [`Register::encode`] convert between the two forms:
///
/// ```
/// use lexibus::Register;
///
/// const POSITION: Register = Register::low_first(8, 2);
/// let mut bytes = [0; 4];
/// assert_eq!(POSITION.decode(&[0x5678, 0x1234], &mut bytes), Ok(4));
/// assert_eq!(u32::from_le_bytes(bytes), 0x1234_5678);
///
/// let mut words = [0; 2];
/// POSITION.encode(&0x1234_5678_u32.to_le_bytes(), &mut words)?;
/// assert_eq!(words, [0x5678, 0x1234]);
/// # Ok::<(), lexibus::LengthError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Register {
    /// Table of the register.
    pub table: RegisterTable,
    /// Wire address of the first register, zero-based.
    pub address: u16,
    /// Number of 16-bit registers that contain the value. For coils and discrete inputs: number of bits.
    pub count: u16,
    /// Order of the registers.
    pub order: WordOrder,
    /// True if the two bytes of each register are swapped.
    pub bytes_swapped: bool,
    /// Bit field of the number that contains the value, or `None` if the value is the whole number. To write a bit
    /// field, a client first reads the registers, unless it uses function 22.
    pub part: Option<RegisterPart>,
    /// Number of 16-bit registers per address: 1 on most devices, 2 on devices with one address per 32-bit register.
    /// With 2 registers per address, a 32-bit value at `address` is followed by the next value at `address + 1`.
    pub words_per_address: u8,
    /// True if a number with fewer bytes than its registers is sign-extended; false if the number is padded with zeros.
    pub sign_extended: bool,
}

impl Register {
    /// Creates the address of a number in `count` registers or bits, with the most significant word first.
    #[must_use]
    pub const fn new(table: RegisterTable, address: u16, count: u16) -> Self {
        Self {
            table,
            address,
            count,
            order: WordOrder::HighFirst,
            bytes_swapped: false,
            part: None,
            words_per_address: 1,
            sign_extended: false,
        }
    }

    /// Creates the address of a value in one holding register.
    #[must_use]
    pub const fn holding(address: u16) -> Self {
        Self::new(RegisterTable::Holding, address, 1)
    }

    /// Creates the address of a number in `count` holding registers, with the most significant word first.
    #[must_use]
    pub const fn high_first(address: u16, count: u16) -> Self {
        Self::new(RegisterTable::Holding, address, count)
    }

    /// Creates the address of a number in `count` holding registers, with the least significant word first.
    #[must_use]
    pub const fn low_first(address: u16, count: u16) -> Self {
        Self { order: WordOrder::LowFirst, ..Self::new(RegisterTable::Holding, address, count) }
    }

    /// Returns the same registers with this word order.
    #[must_use]
    pub const fn ordered(self, order: WordOrder) -> Self {
        Self { order, ..self }
    }

    /// Returns the same registers with the two bytes of each register swapped.
    #[must_use]
    pub const fn swapped(self) -> Self {
        Self { bytes_swapped: true, ..self }
    }

    /// Returns the bit field with `bits` bits at bit offset `first` of the number.
    #[must_use]
    pub const fn part(self, first: u8, bits: u8) -> Self {
        Self { part: Some(RegisterPart { first, bits }), ..self }
    }

    /// Returns the same registers for a device with `words` registers per address.
    #[must_use]
    pub const fn words_per_address(self, words: u8) -> Self {
        Self { words_per_address: words, ..self }
    }

    /// Returns the same registers for a signed number with fewer bytes than the registers. A write fills the upper
    /// bytes with the sign bit.
    ///
    /// ```
    /// use lexibus::Register;
    ///
    /// let mut words = [0; 2];
    /// Register::high_first(0x8001, 2).sign_extended().encode(&(-50_i8).to_le_bytes(), &mut words)?;
    /// assert_eq!(words, [0xFFFF, 0xFFCE]);
    /// # Ok::<(), lexibus::LengthError>(())
    /// ```
    #[must_use]
    pub const fn sign_extended(self) -> Self {
        Self { sign_extended: true, ..self }
    }

    /// Returns how many addresses the value occupies.
    ///
    /// ```
    /// use lexibus::Register;
    ///
    /// assert_eq!(Register::high_first(8, 2).addresses(), 2);
    /// assert_eq!(Register::high_first(0x8009, 2).words_per_address(2).addresses(), 1);
    /// ```
    #[must_use]
    pub const fn addresses(&self) -> u16 {
        self.count.div_ceil(self.step())
    }

    /// Returns the number of registers, or bits, per address.
    pub(crate) const fn step(&self) -> u16 {
        match (self.table, self.words_per_address) {
            (RegisterTable::Coil | RegisterTable::DiscreteInput, _) | (_, 0) => 1,
            (_, words) => words as u16,
        }
    }

    /// Returns the number of words at the first address that precede the value. For example, the lower half of a 32-bit
    /// register is the second word if the most significant word comes first.
    pub(crate) const fn skipped(&self) -> usize {
        match self.order {
            WordOrder::HighFirst => (self.addresses() as usize * self.step() as usize) - self.count as usize,
            WordOrder::LowFirst | WordOrder::Bytes => 0,
        }
    }

    /// Decodes the value in `words`, writes it to the start of `buffer` and returns its length in bytes. A number
    /// starts with its least significant byte, a text with its first byte.
    ///
    /// If a number is longer than `buffer`, its upper bytes are discarded, for example the upper byte of a register
    /// with a one-byte value. A text isn't truncated. For a text, the returned length is the length of the whole text,
    /// as [`Client::read`](crate::Client::read) requires.
    ///
    /// Coils and discrete inputs don't need this method. Modbus messages and `buffer` have the same bit order: the
    /// first bit is the lowest bit of the first byte.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`], in bytes, if the number of `words` isn't [`count`](Register::count). Also returns
    /// [`LengthError`] if the value is a bit field in a number of more than four words.
    pub fn decode(&self, words: &[u16], buffer: &mut [u8]) -> Result<usize, LengthError> {
        self.check(words)?;
        let length = 2 * words.len();
        if let Some(part) = self.part {
            let bits = self.number(words)? >> (part.first & 63) & mask(part.bits.into());
            let filled = buffer.len().min(byte_len(part.bits.into()));
            buffer.iter_mut().zip(bits.to_le_bytes()).take(filled).for_each(|(to, from)| *to = from);
            return Ok(filled);
        }
        for (pair, at) in buffer.chunks_mut(2).zip(0..words.len()) {
            let bytes = self.bytes(words.get(self.position(at, words.len())).copied().unwrap_or_default());
            pair.iter_mut().zip(bytes).for_each(|(to, from)| *to = from);
        }
        Ok(if self.order == WordOrder::Bytes { length } else { length.min(buffer.len()) })
    }

    /// Encodes the value in `data` into `words`, in the format of [`decode`](Register::decode). Missing bytes are 0. If
    /// the register is [`sign_extended`](Register::sign_extended), missing bytes are filled with the sign bit. If the
    /// value is a [`part`](Register::part), `words` must contain the current registers, and only the bits of the part
    /// change.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`], in bytes, if the number of `words` isn't [`count`](Register::count), or if `data` is
    /// longer than `words`. Also returns [`LengthError`] if the value is a bit field in a number of more than four
    /// words.
    pub fn encode(&self, data: &[u8], words: &mut [u16]) -> Result<(), LengthError> {
        self.check(words)?;
        let count = words.len();
        if data.len() > 2 * count {
            return Err(LengthError::new(2 * count, data.len()));
        }
        let Some(part) = self.part else {
            let is_negative = self.sign_extended && data.last().is_some_and(|last| last & 0x80 != 0);
            let beyond = if is_negative { 0xFF } else { 0 };
            for at in 0..count {
                let byte = |offset: usize| data.get(2 * at + offset).copied().unwrap_or(beyond);
                if let Some(word) = words.get_mut(self.position(at, count)) {
                    *word = self.word([byte(0), byte(1)]);
                }
            }
            return Ok(());
        };
        let (first, bits) = (part.first & 63, mask(part.bits.into()));
        let mut value = [0; 8];
        value.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        let number = self.number(words)? & !(bits << first) | (u64::from_le_bytes(value) & bits) << first;
        for (at, pair) in (0..count).zip(number.to_le_bytes().chunks(2)) {
            if let (Some(word), Ok(pair)) = (words.get_mut(self.position(at, count)), pair.try_into()) {
                *word = self.word(pair);
            }
        }
        Ok(())
    }

    fn check(&self, words: &[u16]) -> Result<(), LengthError> {
        let count = usize::from(self.count);
        if words.len() == count {
            Ok(())
        } else {
            Err(LengthError::new(2 * count, 2 * words.len()))
        }
    }

    /// Returns the position of a word among the `count` words of a value. For a number, the least significant word has
    /// `at` 0. For a text, the first word has `at` 0.
    const fn position(&self, at: usize, count: usize) -> usize {
        match self.order {
            WordOrder::HighFirst => count - 1 - at,
            WordOrder::LowFirst | WordOrder::Bytes => at,
        }
    }

    /// Returns the bytes of a word in the byte order of the value.
    const fn bytes(&self, word: u16) -> [u8; 2] {
        if self.is_big_endian() {
            word.to_be_bytes()
        } else {
            word.to_le_bytes()
        }
    }

    const fn word(&self, bytes: [u8; 2]) -> u16 {
        if self.is_big_endian() {
            u16::from_be_bytes(bytes)
        } else {
            u16::from_le_bytes(bytes)
        }
    }

    /// Returns whether the upper half of a word comes first in the value. The upper half comes first in texts without
    /// swapped bytes and in numbers with swapped bytes.
    const fn is_big_endian(&self) -> bool {
        matches!(self.order, WordOrder::Bytes) != self.bytes_swapped
    }

    fn number(&self, words: &[u16]) -> Result<u64, LengthError> {
        const WORDS: usize = 4;
        if words.len() > WORDS {
            return Err(LengthError::new(2 * WORDS, 2 * words.len()));
        }
        let mut bytes = [0; 2 * WORDS];
        for (at, pair) in (0..words.len()).zip(bytes.chunks_mut(2)) {
            let word = words.get(self.position(at, words.len())).copied().unwrap_or_default();
            pair.copy_from_slice(&self.bytes(word));
        }
        Ok(u64::from_le_bytes(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn round_trip(register: Register, words: &[u16], data: &[u8]) {
        let (mut buffer, mut back) = ([0xAA; 16], [0; 8]);
        let count = words.len();
        assert_eq!(register.decode(words, &mut buffer[..data.len()]), Ok(data.len()));
        assert_eq!(&buffer[..data.len()], data);
        assert_eq!(register.encode(data, &mut back[..count]), Ok(()));
        assert_eq!(&back[..count], words);
    }

    #[test]
    fn numbers_of_several_words() {
        round_trip(Register::holding(0), &[0x1234], &[0x34, 0x12]);
        round_trip(Register::high_first(0, 2), &[0x1234, 0x5678], &[0x78, 0x56, 0x34, 0x12]);
        round_trip(Register::low_first(0, 2), &[0x5678, 0x1234], &[0x78, 0x56, 0x34, 0x12]);
        round_trip(Register::low_first(0, 2).swapped(), &[0x7856, 0x3412], &[0x78, 0x56, 0x34, 0x12]);
        round_trip(Register::high_first(0, 2).swapped(), &[0x3412, 0x7856], &[0x78, 0x56, 0x34, 0x12]);
        round_trip(Register::high_first(0, 4), &[1, 2, 3, 4], &[4, 0, 3, 0, 2, 0, 1, 0]);
    }

    #[test]
    fn a_byte_is_the_lower_half_of_its_register() {
        round_trip(Register::holding(0), &[0x0012], &[0x12]);
        round_trip(Register::high_first(0, 2), &[0x0012, 0x3456], &[0x56, 0x34, 0x12]);
        let mut byte = [0];
        assert_eq!(Register::holding(0).decode(&[0xFF12], &mut byte), Ok(1));
        assert_eq!(byte, [0x12]);
    }

    #[test]
    fn short_numbers_fill_their_registers() {
        let signed = Register::high_first(0, 2).sign_extended();
        for (data, expected) in [([0xCE, 0xFF], [0xFFFF, 0xFFCE]), ([0xCE, 0x00], [0, 0x00CE])] {
            round_trip(signed, &expected, &data);
        }
        let mut words = [0; 2];
        assert_eq!(signed.ordered(WordOrder::LowFirst).encode(&[0x80], &mut words), Ok(()));
        assert_eq!(words, [0xFF80, 0xFFFF]);
        assert_eq!(signed.encode(&[], &mut words), Ok(()));
        assert_eq!(words, [0, 0]);
    }

    #[test]
    fn texts_run_on() {
        let text = Register::new(RegisterTable::Holding, 0, 2).ordered(WordOrder::Bytes);
        round_trip(text, &[0x4142, 0x4344], b"ABCD");
        round_trip(text.swapped(), &[0x4241, 0x4443], b"ABCD");
        let mut words = [0xFFFF; 2];
        assert_eq!(text.encode(b"A", &mut words), Ok(()));
        assert_eq!(words, [0x4100, 0]);
        // The caller compares the length with its buffer and detects that the text doesn't fit.
        assert_eq!(text.decode(&[0x4142, 0x4344], &mut [0; 3]), Ok(4));
    }

    #[test]
    fn parts_leave_the_rest_alone() {
        let part = Register::holding(0).part(4, 8);
        let mut byte = [0];
        assert_eq!(part.decode(&[0xABCD], &mut byte), Ok(1));
        assert_eq!(byte, [0xBC]);
        let mut words = [0xABCD];
        assert_eq!(part.encode(&[0x12], &mut words), Ok(()));
        assert_eq!(words, [0xA12D]);
        let across = Register::high_first(0, 2).part(12, 8);
        let mut words = [0xFFF0, 0x0FFF];
        assert_eq!(across.encode(&[0x5A], &mut words), Ok(()));
        assert_eq!(words, [0xFFF5, 0xAFFF]);
        assert_eq!(across.decode(&words, &mut byte), Ok(1));
        assert_eq!(byte, [0x5A]);
        assert!(Register::high_first(0, 5).part(0, 1).decode(&[0; 5], &mut byte).is_err());
        assert!(Register::holding(0).part(255, 255).decode(&[0], &mut [0; 64]).is_ok());
    }

    #[test]
    fn other_lengths_are_errors() {
        let register = Register::high_first(0, 2);
        assert_eq!(register.decode(&[1], &mut [0; 4]), Err(LengthError::new(4, 2)));
        assert_eq!(register.encode(&[0; 4], &mut [0; 3]), Err(LengthError::new(4, 6)));
        assert_eq!(register.encode(&[0; 5], &mut [0; 2]), Err(LengthError::new(4, 5)));
        assert_eq!(register.decode(&[1, 2], &mut [0; 9]), Ok(4));
    }
}
