use core::convert::Infallible;
use std::collections::{HashMap, VecDeque};
use std::vec::Vec;

use core::time::Duration;

use super::*;
use crate::codes::{Code, CodeTable};
use crate::sdo::Server;
use crate::{AbortCode, AsyncClient, Client, CobId, Error, LengthError, NodeId, Object, OutOfRange};
use crate::{Domain, Flags, Initial, Item, OnCanOpen, Range, Ro, Rw, VisibleString, Wo};

const NODE: u8 = 5;
const SPEED: Item<u16, Rw, OnCanOpen> = Item::object(0x2000, 0, "Speed");
const STATUS: Item<u16, Ro, OnCanOpen> = Item::object(0x2001, 0, "Status");
const LABEL: Item<VisibleString, Rw, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x2002, 0), "Label", Range::Full, Initial::Unknown, "", Flags::NONE);
const PROGRAM: Item<Domain, Wo, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x2003, 1), "Program", Range::Full, Initial::Unknown, "", Flags::NONE);

/// Objects of a device. 0x2001 is read-only, and the maximum of 0x2000 is 3000.
struct Objects(HashMap<Object, Vec<u8>>);

impl crate::sdo::Objects for Objects {
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let value = self.0.get(&object).ok_or(AbortCode::NO_OBJECT)?;
        buffer[..value.len()].copy_from_slice(value);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        match object.index {
            0x2001 => Err(AbortCode::READ_ONLY),
            0x2000 if data.len() == 2 && u16::from_le_bytes([data[0], data[1]]) > 3000 => Err(AbortCode::TOO_HIGH),
            _ => {
                self.0.insert(object, data.to_vec());
                Ok(())
            }
        }
    }
}

/// A bus with one node, and frames of other nodes between its replies.
struct Bus {
    server: Server<1024>,
    objects: Objects,
    answers: VecDeque<CanFrame>,
    is_silent: bool,
}

impl Bus {
    fn new() -> Self {
        let objects = Objects(HashMap::from([(Object::new(0x2001, 0), std::vec![0x37, 0x02])]));
        Self { server: Server::new(), objects, answers: VecDeque::new(), is_silent: false }
    }
}

impl CanPort for Bus {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        if self.is_silent {
            return Ok(true);
        }
        self.answers.extend(CanFrame::new(0x705, &[5]));
        let Ok(request) = frame.data().try_into() else { return Ok(true) };
        if frame.id() == 0x605 {
            self.server.handle(&request, Duration::ZERO, &mut self.objects);
        }
        let answers = std::iter::from_fn(|| self.server.next());
        self.answers.extend(answers.filter_map(|answer| CanFrame::new(0x585, &answer)));
        Ok(true)
    }

    fn receive(
        &mut self,
        _: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        Ok(std::iter::from_fn(|| self.answers.pop_front()).find(|frame| wanted(frame)))
    }
}

/// The same bus with an async interface.
struct NoWait(Bus);

impl AsyncCanPort for NoWait {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        self.0.send(frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        self.0.receive(patience, wanted)
    }
}

fn node() -> Node<Bus> {
    Node::new(Bus::new(), NodeId::new(NODE).expect("a node-ID"))
}

#[test]
fn expedited() {
    let mut node = node();
    assert_eq!(SPEED.at(&mut node).write(1500), Ok(()));
    assert_eq!(SPEED.at(&mut node).read(), Ok(1500));
    assert_eq!(STATUS.at(&mut node).read(), Ok(0x237));
}

#[test]
fn segmented() {
    let mut node = node();
    let mut buffer = [0; 64];
    LABEL.at(&mut node).write("a name of more than seven letters").unwrap();
    assert_eq!(LABEL.at(&mut node).read_into(&mut buffer), Ok("a name of more than seven letters"));
    let program: Vec<u8> = (0..=255).cycle().take(1000).collect();
    PROGRAM.at(&mut node).write(&program).unwrap();
    assert_eq!(node.port().objects.0[&Object::new(0x2003, 1)], program);
    assert_eq!(PROGRAM.at(&mut node).write(&[]).map_err(Error::from), Err(Error::Length(LengthError::new(1, 0))));
}

