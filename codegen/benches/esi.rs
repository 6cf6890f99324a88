//! From the bytes of an ESI file to checked IR, against a bare loop over the events of the same bytes.
//!
//! The input is made by `inputs`: devices with dictionaries, PDOs and sync managers in the proportions of real files. The ratio
//! of the two is printed first, over this input and, where it is there, over the corpus beside the repository.

use std::path::Path;
use std::time::{Duration, Instant};

use divan::counter::BytesCount;
use divan::Bencher;
use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::passes;
use lexibus_codegen::source::Source;
use quick_xml::events::Event;
use quick_xml::Reader;

#[path = "inputs/esi.rs"]
mod inputs;

use inputs::{esi, DRIVE};

fn main() {
    let one = esi(DEVICES, DRIVE).into_bytes();
    ratio(&format!("{DEVICES} devices with dictionaries"), &[one]);
    match corpus() {
        Some(files) => ratio(&format!("{} files of the corpus", files.len()), &files),
        None => println!("there is no corpus beside the repository"),
    }
    divan::main();
}

/// Enough for 5 MB.
const DEVICES: usize = 29;

/// Runs of each of the two sides, in turns.
const RUNS: usize = 25;

/// Prints how many times as long as from events alone it takes to get from bytes to checked IR.
fn ratio(what: &str, files: &[Vec<u8>]) {
    let (mut bare, mut checked) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        bare.push(time(files.to_vec(), |bytes| events(&bytes)));
        checked.push(time(files.to_vec(), check));
    }
    let (bare, checked) = (median(bare), median(checked));
    let bytes: usize = files.iter().map(Vec::len).sum();
    let speed = |time: Duration| bytes as f64 / time.as_secs_f64() / 1e6;
    println!(
        "{what}, {:.1} MB: events {:.0} MB/s, checked IR {:.0} MB/s, ratio {:.2}",
        bytes as f64 / 1e6,
        speed(bare),
        speed(checked),
        bare.as_secs_f64() / checked.as_secs_f64()
    );
}

/// How long `run` takes for all files, without dropping what it makes.
fn time<T>(files: Vec<Vec<u8>>, run: impl Fn(Vec<u8>) -> T) -> Duration {
    let one = |bytes| {
        let start = Instant::now();
        let made = divan::black_box(run(bytes));
        let elapsed = start.elapsed();
        drop(made);
        elapsed
    };
    files.into_iter().map(one).sum()
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}

/// All events and their positions, and nothing made of them.
fn events(bytes: &[u8]) -> u64 {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return sum,
            Ok(event) => sum += reader.buffer_position() + event.len() as u64,
        }
    }
}

fn check(bytes: Vec<u8>) -> compile::Compilation {
    compile::check(Source::new("bench.xml", bytes), &Options::default())
}

fn corpus() -> Option<Vec<Vec<u8>>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus/esi");
    let paths = std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let is_xml = |path: &Path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xml"));
    Some(paths.filter(|path| is_xml(path)).filter_map(|path| std::fs::read(path).ok()).collect())
}

#[divan::bench(args = [1, DEVICES])]
fn bare_events(bencher: Bencher<'_, '_>, devices: usize) {
    let text = esi(devices, DRIVE);
    bencher.counter(BytesCount::new(text.len())).bench(|| events(divan::black_box(text.as_bytes())));
}

/// All of reading: bytes to checked IR.
#[divan::bench(args = [1, DEVICES])]
fn bytes_to_checked_ir(bencher: Bencher<'_, '_>, devices: usize) {
    let text = esi(devices, DRIVE);
    bencher.counter(BytesCount::new(text.len())).with_inputs(|| text.clone().into_bytes()).bench_values(check);
}

#[divan::bench(args = [DEVICES])]
fn passes(bencher: Bencher<'_, '_>, devices: usize) {
    let source = Source::new("bench.xml", esi(devices, DRIVE).into_bytes());
    let catalog = compile::read(source, &Options::default()).catalog.expect("a catalogue");
    bencher.with_inputs(|| catalog.clone()).bench_values(|mut catalog| {
        passes::check(&mut catalog, &mut Diagnostics::default());
        catalog
    });
}
