//! From the bytes of an ESI file to Rust, stage by stage, and before that how the way to checked IR compares with a bare loop over
//! the events of the same bytes.
//!
//! The inputs are made by `inputs`: devices with dictionaries, PDOs and sync managers in the proportions of real files.

mod bare;
#[path = "inputs/esi.rs"]
mod inputs;
mod stages;

use divan::Bencher;
use inputs::{esi, growing, DRIVE};
use stages::SIZES;

/// Enough for 5 MB.
const DEVICES: usize = 29;

fn main() {
    bare::report(&format!("{DEVICES} devices with dictionaries"), &[esi(DEVICES, DRIVE).into_bytes()]);
    bare::report_corpus("esi");
    divan::main();
}

#[divan::bench(args = SIZES, max_time = 2)]
fn bare_events(bencher: Bencher<'_, '_>, size: usize) {
    bare::measure(bencher, growing(size));
}

stages::measure!("bench.xml");
