//! Tests of node guarding, TIME and 29-bit CAN-IDs with a simulated node.

use super::tests::{frames, node, send, set, NODE};
use super::*;
use crate::bus::Object;
use crate::client::Client;
use crate::clients::canopen::NmtCommand;
use crate::clients::canopen::{CanFrame, Channel, GuardError, Guarding, Node};
use crate::emergency::Emergency;
use crate::error::Error;
use crate::now::now;
use crate::pdo::CobId;
use crate::value_error::OutOfRange;

const GUARD_TIME: Duration = Duration::from_millis(100);

#[test]
fn guarding() {
    let mut client = Node::new(node(), NODE);
    let mut guarding = Guarding::new(GUARD_TIME, 3);
    assert_eq!(guarding.life_time(), Duration::from_millis(300));
    // The boot-up message is older than the cycle.
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::PreOperational));
    client.nmt(NmtCommand::Start).unwrap();
    assert_eq!(now(client.guard_async(&mut guarding)), Ok(NmtState::Operational));
    client.nmt(NmtCommand::Stop).unwrap();
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::Stopped));
    // A restart resets the toggle bit.
    client.nmt(NmtCommand::ResetNode).unwrap();
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::BootUp));
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::PreOperational));
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::PreOperational));
    client.port().set_connected(false);
    let cycles = [(); 4].map(|()| client.guard(&mut guarding));
    let (none, lost) = (Err(GuardError::NoAnswer), Err(GuardError::NodeLost));
    assert_eq!((cycles, guarding.missed()), ([none, none, lost, lost], 4));
    client.port().set_connected(true);
    assert_eq!(client.guard(&mut guarding), Ok(NmtState::PreOperational));
    assert_eq!(guarding.missed(), 0);
    // A node with a heartbeat producer doesn't answer.
    set(client.port(), 0x1017, 0, &[0xFF, 0xFF]);
    assert_eq!(client.guard(&mut guarding), none);
}

#[test]
fn life_guarding() {
    let mut client = Node::new(node(), NODE);
    set(client.port(), 0x100C, 0, &[100, 0]);
    set(client.port(), 0x100D, 0, &[3]);
    let mut guarding = Guarding::new(GUARD_TIME, 3);
    for _ in 0..5 {
        assert_eq!(client.guard(&mut guarding), Ok(NmtState::PreOperational));
        assert_eq!(client.emergency(Duration::from_millis(290)), Ok(None));
    }
    client.nmt(NmtCommand::Start).unwrap();
    set(client.port(), 0x1001, 0, &[0x20]);
    let error = Emergency { code: 0x8130, register: 0x31, vendor: [0; 5] };
    assert_eq!(client.emergency(GUARD_TIME), Ok(Some(error)));
    assert_eq!(client.emergency(Duration::from_secs(9)), Ok(None));
    // Without object 0x1029, the node leaves Operational.
    assert_eq!(client.port().state(), NmtState::PreOperational);
}

#[test]
fn time() {
    let (mut client, time) = (Node::new(node(), NODE), TimeOfDay::new(7, 9));
    client.send_time(time).unwrap();
    assert_eq!(client.port().time_of_day(), None);
    set(client.port(), 0x1012, 0, &[0, 1, 0, 0x80]);
    client.send_time(time).unwrap();
    assert_eq!(client.port().time_of_day(), Some(time));
    client.nmt(NmtCommand::Stop).unwrap();
    now(client.send_time_async(TimeOfDay::new(8, 9))).unwrap();
    assert_eq!(client.port().time_of_day(), Some(time));
    assert_eq!(client.time(Duration::ZERO), Ok(None));
    let older = TimeOfDay::new(6, 9).frame();
    client.port().outgoing.extend([CanFrame::new(0x100, &[1, 0, 0, 0, 2]).unwrap(), older, time.frame()]);
    let now = client.port().now();
    assert_eq!(client.time(Duration::ZERO), Ok(Some((time, Some(now)))));
    assert_eq!(client.send_time(TimeOfDay::new(86_400_000, 9)), Err(Error::OutOfRange(OutOfRange)));
    assert_eq!(client.send_time(TimeOfDay::new(1 << 28, 9)), Err(Error::OutOfRange(OutOfRange)));
}

#[test]
fn identifiers_of_29_bits() {
    let mut simulated = node();
    // SDO channel, EMCY, RPDO and TPDO with bit 29.
    set(&mut simulated, 0x1201, 1, &[0x05, 6, 0, 0x20]);
    set(&mut simulated, 0x1201, 2, &[0x85, 5, 0, 0x20]);
    set(&mut simulated, 0x1014, 0, &[0x78, 0x56, 0x34, 0x32]);
    set(&mut simulated, 0x1400, 1, &[0x05, 2, 0, 0x20]);
    set(&mut simulated, 0x1800, 1, &[0x85, 1, 0, 0x60]);
    let channel = Channel::new(0x2000_0605, 0x2000_0585).unwrap();
    let mut client = Node::new(simulated, NODE).with_channel(channel);
    assert_eq!(client.write(Object::new(0x2000, 0), &[3, 4]), Ok(()));
    client.nmt(NmtCommand::Start).unwrap();
    frames(client.port());
    let (rpdo, tpdo) = (CobId::fixed(0x2000_0205), CobId::fixed(0x6000_0185));
    client.send_pdo(rpdo, &[5, 6]).unwrap();
    let received = client.receive_pdo(tpdo, Duration::ZERO).unwrap();
    assert_eq!((received.data(), received.is_extended()), ([5, 6].as_slice(), true));
    client.port().device().emit_emergency(0x2310, 1, [0; 5]);
    let emergency = client.port().next_frame().unwrap();
    assert_eq!(Emergency::of_id(&emergency, 0x3234_5678).map(|it| it.code), Some(0x2310));
    client = client.with_emergency_id(0x3234_5678);
    client.port().device().emit_emergency(0x2311, 1, [0; 5]);
    assert_eq!(client.emergency(Duration::ZERO).map(|it| it.map(|it| it.code)), Ok(Some(0x2311)));
    // The same CAN-IDs with 11 bits are different frames, and so are remote frames.
    let node = client.port();
    send(node, 0x205, &[7, 7]);
    send(node, 0x605, &[0x40, 0x00, 0x20, 0, 0, 0, 0, 0]);
    assert_eq!(frames(node), [(0x585, [0x4B, 0, 0x20, 0, 5, 6, 0, 0].to_vec())]);
    node.handle(&CanFrame::remote(0x2000_0205, 2).unwrap());
    assert_eq!((frames(node), node.take_refused()), (std::vec![], std::vec![]));
    node.outgoing.extend(CanFrame::remote(0x2000_0185, 2));
    assert_eq!(client.latest_pdo(tpdo), Ok(None));
}
