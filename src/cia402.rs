//! Operations of drives with the CiA 402 profile (CiA 402-2 and -3, IEC 61800-7-201): confirmed mode changes, homing,
//! positioning with handshake, velocity, quick stop, halt, and monitoring of cyclic set-points.
//!
//! The method `cia402` of a generated device returns a [`Drive`]. The compiler generates the method for each device
//! that has the CiA 402 state machine, and the requested and active mode of operation (0x6060 and 0x6061). Some methods
//! of the drive exist only if the device has the objects that they need: see [`Positioning`], [`Velocity`] and
//! [`Homing`]. For a device with several axes, call `axis` first: `device.axis(2).cia402()`.
//!
//! - No operation enables a drive. All operations except `quick_stop`, `set_mode` and `mode` need the state "Operation
//!   enabled": call the generated method `walk` first. In any other state, they return [`MotionError::NotEnabled`] or
//!   [`MotionError::Fault`], and write nothing. If the drive leaves "Operation enabled" during such an operation, the
//!   operation returns the same errors. It then clears at most bit 4 of the controlword, and only if the write cannot
//!   change the state.
//! - Operations change only those bits of the controlword that their documentation names.
//! - If the drive receives the controlword in process data, use a [`Cyclic`] and a [`Walker`](crate::Walker) instead,
//!   because process data would overwrite the controlword.
//! - Positions and velocities are raw values, in the units of the drive. The generated items convert physical values to
//!   raw values: `objects::TARGET_VELOCITY.raw(2.5)`.
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
mod stop;
mod target;

pub use cyclic::{Cycle, CycleError, Cyclic, Inputs};
pub use drive::Drive;
pub use error::MotionError;
pub use integer::{Absent, ReadInteger, WriteInteger};
pub use objects::{Homing, Objects, Positioning, Velocity};
pub use target::Target;

#[doc(inline)]
pub use crate::profiles::types::{ModesOfOperation as Mode, State};
