//! Output files of a network.

mod concise;
mod dbc;
mod dcf;
mod files;
mod master;
mod master_objects;
mod rust;

pub use concise::concise;
pub use dbc::dbc;
pub use dcf::dcf;
pub use files::{files, OutputFile};
pub use master::{master_dcf, master_writes};
pub use rust::{node_catalog, rust};
