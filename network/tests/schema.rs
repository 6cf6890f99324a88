//! Validates network files against the JSON Schema of `network.toml`.

#[path = "../../tests/support/python.rs"]
mod python;

use std::path::Path;
use std::process::Command;

use lexibus_network::frontend::schema;

/// Prints the number of schema errors in each file.
const SCRIPT: &str = "
import json, sys, tomllib
from jsonschema import Draft202012Validator
schema = json.load(open(sys.argv[1], encoding='utf-8'))
Draft202012Validator.check_schema(schema)
for path in sys.argv[2:]:
    print(len(list(Draft202012Validator(schema).iter_errors(tomllib.load(open(path, 'rb'))))))
";

#[test]
fn the_schema_accepts_the_example_and_rejects_faults() {
    let Some(python) = python::with(&["jsonschema", "tomllib"]) else { return };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("network.schema.json");
    std::fs::write(&path, schema()).expect("a file");
    let cases = [
        "net002-unknown-network-key",
        "net003-misplaced-key",
        "net004-network-value",
        "net013-parameter-range",
        "net025-slot-module",
    ];
    let files = cases.map(|case| root.join("tests/ui/codes-network").join(case).join("network.toml"));
    let mut command = Command::new(python);
    command.args(["-c", SCRIPT]).arg(path).arg(root.join("examples/network/network.toml")).args(files);
    let output = command.output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let counts: Vec<usize> =
        String::from_utf8_lossy(&output.stdout).lines().map(|line| line.parse().expect("a number")).collect();
    assert_eq!((counts[0], &counts[4..]), (0, &[0, 0][..]), "the example and faults that only descriptions show");
    assert!(counts[1..4].iter().all(|count| *count > 0), "{counts:?}");
}
