//! Handwritten structs for EtherCAT process data.

use super::{frame, part, AxisMode};
use lexibus::LengthError;

/// A 3-bit mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// 0.
    Off,
    /// 1.
    Position,
    /// 3.
    Velocity,
    /// 4.
    Torque,
    /// A mode whose number has no name.
    Unknown(u8),
}

impl Mode {
    /// Returns the mode with this number.
    #[inline]
    pub fn from_raw(raw: u8) -> Self {
        match raw {
            0 => Self::Off,
            1 => Self::Position,
            3 => Self::Velocity,
            4 => Self::Torque,
            other => Self::Unknown(other),
        }
    }

    /// Returns the number of the mode.
    #[inline]
    pub fn raw(self) -> u8 {
        match self {
            Self::Off => 0,
            Self::Position => 1,
            Self::Velocity => 3,
            Self::Torque => 4,
            Self::Unknown(other) => other,
        }
    }
}

/// A PDO of 48 bits with single bits, an enumeration, a 24-bit number, and a byte-aligned 16-bit number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    /// Bit 0.
    pub ready: bool,
    /// Bits 1 to 3.
    pub mode: Mode,
    /// Bit 4.
    pub referenced: bool,
    /// Bits 5 to 28, signed.
    pub position: i64,
    /// Bit 29.
    pub overflow: bool,
    /// Bits 30 and 31.
    pub quality: u64,
    /// Bits 32 to 47.
    pub speed: i16,
}

impl Encoder {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 6] {
        let bits = u32::from(self.ready)
            | u32::from(self.mode.raw() & 7) << 1
            | u32::from(self.referenced) << 4
            | (self.position as u32 & 0xFF_FFFF) << 5
            | u32::from(self.overflow) << 29
            | (self.quality as u32 & 3) << 30;
        let mut frame = [0; 6];
        frame[0..4].copy_from_slice(&bits.to_le_bytes());
        frame[4..6].copy_from_slice(&self.speed.to_le_bytes());
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
        let bits = u32::from_le_bytes(part(data, 0));
        Ok(Self {
            ready: bits & 1 != 0,
            mode: Mode::from_raw((bits >> 1 & 7) as u8),
            referenced: bits >> 4 & 1 != 0,
            position: i64::from((bits << 3) as i32 >> 8),
            overflow: bits >> 29 & 1 != 0,
            quality: u64::from(bits >> 30),
            speed: i16::from_le_bytes(part(data, 4)),
        })
    }
}

/// A PDO of more than eight bytes with byte-aligned fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetPoints {
    /// Bytes 0 and 1.
    pub controlword: u16,
    /// Byte 2. Byte 3 is padding.
    pub mode: AxisMode,
    /// Bytes 4 to 7.
    pub position: i32,
    /// Bytes 8 to 11.
    pub velocity: i32,
    /// Bytes 12 and 13.
    pub torque: i16,
}

impl SetPoints {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 14] {
        let mut frame = [0; 14];
        frame[0..2].copy_from_slice(&self.controlword.to_le_bytes());
        frame[2] = self.mode.raw() as u8;
        frame[4..8].copy_from_slice(&self.position.to_le_bytes());
        frame[8..12].copy_from_slice(&self.velocity.to_le_bytes());
        frame[12..14].copy_from_slice(&self.torque.to_le_bytes());
        frame
    }

    /// Reads the fields of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 14] = frame(data)?;
        Ok(Self {
            controlword: u16::from_le_bytes(part(data, 0)),
            mode: AxisMode::from_raw(data[2] as i8),
            position: i32::from_le_bytes(part(data, 4)),
            velocity: i32::from_le_bytes(part(data, 8)),
            torque: i16::from_le_bytes(part(data, 12)),
        })
    }
}

/// A PDO of 96 bits in which most numbers are not byte-aligned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActualValues {
    /// Bits 0 to 15.
    pub statusword: u16,
    /// Bit 16.
    pub limit: bool,
    /// Bits 17 to 19.
    pub mode: Mode,
    /// Bits 20 to 51.
    pub position: i32,
    /// Bits 52 to 83.
    pub velocity: i32,
    /// Bits 84 to 95.
    pub current: u64,
}

impl ActualValues {
    /// Returns the bytes of a frame.
    #[inline]
    pub fn pack(&self) -> [u8; 12] {
        let velocity = self.velocity as u32;
        let low = u64::from(self.statusword)
            | u64::from(self.limit) << 16
            | u64::from(self.mode.raw() & 7) << 17
            | u64::from(self.position as u32) << 20
            | u64::from(velocity) << 52;
        let high = velocity >> 12 | (self.current as u32) << 20;
        let mut frame = [0; 12];
        frame[0..8].copy_from_slice(&low.to_le_bytes());
        frame[8..12].copy_from_slice(&high.to_le_bytes());
        frame
    }

    /// Reads the fields of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 12] = frame(data)?;
        let low = u64::from_le_bytes(part(data, 0));
        let high = u32::from_le_bytes(part(data, 8));
        Ok(Self {
            statusword: low as u16,
            limit: low >> 16 & 1 != 0,
            mode: Mode::from_raw((low >> 17 & 7) as u8),
            position: (low >> 20) as i32,
            velocity: ((low >> 52) as u32 | high << 12) as i32,
            current: u64::from(high >> 20),
        })
    }
}

/// A process image that contains [`Encoder`], directly followed by [`ActualValues`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// Bytes 0 to 5.
    pub encoder: Encoder,
    /// Bytes 6 to 17.
    pub actual_values: ActualValues,
}

impl Image {
    /// Returns the bytes of the image.
    #[inline]
    pub fn pack(&self) -> [u8; 18] {
        let mut image = [0; 18];
        image[0..6].copy_from_slice(&self.encoder.pack());
        image[6..18].copy_from_slice(&self.actual_values.pack());
        image
    }

    /// Reads the fields of the image.
    ///
    /// # Errors
    ///
    /// Returns an error if the image is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 18] = frame(data)?;
        Ok(Self { encoder: Encoder::unpack(&data[0..6])?, actual_values: ActualValues::unpack(&data[6..18])? })
    }
}
