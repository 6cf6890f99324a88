//! Tests node guarding with answers that are delayed, lost or corrupted.

use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, GuardError, Guarding, NmtCommand, NmtState, Node};
use lexibus::sim::{CanBus, CanError, CanFault, CanNode, Device};
use lexibus::NodeId;

use crate::faulty::{faults, faulty, set, Faulty, TIMEOUT};
use crate::matrix::Row;
use crate::now::now;
use crate::random::Random;

const NODE: u8 = 5;

fn node() -> Node<Faulty> {
    let id = NodeId::new(NODE).expect("a node-ID");
    let mut bus = CanBus::new();
    bus.add(CanNode::new(Device::new(&[]).with_node_id(id)));
    Node::new(faulty(bus), id)
}

/// Runs one cycle. The result must be the state of the node, `BootUp` after a restart, or an error.
fn guard(node: &mut Node<Faulty>, guarding: &mut Guarding, is_async: bool) -> Result<NmtState, GuardError<CanError>> {
    let result = match is_async {
        true => now(node.guard_async(guarding)),
        false => node.guard(guarding),
    };
    let state = node.port().bus().nodes()[0].state();
    let is_right = result == Ok(state) || result == Ok(NmtState::BootUp);
    assert!(result.is_err() || is_right, "{result:?} instead of {state:?}");
    result
}

fn name(result: Result<NmtState, GuardError<CanError>>) -> &'static str {
    match result {
        Ok(NmtState::BootUp) => "`BootUp`",
        Ok(_) => "right value",
        Err(GuardError::NoAnswer) => "`NoAnswer`",
        Err(GuardError::Client(_)) => "`Client`",
        Err(GuardError::ToggleBit) => "`ToggleBit`",
        Err(other) => panic!("an error without a name in the table: {other:?}"),
    }
}

#[test]
fn late_answers_are_not_those_of_the_next_cycle() {
    let (mut node, mut random, mut late, mut failed, mut is_late) = (node(), Random::new(3), 0, 0, false);
    let mut guarding = Guarding::new(TIMEOUT, 3);
    for _ in 0..5000 {
        let command = if random.below(2) == 0 { NmtCommand::Start } else { NmtCommand::EnterPreOperational };
        node.nmt(command).expect("a bus");
        // Never delay two answers in succession. After a late answer, the next request is later than usual, and its answer
        // must arrive within one guard time.
        is_late = random.below(20) == 0 && !is_late;
        // The next cycle waits for a late answer for half of the guard time, so the additional delay is shorter.
        let delay = TIMEOUT + Duration::from_millis(random.below(240));
        set(node.port(), is_late.then_some(CanFault::Late(delay)));
        late += u32::from(is_late);
        let state = guard(&mut node, &mut guarding, false);
        assert_ne!(state, Ok(NmtState::BootUp));
        failed += u32::from(state.is_err());
    }
    println!("5,000 cycles of node guarding, {late} late: {failed} errors, no wrong state");
    assert!(late > 200 && failed <= late, "{failed} errors for {late} late answers");
}

/// Returns the rows for node guarding in the table of faults.
pub fn rows() -> Vec<Row> {
    let foreign = CanFrame::new(0x706, &[4]).expect("a frame");
    let mut rows = Vec::new();
    for (fault_name, fault) in faults(foreign).into_iter().chain([("wrong toggle", CanFault::WrongToggle)]) {
        for is_async in [false, true] {
            let (mut node, mut guarding) = (node(), Guarding::new(TIMEOUT, 3));
            guard(&mut node, &mut guarding, is_async).expect("a state");
            let start = node.port().bus().now();
            set(node.port(), fault);
            let result = name(guard(&mut node, &mut guarding, is_async));
            assert_eq!(result == "`BootUp`", fault == CanFault::Restart);
            let middle = node.port().bus().now();
            // After a node has once failed to toggle the bit, all its later toggle bits are inverted.
            set(node.port(), (fault == CanFault::WrongToggle).then_some(fault));
            node.nmt(NmtCommand::Start).expect("a bus");
            guard(&mut node, &mut guarding, is_async).expect("the next cycle is right");
            let (time, next) = (middle - start, node.port().bus().now() - middle);
            rows.push(Row {
                client: "node guarding",
                is_async,
                fault: fault_name,
                result,
                time,
                next,
                timeout: TIMEOUT,
            });
        }
    }
    rows
}
