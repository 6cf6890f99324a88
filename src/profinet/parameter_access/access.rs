//! Parameter access through a record client.

use super::error::ParameterError;
use super::format::ParameterValue;
use super::request::{change_request, read_request, Change, ParameterAddress};
use super::response::Response;
use crate::error::Error;
use crate::profinet::record_client::{AsyncRecordClient, RecordAddress, RecordClient, SubmoduleAddress};

/// Index of the record for parameters of the axis to which the submodule belongs.
pub const LOCAL: u16 = 0xB02E;

/// Index of the record for parameters of any axis.
pub const GLOBAL: u16 = 0xB02F;

/// Application process identifier (API) of PROFIdrive.
pub const API: u32 = 0x3A00;

/// Maximum length in bytes of a request or response when a [`ParameterAccess`] method accesses a single parameter.
/// Every drive supports a parameter channel of this length.
pub const BLOCK_LEN: usize = 240;

/// Default number of attempts to read a response.
const POLLS: u32 = 200;

/// Reads and changes drive parameters through a submodule that has a parameter record. The methods with the suffix
/// `_async` don't block.
///
/// Each method that accesses parameters writes a request, and then reads the record until the drive provides the
/// response. The method repeats the read if the record is empty or if the client reports that the device is busy
/// ([`RecordClient::is_busy`]). Between two reads, the method calls [`RecordClient::pause`].
/// [`with_polls`](Self::with_polls) limits the number of reads. A drive processes only one request at a time.
///
/// # Errors
///
/// - The errors of the client, including the error for a busy device if the device is still busy at the last attempt.
/// - [`Error::Timeout`] if the record is still empty after the last attempt.
/// - [`Error::ParameterAccess`] if the drive refuses the request, or if the request or the response is invalid.
/// - [`Error::Length`] if a request exceeds the buffer, or if a response is incomplete or exceeds the buffer.
#[derive(Clone, Debug)]
pub struct ParameterAccess<C> {
    client: C,
    record: RecordAddress,
    polls: u32,
    reference: u8,
}

impl<C> ParameterAccess<C> {
    /// Creates an access through the record [`LOCAL`] of a submodule. The submodule must belong to the PROFIdrive
    /// application process. In most drives, the slot is the slot of the axis, and the subslot is 1.
    pub const fn new(client: C, slot: u16, subslot: u16) -> Self {
        Self::with_record(client, SubmoduleAddress::new(API, slot, subslot).record(LOCAL))
    }

    /// Creates an access through any other record, such as [`GLOBAL`], a vendor-specific record, or a record with
    /// another API.
    pub const fn with_record(client: C, record: RecordAddress) -> Self {
        Self { client, record, polls: POLLS, reference: 0 }
    }

    /// Returns the access with at most `polls` attempts to read a response. The value 0 has the same effect as 1.
    #[must_use]
    pub fn with_polls(self, polls: u32) -> Self {
        Self { polls, ..self }
    }

    /// Returns the client.
    pub fn client(&mut self) -> &mut C {
        &mut self.client
    }

    /// Returns the client and drops `self`.
    pub fn into_client(self) -> C {
        self.client
    }

    /// Returns the reference for the next request. References run from 1 to 255, and then restart at 1.
    pub fn next_reference(&mut self) -> u8 {
        self.reference = self.reference.checked_add(1).unwrap_or(1);
        self.reference
    }

    /// Encodes a request that reads values of one parameter.
    fn reading<'b>(
        &mut self,
        buffer: &'b mut [u8],
        axis: u8,
        address: ParameterAddress,
    ) -> Result<&'b [u8], ParameterError> {
        read_request(buffer, self.next_reference(), axis, &[address])
    }

    /// Encodes a request that changes values of one parameter.
    fn changing<'b, T: ParameterValue + Copy>(
        &mut self,
        buffer: &'b mut [u8],
        axis: u8,
        address: ParameterAddress,
        values: &[T],
    ) -> Result<&'b [u8], ParameterError> {
        let mut bytes = [0; BLOCK_LEN];
        let mut length = 0;
        for value in values {
            let encoded = value.to_bytes();
            let encoded = encoded.as_ref();
            let to = bytes.get_mut(length..).and_then(|rest| rest.get_mut(..encoded.len()));
            to.ok_or(ParameterError::Values(T::FORMAT))?.copy_from_slice(encoded);
            length += encoded.len();
        }
        let change = Change::new(address, T::FORMAT, bytes.get(..length).unwrap_or_default());
        change_request(buffer, self.next_reference(), axis, &[change])
    }
}

fn elements<T: ParameterValue>(values: &[T]) -> Result<u8, ParameterError> {
    u8::try_from(values.len()).ok().filter(|count| *count > 0).ok_or(ParameterError::Values(T::FORMAT))
}

