//! Tests of the client and the server with each other, and with invalid messages.

mod lossy;

use core::time::Duration;
use std::collections::{HashMap, VecDeque};
use std::vec;
use std::vec::Vec;

use super::*;
use crate::{AbortCode, LengthError, Object};

const OBJECT: Object = Object::new(0x2002, 1);
/// Length of a value with three sub-blocks.
const LONG: usize = 2000;

#[derive(Default)]
struct Values(HashMap<Object, Vec<u8>>);

impl Objects for Values {
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let value = self.0.get(&object).ok_or(AbortCode::NO_OBJECT)?;
        buffer.get_mut(..value.len()).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(value);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        self.0.insert(object, data.to_vec());
        Ok(())
    }
}

/// A server and its objects.
struct Device {
    server: Server<4096>,
    values: Values,
}

impl Device {
    fn new(value: &[u8]) -> Self {
        Self { server: Server::new(), values: Values(HashMap::from([(OBJECT, value.to_vec())])) }
    }

    fn ask(&mut self, request: Message) -> Vec<Message> {
        self.server.handle(&request, Duration::ZERO, &mut self.values);
        core::iter::from_fn(|| self.server.next()).collect()
    }

    fn value(&self) -> &[u8] {
        &self.values.0[&OBJECT]
    }
}

fn value(length: usize) -> Vec<u8> {
    (0..length).map(|at| (at % 251) as u8).collect()
}

/// Runs a transfer. `fate` returns how often a message arrives. Its first argument is `false` for a request and `true`
/// for a reply. Returns the result and all messages.
fn run(
    transfer: &mut Transfer<'_>,
    device: &mut Device,
    mut fate: impl FnMut(bool, &Message) -> usize,
) -> (Result<usize, TransferError>, Vec<Message>) {
    let (mut replies, mut log) = (VecDeque::new(), Vec::new());
    // The server waits longer than the client, so the client ends each transfer.
    for _ in 0..100_000 {
        while let Some(request) = transfer.next() {
            log.push(request);
            for _ in 0..fate(false, &request) {
                for reply in device.ask(request) {
                    log.push(reply);
                    replies.extend(core::iter::repeat(reply).take(fate(true, &reply)));
                }
            }
        }
        if let Some(result) = transfer.result() {
            return (result, log);
        }
        match replies.pop_front() {
            Some(reply) => transfer.handle(&reply),
            None => transfer.time_out(),
        }
    }
    panic!("the transfer doesn't end");
}

fn always(_: bool, _: &Message) -> usize {
    1
}

#[test]
fn lengths() {
    for length in [1, 4, 5, 7, 8, 28, 29, 889, 890, 1778, 1779, LONG, 4096] {
        for threshold in [0, 8, BLOCK_THRESHOLD, usize::MAX] {
            let (value, mut buffer) = (value(length), vec![0; length]);
            let mut device = Device::new(&[]);
            let mut download = Transfer::download(OBJECT, &value, threshold).expect("not empty");
            assert_eq!(run(&mut download, &mut device, always).0, Ok(length), "{length} {threshold}");
            assert_eq!(device.value(), value);
            let mut upload = Transfer::upload(OBJECT, &mut buffer, threshold);
            assert_eq!(run(&mut upload, &mut device, always).0, Ok(length), "{length} {threshold}");
            assert_eq!(buffer, value);
        }
    }
    assert!(Transfer::download(OBJECT, &[], 0).is_err());
}

#[test]
fn the_length_selects_the_protocol() {
    let first = |length: usize| Transfer::download(OBJECT, &vec![0; length], 100).map(|mut it| it.next().unwrap()[0]);
    assert_eq!([4, 99, 100].map(first), [Ok(0x23), Ok(0x21), Ok(0xC6)]);
    let first = |length: usize| Transfer::upload(OBJECT, &mut vec![0; length], 100).next().unwrap();
    assert_eq!([4, 99, 100].map(|length| first(length)[0]), [0x40, 0x40, 0xA4]);
    assert_eq!(first(100), [0xA4, 0x02, 0x20, 1, 127, 28, 0, 0]);
    // Blocks need fewer messages: each sub-block has one confirmation.
    let count = |threshold| {
        let value = value(LONG);
        run(&mut Transfer::download(OBJECT, &value, threshold).unwrap(), &mut Device::new(&[]), always).1.len()
    };
    assert_eq!((count(usize::MAX), count(0)), (2 + 2 * 286, 2 + 286 + 3 + 2));
}

#[test]
fn the_server_switches_the_protocol_for_short_values() {
    let mut buffer = [0; LONG];
    for (length, messages) in [(3, 2), (28, 10), (29, 11)] {
        let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
        let (result, log) = run(&mut upload, &mut Device::new(&value(length)), always);
        assert_eq!((result, log.len()), (Ok(length), messages));
        assert_eq!(buffer[..length], value(length));
    }
}

