//! Tests the HTML output of `lexibus docs`: valid links, escaped texts and limited size.

use crate::docs_support::{files, hostile, html_links, html_markup, site, values, ALL};
use std::collections::BTreeSet;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Page, Site};

#[test]
fn all_links_are_valid() {
    let count = html_links(&files(Format::Html, &ALL));
    assert!(count > 5000, "only {count} links");
}

#[test]
fn the_search_finds_the_entries_of_pages() {
    let pages = files(Format::Html, &["dictionaries/hsd-sm137-sm140.toml"]);
    let index =
        &pages.iter().find(|page| page.path == "hsd-s-p-a/_files/hsd-sm137-sm140/search.js").expect("an index").text;
    // Search for a parameter, the Italian name of a message, and a code.
    for text in ["KP_VEL\\t", "\\nCmdTraj\\tPosizionamento", "\\noverheated\\tALOVERHEATED\\t"] {
        assert!(index.contains(text), "{text}");
    }
    assert!(index.starts_with("lexibusIndex([[\"HSD Motor\",\""));
    assert!(index.contains("\\nparameter 0x0105\\n"));
}

#[test]
fn the_search_finds_modules_by_name_order_code_and_ident_number() {
    let path = crate::root::root().join("tests/data/drive.gsdml.xml");
    let text = std::fs::read_to_string(path).expect("a description");
    let order = "<InfoText TextId=\"T_Axis\"/><OrderNumber Value=\"EX-7 AX\"/>";
    let text = text.replace("<InfoText TextId=\"T_Axis\"/>", order);
    let pages = site(Format::Html, vec![("drive".to_owned(), Source::new("drive.xml", text.into()))]);
    let index = &pages.iter().find(|page| page.path.ends_with("/search.js")).expect("an index").text;
    // The ident number and the order code of the module are entries with its name and anchor. The second entry differs from the
    // first only in its number.
    for part in ["\\n0x00000030\\nEX-7 AX\\n", "\\nAxis\\t", "\\nmodule-00000030\\n", ",1,1,1,1,0,0,"] {
        assert!(index.contains(part), "{part}: {index}");
    }
    let modules = &pages.iter().find(|page| page.path.ends_with("/modules.html")).expect("the modules").text;
    assert!(modules.contains("<section id=\"module-00000030\" class=\"module\">"), "{modules}");
    // The data of submodules are not objects.
    assert!(!modules.contains("<th scope=\"col\">Object"), "{modules}");
}

#[test]
fn nothing_of_a_description_is_markup() {
    let pages = site(Format::Html, hostile::descriptions());
    html_markup(&pages);
    let shown: usize = pages
        .iter()
        .filter(|page| page.path.ends_with(".html"))
        .map(|page| page.text.matches("alert(1)").count())
        .sum();
    assert!(shown > 60, "only {shown} texts are shown");
}

