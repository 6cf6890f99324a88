//! Cyclic data of a submodule, and the status of these data.

use crate::value_error::LengthError;

/// The inputs or outputs of a submodule as a struct. Generated code implements this trait.
pub trait IoData: Sized {
    /// Length of the user data in bytes.
    const LEN: usize;

    /// Length in bytes of the F-message trailer (PROFIsafe), which follows the user data; 0 if there is no trailer.
    const TRAILER_LEN: usize;

    /// Length in bytes of the provider status, which follows the user data and the trailer.
    const STATUS_LEN: usize;

    /// Decodes the user data. Bytes after the user data are ignored.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` has fewer than [`IoData::LEN`] bytes.
    fn unpack(data: &[u8]) -> Result<Self, LengthError>;

    /// Writes the fields to the first [`IoData::LEN`] bytes of `data`. Bits without a field are set to 0.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` has fewer than [`IoData::LEN`] bytes.
    fn pack_into(&self, data: &mut [u8]) -> Result<(), LengthError>;
}

/// The status of a submodule's data. The provider (IOPS) or the consumer (IOCS) of the data sets the status.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IoStatus(pub u8);

impl IoStatus {
    /// The data are valid.
    pub const GOOD: Self = Self(0x80);

    /// The data are invalid, and the subslot reports this status.
    pub const BAD: Self = Self(0x00);

    /// Returns whether the data are valid (bit 7).
    #[must_use]
    pub const fn is_good(self) -> bool {
        self.0 & 0x80 != 0
    }

    /// Returns which instance reports invalid data (bits 5 and 6): 0 the subslot, 1 the slot, 2 the device, 3 the
    /// controller.
    #[must_use]
    pub const fn instance(self) -> u8 {
        self.0 >> 5 & 3
    }

    /// Returns the status in the first byte. Returns [`IoStatus::BAD`] if `bytes` is empty.
    #[must_use]
    pub const fn from_bytes(bytes: &[u8]) -> Self {
        match bytes.first() {
            Some(first) => Self(*first),
            None => Self::BAD,
        }
    }

    /// Writes the status to every byte of `bytes`. Bit 0 is set in every byte except the last one, to indicate that
    /// another byte follows.
    pub fn write(self, bytes: &mut [u8]) {
        let last = bytes.len().saturating_sub(1);
        for (place, byte) in bytes.iter_mut().enumerate() {
            *byte = self.0 & 0xFE | u8::from(place < last);
        }
    }
}

/// The parts of a submodule's data in a frame, for reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IoObject<'a> {
    /// User data.
    pub data: &'a [u8],
    /// F-message trailer; empty if the submodule isn't a safety submodule.
    pub trailer: &'a [u8],
    /// Provider status.
    pub status: &'a [u8],
}

impl<'a> IoObject<'a> {
    /// Splits `object` into its parts. `object` starts with the user data of `T`.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `object` is too short for user data, trailer and status.
    pub fn of<T: IoData>(object: &'a [u8]) -> Result<Self, LengthError> {
        let actual = object.len();
        let split = |part: &'a [u8], at| part.split_at_checked(at).ok_or(too_short::<T>(actual));
        let (data, rest) = split(object, T::LEN)?;
        let (trailer, rest) = split(rest, T::TRAILER_LEN)?;
        let (status, _) = split(rest, T::STATUS_LEN)?;
        Ok(Self { data, trailer, status })
    }

    /// Returns the provider status.
    #[must_use]
    pub const fn provider(&self) -> IoStatus {
        IoStatus::from_bytes(self.status)
    }
}

/// The parts of a submodule's data in a frame, for writing.
#[derive(Debug, PartialEq, Eq)]
pub struct IoObjectMut<'a> {
    /// User data.
    pub data: &'a mut [u8],
    /// F-message trailer; empty if the submodule isn't a safety submodule.
    pub trailer: &'a mut [u8],
    /// Provider status.
    pub status: &'a mut [u8],
}

impl<'a> IoObjectMut<'a> {
    /// Splits `object` into its parts. `object` starts with the user data of `T`.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `object` is too short for user data, trailer and status.
    pub fn of<T: IoData>(object: &'a mut [u8]) -> Result<Self, LengthError> {
        let error = too_short::<T>(object.len());
        let (data, rest) = object.split_at_mut_checked(T::LEN).ok_or(error)?;
        let (trailer, rest) = rest.split_at_mut_checked(T::TRAILER_LEN).ok_or(error)?;
        let (status, _) = rest.split_at_mut_checked(T::STATUS_LEN).ok_or(error)?;
        Ok(Self { data, trailer, status })
    }
}

const fn too_short<T: IoData>(actual: usize) -> LengthError {
    LengthError::new(T::LEN + T::TRAILER_LEN + T::STATUS_LEN, actual)
}

/// User data with their provider status, which follows the data in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WithStatus<T> {
    /// User data.
    pub data: T,
    /// Provider status (IOPS).
    pub provider: IoStatus,
}

impl<T: IoData> WithStatus<T> {
    /// Length in bytes of user data, F-message trailer and provider status.
    pub const LEN: usize = T::LEN + T::TRAILER_LEN + T::STATUS_LEN;

    /// Reads the user data and their status from the start of `object`.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `object` has fewer than [`WithStatus::LEN`] bytes.
    pub fn read(object: &[u8]) -> Result<Self, LengthError> {
        let parts = IoObject::of::<T>(object)?;
        Ok(Self { data: T::unpack(parts.data)?, provider: parts.provider() })
    }

