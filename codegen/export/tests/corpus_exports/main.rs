//! Tests of exports with all files of the corpus.

#[path = "../../../tests/corpus_support/mod.rs"]
mod corpus_support;

mod canopen;
mod dcf_tools;
mod eds;
mod esi;
mod gsdml;
mod oracle;
