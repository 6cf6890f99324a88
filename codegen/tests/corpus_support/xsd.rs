//! Validates files against the schemas of ETG and PI. Uses libxml2.
//!
//! The schemas are not part of the repository. Python's `lxml` calls libxml2. If the schemas or `lxml` are missing, the tests
//! print a message and pass.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::python;
use super::root::root;

/// Python script that prints one line per violation: file name, line and message.
const SCRIPT: &str = "\
import os, sys
from lxml import etree
schema, folder = sys.argv[1:]
schema = etree.XMLSchema(etree.parse(schema))
for name in sorted(os.listdir(folder)):
    try:
        document = etree.parse(os.path.join(folder, name))
    except (etree.XMLSyntaxError, OSError) as error:
        print(f'{name}: {error}')
        continue
    if not schema.validate(document):
        for error in schema.error_log:
            print(f'{name}: {error.line}: {error.message}')
print('done')
";

/// The validator for one schema.
pub struct Schema {
    path: PathBuf,
    python: PathBuf,
}

impl Schema {
    /// Creates a validator for the schema at `path` in the folder of schemas. If the schema, Python or `lxml` is missing, prints a
    /// message and returns `None`.
    pub fn new(path: &str) -> Option<Self> {
        let path = root().join("../shared/schemas").join(path);
        if !path.is_file() {
            eprintln!("skipped: there is no schema at {}", path.display());
            return None;
        }
        let python = python::with(&["lxml"])?;
        Some(Schema { path, python })
    }

    /// Returns the violations in `files`, which are pairs of file name and content. `what` must be unique for each call within a
    /// program.
    pub fn violations<'f>(&self, what: &str, files: impl IntoIterator<Item = (&'f str, &'f [u8])>) -> Vec<String> {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("xsd-{what}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder for files to validate");
        for (name, content) in files {
            std::fs::write(folder.join(name), content).expect("a file to validate");
        }
        let output = Command::new(&self.python).args(["-c", SCRIPT]).arg(&self.path).arg(&folder).output();
        let output = output.expect("the validator runs");
        let _ = std::fs::remove_dir_all(&folder);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        assert_eq!(lines.pop().as_deref(), Some("done"), "{}", String::from_utf8_lossy(&output.stderr));
        lines
    }
}
