//! Tests that the Markdown pages of `lexibus docs` are a valid mdBook.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use lexibus_codegen::compile::{Options, check};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Site};
use mdbook_driver::config::Config;
use support::{attributes, build_into};

mod support;

const DESCRIPTIONS: [&str; 7] = [
    "dictionaries/aec-vector-step.toml",
    "dictionaries/demo-drive.eds",
    "dictionaries/eco.toml",
    "dictionaries/hsd-sm137-sm140.toml",
    "dictionaries/kollmorgen-akd.toml",
    "tests/data/coupler.esi.xml",
    "tests/data/drive.gsdml.xml",
];

/// Writes the Markdown pages to the folder `src` of a new book. Returns the folder of the book.
fn written() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("drives");
    let _ = fs::remove_dir_all(&folder);
    let (mut site, mut pages) = (Site::new(Format::Markdown), Vec::new());
    for path in DESCRIPTIONS {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let compilation = check(Source::read(&path).expect("a description"), &Options::default());
        pages.extend(site.add_compilation(&name, &compilation));
    }
    pages.extend(site.finish());
    for page in pages {
        let path = folder.join("src").join(&page.path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, page.text).expect("a page");
    }
    folder
}

/// Adds the HTML pages in a folder and its subfolders to `all`, by path.
fn pages(root: &Path, folder: &Path, all: &mut BTreeMap<PathBuf, String>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            pages(root, &path, all);
        } else if path.extension().is_some_and(|extension| extension == "html") {
            let relative = path.strip_prefix(root).expect("a page of the book").to_owned();
            all.insert(relative, fs::read_to_string(&path).expect("a page"));
        }
    }
}

/// Resolves `..` and `.` in a path.
fn resolved(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part.as_os_str().to_str() {
            Some("..") => drop(parts.pop()),
            Some(".") => {}
            _ => parts.push(part),
        }
    }
    parts
}

#[test]
fn drives_are_a_book_whose_links_lead_somewhere() {
    let root = written();
    let mut config = Config::default();
    config.build.build_dir = root.join("book");
    build_into(&root, config);
    let mut all = BTreeMap::new();
    pages(&root.join("book"), &root.join("book"), &mut all);
    let ids: BTreeMap<&Path, BTreeSet<&str>> =
        all.iter().map(|(path, text)| (path.as_path(), attributes(text, "id").into_iter().collect())).collect();
    let (mut faults, mut count) = (Vec::new(), 0);
    for (path, text) in all.iter().filter(|(path, _)| !path.ends_with("print.html") && !path.ends_with("404.html")) {
        let Some(content) = text.split("<main>").nth(1).and_then(|rest| rest.split("</main>").next()) else { continue };
        for link in attributes(content, "href") {
            count += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let file = if file.is_empty() { path.clone() } else { path.parent().unwrap_or(path).join(file) };
            let has = ids.get(resolved(&file).as_path()).is_some_and(|ids| anchor.is_empty() || ids.contains(anchor));
            if !has {
                faults.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{} of {count}: {:#?}", faults.len(), &faults[..faults.len().min(20)]);
    assert!(count > 2000, "only {count} links");
}
