//! What a network file declares, before descriptions are read. All front ends produce these types.

use lexibus_codegen::source::Span;

use crate::ethercat::DeclaredSegment;
use crate::syntax::{At, Scalar};

/// A network as its file declares it.
#[derive(Clone, Debug, Default)]
pub struct DeclaredNetwork {
    /// Name of the network.
    pub name: Option<At<String>>,
    /// Bit rate in kbit/s.
    pub bit_rate: Option<At<u16>>,
    /// Bus through which the computer accesses the devices of the network, such as `can:can0`.
    pub bus: Option<At<String>>,
    /// The master.
    pub master: Option<DeclaredMaster>,
    /// True if the network needs no master, because the format of the file has none, or because the file declares only an
    /// EtherCAT segment.
    pub is_master_optional: bool,
    /// Nodes without the master, in the order in which the front end reads them.
    pub nodes: Vec<DeclaredNode>,
    /// The EtherCAT segment, if the file declares one.
    pub segment: Option<DeclaredSegment>,
}

/// The master as its section declares it. Times have the unit of their CANopen object.
#[derive(Clone, Debug)]
pub struct DeclaredMaster {
    /// Location of the section.
    pub span: Span,
    /// Node-ID of the master.
    pub node_id: Option<At<u8>>,
    /// True if the section has a node-ID, even if it is invalid.
    pub has_node_id: bool,
    /// Identity of the master: vendor-ID, product code, revision number, serial number (0x1018).
    pub identity: [u32; 4],
    /// SYNC period in µs (0x1006).
    pub sync_period: Option<At<u32>>,
    /// Synchronous window length in µs (0x1007).
    pub sync_window: u32,
    /// Synchronous counter overflow value (0x1019).
    pub sync_overflow: u8,
    /// COB-ID of TIME (0x1012).
    pub time_cob_id: At<u32>,
    /// Inhibit time of EMCY in units of 100 µs (0x1015).
    pub emcy_inhibit_time: u16,
    /// Heartbeat producer time in ms (0x1017).
    pub heartbeat: At<u16>,
    /// Consumer time of the master's heartbeat as a multiple of its producer time.
    pub heartbeat_multiplier: At<f64>,
    /// True if the master monitors the heartbeats of the nodes (0x1016).
    pub consumes_heartbeats: bool,
    /// Error behavior (0x1029): sub-index and value.
    pub error_behavior: Vec<(u8, u8)>,
    /// Inhibit time of NMT commands in units of 100 µs (0x102A).
    pub nmt_inhibit_time: u16,
    /// NMT startup (0x1F80).
    pub startup: u32,
    /// Boot time in ms (0x1F89).
    pub boot_time: u32,
    /// True if the master exchanges PDOs: it receives each enabled TPDO of the nodes, and sends each enabled RPDO that no node
    /// sends.
    pub exchanges_pdos: bool,
}

impl DeclaredMaster {
    /// Creates a master with default values.
    pub fn new(span: Span) -> Self {
        DeclaredMaster {
            span,
            node_id: None,
            has_node_id: false,
            identity: [0; 4],
            sync_period: None,
            sync_window: 0,
            sync_overflow: 0,
            time_cob_id: At::new(0x100, Span::MISSING),
            emcy_inhibit_time: 0,
            heartbeat: At::new(0, span),
            heartbeat_multiplier: At::new(HEARTBEAT_MULTIPLIER, span),
            consumes_heartbeats: true,
            error_behavior: vec![(1, 0)],
            nmt_inhibit_time: 0,
            startup: 1,
            boot_time: 0,
            exchanges_pdos: true,
        }
    }
}

/// Default ratio of the consumer time of a heartbeat to its producer time.
pub const HEARTBEAT_MULTIPLIER: f64 = 3.0;

/// Default retry factor of a node (0x1F81).
pub const RETRY_FACTOR: u8 = 3;

