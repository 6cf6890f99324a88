//! Tests the pages of the four drives whose manuals are transcribed as dictionaries.

use std::collections::HashSet;

use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::Doubt;
use lexibus_site::Site;

use crate::doubts;

/// The dictionaries of the drives.
const DRIVES: [&str; 4] = ["aec-vector-step.toml", "eco.toml", "hsd-sm137-sm140.toml", "kollmorgen-akd.toml"];

#[test]
fn every_doubt_is_on_the_page_of_assumptions() {
    for file in DRIVES {
        let catalog = doubts::catalog(file);
        let pages = Site::default().add("drive", &catalog);
        let pages = pages.iter().filter(|page| page.path.contains("/assumptions"));
        // The pages list the ambiguity of a repeated row only once, with links to all items of the row.
        let all = doubts::doubts(&catalog);
        let manual = catalog.devices[0].manual.as_deref().expect("a manual");
        let fact = |doubt: &Doubt| {
            let cite = doubt.cite.as_ref().map(|cite| PLAIN.citation(manual, "", cite));
            (doubt.says.clone(), doubt.chosen.clone(), doubt.why.clone(), cite, doubt.part.clone())
        };
        let distinct: HashSet<_> = all.iter().map(fact).collect();
        let rows: Vec<_> = pages.flat_map(|page| page.text.split("<tr><th scope=\"row\">").skip(1)).collect();
        assert_eq!(rows.len(), distinct.len(), "{file}");
        let links: usize =
            rows.iter().map(|row| row.split("<td").next().unwrap_or_default().matches("<a ").count()).sum();
        assert_eq!(links, all.len(), "{file}");
    }
}
