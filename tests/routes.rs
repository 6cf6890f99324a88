//! Tests routes to values, such as windows. Blocking and asynchronous access through a route must have the same effect
//! on the bus.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::time::Duration;

use lexibus::{
    AsyncClient, Axes, Axis, AxisRange, AxisStep, CanOpen, Client, Error, Handshake, LengthError, Limited, Object,
    OutOfRange, ReadRoute, ReadWindow, Resized, Split, Through, WriteRoute, WriteWindow,
};

#[path = "support/now.rs"]
mod now;
use now::now;

type Failure = Error<Infallible>;

/// A simulated device that logs all accesses.
#[derive(Clone, Debug, Default, PartialEq)]
struct Node {
    memory: BTreeMap<Object, Vec<u8>>,
    journal: Vec<String>,
    /// Number of reads until the node clears the number in a window.
    busy: u16,
    has_clock: bool,
}

impl Node {
    fn look(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Failure> {
        self.journal.push(format!("read {object:?}"));
        if object == NUMBER {
            self.busy = self.busy.saturating_sub(1);
            buffer.fill(u8::from(self.busy > 0));
            return Ok(buffer.len());
        }
        let value = self.memory.get(&object).map_or(&[][..], Vec::as_slice);
        let length = value.len().min(buffer.len());
        buffer[..length].copy_from_slice(&value[..length]);
        Ok(length)
    }

    fn put(&mut self, object: Object, data: &[u8]) -> Result<(), Failure> {
        self.journal.push(format!("write {object:?} {data:?}"));
        self.memory.insert(object, data.to_vec());
        Ok(())
    }

    fn pass(&mut self, time: Duration) -> Result<(), Failure> {
        self.journal.push(format!("wait {time:?}"));
        if self.has_clock {
            Ok(())
        } else {
            Err(Error::NoClock)
        }
    }
}

impl Client for Node {
    type Bus = CanOpen;
    type Error = Infallible;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Failure> {
        self.look(object, buffer)
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Failure> {
        self.put(object, data)
    }

    fn wait(&mut self, time: Duration) -> Result<(), Failure> {
        self.pass(time)
    }
}

impl AsyncClient for Node {
    type Bus = CanOpen;
    type Error = Infallible;

    async fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Failure> {
        self.look(object, buffer)
    }

    async fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Failure> {
        self.put(object, data)
    }

