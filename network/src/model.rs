//! The resolved network: nodes with their descriptions, values as bytes, and PDOs with COB-IDs.

use std::collections::HashSet;
use std::rc::Rc;

use lexibus_codegen::ir::{Device, Direction, Item};
use lexibus_codegen::source::Span;

use crate::declared::DeclaredMaster;
use crate::description::Description;
use crate::ethercat::Segment;
use crate::syntax::At;
use crate::values::{Values, Write};

/// Bit of a COB-ID that disables a PDO or EMCY (CiA 301 7.5.2.17, 7.5.2.35, 7.5.2.37).
pub const DISABLED: u32 = 1 << 31;

/// Bit of a COB-ID that is set if the CAN-ID has 29 bits.
pub const EXTENDED: u32 = 1 << 29;

/// Bit of the COB-ID of a TPDO that the node does not send on RTR (CiA 301 7.5.2.37).
pub const NO_RTR: u32 = 1 << 30;

/// Bit of 0x1F81 (CiA 302-2): the master boots the node.
pub const BOOT: u32 = 0x04;

/// Bit of 0x1F81: the network needs the node.
pub const MANDATORY: u32 = 0x08;

/// Bit of 0x1F81: the master does not reset a node that is Operational.
pub const KEEP_RUNNING: u32 = 0x10;

/// Bit of 0x1F81: the master verifies the software version.
pub const VERIFY_SOFTWARE: u32 = 0x20;

/// Bit of 0x1F81: the master may update the software.
pub const UPDATE_SOFTWARE: u32 = 0x40;

/// Bit of 0x1F81: the master restores the defaults before the configuration.
pub const RESTORE: u32 = 0x80;

/// A network whose nodes have descriptions.
#[derive(Debug, Default)]
pub struct Network {
    /// Name of the network; may be empty.
    pub name: String,
    /// Bit rate in kbit/s.
    pub bit_rate: u16,
    /// Location of the bit rate; empty if the file does not declare it.
    pub bit_rate_at: Span,
    /// The master, if the file declares one.
    pub master: Option<DeclaredMaster>,
    /// The resolved nodes without the master, in the order of the declared nodes.
    pub nodes: Vec<NetworkNode>,
    /// The EtherCAT segment, if the file declares one.
    pub segment: Option<Segment>,
}

impl Network {
    /// Returns the node-ID of the master; 255 = not configured.
    pub fn master_id(&self) -> u8 {
        self.master.as_ref().and_then(|master| master.node_id.as_ref()).map_or(255, |id| id.value)
    }

    /// Returns whether the network has an EtherCAT segment, and neither a CANopen master nor nodes.
    pub fn is_only_segment(&self) -> bool {
        self.segment.is_some() && self.master.is_none() && self.nodes.is_empty()
    }

    /// Returns the enabled PDOs of one direction, in the order of the nodes. The PDOs of a node are sorted by number.
    pub fn pdos(&self, direction: Direction) -> impl Iterator<Item = (&NetworkNode, &NetworkPdo)> {
        let is_sent = move |(_, pdo): &(&NetworkNode, &NetworkPdo)| pdo.is_enabled && pdo.direction == direction;
        self.nodes.iter().flat_map(|node| node.pdos.iter().map(move |pdo| (node, pdo))).filter(is_sent)
    }

    /// Returns whether the master sends the RPDOs with a CAN-ID: the master exchanges PDOs, and no node has an enabled TPDO with
    /// this CAN-ID.
    pub fn is_sent_by_master(&self, can_id: u32) -> bool {
        let is_sent = || self.pdos(Direction::Transmit).any(|(_, pdo)| pdo.can_id() == can_id);
        self.master.as_ref().is_some_and(|master| master.exchanges_pdos) && !is_sent()
    }

    /// Returns the RPDOs that the master sends. Of several RPDOs with the same CAN-ID and number of bytes, returns only the first.
    pub fn sent_by_master(&self) -> Vec<(&NetworkNode, &NetworkPdo)> {
        let mut known = HashSet::new();
        let is_sent = |(_, pdo): &(&NetworkNode, &NetworkPdo)| {
            self.is_sent_by_master(pdo.can_id()) && known.insert((pdo.can_id(), pdo.bytes()))
        };
        self.pdos(Direction::Receive).filter(is_sent).collect()
    }

    /// Returns the enabled TPDOs of the nodes, then the RPDOs that the master sends.
    pub fn sent(&self) -> Vec<(&NetworkNode, &NetworkPdo)> {
        self.pdos(Direction::Transmit).chain(self.sent_by_master()).collect()
    }