/// A node as its section declares it. Times have the unit of their CANopen object.
#[derive(Clone, Debug)]
pub struct DeclaredNode {
    /// Name of the node.
    pub name: At<String>,
    /// Node-ID of the node.
    pub node_id: Option<At<u8>>,
    /// True if the section has a node-ID, even if it is invalid.
    pub has_node_id: bool,
    /// Path of the device description.
    pub device: Option<At<String>>,
    /// Name, order code or product code of the device, if the description contains several devices.
    pub model: Option<At<String>>,
    /// Folders that are searched for the device description before the folder of the network file.
    pub folders: Vec<At<String>>,
    /// Folder of the node's concise DCF for the master; `None` = the folder of the master's DCF.
    pub upload_folder: Option<At<String>>,
    /// Paths of overlays.
    pub overlays: Vec<At<String>>,
    /// Expected revision number, instead of that of the description.
    pub revision_number: Option<u32>,
    /// Expected serial number.
    pub serial_number: Option<u32>,
    /// COB-ID of TIME (0x1012).
    pub time_cob_id: Option<At<u32>>,
    /// Heartbeat producer time in ms (0x1017).
    pub heartbeat: Option<At<u16>>,
    /// Consumer time of the node's heartbeat as a multiple of its producer time.
    pub heartbeat_multiplier: At<f64>,
    /// True if the node monitors the heartbeat of the master.
    pub consumes_heartbeat: bool,
    /// Guard time in ms (0x100C).
    pub guard_time: Option<At<u16>>,
    /// Life time factor (0x100D).
    pub life_time_factor: Option<At<u8>>,
    /// Error behavior (0x1029): sub-index and value.
    pub error_behavior: Vec<At<(u8, u8)>>,
    /// RPDOs, then TPDOs, each in the order of the file.
    pub pdos: Vec<DeclaredPdo>,
    /// True if the master boots the node.
    pub boot: bool,
    /// True if the network does not start without the node.
    pub mandatory: bool,
    /// True if the master may reset the communication of the node while the node is Operational.
    pub reset_communication: bool,
    /// Program that the master downloads to the node.
    pub software_file: Option<At<String>>,
    /// Expected software identification (0x1F55); 0 = not checked.
    pub software_version: u32,
    /// Expected texts of the manufacturer hardware version (0x1009) and software version (0x100A); `None` = not checked.
    pub versions: [Option<At<String>>; 2],
    /// Sub-index of 0x1011 that restores the defaults before the configuration; 0 = none.
    pub restore: u8,
    /// Retry factor of the node (0x1F81).
    pub retry_factor: u8,
    /// True if the node stores its configuration.
    pub store: bool,
    /// True if the values that the description configures (DCF, XDC) are written to the node, too. `dcfgen` assumes that the node
    /// already has them.
    pub is_description_written: bool,
    /// Values of objects, in the order in which they are written.
    pub parameters: Vec<DeclaredParameter>,
}

impl DeclaredNode {
    /// Creates a node with default values.
    pub fn new(name: At<String>) -> Self {
        let multiplier = At::new(HEARTBEAT_MULTIPLIER, name.span);
        DeclaredNode {
            name,
            node_id: None,
            has_node_id: false,
            device: None,
            model: None,
            folders: Vec::new(),
            upload_folder: None,
            overlays: Vec::new(),
            revision_number: None,
            serial_number: None,
            time_cob_id: None,
            heartbeat: None,
            heartbeat_multiplier: multiplier,
            consumes_heartbeat: false,
            guard_time: None,
            life_time_factor: None,
            error_behavior: Vec::new(),
            pdos: Vec::new(),
            boot: true,
            mandatory: false,
            reset_communication: true,
            software_file: None,
            software_version: 0,
            versions: [None, None],
            restore: 0,
            retry_factor: RETRY_FACTOR,
            store: false,
            is_description_written: true,
            parameters: Vec::new(),
        }
    }
}

/// A PDO of a node as its section declares it.
#[derive(Clone, Debug)]
pub struct DeclaredPdo {
    /// True if the node sends the PDO.
    pub is_tpdo: bool,
    /// Number of the PDO, counted from 1.
    pub number: At<u16>,
    /// False if the PDO is disabled.
    pub enabled: bool,
    /// COB-ID of the PDO.
    pub cob_id: Option<At<DeclaredCobId>>,
    /// Transmission type (sub-index 2).
    pub transmission: Option<At<u8>>,
    /// Inhibit time of the sender in units of 100 µs (sub-index 3).
    pub inhibit_time: Option<At<u16>>,
    /// Event timer of the sender in ms (sub-index 5).
    pub event_timer: Option<At<u16>>,
    /// Deadline of the receiver in ms (sub-index 5).
    pub event_deadline: Option<At<u16>>,
    /// SYNC start value of the sender (sub-index 6).
    pub sync_start: Option<At<u8>>,
    /// Mapped objects.
    pub mapping: Option<At<Vec<At<ObjectName>>>>,
}

/// COB-ID of a PDO as its section declares it.
#[derive(Clone, Debug, PartialEq)]
pub enum DeclaredCobId {
    /// The COB-ID of the predefined connection set or, for PDOs after the fourth, the next free CAN-ID.
    Automatic,
    /// A COB-ID with flags.
    Number(u32),
    /// The COB-ID of a TPDO of another node: name of the node, number of the TPDO.
    Of(String, u16),
}

/// An object as the file names it.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjectName {
    /// Index and sub-index.
    Address(u16, u8),
    /// Name of an item, or the names of its object and of the item, separated by a slash (`Object/Item`).
    Name(String),
}

/// The value of an object as the file declares it.
#[derive(Clone, Debug)]
pub struct DeclaredParameter {
    /// The object.
    pub object: At<ObjectName>,
    /// The value: a raw value, a physical value with its unit, the name of a value, a formula with `$NODEID`, or a text.
    pub value: At<Scalar>,
}