#[test]
fn aborts_have_their_codes() {
    let mut node = node();
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Abort(AbortCode::NO_OBJECT)));
    assert_eq!(SPEED.at(&mut node).write(3001).map_err(Error::from), Err(Error::Abort(AbortCode::TOO_HIGH)));
    assert_eq!(node.write(Object::new(0x2001, 0), &[0, 0]), Err(Error::Abort(AbortCode::READ_ONLY)));
    node.port().is_silent = true;
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Timeout));
    node.port().is_silent = false;
    // The aborted transfer doesn't affect the next one.
    assert_eq!(SPEED.at(&mut node).write(1), Ok(()));
}

#[test]
fn late_answers_are_not_those_of_the_next_transfer() {
    let mut node = node();
    SPEED.at(&mut node).write(7).unwrap();
    node.port().is_silent = true;
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Timeout));
    node.port().is_silent = false;
    // The reply arrives late.
    node.port().answers.extend(CanFrame::new(0x585, &[0x4B, 0x00, 0x20, 0, 9, 9, 0, 0]));
    assert_eq!(SPEED.at(&mut node).read(), Ok(7));
    assert_eq!(SPEED.at(&mut node).read(), Ok(7));
}

#[test]
fn nobody_says_how_much_is_allocated() {
    let mut buffer = [0; 8];
    // The node announces four gigabytes.
    let mut node = scripted([&[&[0x41, 0x02, 0x20, 0, 0xFF, 0xFF, 0xFF, 0xFF]]]);
    let too_long = Err(Error::Length(LengthError::new(8, u32::MAX as usize)));
    assert_eq!(Client::read(&mut node, Object::new(0x2002, 0), &mut buffer), too_long);
    // The node announces no length and sends an endless number of segments.
    let begin = [0x40, 0x02, 0x20, 0, 0, 0, 0, 0];
    let [even, odd] = [0x00, 0x10].map(|toggle| [toggle, 1, 2, 3, 4, 5, 6, 7]);
    let mut node = scripted([&[&begin], &[&even], &[&odd], &[&even], &[&odd]]);
    let endless = Client::read(&mut node, Object::new(0x2002, 0), &mut buffer);
    assert_eq!(endless, Err(Error::Length(LengthError::new(8, 14))));
}

#[test]
fn answers_to_nobody_are_passed_over() {
    let mut node = node();
    SPEED.at(&mut node).write(7).unwrap();
    // A segment arrives, followed by the reply about another object.
    node.port().answers.extend(CanFrame::new(0x585, &[0x00, 1, 2, 3, 4, 5, 6, 7]));
    node.port().answers.extend(CanFrame::new(0x585, &[0x4B, 0x01, 0x20, 0, 9, 9, 0, 0]));
    assert_eq!(SPEED.at(&mut node).read(), Ok(7));
}

/// A node that replies to the requests in order with these frames, regardless of the content of the requests.
#[derive(Default)]
struct Script {
    answers: VecDeque<Vec<Vec<u8>>>,
    waiting: VecDeque<CanFrame>,
    sent: Vec<Vec<u8>>,
    is_broken: bool,
}

impl CanPort for Script {
    type Error = &'static str;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Self::Error> {
        self.sent.push(frame.data().into());
        let answers = self.answers.pop_front().unwrap_or_default();
        self.waiting.extend(answers.iter().filter_map(|data| CanFrame::new(0x585, data)));
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error> {
        let next = std::iter::from_fn(|| self.waiting.pop_front()).find(|frame| wanted(frame));
        match next {
            None if self.is_broken && !patience.is_zero() => Err("the bus is off"),
            next => Ok(next),
        }
    }
}

fn scripted<const N: usize>(answers: [&[&[u8]]; N]) -> Node<Script> {
    let answers = answers.map(|frames| frames.iter().map(|frame| frame.to_vec()).collect());
    Node::new(Script { answers: answers.into(), ..Script::default() }, NodeId::new(NODE).expect("a node-ID"))
}

/// Returns the reply to an upload of a 16-bit number.
fn number(index: u16, value: u8) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    [0x4B, low, high, 0, value, 0, 0, 0]
}

#[test]
fn reads_are_in_step_again_after_a_late_answer() {
    let (one, two, three) = (number(0x2000, 1), number(0x2000, 2), number(0x2000, 3));
    // The node replies neither to the request nor to the abort. Later, it sends both replies at once.
    let mut node = scripted([&[], &[], &[&one, &two], &[&three]]);
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Timeout));
    assert_eq!(SPEED.at(&mut node).read(), Ok(1), "a late reply cannot be distinguished from this reply");
    assert_eq!(SPEED.at(&mut node).read(), Ok(3));
}

