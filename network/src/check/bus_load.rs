//! Bus load: bits per second of all cyclic frames, with the maximum number of stuff bits.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Span;

use super::sync_producers::{fastest, sync_producers, SyncProducer};
use crate::model::{can_id, Network, NetworkPdo, EXTENDED};

/// Frames of one service from one sender, with their assumed rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic {
    /// Name of the frames: ``TPDO 1 of `axis1` ``.
    pub name: String,
    /// Name without the sender: `TPDO 1`.
    pub service: String,
    /// Node-ID of the node or master that sends the frames.
    pub sender: u8,
    /// CAN-ID. Bit 29 is set if the CAN-ID has 29 bits.
    pub can_id: u32,
    /// Frames per second.
    pub rate: f64,
    /// Number of data bytes.
    pub bytes: u32,
    /// Maximum length of a frame on the bus in bits.
    pub bits: u32,
}

/// Load of a bus by cyclic frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BusLoad {
    /// Frames of SYNC, PDOs, heartbeats and node guarding, except those of `unbounded`.
    pub traffic: Vec<Traffic>,
    /// Names of PDOs with a transmission type above 240, and with neither an inhibit time nor an event timer. Their rate is unknown.
    pub unbounded: Vec<String>,
    /// Bit rate in bit/s.
    pub bit_rate: u32,
}

impl BusLoad {
    /// Returns the number of bits per second.
    pub fn bits_per_second(&self) -> f64 {
        self.traffic.iter().fold(0.0, |sum, traffic| sum + traffic.rate * f64::from(traffic.bits))
    }

    /// Returns the load as text: `bus load of cyclic frames: 8.0 % of 500 kbit/s`, and the PDOs whose rate is unknown.
    pub fn summary(&self) -> String {
        let unbounded = match self.unbounded.as_slice() {
            [] => String::new(),
            [one] => format!(", without {one}, which has neither inhibit time nor event timer"),
            several => format!(", without {} PDOs that have neither inhibit time nor event timer", several.len()),
        };
        format!("bus load of cyclic frames: {}{unbounded}", self.share())
    }

    /// Returns the load as a percentage of the bit rate: `8.0 % of 500 kbit/s`.
    pub fn share(&self) -> String {
        format!("{:.1} % of {} kbit/s", self.ratio() * 100.0, self.bit_rate / 1000)
    }

    /// Returns the load as a fraction of the bit rate: 1.0 is a full bus.
    pub fn ratio(&self) -> f64 {
        self.bits_per_second() / f64::from(self.bit_rate)
    }
}

/// Returns the maximum number of bits of a data frame with `bytes` bytes, including stuff bits and the interframe space
/// (ISO 11898-1).
pub fn frame_bits(can_id: u32, bytes: u32) -> u32 {
    // Bits that can be stuffed: from the start of frame to the CRC. In the worst case, a stuff bit follows every fourth bit after
    // the first.
    let stuffed = if can_id & EXTENDED == 0 { 34 } else { 54 } + 8 * bytes;
    // Stuff bits never occur in these fields: CRC delimiter, acknowledge slot and delimiter, end of frame, interframe space.
    const UNSTUFFED: u32 = 1 + 2 + 7 + 3;
    stuffed + (stuffed - 1) / 4 + UNSTUFFED
}

