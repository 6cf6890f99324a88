//! Names and functions that the macro `ethercrab_wire!` uses.

pub use ethercrab::{EtherCrabWireRead, EtherCrabWireSized, EtherCrabWireWrite, EtherCrabWireWriteSized};
pub use ethercrab_wire::WireError;

use crate::value_error::LengthError;

/// Copies the bytes of a PDO to the beginning of `buffer`, and returns them.
///
/// # Panics
///
/// Panics if `buffer` is too short, as `EtherCrabWireWrite::pack_to_slice_unchecked` requires. `ethercrab` calls that
/// method only with buffers that are long enough.
#[must_use]
#[inline]
pub fn copy<const N: usize>(bytes: [u8; N], buffer: &mut [u8]) -> &[u8] {
    let (start, _) = buffer.split_at_mut(N);
    start.copy_from_slice(&bytes);
    start
}

/// Converts the error of `unpack`.
///
/// # Errors
///
/// Returns [`WireError::ReadBufferTooShort`].
#[inline]
pub fn read<T>(result: Result<T, LengthError>) -> Result<T, WireError> {
    result.map_err(|_| WireError::ReadBufferTooShort)
}
