//! Tests the files of the search index.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Site};

#[test]
fn pages_of_comparisons_have_an_index() {
    let catalog = |name: &str| {
        let table = format!("lexibus = 1\n[device]\nname = \"{name}\"\nbuses = [\"modbus\"]\n");
        check(Source::new("pump.toml", table.into()), &Options::default()).usable().expect("a catalog").clone()
    };
    let (old, new) = (catalog("Old pump"), catalog("Pump"));
    let has_index = |is_compared: bool| {
        let mut site = Site::new(Format::Html);
        site.add("pump", &new);
        if is_compared {
            let page = site.compare(("old", &old), ("new", &new));
            assert!(!page.text.contains("data-index"), "{}", page.text);
        }
        let pages = site.finish();
        ["search.js", "search-first.js"].map(|path| pages.iter().any(|page| page.path == path))
    };
    assert_eq!(has_index(true), [true, true]);
    assert_eq!(has_index(false), [false, false]);
}

#[test]
fn only_generated_scripts_are_replaced() {
    let mut site = Site::new(Format::Html);
    for name in ["a", "b"] {
        let table = format!("lexibus = 1\n[device]\nname = \"{name}\"\nbuses = [\"modbus\"]\n");
        site.add_compilation(name, &check(Source::new("pump.toml", table.into()), &Options::default()));
    }
    let pages = site.finish();
    for path in ["search.js", "search-first.js"] {
        let page = pages.iter().find(|page| page.path == path).expect("an index");
        assert!(page.replaces(&page.text), "{path}");
        assert!(!page.replaces("lexibusIndexer.start();"), "{path}");
    }
}
