//! Several nodes on one CAN interface.

mod handle;
mod kept;
#[cfg(all(test, feature = "std"))]
mod tests;

use core::cell::{Cell, RefCell};
use core::fmt;
use core::task::Waker;
use core::time::Duration;

use self::kept::Kept;
use super::frame::CanFrame;
use crate::node_id::NodeId;

/// Maximum number of async handles that wait for the interface without polling.
const MOST_WAKERS: usize = 16;

/// A CAN interface that several nodes share. Each node has a [handle](Self::node), which is a CAN port. With a
/// [`CanPort`](super::CanPort), the handles are [`CanPort`](super::CanPort)s. With an
/// [`AsyncCanPort`](super::AsyncCanPort), they are [`AsyncCanPort`](super::AsyncCanPort)s, for tasks on the same thread.
///
/// A handle receives only the frames of its node: those with the default COB-IDs of CiA 301 7.3.5, and those with the
/// COB-IDs that [`NetworkPort::with_cob_id`] adds. A frame that arrives while the handle of another node uses the
/// interface is kept, if its node has a handle. Frames
/// without a node, such as TIME, are for the handle that uses the interface. The network keeps up to `N` frames:
///
/// - Of each PDO, only the newest is kept. It replaces the older one.
/// - If there is no room, the oldest PDO is discarded. If no PDO is waiting, the oldest heartbeat is discarded, then the
///   oldest frame of any other kind. A PDO or heartbeat never replaces a frame of another kind.
/// - Discarded frames are counted: [`lost`](Self::lost) counts all of them, and
///   [`lost_emergencies`](Self::lost_emergencies) counts the emergency messages.
///
/// ```
/// use lexibus::clients::canopen::{Network, Node};
/// use lexibus::sim::{CanBus, CanNode, Device};
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::{DemoDrive, ENTRIES};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let [left, right] = [5, 6].map(|id| NodeId::new(id).expect("a node-ID"));
/// # let mut interface = CanBus::new();
/// # interface.add(CanNode::new(Device::new(ENTRIES).with_node_id(left)));
/// # interface.add(CanNode::new(Device::new(ENTRIES).with_node_id(right)));
/// let network = Network::<_, 32>::new(interface);               // for example a `socketcan::CanSocket`
/// let mut x = DemoDrive::new(Node::new(network.node(left), left));
/// let mut y = DemoDrive::new(Node::new(network.node(right), right));
/// x.target_position().write(100)?;
/// y.target_position().write(x.target_position().read()? + 1)?;
/// assert_eq!(y.target_position().read()?, 101);
/// # Ok(())
/// # }
/// ```
///
/// The network needs no allocator. It is not [`Sync`]: use one network for each thread.
pub struct Network<P, const N: usize> {
    /// The interface, unless a handle uses it.
    port: Cell<Option<P>>,
    /// Latest time of the interface.
    time: Cell<Option<Duration>>,
    kept: RefCell<Kept<N>>,
    /// Nodes with a handle: one bit for each node-ID.
    nodes: Cell<u128>,
    wakers: RefCell<[Option<Waker>; MOST_WAKERS]>,
}

/// A handle of one node on a [`Network`]. The handle is the CAN port of a [`Node`](super::Node).
///
/// While an async handle waits for a frame, the other handles get the interface after each millisecond.
#[derive(Debug)]
pub struct NetworkPort<'n, P, const N: usize> {
    network: &'n Network<P, N>,
    node: NodeId,
}

impl<P, const N: usize> fmt::Debug for Network<P, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Network").field("kept", &self.kept).finish_non_exhaustive()
    }
}

impl<P, const N: usize> Network<P, N> {
    /// Creates a network on `port`, without handles.
    pub fn new(port: P) -> Self {
        Self {
            port: Cell::new(Some(port)),
            time: Cell::new(None),
            kept: RefCell::new(Kept::new()),
            nodes: Cell::new(0),
            wakers: RefCell::new([const { None }; MOST_WAKERS]),
        }
    }

    /// Returns a handle of a node. From then on, the network keeps the frames of this node. All handles of a node share
    /// its frames.
    pub fn node(&self, node: NodeId) -> NetworkPort<'_, P, N> {
        self.nodes.set(self.nodes.get() | 1 << node.get());
        NetworkPort { network: self, node }
    }

    /// Returns the number of frames of nodes with a handle that were discarded because more than `N` frames were waiting.
    /// PDOs that a newer one has replaced don't count.
    pub fn lost(&self) -> usize {
        self.kept.try_borrow().map_or(0, |kept| kept.lost)
    }

    /// Returns the number of emergency messages among the [lost](Self::lost) frames.
    pub fn lost_emergencies(&self) -> usize {
        self.kept.try_borrow().map_or(0, |kept| kept.lost_emergencies)
    }

    /// Returns the interface and drops the network. Returns `None` if an async handle was leaked while it used the
    /// interface.
    pub fn into_inner(self) -> Option<P> {
        self.port.into_inner()
    }

    /// Returns whether the frame is for `node` and `wanted` accepts it. Keeps frames of other nodes, and frames that
    /// `wanted` rejects.
    fn dispatch(&self, node: NodeId, frame: &CanFrame, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> bool {
        let owner = self.kept.try_borrow().ok().and_then(|kept| kept.node(frame));
        let Some(owner) = owner else { return wanted(frame) };
        if owner == node && wanted(frame) {
            return true;
        }
        if self.nodes.get() >> owner.get() & 1 == 1 {
            if let Ok(mut kept) = self.kept.try_borrow_mut() {
                kept.push(owner, *frame);
            }
            if owner != node {
                self.wake();
            }
        }
        false
    }

    /// Returns a kept frame of `node` that `wanted` accepts.
    fn take(&self, node: NodeId, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        self.kept.try_borrow_mut().ok()?.take(node, wanted)
    }

    /// Wakes all handles that wait for the interface or a frame. Returns whether there are any.
    fn wake(&self) -> bool {
        let Ok(mut wakers) = self.wakers.try_borrow_mut() else { return false };
        wakers.iter_mut().filter_map(Option::take).map(Waker::wake).count() > 0
    }

    /// Notes a handle that waits for the interface or a frame. If too many handles wait, this one polls.
    fn note(&self, waker: &Waker) {
        let Ok(mut wakers) = self.wakers.try_borrow_mut() else { return waker.wake_by_ref() };
        if wakers.iter().flatten().any(|noted| noted.will_wake(waker)) {
            return;
        }
        match wakers.iter_mut().find(|place| place.is_none()) {
            Some(place) => *place = Some(waker.clone()),
            None => waker.wake_by_ref(),
        }
    }
}

impl<P, const N: usize> NetworkPort<'_, P, N> {
    /// Adds a COB-ID to the frames of the node, for example that of a PDO or an SDO channel whose COB-ID is not the
    /// default one. For a CAN-ID of 29 bits, bit 29 is set. Returns `None` if there is no room: a network has room for
    /// `N` COB-IDs.
    #[must_use]
    pub fn with_cob_id(self, id: u32) -> Option<Self> {
        let has_room = self.network.kept.try_borrow_mut().is_ok_and(|mut kept| kept.add(id, self.node));
        has_room.then_some(self)
    }

    /// Returns the node-ID.
    #[must_use]
    pub const fn id(&self) -> NodeId {
        self.node
    }
}
