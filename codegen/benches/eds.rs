//! Measures all stages from the bytes of an EDS to Rust code.
//!
//! The module `inputs` creates the files. Each file consists of records with nine entries. The smallest file has 10
//! records. `benches/README.md` contains the results and explains how to run the benchmark.

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

/// Measures splitting a text into sections, keys and values.
#[divan::bench(args = SIZES, max_time = 2)]
fn lex(bencher: Bencher<'_, '_>, size: usize) {
    let text = String::from_utf8(growing(size)).expect("text");
    bencher
        .counter(BytesCount::new(text.len()))
        .bench(|| Document::parse(divan::black_box(&text), FileId(0)).entry_count());
}

stages::measure!("bench.eds");
