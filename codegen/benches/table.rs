//! From the bytes of a register table to Rust, stage by stage.
//!
//! The inputs are made by `inputs`: registers of 32 bits with six bit fields each.

#[path = "inputs/table.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.toml");
