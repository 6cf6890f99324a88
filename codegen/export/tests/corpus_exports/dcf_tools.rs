//! Tests exported files with `dcfchk` from the Lely `dcf-tools`, an independent reader of EDS files.
//!
//! If `dcfchk` accepts a file, it must also accept the output of `export --real hex`. If Python does not have the
//! package, the test prints a message and passes.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::corpus_support::{files_of, python};
use lexibus_codegen::compile::{read, Options};
use lexibus_codegen::source::Source;
use lexibus_export::eds::{self, export, Flavor, Reals};
use serde::Deserialize;

/// Files whose exports `dcfchk` rejects, with the reason.
const NOT_ACCEPTED: [(&str, &str); 1] = [(
    "christiansandberg__canopen__sample",
    "the object lists omit the PDO mapping, which maps the missing object 0x6040; the export lists all objects",
)];

/// The results of `dcfchk -n 5`, with its list of known keys and without it.
#[derive(Debug, Deserialize)]
struct Verdict {
    strict: bool,
    lenient: bool,
    error: String,
}

fn verdicts(python: &Path, paths: &[PathBuf]) -> Vec<Verdict> {
    const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/corpus_exports/check.py");
    let output = Command::new(python).arg(SCRIPT).args(paths).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let verdicts: Vec<Verdict> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(verdicts.len(), paths.len());
    verdicts
}

#[test]
fn exported_files_are_accepted_if_their_originals_are() {
    let (Some(python), Some(files)) = (python::with(&["dcf.lint"]), files_of("eds")) else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("eds-in-dcf-tools");
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let options = eds::Options { flavor: Flavor::Eds, reals: Reals::Pattern };
    let (mut names, mut paths) = (Vec::new(), [Vec::new(), Vec::new()]);
    for (number, file) in files.into_iter().filter(|file| file.name.to_lowercase().ends_with(".eds")).enumerate() {
        let compilation = read(Source::new(file.name.as_str(), file.bytes.clone()), &Options::default());
        let Some(catalog) = &compilation.catalog else { continue };
        let Some(exported) = export(catalog, &catalog.devices[0], options) else { continue };
        for (list, (when, bytes)) in
            paths.iter_mut().zip([("before", file.bytes.clone()), ("after", exported.text.into_bytes())])
        {
            let path = folder.join(format!("{number}-{when}.eds"));
            std::fs::write(&path, bytes).expect("a temporary file");
            list.push(path);
        }
        names.push(file.name);
    }
    let [before, after] = paths.map(|paths| verdicts(&python, &paths));
    let count = |list: &[Verdict], of: fn(&Verdict) -> bool| list.iter().filter(|verdict| of(verdict)).count();
    eprintln!(
        "{} files: {} accepted strictly before and {} after export, {} and {} leniently",
        names.len(),
        count(&before, |verdict| verdict.strict),
        count(&after, |verdict| verdict.strict),
        count(&before, |verdict| verdict.lenient),
        count(&after, |verdict| verdict.lenient)
    );
    assert!(count(&before, |verdict| verdict.strict) > 0 && count(&before, |verdict| verdict.lenient) > 0);
    let is_excused = |name: &str| NOT_ACCEPTED.iter().any(|(prefix, _)| name.starts_with(prefix));
    let pairs = names.iter().zip(before.iter().zip(&after));
    let lost = pairs.filter(|(_, (before, after))| before.strict && !after.strict || before.lenient && !after.lenient);
    let lost: Vec<String> = lost
        .filter(|(name, _)| !is_excused(name))
        .map(|(name, (_, after))| format!("{name}: {}", after.error))
        .collect();
    assert!(lost.is_empty(), "not accepted after export:\n{}", lost.join("\n"));
}
