//! An EtherCAT segment in this process: SubDevices made from their generated descriptions, which answer the frames of
//! `ethercrab` without any network.
//!
//! | file | what it is |
//! |---|---|
//! | `segment` | takes frames, and passes their datagrams through the SubDevices |
//! | `controller` | the memory and the registers of a slave controller: sync managers, FMMUs, EEPROM interface, clock |
//! | `eeprom` | what stands in the EEPROM |
//! | `subdevice` | the firmware: state machine, mailbox, process data |
//! | `coe` | the SDO server behind the mailbox |
//! | `pdos` | the objects that configure PDOs, and the way between objects and process data |
//! | `objects` | what a device's application provides: its objects, such as those of `lexibus::sim::Device` |
//! | `servo` | the application of the demo servo |

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
