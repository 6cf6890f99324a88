//! Tests generated messages of a serial protocol, from the program to the bytes on the line and back. The device is a
//! simulated hoist.

mod bindings {
    lexibus::dictionary! {
        pub mod hoist = "tests/data/hoist.toml";
    }
}

#[path = "support/now.rs"]
mod now;

use std::collections::BTreeMap;
use std::convert::Infallible;

use bindings::hoist::messages::{self, *};
use bindings::hoist::{objects, types, Hoist};
use lexibus::framing::{FrameError, Framing};
use lexibus::message::{Completion, Failure, List, Message, Reader, Reply, Request as _, Setting, Settings, Writer};
use lexibus::{AsyncExchange, Error, Exchange, LengthError, OutOfRange, Parameter};
use now::now;

const NODE: u32 = 5;

/// A simulated hoist. The simulated hoist stores its parameters and refuses heights above 100 m.
#[derive(Default)]
struct Simulated {
    parameters: BTreeMap<u32, Setting>,
    height: i32,
    shows_load: bool,
    sent: Vec<Vec<u8>>,
}

impl Simulated {
    fn answer(&mut self, request: &[u8], to: &mut Writer<'_>) {
        self.sent.push(request.to_vec());
        let (station, received) = Request::parse(request).expect("a request");
        assert_eq!(station, NODE);
        let status = types::Status::new().with_done(true);
        let written = match received {
            Request::Go(go) if go.target > 100_000 => {
                let reason = types::Reason::OutOfRange;
                Refused { status, reason }.write(request, to)
            }
            Request::Go(go) => {
                self.height = go.target;
                GoReply { status: status.with_done(false) }.write(request, to)
            }
            Request::GoAtOnce(go) => {
                self.height = go.target;
                GoAtOnceReply.write(request, to)
            }
            Request::SelectLoad(_) => {
                self.shows_load = true;
                SelectLoadReply.write(request, to)
            }
            Request::SelectHeight(_) => {
                self.shows_load = false;
                SelectHeightReply.write(request, to)
            }
            // Both polls have the same request data, so the last selection determines the reply.
            Request::PollLoad(_) if self.shows_load => PollLoadReply { status, load: 0x7FFF }.write(request, to),
            Request::PollLoad(_) => PollHeightReply { status, height: self.height }.write(request, to),
            Request::Write(write) => {
                self.parameters.extend(write.settings.iter().map(|setting| (setting.parameter.0, setting)));
                WriteReply.write(request, to)
            }
            Request::Read(read) => match self.parameters.get(&read.parameter.0) {
                Some(setting) => ReadReply { setting: *setting }.write(request, to),
                None => Refused { status, reason: types::Reason::Unknown(9) }.write(request, to),
            },
            Request::Store(_) => StoreReply.write(request, to),
            Request::ReadFactoryValue(_) => {
                ReadFactoryValueReply { value: &[0x00, 0x01, 0xE2, 0x40] }.write(request, to)
            }
            Request::WriteFactoryValue(_) => to.bytes(&[]),
            Request::Samples(_) => {
                let entries = [
                    SamplesReplyEntry { load: -15, moving: 1, phase: 9 },
                    SamplesReplyEntry { load: 7, moving: 0, phase: 15 },
                ];
                SamplesReply { entries: List::from(&entries) }.write(request, to)
            }
            Request::Play(play) => {
                self.height = play.entries.iter().map(|entry| entry.height).sum();
                PlayReply.write(request, to)
            }
            Request::Note(note) => {
                self.height = note.rest.len() as i32;
                NoteReply.write(request, to)
            }
            Request::Name(_) => NameReply { rest: b"Winde" }.write(request, to),
        };
        written.expect("a buffer for the reply");
    }
}

impl Exchange for Simulated {
    type Error = Infallible;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Infallible>> {
        let mut to = Writer::new(reply);
        self.answer(request, &mut to);
        Ok(to.len())
    }
}

impl AsyncExchange for Simulated {
    type Error = Infallible;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error<Infallible>> {
        Exchange::exchange(self, request, reply)
    }
}

fn hoist() -> Hoist<lexibus::Parameters<Simulated, Protocol, { messages::MAX_DATA }>> {
    Hoist::on(Simulated::default(), NODE)
}

