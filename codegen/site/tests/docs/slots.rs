//! Tests the slots, cycle times, redundancy and records on the overview of a device.

use crate::docs_support::{files, html_links, markdown_links, site};
use lexibus_codegen::facts::markdown;
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Page};

/// Number of modules that fit into slots 2 and 3.
const MODULES: usize = 20;

/// Returns the pages of a device access point that has all facts that the overview shows.
fn access_point(format: Format) -> Vec<Page> {
    let path = crate::root::root().join("tests/data/drive.gsdml.xml");
    let text = std::fs::read_to_string(path).expect("a description");
    let uses: String = (0..MODULES)
        .map(|at| {
            format!(
                "<ModuleItemRef ModuleItemTarget=\"M_{at}\" AllowedInSlots=\"2..3\" {}/>",
                if at == 7 { "UsedInSlots=\"3\"" } else { "" }
            )
        })
        .collect();
    let modules: String = (0..MODULES)
        .map(|at| {
            format!(
                "<ModuleItem ID=\"M_{at}\" ModuleIdentNumber=\"{:#x}\"><ModuleInfo><Name TextId=\"T_Axis\"/><InfoText TextId=\"T_Axis\"/></ModuleInfo>\
                 <VirtualSubmoduleList/></ModuleItem>",
                at + 256
            )
        })
        .collect();
    let record = "<IOData/><RecordDataList><ParameterRecordDataItem Index=\"2\" Length=\"4\"><Name TextId=\"T_Axis\"/>\
                  </ParameterRecordDataItem></RecordDataList>";
    let timing = "<TimingProperties SendClock=\"8 32 64..128\" ReductionRatio=\"1 2 4\"/>\
                  <RT_Class3TimingProperties SendClock=\"4 8\" ReductionRatioPow2=\"1 2\"/></ApplicationRelations>\
                  <MediaRedundancy SupportedRole=\"Client;Manager\"/>";
    let text = text
        .replace("<TimingProperties SendClock=\"32\" ReductionRatio=\"1 2 4\"/></ApplicationRelations>", timing)
        .replace("\"RT_CLASS_1\"", "\"RT_CLASS_1;RT_CLASS_3\"")
        .replace("MaxOutputLength=\"128\"/>", "MaxOutputLength=\"64\" MaxDataLength=\"160\"/><SystemRedundancy DeviceType=\"S2\" MaxSwitchOverTime=\"30\" NumberOfAR_Sets=\"1\"/>")
        .replace("FixedInSlots=\"1\"/>", &format!("FixedInSlots=\"1\"/>{uses}"))
        .replace("</ModuleList>", &format!("{modules}</ModuleList>"))
        .replacen("<IOData/>", record, 1);
    site(format, vec![("drive".to_owned(), Source::new("drive.xml", text.into()))])
}

/// Names and values of the facts on the overview.
const FACTS: [(&str, &str); 16] = [
    ("Physical slots", "0 to 1"),
    ("Slot of the access point", "0"),
    ("Real-time classes", "RT_CLASS_1, RT_CLASS_3"),
    ("Send clock", "0.25, 1, 2 to 4 ms"),
    ("Reduction ratios", "1, 2, 4"),
    ("Send clock (RT class 3)", "0.125, 0.25 ms"),
    ("Reduction ratios (RT class 3)", "1, 2"),
    ("Minimum device interval", "1 ms"),
    ("Start-up modes", "Advanced"),
    ("Media redundancy (MRP)", "Client, Manager"),
    ("System redundancy", "S2; AR sets: 1"),
    ("Application relations", "1"),
    ("Input data with status", "up to 128 bytes"),
    ("Output data with status", "up to 64 bytes"),
    ("Input and output data", "up to 160 bytes"),
    ("Record data", "up to 4068 bytes"),
];

/// Returns the overview among the pages of one device.
fn overview<'p>(pages: &'p [Page], file: &str) -> &'p str {
    let is_overview = |page: &&Page| page.path.ends_with(file) && page.path.contains("/no-revision/");
    &pages.iter().find(is_overview).expect("an overview").text
}

#[test]
fn an_access_point_in_html() {
    let pages = access_point(Format::Html);
    html_links(&pages);
    let text = overview(&pages, "/index.html");
    for (name, value) in FACTS {
        assert!(text.contains(&format!("<tr><th scope=\"row\">{name}<td>{value}<")), "{name}: {text}");
    }
    for row in [
        "<tr><th scope=\"row\">1<td><td>fixed<td><a href=\"../../../example/_files/drive/modules.html#module-00000030\">Axis</a>",
        "<tr><th scope=\"row\">2 to 3<td><td>possible<td><details><summary>20 modules</summary><a href=\"../../../example/_files/drive/modules.html#module-00000100\">Axis</a>, ",
        "<tr><th scope=\"row\">3<td><td>preset<td><a href=\"../../../example/_files/drive/modules.html#module-00000107\">Axis</a>",
        "<tr><th scope=\"row\">0x8000<td><td>fixed<td><a href=\"../../../example/_files/drive/modules.html#submodule-00008000\">Interface</a>",
        "<tr><th scope=\"row\">0x0002<td>Axis<td>4 bytes<td><a href=\"../../../example/_files/drive/modules.html#submodule-00000001\">Servo head</a>",
    ] {
        assert!(text.contains(row), "{row}: {text}");
    }
}

