//! Declared network → network: reads descriptions, looks up objects, and computes the values to write.

mod cob_ids;
mod described_node;
mod heartbeat;
mod mapping;
mod node;
mod object;
mod pdo;
mod pdo_values;
mod run;
mod value;
mod versions;
mod writer;

pub(crate) use object::{named, no_name};
pub use run::resolve;
pub(crate) use writer::Writer;
