//! Tests the front end for XDD, and quirks and limits of EDS, ESI and GSDML files.

#[path = "../corpus_support/mod.rs"]
mod corpus_support;

mod eds;
mod esi;
mod gsdml;
mod xdd;
