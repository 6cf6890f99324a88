//! Tests register tables that combine parts of the examples in the documentation.

#[path = "../../../codegen/tests/table_support/mod.rs"]
mod table_support;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::render;
use lexibus_codegen::source::Source;
use lexibus_export::json;
use proptest::prelude::*;
use proptest::sample::Index;
use table_support::{examples, whole};

/// Returns the lines of all examples in the documentation, without repetitions.
fn pieces() -> Vec<String> {
    let mut lines: Vec<String> =
        examples().iter().flat_map(|(_, block)| whole(block).lines().map(str::to_owned).collect::<Vec<_>>()).collect();
    lines.sort();
    lines.dedup();
    lines
}

/// Generates a TOML value.
fn value() -> impl Strategy<Value = String> {
    const VALUES: [&str; 34] = [
        "0",
        "1",
        "-1",
        "65536",
        "0xFFFFFFFFFFFFFFFF",
        "9223372036854775807",
        "-9223372036854775808",
        "1e308",
        "nan",
        "-inf",
        "true",
        "\"\"",
        "\"u64\"",
        "\"u64[4294967295]\"",
        "\"str(4294967295)\"",
        "\"0x2000:255\"",
        "\"0x0000..0xFFFF\"",
        "\"0..4294967295\"",
        "\"63-0\"",
        "\"$NODEID\"",
        "\"$x\"",
        "\"{n+99999999999}\"",
        "\"item\"",
        "\"pad/4294967295\"",
        "[]",
        "[[]]",
        "[1, \"a\"]",
        "{}",
        "{ a = 1 }",
        "{ name = \"x\" }",
        "1979-05-27",
        "\"\\u0000\"",
        "\"é\"",
        "4294967295",
    ];
    prop::sample::select(&VALUES[..]).prop_map(str::to_owned)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Any table must be read, checked and, if it has no errors, compiled without a panic.
    #[test]
    fn mutated_tables_do_not_panic(
        block in 0usize..128,
        changes in prop::collection::vec((any::<Index>(), 0u8..5, value(), any::<Index>()), 1..8),
    ) {
        let examples = examples();
        let pieces = pieces();
        let mut lines: Vec<String> = whole(&examples[block % examples.len()].1).lines().map(str::to_owned).collect();
        for (position, kind, value, other) in changes {
            if lines.is_empty() {
                break;
            }
            let at = position.index(lines.len());
            match kind {
                0 => drop(lines.remove(at)),
                1 => lines.insert(at, pieces[other.index(pieces.len())].clone()),
                // Replace the value after an equals sign.
                2 | 3 => {
                    let places: Vec<usize> = lines[at].match_indices(" = ").map(|(at, _)| at + 3).collect();
                    let Some(&start) = places.get(other.index(places.len().max(1))) else { continue };
                    let rest = &lines[at][start..];
                    let end = start + rest.find([',', '}', '#']).unwrap_or(rest.len());
                    lines[at].replace_range(start..end, &(value + " "));
                }
                _ => lines[at] = lines[at].chars().rev().collect(),
            }
        }
        let text = lines.join("\n");
        let compilation = check(Source::new("t.toml", text.into()), &Options::default());
        for diagnostic in compilation.diagnostics.list().iter().take(20) {
            render::terminal::render(diagnostic, &compilation.sources, false);
        }
        json::info(&compilation);
        let _ = compilation.rust(&Options::default().rust);
    }
}
