//! From the bytes of an XDD to Rust, stage by stage.
//!
//! The inputs are made by `inputs`: records of nine entries, 10 of them at first, half of which are parameters of the application process.

#[path = "inputs/xdd.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.xdd");
