//! Any IR that passes the lints emits Rust that compiles without a warning.
//!
//! `LEXIBUS_ARBITRARY=5000` draws so many catalogues; `LEXIBUS_ARBITRARY=7..8` draws the one of seed 7, and prints its code.

mod arbitrary_ir;
mod compile_support;

use std::ops::Range;

use arbitrary_ir::bytes::Bytes;
use compile_support::{compile_modules, document};
use lexibus_codegen::compile::{Compilation, Options};
use lexibus_codegen::{Presence, RustOptions};

/// How many catalogues are drawn where nobody asks for more.
const DRAWN: u64 = 200;

/// Of so many of them, all other outputs are made.
const OUTPUTS: usize = 30;

/// So many of them are documented.
const DOCUMENTED: usize = 30;

/// Modules that are compiled together.
const BATCH: usize = 60;

/// Bytes of a catalogue.
const BYTES: usize = 6000;

fn seeds() -> Range<u64> {
    let Ok(wanted) = std::env::var("LEXIBUS_ARBITRARY") else { return 0..DRAWN };
    let number = |text: &str| text.parse().expect("a number of seeds, or a range of them");
    match wanted.split_once("..") {
        Some((first, end)) => number(first)..number(end),
        None => 0..number(&wanted),
    }
}

/// The bytes of a seed: xorshift64*, whose stream no release of a crate changes.
fn bytes(seed: u64) -> Vec<u8> {
    let mut state = (seed + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mut next = || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        state.wrapping_mul(0x2545_F491_4F6C_DD1D).to_be_bytes()[0]
    };
    (0..BYTES).map(|_| next()).collect()
}

/// Choices of a user.
fn options(b: &mut Bytes<'_>) -> RustOptions {
    let presence = |b: &mut Bytes<'_>| match b.within(0..=3) {
        0 => Presence::Never,
        1 => Presence::Feature("optional".into()),
        _ => Presence::Always,
    };
    let feature = |b: &mut Bytes<'_>| match b.one_in(3) {
        true => Presence::Feature("optional".into()),
        false => Presence::Never,
    };
    RustOptions {
        device_name: b.maybe(6, |b| b.pick(&["Drive", "Self", "type", "2nd", "", "Some"]).to_owned()),
        accessors: !b.one_in(4),
        pdos: !b.one_in(6),
        table: presence(b),
        debug: presence(b),
        partial_eq: presence(b),
        defmt: feature(b),
        serde: feature(b),
        ..RustOptions::default()
    }
}

/// The catalogue of a seed, checked, and choices of a user.
fn drawn(seed: u64) -> (Compilation, RustOptions) {
    let bytes = bytes(seed);
    let (chosen, described) = bytes.split_at(100);
    (arbitrary_ir::compilation(described, &Options::default()), options(&mut Bytes::new(chosen)))
}

/// The Rust of a seed; `None` where the catalogue has errors or nothing that code could be generated for.
fn module(seed: u64) -> Option<String> {
    let (compilation, options) = drawn(seed);
    compilation.rust(&options)
}

#[test]
fn what_passes_the_lints_compiles() {
    let seeds = seeds();
    let drawn = seeds.end - seeds.start;
    let kept: Vec<(String, String)> = seeds.filter_map(|seed| Some((format!("seed_{seed}"), module(seed)?))).collect();
    println!("{} of {drawn} catalogues kept", kept.len());
    if let [(name, text)] = kept.as_slice() {
        println!("// {name}\n{text}");
    }
    let failures: Vec<String> = kept.chunks(BATCH).filter_map(|batch| compile_modules(batch).err()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(kept.len() as u64 * 10 >= drawn * 9, "only {} of {drawn} catalogues have no errors", kept.len());
}

#[test]
fn no_output_of_what_was_read_panics() {
    for seed in seeds().take(OUTPUTS) {
        let (compilation, _) = drawn(seed);
        assert!(arbitrary_ir::outputs::others(&compilation) > 0, "seed {seed}");
    }
}

#[test]
fn what_compiles_is_documented_without_a_broken_link() {
    let rust = RustOptions { table: Presence::Always, ..RustOptions::default() };
    let texts: Vec<(u64, String)> =
        seeds().take(DOCUMENTED).filter_map(|seed| Some((seed, drawn(seed).0.rust(&rust)?))).collect();
    let modules: Vec<&str> = texts.iter().map(|(_, text)| text.as_str()).collect();
    let seeds: Vec<u64> = texts.iter().map(|(seed, _)| *seed).collect();
    document(&format!("one of the seeds {seeds:?}"), &modules).unwrap_or_else(|message| panic!("{message}"));
}
