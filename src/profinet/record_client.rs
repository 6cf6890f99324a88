//! Record clients. Adapters to controller libraries implement the traits of this module.

use super::plan::{Plan, RecordWrite};
use crate::error::Error;

/// Address of a submodule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubmoduleAddress {
    /// Application process identifier (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
}

impl SubmoduleAddress {
    /// Creates the address of the submodule in `subslot` of `slot`.
    #[must_use]
    pub const fn new(api: u32, slot: u16, subslot: u16) -> Self {
        Self { api, slot, subslot }
    }

    /// Returns the address of record `index` of this submodule.
    #[must_use]
    pub const fn record(self, index: u16) -> RecordAddress {
        RecordAddress { api: self.api, slot: self.slot, subslot: self.subslot, index }
    }
}

/// Address of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RecordAddress {
    /// Application process identifier (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Index of the record.
    pub index: u16,
}

impl RecordWrite<'_> {
    /// Returns the address of the record.
    #[must_use]
    pub const fn address(&self) -> RecordAddress {
        RecordAddress { api: self.api, slot: self.slot, subslot: self.subslot, index: self.index }
    }
}

impl<const N: usize> Plan<N> {
    /// Returns the address of the submodule in `subslot` of `slot`. Returns `None` if the subslot is empty.
    #[must_use]
    pub fn address(&self, slot: u16, subslot: u16) -> Option<SubmoduleAddress> {
        self.submodule(slot, subslot).map(|submodule| SubmoduleAddress::new(submodule.api, slot, subslot))
    }
}

/// A client that reads and writes records of one device. The client blocks until the response arrives.
///
/// [`RecordAccess`](super::RecordAccess) uses this trait for typed records.
/// [`ParameterAccess`](super::parameter_access::ParameterAccess) uses this trait for PROFIdrive parameters.
///
/// ```
/// use std::collections::HashMap;
///
/// use lexibus::profinet::{PnioStatus, RecordAccess, RecordAddress, RecordClient, SubmoduleAddress};
/// use lexibus::{Error, LengthError};
///
/// /// A simulated device.
/// struct Memory(HashMap<RecordAddress, Vec<u8>>);
///
/// impl RecordClient for Memory {
///     type Error = PnioStatus;
///
///     fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
///         let data = self.0.get(&address).ok_or(Error::Client(PnioStatus(0xDE80_B000)))?;
///         let length = LengthError::new(buffer.len(), data.len());
///         buffer.get_mut(..data.len()).ok_or(length)?.copy_from_slice(data);
///         Ok(data.len())
///     }
///
///     fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
///         self.0.insert(address, data.to_vec());
///         Ok(())
///     }
/// }
///
/// let mut device = Memory(HashMap::new());
/// let setup = SubmoduleAddress::new(0, 1, 1).record(16);
/// device.write_record(setup, &[0x01, 0xF4])?;
/// let mut buffer = [0; 8];
/// assert_eq!(device.read_record(setup, &mut buffer)?, 2);
/// # Ok::<(), Error<PnioStatus>>(())
/// ```
pub trait RecordClient {
    /// Error type of the client. The error type covers communication errors and refusals by the device
    /// ([`PnioStatus`](super::PnioStatus)).
    type Error;

    /// Reads the record at `address` into `buffer` and returns the length of the record in bytes.
    ///
    /// If the record is longer than `buffer`, implementations return the length of the record or an error. If a record
    /// is too long, the content of `buffer` is unspecified.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Client`] if the bus fails or the device refuses the access, or [`Error::Length`] if the record
    /// is too long.
    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the record at `address`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read_record`](Self::read_record).
    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Returns whether an error of [`read_record`](Self::read_record) means that the response isn't available yet
    /// ([`PnioStatus::is_busy`](super::PnioStatus::is_busy)). The default implementation returns false.
    fn is_busy(&self, error: &Self::Error) -> bool {
        let _ = error;
        false
    }

    /// Waits before another attempt to read a record. Implementations may sleep for some milliseconds. The default
    /// implementation returns immediately.
    fn pause(&mut self) {}
}

/// An asynchronous client that reads and writes records of one device, as [`RecordClient`] does.
///
/// ```
/// use lexibus::profinet::{AsyncRecordClient, PnioStatus, RecordAddress};
/// use lexibus::Error;
///
/// /// A device without records.
/// struct Empty;
///
/// impl AsyncRecordClient for Empty {
///     type Error = PnioStatus;
///
///     async fn read_record(&mut self, _: RecordAddress, _: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
///         Err(Error::Client(PnioStatus(0xDE80_B000)))
///     }
///
///     async fn write_record(&mut self, _: RecordAddress, _: &[u8]) -> Result<(), Error<PnioStatus>> {
///         Err(Error::Client(PnioStatus(0xDF80_B000)))
///     }
/// }
/// ```
#[allow(async_fn_in_trait)]
pub trait AsyncRecordClient {
    /// Error type of the client. The error type covers communication errors and refusals by the device.
    type Error;

    /// Reads the record at `address`, as [`RecordClient::read_record`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`RecordClient::read_record`].
    async fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` to the record at `address`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`RecordClient::read_record`].
    async fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Returns whether an error means that the response isn't available yet, as [`RecordClient::is_busy`] does.
    fn is_busy(&self, error: &Self::Error) -> bool {
        let _ = error;
        false
    }

    /// Waits before another attempt to read a record, as [`RecordClient::pause`] does.
    async fn pause(&mut self) {}
}

macro_rules! borrowed {
    ($Client:ident $($async:ident $await:ident)?) => {
        impl<T: $Client + ?Sized> $Client for &mut T {
            type Error = T::Error;

            $($async)? fn read_record(
                &mut self,
                address: RecordAddress,
                buffer: &mut [u8],
            ) -> Result<usize, Error<T::Error>> {
                T::read_record(self, address, buffer)$(.$await)?
            }

            $($async)? fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<T::Error>> {
                T::write_record(self, address, data)$(.$await)?
            }

            fn is_busy(&self, error: &T::Error) -> bool {
                T::is_busy(self, error)
            }

            $($async)? fn pause(&mut self) {
                T::pause(self)$(.$await)?;
            }
        }
    };
}

borrowed! { RecordClient }
borrowed! { AsyncRecordClient async await }
