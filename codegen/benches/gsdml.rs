//! Measures all stages from the bytes of a GSDML file to Rust code. Also compares the time for compiling to checked IR
//! with the times of two loops over the XML events. The second loop also splits the attributes, which contain most
//! facts of a GSDML.
//!
//! The module `inputs` creates the files. Each file describes a drive with parameters, value lists and texts in six
//! languages.

mod bare;
#[path = "inputs/gsdml.rs"]
mod inputs;
mod stages;

use divan::Bencher;
use inputs::{growing, gsdml, DRIVE};
use stages::SIZES;

/// Number of submodules with 500 parameters each.
const SUBMODULES: usize = 100;

fn main() {
    bare::report(&format!("{SUBMODULES} submodules of 500 parameters"), &[gsdml(SUBMODULES, DRIVE)]);
    bare::report_corpus("gsdml");
    divan::main();
}

#[divan::bench(args = SIZES, max_time = 2)]
fn bare_events(bencher: Bencher<'_, '_>, size: usize) {
    bare::measure(bencher, growing(size));
}

stages::measure!("bench.xml");
