//! Sites of documentation that the tests of their formats have in common.

#![allow(dead_code, reason = "each test needs a part of it")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use lexibus_codegen::backend::docs::{Format, Page, Site};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use pulldown_cmark::{Event, Parser, Tag};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The pages of these sources.
pub fn site(format: Format, sources: Vec<(String, Source)>) -> Vec<Page> {
    let (mut site, mut pages) = (Site::new(format), Vec::new());
    for (name, source) in sources {
        let own = site.add_compilation(&name, &check(source, &Options::default()));
        assert!(!own.is_empty(), "{name}");
        pages.extend(own);
    }
    pages.extend(site.finish());
    pages
}

/// The pages of these files of the repository.
pub fn files(format: Format, paths: &[&str]) -> Vec<Page> {
    let read = |path: &&str| {
        let name = path.rsplit('/').next().unwrap_or(path).split('.').next().unwrap_or_default().to_owned();
        (name, Source::read(&root().join(path)).expect("a description"))
    };
    site(format, paths.iter().map(read).collect())
}

/// Descriptions of every format.
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

/// Text that would be markup, script or the end of something, where it isn't escaped.
pub const HOSTILE: &str =
    "<script>alert(1)</script><img src=x onerror=alert(2)>\\\" ' onload=alert(3) </title></table>&lt; http://x";

/// Descriptions of every format, with hostile text in each field.
pub fn hostile() -> Vec<(String, Source)> {
    let hostile = HOSTILE.replace("\\\"", "");
    let eds = format!(
        "[FileInfo]\nDescription={hostile}\n[DeviceInfo]\nVendorName={hostile}\nProductName={hostile}\nOrderCode={hostile}\n\
         [MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n[1000]\nParameterName={hostile}\nDataType=0x0009\nAccessType=ro\n\
         DefaultValue={hostile}\nDenotation={hostile}\n[Comments]\nLines=1\nLine1={hostile}\n"
    );
    let xml = hostile.replace('&', "&amp;").replace('<', "&lt;");
    let esi = std::fs::read_to_string(root().join("tests/data/coupler.esi.xml")).expect("an ESI");
    let esi = esi.replace("</Name>", &format!("{xml}</Name>")).replace("</Comment>", &format!("{xml}</Comment>"));
    let gsdml = std::fs::read_to_string(root().join("tests/data/drive.gsdml.xml")).expect("a GSDML");
    let gsdml = gsdml.replace(" Value=\"", &format!(" Value=\"{}", xml.replace('"', "&quot;")));
    let table = format!(
        "lexibus = 1\n[device]\nname = \"{HOSTILE}\"\nvendor = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\nbuses = [\"modbus\", \"serial\"]\n\
         doubt = {{ says = \"{HOSTILE}\", chose = \"{HOSTILE}\", why = \"{HOSTILE}\" }}\n[manual]\nlanguage = \"it\"\n\
         [spaces.register]\nmodbus = {{ table = \"holding\" }}\n[[chapters]]\ntitle = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\n[chapters.registers]\n\
         \"{HOSTILE}\" = {{ reg = 1, type = \"u16\", access = \"rw\", unit = \"{HOSTILE}\", orig = \"{HOSTILE}\", doc = \"{HOSTILE}\", \
         effects = [\"{HOSTILE}\"], bits = {{ 0 = {{ name = \"{HOSTILE}\", doc = \"{HOSTILE}\" }}, \"2-1\" = {{ name = \"x\", values = {{ 1 = \"{HOSTILE}\" }} }} }} }}\n\
         mode = {{ reg = 2, type = \"u16\", access = \"rw\", enum = {{ 1 = \"{HOSTILE}\" }} }}\n\
         [codes.\"{HOSTILE}\"]\ncolumns = [\"{HOSTILE}\"]\n[codes.\"{HOSTILE}\".rows]\n1 = {{ name = \"{HOSTILE}\", doc = \"{HOSTILE}\", cells = [\"{HOSTILE}\"] }}\n\
         [machines.\"{HOSTILE}\"]\nstatus = \"mode\"\ndoc = \"{HOSTILE}\"\n[machines.\"{HOSTILE}\".states]\n\"{HOSTILE}\" = {{ mask = 1, value = 1 }}\nidle = {{ mask = 1, value = 0 }}\n\
         [machines.\"{HOSTILE}\".commands]\n\"{HOSTILE}\" = {{ mask = 1, value = 1 }}\n\
         [[machines.\"{HOSTILE}\".transitions]]\nfrom = \"idle\"\nto = \"{HOSTILE}\"\ncommand = \"{HOSTILE}\"\n\
         [procedures.\"{HOSTILE}\"]\ndoc = \"{HOSTILE}\"\nsteps = [{{ manual = \"{HOSTILE}\" }}]\n\
         [[messages]]\nname = \"{HOSTILE}\"\ndoc = \"{HOSTILE}\"\nrequest = [{{ field = \"{HOSTILE}\", type = \"u8\", doc = \"{HOSTILE}\" }}]\n"
    );
    vec![
        (hostile.clone(), Source::new("h.eds", eds.into())),
        ("esi".to_owned(), Source::new("h.xml", esi.into())),
        ("gsdml".to_owned(), Source::new("h.xml", gsdml.into())),
        ("table".to_owned(), Source::new("h.toml", table.into())),
    ]
}

