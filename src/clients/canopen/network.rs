//! Several nodes on one CAN interface.

mod handle;
mod kept;
#[cfg(all(test, feature = "std"))]
mod tests;
#[cfg(all(test, feature = "std"))]
mod turn_tests;

use core::cell::{Cell, RefCell};
use core::fmt;
use core::task::Waker;
use core::time::Duration;

use self::kept::{Kept, Kind, Owner};
use super::frame::CanFrame;
use super::node::pdo_id;
use crate::node_id::NodeId;
use crate::pdo::{can_id, CobId};
use crate::sdo::Channel;

/// Maximum number of async handles that wait for the interface without polling.
const MOST_WAKERS: usize = 16;

/// A CAN interface that several nodes share. Each node has a [handle](Self::node), which is a CAN port. With a
/// [`CanPort`](super::CanPort), the handles are [`CanPort`](super::CanPort)s. With an
/// [`AsyncCanPort`](super::AsyncCanPort), they are [`AsyncCanPort`](super::AsyncCanPort)s, for tasks on the same thread.
///
/// A handle receives the frames of its node: those with the default COB-IDs of CiA 301 7.3.5 that a node sends, and
/// those with the COB-IDs that [`NetworkPort::with_pdo`], [`NetworkPort::with_emergency`] and [`NetworkPort::with_sdo`]
/// add. If the node has a handle, the network keeps a frame of the node in two cases: another handle uses the
/// interface, or the handle of the node expects a different frame. The handle [`services`](Self::services) receives LSS
/// answers, SYNC and TIME. All other frames go to the handle that uses the interface. If this handle doesn't expect
/// them, they are lost, and [`unclaimed`](Self::unclaimed) counts them. The network keeps up to `N` frames:
///
/// - Of each PDO, of SYNC and of TIME, only the newest is kept. Of each node, only the newest heartbeat and the newest
///   boot-up message are kept.
/// - If there is no room for an emergency message or a reply, the oldest PDO, heartbeat or boot-up message is
///   discarded. If there is no such frame, the oldest frame of any kind is discarded.
/// - If there is no room for a PDO, heartbeat or boot-up message, the oldest frame of these kinds is discarded. If emergency
///   messages and replies use more than half of the room, the oldest of them is discarded instead. Therefore, PDOs arrive
///   even if the program never receives emergency messages.
/// - Discarded frames are counted: [`lost`](Self::lost) counts all of them, and
///   [`lost_emergencies`](Self::lost_emergencies) counts the emergency messages.
///
/// Make `N` at least twice the number of PDOs plus four times the number of nodes. Then no frame is discarded, unless
/// emergency messages arrive faster than the program receives them.
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
/// The network needs no allocator. `Network` is not [`Sync`]: use one network for each thread.
pub struct Network<P, const N: usize> {
    /// The interface, unless a handle uses it.
    port: Cell<Option<P>>,
    /// Last known time of the interface.
    time: Cell<Option<Duration>>,
    /// Number of times that a handle has returned the interface.
    turn: Cell<u32>,
    /// Number of frames without a handle that were lost.
    unclaimed: Cell<usize>,
    kept: RefCell<Kept<N>>,
    /// Number of handles for each node-ID. The first element is the number of handles of the services.
    handles: [Cell<u16>; 128],
    wakers: RefCell<[Option<Waker>; MOST_WAKERS]>,
}

/// A handle of one node on a [`Network`], or of its services. Use the handle as the CAN port of a [`Node`](super::Node)
/// or an [`LssMaster`](super::LssMaster).
///
/// While an async handle waits for a frame or for a busy bus, the other handles can use the interface after at most one
/// millisecond. When the last handle of a node is dropped, the network discards the frames and the added COB-IDs of the
/// node.
#[derive(Debug)]
pub struct NetworkPort<'n, P, const N: usize> {
    network: &'n Network<P, N>,
    owner: Owner,
}

