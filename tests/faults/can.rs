//! Tests SDO transfers with a simulated node whose replies are delayed, lost or corrupted.

use std::collections::HashMap;
use std::convert::Infallible;
use std::future::Future;
use std::pin::{pin, Pin};
use std::sync::Arc;
use std::task::{Context, Poll, Wake};
use std::time::Duration;

use lexibus::clients::canopen::{sync, AsyncCanPort, Buffered, CanFrame, CanPort, Node};
use lexibus::sdo::Server;
use lexibus::{AbortCode, AsyncClient, Client, CobId, Error, NodeId, Object};

use crate::matrix::{name, Row};
use crate::now::now;
use crate::random::Random;

const NODE: u8 = 5;
const TIMEOUT: Duration = Duration::from_millis(500);
/// Object that contains the number of the current request.
const COUNT: Object = Object::new(0x2000, 0);
/// Object that contains the same number as a text of 20 bytes, which needs a segmented transfer.
const TEXT: Object = Object::new(0x2001, 0);
const SETPOINT: Object = Object::new(0x2002, 0);

/// A fault in the replies to one request.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    /// The replies arrive with this delay.
    Late(Duration),
    Lost,
    Duplicated,
    /// The replies are truncated to four bytes.
    Truncated,
    /// Replies about another object arrive repeatedly instead of the reply.
    Foreign,
    /// A thousand frames of other nodes arrive before the reply.
    Noise,
    /// Each reply arrives just before the timeout.
    Slow,
}

struct Objects(HashMap<Object, Vec<u8>>);

impl lexibus::sdo::Objects for Objects {
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let value = self.0.get(&object).ok_or(AbortCode::NO_OBJECT)?;
        buffer[..value.len()].copy_from_slice(value);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        self.0.insert(object, data.to_vec());
        Ok(())
    }
}

/// A CAN bus with one node. The simulated time advances only while a client waits for a frame.
struct Bus {
    server: Server<8192>,
    objects: Objects,
    now: Duration,
    /// Frames that have not been received, with their arrival times.
    frames: Vec<(Duration, CanFrame)>,
    fault: Fault,
    aborts: usize,
    /// Number of received SYNC messages. The node sends this number in its PDO.
    sample: u32,
}

impl Bus {
    fn new() -> Self {
        let server = Server::new();
        let objects = Objects(HashMap::new());
        Self { server, objects, now: Duration::ZERO, frames: Vec::new(), fault: Fault::Nothing, aborts: 0, sample: 0 }
    }

    /// Sets both objects that contain the number of the current request.
    fn count(&mut self, count: u32) {
        self.objects.0.insert(COUNT, count.to_le_bytes().to_vec());
        self.objects.0.insert(TEXT, text(count));
    }

    fn reply(&mut self, reply: CanFrame) {
        let soon = self.now + Duration::from_millis(1);
        match self.fault {
            Fault::Nothing => self.frames.push((soon, reply)),
            Fault::Late(delay) => self.frames.push((self.now + delay, reply)),
            Fault::Lost => {}
            Fault::Slow => self.frames.push((self.now + TIMEOUT - Duration::from_millis(1), reply)),
            Fault::Duplicated => self.frames.extend([(soon, reply), (soon, reply)]),
            Fault::Truncated => self.frames.extend(CanFrame::new(reply.id(), &reply.data()[..4]).map(|it| (soon, it))),
            Fault::Noise => {
                let other = CanFrame::new(0x123, &[1, 2, 3]).expect("a frame");
                self.frames.extend([(soon, other); 1000]);
                self.frames.push((soon, reply));
            }
            Fault::Foreign => {
                let foreign = CanFrame::new(0x585, &[0x43, 0x34, 0x12, 1, 9, 9, 9, 9]).expect("a frame");
                self.frames.extend((1..300).map(|at| (self.now + at * TIMEOUT * 2 / 5, foreign)));
            }
        }
    }
}