    /// Returns the nodes that have an enabled RPDO with the CAN-ID of `cob_id`, each once.
    pub fn receivers(&self, cob_id: u32) -> impl Iterator<Item = &NetworkNode> {
        let is_received = move |pdo: &NetworkPdo| {
            pdo.is_enabled && pdo.direction == Direction::Receive && pdo.can_id() == can_id(cob_id)
        };
        self.nodes.iter().filter(move |node| node.pdos.iter().any(is_received))
    }
}

/// Returns the CAN-ID of a COB-ID. Bit 29 of the result is set if the CAN-ID has 29 bits.
pub fn can_id(cob_id: u32) -> u32 {
    match cob_id & EXTENDED {
        0 => cob_id & 0x7FF,
        _ => cob_id & (EXTENDED | 0x1FFF_FFFF),
    }
}

/// A node of the network.
#[derive(Debug)]
pub struct NetworkNode {
    /// Name of the node.
    pub name: At<String>,
    /// Node-ID, from 1 to 127.
    pub id: u8,
    /// Description of the device.
    pub description: Rc<Description>,
    /// Path under which the master finds the node's concise DCF.
    pub upload_file: String,
    /// Path of the program that the master downloads; may be empty.
    pub software_file: String,
    /// Expected software identification; 0 = not checked.
    pub software_version: u32,
    /// Expected texts of the manufacturer hardware version (0x1009) and software version (0x100A); `None` = not checked.
    pub versions: [Option<String>; 2],
    /// Device type (0x1000).
    pub device_type: u32,
    /// Expected identity: vendor-ID, product code, revision number, serial number; 0 = not checked.
    pub identity: [u32; 4],
    /// COB-ID of EMCY (0x1014); [`DISABLED`] if the device does not have the object.
    pub emcy_cob_id: u32,
    /// Heartbeat producer time in ms; 0 = no heartbeat.
    pub heartbeat: At<u16>,
    /// Consumer time of the heartbeat as a multiple of its producer time.
    pub heartbeat_multiplier: At<f64>,
    /// Guard time in ms; 0 = no node guarding.
    pub guard_time: u16,
    /// Life time factor; 0 = no life guarding.
    pub life_time_factor: u8,
    /// All PDOs of the device: RPDOs, then TPDOs, each sorted by number.
    pub pdos: Vec<NetworkPdo>,
    /// Values that configure the node, in the order in which they are written.
    pub writes: Vec<Write>,
    /// Value of 0x1F81 for the node (CiA 302-2).
    pub assignment: u32,
    /// Sub-index of 0x1011 that restores the defaults before the configuration; 0 = none.
    pub restore: u8,
    /// True if the node stores its configuration.
    pub store: bool,
}

impl NetworkNode {
    /// Returns the device.
    pub fn device(&self) -> &Device {
        self.description.device()
    }

    /// Returns the name of the node's DCF and concise DCF, without extension.
    pub fn file_stem(&self) -> String {
        file_stem(&self.name.value)
    }

    /// Returns the consumer time of the node's heartbeat in ms.
    pub fn heartbeat_time(&self) -> u32 {
        consumer_time(self.heartbeat.value, self.heartbeat_multiplier.value)
    }

    /// Returns the item at an index and sub-index.
    pub fn item(&self, object: (u16, u8)) -> Option<&Item> {
        self.device().entry(object.0, object.1)
    }

    /// Returns the item that a mapping entry refers to, or `None` for a gap and for an object that the description does not contain.
    pub fn mapped_item(&self, entry: &MappedObject) -> Option<&Item> {
        self.item((entry.index, entry.sub_index)).filter(|_| !entry.is_gap())
    }

    /// Returns the name of an object's entry. If the object has several entries, the name of the object and `separator` precede it.
    pub fn entry_name(&self, object: (u16, u8), separator: &str) -> String {
        entry_name(self.device(), object, separator)
    }

    /// Returns the name of a PDO of this node: ``TPDO 1 of `axis1` ``.
    pub fn pdo_title(&self, pdo: &NetworkPdo) -> String {
        format!("{} of `{}`", pdo.title(), self.name.value)
    }

    /// Returns the values that the objects have after the configuration.
    pub fn values(&self) -> Values<'_> {
        Values { device: self.device(), id: self.id, writes: &self.writes }
    }

    /// Returns the PDO with this direction and number.
    pub fn pdo(&self, direction: Direction, number: u16) -> Option<&NetworkPdo> {
        self.pdos.iter().find(|pdo| pdo.direction == direction && pdo.number == number)
    }
}

