//! Lints for register tables only.

pub(super) mod conversions;
pub(super) mod declared_pdos;
pub(super) mod item_names;
pub(super) mod limits;
pub(super) mod mentions;
#[cfg(feature = "messages")]
pub(super) mod message_shapes;
#[cfg(feature = "messages")]
pub(super) mod messages;
pub(super) mod modbus_examples;
pub(super) mod names;
pub(super) mod number_gaps;
mod physical;
pub(super) mod quantities;
pub(super) mod window_numbers;
pub(super) mod window_widths;
mod windows;