/// Copies the values of a response with one parameter to `to`.
fn copy<T: ParameterValue>(response: &Response<'_>, to: &mut [T]) -> Result<(), ParameterError> {
    let values = response.values()?;
    for (place, to) in to.iter_mut().enumerate() {
        *to = values.get(place)?;
    }
    Ok(())
}

/// Evaluates an attempt to read a response. The inner result is the length of the response, or the error to return if
/// this was the last attempt. An outer error means that no further attempt follows.
fn response_length<E>(
    outcome: Result<usize, Error<E>>,
    is_busy: impl FnOnce(&E) -> bool,
) -> Result<Result<usize, Error<E>>, Error<E>> {
    match outcome {
        Ok(0) => Ok(Err(Error::Timeout)),
        Ok(length) => Ok(Ok(length)),
        Err(Error::Client(error)) if is_busy(&error) => Ok(Err(Error::Client(error))),
        Err(error) => Err(error),
    }
}

/// Decodes the response in the first `length` bytes of `buffer`.
fn decoded<'b, E>(request: &[u8], buffer: &'b [u8], length: usize) -> Result<Response<'b>, Error<E>> {
    let data = buffer.get(..length).ok_or(crate::LengthError::new(buffer.len(), length))?;
    Ok(Response::decode(request, data)?)
}

macro_rules! calls {
    (
        $RecordClient:ident: $read:ident $read_array:ident $write:ident $write_array:ident $request:ident
        $($async:ident $await:ident)?
    ) => {
        impl<C: $RecordClient> ParameterAccess<C> {
            /// Reads one value of a parameter of `axis`. If the parameter isn't an array, pass `subindex` 0.
            pub $($async)? fn $read<T: ParameterValue>(
                &mut self,
                axis: u8,
                pnu: u16,
                subindex: u16,
            ) -> Result<T, Error<C::Error>> {
                let (mut request, mut response) = ([0; BLOCK_LEN], [0; BLOCK_LEN]);
                let request = self.reading(&mut request, axis, ParameterAddress::value(pnu, subindex))?;
                Ok(self.$request(request, &mut response)$(.$await)??.values()?.get(0)?)
            }

            /// Reads consecutive elements of an array, starting at `subindex`. The length of `values` is the number of
            /// elements.
            pub $($async)? fn $read_array<T: ParameterValue>(
                &mut self,
                axis: u8,
                pnu: u16,
                subindex: u16,
                values: &mut [T],
            ) -> Result<(), Error<C::Error>> {
                let (mut request, mut response) = ([0; BLOCK_LEN], [0; BLOCK_LEN]);
                let address = ParameterAddress::values(pnu, subindex, elements(values)?);
                let request = self.reading(&mut request, axis, address)?;
                Ok(copy(&self.$request(request, &mut response)$(.$await)??, values)?)
            }

            /// Changes one value of a parameter of `axis`.
            pub $($async)? fn $write<T: ParameterValue + Copy>(
                &mut self,
                axis: u8,
                pnu: u16,
                subindex: u16,
                value: T,
            ) -> Result<(), Error<C::Error>> {
                self.$write_array(axis, pnu, subindex, &[value])$(.$await)?
            }

            /// Changes consecutive elements of an array, starting at `subindex`.
            pub $($async)? fn $write_array<T: ParameterValue + Copy>(
                &mut self,
                axis: u8,
                pnu: u16,
                subindex: u16,
                values: &[T],
            ) -> Result<(), Error<C::Error>> {
                let (mut request, mut response) = ([0; BLOCK_LEN], [0; BLOCK_LEN]);
                let address = ParameterAddress::values(pnu, subindex, elements(values)?);
                let request = self.changing(&mut request, axis, address, values)?;
                Ok(self.$request(request, &mut response)$(.$await)??.done()?)
            }

            /// Sends a request and returns the response, which borrows `buffer`. Create the request with
            /// [`read_request`] or [`change_request`] and the [next reference](Self::next_reference). If the drive
            /// refuses a parameter, the response contains the refusal.
            pub $($async)? fn $request<'b>(
                &mut self,
                request: &[u8],
                buffer: &'b mut [u8],
            ) -> Result<Response<'b>, Error<C::Error>> {
                self.client.write_record(self.record, request)$(.$await)??;
                let mut left = self.polls.max(1);
                loop {
                    let outcome = self.client.read_record(self.record, buffer)$(.$await)?;
                    match response_length(outcome, |error| self.client.is_busy(error))? {
                        Ok(length) => return decoded(request, buffer, length),
                        Err(error) if left == 1 => return Err(error),
                        Err(_) => left -= 1,
                    }
                    self.client.pause()$(.$await)?;
                }
            }
        }
    };
}

calls! { RecordClient: read read_array write write_array request }
calls! {
    AsyncRecordClient: read_async read_array_async write_async write_array_async request_async async await
}