#[test]
fn answers_to_others_dont_go_on_for_ever() {
    let other = number(0x2001, 9);
    let answer = number(0x2000, 7);
    let mut few = std::vec![&other[..]; 200];
    few.push(&answer);
    assert_eq!(SPEED.at(&mut scripted([&few])).read(), Ok(7));
    let many = std::vec![&other[..]; 1000];
    let mut node = scripted([&many]);
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Timeout));
    assert_eq!(node.port().sent[1][0], 0x80, "it is aborted");
    // The node sends segments without data.
    let begin = [0x41, 0x02, 0x20, 0, 0, 0, 0, 0];
    let mut node = scripted([&[&begin], &[&[0x0E, 0, 0, 0, 0, 0, 0, 0]], &[&[0x1E, 0, 0, 0, 0, 0, 0, 0]]]);
    assert_eq!(Client::read(&mut node, Object::new(0x2002, 0), &mut [0; 8]), Err(Error::UnexpectedReply));
    assert_eq!(node.port().sent.last().map(|data| data[0]), Some(0x80));
}

#[test]
fn values_without_a_length_have_the_length_of_their_type() {
    let answer = [0x42, 0x00, 0x20, 0, 0x37, 0x02, 0, 0];
    assert_eq!(SPEED.at(&mut scripted([&[&answer]])).read(), Ok(0x237));
    let mut byte = [0];
    assert_eq!(Client::read(&mut scripted([&[&answer]]), Object::new(0x2000, 0), &mut byte), Ok(1));
    let mut double = [0; 8];
    assert_eq!(Client::read(&mut scripted([&[&answer]]), Object::new(0x2000, 0), &mut double), Ok(4));
}

#[test]
fn messages_of_less_than_eight_bytes_are_none() {
    let mut node = scripted([&[&[0x4B, 0x00, 0x20, 0]]]);
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Timeout), "not the value 0");
    let mut node = scripted([&[&[0x4B, 0x00, 0x20, 0], &number(0x2000, 7)]]);
    assert_eq!(SPEED.at(&mut node).read(), Ok(7));
}

#[test]
fn a_transfer_is_aborted_where_the_interface_fails() {
    let mut node = scripted([]);
    node.port().is_broken = true;
    assert_eq!(SPEED.at(&mut node).read().map_err(Error::from), Err(Error::Client("the bus is off")));
    assert_eq!(node.port().sent[1], [0x80, 0x00, 0x20, 0, 0, 0, 0, 8]);
}

#[test]
fn messages_during_a_transfer_are_kept() {
    let id = NodeId::new(NODE).expect("a node-ID");
    let mut node = Node::new(Buffered::<_, 4>::new(Bus::new()), id);
    SPEED.at(&mut node).write(7).unwrap();
    assert_eq!(node.heartbeat(Duration::ZERO), Ok(Some(NmtState::Operational)));
    assert_eq!(node.heartbeat(Duration::ZERO), Ok(None));
    node.nmt(NmtCommand::Start).unwrap();
    assert_eq!(node.wait_for(NmtState::Operational, Duration::ZERO), Ok(()));
    SPEED.at(&mut node).write(8).unwrap();
    assert_eq!(node.wait_for(NmtState::Stopped, Duration::ZERO), Err(Error::Timeout));
    // Without the buffer, the heartbeats are lost.
    let mut node = Node::new(Bus::new(), id);
    SPEED.at(&mut node).write(7).unwrap();
    assert_eq!(node.heartbeat(Duration::ZERO), Ok(None));
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Alarm {
    Blocked,
    Unknown(u16),
}

impl CodeTable for Alarm {
    type Raw = u16;

    fn codes() -> &'static [Code] {
        const { &[Code::new(0x7121, 0x7121, "motor blocked", "", &[])] }
    }

    fn from_raw(code: u16) -> Self {
        match code {
            0x7121 => Self::Blocked,
            _ => Self::Unknown(code),
        }
    }

    fn raw(self) -> u16 {
        match self {
            Self::Blocked => 0x7121,
            Self::Unknown(code) => code,
        }
    }
}