#[test]
fn orders_and_refusals() {
    let mut hoist = hoist();
    let reply = hoist.go(1798046, 600, -2).send().unwrap_err();
    assert!(matches!(reply, Failure::Error(Error::OutOfRange(OutOfRange))), "outside its range: {reply:?}");
    let reply = hoist.go(66_100, 600, -2).send().unwrap();
    assert!(!reply.is_complete());
    let expected = [5, 0x02, 0x02, 0x34, 0x00, 0x01, 0x25, 0x8E];
    assert_eq!(hoist.client().exchange().sent, [expected]);
    let refused = hoist.go(150_000, 0, 0).send().unwrap_err();
    assert!(matches!(&refused, Failure::Refused(Refused { reason: types::Reason::OutOfRange, .. })), "{refused:?}");
    assert_eq!(refused.into_error(), Error::Refused);
    #[allow(deprecated)]
    let older = hoist.go_at_once(-7).send();
    assert_eq!(older, Ok(GoAtOnceReply));
    assert_eq!((Go::COMPLETION, GoAtOnce::COMPLETION), (Completion::Polled, Completion::Delayed(100)));
    assert_eq!((Store::COMPLETION, Store::NAME), (Completion::Reply, "Store"));
}

#[test]
fn scales_of_fields() {
    assert_eq!((Go::SPEED.raw(300.0), Go::SPEED.physical(601)), (Ok(600), 300.5));
    assert_eq!((PollLoadReply::LOAD.physical(12), PollLoadReply::LOAD.physical(0x7FFF)), (Some(12.0), None));
    assert_eq!(SamplesReplyEntry::LOAD.physical(-15), -1.5);
}

#[test]
fn parameters_are_items() {
    let mut hoist = hoist();
    hoist.gain().write_scaled(1.5).unwrap();
    hoist.height().write(0x0102_AB34).unwrap();
    assert_eq!(hoist.gain().read(), Ok(150));
    assert_eq!(now(hoist.height().read_async()), Ok(0x0102_AB34));
    assert_eq!(hoist.serial().read(), Ok(123_456));
    assert_eq!(hoist.ramp().read().map_err(Error::from), Err(Error::Refused));
    assert_eq!(hoist.mode().write(types::Mode::Automatic), Ok(()));
    let sent = &hoist.client().exchange().sent;
    assert_eq!(sent[0], [5, 0xB8, 0x01, 0x05, 0x00, 0x96]);
    assert_eq!(sent[1], [5, 0xB8, 0x01, 0x0C, 0xAB, 0x34, 0x01, 0x02]);
    assert_eq!(sent[2], [5, 0xC0, 0x01, 0x05, 0x00, 0x00]);
    assert_eq!(sent[4], [5, 0xD0, 0x01]);
}

#[test]
fn several_parameters_in_one_frame() -> Result<(), OutOfRange> {
    let mut hoist = hoist();
    let settings = [objects::GAIN.setting(150)?, objects::HEIGHT.setting(-5)?, objects::RAMP.setting(20)?];
    assert_eq!(objects::RAMP.setting(9), Err(OutOfRange));
    assert_eq!(hoist.write(&settings).send(), Ok(WriteReply));
    let expected = [5, 0xB8, 1, 5, 0, 0x96, 1, 0x0C, 0xFF, 0xFB, 0xFF, 0xFF, 1, 0x0D, 0, 20];
    assert_eq!(hoist.client().exchange().sent[0], expected);
    let read = hoist.read(Parameter(0x010C)).send().unwrap();
    assert_eq!((read.setting.value_of(&objects::HEIGHT), read.setting.value_of(&objects::GAIN)), (Some(-5), None));
    // The first request has more settings than the message allows. The second request exceeds the maximum length.
    let many = [settings[0]; 9];
    assert_eq!(hoist.write(&many).send(), Err(Error::OutOfRange(OutOfRange).into()));
    let long = [settings[1]; 7];
    assert_eq!(hoist.write(&long).send(), Err(Error::Length(LengthError::new(40, 44)).into()));
    Ok(())
}

#[test]
fn what_a_request_means_is_a_type() {
    let mut hoist = hoist();
    #[allow(deprecated)]
    hoist.go_at_once(1200).send().unwrap();
    assert_eq!(hoist.after_power_on().poll_height().send().map(|reply| reply.height), Ok(1200));
    {
        let mut shows_load = hoist.select_load().select().unwrap();
        assert_eq!(PollLoadReply::LOAD.physical(shows_load.poll_load().send().unwrap().load), None);
        // Requests that do not depend on the selection must remain available.
        shows_load.store().send().unwrap();
        assert!(shows_load.poll_load().send().unwrap().is_complete());
    }
    let mut shows_height = now(hoist.select_height().select_async()).unwrap();
    assert_eq!(now(shows_height.poll_height().send_async()).map(|reply| reply.height), Ok(1200));
}

