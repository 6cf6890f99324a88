//! Tests the book as built by mdBook: the build has no warnings, each file is a chapter, and all links are valid.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use mdbook_driver::config::Config;
use support::{attributes, build_into};

mod support;

/// Start of links to files of the repository. The test checks that these files exist on disk.
const REPOSITORY: &str = "https://github.com/lexibus/lexibus/blob/main/";

fn docs() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the folder of the book")
}

/// Builds the book into a separate folder.
fn build() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    let _ = fs::remove_dir_all(&folder);
    let mut config = Config::from_disk(docs().join("book.toml")).expect("the configuration of the book");
    config.build.build_dir = folder.clone();
    build_into(docs(), config);
    folder
}

/// Returns the built chapters by name, as listed in `SUMMARY.md`.
fn pages(folder: &Path) -> BTreeMap<String, String> {
    let names = fs::read_dir(folder).expect("the book").map(|entry| entry.expect("a page").path());
    let pages = names.filter(|path| path.extension().is_some_and(|extension| extension == "html"));
    let file_name =
        |path: &PathBuf| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let read = |path: PathBuf| (file_name(&path), fs::read_to_string(&path).expect("a page"));
    let is_chapter = |name: &str| !["print.html", "404.html", "toc.html"].contains(&name);
    pages.map(read).filter(|(name, _)| is_chapter(name)).collect()
}

/// Returns the reason why a link on a page is invalid, or `None` if the link is valid.
fn fault(link: &str, page: &str, anchors: &BTreeMap<&str, BTreeSet<&str>>, folder: &Path) -> Option<&'static str> {
    if let Some(path) = link.strip_prefix(REPOSITORY) {
        let path = path.split('#').next().unwrap_or_default();
        return (!docs().join("..").join(path).exists()).then_some("the repository has no such file");
    }
    if link.contains("://") || link.starts_with("javascript:") {
        return None;
    }
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    let path = if path.is_empty() { page } else { path };
    match anchors.get(path) {
        Some(ids) => (!anchor.is_empty() && !ids.contains(anchor)).then_some("the page has no such anchor"),
        None => (path.contains("..") || !folder.join(path).exists()).then_some("the book has no such page"),
    }
}

#[test]
fn the_book_is_built_and_its_links_lead_somewhere() {
    let folder = build();
    let pages = pages(&folder);
    let ids = |text| attributes(text, "id").into_iter().collect();
    let anchors: BTreeMap<&str, BTreeSet<&str>> = pages.iter().map(|(name, text)| (name.as_str(), ids(text))).collect();
    let (mut faults, mut count) = (Vec::new(), 0);
    for (name, text) in &pages {
        // Only links within a chapter are checked, not those of mdBook's page frame.
        let content = text.split("<main>").nth(1).and_then(|rest| rest.split("</main>").next()).expect("a chapter");
        for link in attributes(content, "href").into_iter().chain(attributes(content, "src")) {
            count += 1;
            if let Some(fault) = fault(link, name, &anchors, &folder) {
                faults.push(format!("{name}: {link}: {fault}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(count > 500 && pages.len() > 20, "{count} links on {} pages", pages.len());
}

#[test]
fn every_file_is_a_chapter_and_its_examples_are_compiled() {
    let summary = fs::read_to_string(docs().join("src/SUMMARY.md")).expect("the summary");
    let tests = fs::read_to_string(docs().join("lib.rs")).expect("the list of chapters");
    let files = fs::read_dir(docs().join("src")).expect("the chapters");
    let files = files.map(|entry| entry.expect("a chapter").file_name().to_string_lossy().into_owned());
    let (chapters, pictures): (Vec<String>, Vec<String>) = files.partition(|name| name.ends_with(".md"));
    let text = |name: &String| fs::read_to_string(docs().join("src").join(name)).expect("a chapter");
    for picture in pictures {
        let is_used = chapters.iter().any(|chapter| text(chapter).contains(&format!("]({picture})")));
        assert!(is_used, "no chapter shows {picture}");
    }
    let mut count = 0;
    for name in chapters.into_iter().filter(|name| name != "SUMMARY.md") {
        assert!(summary.contains(&format!("]({name})")), "{name} is not in SUMMARY.md");
        assert!(tests.contains(&format!("include_str!(\"src/{name}\")")), "{name} is not in lib.rs");
        count += 1;
    }
    assert_eq!(summary.matches("](").count(), count, "a chapter of SUMMARY.md has no file, or is listed twice");
}

/// Links to files in other texts of the repository must be valid.
#[test]
fn links_of_other_texts_lead_to_files() {
    let root = docs().join("..");
    let mut count = 0;
    for text in
        ["README.md", "CHANGELOG.md", "dictionaries/README.md", "tests/interop/README.md", "examples/no_std/README.md"]
    {
        let path = root.join(text);
        let content = fs::read_to_string(&path).expect("a text of the repository");
        let inline = content.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let definitions =
            content.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: ").map(|(_, link)| link));
        let links = inline.chain(definitions).filter(|link| !link.contains("://") && !link.starts_with('#'));
        for link in links {
            let target = path.parent().expect("a folder").join(link.split('#').next().unwrap_or_default());
            assert!(target.exists(), "{text}: {link}");
            count += 1;
        }
    }
    assert!(count > 10, "{count} links");
}

/// No Rust example of the book may be marked `ignore`, so that a test compiles all of them.
#[test]
fn no_example_is_left_out() {
    for entry in fs::read_dir(docs().join("src")).expect("the chapters") {
        let path = entry.expect("a chapter").path();
        let text = fs::read_to_string(&path).expect("a chapter");
        for line in text.lines().filter(|line| line.starts_with("```rust")) {
            assert!(!line.contains("ignore"), "{}: {line}", path.display());
        }
    }
}
