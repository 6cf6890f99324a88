//! Encoding of requests.

use super::error::ParameterError;
use super::format::Format;
use crate::value_error::LengthError;

/// Maximum number of parameters in a request.
pub const MAX_PARAMETERS: usize = 39;

/// Request ID of a read request.
pub(super) const READ: u8 = 0x01;
/// Request ID of a change request.
pub(super) const CHANGE: u8 = 0x02;
/// Length of the header of requests and responses in bytes: reference, ID, axis, and number of parameters.
pub(super) const HEADER_LEN: usize = 4;
/// Length of a parameter address in bytes.
const ADDRESS_LEN: usize = 6;

/// The attribute of a parameter that a request reads or changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Attribute {
    /// The value of the parameter.
    #[default]
    Value = 0x10,
    /// The description of the parameter.
    Description = 0x20,
    /// The texts of the parameter.
    Text = 0x30,
}

/// The elements of a parameter that a request reads or changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ParameterAddress {
    /// Attribute of the parameter.
    pub attribute: Attribute,
    /// Number of elements.
    pub elements: u8,
    /// Parameter number (PNU).
    pub pnu: u16,
    /// Subindex of the first element; 0 if the parameter isn't an array.
    pub subindex: u16,
}

impl ParameterAddress {
    /// Creates the address of a single value.
    #[must_use]
    pub const fn value(pnu: u16, subindex: u16) -> Self {
        Self::values(pnu, subindex, 1)
    }

    /// Creates the address of consecutive elements of an array, starting at `subindex`.
    #[must_use]
    pub const fn values(pnu: u16, subindex: u16, elements: u8) -> Self {
        Self { attribute: Attribute::Value, elements, pnu, subindex }
    }

    /// Returns the same address with another attribute.
    #[must_use]
    pub const fn of(self, attribute: Attribute) -> Self {
        Self { attribute, ..self }
    }
}

/// A change of a parameter.
///
/// ```
/// use lexibus::profinet::parameter_access::{Change, ParameterAddress, ParameterValue};
///
/// let ramp = 1500_u16.to_be_bytes();
/// let change = Change::new(ParameterAddress::value(1120, 0), u16::FORMAT, &ramp);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change<'v> {
    /// Address of the parameter.
    pub address: ParameterAddress,
    /// Format of the values.
    pub format: Format,
    /// Encoded values.
    pub values: &'v [u8],
}

impl<'v> Change<'v> {
    /// Creates a change that sets the elements at `address` to `values`.
    #[must_use]
    pub const fn new(address: ParameterAddress, format: Format, values: &'v [u8]) -> Self {
        Self { address, format, values }
    }
}

/// Encodes a request into `buffer` and returns the request. The request reads `parameters`. `axis` is the drive object
/// number (DO-ID).
///
/// The drive copies `reference` to the response.
///
/// # Errors
///
/// - [`ParameterError::NoRequest`] if `reference` is 0.
/// - [`ParameterError::Count`] if the number of parameters isn't between 1 and [`MAX_PARAMETERS`].
/// - [`ParameterError::Length`] if `buffer` is too short.
pub fn read_request<'b>(
    buffer: &'b mut [u8],
    reference: u8,
    axis: u8,
    parameters: &[ParameterAddress],
) -> Result<&'b [u8], ParameterError> {
    let mut to = Writer::new(buffer);
    to.header(reference, READ, axis, parameters.len())?;
    parameters.iter().for_each(|parameter| to.address(parameter));
    to.finish()
}

/// Encodes a request into `buffer` and returns the request. The request contains `changes`. `axis` is the drive object
/// number (DO-ID).
///
/// # Errors
///
/// - [`ParameterError::NoRequest`] if `reference` is 0.
/// - [`ParameterError::Count`] if the number of changes isn't between 1 and [`MAX_PARAMETERS`].
/// - [`ParameterError::Values`] if the values don't match their format.
/// - [`ParameterError::Length`] if `buffer` is too short.
pub fn change_request<'b>(
    buffer: &'b mut [u8],
    reference: u8,
    axis: u8,
    changes: &[Change<'_>],
) -> Result<&'b [u8], ParameterError> {
    let mut to = Writer::new(buffer);
    to.header(reference, CHANGE, axis, changes.len())?;
    changes.iter().for_each(|change| to.address(&change.address));
    for change in changes {
        to.values(change)?;
    }
    to.finish()
}

/// A writer that continues to count bytes after the end of the buffer.
struct Writer<'b> {
    buffer: &'b mut [u8],
    length: usize,
}

impl<'b> Writer<'b> {
    fn new(buffer: &'b mut [u8]) -> Self {
        Self { buffer, length: 0 }
    }

    fn put(&mut self, bytes: &[u8]) {
        let to = self.buffer.get_mut(self.length..).and_then(|rest| rest.get_mut(..bytes.len()));
        if let Some(to) = to {
            to.copy_from_slice(bytes);
        }
        self.length += bytes.len();
    }

    fn header(&mut self, reference: u8, id: u8, axis: u8, count: usize) -> Result<(), ParameterError> {
        if reference == 0 {
            return Err(ParameterError::NoRequest);
        }
        let allowed = u8::try_from(count).ok().filter(|_| (1..=MAX_PARAMETERS).contains(&count));
        self.put(&[reference, id, axis, allowed.ok_or(ParameterError::Count(count))?]);
        Ok(())
    }

    fn address(&mut self, address: &ParameterAddress) {
        let ([a, b], [c, d]) = (address.pnu.to_be_bytes(), address.subindex.to_be_bytes());
        let bytes: [u8; ADDRESS_LEN] = [address.attribute as u8, address.elements, a, b, c, d];
        self.put(&bytes);
    }

    fn values(&mut self, change: &Change<'_>) -> Result<(), ParameterError> {
        let error = ParameterError::Values(change.format);
        let size = change.format.size().ok_or(error)?;
        let count = u8::try_from(change.values.len() / size).map_err(|_| error)?;
        if count == 0 || change.values.len() % size != 0 {
            return Err(error);
        }
        self.put(&[change.format.0, count]);
        self.put(change.values);
        if change.values.len() % 2 == 1 {
            self.put(&[0]);
        }
        Ok(())
    }

    fn finish(self) -> Result<&'b [u8], ParameterError> {
        let error = LengthError::new(self.length, self.buffer.len());
        let buffer: &'b [u8] = self.buffer;
        Ok(buffer.get(..self.length).ok_or(error)?)
    }
}