#[test]
fn what_is_repeated_and_what_goes_on_to_the_end() {
    let mut hoist = hoist();
    let reply = hoist.samples().send().unwrap();
    let loads: Vec<(i16, u8, u8)> = reply.entries.iter().map(|entry| (entry.load, entry.moving, entry.phase)).collect();
    assert_eq!(loads, [(-15, 1, 9), (7, 0, 15)]);
    let entries = [PlayEntry { height: -70_000, pause: 3 }, PlayEntry { height: 1, pause: 0 }];
    hoist.play(List::from(&entries)).send().unwrap();
    assert_eq!(hoist.client().exchange().height, -69_999);
    assert_eq!(hoist.client().exchange().sent[1], [5, 0xA1, 0xFE, 0xEE, 0x90, 3, 0, 0, 1, 0]);
    assert_eq!(hoist.name(*b"de").send().map(|reply| reply.rest), Ok(&b"Winde"[..]));
    assert_eq!(hoist.note(9, b"ab").send(), Ok(NoteReply));
    assert_eq!(hoist.client().exchange().sent[3], [5, 0xA5, 5, 0, 0x02, 0x01, 9, b'a', b'b']);
    assert_eq!(Note::parse(&mut Reader::new(&[5, 0xA5, 4, 0, 0x02, 0x01, 9, b'a', b'b'])), None);
    let too_high = [PlayEntry { height: 1 << 23, pause: 0 }];
    assert_eq!(hoist.play(List::from(&too_high)).send(), Err(Error::OutOfRange(OutOfRange).into()));
}

/// A reply with a changed byte must be rejected, unless this byte is the status.
#[test]
fn every_byte_of_a_reply_counts() {
    let request = [5, 0x02, 0x02, 0x34, 0x00, 0x01, 0x25, 0x8E];
    let reply = [5, 0x02, 0x02, 0x34, 0x00, 0x01];
    let read = |data: &[u8]| GoReply::read(&request, &mut Reader::new(data));
    assert!(read(&reply).is_some_and(|reply| reply.is_complete()));
    for byte in [0, 2, 3, 4, 5] {
        for bit in 0..8 {
            let mut other = reply;
            other[byte] ^= 1 << bit;
            assert_eq!(read(&other), None, "{other:?}");
        }
    }
    assert_eq!((read(&reply[..5]), read(&[5, 0x02, 0x02, 0x34, 0x00, 0x01, 0])), (None, None));
}

#[test]
fn requests_come_back_from_their_bytes() {
    let settings = [objects::GAIN.setting(1).unwrap(), objects::HEIGHT.setting(2).unwrap()];
    let message = Write { settings: Settings::sent(&settings, messages::PARAMETER) };
    let mut data = [0; 40];
    let mut to = Writer::new(&mut data);
    message.write(7, &mut to).unwrap();
    assert_eq!(Write::parse(&mut Reader::new(to.written())), Some((7, message)));
    assert_eq!(Write::parse(&mut Reader::new(&to.written()[..9])), None);
    assert_eq!(message.write(256, &mut Writer::new(&mut [0; 40])), Err(OutOfRange.into()));
    let go = Go { target: -1000, speed: 3000, trim: -4 };
    let mut to = Writer::new(&mut data);
    go.write(0, &mut to).unwrap();
    assert_eq!(Go::parse(&mut Reader::new(to.written())), Some((0, go)));
}

#[test]
fn frames_of_the_device() {
    let mut frame = [0; 32];
    let length = messages::FRAMING.encode(&[0x01, 0x02, 0x6F, 0x9E, 0x00, 0x1B], &mut frame).unwrap();
    assert_eq!(frame[..length], [0x02, 0x01, 0x1B, 0xFD, 0x6F, 0x9E, 0x00, 0x1B, 0xE4, 0x16, 0x03]);
    let (mut decoder, mut data) = (messages::FRAMING.decoder(), [0; 41]);
    let lost = (0..=41).find_map(|_| messages::FRAMING.decode(&mut decoder, 0x02, &mut data).err());
    assert_eq!(lost, Some(FrameError::Interrupted));
}
