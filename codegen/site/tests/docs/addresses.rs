//! Tests that addresses stay valid when a description gets another device.

use std::collections::BTreeSet;

use crate::docs_support::{html_links, markdown_links, pages, site, values};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Page};

/// Returns the path of each page, and the address of each element.
fn addresses(all: &[Page]) -> BTreeSet<String> {
    let markdown = pages(all).filter(|(page, _)| page.path.ends_with(".md"));
    let markdown = markdown.flat_map(|(page, seen)| {
        let ids = seen.html.iter().filter_map(|html| crate::docs_support::id(html)).map(str::to_owned);
        ids.map(|id| format!("{}#{id}", page.path)).collect::<Vec<_>>()
    });
    let html = all.iter().filter(|page| page.path.ends_with(".html"));
    let html = html.flat_map(|page| values(&page.text, "id").into_iter().map(|id| format!("{}#{id}", page.path)));
    all.iter().map(|page| page.path.clone()).chain(html).chain(markdown).collect()
}

/// Checks that all addresses in the documentation of `one`, which describes one device, also exist in the documentation
/// of `two`, which describes a second device in addition.
fn nothing_moves(file: &str, one: &str, two: &str) {
    for (format, check) in [(Format::Html, html_links as fn(&[Page]) -> usize), (Format::Markdown, markdown_links)] {
        let documented = |text: &str| site(format, vec![("file".to_owned(), Source::new(file, text.into()))]);
        let (before, after) = (documented(one), documented(two));
        check(&before);
        check(&after);
        let (before, after) = (addresses(&before), addresses(&after));
        assert!(
            ["modules", "diagnostics"].iter().all(|name| before.iter().any(|path| path.contains(name))),
            "{before:?}"
        );
        assert!(after.len() > before.len());
        let missing: Vec<_> = before.difference(&after).collect();
        assert!(missing.is_empty(), "{missing:#?}");
    }
}

#[test]
fn a_second_revision_moves_nothing() {
    let text = std::fs::read_to_string(crate::root::root().join("tests/data/coupler.esi.xml")).expect("a description");
    let start = text.find("<Device ").expect("a device");
    let length = text[start..].find("</Device>").expect("its end") + "</Device>".len();
    let end = text.rfind("</Device>").expect("the last device") + "</Device>".len();
    // Add an invalid attribute, so that the site has a page of diagnostics.
    let device = text[start..][..length].replacen("<Name>", "<Name LcId=\"x\">", 1);
    let newer = device.replacen("RevisionNo=\"#x00010000\"", "RevisionNo=\"#x00010001\"", 1);
    assert_ne!(device, newer);
    let with = |devices: &str| format!("{}{devices}{}", &text[..start], &text[end..]);
    nothing_moves("coupler.xml", &with(&device), &with(&format!("{device}{newer}")));
}

#[test]
fn a_second_access_point_moves_nothing() {
    let text = std::fs::read_to_string(crate::root::root().join("tests/data/drive.gsdml.xml")).expect("a description");
    let text = text.replacen("MinDeviceInterval=\"32\"", "MinDeviceInterval=\"x\"", 1);
    let start = text.find("<DeviceAccessPointItem ").expect("an access point");
    const END: &str = "</DeviceAccessPointItem>";
    let end = text.find(END).expect("its end") + END.len();
    let second = text[start..end]
        .replacen("ID=\"DAP\"", "ID=\"DAP_2\"", 1)
        .replacen("0x00000011", "0x00000012", 1)
        .replace("\"DAP_V\"", "\"DAP_2_V\"")
        .replace("\"DAP_I\"", "\"DAP_2_I\"")
        .replace("\"DAP_P\"", "\"DAP_2_P\"");
    nothing_moves("drive.xml", &text, &format!("{}{second}{}", &text[..end], &text[end..]));
}
