//! Tests the encoding and decoding of all requests and replies, both intact and damaged.

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::fmt::Debug;
use std::future::{poll_fn, Future};
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake};

use lexibus::clients::serial::{embedded_io_async, SerialLine};
use lexibus::framing::FrameError;
use lexibus::message::{List, Message, Reader, Reply, Request as Received, Setting, Settings, WriteError, Writer};
use lexibus::{AsyncExchange, LengthError, OutOfRange, Parameter};
use lexibus_drives::hsd::messages::*;
use lexibus_drives::hsd::types::{BitStato, HomingState, MotorType, State};

use super::{found, found_in_pieces, framed};

const NODE: u32 = 5;

/// Returns the encoded data of a request.
fn sent(message: &impl Message) -> Vec<u8> {
    let mut data = [0; MAX_DATA];
    let mut to = Writer::new(&mut data);
    message.write(NODE, &mut to).expect("a message of the protocol");
    to.written().to_vec()
}

fn answered<'r>(reply: &impl Reply<'r>, request: &[u8]) -> Vec<u8> {
    let mut data = [0; MAX_DATA];
    let mut to = Writer::new(&mut data);
    reply.write(request, &mut to).expect("a message of the protocol");
    to.written().to_vec()
}

/// Checks that a packet is decoded in three cases: if it arrives in two pieces, if it follows noise, and if any one of its
/// bytes needs an escape.
fn framing_holds(data: &[u8]) {
    let frame = framed(data);
    let whole = [Ok(data.to_vec())];
    for at in 0..frame.len() {
        let (first, second) = frame.split_at(at);
        assert_eq!(found_in_pieces(&[first, second]), whole, "broken at {at}");
        assert_eq!(answer_in_pieces(first, second), data, "broken at {at}");
        // The noise is the end of a packet whose start is missing.
        assert_eq!(found(&[second, &frame].concat()).last(), Some(&Ok(data.to_vec())), "from {at} on");
    }
    for (place, special) in (0..data.len()).flat_map(|place| SPECIAL.map(|special| (place, special))) {
        let mut changed = data.to_vec();
        changed[place] = special;
        assert_eq!(found(&framed(&changed)), [Ok(changed)], "{special:#04X} at {place}");
    }
}

/// Bytes that need an escape, and their replacements.
const SPECIAL: [u8; 6] = [0x02, 0x03, 0x1B, 0xFD, 0xFC, 0xE4];

/// A line on which the reply arrives in two pieces. The reader must wait between the two pieces.
struct Pieces<'a> {
    now: &'a [u8],
    later: Option<&'a [u8]>,
}

impl embedded_io_async::ErrorType for Pieces<'_> {
    type Error = Infallible;
}

impl embedded_io_async::Read for Pieces<'_> {
    async fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        if self.now.is_empty() {
            // Return `Pending` once before the second piece.
            poll_fn(|_| match self.later.take() {
                Some(later) => {
                    self.now = later;
                    Poll::Pending
                }
                None => Poll::Ready(()),
            })
            .await;
        }
        embedded_io_async::Read::read(&mut self.now, buffer).await
    }
}

