//! Tests SDO transfers with a simulated node and faults of the bus.

mod bus;
pub mod pdo;

use std::pin::pin;
use std::task::Poll;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, Node};
use lexibus::sim::{CanError, CanFault, FaultyCan};
use lexibus::{AsyncClient, Client, Error, NodeId};

use self::bus::*;
use crate::faulty::{faults, foreign, set, TIMEOUT};
use crate::matrix::{name, Row};
use crate::now::now;
use crate::random::Random;

pub use self::bus::poll_once;

/// Each reply arrives just before the timeout.
const SLOW: CanFault = CanFault::Late(TIMEOUT.saturating_sub(FRAME));

/// Returns a fault: replies about another object arrive instead of the right reply.
fn other_object() -> CanFault {
    foreign(CanFrame::new(0x585, &[0x43, 0x34, 0x12, 1, 9, 9, 9, 9]).expect("a frame"))
}

/// Sends `count` requests, each with the fault that `fault` returns. Returns the number of timeouts. Panics if a value is wrong or
/// another error occurs.
fn requests(mut node: Node<FaultyCan<Bus>>, count: u32, mut fault: impl FnMut(&mut Random) -> Option<CanFault>) -> u32 {
    let mut random = Random::new(28);
    let mut failed = 0;
    for number in 0..count {
        node.port().bus().count(number);
        set(node.port(), fault(&mut random));
        let mut buffer = [0; 20];
        let result = match random.below(3) {
            0 => Client::read(&mut node, COUNT, &mut buffer[..4]).map(|length| {
                assert_eq!(buffer[..length], number.to_le_bytes(), "request {number}");
            }),
            1 => Client::read(&mut node, TEXT, &mut buffer).map(|length| {
                assert_eq!(buffer[..length], text(number), "request {number}");
            }),
            _ => Client::write(&mut node, SETPOINT, &number.to_le_bytes()).map(|()| {
                assert_eq!(node.port().bus().objects.0[&SETPOINT], number.to_le_bytes(), "request {number}");
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
            Some(CanFault::Late(TIMEOUT + Duration::from_millis(random.below(450))))
        }
        _ => None,
    });
    println!("10,000 SDO transfers, {late} late: {failed} errors, no wrong value");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

#[test]
fn async_late_replies_are_not_those_of_the_next_request() {
    let bus = AsyncBus { bus: FaultyCan::new(Bus::new()), pending_after: None };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    let (mut random, mut late, mut failed) = (Random::new(29), 0, 0);
    for number in 0..10_000 {
        let is_late = random.below(20) == 0;
        late += u32::from(is_late);
        let delay = TIMEOUT + Duration::from_millis(random.below(450));
        node.port().bus.bus().count(number);
        set(&mut node.port().bus, is_late.then_some(CanFault::Late(delay)));
        let mut buffer = [0; 20];
        let result = match random.below(2) {
            0 => now(AsyncClient::read(&mut node, COUNT, &mut buffer[..4])).map(|_| number.to_le_bytes().to_vec()),
            _ => now(AsyncClient::read(&mut node, TEXT, &mut buffer)).map(|_| text(number)),
        };
        match result {
            Ok(expected) => assert_eq!(buffer[..expected.len()], expected, "request {number}"),
            Err(Error::Timeout) => failed += 1,
            Err(other) => panic!("request {number}: {other}"),
        }
    }
    println!("10,000 async SDO transfers, {late} late: {failed} errors, no wrong value");
    assert!(late > 400 && failed <= late, "{failed} errors for {late} late replies");
}

#[test]
fn foreign_replies_dont_prolong_a_transfer() {
    let mut node = node();
    node.port().bus().count(1);
    set(node.port(), other_object());
    assert_eq!(Client::read(&mut node, COUNT, &mut [0; 4]), Err(Error::Timeout));
    assert_eq!(node.port().bus().now, TIMEOUT + FRAME, "with the time of the abort");
    set(node.port(), None);
    let mut buffer = [0; 4];
    assert_eq!(Client::read(&mut node, COUNT, &mut buffer), Ok(4));
    assert_eq!((buffer, node.port().bus().now), ([1, 0, 0, 0], 2 * (TIMEOUT + FRAME)));
}

#[test]
fn other_faults_end_in_time() {
    for (fault, expected) in [
        (CanFault::Lost, Err(Error::Timeout)),
        (CanFault::Truncated, Err(Error::Timeout)),
        (CanFault::Duplicated, Ok(4)),
    ] {
        let mut node = node();
        node.port().bus().count(0x0403_0201);
        set(node.port(), fault);
        let mut buffer = [0; 4];
        assert_eq!(Client::read(&mut node, COUNT, &mut buffer), expected, "{fault:?}");
        assert!(node.port().bus().now <= TIMEOUT + FRAME, "{fault:?}");
        set(node.port(), None);
        node.port().bus().count(7);
        assert_eq!((Client::read(&mut node, COUNT, &mut buffer), buffer), (Ok(4), [7, 0, 0, 0]), "{fault:?}");
    }
}

#[test]
fn a_repeated_segment_isnt_data() {
    let mut node = node();
    node.port().bus().count(7);
    set(node.port(), CanFault::Duplicated);
    assert_eq!(Client::read(&mut node, TEXT, &mut [0; 20]), Err(Error::UnexpectedReply));
    set(node.port(), None);
    node.port().bus().count(8);
    let mut buffer = [0; 20];
    assert_eq!((Client::read(&mut node, TEXT, &mut buffer), &buffer[..]), (Ok(20), &text(8)[..]));
}

/// Length of a value that has 100 segments. Its transfer may take one timeout, plus one tenth of the timeout for each
/// segment. The last request and the abort additionally take the time of one frame each.
const LONG: usize = 700;
const LIMIT: Duration = Duration::from_millis(11 * 500);

#[test]
fn a_node_that_replies_just_in_time_doesnt_block_for_ever() {
    let value = [7; LONG];
    let mut node = node();
    for writes in [false, true] {
        node.port().bus().objects.0.insert(TEXT, value.to_vec());
        set(node.port(), SLOW);
        let (start, aborts) = (node.port().bus().now, node.port().bus().aborts);
        let result = match writes {
            false => Client::read(&mut node, TEXT, &mut [0; LONG]).map(|_| ()),
            true => Client::write(&mut node, TEXT, &value),
        };
        assert_eq!((result, node.port().bus().now - start), (Err(Error::Timeout), LIMIT + 2 * FRAME));
        assert_eq!(node.port().bus().aborts - aborts, 1);
        set(node.port(), None);
        node.port().bus().count(8);
        let mut buffer = [0; 20];
        assert_eq!((Client::read(&mut node, TEXT, &mut buffer), &buffer[..]), (Ok(20), &text(8)[..]));
    }
}

#[test]
fn async_transfers_have_the_same_limit() {
    let mut bus = Bus::new();
    bus.objects.0.insert(TEXT, vec![7; LONG]);
    let mut bus = AsyncBus { bus: FaultyCan::new(bus), pending_after: None };
    set(&mut bus.bus, SLOW);
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    assert_eq!(now(AsyncClient::read(&mut node, TEXT, &mut [0; LONG])), Err(Error::Timeout));
    assert_eq!((node.port().bus.bus().now, node.port().bus.bus().aborts), (LIMIT + 2 * FRAME, 1));
}

#[test]
fn slow_segments_within_the_limit_are_right() {
    let mut node = node();
    node.port().bus().objects.0.insert(TEXT, vec![7; LONG]);
    set(node.port(), CanFault::Late(TIMEOUT / 11));
    let mut buffer = [0; LONG];
    assert_eq!((Client::read(&mut node, TEXT, &mut buffer), buffer), (Ok(LONG), [7; LONG]));
    assert_eq!(Client::write(&mut node, TEXT, &buffer), Ok(()));
}

#[test]
fn a_dropped_transfer_is_aborted_and_the_next_one_is_right() {
    let bus = AsyncBus { bus: FaultyCan::new(Bus::new()), pending_after: Some(0) };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    node.port().bus.bus().count(7);
    let mut buffer = [0; 20];
    for object in [COUNT, TEXT] {
        let mut dropped = pin!(AsyncClient::read(&mut node, object, &mut buffer));
        assert_eq!(poll_once(dropped.as_mut()), Poll::Pending);
    }
    assert_eq!(node.port().bus.bus().aborts, 1, "the second transfer aborts the first one");
    node.port().pending_after = None;
    node.port().bus.bus().count(8);
    assert_eq!(now(AsyncClient::read(&mut node, TEXT, &mut buffer)), Ok(20));
    assert_eq!((&buffer[..], node.port().bus.bus().aborts), (&text(8)[..], 1));
}

/// Length of a value that is transferred in blocks.
const BLOCK: usize = 2000;

fn block(count: u32) -> Vec<u8> {
    (0..BLOCK as u32).map(|at| (at.wrapping_mul(count + 7) / 3) as u8).collect()
}

#[test]
fn faults_in_block_transfers() {
    for (fault, expected) in [
        (None, Ok(BLOCK)),
        (Some(CanFault::Duplicated), Ok(BLOCK)),
        (Some(CanFault::Late(Duration::from_millis(50))), Ok(BLOCK)),
        (Some(CanFault::Lost), Err(Error::Timeout)),
        (Some(CanFault::Truncated), Err(Error::Timeout)),
        (Some(CanFault::Late(TIMEOUT + Duration::from_millis(100))), Err(Error::Timeout)),
    ] {
        let (mut node, mut buffer) = (node(), vec![0; BLOCK]);
        node.port().bus().objects.0.insert(TEXT, block(1));
        set(node.port(), fault);
        assert_eq!(Client::read(&mut node, TEXT, &mut buffer), expected, "{fault:?}");
        assert!(expected.is_err() || buffer == block(1), "{fault:?}");
        // If each acknowledgment of the node arrives twice, the client may notice this only at the end of the transfer.
        match Client::write(&mut node, SETPOINT, &block(2)) {
            Ok(()) => assert_eq!(node.port().bus().objects.0[&SETPOINT], block(2)),
            result => assert!(expected.is_err() || fault == Some(CanFault::Duplicated), "{fault:?} {result:?}"),
        }
        set(node.port(), None);
        node.port().bus().objects.0.insert(TEXT, block(3));
        assert_eq!(Client::read(&mut node, TEXT, &mut buffer), Ok(BLOCK), "{fault:?}");
        assert!(buffer == block(3), "{fault:?}");
    }
}

/// The segments of a dropped block transfer must not be taken for replies to the next request.
#[test]
fn late_segments_are_discarded() {
    let reply = [0x4B, 0x00, 0x20, 0, 9, 9, 0, 0];
    let mut node = node();
    // Each segment of this value is a valid reply about the object `COUNT`, except for its first byte.
    node.port().bus().objects.0.insert(TEXT, reply[1..].iter().copied().cycle().take(BLOCK).collect());
    set(node.port(), CanFault::Late(TIMEOUT * 9 / 10));
    let mut buffer = vec![0; BLOCK];
    let limited = Client::read(&mut node, TEXT, &mut buffer);
    assert_eq!(limited, Ok(BLOCK));
    set(node.port(), CanFault::Late(TIMEOUT / 2));
    // The transfer is dropped after its first segment has been requested.
    let bus = AsyncBus { bus: node.into_port(), pending_after: Some(1) };
    let mut node = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
    assert_eq!(poll_once(pin!(AsyncClient::read(&mut node, TEXT, &mut buffer)).as_mut()), Poll::Pending);
    node.port().pending_after = None;
    set(&mut node.port().bus, None);
    node.port().bus.bus().count(0x0403_0201);
    let mut number = [0; 4];
    assert_eq!(now(AsyncClient::read(&mut node, COUNT, &mut number)), Ok(4));
    assert_eq!((number, node.port().bus.bus().aborts), ([1, 2, 3, 4], 1));
}

/// A kind of transfer in the table of faults, in addition to SDO reads.
#[derive(Clone, Copy)]
enum Access {
    Write,
    BlockRead,
    BlockWrite,
}

/// Transfers a value that depends on `count`. Panics if the result is wrong.
fn transfer<P>(
    node: &mut Node<P>,
    access: Access,
    count: u32,
    read: impl FnOnce(&mut Node<P>, &mut [u8]) -> Result<usize, Error<CanError>>,
    write: impl FnOnce(&mut Node<P>, &[u8]) -> Result<(), Error<CanError>>,
    mut bus: impl FnMut(&mut Node<P>) -> &mut Bus,
) -> Result<(), Error<CanError>> {
    let value = if let Access::Write = access { count.to_le_bytes().to_vec() } else { block(count) };
    if let Access::BlockRead = access {
        bus(node).objects.0.insert(TEXT, value.clone());
        let mut buffer = [0; BLOCK];
        return read(node, &mut buffer).map(|length| assert!(buffer[..length] == value, "a wrong value"));
    }
    write(node, &value)?;
    assert!(bus(node).objects.0[&SETPOINT] == value, "a wrong value");
    Ok(())
}

/// Returns the rows for writes and for block transfers.
fn further_rows() -> Vec<Row> {
    let frame = CanFrame::new(0x585, &[0x60, 0x34, 0x12, 1, 0, 0, 0, 0]).expect("a frame");
    let accesses =
        [("SDO write", Access::Write), ("block read", Access::BlockRead), ("block write", Access::BlockWrite)];
    let mut rows = Vec::new();
    for (client, access) in accesses {
        for (fault_name, fault) in faults(frame) {
            // With less noise, the queue of the simulated interface can hold the segments of a block.
            let fault = if let CanFault::Noise(_) = fault { CanFault::Noise(100) } else { fault };
            for is_async in [false, true] {
                let bus = AsyncBus { bus: FaultyCan::new(Bus::new()), pending_after: None };
                let mut asynchronous = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
                let mut blocking = node();
                let mut run = |count: u32, fault: Option<CanFault>| {
                    let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                    set(port, fault);
                    let start = port.bus().now;
                    let result = if is_async {
                        let read = |node: &mut Node<_>, buffer: &mut [u8]| now(AsyncClient::read(node, TEXT, buffer));
                        let write = |node: &mut Node<_>, data: &[u8]| now(AsyncClient::write(node, SETPOINT, data));
                        transfer(&mut asynchronous, access, count, read, write, |node| node.port().bus.bus())
                    } else {
                        let read = |node: &mut Node<_>, buffer: &mut [u8]| Client::read(node, TEXT, buffer);
                        let write = |node: &mut Node<_>, data: &[u8]| Client::write(node, SETPOINT, data);
                        transfer(&mut blocking, access, count, read, write, |node| node.port().bus())
                    };
                    let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                    (name(&result), port.bus().now - start)
                };
                let (result, time) = run(1, Some(fault));
                let (second, next) = run(2, None);
                assert_eq!(second, "right value", "{client} after {fault_name}");
                rows.push(Row { client, is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
            }
        }
    }
    rows
}

/// Returns the rows for SDO transfers in the table of faults. Only a segmented transfer has toggle bits.
pub fn rows() -> Vec<Row> {
    let frame = CanFrame::new(0x585, &[0x43, 0x34, 0x12, 1, 9, 9, 9, 9]).expect("a frame");
    let faults = faults(frame).into_iter().map(|(name, fault)| (name, fault, COUNT));
    let mut rows = further_rows();
    for (fault_name, fault, object) in faults.chain([("wrong toggle", CanFault::WrongToggle, TEXT)]) {
        for is_async in [false, true] {
            let mut blocking = node();
            let bus = AsyncBus { bus: FaultyCan::new(Bus::new()), pending_after: None };
            let mut asynchronous = Node::new(bus, NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT);
            let mut read = |count: u32, fault: Option<CanFault>| {
                let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                port.bus().count(count);
                set(port, fault);
                let (start, mut buffer) = (port.bus().now, [0; 20]);
                let buffer = if object == COUNT { &mut buffer[..4] } else { &mut buffer };
                let result = match is_async {
                    true => now(AsyncClient::read(&mut asynchronous, object, buffer)),
                    false => Client::read(&mut blocking, object, buffer),
                };
                let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                assert!(result.is_err() || *buffer == port.bus().objects.0[&object], "{fault:?}");
                (result, port.bus().now - start)
            };
            let (result, time) = read(1, Some(fault));
            let (second, next) = read(2, None);
            second.expect("the next request is right");
            let (client, result, timeout) = ("SDO", name(&result), TIMEOUT);
            rows.push(Row { client, is_async, fault: fault_name, result, time, next, timeout });
        }
    }
    rows
}
