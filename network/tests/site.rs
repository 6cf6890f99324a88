//! Tests for the documentation of the example network and of an EtherCAT segment. All links must lead to a page, and the pages must
//! show the configured values.

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
    site_of(Source::read(&path).expect("the example"), "Packaging line", format)
}

/// Returns the pages of a site with the network or segment that a file describes.
fn site_of(source: Source, title: &str, format: Format) -> Vec<Page> {
    let compilation = compile(source, Levels::lenient());
    let network = compilation.usable().expect("a network");
    let mut site = Site::new(format);
    announce(network, title, &mut site);
    let mut all = pages(network, title, &mut site);
    all.extend(site.finish());
    all
}

/// Returns the pages of a site with an EtherCAT segment.
fn segment(format: Format) -> Vec<Page> {
    let text =
        "[segment]\ncycle = 1000\n[segment.subdevices.terminals]\ndevice = \"coupler.esi.xml\"\nmodel = \"CP-32\"\n\
                alias = 5\nmodules = { 0 = \"DO-8\", 2 = \"AI-2\" }\n\
                [segment.subdevices.\"axis|1\"]\ndevice = \"coupler.esi.xml\"\nmodel = \"SV-1\"\n";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data");
    site_of(Source::new("line.toml", text.into()).in_folder(folder), "line", format)
}

#[test]
fn links_of_a_segment_lead_to_pages() {
    assert!(html_links(&segment(Format::Html)) > 50);
    assert!(markdown_links(&segment(Format::Markdown)) > 50);
}

#[test]
fn the_page_of_a_segment_shows_its_settings() {
    let pages = segment(Format::Markdown);
    let segment = page(&pages, "_segments/line.md");
    for line in [
        "# EtherCAT segment line",
        "2 SubDevices; 7 bytes of outputs, 13 bytes of inputs.",
        "Vendor-ID 0x00000ABC. Product code 0x00A10001. Revision number 0x00010000. Station alias 5. |",
        "Clock mode DC: AssignActivate 0x0300, SYNC0 every 1000000 ns, shifted by 250000 ns. |",
        "| 2 | 0x00003001 | 2 analogue inputs |",
        "| 2 | Outputs | 0x1100 | 6 | 0x64 | yes |",
        "| 0 | 2 | outputs | 1 | 6 | 0x1100 | yes |",
        "## axis\\|1",
        "| PS | 0x8020:01 | Settings / Filter |",
        "| PS | 0x1C12:00 | PDO assignment of sync manager 2 | 00 |",
        "| PS | 0xF030:01 | Configured module idents | 01 20 00 00 |",
    ] {
        assert!(segment.contains(line), "{line}\n{segment}");
    }
    let (html, path) = (self::segment(Format::Html), "_segments/line.html");
    assert!(page(&html, path).contains("id=\"subdevice-1\"") && page(&html, "index.html").contains(path));
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
