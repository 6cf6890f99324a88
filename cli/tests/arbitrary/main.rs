//! Generates random catalogs of IR. If a catalog has no errors, its generated Rust code must compile without warnings.
//!
//! `LEXIBUS_ARBITRARY=5000` tests 5,000 random catalogs. `LEXIBUS_ARBITRARY=7..8` tests the catalog of seed 7 and prints its
//! generated code.

#[path = "../../../tests/support/arbitrary_ir/mod.rs"]
mod arbitrary_ir;
#[path = "../../../codegen/tests/compile_support/mod.rs"]
mod compile_support;
#[path = "../../../codegen/site/tests/docs_support/mod.rs"]
mod docs_support;
#[path = "../../../tests/support/lane.rs"]
mod lane;
mod outputs;
#[path = "../../../tests/support/seed.rs"]
mod seed;

use std::collections::BTreeSet;
use std::ops::Range;

use arbitrary_ir::bytes::Bytes;
use compile_support::{check_with_traits, compile_modules, document};
use docs_support::{html_links, html_markup, markdown_links, markdown_markup};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Catalog, Device, Format, Group};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};
use outputs::Outputs;

/// Number of catalogs in the full lane. The fast lane tests a sixteenth of this number.
const DRAWN: u64 = 400;

/// Default number of catalogs for which all outputs other than Rust are created.
const OUTPUTS: usize = 30;

/// Number of catalogs whose generated code implements traits of other crates.
const WITH_TRAITS: usize = 60;

/// Number of catalogs whose generated code is documented with rustdoc.
const DOCUMENTED: usize = 30;

/// Number of generated modules that are compiled together.
const BATCH: usize = 60;

/// Number of random bytes from which a catalog is created.
const BYTES: usize = 8000;

fn seeds() -> Range<u64> {
    let Ok(wanted) = std::env::var("LEXIBUS_ARBITRARY") else {
        return 0..if lane::is_full() { DRAWN } else { DRAWN / 16 };
    };
    let number = |text: &str| text.parse().expect("a number of seeds, or a range of seeds");
    match wanted.split_once("..") {
        Some((first, end)) => number(first)..number(end),
        None => 0..number(&wanted),
    }
}

/// Returns random options for generating Rust.
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

/// Returns the checked catalog and the Rust options for a seed.
fn drawn(seed: u64) -> (Compilation, RustOptions) {
    let bytes = seed::bytes(seed, BYTES);
    let (chosen, described) = bytes.split_at(100);
    (arbitrary_ir::compilation(described, &Options::default()), options(&mut Bytes::new(chosen)))
}

/// Returns the Rust code for a seed. Returns `None` if the catalog has errors or contains nothing to generate.
fn module(seed: u64) -> Option<String> {
    let (compilation, options) = drawn(seed);
    compilation.rust(&options)
}

