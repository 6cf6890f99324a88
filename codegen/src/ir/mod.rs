//! The intermediate representation: plain data that every front end produces and every back end reads.
//!
//! A [`Catalog`] holds the [`Device`]s of one vendor. The main elements of a device are:
//!
//! - An [`Item`] is *one value*: a sub-index of an object, a register, a parameter, a field of a record or of a process
//!   image. It has a [`Type`], an [`Access`], a default, limits, and **bindings**: its address on each bus. One item may
//!   have several addresses.
//! - A [`Group`] is a list of items that belong together in the source: the sub-indices of an object, the registers of a
//!   chapter, the fields of a parameter record. On CANopen and EtherCAT a group is an object.
//! - A [`Type`] is either basic or refers to a [`TypeDef`]: an alias, an array, a record, a bit field, an enumeration or a
//!   scaled integer.
//! - [`ProcessData`] is the cyclic data: PDOs with exact bit positions, sync managers, submodule data.
//! - A [`Message`] is a request of a command protocol, with its reply.
//! - [`Module`]s and [`Submodule`]s extend a modular device. They belong to the catalog, because several devices may
//!   accept the same modules.
//! - [`CodeTable`]s, [`StateMachine`]s and [`Procedure`]s are further parts of a manual.
//!
//! Most elements have an [`Origin`](crate::source::Origin) or a [`Span`](crate::source::Span). A [`Doubt`] describes an
//! ambiguity in the source and the assumption that was made. Facts without a field in the IR are kept as
//! [`Extension`]s.
//!
//! The IR can hold contradictory descriptions, because it holds what the source states. The lints of the module `check` report
//! contradictions.

mod behavior;
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
mod rare;
#[cfg(feature = "serde")]
mod real;
mod reference;
mod shared;
pub(crate) mod stated;
#[cfg(feature = "table")]
pub(crate) mod texts;
mod types;
mod value;
mod variant;

pub use behavior::*;
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
pub use rare::{Missing, Rare};
pub use reference::*;
pub use shared::*;
pub use types::*;
pub use value::*;
pub use variant::*;

pub use compact_str::CompactString;
