//! Frames between two bytes.

use super::{Check, FrameError, Framing};
use crate::value_error::LengthError;

/// Frames that end in a byte of their own, and mostly begin with one: begin, data, check, end.
///
/// Bytes between frames are passed over, where a frame has a first byte. First and last byte may be the same; then one of them
/// may end a frame and begin the next one, and frames without data are passed over.
///
/// Where the check isn't escaped, it may look like the end of a frame. A frame ends with the first last byte that agrees with
/// the check in front of it; nothing can be said of the rare case that this is inside of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delimited {
    /// First byte; `None` where a frame begins behind the end of the last one.
    pub start: Option<u8>,
    /// Last byte.
    pub end: u8,
    /// How bytes within the frame are told from these; `None` where they don't occur in data.
    pub escape: Option<Escape>,
    /// What stands behind the data.
    pub check: Check,
    /// The first byte of the data that is checked, from 0.
    pub check_from: usize,
    /// Whether the check is escaped, as the data are.
    pub is_check_escaped: bool,
    /// Greatest number of data bytes, without begin, end, escapes and check.
    pub max_data: usize,
}

/// How some bytes are sent in two: one that announces it, and then the byte combined with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Escape {
    /// The byte that announces an escaped one.
    pub byte: u8,
    /// What an escaped byte is combined with (exclusive or); 0 where it follows as it is.
    pub xor: u8,
    /// The bytes that are escaped.
    pub escaped: &'static [u8],
}

impl Delimited {
    /// Frames of any length between two bytes, without escapes and check.
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

    /// The same with bytes `escaped`: each is sent as `byte`, and then itself combined with `xor`.
    #[must_use]
    pub const fn with_escape(self, byte: u8, xor: u8, escaped: &'static [u8]) -> Self {
        Self { escape: Some(Escape { byte, xor, escaped }), ..self }
    }

    /// The same with a check of all data, which is escaped as they are.
    #[must_use]
    pub const fn with_check(self, check: Check) -> Self {
        Self { check, ..self }
    }

    /// The same with at most so many data.
    #[must_use]
    pub const fn with_max_data(self, max_data: usize) -> Self {
        Self { max_data, ..self }
    }

    fn needs_escape(&self, byte: u8) -> Option<Escape> {
        self.escape.filter(|escape| escape.escaped.contains(&byte))
    }

    /// The check of these data.
    fn check_of(&self, data: &[u8]) -> [u8; 2] {
        self.check.of(data.get(self.check_from..).unwrap_or_default())
    }
}

/// Writes as long as there is room, and counts on beyond it.
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

/// How far a frame of [`Delimited`] has come.
#[derive(Clone, Debug)]
pub struct DelimitedDecoder {
    state: State,
    /// How many data there are.
    length: usize,
    /// The last bytes: they may be the check. Where the check isn't escaped, as they came.
    held: [u8; 2],
    held_length: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Waits for the first byte of a frame, or for the last one where frames have none.
    Idle,
    /// Within a frame.
    Data,
    /// Behind the byte that announces an escaped one.
    Escaped,
}

impl DelimitedDecoder {
    fn begin(&mut self, state: State) {
        *self = Self { state, length: 0, held: [0; 2], held_length: 0 };
    }

    /// Holds a byte back, and returns the one that can't be a part of the check any more.
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
    /// Where a decoder goes on behind the end of a frame.
    const fn behind_end(&self) -> State {
        match self.start {
            Some(start) if start != self.end => State::Idle,
            _ => State::Data,
        }
    }

    /// The frame is lost: what a byte that isn't a part of it means for the next one.
    fn lost(&self, decoder: &mut DelimitedDecoder, byte: u8, error: FrameError) -> Result<Option<usize>, FrameError> {
        decoder.begin(match byte {
            byte if byte == self.end => self.behind_end(),
            byte if Some(byte) == self.start => State::Data,
            _ => State::Idle,
        });
        Err(error)
    }

    /// Whether what is held is the check of the data.
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

    /// The byte that `byte` stands for; `None` where it announces one.
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

    /// A byte within a frame whose check is escaped: it means the same wherever it stands.
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

    /// A byte within a frame whose check isn't escaped: what it means is known when it can't be a part of the check any
    /// more.
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
                // What is held stands behind it.
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
        // A last byte is the end, or the check itself; of two bytes of check it may be the first.
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
