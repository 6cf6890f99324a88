//! Two reference loops for comparison with the XML front ends: one reads the events of `quick-xml` with their
//! positions, and the other also splits the attributes.

use std::path::Path;
use std::time::{Duration, Instant};

use divan::counter::BytesCount;
use divan::Bencher;
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use quick_xml::events::{BytesStart, Event};
use quick_xml::Reader;

/// Reads the XML events of a file up to the end of the file or an error. Returns the sum of the lengths and end
/// positions of the events, so that the compiler does not remove the loop.
fn events(bytes: &[u8]) -> usize {
    walk(bytes, |_| 0)
}

/// Reads the XML events like `events`, and also splits the attributes of each tag without decoding them.
fn attributes(bytes: &[u8]) -> usize {
    walk(bytes, |tag| tag.attributes().flatten().map(|attribute| attribute.value.len()).sum())
}

fn walk(bytes: &[u8], of_tag: impl Fn(&BytesStart<'_>) -> usize) -> usize {
    let mut reader = Reader::from_reader(bytes);
    let mut sum = 0;
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return sum,
            Ok(Event::Start(tag) | Event::Empty(tag)) => sum += of_tag(&tag) + tag.len(),
            Ok(event) => sum += event.len(),
        }
        sum += reader.buffer_position() as usize;
    }
}

/// Measures the reference loop that reads events.
pub fn measure(bencher: Bencher<'_, '_>, bytes: Vec<u8>) {
    bencher.counter(BytesCount::new(bytes.len())).bench(|| events(divan::black_box(&bytes)));
}

/// Prints the throughput of the compiler, up to the checked IR, and of both reference loops. For each loop, also prints
/// the ratio of its time to the compile time.
pub fn report(name: &str, files: &[Vec<u8>]) {
    let length: usize = files.iter().map(Vec::len).sum();
    let repetitions = (200_000_000 / length.max(1)).clamp(5, 50);
    let [mut bare, mut apart, mut full] = [Duration::MAX; 3];
    // Measure all functions in turn and use the minimum time of each, so that other load on the system affects all of
    // them equally.
    for _ in 0..repetitions {
        bare = bare.min(time(|| files.iter().map(|file| events(file)).sum::<usize>()));
        apart = apart.min(time(|| files.iter().map(|file| attributes(file)).sum::<usize>()));
        let copies = files.to_vec();
        full = full.min(time(|| copies.into_iter().map(check).collect::<Vec<_>>()));
    }
    let speed = |time: Duration| length as f64 / 1e6 / time.as_secs_f64();
    let ratio = |time: Duration| time.as_secs_f64() / full.as_secs_f64();
    println!("{name}: {:.1} MB", length as f64 / 1e6);
    println!("  bytes to checked IR                    {:6.1} MB/s", speed(full));
    println!("  events with positions                  {:6.1} MB/s, ratio {:.2}", speed(bare), ratio(bare));
    println!("  the same, with split attributes          {:6.1} MB/s, ratio {:.2}", speed(apart), ratio(apart));
}

/// Returns the time that a function takes, without the time for dropping its result.
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

/// Measures the files in a folder of the corpus if the corpus exists. Files without a catalog are left out. All files are
/// converted to UTF-8 because `quick-xml` requires it.
pub fn report_corpus(folder: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus").join(folder);
    let Ok(entries) = std::fs::read_dir(folder) else {
        println!("there is no corpus next to the repository");
        return;
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let paths = paths.filter(|path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xml")));
    let checked = paths.filter_map(|path| std::fs::read(path).ok()).map(check);
    let checked = checked.filter(|compilation| compilation.catalog.is_some());
    let text = |compilation: Compilation| Some(compilation.sources.first()?.text().as_bytes().to_vec());
    let files: Vec<_> = checked.filter_map(text).collect();
    report(&format!("corpus, {} files", files.len()), &files);
}
