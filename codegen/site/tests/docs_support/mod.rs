//! Helpers for the tests of documentation: they create pages, and check links and markup.

#![allow(dead_code, reason = "each test needs a part of it")]

pub mod hostile;
#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../../tests/support/root.rs"]
mod root;

use std::collections::{BTreeMap, BTreeSet};

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Page, Site};
use pulldown_cmark::{Event, Parser, Tag};
use root::root;

/// Returns the pages of a site that documents `sources`.
pub fn site(format: Format, sources: Vec<(String, Source)>) -> Vec<Page> {
    let (mut site, mut pages) = (Site::new(format), Vec::new());
    let compiled: Vec<_> =
        sources.into_iter().map(|(name, source)| (name, check(source, &Options::default()))).collect();
    for (name, compilation) in &compiled {
        site.announce(name, compilation.catalog.as_ref().expect("a catalog"));
    }
    for (name, compilation) in &compiled {
        let pages_of_source = site.add_compilation(name, compilation);
        assert!(!pages_of_source.is_empty(), "{name}");
        pages.extend(pages_of_source);
    }
    pages.extend(site.finish());
    pages
}

/// Returns the pages of a site that documents files of the repository.
pub fn files(format: Format, paths: &[&str]) -> Vec<Page> {
    let read = |path: &&str| {
        let name = path.rsplit('/').next().unwrap_or(path).split('.').next().unwrap_or_default().to_owned();
        (name, Source::read(&root().join(path)).expect("a description"))
    };
    site(format, paths.iter().map(read).collect())
}

/// Paths of register tables and of EDS, ESI and GSDML files.
pub const ALL: [&str; 10] = [
    "dictionaries/aec-vector-step.toml",
    "dictionaries/demo-drive.eds",
    "dictionaries/eco.toml",
    "dictionaries/hsd-sm137-sm140.toml",
    "dictionaries/kollmorgen-akd.toml",
    "tests/data/coupler.esi.xml",
    "tests/data/drive.gsdml.xml",
    "tests/data/heads.gsdml.xml",
    "tests/data/hoist.toml",
    "tests/data/safe.gsdml.xml",
];

/// Returns all values of an attribute that are in double quotes.
pub fn values<'p>(text: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    text.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

/// Checks all links of a site. Returns the number of links.
///
/// # Panics
///
/// Panics if a link is invalid or an ID occurs twice on a page.
pub fn html_links(pages: &[Page]) -> usize {
    let mut ids: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for page in pages {
        let all = values(&page.text, "id");
        let ids_of_page: BTreeSet<&str> = all.iter().copied().collect();
        assert_eq!(ids_of_page.len(), all.len(), "{}: an id occurs twice", page.path);
        ids.insert(&page.path, ids_of_page);
    }
    let mut count = 0;
    for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
        let links = values(&page.text, "href").into_iter().chain(values(&page.text, "src"));
        count += links.map(|link| follow(page, link, |path, id| ids.get(path).map(|ids| ids.contains(id)))).count();
    }
    count
}

/// Checks all links of Markdown pages. Returns the number of links.
///
/// # Panics
///
/// Panics if a link is invalid or an ID occurs twice on a page.
pub fn markdown_links(all: &[Page]) -> usize {
    let mut ids: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    let mut links = Vec::new();
    for (page, seen) in pages(all) {
        let ids_of_page: Vec<&str> = seen.html.iter().filter_map(|html| id(html)).collect();
        let once: BTreeSet<String> = ids_of_page.iter().map(|id| (*id).to_owned()).collect();
        assert_eq!(once.len(), ids_of_page.len(), "{}: an id occurs twice", page.path);
        ids.insert(&page.path, once);
        links.extend(seen.links.into_iter().map(|link| (page, link)));
    }
    for (page, link) in &links {
        follow(page, link, |path, id| ids.get(path).map(|ids| ids.contains(id)));
    }
    links.len()
}

