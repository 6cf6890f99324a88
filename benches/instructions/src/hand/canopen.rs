//! Handwritten structs for PDOs of up to eight bytes.

use super::{frame, part, StepMode};
use lexibus::LengthError;

/// A PDO with a 16-bit word and a 32-bit number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WordAndLong {
    /// Control word or status word.
    pub word: u16,
    /// Position.
    pub long: i32,
}

impl WordAndLong {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 6] {
        let mut frame = [0; 6];
        frame[0..2].copy_from_slice(&self.word.to_le_bytes());
        frame[2..6].copy_from_slice(&self.long.to_le_bytes());
        frame
    }

    /// Reads the fields of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 6] = frame(data)?;
        Ok(Self { word: u16::from_le_bytes(part(data, 0)), long: i32::from_le_bytes(part(data, 2)) })
    }
}

/// A full CAN frame of eight bytes: a word, a 32-bit number and a 16-bit number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Full {
    /// Status word.
    pub word: u16,
    /// Position.
    pub long: i32,
    /// Torque.
    pub short: i16,
}

impl Full {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 8] {
        let bits = u64::from(self.word) | u64::from(self.long as u32) << 16 | u64::from(self.short as u16) << 48;
        bits.to_le_bytes()
    }

    /// Reads the fields of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 8] = frame(data)?;
        let bits = u64::from_le_bytes(*data);
        Ok(Self { word: bits as u16, long: (bits >> 16) as i32, short: (bits >> 48) as i16 })
    }
}

/// A PDO with a 16-bit word and a mode of operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WordAndMode {
    /// Control word or status word.
    pub word: u16,
    /// Mode of operation.
    pub mode: StepMode,
}

impl WordAndMode {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 3] {
        let mut frame = [0; 3];
        frame[0..2].copy_from_slice(&self.word.to_le_bytes());
        frame[2] = self.mode.raw() as u8;
        frame
    }

    /// Reads the fields of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 3] = frame(data)?;
        Ok(Self { word: u16::from_le_bytes(part(data, 0)), mode: StepMode::from_raw(data[2] as i8) })
    }
}
