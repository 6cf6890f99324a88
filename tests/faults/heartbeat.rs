//! Tests the heartbeat consumer with heartbeats that are delayed, lost or corrupted, over many cycles.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::Arc;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, HeartbeatConsumer, HeartbeatError, NmtState, Node};
use lexibus::sim::{CanBus, CanError, CanFault, CanNode, Device};
use lexibus::{AccessRights, Bound, DataType, Entry, Flags, NodeId, Object, RawInitial};

use crate::faulty::{faults, faulty, set, Faulty, TIMEOUT};
use crate::matrix::Row;
use crate::now::now;
use crate::random::Random;

const NODE: u8 = 5;
const PERIOD: Duration = Duration::from_millis(100);
/// Heartbeat consumer time, which tolerates one missing heartbeat.
const CONSUMER_TIME: Duration = Duration::from_millis(250);

/// Objects of the node: the producer heartbeat time, in ms.
const ENTRIES: &[Entry] = &[Entry {
    object: Some(Object::new(0x1017, 0)),
    register: None,
    name: "",
    data_type: DataType::Unsigned16,
    access: AccessRights::ReadWrite,
    flags: Flags::NONE,
    initial: RawInitial::Bytes(&[100, 0]),
    configured: None,
    low: Bound::Unlimited,
    high: Bound::Unlimited,
    unit: "",
}];

fn node() -> Node<Faulty> {
    let id = NodeId::new(NODE).expect("a node-ID");
    let mut bus = CanBus::new();
    bus.add(CanNode::new(Device::new(ENTRIES).with_node_id(id)));
    Node::new(faulty(bus), id)
}

type Watched = Result<Option<NmtState>, HeartbeatError<CanError>>;

/// Waits for `pause` in simulated time, and checks the node. A reported state must be that of the node, or `BootUp`.
fn watch(node: &mut Node<Faulty>, consumer: &mut HeartbeatConsumer, is_async: bool, pause: Duration) -> Watched {
    node.port().bus().advance(pause);
    let result = match is_async {
        true => now(node.watch_async(consumer)),
        false => node.watch(consumer),
    };
    let actual = node.port().bus().nodes()[0].state();
    let is_right = |state| state == actual || state == NmtState::BootUp;
    assert!(!matches!(result, Ok(Some(state)) if !is_right(state)), "{result:?} instead of {actual:?}");
    result
}

#[test]
fn lost_heartbeats_and_a_late_master() {
    const CYCLES: u32 = 50_000;
    let (mut node, mut consumer, mut random) = (node(), HeartbeatConsumer::new(CONSUMER_TIME), Random::new(17));
    let arrived = Arc::new(AtomicU32::new(0));
    let (counter, mut losses) = (arrived.clone(), Random::new(18));
    // One heartbeat in five is lost, so that often several are lost in succession.
    node.port().inject(CanFault::Lost, move |_| {
        let is_lost = losses.below(5) == 0;
        counter.fetch_add(u32::from(!is_lost), Ordering::Relaxed);
        is_lost
    });
    let (mut known, mut last, mut missing, mut recovered) = (0, None, 0, 0);
    let mut was_missing = false;
    for cycle in 0..CYCLES {
        // The cycle time of the master is 10 ms, plus a random delay of up to 20 ms.
        let result = watch(&mut node, &mut consumer, cycle % 2 == 0, Duration::from_millis(10 + random.below(21)));
        let time = node.port().bus().now();
        if arrived.load(Ordering::Relaxed) != known {
            (known, last) = (arrived.load(Ordering::Relaxed), Some(time));
        }
        let expected = match last {
            None => Ok(None),
            Some(last) if time - last > CONSUMER_TIME => {
                Err(HeartbeatError::Missing { state: NmtState::PreOperational })
            }
            Some(_) => Ok(Some(NmtState::PreOperational)),
        };
        assert_eq!(result, expected, "cycle {cycle}");
        missing += u32::from(result.is_err() && !was_missing);
        recovered += u32::from(result.is_ok() && was_missing);
        was_missing = result.is_err();
    }
    println!("{CYCLES} cycles, {known} heartbeats: {missing} times missing, {recovered} times back");
    assert!(missing > 100 && missing - recovered <= 1 && node.port().waiting() == 0);
}

#[test]
fn a_restart_is_never_missed() {
    let (mut node, mut consumer, mut random) = (node(), HeartbeatConsumer::new(CONSUMER_TIME), Random::new(19));
    let (mut restarts, mut seen) = (0, 0);
    for cycle in 0..10_000 {
        let is_restart = random.below(50) == 0;
        if is_restart {
            node.port().bus().nodes()[0].power_cycle();
            restarts += 1;
        }
        let state = watch(&mut node, &mut consumer, cycle % 2 == 0, Duration::from_millis(10 + random.below(190)));
        let state = state.expect("a heartbeat");
        seen += u32::from(state == Some(NmtState::BootUp));
        assert_eq!(is_restart, state == Some(NmtState::BootUp), "cycle {cycle}");
    }
    println!("10,000 cycles, {restarts} restarts");
    assert_eq!(restarts, seen);
}

/// Watches the node for one timeout, or until a boot-up or an error is reported. Returns the result for the table.
fn request(node: &mut Node<Faulty>, consumer: &mut HeartbeatConsumer, is_async: bool) -> &'static str {
    for _ in 0..TIMEOUT.as_millis() / 50 {
        match watch(node, consumer, is_async, Duration::from_millis(50)) {
            Ok(Some(NmtState::BootUp)) => return "`BootUp`",
            Ok(_) => {}
            Err(HeartbeatError::Missing { .. }) => return "`Missing`",
            Err(HeartbeatError::Client(_)) => return "`Client`",
            Err(other) => panic!("an error without a name in the table: {other:?}"),
        }
    }
    "right value"
}

/// Returns the rows for the heartbeat in the table of faults.
pub fn rows() -> Vec<Row> {
    let foreign = CanFrame::new(0x706, &[4]).expect("a frame");
    let mut rows = Vec::new();
    for (fault, injected) in faults(foreign) {
        for is_async in [false, true] {
            let (mut node, mut consumer) = (node(), HeartbeatConsumer::new(CONSUMER_TIME));
            assert_eq!(request(&mut node, &mut consumer, is_async), "right value");
            let start = node.port().bus().now();
            set(node.port(), injected);
            let result = request(&mut node, &mut consumer, is_async);
            let middle = node.port().bus().now();
            // The error lasts until the next heartbeat.
            set(node.port(), None);
            node.heartbeat(PERIOD * 2).expect("a bus").expect("a heartbeat");
            watch(&mut node, &mut consumer, is_async, PERIOD).expect("a heartbeat");
            assert_eq!(request(&mut node, &mut consumer, is_async), "right value");
            let (time, next) = (middle - start, Duration::ZERO);
            rows.push(Row { client: "heartbeat", is_async, fault, result, time, next, timeout: TIMEOUT });
        }
    }
    rows
}
