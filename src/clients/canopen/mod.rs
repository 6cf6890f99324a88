//! CANopen over any CAN interface.
//!
//! Supports SDO transfers (CiA 301 7.2.4; expedited, segmented and block transfers), NMT and heartbeat (7.2.8),
//! emergency messages (7.2.7), node guarding (7.2.8.3.2.1), SYNC (7.2.5), TIME (7.2.6), PDOs (7.2.2), LSS (CiA 305),
//! and the boot of a node (CiA 302-2).
//!
//! ```
//! use std::time::{Duration, Instant};
//!
//! use lexibus::clients::canopen::{Buffered, NmtCommand, NmtState, Node, Polled};
//! use lexibus::NodeId;
//! use lexibus_drives::demo_drive::{codes::DriveErrors, pdo, DemoDrive};
//!
//! /// Works with any CAN interface of a microcontroller or a computer.
//! fn start<C: embedded_can::nb::Can>(can: C, position: i32) -> Result<(), lexibus::Error<C::Error>> {
//!     let start = Instant::now();
//!     // Keeps up to sixteen frames that arrive during an SDO transfer.
//!     let port = Buffered::<_, 16>::new(Polled::new(can, move || start.elapsed()));
//!     let id = NodeId::new(5).expect("a node-ID");
//!     let mut drive = DemoDrive::new(Node::new(port, id));
//!
//!     drive.client().nmt(NmtCommand::ResetNode)?;
//!     drive.client().wait_for(NmtState::BootUp, Duration::from_secs(5))?;
//!     for write in pdo::RxPdo2::configuration(id) {
//!         write.send(drive.client())?;
//!     }
//!     drive.target_position().write(position)?;
//!     drive.client().nmt(NmtCommand::Start)?;
//!     if let Some(emergency) = drive.client().emergency(Duration::ZERO)? {
//!         eprintln!("the drive has an error: {:?}", emergency.alarm::<DriveErrors>());
//!     }
//!     Ok(())
//! }
//! ```
//!
//! [`Polled`] converts an interface of `embedded-can` to a [`CanPort`]. The feature `socketcan` implements [`CanPort`]
//! for the sockets of the crate `socketcan`, which this module re-exports. The feature `socketcan-tokio` implements
//! [`AsyncCanPort`]. For any other library, implement [`CanPort`] as in the example of this trait.
//!
//! # Errors of the CAN interface
//!
//! The errors of SocketCAN are [`socketcan::Error`](https://docs.rs/socketcan): `Io` for errors of the operating
//! system, and `Can` for errors of the bus, for example `CanError::BusOff`. The kernel reports bus errors only if the
//! socket has an error filter. Set the filter to the errors that should end a transfer, for example
//! `socket.set_error_filter(libc::CAN_ERR_BUSOFF)` with the trait `socketcan::SocketOptions`.
//!
//! This module doesn't allocate memory. SDO transfers use the buffer of the caller.

mod boot;
mod buffered;
mod emergency;
mod frame;
mod guarding;
mod heartbeat;
#[cfg(all(feature = "socketcan", target_os = "linux"))]
mod linux;
#[cfg(all(feature = "socketcan-tokio", target_os = "linux"))]
mod linux_async;
mod lss;
mod network;
mod nmt;
mod node;
mod polled;
mod port;
mod sdo;
mod sync_producer;
mod time_stamp;

pub use crate::sdo::Channel;
pub use boot::{Boot, BootError, Booted, ErrorControl, VersionText};
pub use buffered::Buffered;
pub use frame::CanFrame;
pub use guarding::{GuardError, Guarding};
pub use heartbeat::{HeartbeatConsumer, HeartbeatError};
pub use lss::LssMaster;
pub use network::{Network, NetworkPort};
pub use nmt::{sync, sync_with_counter, NmtCommand, NmtState, SYNC};
pub use node::{Node, TIMEOUT};
pub use polled::Polled;
pub use port::{AsyncCanPort, CanPort};
#[cfg(all(feature = "socketcan", target_os = "linux"))]
pub use socketcan;
pub use sync_producer::SyncProducer;

#[cfg(all(test, feature = "std"))]
mod slow;
#[cfg(test)]
mod tests;
