//! From EDS text to Rust, stage by stage: lexing, lowering to IR, passes, emission.
//!
//! The inputs are made by `inputs`: `small` is a device of some 40 entries, `large` one of 10,000. How to run it, and what it gave, is
//! in `benches/README.md`.

use divan::counter::{BytesCount, ItemsCount};
use divan::Bencher;
use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::passes;
use lexibus_codegen::source::{FileId, Source};
use lexibus_codegen::syntax::ini::Document;
use lexibus_codegen::RustOptions;

#[path = "inputs/eds.rs"]
mod inputs;

use inputs::eds;

fn main() {
    divan::main();
}

/// Number of records; each has sub-index 0 and eight entries.
const SIZES: [usize; 3] = [4, 110, 1_111];

fn source(records: usize) -> Source {
    Source::new("bench.eds", eds(records).into_bytes())
}

#[divan::bench(args = SIZES)]
fn lex(bencher: Bencher<'_, '_>, records: usize) {
    let text = eds(records);
    bencher
        .counter(BytesCount::new(text.len()))
        .bench(|| Document::parse(divan::black_box(&text), FileId(0)).entry_count());
}

#[divan::bench(args = SIZES)]
fn lex_and_lower(bencher: Bencher<'_, '_>, records: usize) {
    let source = source(records);
    bencher.counter(BytesCount::new(source.text().len())).bench(|| {
        let mut diagnostics = Diagnostics::default();
        lexibus_codegen::frontend::eds::read(divan::black_box(&source), FileId(0), &[], &mut diagnostics)
    });
}

#[divan::bench(args = SIZES)]
fn passes(bencher: Bencher<'_, '_>, records: usize) {
    let catalog = compile::read(source(records), &Options::default()).catalog.expect("a catalogue");
    bencher.with_inputs(|| catalog.clone()).input_counter(move |_| ItemsCount::new(records * 9)).bench_values(
        |mut catalog| {
            passes::check(&mut catalog, &mut Diagnostics::default());
            catalog
        },
    );
}

/// All of reading: bytes to checked IR.
#[divan::bench(args = SIZES)]
fn check(bencher: Bencher<'_, '_>, records: usize) {
    let text = eds(records);
    let options = Options::default();
    bencher
        .counter(BytesCount::new(text.len()))
        .with_inputs(|| text.clone().into_bytes())
        .bench_values(|bytes| compile::check(Source::new("bench.eds", bytes), &options));
}

#[divan::bench(args = SIZES)]
fn emit(bencher: Bencher<'_, '_>, records: usize) {
    let compilation = compile::check(source(records), &Options::default());
    let catalog = compilation.catalog.as_ref().expect("a catalogue");
    let options = RustOptions::default();
    bencher
        .counter(ItemsCount::new(records * 9))
        .bench(|| rust::emit(divan::black_box(&catalog.devices[0]), &catalog.files[0], &options));
}
