//! Traits for the CiA 402 objects of a drive.

use super::integer::{Absent, ReadInteger, WriteInteger};
use crate::bus::Bus;

/// The objects that every operation of a [`Drive`](super::Drive) needs, on bus `B`. The compiler implements this trait
/// for each generated device type that has these objects, for example `DemoDrive<()>`. Implement the trait by hand for
/// items without generated code:
///
/// ```
/// use lexibus::cia402::{Objects, ReadInteger, WriteInteger};
/// use lexibus::{CanOpen, Item, OnCanOpen, Ro, Rw};
///
/// const CONTROLWORD: Item<u16, Rw, OnCanOpen> = Item::object(0x6040, 0, "Controlword");
/// const STATUSWORD: Item<u16, Ro, OnCanOpen> = Item::object(0x6041, 0, "Statusword");
/// const MODE: Item<i8, Rw, OnCanOpen> = Item::object(0x6060, 0, "Modes of operation");
/// const ACTIVE_MODE: Item<i8, Ro, OnCanOpen> = Item::object(0x6061, 0, "Modes of operation display");
///
/// struct MyDrive;
///
/// impl Objects<CanOpen> for MyDrive {
///     fn controlword() -> impl ReadInteger<CanOpen> + WriteInteger<CanOpen> {
///         CONTROLWORD
///     }
///     fn statusword() -> impl ReadInteger<CanOpen> {
///         STATUSWORD
///     }
///     fn modes_of_operation() -> impl WriteInteger<CanOpen> {
///         MODE
///     }
///     fn modes_of_operation_display() -> impl ReadInteger<CanOpen> {
///         ACTIVE_MODE
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "the device has no CiA 402 objects on `{B}`",
    label = "the client's bus has no controlword, statusword or mode of operation of this device"
)]
pub trait Objects<B: Bus> {
    /// Returns the item of the controlword (0x6040, CiA 402-2 10.3.1).
    fn controlword() -> impl ReadInteger<B> + WriteInteger<B>;

    /// Returns the item of the statusword (0x6041, CiA 402-2 10.3.2).
    fn statusword() -> impl ReadInteger<B>;

    /// Returns the item of the requested mode of operation (0x6060, CiA 402-2 10.3.8).
    fn modes_of_operation() -> impl WriteInteger<B>;

    /// Returns the item of the active mode of operation (0x6061, CiA 402-2 10.3.9).
    fn modes_of_operation_display() -> impl ReadInteger<B>;

    /// Returns the item of the error code (0x603F, CiA 402-2 9.3.2, or 0x1003:01 of CiA 301), or [`Absent`].
    fn error_code() -> impl ReadInteger<B> {
        Absent
    }

    /// Returns the item of the actual following error (0x60F4), or [`Absent`].
    fn following_error() -> impl ReadInteger<B> {
        Absent
    }
}

/// The objects of a drive with a target position.
#[diagnostic::on_unimplemented(
    message = "the device has no target position (0x607A) on `{B}`",
    label = "the client's bus has no target position of this device"
)]
pub trait Positioning<B: Bus>: Objects<B> {
    /// Returns the item of the target position (0x607A, CiA 402-2 12.3.1).
    fn target_position() -> impl WriteInteger<B>;
}

/// The objects of a drive with a target velocity.
#[diagnostic::on_unimplemented(
    message = "the device has no target velocity (0x60FF) on `{B}`",
    label = "the client's bus has no target velocity of this device"
)]
pub trait Velocity<B: Bus>: Objects<B> {
    /// Returns the item of the target velocity (0x60FF, CiA 402-2 16).
    fn target_velocity() -> impl WriteInteger<B>;
}

/// The objects of a drive with homing.
#[diagnostic::on_unimplemented(
    message = "the device has no homing method (0x6098) on `{B}`",
    label = "the client's bus has no homing method of this device"
)]
pub trait Homing<B: Bus>: Objects<B> {
    /// Returns the item of the homing method (0x6098, CiA 402-2 13.3.2).
    fn homing_method() -> impl WriteInteger<B>;
}
