//! Tests messages and numbered parameters over `embedded-io` streams with a simulated drive.

use std::collections::{BTreeMap, VecDeque};
use std::future::{pending, Pending};
use std::io::ErrorKind;
use std::time::Duration;

use lexibus::clients::serial::{embedded_io, embedded_io_async, SerialError, SerialLine};
use lexibus::framing::{Check, Delimited, FrameError, Framing};
use lexibus::message::WriteError;
use lexibus::{
    AbortCode, AsyncExchange, Error, Exchange, Flags, Initial, Item, LengthError, OnSerial, Parameter,
    ParameterMessages, Parameters, Range, Rw,
};

#[path = "support/now.rs"]
mod now;
use now::now;

const FRAMING: Delimited = Delimited::new(Some(0x02), 0x03)
    .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
    .with_check(Check::Xor(0xFF))
    .with_max_data(20);

fn framed(data: &[u8]) -> Vec<u8> {
    let mut frame = [0; 64];
    let length = FRAMING.encode(data, &mut frame).expect("it fits");
    frame[..length].to_vec()
}

/// A serial line that is connected to a simulated drive or returns fixed replies.
#[derive(Default)]
struct Line {
    received: Vec<u8>,
    replies: VecDeque<u8>,
    /// True if a timeout follows the replies. False if the end of the stream follows the replies.
    is_late: bool,
    /// True if each write accepts only a single byte.
    slow: bool,
    drive: Option<Drive>,
}

impl Line {
    fn replying(replies: impl IntoIterator<Item = u8>) -> Self {
        Self { replies: replies.into_iter().collect(), is_late: true, ..Self::default() }
    }

    fn take(&mut self, bytes: &[u8]) -> usize {
        let count = if self.slow { 1 } else { bytes.len() };
        self.received.extend(&bytes[..count]);
        let Some(drive) = &mut self.drive else { return count };
        for byte in &bytes[..count] {
            if let Some(reply) = drive.receive(*byte) {
                self.replies.extend(framed(&reply));
            }
        }
        count
    }

    fn give(&mut self, buffer: &mut [u8]) -> Result<usize, ErrorKind> {
        match self.replies.pop_front() {
            Some(byte) => {
                buffer[0] = byte;
                Ok(1)
            }
            None if self.is_late => Err(ErrorKind::TimedOut),
            None => Ok(0),
        }
    }
}

/// An error type for `embedded-io`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Late(ErrorKind);

impl std::fmt::Display for Late {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Late {}

impl embedded_io::Error for Late {
    fn kind(&self) -> embedded_io::ErrorKind {
        embedded_io::ErrorKind::TimedOut
    }
}

impl embedded_io::ErrorType for Line {
    type Error = Late;
}

impl embedded_io::Read for Line {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Late> {
        self.give(buffer).map_err(Late)
    }
}

impl embedded_io::Write for Line {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Late> {
        Ok(self.take(bytes))
    }

    fn flush(&mut self) -> Result<(), Late> {
        Ok(())
    }
}

/// The line as an asynchronous stream.
struct AsyncLine(Line);

impl embedded_io::ErrorType for AsyncLine {
    type Error = Late;
}

impl embedded_io_async::Read for AsyncLine {
    async fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Late> {
        self.0.give(buffer).map_err(Late)
    }
}

impl embedded_io_async::Write for AsyncLine {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Late> {
        Ok(self.0.take(bytes))
    }

    async fn flush(&mut self) -> Result<(), Late> {
        Ok(())
    }
}

/// The test protocol. The requests are `r` with a number, and `w` with a number and a value. The replies are `r` with a number
/// and a value, `w` with a number, and `!` with a number. Values are big-endian.
struct Messages;

impl ParameterMessages for Messages {
    fn read_request(&self, parameter: Parameter, _: usize, request: &mut [u8]) -> Result<usize, WriteError> {
        self.write_request(parameter, &[], request).inspect(|_| request[0] = b'r')
    }

