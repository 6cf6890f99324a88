//! Tests exports: their content, validity, and notes about facts that are left out or missing.

#[path = "../../../tests/corpus_support/mod.rs"]
mod corpus_support;
#[path = "../../../tests/eco_support/mod.rs"]
mod eco_support;
#[path = "../../../tests/table_support/manual.rs"]
mod manual_text;

mod eco;
mod eds;
mod esi;
mod gsdml;
mod hostile;
mod info;
mod sii;