#[test]
fn what_passes_the_lints_compiles() {
    let seeds = seeds();
    let drawn = seeds.end - seeds.start;
    let kept: Vec<(String, String)> = seeds.filter_map(|seed| Some((format!("seed_{seed}"), module(seed)?))).collect();
    println!("{} of {drawn} catalogs kept", kept.len());
    if let [(name, text)] = kept.as_slice() {
        println!("// {name}\n{text}");
    }
    let failures: Vec<String> = kept.chunks(BATCH).filter_map(|batch| compile_modules(batch).err()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    // If fewer than 100 catalogs are tested, at least 80 % instead of 90 % of them must have no errors. The share
    // varies more in small samples.
    let tenths = if drawn < 100 { 8 } else { 9 };
    assert!(kept.len() as u64 * 10 >= drawn * tenths, "only {} of {drawn} catalogs have no errors", kept.len());
}

#[test]
fn traits_of_other_crates_are_derived_for_it() {
    if lane::skips("a build outside of the workspace") {
        return;
    }
    let options = |seed| RustOptions { serde: Presence::Always, defmt: Presence::Always, ..drawn(seed).1 };
    let module = |seed| Some((format!("seed_{seed}"), drawn(seed).0.rust(&options(seed))?));
    let kept: Vec<(String, String)> = some(WITH_TRAITS).filter_map(module).collect();
    check_with_traits(&kept).unwrap_or_else(|message| panic!("{message}"));
    let count = |text: &str| kept.iter().map(|(_, module)| module.matches(text).count()).sum::<usize>();
    assert!(count("serde::Serialize") > kept.len() && count("defmt::Format") > kept.len());
}

/// For some catalogs, creates all outputs except Rust. Returns the seed, the compilation and these outputs for each of
/// these catalogs.
fn outputs() -> impl Iterator<Item = (u64, Compilation, Outputs)> {
    some(OUTPUTS).map(|seed| {
        let (compilation, _) = drawn(seed);
        let outputs = outputs::others(&compilation);
        (seed, compilation, outputs)
    })
}

/// Returns the first `most` seeds, or all seeds that `LEXIBUS_ARBITRARY` selects.
fn some(most: usize) -> impl Iterator<Item = u64> {
    let all = std::env::var_os("LEXIBUS_ARBITRARY").is_some();
    seeds().take(if all { usize::MAX } else { most })
}

#[test]
fn pages_have_no_markup_of_a_description_and_no_broken_link() {
    let (mut links, mut pages) = (0, 0);
    for (seed, _, made) in outputs() {
        println!("seed {seed}");
        html_markup(&made.html);
        markdown_markup(&made.markdown);
        links += html_links(&made.html) + markdown_links(&made.markdown);
        pages += made.html.len() + made.markdown.len();
    }
    assert!(pages > 10 && links > pages, "{links} links on {pages} pages");
}

/// Returns the indices of a device's objects.
fn indices(device: &Device) -> BTreeSet<u16> {
    device.groups.iter().filter_map(Group::index).collect()
}

/// Reads an exported file as a catalog.
fn again(name: &str, text: &str) -> Catalog {
    let read = check(Source::new(name, text.into()), &Options::default());
    let messages: Vec<String> = read.diagnostics.list().iter().map(|found| read.one_line(found)).collect();
    read.catalog.unwrap_or_else(|| panic!("{name}: {messages:?}\n{text}"))
}

#[test]
fn exports_are_read_again() {
    let mut read = [0; 3];
    for (seed, compilation, made) in outputs() {
        let catalog = compilation.catalog.as_ref().expect("a catalog");
        let dumped: serde_json::Value = serde_json::from_str(&made.dump).expect("JSON");
        assert_eq!(dumped["devices"].as_array().map(Vec::len), Some(catalog.devices.len()), "seed {seed}");
        for (at, text) in &made.eds {
            let (original, again) = (indices(&catalog.devices[*at]), again("again.eds", text));
            let exported = indices(&again.devices[0]);
            // An export may add objects for registers, and objects that describe PDOs.
            let has_registers = catalog.files[0].format == Format::Table;
            let is_made = |index: &&u16| has_registers || (0x1400..0x1C00).contains(*index);
            let more: Vec<&u16> = exported.difference(&original).filter(|index| !is_made(index)).collect();
            assert!(more.is_empty(), "seed {seed}: {more:04X?} in\n{text}");
            read[0] += 1;
        }
        if let Some(text) = &made.esi {
            assert!(again("again.xml", text).devices.len() <= catalog.devices.len(), "seed {seed}:\n{text}");
            read[1] += 1;
        }
        if let Some(text) = &made.gsdml {
            assert!(again("GSDML-again.xml", text).devices.len() <= catalog.devices.len(), "seed {seed}:\n{text}");
            read[2] += 1;
        }
    }
    assert!(read.iter().all(|&number| number > 0), "EDS, ESI, GSDML: {read:?}");
}

#[test]
fn what_compiles_is_documented_without_a_broken_link() {
    let rust = RustOptions { table: Presence::Always, ..RustOptions::default() };
    let texts: Vec<(u64, String)> =
        some(DOCUMENTED).filter_map(|seed| Some((seed, drawn(seed).0.rust(&rust)?))).collect();
    let modules: Vec<&str> = texts.iter().map(|(_, text)| text.as_str()).collect();
    let seeds: Vec<u64> = texts.iter().map(|(seed, _)| *seed).collect();
    document(&format!("one of the seeds {seeds:?}"), &modules).unwrap_or_else(|message| panic!("{message}"));
}
