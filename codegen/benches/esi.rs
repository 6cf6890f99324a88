//! Measures all stages from the bytes of an ESI file to Rust code. Also compares the time for compiling to checked IR
//! with the times of two loops over the XML events. The second loop also splits the attributes.
//!
//! The module `inputs` creates the files. The devices in these files have dictionaries, PDOs and sync managers in the
//! proportions of real files.

mod bare;
#[path = "inputs/esi.rs"]
mod inputs;
mod stages;

use divan::Bencher;
use inputs::{esi, growing, DRIVE};
use stages::SIZES;

/// Number of drives in a file of 5 MB.
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