#[test]
fn nothing_comes_from_elsewhere() {
    for page in files(Format::Html, &ALL) {
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
    let pages = site(Format::Html, vec![("big".to_owned(), Source::new("big.toml", table.into()))]);
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
    let pages = site(Format::Html, vec![("pump".to_owned(), Source::new("pump.toml", table.into()))]);
    let page = pages.iter().find(|page| page.path.ends_with("/control.html")).expect("the chapter");
    let (_, content) = page.text.split_once("<main").expect("the content");
    insta::assert_snapshot!(content);
}

#[test]
fn repairs_stand_where_they_matter() {
    let eds = "[DeviceInfo]\nProductName=Pump\n[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n\
               [2000]\nParameterName=Gain\nDataType=6\nAccessType=rw\nDefaultValue=012\nLowLimit=010\n\
               [2001]\nParameterName=Level\nDataType=6\nAccessType=ro\n";
    for (format, page, all) in [
        (Format::Html, "/manufacturer-objects.html", "/diagnostics.html"),
        (Format::Markdown, "/manufacturer-objects.md", "/diagnostics.md"),
    ] {
        let pages = site(format, vec![("pump".to_owned(), Source::new("pump.eds", eds.into()))]);
        let text =
            |end: &str| &pages.iter().find(|page| page.path.ends_with(end)).unwrap_or_else(|| panic!("{end}")).text;
        let (gain, level) = text(page).split_once("id=\"0x2001\"").expect("two objects");
        assert!(gain.contains("Repaired") && gain.contains("(pump.eds:11:14, EDS020)"), "{gain}");
        assert!(!level.contains("Repaired"), "{level}");
        let heading = text(all).lines().find(|line| line.contains("EDS020") && line.contains("2 repairs"));
        assert!(heading.is_some(), "{}", text(all));
        let first = pages.iter().find(|page| page.path.contains("/no-revision/index."));
        assert!(first.expect("the first page").text.contains(&format!("_files/pump{all}")));
    }
    // If a file has no diagnostics, its documentation has no page of diagnostics.
    let pages = files(Format::Html, &["dictionaries/demo-drive.eds"]);
    assert!(pages.iter().all(|page| !page.path.ends_with("diagnostics.html")));
}

#[test]
fn revisions_in_two_files_are_compared() {
    let eds = |revision: u32, access: &str| {
        format!(
            "[DeviceInfo]\nVendorName=Maker\nVendorNumber=5\nProductName=Pump\nProductNumber=7\nRevisionNumber={revision}\n\
             [ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
             [2000]\nParameterName=Gain\nDataType=6\nAccessType={access}\n"
        )
    };
    // The pages must not depend on the order of the files.
    let source = |name: &str, text: String| (name.to_owned(), Source::new(format!("{name}.eds"), text.into()));
    let (old, new) = (source("old", eds(1, "rw")), source("new", eds(2, "ro")));
    let other = |text: String| text.replace("ProductNumber=7", "ProductNumber=8\nOrderCode=P-8");
    let first = source("first", other(eds(1, "rw")));
    let renamed = source("renamed", other(eds(2, "rw")).replace("ProductName=Pump", "ProductName=Pump plus"));
    for mut sources in [vec![old.clone(), new.clone()], vec![new, old]] {
        sources.extend([renamed.clone(), first.clone()]);
        let pages = site(Format::Html, sources);
        let text = |path: &str| &pages.iter().find(|page| page.path == path).unwrap_or_else(|| panic!("{path}")).text;
        let changes = text("maker/pump-0x00000007/0x00000002/changes.html");
        assert!(changes.contains("<td>access<td data-title=\"Old\">rw<td data-title=\"New\">ro"), "{changes}");
        assert!(text("maker/pump-0x00000007/0x00000002/index.html").contains("Changes since revision 0x00000001"));
        assert!(text("maker/pump-0x00000007/latest/index.html").contains("href=\"../0x00000002/index.html\""));
        // The newest revision has another name.
        let newest = "href=\"../../../maker/pump-plus-0x00000008/0x00000002/index.html\"";
        assert!(text("maker/pump-0x00000008/latest/index.html").contains(newest));
        assert!(pages.iter().any(|page| page.path == "maker/pump-plus-0x00000008/0x00000002/changes.html"));
        assert!(pages.iter().all(|page| page.path != "maker/pump-0x00000007/0x00000001/changes.html"));
        html_links(&pages);
        // The search results contain the revision if the titles are equal.
        for device in ["[\"Pump (0x00000001)\",", "[\"Pump (0x00000002)\",", "[\"Pump plus\","] {
            assert!(text("search.js").contains(device), "{device}");
        }
    }
}

#[test]
fn notes_of_an_object_are_shown_once() {
    let pages = files(Format::Html, &["dictionaries/aec-vector-step.toml", "dictionaries/eco.toml"]);
    let text = |end: &str| &pages.iter().find(|page| page.path.ends_with(end)).unwrap_or_else(|| panic!("{end}")).text;
    let objects = text("vector-step/no-revision/communication-objects.html");
    // Both entries of the object have this ambiguity.
    assert_eq!(objects.matches("both have the symbol standard_error_field").count(), 1);
    assert!(objects.contains("<summary>Ambiguity of 0x1003:01, 0x1003:02</summary><div"), "{objects}");
    // A register has the same address in several windows.
    let (_, parameter) = text("eco/no-revision/parameters.html").split_once("<tbody id=\"d1\"").expect("a register");
    let (parameter, _) = parameter.split_once("</tbody>").expect("an end");
    assert_eq!(parameter.matches("parameter 0x0001 on CANopen").count(), 1, "{parameter}");
    // The compiler reports the object once, at its section.
    let eds = "[DeviceInfo]\nProductName=Pump\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
               [2000]\nParameterName=Speed\nDataType=6\nAccessType=ro\n\
               [3001]\nParameterName=Gains\nObjectType=9\nSubNumber=2\n\
               [3001sub0]\nParameterName=Count\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
               [3001sub1]\nParameterName=Gain\nDataType=6\nAccessType=rw\n";
    let pages = site(Format::Html, vec![("pump".to_owned(), Source::new("pump.eds", eds.into()))]);
    let page = pages.iter().find(|page| page.path.ends_with("manufacturer-objects.html")).expect("the page");
    assert_eq!(page.text.matches("Object 0x3001 is described, but is in no object list").count(), 1, "{}", page.text);
}

#[test]
fn families_have_their_vendor_in_the_heading() {
    let device = "<Device Physics=\"YY\"><Type ProductCode=\"#x1\" RevisionNo=\"#x1\">T1</Type><Name>T1</Name>\
                  <GroupType>Terminals</GroupType></Device>";
    let esi = format!(
        "<EtherCATInfo><Vendor><Id>#x77</Id><Name>Maker</Name></Vendor><Descriptions><Groups><Group>\
         <Type>Terminals</Type><Name>Terminals</Name></Group></Groups><Devices>{device}</Devices></Descriptions>\
         </EtherCATInfo>"
    );
    let pages = site(Format::Html, vec![("terminals".to_owned(), Source::new("terminals.xml", esi.into()))]);
    let list = &pages.iter().find(|page| page.path == "index.html").expect("the list").text;
    assert!(list.contains("Maker – Terminals") && !list.contains("<th scope=\"col\">Vendor"), "{list}");
    assert!(list.contains(">1 device<"), "{list}");
}

/// Returns the description with a text that describes the axis module, in addition to its name.
fn with_information(text: &str) -> String {
    let primary = "<Text TextId=\"T_Info\" Value=\"For one axis\"/></PrimaryLanguage>";
    text.replace("<InfoText TextId=\"T_Axis\"/>", "<InfoText TextId=\"T_Info\"/>")
        .replace("</PrimaryLanguage>", primary)
}

#[test]
fn languages_of_modules_can_be_chosen() {
    let path = crate::root::root().join("tests/data/drive.gsdml.xml");
    let german = "<Language xml:lang=\"de\"><Text TextId=\"T_Tel1\" Value=\"Standardtelegramm 1\"/>\
                  <Text TextId=\"T_Info\" Value=\"Für eine Achse\"/></Language></ExternalTextList>";
    let text = with_information(&std::fs::read_to_string(path).expect("a description"));
    let text = text.replace("</ExternalTextList>", german);
    let source = || vec![("drive".to_owned(), Source::new("drive.xml", text.clone().into()))];
    let pages = site(Format::Html, source());
    let markdown = site(Format::Markdown, source());
    let page = markdown.iter().find(|page| page.path.ends_with("/modules.md")).expect("the modules");
    assert!(page.text.contains(" Standard telegram 1 *Standardtelegramm 1*\n"), "{}", page.text);
    let text = |end: &str| {
        let mut found = pages.iter().filter(|page| page.path.ends_with(end) && !page.path.contains("/latest/"));
        &found.next().unwrap_or_else(|| panic!("{end}")).text
    };
    for path in ["/index.html", "/modules.html"] {
        assert!(text(path).contains("<option>de</option>"), "{path}");
    }
    let modules = text("/modules.html");
    assert!(modules.contains("<i lang=\"de\">"), "names");
    assert!(modules.contains("<p lang=\"de\">"), "descriptions");
}

#[test]
fn equal_translations_are_shown_once() {
    let path = crate::root::root().join("tests/data/drive.gsdml.xml");
    let text = std::fs::read_to_string(path).expect("a description");
    let text = with_information(&text);
    let language = |tag: &str, axis: &str| {
        format!(
            "<Language xml:lang=\"{tag}\"><Text TextId=\"T_Axis\" Value=\"{axis}\"/><Text TextId=\"T_Info\" Value=\"1 {axis}\"/>\
             <Text TextId=\"T_Tel1\" Value=\"Standard telegram 1\"/></Language>"
        )
    };
    let languages = ["de", "nl"].map(|tag| language(tag, "Achse")).concat() + &language("fr", "Axe");
    let text = text.replace("</ExternalTextList>", &format!("{languages}</ExternalTextList>"));
    let page = |format, path: &str| {
        let pages = site(format, vec![("drive".to_owned(), Source::new("drive.xml", text.clone().into()))]);
        pages.into_iter().find(|page| page.path.ends_with(path)).expect("the modules").text
    };
    let html = page(Format::Html, "/modules.html");
    let name = "<b>Axis</b> <i lang=\"de\" title=\"de, nl\">Achse</i> <i lang=\"fr\">Axe</i></h2>";
    assert!(html.contains(name), "{html}");
    assert!(html.contains("<p lang=\"de\" title=\"de, nl\">1 Achse<p lang=\"fr\">1 Axe"), "{html}");
    // The description of the telegram only repeats its name, so the pages leave it out.
    assert!(html.contains("<b>Standard telegram 1</b></h2>") && !html.contains("<p>Standard telegram 1."), "{html}");
    let markdown = page(Format::Markdown, "/modules.md");
    assert!(markdown.contains(" Axis *Achse* (de, nl) *Axe*\n"), "{markdown}");
    assert!(markdown.contains("\n*1 Achse* (de, nl)\n"), "{markdown}");
    assert!(
        markdown.contains(" Standard telegram 1\n") && !markdown.contains("\nStandard telegram 1.\n"),
        "{markdown}"
    );
}

#[test]
fn long_content_is_split_by_size() {
    let entry = |at: usize| {
        let help = "Text ".repeat(500);
        format!("r{at} = {{ reg = {at}, type = \"u16\", access = \"rw\", doc = \"{help}\" }}\n")
    };
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"modbus\"]\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"Control\"\n[chapters.registers]\n{}",
        (1..=200).map(entry).collect::<String>()
    );
    let source = || vec![("pump".to_owned(), Source::new("pump.toml", table.clone().into()))];
    let pages = site(Format::Html, source());
    html_links(&pages);
    let areas: Vec<_> = pages.iter().filter(|page| page.path.contains("/control")).collect();
    assert!(areas.len() > 1 && areas.iter().all(|page| page.text.len() < 210_000), "{} pages", areas.len());
    let rows: usize = areas.iter().map(|page| page.text.matches("<tbody id=\"r").count()).sum();
    assert_eq!(rows, 200);
    // Both formats split the chapter into the same number of pages.
    let markdown = site(Format::Markdown, source());
    assert_eq!(markdown.iter().filter(|page| page.path.contains("/control")).count(), areas.len());
}

