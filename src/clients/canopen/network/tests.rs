//! Tests of several nodes on one simulated bus.

use core::pin::pin;
use core::task::Context;
use std::vec::Vec;

use super::*;
use crate::bus::Object;
use crate::client::{AsyncClient, Client};
use crate::clients::canopen::slow::silent;
use crate::clients::canopen::{AsyncCanPort, CanPort, NmtCommand, NmtState, Node};
use crate::data_type::DataType;
use crate::emergency::Emergency;
use crate::error::Error;
use crate::flags::Flags;
use crate::pdo::CobId;
use crate::sim::{CanBus, CanNode, Device};
use crate::table::{AccessRights, Bound, Entry, RawInitial};

const TEXT: Object = Object::new(0x2000, 0);
pub(super) const PDO: CobId = CobId::from_node(0x180);

const fn entry(index: u16, sub_index: u8, data_type: DataType) -> Entry {
    Entry {
        object: Some(Object::new(index, sub_index)),
        register: None,
        name: "",
        data_type,
        access: AccessRights::ReadWrite,
        flags: Flags::NONE,
        initial: RawInitial::Unknown,
        configured: None,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

pub(super) fn id(node: u8) -> NodeId {
    NodeId::new(node).expect("a node-ID")
}

/// Creates a bus with the nodes 1 to `count`.
fn bus(count: u8) -> CanBus {
    let entries = [entry(0x1001, 0, DataType::Unsigned8), entry(0x2000, 0, DataType::Domain)];
    let mut bus = CanBus::new();
    for node in 1..=count {
        bus.add(CanNode::new(Device::new(&entries).with_node_id(id(node))));
    }
    bus
}

/// A network whose nodes have sent PDOs and emergency messages.
fn busy<const N: usize>() -> Network<Script, N> {
    let mut frames = Vec::new();
    for number in 0..20 {
        frames.push(CanFrame::of(0x182, [number]));
        frames.push(CanFrame::of(0x183, [number]));
        if number % 5 == 0 {
            frames.push(Emergency { code: 0x1000 + u16::from(number), register: 1, vendor: [0; 5] }.frame(id(2)));
        }
    }
    frames.push(CanFrame::of(0x701, [5]));
    Network::new(Script(frames.into()))
}

/// An interface that has received these frames.
struct Script(std::collections::VecDeque<CanFrame>);

impl CanPort for Script {
    type Error = core::convert::Infallible;

    fn send(&mut self, _: &CanFrame, _: Duration) -> Result<bool, Self::Error> {
        Ok(true)
    }

    fn receive(
        &mut self,
        _: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Self::Error> {
        Ok(core::iter::from_fn(|| self.0.pop_front()).find(|frame| wanted(frame)))
    }
}

#[test]
fn frames_of_other_nodes_are_kept() {
    let network = busy::<8>();
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert_eq!(one.heartbeat(Duration::ZERO), Ok(Some(NmtState::Operational)));
    // Node 3 has no handle. Only the newest PDO is kept, and all emergency messages.
    assert_eq!(two.latest_pdo(PDO).map(|pdo| pdo.map(|pdo| pdo.data()[0])), Ok(Some(19)));
    assert_eq!(two.latest_pdo(PDO), Ok(None));
    let codes: Vec<_> = core::iter::from_fn(|| two.emergency(Duration::ZERO).unwrap()).map(|it| it.code).collect();
    assert_eq!(codes, [0x1000, 0x1005, 0x100A, 0x100F]);
    assert_eq!((network.lost(), network.lost_emergencies()), (0, 0));
    // The PDOs of node 3 are for no handle.
    assert_eq!(network.unclaimed(), 20);
}

#[test]
fn lost_emergencies_are_counted() {
    let network = busy::<2>();
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert_eq!(one.heartbeat(Duration::ZERO), Ok(Some(NmtState::Operational)));
    assert_eq!(network.lost_emergencies(), 3);
    let codes: Vec<_> = core::iter::from_fn(|| two.emergency(Duration::ZERO).unwrap()).map(|it| it.code).collect();
    assert_eq!(codes, [0x100F]);
    // PDOs have half of the room.
    assert!(two.latest_pdo(PDO).unwrap().is_some());
}

#[test]
fn two_nodes_side_by_side() {
    let network = Network::<_, 8>::new(bus(2));
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    for length in [3_usize, 200] {
        let [left, right] = [1, 2].map(|byte| std::vec![byte; length]);
        assert_eq!((Client::write(&mut one, TEXT, &left), Client::write(&mut two, TEXT, &right)), (Ok(()), Ok(())));
        let mut buffer = [0; 200];
        assert_eq!((Client::read(&mut one, TEXT, &mut buffer), &buffer[..length]), (Ok(length), &left[..]));
        assert_eq!((Client::read(&mut two, TEXT, &mut buffer), &buffer[..length]), (Ok(length), &right[..]));
    }
    // The boot-up message of node 2 arrived during the transfers of node 1.
    assert_eq!(two.wait_for(NmtState::BootUp, Duration::ZERO), Ok(()));
}

/// Polls several futures in turn until all have ended.
fn together<F: core::future::Future>(futures: Vec<F>) -> Vec<F::Output> {
    let waker = silent();
    let mut running: Vec<_> = futures.into_iter().map(|future| (std::boxed::Box::pin(future), None)).collect();
    for _ in 0..1_000_000 {
        for (future, output) in running.iter_mut().filter(|(_, output)| output.is_none()) {
            if let core::task::Poll::Ready(value) = future.as_mut().poll(&mut Context::from_waker(&waker)) {
                *output = Some(value);
            }
        }
        if running.iter().all(|(_, output)| output.is_some()) {
            break;
        }
    }
    running.into_iter().map(|(_, output)| output.expect("it ends")).collect()
}

async fn exchange<const N: usize>(
    network: &Network<CanBus, N>,
    node: u8,
) -> Result<(), Error<core::convert::Infallible>> {
    let mut client = Node::new(network.node(id(node)), id(node));
    for round in 0..10 {
        let value = std::vec![node.wrapping_mul(31).wrapping_add(round); 100];
        AsyncClient::write(&mut client, TEXT, &value).await?;
        let mut buffer = [0; 100];
        assert_eq!(AsyncClient::read(&mut client, TEXT, &mut buffer).await?, 100);
        assert_eq!(buffer[..], value);
    }
    Ok(())
}

#[test]
fn async_nodes_side_by_side() {
    let network = Network::<_, 32>::new(bus(6));
    let results = together((1..=6).map(|node| exchange(&network, node)).collect());
    assert!(results.iter().all(Result::is_ok), "{results:?}");
}

#[test]
fn a_timeout_ends_while_another_handle_waits() {
    let network = Network::<_, 8>::new(bus(2));
    let wait = |node: u8, time: u64| {
        let mut port = network.node(id(node));
        async move {
            let start = AsyncCanPort::now(&mut port);
            let frame = AsyncCanPort::receive(&mut port, Duration::from_millis(time), &mut |_| false).await;
            assert_eq!(frame, Ok(None));
            AsyncCanPort::now(&mut port).zip(start).map(|(end, start)| end - start)
        }
    };
    let times = together(std::vec![wait(1, 1000), wait(2, 100)]);
    assert!(
        times[0] >= Some(Duration::from_millis(1000)) && times[0] <= Some(Duration::from_millis(1002)),
        "{times:?}"
    );
    assert!(times[1] >= Some(Duration::from_millis(100)) && times[1] <= Some(Duration::from_millis(102)), "{times:?}");
}

#[test]
fn a_dropped_future_returns_the_interface() {
    struct Pending;
    impl AsyncCanPort for Pending {
        type Error = ();
        async fn send(&mut self, _: &CanFrame, _: Duration) -> Result<bool, ()> {
            Ok(true)
        }
        async fn receive(&mut self, _: Duration, _: &mut dyn FnMut(&CanFrame) -> bool) -> Result<Option<CanFrame>, ()> {
            core::future::pending().await
        }
    }
    let network = Network::<_, 8>::new(Pending);
    let mut port = network.node(id(1));
    {
        let mut wanted = |_: &CanFrame| true;
        let mut future = pin!(AsyncCanPort::receive(&mut port, Duration::from_secs(1), &mut wanted));
        let waker = silent();
        let mut context = Context::from_waker(&waker);
        assert!(core::future::Future::poll(future.as_mut(), &mut context).is_pending());
    }
    drop(port);
    assert!(network.into_inner().is_some());
}

/// An interface that has received these frames.
fn script(frames: impl IntoIterator<Item = CanFrame>) -> Script {
    Script(frames.into_iter().collect())
}

pub(super) fn frame(id: u32, data: &[u8]) -> CanFrame {
    CanFrame::new(id, data).expect("a frame")
}

#[test]
fn frames_that_nobody_receives_leave_room_for_pdos() {
    let mut frames = Vec::new();
    for byte in 0..20 {
        frames.extend([0x701, 0x702].map(|id| frame(id, &[5])));
        frames.extend([0x601, 0x602, 0x202].map(|id| frame(id, &[0; 8])));
        frames.extend(CanFrame::remote(0x182, 2));
        frames.extend([1, 2].map(|node| Emergency { code: 0x1000, register: 1, vendor: [0; 5] }.frame(id(node))));
        frames.extend([0x181, 0x182].map(|id| frame(id, &[byte])));
    }
    let network = Network::<_, 8>::new(script(frames));
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    let newest = |pdo: Result<Option<CanFrame>, _>| pdo.map(|pdo| pdo.map(|pdo| pdo.data()[0]));
    assert_eq!((newest(one.latest_pdo(PDO)), newest(two.latest_pdo(PDO))), (Ok(Some(19)), Ok(Some(19))));
}

#[test]
fn a_dead_node_is_operational_only_once() {
    let beats = (0..20).map(|_| frame(0x701, &[5]));
    let network = Network::<_, 8>::new(script(beats));
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert_eq!(two.heartbeat(Duration::ZERO), Ok(None));
    let states = [(); 2].map(|()| one.heartbeat(Duration::ZERO).unwrap());
    assert_eq!(states, [Some(NmtState::Operational), None]);
    // Without a network, too. A restart is not missed.
    let beats = [5, 5, 0, 0x7F, 5].map(|state| frame(0x701, &[state]));
    let mut alone = Node::new(script(beats), id(1));
    let states = [(); 3].map(|()| alone.heartbeat(Duration::ZERO).unwrap());
    assert_eq!(states, [Some(NmtState::BootUp), Some(NmtState::Operational), None]);
}

#[test]
fn an_old_boot_up_message_doesnt_confirm_a_restart() {
    let network = Network::<_, 8>::new(script([frame(0x701, &[0]), frame(0x181, &[7]), frame(0x701, &[0])]));
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert_eq!(two.latest_pdo(PDO), Ok(None));
    one.nmt(NmtCommand::ResetNode).unwrap();
    assert_eq!(one.wait_for(NmtState::BootUp, Duration::ZERO), Err(Error::Timeout));
    assert!(one.latest_pdo(PDO).unwrap().is_some());
    let mut alone = Node::new(script([frame(0x701, &[0])]), id(1));
    alone.nmt(NmtCommand::ResetCommunication).unwrap();
    assert_eq!(alone.wait_for(NmtState::BootUp, Duration::ZERO), Err(Error::Timeout));
}

#[test]
fn a_handle_discards_only_its_own_frames() {
    let network = Network::<_, 8>::new(script([0x181, 0x182, 0x281, 0x282].map(|id| frame(id, &[1]))));
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert!(one.latest_pdo(CobId::from_node(0x280)).unwrap().is_some());
    one.port().clear().unwrap();
    assert_eq!(one.latest_pdo(PDO), Ok(None));
    assert!(two.latest_pdo(PDO).unwrap().is_some());
    assert!(two.latest_pdo(CobId::from_node(0x280)).unwrap().is_some());
}

#[test]
fn added_cob_ids() {
    const WIDE: u32 = CanFrame::EXTENDED | 0x185;
    let emergency = |code| Emergency { code, register: 1, vendor: [0; 5] }.to_bytes();
    let mut frames: Vec<_> = (0..20).map(|byte| frame(WIDE, &[byte])).collect();
    frames.extend([1, 2].map(|code| frame(0x190, &emergency(code))));
    frames.push(frame(0x1C5, &[3]));
    let network = Network::<_, 8>::new(script(frames));
    let port = network.node(id(1)).with_pdo(CobId::fixed(WIDE)).and_then(|port| port.with_emergency(0x190));
    let mut one = Node::new(port.expect("room"), id(1)).with_emergency_id(0x190);
    let mut two = Node::new(network.node(id(2)), id(2));
    assert_eq!(two.heartbeat(Duration::ZERO), Ok(None));
    assert_eq!(one.latest_pdo(CobId::fixed(WIDE)).unwrap().map(|pdo| pdo.data()[0]), Some(19));
    let codes: Vec<_> = core::iter::from_fn(|| one.emergency(Duration::ZERO).unwrap()).map(|it| it.code).collect();
    assert_eq!((codes, network.lost()), (std::vec![1, 2], 0));
    // A COB-ID belongs to one node, until the last handle of the node is dropped.
    assert!(network.node(id(2)).with_pdo(CobId::fixed(WIDE)).is_none());
    assert!(network.node(id(2)).with_pdo(CobId::fixed(0x701)).is_none());
    assert!(network.services().with_emergency(0x191).is_none());
    drop(one);
    assert!(network.node(id(2)).with_pdo(CobId::fixed(WIDE)).is_some());
}

#[test]
fn frames_of_nodes_without_a_handle() {
    let network = Network::<_, 8>::new(script([frame(0x1C5, &[3]), frame(0x181, &[4])]));
    // This COB-ID is a default one of node 69, which doesn't exist.
    let mut two = Node::new(network.node(id(2)), id(2));
    let one = network.node(id(1));
    assert!(two.latest_pdo(CobId::fixed(0x1C5)).unwrap().is_some());
    assert_eq!(two.latest_pdo(PDO), Ok(None));
    drop(one);
    // The frames of a handle that was dropped are discarded.
    assert_eq!(Node::new(network.node(id(1)), id(1)).latest_pdo(PDO), Ok(None));
}

#[test]
fn lss_answers_are_kept_for_the_services() {
    let answer = frame(0x7E4, &[0x11, 0, 0, 0, 0, 0, 0, 0]);
    let network = Network::<_, 8>::new(script([answer, frame(0x100, &[1, 0, 0, 0, 2, 0]), answer]));
    let (mut services, mut one) = (network.services(), Node::new(network.node(id(1)), id(1)));
    assert_eq!((one.heartbeat(Duration::ZERO), one.time(Duration::ZERO)), (Ok(None), Ok(None)));
    let mut answers = || services.receive(Duration::ZERO, &mut |frame| frame.id() == 0x7E4).unwrap();
    assert_eq!([answers(), answers(), answers()], [Some(answer), Some(answer), None]);
    assert!(Node::new(services, id(1)).time(Duration::ZERO).unwrap().is_some());
}
