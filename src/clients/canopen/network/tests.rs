//! Tests of several nodes on one simulated bus.

use core::pin::pin;
use core::task::Context;
use std::sync::Arc;
use std::task::Wake;
use std::vec::Vec;

use super::*;
use crate::bus::Object;
use crate::client::{AsyncClient, Client};
use crate::clients::canopen::{AsyncCanPort, CanPort, NmtState, Node};
use crate::data_type::DataType;
use crate::emergency::Emergency;
use crate::error::Error;
use crate::flags::Flags;
use crate::pdo::CobId;
use crate::sim::{CanBus, CanNode, Device};
use crate::table::{AccessRights, Bound, Entry, RawInitial};

const TEXT: Object = Object::new(0x2000, 0);
const PDO: CobId = CobId::from_node(0x180);

const fn entry(index: u16, sub_index: u8, data_type: DataType) -> Entry {
    Entry {
        object: Some(Object::new(index, sub_index)),
        register: None,
        name: "",
        data_type,
        access: AccessRights::ReadWrite,
        flags: Flags::NONE,
        initial: RawInitial::Unknown,
        low: Bound::Unlimited,
        high: Bound::Unlimited,
        unit: "",
    }
}

fn id(node: u8) -> NodeId {
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
}

#[test]
fn lost_emergencies_are_counted() {
    let network = busy::<2>();
    let [mut one, mut two] = [1, 2].map(|node| Node::new(network.node(id(node)), id(node)));
    assert_eq!(one.heartbeat(Duration::ZERO), Ok(Some(NmtState::Operational)));
    assert_eq!(network.lost_emergencies(), 2);
    let codes: Vec<_> = core::iter::from_fn(|| two.emergency(Duration::ZERO).unwrap()).map(|it| it.code).collect();
    assert_eq!(codes, [0x100A, 0x100F]);
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

/// Returns a waker without effect.
fn silent() -> Waker {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    Arc::new(Silent).into()
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
    assert!(network.into_inner().is_some());
}
