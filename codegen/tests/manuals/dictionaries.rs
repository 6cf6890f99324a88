//! Tests the four dictionaries that were transcribed from the manuals of drives.

use crate::doubts;
use crate::manual_text;

use std::collections::{BTreeSet, HashSet};

use lexibus_codegen::ir::{Binding, Catalog, Device, Item};

/// The file names of dictionaries, with the names of their manuals.
const DRIVES: [(&str, &str); 4] = [
    ("aec-vector-step.toml", "aec-vector-step-canopen.it.txt"),
    ("eco.toml", "eco-fieldbuses.it.txt"),
    ("hsd-sm137-sm140.toml", "hsd-sm137-sm140-rs485.it.txt"),
    ("kollmorgen-akd.toml", "kollmorgen-akd-ethercat.it.txt"),
];

fn device(catalog: &Catalog) -> &Device {
    catalog.devices.first().expect("a device")
}

fn items(catalog: &Catalog) -> impl Iterator<Item = &Item> {
    device(catalog).groups.iter().flat_map(|group| &group.items)
}

/// Returns the heading from a line of a table of contents, for example `VARIE` from `VARIE<tab>183`. Returns `None` if the line
/// does not end with a tab and a page number.
fn heading_of_contents(line: &str) -> Option<&str> {
    let (heading, page) = line.trim_end().rsplit_once('\t')?;
    page.trim().parse::<u32>().ok().map(|_| heading)
}

/// Converts a text to lowercase with single spaces.
fn normal(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase()
}

#[test]
fn every_register_has_a_description() {
    for (file, _) in DRIVES {
        let catalog = doubts::catalog(file);
        let is_described =
            |item: &&Item| item.documentation.as_ref().is_some_and(|documentation| !documentation.text.is_empty());
        let missing: Vec<_> =
            items(&catalog).filter(|item| !is_described(item)).map(|item| item.name.clone()).collect();
        assert!(missing.is_empty(), "{file}: {missing:?}");
        assert!(items(&catalog).count() > 90, "{file}");
    }
}

#[test]
fn every_doubt_has_a_severity_and_a_citation() {
    for (file, _) in DRIVES {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries").join(file);
        let text = std::fs::read_to_string(path).expect("the dictionary");
        let count = |mark: &str| text.matches(mark).count();
        assert_eq!(count("says = "), count("severity = "), "{file}");
        let doubts = doubts::doubts(&doubts::catalog(file));
        assert!(doubts.len() > 100, "{file}: {} doubts", doubts.len());
        for doubt in doubts {
            assert!(doubt.cite.is_some(), "{file}: {}", doubt.says);
            let words = [&doubt.says, &doubt.chosen, &doubt.why];
            let names_line = |text: &&String| {
                let mut rest = text.match_indices("(L").map(|(at, _)| &text[at + 2..]);
                rest.any(|rest| rest.starts_with(|letter: char| letter.is_ascii_digit()))
            };
            assert!(!words.iter().any(names_line), "{file} mentions a line number in: {}", doubt.says);
        }
    }
}

#[test]
fn sections_are_titles_of_the_manual() {
    for (file, manual) in DRIVES {
        let Some(text) = manual_text::text(manual) else { return };
        let lines: Vec<String> = text.lines().map(normal).collect();
        let catalog = doubts::catalog(file);
        let manual = device(&catalog).manual.as_deref().expect("the manual");
        assert!(manual.sections.len() > 50, "{file}: {} sections", manual.sections.len());
        // If the extracted text lacks a heading, the table of contents contains it, with spaces between large and small
        // capitals.
        let bare = |text: &str| normal(text).replace(' ', "");
        let contents: HashSet<String> = text.lines().filter_map(heading_of_contents).map(bare).collect();
        let is_there = |line: u32, title: &str| {
            lines[line as usize - 1].contains(&normal(title)) || contents.contains(&bare(title))
        };
        let wrong = manual.sections.iter().filter(|section| !is_there(section.start, &section.title));
        let wrong: Vec<_> = wrong.map(|section| (section.start, section.title.as_str())).collect();
        assert!(wrong.is_empty(), "{file}: {wrong:?}");
    }
}

