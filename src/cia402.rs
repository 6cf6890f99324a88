//! Operations of drives with the profile CiA 402 (CiA 402-2 and -3, IEC 61800-7-201). The operations are a change of
//! the mode with confirmation, homing, moves with handshake, velocities, quick stop, halt, and a watch over cyclic
//! set-points.
//!
//! The method `cia402` of a generated device returns a [`Drive`]. The compiler generates the method for each device that
//! has the controlword, the statusword, and the requested and active mode of operation. The further methods of the drive
//! exist if the device has their objects, see [`Positioning`], [`Velocity`] and [`Homing`]. The method `axis` of a device
//! with several axes comes first: `device.axis(2).cia402()`.
//!
//! - No operation enables a drive. Before an operation other than `quick_stop` and `set_mode`, lead the drive to
//!   "Operation enabled" with the generated method `walk`. Another operation than `quick_stop` and `set_mode` returns
//!   [`MotionError::NotEnabled`] or [`MotionError::Fault`] in another state, and writes nothing. If the drive leaves the
//!   state during the operation, the operation returns the same errors, and doesn't write the controlword any more.
//! - Operations change only those bits of the controlword that their documentation names.
//! - The drive must not receive the controlword in process data, because process data would overwrite it. In this case,
//!   use a [`Cyclic`] and a [`Walker`](crate::Walker).
//! - Positions and velocities are raw values, in the units of the drive. The generated items convert them:
//!   `objects::TARGET_VELOCITY.raw(2.5)`.
//!
//! ```
//! # #[cfg(feature = "std")] {
//! use core::time::Duration;
//!
//! use lexibus::cia402::{Mode, Target};
//! use lexibus::sim::Device;
//! use lexibus::CanOpen;
//! use lexibus_drives::demo_drive::types::State;
//! use lexibus_drives::demo_drive::{DemoDrive, ENTRIES};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut device = Device::new(ENTRIES).with_cia402();
//! let mut drive = DemoDrive::new(device.client::<CanOpen>());
//! let limit = Duration::from_secs(2);
//!
//! drive.walk(State::OperationEnabled, limit)?;
//! drive.cia402().set_mode(Mode::ProfilePosition, limit)?;
//! drive.cia402().move_to(Target::absolute(500), limit)?;
//! drive.cia402().wait_reached(limit)?;
//! assert_eq!(drive.position_actual_value().read()?, 500);
//! # Ok(())
//! # }
//! # main().unwrap();
//! # }
//! ```
//!
//! The demo drive has no homing method (0x6098), so a call of `home` doesn't compile:
//!
//! ```compile_fail,E0599
//! # use lexibus::{CanOpen, Client};
//! # use lexibus_drives::demo_drive::DemoDrive;
//! fn home<C: Client<Bus = CanOpen>>(drive: &mut DemoDrive<C>) {
//!     let _ = drive.cia402().home(core::time::Duration::from_secs(10));
//! }
//! ```

mod bits;
mod cyclic;
mod drive;
mod error;
mod homing;
mod integer;
mod objects;
mod settling;
mod state;
mod stop;
mod target;

pub use cyclic::{Cycle, CycleError, Cyclic, Inputs};
pub use drive::Drive;
pub use error::MotionError;
pub use integer::{Absent, ReadInteger, WriteInteger};
pub use objects::{Homing, Objects, Positioning, Velocity};
pub use state::{Mode, State};
pub use target::Target;