    fn read_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8], value: &mut [u8]) -> Result<usize, Error<E>> {
        let bytes = reply_to(b'r', parameter, reply)?;
        if bytes.len() != value.len() {
            return Err(Error::Length(LengthError::new(value.len(), bytes.len())));
        }
        value.iter_mut().zip(bytes.iter().rev()).for_each(|(to, from)| *to = *from);
        Ok(bytes.len())
    }

    fn write_request(&self, parameter: Parameter, value: &[u8], request: &mut [u8]) -> Result<usize, WriteError> {
        let error = LengthError::new(2 + value.len(), request.len());
        let request = request.get_mut(..2 + value.len()).ok_or(error)?;
        request[..2].copy_from_slice(&[b'w', parameter.0 as u8]);
        request[2..].iter_mut().zip(value.iter().rev()).for_each(|(to, from)| *to = *from);
        Ok(request.len())
    }

    fn write_reply<E>(&self, parameter: Parameter, _: &[u8], reply: &[u8]) -> Result<(), Error<E>> {
        reply_to(b'w', parameter, reply).map(drop)
    }
}

fn reply_to<E>(kind: u8, parameter: Parameter, reply: &[u8]) -> Result<&[u8], Error<E>> {
    match reply {
        [head, number, value @ ..] if *head == kind && u32::from(*number) == parameter.0 => Ok(value),
        [b'!', ..] => Err(Error::Abort(AbortCode::NO_OBJECT)),
        _ => Err(Error::UnexpectedReply),
    }
}

/// A simulated drive that has all parameters except number 9.
#[derive(Default)]
struct Drive {
    decoder: Option<<Delimited as Framing>::Decoder>,
    request: [u8; 20],
    parameters: BTreeMap<u8, Vec<u8>>,
}

impl Drive {
    fn receive(&mut self, byte: u8) -> Option<Vec<u8>> {
        let decoder = self.decoder.get_or_insert_with(|| FRAMING.decoder());
        let length = FRAMING.decode(decoder, byte, &mut self.request).expect("a good frame")?;
        Some(match self.request[..length] {
            [_, 9, ..] => vec![b'!', 9],
            [b'r', number] => [&[b'r', number], &self.parameters[&number][..]].concat(),
            [_, number, ref value @ ..] => {
                self.parameters.insert(number, value.to_vec());
                vec![b'w', number]
            }
            _ => Vec::new(),
        })
    }
}

/// A timer that never expires.
const NEVER: fn(Duration) -> Pending<()> = |_| pending();

const TIMEOUT: Duration = Duration::from_secs(1);

type Answer = Result<Vec<u8>, Error<SerialError<Late>>>;

/// Returns the result of an exchange with these replies. Checks that the asynchronous result is equal.
fn exchanged(replies: &[u8]) -> Answer {
    let answer = |result: Result<usize, _>, reply: &[u8]| result.map(|length| reply[..length].to_vec());
    let mut reply = [0; 20];
    let mut line: SerialLine<_, _, 64> = SerialLine::with_ready(Line::replying(replies.iter().copied()), FRAMING, None);
    let blocking = answer(line.exchange(&[1, 2], &mut reply), &reply);
    assert_eq!(line.into_stream().received, framed(&[1, 2]));

    let stream = AsyncLine(Line { slow: true, ..Line::replying(replies.iter().copied()) });
    let mut line = SerialLine::<_, _, 64>::with_ready(stream, FRAMING, None).with_time(NEVER, TIMEOUT);
    let other = answer(now(line.exchange(&[1, 2], &mut reply)), &reply);
    assert_eq!((&other, line.stream().0.received.len()), (&blocking, framed(&[1, 2]).len()));
    other
}

fn lost(error: FrameError) -> Answer {
    Err(Error::Client(SerialError::Frame(error)))
}

