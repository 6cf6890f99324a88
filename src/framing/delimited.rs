//! Frames with start and end bytes.

use super::{Check, FrameError, Framing};
use crate::value_error::LengthError;

/// Framing with an end byte, and usually a start byte: start, data, checksum, end.
///
/// If the start byte differs from the end byte, bytes between frames are ignored. If both are equal, one byte can be
/// both the end of a frame and the start of the next frame. In this case, frames without data are ignored.
///
/// An unescaped checksum can contain the end byte. Therefore, the decoder ends a frame at the first end byte that
/// follows a matching checksum. In rare cases, the data contain a matching checksum, followed by an end byte. The
/// decoder then ends the frame too early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delimited {
    /// Start byte; `None` if each frame starts directly after the end byte of the previous frame.
    pub start: Option<u8>,
    /// End byte.
    pub end: u8,
    /// Escape sequences for start and end bytes in the data; `None` if the data never contain start or end bytes.
    pub escape: Option<Escape>,
    /// Checksum after the data.
    pub check: Check,
    /// Offset of the first data byte that the checksum covers.
    pub check_from: usize,
    /// True if the checksum is escaped in the same way as the data.
    pub is_check_escaped: bool,
    /// Maximum number of data bytes, without start, end, escapes and checksum.
    pub max_data: usize,
}

/// Escape sequence of two bytes: the escape byte, then the original byte XOR `xor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Escape {
    /// Escape byte.
    pub byte: u8,
    /// Mask that is combined with the original byte by XOR; 0 leaves the byte unchanged.
    pub xor: u8,
    /// Bytes that are escaped.
    pub escaped: &'static [u8],
}

impl Delimited {
    /// Creates a framing for data of any length, without escapes and checksum.
    #[must_use]
    pub const fn new(start: Option<u8>, end: u8) -> Self {
        Self {
            start,
            end,
            escape: None,
            check: Check::None,
            check_from: 0,
            is_check_escaped: true,
            max_data: usize::MAX,
        }
    }

    /// Returns the framing with escapes: each of the bytes in `escaped` is sent as `byte`, followed by the original
    /// byte XOR `xor`.
    #[must_use]
    pub const fn with_escape(self, byte: u8, xor: u8, escaped: &'static [u8]) -> Self {
        Self { escape: Some(Escape { byte, xor, escaped }), ..self }
    }

    /// Returns the framing with a checksum. By default, the checksum covers all data and is escaped in the same way as
    /// the data.
    #[must_use]
    pub const fn with_check(self, check: Check) -> Self {
        Self { check, ..self }
    }

    /// Returns the framing with a maximum number of data bytes.
    #[must_use]
    pub const fn with_max_data(self, max_data: usize) -> Self {
        Self { max_data, ..self }
    }

    fn needs_escape(&self, byte: u8) -> Option<Escape> {
        self.escape.filter(|escape| escape.escaped.contains(&byte))
    }

    /// Computes the checksum of `data`.
    fn check_of(&self, data: &[u8]) -> [u8; 2] {
        self.check.of(data.get(self.check_from..).unwrap_or_default())
    }
}

/// Writer that stores the bytes that fit into the frame, and counts all bytes.
struct Writer<'f> {
    frame: &'f mut [u8],
    length: usize,
}

impl Writer<'_> {
    fn put(&mut self, byte: u8) {
        if let Some(to) = self.frame.get_mut(self.length) {
            *to = byte;
        }
        self.length += 1;
    }

    fn put_escaped(&mut self, byte: u8, escape: Option<Escape>) {
        match escape {
            Some(escape) => {
                self.put(escape.byte);
                self.put(byte ^ escape.xor);
            }
            None => self.put(byte),
        }
    }
}

