//! Tests for the names and texts that `cantools` reads from a DBC.

use std::path::Path;
use std::process::Command;

use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_network::compile::compile;
use lexibus_network::output::dbc;

use crate::corpus_support::{python, root};

/// Prints a line for each signal. The line contains the sender, the names of the message and the signal, the comment, and the unit.
const SCRIPT: &str = "
import json, sys, cantools
for message in cantools.database.load_file(sys.argv[1]).messages:
    for signal in message.signals:
        print(json.dumps([message.senders[0], message.name, signal.name, signal.comment, signal.unit or '']))
";

/// Two objects have the name `SIGNAL`. One node has the name `NODE`, and another node has this name with a suffix.
const SIGNAL: &str = "Actual value of the second encoder in user-defined units";
const NODE: &str = "the drive on the left side of the machine";

/// Returns the DBC of a network of three drives. The names are long or reserved, or contain characters that Windows-1252 lacks.
fn network(folder: &Path) -> Vec<u8> {
    std::fs::create_dir_all(folder).expect("a folder");
    let mut drive = std::fs::read_to_string(root::root().join("examples/network/drive.eds")).expect("the example");
    let names = [
        ("Position actual value", SIGNAL),
        ("Velocity actual value", SIGNAL),
        ("Statusword", "Größe in \u{212B}⁻¹ \\"),
    ];
    for (old, new) in names {
        let [old, new] = [old, new].map(|name| format!("ParameterName={name}\r\n"));
        assert!(drive.contains(&old));
        drive = drive.replace(&old, &new);
    }
    std::fs::write(folder.join("drive.eds"), drive).expect("a file");
    let overlay =
        "lexibus = 1\n[overlay]\nwhy = \"test\"\n[[chapters]]\n[chapters.objects]\n0x6064 = { unit = \"kΩ\" }\n";
    std::fs::write(folder.join("overlay.toml"), overlay).expect("a file");
    let mut text = String::from("[master]\nid = 127\npdos = false\n[nodes]\n");
    for (id, name) in [(1, NODE), (2, &format!("{NODE} 2")), (3, "FILTER")] {
        text += &format!(
            "\"{name}\" = {{ id = {id}, device = \"drive.eds\", overlays = [\"overlay.toml\"], \
             rpdo = {{ 1 = {{ enabled = false }} }}, \
             tpdo = {{ 1 = {{ map = [\"0x6064\", \"0x606C\"] }}, 2 = {{ map = [\"0x6041\"] }} }} }}\n"
        );
    }
    let compilation = compile(Source::new("network.toml", text.into_bytes()).in_folder(folder), Levels::lenient());
    dbc(compilation.usable().unwrap_or_else(|| panic!("{:?}", compilation.diagnostics.list())))
}

#[test]
fn names_are_unique_and_texts_are_in_windows_1252() {
    let Some(python) = python::with(&["cantools"]) else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dbc-names");
    let bytes = network(&folder);
    let path = folder.join("network.dbc");
    std::fs::write(&path, bytes).expect("a file");
    let output = Command::new(&python).args(["-c", SCRIPT]).arg(&path).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let mut rows: Vec<[String; 5]> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    // Compare only the start of each comment. The rest is the end of a long name, and the documentation of the object.
    rows.iter_mut().for_each(|row| row[3].truncate(28));
    let [node, signal] = [NODE, SIGNAL].map(|name| name.replace([' ', '-'], "_"));
    let mut expected = Vec::new();
    for (sender, name) in
        [(&node, &node), (&format!("{node}_2"), &format!("{node}_2")), (&"FILTER_2".into(), &"FILTER".into())]
    {
        let row = |message, signal: &str, comment: &str, unit: &str| {
            [sender.clone(), format!("{name}_{message}"), signal.to_owned(), comment.to_owned(), unit.to_owned()]
        };
        expected.push(row("TPDO1", &signal, "0x6064:00 Actual value of th", "kOhm"));
        expected.push(row("TPDO1", &format!("{signal}_2"), "0x606C:00 Actual value of th", ""));
        expected.push(row("TPDO2", "Gr_e_in", "0x6041:00 Größe in Å^-1 /", ""));
    }
    assert_eq!(rows, expected);
}
