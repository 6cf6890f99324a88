//! Measures all stages from the bytes of a register table to Rust code.
//!
//! The module `inputs` creates the files. Each file contains 32-bit registers with six bit fields each.

#[path = "inputs/table.rs"]
mod inputs;
mod stages;

use inputs::growing;

fn main() {
    divan::main();
}

stages::measure!("bench.toml");
