//! Tests register tables and overlays.

#[path = "../compile_support/mod.rs"]
mod compile_support;
#[path = "../form_support/mod.rs"]
mod form_support;
#[path = "../table_support/mod.rs"]
mod table_support;

mod overlays;
mod table;
mod table_edges;
mod table_protocol;
mod table_rows;
mod table_windows;