    async fn wait(&mut self, time: Duration) -> Result<(), Failure> {
        self.pass(time)
    }
}

const NUMBER: Object = Object::new(0x2005, 1);
const VALUE: Object = Object::new(0x2005, 2);

/// Reads through `route`, both blocking and asynchronously. Returns the result and the state of the node after reading.
fn read(route: &impl ReadRoute<CanOpen>, node: &Node, length: usize) -> (Result<Vec<u8>, Failure>, Node) {
    let (mut one, mut other) = (node.clone(), node.clone());
    let (mut value, mut value_async) = (vec![0xAA; length], vec![0xAA; length]);
    let blocking = route.read(&mut one, &mut value).map(|length| value[..length].to_vec());
    let later = now(route.read_async(&mut other, &mut value_async)).map(|length| value_async[..length].to_vec());
    assert_eq!((&blocking, &one), (&later, &other));
    (blocking, one)
}

/// Writes through `route`, both blocking and asynchronously. Returns the result and the state of the node after
/// writing.
fn write(route: &impl WriteRoute<CanOpen>, node: &Node, data: &[u8]) -> (Result<(), Failure>, Node) {
    let (mut one, mut other) = (node.clone(), node.clone());
    let blocking = route.write(&mut one, data);
    let later = now(route.write_async(&mut other, data));
    assert_eq!((&blocking, &one), (&later, &other));
    (blocking, one)
}

fn with(object: Object, bytes: &[u8]) -> Node {
    Node { memory: BTreeMap::from([(object, bytes.to_vec())]), ..Node::default() }
}

#[test]
fn another_width_on_the_bus() {
    let place = Object::new(0x6060, 0);
    let route = Resized::signed(place, 8);
    assert_eq!(read(&route, &with(place, &[0xCE]), 4).0, Ok((-50_i32).to_le_bytes().to_vec()));
    assert_eq!(read(&route, &with(place, &[]), 4).0, Err(LengthError::new(1, 0).into()), "an answer that is too short");
    assert_eq!(write(&route, &Node::default(), &(-50_i32).to_le_bytes()).1.memory[&place], [0xCE]);
    let (refused, node) = write(&route, &Node::default(), &200_i32.to_le_bytes());
    assert_eq!((refused, node), (Err(OutOfRange.into()), Node::default()), "nothing is sent");
    let route = Resized::unsigned(place, 16);
    assert_eq!(read(&route, &with(place, &[1, 1]), 1).0, Err(OutOfRange.into()));
    assert_eq!(write(&route, &Node::default(), &[0xFE]).1.memory[&place], [0xFE, 0]);
}

#[test]
fn fewer_values_on_the_bus() {
    let place = Object::new(0x6060, 0);
    let route = Limited::new(place, true, &[(-2, -1), (1, 7)]);
    assert_eq!(write(&route, &Node::default(), &[0xFF]).1.memory[&place], [0xFF]);
    assert_eq!(write(&route, &Node::default(), &[0]), (Err(OutOfRange.into()), Node::default()));
    assert_eq!(read(&route, &with(place, &[0]), 1).0, Ok(vec![0]), "received values are not checked");
}

#[test]
fn read_here_and_written_there() {
    let (here, there) = (Object::new(0x6061, 0), Object::new(0x6060, 0));
    let both = Split::new(here, there);
    assert_eq!(read(&both, &with(here, &[7]), 1).0, Ok(vec![7]));
    assert_eq!(write(&both, &Node::default(), &[7]).1.memory[&there], [7]);
    assert_eq!(read(&Split::reading(here), &with(here, &[7]), 1).0, Ok(vec![7]));
    assert_eq!(write(&Split::writing(there), &Node::default(), &[7]).1.memory[&there], [7]);
}

const fn read_window(handshake: Handshake) -> ReadWindow<Object> {
    ReadWindow { number: NUMBER, number_bits: 16, value: VALUE, value_bits: 32, handshake }
}

const fn write_window(is_number_first: bool, handshake: Handshake) -> WriteWindow<Object> {
    WriteWindow { number: NUMBER, number_bits: 16, value: VALUE, value_bits: 32, is_number_first, handshake }
}

#[test]
fn through_a_window_as_quick_as_its_answers() {
    const READ: ReadWindow<Object> = read_window(Handshake::NONE);
    const WRITE: WriteWindow<Object> = write_window(false, Handshake::NONE);
    const NUMBER_FIRST: WriteWindow<Object> = write_window(true, Handshake::NONE);
    let (value, node) = read(&Through::signed(0x8017, &READ), &with(VALUE, &(-5_i32).to_le_bytes()), 2);
    assert_eq!(value, Ok((-5_i16).to_le_bytes().to_vec()));
    assert_eq!(node.journal, [format!("write {NUMBER:?} [23, 128]"), format!("read {VALUE:?}")]);
    let short = read(&Through::unsigned(1, &READ), &with(VALUE, &[1]), 2).0;
    assert_eq!(short, Err(LengthError::new(4, 1).into()));
    let mut written = [format!("write {VALUE:?} [251, 0, 0, 0]"), format!("write {NUMBER:?} [23, 128]")];
    assert_eq!(write(&Through::unsigned(0x8017, &WRITE), &Node::default(), &[251]).1.journal, written);
    written.reverse();
    assert_eq!(write(&Through::unsigned(0x8017, &NUMBER_FIRST), &Node::default(), &[251]).1.journal, written);
}

#[test]
fn through_a_window_that_is_cleared() {
    const READ: ReadWindow<Object> = read_window(Handshake::cleared(3));
    const WRITE: WriteWindow<Object> = write_window(true, Handshake::cleared(3));
    for has_clock in [true, false] {
        let node = |busy| Node { busy, has_clock, ..with(VALUE, &[1, 0, 0, 0]) };
        let (value, after) = read(&Through::unsigned(2, &READ), &node(3), 2);
        assert_eq!(
            value,
            Ok(vec![1, 0]),
            "the third poll finds the number cleared; without a clock, the number of polls is the timeout"
        );
        assert_eq!(after.journal.iter().filter(|line| line.starts_with("wait 1ms")).count(), 2);
        assert_eq!(read(&Through::unsigned(2, &READ), &node(4), 2).0, Err(Error::Timeout));
        assert_eq!(write(&Through::unsigned(2, &WRITE), &node(1), &[1]).0, Ok(()));
        assert_eq!(write(&Through::unsigned(2, &WRITE), &node(9), &[1]).0, Err(Error::Timeout));
    }
}

#[test]
fn through_a_window_that_takes_its_time() {
    const READ: ReadWindow<Object> = read_window(Handshake::after(20));
    let node = Node { has_clock: true, ..with(VALUE, &[1, 0, 0, 0]) };
    let (value, after) = read(&Through::unsigned(2, &READ), &node, 4);
    assert_eq!((value, after.journal[1].as_str()), (Ok(vec![1, 0, 0, 0]), "wait 20ms"));
    assert_eq!(read(&Through::unsigned(2, &READ), &with(VALUE, &[1, 0, 0, 0]), 4).0, Err(Error::NoClock));
}

#[test]
fn further_axes() {
    const RANGES: &[AxisRange] = &[AxisRange { first: 0x6000, last: 0x67FF, step: AxisStep::Index(0x800) }];
    const AXES: Axes = Axes { count: 2, ranges: RANGES, shared: &[] };
    let (place, second) = (Object::new(0x607A, 0), Object::new(0x687A, 0));
    assert_eq!(Axis::new(Node::default(), &AXES, 2).number(), 2);
    let blocking = {
        let mut node = with(second, &[1, 2]);
        let mut axis = Axis::new(&mut node, &AXES, 2);
        let mut value = [0; 2];
        let read = Client::read(&mut axis, place, &mut value);
        let done =
            (read, value, Client::write(&mut axis, place, &[3]), Client::wait(&mut axis, Duration::from_secs(1)));
        (done, node)
    };
    let later = {
        let mut node = with(second, &[1, 2]);
        let mut axis = Axis::new(&mut node, &AXES, 2);
        let mut value = [0; 2];
        let read = now(AsyncClient::read(&mut axis, place, &mut value));
        let written = now(AsyncClient::write(&mut axis, place, &[3]));
        let done = (read, value, written, now(AsyncClient::wait(&mut axis, Duration::from_secs(1))));
        (done, node)
    };
    assert_eq!(blocking, later);
    assert_eq!(blocking.0, (Ok(2), [1, 2], Ok(()), Err(Error::NoClock)));
    assert_eq!(blocking.1.memory[&second], [3]);
    let mut third = Axis::new(Node::default(), &AXES, 3);
    let missing = Err(Error::NoSuchAxis { axis: 3, object: place });
    assert_eq!(Client::write(&mut third, place, &[3]), missing);
    assert_eq!(now(AsyncClient::write(&mut third, place, &[3])), missing);
}
