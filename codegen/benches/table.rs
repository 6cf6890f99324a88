//! Measures the stages from the bytes of a register table to Rust.
//!
//! `inputs` creates the files: 32-bit registers with six bit fields each.

#[path = "inputs/table.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.toml");
