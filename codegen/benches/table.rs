//! From the bytes of a register table to Rust, stage by stage.
//!
//! The inputs are made by `inputs`: registers of 32 bits with six bit fields each.

#[path = "inputs/table.rs"]
mod inputs;
mod stages;

use divan::Bencher;
use inputs::growing;
use stages::SIZES;

fn main() {
    divan::main();
}

#[divan::bench(args = SIZES, max_time = 2)]
fn read(bencher: Bencher<'_, '_>, size: usize) {
    stages::read(bencher, "bench.toml", growing(size));
}

#[divan::bench(args = SIZES, max_time = 2)]
fn passes(bencher: Bencher<'_, '_>, size: usize) {
    stages::passes(bencher, "bench.toml", growing(size));
}

#[divan::bench(args = SIZES, max_time = 2)]
fn check(bencher: Bencher<'_, '_>, size: usize) {
    stages::check(bencher, "bench.toml", growing(size));
}

#[divan::bench(args = SIZES, max_time = 2)]
fn emit(bencher: Bencher<'_, '_>, size: usize) {
    stages::emit(bencher, "bench.toml", growing(size));
}
