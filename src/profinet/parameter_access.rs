//! Base mode parameter access of PROFIdrive, which uses the records 0xB02E and 0xB02F.
//!
//! A request reads or changes up to [`MAX_PARAMETERS`] parameters of one axis. The controller writes the request to a
//! record. Then, the controller reads the response from the same record. [`ParameterAccess`] writes requests and reads
//! responses through any [`RecordClient`](super::RecordClient):
//!
//! ```
//! use lexibus::profinet::parameter_access::ParameterAccess;
//! use lexibus::profinet::RecordClient;
//! use lexibus::Error;
//!
//! /// Sets two elements of an array of axis 1, from subindex 0 on. Returns the selected telegram (PNU 922).
//! fn set_up<C: RecordClient>(client: C) -> Result<u16, Error<C::Error>> {
//!     let mut parameters = ParameterAccess::new(client, 1, 1);
//!     parameters.write_array(1, 2100, 0, &[15_u16, 30])?;
//!     parameters.read(1, 922, 0)
//! }
//! ```
//!
//! To encode requests and decode responses in your own code, use [`read_request`], [`change_request`] and [`Response`]:
//!
//! ```
//! use lexibus::profinet::parameter_access::{read_request, Answer, ParameterAddress, Response};
//!
//! let mut buffer = [0; 16];
//! let request = read_request(&mut buffer, 0x80, 1, &[ParameterAddress::value(2, 0)])?;
//! assert_eq!(request, [0x80, 0x01, 0x01, 0x01, 0x10, 0x01, 0x00, 0x02, 0x00, 0x00]);
//!
//! let response = Response::decode(request, &[0x80, 0x01, 0x01, 0x01, 0x03, 0x01, 0x00, 0x1F])?;
//! let Some(Answer::Values(values)) = response.answers().next() else { panic!("refused") };
//! assert_eq!(values.get::<i16>(0)?, 31);
//! # Ok::<(), lexibus::profinet::parameter_access::ParameterError>(())
//! ```
//!
//! All numbers are big-endian.

mod access;
mod error;
mod format;
mod request;
mod response;

pub use access::{ParameterAccess, API, BLOCK_LEN, GLOBAL, LOCAL};
pub use error::{ErrorNumber, ParameterError, Refusal};
pub use format::{Format, ParameterValue};
pub use request::{change_request, read_request, Attribute, Change, ParameterAddress, MAX_PARAMETERS};
pub use response::{Answer, Answers, Response, Values};

#[cfg(test)]
mod tests;