/// Checks a link. `has` returns whether a page has an id, or `None` if the page does not exist.
fn follow(page: &Page, link: &str, has: impl Fn(&str, &str) -> Option<bool>) {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let mut steps: Vec<&str> = page.path.split('/').collect();
    if !file.is_empty() {
        steps.pop();
    }
    for step in file.split('/').filter(|step| !matches!(*step, "" | ".")) {
        match step {
            ".." => drop(steps.pop().expect("a folder of the site")),
            _ => steps.push(step),
        }
    }
    let path = steps.join("/");
    let is_there = has(&path, anchor).unwrap_or_else(|| panic!("{}: there is no {path}", page.path));
    assert!(anchor.is_empty() || is_there, "{}: {path} has no {anchor}", page.path);
}

/// The visible parts of a Markdown page, parsed as GitHub and `mdBook` do.
#[derive(Default)]
pub struct Seen {
    pub links: Vec<String>,
    pub html: Vec<String>,
    pub text: String,
    pub images: usize,
}

pub fn seen(page: &Page) -> Seen {
    let mut seen = Seen::default();
    for event in Parser::new_ext(&page.text, pulldown_cmark::Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Link { dest_url, .. }) => seen.links.push(dest_url.into_string()),
            Event::Start(Tag::Image { .. }) => seen.images += 1,
            Event::Html(text) | Event::InlineHtml(text) => seen.html.push(text.trim().to_owned()),
            Event::Text(text) | Event::Code(text) => seen.text.push_str(&text),
            _ => {}
        }
    }
    seen
}

/// Returns the id of an `<a id="…">` element.
pub fn id(html: &str) -> Option<&str> {
    html.strip_prefix("<a id=\"")?.strip_suffix("\">")
}

/// Returns each page together with its visible parts.
pub fn pages(all: &[Page]) -> impl Iterator<Item = (&Page, Seen)> {
    all.iter().map(|page| (page, seen(page)))
}

/// Checks that the path of each page is within the folder of the site, regardless of device names.
fn placed(pages: &[Page]) {
    for Page { path, .. } in pages {
        assert!(!path.contains("..") && !path.starts_with('/') && !path.contains(['<', '\\', ':']), "{path}");
    }
}

/// Checks that descriptions do not add HTML elements or event handlers to the pages of a site.
///
/// # Panics
///
/// Panics if a description adds an HTML element or an event handler.
pub fn html_markup(all: &[Page]) {
    placed(all);
    for page in all.iter().filter(|page| page.path.ends_with(".html")) {
        assert_eq!(page.text.matches("<script").count(), 1, "{}", page.path);
        assert_eq!(page.text.matches("</title>").count(), 1, "{}", page.path);
        assert!(!page.text.contains("<img"), "{}", page.path);
        // A quotation mark in a value would end the attribute, and another attribute could follow.
        for tag in page.text.split('<').skip(1).filter_map(|rest| rest.split('>').next()) {
            let names = tag.split('"').step_by(2).collect::<String>();
            assert!(!names.contains("onerror") && !names.contains("onload"), "{}: <{tag}>", page.path);
        }
    }
}

/// Checks that descriptions do not add markup to Markdown pages. The pages are parsed as GitHub and `mdBook` do.
///
/// # Panics
///
/// Panics if a description adds markup.
pub fn markdown_markup(all: &[Page]) {
    placed(all);
    for (page, seen) in pages(all) {
        for html in &seen.html {
            let is_ours = html == "</a>" || html == "<br>" || html.starts_with("<!-- Written by lexibus docs");
            assert!(is_ours || id(html).is_some_and(|id| !id.contains(['"', '<', '>'])), "{}: {html}", page.path);
        }
        assert!(seen.links.iter().all(|link| !link.contains("//")), "{}", page.path);
        assert_eq!(seen.images, 0, "{}", page.path);
        assert!(!seen.text.contains('|') || page.text.contains("\\|"), "{}", page.path);
    }
}