#[test]
fn each_transition_of_cia_402_has_an_arrow() {
    let pages = files(Format::Html, &["dictionaries/demo-drive.eds"]);
    let page = pages.iter().find(|page| page.path.ends_with("states-and-procedures.html")).expect("the state machine");
    let start = page.text.find("<svg class=\"states\"").expect("the diagram");
    let diagram = &page.text[start..start + page.text[start..].find("</svg>").expect("its end")];
    // Transition 13 can start in any state.
    assert!(diagram.contains(">any state<"), "{diagram}");
    assert_eq!(diagram.matches("marker-end").count(), 16);
    let texts = diagram.split("<text class=\"").skip(1).filter(|text| !text.starts_with("pattern"));
    let labels = texts.filter_map(|text| text.split_once('>')?.1.split('<').next());
    let numbers: BTreeSet<u32> =
        labels.flat_map(|label| label.split([' ', ','])).filter_map(|word| word.parse().ok()).collect();
    assert_eq!(numbers, (1..=16).collect());
    assert!(diagram.contains(">9 disable voltage<") && diagram.contains(">switch on disabled<"), "{diagram}");
    assert!(page.text.contains("id=\"drive.switch_on_disabled\""), "anchors are identifiers");
    assert!(page.text.contains("<td>xxxx xxxx x1xx 0000<td"), "states are bit patterns");
    assert_eq!(diagram.matches(">xxxx xxxx x").count(), 8, "each state has its pattern");
}

