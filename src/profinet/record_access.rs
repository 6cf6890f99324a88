//! Typed access to records and to items in records, through a record client.

use super::record::RecordData;
use super::record_client::{AsyncRecordClient, RecordAddress, RecordClient, SubmoduleAddress};
use crate::bus::{Profinet, Record};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::value_error::LengthError;

/// Reads and writes records as structs, and individual items in records.
///
/// `N` is the size of the buffer in bytes. The buffer must hold the longest record.
///
/// ```
/// use lexibus::profinet::{RecordAccess, RecordClient, RecordData, SubmoduleAddress};
/// use lexibus::Error;
///
/// /// Reads a generated record, changes it and writes it back.
/// fn change<C: RecordClient, T: RecordData>(client: C, change: impl FnOnce(&mut T)) -> Result<(), Error<C::Error>> {
///     let mut records = RecordAccess::<_, 64>::new(client);
///     let input = SubmoduleAddress::new(0, 2, 1);
///     let mut record = records.read::<T>(input)?;
///     change(&mut record);
///     records.write(input, &record)
/// }
/// ```
///
/// `RecordAccess` implements [`Client`] if `C` is a [`RecordClient`], and [`AsyncClient`] if `C` is an
/// [`AsyncRecordClient`]. To write an item, `RecordAccess` reads the record, changes the item, and writes the whole
/// record. No other program may write the record between the read and the write. A read truncates a text to the length
/// of the caller's buffer.
///
/// A record that is longer than the buffer causes a compile-time error:
///
/// ```compile_fail,E0080
/// use lexibus::profinet::{FRecord, RecordAccess, RecordClient, RecordData, SubmoduleAddress};
///
/// fn read<C: RecordClient>(client: C) {
///     let _ = RecordAccess::<_, 4>::new(client).read::<Long>(SubmoduleAddress::new(0, 2, 1));
/// }
/// # struct Long;
/// # impl RecordData for Long {
/// #     const INDEX: u16 = 1;
/// #     const LEN: usize = 5;
/// #     const TRANSFER_SEQUENCE: u16 = 0;
/// #     fn decode(_: &[u8]) -> Result<Self, lexibus::LengthError> { Ok(Self) }
/// #     fn encode_into<'b>(&self, data: &'b mut [u8]) -> Result<&'b [u8], lexibus::profinet::RecordError> { Ok(data) }
/// # }
/// # struct Never;
/// # impl RecordClient for Never {
/// #     type Error = ();
/// #     fn read_record(&mut self, _: lexibus::profinet::RecordAddress, _: &mut [u8]) -> Result<usize, lexibus::Error<()>> { Ok(0) }
/// #     fn write_record(&mut self, _: lexibus::profinet::RecordAddress, _: &[u8]) -> Result<(), lexibus::Error<()>> { Ok(()) }
/// # }
/// # read(Never);
/// ```
#[derive(Clone, Debug)]
pub struct RecordAccess<C, const N: usize> {
    client: C,
    buffer: [u8; N],
}

impl<C, const N: usize> RecordAccess<C, N> {
    /// Creates a record access through `client`.
    pub const fn new(client: C) -> Self {
        Self { client, buffer: [0; N] }
    }

    /// Returns the client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the client and drops `self`.
    pub fn into_client(self) -> C {
        self.client
    }

    /// Returns the first `length` bytes of the buffer. `length` is the length that the client reported.
    fn filled(&self, length: usize) -> Result<&[u8], LengthError> {
        self.buffer.get(..length).ok_or(LengthError::new(N, length))
    }

    /// Reads an item. The buffer contains a record of `length` bytes.
    fn part(&self, length: usize, place: Record, value: &mut [u8]) -> Result<usize, LengthError> {
        let at = usize::from(place.offset);
        let rest = self.filled(length)?.get(at..).unwrap_or_default();
        let count = if place.is_bytes { value.len().min(rest.len()) } else { value.len() };
        let field = rest.get(..count).filter(|field| !field.is_empty() || value.is_empty());
        let field = field.ok_or(LengthError::new(at + value.len().max(1), length))?;
        copy(value, field, place.is_bytes);
        Ok(count)
    }

