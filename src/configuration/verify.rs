//! Compares a configuration with the values of a device.

use core::fmt;

use super::{Configuration, Phase, Setting};
use crate::bus::{Bus, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;
use crate::pdo::{Hexadecimal, SdoWrite};
use crate::value_error::LengthError;

/// An object whose value differs from the configuration or cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference<'d, E> {
    /// The object and its configured value.
    pub expected: SdoWrite,
    /// The value of the device, or the reason why the value could not be read. [`Error::Length`] means that the value
    /// is longer than the configured value, or that the buffer is too short.
    pub found: Result<&'d [u8], Error<E>>,
}

impl<E: fmt::Display> fmt::Display for Difference<'_, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: expected {}, ", self.expected.object(), Hexadecimal(self.expected.data()))?;
        match &self.found {
            Ok(found) => write!(f, "found {}", Hexadecimal(found)),
            Err(error) => write!(f, "but cannot read the value: {error}"),
        }
    }
}

impl Configuration {
    /// Reads the configured objects of the device with this node-ID, and calls `report` for each object whose value
    /// differs or cannot be read. Returns the number of these objects. Write-only objects are skipped.
    ///
    /// `buffer` must have at least the length of the [longest value](Self::longest_value). If the value of the device
    /// is longer than the configured value, the difference contains [`Error::Length`].
    ///
    /// # Errors
    ///
    /// Returns the error of the client if the bus fails or the device doesn't reply in time. Any other error, for
    /// example a refused access, is reported in [`Difference::found`].
    pub fn verify<C: Client>(
        self,
        client: &mut C,
        node_id: NodeId,
        buffer: &mut [u8],
        mut report: impl FnMut(Difference<'_, C::Error>),
    ) -> Result<usize, Error<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        let mut differences = 0;
        for expected in self.expected(node_id) {
            let result = match value_buffer(buffer, expected) {
                Ok(buffer) => client.read(expected.object(), buffer),
                Err(error) => Err(error.into()),
            };
            differences += usize::from(compare(expected, result, buffer, &mut report)?);
        }
        Ok(differences)
    }

