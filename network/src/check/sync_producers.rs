//! Nodes that send SYNC.

use lexibus_codegen::source::Span;

use crate::model::{Network, NetworkNode};

/// Bit of 0x1005: the node sends SYNC.
const PRODUCER: u32 = 1 << 30;

/// A node that sends SYNC.
pub(super) struct SyncProducer {
    /// Name of its frames: `SYNC` for the master, or ``SYNC of `axis1` ``.
    pub name: String,
    /// Node-ID of the producer.
    pub sender: u8,
    /// COB-ID with flags.
    pub cob_id: u32,
    /// Communication cycle period in µs.
    pub period: u32,
    /// Synchronous window length in µs; 0 = none.
    pub window: u32,
    /// True if the frames contain a counter.
    pub has_counter: bool,
    /// Location of the period. If the network file does not set the period: location of the COB-ID or, without it, of the
    /// node's name.
    pub span: Span,
}

impl SyncProducer {
    /// Returns the number of SYNCs per second.
    pub fn rate(&self) -> f64 {
        1e6 / f64::from(self.period)
    }
}

/// Returns the nodes that send SYNC, the master first.
pub(super) fn sync_producers(network: &Network) -> Vec<SyncProducer> {
    let master = network.master.as_ref().and_then(|master| {
        let period = master.sync_period.as_ref().filter(|period| period.value > 0)?;
        Some(SyncProducer {
            name: "SYNC".to_owned(),
            sender: network.master_id(),
            cob_id: 0x80,
            period: period.value,
            window: master.sync_window,
            has_counter: master.sync_overflow > 0,
            span: period.span,
        })
    });
    master.into_iter().chain(network.nodes.iter().filter_map(of_node)).collect()
}

/// Returns the producer with the shortest period.
pub(super) fn fastest(producers: &[SyncProducer]) -> Option<&SyncProducer> {
    producers.iter().min_by_key(|producer| producer.period)
}

fn of_node(node: &NetworkNode) -> Option<SyncProducer> {
    let number = |index| node.values().number((index, 0)).unwrap_or(0u32);
    let (cob_id, period) = (number(0x1005), number(0x1006));
    (cob_id & PRODUCER != 0 && period > 0).then(|| SyncProducer {
        name: format!("SYNC of `{}`", node.name.value),
        sender: node.id,
        cob_id,
        period,
        window: number(0x1007),
        has_counter: number(0x1019) > 0,
        span: node.values().set_at((0x1006, 0)).or(node.values().set_at((0x1005, 0))).or(node.name.span),
    })
}
