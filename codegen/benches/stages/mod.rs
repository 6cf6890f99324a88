//! The measured stages from the bytes of a description to Rust code. The largest input has 1,000 times the size of the
//! smallest one.

use divan::counter::BytesCount;
use divan::Bencher;
use lexibus_codegen::check as lints;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::resolve::{resolve, Changes, Profiles};
use lexibus_codegen::selection::Selection;
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

/// Sizes of the inputs, as multiples of the smallest input.
pub const SIZES: [usize; 4] = [1, 10, 100, 1_000];

/// Measures reading the bytes of a file to IR.
pub fn read(bencher: Bencher<'_, '_>, name: &str, bytes: Vec<u8>) {
    bencher
        .counter(BytesCount::new(bytes.len()))
        .with_inputs(|| bytes.clone())
        .bench_values(|bytes| compile::read(Source::new(name, bytes), &Options::default()));
}

/// Measures the passes that convert IR to checked IR.
pub fn passes(bencher: Bencher<'_, '_>, name: &str, bytes: Vec<u8>) {
    let count = BytesCount::new(bytes.len());
    let catalog = compile::read(Source::new(name, bytes), &Options::default()).catalog.expect("a catalog");
    let selection = Selection::default();
    bencher.counter(count).with_inputs(|| catalog.clone()).bench_values(|mut catalog| {
        let mut diagnostics = Diagnostics::default();
        let changes = Changes { selection: &selection, overlays: Vec::new(), profiles: Profiles::Applied };
        resolve(&mut catalog, &changes, &mut diagnostics);
        lints::check(&catalog, &mut diagnostics);
        catalog
    });
}

/// Measures the stages from bytes to checked IR. The stages include adding the facts of profiles and calculating the
/// digest of the source.
pub fn check(bencher: Bencher<'_, '_>, name: &str, bytes: Vec<u8>) {
    bencher
        .counter(BytesCount::new(bytes.len()))
        .with_inputs(|| bytes.clone())
        .bench_values(|bytes| compile::check(Source::new(name, bytes), &Options::default()));
}

/// Measures generating Rust for all devices from checked IR. The throughput refers to the bytes of the description.
pub fn emit(bencher: Bencher<'_, '_>, name: &str, bytes: Vec<u8>) {
    let count = BytesCount::new(bytes.len());
    let compilation = compile::check(Source::new(name, bytes), &Options::default());
    bencher.counter(count).bench(|| divan::black_box(&compilation).rust(&RustOptions::default()).expect("bindings"));
}

/// Measures all stages from bytes to Rust.
pub fn whole(bencher: Bencher<'_, '_>, name: &str, bytes: Vec<u8>) {
    bencher.counter(BytesCount::new(bytes.len())).with_inputs(|| bytes.clone()).bench_values(|bytes| {
        let compilation = compile::check(Source::new(name, bytes), &Options::default());
        compilation.rust(&RustOptions::default()).expect("bindings")
    });
}

/// Measures all stages for a format. `growing` creates the files, and `$name` is their name.
macro_rules! measure {
    ($name:literal) => {
        #[divan::bench(args = stages::SIZES, max_time = 2)]
        fn read(bencher: divan::Bencher<'_, '_>, size: usize) {
            stages::read(bencher, $name, growing(size));
        }

        #[divan::bench(args = stages::SIZES, max_time = 2)]
        fn passes(bencher: divan::Bencher<'_, '_>, size: usize) {
            stages::passes(bencher, $name, growing(size));
        }

        #[divan::bench(args = stages::SIZES, max_time = 2)]
        fn check(bencher: divan::Bencher<'_, '_>, size: usize) {
            stages::check(bencher, $name, growing(size));
        }

        #[divan::bench(args = stages::SIZES, max_time = 2)]
        fn emit(bencher: divan::Bencher<'_, '_>, size: usize) {
            stages::emit(bencher, $name, growing(size));
        }

        #[divan::bench(args = stages::SIZES, max_time = 2)]
        fn whole(bencher: divan::Bencher<'_, '_>, size: usize) {
            stages::whole(bencher, $name, growing(size));
        }
    };
}
pub(crate) use measure;