/// State of a partly received frame of [`Delimited`].
#[derive(Clone, Debug)]
pub struct DelimitedDecoder {
    state: State,
    /// Number of data bytes received so far.
    length: usize,
    /// The last bytes, which may be the checksum. If the checksum is sent without escapes, the bytes are stored as
    /// received.
    held: [u8; 2],
    held_length: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Waits for the start byte, or for an end byte if frames have no start byte.
    Idle,
    /// Inside a frame.
    Data,
    /// After an escape byte.
    Escaped,
}

impl DelimitedDecoder {
    fn begin(&mut self, state: State) {
        *self = Self { state, length: 0, held: [0; 2], held_length: 0 };
    }

    /// Holds a byte that may be a part of the checksum. Returns the oldest held byte if it can no longer be a part of
    /// the checksum.
    fn hold(&mut self, byte: u8, check: usize) -> Option<u8> {
        if check == 0 {
            return Some(byte);
        }
        let is_full = self.held_length >= check;
        let oldest = self.held[0];
        if is_full {
            self.held.rotate_left(1);
        } else {
            self.held_length += 1;
        }
        if let Some(to) = self.held.get_mut(self.held_length - 1) {
            *to = byte;
        }
        is_full.then_some(oldest)
    }
}

impl Delimited {
    /// Returns the state after the end of a frame.
    const fn behind_end(&self) -> State {
        match self.start {
            Some(start) if start != self.end => State::Idle,
            _ => State::Data,
        }
    }

    /// Resets the decoder after an invalid frame. `byte` may start the next frame.
    fn lost(&self, decoder: &mut DelimitedDecoder, byte: u8, error: FrameError) -> Result<Option<usize>, FrameError> {
        decoder.begin(match byte {
            byte if byte == self.end => self.behind_end(),
            byte if Some(byte) == self.start => State::Data,
            _ => State::Idle,
        });
        Err(error)
    }

    /// Returns whether the held bytes are the checksum of the data.
    fn agrees(&self, decoder: &DelimitedDecoder, data: &[u8]) -> bool {
        let check = self.check_of(data.get(..decoder.length).unwrap_or_default());
        let count = self.check.len();
        decoder.held_length == count && decoder.held.iter().zip(check).take(count).all(|(held, check)| *held == check)
    }

    fn finish(&self, decoder: &mut DelimitedDecoder, data: &[u8]) -> Result<Option<usize>, FrameError> {
        let found = if decoder.state == State::Escaped {
            Err(FrameError::Escape)
        } else if decoder.held_length < self.check.len() {
            Err(FrameError::TooShort)
        } else if self.agrees(decoder, data) {
            Ok(Some(decoder.length))
        } else {
            Err(FrameError::Check)
        };
        decoder.begin(self.behind_end());
        found
    }

    fn store(&self, decoder: &mut DelimitedDecoder, byte: u8, data: &mut [u8]) -> Result<(), FrameError> {
        let to = data.get_mut(decoder.length).filter(|_| decoder.length < self.max_data);
        *to.ok_or(FrameError::TooLong)? = byte;
        decoder.length += 1;
        Ok(())
    }

    /// Returns the unescaped byte, `None` if `byte` is the escape byte, or an error if the escape sequence is invalid.
    fn unescape(&self, decoder: &mut DelimitedDecoder, byte: u8) -> Result<Option<u8>, FrameError> {
        let Some(escape) = self.escape else { return Ok(Some(byte)) };
        match decoder.state {
            State::Escaped => {
                decoder.state = State::Data;
                let plain = byte ^ escape.xor;
                self.needs_escape(plain).map(|_| Some(plain)).ok_or(FrameError::Escape)
            }
            _ if byte == escape.byte => {
                decoder.state = State::Escaped;
                Ok(None)
            }
            _ => Ok(Some(byte)),
        }
    }

