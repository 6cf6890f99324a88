//! Tests the documentation of generated Rust. All links must be valid, rustdoc must report nothing, and no text of a
//! description may break its table cell.

use crate::compile_support;
use crate::corpus_support;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use compile_support::{document, page};
use corpus_support::bindings::on_all_processors;
use corpus_support::lane;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::selection::Selection;
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the paths of the descriptions in `tests/data` and `dictionaries`.
fn examples() -> Vec<PathBuf> {
    let folders = ["tests/data", "dictionaries"].map(|name| repository().join(name));
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("a folder of the repository"));
    let is_description = |path: &PathBuf| {
        ["toml", "eds", "xml"].iter().any(|ending| path.extension().is_some_and(|entry| entry == *ending))
    };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).filter(is_description).collect();
    paths.sort();
    assert!(paths.len() >= 14, "{paths:?}");
    paths
}

fn read(path: &Path, options: &Options) -> Compilation {
    check(Source::read(path).expect("the example"), options)
}

/// Generated documentation must not link to a part that is left out of the output.
#[test]
fn rustdoc_has_nothing_to_say_of_the_examples() {
    let everything = || RustOptions { table: Presence::Always, ..RustOptions::default() };
    let choices = [
        everything(),
        RustOptions { accessors: false, ..everything() },
        RustOptions { pdos: false, ..RustOptions::default() },
    ];
    let mut examples = examples();
    // In the fast lane, skip the drives, because rustdoc already runs on the crate `lexibus-drives`.
    examples.retain(|path| lane::is_full() || path.parent().is_some_and(|folder| folder.ends_with("data")));
    on_all_processors(examples, |path| {
        let compilation = read(&path, &Options::default());
        // Use only one set of options for the drives, because rustdoc also runs on the crate `lexibus-drives`.
        let chosen =
            if path.parent().is_some_and(|entry| entry.ends_with("data")) { &choices[..] } else { &choices[1..2] };
        let texts: Vec<String> = chosen.iter().filter_map(|entry| compilation.rust(entry)).collect();
        assert_eq!(texts.len(), chosen.len(), "{}", path.display());
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        document(&path.display().to_string(), &texts).unwrap_or_else(|message| panic!("{message}"));
    });
}

#[test]
fn what_is_not_selected_is_not_linked() {
    let of = |name: &str, objects: &str| {
        let objects = vec![objects.parse().expect("a range of objects")];
        let select = Selection { objects, ..Selection::default() };
        let compilation = read(&repository().join(name), &Options { select, ..Options::default() });
        compilation.rust(&RustOptions::default()).expect("bindings")
    };
    let drive = of("dictionaries/demo-drive.eds", "0x6040..0x6060");
    assert!(drive.contains("Mapped in [`RxPdo1`](pdo::RxPdo1)") && !drive.contains("MODES_OF_OPERATION_DISPLAY"));
    let press = of("tests/data/press.toml", "0x2008");
    document("selected", &[&drive, &press]).unwrap_or_else(|message| panic!("{message}"));
}

/// Objects that a description mentions must become links. The path of a link is relative to the item.
#[test]
fn references_are_links() {
    let of = |name: &str| {
        let compilation = read(&repository().join(name), &Options::default());
        compilation.rust(&RustOptions::default()).expect("bindings")
    };
    for (name, lines) in [
        (
            "tests/data/press.toml",
            &[
                "    /// Constant: [`objects::CONTROL`]. Value type: [`Control`](types::Control).",
                "    /// View of [`Control`] with the bits that are defined while [mode](super::objects::MODE) is \"press\" (1).",
                "    /// States of ram, read from [status](super::objects::STATUS).",
                "    /// | [`Ready`](Self::Ready) | `xxxx xxxx xxxx x001` |",
                "    /// force: Physical value = raw × 0.5 / [gain](GAIN) N, 0x200C:01, Modbus 12 (holding; wire address 12; FC 3), INTEGER16, read-only.",
                "    /// Removed in firmware 2\\.0. Replaced by [position](POSITION_8).",
            ][..],
        ),
        (
            "tests/data/hoist.toml",
            &[
                "    /// The message has this meaning only after [Select load](messages::SelectLoad) was sent.",
                "    /// The message has this meaning only after [Select load](SelectLoad) was sent.",
                "    /// Replaced by [Go](messages::Go).",
                "    /// Sends the message [`messages::Go`].",
            ],
        ),
        (
            "tests/data/one-drive.toml",
            &["    /// Window on CANopen: [Read address](super::objects::reading::READ_ADDRESS) receives the number of an item, and \
               [Read value](super::objects::reading::READ_VALUE) returns the value of this item."],
        ),
        (
            "dictionaries/eco.toml",
            &["    /// The view has the fields of [`pdo::Velocity`](super::pdo::Velocity).", "    /// Constant: [`objects::P1`]. Part of the composite number [`PULSES_PER_TURN`]."],
        ),
        (
            "dictionaries/demo-drive.eds",
            &[
                "    /// | 2–5 | [`target_position`](Self::target_position) | [0x607A:00](super::objects::TARGET_POSITION) | `i32` |",
                "        /// Accessor: [`IdentityObjectAccessors::vendor_id`].",
            ],
        ),
    ] {
        let text = of(name);
        for line in lines {
            assert!(text.lines().any(|entry| entry == *line), "{name}: {line}");
        }
    }
}

