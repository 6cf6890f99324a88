//! Front ends: network files in each format to a [`DeclaredNetwork`](crate::declared::DeclaredNetwork).

mod bus_yml;
mod common;
mod cpj;
mod detect;
mod network_toml;
mod object_name;
mod reader;

mod schema;
mod section;

pub use detect::{is_network, read, Format};
pub use schema::schema;
