//! Facts about elements in the form that all outputs for people and programs use.
//!
//! | file | subject |
//! |---|---|
//! | `address` | addresses of items on each bus |
//! | `area` | areas of a device: chapters of registers and ranges of objects |
//! | `cob_id` | COB-IDs: identifiers of CAN frames with flags |
//! | `code` | codes as their source prints them |
//! | `configuration` | configured values in the order in which a device accepts them |
//! | `device` | titles of devices, and modules that slots accept |
//! | `doubts` | ambiguities of a device and of its definitions |
//! | `encoding` | values as the bytes of an SDO transfer |
//! | `item` | default value, range, unit and PDO mapping of an item |
//! | `machine` | fault states and energized states of state machines |
//! | `markdown` | texts in Markdown |
//! | `pattern` | bit patterns of states and commands |
//! | `pdo` | names of PDOs on CANopen and EtherCAT, and what they can map |
//! | `physical` | physical values with raw values |
//! | `profinet` | slots, cycle times, redundancy and lengths of PROFINET access points |
//! | `referrers` | which elements refer to an item |
//! | `register` | printed addresses and wire addresses on Modbus |
//! | `types` | types of values |
//! | `words` | sentences about elements for all kinds of documentation |

pub mod address;
pub mod area;
pub mod cob_id;
pub mod code;
pub mod configuration;
pub mod device;
pub mod doubts;
pub mod encoding;
pub mod item;
pub mod machine;
pub mod markdown;
pub mod mentions;
pub mod pattern;
pub mod pdo;
pub mod physical;
pub mod profinet;
pub mod referrers;
pub mod register;
pub mod types;
pub mod words;