const HOSTILE: &str = r#"
lexibus = 1
[device]
name = "X"
[spaces.register]
modbus = { table = "holding" }
[[chapters]]
title = "C | [x](y)"
[chapters.registers]
mode = { reg = 0, type = "u8", access = "rw", enum = "Mode" }
"P|1" = { reg = 1, type = "u16", access = "rw", bits = "Status", doc = "a | b [`mode`](Self::mode) <b>" }
MODE_2 = { reg = 2, type = "u8", access = "rw", doc = "ends with \\", when = { "P|1" = [1] } }
[enums.Mode.values]
0 = "a | b"
1 = { name = "\\| [mode](mode) `x", doc = "\\" }
2 = { name = "| - | - |", doc = "| 7 | [`Mode`] |\n\n| x |" }
[bits.Status.at]
0 = { name = "x || y", doc = "`|` \\| $[`mode`] <script> &#124; https://x.y" }
1 = "] (Self::x) |"
"3-2" = { name = "m", values = { 0 = "type", 1 = "]|[" } }
4 = { reserved = 0 }
"#;

/// Returns the cells in each row of the first table on a page.
fn cells(page: &str) -> Vec<Vec<&str>> {
    let table = page.split_once("<tbody>").and_then(|(_, rest)| rest.split_once("</tbody>")).expect("a table").0;
    let rows = table.split("<tr>").skip(1);
    rows.map(|row| row.split("<td>").skip(1).map(|cell| cell.split_once("</td>").expect("a cell").0).collect())
        .collect()
}

#[test]
fn no_text_breaks_out_of_its_cell() {
    let compilation = check(Source::new("hostile.toml", HOSTILE.into()), &Options::default());
    let messages: Vec<String> =
        compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect();
    let text = compilation.rust(&RustOptions::default()).unwrap_or_else(|| panic!("{messages:#?}"));
    let of_type =
        |name: &str| page("hostile", &text, &format!("types/{name}.html")).unwrap_or_else(|entry| panic!("{entry}"));
    let (values, bits) = (of_type("enum.Mode"), of_type("struct.Status"));
    let values = cells(&values);
    assert_eq!(values.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3, 3], "{values:#?}");
    assert_eq!(values[0][2], "a | b.");
    assert!(values[1][2].starts_with(r"\| [mode](mode) `x. \"), "{values:#?}");
    assert_eq!(values[2][2], "| - | - |. | 7 | [`Mode`] | | x |.");
    let bits = cells(&bits);
    assert_eq!(bits.iter().map(Vec::len).collect::<Vec<_>>(), [3; 4], "{bits:#?}");
    assert_eq!(bits[0][2], r"x || y. `|` \| $[`mode`] &lt;script&gt; &amp;#124; https://x.y.");
    assert!(bits[2][2].contains("enum.StatusM.html"), "the values of a field are linked: {bits:#?}");
    assert_eq!(bits[3][1..], ["reserved", "A write to an item sets the value 0."]);
}

/// Time limit for running rustdoc on corpus files. The first five devices of each format are not subject to the limit.
const TIME: Duration = Duration::from_secs(25);

/// Maximum number of devices per file for which rustdoc runs.
const DEVICES: usize = 2;

#[test]
fn rustdoc_has_nothing_to_say_of_a_sample_of_the_corpus() {
    if lane::skips("rustdoc of the corpus") {
        return;
    }
    let end = Instant::now() + TIME;
    for (format, step) in [("eds", 9), ("esi", 7), ("gsdml", 5)] {
        let Some(files) = corpus_support::files_of(format) else { return };
        let files = files.into_iter().step_by(step).collect();
        let (seen, documented) = (Mutex::new(HashMap::<String, usize>::new()), AtomicUsize::new(0));
        corpus_support::bindings::each(files, &Options::default(), |name, text| {
            let number = {
                *seen.lock().expect("the files").entry(name.to_owned()).and_modify(|entry| *entry += 1).or_insert(1)
            };
            if number > DEVICES || Instant::now() > end && documented.load(Ordering::Relaxed) >= 5 {
                return Ok(());
            }
            documented.fetch_add(1, Ordering::Relaxed);
            document(name, &[text])
        });
        println!("{format}: {} devices", documented.into_inner());
    }
}
