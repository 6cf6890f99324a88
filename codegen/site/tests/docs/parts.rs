//! Tests the anchors of bits and values, and the links between them and the items on which their meaning depends.

use crate::docs_support::{files, html_links, markdown_links};
use lexibus_site::{Format, Page};

/// Anchors of bits with several meanings, of a bit with one meaning, and of values.
const ANCHORS: [&str; 7] = [
    "0x6040.bit-4-new-set-point",
    "0x6040.bit-4-homing-operation-start",
    "0x6040.bit-4-jog",
    "0x6040.bit-4-jog.value-1",
    "0x6040.bit-6-target.value-0",
    "0x6040.bit-7",
    "0x6060.value-6",
];

/// Returns the profile objects of the Vector Step.
fn profile_objects(format: Format, check: fn(&[Page]) -> usize) -> String {
    let pages = files(format, &["dictionaries/aec-vector-step.toml"]);
    check(&pages);
    pages.into_iter().find(|page| page.path.contains("/profile-objects.")).expect("the objects").text
}

#[test]
fn bits_and_values_have_anchors() {
    for (format, check) in [(Format::Html, html_links as fn(&[Page]) -> usize), (Format::Markdown, markdown_links)] {
        let text = profile_objects(format, check);
        for anchor in ANCHORS {
            assert_eq!(text.matches(&format!(" id=\"{anchor}\"")).count(), 1, "{anchor}");
        }
    }
}

#[test]
fn conditions_are_linked_in_both_directions() {
    let html = profile_objects(Format::Html, html_links);
    let row = |id: &str| {
        let (_, row) = html.split_once(&format!("<tbody id=\"{id}\"")).expect("a row");
        row.split_once("</tbody>").expect("its end").0
    };
    let control_word = "<b>Depends on</b> <a href=\"profile-objects.html#0x6060\">0x6060 Modes of operation</a>";
    assert!(row("0x6040").contains(control_word), "{}", row("0x6040"));
    let bit = "<a href=\"profile-objects.html#0x6040.bit-4-new-set-point\">0x6040 Controlword: bit 4 new set-point</a>";
    assert!(row("0x6060").contains(bit), "{}", row("0x6060"));
    let markdown = profile_objects(Format::Markdown, markdown_links);
    let bit = "[0x6040 Controlword: bit 4 new set-point](profile-objects.md#0x6040.bit-4-new-set-point)";
    assert!(markdown.contains(bit), "{markdown}");
}