    /// Compares the values of the device through an asynchronous client, as [`verify`](Self::verify) does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`verify`](Self::verify).
    pub async fn verify_async<C: AsyncClient>(
        self,
        client: &mut C,
        node_id: NodeId,
        buffer: &mut [u8],
        mut report: impl FnMut(Difference<'_, C::Error>),
    ) -> Result<usize, Error<C::Error>>
    where
        C::Bus: Bus<Address = Object>,
    {
        let mut differences = 0;
        for expected in self.expected(node_id) {
            let result = match value_buffer(buffer, expected) {
                Ok(buffer) => client.read(expected.object(), buffer).await,
                Err(error) => Err(error.into()),
            };
            differences += usize::from(compare(expected, result, buffer, &mut report)?);
        }
        Ok(differences)
    }

    /// Returns the expected values: the last write to each object, except write-only objects.
    pub(super) fn expected(self, node_id: NodeId) -> impl Iterator<Item = SdoWrite> {
        self.settings()
            .filter(move |(_, setting)| !setting.is_write_only && self.is_last(setting))
            .map(move |(_, setting)| setting.resolve(node_id))
    }

    /// Returns whether no later setting writes to the same object. COB-IDs and numbers of mapped objects, for example, are
    /// written twice.
    fn is_last(self, setting: &'static Setting) -> bool {
        let is_same = |(_, other): &(Phase, &Setting)| other.write.object() == setting.write.object();
        self.settings().filter(is_same).last().is_some_and(|(_, last)| core::ptr::eq(last, setting))
    }
}

/// Returns the first bytes of the buffer, as many as the expected value has, or an error if the buffer is too short.
fn value_buffer(buffer: &mut [u8], expected: SdoWrite) -> Result<&mut [u8], LengthError> {
    let (length, available) = (expected.data().len(), buffer.len());
    buffer.get_mut(..length).ok_or(LengthError::new(length, available))
}

/// Compares the result of reading an object with its configured value. Calls `report` and returns true if the values
/// differ or the object cannot be read. Returns an error if the bus fails or the device doesn't reply in time.
fn compare<E>(
    expected: SdoWrite,
    result: Result<usize, Error<E>>,
    buffer: &[u8],
    report: &mut impl FnMut(Difference<'_, E>),
) -> Result<bool, Error<E>> {
    let longest = expected.data().len();
    let found = match result {
        Err(error @ (Error::Client(_) | Error::Timeout)) => return Err(error),
        Err(error) => Err(error),
        Ok(length) if length > longest => Err(Error::Length(LengthError::new(longest, length))),
        Ok(length) => buffer.get(..length).ok_or(Error::Length(LengthError::new(length, buffer.len()))),
    };
    let differs = !matches!(found, Ok(found) if found == expected.data());
    if differs {
        report(Difference { expected, found });
    }
    Ok(differs)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{AsyncStore, Store, CONFIGURATION, NODE};
    use super::*;
    use crate::abort::AbortCode;
    use crate::now::now;
    use std::string::{String, ToString};
    use std::vec::Vec;

    /// Returns a device with the values of `CONFIGURATION`.
    fn configured() -> Store {
        let mut device = Store::default();
        CONFIGURATION.apply(&mut device, NODE, |_| ()).unwrap();
        device
    }

    fn differences(device: &mut Store, buffer: &mut [u8]) -> Vec<String> {
        let mut differences = Vec::new();
        let mut report = |difference: Difference<'_, ()>| {
            let Difference { expected, found } = difference;
            // `Error<()>` has no `Display`.
            let found = found.map_err(|error| match error {
                Error::Abort(code) => Error::<AbortCode>::Abort(code),
                Error::Length(error) => Error::Length(error),
                _ => Error::UnexpectedReply,
            });
            differences.push(Difference { expected, found }.to_string());
        };
        let count = CONFIGURATION.verify(device, NODE, buffer, &mut report).unwrap();
        assert_eq!(count, differences.len());
        differences
    }

    #[test]
    fn a_configured_device_has_no_differences() {
        let mut device = configured();
        // A write-only object is not read.
        device.refused = Some(Object::new(0x2001, 0));
        assert_eq!(differences(&mut device, &mut [0; 9]), [""; 0]);
    }

    #[test]
    fn finds_each_difference() {
        let mut device = configured();
        device.set(Object::new(0x1800, 1), &[0x85, 1, 0, 0]);
        device.set(Object::new(0x1017, 0), &[0xE8]);
        device.set(Object::new(0x2000, 0), b"longer text");
        device.set(Object::new(0x1600, 0), &[0]);
        device.refused = Some(Object::new(0x1400, 2));
        let expected = [
            "0x1800:01: expected 0x80000185, found 0x00000185",
            "0x1017:00: expected 0x03E8, found 0xE8",
            "0x2000:00: expected [6C, 6F, 6E, 67, 20, 74, 65, 78, 74], but cannot read the value: expected 9 bytes, got 11",
            "0x1600:00: expected 0x01, found 0x00",
            "0x1400:02: expected 0x01, but cannot read the value: the device refused: 0x06010002: attempt to write a \
             read-only object",
        ];
        assert_eq!(differences(&mut device, &mut [0; 9]), expected);
    }

    #[test]
    fn a_short_buffer_is_a_difference() {
        let text = "0x2000:00: expected [6C, 6F, 6E, 67, 20, 74, 65, 78, 74], but cannot read the value: expected 9 bytes, got 4";
        assert_eq!(differences(&mut configured(), &mut [0; 4]), [text]);
    }

    #[test]
    fn the_bus_fails() {
        let mut device = configured();
        device.failing = Some(Object::new(0x1600, 1));
        device.set(Object::new(0x1017, 0), &[0, 0]);
        let mut reported = 0;
        let result = CONFIGURATION.verify(&mut device, NODE, &mut [0; 9], |_| reported += 1);
        assert_eq!((result, reported), (Err(Error::Client(())), 1));
    }

    #[test]
    fn without_blocking() {
        let mut device = AsyncStore(configured());
        let count = now(CONFIGURATION.verify_async(&mut device, NODE, &mut [0; 9], |_| ()));
        assert_eq!(count, Ok(0));
        device.0.set(Object::new(0x1017, 0), &[0, 0]);
        let mut found = None;
        let count = now(CONFIGURATION.verify_async(&mut device, NODE, &mut [0; 9], |difference| {
            found = Some((difference.expected, difference.found.map(<[u8]>::to_vec)));
        }));
        assert_eq!((count, found), (Ok(1), Some((SdoWrite::new_u16(0x1017, 0, 1000), Ok([0, 0].to_vec())))));
        // The value equals the default of the description, so it is left out.
        let configuration = CONFIGURATION.without_defaults();
        assert_eq!(now(configuration.verify_async(&mut device, NODE, &mut [0; 9], |_| ())), Ok(0));
    }
}
