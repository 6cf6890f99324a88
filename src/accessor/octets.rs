//! Methods that read and write byte strings.

use super::Accessor;
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::client::{AsyncClient, Client};
#[cfg(doc)]
use crate::error::Error;
use crate::location::On;
use crate::route::{ReadRoute, WriteRoute};
use crate::text::{Domain, OctetString, Opaque};

/// Defines the methods for byte strings, blocking and async.
macro_rules! octets {
    (
        $marker:ident: $Client:ident $fetch:ident $send:ident $read_into:ident $write:ident
        $($async:ident $await:ident)?
    ) => {
        impl<C, A: Readable, L> Accessor<'_, C, $marker, A, L> {
            /// Reads the byte string into `buffer` and returns the received bytes.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Length`] if the byte string is longer than `buffer`.
            pub $($async)? fn $read_into<'b>(&mut self, buffer: &'b mut [u8]) -> Result<&'b [u8], AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                self.$fetch(buffer)$(.$await)?.map_err(|error| self.read_failed(error))
            }
        }

        impl<C, A: Writable, L> Accessor<'_, C, $marker, A, L> {
            /// Writes the byte string.
            ///
            /// # Errors
            ///
            /// Returns only the errors of the client.
            pub $($async)? fn $write(&mut self, data: &[u8]) -> Result<(), AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                self.$send(data)$(.$await)?.map_err(|error| self.write_failed(error, None))
            }
        }
    };
    ($($marker:ident)*) => {$(
        octets! { $marker: Client fetch send read_into write }
        octets! { $marker: AsyncClient fetch_async send_async read_into_async write_async async await }
    )*};
}

octets! { OctetString Domain Opaque }

#[cfg(test)]
mod tests {
    use super::super::testing::{item, now, Device};
    use crate::{Domain, Error, LengthError, OctetString, Opaque, Rw};

    #[test]
    fn bytes_pass_unchanged() {
        let mut device = Device::answering(&[0, 1, 0]);
        let mut buffer = [0xAA; 8];
        assert_eq!(item::<OctetString, Rw>().at(&mut device).read_into(&mut buffer), Ok([0, 1, 0].as_slice()));
        assert_eq!(now(item::<Domain, Rw>().at(&mut device).read_into_async(&mut buffer)), Ok([0, 1, 0].as_slice()));
        assert_eq!(item::<Opaque, Rw>().at(&mut device).write(&[7; 20]), Ok(()));
        assert_eq!(device.written.take(), Some([7; 20].to_vec()));
        assert_eq!(now(item::<Domain, Rw>().at(&mut device).write_async(&[])), Ok(()));
        assert_eq!(device.written.as_deref(), Some([].as_slice()));
    }

    #[test]
    fn more_than_the_buffer_is_an_error() {
        let mut device = Device::answering(&[0; 9]);
        let error = Error::Length(LengthError { expected: 8, actual: 9 });
        assert_eq!(item::<Domain, Rw>().at(&mut device).read_into(&mut [0; 8]).map_err(Error::from), Err(error));
    }
}
