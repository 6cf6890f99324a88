//! Frames of a network that have not been received.

use super::super::frame::CanFrame;
use crate::lss::ANSWERS;
use crate::node_id::NodeId;

/// Owner of a frame: a node, or `None` for the services of the network (LSS, SYNC and TIME).
pub(super) type Owner = Option<NodeId>;

/// Kind of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A PDO, SYNC or TIME. Only the newest one with the same COB-ID is kept.
    ProcessData,
    /// Only the newest heartbeat of a node is kept.
    Heartbeat,
    /// Only the newest boot-up message of a node is kept.
    BootUp,
    Emergency,
    /// An SDO reply or an LSS answer.
    Reply,
}

impl Kind {
    /// Returns whether only the newest frame of this kind is kept.
    const fn is_newest_only(self) -> bool {
        matches!(self, Self::ProcessData | Self::Heartbeat | Self::BootUp)
    }
}

/// A frame that has not been received.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    owner: Owner,
    kind: Kind,
    frame: CanFrame,
}

/// Kept frames in the order of arrival, and the added COB-IDs of nodes.
#[derive(Debug)]
pub(super) struct Kept<const N: usize> {
    frames: [Option<Waiting>; N],
    cob_ids: [Option<(u32, Owner, Kind)>; N],
    pub lost: usize,
    pub lost_emergencies: usize,
}

/// Returns the owner and the kind of a frame with a default COB-ID (CiA 301 7.3.5), or `None` if no handle receives
/// frames with this COB-ID.
fn default_owner(frame: &CanFrame) -> Option<(Owner, Kind)> {
    match frame.id() {
        0x080 | 0x100 => return Some((None, Kind::ProcessData)),
        ANSWERS => return Some((None, Kind::Reply)),
        _ => {}
    }
    let kind = match frame.id() & !0x7F {
        0x080 => Kind::Emergency,
        0x180 | 0x280 | 0x380 | 0x480 => Kind::ProcessData,
        0x580 => Kind::Reply,
        0x700 if frame.data() == [0] => Kind::BootUp,
        0x700 => Kind::Heartbeat,
        _ => return None,
    };
    let node = NodeId::new((frame.id() & 0x7F) as u8)?;
    Some((Some(node), kind))
}

impl<const N: usize> Kept<N> {
    pub const fn new() -> Self {
        Self { frames: [None; N], cob_ids: [None; N], lost: 0, lost_emergencies: 0 }
    }

    /// Adds a COB-ID of a node. Returns `false` if there is no room, or if the COB-ID is that of another node or kind.
    pub fn add(&mut self, id: u32, owner: Owner, kind: Kind) -> bool {
        let added = Some((id, owner, kind));
        if let Some(same) = self.cob_ids.iter().find(|place| place.is_some_and(|(other, ..)| other == id)) {
            return *same == added;
        }
        let place = self.cob_ids.iter_mut().find(|place| place.is_none());
        place.map(|place| *place = added).is_some()
    }

    /// Returns the owner and the kind of a frame, or `None` if the frame has no owner. Remote frames have no owner.
    pub fn owner(&self, frame: &CanFrame) -> Option<(Owner, Kind)> {
        let added = self.cob_ids.iter().flatten().find(|(id, ..)| *id == frame.id());
        let owner = added.map(|(_, owner, kind)| (*owner, *kind)).or_else(|| default_owner(frame));
        owner.filter(|_| !frame.is_remote())
    }

    /// Discards the frames of a node.
    pub fn clear(&mut self, owner: Owner) {
        while self.take(owner, &mut |_| true).is_some() {}
    }

    /// Discards the frames and the added COB-IDs of a node.
    pub fn purge(&mut self, owner: Owner) {
        self.clear(owner);
        for place in &mut self.cob_ids {
            *place = place.filter(|(_, other, _)| *other != owner);
        }
    }

