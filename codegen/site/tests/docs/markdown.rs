//! Tests the Markdown output: valid links, escaped texts and a summary of all pages.

use std::collections::BTreeSet;

use crate::docs_support::{files, hostile, markdown_links, markdown_markup, pages, site, ALL};
use lexibus_codegen::source::Source;
use lexibus_site::Format;

#[test]
fn all_links_are_valid() {
    let count = markdown_links(&files(Format::Markdown, &ALL));
    assert!(count > 2000, "only {count} links");
}

#[test]
fn the_summary_has_every_page_once() {
    let all = files(Format::Markdown, &ALL);
    let (_, summary) = pages(&all).find(|(page, _)| page.path == "SUMMARY.md").expect("a summary");
    let listed: BTreeSet<&str> = summary.links.iter().map(String::as_str).collect();
    assert_eq!(listed.len(), summary.links.len(), "a page is listed twice");
    let written: BTreeSet<&str> =
        all.iter().map(|page| page.path.as_str()).filter(|path| *path != "SUMMARY.md").collect();
    assert_eq!(listed, written);
}

#[test]
fn nothing_of_a_description_is_markup() {
    let all = site(Format::Markdown, hostile::descriptions());
    markdown_markup(&all);
    let shown: usize = pages(&all).map(|(_, seen)| seen.text.matches("alert(1)").count()).sum();
    assert!(shown > 60, "only {shown} texts are shown");
    // The characters `<;#%(` have a meaning in Mermaid diagrams, so texts must not contain them.
    let machines =
        all.iter().find(|page| page.path.ends_with("/no-revision/states-and-procedures.md")).expect("machines");
    let (_, rest) = machines.text.split_once("```mermaid\n").expect("a diagram");
    let (diagram, _) = rest.split_once("```").expect("its end");
    assert!(diagram.contains("s1 --> s0: ") && !diagram.contains(['<', ';', '#', '%', '(']), "{diagram}");
}

#[test]
fn rows_of_tables_have_one_cell_a_column() {
    for page in files(Format::Markdown, &ALL) {
        let mut columns = None;
        for (number, line) in page.text.lines().enumerate() {
            // An escaped `|` does not end a table cell.
            let cells = line.starts_with('|').then(|| line.replace("\\\\", "").replace("\\|", "").matches('|').count());
            if let Some((expected, cells)) = columns.zip(cells) {
                assert_eq!(expected, cells, "{}:{}: {line}", page.path, number + 1);
            }
            columns = cells;
        }
    }
}

#[test]
fn a_page_of_registers() {
    let table = "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"modbus\"]\n[manual]\nlanguage = \"it\"\ncites = \"page\"\n\
                 [spaces.register]\nmodbus = { table = \"holding\" }\n[[chapters]]\ntitle = \"Control\"\ndoc = \"What is wanted\"\n[chapters.registers]\n\
                 speed = { reg = 1, type = \"i16\", access = \"rw\", unit = \"rpm\", scale = 0.1, min = -300, max = 300, default = 0, orig = \"velocità\", cite = 4, save = true }\n\
                 control = { reg = 2, type = \"u8\", access = \"rw\", bits = { 0 = \"on\", \"3-2\" = { name = \"mode\", values = { 1 = \"slow | fast\" } } }, \
                 doubt = { says = \"Two tables differ\", chose = \"the first\", why = \"it has more\" } }\n\
                 [machines.axis]\nstatus = \"control\"\ncontrol = \"control\"\ninitial = \"idle\"\n[machines.axis.states]\nidle = { mask = 1, value = 0 }\nmoving = { mask = 1, value = 1 }\n\
                 [machines.axis.commands]\nstart = { mask = 1, value = 1 }\n[[machines.axis.transitions]]\nfrom = \"idle\"\nto = \"moving\"\ncommand = \"start\"\n";
    let pages = site(Format::Markdown, vec![("pump".to_owned(), Source::new("pump.toml", table.into()))]);
    let text =
        |end: &str| pages.iter().find(|page| page.path.ends_with(end)).unwrap_or_else(|| panic!("{end}")).text.as_str();
    insta::assert_snapshot!("markdown_area", text("/control.md"));
    insta::assert_snapshot!("markdown_machines", text("/states-and-procedures.md"));
    insta::assert_snapshot!("markdown_summary", text("SUMMARY.md"));
}

#[test]
fn modules_with_node_ids_have_a_note() {
    let has_note = |path: &str, request: &str| {
        let all = files(Format::Markdown, &[path]);
        let mut modules = all.iter().filter(|page| page.path.contains("/modules"));
        let page = modules.find(|page| page.text.contains(request)).expect("modules with requests");
        page.text.contains("\nRequests have node-ID 1 and Modbus unit 1.")
    };
    assert!(has_note("tests/data/coupler.esi.xml", "pysoem read"));
    assert!(!has_note("tests/data/safe.gsdml.xml", "PROFINET record"));
}
