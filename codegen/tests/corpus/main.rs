//! Tests the front ends on the files of the corpus.

#[path = "../corpus_support/mod.rs"]
mod corpus_support;

mod esi;
mod fixes;
mod gsdml;
mod lexer;
mod profinet;
mod values;
mod xml;