const NOTHING: Answer = Err(Error::Client(SerialError::Stream(Late(ErrorKind::TimedOut))));

#[test]
fn replies() {
    let good = framed(&[1, 0x02, 0x03, 0x1B]);
    let data = Ok(vec![1, 0x02, 0x03, 0x1B]);
    assert_eq!(exchanged(&good), data);
    assert_eq!(exchanged(&[&[0xFF, 0x03, 0x41][..], &good, &[0xFF]].concat()), data, "noise");
    assert_eq!(exchanged(&[&[0x02, 0x41][..], &good].concat()), data, "a frame that was cut off");
    assert_eq!(exchanged(&[0x02, 0x41, 0x41, 0x03]), lost(FrameError::Check));
    assert_eq!(exchanged(&[0x02, 0x41, 0x1B, 0x41]), lost(FrameError::Escape));
    assert_eq!(exchanged(&[0x02, 0x03]), lost(FrameError::TooShort));
    assert_eq!(exchanged(&[&[0x02][..], &[0x41; 30]].concat()), lost(FrameError::TooLong));
    for cut in 0..good.len() {
        assert_eq!(exchanged(&good[..cut]), NOTHING, "{cut}");
    }
}

#[test]
fn the_rest_of_a_reply_that_was_cut_off_isnt_the_next_one() {
    const LINES: Delimited = Delimited::new(None, b'\r');
    let mut reply = [0; 4];
    let mut line: SerialLine<_, _, 64> = SerialLine::with_ready(Line::replying(*b"ABCDEFGH\rOK\r1\r"), LINES, None);
    let too_long = Err(Error::Client(SerialError::Frame(FrameError::TooLong)));
    assert_eq!(line.exchange(b"?", &mut reply), too_long);
    assert_eq!((line.exchange(b"?", &mut reply), &reply[..2]), (Ok(2), &b"OK"[..]));
    assert_eq!(line.exchange(b"?", &mut reply), Ok(1));
    assert!(format!("{:?}", SerialLine::<_, _, 8>::with_ready((), LINES, None))
        .starts_with("SerialLine { stream: (), framing: "));
    // A line with a timer discards one more frame, because the reply to the failed request can still arrive.
    let stream = AsyncLine(Line::replying(*b"ABCDEFGH\rold\rOK\r"));
    let mut line = SerialLine::<_, _, 64>::with_ready(stream, LINES, None).with_time(NEVER, TIMEOUT);
    assert!(now(AsyncExchange::exchange(&mut line, b"?", &mut reply)).is_err());
    assert_eq!((now(AsyncExchange::exchange(&mut line, b"?", &mut reply)), &reply[..2]), (Ok(2), &b"OK"[..]));
}

#[test]
fn nothing_behind_the_reply_is_taken() {
    let replies = [framed(&[1]), framed(&[2, 0x03])].concat();
    let mut line: SerialLine<_, _, 64> = SerialLine::with_ready(Line::replying(replies), FRAMING, None);
    let mut reply = [0; 20];
    assert_eq!(line.exchange(&[], &mut reply), Ok(1));
    assert_eq!(line.exchange(&[], &mut reply), Ok(2));
    assert_eq!(reply[..2], [2, 0x03]);
}

#[test]
fn streams_that_end_and_requests_that_are_too_long() {
    let mut line: SerialLine<_, _, 8> = SerialLine::with_ready(Line::default(), &FRAMING, None);
    let closed = line.exchange(&[1], &mut [0; 8]).unwrap_err();
    assert_eq!((closed, closed.to_string()), (Error::Client(SerialError::Closed), "the serial line was closed".into()));
    assert_eq!(line.exchange(&[2; 3], &mut [0; 8]), Err(Error::Length(LengthError::new(9, 8))));
    assert_eq!(line.exchange(&[0; 21], &mut [0; 8]), Err(Error::Length(LengthError::new(20, 21))));
    assert_eq!(line.stream().received, framed(&[1]), "data that are too long are not sent");
}