#[test]
fn citations_are_in_the_manual_and_in_a_section() {
    for (file, manual) in DRIVES {
        let Some(text) = manual_text::text(manual) else { return };
        let last = text.lines().count();
        let catalog = doubts::catalog(file);
        let manual = device(&catalog).manual.as_deref().expect("the manual");
        let of_items = items(&catalog).filter_map(|item| item.documentation.as_ref()?.cite.clone());
        let of_doubts = doubts::doubts(&catalog).into_iter().filter_map(|doubt| doubt.cite);
        let lines: BTreeSet<usize> = of_items.chain(of_doubts).flat_map(|cite| doubts::lines(&cite)).collect();
        let beyond: Vec<_> = lines.iter().filter(|line| !(1..=last).contains(line)).collect();
        assert!(beyond.is_empty(), "{file}: {beyond:?}");
        let first = manual.sections.first().expect("a section").start as usize;
        let outside = items(&catalog)
            .filter_map(|item| item.documentation.as_ref()?.cite.as_deref())
            .filter(|cite| doubts::lines(cite).iter().all(|line| *line < first));
        assert_eq!(outside.count(), 0, "{file}: items cite lines before the first section");
    }
}

#[test]
fn rows_are_on_the_lines_that_they_cite() {
    for (file, manual) in DRIVES {
        let Some(text) = manual_text::text(manual) else { return };
        let lines: Vec<String> = text.lines().map(normal).collect();
        let catalog = doubts::catalog(file);
        let cited = items(&catalog).filter_map(|item| Some((item, item.documentation.as_ref()?.cite.as_deref()?)));
        let (mut count, mut missing) = (0, Vec::new());
        for (item, cite) in cited {
            count += 1;
            // The text of a cell can start before the cited line or continue after it.
            let context: BTreeSet<usize> =
                doubts::lines(cite).iter().flat_map(|line| line.saturating_sub(3)..=line + 2).collect();
            let near: Vec<&str> = context.iter().filter_map(|line| lines.get(*line)).map(String::as_str).collect();
            let near = format!(" {} ", near.join(" "));
            // The register table of the AKD has four mapping entries, although the manual prints only the first two.
            let is_assumed = file.starts_with("kollmorgen") && matches!(item.name.as_str(), "Entry 3" | "Entry 4");
            if !is_assumed && !printed(item).iter().any(|form| near.contains(form)) {
                missing.push(item.name.as_str());
            }
        }
        assert!(count > 90, "{file}: {count} citations");
        assert!(missing.is_empty(), "{file}: {missing:?}");
    }
}

/// Returns the notations in which a manual can print an item: names, index, sub-index and register address.
fn printed(item: &Item) -> Vec<String> {
    let mut forms: Vec<String> = item.names.iter().map(|name| normal(&name.text)).collect();
    forms.extend([normal(&item.name), normal(&item.name).replace('_', " ")]);
    for binding in &item.bindings {
        match binding {
            Binding::Object { index, sub_index: 0, .. } => {
                forms.extend([format!("{index:04x}"), " sub 0 ".to_owned(), "numofentries".to_owned()]);
            }
            Binding::Object { index, sub_index, .. } => {
                forms.extend([format!("{index:04x}"), format!(" {sub_index} "), format!("{sub_index:02x}")]);
            }
            Binding::Ascii(name) => forms.push(normal(name)),
            Binding::Register(register) => {
                let (first, _) = register.printed.split_once('–').unwrap_or((&register.printed, ""));
                forms.extend([format!(" {}", first.to_lowercase()), format!("0x{:x}", register.address)]);
            }
            _ => {}
        }
    }
    forms.retain(|form| !form.trim().is_empty());
    forms
}
