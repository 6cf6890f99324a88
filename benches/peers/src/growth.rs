//! Measures the time and memory for inputs of 1, 10, 100 and 1,000 times the smallest size.

use std::hint::black_box;
use std::time::{Duration, Instant};

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;
use serde_json::{json, Value};

use crate::input::{growing, growing_device, InputFormat};
use crate::memory;
use crate::read::check;

const SIZES: [usize; 4] = [1, 10, 100, 1_000];

/// A kind of input that is measured in several sizes: its title, its file name, and the function that creates it.
type Series = (&'static str, &'static str, fn(usize) -> Vec<u8>);

const SERIES: [Series; 5] = [
    ("EDS, records", "bench.eds", |size| growing(InputFormat::Eds, size)),
    ("ESI, devices", "bench.xml", |size| growing(InputFormat::Esi, size)),
    ("ESI, objects of one device", "bench.xml", growing_device),
    ("GSDML, modules and records", "bench.xml", |size| growing(InputFormat::Gsdml, size)),
    ("table, registers", "bench.toml", |size| growing(InputFormat::Table, size)),
];

/// Size of an input in bytes, and its cost per byte: time in nanoseconds and memory in bytes.
struct Cost {
    bytes: usize,
    read: f64,
    check: f64,
    emit: Option<f64>,
    peak: f64,
    left: f64,
}

/// Measures each growing input. Returns the results as JSON; if `print` is set, also prints a table for each input.
pub fn report(print: bool) -> Vec<Value> {
    SERIES.iter().map(|series| one(series, print)).collect()
}

fn one(series: &Series, print: bool) -> Value {
    let &(title, name, make) = series;
    let inputs: Vec<_> = SIZES.iter().map(|&size| make(size)).collect();
    let costs = costs(name, &inputs);
    if print {
        println!("\nGrowth: {title}\n");
        println!("| size | MB | read, ns per byte | check | emit | peak memory, times the input | retained memory |");
        println!("|---|---|---|---|---|---|---|");
    }
    // Compare the times per byte with those of the second size, because the fixed time per file dominates for the
    // smallest input.
    let usual = &costs[1];
    let mut rows = Vec::new();
    for (size, cost) in SIZES.iter().zip(&costs) {
        let grows = [cost.read > 2.0 * usual.read, cost.check > 2.0 * usual.check];
        let emit = cost.emit.map(|emit| format!("{emit:.1}")).unwrap_or_default();
        if print {
            println!(
                "| {size} | {:.3} | {:.2}{} | {:.2}{} | {emit} | {:.2}{} | {:.2} |",
                cost.bytes as f64 / 1e6,
                cost.read,
                mark(grows[0] && *size > 1),
                cost.check,
                mark(grows[1] && *size > 1),
                cost.peak,
                mark(cost.peak > 4.0),
                cost.left,
            );
        }
        rows.push(json!({
            "size": size, "bytes": cost.bytes, "read_ns": cost.read, "check_ns": cost.check, "emit_ns": cost.emit,
            "peak": cost.peak, "left": cost.left,
        }));
    }
    json!({ "title": title, "sizes": rows })
}

/// Returns a bold exclamation mark for an unexpected value, and an empty text for any other value.
fn mark(bad: bool) -> &'static str {
    if bad {
        " **!**"
    } else {
        ""
    }
}

/// Measures all inputs in turn, in several rounds. Returns the cost of each input. Each time is the minimum of several runs.
fn costs(name: &str, inputs: &[Vec<u8>]) -> Vec<Cost> {
    let options = Options::default();
    let read = |bytes: Vec<u8>| compile::read(Source::new(name, bytes), &options);
    let whole = |bytes: Vec<u8>| check(name.to_owned(), bytes);
    // The first run reads the profiles, and later runs reuse them.
    drop(whole(inputs[0].clone()));
    let mut best = vec![[Duration::MAX; 2]; inputs.len()];
    for _ in 0..ROUNDS {
        for (bytes, best) in inputs.iter().zip(&mut best) {
            for _ in 0..repetitions(bytes.len()) {
                *best = [best[0].min(time(bytes, read)), best[1].min(time(bytes, whole))];
            }
        }
    }
    inputs.iter().zip(best).map(|(bytes, best)| cost(name, bytes, best)).collect()
}

const ROUNDS: usize = 4;

/// Returns the number of repetitions for an input size: 1 to 50. Short inputs are repeated more often, so that their
/// total time is similar to that of long inputs.
fn repetitions(bytes: usize) -> usize {
    (2_000_000 / bytes).clamp(1, 50)
}

fn cost(name: &str, bytes: &[u8], [read, whole]: [Duration; 2]) -> Cost {
    let a_byte = |time: Duration| time.as_nanos() as f64 / bytes.len() as f64;
    let (most, left) = memory::peak(|| check(name.to_owned(), bytes.to_vec()));
    Cost {
        bytes: bytes.len(),
        read: a_byte(read),
        check: a_byte(whole),
        emit: emit(&check(name.to_owned(), bytes.to_vec())).map(a_byte),
        peak: most as f64 / bytes.len() as f64,
        left: left as f64 / bytes.len() as f64,
    }
}

fn time(bytes: &[u8], work: impl Fn(Vec<u8>) -> Compilation) -> Duration {
    let bytes = bytes.to_vec();
    let start = Instant::now();
    let made = black_box(work(bytes));
    let elapsed = start.elapsed();
    drop(made);
    elapsed
}

/// Returns the time for generating Rust from IR: the minimum of three runs. Returns `None` if there are errors.
fn emit(compilation: &Compilation) -> Option<Duration> {
    let once = || {
        let start = Instant::now();
        black_box(compilation.rust(&RustOptions::default())?);
        Some(start.elapsed())
    };
    (0..3).map(|_| once()).min().flatten()
}
