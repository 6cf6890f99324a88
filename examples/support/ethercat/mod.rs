//! A simulated EtherCAT segment. Its SubDevices are created from generated descriptions and answer frames of
//! `ethercrab` without a network.
//!
//! | module | content |
//! |---|---|
//! | `segment` | frames and the path of their datagrams through the SubDevices |
//! | `controller` | memory and registers of a slave controller: sync managers, FMMUs, EEPROM interface, clock |
//! | `eeprom` | content of the EEPROM |
//! | `subdevice` | firmware: state machine, mailbox, process data |
//! | `coe` | SDO server of the mailbox |
//! | `pdos` | PDO configuration objects, and the copy between objects and process data |
//! | `objects` | interface to the objects of an application, such as those of `lexibus::sim::Device` |
//! | `servo` | application of the demo servo |

mod coe;
mod controller;
mod eeprom;
pub mod objects;
mod pdos;
mod segment;
mod servo;
mod subdevice;

pub use segment::Segment;
pub use servo::Servo;
pub use subdevice::SubDevice;
