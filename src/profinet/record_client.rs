//! What carries records: implemented by adapters to controller libraries.

use super::plan::{Plan, RecordWrite};
use crate::error::Error;

/// Where a submodule is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubmoduleAddress {
    /// Number of the application process (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
}

impl SubmoduleAddress {
    /// The submodule in `subslot` of `slot`.
    #[must_use]
    pub const fn new(api: u32, slot: u16, subslot: u16) -> Self {
        Self { api, slot, subslot }
    }

    /// The record `index` of the submodule.
    #[must_use]
    pub const fn record(self, index: u16) -> RecordAddress {
        RecordAddress { api: self.api, slot: self.slot, subslot: self.subslot, index }
    }
}

/// Where a record is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RecordAddress {
    /// Number of the application process (API).
    pub api: u32,
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// The record's index.
    pub index: u16,
}

impl RecordWrite<'_> {
    /// Where the record is.
    #[must_use]
    pub const fn address(&self) -> RecordAddress {
        RecordAddress { api: self.api, slot: self.slot, subslot: self.subslot, index: self.index }
    }
}

impl<const N: usize> Plan<N> {
    /// The address of the submodule in `subslot` of `slot`; `None` where there is none.
    #[must_use]
    pub fn address(&self, slot: u16, subslot: u16) -> Option<SubmoduleAddress> {
        self.submodule(slot, subslot).map(|submodule| SubmoduleAddress::new(submodule.api, slot, subslot))
    }
}

/// Reads and writes the records of one device, waiting for each answer.
///
/// What stands on it: [`RecordAccess`](super::RecordAccess) for typed records,
/// [`ParameterAccess`](super::parameter_access::ParameterAccess) for the parameters of PROFIdrive.
///
/// ```
/// use std::collections::HashMap;
///
/// use lexibus::profinet::{PnioStatus, RecordAccess, RecordAddress, RecordClient, SubmoduleAddress};
/// use lexibus::{Error, LengthError};
///
/// /// A device in memory.
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
    /// What can go wrong on the bus, the status with which the device refuses included ([`PnioStatus`](super::PnioStatus)).
    type Error;

    /// Reads the record at `address` to the start of `buffer` and returns its length in bytes.
    ///
    /// Where the record is longer than `buffer`, return its length (what is in the buffer then doesn't matter) or an
    /// error.
    ///
    /// # Errors
    ///
    /// [`Error::Client`] where the bus fails or the device refuses, [`Error::Length`] where the record is too long.
    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` as the record at `address`.
    ///
    /// # Errors
    ///
    /// The same as of [`read_record`](Self::read_record).
    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Whether an error of [`read_record`](Self::read_record) says that the answer isn't there yet
    /// ([`PnioStatus::is_busy`](super::PnioStatus::is_busy)), so that reading again will help. Nothing does, unless said
    /// otherwise.
    fn is_busy(&self, error: &Self::Error) -> bool {
        let _ = error;
        false
    }

    /// Called before a record is read again that wasn't there yet: the place to sleep for some milliseconds. Returns at
    /// once, unless said otherwise.
    fn pause(&mut self) {}
}

/// Reads and writes the records of one device without blocking. The same rules as for [`RecordClient`].
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
    /// What can go wrong on the bus, the status with which the device refuses included.
    type Error;

    /// Reads the record at `address`, as [`RecordClient::read_record`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`RecordClient::read_record`].
    async fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>>;

    /// Writes `data` as the record at `address`.
    ///
    /// # Errors
    ///
    /// The same as of [`RecordClient::read_record`].
    async fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<Self::Error>>;

    /// Whether an error says that the answer isn't there yet, as [`RecordClient::is_busy`] does.
    fn is_busy(&self, error: &Self::Error) -> bool {
        let _ = error;
        false
    }

    /// Called before a record is read again that wasn't there yet, as [`RecordClient::pause`] is.
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