/// The values of an attribute in double quotes.
pub fn values<'p>(text: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    text.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

/// Follows every link of a site.
///
/// # Panics
///
/// Where one leads nowhere, or an address is given twice.
pub fn html_links(pages: &[Page]) -> usize {
    let mut ids: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for page in pages {
        let all = values(&page.text, "id");
        let own: BTreeSet<&str> = all.iter().copied().collect();
        assert_eq!(own.len(), all.len(), "{}: an id is given twice", page.path);
        ids.insert(&page.path, own);
    }
    let mut count = 0;
    for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
        let links = values(&page.text, "href").into_iter().chain(values(&page.text, "src"));
        count += links.map(|link| follow(page, link, |path, id| ids.get(path).map(|own| own.contains(id)))).count();
    }
    count
}

/// The same for Markdown.
///
/// # Panics
///
/// As for a site.
pub fn markdown_links(all: &[Page]) -> usize {
    let mut ids: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    let mut links = Vec::new();
    for (page, seen) in pages(all) {
        let own: Vec<&str> = seen.html.iter().filter_map(|html| id(html)).collect();
        let once: BTreeSet<String> = own.iter().map(|own| (*own).to_owned()).collect();
        assert_eq!(once.len(), own.len(), "{}: an id is given twice", page.path);
        ids.insert(&page.path, once);
        links.extend(seen.links.into_iter().map(|link| (page, link)));
    }
    for (page, link) in &links {
        follow(page, link, |path, id| ids.get(path).map(|own| own.contains(id)));
    }
    links.len()
}

/// `has` tells whether a page has an address, and `None` of a page that isn't there.
fn follow(page: &Page, link: &str, has: impl Fn(&str, &str) -> Option<bool>) {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let folder = page.path.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
    let path = match file.strip_prefix("../") {
        Some(path) => path.to_owned(),
        None if file.is_empty() => page.path.clone(),
        None => format!("{folder}{}", file.trim_start_matches("./")),
    };
    let is_there = has(&path, anchor).unwrap_or_else(|| panic!("{}: there is no {path}", page.path));
    assert!(anchor.is_empty() || is_there, "{}: {path} has no {anchor}", page.path);
}

/// What a reader of Markdown sees in a page, read as GitHub and `mdBook` do.
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
            Event::Html(own) | Event::InlineHtml(own) => seen.html.push(own.trim().to_owned()),
            Event::Text(own) | Event::Code(own) => seen.text.push_str(&own),
            _ => {}
        }
    }
    seen
}

/// The address that `<a id="…">` gives.
pub fn id(html: &str) -> Option<&str> {
    html.strip_prefix("<a id=\"")?.strip_suffix("\">")
}

/// Each page with what is seen of it.
pub fn pages(all: &[Page]) -> impl Iterator<Item = (&Page, Seen)> {
    all.iter().map(|page| (page, seen(page)))
}