impl CanPort for Bus {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        if frame.id() == 0x080 {
            self.sample = self.sample.wrapping_add(1);
            self.reply(CanFrame::new(0x185, &self.sample.to_le_bytes()).expect("a frame"));
            return Ok(true);
        }
        let data: [u8; 8] = frame.data().try_into().expect("an SDO message");
        self.aborts += usize::from(data[0] == 0x80);
        if frame.id() == 0x600 + u32::from(NODE) {
            self.server.handle(&data, Duration::ZERO, &mut self.objects);
        }
        while let Some(reply) = self.server.next() {
            self.reply(CanFrame::new(0x580 + u32::from(NODE), &reply).expect("a frame"));
        }
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now + patience;
        loop {
            let first = (0..self.frames.len()).min_by_key(|&at| self.frames[at].0);
            let Some(first) = first.filter(|&at| self.frames[at].0 <= end) else {
                self.now = end;
                return Ok(None);
            };
            let (at, frame) = self.frames.remove(first);
            self.now = self.now.max(at);
            let frame = frame.at(Some(self.now));
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

/// An asynchronous port of the bus.
struct AsyncBus {
    bus: Bus,
    /// Number of frames that the port still receives; `None` if it is unlimited.
    pending_after: Option<usize>,
}

impl AsyncCanPort for AsyncBus {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        self.bus.send(frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        if self.pending_after == Some(0) && !patience.is_zero() {
            std::future::pending::<()>().await;
        }
        if let Some(left) = &mut self.pending_after {
            *left = left.saturating_sub(usize::from(!patience.is_zero()));
        }
        self.bus.receive(patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        CanPort::now(&mut self.bus)
    }
}

/// Polls a future once.
pub fn poll_once<F: Future>(future: Pin<&mut F>) -> Poll<F::Output> {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    future.poll(&mut Context::from_waker(&Arc::new(Silent).into()))
}

fn text(count: u32) -> Vec<u8> {
    format!("{count:020}").into_bytes()
}

fn node() -> Node<Bus> {
    Node::new(Bus::new(), NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT)
}

/// Sends `count` requests with random faults. Returns the number of failed requests, and panics if a value is wrong.
fn requests(mut node: Node<Bus>, count: u32, mut fault: impl FnMut(&mut Random) -> Fault) -> u32 {
    let mut random = Random::new(28);
    let mut failed = 0;
    for number in 0..count {
        node.port().count(number);
        node.port().fault = fault(&mut random);
        let mut buffer = [0; 20];
        let result = match random.below(3) {
            0 => Client::read(&mut node, COUNT, &mut buffer[..4]).map(|length| {
                assert_eq!(buffer[..length], number.to_le_bytes(), "request {number}");
            }),
            1 => Client::read(&mut node, TEXT, &mut buffer).map(|length| {
                assert_eq!(buffer[..length], text(number), "request {number}");
            }),
            _ => Client::write(&mut node, SETPOINT, &number.to_le_bytes()).map(|()| {
                assert_eq!(node.port().objects.0[&SETPOINT], number.to_le_bytes(), "request {number}");
            }),
        };
        match result {
            Ok(()) => {}
            Err(Error::Timeout) => failed += 1,
            Err(other) => panic!("request {number}: {other}"),
        }
    }
    failed
}

#[test]
fn late_replies_are_not_those_of_the_next_request() {
    let mut late = 0;
    let failed = requests(node(), 10_000, |random| match random.below(20) {
        0 => {
            late += 1;
            Fault::Late(TIMEOUT + Duration::from_millis(random.below(450)))
        }
        _ => Fault::Nothing,
    });
    println!("10,000 SDO transfers, {late} late: {failed} errors, no wrong value");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

#[test]
fn foreign_replies_dont_prolong_a_transfer() {
    let mut node = node();
    node.port().count(1);
    node.port().fault = Fault::Foreign;
    assert_eq!(Client::read(&mut node, COUNT, &mut [0; 4]), Err(Error::Timeout));
    assert_eq!(node.port().now, TIMEOUT);
    node.port().fault = Fault::Nothing;
    let mut buffer = [0; 4];
    assert_eq!(Client::read(&mut node, COUNT, &mut buffer), Ok(4));
    assert_eq!((buffer, node.port().now), ([1, 0, 0, 0], 2 * TIMEOUT + Duration::from_millis(1)));
}

#[test]
fn other_faults_end_in_time() {
    for (fault, expected) in
        [(Fault::Lost, Err(Error::Timeout)), (Fault::Truncated, Err(Error::Timeout)), (Fault::Duplicated, Ok(4))]
    {
        let mut node = node();
        node.port().count(0x0403_0201);
        node.port().fault = fault;
        let mut buffer = [0; 4];
        assert_eq!(Client::read(&mut node, COUNT, &mut buffer), expected, "{fault:?}");
        assert!(node.port().now <= TIMEOUT, "{fault:?}");
        node.port().fault = Fault::Nothing;
        node.port().count(7);
        assert_eq!((Client::read(&mut node, COUNT, &mut buffer), buffer), (Ok(4), [7, 0, 0, 0]), "{fault:?}");
    }
}

#[test]
fn a_repeated_segment_isnt_data() {
    let mut node = node();
    node.port().count(7);
    node.port().fault = Fault::Duplicated;
    assert_eq!(Client::read(&mut node, TEXT, &mut [0; 20]), Err(Error::UnexpectedReply));
    node.port().fault = Fault::Nothing;
    node.port().count(8);
    let mut buffer = [0; 20];
    assert_eq!((Client::read(&mut node, TEXT, &mut buffer), &buffer[..]), (Ok(20), &text(8)[..]));
}

/// Length of a value that has 100 segments. Its transfer may take one timeout, plus one tenth of the timeout for each
/// segment.
const LONG: usize = 700;
const LIMIT: Duration = Duration::from_millis(11 * 500);

#[test]
fn a_node_that_replies_just_in_time_doesnt_block_for_ever() {
    let value = [7; LONG];
    let mut node = node();
    for writes in [false, true] {
        node.port().objects.0.insert(TEXT, value.to_vec());
        node.port().fault = Fault::Slow;
        let (start, aborts) = (node.port().now, node.port().aborts);
        let result = match writes {
            false => Client::read(&mut node, TEXT, &mut [0; LONG]).map(|_| ()),
            true => Client::write(&mut node, TEXT, &value),
        };
        assert_eq!((result, node.port().now - start), (Err(Error::Timeout), LIMIT));
        assert_eq!(node.port().aborts - aborts, 1);
        node.port().fault = Fault::Nothing;
        node.port().count(8);
        let mut buffer = [0; 20];
        assert_eq!((Client::read(&mut node, TEXT, &mut buffer), &buffer[..]), (Ok(20), &text(8)[..]));
    }
}

#[test]
fn async_transfers_have_the_same_limit() {
    let mut bus = Bus::new();
    bus.objects.0.insert(TEXT, vec![7; LONG]);
    bus.fault = Fault::Slow;
    let bus = AsyncBus { bus, pending_after: None };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    assert_eq!(now(AsyncClient::read(&mut node, TEXT, &mut [0; LONG])), Err(Error::Timeout));
    assert_eq!((node.port().bus.now, node.port().bus.aborts), (LIMIT, 1));
}

#[test]
fn slow_segments_within_the_limit_are_right() {
    let mut node = node();
    node.port().objects.0.insert(TEXT, vec![7; LONG]);
    node.port().fault = Fault::Late(TIMEOUT / 11);
    let mut buffer = [0; LONG];
    assert_eq!((Client::read(&mut node, TEXT, &mut buffer), buffer), (Ok(LONG), [7; LONG]));
    assert_eq!(Client::write(&mut node, TEXT, &buffer), Ok(()));
}

#[test]
fn a_dropped_transfer_is_aborted_and_the_next_one_is_right() {
    let bus = AsyncBus { bus: Bus::new(), pending_after: Some(0) };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    node.port().bus.count(7);
    let mut buffer = [0; 20];
    for object in [COUNT, TEXT] {
        let mut dropped = pin!(AsyncClient::read(&mut node, object, &mut buffer));
        assert_eq!(poll_once(dropped.as_mut()), Poll::Pending);
    }
    assert_eq!(node.port().bus.aborts, 1, "the second transfer aborts the first one");
    node.port().pending_after = None;
    node.port().bus.count(8);
    assert_eq!(now(AsyncClient::read(&mut node, TEXT, &mut buffer)), Ok(20));
    assert_eq!((&buffer[..], node.port().bus.aborts), (&text(8)[..], 1));
}

/// Length of a value that is transferred in blocks.
const BLOCK: usize = 2000;

fn block(count: u32) -> Vec<u8> {
    (0..BLOCK as u32).map(|at| (at.wrapping_mul(count + 7) / 3) as u8).collect()
}

#[test]
fn faults_in_block_transfers() {
    for (fault, expected) in [
        (Fault::Nothing, Ok(BLOCK)),
        (Fault::Duplicated, Ok(BLOCK)),
        (Fault::Late(Duration::from_millis(50)), Ok(BLOCK)),
        (Fault::Lost, Err(Error::Timeout)),
        (Fault::Truncated, Err(Error::Timeout)),
        (Fault::Late(TIMEOUT + Duration::from_millis(100)), Err(Error::Timeout)),
    ] {
        let (mut node, mut buffer) = (node(), vec![0; BLOCK]);
        node.port().objects.0.insert(TEXT, block(1));
        node.port().fault = fault;
        assert_eq!(Client::read(&mut node, TEXT, &mut buffer), expected, "{fault:?}");
        assert!(expected.is_err() || buffer == block(1), "{fault:?}");
        // Each acknowledgment of the node arrives twice. The client may notice it only at the end of the transfer.
        match Client::write(&mut node, SETPOINT, &block(2)) {
            Ok(()) => assert_eq!(node.port().objects.0[&SETPOINT], block(2)),
            result => assert!(expected.is_err() || fault == Fault::Duplicated, "{fault:?} {result:?}"),
        }
        node.port().fault = Fault::Nothing;
        node.port().objects.0.insert(TEXT, block(3));
        assert_eq!(Client::read(&mut node, TEXT, &mut buffer), Ok(BLOCK), "{fault:?}");
        assert!(buffer == block(3), "{fault:?}");
    }
}

/// The segments of a block that was given up must not be taken for replies to the next request.
#[test]
fn late_segments_are_discarded() {
    let reply = [0x4B, 0x00, 0x20, 0, 9, 9, 0, 0];
    let mut node = node();
    // Each segment of this value is a valid reply about the object `COUNT`, except for its first byte.
    node.port().objects.0.insert(TEXT, reply[1..].iter().copied().cycle().take(BLOCK).collect());
    node.port().fault = Fault::Late(TIMEOUT * 9 / 10);
    let mut buffer = vec![0; BLOCK];
    let limited = Client::read(&mut node, TEXT, &mut buffer);
    assert_eq!(limited, Ok(BLOCK));
    node.port().fault = Fault::Late(TIMEOUT / 2);
    // The transfer is dropped after its first segment has been requested.
    let bus = AsyncBus { bus: node.into_port(), pending_after: Some(1) };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    assert_eq!(poll_once(pin!(AsyncClient::read(&mut node, TEXT, &mut buffer)).as_mut()), Poll::Pending);
    (node.port().pending_after, node.port().bus.fault) = (None, Fault::Nothing);
    node.port().bus.count(0x0403_0201);
    let mut number = [0; 4];
    assert_eq!(now(AsyncClient::read(&mut node, COUNT, &mut number)), Ok(4));
    assert_eq!((number, node.port().bus.aborts), ([1, 2, 3, 4], 1));
}

const PDO: CobId = CobId::from_node(0x180);

/// Returns a node that has sent 200 PDOs. While the client waits for another message, its buffer keeps 16 of these PDOs.
fn behind() -> Node<Buffered<AsyncBus, 16>> {
    let mut bus = Bus::new();
    for _ in 0..200 {
        bus.send(&sync(), Duration::ZERO).expect("it is sent");
    }
    bus.now = Duration::from_secs(1);
    bus.count(7);
    let bus = AsyncBus { bus, pending_after: None };
    Node::new(Buffered::new(bus), NodeId::new(NODE).expect("a node-ID"))
}

fn sample(frame: CanFrame) -> u32 {
    u32::from_le_bytes(frame.data().try_into().expect("four bytes"))
}

#[test]
fn a_pdo_after_clear_and_sync_is_new() {
    now(async {
        let mut node = behind();
        node.port().clear_async().await?;
        node.sync_async().await.expect("it is sent");
        let pdo = node.receive_pdo_async(PDO, TIMEOUT).await.expect("a PDO");
        assert_eq!(sample(pdo), 201);
        // Some of the PDOs are already in the buffer when `clear_async` is called.
        let mut node = behind();
        AsyncClient::read(&mut node, COUNT, &mut [0; 4]).await.expect("a value");
        node.port().clear_async().await?;
        assert_eq!(node.latest_pdo_async(PDO).await, Ok(None));
        Ok::<(), Infallible>(())
    })
    .expect("no fault");
    let mut node = Node::new(Buffered::<_, 16>::new(behind().into_port().into_inner().bus), NodeId::new(NODE).unwrap());
    node.port().clear().expect("no fault");
    node.sync().expect("it is sent");
    assert_eq!(sample(node.receive_pdo(PDO, TIMEOUT).expect("a PDO")), 201);
}

#[test]
fn the_latest_pdo_is_the_newest_one() {
    let mut node = behind();
    assert_eq!(now(node.latest_pdo_async(PDO)).map(|pdo| pdo.map(sample)), Ok(Some(200)));
    assert_eq!(now(node.latest_pdo_async(PDO)), Ok(None));
    // Some of the PDOs are already in the buffer when `latest_pdo_async` is called.
    let mut node = behind();
    assert_eq!(now(node.heartbeat_async(Duration::ZERO)), Ok(None));
    assert_eq!(now(node.latest_pdo_async(PDO)).map(|pdo| pdo.map(sample)), Ok(Some(200)));
    let mut node = Node::new(behind().into_port().into_inner().bus, NodeId::new(NODE).expect("a node-ID"));
    assert_eq!(node.latest_pdo(PDO).map(|pdo| pdo.map(sample)), Ok(Some(200)));
    assert_eq!(node.latest_pdo(PDO), Ok(None));
}

#[test]
fn the_latest_pdo_has_the_time_at_which_it_was_taken_from_the_interface() {
    let time = |pdo: Result<Option<CanFrame>, _>| pdo.expect("no fault").and_then(|pdo: CanFrame| pdo.time());
    let mut node = behind();
    let start = node.port().now();
    assert_eq!(time(now(node.latest_pdo_async(PDO))), start, "the PDOs were in the queue of the interface");
    // The PDO arrives 1 ms after SYNC, during an SDO transfer, and is kept in the buffer.
    now(node.sync_async()).expect("it is sent");
    now(AsyncClient::read(&mut node, TEXT, &mut [0; 20])).expect("a value");
    let (arrival, after) = (start.map(|start| start + Duration::from_millis(1)), node.port().now());
    assert!(arrival < after);
    assert_eq!(time(now(node.latest_pdo_async(PDO))), arrival);
    let bus = node.into_port().into_inner().bus;
    let mut node = Node::new(Buffered::<_, 16>::new(bus), NodeId::new(NODE).expect("a node-ID"));
    node.sync().expect("it is sent");
    Client::read(&mut node, TEXT, &mut [0; 20]).expect("a value");
    assert_eq!(time(node.latest_pdo(PDO)), after.map(|after| after + Duration::from_millis(1)));
}

/// Returns the rows for SDO transfers in the table of faults.
pub fn rows() -> Vec<Row> {
    let faults = [
        ("late", Fault::Late(TIMEOUT + Duration::from_millis(100))),
        ("lost", Fault::Lost),
        ("duplicated", Fault::Duplicated),
        ("truncated", Fault::Truncated),
        ("foreign", Fault::Foreign),
        ("noise", Fault::Noise),
    ];
    let mut rows = Vec::new();
    for (fault_name, fault) in faults {
        for is_async in [false, true] {
            let mut blocking = node();
            let bus = AsyncBus { bus: Bus::new(), pending_after: None };
            let mut asynchronous = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
            let mut read = |count: u32, fault| {
                let bus = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                bus.count(count);
                bus.fault = fault;
                let (start, mut buffer) = (bus.now, [0; 4]);
                let result = match is_async {
                    true => now(AsyncClient::read(&mut asynchronous, COUNT, &mut buffer)),
                    false => Client::read(&mut blocking, COUNT, &mut buffer),
                };
                assert!(result.is_err() || buffer == count.to_le_bytes(), "{fault:?}");
                let bus = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                (result, bus.now - start)
            };
            let (result, time) = read(1, fault);
            let (second, next) = read(2, Fault::Nothing);
            second.expect("the next request is right");
            let (client, result, timeout) = ("SDO", name(&result), TIMEOUT);
            rows.push(Row { client, is_async, fault: fault_name, result, time, next, timeout });
        }
    }
    rows
}
