//! Measures the stages from the bytes of an XDD to Rust.
//!
//! `inputs` creates the files: records of nine entries, starting with 10 records. Half of the entries are parameters of the
//! application process.

#[path = "inputs/xdd.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.xdd");
