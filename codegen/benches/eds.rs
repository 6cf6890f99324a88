//! From the bytes of an EDS to Rust, stage by stage.
//!
//! The inputs are made by `inputs`: records of nine entries, 10 of them at first. How to run it, and what it gave, is in
//! `benches/README.md`.

#[path = "inputs/eds.rs"]
mod inputs;
mod stages;

use divan::counter::BytesCount;
use divan::Bencher;
use inputs::growing;
use lexibus_codegen::source::FileId;
use lexibus_codegen::syntax::ini::Document;
use stages::SIZES;

fn main() {
    divan::main();
}

/// Text to sections, keys and values.
#[divan::bench(args = SIZES, max_time = 2)]
fn lex(bencher: Bencher<'_, '_>, size: usize) {
    let text = String::from_utf8(growing(size)).expect("text");
    bencher
        .counter(BytesCount::new(text.len()))
        .bench(|| Document::parse(divan::black_box(&text), FileId(0)).entry_count());
}

stages::measure!("bench.eds");