    /// Decodes a byte in a frame that has no checksum or an escaped checksum. In such a frame, start, end and escape
    /// bytes have the same meaning at all positions.
    fn inside(&self, decoder: &mut DelimitedDecoder, byte: u8, data: &mut [u8]) -> Result<Option<usize>, FrameError> {
        let is_escaped = decoder.state == State::Escaped;
        match self.unescape(decoder, byte) {
            Err(error) => return self.lost(decoder, byte, error),
            Ok(None) => return Ok(None),
            Ok(Some(_)) if !is_escaped && byte == self.end => {
                let is_between = Some(byte) == self.start && decoder.length + decoder.held_length == 0;
                return if is_between { Ok(None) } else { self.finish(decoder, data) };
            }
            Ok(Some(_)) if !is_escaped && Some(byte) == self.start => {
                return self.lost(decoder, byte, FrameError::Interrupted);
            }
            Ok(Some(plain)) => {
                if let Some(released) = decoder.hold(plain, self.check.len()) {
                    if let Err(error) = self.store(decoder, released, data) {
                        return self.lost(decoder, byte, error);
                    }
                }
            }
        }
        Ok(None)
    }

    /// Decodes a byte in a frame whose checksum isn't escaped. An end byte after a matching checksum ends the frame.
    /// Any other byte is interpreted when it can no longer be a part of the checksum.
    fn inside_raw(
        &self,
        decoder: &mut DelimitedDecoder,
        byte: u8,
        data: &mut [u8],
    ) -> Result<Option<usize>, FrameError> {
        let count = self.check.len();
        if byte == self.end && decoder.state == State::Data && self.agrees(decoder, data) {
            return self.finish(decoder, data);
        }
        if let Some(released) = decoder.hold(byte, count) {
            let is_escaped = decoder.state == State::Escaped;
            if !is_escaped && released == self.end {
                return self.lost(decoder, byte, FrameError::Check);
            }
            if !is_escaped && Some(released) == self.start {
                // The held bytes are in the new frame.
                decoder.length = 0;
                return Err(FrameError::Interrupted);
            }
            let stored = self.unescape(decoder, released).and_then(|plain| match plain {
                Some(plain) => self.store(decoder, plain, data),
                None => Ok(()),
            });
            if let Err(error) = stored {
                return self.lost(decoder, byte, error);
            }
        }
        // An end byte may belong to the checksum, or be the first of its two bytes.
        let is_check = count > 1 || (decoder.state == State::Data && self.agrees(decoder, data));
        match byte == self.end && !is_check {
            true if decoder.length == 0 => self.lost(decoder, byte, FrameError::TooShort),
            true => self.lost(decoder, byte, FrameError::Check),
            false => Ok(None),
        }
    }
}

impl Framing for Delimited {
    type Decoder = DelimitedDecoder;

    fn encode(&self, data: &[u8], frame: &mut [u8]) -> Result<usize, LengthError> {
        if data.len() > self.max_data {
            return Err(LengthError::new(self.max_data, data.len()));
        }
        let room = frame.len();
        let mut to = Writer { frame, length: 0 };
        self.start.into_iter().for_each(|start| to.put(start));
        data.iter().for_each(|byte| to.put_escaped(*byte, self.needs_escape(*byte)));
        for byte in self.check_of(data).into_iter().take(self.check.len()) {
            to.put_escaped(byte, self.needs_escape(byte).filter(|_| self.is_check_escaped));
        }
        to.put(self.end);
        Some(to.length).filter(|length| *length <= room).ok_or(LengthError::new(to.length, room))
    }

    fn decoder(&self) -> DelimitedDecoder {
        let state = if self.start.is_some() { State::Idle } else { State::Data };
        DelimitedDecoder { state, length: 0, held: [0; 2], held_length: 0 }
    }

    fn decode(&self, decoder: &mut DelimitedDecoder, byte: u8, data: &mut [u8]) -> Result<Option<usize>, FrameError> {
        match decoder.state {
            State::Idle => {
                if byte == self.start.unwrap_or(self.end) {
                    decoder.begin(State::Data);
                }
                Ok(None)
            }
            _ if self.is_check_escaped || self.check.is_empty() => self.inside(decoder, byte, data),
            _ => self.inside_raw(decoder, byte, data),
        }
    }
}
