//! SDO writes that configure a device.

use core::fmt;

use super::word::{from_bytes, mask, to_bytes};
use crate::bus::{Bus, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;

/// An SDO write: an object, and the value to write. A configuration is a list of SDO writes.
///
/// ```
/// use lexibus::SdoWrite;
///
/// assert_eq!(SdoWrite::new_u32(0x1400, 1, 0x8000_0205).to_string(), "0x1400:01 = 0x80000205");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct SdoWrite {
    object: Object,
    data: Data,
}

/// The bytes of a value. A value of at most 8 bytes is always `Short`, so equal values compare as equal.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Data {
    /// A value of at most 8 bytes, and its length. Further bytes are 0.
    Short([u8; 8], u8),
    Long(&'static [u8]),
}

impl SdoWrite {
    /// Creates a write of an UNSIGNED8.
    #[must_use]
    pub const fn new_u8(index: u16, sub_index: u8, value: u8) -> Self {
        Self::new(index, sub_index, value as u64, 1)
    }

    /// Creates a write of an UNSIGNED16.
    #[must_use]
    pub const fn new_u16(index: u16, sub_index: u8, value: u16) -> Self {
        Self::new(index, sub_index, value as u64, 2)
    }

    /// Creates a write of an UNSIGNED32.
    #[must_use]
    pub const fn new_u32(index: u16, sub_index: u8, value: u32) -> Self {
        Self::new(index, sub_index, value as u64, 4)
    }

    /// Creates a write of an UNSIGNED64.
    #[must_use]
    pub const fn new_u64(index: u16, sub_index: u8, value: u64) -> Self {
        Self::new(index, sub_index, value, 8)
    }

    /// Creates a write of an already encoded value of any type and length. The least significant byte of a
    /// number comes first.
    #[must_use]
    pub const fn new_bytes(index: u16, sub_index: u8, value: &'static [u8]) -> Self {
        match value.len() {
            len @ 0..=8 => Self::new(index, sub_index, from_bytes(value), len as u8),
            _ => Self { object: Object { index, sub_index }, data: Data::Long(value) },
        }
    }

    const fn new(index: u16, sub_index: u8, value: u64, len: u8) -> Self {
        Self { object: Object { index, sub_index }, data: Data::Short(to_bytes(value), len) }
    }

    /// Returns the write with the node-ID added to its value. The sum wraps around at the length of the value. A value of
    /// more than 8 bytes stays the same.
    pub(crate) const fn plus_node_id(self, node: NodeId) -> Self {
        let Data::Short(data, len) = self.data else { return self };
        let sum = from_bytes(&data).wrapping_add(node.get() as u64);
        Self { object: self.object, data: Data::Short(to_bytes(sum & mask(8 * len as u32)), len) }
    }

    /// Returns the object to write.
    #[must_use]
    pub const fn object(&self) -> Object {
        self.object
    }

    /// Returns the bytes to write.
    #[must_use]
    pub const fn data(&self) -> &[u8] {
        match &self.data {
            Data::Short(data, len) => data.split_at(*len as usize).0,
            Data::Long(data) => data,
        }
    }

    /// Writes the value through a CANopen or CoE client.
    ///
    /// # Errors
    ///
    /// Returns the error of the client, with this write.
    pub fn send<C: Client>(&self, client: &mut C) -> Result<(), SdoWriteError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        client.write(self.object, self.data()).map_err(|error| SdoWriteError { write: *self, error })
    }

    /// Writes the value through an asynchronous client, as [`send`](Self::send) does.
    ///
    /// # Errors
    ///
    /// Returns the error of the client, with this write.
    pub async fn send_async<C: AsyncClient>(&self, client: &mut C) -> Result<(), SdoWriteError<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        client.write(self.object, self.data()).await.map_err(|error| SdoWriteError { write: *self, error })
    }
}

/// An [`SdoWrite`] that failed. The operator `?` converts this error to [`Error`], which contains only the reason.
///
/// ```
/// use lexibus::{AbortCode, Error, SdoWrite, SdoWriteError};
///
/// let write = SdoWrite::new_u32(0x1400, 1, 0x8000_0205);
/// let error = SdoWriteError { write, error: Error::<core::fmt::Error>::Abort(AbortCode::READ_ONLY) };
/// let text = "write 0x1400:01 = 0x80000205: the device refused: 0x06010002: attempt to write a read-only object";
/// assert_eq!(error.to_string(), text);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SdoWriteError<E> {
    /// The object and the value.
    pub write: SdoWrite,
    /// Reason why the write failed.
    pub error: Error<E>,
}