#[test]
fn emergencies_are_the_devices_alarms() {
    let mut node = node();
    for (id, code) in [(0x086, 0x1000), (0x085, 0x7121), (0x085, 0x1000)] {
        let [low, high] = u16::to_le_bytes(code);
        node.port().answers.extend(CanFrame::new(id, &[low, high, 1, 0, 0, 0, 0, 0]));
    }
    let alarm =
        |node: &mut Node<Bus>| node.emergency(Duration::ZERO).unwrap().map(|emergency| emergency.alarm::<Alarm>());
    assert_eq!(alarm(&mut node), Some(Alarm::Blocked));
    assert_eq!(alarm(&mut node), Some(Alarm::Unknown(0x1000)));
    assert_eq!(alarm(&mut node), None);
    assert_eq!(Alarm::Blocked.row().map(|row| row.name), Some("motor blocked"));
}

#[test]
fn pdos_have_the_identifiers_of_the_node() {
    let mut node = node();
    node.port().answers.extend([CanFrame::new(0x186, &[1]), CanFrame::new(0x185, &[2, 3])].into_iter().flatten());
    let received = node.receive_pdo(CobId::from_node(0x4000_0180), Duration::ZERO).unwrap();
    assert_eq!(received.data(), [2, 3]);
    assert_eq!(node.receive_pdo(CobId::from_node(0x180), Duration::ZERO), Err(Error::Timeout));
    assert_eq!(node.send_pdo(CobId::from_node(0x200), &[1, 2]), Ok(()));
    // The PDO is disabled by default, and a configuration can enable it.
    assert_eq!(node.send_pdo(CobId::from_node(0xC000_0200), &[]), Ok(()));
    // A PDO must not have the COB-ID 0, a COB-ID of SDO or heartbeat, or more than 11 bits without bit 29.
    for wrong in [CobId::fixed(0x8000_0000), CobId::from_node(0x8000_0000), CobId::fixed(0), CobId::fixed(0x605)] {
        assert_eq!(node.send_pdo(wrong, &[0x80, 0]), Err(Error::OutOfRange(OutOfRange)));
        assert_eq!(node.receive_pdo(wrong, Duration::ZERO), Err(Error::OutOfRange(OutOfRange)));
    }
    assert_eq!(node.send_pdo(CobId::fixed(0x2000_0800), &[]), Ok(()));
    assert_eq!(node.send_pdo(CobId::fixed(0x0000_0800), &[]), Err(Error::OutOfRange(OutOfRange)));
    assert_eq!(node.send_pdo(CobId::fixed(0x205), &[0; 9]), Err(Error::Length(LengthError::new(8, 9))));
}

#[tokio::test]
async fn without_blocking() {
    let mut node = Node::new(Buffered::<_, 16>::new(NoWait(Bus::new())), NodeId::new(NODE).expect("a node-ID"));
    assert_eq!(SPEED.at(&mut node).write_async(1500).await, Ok(()));
    assert_eq!(SPEED.at(&mut node).read_async().await, Ok(1500));
    assert_eq!(
        SPEED.at(&mut node).write_async(3001).await.map_err(Error::from),
        Err(Error::Abort(AbortCode::TOO_HIGH))
    );
    let label = "a name of more than seven letters";
    AsyncClient::write(&mut node, Object::new(0x2002, 0), label.as_bytes()).await.unwrap();
    let mut buffer = [0; 64];
    assert_eq!(AsyncClient::read(&mut node, Object::new(0x2002, 0), &mut buffer).await, Ok(label.len()));
    assert_eq!(&buffer[..label.len()], label.as_bytes());
    node.nmt_async(NmtCommand::Stop).await.unwrap();
    node.sync_async().await.unwrap();
    node.send_pdo_async(CobId::from_node(0x200), &[1, 2]).await.unwrap();
    assert_eq!(node.receive_pdo_async(CobId::from_node(0x180), Duration::ZERO).await, Err(Error::Timeout));
    assert_eq!(node.heartbeat_async(Duration::ZERO).await, Ok(Some(NmtState::Operational)));
    assert_eq!(node.wait_for_async(NmtState::Stopped, Duration::ZERO).await, Err(Error::Timeout));
    assert_eq!(node.emergency_async(Duration::ZERO).await, Ok(None));
}