#[test]
fn lists_of_devices_have_no_empty_columns() {
    let pages = files(Format::Html, &["dictionaries/eco.toml"]);
    let text = |path: &str| &pages.iter().find(|page| page.path == path).unwrap_or_else(|| panic!("{path}")).text;
    let list = text("index.html");
    let columns = list.split("<th scope=\"col\">").skip(1).map(|rest| rest.split('<').next().unwrap_or_default());
    assert_eq!(columns.collect::<Vec<_>>(), ["Device", "Buses", "Profiles", "File"]);
    let overview = text("vendor-0x0000078f/eco/no-revision/index.html");
    assert!(overview.contains("<th scope=\"row\">Buses<td>CANopen, EtherCAT and Modbus"), "{overview}");
    assert!(overview.contains("<th scope=\"row\">Node-IDs and slave addresses<td>1 to 99"), "{overview}");
}

#[test]
fn objects_that_are_mapped_by_default_are_in_the_builder() {
    let entry = |index: &str, sub: u8, ty: u8, default: &str| {
        format!("[{index}sub{sub}]\nParameterName=Entry {sub}\nDataType={ty}\nAccessType=rw\nDefaultValue={default}\n")
    };
    let record = |index: &str| format!("[{index}]\nParameterName=PDO\nObjectType=9\nSubNumber=2\n");
    let eds = [
        "[DeviceInfo]\nProductName=Pump\nNrOfRXPDO=1\n[OptionalObjects]\nSupportedObjects=2\n1=0x1400\n2=0x1600\n\
         [ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n\
         [2000]\nParameterName=Gain\nDataType=6\nAccessType=rw\nPDOMapping=0\n\
         [2001]\nParameterName=Level\nDataType=6\nAccessType=rw\nPDOMapping=0\n"
            .to_owned(),
        record("1400") + &entry("1400", 0, 5, "1") + &entry("1400", 1, 7, "$NODEID+0x200"),
        record("1600") + &entry("1600", 0, 5, "1") + &entry("1600", 1, 7, "0x20000010"),
    ];
    let pages = site(Format::Html, vec![("pump".to_owned(), Source::new("pump.eds", eds.concat().into()))]);
    let page = pages.iter().find(|page| page.path.ends_with("/process-data.html")).expect("the PDOs");
    let (_, data) = page.text.split_once("<template id=\"mappable\">").expect("the builder");
    let (data, _) = data.split_once("</template>").expect("its end");
    let data = data.replace("&#34;", "\"");
    assert!(data.contains("[8192,0,16,\"0x2000:00 Gain\",true,false,"), "{data}");
    assert!(!data.contains("Level"), "{data}");
}