impl embedded_io_async::Write for Pieces<'_> {
    async fn write(&mut self, data: &[u8]) -> Result<usize, Infallible> {
        Ok(data.len())
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// A waker that does nothing, because the test itself polls the exchange again.
struct Silent;

impl Wake for Silent {
    fn wake(self: Arc<Self>) {}
}

/// Returns the reply that a client decodes if it arrives in two pieces.
fn answer_in_pieces(first: &[u8], second: &[u8]) -> Vec<u8> {
    let pieces = Pieces { now: first, later: Some(second) };
    let mut line = SerialLine::<_, _, 140>::with_ready(pieces, FRAMING, None)
        .with_time(|_| std::future::pending::<()>(), std::time::Duration::from_secs(1));
    let mut reply = [0; MAX_DATA];
    let length = {
        let mut exchange = pin!(AsyncExchange::exchange(&mut line, &[NODE as u8, 8, 0], &mut reply));
        let waker = Arc::new(Silent).into();
        let mut context = Context::from_waker(&waker);
        assert!(exchange.as_mut().poll(&mut context).is_pending());
        match exchange.as_mut().poll(&mut context) {
            Poll::Ready(length) => length.expect("a reply"),
            Poll::Pending => panic!("the whole frame is there"),
        }
    };
    reply[..length].to_vec()
}

/// Checks all single-bit errors. A damaged packet must be rejected or decoded unchanged, but never decoded as another
/// packet. The next packet must be decoded.
fn damage_is_found(data: &[u8]) {
    let (frame, next) = (framed(data), framed(&[9, 8, 0]));
    for bit in 0..8 * frame.len() {
        let mut damaged = frame.clone();
        damaged[bit / 8] ^= 1 << (bit % 8);
        let mut frames = found(&[damaged, next.clone(), next.clone()].concat());
        assert_eq!(frames.pop(), Some(Ok(vec![9, 8, 0])), "bit {bit} of {frame:02X?}");
        let other =
            |frame: &&Result<Vec<u8>, FrameError>| matches!(frame, Ok(frame) if frame != data && frame != &[9, 8, 0]);
        assert_eq!(frames.iter().find(other), None, "bit {bit} of {frame:02X?}");
    }
}

/// Encodes and decodes a request and its reply, both intact and damaged. Returns the name of the request. `length` is
/// the manual's packet length of the reply: with start, checksum and end, but without escapes.
fn exchanged<'r, M, R>(request: M, reply: R, length: usize) -> &'static str
where
    M: for<'q> Received<'q> + Debug + PartialEq,
    R: for<'q> Reply<'q> + Debug + PartialEq,
    M: Message<Reply<'r> = R>,
{
    let data = sent(&request);
    assert_eq!(M::parse(&mut Reader::new(&data)), Some((NODE, request)));
    let answer = answered(&reply, &data);
    assert_eq!(R::read(&data, &mut Reader::new(&answer)), Some(reply));
    assert_eq!(answer.len() + 3, length, "{answer:02X?}");
    for data in [&data, &answer] {
        framing_holds(data);
        damage_is_found(data);
    }
    assert!(Request::parse(&data).is_some_and(|(node, _)| node == NODE), "a simulated motor recognizes the request");
    M::NAME
}

fn done() -> BitStato {
    BitStato::new().with_command_complete(true)
}

fn setting(parameter: u32, value: &[u8]) -> Setting {
    Setting::of(Parameter(parameter), value).expect("at most eight bytes")
}

/// Tests the 36 named requests, and the null request with its four meanings.
#[test]
#[rustfmt::skip]
fn every_packet_goes_there_and_comes_back() {
    let mut seen = BTreeSet::new();
    seen.insert(exchanged(CmdReset, CmdResetReply { status: done() }, 9));
    seen.insert(exchanged(CmdNoReg, CmdNoRegReply { status: done() }, 9));
    seen.insert(exchanged(CmdReg, CmdRegReply { status: done() }, 9));
    seen.insert(exchanged(CmdHold, CmdHoldReply { status: done() }, 9));
    seen.insert(exchanged(CmdMazz { position: 0x0102_AB34 }, CmdMazzReply { status: done() }, 9));
    seen.insert(exchanged(CmdAzz, CmdAzzReply { status: done() }, 9));
    seen.insert(exchanged(CmdJogN { speed: -578 }, CmdJogNReply { status: done() }, 9));
    seen.insert(exchanged(CmdTraj { target: 1_798_046 }, CmdTrajReply { status: done() }, 9));
    seen.insert(exchanged(CmdTrajVel { target: 1_798_046, speed: 468 }, CmdTrajVelReply { status: done() }, 10));
    seen.insert(exchanged(PollPosition, PollPositionReply { status: done(), real_position: 0x09C1_10AB }, 9));
    seen.insert(exchanged(PollTheoreticalPosition, PollTheoreticalPositionReply { status: done(), theoretical_position: -3 }, 9));
    seen.insert(exchanged(PollSpeeds, PollSpeedsReply { status: done(), real_speed: -2368, theoretical_speed: 0x0203 }, 9));
    seen.insert(exchanged(PollTorques, PollTorquesReply { status: done(), real_torque: 0x1B, theoretical_torque: -1 }, 9));
    seen.insert(exchanged(CmdEmerg, CmdEmergReply { status: done() }, 9));
    seen.insert(exchanged(CmdSetOverr { r#override: 90 }, CmdSetOverrReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetOverr, CmdGetOverrReply { status: done(), r#override: 200 }, 9));
    seen.insert(exchanged(CmdGetParN { parameter: Parameter(0x0105) }, CmdGetParNReply { status: done(), setting: setting(0x0105, &[150, 0]) }, 11));
    seen.insert(exchanged(CmdGetParN { parameter: Parameter(0x011C) }, CmdGetParNReply { status: done(), setting: setting(0x011C, &[1, 2, 3, 0x1B]) }, 13));
    seen.insert(exchanged(CmdChgPar { setting: setting(0x0003, &[2, 3]) }, CmdChgParReply { status: done() }, 9));
    seen.insert(exchanged(CmdSaveParFl, CmdSaveParFlReply { status: done() }, 9));
    seen.insert(exchanged(CmdAdcOff, CmdAdcOffReply { status: done() }, 9));
    seen.insert(exchanged(CmdAzzEl { method: 0 }, CmdAzzElReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetStatAzz, CmdGetStatAzzReply { status: done(), homing_state: HomingState::from_raw(2) }, 9));
    seen.insert(exchanged(CmdGetDistMicroZero, CmdGetDistMicroZeroReply { status: done(), distance: 799 }, 11));
    seen.insert(exchanged(CmdGetPos, CmdGetPosReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetPosT, CmdGetPosTReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetVel, CmdGetVelReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetTor, CmdGetTorReply { status: done() }, 9));
    seen.insert(exchanged(CmdGetAlarm, CmdGetAlarmReply { status: done(), message: 0x4001 }, 9));
    seen.insert(exchanged(CmdGetVer, CmdGetVerReply { status: done(), version: 103 }, 9));
    seen.insert(exchanged(CmdGetType, CmdGetTypeReply { status: done(), r#type: MotorType::from_raw(0x10) }, 9));
    seen.insert(exchanged(CmdGetSmStat, CmdGetSmStatReply { status: done(), state: State::from_raw(4) }, 9));
    seen.insert(exchanged(CmdSampleVar { variable_1: 2, variable_2: 3 }, CmdSampleVarReply { status: done() }, 9));
    seen.insert(exchanged(CmdSampleMem { address_1: 0x0203, address_2: 0x1BFD, sampling_time: 1 }, CmdSampleMemReply { status: done() }, 9));
    seen.insert(exchanged(CmdRegWait, CmdRegWaitReply { status: done() }, 9));
    seen.insert(exchanged(CmdHoldWait, CmdHoldWaitReply { status: done() }, 9));
    seen.insert(exchanged(CmdJog { speed: -2368 }, CmdJogReply { status: done() }, 9));
    seen.insert(exchanged(CmdAzzElWait { method: 0 }, CmdAzzElWaitReply { status: done() }, 9));
    seen.insert(exchanged(CmdSample { variable_1: 1, variable_2: 4 }, CmdSampleReply { status: done() }, 9));
    // The following messages borrow data from the packet.
    let settings = [setting(0x0105, &[150, 0]), setting(0x011C, &[1, 2, 3, 0x1B])];
    let request = CmdChgParN { settings: Settings::sent(&settings, PARAMETER) };
    let data = sent(&request);
    assert_eq!(CmdChgParN::parse(&mut Reader::new(&data)), Some((NODE, request)));
    let answer = answered(&CmdChgParNReply { status: done() }, &data);
    assert_eq!(CmdChgParNReply::read(&data, &mut Reader::new(&answer)), Some(CmdChgParNReply { status: done() }));
    assert_eq!(answer, [5, 2, 0xB8, 0, 0x01, 0x05]);
    seen.insert(CmdChgParN::NAME);
    let entries = [CmdGetSampReplyEntry { variable_1: -2, variable_2: 0x1B02 }; 14];
    let reply = CmdGetSampReply { status: done(), entries: List::from(&entries) };
    let data_of_samples = sent(&CmdGetSamp);
    let samples = answered(&reply, &data_of_samples);
    assert_eq!(CmdGetSampReply::read(&data_of_samples, &mut Reader::new(&samples)), Some(reply));
    seen.insert(CmdGetSamp::NAME);
    for data in [&data, &answer, &data_of_samples, &samples] {
        framing_holds(data);
        damage_is_found(data);
    }
    assert_eq!(seen.len(), 36 + 4, "{seen:?}");
}

/// Any reply can be replaced with a refusal, except replies to the null request. The refusal must not be decoded as the
/// expected reply.
#[test]
fn refusals() {
    let jog = sent(&CmdJogN { speed: -578 });
    let refusal = CmdNack { node: 5, status: done() };
    let data = answered(&refusal, &jog);
    assert_eq!(data, [5, 2, 0xB0, 0, 0xFD, 0xBE]);
    framing_holds(&data);
    assert_eq!(CmdNack::read(&jog, &mut Reader::new(&data)), Some(refusal));
    assert_eq!(CmdJogNReply::read(&jog, &mut Reader::new(&data)), None);
    // A reply with a position can contain the byte that identifies a refusal. The reply is not a refusal, because a
    // motor cannot refuse the null request.
    let poll = sent(&PollPosition);
    let position = PollPositionReply { status: done(), real_position: 0x0000_B000 };
    let data = answered(&position, &poll);
    assert_eq!((data[2], PollPositionReply::read(&poll, &mut Reader::new(&data))), (0xB0, Some(position)));
    fn never<M: Message<Refusal = Infallible>>(_: M) {}
    never(PollPosition);
    never(PollSpeeds);
}

/// Tests packets of all lengths with a byte that needs an escape at each position.
#[test]
fn special_bytes_anywhere() {
    for length in 1..=MAX_DATA {
        for special in SPECIAL {
            for place in 0..length {
                let mut data = vec![0x41; length];
                data[place] = special;
                assert_eq!(found(&framed(&data)), [Ok(data)]);
            }
            assert_eq!(found(&framed(&vec![special; length])), [Ok(vec![special; length])]);
        }
    }
}

/// The maximum of 68 data bytes (section 2.3) is enough for 16 parameters of 16 bits, 10 parameters of 32 bits, or 15
/// samples.
#[test]
fn the_longest_packets() {
    let (short, long) = (setting(0x0105, &[2, 3]), setting(0x011C, &[0x1B, 2, 3, 0x1B]));
    let too_many = WriteError::OutOfRange(OutOfRange);
    let too_long = WriteError::Length(LengthError::new(MAX_DATA, 70));
    for (setting, count, length, refusal) in [(short, 16, 68, too_many), (long, 10, 64, too_long)] {
        let settings = vec![setting; count];
        let request = CmdChgParN { settings: Settings::sent(&settings, PARAMETER) };
        let data = sent(&request);
        assert_eq!(data.len(), length);
        let Some((NODE, Request::CmdChgParN(received))) = Request::parse(&data) else { panic!("{data:02X?}") };
        assert_eq!(received.settings.iter().collect::<Vec<_>>(), settings);
        framing_holds(&data);
        damage_is_found(&data);
        let one_more = vec![setting; count + 1];
        let request = CmdChgParN { settings: Settings::sent(&one_more, PARAMETER) };
        assert_eq!(request.write(NODE, &mut Writer::new(&mut [0; MAX_DATA])), Err(refusal));
    }
    let request = sent(&CmdGetSamp);
    let entries = [CmdGetSampReplyEntry { variable_1: 0x0203, variable_2: 0x1B1B }; 16];
    let reply = CmdGetSampReply { status: done(), entries: List::from(&entries[..15]) };
    let data = answered(&reply, &request);
    assert_eq!(data.len(), MAX_DATA);
    assert_eq!(CmdGetSampReply::read(&request, &mut Reader::new(&data)), Some(reply));
    framing_holds(&data);
    damage_is_found(&data);
    let reply = CmdGetSampReply { status: done(), entries: List::from(&entries) };
    let refused = reply.write(&request, &mut Writer::new(&mut [0; 2 * MAX_DATA]));
    assert_eq!(refused, Err(too_many));
    // If all data bytes are escaped, the frame contains two bytes for each data byte, and one byte each for start,
    // checksum and end.
    assert_eq!(framed(&[0x1B; MAX_DATA]).len(), 1 + 2 * MAX_DATA + 1 + 1);
    assert_eq!(framed(&[[0x1B; MAX_DATA - 1].as_slice(), &[0xFF]].concat()).len(), 139);
}

/// Tests frames according to sections 2.1 to 2.3. The manual prints no frame with its checksum.
#[test]
fn frames_on_the_wire() {
    fn holds(data: &[u8], frame: &[u8]) {
        assert_eq!(framed(data), frame);
        assert_eq!(found(frame), [Ok(data.to_vec())]);
    }
    fn request<M>(node: u32, message: M, frame: &[u8]) -> Vec<u8>
    where
        M: Message + for<'q> Received<'q> + Debug + PartialEq,
    {
        let mut room = [0; MAX_DATA];
        let mut to = Writer::new(&mut room);
        message.write(node, &mut to).expect("a message of the protocol");
        let data = to.written().to_vec();
        holds(&data, frame);
        let received = found(frame).remove(0).expect("a frame");
        assert_eq!(M::parse(&mut Reader::new(&received)), Some((node, message)));
        data
    }
    fn reply<R>(to_what: &[u8], message: R, frame: &[u8])
    where
        R: for<'q> Reply<'q> + Debug + PartialEq,
    {
        holds(&answered(&message, to_what), frame);
        let received = found(frame).remove(0).expect("a frame");
        assert_eq!(R::read(to_what, &mut Reader::new(&received)), Some(message));
    }
    request(5, CmdReset, &[0x02, 0x05, 0x08, 0x9C, 0x00, 0x00, 0x00, 0x6E, 0x03]);
    let target = CmdTraj { target: 1_798_046 };
    request(1, target, &[0x02, 0x01, 0x1B, 0xFD, 0x6F, 0x9E, 0x00, 0x1B, 0xE4, 0x16, 0x03]);
    let position = CmdMazz { position: 0x0102_AB34 };
    request(1, position, &[0x02, 0x01, 0x01, 0xAB, 0x34, 0x01, 0x1B, 0xFD, 0x63, 0x03]);
    let jog = request(1, CmdJogN { speed: -578 }, &[0x02, 0x01, 0x08, 0xE0, 0x00, 0xFD, 0xBE, 0x55, 0x03]);
    let poll = request(1, PollPosition, &[0x02, 0x01, 0x08, 0x00, 0xF6, 0x03]);
    let position = PollPositionReply { status: done(), real_position: 0x09C1_10AB };
    reply(&poll, position, &[0x02, 0x01, 0x1B, 0xFD, 0x10, 0xAB, 0x09, 0xC1, 0x8F, 0x03]);
    let refusal = CmdNack { node: 1, status: done() };
    reply(&jog, refusal, &[0x02, 0x01, 0x1B, 0xFD, 0xB0, 0x00, 0xFD, 0xBE, 0x0F, 0x03]);
}