/// Computes the load of all cyclic frames: SYNC, PDOs, heartbeats and node guarding.
pub fn bus_load(network: &Network) -> BusLoad {
    let mut load = BusLoad { bit_rate: u32::from(network.bit_rate) * 1000, ..BusLoad::default() };
    let mut add = |service: &str, name: String, sender: u8, (can_id, bytes): (u32, u32), rate: f64| {
        let (service, bits) = (service.to_owned(), frame_bits(can_id, bytes));
        load.traffic.push(Traffic { name, service, sender, can_id, bytes, bits, rate });
    };
    let (producers, master_id) = (sync_producers(network), network.master_id());
    for producer in &producers {
        let frame = (can_id(producer.cob_id), producer.has_counter.into());
        add("SYNC", producer.name.clone(), producer.sender, frame, producer.rate());
    }
    if let Some(master) = network.master.as_ref().filter(|master| master.heartbeat.value > 0) {
        let rate = per_second(master.heartbeat.value);
        add("heartbeat", "heartbeat of the master".to_owned(), master_id, (0x700 + u32::from(master_id), 1), rate);
    }
    for node in &network.nodes {
        let (id, name) = (0x700 + u32::from(node.id), &node.name.value);
        if node.heartbeat.value > 0 {
            let rate = per_second(node.heartbeat.value);
            add("heartbeat", format!("heartbeat of `{name}`"), node.id, (id, 1), rate);
        } else if node.guard_time > 0 {
            let rate = per_second(node.guard_time);
            let request = "node guarding request";
            add(request, format!("{request} to `{name}`"), master_id, (id, 0), rate);
            add("node guarding reply", format!("node guarding reply of `{name}`"), node.id, (id, 1), rate);
        }
    }
    let sync = fastest(&producers).map_or(0.0, SyncProducer::rate);
    let mut unbounded = Vec::new();
    for (node, pdo) in network.sent() {
        let sender = if pdo.direction == Direction::Transmit { node.id } else { master_id };
        match rate(pdo, sync) {
            Some(rate) => add(&pdo.title(), node.pdo_title(pdo), sender, (pdo.can_id(), pdo.bytes()), rate),
            None => unbounded.push(node.pdo_title(pdo)),
        }
    }
    load.unbounded = unbounded;
    load
}

/// Returns the number of cycles per second for a cycle time in ms.
fn per_second(milliseconds: u16) -> f64 {
    1000.0 / f64::from(milliseconds)
}

/// Returns the assumed rate of a PDO in frames per second, or `None` if its rate is unknown. The rate of a PDO that is not synchronous
/// follows from its inhibit time or, without an inhibit time, from its event timer. `sync` is the number of SYNCs per second.
fn rate(pdo: &NetworkPdo, sync: f64) -> Option<f64> {
    match (pdo.syncs(), pdo.inhibit_time, pdo.event_timer) {
        (Some(syncs), ..) => Some(sync / f64::from(syncs)),
        (None, inhibit_time @ 1.., _) => Some(10_000.0 / f64::from(inhibit_time)),
        (None, 0, event_timer @ 1..) => Some(per_second(event_timer)),
        _ => None,
    }
}

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    let load = bus_load(network);
    if load.ratio() <= 1.0 {
        return;
    }
    let message = format!(
        "the bus load is {:.0} kbit/s, but the bit rate is {} kbit/s",
        load.bits_per_second() / 1000.0,
        network.bit_rate
    );
    let mut largest: Vec<&Traffic> = load.traffic.iter().collect();
    let bits = |traffic: &Traffic| traffic.rate * f64::from(traffic.bits);
    largest.sort_by(|one, other| bits(other).total_cmp(&bits(one)));
    let found =
        Diagnostic::new(&codes::BUS_LOAD, load_at(network), message).help("use longer periods or a higher bit rate");
    let note = |traffic: &&Traffic| {
        format!("{}: {:.1} frames per second, {} bits each", traffic.name, traffic.rate, traffic.bits)
    };
    diagnostics.push(largest.iter().take(3).map(note).fold(found, Diagnostic::note));
}

/// Returns the location of the bit rate or, if the file declares none, of the master.
fn load_at(network: &Network) -> Span {
    network.bit_rate_at.or(network.master.as_ref().map_or(Span::MISSING, |master| master.span))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_have_the_length_of_the_literature() {
        // Davis et al., "Controller Area Network schedulability analysis: refuted, revisited and revised", 2007: a frame with s
        // data bytes has at most 55 + 10 s bits with an 11-bit identifier, and 80 + 10 s bits with a 29-bit identifier.
        for bytes in 0..=8 {
            assert_eq!(frame_bits(0x181, bytes), 55 + 10 * bytes);
            assert_eq!(frame_bits(EXTENDED | 0x181, bytes), 80 + 10 * bytes);
        }
    }
}
