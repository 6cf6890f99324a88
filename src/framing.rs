//! Framing of messages in a byte stream.
//!
//! [`Framing`] is a trait for framing protocols. [`Delimited`] implements the trait for protocols with start and end
//! bytes. A [`Delimited`] contains the delimiters, the escape bytes and the type of the checksum, and can be a
//! constant. The types of this module neither allocate nor perform I/O. The feature `serial` applies framing to a byte
//! stream of `embedded-io`.
//!
//! ```
//! use lexibus::framing::{Check, Delimited, Framing};
//!
//! /// STX, data, checksum, ETX. In the data, 0x02, 0x03 and 0x1B are sent as 0x1B and their complement.
//! const FRAMING: Delimited = Delimited::new(Some(0x02), 0x03)
//!     .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
//!     .with_check(Check::Xor(0xFF))
//!     .with_max_data(68);
//!
//! let mut frame = [0; 16];
//! let length = FRAMING.encode(&[0x01, 0x02, 0x6F, 0x9E, 0x00, 0x1B], &mut frame)?;
//! assert_eq!(frame[..length], [0x02, 0x01, 0x1B, 0xFD, 0x6F, 0x9E, 0x00, 0x1B, 0xE4, 0x16, 0x03]);
//!
//! let (mut decoder, mut data) = (FRAMING.decoder(), [0; 16]);
//! let found = frame.iter().find_map(|byte| FRAMING.decode(&mut decoder, *byte, &mut data).transpose());
//! assert_eq!(found, Some(Ok(6)));
//! assert_eq!(data[..6], [0x01, 0x02, 0x6F, 0x9E, 0x00, 0x1B]);
//! # Ok::<(), lexibus::LengthError>(())
//! ```

mod check;
mod delimited;

use core::error;
use core::fmt;

use crate::value_error::LengthError;

pub use check::Check;
pub use delimited::{Delimited, DelimitedDecoder, Escape};

/// Framing of messages in a byte stream.
///
/// Implement this trait for a custom protocol. In this example, a frame consists of a length byte and the data, without
/// a checksum:
///
/// ```
/// use lexibus::framing::{FrameError, Framing};
/// use lexibus::LengthError;
///
/// struct Counted;
///
/// /// Number of missing bytes, and number of received bytes.
/// struct Progress(u8, usize);
///
/// impl Framing for Counted {
///     type Decoder = Progress;
///
///     fn encode(&self, data: &[u8], frame: &mut [u8]) -> Result<usize, LengthError> {
///         let length = u8::try_from(data.len()).map_err(|_| LengthError::new(255, data.len()))?;
///         let error = LengthError::new(1 + data.len(), frame.len());
///         let frame = frame.get_mut(..1 + data.len()).ok_or(error)?;
///         frame[0] = length;
///         frame[1..].copy_from_slice(data);
///         Ok(frame.len())
///     }
///
///     fn decoder(&self) -> Progress {
///         Progress(0, 0)
///     }
///
///     fn decode(&self, decoder: &mut Progress, byte: u8, data: &mut [u8]) -> Result<Option<usize>, FrameError> {
///         if decoder.0 == 0 {
///             *decoder = Progress(byte, 0);
///             return Ok(None);
///         }
///         *data.get_mut(decoder.1).ok_or(FrameError::TooLong)? = byte;
///         *decoder = Progress(decoder.0 - 1, decoder.1 + 1);
///         Ok((decoder.0 == 0).then_some(decoder.1))
///     }
/// }
///
/// let mut frame = [0; 4];
/// assert_eq!(Counted.encode(&[7, 8], &mut frame), Ok(3));
/// let (mut decoder, mut data) = (Counted.decoder(), [0; 8]);
/// assert_eq!(Counted.decode(&mut decoder, frame[0], &mut data), Ok(None));
/// assert_eq!(Counted.decode(&mut decoder, frame[1], &mut data), Ok(None));
/// assert_eq!(Counted.decode(&mut decoder, frame[2], &mut data), Ok(Some(2)));
/// assert_eq!(data[..2], [7, 8]);
/// ```
pub trait Framing {
    /// State of the decoder between two bytes.
    type Decoder;

    /// Writes the frame for `data` to the start of `frame` and returns the length of the frame.
    ///
    /// # Errors
    ///
    /// Returns an error if `data` is too long for the protocol, or if the frame doesn't fit into `frame`.
    fn encode(&self, data: &[u8], frame: &mut [u8]) -> Result<usize, LengthError>;

    /// Returns a decoder that waits for the start of a frame.
    fn decoder(&self) -> Self::Decoder;

    /// Decodes the next byte of the stream and writes the decoded data to `data`. Pass the same buffer for all bytes of
    /// a frame. Returns the length of the data if `byte` is the last byte of the frame, otherwise `None`.
    ///
    /// # Errors
    ///
    /// Returns an error if the frame is invalid. The decoder then waits for the next frame. `byte` may already be the
    /// first byte of that frame.
    fn decode(&self, decoder: &mut Self::Decoder, byte: u8, data: &mut [u8]) -> Result<Option<usize>, FrameError>;
}

impl<F: Framing + ?Sized> Framing for &F {
    type Decoder = F::Decoder;

    fn encode(&self, data: &[u8], frame: &mut [u8]) -> Result<usize, LengthError> {
        F::encode(self, data, frame)
    }

    fn decoder(&self) -> F::Decoder {
        F::decoder(self)
    }

    fn decode(&self, decoder: &mut F::Decoder, byte: u8, data: &mut [u8]) -> Result<Option<usize>, FrameError> {
        F::decode(self, decoder, byte, data)
    }
}

/// Reason why a frame is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FrameError {
    /// Another frame started before the end of the frame.
    Interrupted,
    /// The data are longer than the protocol or the buffer allows.
    TooLong,
    /// The frame is shorter than its checksum.
    TooShort,
    /// The byte after the escape byte is invalid.
    Escape,
    /// The checksum doesn't match the data.
    Check,
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Interrupted => "another frame started before the end of this one",
            Self::TooLong => "the frame is too long",
            Self::TooShort => "the frame is too short",
            Self::Escape => "invalid escape sequence in the frame",
            Self::Check => "the check of the frame doesn't match its data",
        })
    }
}

impl error::Error for FrameError {}
