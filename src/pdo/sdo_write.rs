//! SDO writes that configure a device.

use core::fmt;

use super::word::{from_bytes, to_bytes};
use crate::bus::{Bus, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;

/// A write of at most 8 bytes to an object. A configuration is a list of SDO writes.
///
/// ```
/// use lexibus::SdoWrite;
///
/// assert_eq!(SdoWrite::new_u32(0x1400, 1, 0x8000_0205).to_string(), "0x1400:01 = 0x80000205");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct SdoWrite {
    object: Object,
    data: [u8; 8],
    len: u8,
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

    const fn new(index: u16, sub_index: u8, value: u64, len: u8) -> Self {
        Self { object: Object { index, sub_index }, data: to_bytes(value), len }
    }

    /// Returns the object to write.
    #[must_use]
    pub const fn object(&self) -> Object {
        self.object
    }

    /// Returns the bytes to write.
    #[must_use]
    pub const fn data(&self) -> &[u8] {
        self.data.split_at(self.len as usize).0
    }

    /// Writes the value through a CANopen or CoE client.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client.
    pub fn send<C: Client>(&self, client: &mut C) -> Result<(), Error<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        client.write(self.object, self.data())
    }

    /// Writes the value through an asynchronous client, as [`send`](Self::send) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of the client.
    pub async fn send_async<C: AsyncClient>(&self, client: &mut C) -> Result<(), Error<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        client.write(self.object, self.data()).await
    }
}

impl fmt::Display for SdoWrite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = 2 * usize::from(self.len);
        write!(f, "{} = 0x{:0digits$X}", self.object, from_bytes(self.data()))
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
    fn sends() {
        let mut client = Last::default();
        assert_eq!(SdoWrite::new_u16(0x1400, 3, 1).send(&mut client), Ok(()));
        assert_eq!(client.0, Some((Object { index: 0x1400, sub_index: 3 }, 2)));
    }
}
