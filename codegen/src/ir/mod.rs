//! The intermediate representation: plain data that every front end produces and every back end reads.
//!
//! A [`Catalog`] holds the [`Device`]s of one vendor. What a device has falls into a few ideas:
//!
//! - An [`Item`] is *one value* of the device: an object's sub-entry, a register, a parameter, a field of a record or of
//!   a process image. It has a [`Type`], an [`Access`], a default, limits, and **bindings**: where it is found on each
//!   bus. One item may have several addresses.
//! - A [`Group`] keeps together the items that the source keeps together: the sub-entries of an object, the registers
//!   of a chapter, the fields of a parameter record. On CANopen and EtherCAT a group is an object.
//! - A [`Type`] is either basic or names a [`TypeDef`]: a bit field, an enumeration, an array, a record.
//! - [`ProcessData`] is what is exchanged cyclically: PDOs with exact bit positions, sync managers, submodule data.
//! - A [`Message`] is a request or reply frame of a drive that speaks a command protocol.
//! - [`Module`]s and [`Submodule`]s extend a modular device; they belong to the catalogue, because several devices may
//!   take the same ones. [`CodeTable`]s, [`StateMachine`]s and [`Procedure`]s are what a manual tells
//!   beside the dictionary.
//!
//! Every element knows its [`Origin`](crate::source::Origin), and where the source contradicts itself a [`Doubt`] says
//! what it says, what was chosen and why. What a source says and the IR has no place for is kept as an [`Extension`].
//!
//! The IR is never wrong by construction: it holds what a source says, even where that makes no sense. Passes check it.

mod behaviour;
mod bus;
mod catalog;
mod composite;
mod device;
mod ethercat;
mod fact;
pub(crate) mod firmware;
mod format;
mod item;
mod lookup;
mod machine;
mod message;
mod module;
pub(crate) mod object_names;
pub mod owner;
mod process_data;
mod profinet;
#[cfg(feature = "serde")]
mod real;
mod reference;
mod shared;
#[cfg(feature = "table")]
pub(crate) mod texts;
mod types;
mod value;
mod variant;

pub use behaviour::*;
pub use bus::*;
pub use catalog::*;
pub use composite::*;
pub use device::*;
pub use ethercat::*;
pub use fact::*;
pub use format::*;
pub use item::*;
pub use lookup::*;
pub use machine::*;
pub use message::*;
pub use module::*;
pub use process_data::*;
pub use profinet::*;
pub use reference::*;
pub use shared::*;
pub use types::*;
pub use value::*;
pub use variant::*;

pub use compact_str::CompactString;