/// Returns the name of an object's entry. If the object has several entries, the name of the object and `separator` precede it.
pub(crate) fn entry_name(device: &Device, object: (u16, u8), separator: &str) -> String {
    let (index, sub_index) = object;
    let entry = device.entry(index, sub_index).map(|item| item.name.as_str()).unwrap_or_default();
    match device.object(index).filter(|group| group.items.len() > 1) {
        Some(group) => format!("{}{separator}{entry}", group.name),
        None => entry.to_owned(),
    }
}

/// Returns a name as a file name: characters other than letters, digits, `-`, `_` and `.` become `_`.
pub fn file_stem(name: &str) -> String {
    let is_safe = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.');
    name.chars().map(|letter| if is_safe(letter) { letter } else { '_' }).collect()
}

/// Returns the consumer time of a heartbeat in ms.
pub fn consumer_time(producer_time: u16, multiplier: f64) -> u32 {
    (f64::from(producer_time) * multiplier) as u32
}

/// A PDO of a node.
#[derive(Clone, Debug)]
pub struct NetworkPdo {
    /// Direction, seen from the node.
    pub direction: Direction,
    /// Number of the PDO, counted from 1.
    pub number: u16,
    /// Location of the PDO in the network file; empty if the file does not mention it.
    pub span: Span,
    /// True if the PDO is enabled and maps objects.
    pub is_enabled: bool,
    /// COB-ID with flags.
    pub cob_id: u32,
    /// Location of the COB-ID in the network file or, if the file does not set the COB-ID, the location `span`.
    pub cob_id_at: Span,
    /// Transmission type.
    pub transmission: u8,
    /// Inhibit time of the sender in units of 100 µs; 0 = none.
    pub inhibit_time: u16,
    /// Event timer of the sender in ms; 0 = none.
    pub event_timer: u16,
    /// Deadline of the receiver in ms; 0 = none.
    pub event_deadline: u16,
    /// SYNC start value of the sender; 0 = none.
    pub sync_start: u8,
    /// Mapped objects, in the order of the mapping.
    pub entries: Vec<MappedObject>,
}

impl NetworkPdo {
    /// Returns the CAN-ID. Bit 29 of the result is set if the CAN-ID has 29 bits.
    pub fn can_id(&self) -> u32 {
        can_id(self.cob_id)
    }

    /// Returns the length in bits.
    pub fn bits(&self) -> u32 {
        self.entries.iter().map(|entry| u32::from(entry.bits)).sum()
    }

    /// Returns the length in bytes.
    pub fn bytes(&self) -> u32 {
        self.bits().div_ceil(8)
    }

    /// Returns the number of SYNCs after which the PDO is sent, or `None` for a transmission type above 240. For an acyclic
    /// PDO (transmission type 0), returns 1, the worst case.
    pub fn syncs(&self) -> Option<u8> {
        match self.transmission {
            0 => Some(1),
            syncs @ 1..=240 => Some(syncs),
            _ => None,
        }
    }

    /// Returns the name of the PDO: `TPDO 1`.
    pub fn title(&self) -> String {
        let direction = if self.direction == Direction::Transmit { "TPDO" } else { "RPDO" };
        format!("{direction} {}", self.number)
    }

    /// Returns the index of the communication object.
    pub fn index(&self) -> u16 {
        communication_index(self.direction, self.number)
    }
}

/// Returns the index of the communication object of a PDO.
pub fn communication_index(direction: Direction, number: u16) -> u16 {
    let first = if direction == Direction::Receive { 0x1400 } else { 0x1800 };
    first + number - 1
}

/// An object in a PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MappedObject {
    /// Index of the object. An index below 0x1000 is the code of a data type: the entry is a gap.
    pub index: u16,
    /// Sub-index of the object.
    pub sub_index: u8,
    /// Length in bits.
    pub bits: u8,
}

impl MappedObject {
    /// Returns the object in an entry of a mapping (CiA 301 7.5.2.36).
    pub fn of_word(word: u32) -> Self {
        MappedObject { index: (word >> 16) as u16, sub_index: (word >> 8) as u8, bits: word as u8 }
    }

    /// Returns whether the entry is a gap: its index is the code of a data type.
    pub fn is_gap(self) -> bool {
        self.index < 0x1000
    }

    /// Returns the mapping entry for the object (CiA 301 7.5.2.36).
    pub fn word(self) -> u32 {
        u32::from(self.index) << 16 | u32::from(self.sub_index) << 8 | u32::from(self.bits)
    }
}