impl<E: fmt::Display> fmt::Display for SdoWriteError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "write {}: {}", self.write, self.error)
    }
}

impl<E: core::error::Error> core::error::Error for SdoWriteError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        self.error.source()
    }
}

impl<E> From<SdoWriteError<E>> for Error<E> {
    fn from(error: SdoWriteError<E>) -> Self {
        error.error
    }
}

impl fmt::Display for SdoWrite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.object, Hexadecimal(self.data()))
    }
}

/// Formats the bytes of a value: a value of 1 to 8 bytes as a number, any other value byte by byte.
pub(crate) struct Hexadecimal<'d>(pub &'d [u8]);

impl fmt::Display for Hexadecimal<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [] => f.write_str("[]"),
            number if number.len() <= 8 => write!(f, "0x{:0digits$X}", from_bytes(number), digits = 2 * number.len()),
            bytes => write!(f, "{bytes:02X?}"),
        }
    }
}

impl fmt::Debug for SdoWrite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SdoWrite({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CoE;
    use std::format;
    use std::string::ToString;

    #[derive(Default)]
    struct Last(Option<(Object, usize)>);

    impl Client for Last {
        type Bus = CoE;
        type Error = ();

        fn read(&mut self, _: Object, _: &mut [u8]) -> Result<usize, Error<()>> {
            Err(Error::UnexpectedReply)
        }

        fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<()>> {
            self.0 = Some((address, data.len()));
            Ok(())
        }
    }

    #[test]
    fn data_is_little_endian() {
        assert_eq!(SdoWrite::new_u8(0x1600, 0, 2).data(), [2]);
        assert_eq!(SdoWrite::new_u16(0x1400, 3, 0x0102).data(), [2, 1]);
        assert_eq!(SdoWrite::new_u32(0x1400, 1, 0x8000_0205).data(), [5, 2, 0, 0x80]);
        assert_eq!(format!("{:?}", SdoWrite::new_u16(0x1400, 3, 0xA)), "SdoWrite(0x1400:03 = 0x000A)");
    }

    #[test]
    fn bytes_of_any_length() {
        assert_eq!(SdoWrite::new_bytes(0x2000, 1, &[1, 2]), SdoWrite::new_u16(0x2000, 1, 0x0201));
        assert_eq!(SdoWrite::new_u64(0x2000, 1, 3).data(), [3, 0, 0, 0, 0, 0, 0, 0]);
        let long = SdoWrite::new_bytes(0x2000, 1, b"\x0123456789");
        assert_eq!(long.data(), b"\x0123456789");
        assert_eq!(long.to_string(), "0x2000:01 = [01, 32, 33, 34, 35, 36, 37, 38, 39]");
        assert_eq!(SdoWrite::new_bytes(0x2000, 1, b"").to_string(), "0x2000:01 = []");
    }

    #[test]
    fn the_node_id_is_added_within_the_length() {
        let node = NodeId::new(127).unwrap();
        assert_eq!(SdoWrite::new_u32(0x1400, 1, 0x8000_0200).plus_node_id(node).data(), [0x7F, 2, 0, 0x80]);
        assert_eq!(SdoWrite::new_u8(0x2000, 0, 0x81).plus_node_id(node).data(), [0]);
        assert_eq!(SdoWrite::new_u64(0x2000, 0, u64::MAX).plus_node_id(node).data(), [126, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(SdoWrite::new_bytes(0x2000, 0, b"").plus_node_id(node).data(), []);
        assert_eq!(SdoWrite::new_bytes(0x2000, 0, b"123456789").plus_node_id(node).data(), b"123456789");
    }

    #[test]
    fn sends() {
        let mut client = Last::default();
        assert_eq!(SdoWrite::new_u16(0x1400, 3, 1).send(&mut client), Ok(()));
        assert_eq!(client.0, Some((Object { index: 0x1400, sub_index: 3 }, 2)));
    }
}
