//! From EDS text to Rust, stage by stage: lexing, lowering to IR, passes, emission.
//!
//! The inputs are made here: `small` is a device of some 40 entries, `large` one of 10,000. How to run it, and what it gave, is
//! in `benches/README.md`.

use std::fmt::Write;

use divan::counter::{BytesCount, ItemsCount};
use divan::Bencher;
use lexibus_codegen::backend::rust;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::passes;
use lexibus_codegen::source::{FileId, Source};
use lexibus_codegen::syntax::ini::Document;
use lexibus_codegen::RustOptions;

fn main() {
    divan::main();
}

/// Number of records; each has sub-index 0 and eight entries.
const SIZES: [usize; 3] = [4, 110, 1_111];

/// An EDS with `records` records, in the words and with the proportions of real ones.
fn eds(records: usize) -> String {
    let mut text = String::from("[FileInfo]\nFileName=bench.eds\nEDSVersion=4.0\n\n[DeviceInfo]\nVendorName=Bench\n");
    text += "ProductName=Bench\nVendorNumber=1\nProductNumber=2\nRevisionNumber=3\nNrOfRXPDO=0\nNrOfTXPDO=0\n\n";
    text += "[ManufacturerObjects]\n";
    let _ = writeln!(text, "SupportedObjects={records}");
    for number in 0..records {
        let _ = writeln!(text, "{}=0x{:04X}", number + 1, 0x2000 + number);
    }
    for number in 0..records {
        record(&mut text, 0x2000 + number);
    }
    text
}

fn record(text: &mut String, index: usize) {
    let _ = writeln!(text, "\n[{index:04X}]\nParameterName=Axis parameter set {index}\nObjectType=0x9\nSubNumber=9");
    let _ = writeln!(text, "\n[{index:04X}sub0]\nParameterName=Highest sub-index supported\nObjectType=0x7");
    let _ = writeln!(text, "DataType=0x0005\nAccessType=const\nDefaultValue=0x08\nPDOMapping=0");
    for sub in 1..=8 {
        let _ = writeln!(text, "\n[{index:04X}sub{sub:X}]\nParameterName=Velocity limit {sub}\nObjectType=0x7");
        let _ = writeln!(text, "DataType=0x0004\nAccessType=rw\nDefaultValue=0x00000{sub:03X}\nPDOMapping=1");
        let _ = writeln!(text, "LowLimit=-2147483648\nHighLimit=0x7FFFFFFF");
    }
}

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