impl<P, const N: usize> Drop for NetworkPort<'_, P, N> {
    fn drop(&mut self) {
        let Some(count) = self.network.handles(self.owner) else { return };
        count.set(count.get().saturating_sub(1));
        if count.get() == 0 {
            if let Ok(mut kept) = self.network.kept.try_borrow_mut() {
                kept.purge(self.owner);
            }
        }
    }
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
            turn: Cell::new(0),
            unclaimed: Cell::new(0),
            kept: RefCell::new(Kept::new()),
            handles: [const { Cell::new(0) }; 128],
            wakers: RefCell::new([const { None }; MOST_WAKERS]),
        }
    }

    /// Returns a handle of a node. From then on, the network keeps the frames of this node. All handles of a node share
    /// its frames.
    pub fn node(&self, node: NodeId) -> NetworkPort<'_, P, N> {
        self.handle(Some(node))
    }

    /// Returns a handle for the services of the network: it receives LSS answers, SYNC and TIME. From then on, the network
    /// keeps these frames, and the handles of nodes don't receive them. Use this handle for an
    /// [`LssMaster`](super::LssMaster).
    pub fn services(&self) -> NetworkPort<'_, P, N> {
        self.handle(None)
    }

    fn handle(&self, owner: Owner) -> NetworkPort<'_, P, N> {
        if let Some(count) = self.handles(owner) {
            count.set(count.get().saturating_add(1));
        }
        NetworkPort { network: self, owner }
    }

    /// Returns the number of handles of a node or of the services.
    fn handles(&self, owner: Owner) -> Option<&Cell<u16>> {
        self.handles.get(usize::from(owner.map_or(0, NodeId::get)))
    }

    /// Returns the number of frames that the network has discarded because it can keep only `N` frames. Frames that a
    /// newer frame has replaced don't count.
    pub fn lost(&self) -> usize {
        self.kept.try_borrow().map_or(0, |kept| kept.lost)
    }

    /// Returns the number of emergency messages among the [lost](Self::lost) frames.
    pub fn lost_emergencies(&self) -> usize {
        self.kept.try_borrow().map_or(0, |kept| kept.lost_emergencies)
    }

    /// Returns the number of unclaimed frames. They belong to no handle, and are lost because the handle that used the
    /// interface didn't expect them. A growing number can mean that a node has no handle, or that the COB-ID of a PDO
    /// was not [added](NetworkPort::with_pdo). Frames of other masters and remote frames also count. SYNC, TIME and LSS
    /// answers count if there is no handle for the [`services`](Self::services).
    pub fn unclaimed(&self) -> usize {
        self.unclaimed.get()
    }

    /// Returns the interface and drops the network. Returns `None` if an async handle was leaked while it used the
    /// interface.
    pub fn into_inner(self) -> Option<P> {
        self.port.into_inner()
    }

    /// Returns whether `handle` receives the frame: the frame is for this handle or for no handle, and `wanted` accepts
    /// it. Keeps frames of other handles, and frames of this handle that `wanted` rejects.
    fn dispatch(&self, handle: Owner, frame: &CanFrame, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> bool {
        let owner = self.kept.try_borrow().ok().and_then(|kept| kept.owner(frame));
        let owner = owner.filter(|(owner, _)| self.handles(*owner).is_some_and(|count| count.get() > 0));
        let Some((owner, kind)) = owner else {
            let is_wanted = wanted(frame);
            self.unclaimed.set(self.unclaimed.get().saturating_add(usize::from(!is_wanted)));
            return is_wanted;
        };
        if owner == handle && wanted(frame) {
            return true;
        }
        if let Ok(mut kept) = self.kept.try_borrow_mut() {
            kept.push(owner, kind, *frame);
        }
        if owner != handle {
            self.wake();
        }
        false
    }

    /// Removes the oldest kept frame of a handle that `wanted` accepts, and returns it.
    fn take(&self, handle: Owner, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        self.kept.try_borrow_mut().ok()?.take(handle, wanted)
    }

    /// Wakes all handles that wait for the interface or a frame. Returns whether a handle was waiting.
    fn wake(&self) -> bool {
        let Ok(mut wakers) = self.wakers.try_borrow_mut() else { return false };
        wakers.iter_mut().filter_map(Option::take).map(Waker::wake).count() > 0
    }

    /// Stores the waker of a handle that waits for the interface or a frame. If too many handles wait, wakes this
    /// handle at once, so that it polls.
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
    /// Adds a PDO of the node to the frames that the handle receives. This is not necessary for the PDOs whose COB-IDs
    /// are 0x180, 0x280, 0x380 or 0x480 plus the node-ID.
    ///
    /// Returns `None` if `cob_id` isn't allowed for a PDO, if it was added for another node or another kind of frame,
    /// or if `N` COB-IDs have already been added. Also returns `None` for the handle of the services.
    #[must_use]
    pub fn with_pdo(self, cob_id: CobId) -> Option<Self> {
        let id = pdo_id(cob_id, self.owner?)?;
        self.with(id, Kind::ProcessData)
    }

    /// Adds the COB-ID of the emergency messages of the node (object 0x1014). Bit 29 means that the CAN-ID has 29 bits;
    /// bits 30 and 31 are ignored. This is not necessary for the default COB-ID. Pass the same COB-ID to
    /// [`Node::with_emergency_id`](super::Node::with_emergency_id).
    ///
    /// Returns `None` if the COB-ID is invalid, or for the other reasons that [`with_pdo`](Self::with_pdo) lists.
    #[must_use]
    pub fn with_emergency(self, cob_id: u32) -> Option<Self> {
        let id = can_id(cob_id)?;
        self.with(id, Kind::Emergency)
    }

    /// Adds the replies of an SDO channel that isn't the default channel. Also call
    /// [`Node::with_channel`](super::Node::with_channel) with the same channel.
    ///
    /// Returns `None` if the COB-ID of the replies was added for another node or another kind of frame, or if `N`
    /// COB-IDs have already been added. Also returns `None` for the handle of the services.
    #[must_use]
    pub fn with_sdo(self, channel: Channel) -> Option<Self> {
        self.with(channel.reply(), Kind::Reply)
    }

    fn with(self, id: u32, kind: Kind) -> Option<Self> {
        let (network, owner) = (self.network, self.owner);
        let is_added = owner.is_some() && network.kept.try_borrow_mut().is_ok_and(|mut kept| kept.add(id, owner, kind));
        is_added.then_some(self)
    }

    /// Returns the node-ID, or `None` for the handle of the services.
    #[must_use]
    pub const fn id(&self) -> Option<NodeId> {
        self.owner
    }
}