    /// Replaces an item. The buffer contains a record of `length` bytes.
    fn replace(&mut self, length: usize, place: Record, value: &[u8]) -> Result<&[u8], LengthError> {
        self.filled(length)?;
        let at = usize::from(place.offset);
        let error = LengthError::new(at + value.len(), length);
        let record = self.buffer.get_mut(..length).ok_or(error)?;
        let to = record.get_mut(at..).and_then(|rest| rest.get_mut(..value.len())).ok_or(error)?;
        copy(to, value, place.is_bytes);
        Ok(record)
    }
}

/// Copies a value between a big-endian record and a little-endian client buffer. Byte strings keep their byte order.
fn copy(to: &mut [u8], from: &[u8], is_bytes: bool) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
    if !is_bytes {
        to.reverse();
    }
}

/// A compile-time check that a record fits into the buffer.
struct Fits<T, const N: usize>(core::marker::PhantomData<T>);

impl<T: RecordData, const N: usize> Fits<T, N> {
    const CHECKED: () = assert!(T::LEN <= N, "the record is longer than the buffer of its `RecordAccess`");
}

impl From<Record> for RecordAddress {
    fn from(part: Record) -> Self {
        Self { api: part.api, slot: part.slot, subslot: part.subslot, index: part.index }
    }
}

macro_rules! access {
    ($RecordClient:ident $Client:ident: $read:ident $write:ident $($async:ident $await:ident)?) => {
        impl<C: $RecordClient, const N: usize> RecordAccess<C, N> {
            /// Reads the record `T` of a submodule.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`RecordClient::read_record`], or [`Error::Length`] if the device's record is
            /// shorter than `T` or longer than the buffer.
            pub $($async)? fn $read<T: RecordData>(&mut self, submodule: SubmoduleAddress) -> Result<T, Error<C::Error>> {
                let () = Fits::<T, N>::CHECKED;
                let length = self.client.read_record(submodule.record(T::INDEX), &mut self.buffer)$(.$await)??;
                Ok(T::decode(self.filled(length)?)?)
            }

            /// Writes the record `T` of a submodule.
            ///
            /// # Errors
            ///
            /// Returns [`Error::NotAllowed`] if a field has a value that isn't allowed; the record isn't sent. Also
            /// returns the errors of [`RecordClient::write_record`].
            pub $($async)? fn $write<T: RecordData>(
                &mut self,
                submodule: SubmoduleAddress,
                record: &T,
            ) -> Result<(), Error<C::Error>> {
                let () = Fits::<T, N>::CHECKED;
                let data = record.encode_into(&mut self.buffer)?;
                self.client.write_record(submodule.record(T::INDEX), data)$(.$await)?
            }
        }

        impl<C: $RecordClient, const N: usize> $Client for RecordAccess<C, N> {
            type Bus = Profinet;
            type Error = C::Error;

            $($async)? fn read(&mut self, address: Record, buffer: &mut [u8]) -> Result<usize, Error<C::Error>> {
                let length = self.client.read_record(address.into(), &mut self.buffer)$(.$await)??;
                Ok(self.part(length, address, buffer)?)
            }

            $($async)? fn write(&mut self, address: Record, data: &[u8]) -> Result<(), Error<C::Error>> {
                let length = self.client.read_record(address.into(), &mut self.buffer)$(.$await)??;
                self.replace(length, address, data)?;
                let record = self.buffer.get(..length).unwrap_or_default();
                self.client.write_record(address.into(), record)$(.$await)?
            }
        }
    };
}

access! { RecordClient Client: read write }
access! { AsyncRecordClient AsyncClient: read_async write_async async await }
