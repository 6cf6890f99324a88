//! Front ends: read network files of each format into a [`DeclaredNetwork`](crate::declared::DeclaredNetwork).

mod bus_yml;
pub(crate) mod common;
mod cpj;
mod detect;
mod network_toml;
mod object_name;
pub(crate) mod reader;
mod schema;
pub(crate) mod section;

pub use detect::{is_network, read, Format};
pub use schema::schema;
