//! From the bytes of a GSDML file to Rust, stage by stage, and before that how the way to checked IR compares with a bare loop over
//! the events of the same bytes, and with one that takes the attributes apart: GSDML says next to nothing but by attributes.
//!
//! The inputs are made by `inputs`: a drive with parameters, value lists and texts in six languages.

mod bare;
#[path = "inputs/gsdml.rs"]
mod inputs;
mod stages;

use divan::Bencher;
use inputs::{growing, gsdml, DRIVE};
use stages::SIZES;

/// Submodules, of 500 parameters each.
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
