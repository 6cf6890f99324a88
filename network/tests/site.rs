//! Documentation of the example network: all links lead to a page, and the page of the network has the values of the network.

#[path = "../../codegen/site/tests/docs_support/mod.rs"]
mod docs_support;

use std::path::Path;

use docs_support::{html_links, markdown_links};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_network::compile::compile;
use lexibus_network::output::{announce, pages};
use lexibus_site::{Format, Page, Site};

/// Returns the pages of a site with the example network.
fn site(format: Format) -> Vec<Page> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/network/network.toml");
    let compilation = compile(Source::read(&path).expect("the example"), Levels::lenient());
    let network = compilation.usable().expect("a network");
    let mut site = Site::new(format);
    announce(network, &network.name, &mut site);
    let mut all = pages(network, &network.name, &mut site);
    all.extend(site.finish());
    all
}

fn page<'p>(pages: &'p [Page], path: &str) -> &'p str {
    &pages.iter().find(|page| page.path == path).unwrap_or_else(|| panic!("no page {path}")).text
}

#[test]
fn links_lead_to_pages() {
    assert!(html_links(&site(Format::Html)) > 100);
    assert!(markdown_links(&site(Format::Markdown)) > 100);
}

#[test]
fn the_page_shows_who_sends_what_to_whom() {
    let pages = site(Format::Markdown);
    let network = page(&pages, "_networks/packaging-line.md");
    let axis = |number: u8, page: &str| {
        format!("[axis{number}](../example/demo-servo-0x00004022/0x00010000-packaging-line-axis{number}/{page})")
    };
    let expected = [
        "Bus load of cyclic frames: 8.0 % of 500 kbit/s, without 5 PDOs that have neither inhibit time nor event timer.".to_owned(),
        format!(
            "| 0x281 | TPDO 2 | {} | {}, master | Position actual value | on an event, at intervals of at least 10 ms, at \
             the latest after 500 ms | 4 |",
            axis(1, "process-data.md#0x1A01"),
            axis(2, "process-data.md#0x1601")
        ),
        format!("| 0x201 | RPDO 1 | master | {} | Controlword, Target velocity | after each SYNC", axis(1, "process-data.md#0x1600")),
        format!("| 0x701 | heartbeat | {} |  |  | every 100 ms | 1 | 10\\.0 | 0\\.1 % |", axis(1, "index.md")),
        "| 0x80 | SYNC | master |  |  | every 10 ms |".to_owned(),
        "| 0x2100:00 | Pressure limit | 6\\.50 bar (raw 650) |".to_owned(),
        "| 0x1600:02 | RPDO 1 mapping / Mapped object 2 | 0x60FF0020 (Target velocity) |".to_owned(),
        "| 0x6060:00 | Modes of operation | 3 (profile velocity) |".to_owned(),
    ];
    for line in expected {
        assert!(network.contains(&line), "{line}\n{network}");
    }
    assert!(page(&pages, "README.md").contains("[Network Packaging line](_networks/packaging-line.md)"));
}

#[test]
fn the_pages_of_a_node_show_its_pdos_in_the_network() {
    let pages = site(Format::Markdown);
    let data = page(&pages, "example/demo-servo-0x00004022/0x00010000-packaging-line-axis2/process-data.md");
    assert!(data.contains("COB-ID 0x281"), "the RPDO that receives the position of axis1\n{data}");
}
