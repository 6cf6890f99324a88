//! Tests that clients get the newest PDO.

use std::time::Duration;

use lexibus::clients::canopen::{sync, AsyncCanPort, Buffered, CanFrame, CanPort, Node};
use lexibus::sim::{CanError, CanFault, FaultyCan};
use lexibus::{AsyncClient, Client, CobId, Error, LengthError, NodeId};

use super::bus::*;
use crate::faulty::{faults, set, TIMEOUT};
use crate::matrix::{name, Row};
use crate::now::now;

const PDO: CobId = CobId::from_node(0x180);

/// Returns a node that has sent 200 PDOs. While the client waits for another message, its buffer keeps 16 of these PDOs.
fn behind() -> Node<Buffered<AsyncBus, 16>> {
    let mut bus = Bus::new();
    for _ in 0..200 {
        bus.send(&sync(), Duration::ZERO).expect("it is sent");
    }
    bus.now = Duration::from_secs(1);
    bus.count(7);
    let bus = AsyncBus { bus: FaultyCan::new(bus), pending_after: None };
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
        Ok::<(), CanError>(())
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

/// Checks that a PDO contains the number of the last SYNC. Returns an error if the PDO has a wrong length, and panics if the
/// number is wrong.
fn check(pdo: &CanFrame, bus: &Bus) -> Result<(), Error<CanError>> {
    let data = pdo.data();
    let number = data.try_into().map_err(|_| Error::Length(LengthError::new(4, data.len())))?;
    assert_eq!(u32::from_le_bytes(number), bus.sample, "an old value");
    Ok(())
}

/// Runs one cycle of a master: discards old PDOs, sends SYNC, and receives the PDO that the node sends after SYNC.
fn cycle(node: &mut Node<FaultyCan<Bus>>) -> Result<(), Error<CanError>> {
    node.latest_pdo(PDO)?;
    node.sync()?;
    let pdo = node.receive_pdo(PDO, TIMEOUT)?;
    check(&pdo, node.port().bus())
}

async fn cycle_async(node: &mut Node<AsyncBus>) -> Result<(), Error<CanError>> {
    node.latest_pdo_async(PDO).await?;
    node.sync_async().await?;
    let pdo = node.receive_pdo_async(PDO, TIMEOUT).await?;
    check(&pdo, node.port().bus.bus())
}

/// Returns the rows for PDOs in the table of faults.
pub fn rows() -> Vec<Row> {
    let foreign = CanFrame::new(0x186, &[9, 9, 9, 9]).expect("a frame");
    let mut rows = Vec::new();
    for (fault_name, fault) in faults(foreign) {
        for is_async in [false, true] {
            let mut blocking = node();
            let bus = AsyncBus { bus: FaultyCan::new(Bus::new()), pending_after: None };
            let mut asynchronous = Node::new(bus, NodeId::new(NODE).expect("a node-ID"));
            let mut run = |fault: Option<CanFault>| {
                let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                set(port, fault);
                let start = port.bus().now;
                let result = if is_async { now(cycle_async(&mut asynchronous)) } else { cycle(&mut blocking) };
                let port = if is_async { &mut asynchronous.port().bus } else { blocking.port() };
                (name(&result), port.bus().now - start)
            };
            let (result, time) = run(Some(fault));
            let (second, next) = run(None);
            assert_eq!(second, "right value", "after {fault_name}");
            rows.push(Row { client: "PDO", is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
        }
    }
    rows
}

#[test]
fn the_latest_pdo_has_the_time_at_which_it_was_taken_from_the_interface() {
    let time = |pdo: Result<Option<CanFrame>, _>| pdo.expect("no fault").and_then(|pdo: CanFrame| pdo.time());
    let mut node = behind();
    let start = node.port().now();
    assert_eq!(time(now(node.latest_pdo_async(PDO))), start, "the PDOs were in the queue of the interface");
    // At the start of the SDO transfer, the client moves the PDO to the buffer.
    now(node.sync_async()).expect("it is sent");
    now(AsyncClient::read(&mut node, TEXT, &mut [0; 20])).expect("a value");
    let (arrival, after) = (start.map(|start| start + FRAME), node.port().now());
    assert!(arrival < after);
    assert_eq!(time(now(node.latest_pdo_async(PDO))), arrival);
    let bus = node.into_port().into_inner().bus;
    let mut node = Node::new(Buffered::<_, 16>::new(bus), NodeId::new(NODE).expect("a node-ID"));
    node.sync().expect("it is sent");
    Client::read(&mut node, TEXT, &mut [0; 20]).expect("a value");
    assert_eq!(time(node.latest_pdo(PDO)), after.map(|after| after + FRAME));
}
