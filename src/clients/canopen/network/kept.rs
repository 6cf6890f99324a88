//! Frames of a network that have not been received.

use super::super::frame::CanFrame;
use crate::node_id::NodeId;

/// A frame that has not been received, and its node.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    node: NodeId,
    frame: CanFrame,
}

/// Frames in the order of arrival, and COB-IDs of nodes that are not default COB-IDs.
#[derive(Debug)]
pub(super) struct Kept<const N: usize> {
    frames: [Option<Waiting>; N],
    cob_ids: [Option<(u32, NodeId)>; N],
    pub lost: usize,
    pub lost_emergencies: usize,
}

/// Kind of a frame, in the order in which frames are discarded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    ProcessData,
    ErrorControl,
    Other,
}

/// Returns the node that sends frames with this default COB-ID, or to which they are sent (CiA 301 7.3.5).
fn default_node(id: u32) -> Option<NodeId> {
    let function = id & !0x7F;
    let is_of_node = matches!(function, 0x080 | 0x180..=0x580 | 0x600 | 0x700);
    NodeId::new((id & 0x7F) as u8).filter(|_| is_of_node && id <= 0x7FF)
}

fn is_emergency(frame: &CanFrame) -> bool {
    matches!(frame.id(), 0x081..=0x0FF)
}

fn kind(frame: &CanFrame) -> Kind {
    match frame.id() {
        0x181..=0x57F if !frame.is_remote() => Kind::ProcessData,
        0x701..=0x77F => Kind::ErrorControl,
        _ => Kind::Other,
    }
}

impl<const N: usize> Kept<N> {
    pub const fn new() -> Self {
        Self { frames: [None; N], cob_ids: [None; N], lost: 0, lost_emergencies: 0 }
    }

    /// Adds a COB-ID of a node. Returns whether there is room.
    pub fn add(&mut self, id: u32, node: NodeId) -> bool {
        let place = self.cob_ids.iter_mut().find(|place| place.map_or(true, |(other, _)| other == id));
        place.map(|place| *place = Some((id, node))).is_some()
    }

    /// Returns the node of a frame.
    pub fn node(&self, frame: &CanFrame) -> Option<NodeId> {
        let added = self.cob_ids.iter().flatten().find(|(id, _)| *id == frame.id());
        added.map(|(_, node)| *node).or_else(|| default_node(frame.id()))
    }

    fn remove(&mut self, at: usize) -> Option<CanFrame> {
        let frame = self.frames.get_mut(at)?.take();
        if let Some(rest) = self.frames.get_mut(at..) {
            rest.rotate_left(1);
        }
        frame.map(|waiting| waiting.frame)
    }

    pub fn take(&mut self, node: NodeId, wanted: &mut dyn FnMut(&CanFrame) -> bool) -> Option<CanFrame> {
        let mut frames = self.frames.iter().flatten();
        let at = frames.position(|waiting| waiting.node == node && wanted(&waiting.frame))?;
        self.remove(at)
    }

    /// Counts a frame that is discarded.
    fn discard(&mut self, frame: &CanFrame) {
        self.lost = self.lost.saturating_add(1);
        self.lost_emergencies = self.lost_emergencies.saturating_add(usize::from(is_emergency(frame)));
    }

    pub fn push(&mut self, node: NodeId, frame: CanFrame) {
        if kind(&frame) == Kind::ProcessData {
            let is_older = |waiting: &Waiting| waiting.frame.id() == frame.id() && !waiting.frame.is_remote();
            if let Some(at) = self.frames.iter().flatten().position(is_older) {
                self.remove(at);
            }
        }
        if self.frames.last().is_some_and(Option::is_some) {
            let frames = self.frames.iter().flatten().enumerate();
            // `min_by_key` returns the first of several equal elements, which is the oldest.
            let first = frames.min_by_key(|(_, waiting)| kind(&waiting.frame));
            let is_replaced = |waiting: &Waiting| kind(&waiting.frame) <= kind(&frame);
            let first = first.filter(|(_, waiting)| is_replaced(waiting)).map(|(at, _)| at);
            if let Some(old) = first.and_then(|at| self.remove(at)) {
                self.discard(&old);
            }
        }
        match self.frames.iter_mut().find(|place| place.is_none()) {
            Some(place) => *place = Some(Waiting { node, frame }),
            None => self.discard(&frame),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: NodeId = match NodeId::new(5) {
        Some(node) => node,
        None => unreachable!(),
    };

    fn frame(id: u32, byte: u8) -> CanFrame {
        CanFrame::new(id, &[byte]).expect("a frame")
    }

    #[test]
    fn the_newest_pdo_replaces_the_older_one() {
        let mut kept = Kept::<4>::new();
        for (id, byte) in [(0x185, 1), (0x585, 2), (0x285, 3), (0x185, 4), (0x585, 5)] {
            kept.push(NODE, frame(id, byte));
        }
        let all: std::vec::Vec<_> = core::iter::from_fn(|| kept.take(NODE, &mut |_| true)).collect();
        assert_eq!(all, [frame(0x585, 2), frame(0x285, 3), frame(0x185, 4), frame(0x585, 5)]);
        assert_eq!((kept.lost, kept.lost_emergencies), (0, 0));
    }

    #[test]
    fn process_data_are_discarded_before_emergencies() {
        let mut kept = Kept::<3>::new();
        for (id, byte) in [(0x085, 1), (0x185, 2), (0x705, 3), (0x585, 4), (0x085, 5)] {
            kept.push(NODE, frame(id, byte));
        }
        assert_eq!((kept.lost, kept.lost_emergencies), (2, 0));
        kept.push(NODE, frame(0x085, 6));
        assert_eq!((kept.lost, kept.lost_emergencies), (3, 1));
        assert_eq!(kept.take(NODE, &mut |frame| frame.id() == 0x085), Some(frame(0x085, 5)));
        let mut none = Kept::<0>::new();
        none.push(NODE, frame(0x085, 6));
        assert_eq!((none.lost, none.lost_emergencies, none.add(0x300, NODE)), (1, 1, false));
    }

    #[test]
    fn nodes_of_frames() {
        let mut kept = Kept::<1>::new();
        for id in [0x085, 0x185, 0x505, 0x585, 0x605, 0x705] {
            assert_eq!(kept.node(&frame(id, 0)), Some(NODE), "{id:X}");
        }
        for id in [0x005, 0x080, 0x105, 0x685, 0x7E4, 0x2000_0185] {
            assert_eq!(kept.node(&frame(id, 0)), None, "{id:X}");
        }
        assert!(kept.add(0x2000_0185, NODE) && kept.add(0x2000_0185, NODE) && !kept.add(0x300, NODE));
        assert_eq!(kept.node(&frame(0x2000_0185, 0)), Some(NODE));
    }
}
