//! Methods that read and write texts.

use super::Accessor;
use crate::access::{Readable, Writable};
use crate::access_error::AccessError;
use crate::client::{AsyncClient, Client};
#[cfg(doc)]
use crate::error::Error;
use crate::location::On;
use crate::route::{ReadRoute, WriteRoute};
use crate::text::{decode_visible, encode_utf16, encode_visible, UnicodeString, Utf16, VisibleString};

/// Defines the methods for texts, blocking and async.
macro_rules! texts {
    ($Client:ident $fetch:ident $send:ident: $read_into:ident $write:ident $($async:ident $await:ident)?) => {
        impl<C, A: Readable, L> Accessor<'_, C, VisibleString, A, L> {
            /// Reads the text into `buffer`. The text ends before the first NUL, because devices pad texts of a fixed
            /// length with NULs.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Length`] if the text is longer than `buffer`, or [`Error::Text`] if the text isn't
            /// valid UTF-8.
            pub $($async)? fn $read_into<'b>(&mut self, buffer: &'b mut [u8]) -> Result<&'b str, AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                let bytes = self.$fetch(buffer)$(.$await)?;
                let text = bytes.and_then(|bytes| Ok(decode_visible(bytes)?));
                text.map_err(|error| self.read_failed(error))
            }
        }

        impl<C, A: Writable, L> Accessor<'_, C, VisibleString, A, L> {
            /// Writes the text.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Text`] if a character is outside the range 0x20 to 0x7E; the text isn't sent.
            pub $($async)? fn $write(&mut self, text: &str) -> Result<(), AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                let sent = match encode_visible(text) {
                    Ok(bytes) => self.$send(bytes)$(.$await)?,
                    Err(error) => Err(error.into()),
                };
                sent.map_err(|error| self.write_failed(error, None))
            }
        }

        impl<C, A: Readable, L> Accessor<'_, C, UnicodeString, A, L> {
            /// Reads the text into `buffer`, two bytes per code unit. The text ends before the first NUL.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Length`] if the text is longer than `buffer`, or [`Error::Text`] if the text isn't
            /// valid UTF-16.
            pub $($async)? fn $read_into<'b>(&mut self, buffer: &'b mut [u8]) -> Result<Utf16<'b>, AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: ReadRoute<C::Bus>>,
            {
                let bytes = self.$fetch(buffer)$(.$await)?;
                let text = bytes.and_then(|bytes| Ok(Utf16::new(bytes)?));
                text.map_err(|error| self.read_failed(error))
            }
        }

        impl<C, A: Writable, L> Accessor<'_, C, UnicodeString, A, L> {
            /// Writes the text. The method encodes the text into `scratch`, two bytes per code unit.
            ///
            /// # Errors
            ///
            /// Returns [`Error::Length`] if `scratch` is too short; the text isn't sent.
            pub $($async)? fn $write(&mut self, text: &str, scratch: &mut [u8]) -> Result<(), AccessError<C::Error>>
            where
                C: $Client,
                L: On<C::Bus, Route: WriteRoute<C::Bus>>,
            {
                let sent = match encode_utf16(text, scratch) {
                    Ok(bytes) => self.$send(bytes)$(.$await)?,
                    Err(error) => Err(error.into()),
                };
                sent.map_err(|error| self.write_failed(error, None))
            }
        }
    };
}

texts! { Client fetch send: read_into write }
texts! { AsyncClient fetch_async send_async: read_into_async write_async async await }

#[cfg(test)]
mod tests {
    use super::super::testing::{item, now, Device};
    use crate::{Error, LengthError, Rw, TextError, UnicodeString, VisibleString};

    #[test]
    fn visible_text() {
        let mut device = Device::answering(b"Drive\0");
        let name = item::<VisibleString, Rw>();
        let mut buffer = [0; 6];
        assert_eq!(name.at(&mut device).read_into(&mut buffer), Ok("Drive"));
        assert_eq!(now(name.at(&mut device).read_into_async(&mut buffer)), Ok("Drive"));
        let long = Error::Length(LengthError { expected: 5, actual: 6 });
        assert_eq!(name.at(&mut device).read_into(&mut buffer[..5]).map_err(Error::from), Err(long));
        assert_eq!(name.at(&mut device).write("save"), Ok(()));
        assert_eq!(device.written.as_deref(), Some(b"save".as_slice()));
    }

    #[test]
    fn invalid_visible_text_is_not_sent() {
        let mut device = Device::default();
        let name = item::<VisibleString, Rw>();
        assert_eq!(name.at(&mut device).write("5°").map_err(Error::from), Err(Error::Text(TextError)));
        assert_eq!(now(name.at(&mut device).write_async("5°")).map_err(Error::from), Err(Error::Text(TextError)));
        assert_eq!(device.written, None);
    }

    #[test]
    fn unicode_text() {
        let mut device = Device::answering(&[b'5', 0, 0xB0, 0]);
        let label = item::<UnicodeString, Rw>();
        let mut buffer = [0; 4];
        assert_eq!(label.at(&mut device).read_into(&mut buffer).unwrap(), "5°");
        assert_eq!(now(label.at(&mut device).read_into_async(&mut buffer)).unwrap(), "5°");
        assert_eq!(label.at(&mut device).write("°", &mut buffer), Ok(()));
        assert_eq!(device.written.take().as_deref(), Some([0xB0, 0].as_slice()));
        let short = Error::Length(LengthError { expected: 6, actual: 4 });
        assert_eq!(now(label.at(&mut device).write_async("abc", &mut buffer)).map_err(Error::from), Err(short));
        assert_eq!(device.written, None);
    }
}