    fn remove(&mut self, at: usize) -> Option<CanFrame> {
        let frame = self.frames.get_mut(at)?.take();
        if let Some(rest) = self.frames.get_mut(at..) {
            rest.rotate_left(1);
        }
        frame.map(|waiting| waiting.frame)
    }

    pub fn take(&mut self, owner: Owner, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        let mut frames = self.frames.iter().flatten();
        let at = frames.position(|waiting| waiting.owner == owner && wanted(&waiting.frame))?;
        self.remove(at)
    }

    /// Counts a frame that is discarded.
    fn discard(&mut self, kind: Kind) {
        self.lost = self.lost.saturating_add(1);
        self.lost_emergencies = self.lost_emergencies.saturating_add(usize::from(kind == Kind::Emergency));
    }

    /// Removes the frames that a new frame makes obsolete.
    fn replace(&mut self, owner: Owner, kind: Kind, frame: &CanFrame) {
        let is_obsolete = |waiting: &Waiting| match kind {
            Kind::ProcessData => waiting.kind == kind && waiting.frame.id() == frame.id(),
            Kind::Heartbeat => waiting.kind == kind && waiting.owner == owner,
            // The heartbeat is older than the restart of the node.
            Kind::BootUp => matches!(waiting.kind, Kind::BootUp | Kind::Heartbeat) && waiting.owner == owner,
            Kind::Emergency | Kind::Reply => false,
        };
        while let Some(at) = self.frames.iter().flatten().position(is_obsolete) {
            self.remove(at);
        }
    }

    /// Returns the position of the frame that is discarded to make room for a new frame.
    ///
    /// Emergency messages and replies displace the other frames. If they fill more than half of the room, because the
    /// program doesn't receive them, the other frames displace the oldest of them.
    fn oldest(&self, kind: Kind) -> Option<usize> {
        let find = |is_newest_only: bool| {
            self.frames.iter().flatten().position(|waiting| waiting.kind.is_newest_only() == is_newest_only)
        };
        let newest_only = self.frames.iter().flatten().filter(|waiting| waiting.kind.is_newest_only()).count();
        match kind.is_newest_only() {
            true if newest_only < N / 2 => find(false),
            true => find(true),
            false => find(true).or_else(|| find(false)),
        }
    }

