//! Tests the export of all files in the corpus as EDS, DCF, ESI, SII or GSDML.

#[path = "../../../tests/corpus_support/mod.rs"]
mod corpus_support;

mod canopen;
mod dcf_tools;
mod eds;
mod esi;
mod gsdml;
mod oracle;
mod sii;