    /// Writes the user data and their status to the start of `object`. The safety layer must write the F-message
    /// trailer.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `object` has fewer than [`WithStatus::LEN`] bytes.
    pub fn write(&self, object: &mut [u8]) -> Result<(), LengthError> {
        let parts = IoObjectMut::of::<T>(object)?;
        self.data.pack_into(parts.data)?;
        self.provider.write(parts.status);
        Ok(())
    }
}

/// The F-message trailer (PROFIsafe). The trailer consists of the status byte of inputs or the control byte of outputs,
/// and of a CRC of 3 or 4 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FTrailer {
    /// Status byte of inputs, or control byte of outputs.
    pub status: u8,
    /// CRC2, in the low 24 bits or in all 32 bits.
    pub crc: u32,
}

impl FTrailer {
    /// Decodes a trailer.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] unless `bytes` has 4 or 5 bytes.
    pub const fn from_bytes(bytes: &[u8]) -> Result<Self, LengthError> {
        match *bytes {
            [status, a, b, c] => Ok(Self { status, crc: u32::from_be_bytes([0, a, b, c]) }),
            [status, a, b, c, d] => Ok(Self { status, crc: u32::from_be_bytes([a, b, c, d]) }),
            _ => Err(LengthError::new(4, bytes.len())),
        }
    }

    /// Writes the trailer to `bytes`.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] unless `bytes` has 4 or 5 bytes.
    pub fn write(self, bytes: &mut [u8]) -> Result<(), LengthError> {
        let [a, b, c, d] = self.crc.to_be_bytes();
        match bytes {
            [to @ .., _] if to.len() == 3 => bytes.copy_from_slice(&[self.status, b, c, d]),
            [to @ .., _] if to.len() == 4 => bytes.copy_from_slice(&[self.status, a, b, c, d]),
            _ => return Err(LengthError::new(4, bytes.len())),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Outputs with 2 bytes of user data, 4 bytes of trailer and 1 byte of status.
    #[derive(Debug, PartialEq)]
    struct Safe(u16);

    impl IoData for Safe {
        const LEN: usize = 2;
        const TRAILER_LEN: usize = 4;
        const STATUS_LEN: usize = 1;

        fn unpack(data: &[u8]) -> Result<Self, LengthError> {
            let bytes = data.first_chunk().ok_or(LengthError::new(2, data.len()))?;
            Ok(Self(u16::from_be_bytes(*bytes)))
        }

        fn pack_into(&self, data: &mut [u8]) -> Result<(), LengthError> {
            let error = LengthError::new(2, data.len());
            *data.first_chunk_mut().ok_or(error)? = self.0.to_be_bytes();
            Ok(())
        }
    }

    const OBJECT: [u8; 8] = [0x12, 0x34, 0x20, 0xAA, 0xBB, 0xCC, 0x80, 0x77];

    #[test]
    fn data_and_status_are_read_together() {
        let read = WithStatus::<Safe>::read(&OBJECT).unwrap();
        assert_eq!(read, WithStatus { data: Safe(0x1234), provider: IoStatus::GOOD });
        assert_eq!(WithStatus::<Safe>::read(&OBJECT[..6]), Err(LengthError::new(7, 6)));
    }

    #[test]
    fn the_trailer_is_no_user_data() {
        let parts = IoObject::of::<Safe>(&OBJECT).unwrap();
        assert_eq!((parts.data, parts.status), (&OBJECT[..2], &OBJECT[6..7]));
        assert_eq!(FTrailer::from_bytes(parts.trailer), Ok(FTrailer { status: 0x20, crc: 0x00AA_BBCC }));
        let mut object = OBJECT;
        WithStatus { data: Safe(0x5678), provider: IoStatus::BAD }.write(&mut object).unwrap();
        assert_eq!(object, [0x56, 0x78, 0x20, 0xAA, 0xBB, 0xCC, 0x00, 0x77]);
        let parts = IoObjectMut::of::<Safe>(&mut object).unwrap();
        FTrailer { status: 1, crc: 0x02_0304 }.write(parts.trailer).unwrap();
        assert_eq!(object, [0x56, 0x78, 0x01, 0x02, 0x03, 0x04, 0x00, 0x77]);
    }

    #[test]
    fn trailers_have_four_or_five_bytes() {
        let mut bytes = [0; 5];
        let trailer = FTrailer { status: 1, crc: 0x0203_0405 };
        trailer.write(&mut bytes).unwrap();
        assert_eq!(bytes, [1, 2, 3, 4, 5]);
        assert_eq!(FTrailer::from_bytes(&bytes), Ok(trailer));
        assert_eq!(FTrailer::from_bytes(&bytes[..3]), Err(LengthError::new(4, 3)));
        assert_eq!(trailer.write(&mut bytes[..3]), Err(LengthError::new(4, 3)));
        assert_eq!(trailer.write(&mut []), Err(LengthError::new(4, 0)));
    }

    #[test]
    fn status() {
        assert!(IoStatus::GOOD.is_good() && !IoStatus::BAD.is_good());
        assert_eq!(IoStatus(0x60).instance(), 3);
        assert_eq!(IoStatus::from_bytes(&[]), IoStatus::BAD);
        let mut two = [0; 2];
        IoStatus::GOOD.write(&mut two);
        assert_eq!(two, [0x81, 0x80]);
        IoStatus::GOOD.write(&mut []);
    }
}
