//! Tests the generated Rust code.

#[path = "../compile_support/mod.rs"]
mod compile_support;
#[path = "../corpus_support/mod.rs"]
mod corpus_support;
#[path = "../form_support/mod.rs"]
mod form_support;

mod cia402;
mod generated_code;
mod odd_messages;
mod profinet;
mod program;
mod remappable;
mod routes;
mod rust_format;
mod rustdoc;
mod snapshots;
mod table_code;
