//! Measures all stages from the bytes of an XDD to Rust code.
//!
//! The module `inputs` creates the files. Each file consists of records with nine entries. The smallest file has 10
//! records. In each record, every second value is a parameter of the application process.

#[path = "inputs/xdd.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.xdd");
