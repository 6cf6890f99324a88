//! Tests how the front ends read quirks, and the front end for XDD.

#[path = "../corpus_support/mod.rs"]
mod corpus_support;

mod eds;
mod esi;
mod gsdml;
mod xdd;
