//! Tests the links between codes and the items that report them.

use crate::docs_support::{files, html_links, site, values};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Page};

#[test]
fn codes_have_links_to_the_items_with_the_same_value() {
    let pages = files(Format::Html, &["dictionaries/kollmorgen-akd.toml"]);
    let page = pages.iter().find(|page| page.path.ends_with("/codes.html")).expect("the codes");
    let (_, row) = page.text.split_once("id=\"operating_modes-6\"").expect("homing");
    let (row, _) = row.split_once("</tbody>").expect("the end of the row");
    assert!(row.contains("<b>Value of</b> <a href=\"profile-objects.html#0x6060.value-6\">"), "{row}");
}

#[test]
fn codes_have_links_to_what_reports_them_on_each_page() {
    let doc = "Another cause. ".repeat(20);
    let others: String =
        (1..1500).map(|code| format!("{code} = {{ name = \"code {code}\", doc = \"{doc}\" }}\n")).collect();
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"modbus\"]\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"Control\"\n[chapters.registers]\nfault_code = {{ reg = 1, type = \"u16\", enum = \"Fault\" }}\n\
         status_word = {{ reg = 2, type = \"u16\" }}\n[enums.Fault.values]\n2000 = \"dry\"\n\
         [codes.first.rows]\n{others}[codes.faults]\ndoc = \"Bit 3 of status_word is set\"\n[codes.faults.rows]\n\
         2000 = {{ name = \"dry\", doc = \"Clears with status_word\" }}\n"
    );
    let pages = site(Format::Html, vec![("pump".to_owned(), Source::new("pump.toml", table.into()))]);
    let codes: Vec<_> = pages.iter().filter(|page| page.path.contains("/codes")).collect();
    assert!(codes.len() > 2, "{} pages of codes", codes.len());
    let linked: Vec<_> = codes.iter().filter(|page| page.text.contains("class=\"links\"")).collect();
    let [last] = linked.as_slice() else { panic!("{} pages have links", linked.len()) };
    let file = last.path.rsplit('/').next().expect("a file");
    let (_, row) = last.text.split_once("id=\"faults-2000\"").expect("the code");
    assert!(row.contains("<b>Value of</b> <a href=\"control.html#fault_code.value-2000\">"), "{row}");
    assert!(row.contains("<b>See</b> <a href=\"control.html#status_word\">"), "{row}");
    let control = &pages.iter().find(|page| page.path.ends_with("/control.html")).expect("the registers").text;
    assert!(control.contains(&format!("<b>Codes</b> <a href=\"{file}#faults\">faults</a>")), "{control}");
    assert!(control.contains(&format!("<a href=\"{file}#faults-2000\">2000 dry</a>")), "{control}");
    html_links(&pages);
}

#[test]
fn a_table_of_codes_on_several_pages_is_linked_once() {
    let doc = "Another cause. ".repeat(20);
    let rows: String =
        (1..1500).map(|code| format!("{code} = {{ name = \"code {code}\", doc = \"{doc}\" }}\n")).collect();
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"modbus\"]\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"Control\"\n[chapters.registers]\nfault_code = {{ reg = 1, type = \"u16\", enum = \"Fault\" }}\n\
         [enums.Fault.values]\n1000 = \"code 1000\"\n1001 = \"code 1001\"\n1499 = \"code 1499\"\n[codes.faults.rows]\n{rows}"
    );
    let pages = site(Format::Html, vec![("pump".to_owned(), Source::new("pump.toml", table.into()))]);
    let of_row = |id: &str| pages.iter().find(|page| page.text.contains(&format!("id=\"{id}\""))).expect("a row");
    let (first, last) = (of_row("faults-1000"), of_row("faults-1499"));
    assert_ne!(first.path, last.path);
    let control = &pages.iter().find(|page| page.path.ends_with("/control.html")).expect("the registers").text;
    let links: Vec<&str> = values(control, "href").into_iter().filter(|link| link.ends_with("#faults")).collect();
    let file = first.path.rsplit('/').next().expect("a file");
    assert_eq!(links, [format!("{file}#faults")]);
    html_links(&pages);
}

#[test]
fn tables_of_errors_have_links_to_what_reports_them() {
    for (path, table, link) in [
        ("aec-vector-step.toml", "emergency", "communication-objects.html#0x1003"),
        ("eco.toml", "emergency", "communication-objects.html#0x1003"),
        ("eco.toml", "general_alarms", "registers.html#status_word.bit-3"),
        ("hsd-sm137-sm140.toml", "alarm", "states-and-procedures.html#axis.alarm"),
        ("eco.toml", "ethercat_alarms", "profile-objects.html#0x603F"),
        ("kollmorgen-akd.toml", "faults", "states-and-procedures.html#drive.fault"),
        ("demo-drive.eds", "emergency", "communication-objects.html#0x1003"),
    ] {
        let about = about_table(&files(Format::Html, &[&format!("dictionaries/{path}")]), table);
        let (_, see) = about.split_once("<b>See</b> ").expect("links");
        assert!(see.contains(&format!("<a href=\"{link}\">")), "{path}, {table}: {about}");
    }
}

/// Returns the HTML of a code table's section, from the heading up to the rows.
fn about_table(pages: &[Page], table: &str) -> String {
    let id = format!("<section id=\"{table}\">");
    let (_, section) = pages.iter().find_map(|page| page.text.split_once(&id)).expect("the table");
    section.split_once("<table").expect("its rows").0.to_owned()
}

#[test]
fn errors_of_drives_have_a_link_to_the_error_code() {
    let eds = "[DeviceInfo]\nProductName=Drive\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\
               [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x00020192\n\
               [OptionalObjects]\nSupportedObjects=1\n1=0x603F\n\
               [603F]\nParameterName=Error code\nDataType=6\nAccessType=ro\n";
    let pages = site(Format::Html, vec![("drive".to_owned(), Source::new("drive.eds", eds.into()))]);
    let about = about_table(&pages, "drive_errors");
    assert!(about.contains("<b>See</b> <a href=\"profile-objects.html#0x603F\">"), "{about}");
}
