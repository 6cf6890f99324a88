//! Output files of a network.

mod concise;
mod configured;
mod dbc;
mod dbc_names;
mod dbc_text;
mod dcf;
mod files;
mod identity;
mod master;
mod master_objects;
mod rust;
mod rust_text;
mod segment;
mod segment_rust;
mod segment_site;
mod site;

pub use concise::concise;
pub use configured::node_catalog;
pub use dbc::dbc;
pub use dcf::dcf;
pub use files::{files, OutputFile};
pub use master::{master_dcf, master_writes};
pub use rust::rust;
pub use segment::segment_json;
pub use segment_rust::segment_rust;
pub use segment_site::summary as segment_summary;
pub use site::{announce, pages};
