//! Tests the boot of a node with answers that are delayed, lost or corrupted.

use std::time::Duration;

use lexibus::clients::canopen::{Boot, BootError, Booted, CanFrame, ErrorControl, NmtCommand, NmtState, Node};
use lexibus::sim::{CanBus, CanError, CanFault, CanNode, Device};
use lexibus::{Configuration, Error, NodeId, SdoWrite, Setting};
use lexibus_drives::demo_drive::{ENTRIES, IDENTITY};

use crate::faulty::{faults, faulty, set, Faulty, TIMEOUT};
use crate::matrix::Row;
use crate::now::now;
use crate::random::Random;

const CONFIGURATION: Configuration =
    Configuration { communication: &[Setting::fixed(SdoWrite::new_u16(0x1017, 0, 50))], ..Configuration::EMPTY };

const BOOT: Boot = Boot::new(ErrorControl::Heartbeat(TIMEOUT))
    .device_type(0x0002_0192)
    .identity(&IDENTITY)
    .configuration(CONFIGURATION);

fn node() -> Node<Faulty> {
    let id = NodeId::new(5).expect("a node-ID");
    let mut bus = CanBus::new();
    bus.add(CanNode::new(Device::new(ENTRIES).with_node_id(id)));
    Node::new(faulty(bus), id)
}

/// Boots the node, whose identity is the expected one. Panics if the boot fails with an error that a bus fault cannot cause.
fn boot(node: &mut Node<Faulty>, is_async: bool) -> Result<Booted, BootError<CanError>> {
    let result = match is_async {
        true => now(node.boot_async(&BOOT)),
        false => node.boot(&BOOT),
    };
    match result {
        Ok(booted) => {
            assert_eq!((booted.device_type, booted.is_configured), (0x0002_0192, true));
            assert_eq!(node.port().bus().nodes()[0].state(), NmtState::Operational);
        }
        Err(error) => drop(name(Err(error))),
    }
    result
}

fn name(result: Result<Booted, BootError<CanError>>) -> &'static str {
    match result {
        Ok(_) => "right value",
        Err(BootError::Access { error: Error::Timeout, .. }) => "`Timeout`",
        Err(BootError::Configuration(error)) if error.error == Error::Timeout => "`Timeout`",
        Err(BootError::Access { error: Error::Client(_), .. }) => "`Client`",
        Err(BootError::NotOperational { .. }) => "`NotOperational`",
        Err(other) => panic!("an error without a name in the table: {other:?}"),
    }
}

#[test]
fn a_fault_is_not_a_wrong_device() {
    let (mut node, mut random, mut failed) = (node(), Random::new(11), 0);
    for _ in 0..500 {
        let fault = match random.below(6) {
            0 => Some(CanFault::Lost),
            1 => Some(CanFault::Late(Duration::from_millis(random.below(950)))),
            2 => Some(CanFault::Duplicated),
            3 => Some(CanFault::Truncated),
            _ => None,
        };
        set(node.port(), fault);
        failed += u32::from(boot(&mut node, false).is_err());
        set(node.port(), None);
        node.nmt(NmtCommand::EnterPreOperational).expect("a bus");
    }
    println!("500 boots: {failed} errors, no wrong device");
    assert!((50..350).contains(&failed), "{failed}");
}

/// Returns the rows for the boot of a node in the table of faults.
pub fn rows() -> Vec<Row> {
    let foreign = CanFrame::new(0x706, &[4]).expect("a frame");
    let mut rows = Vec::new();
    for (fault_name, fault) in faults(foreign) {
        for is_async in [false, true] {
            let mut node = node();
            let start = node.port().bus().now();
            set(node.port(), fault);
            let result = name(boot(&mut node, is_async));
            let middle = node.port().bus().now();
            set(node.port(), None);
            boot(&mut node, is_async).expect("the next boot is right");
            let (time, next) = (middle - start, node.port().bus().now() - middle);
            rows.push(Row { client: "boot", is_async, fault: fault_name, result, time, next, timeout: TIMEOUT });
        }
    }
    rows
}
