//! Documentation in both formats.

#[path = "../../../tests/corpus_support/mod.rs"]
mod corpus_support;
#[path = "../docs_support/mod.rs"]
mod docs_support;
#[allow(dead_code)]
#[path = "../../../tests/table_support/doubts.rs"]
mod doubts;
#[path = "../../../../tests/support/root.rs"]
mod root;

mod corpus;
mod dictionaries;
mod html;
mod markdown;
