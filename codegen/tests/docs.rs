//! The site of `lexibus docs`: each link leads somewhere, nothing of a description is markup, and it is as small as it should be.

#[path = "docs_support/hostile.rs"]
mod hostile;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use lexibus_codegen::backend::docs::{Page, Site};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The pages of these sources.
fn site(sources: Vec<(String, Source)>) -> Vec<Page> {
    let (mut site, mut pages) = (Site::default(), Vec::new());
    for (name, source) in sources {
        let compilation = check(source, &Options::default());
        pages.extend(site.add(&name, compilation.catalog.as_ref().unwrap_or_else(|| panic!("{name}"))));
    }
    pages.extend(site.finish());
    pages
}

fn files(paths: &[&str]) -> Vec<Page> {
    let read = |path: &&str| {
        let name = path.rsplit('/').next().unwrap_or(path).split('.').next().unwrap_or_default().to_owned();
        (name, Source::read(&root().join(path)).expect("a description"))
    };
    site(paths.iter().map(read).collect())
}

const ALL: [&str; 10] = [
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

/// The values of an attribute in double quotes.
fn values<'p>(text: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    text.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn each_link_leads_somewhere() {
    let pages = files(&ALL);
    let mut ids: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for page in &pages {
        let all = values(&page.text, "id");
        let own: BTreeSet<&str> = all.iter().copied().collect();
        assert_eq!(own.len(), all.len(), "{}: an id is given twice", page.path);
        ids.insert(&page.path, own);
    }
    let mut count = 0;
    for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
        let folder = page.path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let links = values(&page.text, "href").into_iter().chain(values(&page.text, "src"));
        for link in links {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let path = match file.strip_prefix("../") {
                Some(path) => path.to_owned(),
                None if file.is_empty() => page.path.clone(),
                None => format!("{folder}/{}", file.trim_start_matches("./")).trim_start_matches('/').to_owned(),
            };
            let own = ids.get(path.as_str()).unwrap_or_else(|| panic!("{}: there is no {path}", page.path));
            assert!(anchor.is_empty() || own.contains(anchor), "{}: {path} has no {anchor}", page.path);
            count += 1;
        }
    }
    assert!(count > 5000, "only {count} links");
}

#[test]
fn the_search_finds_what_pages_have() {
    let pages = files(&["dictionaries/hsd-sm137-sm140.toml"]);
    let index = &pages.iter().find(|page| page.path == "hsd-sm137-sm140/search.js").expect("an index").text;
    // A parameter, a message by its Italian name, a code.
    for text in ["KP_VEL\\t", "\\nCmdTraj\\tPosizionamento", "\\noverheated\\tALOVERHEATED\\t"] {
        assert!(index.contains(text), "{text}");
    }
    assert!(index.starts_with("lexibusIndex([[\"index.html\",\"HSD Motor\"],"));
    assert!(index.contains("\\nparameter 0x0105\\n"));
}

#[test]
fn nothing_of_a_description_is_markup() {
    let pages = site(hostile::descriptions());
    let mut shown = 0;
    for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
        assert_eq!(page.text.matches("<script").count(), 1, "{}", page.path);
        assert_eq!(page.text.matches("</title>").count(), 1, "{}", page.path);
        assert!(!page.text.contains("<img"), "{}", page.path);
        // A quote would end an attribute, and what is behind it would be another one.
        for tag in page.text.split('<').skip(1).filter_map(|rest| rest.split('>').next()) {
            let names = tag.split('"').step_by(2).collect::<String>();
            assert!(!names.contains("onerror") && !names.contains("onload"), "{}: <{tag}>", page.path);
        }
        shown += page.text.matches("alert(1)").count();
    }
    assert!(shown > 60, "only {shown} texts are shown");
    assert!(pages
        .iter()
        .all(|page| !page.path.contains("..") && !page.path.starts_with('/') && !page.path.contains('<')));
}

#[test]
fn nothing_comes_from_elsewhere() {
    for page in files(&ALL) {
        for attribute in ["src", "href"] {
            assert!(values(&page.text, attribute).iter().all(|link| !link.contains("//")), "{}", page.path);
        }
        if page.path.ends_with(".css") || page.path == "site.js" {
            assert!(!page.text.contains("http") && !page.text.contains("url("), "{}", page.path);
        }
    }
}

#[test]
fn two_thousand_registers_are_small() {
    let field = |register: usize, at: usize| {
        format!("\"{}-{}\" = {{ name = \"field {at} of {register}\", number = true }}", 2 * at + 1, 2 * at)
    };
    let row = |register: usize| {
        let fields: Vec<String> = (0..8).map(|at| field(register, at)).collect();
        format!(
            "register_{register} = {{ reg = {register}, type = \"u16\", access = \"rw\", bits = {{ {} }} }}\n",
            fields.join(", ")
        )
    };
    let rows: String = (0..2000).map(row).collect();
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Big\"\nbuses = [\"modbus\"]\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"Registers\"\n[chapters.registers]\n{rows}"
    );
    let pages = site(vec![("big".to_owned(), Source::new("big.toml", table.into()))]);
    let size: usize = pages.iter().map(|page| page.text.len()).sum();
    assert!(size < 3_000_000, "{size} bytes");
    assert!(pages.len() < 20, "{} files", pages.len());
}

#[test]
fn a_page_of_registers() {
    let table = "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"modbus\"]\n[manual]\nlanguage = \"it\"\ncites = \"page\"\n\
                 [spaces.register]\nmodbus = { table = \"holding\" }\n[[chapters]]\ntitle = \"Control\"\ndoc = \"What is wanted\"\n[chapters.registers]\n\
                 speed = { reg = 1, type = \"i16\", access = \"rw\", unit = \"rpm\", scale = 0.1, min = -300, max = 300, default = 0, orig = \"velocità\", cite = 4, save = true }\n\
                 control = { reg = 2, type = \"u8\", access = \"rw\", bits = { 0 = \"on\", \"3-2\" = { name = \"mode\", values = { 1 = \"slow\" } } }, \
                 doubt = { says = \"Two tables differ\", chose = \"the first\", why = \"it has more\" } }\n";
    let pages = site(vec![("pump".to_owned(), Source::new("pump.toml", table.into()))]);
    let page = pages.iter().find(|page| page.path == "pump/control.html").expect("the chapter");
    let (_, content) = page.text.split_once("<main").expect("the content");
    insta::assert_snapshot!(content);
}