#[test]
fn the_search_has_printed_and_wire_addresses() {
    let pages = files(Format::Html, &["tests/ui/tables/printed-and-wire-addresses/input.toml"]);
    let index = pages.iter().find(|page| page.path.ends_with("/search.js")).expect("the index");
    for number in ["register 40101 (wire 100)", "register 40102–40103 (wire 101–102)", "coil 7 (wire 6)"] {
        assert!(index.text.contains(number), "{number}: {}", index.text);
    }
}

/// Returns an ESI file with a device for each number of input bytes. The devices have the same name, order code, product code and
/// revision.
fn terminals(bytes: &[u32]) -> Source {
    let device = |bytes: &u32| {
        format!(
            "<Device><Type ProductCode=\"#x03FA3052\" RevisionNo=\"#x00120000\">T1018</Type><Name>T1018 inputs</Name>\
             <TxPdo Fixed=\"1\"><Index>#x1A00</Index><Name>Inputs</Name><Entry><Index>#x6000</Index><SubIndex>1</SubIndex>\
             <BitLen>{}</BitLen><Name>Value</Name><DataType>UDINT</DataType></Entry></TxPdo></Device>",
            bytes * 8
        )
    };
    let devices: String = bytes.iter().map(device).collect();
    let text = format!(
        "<EtherCATInfo><Vendor><Id>#x77</Id><Name>Example</Name></Vendor><Descriptions><Devices>{devices}</Devices>\
         </Descriptions></EtherCATInfo>"
    );
    Source::new("terminals.xml", text.into())
}