#[test]
fn an_empty_value_is_read_in_segments_and_in_blocks() {
    let mut buffer = [0; 8];
    for threshold in [0, usize::MAX] {
        let mut upload = Transfer::upload(OBJECT, &mut buffer, threshold);
        assert_eq!(run(&mut upload, &mut Device::new(&[]), always).0, Ok(0));
    }
    let mut device = Device::new(&[]);
    // Without a threshold for switching, the server sends an empty block.
    assert_eq!(device.ask([0xA4, 0x02, 0x20, 1, 127, 0, 0, 0])[0][0], 0xC6);
    assert_eq!(device.ask([0xA3, 0, 0, 0, 0, 0, 0, 0]), [[0x81, 0, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(device.ask([0xA2, 1, 127, 0, 0, 0, 0, 0]), [[0xDD, 0, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(device.ask([0xA1, 0, 0, 0, 0, 0, 0, 0]), [] as [Message; 0]);
    assert_eq!(device.server.deadline(), None);
}

#[test]
fn a_server_without_blocks() {
    let (value, mut buffer) = (value(LONG), [0; LONG]);
    let mut device = Device::new(&[]);
    device.server.allow_blocks(false);
    let mut download = Transfer::download(OBJECT, &value, 0).unwrap();
    assert_eq!(run(&mut download, &mut device, always).0, Ok(LONG));
    assert!(download.is_block_refused() && device.value() == value);
    let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
    assert_eq!(run(&mut upload, &mut device, always).0, Ok(LONG));
    assert!(upload.is_block_refused());
    assert_eq!(buffer[..], value);
    // Other abort codes end the transfer.
    let mut upload = Transfer::upload(Object::new(0x2003, 0), &mut buffer, 0);
    device.server.allow_blocks(true);
    assert_eq!(run(&mut upload, &mut device, always).0, Err(TransferError::Refused(AbortCode::NO_OBJECT)));
}

#[test]
fn a_server_without_crc() {
    let value = value(LONG);
    let mut download = Transfer::download(OBJECT, &value, 0).unwrap();
    assert_eq!(download.next().map(|request| request[0]), Some(0xC6));
    download.handle(&[0xA0, 0x02, 0x20, 1, 127, 0, 0, 0]);
    assert_eq!(download.next(), Some([0x80, 0x02, 0x20, 1, 0, 0, 0, 8]));
    assert_eq!(download.next(), Some([0x21, 0x02, 0x20, 1, 0xD0, 0x07, 0, 0]));
    // A client without CRC is served.
    let mut device = Device::new(&value);
    assert_eq!(device.ask([0xA0, 0x02, 0x20, 1, 127, 0, 0, 0])[0][0], 0xC2);
    assert_eq!(device.ask([0xA3, 0, 0, 0, 0, 0, 0, 0]).len(), 127);
    assert_eq!(device.ask([0xA2, 127, 127, 0, 0, 0, 0, 0]).len(), 127);
    assert_eq!(device.ask([0xA2, 127, 127, 0, 0, 0, 0, 0]).len(), 286 - 254);
    assert_eq!(device.ask([0xA2, 32, 127, 0, 0, 0, 0, 0]), [[0xC1 | 2 << 2, 0, 0, 0, 0, 0, 0, 0]]);
}

#[test]
fn lost_segments_are_sent_again() {
    let (value, mut buffer) = (value(LONG), [0; LONG]);
    let mut device = Device::new(&[]);
    // Segments 5 and 6 of the first sub-block are lost.
    let loses = |is_reply: bool| {
        let mut lost = 2;
        move |of_server: bool, message: &Message| {
            let is_lost = of_server == is_reply && lost > 0 && message[1] == 28 + 7 * (2 - lost as u8);
            lost -= usize::from(is_lost);
            usize::from(!is_lost)
        }
    };
    let mut download = Transfer::download(OBJECT, &value, 0).unwrap();
    let (result, log) = run(&mut download, &mut device, loses(false));
    assert_eq!((result, device.value()), (Ok(LONG), &value[..]));
    assert!(log.contains(&[0xA2, 4, 127, 0, 0, 0, 0, 0]));
    let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
    let (result, log) = run(&mut upload, &mut device, loses(true));
    assert_eq!((result, &buffer[..]), (Ok(LONG), &value[..]));
    assert!(log.contains(&[0xA2, 4, 127, 0, 0, 0, 0, 0]));
}

/// Runs a block upload with a buffer of 10 bytes. `end` is the message that ends the transfer. Returns the result and the
/// last message of the client.
fn upload_with(start: Message, segments: &[Message], end: Message) -> (Option<Result<usize, TransferError>>, Message) {
    let mut buffer = [0; 10];
    let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
    let mut last = upload.next();
    for message in [&[start], segments, &[end]].concat() {
        upload.handle(&message);
        last = upload.next().or(last);
    }
    (upload.result(), last.unwrap_or_default())
}

const START: Message = [0xC6, 0x02, 0x20, 1, 10, 0, 0, 0];
const SEGMENTS: [Message; 2] = [[1, 0, 1, 2, 3, 4, 5, 6], [0x82, 7, 8, 9, 0, 0, 0, 0]];

#[test]
fn wrong_replies_abort_a_block_upload() {
    let [low, high] = super::crc::crc(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]).to_le_bytes();
    let end = [0xC1 | 4 << 2, low, high, 0, 0, 0, 0, 0];
    assert_eq!(upload_with(START, &SEGMENTS, end), (Some(Ok(10)), [0xA1, 0, 0, 0, 0, 0, 0, 0]));
    let unexpected = |code| (Some(Err(TransferError::UnexpectedReply)), abort(OBJECT, code));
    let wrong_crc = [end[0], low ^ 1, high, 0, 0, 0, 0, 0];
    assert_eq!(upload_with(START, &SEGMENTS, wrong_crc), unexpected(AbortCode::CRC));
    let wrong_size = [0xC1 | 5 << 2, low, high, 0, 0, 0, 0, 0];
    assert_eq!(upload_with(START, &SEGMENTS, wrong_size), unexpected(AbortCode::LENGTH));
    let too_long = |length| {
        let error = TransferError::TooLong(LengthError::new(10, length));
        (Some(Err(error)), abort(OBJECT, AbortCode::OUT_OF_MEMORY))
    };
    assert_eq!(upload_with([0xC6, 0x02, 0x20, 1, 11, 0, 0, 0], &[], end), too_long(11));
    let unsized_start = [0xC4, 0x02, 0x20, 1, 0, 0, 0, 0];
    assert_eq!(upload_with(unsized_start, &SEGMENTS, end), (Some(Ok(10)), [0xA1, 0, 0, 0, 0, 0, 0, 0]));
    assert_eq!(upload_with(unsized_start, &SEGMENTS, [0xC1, low, high, 0, 0, 0, 0, 0]), too_long(14));
}

#[test]
fn wrong_sequence_numbers_abort_a_block_transfer() {
    let mut buffer = [0; 10];
    let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
    upload.next();
    upload.handle(&START);
    upload.next();
    upload.handle(&[0x80, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(upload.result(), Some(Err(TransferError::UnexpectedReply)));
    assert_eq!(upload.next(), Some(abort(OBJECT, AbortCode::SEQUENCE_NUMBER)));
    let value = value(100);
    for (acknowledgment, code) in [([16, 127], AbortCode::SEQUENCE_NUMBER), ([1, 0], AbortCode::BLOCK_SIZE)] {
        let mut download = Transfer::download(OBJECT, &value, 0).unwrap();
        download.next();
        download.handle(&[0xA4, 0x02, 0x20, 1, 127, 0, 0, 0]);
        assert_eq!(core::iter::from_fn(|| download.next()).count(), 15);
        let [sequence, size] = acknowledgment;
        download.handle(&[0xA2, sequence, size, 0, 0, 0, 0, 0]);
        assert_eq!(download.next(), Some(abort(OBJECT, code)));
    }
    let mut device = Device::new(&value);
    device.ask([0xA4, 0x02, 0x20, 1, 127, 0, 0, 0]);
    device.ask([0xA3, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(device.ask([0xA2, 16, 127, 0, 0, 0, 0, 0]), [abort(OBJECT, AbortCode::SEQUENCE_NUMBER)]);
    device.ask([0xC6, 0x02, 0x20, 1, 100, 0, 0, 0]);
    assert_eq!(device.ask([0x80, 1, 2, 3, 4, 5, 6, 7]), [] as [Message; 0], "an abort");
    device.ask([0xC6, 0x02, 0x20, 1, 100, 0, 0, 0]);
    assert_eq!(device.ask([0x00, 1, 2, 3, 4, 5, 6, 7]), [abort(OBJECT, AbortCode::SEQUENCE_NUMBER)]);
    assert_eq!(device.ask([0xA4, 0x02, 0x20, 1, 0, 0, 0, 0]), [abort(OBJECT, AbortCode::BLOCK_SIZE)]);
}

#[test]
fn the_server_refuses_a_wrong_block_download() {
    let start = |size| [0xC6, 0x02, 0x20, 1, size, 0, 0, 0];
    let end = |low| [0xC1 | 4 << 2, low, 0, 0, 0, 0, 0, 0];
    for (size, code) in [(10, AbortCode::CRC), (9, AbortCode::LENGTH)] {
        let mut device = Device::new(&[1]);
        assert_eq!(device.ask(start(size)), [[0xA4, 0x02, 0x20, 1, 127, 0, 0, 0]]);
        assert_eq!(device.ask(SEGMENTS[0]), [] as [Message; 0]);
        assert_eq!(device.ask(SEGMENTS[1]), [[0xA2, 2, 127, 0, 0, 0, 0, 0]]);
        assert_eq!(device.ask(SEGMENTS[1]), [] as [Message; 0], "a repeated frame");
        assert_eq!(device.ask(end(0)), [abort(OBJECT, code)]);
        assert_eq!(device.value(), [1], "nothing is written");
    }
    let mut device = Device::new(&[1]);
    let too_long = [0xC6, 0x02, 0x20, 1, 1, 0x10, 0, 0];
    assert_eq!(device.ask(too_long), [abort(OBJECT, AbortCode::OUT_OF_MEMORY)]);
    // Segments and ends without a transfer.
    assert_eq!(device.ask(end(0)), [abort(Object::new(0, 0), AbortCode::COMMAND)]);
    assert_eq!(device.ask([0x60, 0, 0, 0, 0, 0, 0, 0]), [abort(Object::new(0, 0), AbortCode::COMMAND)]);
    assert_eq!(device.ask([0xE0, 0x02, 0x20, 1, 0, 0, 0, 0]), [abort(OBJECT, AbortCode::COMMAND)]);
}

#[test]
fn toggle_bits_and_sizes_of_segments() {
    let mut device = Device::new(&value(20));
    device.ask([0x40, 0x02, 0x20, 1, 0, 0, 0, 0]);
    assert_eq!(device.ask([0x70, 0, 0, 0, 0, 0, 0, 0]), [abort(OBJECT, AbortCode::TOGGLE_BIT)]);
    device.ask([0x21, 0x02, 0x20, 1, 20, 0, 0, 0]);
    assert_eq!(device.ask([0x10, 1, 2, 3, 4, 5, 6, 7]), [abort(OBJECT, AbortCode::TOGGLE_BIT)]);
    device.ask([0x21, 0x02, 0x20, 1, 20, 0, 0, 0]);
    assert_eq!(device.ask([0x01, 1, 2, 3, 4, 5, 6, 7]), [abort(OBJECT, AbortCode::LENGTH)]);
    assert_eq!(device.value(), value(20));
    let mut buffer = [0; 20];
    for (segment, code) in [([0x10; 8], AbortCode::TOGGLE_BIT), ([0x01; 8], AbortCode::LENGTH)] {
        let mut upload = Transfer::upload(OBJECT, &mut buffer, usize::MAX);
        upload.next();
        upload.handle(&[0x41, 0x02, 0x20, 1, 20, 0, 0, 0]);
        upload.next();
        upload.handle(&segment);
        assert_eq!(
            (upload.result(), upload.next()),
            (Some(Err(TransferError::UnexpectedReply)), Some(abort(OBJECT, code)))
        );
    }
    let value = value(20);
    let mut download = Transfer::download(OBJECT, &value, usize::MAX).unwrap();
    download.next();
    download.handle(&[0x60, 0x02, 0x20, 1, 0, 0, 0, 0]);
    assert_eq!(download.next().map(|segment| segment[0]), Some(0x00));
    download.handle(&[0x30, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(download.next(), Some(abort(OBJECT, AbortCode::TOGGLE_BIT)));
}

#[test]
fn the_server_times_out() {
    let mut device = Device::new(&value(LONG));
    device.ask([0xA4, 0x02, 0x20, 1, 127, 0, 0, 0]);
    assert_eq!(device.server.deadline(), Some(Duration::from_secs(1)));
    device.server.time_out(Duration::from_millis(999));
    assert_eq!(device.server.next(), None);
    device.server.time_out(Duration::from_secs(1));
    assert_eq!((device.server.next(), device.server.deadline()), (Some(abort(OBJECT, AbortCode::TIMEOUT)), None));
}

#[test]
fn limits_of_the_duration() {
    let (value, second) = (value(70), Duration::from_secs(1));
    let download = Transfer::download(OBJECT, &value, 0).unwrap();
    assert_eq!(download.limit(second), 2 * second);
    let mut buffer = [0; 70];
    let mut upload = Transfer::upload(OBJECT, &mut buffer, 0);
    assert_eq!(upload.limit(second), second);
    upload.handle(&[0xC6, 0x02, 0x20, 1, 70, 0, 0, 0]);
    assert_eq!(upload.limit(second), 2 * second);
}