#[test]
fn an_access_point_in_markdown() {
    let pages = access_point(Format::Markdown);
    markdown_links(&pages);
    let text = overview(&pages, "/index.md");
    for (name, value) in FACTS {
        assert!(text.contains(&format!("\n| {name} | {} |\n", markdown::escape(value, |_| true))), "{name}: {text}");
    }
    for row in [
        "\n| 1 |  | fixed | [Axis](../../../example/_files/drive/modules.md#module-00000030) |\n",
        "\n| 2 to 3 |  | possible | [Axis](../../../example/_files/drive/modules.md#module-00000100), [Axis](",
        "\n| 3 |  | preset | [Axis](../../../example/_files/drive/modules.md#module-00000107) |\n",
        "\n| 0x8000 |  | fixed | [Interface](../../../example/_files/drive/modules.md#submodule-00008000) |\n",
        "\n| 0x0002 | Axis | 4 bytes | [Servo head](../../../example/_files/drive/modules.md#submodule-00000001) |\n",
    ] {
        assert!(text.contains(row), "{row}: {text}");
    }
}

#[test]
fn slots_of_an_ethercat_coupler() {
    let pages = files(Format::Html, &["tests/data/coupler.esi.xml"]);
    let is_coupler = |page: &&Page| page.path.contains("/cp-32-") && page.path.ends_with("/0x00010000/index.html");
    let text = &pages.iter().find(is_coupler).expect("an overview").text;
    assert!(text.contains("; up to 32 slots<"), "{text}");
    let row = "<tr><th scope=\"row\">0 to 31<td>Terminals<td>possible<td><a href=\"../../../example/_files/coupler/modules.html#module-00001001\">16 digital inputs</a>, ";
    assert!(text.contains(row), "{text}");
}

#[test]
fn links_to_submodules_without_a_name_have_a_text() {
    let path = crate::root::root().join("tests/data/drive.gsdml.xml");
    let text = std::fs::read_to_string(path).expect("a description");
    let name = "<ModuleInfo><Name TextId=\"T_Map\"/><InfoText TextId=\"T_Map\"/></ModuleInfo>";
    assert!(text.contains(name));
    let source = Source::new("drive.xml", text.replace(name, "").into());
    let pages = site(Format::Html, vec![("drive".to_owned(), source)]);
    let links = pages.iter().flat_map(|page| page.text.split("#submodule-0000FFFF\">").skip(1));
    let texts: Vec<&str> = links.filter_map(|link| link.split('<').next()).collect();
    assert!(!texts.is_empty() && texts.iter().all(|text| *text == "0x0000FFFF"), "{texts:?}");
}

/// Returns the page of `safe.gsdml.xml` whose path ends with `name`.
fn station(format: Format, name: &str) -> String {
    let pages = files(format, &["tests/data/safe.gsdml.xml"]);
    pages.into_iter().find(|page| page.path.ends_with(name)).expect("the modules").text
}

#[test]
fn requests_for_records_are_about_the_whole_record() {
    let address = "API 0, slot of the module (1 to 3), subslot 1, index 0x0002, length 9, value in bytes 3–6";
    let bytes = "5A 01 84 3F C0 00 00 EE 07";
    let text = station(Format::Markdown, "/modules.md");
    let lines = [
        format!("\nDefault bytes: `{bytes}`\n"),
        format!("\nPROFINET record read: {address}\n"),
        format!("\nPROFINET record write: {address}\nPROFINET record bytes: {bytes}\n"),
    ];
    for line in lines {
        assert!(text.contains(&line), "{line}: {text}");
    }
    let text = station(Format::Html, "/modules.html");
    for part in [format!(" data-at=\"r 24 32 {address}\""), format!("<p>Default bytes: <code>{bytes}</code><table")] {
        assert!(text.contains(&part), "{part}: {text}");
    }
}

#[test]
fn items_in_records_have_rust_code() {
    let path = "submodules::safe_inputs::InputFilterRecord";
    let text = station(Format::Markdown, "/modules.md");
    let read = format!("\nrecords.read::<{path}>(address)?.gain\n");
    let write = format!(
        "\nlet record = {path} {{ gain: value, ..records.read(address)? }}; records.write(address, &record)?\n"
    );
    assert!(text.contains(&read) && text.contains(&write), "{text}");
}

#[test]
fn objects_of_modules_have_rust_code() {
    let pages = files(Format::Markdown, &["tests/data/coupler.esi.xml"]);
    let modules = pages.iter().find(|page| page.path.ends_with("/modules.md")).expect("the modules");
    let handle = "modules::ai_2::objects::settings::FILTER.shifted(offset).at(&mut client)";
    for call in ["read()?", "write(value)?"] {
        assert!(modules.text.contains(&format!("{handle}.{call}")), "{call}: {}", modules.text);
    }
}
