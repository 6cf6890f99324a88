//! CANopen over any CAN interface: SDO transfers (CiA 301 7.2.4), expedited and segmented, NMT and heartbeat (7.2.8),
//! emergency messages (7.2.7), SYNC (7.2.5) and PDOs (7.2.2).
//!
//! ```
//! use std::time::{Duration, Instant};
//!
//! use lexibus::clients::canopen::{Buffered, NmtCommand, NmtState, Node, Polled};
//! use lexibus::NodeId;
//! use lexibus_drives::demo_drive::{codes::DriveErrors, pdo, DemoDrive};
//!
//! /// Any CAN interface, of a microcontroller or of a computer.
//! fn start<C: embedded_can::nb::Can>(can: C, position: i32) -> Result<(), lexibus::Error<C::Error>> {
//!     let start = Instant::now();
//!     // What comes while an answer is waited for is kept, up to sixteen frames.
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
//! [`Polled`] makes a [`CanPort`] of an interface of `embedded-can`. The feature `socketcan` has one of SocketCAN, which is
//! re-exported here; `socketcan-tokio` has an [`AsyncCanPort`]. Any other library takes twenty lines: [`CanPort`] shows them.
//!
//! The buffer of an SDO transfer is allocated; all else is on the stack.

mod buffered;
mod emergency;
mod frame;
#[cfg(all(feature = "socketcan", target_os = "linux"))]
mod linux;
#[cfg(all(feature = "socketcan-tokio", target_os = "linux"))]
mod linux_async;
mod nmt;
mod node;
mod polled;
mod port;
mod sdo;

pub use buffered::Buffered;
pub use frame::CanFrame;
pub use nmt::{sync, NmtCommand, NmtState};
pub use node::{Node, TIMEOUT};
pub use polled::Polled;
pub use port::{AsyncCanPort, CanPort};
#[cfg(all(feature = "socketcan", target_os = "linux"))]
pub use socketcan;

#[cfg(test)]
mod tests;
