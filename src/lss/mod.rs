//! Layer setting services (LSS, CiA 305) as state machines that perform no I/O.
//!
//! LSS sets the node-ID and the bit rate of a device through the CAN bus. Each device is identified by its
//! [`LssAddress`], which consists of the four numbers of object 0x1018. [`Transaction`] is the master side of one
//! service, [`FastScan`] finds a device with an unknown address, and [`Slave`] is the device side. The caller sends the
//! messages that `next` returns, passes received messages to `handle`, and measures the time.
//! `clients::canopen::LssMaster` does this for any CAN interface.
//!
//! ```
//! use lexibus::lss::{FastScan, LssAddress, LssState, NoHost, Service, Slave, Transaction};
//! use lexibus::NodeId;
//!
//! let address = LssAddress { vendor_id: 0x319, product_code: 7, revision_number: 0x1_0002, serial_number: 4711 };
//! let mut slave = Slave::new(address, None);
//!
//! // Find the slave, although its address is unknown.
//! let mut scan = FastScan::new();
//! while let Some(request) = scan.next() {
//!     if let Some(answer) = slave.handle(&request, &mut NoHost) {
//!         scan.handle(&answer);
//!     }
//!     // The time in which slaves answer has passed.
//!     scan.time_out();
//! }
//! assert_eq!(scan.result(), Ok(Some(address)));
//!
//! // The scan has switched the slave to the state Configuration.
//! let mut transaction = Transaction::new(Service::ConfigureNodeId(NodeId::new(5)));
//! while let Some(request) = transaction.next() {
//!     if let Some(answer) = slave.handle(&request, &mut NoHost) {
//!         transaction.handle(&answer);
//!     }
//! }
//! transaction.time_out();
//! assert_eq!(transaction.result(), Some(Ok(0)));
//! for request in Service::SwitchGlobal(LssState::Waiting).messages() {
//!     slave.handle(&request, &mut NoHost);
//! }
//! assert_eq!(slave.node_id(), NodeId::new(5));
//! ```

mod address;
mod bit_rate;
mod command;
mod error;
mod fast_scan;
mod service;
mod slave;
mod transaction;

#[cfg(test)]
mod tests;

pub use address::{IdentityPart, LssAddress};
pub use bit_rate::BitRate;
pub use error::{LssError, Refusal};
pub use fast_scan::FastScan;
pub use service::{LssState, Message, Service};
pub use slave::{Host, NoHost, Slave};
pub use transaction::Transaction;

/// COB-ID of the messages of the LSS master (CiA 305).
pub const REQUESTS: u32 = 0x7E5;

/// COB-ID of the messages of the LSS slaves (CiA 305).
pub const ANSWERS: u32 = 0x7E4;

pub(crate) use fast_scan::is_identified;