const fn item<V: lexibus::Value>(number: u32) -> Item<V, Rw, OnSerial> {
    Item::new(OnSerial::serial(number), "Parameter", Range::Full, Initial::Unknown, "", Flags::NONE)
}

const GAIN: Item<i16, Rw, OnSerial> = item(3);
const POSITION: Item<i32, Rw, OnSerial> = item(0x1B);
const MISSING: Item<u16, Rw, OnSerial> = item(9);

#[test]
fn parameters_are_items() {
    let stream = Line { drive: Some(Drive::default()), ..Line::default() };
    let mut drive = Parameters::<_, _, 20>::new(SerialLine::<_, _, 64>::with_ready(stream, FRAMING, None), Messages);
    GAIN.at(&mut drive).write(-2).unwrap();
    POSITION.at(&mut drive).write(0x0203_1BFF).unwrap();
    assert_eq!((GAIN.at(&mut drive).read(), POSITION.at(&mut drive).read()), (Ok(-2), Ok(0x0203_1BFF)));
    assert_eq!(MISSING.at(&mut drive).read().map_err(Error::from), Err(Error::Abort(AbortCode::NO_OBJECT)));
    assert_eq!(MISSING.at(&mut drive).write(1).map_err(Error::from), Err(Error::Abort(AbortCode::NO_OBJECT)));
    let parameters = &drive.exchange().stream().drive.as_ref().expect("a drive").parameters;
    assert_eq!(*parameters, BTreeMap::from([(3, vec![0xFF, 0xFE]), (0x1B, vec![0x02, 0x03, 0x1B, 0xFF])]));
    let short = item::<i32>(3).at(&mut drive).read().map_err(Error::from);
    assert_eq!(short, Err(Error::Length(LengthError::new(4, 2))));

    let stream = drive.into_exchange().into_stream();
    let line = SerialLine::<_, _, 64>::with_ready(AsyncLine(stream), FRAMING, None).with_time(NEVER, TIMEOUT);
    let mut drive = Parameters::<_, _, 20>::new(line, Messages);
    now(async {
        POSITION.at(&mut drive).write_async(-7).await.unwrap();
        assert_eq!(POSITION.at(&mut drive).read_async().await, Ok(-7));
        assert_eq!(GAIN.at(&mut drive).read_async().await, Ok(-2));
    });
    // The reply in this test belongs to another request.
    let line = SerialLine::<_, _, 64>::with_ready(Line::replying(framed(b"w\x04")), FRAMING, None);
    let mut drive = Parameters::<_, _, 20>::new(line, Messages);
    assert_eq!(GAIN.at(&mut drive).write(1).map_err(Error::from), Err(Error::UnexpectedReply));
    let line = SerialLine::<_, _, 64>::with_ready(Line::default(), FRAMING, None);
    let mut small = Parameters::<_, _, 3>::new(line, Messages);
    assert_eq!(GAIN.at(&mut small).write(1).map_err(Error::from), Err(Error::Length(LengthError::new(4, 3))));
}

#[test]
fn borrowed_exchanges() {
    fn once(mut line: impl Exchange) -> bool {
        line.exchange(&[1], &mut [0; 8]).is_ok()
    }
    async fn once_async(mut line: impl AsyncExchange) -> bool {
        line.exchange(&[1], &mut [0; 8]).await.is_ok()
    }
    let mut line: SerialLine<_, _, 64> = SerialLine::with_ready(Line::replying(framed(&[1])), FRAMING, None);
    assert!(once(&mut line) && !once(&mut line));
    let stream = AsyncLine(Line::replying(framed(&[1])));
    let mut line = SerialLine::<_, _, 64>::with_ready(stream, FRAMING, None).with_time(NEVER, TIMEOUT);
    assert!(now(once_async(&mut line)) && !now(once_async(&mut line)));
}
