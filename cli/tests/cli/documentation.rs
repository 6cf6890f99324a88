//! Tests documentation sites, Markdown pages and comparisons.

use super::{code, err, file, folder, lexibus, out, COUPLER, DEMO, QUIRKY};

#[test]
fn a_site_of_documentation() {
    let folder = folder("site");
    let out = folder.join("pages");
    let output = lexibus(&["docs", DEMO, COUPLER, "--out", &out.to_string_lossy()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let read = |path: &str| std::fs::read_to_string(out.join(path)).unwrap_or_else(|_| panic!("{path}"));
    assert!(read("index.html").contains("href=\"lexibus/demo-drive-0x00004021/0x00010000/index.html\""));
    assert!(read("lexibus/demo-drive-0x00004021/0x00010000/profile-objects.html").contains("id=\"0x6040\""));
    for shared in ["site.css", "site.js", "search.js"] {
        assert!(!read(shared).is_empty());
    }
    // Pages of an earlier call are removed. Other files stay.
    let coupler = std::fs::read_dir(&out).expect("a folder").filter_map(|entry| Some(entry.ok()?.path()));
    let coupler = coupler.filter(|path| path.is_dir() && !path.ends_with("lexibus")).collect::<Vec<_>>();
    assert_eq!(coupler.len(), 1, "{coupler:?}");
    std::fs::write(coupler[0].join("notes.html"), "<title>My notes</title>").expect("a file");
    // If a description has errors, no page is removed.
    let broken = file(&folder, "broken.eds", "");
    assert_eq!(code(&lexibus(&["docs", DEMO, &broken, "--out", &out.to_string_lossy()])), 1);
    assert!(std::fs::read_dir(&coupler[0]).expect("a folder").count() > 1);
    let call = |further: &[&str]| lexibus(&[&["docs", DEMO, "--out", &out.to_string_lossy()], further].concat());
    let output = call(&["--check"]);
    assert!(code(&output) == 1 && err(&output).contains("modules.html is not part of"), "{}", err(&output));
    assert_eq!(code(&call(&[])), 0);
    assert_eq!(std::fs::read_dir(&coupler[0]).expect("a folder").count(), 1, "only the notes");
    assert_eq!(code(&call(&["--check"])), 0);
    // A missing option `--out` and an output that cannot be written are errors.
    let file = file(&folder, "occupied", "");
    assert_eq!(code(&lexibus(&["docs", DEMO, "--out", &file])), 1);
    assert_eq!(code(&lexibus(&["docs", DEMO])), 2);
}

#[test]
fn pages_of_markdown() {
    let folder = folder("markdown");
    let out = folder.join("pages");
    let call = |further: &[&str]| {
        let out = out.to_string_lossy();
        lexibus(&[&["docs", DEMO, "--format", "markdown", "--out", &out], further].concat())
    };
    // `--check` fails because the pages do not exist yet.
    assert_eq!(code(&call(&["--check"])), 1);
    assert_eq!(code(&call(&[])), 0);
    assert_eq!(code(&call(&["--check"])), 0);
    let summary = std::fs::read_to_string(out.join("SUMMARY.md")).expect("a summary");
    // `--compare` adds a page with the changes between two descriptions, and a link to it in the list of devices.
    assert_eq!(code(&call(&["--compare", DEMO, COUPLER])), 0);
    let page = out.join("_compare/demo-drive-to-coupler-esi.md");
    let changes = std::fs::read_to_string(&page).expect("a comparison");
    let has = |text: &str| changes.contains(text);
    assert!(
        has("# demo-drive → coupler.esi") && has("| breaks api, wire | Demo Drive: device | removed |"),
        "{changes}"
    );
    let first = std::fs::read_to_string(out.join("README.md")).expect("a list");
    assert!(first.contains("(_compare/demo-drive-to-coupler-esi.md)"), "{first}");
    assert_eq!(code(&call(&[])), 0);
    assert!(!page.exists(), "comparisons that are not asked for are removed");
    assert!(
        summary.contains(
            "\n- [Demo Drive](lexibus/demo-drive-0x00004021/0x00010000/index.md)\n  - [Communication objects]"
        ),
        "{summary}"
    );
    let page = out.join("lexibus/demo-drive-0x00004021/0x00010000/profile-objects.md");
    std::fs::write(&page, "<!-- Written by lexibus docs -->\n# Old\n").expect("a page");
    let output = call(&["--check"]);
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("profile-objects.md is stale"), "{}", err(&output));
    assert_eq!(code(&call(&[])), 0);
    assert!(std::fs::read_to_string(&page).expect("a page").contains("<a id=\"0x6040\"></a>"));
    // Files that `lexibus docs` did not write must not be overwritten.
    std::fs::write(out.join("README.md"), "# A project\n\nPages are made by `lexibus docs`.\n").expect("a file");
    let output = call(&[]);
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("README.md exists and was not written by `lexibus docs`"), "{}", err(&output));
    assert_eq!(
        std::fs::read_to_string(out.join("README.md")).expect("a file"),
        "# A project\n\nPages are made by `lexibus docs`.\n"
    );
    let latin = b"# Gr\xFC\xDFe\n";
    std::fs::write(out.join("README.md"), latin).expect("a file");
    assert_eq!(code(&call(&[])), 1);
    assert_eq!(std::fs::read(out.join("README.md")).expect("a file"), latin, "in any encoding");
}

#[test]
fn changes_between_two_versions() {
    let folder = folder("diff");
    let old = file(&folder, "old.eds", QUIRKY);
    let wider = file(&folder, "wider.eds", &QUIRKY.replace("DefaultValue=012", "DefaultValue=5"));
    let other = file(&folder, "other.eds", &QUIRKY.replace("DataType=0x0006", "DataType=0x0007"));
    let output = lexibus(&["diff", &old, &old]);
    assert_eq!((code(&output), out(&output).as_str()), (0, "no changes\n"));
    let output = lexibus(&["diff", &old, &wider]);
    assert_eq!(
        (code(&output), out(&output).as_str()),
        (
            0,
            "breaks behavior: 0x2000:00 Gain: default 10, now 5\n\
             1 change; breaking: api 0, wire 0, behavior 1; compatible: 0; no effect: 0\n"
        )
    );
    let output = lexibus(&["diff", &old, &wider, "--show", "breaking"]);
    assert_eq!(out(&output).lines().count(), 1, "the summary also counts the changes that are not shown");
    let output = lexibus(&["diff", &old, &other]);
    assert_eq!(code(&output), 1);
    assert!(
        out(&output).starts_with("breaks api, wire: 0x2000:00 Gain: type UNSIGNED16, now UNSIGNED32\n"),
        "{}",
        out(&output)
    );
    let output = lexibus(&["diff", &old, &other, "--format", "json"]);
    let line: serde_json::Value = serde_json::from_str(out(&output).lines().next().expect("a change")).expect("JSON");
    let judgment = [&line["api"], &line["wire"], &line["behavior"]];
    assert_eq!(
        (&line["fact"], judgment),
        (&"type".into(), [&"breaking".into(), &"breaking".into(), &"unaffected".into()])
    );
    let page = folder.join("page.html");
    lexibus(&["diff", &old, &other, "--format", "html", "--out", &page.to_string_lossy()]);
    assert!(std::fs::read_to_string(page).expect("a page").contains("<td><b>breaks api, wire</b>"));
    assert_eq!(code(&lexibus(&["diff", &old, "nowhere.eds"])), 2);
    let broken = file(&folder, "broken.toml", "lexibus = 1\n[device]\n");
    assert_eq!(code(&lexibus(&["diff", &old, &broken])), 1);
}
