//! Handwritten structs for known frames, as a programmer would write them: fields at fixed offsets, without generality.

mod canopen;
mod ethercat;
mod modes;
mod profinet;

pub use canopen::{Full, WordAndLong, WordAndMode};
pub use ethercat::{ActualValues, Encoder, Image, Mode, SetPoints};
pub use modes::{AxisMode, StepMode};
pub use profinet::{Inputs, Outputs};

use lexibus::LengthError;

/// Returns the first `N` bytes of a frame.
///
/// # Errors
///
/// Returns an error if the frame is too short.
#[inline]
pub fn frame<const N: usize>(data: &[u8]) -> Result<&[u8; N], LengthError> {
    data.first_chunk().ok_or(LengthError::new(N, data.len()))
}

/// Returns the first `N` bytes of a frame for writing.
///
/// # Errors
///
/// Returns an error if the frame is too short.
#[inline]
pub fn frame_mut<const N: usize>(data: &mut [u8]) -> Result<&mut [u8; N], LengthError> {
    let error = LengthError::new(N, data.len());
    data.first_chunk_mut().ok_or(error)
}

/// Returns the `N` bytes that start at offset `at`.
#[inline]
pub fn part<const N: usize>(data: &[u8], at: usize) -> [u8; N] {
    let mut part = [0; N];
    part.copy_from_slice(&data[at..at + N]);
    part
}