/// Returns the texts of the rows in the list of all devices.
fn rows_of_list(pages: &[Page]) -> Vec<String> {
    let list = &pages.iter().find(|page| page.path == "index.html").expect("the list").text;
    let rows = list.split("<tr><th scope=\"row\">").skip(1).map(|row| row.split("</table>").next().unwrap_or_default());
    let text = |row: &str| {
        let parts = row.split('<').map(|part| part.rsplit('>').next().unwrap_or_default());
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("|")
    };
    rows.map(text).collect()
}

#[test]
fn rows_of_a_list_differ() {
    let files = [("a", &[4, 4, 2][..]), ("b", &[4])];
    let pages = site(Format::Html, files.map(|(name, bytes)| (name.to_owned(), terminals(bytes))).into());
    html_links(&pages);
    let row =
        |note: &str, file: &str| format!("T1018 inputs|{note}T1018|Example|0x03FA3052|0x00120000|EtherCAT|{file}");
    let note = " |(description 1 of 2, 2 identical descriptions)|";
    let other = " |(description 2 of 2)|";
    assert_eq!(rows_of_list(&pages), [row(note, "a"), row(other, "a"), row("", "b")]);
    let copies = pages.iter().filter(|page| page.path.ends_with("/process-data.html")).count();
    assert_eq!(copies, 3, "a copy has no pages");
    let markdown = site(Format::Markdown, vec![("a".to_owned(), terminals(&[4, 4]))]);
    let list = &markdown.iter().find(|page| page.path == "README.md").expect("the list").text;
    assert!(list.contains(") (2 identical descriptions) |"), "{list}");
    // The search results must also differ.
    let index = &pages.iter().find(|page| page.path == "search.js").expect("the index").text;
    for name in ["description 1 of 2, 2 identical descriptions", "0x00120000, description 2 of 2"] {
        assert!(index.contains(name), "{name}: {index}");
    }
}

#[test]
fn changes_name_their_device() {
    for (format, element) in
        [(Format::Html, "<th scope=\"row\">T1018 inputs: "), (Format::Markdown, "| T1018 inputs: ")]
    {
        let catalog = |bytes: &[u32]| check(terminals(bytes), &Options::default()).usable().expect("a catalog").clone();
        let page = Site::new(format).compare(("old", &catalog(&[4])), ("new", &catalog(&[4, 2])));
        assert!(page.text.contains(element), "{}", page.text);
    }
}