    pub fn push(&mut self, owner: Owner, kind: Kind, frame: CanFrame) {
        self.replace(owner, kind, &frame);
        if self.frames.last().is_some_and(Option::is_some) {
            let oldest = self.oldest(kind);
            let old = oldest.and_then(|at| self.frames.get(at).copied().flatten().map(|waiting| (at, waiting.kind)));
            if let Some((at, kind)) = old {
                self.remove(at);
                self.discard(kind);
            }
        }
        match self.frames.iter_mut().find(|place| place.is_none()) {
            Some(place) => *place = Some(Waiting { owner, kind, frame }),
            None => self.discard(kind),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: Owner = NodeId::new(5);

    fn frame(id: u32, byte: u8) -> CanFrame {
        CanFrame::new(id, &[byte]).expect("a frame")
    }

    fn push<const N: usize>(kept: &mut Kept<N>, id: u32, byte: u8) {
        let (owner, kind) = kept.owner(&frame(id, byte)).expect("an owner");
        kept.push(owner, kind, frame(id, byte));
    }

    fn all<const N: usize>(kept: &mut Kept<N>) -> std::vec::Vec<(u32, u8)> {
        core::iter::from_fn(|| kept.take(NODE, &mut |_| true)).map(|frame| (frame.id(), frame.data()[0])).collect()
    }

    #[test]
    fn the_newest_pdo_replaces_the_older_one() {
        let mut kept = Kept::<4>::new();
        for (id, byte) in [(0x185, 1), (0x585, 2), (0x285, 3), (0x185, 4), (0x585, 5)] {
            push(&mut kept, id, byte);
        }
        assert_eq!(all(&mut kept), [(0x585, 2), (0x285, 3), (0x185, 4), (0x585, 5)]);
        assert_eq!((kept.lost, kept.lost_emergencies), (0, 0));
    }

    #[test]
    fn only_the_newest_heartbeat_and_the_boot_up_message_are_kept() {
        let mut kept = Kept::<4>::new();
        for byte in [5, 5, 0, 0, 127, 5] {
            push(&mut kept, 0x705, byte);
        }
        assert_eq!(all(&mut kept), [(0x705, 0), (0x705, 5)]);
    }

    #[test]
    fn process_data_are_discarded_before_emergencies() {
        let mut kept = Kept::<3>::new();
        for (id, byte) in [(0x085, 1), (0x185, 2), (0x705, 3), (0x585, 4), (0x085, 5)] {
            push(&mut kept, id, byte);
        }
        assert_eq!((kept.lost, kept.lost_emergencies), (2, 0));
        push(&mut kept, 0x085, 6);
        assert_eq!((kept.lost, kept.lost_emergencies), (3, 1));
        assert_eq!(kept.take(NODE, &mut |frame| frame.id() == 0x085), Some(frame(0x085, 5)));
        let mut none = Kept::<0>::new();
        push(&mut none, 0x085, 6);
        assert_eq!((none.lost, none.lost_emergencies), (1, 1));
        assert!(!none.add(0x300, NODE, Kind::ProcessData));
    }

    #[test]
    fn frames_that_nobody_receives_leave_room_for_process_data() {
        let mut kept = Kept::<4>::new();
        for byte in 0..9 {
            push(&mut kept, 0x085, byte);
        }
        for byte in 0..9 {
            push(&mut kept, 0x185, byte);
            push(&mut kept, 0x285, byte);
        }
        assert_eq!(all(&mut kept), [(0x085, 7), (0x085, 8), (0x185, 8), (0x285, 8)]);
        assert_eq!((kept.lost, kept.lost_emergencies), (7, 7));
    }

    #[test]
    fn added_cob_ids_have_the_kind_of_their_frames() {
        let mut kept = Kept::<4>::new();
        assert!(kept.add(0x2000_0185, NODE, Kind::ProcessData) && kept.add(0x2000_0185, NODE, Kind::ProcessData));
        assert!(!kept.add(0x2000_0185, NodeId::new(6), Kind::ProcessData));
        assert!(!kept.add(0x2000_0185, NODE, Kind::Emergency));
        assert!(kept.add(0x190, NODE, Kind::Emergency) && kept.add(0x191, NODE, Kind::Reply));
        for byte in 0..2 {
            for id in [0x2000_0185, 0x190, 0x191] {
                push(&mut kept, id, byte);
            }
        }
        assert_eq!((kept.lost, kept.lost_emergencies), (1, 0));
        push(&mut kept, 0x190, 2);
        assert_eq!((kept.lost, kept.lost_emergencies), (2, 1));
        assert_eq!(all(&mut kept), [(0x191, 0), (0x190, 1), (0x191, 1), (0x190, 2)]);
        kept.purge(NODE);
        assert!(kept.add(0x190, NodeId::new(6), Kind::ProcessData));
    }

    #[test]
    fn owners_of_frames() {
        let kept = Kept::<1>::new();
        let owner = |id| kept.owner(&frame(id, 0)).map(|(owner, _)| owner);
        for id in [0x085, 0x185, 0x485, 0x585, 0x705] {
            assert_eq!(owner(id), Some(NODE), "{id:X}");
        }
        for id in [0x080, 0x100, 0x7E4] {
            assert_eq!(owner(id), Some(None), "{id:X}");
        }
        // Requests of other masters, and frames without a default meaning.
        for id in [0x005, 0x105, 0x205, 0x505, 0x605, 0x685, 0x700, 0x7E5, 0x2000_0185] {
            assert_eq!(owner(id), None, "{id:X}");
        }
        assert_eq!(kept.owner(&CanFrame::remote(0x705, 1).expect("a remote frame")), None);
    }
}
