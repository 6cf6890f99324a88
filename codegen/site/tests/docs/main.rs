//! Tests the documentation that `lexibus docs` writes as HTML and as Markdown.

#[path = "../../../tests/corpus_support/mod.rs"]
mod corpus_support;
#[path = "../docs_support/mod.rs"]
mod docs_support;
#[allow(dead_code)]
#[path = "../../../tests/table_support/doubts.rs"]
mod doubts;
#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../../tests/support/root.rs"]
mod root;

mod addresses;
mod codes;
mod corpus;
mod dictionaries;
mod html;
mod index;
mod markdown;
mod parts;
mod slots;
