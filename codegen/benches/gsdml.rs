//! From the bytes of a GSDML file to checked IR, against a bare event loop of `quick-xml` over the same bytes that takes the
//! position of each event and does nothing else.
//!
//! The input is made by `inputs`: a drive with 50,000 parameters, value lists and texts in five languages. `cargo bench -p
//! lexibus-codegen --bench gsdml` prints the ratio of the two, also for the corpus where it is there; then the single
//! measurements. The most that `read_and_check` has allocated, less what `ir` has, is the memory that reading takes beside
//! the IR.

use std::path::Path;
use std::time::{Duration, Instant};

use divan::counter::BytesCount;
use divan::{AllocProfiler, Bencher};
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use quick_xml::events::Event;
use quick_xml::Reader;

#[path = "inputs/gsdml.rs"]
mod inputs;

use inputs::{gsdml, DRIVE};

/// Tells how much each measurement has allocated at most.
#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

/// Submodules, of 500 parameters each.
const SUBMODULES: usize = 100;

fn main() {
    let text = gsdml(SUBMODULES, DRIVE);
    report("made by the bench", std::slice::from_ref(&text));
    if let Some(files) = corpus() {
        report("corpus", &files);
    }
    divan::main();
}

/// Prints both times and their ratio, and the memory.
fn report(name: &str, files: &[Vec<u8>]) {
    let length: usize = files.iter().map(Vec::len).sum();
    let repetitions = (200_000_000 / length.max(1)).clamp(5, 50);
    let (mut bare, mut attributes, mut full) = (Duration::MAX, Duration::MAX, Duration::MAX);
    // In turn, and the least of each, so that both have the same luck.
    for _ in 0..repetitions {
        bare = bare.min(time(|| files.iter().map(|file| events(file)).sum::<usize>()));
        attributes = attributes.min(time(|| files.iter().map(|file| attributes_of(file)).sum::<usize>()));
        let copies = files.to_vec();
        full = full.min(time(|| copies.into_iter().map(check).collect::<Vec<_>>()));
    }
    let speed = |time: Duration| length as f64 / 1e6 / time.as_secs_f64();
    let ratio = |time: Duration| time.as_secs_f64() / full.as_secs_f64();
    println!("{name}: {:.1} MB", length as f64 / 1e6);
    println!("  bytes to checked IR                    {:6.1} MB/s", speed(full));
    println!("  events with positions                  {:6.1} MB/s, ratio {:.2}", speed(bare), ratio(bare));
    println!("  the same, and names of the attributes  {:6.1} MB/s, ratio {:.2}", speed(attributes), ratio(attributes));
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    let result = divan::black_box(work());
    let elapsed = start.elapsed();
    drop(result);
    elapsed
}

fn check(bytes: Vec<u8>) -> Compilation {
    compile::check(Source::new("bench.xml", bytes), &Options::default())
}

/// All events of a file, with the position of each.
fn events(bytes: &[u8]) -> usize {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Eof => return sum,
            event => {
                divan::black_box(&event);
                sum += reader.buffer_position() as usize;
            }
        }
    }
}

/// The same, and the attributes of every tag, undecoded: GSDML says next to nothing but by attributes.
fn attributes_of(bytes: &[u8]) -> usize {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Eof => return sum,
            Event::Start(tag) | Event::Empty(tag) => {
                sum += tag.attributes().map(|attribute| attribute.expect("an attribute").value.len()).sum::<usize>();
                sum += reader.buffer_position() as usize;
            }
            event => {
                divan::black_box(&event);
                sum += reader.buffer_position() as usize;
            }
        }
    }
}

fn corpus() -> Option<Vec<Vec<u8>>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus/gsdml");
    let entries = std::fs::read_dir(folder).ok()?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let files = paths.filter(|path| path.extension().is_some_and(|extension| extension == "xml"));
    // Two files aren't well formed. All are compared as UTF-8, which is what `quick-xml` reads.
    let checked = files.filter_map(|path| std::fs::read(path).ok()).map(check);
    let checked = checked.filter(|compilation| compilation.catalog.is_some());
    Some(checked.filter_map(|compilation| Some(compilation.sources.first()?.text().as_bytes().to_vec())).collect())
}

#[divan::bench]
fn events_with_positions(bencher: Bencher<'_, '_>) {
    let text = gsdml(SUBMODULES, DRIVE);
    bencher.counter(BytesCount::new(text.len())).bench(|| events(divan::black_box(&text)));
}

/// Bytes to IR, as the source has it.
#[divan::bench]
fn read(bencher: Bencher<'_, '_>) {
    let text = gsdml(SUBMODULES, DRIVE);
    bencher
        .counter(BytesCount::new(text.len()))
        .with_inputs(|| text.clone())
        .bench_values(|bytes| compile::read(Source::new("bench.xml", bytes), &Options::default()));
}

/// Bytes to checked IR.
#[divan::bench]
fn read_and_check(bencher: Bencher<'_, '_>) {
    let text = gsdml(SUBMODULES, DRIVE);
    bencher.counter(BytesCount::new(text.len())).with_inputs(|| text.clone()).bench_values(check);
}

/// A copy of the IR and of nothing else.
#[divan::bench]
fn ir(bencher: Bencher<'_, '_>) {
    let compilation = check(gsdml(SUBMODULES, DRIVE));
    bencher.bench(|| compilation.catalog.clone());
}
