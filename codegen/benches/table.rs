//! From a register table to Rust, stage by stage: lowering to IR, passes, emission.
//!
//! The inputs are made by `inputs`: registers of 32 bits with six bit fields each.

use divan::counter::{BytesCount, ItemsCount};
use divan::Bencher;
use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::passes;
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

#[path = "inputs/table.rs"]
mod inputs;

use inputs::table;

fn main() {
    divan::main();
}

const REGISTERS: [usize; 4] = [10, 100, 1_000, 10_000];

fn source(registers: usize) -> Source {
    Source::new("bench.toml", table(registers).into_bytes())
}

/// Text to IR.
#[divan::bench(args = REGISTERS)]
fn read(bencher: Bencher<'_, '_>, registers: usize) {
    let options = Options::default();
    bencher
        .counter(BytesCount::new(table(registers).len()))
        .with_inputs(|| source(registers))
        .bench_values(|source| compile::read(source, &options));
}

#[divan::bench(args = REGISTERS)]
fn passes(bencher: Bencher<'_, '_>, registers: usize) {
    let catalog = compile::read(source(registers), &Options::default()).catalog.expect("a catalogue");
    bencher.with_inputs(|| catalog.clone()).input_counter(move |_| ItemsCount::new(registers)).bench_values(
        |mut catalog| {
            passes::check(&mut catalog, &mut Diagnostics::default());
            catalog
        },
    );
}

/// All of reading: bytes to checked IR.
#[divan::bench(args = REGISTERS)]
fn check(bencher: Bencher<'_, '_>, registers: usize) {
    let text = table(registers);
    let options = Options::default();
    bencher
        .counter(BytesCount::new(text.len()))
        .with_inputs(|| text.clone().into_bytes())
        .bench_values(|bytes| compile::check(Source::new("bench.toml", bytes), &options));
}

#[divan::bench(args = REGISTERS)]
fn emit(bencher: Bencher<'_, '_>, registers: usize) {
    let compilation = compile::check(source(registers), &Options::default());
    let catalog = compilation.catalog.as_ref().expect("a catalogue");
    let options = RustOptions::default();
    bencher
        .counter(ItemsCount::new(registers))
        .bench(|| rust::emit(divan::black_box(&catalog.devices[0]), &catalog.files[0], &options));
}
